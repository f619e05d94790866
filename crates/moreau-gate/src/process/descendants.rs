//! The processes that a process has started, and those that these have started, wherever they have put themselves.
//!
//! A child that makes a process group of its own is out of reach of a signal to its parent's group. As long as its ancestors live, the
//! table of processes leads to it. A daemon, whose parent has ended, is out of reach of both.

use std::path::Path;

/// The living descendants of a process, children before grandchildren; nothing where the system has no `/proc`.
pub(super) fn descendants(ancestor: u32) -> Vec<u32> {
    let table = table();
    let mut found = vec![ancestor];
    let mut next = 0;
    while let Some(parent) = found.get(next).copied() {
        found.extend(table.iter().filter(|(_, of)| *of == parent).map(|(id, _)| *id));
        next += 1;
    }
    found.split_off(1)
}

/// (process, its parent) for all processes.
fn table() -> Vec<(u32, u32)> {
    let Ok(entries) = std::fs::read_dir("/proc") else { return Vec::new() };
    let numbers = entries.filter_map(|entry| entry.ok()?.file_name().to_str()?.parse::<u32>().ok());
    numbers.filter_map(|id| Some((id, parent(&Path::new("/proc").join(id.to_string()).join("stat"))?))).collect()
}

/// The parent in a line `id (name) state parent …`; a name may have spaces and brackets.
fn parent(stat: &Path) -> Option<u32> {
    let line = std::fs::read_to_string(stat).ok()?;
    line.rsplit_once(')')?.1.split_whitespace().nth(1)?.parse().ok()
}

/// Ends a process at once; one that is gone already need not be ended.
#[cfg(unix)]
pub(super) fn end(id: u32) {
    use nix::sys::signal::{Signal, kill};
    if let Ok(id) = i32::try_from(id) {
        let _ = kill(nix::unistd::Pid::from_raw(id), Signal::SIGKILL);
    }
}
