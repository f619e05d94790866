//! The invariants of the architecture, read off the source: who may import whom, and where tolerances live.

mod source;

use source::{imports, small_literals, strip, without_tests};
use std::path::{Path, PathBuf};

/// A file of `src/` without comments, texts and test code.
struct File {
    /// Path below `src/`.
    path: PathBuf,
    code: String,
}

impl File {
    /// The top-level module the file belongs to.
    fn module(&self) -> String {
        let first = self.path.iter().next().expect("a path below src/ has a first part");
        first.to_string_lossy().trim_end_matches(".rs").into()
    }

    fn imports(&self) -> Vec<String> {
        let folders = self.path.iter().count() - 1;
        let own = usize::from(!self.path.ends_with("mod.rs"));
        imports(&self.code, folders + own)
    }
}

/// Every file of `src/` that is compiled outside tests.
fn library() -> Vec<File> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut test_only = Vec::new();
    let mut files = Vec::new();
    for path in rust_files(&root) {
        let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        let (code, modules) = without_tests(&strip(&text));
        let folder = path.parent().expect("a file lies in a folder");
        test_only.extend(modules.iter().map(|name| folder.join(format!("{name}.rs"))));
        files.push((path, code));
    }
    // `x_tests.rs` is the test module of `x.rs`, named by a path attribute
    let named_so = |path: &PathBuf| path.to_string_lossy().ends_with("_tests.rs");
    files.retain(|(path, _)| !test_only.contains(path) && !named_so(path));
    let below = |path: PathBuf| path.strip_prefix(&root).expect("found below the root").to_path_buf();
    files.into_iter().map(|(path, code)| File { path: below(path), code }).collect()
}

fn rust_files(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    let mut paths: Vec<_> = entries.map(|entry| entry.expect("a readable entry").path()).collect();
    paths.sort();
    let mut files = Vec::new();
    for path in paths {
        if path.is_dir() {
            files.extend(rust_files(&path));
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            files.push(path);
        }
    }
    files
}

/// Files of a module that import a name outside `allowed`, as `file: name`.
fn strangers(files: &[File], module: &str, allowed: &[&str]) -> Vec<String> {
    let of_module = files.iter().filter(|file| file.module() == module);
    let pairs = of_module.flat_map(|file| file.imports().into_iter().map(move |name| (file, name)));
    let strange = pairs.filter(|(_, name)| name != module && !allowed.contains(&name.as_str()));
    strange.map(|(file, name)| format!("src/{}: crate::{name}", file.path.display())).collect()
}

/// What every module may use: errors, numbers and the limit of memory.
const GROUND: [&str; 7] = ["Error", "Result", "error", "memory", "number", "scalar", "tolerance"];

#[track_caller]
fn assert_imports_only(module: &str, others: &[&str]) {
    let files = library();
    assert!(files.iter().any(|file| file.module() == module), "src/{module} has no file: the test looks at nothing");
    let allowed: Vec<_> = GROUND.iter().chain(others).copied().collect();
    assert_eq!(strangers(&files, module, &allowed), Vec::<String>::new(), "{module} imports what it may not know");
}

#[test]
fn problems_know_no_solver_and_no_scheme() {
    assert_imports_only("problem", &["cones", "contact", "files", "Law", "ContactProblem", "Solution"]);
}

#[test]
fn certificates_know_no_solver_and_no_scheme() {
    assert_imports_only("certificate", &["problem", "cones", "elimination", "Law", "ContactProblem", "Solution"]);
}

#[test]
fn closed_forms_know_nothing_they_verify() {
    assert_imports_only("closed_forms", &[]);
}

#[test]
fn files_know_nothing_of_what_they_hold() {
    assert_imports_only("files", &[]);
}

#[test]
fn cones_know_numbers_only() {
    assert_imports_only("cones", &[]);
}

