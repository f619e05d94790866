//! What the reader of JSON says of a value, in words of JSON instead of those of the program.
//!
//! ```text
//!     invalid type: string "x", expected f64      →      is the text "x"; give a number
//! ```

use moreau_exact::number::counted;

/// What is wrong with a value, and what would be right.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Told {
    /// What it is.
    pub problem: String,
    /// What to give instead.
    pub cure: String,
}

/// A message without its place in plain words; nothing where it is plain already. Readers of other formats have the same messages.
pub fn told(message: &str) -> Option<Told> {
    if message.starts_with("data did not match any variant") {
        let cure = "give one of the kinds that the schema has";
        return Some(Told { problem: "is of none of the kinds that there are".into(), cure: cure.into() });
    }
    if let Some((name, rest)) = message.strip_prefix("unknown variant `").and_then(|rest| rest.split_once('`')) {
        let known = rest.trim_start_matches(", expected ").trim_start_matches("one of ");
        return Some(Told { problem: format!("is `{name}`"), cure: format!("use one of {known}") });
    }
    // a text that is quoted may have the same words in it
    let (found, expected) = message.rsplit_once(", expected ")?;
    let problem = match found.strip_prefix("invalid length ") {
        Some(count) => format!("has {}", counted(count.parse().ok()?, "entry")),
        None => format!("is {}", value(found.strip_prefix("invalid type: ").or_else(|| found.strip_prefix("invalid value: "))?)),
    };
    Some(Told { problem, cure: format!("give {}", wanted(expected)) })
}

/// A value that was found.
fn value(found: &str) -> String {
    if let Some(text) = found.strip_prefix("string ") {
        let shown: String = text.chars().take(SHOWN).collect();
        return format!("the text {}", if shown.len() < text.len() { shown + "…" } else { shown });
    }
    match found {
        "sequence" => "a list".into(),
        "map" => "an object".into(),
        "unit value" | "Option value" => "null".into(),
        // a number or a word of JSON between two marks: integer `5`
        _ => match found.split_once('`') {
            Some((_, quoted)) => quoted.trim_end_matches('`').into(),
            None => found.into(),
        },
    }
}

/// Letters of a text that are shown.
const SHOWN: usize = 60;

/// What was expected.
fn wanted(expected: &str) -> String {
    let digits = || expected.chars().filter(char::is_ascii_digit).collect::<String>();
    match expected {
        "u8" => format!("a whole number from 0 to {}", u8::MAX),
        "u16" => format!("a whole number from 0 to {}", u16::MAX),
        "u32" => format!("a whole number from 0 to {}", u32::MAX),
        "u64" | "usize" => "a whole number, 0 or more".into(),
        "i8" | "i16" | "i32" | "i64" | "isize" => "a whole number".into(),
        "f32" | "f64" => "a number".into(),
        "a boolean" => "true or false".into(),
        "a string" | "a borrowed string" => "a text in quotation marks".into(),
        "a sequence" => "a list in square brackets".into(),
        "a map" => OBJECT.into(),
        "unit" => "null".into(),
        "string or map" | "variant identifier" | "string only" => "one of the words that the schema has".into(),
        _ if expected.starts_with("an array of length ") || expected.starts_with("a tuple of size ") => {
            format!("a list of {} entries", digits())
        }
        _ if ["struct ", "tuple struct ", "internally tagged", "adjacently tagged"].iter().any(|start| expected.starts_with(start)) => {
            OBJECT.into()
        }
        _ if expected.starts_with("enum ") || expected.contains("variant of enum") => "one of the words that the schema has".into(),
        other => other.into(),
    }
}

const OBJECT: &str = "an object in braces";

#[cfg(test)]
mod tests {
    use super::*;
    use crate::files::read_object;
    use serde::Deserialize;

