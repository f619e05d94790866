//! How much time and memory an engine may take.

use std::time::Duration;

/// Limits of a child process that speaks the protocol.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// From writing a request to the end of its reply.
    pub reply: Duration,
    /// The same for the first request, which begins with the start of the program.
    pub start: Duration,
    /// Bytes of a line, without its end.
    pub line: usize,
    /// How long it may take to end after `bye`, or after it closed its standard output.
    pub farewell: Duration,
}

impl Default for Limits {
    /// 60 s, 60 s, 256 MiB, 2 s.
    fn default() -> Self {
        Limits { reply: Duration::from_secs(60), start: Duration::from_secs(60), line: 256 << 20, farewell: Duration::from_secs(2) }
    }
}
