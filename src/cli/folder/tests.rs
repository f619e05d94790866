//! What may be written where, what stays, and what is told.

use super::*;

/// An empty folder of this test, which goes away with it.
struct Empty(PathBuf);

impl Empty {
    fn new(name: &str) -> Self {
        let folder = std::env::temp_dir().join(format!("moreau-report-{name}-{}", std::process::id()));
        fs::create_dir(&folder).expect("a new folder");
        Empty(folder)
    }

    fn names(&self) -> Vec<String> {
        files(&self.0, "").expect("readable")
    }
}

impl Drop for Empty {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

fn report(names: &[&str]) -> Vec<File> {
    let marker = serde_json::json!({"schema": SCHEMA, "files": names}).to_string();
    let mut files: Vec<File> = names.iter().map(|name| File { path: (*name).into(), text: "text".into() }).collect();
    files.push(File { path: FILE.into(), text: marker });
    files
}

fn refusal(folder: &Path) -> String {
    Target::new(folder, |_| {}).map(|_| ()).expect_err("refused").to_string()
}

#[test]
fn a_report_is_written_and_replaced_whole() {
    let room = Empty::new("whole");
    let folder = room.0.join("report");
    for names in [&["index.html", "zh/index.html"][..], &["index.html"]] {
        Target::new(&folder, |_| {}).expect("new or a report").write(&report(names), |_| {}).expect("writable");
        let expected: Vec<String> = names.iter().copied().chain([FILE]).map(|name| format!("report/{name}")).collect();
        let mut found = room.names();
        found.sort_by_key(|name| expected.iter().position(|one| one == name));
        assert_eq!(found, expected);
    }
}

#[test]
fn an_empty_folder_is_taken_and_one_with_something_else_is_not() {
    let room = Empty::new("other");
    assert!(Target::new(&room.0, |_| {}).is_ok());
    fs::write(room.0.join("thesis.tex"), "text").expect("writable");
    let message = refusal(&room.0);
    assert!(message.contains("thesis.tex") && message.contains("name a new or an empty folder"), "{message}");
}

#[test]
fn what_stands_in_a_report_and_is_not_of_it_is_kept() {
    let room = Empty::new("kept");
    let folder = room.0.join("report");
    Target::new(&folder, |_| {}).expect("new").write(&report(&["index.html"]), |_| {}).expect("writable");
    fs::write(folder.join("notes.txt"), "mine").expect("writable");
    assert!(refusal(&folder).contains("notes.txt"));
    fs::write(folder.join(FILE), r#"{"schema": "other/1", "files": ["index.html", "notes.txt"]}"#).expect("writable");
    assert!(Target::new(&folder, |_| {}).is_err(), "another program's report.json marks no report of ours");
}

#[test]
fn a_file_that_some_program_put_into_a_report_is_named_with_the_cure() {
    let room = Empty::new("cure");
    let folder = room.0.join("report");
    Target::new(&folder, |_| {}).expect("new").write(&report(&["index.html"]), |_| {}).expect("writable");
    let dropped = folder.join(".DS_Store");
    fs::write(&dropped, "icons").expect("writable");
    let message = refusal(&folder);
    assert!(message.contains(&format!("take {} away", dropped.display())) && message.contains("is replaced"), "{message}");
    fs::remove_file(&dropped).expect("writable");
    assert!(Target::new(&folder, |_| {}).is_ok(), "the cure cures");
}

/// The target, and what was told.
fn told(folder: &Path) -> (Result<Target>, Vec<String>) {
    let mut told = Vec::new();
    let target = Target::new(folder, |text| told.push(text.to_string()));
    (target, told)
}

/// A room with a report where a stopped run had set it aside, and nothing in its place.
fn stopped(name: &str) -> (Empty, PathBuf) {
    let room = Empty::new(name);
    let folder = room.0.join("report");
    Target::new(&folder, |_| {}).expect("new").write(&report(&["index.html"]), |_| {}).expect("writable");
    fs::rename(&folder, room.0.join(".report.old-7")).expect("writable");
    (room, folder)
}

#[test]
fn a_report_that_a_stopped_run_set_aside_is_put_back_and_what_else_it_left_is_told() {
    let (room, folder) = stopped("stopped");
    // what it was to be replaced by is whole, too
    Target::new(&room.0.join("other"), |_| {}).expect("new").write(&report(&["new.html"]), |_| {}).expect("writable");
    fs::rename(room.0.join("other"), room.0.join(".report.new-7")).expect("writable");
    fs::create_dir(room.0.join(".report.new-mine")).expect("writable");
    let (target, told) = told(&folder);
    assert!(target.is_ok() && folder.join("index.html").is_file());
    assert!(told.len() == 2 && told[0].contains("put the report back") && told[0].contains(".report.old-7"), "{told:?}");
    assert!(told[1].contains(".report.new-7") && told[1].contains("take it away"), "{told:?}");
    assert!(room.0.join(".report.new-7/new.html").is_file() && room.0.join(".report.new-mine").is_dir());
}

#[test]
fn a_part_of_a_report_is_not_put_back_and_what_is_somebodys_is_not_advised_away() {
    let (room, folder) = stopped("part");
    fs::remove_file(room.0.join(".report.old-7/index.html")).expect("there");
    let (_, said) = told(&folder);
    assert!(!folder.exists() && said.len() == 1 && said[0].contains("take it away"), "{said:?}");
    fs::write(room.0.join(".report.old-7/thesis.tex"), "mine").expect("writable");
    let (_, said) = told(&folder);
    assert!(!folder.exists() && said.len() == 1 && said[0].contains("thesis.tex") && said[0].contains("look at it before"), "{said:?}");
}

#[test]
fn what_was_left_is_told_where_the_folder_is_refused_as_well() {
    let (_room, folder) = stopped("refused");
    fs::create_dir(&folder).expect("writable");
    fs::write(folder.join("thesis.tex"), "mine").expect("writable");
    let (target, said) = told(&folder);
    assert!(target.is_err() && said.len() == 1, "{said:?}");
}

#[test]
fn a_number_that_is_taken_is_not_used_again() {
    let room = Empty::new("taken");
    let folder = room.0.join("report");
    let taken = room.0.join(format!(".report.new-{}", std::process::id()));
    fs::create_dir(&taken).expect("writable");
    fs::write(taken.join("index.html"), "of another run").expect("writable");
    let target = Target::new(&folder, |_| {}).expect("another number");
    // somebody takes the next one, too, while the report is computed
    let mine = target.beside(Left::New);
    fs::create_dir(&mine).expect("writable");
    assert!(target.write(&report(&["index.html"]), |_| {}).is_err());
    assert!(mine.is_dir() && taken.join("index.html").is_file(), "what others made stays");
}

#[test]
fn what_was_set_aside_is_not_put_over_what_stands_there() {
    let (room, folder) = stopped("both");
    Target::new(&room.0.join("other"), |_| {}).expect("another name").write(&report(&["index.html"]), |_| {}).expect("writable");
    fs::rename(room.0.join("other"), &folder).expect("writable");
    let (target, told) = told(&folder);
    assert!(target.is_ok() && told[0].contains(".report.old-7") && room.0.join(".report.old-7/index.html").is_file());
}

#[test]
fn what_can_be_put_aside_still_stands_where_it_was() {
    let room = Empty::new("aside");
    let folder = room.0.join("report");
    fs::create_dir(&folder).expect("writable");
    assert!(Target::new(&folder, |_| {}).is_ok());
    assert_eq!(room.names(), ["report/"]);
}

#[test]
fn what_cannot_be_put_aside_is_refused_before_anything_is_computed() {
    let room = Empty::new("mount");
    let busy = |_: &Path, _: &Path| Err(io::Error::from(io::ErrorKind::ResourceBusy)); // as a mount point answers
    let message = Target::checked(&room.0, |_| {}, busy).map(|_| ()).expect_err("refused").to_string();
    assert!(message.contains("mount point") && message.contains("name a folder inside of it"), "{message}");
    assert!(Target::checked(&room.0.join("new"), |_| {}, busy).is_ok(), "nothing is put aside where nothing stands");
}

#[test]
fn what_is_put_there_while_the_report_is_computed_is_kept() {
    let room = Empty::new("meanwhile");
    let folder = room.0.join("report");
    let target = Target::new(&folder, |_| {}).expect("new");
    fs::create_dir(&folder).expect("writable");
    fs::write(folder.join("thesis.tex"), "mine").expect("writable");
    let message = target.write(&report(&["index.html"]), |_| {}).expect_err("refused").to_string();
    assert!(message.contains("thesis.tex"), "{message}");
    assert_eq!(room.names(), ["report/thesis.tex"]);
    fs::remove_file(folder.join("thesis.tex")).expect("writable");
    fs::create_dir(folder.join("mine")).expect("writable");
    assert!(target.write(&report(&["index.html"]), |_| {}).is_err(), "an empty folder is somebody's as well");
}

#[test]
fn a_file_and_a_folder_in_no_folder_are_refused() {
    let room = Empty::new("file");
    let file = room.0.join("file");
    fs::write(&file, "text").expect("writable");
    assert!(refusal(&file).contains("no folder"));
    assert!(refusal(&room.0.join("none").join("report")).contains("make that folder first"));
    assert!(refusal(Path::new("..")).contains("no name of a folder"));
}

#[test]
fn what_cannot_be_written_leaves_what_stood_there() {
    let room = Empty::new("broken");
    let folder = room.0.join("report");
    let target = Target::new(&folder, |_| {}).expect("new");
    target.write(&report(&["index.html"]), |_| {}).expect("writable");
    let before = room.names();
    let twice = ["index.html", "index.html/page.html"]; // a file and a folder of one name
    assert!(target.write(&report(&twice), |_| {}).is_err());
    assert_eq!(room.names(), before);
}
