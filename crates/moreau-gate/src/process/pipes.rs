//! The threads at a child's pipes. Each holds a bounded amount of memory, whatever the child does, and ends with its pipe.

use crate::process::words;
use std::collections::VecDeque;
use std::io::{ErrorKind, Read, Write};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, SyncSender, channel, sync_channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::time::Duration;

/// Bytes read at once.
const CHUNK: usize = 64 << 10;
/// Bytes of standard error that are kept.
const TAIL: usize = 64 << 10;
/// Lines that may wait to be looked at; a child that writes more has to wait itself.
const WAITING: usize = 2;

/// What happened at the pipes.
pub(super) enum Event {
    /// A whole line, and whether more had been written behind it.
    Line { line: Vec<u8>, followed: bool },
    /// A line beyond the limit, with its beginning; nothing more is read.
    TooLong(String),
    /// The end of standard output, with the beginning of an unfinished line.
    Ended(String),
    /// Standard input was closed by the child.
    NotRead,
}

/// The beginning of the line that is being read.
pub(super) type Begun = Arc<Mutex<String>>;

/// Reads lines of at most `limit` bytes.
pub(super) fn read_lines(pipe: impl Read + Send + 'static, limit: usize) -> (SyncSender<Event>, Receiver<Event>, Begun) {
    let (sender, receiver) = sync_channel(WAITING);
    let begun = Begun::default();
    let (events, shared) = (sender.clone(), begun.clone());
    // the loop ends early if the receiver is dropped, and the pipe closes
    thread::spawn(move || Lines { pipe, limit, line: Vec::new(), begun: shared, events }.run());
    (sender, receiver, begun)
}

struct Lines<R> {
    pipe: R,
    limit: usize,
    line: Vec<u8>,
    begun: Begun,
    events: SyncSender<Event>,
}

impl<R: Read> Lines<R> {
    fn run(mut self) -> Option<()> {
        let mut chunk = vec![0; CHUNK];
        loop {
            let count = read(&mut self.pipe, &mut chunk);
            if count == 0 {
                return self.send(Event::Ended(words::beginning(&self.line)));
            }
            let mut rest = &chunk[..count];
            while let Some(end) = rest.iter().position(|&byte| byte == b'\n') {
                self.append(&rest[..end])?;
                rest = &rest[end + 1..];
                let line = std::mem::take(&mut self.line);
                self.note();
                self.send(Event::Line { line, followed: !rest.is_empty() })?;
            }
            self.append(rest)?;
            self.note();
        }
    }

    /// Lengthens the line, within the limit.
    fn append(&mut self, part: &[u8]) -> Option<()> {
        if self.line.len() + part.len() > self.limit {
            self.send(Event::TooLong(words::beginning(if self.line.is_empty() { part } else { &self.line })))?;
            return None;
        }
        self.line.extend_from_slice(part);
        Some(())
    }

    fn note(&self) {
        *self.begun.lock().unwrap_or_else(PoisonError::into_inner) = words::beginning(&self.line);
    }

    fn send(&self, event: Event) -> Option<()> {
        self.events.send(event).ok()
    }
}

/// The number of bytes read; 0 at the end, and if the pipe cannot be read, which is the same to us.
fn read(pipe: &mut impl Read, chunk: &mut [u8]) -> usize {
    loop {
        match pipe.read(chunk) {
            Err(error) if error.kind() == ErrorKind::Interrupted => {}
            outcome => return outcome.unwrap_or(0),
        }
    }
}

/// Writes what is sent; ends, and closes the pipe, when the sender is dropped.
pub(super) fn write_lines(mut pipe: impl Write + Send + 'static, events: SyncSender<Event>) -> Sender<Vec<u8>> {
    let (sender, lines) = channel::<Vec<u8>>();
    thread::spawn(move || {
        for line in lines {
            if pipe.write_all(&line).and_then(|()| pipe.flush()).is_err() {
                // the child does not read its input: the session is over
                let _ = events.send(Event::NotRead);
                return;
            }
        }
    });
    sender
}

/// The last bytes of a child's standard error.
pub(super) struct Tail {
    bytes: Arc<Mutex<VecDeque<u8>>>,
    /// Closed when the pipe is.
    open: Receiver<()>,
}

impl Tail {
    /// Reads to the end and keeps the last 64 KiB.
    pub(super) fn of(mut pipe: impl Read + Send + 'static) -> Tail {
        let bytes = Arc::new(Mutex::new(VecDeque::new()));
        let (closing, open) = channel::<()>();
        let kept = bytes.clone();
        thread::spawn(move || {
            let _closing = closing;
            let mut chunk = vec![0; CHUNK];
            loop {
                let count = read(&mut pipe, &mut chunk);
                // the gate has let go of this child, or it has ended
                if count == 0 || Arc::strong_count(&kept) == 1 {
                    return;
                }
                let mut bytes = kept.lock().unwrap_or_else(PoisonError::into_inner);
                bytes.extend(&chunk[..count]);
                let excess = bytes.len().saturating_sub(TAIL);
                bytes.drain(..excess);
            }
        });
        Tail { bytes, open }
    }

    /// The last lines, once the pipe is closed or the limit is over.
    pub(super) fn last_lines(&self, limit: Duration) -> String {
        let waited = self.open.recv_timeout(limit);
        debug_assert!(matches!(waited, Err(RecvTimeoutError::Timeout | RecvTimeoutError::Disconnected)));
        let bytes: Vec<u8> = self.bytes.lock().unwrap_or_else(PoisonError::into_inner).iter().copied().collect();
        words::last_lines(&bytes)
    }
}
