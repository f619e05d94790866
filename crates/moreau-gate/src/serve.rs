//! An engine behind the protocol `moreau-engine/1`: reads requests, asks the engine, writes replies.

use crate::process::messages::{PROTOCOL, Points};
use crate::{Engine, Options, Refusal, Reply};
use moreau_contact::problem::ContactProblem;
use moreau_dynamics::scenes::Scene;
use serde::Deserialize;
use serde_json::{Value, json};
use std::io::{BufRead, Read, Write};
use std::panic::{AssertUnwindSafe, catch_unwind};

/// A request as it arrives: `protocol` and `id` are looked at first, so that a reply can repeat the number whatever else is wrong.
#[derive(Deserialize)]
struct Incoming {
    protocol: Option<String>,
    request: String,
    #[serde(default)]
    options: Options,
    scene: Option<Value>,
    time_step: Option<f64>,
    sample_every: Option<usize>,
    problem: Option<Value>,
    friction: Option<f64>,
    points: Option<Vec<Vec<f64>>>,
}

/// Answers the lines of `input` until `bye` or its end; lines longer than `limit` bytes are refused without being kept.
///
/// # Errors
/// If reading or writing fails.
///
/// ```
/// use moreau_gate::{own, serve::serve};
///
/// let requests = b"{\"protocol\": \"moreau-engine/1\", \"id\": 1, \"request\": \"describe\"}\n";
/// let mut replies = Vec::new();
/// serve(&mut own::by_name("moreau-jean")?, &requests[..], &mut replies, 1 << 20).expect("nothing to fail");
/// assert!(String::from_utf8_lossy(&replies).contains("\"law\":\"coulomb\""));
/// # Ok::<(), moreau_exact::Error>(())
/// ```
pub fn serve(engine: &mut dyn Engine, mut input: impl BufRead, mut output: impl Write, limit: u64) -> std::io::Result<()> {
    loop {
        let mut line = Vec::new();
        if input.by_ref().take(limit + 1).read_until(b'\n', &mut line)? == 0 {
            return Ok(());
        }
        let reply = if line.len() as u64 > limit && line.last() != Some(&b'\n') {
            skip_line(&mut input)?;
            Some(json!({"id": null, "error": format!("the line has more than {limit} bytes")}))
        } else {
            answer(engine, &line)
        };
        let last = reply.is_none();
        let reply = reply.unwrap_or_else(|| json!({"id": number(&line), "result": {}}));
        writeln!(output, "{reply}")?;
        output.flush()?;
        if last {
            return Ok(());
        }
    }
}

fn skip_line(input: &mut impl BufRead) -> std::io::Result<()> {
    loop {
        let buffer = input.fill_buf()?;
        let (length, ended) = match buffer.iter().position(|byte| *byte == b'\n') {
            Some(end) => (end + 1, true),
            None => (buffer.len(), buffer.is_empty()),
        };
        input.consume(length);
        if ended {
            return Ok(());
        }
    }
}

/// The `id` of a line, null if it has none that can be read.
fn number(line: &[u8]) -> Value {
    serde_json::from_slice::<Value>(line).ok().and_then(|value| value.get("id").cloned()).unwrap_or(Value::Null)
}

/// The reply to a line, or none to `bye`.
fn answer(engine: &mut dyn Engine, line: &[u8]) -> Option<Value> {
    let id = number(line);
    let result = match serde_json::from_slice::<Incoming>(line) {
        Err(problem) => Err(Refusal::errored(format!("the line is not a request: {problem}"))),
        Ok(incoming) if incoming.protocol.as_deref() != Some(PROTOCOL) => Err(Refusal::errored(format!("this engine speaks {PROTOCOL}"))),
        Ok(incoming) if incoming.request == "bye" => return None,
        Ok(incoming) => catch_unwind(AssertUnwindSafe(|| ask(engine, incoming)))
            .unwrap_or_else(|_| Err(Refusal::errored("the engine panicked; its message is on standard error"))),
    };
    Some(match result {
        Ok(result) => json!({"id": id, "result": result}),
        Err(Refusal::Unsupported(reason)) => json!({"id": id, "unsupported": reason}),
        Err(Refusal::Errored(cause)) => json!({"id": id, "error": cause}),
    })
}

