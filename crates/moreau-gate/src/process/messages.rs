//! The messages of `moreau-engine/1`: what is asked, and what a reply may be.
//!
//! ```text
//! request   {"protocol": "moreau-engine/1", "id": 7, "request": "simulate", …}
//! reply     {"id": 7, "result": …} | {"id": 7, "unsupported": "reason"} | {"id": 7, "error": "message"}
//! ```

use crate::process::{not_finite, words};
use crate::{Description, Options};
use moreau_contact::files::{read_object, read_schema};
use moreau_contact::problem::{ContactProblem, Solution};
use moreau_dynamics::scenes::Scene;
use moreau_dynamics::trajectory;
use moreau_dynamics::trajectory::Trajectory;
use moreau_exact::number::counted;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::value::RawValue;

/// The name and version of the protocol.
pub const PROTOCOL: &str = "moreau-engine/1";

/// One line to an engine.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Request {
    /// Always `moreau-engine/1`.
    #[schemars(extend("const" = PROTOCOL))]
    pub protocol: String,
    /// The number that the reply repeats.
    pub id: u64,
    /// What is asked.
    #[serde(flatten)]
    pub question: Question,
}

/// What an engine can be asked.
#[derive(Clone, Debug, Serialize, JsonSchema)]
#[serde(tag = "request", rename_all = "kebab-case")]
pub enum Question {
    /// Asks for the name and the contact model of the engine, under these options.
    Describe {
        /// Options that differ from the engine's own values.
        #[serde(skip_serializing_if = "Options::is_empty")]
        options: Options,
    },
    /// Asks for the motion of a scene.
    Simulate {
        /// What is simulated.
        scene: Box<Scene>,
        /// h \[s\].
        time_step: f64,
        /// Steps from sample to sample.
        sample_every: usize,
        /// Options that differ from the engine's own values.
        #[serde(skip_serializing_if = "Options::is_empty")]
        options: Options,
    },
    /// Asks for the impulses that solve a contact problem.
    Solve {
        /// A `contact-problem/1`.
        #[schemars(with = "moreau_contact::problem::ProblemFile")]
        problem: Box<RawValue>,
        /// Options that differ from the engine's own values.
        #[serde(skip_serializing_if = "Options::is_empty")]
        options: Options,
    },
    /// Asks for the projections of these points on the friction cone.
    Project {
        /// μ.
        friction: f64,
        /// Rows (n, t₁) or (n, t₁, t₂).
        points: Vec<Vec<f64>>,
        /// Options that differ from the engine's own values.
        #[serde(skip_serializing_if = "Options::is_empty")]
        options: Options,
    },
    /// Asks the engine to answer and to end.
    Bye {},
}

impl Question {
    /// A contact problem as a question.
    pub fn solve(problem: &ContactProblem, options: &Options) -> Self {
        let text = problem.to_json();
        let problem = RawValue::from_string(text.trim().to_string()).expect("the text of a contact problem is JSON");
        Question::Solve { problem, options: options.clone() }
    }
}

impl Request {
    /// A question with its number.
    pub fn new(id: u64, question: Question) -> Self {
        Request { protocol: PROTOCOL.into(), id, question }
    }

    /// The line, without its end.
    pub fn line(&self) -> String {
        serde_json::to_string(self).expect("numbers, strings, lists and maps with text keys always have a JSON form")
    }
}

/// A reply whose outer form is valid: the text of its result, or the reason why it has none.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Answer<'a> {
    /// The request was carried out; this is the JSON text of `result`.
    Result(&'a str),
    /// The engine cannot express the question.
    Unsupported(String),
    /// Something went wrong.
    Error(String),
}

/// One line from an engine: the number of its request, and exactly one of `result`, `unsupported` and `error`.
#[derive(JsonSchema)]
#[schemars(rename = "Reply", deny_unknown_fields, extend("required" = ["id"]))]
#[schemars(extend("oneOf" = [{"required": ["result"]}, {"required": ["unsupported"]}, {"required": ["error"]}]))]
#[allow(dead_code)]
pub struct ReplyForm {
    /// The number of the request; null only if it could not be read.
    id: Option<u64>,
    /// The request was carried out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Options")]
    result: Option<Options>,
    /// The engine cannot express the question, for this reason.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "String")]
    unsupported: Option<String>,
    /// Something went wrong.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "String")]
    error: Option<String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Envelope<'a> {
    #[serde(borrow, default)]
    id: Option<&'a RawValue>,
    #[serde(borrow, default)]
    result: Option<&'a RawValue>,
    #[serde(default)]
    unsupported: Option<String>,
    #[serde(default)]
    error: Option<String>,
}

