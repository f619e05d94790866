//! The examples of the pages of `docs/`: commands are run and print what the page shows, or the page says why they are not run here;
//! data can be read.
//!
//! ```text
//!     sh      a line is a command of `moreau`, run in a folder of the page; or above the block stands <!-- not run: REASON -->,
//!             or <!-- run by SCRIPT -->; <!-- exit code 1 --> above it where the answer is no
//!     text    the first one after it in its section is what it printed: its lines, in this order; … stands for lines left out
//!     json    can be read; where the line before ends with `FILE`: it is written there before the next command; so is toml
//!     rust    is a documentation test (tests/readme.rs); everything else says by a comment why it is not run, or by what
//! ```

mod blocks;
mod tolerances;

use blocks::{Block, blocks};
use std::path::{Path, PathBuf};
use std::process::Command;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// The pages of `docs/` and those beside it that show commands; the README has a test of its own.
fn pages() -> Vec<PathBuf> {
    let mut pages = vec![root().join("CONTRIBUTING.md"), root().join("references/README.md")];
    below(&root().join("docs"), &mut pages);
    pages
}

fn below(folder: &Path, pages: &mut Vec<PathBuf>) {
    let mut entries: Vec<_> = std::fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("readable").path()).collect();
    entries.sort();
    for path in entries {
        if path.is_dir() {
            below(&path, pages);
        } else if path.extension().is_some_and(|ending| ending == "md") {
            pages.push(path);
        }
    }
}

/// Whether a comment says why a block is not run here, or what runs it: a file that exists and names the page.
fn is_excused(comment: Option<&str>, page: &Path) -> bool {
    let Some(comment) = comment else { return false };
    if let Some(reason) = comment.strip_prefix("not run: ") {
        return reason.len() > 10;
    }
    let name = page.file_name().expect("a file").to_string_lossy();
    let script = comment.strip_prefix("run by ").and_then(|rest| rest.split(';').next());
    script.is_some_and(|script| {
        let text = std::fs::read_to_string(root().join(script)).unwrap_or_default();
        text.contains(name.as_ref())
    })
}

/// What a page's commands printed, and what was wrong with them.
struct Folder {
    path: PathBuf,
    printed: Option<(String, usize)>,
    wrong: Vec<String>,
}

impl Folder {
    /// A folder of its own for a page.
    fn of(page: &Path) -> Self {
        let name = format!("page-{}-{}", std::process::id(), page.file_stem().expect("a name").to_string_lossy());
        let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
        std::fs::create_dir_all(&path).expect("the target directory is writable");
        Folder { path, printed: None, wrong: Vec::new() }
    }

    /// One command of `moreau`; what it prints is kept.
    fn run(&mut self, command: &str, code: i32) -> String {
        let Some(arguments) = command.strip_prefix("moreau ") else {
            self.wrong.push(format!("no command of moreau, and nothing says why it is not run: {command}"));
            return String::new();
        };
        let moreau = Path::new(env!("CARGO_BIN_EXE_moreau"));
        // the engine after `--` is `moreau` again, found in this folder alone: nothing else is needed
        let path = moreau.parent().expect("a folder");
        let run = Command::new(moreau).args(arguments.split_whitespace()).current_dir(&self.path).env("PATH", path).output();
        let run = run.expect("the built command starts");
        if run.status.code() != Some(code) {
            self.wrong.push(format!("{command}: {:?}: {}", run.status.code(), String::from_utf8_lossy(&run.stderr)));
        }
        String::from_utf8(run.stdout).expect("output is UTF-8")
    }

    /// Runs a block of commands.
    fn commands(&mut self, block: &Block) {
        let code = block.comment.and_then(|comment| comment.strip_prefix("exit code ")).map_or(0, |code| code.parse().expect("a number"));
        let lines = block.text.lines().map(|line| line.split(" #").next().unwrap_or_default().trim()).filter(|line| !line.is_empty());
        let lines: Vec<&str> = lines.collect();
        let last = lines.len().saturating_sub(1);
        let printed = lines.iter().enumerate().map(|(k, line)| self.run(line, if k == last { code } else { 0 })).collect();
        self.printed = Some((printed, block.section));
    }

    /// Holds a block of text to what the commands before it printed.
    fn shown(&mut self, block: &Block) -> bool {
        let Some((printed, _)) = self.printed.take().filter(|(_, section)| *section == block.section) else { return false };
        if let Some(line) = missing(block.text, &printed) {
            self.wrong.push(format!("not printed in this place: {line}\n{printed}"));
        }
        true
    }