fn ask(engine: &mut dyn Engine, incoming: Incoming) -> Reply<Value> {
    let Incoming { request, options, scene, time_step, sample_every, problem, friction, points, .. } = incoming;
    match request.as_str() {
        "describe" => engine.describe(&options).and_then(value),
        "simulate" => {
            let scene = Scene::from_json(&given("scene", scene)?.to_string()).map_err(Refusal::errored)?;
            value(engine.simulate(&scene, given("time_step", time_step)?, given("sample_every", sample_every)?, &options)?)
        }
        "solve" => {
            let problem = ContactProblem::from_json(&given("problem", problem)?.to_string()).map_err(Refusal::errored)?;
            let solution = engine.solve(&problem, &options)?;
            serde_json::from_str(&solution.to_json(None, None)).map_err(Refusal::errored)
        }
        "project" => {
            let points = engine.project(given("friction", friction)?, &given("points", points)?, &options)?;
            value(Points { points })
        }
        other => Err(Refusal::unsupported(format!("request `{other}` is not implemented"))),
    }
}

fn given<T>(field: &str, value: Option<T>) -> Reply<T> {
    value.ok_or_else(|| Refusal::errored(format!("missing field `{field}`")))
}

/// A result as JSON; numbers that JSON does not have are an error of the engine.
fn value(result: impl serde::Serialize) -> Reply<Value> {
    serde_json::to_value(result).map_err(Refusal::errored)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::own;

    fn replies(input: &str, limit: u64) -> Vec<Value> {
        let mut engine = own::by_name("moreau-jean").expect("built in");
        let mut output = Vec::new();
        serve(&mut engine, input.as_bytes(), &mut output, limit).expect("memory does not fail");
        String::from_utf8(output).expect("UTF-8").lines().map(|line| serde_json::from_str(line).expect("JSON")).collect()
    }

    #[test]
    fn every_line_gets_one_reply_and_bye_ends_the_conversation() {
        let lines = r#"{"protocol":"moreau-engine/1","id":1,"request":"describe"}
garbage
{"protocol":"moreau-engine/0","id":3,"request":"describe"}
{"protocol":"moreau-engine/1","id":4,"request":"dance"}
{"protocol":"moreau-engine/1","id":5,"request":"simulate","time_step":0.1}
{"protocol":"moreau-engine/1","id":6,"request":"project","friction":0.5,"points":[[-1,0.5],[1,0.25]]}
{"protocol":"moreau-engine/1","id":7,"request":"bye"}
{"protocol":"moreau-engine/1","id":8,"request":"describe"}
"#;
        let replies = replies(lines, 1 << 20);
        assert_eq!(replies.len(), 7);
        assert_eq!(replies[0]["result"]["name"], "moreau-jean");
        assert!(replies[1]["id"].is_null() && replies[1]["error"].is_string());
        assert!(replies[2]["id"] == 3 && replies[2]["error"].as_str().is_some_and(|text| text.contains("moreau-engine/1")));
        assert!(replies[3]["id"] == 4 && replies[3]["unsupported"].as_str().is_some_and(|text| text.contains("dance")));
        assert!(replies[4]["id"] == 5 && replies[4]["error"].as_str().is_some_and(|text| text.contains("scene")));
        assert_eq!(replies[5]["result"]["points"], json!([[0.0, 0.0], [1.0, 0.25]]));
        assert_eq!(replies[6], json!({"id": 7, "result": {}}));
    }

    #[test]
    fn a_line_too_long_is_refused_and_the_next_is_answered() {
        let long = format!("{}\n{}\n", "x".repeat(1000), r#"{"protocol":"moreau-engine/1","id":2,"request":"describe"}"#);
        let replies = replies(&long, 100);
        assert!(replies[0]["error"].as_str().is_some_and(|text| text.contains("100 bytes")), "{replies:?}");
        assert_eq!(replies[1]["result"]["name"], "moreau-jean");
    }
}
