//! One test per misbehaviour: the cause, the restart, the next answer, and no process left.

use crate::engines::{self, POISON};
use crate::processes::{File, assert_gone, peak_memory, runs};
use libtest_mimic::Trial;
use moreau::gate::process::{Limits, ProcessEngine};
use moreau::gate::{Engine, Options, Refusal};
use std::time::{Duration, Instant};

/// Short limits: a request has 2 s, a line 1 MiB.
const LIMITS: Limits =
    Limits { reply: Duration::from_secs(2), start: Duration::from_secs(2), line: 1 << 20, farewell: Duration::from_millis(500) };

/// More than any request may take: reply, farewell and last words, on a machine that has other work as well.
const PATIENCE: Duration = Duration::from_secs(30);

/// What a misbehaviour must be called; every one of the bundle is listed.
const CAUSES: [(&str, &[&str]); 32] = [
    ("hang", &["no reply within 2s"]),
    ("exit", &["ended without a reply", "exit status: 7", "ValueError: no such shape"]),
    ("exit-quietly", &["ended without a reply", "exit status: 0"]),
    ("abort", &["ended without a reply", "signal: 6"]),
    ("panic", &["ended without a reply", "exit status: 101", "standard error: "]),
    ("flood-stderr", &["no reply within 2s", "warning: the solver did not converge"]),
    ("flood-line", &["a line of more than 1048576 bytes", "`xxxxx"]),
    ("flood-lines", &["more than one line in reply"]),
    ("garbage", &["not a reply", "pybullet build time"]),
    ("bytes", &["not UTF-8"]),
    ("empty-line", &["not a reply"]),
    ("wrong-id", &["`id` is"]),
    ("no-id", &["no `id`"]),
    ("nan", &["`points[0][0]` is NaN"]),
    ("infinity", &["`points[0][0]` is Infinity"]),
    ("overflow", &["`points", "number out of range"]),
    ("null", &["`points", "null"]),
    ("text", &["`points", "the text \"1\""]),
    ("sizes", &["`points`", "has 2 rows"]),
    ("row-sizes", &["`points`", "of the same size"]),
    ("half-line", &["ended without a reply", "in the middle of the line", "\"poi`"]),
    ("half-line-and-hang", &["no reply within 2s", "in the middle of the line", "\"poi`"]),
    ("two-replies", &["more than one line in reply"]),
    ("result-and-error", &["exactly one"]),
    ("close-stdout", &["closed its standard output but still runs"]),
    ("ignore-signals", &["no reply within 2s"]),
    ("grandchild-and-hang", &["no reply within 2s", "grandchild"]),
    ("grandchild-and-exit", &["ended without a reply", "exit status: 3", "grandchild"]),
    ("grandchild-in-its-own-group", &["no reply within 2s", "grandchild"]),
    ("dribble", &["no reply within 2s", "in the middle of the line", "xx"]),
    ("nesting", &["`points"]),
    ("nesting-without-end", &["no reply within 2s", "[[["]),
];

/// Every test.
pub fn all() -> Vec<Trial> {
    let mut trials: Vec<_> = CAUSES
        .iter()
        .map(|(name, words)| {
            Trial::test(format!("{name}_is_reported_and_the_next_question_is_answered"), move || {
                reported_and_restarted(name, words);
                Ok(())
            })
        })
        .collect();
    let others: [(&str, fn()); 13] = [
        ("every_misbehaviour_of_the_bundle_is_tested", every_misbehaviour_is_tested),
        ("a_program_that_is_not_there_is_reported", a_program_that_is_not_there_is_reported),
        ("a_crash_at_start_is_reported_every_time", a_crash_at_start_is_reported_every_time),
        ("a_banner_on_standard_output_is_reported", a_banner_is_reported),
        ("an_engine_that_never_reads_does_not_stop_the_gate_that_writes", an_engine_that_never_reads),
        ("an_engine_that_closes_its_input_is_reported", an_engine_that_closes_its_input),
        ("a_second_reply_that_comes_late_is_reported", a_second_reply_that_comes_late),
        ("an_engine_that_ends_between_questions_is_reported", an_engine_that_ends_between_questions),
        ("chatter_on_standard_error_does_no_harm", chatter_does_no_harm),
        ("unsupported_and_error_are_replies_and_no_faults", unsupported_and_error_are_replies),
        ("nothing_is_left_behind_after_bye", nothing_is_left_behind_after_bye),
        ("a_line_of_a_gigabyte_takes_no_memory", a_line_of_a_gigabyte_takes_no_memory),
        ("several_engines_at_once_do_not_disturb_each_other", several_engines_at_once),
    ];
    trials.extend(others.into_iter().map(|(name, test)| {
        Trial::test(name, move || {
            test();
            Ok(())
        })
    }));
    trials
}

fn engine(name: &str) -> ProcessEngine {
    ProcessEngine::new(this_program(&["--misbehave", name]), LIMITS)
}

/// The command that starts this program again.
pub fn this_program(arguments: &[&str]) -> Vec<String> {
    let this = std::env::current_exe().expect("known").to_string_lossy().into_owned();
    std::iter::once(this).chain(arguments.iter().map(|argument| argument.to_string())).collect()
}

fn project(engine: &mut ProcessEngine, friction: f64) -> Result<Vec<Vec<f64>>, Refusal> {
    engine.project(friction, &[vec![1.0, 0.0]], &Options::new())
}

#[track_caller]
fn assert_answers(engine: &mut ProcessEngine) {
    assert_eq!(project(engine, 0.5), Ok(vec![vec![1.0, 0.0]]));
}

