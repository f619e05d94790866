//! JSON in: errors that name the field, and files with a schema name.

use super::near::did_you_mean;
use super::words::{Told, told};
use moreau_exact::{Error, Result};
use serde::Deserialize;
use serde::de::DeserializeOwned;
use serde_path_to_error::{Path, Segment};

/// Reads a value from JSON text whose `schema` entry must be `schema`.
///
/// # Errors
/// [`Error::Json`] if the text is not JSON; [`Error::Invalid`] names the field where it is not what the schema says.
pub fn read_schema<T: DeserializeOwned>(text: &str, schema: &str) -> Result<T> {
    schema_of(text, &[schema])?;
    read_object(text, schema)
}

/// Which of `schemas` the `schema` entry of JSON text names.
///
/// # Errors
/// [`Error::Json`] if the text is not JSON; [`Error::Invalid`] names all of `schemas` where the entry is missing or another one.
pub fn schema_of<'a>(text: &str, schemas: &[&'a str]) -> Result<&'a str> {
    #[derive(Deserialize)]
    struct Probe {
        schema: Option<serde_json::Value>,
    }
    let names = schemas.iter().map(|schema| format!("\"{schema}\"")).collect::<Vec<_>>().join(" or ");
    if text.starts_with('\u{feff}') {
        let problem = "stands behind a byte-order mark (the bytes EF BB BF), which JSON does not have";
        return Err(Error::invalid("schema", problem, "save the file again as UTF-8 without a byte-order mark"));
    }
    if text.trim_start().starts_with(|letter: char| letter != '{') {
        let problem = "is missing, because the text is not a JSON object";
        return Err(Error::invalid("schema", problem, format!("start with {{\"schema\": {names}, …}}")));
    }
    let probe: Probe = read_object(text, schemas.first().copied().unwrap_or_default())?;
    match probe.schema {
        None => Err(Error::invalid("schema", "is missing", format!("add \"schema\": {names}"))),
        Some(found) => {
            let known = schemas.iter().copied().find(|schema| found == *schema);
            known.ok_or_else(|| Error::invalid("schema", format!("is {found}"), format!("this reader takes {names}")))
        }
    }
}

/// Reads a value from JSON text that `schema` describes.
///
/// # Errors
/// [`Error::Json`] if the text is not JSON; [`Error::Invalid`] names the field where it is not what the schema says.
pub fn read_object<T: DeserializeOwned>(text: &str, schema: &str) -> Result<T> {
    if text.trim_start().starts_with('[') {
        // serde would take its entries for the fields, in their order
        return Err(Error::invalid(schema, "is a list", format!("write an object with the fields by name; see the schema {schema}")));
    }
    serde_json::from_str(text).map_err(|error| {
        // read once more: to know the path on the way costs time, and only this text needs it. Where it is no JSON everything is looked
        // at, also what T passes over
        let path_of_json = || path_in::<serde_json::Value>(text);
        let path = error.is_syntax().then(path_of_json).flatten().or_else(|| path_in::<T>(text));
        name_field(text, schema, error, path.as_ref())
    })
}

/// The path to the place where reading a T ends.
fn path_in<T: DeserializeOwned>(text: &str) -> Option<Path> {
    let mut reader = serde_json::Deserializer::from_str(text);
    serde_path_to_error::deserialize::<_, T>(&mut reader).err().map(|failed| failed.path().clone())
}

