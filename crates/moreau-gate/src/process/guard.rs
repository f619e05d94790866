//! A shell that outlives a gate which is killed, and then ends the engine's group.
//!
//! It waits for the end of its standard input, whose other end the gate alone holds: when the gate is gone, however it went, the pipe is
//! closed.

use std::io;
use std::os::unix::process::CommandExt;
use std::process::{Child, Command, Stdio};

/// What the shell does: wait, then kill the group $1.
const SCRIPT: &str = "read -r _; kill -s KILL -- \"-$1\" 2> /dev/null";

/// The waiting shell; called off when it is dropped.
pub(super) struct Guard(Child);

impl Guard {
    /// A guard of the process group with this number.
    pub(super) fn of(group: u32) -> io::Result<Guard> {
        let mut command = Command::new("/bin/sh");
        command.args(["-c", SCRIPT, "sh", &group.to_string()]);
        // in a group of its own: what interrupts the gate must not end the guard first
        command.process_group(0).stdin(Stdio::piped()).stdout(Stdio::null()).stderr(Stdio::null());
        command.spawn().map(Guard)
    }
}

impl Drop for Guard {
    fn drop(&mut self) {
        // the group is gone already, and its number may be another's soon
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}
