//! The stored schemas are those of the types; made again by `moreau schema --write schemas`.

use moreau::report::formats::{BEGIN, END, WRITTEN_BY_HAND, markdown};
use moreau::report::schemas::FORMATS;
use std::collections::BTreeSet;
use std::path::Path;

#[test]
fn the_stored_schemas_are_those_of_the_types() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("schemas");
    for format in &FORMATS {
        let stored = std::fs::read_to_string(folder.join(format.file())).unwrap_or_default();
        assert!(stored == format.schema(), "{} is out of date: run `cargo run -- schema --write schemas`", format.file());
    }
    let files =
        std::fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("readable").file_name().to_string_lossy().into_owned());
    let expected: BTreeSet<String> = FORMATS.iter().map(|format| format.file()).collect();
    assert_eq!(files.collect::<BTreeSet<_>>(), expected);
}

#[test]
fn every_field_of_every_schema_is_explained() {
    for format in &FORMATS {
        let schema: serde_json::Value = serde_json::from_str(&format.schema()).expect("JSON");
        assert_eq!(schema["$schema"], "https://json-schema.org/draft/2020-12/schema");
        let mut dumb = Vec::new();
        unexplained(&schema, format.name, &mut dumb);
        assert!(dumb.is_empty(), "without a description: {dumb:?}");
    }
}

/// The properties without a description; the one property of a variant is explained with it, and constants by themselves.
fn unexplained(value: &serde_json::Value, path: &str, found: &mut Vec<String>) {
    if let Some(properties) = value["properties"].as_object() {
        let variant = properties.len() == 1 && !value["description"].is_null();
        for (name, property) in properties {
            if property["description"].is_null() && property["const"].is_null() && !variant {
                found.push(format!("{path}/{name}"));
            }
        }
    }
    match value {
        serde_json::Value::Object(entries) => entries.iter().for_each(|(name, inner)| unexplained(inner, &format!("{path}/{name}"), found)),
        serde_json::Value::Array(entries) => entries.iter().for_each(|inner| unexplained(inner, path, found)),
        _ => {}
    }
}

#[test]
fn the_page_of_the_fields_is_made_from_the_schemas_and_has_every_field() {
    let page = std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/formats.md")).expect("docs/formats.md");
    let section = page.split_once(BEGIN).and_then(|(_, rest)| rest.split_once(END)).expect("both markers").0;
    assert!(section.trim() == markdown().trim(), "run `moreau schema --readme docs/formats.md`");
    let sections: Vec<&str> = section.split("\n## ").skip(1).collect();
    for (name, written) in WRITTEN_BY_HAND.iter().zip(&sections) {
        let stored = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("schemas/{name}.schema.json"));
        let schema: serde_json::Value = serde_json::from_str(&std::fs::read_to_string(stored).expect("a schema")).expect("JSON");
        let mut fields = Vec::new();
        all_fields(&schema, &mut fields);
        assert!(written.starts_with(&format!("{name}/1\n")) && fields.len() >= 4, "{name}");
        for (field, needed) in fields {
            let start = format!("| `{field}` | {} |", if needed { "yes" } else { "" });
            assert!(written.contains(&start) || written.contains(&format!("\"{field}\":")), "{name}: no row `{start}`");
        }
    }
    // a field more in a schema is missing in the page
    let planted = section.replacen("| `shift` |", "| `shft` |", 1);
    assert!(planted.trim() != markdown().trim());
}

fn is_condition(field: &serde_json::Value) -> bool {
    field.as_object().is_some_and(|field| field.keys().all(|key| key == "const"))
}

/// Every property of a schema at any depth, and whether it is required where it stands.
fn all_fields(value: &serde_json::Value, found: &mut Vec<(String, bool)>) {
    let required = |name: &str| value["required"].as_array().is_some_and(|all| all.iter().any(|one| one == name));
    // what has nothing but a value is a condition on a field that stands elsewhere
    let fields = value["properties"].as_object().into_iter().flatten().filter(|(_, field)| !is_condition(field));
    found.extend(fields.map(|(name, _)| (name.clone(), required(name))));
    match value {
        serde_json::Value::Object(entries) => entries.values().for_each(|inner| all_fields(inner, found)),
        serde_json::Value::Array(entries) => entries.iter().for_each(|inner| all_fields(inner, found)),
        _ => {}
    }
}