/// The error with the last key before the place where reading stopped, and the path to it.
fn name_field(text: &str, schema: &str, error: serde_json::Error, path: Option<&Path>) -> Error {
    use serde_json::error::Category;
    if error.classify() == Category::Eof || is_cut_number(text, &error) {
        return ends_early(text, &error);
    }
    if error.classify() == Category::Io {
        return Error::Json(error);
    }
    let goes_on = error.to_string().starts_with("trailing characters");
    // what stands after a whole file is no JSON; after what a list has room for it is
    let is_json = || serde_json::from_str::<serde_json::Value>(text).is_ok();
    let is_list_too_long = goes_on && is_json();
    let (problem, cure) = if is_list_too_long {
        let place = format!("at line {} column {}", error.line(), error.column());
        (format!("holds a list with an entry too many {place}"), format!("take it out, or see the schema {schema}"))
    } else if error.to_string().starts_with("number out of range") {
        (error.to_string(), "use a finite number".to_string())
    } else if error.to_string().starts_with("recursion limit") {
        let problem = format!("holds lists and objects within each other too deep to be read: {error}");
        (problem, format!("nest at most {DEEPEST} of them, the whole file counted"))
    } else if error.to_string().starts_with("expected value") && is_json() {
        // the reader says so of a number where it takes a word or an object
        let place = format!("at line {} column {}", error.line(), error.column());
        (format!("is no value that can stand there, {place}"), format!("give what the schema {schema} has there"))
    } else if error.classify() == Category::Syntax {
        let said = error.to_string().replace("expected ident", "a word that JSON does not have");
        (format!("not valid JSON: {said}"), cure_of_syntax(word_at(text, error.line(), error.column())))
    } else if let Some(Told { problem, cure }) = told(&without_place(&error)) {
        let place = format!("at line {} column {}", error.line(), error.column());
        (format!("{problem}, {place}"), format!("{cure}; see the schema {schema}"))
    } else {
        let meant = nearest(&error.to_string()).map_or(String::new(), |meant| meant + " ");
        (error.to_string(), format!("{meant}see the schema {schema}"))
    };
    let field = named(&error).or_else(|| last_key(text, error.line(), error.column()));
    match field.filter(|_| is_list_too_long || !goes_on) {
        Some(field) => Error::invalid(within(path, field), problem, cure),
        None if error.classify() == Category::Syntax => Error::Unsupported(format!("{problem}; one object in braces is a whole file")),
        None => Error::Json(error),
    }
}

/// The message of an error before the place that it ends with.
fn without_place(error: &serde_json::Error) -> String {
    let (said, place) = (error.to_string(), format!(" at line {} column {}", error.line(), error.column()));
    said.strip_suffix(&place).map_or(said.clone(), String::from)
}

/// Lists and objects within each other that the reader of JSON takes.
const DEEPEST: usize = 127;

/// Lists within each other that fields have at most.
const DEEP: usize = 3;

/// The place in a list that a part of a path is.
fn index_of(segment: &&Segment) -> Option<usize> {
    if let Segment::Seq { index } = segment { Some(*index) } else { None }
}

/// A field with the objects and lists around it, as `bodies[0].position`, and the place in it where it is a list, as `friction[3]`.
fn within(path: Option<&Path>, field: String) -> String {
    let mut around: Vec<&Segment> = path.map_or_else(Vec::new, |path| path.iter().collect());
    let is_key = |segment: &Segment| matches!(segment, Segment::Map { key } if *key == field);
    // what is inside of the field, and the field itself; a field that is missing or unknown is not on the path
    let end = around.iter().rposition(|segment| is_key(segment)).unwrap_or(around.len());
    let places: Vec<usize> = around.iter().skip(end + 1).map_while(index_of).collect();
    // lists within lists as deep as only a mistake makes them tell nothing
    let places = if places.len() <= DEEP { &places[..] } else { &[] };
    let field = places.iter().fold(field, |field, index| format!("{field}[{index}]"));
    around.truncate(end);
    let outer = around.iter().fold(String::new(), |path, segment| match segment {
        Segment::Seq { index } => format!("{path}[{index}]"),
        Segment::Map { key } if path.is_empty() => key.clone(),
        Segment::Map { key } => format!("{path}.{key}"),
        Segment::Enum { .. } | Segment::Unknown => path,
    });
    if outer.is_empty() { field } else { format!("{outer}.{field}") }
}

/// What to do about a word where JSON has no such one.
fn cure_of_syntax(word: &str) -> String {
    let lower = word.to_lowercase();
    if ["nan", "inf"].iter().any(|number| lower.contains(number)) {
        return "JSON knows finite numbers only, no NaN and no Infinity".into();
    }
    "put right what stands there: a comma, a bracket or a quotation mark is missing or too much".into()
}

/// The letters, digits and signs around a line and column (both counted from 1, the column in bytes).
fn word_at(text: &str, line: usize, column: usize) -> &str {
    let whole = text.split('\n').nth(line.saturating_sub(1)).unwrap_or_default();
    let belongs = |byte: u8| byte.is_ascii_alphanumeric() || b"+-._".contains(&byte);
    let place = column.saturating_sub(1).min(whole.len());
    let start = whole.as_bytes()[..place].iter().rposition(|byte| !belongs(*byte)).map_or(0, |before| before + 1);
    let end = whole.as_bytes()[place..].iter().position(|byte| !belongs(*byte)).map_or(whole.len(), |after| place + after);
    whole.get(start..end).unwrap_or_default()
}

