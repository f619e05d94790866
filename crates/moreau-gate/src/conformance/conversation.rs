//! Probes of the conversation itself: lines, numbers, refusals, the end.

use crate::conformance::{ProbeOutcome, Probes, Seen, demand, problem, skipped};
use crate::process::messages::{Answer, PROTOCOL};
use crate::process::{Fate, Fault, Limits, Session, messages};
use crate::{Description, Refusal};
use serde_json::{Value, json};
use std::time::Duration;

/// A kind of request that no engine knows.
const UNKNOWN: &str = "moreau-does-not-exist";

/// How long the adapter is listened to after a reply.
const SILENCE: Duration = Duration::from_millis(200);

/// The cure of most faults.
const ONE_LINE: &str = "write exactly one line per request on standard output, flush it, and everything else on standard error";

/// What an adapter's author may do about a request without a reply.
fn unanswered(fault: Fault) -> ProbeOutcome {
    let cure = match fault.cause {
        Fate::NotStarted(_) => "give the program and its arguments as they are typed in a shell",
        Fate::TimedOut(..) => {
            "answer every request, an unknown one with `unsupported`, and flush the line; or allow more time by --time-limit, \
             to start by --start-limit"
        }
        Fate::Ended(..) => "catch what the engine throws and answer it as `error`; a program that crashes tells why on standard error",
        _ => ONE_LINE,
    };
    problem(fault, cure)
}

/// A conversation line by line; after a fault the program is started again.
pub(super) struct Talk<'a> {
    command: &'a [String],
    limits: Limits,
    session: Option<Session>,
    id: u64,
    /// How many requests in a row had no reply within the time limit.
    silences: usize,
}

/// Why a probe is not run then.
const SILENT: &str = "the adapter does not reply within the time limit, so that nothing more is asked";

/// Requests in a row without a reply, after which no other one is made.
const SILENCES: usize = 2;

/// The text of a result, or the refusal the adapter answered.
type Told = Result<String, Refusal>;

impl<'a> Talk<'a> {
    /// A conversation that has not begun.
    pub(super) fn new(command: &'a [String], limits: Limits) -> Self {
        // numbers beyond 32 bits show an adapter that keeps them in too small a type
        Talk { command, limits, session: None, id: 5_000_000_000, silences: 0 }
    }

    fn session(&mut self) -> Result<Session, Fault> {
        self.session.take().map_or_else(|| Session::start(self.command, self.limits), Ok)
    }

    /// Says a line; gives back the line that answers.
    fn say(&mut self, line: &str) -> Result<Vec<u8>, Fault> {
        let mut session = self.session()?;
        let reply = session.exchange(line);
        let is_silent = matches!(&reply, Err(Fault { cause: Fate::TimedOut(..), .. }));
        self.silences = if is_silent { self.silences + 1 } else { 0 };
        let reply = reply?;
        self.session = Some(session);
        Ok(reply)
    }

    /// Whether more waiting is in vain: twice in a row, or when it was asked to describe itself, it kept silent.
    pub(super) fn is_over(&self) -> bool {
        self.silences >= SILENCES
    }

    /// Asks with a protocol and a new number.
    fn ask_in(&mut self, protocol: &str, mut request: Value) -> Result<Result<Told, String>, Fault> {
        self.id += 1;
        request["protocol"] = protocol.into();
        request["id"] = self.id.into();
        let line = self.say(&request.to_string())?;
        let told = told(&line, Some(self.id));
        if told.is_err() {
            // what comes after a line that is no reply answers an earlier question
            self.session = None;
        }
        Ok(told)
    }

    fn ask(&mut self, request: Value) -> Result<Told, ProbeOutcome> {
        self.ask_in(PROTOCOL, request).map_err(unanswered)?.map_err(malformed)
    }

    /// What a probe sees, unless waiting is in vain.
    fn unless_over(&mut self, look: &dyn Fn(&mut Talk) -> Seen) -> Seen {
        if self.is_over() { Err(skipped(SILENT)) } else { look(self) }
    }

    /// The first question; without a reply to it nothing else is asked.
    pub(super) fn describe(&mut self) -> Result<Result<Told, String>, Fault> {
        let described = self.ask_in(PROTOCOL, json!({"request": "describe"}));
        self.silences *= SILENCES;
        described
    }
}

fn told(line: &[u8], id: Option<u64>) -> Result<Told, String> {
    Ok(match messages::open(line, id)? {
        Answer::Result(text) => Ok(text.to_string()),
        Answer::Unsupported(reason) => Err(Refusal::Unsupported(reason)),
        Answer::Error(message) => Err(Refusal::Errored(message)),
    })
}

fn malformed(why: String) -> ProbeOutcome {
    problem(why, "reply {\"id\": …, \"result\": {…}}, or with \"unsupported\" or \"error\" and a text; repeat the `id` of the request")
}

/// The description in the first reply.
pub(super) fn described(first: Result<Result<Told, String>, Fault>) -> Result<Description, ProbeOutcome> {
    let told = first.map_err(unanswered)?.map_err(malformed)?;
    let text = told.map_err(|refusal| problem(refusal, "`describe` must be answered with a result"))?;
    messages::description(&text).map_err(|error| problem(error, "give the fields of `describe` in docs/protocol.md, and no others"))
}

