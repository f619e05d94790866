//! `moreau man`: manual pages, one per subcommand.

use super::Answer;
use super::output::print;
use super::several::require_folder;
use crate::files::write_together;
use crate::{Error, Result};
use clap::Command;
use clap_mangen::Man;
use std::path::PathBuf;

/// Write the manual pages, `moreau.1` and one per subcommand, into a folder.
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    /// The folder; it must exist.
    #[arg(value_name = "FOLDER")]
    folder: PathBuf,
}

const EXAMPLES: &str = "\
Examples:
  mkdir -p ~/.local/share/man/man1 && moreau man ~/.local/share/man/man1
  man moreau-gate";

/// Runs the subcommand for this program.
pub fn run(arguments: &Arguments, program: Command) -> Result<Answer> {
    require_folder("FOLDER", &arguments.folder)?;
    let mut program = program.disable_help_subcommand(true);
    program.build();
    let mut pages = vec![(arguments.folder.join("moreau.1"), page(program.clone())?)];
    for command in program.get_subcommands() {
        let name = format!("moreau-{}", command.get_name());
        pages.push((arguments.folder.join(format!("{name}.1")), page(command.clone())?));
    }
    // with the names `moreau-gate` that `build` has given them
    let files: Vec<_> = pages.iter().map(|(file, text)| (file.as_path(), text.as_slice())).collect();
    write_together(&files)?;
    print(&format!("{} manual pages written into {}\n", files.len(), arguments.folder.display()))?;
    Ok(Answer::Yes)
}

fn page(command: Command) -> Result<Vec<u8>> {
    let mut text = Vec::new();
    let told = |error: std::io::Error| Error::Unsupported(format!("the manual page cannot be made: {error}"));
    Man::new(command).render(&mut text).map_err(told)?;
    Ok(text)
}
