//! `moreau engine`: our own schemes behind the protocol that every other engine speaks.

use super::Answer;
use super::near::suggestion;
use crate::gate::own::{self, OwnEngine};
use crate::gate::process::Limits;
use crate::gate::{planted, serve};
use crate::schemes;
use crate::{Error, Result, solvers};
use std::io::{BufReader, stdin, stdout};
use std::path::Path;

/// Serve one of our schemes over moreau-engine/1 on standard input and output.
///
/// This is what `moreau gate -- moreau engine --scheme NAME` starts; docs/protocol.md specifies the messages. Options of
/// a request: solver; theta and activation of moreau-jean; directions of stewart-trinkle. Only these schemes are served: an engine
/// declares its contact law, the numbers of it and what it supports, and that is written down for these alone.
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    /// The scheme: moreau-jean, moreau-jean-theta-1, stewart-trinkle or anitescu.
    #[arg(long, value_name = "NAME", default_value = "moreau-jean", conflicts_with = "planted")]
    scheme: String,
    /// A planted mistake instead, by its name in `moreau defects`.
    #[arg(long, value_name = "NAME")]
    planted: Option<String>,
}

const EXAMPLES: &str = "\
Examples:
  moreau gate --quick --only incline/ -- moreau engine --scheme anitescu
  moreau protocol-check -- moreau engine
  moreau gate --quick --only bounce/ -- moreau engine --planted bounce/plastic-boxes   it fails, as it must";

/// Runs the subcommand.
pub fn run(arguments: &Arguments) -> Result<Answer> {
    let mut engine: Box<dyn crate::gate::Engine> = match &arguments.planted {
        None => Box::new(OwnEngine {
            solvers: solvers::ALL.clone(),
            ..own::by_name(&arguments.scheme).map_err(|_| unserved(&arguments.scheme))?
        }),
        Some(name) => {
            let known = planted::all().map(|planted| planted.name);
            let cure = || suggestion(name, known, "`moreau defects` lists them");
            let unknown = || Error::Unsupported(format!("no planted mistake `{name}`; {}", cure()));
            (planted::find(name).ok_or_else(unknown)?.subject.engine)()
        }
    };
    let failed = |source| Error::Write { file: Path::new("standard output").into(), source };
    serve::serve(engine.as_mut(), BufReader::new(stdin().lock()), stdout().lock(), Limits::default().line as u64).map_err(failed)?;
    Ok(Answer::Yes)
}

/// The error of a scheme that is not served, or that is none.
fn unserved(name: &str) -> Error {
    let served = own::NAMES.join(", ");
    if schemes::NAMES.contains(&name) {
        let problem =
            format!("is {name}, which is not served: an engine declares its contact law, and that is written down for {served} alone");
        let cure = format!("use one of these; `moreau simulate --scheme {name}` and `moreau compare` run it");
        return Error::invalid("--scheme", problem, cure);
    }
    Error::invalid("--scheme", format!("`{name}` is unknown"), suggestion(name, own::NAMES, &format!("use one of {served}")))
}
