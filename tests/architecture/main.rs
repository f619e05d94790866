//! The invariants of the architecture, read off manifests and source: who may depend on whom, and where tolerances live.

mod circles;
mod controls;
mod modules;
mod second;
mod source;
mod strip;
mod tolerances;

use source::{imports, names_after, small_literals, without_tests};
use std::path::{Path, PathBuf};
use strip::strip;

/// A file of a crate without comments, texts and test code.
#[derive(Clone)]
struct File {
    /// The crate's name.
    room: String,
    /// Path below the crate's `src/`.
    path: PathBuf,
    code: String,
}

impl File {
    /// The top-level module the file belongs to, `crate/module`.
    fn module(&self) -> String {
        let first = self.path.iter().next().expect("a path below src/ has a first part");
        format!("{}/{}", self.room, first.to_string_lossy().trim_end_matches(".rs"))
    }

    /// Where it is, for messages.
    fn place(&self) -> String {
        format!("{}/{}", self.room, self.path.display())
    }

    /// The modules of its own crate that it names, `crate/module`.
    fn imports(&self) -> Vec<String> {
        let folders = self.path.iter().count() - 1;
        let own = usize::from(!self.path.ends_with("mod.rs"));
        imports(&self.code, folders + own).into_iter().map(|name| format!("{}/{name}", self.room)).collect()
    }
}

/// The crates of the workspace below the top one, in the order of their arrows.
const ROOMS: [&str; 8] =
    ["moreau-exact", "moreau-forms", "moreau-contact", "moreau-dynamics", "moreau-checks", "moreau-replicas", "moreau-gate", "moreau-site"];

/// The folder of a crate of the workspace.
fn folder(room: &str) -> PathBuf {
    let top = Path::new(env!("CARGO_MANIFEST_DIR"));
    if room == "moreau" { top.into() } else { top.join("crates").join(room) }
}

/// Every file of every crate that is compiled outside tests.
fn library() -> Vec<File> {
    ROOMS.iter().chain(&["moreau"]).flat_map(|room| files_of(room)).collect()
}