/// Opens the reply to request `id`; with `None` any `id` will do, as where the request could not be read.
///
/// # Errors
/// In words, what is wrong with the line.
pub fn open(line: &[u8], id: Option<u64>) -> Result<Answer<'_>, String> {
    let shown = || format!("; the line begins `{}`", words::beginning(line));
    let text = std::str::from_utf8(line).map_err(|_| format!("the reply is not UTF-8{}", shown()))?;
    // a list would be read as the fields in their order
    if !text.trim_start().starts_with('{') {
        return Err(format!("the line is not a reply: it is not a JSON object{}", shown()));
    }
    let envelope: Envelope = serde_json::from_str(text).map_err(|error| match not_finite::first(text) {
        Some(place) => format!("{place}: the line is not JSON, which knows finite numbers only"),
        None => format!("the line is not a reply: {error}{}", shown()),
    })?;
    if let Some(id) = id {
        match envelope.id.map(RawValue::get) {
            Some(text) if text == id.to_string() => {}
            Some(other) => return Err(format!("the reply's `id` is {} instead of {id}", words::beginning(other.as_bytes()))),
            None => return Err(format!("the reply has no `id`{}", shown())),
        }
    }
    match (envelope.result, envelope.unsupported, envelope.error) {
        (Some(result), None, None) if result.get().starts_with('{') => Ok(Answer::Result(result.get())),
        (Some(_), None, None) => Err(format!("`result` is not a JSON object{}", shown())),
        (None, Some(reason), None) => Ok(Answer::Unsupported(words::message(&reason))),
        (None, None, Some(message)) => Ok(Answer::Error(words::message(&message))),
        _ => Err(format!("the reply must have exactly one of `result`, `unsupported` and `error`{}", shown())),
    }
}

/// The result of `project`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Points {
    /// One row per point of the request.
    pub points: Vec<Vec<f64>>,
}

/// Reads the result of `describe`.
///
/// # Errors
/// Names the field.
pub fn description(text: &str) -> moreau_exact::Result<Description> {
    let description: Description = read_object(text, "description")?;
    description.validate()?;
    Ok(description)
}

/// Reads and validates the result of `simulate`.
///
/// # Errors
/// Names the field.
pub fn trajectory(text: &str) -> moreau_exact::Result<Trajectory> {
    let trajectory: Trajectory = read_schema(text, trajectory::SCHEMA)?;
    trajectory.validate()?;
    Ok(trajectory)
}

/// Reads the result of `solve` for a problem with so many contact rows.
///
/// # Errors
/// Names the field.
pub fn solution(text: &str, rows: usize) -> moreau_exact::Result<Solution> {
    let solution = Solution::from_json(text)?;
    for (field, vector) in [("impulse", &solution.impulse), ("velocity", &solution.velocity)] {
        if vector.len() != rows {
            return Err(moreau_exact::Error::invalid(
                field,
                format!("has {}", counted(vector.len(), "entry")),
                format!("the problem has {}", counted(rows, "row")),
            ));
        }
    }
    Ok(solution)
}

