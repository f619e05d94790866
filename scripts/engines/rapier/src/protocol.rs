//! One request line in, one reply out: `result`, `unsupported` with the reason, or `error` with the message.

use crate::{options, simulate};
use serde_json::{Map, Value, json};
use std::panic::{AssertUnwindSafe, catch_unwind};

/// The name and version of the protocol.
const PROTOCOL: &str = "moreau-engine/1";

/// The longest message \[bytes\].
pub const MAX_LINE_BYTES: usize = 256 * 1024 * 1024;

/// Why a request has no result.
#[derive(Debug, PartialEq)]
pub enum Refusal {
    /// This engine cannot express it.
    Unsupported(String),
    /// It could, but something is wrong.
    Error(String),
}

impl Refusal {
    /// An error with this message.
    pub fn error(message: impl Into<String>) -> Self {
        Refusal::Error(message.into())
    }

    /// A refusal with this reason.
    pub fn unsupported(reason: impl Into<String>) -> Self {
        Refusal::Unsupported(reason.into())
    }
}

/// What a request comes to.
pub type Outcome<T> = Result<T, Refusal>;

/// The reply to a line, and whether the conversation goes on after it.
pub fn answer(line: &[u8]) -> (String, bool) {
    let request = match decode(line) {
        Ok(request) => request,
        Err(message) => return (reply(&Value::Null, Err(Refusal::Error(message))), true),
    };
    let id = request.get("id").cloned().unwrap_or(Value::Null);
    let kind = request.get("request").cloned().unwrap_or(Value::Null);
    if request.get("protocol") != Some(&json!(PROTOCOL)) {
        return (reply(&id, Err(Refusal::error(format!("this adapter speaks {PROTOCOL}")))), true);
    }
    if kind == "bye" {
        return (reply(&id, Ok(json!({}))), false);
    }
    // A panic inside the engine has printed itself on standard error; the next request gets a fresh world.
    let outcome = catch_unwind(AssertUnwindSafe(|| carry_out(&kind, &request)));
    (reply(&id, outcome.unwrap_or_else(|panic| Err(Refusal::Error(panic_message(panic.as_ref()))))), true)
}

fn carry_out(kind: &Value, request: &Map<String, Value>) -> Outcome<Value> {
    match kind.as_str() {
        Some("describe") => options::describe(request),
        Some("simulate") => simulate::simulate(request),
        _ => Err(Refusal::unsupported(format!("request {kind} is not implemented"))),
    }
}

fn decode(line: &[u8]) -> Result<Map<String, Value>, String> {
    if line.len() > MAX_LINE_BYTES {
        return Err(format!("a message has at most {MAX_LINE_BYTES} bytes"));
    }
    serde_json::from_slice(line).map_err(|problem| format!("not a message: {problem}"))
}

fn reply(id: &Value, outcome: Outcome<Value>) -> String {
    let text = match outcome {
        Ok(result) => json!({"id": id, "result": result}),
        Err(Refusal::Unsupported(reason)) => json!({"id": id, "unsupported": reason}),
        Err(Refusal::Error(message)) => json!({"id": id, "error": message}),
    }
    .to_string();
    if text.len() < MAX_LINE_BYTES {
        return text;
    }
    json!({"id": id, "error": format!("the reply would have more than {MAX_LINE_BYTES} bytes; sample less often")}).to_string()
}

fn panic_message(panic: &(dyn std::any::Any + Send)) -> String {
    let text = panic.downcast_ref::<String>().map(String::as_str).or_else(|| panic.downcast_ref::<&str>().copied());
    format!("the engine panicked: {}", text.unwrap_or("no message"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn answered(line: &str) -> (Value, bool) {
        let (text, go_on) = answer(line.as_bytes());
        (serde_json::from_str(&text).expect("a reply is JSON"), go_on)
    }

    #[test]
    fn a_reply_repeats_the_id_and_has_exactly_one_outcome() {
        for (line, outcome) in [
            (r#"{"protocol":"moreau-engine/1","id":7,"request":"describe"}"#, "result"),
            (r#"{"protocol":"moreau-engine/1","id":7,"request":"solve"}"#, "unsupported"),
            (r#"{"protocol":"moreau-engine/1","id":7,"request":"simulate"}"#, "error"),
            (r#"{"protocol":"other/1","id":7,"request":"describe"}"#, "error"),
        ] {
            let (reply, go_on) = answered(line);
            let fields: Vec<_> = reply.as_object().expect("an object").keys().cloned().collect();
            let mut expected = vec!["id".to_string(), outcome.to_string()];
            expected.sort();
            assert_eq!((fields, &reply["id"], go_on), (expected, &json!(7), true), "{line}");
        }
    }

    #[test]
    fn lines_that_are_no_messages_are_errors_and_the_conversation_goes_on() {
        for line in ["{", "[]", "7", r#"{"id": NaN}"#, r#"{"id": 1e999}"#, "\u{0}"] {
            let (reply, go_on) = answered(line);
            assert!(reply["error"].is_string() && go_on, "{line}: {reply}");
        }
        assert!(answer(b"\xff\xfe").0.contains("error"));
    }

    #[test]
    fn bye_is_answered_and_ends_the_conversation() {
        assert_eq!(answered(r#"{"protocol":"moreau-engine/1","id":1,"request":"bye"}"#), (json!({"id": 1, "result": {}}), false));
    }

    #[test]
    fn a_missing_request_is_unsupported_and_a_panic_keeps_its_message() {
        assert!(answered(r#"{"protocol":"moreau-engine/1","id":1}"#).0["unsupported"].is_string());
        assert!(panic_message(&"index out of bounds").ends_with("index out of bounds"));
    }
}