/// Whether the text ends within a number, as after `0.`, which the reader takes for a number that is none.
fn is_cut_number(text: &str, error: &serde_json::Error) -> bool {
    let rest = text.split_inclusive('\n').skip(error.line().saturating_sub(1)).enumerate();
    let mut after = rest.flat_map(|(k, line)| line.bytes().skip(if k == 0 { error.column() } else { 0 }));
    let is_unfinished = text.trim_end().ends_with(['.', '-', '+', 'e', 'E']);
    is_unfinished && error.to_string().starts_with("invalid number") && after.all(|byte| byte.is_ascii_whitespace())
}

/// The error of a text that is cut off: where it ends, and after which key.
fn ends_early(text: &str, error: &serde_json::Error) -> Error {
    let field = last_key(text, error.line(), error.column());
    let early = format!("ends early, at line {} column {}", error.line(), error.column());
    let problem = match &field {
        _ if text.trim().is_empty() => "is missing, because the text is empty".into(),
        Some(_) => format!("is the last one of a text that {early}"),
        None => format!("is missing, because the text {early}"),
    };
    Error::invalid(field.unwrap_or_else(|| "schema".into()), problem, "it is not valid JSON: write or copy the file again, whole")
}

/// The field that the message itself names: an unknown, missing or doubled one.
fn named(error: &serde_json::Error) -> Option<String> {
    let message = error.to_string();
    let rest = ["unknown field `", "missing field `", "duplicate field `"].into_iter().find_map(|start| message.strip_prefix(start))?;
    rest.split('`').next().map(String::from)
}

