//! The fields of the files that people write, as the tables of docs/formats.md, made from their schemas.

use super::schemas::FORMATS;
use serde_json::{Map, Value};
use std::fmt::Write;

/// What `<!-- formats -->` and `<!-- /formats -->` enclose in docs/formats.md.
pub const BEGIN: &str = "<!-- formats -->";
/// The end of the tables.
pub const END: &str = "<!-- /formats -->";

/// The schemas of the files that people write.
pub const WRITTEN_BY_HAND: [&str; 4] = ["contact-problem", "lcp", "solution", "scene"];

/// A section of tables for each of these files.
pub fn markdown() -> String {
    let mut text = String::new();
    for format in WRITTEN_BY_HAND.iter().filter_map(|name| FORMATS.iter().find(|format| format.name == *name)) {
        let schema: Value = serde_json::from_str(&format.schema()).unwrap_or_default();
        let _ = writeln!(text, "## {}/1\n\n{}\n\n{}", format.name, said(&schema), table(&schema));
        for (name, part) in entries(&schema, "$defs") {
            let _ = writeln!(text, "**{name}**: {}\n\n{}", said(part), table(part));
        }
    }
    text
}

/// What an object or a choice consists of.
fn table(schema: &Value) -> String {
    let fields: Vec<_> = entries(schema, "properties").collect();
    if fields.is_empty() {
        let choice = |one: &Value| format!("| {} | {} |\n", kind(one), said(one));
        let rows: String = schema["oneOf"].as_array().into_iter().flatten().map(choice).collect();
        return format!("| one of | what it is |\n|---|---|\n{rows}");
    }
    let needed = |name: &str| if list(&schema["required"]).any(|required| required == name) { "yes" } else { "" };
    let row = |(name, field): &(&String, &Value)| format!("| `{name}` | {} | {} | {} |\n", needed(name), kind(field), said(field));
    let rows: String = fields.iter().map(row).collect();
    format!("| field | needed | kind | what it holds |\n|---|---|---|---|\n{rows}{}", alternatives(schema))
}

/// Fields of which one or another stands there.
fn alternatives(schema: &Value) -> String {
    let together = |one: &Value| list(&one["required"]).map(|name| format!("`{name}`")).collect::<Vec<_>>().join(" with ");
    let choices: Vec<String> = schema["oneOf"].as_array().into_iter().flatten().map(together).collect();
    if choices.is_empty() { String::new() } else { format!("\nExactly one of: {}.\n", choices.join(", ")) }
}

/// What a value is.
fn kind(node: &Value) -> String {
    if let Some(constant) = node.get("const") {
        return format!("`{constant}`");
    }
    if let Some(words) = node["enum"].as_array() {
        return words.iter().map(|word| format!("`{word}`")).collect::<Vec<_>>().join(", ");
    }
    if let Some(name) = node["$ref"].as_str() {
        return format!("**{}**", name.rsplit('/').next().unwrap_or(name));
    }
    if let Some(real) = node["anyOf"].as_array().and_then(|all| all.iter().find(|one| one["type"] != "null")) {
        return kind(real);
    }
    let types: Vec<&str> = node["type"].as_str().into_iter().chain(list(&node["type"])).collect();
    match types.first().copied() {
        Some("array") if node["minItems"] == node["maxItems"] && node["minItems"].is_u64() => {
            format!("list of {}, each: {}", node["minItems"], item(&node["items"]))
        }
        Some("array") => format!("list, each: {}", item(&node["items"])),
        Some("integer") => format!("whole number{}", range(node)),
        Some("number") => format!("number{}", range(node)),
        Some("string") => "text".into(),
        Some("boolean") => "`true` or `false`".into(),
        Some("object") if node.get("properties").is_some() => {
            let inside = |(name, field): (&String, &Value)| format!("`{{\"{name}\":` {}`}}`", kind(field));
            entries(node, "properties").map(inside).collect::<Vec<_>>().join(", ")
        }
        Some("object") => "object".into(),
        _ => "anything".into(),
    }
}

/// What an entry of a list is; null is one there, while a field that is null is absent.
fn item(node: &Value) -> String {
    let or_null = if list(&node["type"]).any(|word| word == "null") { " or null" } else { "" };
    kind(node) + or_null
}

/// The least and the largest value, where there are some.
fn range(node: &Value) -> String {
    match (node["minimum"].as_f64(), node["maximum"].as_f64()) {
        (Some(least), Some(most)) => format!(", {least} to {most}"),
        (Some(least), None) => format!(" ≥ {least}"),
        _ => String::new(),
    }
}

/// The description, in a line of a table.
fn said(node: &Value) -> String {
    node["description"].as_str().unwrap_or_default().replace('\n', " ").replace('|', "\\|")
}

fn entries<'a>(node: &'a Value, key: &str) -> impl Iterator<Item = (&'a String, &'a Value)> {
    node[key].as_object().into_iter().flat_map(Map::iter)
}

fn list(node: &Value) -> impl Iterator<Item = &str> {
    node.as_array().into_iter().flatten().filter_map(Value::as_str)
}