    #[test]
    fn values_and_what_is_expected_are_told_in_words_of_json() {
        let known = [
            ("invalid type: string \"x, expected y\", expected f64", "is the text \"x, expected y\"", "give a number"),
            ("invalid type: integer `5`, expected a string", "is 5", "give a text in quotation marks"),
            ("invalid value: integer `-3`, expected usize", "is -3", "give a whole number, 0 or more"),
            ("invalid type: floating point `3.5`, expected u32", "is 3.5", "give a whole number from 0 to 4294967295"),
            ("invalid type: null, expected f64", "is null", "give a number"),
            ("invalid type: map, expected a sequence", "is an object", "give a list in square brackets"),
            ("invalid type: sequence, expected struct Pair", "is a list", "give an object in braces"),
            ("invalid type: boolean `true`, expected a map", "is true", "give an object in braces"),
            ("invalid length 1, expected an array of length 2", "has 1 entry", "give a list of 2 entries"),
            ("unknown variant `x`, expected one of `a`, `b`", "is `x`", "use one of `a`, `b`"),
            ("invalid type: integer `1`, expected a matrix as {}", "is 1", "give a matrix as {}"),
        ];
        for (message, problem, cure) in known {
            assert_eq!(told(message), Some(Told { problem: problem.into(), cure: cure.into() }), "{message}");
        }
        for plain in ["missing field `x`", "unknown field `x`, expected `a` or `b`", "number out of range", "is null instead of a matrix"] {
            assert_eq!(told(plain), None, "{plain}");
        }
        let long = told(&format!("invalid type: string \"{}\", expected f64", "x".repeat(500))).expect("a value").problem;
        assert!(long.chars().count() < 80 && long.ends_with('…'), "{long}");
    }

    #[derive(Debug, Deserialize)]
    #[serde(deny_unknown_fields)]
    #[allow(dead_code)]
    struct Every {
        whole: Option<usize>,
        small: Option<u8>,
        signed: Option<i64>,
        number: Option<f64>,
        single: Option<f32>,
        text: Option<String>,
        truth: Option<bool>,
        list: Option<Vec<f64>>,
        pair: Option<[f64; 2]>,
        both: Option<(f64, String)>,
        inner: Option<Inner>,
        word: Option<Word>,
        either: Option<Either>,
    }

    #[derive(Debug, Deserialize)]
    #[allow(dead_code)]
    struct Inner {
        a: f64,
    }

    #[derive(Debug, Deserialize)]
    #[allow(dead_code)]
    enum Word {
        One,
        Two(usize),
    }

    #[derive(Debug, Deserialize)]
    #[serde(untagged)]
    #[allow(dead_code)]
    enum Either {
        Number(f64),
        List(Vec<f64>),
    }

    #[test]
    fn no_field_of_any_kind_is_refused_with_words_of_the_program() {
        let fields = ["whole", "small", "signed", "number", "single", "text", "truth", "list", "pair", "both", "inner", "word", "either"];
        let mut refused = 0;
        for field in fields {
            for value in
                ["5", "-5", "1e9", "2.5", "true", "\"x\"", "[]", "[\"x\"]", "[[1]]", "{}", "{\"a\":[]}", "{\"Two\":\"x\"}", "1e999"]
            {
                // where a word is meant, a number that is too large is not read as one
                if (field, value) == ("word", "1e999") {
                    continue;
                }
                let Err(error) = read_object::<Every>(&format!("{{\"{field}\": {value}}}"), "every/1") else { continue };
                refused += 1;
                let message = error.to_string();
                for word in
                    ["usize", "u8", "i64", "f64", "f32", "struct", "enum", "sequence", "map", "tuple", "variant", "invalid", "expected"]
                {
                    let own = message.replace("unknown field `a`, expected", "");
                    assert!(!own.split(|letter: char| !letter.is_alphanumeric()).any(|said| said == word), "{field} {value}: {message}");
                }
                assert!(message.contains(&format!("field `{field}")) || message.contains("field `a"), "{field} {value}: {message}");
            }
        }
        assert!(refused > 80, "{refused}");
    }
}