    fn see(&mut self, block: &Block, page: &Path) -> [usize; 2] {
        match block.language {
            "sh" if is_excused(block.comment, page) => self.printed = None,
            "sh" => {
                self.commands(block);
                return [1, 0];
            }
            "text" => return [0, usize::from(self.shown(block))],
            "json" | "toml" => self.data(block),
            language if language.starts_with("rust") || is_excused(block.comment, page) => {}
            language => self.wrong.push(format!("a block in `{language}` that nothing runs: {}", block.text)),
        }
        [0, 0]
    }

    /// Data can be read; where they have a name they become a file.
    fn data(&mut self, block: &Block) {
        let read = match block.language {
            "json" => serde_json::from_str::<serde_json::Value>(block.text).map(|_| ()).map_err(|error| error.to_string()),
            _ => toml::from_str::<toml::Table>(block.text).map(|_| ()).map_err(|error| error.to_string()),
        };
        if let Err(error) = read {
            self.wrong.push(format!("{error}: {}", block.text));
        }
        if let Some(name) = block.file {
            std::fs::write(self.path.join(name), block.text).expect("a writable folder");
        }
    }
}

/// The first line that was not printed after the line before it; `…` stands for any lines.
fn missing<'a>(shown: &'a str, printed: &str) -> Option<&'a str> {
    let printed: Vec<&str> = printed.lines().map(str::trim_end).collect();
    let (mut place, mut anywhere) = (0, true);
    for line in shown.lines().map(str::trim_end) {
        if line == "…" {
            anywhere = true;
            continue;
        }
        let far = if anywhere { printed.len() } else { printed.len().min(place + 1) };
        match (place..far).find(|at| printed[*at] == line) {
            Some(at) => place = at + 1,
            None => return Some(line),
        }
        anywhere = false;
    }
    None
}

/// What is wrong with a page, and how many blocks were run and compared.
fn judge(page: &Path, text: &str) -> (Vec<String>, [usize; 2]) {
    let mut folder = Folder::of(page);
    let counts = blocks(text).iter().map(|block| folder.see(block, page)).fold([0, 0], |[a, b], [c, d]| [a + c, b + d]);
    std::fs::remove_dir_all(&folder.path).expect("nobody else uses it");
    let name = page.strip_prefix(root()).unwrap_or(page).display().to_string();
    (folder.wrong.into_iter().map(|wrong| format!("{name}: {wrong}")).collect(), counts)
}

#[test]
fn every_example_of_the_pages_is_run_or_says_why_not() {
    let judged: Vec<_> = pages().iter().map(|page| judge(page, &std::fs::read_to_string(page).expect("UTF-8"))).collect();
    let [run, compared] = judged.iter().fold([0, 0], |[a, b], (_, [c, d])| [a + c, b + d]);
    let wrong: Vec<String> = judged.into_iter().flat_map(|(wrong, _)| wrong).collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n\n"));
    assert!(run >= 8 && compared >= 6, "{run} blocks run, {compared} compared");
}

#[test]
fn a_page_with_a_mistake_is_noticed() {
    let solve = "`p.json`:\n```json\n{\"schema\": \"lcp/1\", \"matrix\": {\"shape\": [1, 1], \"rows\": [[2]]}, \"vector\": [-1]}\n```\n\
        ```sh\nmoreau solve p.json --out a.json # solves\nmoreau certify p.json a.json\n```\n";
    let wrong = |text: &str| judge(Path::new("planted.md"), text).0.len();
    assert_eq!(wrong(solve), 0);
    assert_eq!(wrong(&format!("{solve}```text\nno such line\n```\n")), 1);
    assert_eq!(wrong(&solve.replace("a.json\n```\n", "b.json\n```\n")), 1, "a file that is not there");
    assert_eq!(wrong(&solve.replace("```sh", "<!-- exit code 1 -->\n```sh")), 1, "another exit code");
    assert_eq!(wrong("```sh\npip install x\n```\n"), 1);
    assert_eq!(wrong("<!-- not run: it needs the network -->\n```sh\npip install x\n```\n"), 0);
    assert_eq!(wrong("<!-- run by scripts/nowhere.py -->\n```sh\npip install x\n```\n"), 1);
    assert_eq!(wrong("```python\nx\n```\n") + wrong("```json\n{\n```\n") + wrong("```toml\na = \n```\n"), 3);
}

#[test]
fn shown_lines_must_follow_each_other_unless_lines_are_left_out() {
    let printed = "a\nb \nc\nd\n";
    for shown in ["b\nc", "a\n…\nc\nd", "…\nd"] {
        assert_eq!(missing(shown, printed), None, "{shown}");
    }
    for (shown, line) in [("a\nc", "c"), ("c\nb", "b"), ("a\n…\ne", "e"), ("…\nc\n…\nb", "b")] {
        assert_eq!(missing(shown, printed), Some(line), "{shown}");
    }
}
