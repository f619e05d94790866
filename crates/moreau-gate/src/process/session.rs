//! One life of a child process: lines in, lines out, until something is wrong with it.

use crate::process::deadline::Deadline;
use crate::process::group::Group;
use crate::process::pipes::{Begun, Event, Tail, read_lines, write_lines};
use crate::process::{Limits, words};
use std::fmt;
use std::process::ExitStatus;
use std::sync::PoisonError;
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, TryRecvError};
use std::time::Duration;

/// How often to look whether a silent child has ended.
const LOOK: Duration = Duration::from_millis(100);

/// A running child with its pipes.
pub struct Session {
    group: Group,
    /// Closed, it ends the child's standard input.
    requests: Option<Sender<Vec<u8>>>,
    events: Receiver<Event>,
    begun: Begun,
    errors: Tail,
    limits: Limits,
    /// Whether it has replied once.
    has_replied: bool,
}

/// Why a session is over.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault {
    /// What happened.
    pub cause: Fate,
    /// The last lines of standard error.
    pub last_words: String,
}

/// What a child did wrong.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Fate {
    /// The program is not there or may not be run; the text names it.
    NotStarted(String),
    /// The child wrote no whole line within the time limit; the texts are the limit and the beginning of the unfinished line.
    TimedOut(String, String),
    /// The child ended with this status; the text is the beginning of an unfinished line, if there is one.
    Ended(ExitStatus, String),
    /// The child closed its standard output but still runs; the text is the beginning of an unfinished line, if there is one.
    Closed(String),
    /// The child closed its standard input but still runs.
    NotRead,
    /// The child wrote a line of more than this many bytes; the text is the beginning of that line.
    TooLong(usize, String),
    /// The child wrote this line without a request.
    Unsolicited(String),
    /// The child wrote more than one line in reply to one request; the text is the first line.
    Followed(String),
    /// The line is not the reply; the words say what is wrong with it.
    Malformed(String),
}

impl Session {
    /// Starts a program.
    ///
    /// # Errors
    /// [`Fate::NotStarted`].
    pub fn start(command: &[String], limits: Limits) -> Result<Session, Fault> {
        let not_started = |error| Fault { cause: Fate::NotStarted(words::not_started(command, &error)), last_words: String::new() };
        let (group, streams) = Group::start(command).map_err(not_started)?;
        let (sender, events, begun) = read_lines(streams.output, limits.line);
        let requests = Some(write_lines(streams.input, sender));
        Ok(Session { group, requests, events, begun, errors: Tail::of(streams.errors), limits, has_replied: false })
    }

    /// The process number of the child.
    pub fn id(&self) -> u32 {
        self.group.id()
    }

    /// Writes a line and waits for the line that answers it.
    ///
    /// # Errors
    /// [`Fault`]; then the child has been ended, with everything it started, and the session is of no more use.
    pub fn exchange(&mut self, request: &str) -> Result<Vec<u8>, Fault> {
        match self.converse(request) {
            Ok(line) => {
                self.has_replied = true;
                Ok(line)
            }
            Err(cause) => Err(self.fail(cause)),
        }
    }

    fn converse(&mut self, request: &str) -> Result<Vec<u8>, Fate> {
        self.quiet()?;
        self.write(request);
        let limit = if self.has_replied { self.limits.reply } else { self.limits.start };
        match self.next_event(&Deadline::after(limit)) {
            Some(Event::Line { line, followed: false }) => Ok(line),
            Some(Event::Line { line, followed: true }) => Err(Fate::Followed(words::beginning(&line))),
            Some(other) => Err(self.cause_of(other)),
            None => Err(match self.group.wait(Duration::ZERO) {
                Some(status) => Fate::Ended(status, self.begun()),
                None => Fate::TimedOut(format!("{limit:?}"), self.begun()),
            }),
        }
    }

    /// What happens next, unless the time is over or the child ended and something else keeps its pipes open.
    fn next_event(&self, deadline: &Deadline) -> Option<Event> {
        loop {
            let remaining = deadline.remaining();
            // seen before listening: what it wrote before it ended still counts
            let ended = self.group.wait(Duration::ZERO).is_some();
            let patience = if ended { self.limits.farewell } else { LOOK };
            match self.events.recv_timeout(patience.min(remaining)) {
                Ok(event) => return Some(event),
                Err(RecvTimeoutError::Timeout) if !ended && remaining > LOOK => {}
                Err(_) => return None,
            }
        }
    }