/// Everything but the farewell.
pub(super) fn probe_all(talk: &mut Talk, description: Option<&Description>, probes: &mut Probes) {
    let mut ask = |name, demand, look: &dyn Fn(&mut Talk) -> Seen| probes.ask(name, demand, || talk.unless_over(look));
    ask("line/same-twice", "the same request gets the same answer twice", &same_twice);
    ask("line/unknown-request", "an unknown request is answered `unsupported`", &unknown_request);
    ask("line/garbage", "a line that is not JSON is answered `error`, and the next line is answered as usual", &garbage);
    ask("line/version", "another version of the protocol is refused", &other_version);
    ask("describe/unknown-option", "an unknown option is an `error`", &unknown_option);
    let stated = "a request may state the options and parameters that the description gives, with their values";
    ask("describe/known-options", stated, &|talk| known_options(talk, description));
    ask("line/nothing-else", "nothing but replies is written on standard output", &silent);
}

fn same_twice(talk: &mut Talk) -> Seen {
    let first = talk.ask(json!({"request": "describe"}))?;
    let second = talk.ask(json!({"request": "describe"}))?;
    demand(first == second, || "two descriptions differ".into(), "leave out what changes from request to request")
}

fn unknown_request(talk: &mut Talk) -> Seen {
    match talk.ask(json!({"request": UNKNOWN}))? {
        Err(Refusal::Unsupported(_)) => Ok(()),
        other => Err(problem(shown(&other), "answer {\"id\": …, \"unsupported\": \"reason\"} to a request the adapter does not know")),
    }
}

fn garbage(talk: &mut Talk) -> Seen {
    const CURE: &str = "catch the error of the JSON reader, answer {\"id\": null, \"error\": \"message\"} and read on";
    let line = talk.say("this is {not} JSON").map_err(|fault| problem(fault, CURE))?;
    match told(&line, None) {
        Ok(Err(Refusal::Errored(_))) => {}
        Ok(other) => return Err(problem(shown(&other), CURE)),
        Err(why) => return Err(problem(why, CURE)),
    }
    let next = talk.ask(json!({"request": "describe"}))?;
    demand(next.is_ok(), || format!("the request after it: {}", shown(&next)), CURE)
}

fn other_version(talk: &mut Talk) -> Seen {
    const CURE: &str = "compare `protocol` with \"moreau-engine/1\" and answer `error` if it differs";
    let outcome = talk.ask_in("moreau-engine/999", json!({"request": "describe"})).map_err(|fault| problem(fault, CURE))?;
    let told = outcome.map_err(malformed)?;
    demand(told.is_err(), || "a request in `moreau-engine/999` was carried out".into(), CURE)
}

fn unknown_option(talk: &mut Talk) -> Seen {
    match talk.ask(json!({"request": "describe", "options": {UNKNOWN: 1}}))? {
        Err(Refusal::Errored(_)) => Ok(()),
        other => {
            let cure =
                "compare the names in `options` with those of the description: an option that is silently ignored would falsify results";
            Err(problem(shown(&other), cure))
        }
    }
}

fn known_options(talk: &mut Talk, description: Option<&Description>) -> Seen {
    let description = description.ok_or_else(|| skipped("there is no description"))?;
    let mut options = description.options.clone();
    for (name, parameter) in &description.contact_model.parameters {
        options.insert(name.clone(), serde_json::to_value(&parameter.value).unwrap_or_default());
    }
    let text = talk.ask(json!({"request": "describe", "options": options}))?.map_err(|refusal| {
        problem(refusal, "accept in `options` every name that the description has in `options` and `contact_model.parameters`")
    })?;
    let again =
        messages::description(&text).map_err(|error| problem(error, "answer `describe` with these options as you do without options"))?;
    demand(
        again == *description,
        || "the description changes when a request states its own values".into(),
        "describe the values that the engine uses",
    )
}

fn silent(talk: &mut Talk) -> Seen {
    let _ = talk.ask(json!({"request": "describe"}))?;
    let mut session = talk.session().map_err(unanswered)?;
    session.listen(SILENCE).map_err(unanswered)?;
    talk.session = Some(session);
    Ok(())
}

/// The two ways to end.
pub(super) fn probe_farewell(talk: &mut Talk, probes: &mut Probes) {
    probes.ask("end/bye", "`bye` is answered, and the adapter ends", || talk.unless_over(&bye));
    probes.ask("end/input", "the adapter ends when its standard input does", || talk.unless_over(&end_of_input));
}

fn bye(talk: &mut Talk) -> Seen {
    const CURE: &str = "answer {\"id\": …, \"result\": {}} to `bye`, then leave the loop and the program";
    let told = talk.ask(json!({"request": "bye"}))?;
    demand(told.is_ok(), || shown(&told), CURE)?;
    let session = talk.session.take().ok_or_else(|| skipped("the program does not run"))?;
    demand(session.ends().is_some(), || "`bye` was answered, but the program does not end".into(), CURE)
}

fn end_of_input(talk: &mut Talk) -> Seen {
    const CURE: &str = "leave the loop when reading a line fails or gives nothing";
    let _ = talk.ask(json!({"request": "describe"}))?;
    let session = talk.session().map_err(|fault| problem(fault, CURE))?;
    demand(session.close().is_some(), || "the program does not end".into(), CURE)
}

fn shown(told: &Told) -> String {
    match told {
        Ok(text) => format!("the request was carried out: {}", text.chars().take(80).collect::<String>()),
        Err(refusal) => format!("the answer was {refusal}"),
    }
}