/// The known fields that an unknown one may be meant as, from a message that lists them.
fn nearest(message: &str) -> Option<String> {
    let mut quoted = message.strip_prefix("unknown field ")?.split('`').skip(1).step_by(2);
    did_you_mean(quoted.next()?, quoted)
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
        assert!(message(r#"{"schema":"pair/1","first":[1,"x"],"second":2}"#).contains("field `first[1]`: is the text \"x\", at line 1"));
        assert!(message("{\"schema\":\"pair/1\",\n\"first\":[1],\n\"second\": 1e999}").contains("`second`"));
        assert!(message(r#"{"schema":"pair/1","first":[1],"secnd":2}"#).contains("field `secnd`: unknown"));
        assert!(message(r#"{"schema":"pair/1","first":[1],"secnd":2}"#).contains("did you mean `second`? see the schema"));
        let far = message(r#"{"schema":"pair/1","first":[1],"third":2}"#);
        assert!(far.contains("unknown") && !far.contains("did you mean"), "{far}");
        assert!(message(r#"{"schema":"pair/1","first":[1]}"#).contains("field `second`: missing"));
        assert!(message(r#"{"schema":"pair/1","first":[1],"second":2,"first":[1]}"#).contains("field `first`: duplicate"));
        let more = message(r#"{"schema":"pair/1","first":[1],"second":2}}"#);
        assert!(!more.contains("field") && more.contains("trailing characters") && more.contains("one object in braces"), "{more}");
        let marked = message("\u{feff}{\"schema\":\"pair/1\"}");
        assert!(marked.contains("byte-order mark") && marked.contains("as UTF-8 without"), "{marked}");
        assert!(message(r#"{"schema":"pair/2"}"#).contains("pair/1"));
        assert!(message(r#"{"first":[1]}"#).contains("`schema`"));
        let cut = message("{\"schema\":\"pair/1\",\n\"first\":[1");
        assert!(cut.contains("`first`") && cut.contains("ends early, at line 2 column 10") && cut.contains("not valid JSON"), "{cut}");
        assert!(message("{").contains("ends early, at line 1"));
        for number in ["0.", "-", "1e", "1E-", "2.5e+", "12.", "0.\n"] {
            let cut = message(&format!("{{\"schema\":\"pair/1\",\n\"first\":[1, {number}"));
            assert!(cut.contains("`first`") && cut.contains("ends early, at line ") && cut.contains("again, whole"), "{number}: {cut}");
            let whole = message(&format!("{{\"schema\":\"pair/1\",\n\"first\":[1, {number}], \"second\": 1}}"));
            assert!(!whole.contains("ends early") && whole.contains("not valid JSON"), "{number}: {whole}");
        }
        assert!(message(r#"{"schema":"pair/1","first":[NaN],"second":2}"#).contains("`first[0]`: not valid JSON"));
        assert!(message(r#"{"schema":"pair/1","first":[1],"second":-Infinity}"#).contains("`second`: not valid JSON"));
        for number in ["NaN", "-Infinity", "-NaN", "inf"] {
            let text = format!(r#"{{"schema":"pair/1","first":[1, {number}],"second":2}}"#);
            assert!(message(&text).contains("finite numbers only"), "{number}: {}", message(&text));
        }
        for text in [
            r#"{"schema":"pair/1","first":[1 2],"second":2}"#,
            r#"{"schema":"pair/1","first":[1],"second":'2'}"#,
            r#"{"schema":"pair/1","first":[1],"second":é2}"#,
        ] {
            let said = message(text);
            assert!(said.contains("a comma, a bracket") && !said.contains("finite"), "{said}");
        }
        for text in ["no JSON at all", "[1]", "null", "\"x\""] {
            assert!(message(text).contains("not a JSON object"), "{text}");
        }
        assert!(message(" \n").contains("the text is empty"));
    }

    #[derive(Debug, Deserialize)]
    #[serde(deny_unknown_fields)]
    #[allow(dead_code)]
    struct Pairs {
        schema: String,
        pairs: Vec<Pair>,
        one: Option<Box<Pair>>,
        two: Option<Vec<[f64; 2]>>,
    }

    #[test]
    fn the_fields_of_an_object_are_not_taken_from_a_list() {
        #[derive(Debug, Deserialize)]
        struct One {
            size: f64,
        }
        assert_eq!(read_object::<One>("{\"size\": 2}", "one/1").unwrap().size, 2.0);
        for list in ["[2]", " []", "\n[2, 3]"] {
            let told = read_object::<One>(list, "one/1").unwrap_err().to_string();
            assert!(told.contains("is a list") && told.contains("one/1"), "{told}");
        }
    }

    #[test]
    fn a_list_with_an_entry_too_many_is_told_with_its_place() {
        let of = |two: &str| format!(r#"{{"schema":"pairs/1","pairs":[],"one":null,"two":{two}}}"#);
        assert!(read_schema::<Pairs>(&of("[[1,2],[3,4]]"), "pairs/1").is_ok());
        let more = read_schema::<Pairs>(&of("[[1,2],[3,4,5]]"), "pairs/1").unwrap_err().to_string();
        assert!(more.contains("field `two[1]") && more.contains("an entry too many") && !more.contains("trailing"), "{more}");
        let fewer = read_schema::<Pairs>(&of("[[1,2],[3]]"), "pairs/1").unwrap_err().to_string();
        assert!(fewer.contains("field `two[1]") && fewer.contains("give a list of 2 entries"), "{fewer}");
    }

    #[test]
    fn errors_in_objects_within_lists_name_the_way_to_the_field() {
        let whole = r#"{"schema":"a","first":[1],"second":2}"#;
        let message = |inner: &str| {
            let text = format!(r#"{{"schema":"pairs/1","pairs":[{whole},{inner}],"one":{inner}}}"#);
            read_schema::<Pairs>(&text, "pairs/1").unwrap_err().to_string()
        };
        assert!(message(&whole.replace("[1]", r#"[1,"x"]"#)).contains("`pairs[1].first[1]`"));
        assert!(message(&whole.replace(r#""second":2"#, r#""secnd":2"#)).contains("`pairs[1].secnd`: unknown"));
        assert!(message(&whole.replace(r#","second":2"#, "")).contains("`pairs[1].second`: missing"));
        let alone = format!(r#"{{"schema":"pairs/1","pairs":[],"one":{}}}"#, whole.replace(":2", ":[]"));
        assert!(read_schema::<Pairs>(&alone, "pairs/1").unwrap_err().to_string().contains("`one.second`"));
        // what is no JSON is found before fields are looked at
        assert!(message(&whole.replace("[1]", "[1,]")).contains("`pairs[1].first`: not valid JSON"));
        let alone = format!(r#"{{"schema":"pairs/1","pairs":[],"one":{{"of":{{"of":{whole}}}}}}}"#).replace("[1]", "[1 2]");
        assert!(read_schema::<Pairs>(&alone, "pairs/1").unwrap_err().to_string().contains("`one.of.of.first`: not valid JSON"));
    }

    #[test]
    fn what_is_nested_too_deep_is_told_so_and_not_as_a_missing_bracket() {
        #[derive(Debug, Deserialize)]
        #[allow(dead_code)]
        struct Opaque {
            anything: serde_json::Value,
        }
        let nested = |lists: usize| format!(r#"{{"schema":"opaque/1","anything":{}{}}}"#, "[".repeat(lists), "]".repeat(lists));
        assert!(read_schema::<Opaque>(&nested(DEEPEST - 1), "opaque/1").is_ok(), "one more is the object around them");
        let message = read_schema::<Opaque>(&nested(DEEPEST), "opaque/1").unwrap_err().to_string();
        assert!(message.contains("`anything`: holds lists") && message.contains("nest at most 127"), "{message}");
        assert!(!message.contains("a bracket"), "{message}");
    }
}
