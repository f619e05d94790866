//! A bundle of misbehaving engines: this executable, started again with the name of a misbehaviour.
//!
//! Every one answers `describe` and `project`; to `project` with friction [`POISON`] it misbehaves. Some misbehave from the start.

use std::io::{BufRead, Write};
use std::process::{Command, Stdio};
use std::time::Duration;

/// The friction coefficient that brings the misbehaviour out.
pub const POISON: f64 = 13.0;

/// How long a misbehaving engine does nothing: far longer than any test waits.
const LONG: Duration = Duration::from_secs(600);

/// What an engine does instead of answering.
type Misbehaviour = fn(id: u64);

/// Misbehaviours that the poisoned question brings out, by name.
const MISBEHAVIOURS: [(&str, Misbehaviour); 32] = [
    ("hang", |_| sleep()),
    ("exit", |_| {
        eprintln!("Traceback (most recent call last):\nValueError: no such shape");
        std::process::exit(7)
    }),
    ("exit-quietly", |_| std::process::exit(0)),
    ("abort", |_| std::process::abort()),
    // without a backtrace, whose symbols a busy machine may look up for longer than the limit of the reply
    ("panic", |_| {
        std::panic::set_hook(Box::new(|info| eprintln!("{info}")));
        panic!("index out of bounds")
    }),
    ("flood-stderr", |_| {
        loop {
            eprintln!("warning: the solver did not converge");
        }
    }),
    ("flood-line", |_| flood(&[b'x'; 1 << 16], 1 << 14)),
    ("flood-lines", |id| flood(reply(id, "{\"points\":[[1,0]]}").repeat(1000).as_bytes(), usize::MAX)),
    ("garbage", |_| say("pybullet build time: Nov 28 2023\n")),
    ("bytes", |_| raw(b"\xff\xfe\x1b[2J\n")),
    ("empty-line", |_| say("\n")),
    ("wrong-id", |id| say(&format!("{{\"id\":{},\"result\":{{\"points\":[[1,0]]}}}}\n", id + 1))),
    ("no-id", |_| say("{\"result\":{\"points\":[[1,0]]}}\n")),
    ("nan", |id| result(id, "{\"points\":[[NaN,0]]}")),
    ("infinity", |id| result(id, "{\"points\":[[Infinity,0]]}")),
    ("overflow", |id| result(id, "{\"points\":[[1e999,0]]}")),
    ("null", |id| result(id, "{\"points\":[[null,0]]}")),
    ("text", |id| result(id, "{\"points\":[[\"1\",0]]}")),
    ("sizes", |id| result(id, "{\"points\":[[1,0],[1,0]]}")),
    ("row-sizes", |id| result(id, "{\"points\":[[1,0,0]]}")),
    ("half-line", |id| {
        say(&format!("{{\"id\":{id},\"result\":{{\"poi"));
        std::process::exit(0)
    }),
    ("half-line-and-hang", |id| {
        say(&format!("{{\"id\":{id},\"result\":{{\"poi"));
        sleep()
    }),
    ("two-replies", |id| say(&format!("{0}{0}", reply(id, "{\"points\":[[1,0]]}")))),
    ("result-and-error", |id| say(&format!("{{\"id\":{id},\"result\":{{\"points\":[[1,0]]}},\"error\":\"?\"}}\n"))),
    ("close-stdout", |_| become_sleeper(|command| command.stdout(Stdio::null()))),
    ("ignore-signals", |_| {
        ctrlc::set_handler(|| {}).expect("no other handler");
        sleep()
    }),
    ("grandchild-and-hang", |_| {
        grandchild(false);
        sleep()
    }),
    ("grandchild-and-exit", |_| {
        grandchild(false);
        std::process::exit(3)
    }),
    ("grandchild-in-its-own-group", |_| {
        grandchild(true);
        sleep()
    }),
    ("dribble", |_| {
        loop {
            say("x");
            std::thread::sleep(Duration::from_millis(50));
        }
    }),
    ("nesting", |id| result(id, &format!("{{\"points\":{}{}}}", "[".repeat(100_000), "]".repeat(100_000)))),
    ("nesting-without-end", |_| flood(b"[", 500_000)),
];

