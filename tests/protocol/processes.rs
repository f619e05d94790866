//! Whether a process is still there.

use std::path::PathBuf;
use std::process::Command;
use std::time::Duration;

/// Fails unless the process has ended or is about to; a zombie that its new parent has not collected has ended.
pub fn assert_gone(id: u32) {
    for _ in 0..100 {
        if !runs(id) {
            return;
        }
        std::thread::sleep(Duration::from_millis(50));
    }
    panic!("process {id} is still there");
}

/// Whether the process runs.
pub fn runs(id: u32) -> bool {
    let state = match std::fs::read_to_string(PathBuf::from(format!("/proc/{id}/stat"))) {
        Ok(line) => line.rsplit(") ").next().map(String::from),
        Err(_) if PathBuf::from("/proc/self/stat").exists() => None,
        Err(_) => {
            let output = Command::new("ps").args(["-o", "stat=", "-p", &id.to_string()]).output().expect("ps runs");
            Some(String::from_utf8_lossy(&output.stdout).trim().to_string()).filter(|state| !state.is_empty())
        }
    };
    state.is_some_and(|state| !state.starts_with('Z') && !state.starts_with('X'))
}

/// The largest memory this process has used so far \[KiB\], where the system tells.
pub fn peak_memory() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    line.split_whitespace().nth(1)?.parse().ok()
}

/// A file for a process number, of its own for one test, removed at its end.
pub struct File(PathBuf);

impl File {
    /// A file that is not there yet.
    pub fn new(test: &str) -> Self {
        File(PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("process-{test}-{}", std::process::id())))
    }

    /// Its path, as an argument.
    pub fn path(&self) -> &str {
        self.0.to_str().expect("UTF-8")
    }

    /// The number in it, once it is written.
    pub fn number(&self) -> Option<u32> {
        std::fs::read_to_string(&self.0).ok()?.parse().ok()
    }
}

impl Drop for File {
    fn drop(&mut self) {
        let _ = std::fs::remove_file(&self.0);
    }
}