/// Reads the result of `project` for these points.
///
/// # Errors
/// Names the field.
pub fn points(text: &str, asked: &[Vec<f64>]) -> moreau_exact::Result<Vec<Vec<f64>>> {
    let Points { points } = read_object(text, "points")?;
    let sizes = |rows: &[Vec<f64>]| rows.iter().map(Vec::len).collect::<Vec<_>>();
    if sizes(&points) != sizes(asked) {
        return Err(moreau_exact::Error::invalid(
            "points",
            format!("has {}", counted(points.len(), "row")),
            "answer every point with a point of the same size",
        ));
    }
    Ok(points)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_request_is_one_line_with_the_fields_of_the_protocol() {
        let line = Request::new(7, Question::Describe { options: Options::new() }).line();
        assert_eq!(line, r#"{"protocol":"moreau-engine/1","id":7,"request":"describe"}"#);
        let scene = moreau_dynamics::scenes::named(moreau_dynamics::scenes::NAMES[0]).expect("a listed scene");
        let options: Options = [("iterations".to_string(), 50.into())].into_iter().collect();
        let line = Request::new(8, Question::Simulate { scene: scene.into(), time_step: 0.1, sample_every: 2, options }).line();
        assert!(line.contains(r#""request":"simulate","scene":{"#) && line.contains(r#""time_step":0.1,"sample_every":2,"options":{"#));
        assert!(!line.contains('\n'));
        assert_eq!(Request::new(9, Question::Bye {}).line(), r#"{"protocol":"moreau-engine/1","id":9,"request":"bye"}"#);
    }

    #[test]
    fn a_problem_travels_on_one_line() {
        let text = r#"{"schema":"contact-problem/1","name":"a","dimension":1,"law":"frictionless","friction":[0],
            "free_velocity":[-1],"delassus":{"shape":[1,1],"rows":[[1]]}}"#;
        let problem = ContactProblem::from_json(text).expect("valid");
        let line = Request::new(1, Question::solve(&problem, &Options::new())).line();
        assert!(line.contains(r#""problem":{"schema":"contact-problem/1""#) && !line.contains('\n'), "{line}");
    }

    #[test]
    fn the_three_replies_are_told_apart() {
        assert_eq!(open(br#"{"id":7,"result":{"x":1}}"#, Some(7)), Ok(Answer::Result(r#"{"x":1}"#)));
        assert_eq!(open(br#"{"id": 7, "unsupported": "no boxes"}"#, Some(7)), Ok(Answer::Unsupported("no boxes".into())));
        assert_eq!(open(b"{\"error\":\"what?\", \"id\":null}\r", None), Ok(Answer::Error("what?".into())));
    }

    #[test]
    fn what_is_not_a_reply_is_named_in_words() {
        let cases: [(&[u8], &str); 12] = [
            (b"Hello from the simulator", "is not a reply"),
            (b"", "is not a reply"),
            (b"[1]", "is not a reply"),
            (b"\xff\xfe", "not UTF-8"),
            (br#"{"id":8,"result":{}}"#, "`id` is 8 instead of 7"),
            (br#"{"id":"7","result":{}}"#, "`id` is \"7\" instead of 7"),
            (br#"{"result":{}}"#, "no `id`"),
            (br#"{"id":7}"#, "exactly one"),
            (br#"{"id":7,"result":{},"error":"x"}"#, "exactly one"),
            (br#"{"id":7,"results":{}}"#, "unknown field `results`"),
            (br#"{"id":7,"result":[[1,0]]}"#, "`result` is not a JSON object"),
            (br#"{"id":7,"result":{"bodies":[{"name":"a","position":[[0,NaN]]}]}}"#, "`bodies[0].position[0][1]` of body `a` is NaN"),
        ];
        for (line, expected) in cases {
            let message = open(line, Some(7)).expect_err("not a reply");
            assert!(message.contains(expected), "{message}");
        }
    }

    #[test]
    fn results_are_read_strictly_and_errors_name_the_field() {
        let message = |outcome: moreau_exact::Result<Vec<Vec<f64>>>| outcome.expect_err("refused").to_string();
        let asked = [vec![1.0, 0.0]];
        assert!(message(points(r#"{"points":[[1,1e999]]}"#, &asked)).contains("`points[0][1]`: number out of range"));
        assert!(message(points(r#"{"points":[[1,0],[1,0]]}"#, &asked)).contains("`points`: has 2 rows"));
        assert!(message(points(r#"{"points":[[1,"x"]]}"#, &asked)).contains("`points[0][1]`"));
        assert!(message(points(r#"{"point":[]}"#, &asked)).contains("`point`"));
        assert_eq!(points(r#"{"points":[[1,0.5]]}"#, &asked).expect("well formed"), [[1.0, 0.5]]);
        let short = r#"{"schema":"solution/1","impulse":[1],"velocity":[0]}"#;
        assert!(solution(short, 1).is_ok());
        assert!(solution(short, 2).expect_err("too short").to_string().contains("`impulse`: has 1 entry"));
        let bad = r#"{"name":"x","version":"1","precision":"half"}"#;
        assert!(description(bad).expect_err("unknown precision").to_string().contains("`precision`"));
    }

    #[test]
    fn nesting_without_end_is_refused_and_not_followed() {
        let deep = format!(r#"{{"name":"x","options":{{"a":{}1{}}}}}"#, "[".repeat(200_000), "]".repeat(200_000));
        assert!(description(&deep).expect_err("too deep").to_string().contains("recursion limit"));
        let line = format!(r#"{{"id":7,"result":{}"#, "[".repeat(1_000_000));
        assert!(open(line.as_bytes(), Some(7)).is_err());
    }
}
