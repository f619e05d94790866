//! The stored schemas are those of the types; made again by `moreau schema --write schemas`.

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
