//! `moreau completions`: what a shell needs to complete subcommands, options and their values.

use super::Answer;
use super::output::print;
use crate::Result;
use clap::Command;
use clap_complete::{Shell, generate};

/// Print the completion script of a shell.
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    /// The shell.
    #[arg(value_enum)]
    shell: Shell,
}

const EXAMPLES: &str = "\
Examples:
  mkdir -p ~/.local/share/bash-completion/completions ~/.zfunc ~/.config/fish/completions
  moreau completions bash > ~/.local/share/bash-completion/completions/moreau
  moreau completions zsh > ~/.zfunc/_moreau           with ~/.zfunc in fpath
  moreau completions fish > ~/.config/fish/completions/moreau.fish";

/// Runs the subcommand for this program.
pub fn run(arguments: &Arguments, mut program: Command) -> Result<Answer> {
    let mut script = Vec::new();
    generate(arguments.shell, &mut program, "moreau", &mut script);
    print(&String::from_utf8_lossy(&script))?;
    Ok(Answer::Yes)
}