fn files_of(room: &str) -> Vec<File> {
    let root = folder(room).join("src");
    let mut test_only = Vec::new();
    let mut files = Vec::new();
    for path in rust_files(&root) {
        let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        let (code, modules) = without_tests(&strip(&text));
        let folder = path.parent().expect("a file lies in a folder");
        test_only.extend(modules.iter().flat_map(|name| [folder.join(format!("{name}.rs")), folder.join(name)]));
        files.push((path, code));
    }
    // `x_tests.rs` is the test module of `x.rs`, named by a path attribute
    let named_so = |path: &PathBuf| path.to_string_lossy().ends_with("_tests.rs");
    files.retain(|(path, _)| !test_only.iter().any(|only| path.starts_with(only)) && !named_so(path));
    let below = |path: PathBuf| path.strip_prefix(&root).expect("found below the root").to_path_buf();
    files.into_iter().map(|(path, code)| File { room: room.into(), path: below(path), code }).collect()
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

/// Files of a module that name a module of their crate outside `allowed`, as `file: module`.
fn strangers(files: &[File], module: &str, allowed: &[String]) -> Vec<String> {
    let of_module = files.iter().filter(|file| file.module() == module);
    let pairs = of_module.flat_map(|file| file.imports().into_iter().map(move |name| (file, name)));
    let strange = pairs.filter(|(_, name)| name != module && !allowed.contains(name));
    strange.map(|(file, name)| format!("{}: {name}", file.place())).collect()
}

/// What every module of a crate may use beside what the map allows: its tolerances and the limit of memory, at the top the crates below
/// under their old names. What a crate re-exports of its own (`crate::ContactProblem`) is none of it: a module takes it from where it is.
fn ground(room: &str) -> Vec<String> {
    let mut names: Vec<String> = ["tolerance", "memory"].map(String::from).into();
    if room == "moreau" {
        let text = strip(&std::fs::read_to_string(folder(room).join("src/lib.rs")).expect("the top crate"));
        let handed_on = text.split(';').filter(|item| item.trim_start().starts_with("pub use moreau_"));
        names.extend(handed_on.flat_map(|item| item.split(|letter: char| !letter.is_alphanumeric() && letter != '_')).map(String::from));
    }
    names.into_iter().map(|name| format!("{room}/{name}")).collect()
}

/// Dependencies on crates of the workspace in one table of a crate's manifest, by name.
fn dependencies(room: &str, table: &str) -> Vec<String> {
    let file = folder(room).join("Cargo.toml");
    let text = std::fs::read_to_string(&file).unwrap_or_else(|error| panic!("{}: {error}", file.display()));
    named(&text, table)
}

/// The crates of the workspace that one table of a manifest names, tables of a target included.
fn named(manifest: &str, table: &str) -> Vec<String> {
    let manifest: toml::Table = manifest.parse().expect("a manifest is TOML");
    let tables = |manifest: &toml::Table| manifest.get(table).and_then(toml::Value::as_table).cloned().unwrap_or_default();
    let targets = manifest.get("target").and_then(toml::Value::as_table).into_iter().flat_map(toml::Table::values);
    let mut names: Vec<String> = tables(&manifest).into_iter().map(|(name, _)| name).collect();
    names.extend(targets.filter_map(toml::Value::as_table).flat_map(|target| tables(target).into_iter().map(|(name, _)| name)));
    names.retain(|name| name.starts_with("moreau"));
    names
}

/// The rows of the map in ARCHITECTURE.md: the names in the first column, the names that the last one allows.
fn map() -> Vec<(Vec<String>, Vec<String>)> {
    let quoted = |cell: &str| -> Vec<String> { cell.split('`').skip(1).step_by(2).map(String::from).collect() };
    let rows = include_str!("../../ARCHITECTURE.md").lines().filter(|line| line.starts_with("| `moreau"));
    rows.map(|line| {
        let cells: Vec<_> = line.trim_matches('|').split('|').collect();
        (quoted(cells[0]), quoted(cells[cells.len() - 1]))
    })
    .collect()
}

#[test]
fn every_crate_depends_on_the_crates_that_the_map_gives_it_and_tests_on_no_upper_one() {
    for room in ROOMS {
        let row = map().into_iter().find(|(names, _)| names.iter().any(|name| name == room));
        let (_, mut allowed) = row.unwrap_or_else(|| panic!("{room} is not in the map of ARCHITECTURE.md"));
        allowed.sort();
        assert_eq!(dependencies(room, "dependencies"), allowed, "{room}: Cargo.toml against the map of ARCHITECTURE.md");
        let above: Vec<&str> = ROOMS.into_iter().skip_while(|name| *name != room).collect();
        assert!(allowed.iter().all(|name| !above.contains(&name.as_str())), "{room}: an arrow upwards");
        for table in ["dev-dependencies", "build-dependencies"] {
            assert_eq!(dependencies(room, table), Vec::<String>::new(), "{room}: tests that need an upper crate belong to the top one");
        }
    }
}

#[test]
fn the_gate_and_the_replicas_do_not_know_each_other() {
    let known = |room: &str| dependencies(room, "dependencies");
    assert!(!known("moreau-gate").contains(&"moreau-replicas".into()) && !known("moreau-replicas").contains(&"moreau-gate".into()));
}

#[test]
fn the_map_names_every_module_and_what_it_imports() {
    let files = library();
    // closed forms and numbers: one per file, nothing to allow but each other
    let listed = |room: &str| !["moreau-exact", "moreau-forms"].contains(&room);
    let mut checked = 0;
    for file in files.iter().filter(|file| listed(&file.room) && !["lib.rs", "main.rs"].contains(&file.path.to_string_lossy().as_ref())) {
        let module = file.module();
        if module.ends_with("/tolerance") {
            continue;
        }
        let row = map().into_iter().find(|(names, _)| names.contains(&module));
        let (_, allowed) = row.unwrap_or_else(|| panic!("{module} is not in the map of ARCHITECTURE.md"));
        checked += 1;
        if allowed.contains(&file.room) {
            continue;
        }
        let allowed: Vec<_> = allowed.iter().map(|name| format!("{}/{name}", file.room)).chain(ground(&file.room)).collect();
        assert_eq!(strangers(&files, &module, &allowed), Vec::<String>::new(), "the map of ARCHITECTURE.md does not allow this");
    }
    assert!(checked > 0);
    for (names, allowed) in map().into_iter().filter(|(names, _)| names[0].contains('/')) {
        let (room, _) = names[0].split_once('/').expect("a module's row");
        let allowed: Vec<_> = allowed.into_iter().filter(|name| name != room).map(|name| format!("{room}/{name}")).collect();
        for name in names.iter().chain(&allowed) {
            assert!(files.iter().any(|file| file.module() == *name), "the map of ARCHITECTURE.md names `{name}`, which does not exist");
        }
    }
}

#[test]
fn what_moves_knows_no_solver() {
    for module in ["integrators", "mechanics", "stabilisation", "scenes", "trajectory"].map(|name| format!("moreau-dynamics/{name}")) {
        let files: Vec<_> = library().into_iter().filter(|file| file.module() == module).collect();
        assert!(!files.is_empty(), "{module} has no file: the test looks at nothing");
        for file in files {
            assert!(!names_after(&file.code, &["moreau_contact::"]).contains(&"solvers".into()), "{} knows solvers", file.place());
        }
    }
}

#[test]
fn problems_and_certificates_know_no_solver() {
    let files = library();
    for (module, others) in [
        ("moreau-contact/problem", &["cones", "contact", "files", "operator"][..]),
        ("moreau-contact/certificate", &["problem", "cones", "operator", "fronts", "watch"]),
        ("moreau-contact/fronts", &["operator", "watch"]),
        ("moreau-contact/operator", &["contact"]),
        ("moreau-contact/cones", &[]),
        ("moreau-contact/files", &[]),
    ] {
        let allowed: Vec<_> = others.iter().map(|name| format!("moreau-contact/{name}")).chain(ground("moreau-contact")).collect();
        assert!(files.iter().any(|file| file.module() == module), "{module} has no file: the test looks at nothing");
        assert_eq!(strangers(&files, module, &allowed), Vec::<String>::new(), "{module} imports what it may not know");
    }
}

#[test]
fn small_numbers_stand_in_the_tables_of_tolerances_or_in_a_planted_defect() {
    let files = library();
    let planted = |file: &File| {
        ["moreau/defects", "moreau-checks/defects", "moreau-gate/planted"].contains(&file.module().as_str())
            || file.path.ends_with("energy_balance/defects.rs")
    };
    let elsewhere = files.iter().filter(|file| !file.module().ends_with("/tolerance") && !planted(file));
    let found: Vec<_> =
        elsewhere.flat_map(|file| small_literals(&file.code).into_iter().map(|number| format!("{}: {number}", file.place()))).collect();
    assert_eq!(found, Vec::<String>::new(), "a small number needs a name and a derivation in its crate's tolerances");
}

#[test]
fn every_tolerance_says_whether_it_is_derived_required_or_measured() {
    let (mut found, mut read) = (Vec::new(), 0);
    for room in ROOMS.into_iter().chain(["moreau"]) {
        let root = folder(room).join("src");
        let inside = |path: &PathBuf| path.starts_with(root.join("tolerance")) || path.ends_with("src/tolerance.rs");
        for path in rust_files(&root).into_iter().filter(inside) {
            let text = std::fs::read_to_string(&path).expect("a source file");
            let told = tolerances::complaints(&text, Path::new(env!("CARGO_MANIFEST_DIR")));
            found.extend(told.into_iter().map(|complaint| format!("{}: {complaint}", path.display())));
            read += 1;
        }
    }
    assert!(read > 40, "{read} files are not all tolerances");
    assert_eq!(found, Vec::<String>::new());
}

#[test]
fn clocks_are_read_only_to_report_run_times_and_to_end_an_engine_that_does_not_answer() {
    let files = library();
    let reading = files.iter().filter(|file| file.code.contains("Instant") || file.code.contains("SystemTime"));
    let places: Vec<_> = reading.map(File::place).collect();
    // the time limit decides whether there is a reply, never what it is
    assert_eq!(
        places,
        ["moreau-gate/process/deadline.rs", "moreau/claims/registry.rs", "moreau/cli/bench.rs"],
        "the same input gives the same output"
    );
}

/// Whether a source file reads or embeds a file of `references/`, at compile time or later.
fn takes_a_stored_run(text: &str) -> bool {
    let code: String = text.lines().filter(|line| !line.trim_start().starts_with("//")).collect();
    let reading = ["include_str!", "include_bytes!", "CARGO_MANIFEST_DIR"];
    code.contains("references/") && reading.iter().any(|way| code.contains(way))
}

#[test]
fn no_library_below_the_top_one_embeds_a_stored_run() {
    for room in ROOMS {
        for path in rust_files(&folder(room).join("src")) {
            let text = std::fs::read_to_string(&path).expect("a source file");
            assert!(!takes_a_stored_run(&text), "{} takes a stored run; hand it in", path.display());
        }
    }
    assert!(takes_a_stored_run("const RUN: &[u8] = include_bytes!(\"../../references/a.json\");"));
    assert!(!takes_a_stored_run("/// references/ holds them\nconst RUN: &str = include_str!(\"a.json\");"));
}

#[test]
fn a_module_with_children_is_the_folders_mod_rs() {
    let top = folder("moreau");
    let folders = ROOMS.iter().map(|room| folder(room).join("src")).chain(["src", "tests"].map(|name| top.join(name)));
    let files: Vec<_> = folders.flat_map(|folder| rust_files(&folder)).collect();
    let beside: Vec<_> = files.iter().filter(|path| path.with_extension("").is_dir()).collect();
    assert_eq!(beside, Vec::<&PathBuf>::new(), "a file beside the folder of its name; the others are mod.rs in it");
}

/// The lines of a source file that are longer than rustfmt's, which leaves comments and texts as they are, by number.
fn long_lines(text: &str) -> Vec<usize> {
    text.lines().enumerate().filter(|(_, line)| line.chars().count() > LINE).map(|(index, _)| index + 1).collect()
}

/// `max_width` of rustfmt.toml \[characters\].
const LINE: usize = 140;

#[test]
fn no_line_is_longer_than_the_others() {
    let top = folder("moreau");
    let others = ["src", "tests", "examples", "crates/moreau-python"].map(|name| top.join(name));
    let folders = ROOMS.iter().map(|room| folder(room)).chain(others);
    let files: Vec<_> = folders.filter(|folder| folder.exists()).flat_map(|folder| rust_files(&folder)).collect();
    let found = files.iter().flat_map(|path| {
        let text = std::fs::read_to_string(path).expect("a source file");
        long_lines(&text).into_iter().map(move |line| format!("{}:{line}", path.display()))
    });
    assert_eq!(found.collect::<Vec<_>>(), Vec::<String>::new(), "break the line");
    assert_eq!(long_lines(&format!("{}\n{}", "½".repeat(LINE), "½".repeat(LINE + 1))), [2]);
}

#[test]
fn the_rules_can_fail() {
    let planted = |path: &str, code: &str| File { room: "moreau-contact".into(), path: path.into(), code: strip(code) };
    let files = [
        planted("problem/law.rs", "use crate::solvers::Auto;"),
        planted("problem/mod.rs", "use super::certificate::Judge; use crate::problem::x;"),
        planted("cones/orthant.rs", "use crate::problem::Law; use crate::ContactProblem;"),
    ];
    let expected = ["moreau-contact/problem/law.rs: moreau-contact/solvers", "moreau-contact/problem/mod.rs: moreau-contact/certificate"];
    assert_eq!(strangers(&files, "moreau-contact/problem", &ground("moreau-contact")), expected);
    assert_eq!(
        strangers(&files, "moreau-contact/cones", &ground("moreau-contact")),
        ["moreau-contact/cones/orthant.rs: moreau-contact/ContactProblem", "moreau-contact/cones/orthant.rs: moreau-contact/problem"]
    );
    let manifest = "[dependencies]\nmoreau-exact = { path = \"\" }\nserde = \"1\"\n[dev-dependencies]\nmoreau-gate = \"0\"\n\
                    [target.'cfg(unix)'.dependencies]\nmoreau-forms = \"0\"\n";
    assert_eq!(named(manifest, "dependencies"), ["moreau-exact", "moreau-forms"]);
    assert_eq!(named(manifest, "dev-dependencies"), ["moreau-gate"]);
}
