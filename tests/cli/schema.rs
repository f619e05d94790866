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
