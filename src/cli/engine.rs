//! `moreau engine`: our own schemes behind the protocol that every other engine speaks.

use super::Answer;
use crate::gate::own::{self, OwnEngine};
use crate::gate::process::Limits;
use crate::gate::{planted, serve};
use crate::{Error, Result, solvers};
use std::io::{BufReader, stdin, stdout};
use std::path::Path;

/// Serve one of our schemes over moreau-engine/1 on standard input and output.
///
/// This is what `moreau gate -- moreau engine --scheme NAME` starts; docs/protocol.md specifies the messages. Options of
/// a request: solver; theta and activation of moreau-jean; directions of stewart-trinkle.
#[derive(clap::Args)]
pub struct Arguments {
    /// The scheme: moreau-jean, moreau-jean-theta-1, stewart-trinkle or anitescu.
    #[arg(long, value_name = "NAME", default_value = "moreau-jean", conflicts_with = "planted")]
    scheme: String,
    /// A planted mistake instead, by its name in `moreau defects`.
    #[arg(long, value_name = "NAME")]
    planted: Option<String>,
}

/// Runs the subcommand.
pub fn run(arguments: &Arguments) -> Result<Answer> {
    let mut engine: Box<dyn crate::gate::Engine> = match &arguments.planted {
        None => Box::new(OwnEngine { solvers: solvers::ALL.clone(), ..own::by_name(&arguments.scheme)? }),
        Some(name) => {
            let unknown = || Error::Unsupported(format!("no planted mistake `{name}`; `moreau defects` lists them"));
            (planted::find(name).ok_or_else(unknown)?.subject.engine)()
        }
    };
    let failed = |source| Error::Write { file: Path::new("standard output").into(), source };
    serve::serve(engine.as_mut(), BufReader::new(stdin().lock()), stdout().lock(), Limits::default().line as u64).map_err(failed)?;
    Ok(Answer::Yes)
}
