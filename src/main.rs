//! The `moreau` command: a thin shell around [`moreau::cli`].

fn main() -> std::process::ExitCode {
    moreau::cli::run()
}
