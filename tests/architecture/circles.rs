//! No two files of a crate import each other, directly or through others.

use super::modules::{Modules, Source};
use super::strip::strip;
use super::{File, library, rust_files};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// The module a file is, from the root of its crate.
fn module(path: &Path) -> Vec<String> {
    let mut parts: Vec<String> = path.with_extension("").iter().map(|part| part.to_string_lossy().into_owned()).collect();
    if parts.last().is_some_and(|last| last == "mod" || (parts.len() == 1 && ["lib", "main"].contains(&last.as_str()))) {
        parts.pop();
    }
    parts
}

/// Every circle of a crate's files, each as the lines of its imports, `a.rs -> b.rs: names`.
fn circles(files: &[&File]) -> Vec<Vec<String>> {
    let sources: Vec<_> = files.iter().map(|file| Source { module: module(&file.path), code: file.code.clone() }).collect();
    let edges = Modules::new(&sources).edges();
    let next = |file: usize| edges.range((file, 0)..(file + 1, 0)).map(|((_, to), _)| *to);
    let reach: Vec<BTreeSet<usize>> = (0..files.len()).map(|file| reached(file, next)).collect();
    let mut groups: BTreeMap<Vec<usize>, Vec<String>> = BTreeMap::new();
    for ((from, to), names) in edges.iter().filter(|((from, to), _)| reach[*to].contains(from)) {
        let group = reach[*from].iter().copied().filter(|file| reach[*file].contains(from)).collect();
        let line = format!("{} -> {}: {}", files[*from].place(), files[*to].place(), names.iter().cloned().collect::<Vec<_>>().join(", "));
        groups.entry(group).or_default().push(line);
    }
    groups.into_values().collect()
}

/// The files of the test programs that have more than one.
fn test_programs() -> Vec<File> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests");
    let file = |path: PathBuf| {
        let code = strip(&std::fs::read_to_string(&path).expect("a source file"));
        let below: Vec<_> = path.strip_prefix(&folder).expect("found below").iter().collect();
        let room = format!("tests/{}", below[0].to_string_lossy());
        (below.len() > 1).then(|| File { room, path: below[1..].iter().collect(), code })
    };
    rust_files(&folder).into_iter().filter_map(file).collect()
}

/// The files that are reached from one in a step or more.
fn reached<I: Iterator<Item = usize>>(start: usize, next: impl Fn(usize) -> I) -> BTreeSet<usize> {
    let mut found = BTreeSet::new();
    let mut open: Vec<usize> = next(start).collect();
    while let Some(file) = open.pop() {
        if found.insert(file) {
            open.extend(next(file));
        }
    }
    found
}

#[test]
fn no_files_import_each_other_in_a_circle() {
    let files = [library(), test_programs()].concat();
    let rooms: BTreeSet<_> = files.iter().map(|file| &file.room).collect();
    assert!(rooms.len() > 8, "test programs are looked at, too: {rooms:?}");
    // the program `moreau` is a crate of its own
    let program = |file: &File| file.room == "moreau" && file.path.ends_with("main.rs");
    let of_room = |room: &String| files.iter().filter(|file| file.room == *room && !program(file)).collect::<Vec<_>>();
    let found: Vec<_> = rooms.into_iter().flat_map(|room| circles(&of_room(room))).collect();
    let listed: Vec<_> = found.iter().map(|lines| format!("{}\n", lines.join("\n"))).collect();
    assert!(found.is_empty(), "{} circles; move what is shared to where both may take it from:\n\n{}", found.len(), listed.join("\n"));
}

/// The circles among planted files, each as its number of imports.
fn planted(files: &[(&str, &str)]) -> Vec<usize> {
    let files: Vec<_> = files.iter().map(|(path, code)| File { room: "planted".into(), path: path.into(), code: (*code).into() }).collect();
    circles(&files.iter().collect::<Vec<_>>()).iter().map(Vec::len).collect()
}

