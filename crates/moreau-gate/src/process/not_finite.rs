//! Where a line that is not JSON for the sake of `NaN` or `Infinity` has the first of them.
//!
//! JSON knows finite numbers only, and many writers put these words all the same: a simulation that has blown up should be told so, and
//! not that a column of a line of a megabyte is wrong.

use serde_json::Value;

/// The words that writers of JSON use.
const WORDS: [&str; 5] = ["-Infinity", "Infinity", "NaN", "-inf", "inf"];

/// `` `bodies[1].linear_velocity[7][2]` of body `box` is NaN ``, if such a word is all that is wrong with the line.
pub(super) fn first(line: &str) -> Option<String> {
    let value: Value = serde_json::from_str(&quoted(line)?).ok()?;
    let (path, word) = find(value.get("result").unwrap_or(&value), String::new())?;
    let index = path.strip_prefix("bodies[").and_then(|rest| rest.split(']').next()).and_then(|index| index.parse::<usize>().ok());
    let name = index.and_then(|index| value["result"]["bodies"][index]["name"].as_str());
    Some(format!("`{path}`{} is {word}", name.map_or(String::new(), |name| format!(" of body `{name}`"))))
}

/// The line with every such word outside of strings as a string of its own, marked; `None` if there is none.
fn quoted(line: &str) -> Option<String> {
    let (mut text, mut rest, mut found) = (String::with_capacity(line.len() + 16), line, false);
    while let Some(next) = rest.chars().next() {
        if next == '"' {
            let end = end_of_string(rest);
            text += &rest[..end];
            rest = &rest[end..];
        } else if let Some(word) = WORDS.iter().find(|word| rest.starts_with(**word)) {
            text += &format!("\"{MARK}{word}\"");
            rest = &rest[word.len()..];
            found = true;
        } else {
            text.push(next);
            rest = &rest[next.len_utf8()..];
        }
    }
    found.then_some(text)
}

/// A character of private use, which no text of a reply has.
const MARK: char = '\u{e000}';

/// Where the string ends that begins the text.
fn end_of_string(text: &str) -> usize {
    let mut escaped = false;
    for (at, c) in text.char_indices().skip(1) {
        match c {
            _ if escaped => escaped = false,
            '\\' => escaped = true,
            '"' => return at + 1,
            _ => {}
        }
    }
    text.len()
}

/// The path of the first marked word, and the word.
fn find(value: &Value, path: String) -> Option<(String, String)> {
    match value {
        Value::String(text) => Some((path, text.strip_prefix(MARK)?.to_string())),
        Value::Array(items) => items.iter().enumerate().find_map(|(k, item)| find(item, format!("{path}[{k}]"))),
        Value::Object(fields) => fields.iter().find_map(|(name, item)| {
            let dot = if path.is_empty() { "" } else { "." };
            find(item, format!("{path}{dot}{name}"))
        }),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::first;

    #[test]
    fn the_body_and_the_field_are_named() {
        let line = r#"{"id":7,"result":{"bodies":[{"name":"NaN, \"inf","v":[[1,2]]},{"name":"box","linear_velocity":[[0,1],[0,NaN]]}]}}"#;
        assert_eq!(first(line).as_deref(), Some("`bodies[1].linear_velocity[1][1]` of body `box` is NaN"));
        assert_eq!(first(r#"{"id":7,"result":{"points":[[1,-Infinity]]}}"#).as_deref(), Some("`points[0][1]` is -Infinity"));
    }

    #[test]
    fn another_mistake_is_left_to_the_reader() {
        for line in [r#"{"id":7,"result":{"x":1}}"#, r#"{"id":7,"result":{"x":nan}}"#, r#"{"id":7,"result":{"x":NaN"#, "NaN or never", ""] {
            assert_eq!(first(line), None, "{line}");
        }
    }
}
