//! The protocol's client. Whatever an engine does, the gate gets a cause in words, goes on with a new process, and leaves none behind;
//! and whatever an adapter mistakes, the probes say so.
//!
//! The engines are this executable itself, started again; so the tests need nothing but the crate.

#[cfg(unix)]
mod adapter;
#[cfg(unix)]
mod body;
#[cfg(unix)]
mod cases;
#[cfg(unix)]
mod command;
#[cfg(unix)]
mod conformance;
#[cfg(unix)]
mod engines;
#[cfg(unix)]
mod processes;

#[cfg(unix)]
fn main() -> std::process::ExitCode {
    let mut arguments = std::env::args().skip(1);
    match arguments.next().as_deref() {
        Some("--misbehave") => engines::run(&arguments.next().expect("a misbehaviour"), arguments.next().as_deref()),
        Some("--adapter") => adapter::run(&arguments.next().expect("a mistake")),
        _ => {
            let tests = cases::all().into_iter().chain(conformance::all()).chain(command::all()).collect();
            return libtest_mimic::run(&libtest_mimic::Arguments::from_args(), tests).exit_code();
        }
    }
    std::process::ExitCode::SUCCESS
}

#[cfg(not(unix))]
fn main() {}