/// The section of the claims that a file belongs to: the folder below `claims` whose table of claims the registry lists.
fn section(file: &File, sections: &BTreeSet<String>) -> Option<String> {
    let path: Vec<_> = file.path.iter().map(|part| part.to_string_lossy()).collect();
    let ["claims", section, ..] = path.iter().map(AsRef::as_ref).collect::<Vec<_>>()[..] else { return None };
    sections.contains(section).then(|| section.to_string())
}

/// The imports from one section of the claims into another, each as a line; what two share is an experiment.
fn between_sections(files: &[&File], sections: &BTreeSet<String>) -> Vec<String> {
    let sources: Vec<_> = files.iter().map(|file| Source { module: module(&file.path), code: file.code.clone() }).collect();
    let edges = Modules::new(&sources).edges();
    let of = |file: usize| section(files[file], sections);
    let crossing = edges.keys().filter(|(from, to)| of(*from).zip(of(*to)).is_some_and(|(from, to)| from != to));
    crossing.map(|(from, to)| format!("{} -> {}", files[*from].place(), files[*to].place())).collect()
}

#[test]
fn no_section_of_the_claims_imports_another() {
    let files = library();
    let files: Vec<_> = files.iter().filter(|file| file.room == "moreau" && !file.path.ends_with("main.rs")).collect();
    let registry = files.iter().find(|file| file.path.ends_with("claims/registry.rs")).expect("the registry");
    let listed = registry.code.split("super::").filter_map(|rest| rest.split_once("::CLAIMS")).map(|(section, _)| section.to_string());
    let sections: BTreeSet<_> = listed.filter(|section| section.chars().all(char::is_alphanumeric)).collect();
    assert_eq!(sections.len(), 16, "{sections:?}");
    assert_eq!(between_sections(&files, &sections), Vec::<String>::new());
}

#[test]
fn a_planted_import_between_sections_is_found() {
    let file = |(path, code): (&str, &str)| File { room: "planted".into(), path: path.into(), code: code.into() };
    let claims = ("claims/mod.rs", "mod experiments; mod s1; mod s2;");
    let shared = ("claims/experiments.rs", "pub fn fall() {}");
    let first = ("claims/s1/mod.rs", "use crate::claims::experiments::fall; pub fn own() {}");
    let found = |second: &str| {
        let files = [("lib.rs", "mod claims;"), claims, shared, first, ("claims/s2/mod.rs", second)].map(file);
        between_sections(&files.iter().collect::<Vec<_>>(), &["s1".into(), "s2".into()].into())
    };
    assert_eq!(found("use crate::claims::experiments::fall;"), Vec::<String>::new());
    assert_eq!(found("use crate::claims::s1::own;"), ["planted/claims/s2/mod.rs -> planted/claims/s1/mod.rs"]);
}

#[test]
fn planted_circles_of_two_and_three_files_are_found() {
    let root = ("lib.rs", "mod a; mod b; mod c;");
    let (a, b) = (("a.rs", "use crate::b::B; pub struct A;"), ("b.rs", "use super::a::A; pub struct B;"));
    assert_eq!(planted(&[root, a, b]), [2]);
    let b = ("b/mod.rs", "pub struct B(super::c::C);");
    let c = ("c.rs", "use crate::a; pub struct C; fn f() { a::A }");
    assert_eq!(planted(&[root, a, b, c]), [3]);
    assert_eq!(planted(&[root, a, b, ("c.rs", "pub struct C;")]), Vec::<usize>::new());
}

#[test]
fn a_planted_circle_is_found_through_re_exports_and_between_parent_and_child() {
    let root = ("lib.rs", "mod a; mod b; pub use a::A; pub use b::B;");
    assert_eq!(planted(&[root, ("a.rs", "use crate::B; pub struct A;"), ("b.rs", "use crate::A; pub struct B;")]), [2]);
    let child = ("a/child.rs", "use super::A; pub struct Child;");
    assert_eq!(planted(&[("a/mod.rs", "mod child; use child::Child; pub struct A;"), child]), [2]);
    assert_eq!(planted(&[("a/mod.rs", "mod child; pub use child::Child; pub struct A(Child);"), child]), [2]);
    // handed on only
    assert_eq!(planted(&[("a/mod.rs", "mod child; pub use child::Child; pub struct A;"), child]), Vec::<usize>::new());
}