/// The rows of the map in ARCHITECTURE.md that stand for modules: the names in the first column, the names that the last one allows.
fn map() -> Vec<(Vec<String>, Vec<String>)> {
    let text = include_str!("../../ARCHITECTURE.md");
    let quoted = |cell: &str| -> Vec<String> {
        cell.split('`').skip(1).step_by(2).map(|name| name.trim_end_matches('/').trim_end_matches(".rs").to_string()).collect()
    };
    let mut above: Vec<String> = Vec::new();
    let mut rows = Vec::new();
    for line in text.lines().filter(|line| line.starts_with("| `")) {
        let cells: Vec<_> = line.trim_matches('|').split('|').collect();
        let (names, last) = (quoted(cells[0]), cells[cells.len() - 1]);
        let allowed = if last.contains("all of the above") { above.clone() } else { quoted(last) };
        above.extend(names.clone());
        rows.push((names, allowed));
    }
    rows
}

#[test]
fn the_map_names_every_folder_and_what_it_imports() {
    let files = library();
    let map = map();
    let reexports = ["Law", "ContactProblem", "Solution", "gate_tests"];
    for module in files.iter().map(File::module).filter(|module| !["lib", "main"].contains(&module.as_str())) {
        let row = map.iter().find(|(names, _)| names.contains(&module));
        let (_, allowed) = row.unwrap_or_else(|| panic!("src/{module} is not in the map of ARCHITECTURE.md"));
        // `super::` inside the inline modules of the ground is not the root
        if GROUND.contains(&module.as_str()) {
            continue;
        }
        let allowed: Vec<_> = allowed.iter().map(String::as_str).chain(GROUND).chain(reexports).collect();
        assert_eq!(strangers(&files, &module, &allowed), Vec::<String>::new(), "the map of ARCHITECTURE.md does not allow this");
    }
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    for name in map.iter().flat_map(|(names, allowed)| names.iter().chain(allowed)) {
        let places = [
            root.join("src").join(name),
            root.join("src").join(format!("{name}.rs")),
            root.join(name),
            root.join("tests").join(format!("{name}.rs")),
        ];
        assert!(places.iter().any(|place| place.exists()), "the map of ARCHITECTURE.md names `{name}`, which does not exist");
    }
}

#[test]
fn small_numbers_stand_in_the_table_of_tolerances_or_in_a_planted_defect() {
    let files = library();
    let planted = |file: &File| file.module() == "defects" || file.path.starts_with("gate/planted");
    let elsewhere = files.iter().filter(|file| file.module() != "tolerance" && !planted(file));
    let found: Vec<_> = elsewhere
        .flat_map(|file| small_literals(&file.code).into_iter().map(|number| format!("src/{}: {number}", file.path.display())))
        .collect();
    assert_eq!(found, Vec::<String>::new(), "a small number needs a name and a derivation in src/tolerance.rs");
}

#[test]
fn clocks_are_read_only_to_report_run_times_and_to_end_an_engine_that_does_not_answer() {
    let files = library();
    let reading = files.iter().filter(|file| file.code.contains("Instant") || file.code.contains("SystemTime"));
    let paths: Vec<_> = reading.map(|file| file.path.to_string_lossy().into_owned()).collect();
    // the time limit decides whether there is a reply, never what it is
    assert_eq!(paths, ["claims/registry.rs", "gate/process/deadline.rs"], "the same input gives the same output");
}

#[test]
fn the_rules_can_fail() {
    let planted = |path: &str, code: &str| File { path: path.into(), code: strip(code) };
    let files = [
        planted("closed_forms/ball.rs", "use crate::schemes::step;"),
        planted("closed_forms/mod.rs", "use super::mechanics::State; use crate::closed_forms::x;"),
        planted("cones/orthant.rs", "use crate::problem::Law;"),
    ];
    let expected = ["src/closed_forms/ball.rs: crate::schemes", "src/closed_forms/mod.rs: crate::mechanics"];
    assert_eq!(strangers(&files, "closed_forms", &GROUND), expected);
    assert_eq!(strangers(&files, "cones", &GROUND), ["src/cones/orthant.rs: crate::problem"]);
}
