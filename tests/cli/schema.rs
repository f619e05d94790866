//! `moreau schema`.

use super::{Folder, moreau};

#[test]
fn the_formats_are_listed_and_each_is_printed_as_stored() {
    let list = moreau(&["schema", "--format", "json"]).json();
    let names: Vec<_> = list.as_array().expect("a list").iter().map(|entry| entry["name"].as_str().expect("a name").to_string()).collect();
    assert!(names.contains(&"trajectory".to_string()) && names.contains(&"request".to_string()), "{names:?}");
    let folder = Folder::new("schema");
    assert_eq!(moreau(&["schema", "--write", &folder.path("")]).code, 0);
    for name in names {
        let printed = moreau(&["schema", &name]);
        assert_eq!(printed.code, 0);
        let written = std::fs::read_to_string(folder.path(&format!("{name}.schema.json"))).expect("written");
        assert_eq!(printed.output, written);
    }
}

#[test]
fn an_unknown_format_is_refused_with_the_nearest() {
    moreau(&["schema", "trajectry"]).is_refused(&["`trajectry`", "trajectory"]);
    moreau(&["schema", "--write", "/nowhere/at/all"]).is_refused(&["/nowhere/at/all"]);
}

#[test]
fn what_verify_writes_is_as_its_schema_says() {
    let runs: [(&str, &[&str]); 3] = [
        ("verify", &["verify", "--filter", "S12"]),
        ("verify-list", &["verify", "--list"]),
        ("verify-explain", &["verify", "--explain", "S3.drift"]),
    ];
    for (name, command) in runs {
        let schema = moreau(&["schema", name]).json();
        let validator = jsonschema::validator_for(&schema).expect("a schema");
        let written = moreau(&[command, &["--format", "json"]].concat()).json();
        let errors: Vec<String> = validator.iter_errors(&written).map(|error| format!("{}: {error}", error.instance_path())).collect();
        assert!(errors.is_empty(), "{name}: {errors:?}");
        // a verdict that there is none of
        let mut other = written.clone();
        let claim = if other.is_array() { &mut other[0] } else { &mut other };
        claim["verdict"] = "PERHAPS".into();
        assert!(!validator.is_valid(&other), "{name}");
    }
}

#[test]
fn what_verify_exports_is_as_its_schema_says() {
    let folder = Folder::new("witnesses");
    let file = folder.path("witnesses.json");
    assert_eq!(moreau(&["verify", "--filter", "S4", "--export", &file]).code, 0);
    let written: serde_json::Value = serde_json::from_str(&std::fs::read_to_string(&file).expect("written")).expect("JSON");
    let validator = jsonschema::validator_for(&moreau(&["schema", "witnesses"]).json()).expect("a schema");
    let errors: Vec<String> = validator.iter_errors(&written).map(|error| format!("{}: {error}", error.instance_path())).collect();
    assert!(errors.is_empty(), "{errors:?}");
    for (place, wrong) in [("/schema", "witnesses/2"), ("/claims/0/witnesses/0/kind", "7"), ("/claims/0/findings/0/relation", "nearly")] {
        let mut other = written.clone();
        *other.pointer_mut(place).expect("it is there") = if wrong == "7" { 7.into() } else { wrong.into() };
        assert!(!validator.is_valid(&other), "{place}");
    }
    let length = written["claims"].as_array().expect("a list").len() as u64;
    assert_eq!(written["selected"]["group"], "S4");
    assert!(written["of"].as_u64().expect("a number") > length && written["counts"]["claims"] == length);
    moreau(&["verify", "--filter", "S4", "--export", "-"]).is_refused(&["--export", "file"]);
}
