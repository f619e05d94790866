//! What a child wrote, short enough for a report and without characters that would steer a terminal.

use std::io::{Error, ErrorKind};
use std::path::{MAIN_SEPARATOR, Path};

/// Characters of a line that a report shows.
const BEGINNING: usize = 120;
/// Lines of standard error that a report shows.
const LINES: usize = 8;
/// Characters of a message that a report shows.
const MESSAGE: usize = 2000;

/// The beginning of a line.
pub(super) fn beginning(line: &[u8]) -> String {
    let head = &line[..line.len().min(4 * BEGINNING)];
    shortened(&String::from_utf8_lossy(head), BEGINNING)
}

/// A message of an engine.
pub(super) fn message(text: &str) -> String {
    shortened(text.trim(), MESSAGE)
}

/// Why a command cannot be started, and what to do about it.
pub(super) fn not_started(command: &[String], error: &Error) -> String {
    let program = command.first().map_or("", String::as_str);
    let shown = shortened(program, BEGINNING);
    let is_path = program.contains(MAIN_SEPARATOR);
    match error.kind() {
        _ if is_path && Path::new(program).is_dir() => format!("`{shown}` is a folder; name a program in it"),
        ErrorKind::NotFound if is_path => {
            format!("there is no program `{shown}`; look at its path, which begins in the folder of this command")
        }
        ErrorKind::NotFound => format!("there is no program `{shown}` on the search path; install it, or give its path, as `./{shown}`"),
        ErrorKind::PermissionDenied => {
            format!("`{shown}` may not be run; make it a program (chmod +x), or name first what runs it, as `python3 {shown}`")
        }
        // a text without its first line, or a program of another machine
        _ => format!("`{shown}` is no program of this machine ({error}); name first what runs it, as `python3 {shown}`"),
    }
}

/// The last lines that are not blank, joined by ` | `.
pub(super) fn last_lines(bytes: &[u8]) -> String {
    let text = String::from_utf8_lossy(bytes);
    let mut lines: Vec<_> = text.lines().rev().map(str::trim).filter(|line| !line.is_empty()).take(LINES).collect();
    lines.reverse();
    let joined = lines.join(" | ");
    let excess = joined.chars().count().saturating_sub(MESSAGE);
    let kept: String = joined.chars().skip(excess).collect();
    if excess > 0 { format!("…{}", plain(&kept)) } else { plain(&kept) }
}

fn shortened(text: &str, limit: usize) -> String {
    let mut head: String = text.chars().take(limit).collect();
    if text.chars().nth(limit).is_some() {
        head.push('…');
    }
    plain(&head)
}

fn plain(text: &str) -> String {
    text.chars().map(|letter| if letter.is_control() && letter != '\t' { '\u{fffd}' } else { letter }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_long_is_cut_and_what_steers_a_terminal_is_replaced() {
        assert_eq!(beginning(b"{\"id\": 7}"), "{\"id\": 7}");
        assert_eq!(beginning("ä".repeat(121).as_bytes()), format!("{}…", "ä".repeat(120)));
        assert_eq!(beginning(b"\x1b[2J\xff"), "\u{fffd}[2J\u{fffd}");
        assert_eq!(message(&"x".repeat(2000)).chars().count(), 2000);
        assert_eq!(message(&"x".repeat(2001)).chars().count(), 2001);
    }

    #[test]
    fn what_cannot_be_started_is_told_by_its_name_with_a_cure() {
        let command = |program: &str| vec![program.to_string(), "--stdio".into()];
        let told = |program: &str, number: i32| not_started(&command(program), &Error::from_raw_os_error(number));
        assert!(told("./engine", 2).contains("no program `./engine`; look at its path"));
        assert!(told("engine", 2).contains("no program `engine` on the search path; install it"));
        assert!(told("engine.py", 13).contains("`engine.py` may not be run") && told("engine.py", 13).contains("python3 engine.py"));
        assert!(told("./engine", 8).contains("no program of this machine"));
        assert!(told("./", 13).contains("`./` is a folder; name a program in it"));
    }

    #[test]
    fn of_standard_error_the_last_lines_stay() {
        let text: String = (0..20).map(|k| format!("line {k}\n\n")).collect();
        let kept = last_lines(text.as_bytes());
        assert!(kept.starts_with("line 12 |") && kept.ends_with("| line 19"), "{kept}");
        assert_eq!(last_lines(b""), "");
        let long = last_lines(&[b"x".repeat(3000), b" end".to_vec()].concat());
        assert!(long.starts_with('…') && long.ends_with(" end") && long.chars().count() == 2001);
    }
}