/// The names of the misbehaviours that the poisoned question brings out.
pub fn names() -> impl Iterator<Item = &'static str> {
    MISBEHAVIOURS.iter().map(|(name, _)| *name)
}

/// Runs the engine with this misbehaviour.
pub fn run(name: &str, file: Option<&str>) {
    match name {
        "sleep" => sleep(),
        "hang-at-start" => {
            std::fs::write(file.expect("a file for the process number"), std::process::id().to_string()).expect("writable");
            sleep()
        }
        "crash-at-start" => {
            eprintln!("ModuleNotFoundError: No module named 'simulator'");
            std::process::exit(1)
        }
        "never-read" => sleep(),
        "close-stdin" => become_sleeper(|command| command.stdin(Stdio::null())),
        "banner" => {
            say("Welcome to the simulator!\n");
            serve(name, file)
        }
        _ => serve(name, file),
    }
}

fn serve(name: &str, file: Option<&str>) {
    let misbehaviour = MISBEHAVIOURS.iter().find(|(other, _)| *other == name).map(|(_, misbehaviour)| misbehaviour);
    for line in std::io::stdin().lock().lines() {
        let request: serde_json::Value = serde_json::from_str(&line.expect("UTF-8")).expect("the gate writes JSON");
        let id = request["id"].as_u64().expect("a number");
        let poisoned = request["friction"].as_f64() == Some(POISON);
        match (request["request"].as_str().expect("a text"), misbehaviour) {
            (_, Some(misbehave)) if poisoned => misbehave(id),
            ("bye", _) if name == "ignore-bye" => sleep(),
            ("bye", _) => {
                if name == "leave-grandchild" {
                    std::fs::write(file.expect("a file for the process number"), grandchild(false).to_string()).expect("writable");
                }
                return result(id, "{}");
            }
            (_, _) if name == "unsupported" => say(&format!("{{\"id\":{id},\"unsupported\":\"I am a toaster\"}}\n")),
            (_, _) if name == "error" => say(&format!("{{\"id\":{id},\"error\":\"the licence has expired\"}}\n")),
            ("project", _) => {
                if name == "chatter" {
                    (0..200_000).for_each(|k| eprintln!("iteration {k} of the inner solver"));
                }
                result(id, &format!("{{\"points\":{}}}", request["points"]));
                match name {
                    "late-second-reply" => {
                        std::thread::sleep(Duration::from_millis(100));
                        result(id, "{}");
                    }
                    "late-words" => {
                        std::thread::sleep(Duration::from_millis(100));
                        say("done");
                    }
                    "one-shot" => return,
                    _ => {}
                }
            }
            _ => say(&format!("{{\"id\":{id},\"unsupported\":\"only projections\"}}\n")),
        }
    }
}

fn result(id: u64, text: &str) {
    say(&reply(id, text));
}

fn reply(id: u64, text: &str) -> String {
    format!("{{\"id\":{id},\"result\":{text}}}\n")
}

fn say(text: &str) {
    raw(text.as_bytes());
}

fn raw(bytes: &[u8]) {
    let mut output = std::io::stdout().lock();
    // a gate that has closed the pipe ends this process as well
    if output.write_all(bytes).and_then(|()| output.flush()).is_err() {
        std::process::exit(0);
    }
}

fn flood(bytes: &[u8], times: usize) {
    (0..times).for_each(|_| raw(bytes));
    sleep();
}

fn sleep() {
    std::thread::sleep(LONG);
}

/// A process that holds this one's pipes, perhaps in a group of its own; its number goes to standard error.
#[expect(clippy::zombie_processes, reason = "leaving it behind is the misbehaviour")]
fn grandchild(is_apart: bool) -> u32 {
    use std::os::unix::process::CommandExt;
    let mut command = Command::new(std::env::current_exe().expect("known"));
    if is_apart {
        command.process_group(0);
    }
    let child = command.args(["--misbehave", "sleep"]).spawn().expect("starts");
    eprintln!("grandchild {}", child.id());
    child.id()
}

/// Goes on as a process that sleeps, without one of its streams.
fn become_sleeper(without: fn(&mut Command) -> &mut Command) {
    use std::os::unix::process::CommandExt;
    let mut command = Command::new(std::env::current_exe().expect("known"));
    let error = without(command.args(["--misbehave", "sleep"])).exec();
    panic!("{error}");
}