    /// Whether the child has kept silent since its last reply.
    fn quiet(&self) -> Result<(), Fate> {
        match self.events.try_recv() {
            Ok(Event::Line { line, .. }) => Err(Fate::Unsolicited(words::beginning(&line))),
            Ok(other) => Err(self.cause_of(other)),
            Err(TryRecvError::Disconnected) => Err(self.ended(String::new())),
            Err(TryRecvError::Empty) if !self.begun().is_empty() => Err(Fate::Unsolicited(self.begun())),
            Err(TryRecvError::Empty) => Ok(()),
        }
    }

    fn write(&self, request: &str) {
        let line = [request.as_bytes(), b"\n"].concat();
        // a writer that has ended has left its reason among the events
        let _ = self.requests.as_ref().map(|writer| writer.send(line));
    }

    fn cause_of(&self, event: Event) -> Fate {
        match event {
            Event::Line { line, .. } => Fate::Unsolicited(words::beginning(&line)),
            Event::TooLong(beginning) => Fate::TooLong(self.limits.line, beginning),
            Event::Ended(beginning) => self.ended(beginning),
            Event::NotRead => self.group.wait(self.limits.farewell).map_or(Fate::NotRead, |status| Fate::Ended(status, String::new())),
        }
    }

    fn ended(&self, beginning: String) -> Fate {
        match self.group.wait(self.limits.farewell) {
            Some(status) => Fate::Ended(status, beginning),
            None => Fate::Closed(beginning),
        }
    }

    fn begun(&self) -> String {
        self.begun.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// Ends the child with everything it started; the fault has its last words.
    pub fn fail(&mut self, cause: Fate) -> Fault {
        self.group.end();
        Fault { cause, last_words: self.errors.last_lines(self.limits.farewell) }
    }

    /// Waits this long for output that answers no request.
    ///
    /// # Errors
    /// [`Fault`] if the child writes something. The session is over after that.
    pub fn listen(&mut self, time: Duration) -> Result<(), Fault> {
        std::thread::sleep(time);
        self.quiet().map_err(|cause| self.fail(cause))
    }

    /// Says goodbye in these words and closes the child's standard input; the exit status, if it ends in a short while.
    pub fn farewell(self, request: &str) -> Option<ExitStatus> {
        self.write(request);
        self.close()
    }

    /// Closes the child's standard input; the exit status, if it ends in a short while.
    pub fn close(mut self) -> Option<ExitStatus> {
        self.requests = None;
        self.ends()
    }

    /// The exit status, if the child ends in a short while.
    pub fn ends(&self) -> Option<ExitStatus> {
        self.group.wait(self.limits.farewell)
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.cause)?;
        if self.last_words.is_empty() { Ok(()) } else { write!(f, "; its last lines on standard error: {}", self.last_words) }
    }
}

impl fmt::Display for Fate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let begun = |line: &str| if line.is_empty() { String::new() } else { format!(", in the middle of the line `{line}`") };
        match self {
            Fate::NotStarted(error) => write!(f, "it cannot be started: {error}"),
            Fate::TimedOut(limit, line) => write!(f, "no reply within {limit}{}", begun(line)),
            Fate::Ended(status, line) => write!(f, "it ended without a reply ({status}){}", begun(line)),
            Fate::Closed(line) => write!(f, "it closed its standard output but still runs{}", begun(line)),
            Fate::NotRead => write!(f, "it closed its standard input but still runs"),
            Fate::TooLong(limit, line) => write!(f, "a line of more than {limit} bytes, which begins `{line}`"),
            Fate::Unsolicited(line) => write!(f, "it wrote `{line}` on standard output before it was asked"),
            Fate::Followed(line) => write!(f, "more than one line in reply to one request; the first is `{line}`"),
            Fate::Malformed(problem) => write!(f, "{problem}"),
        }
    }
}