#[track_caller]
fn cause(reply: Result<Vec<Vec<f64>>, Refusal>) -> String {
    match reply {
        Err(Refusal::Errored(cause)) => cause,
        other => panic!("{other:?} is not errored"),
    }
}

fn reported_and_restarted(name: &str, words: &[&str]) {
    let start = Instant::now();
    let mut engine = engine(name);
    assert_answers(&mut engine);
    let first = engine.process().expect("it runs");
    let cause = cause(project(&mut engine, POISON));
    for word in words {
        assert!(cause.contains(word), "`{cause}` does not contain `{word}`");
    }
    assert!(!cause.contains('\u{1b}') && cause.chars().count() < 3000, "fit for a report: {cause}");
    assert_gone(first);
    if let Some((_, number)) = cause.split_once("grandchild ") {
        assert_gone(number.trim().parse().expect("a process number"));
    }
    assert_answers(&mut engine);
    let second = engine.process().expect("it runs again");
    assert!(second != first && runs(second));
    drop(engine);
    assert_gone(second);
    assert!(start.elapsed() < PATIENCE, "{:?}", start.elapsed());
}

fn every_misbehaviour_is_tested() {
    assert!(engines::names().eq(CAUSES.iter().map(|(name, _)| *name)));
}

fn a_program_that_is_not_there_is_reported() {
    for command in [vec!["/nowhere/engine".to_string()], vec!["/".into()], Vec::new()] {
        let mut engine = ProcessEngine::new(command, LIMITS);
        assert!(cause(project(&mut engine, 0.5)).contains("cannot be started"));
        assert_eq!(engine.process(), None);
    }
}

fn a_crash_at_start_is_reported_every_time() {
    let mut engine = engine("crash-at-start");
    for _ in 0..2 {
        let cause = cause(project(&mut engine, 0.5));
        assert!(cause.contains("exit status: 1") && cause.contains("No module named 'simulator'"), "{cause}");
    }
}

fn a_banner_is_reported() {
    let cause = cause(project(&mut engine("banner"), 0.5));
    assert!(cause.contains("Welcome to the simulator!"), "{cause}");
}

fn large_question() -> Vec<Vec<f64>> {
    vec![vec![1.0, 0.0]; 100_000]
}

fn an_engine_that_never_reads() {
    let cause = cause(engine("never-read").project(0.5, &large_question(), &Options::new()));
    assert!(cause.contains("no reply within 2s"), "{cause}");
}

fn an_engine_that_closes_its_input() {
    let cause = cause(engine("close-stdin").project(0.5, &large_question(), &Options::new()));
    assert!(cause.contains("closed its standard input but still runs"), "{cause}");
}

fn a_second_reply_that_comes_late() {
    for name in ["late-second-reply", "late-words"] {
        let mut engine = engine(name);
        assert_answers(&mut engine);
        let first = engine.process().expect("it runs");
        std::thread::sleep(Duration::from_millis(500));
        let cause = cause(project(&mut engine, 0.5));
        assert!(cause.contains("before it was asked"), "{cause}");
        assert_gone(first);
        assert_answers(&mut engine);
    }
}

fn an_engine_that_ends_between_questions() {
    let mut engine = engine("one-shot");
    assert_answers(&mut engine);
    let cause = cause(project(&mut engine, 0.5));
    assert!(cause.contains("exit status: 0"), "{cause}");
    assert_answers(&mut engine);
}

fn chatter_does_no_harm() {
    let mut engine = engine("chatter");
    assert_answers(&mut engine);
    let first = engine.process();
    assert_answers(&mut engine);
    assert_eq!(engine.process(), first);
}

fn unsupported_and_error_are_replies() {
    let mut toaster = engine("unsupported");
    assert_eq!(project(&mut toaster, 0.5), Err(Refusal::unsupported("I am a toaster")));
    let first = toaster.process();
    assert_eq!(project(&mut toaster, 0.5), Err(Refusal::unsupported("I am a toaster")));
    assert_eq!(toaster.process(), first);
    let mut expired = engine("error");
    assert_eq!(project(&mut expired, 0.5), Err(Refusal::errored("the licence has expired")));
    assert!(expired.process().is_some_and(runs));
}

fn nothing_is_left_behind_after_bye() {
    let file = File::new("grandchild");
    for name in ["well-behaved", "ignore-bye", "leave-grandchild"] {
        let mut engine = ProcessEngine::new(this_program(&["--misbehave", name, file.path()]), LIMITS);
        assert_answers(&mut engine);
        let process = engine.process().expect("it runs");
        drop(engine);
        assert_gone(process);
    }
    assert_gone(file.number().expect("the grandchild's process number"));
}

fn a_line_of_a_gigabyte_takes_no_memory() {
    let mut engine = engine("flood-line");
    assert_answers(&mut engine);
    let before = peak_memory();
    let cause = cause(project(&mut engine, POISON));
    assert!(cause.contains("a line of more than 1048576 bytes"), "{cause}");
    if let (Some(before), Some(after)) = (before, peak_memory()) {
        // the other tests of this program run at the same time: their largest lines and questions take a few MiB
        assert!(after - before < 64 << 10, "{} KiB more", after - before);
    }
}

fn several_engines_at_once() {
    std::thread::scope(|scope| {
        for name in ["hang", "exit", "well-behaved", "garbage"] {
            scope.spawn(move || {
                let mut engine = engine(name);
                for friction in [0.5, POISON, 0.5, 0.5] {
                    let reply = project(&mut engine, friction);
                    assert_eq!(reply.is_ok(), friction != POISON || name == "well-behaved", "{name}: {reply:?}");
                }
            });
        }
    });
}
