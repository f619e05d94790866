//! JSON in: errors that name the field, and files with a schema name.

use moreau_exact::{Error, Result};
use serde::Deserialize;
use serde::de::DeserializeOwned;

/// Reads a value from JSON text whose `schema` entry must be `schema`.
///
/// # Errors
/// [`Error::Json`] if the text is not JSON; [`Error::Invalid`] names the field where it is not what the schema says.
pub fn read_schema<T: DeserializeOwned>(text: &str, schema: &str) -> Result<T> {
    #[derive(Deserialize)]
    struct Probe {
        schema: Option<serde_json::Value>,
    }
    let first = text.trim_start_matches(|letter: char| letter.is_whitespace() || letter == '\u{feff}').chars().next();
    if text.starts_with('\u{feff}') || first.is_some_and(|letter| letter != '{') {
        return Err(Error::invalid(
            "schema",
            "is missing, because the text is not a JSON object",
            format!("start with {{\"schema\": \"{schema}\""),
        ));
    }
    let probe: Probe = read_object(text, schema)?;
    match probe.schema {
        Some(serde_json::Value::String(name)) if name == schema => {}
        Some(other) => return Err(Error::invalid("schema", format!("is {other}"), format!("this reader takes \"{schema}\""))),
        None => return Err(Error::invalid("schema", "is missing", format!("add \"schema\": \"{schema}\""))),
    }
    read_object(text, schema)
}

/// Whether this is JSON text whose `schema` entry is `schema`.
pub fn names_schema(text: &str, schema: &str) -> bool {
    #[derive(Deserialize)]
    struct Probe {
        schema: String,
    }
    serde_json::from_str::<Probe>(text).is_ok_and(|probe| probe.schema == schema)
}

/// Reads a value from JSON text that `schema` describes.
///
/// # Errors
/// [`Error::Json`] if the text is not JSON; [`Error::Invalid`] names the field where it is not what the schema says.
pub fn read_object<T: DeserializeOwned>(text: &str, schema: &str) -> Result<T> {
    serde_json::from_str(text).map_err(|error| name_field(text, schema, error))
}

/// The error with the last key before the place where reading stopped.
fn name_field(text: &str, schema: &str, error: serde_json::Error) -> Error {
    use serde_json::error::Category;
    if error.classify() == Category::Eof {
        return ends_early(text, &error);
    }
    if error.classify() == Category::Io {
        return Error::Json(error);
    }
    let (problem, cure) = if error.to_string().starts_with("number out of range") {
        (error.to_string(), "use a finite number".to_string())
    } else if error.classify() == Category::Syntax {
        (format!("not valid JSON: {error}"), "JSON knows finite numbers only, no NaN and no Infinity".to_string())
    } else {
        (error.to_string(), format!("see the schema {schema}"))
    };
    let field = named(&error).or_else(|| last_key(text, error.line(), error.column()));
    match field.filter(|_| !error.to_string().starts_with("trailing characters")) {
        Some(field) => Error::invalid(field, problem, cure),
        None => Error::Json(error),
    }
}

/// The error of a text that is cut off: where it ends, and after which key.
fn ends_early(text: &str, error: &serde_json::Error) -> Error {
    let field = last_key(text, error.line(), error.column()).unwrap_or_else(|| "schema".into());
    let problem = if text.trim().is_empty() {
        "is missing, because the text is empty".into()
    } else {
        format!("is the last one of a text that ends early, at line {} column {}", error.line(), error.column())
    };
    Error::invalid(field, problem, "it is not valid JSON: write or copy the file again, whole")
}

/// The field that the message itself names: an unknown, missing or doubled one.
fn named(error: &serde_json::Error) -> Option<String> {
    let message = error.to_string();
    let rest = ["unknown field `", "missing field `", "duplicate field `"].into_iter().find_map(|start| message.strip_prefix(start))?;
    rest.split('`').next().map(String::from)
}

/// The last `"key":` that starts before a line and column (both counted from 1, the column in bytes).
fn last_key(text: &str, line: usize, column: usize) -> Option<String> {
    let before: usize = text.split_inclusive('\n').take(line.saturating_sub(1)).map(str::len).sum();
    let head = text.as_bytes().get(..(before + column).min(text.len()))?;
    let colon = (0..head.len())
        .rev()
        .find(|&k| head[k] == b':' && head[..k].iter().rev().find(|byte| !byte.is_ascii_whitespace()) == Some(&b'"'))?;
    let close = head[..colon].iter().rposition(|&byte| byte == b'"')?;
    let open = head[..close].iter().rposition(|&byte| byte == b'"')?;
    Some(String::from_utf8_lossy(&head[open + 1..close]).into_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Debug, Deserialize)]
    #[serde(deny_unknown_fields)]
    #[allow(dead_code)]
    struct Pair {
        schema: String,
        first: Vec<f64>,
        second: f64,
    }

    fn message(text: &str) -> String {
        read_schema::<Pair>(text, "pair/1").unwrap_err().to_string()
    }

    #[test]
    fn errors_name_the_field() {
        assert!(message(r#"{"schema":"pair/1","first":[1,"x"],"second":2}"#).contains("`first`"));
        assert!(message("{\"schema\":\"pair/1\",\n\"first\":[1],\n\"second\": 1e999}").contains("`second`"));
        assert!(message(r#"{"schema":"pair/1","first":[1],"secnd":2}"#).contains("field `secnd`: unknown"));
        assert!(message(r#"{"schema":"pair/1","first":[1]}"#).contains("field `second`: missing"));
        assert!(message(r#"{"schema":"pair/1","first":[1],"second":2,"first":[1]}"#).contains("field `first`: duplicate"));
        assert!(!message(r#"{"schema":"pair/1","first":[1],"second":2}}"#).contains("field"));
        assert!(message("\u{feff}{\"schema\":\"pair/1\"}").contains("start with"));
        assert!(message(r#"{"schema":"pair/2"}"#).contains("pair/1"));
        assert!(message(r#"{"first":[1]}"#).contains("`schema`"));
        let cut = message("{\"schema\":\"pair/1\",\n\"first\":[1");
        assert!(cut.contains("`first`") && cut.contains("ends early, at line 2 column 10") && cut.contains("not valid JSON"), "{cut}");
        assert!(message("{").contains("ends early, at line 1"));
        assert!(message(r#"{"schema":"pair/1","first":[NaN],"second":2}"#).contains("`first`: not valid JSON"));
        assert!(message(r#"{"schema":"pair/1","first":[1],"second":-Infinity}"#).contains("`second`: not valid JSON"));
        for text in ["no JSON at all", "[1]", "null", "\"x\""] {
            assert!(message(text).contains("not a JSON object"), "{text}");
        }
        assert!(message(" \n").contains("the text is empty"));
    }
}
