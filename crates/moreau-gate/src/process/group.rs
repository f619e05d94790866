//! Child processes in groups of their own, and a register of the living ones, so that none outlives the gate.
//!
//! A group is ended by SIGKILL to all its members and to the descendants that have left it. Out of reach is a daemon, which has left both
//! its group and its parents; the threads at its pipes end when it does. A gate that is killed itself leaves a [`Guard`] behind, which
//! ends the group.

use crate::process::deadline::poll;
#[cfg(unix)]
use crate::process::descendants::{descendants, end};
#[cfg(unix)]
use crate::process::guard::Guard;
use moreau_exact::{Error, Result};
use process_wrap::std::{ChildWrapper, CommandWrap};
use std::io;
use std::process::{ChildStderr, ChildStdin, ChildStdout, ExitStatus, Stdio};
use std::sync::{Arc, Mutex, MutexGuard, Once, PoisonError};
use std::time::Duration;

/// The exit code of a gate that was interrupted: 128 + SIGINT, as shells count.
const INTERRUPTED: i32 = 130;

/// How long a killed process may take to disappear; longer only in the kernel's own waits, where nothing can be done.
const DISAPPEARANCE: Duration = Duration::from_secs(5);

type Handle = Arc<Mutex<Box<dyn ChildWrapper>>>;

/// The groups that have not been ended. It is locked while one is started, and for good once the gate was interrupted.
static LIVING: Mutex<Vec<Handle>> = Mutex::new(Vec::new());

/// A child process with everything it starts.
pub(super) struct Group {
    handle: Handle,
    #[cfg(unix)]
    _guard: Guard,
}

/// The gate's ends of a child's three streams.
pub(super) struct Streams {
    pub(super) input: ChildStdin,
    pub(super) output: ChildStdout,
    pub(super) errors: ChildStderr,
}

impl Group {
    /// Starts a program with its arguments as the leader of a new group.
    pub(super) fn start(command: &[String]) -> io::Result<(Group, Streams)> {
        let (program, arguments) = command.split_first().ok_or_else(|| io::Error::other("the command is empty"))?;
        let mut wrap = CommandWrap::with_new(program, |command| {
            command.args(arguments).stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
        });
        #[cfg(unix)]
        wrap.wrap(process_wrap::std::ProcessGroup::leader());
        let mut living = lock(&LIVING);
        let mut child = wrap.spawn()?;
        #[cfg(unix)]
        let guard = Guard::of(child.id()).inspect_err(|_| drop(child.start_kill()))?;
        let streams = (child.stdin().take(), child.stdout().take(), child.stderr().take());
        let handle: Handle = Arc::new(Mutex::new(child));
        living.push(handle.clone());
        let group = Group {
            handle,
            #[cfg(unix)]
            _guard: guard,
        };
        match streams {
            (Some(input), Some(output), Some(errors)) => Ok((group, Streams { input, output, errors })),
            _ => Err(io::Error::other("its standard streams are missing")),
        }
    }

    /// The leader's exit status, if it ends within the limit.
    pub(super) fn wait(&self, limit: Duration) -> Option<ExitStatus> {
        poll(limit, || lock(&self.handle).try_wait().ok().flatten())
    }

    /// Ends every member of the group and waits until the leader is gone.
    pub(super) fn end(&self) {
        kill(&self.handle);
        self.wait(DISAPPEARANCE);
    }

    /// The leader's process number, which is also the group's.
    pub(super) fn id(&self) -> u32 {
        lock(&self.handle).id()
    }
}

impl Drop for Group {
    fn drop(&mut self) {
        self.end();
        lock(&LIVING).retain(|other| !Arc::ptr_eq(other, &self.handle));
    }
}

fn kill(handle: &Handle) {
    let mut child = lock(handle);
    #[cfg(unix)]
    descendants(child.id()).into_iter().for_each(end);
    // a group without members cannot be killed, and need not be
    let _ = child.start_kill();
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// From now on, Ctrl-C, SIGTERM and SIGHUP end every engine with all its processes, and then the gate with exit code 130.
///
/// # Errors
/// [`Error::Unsupported`] if the signals are taken already.
pub fn end_engines_on_interrupt() -> Result<()> {
    static ONCE: Once = Once::new();
    let mut outcome = Ok(());
    ONCE.call_once(|| outcome = ctrlc::set_handler(end_all));
    outcome.map_err(|error| Error::Unsupported(format!("the interrupt signal cannot be watched: {error}")))
}

/// Ends every engine of this process that runs now, with all that it has started. Who asks one of them hears that it ended.
pub fn end_engines() {
    lock(&LIVING).iter().for_each(kill);
}

fn end_all() {
    // kept locked until the end: no engine starts any more
    let living = lock(&LIVING);
    living.iter().for_each(kill);
    std::process::exit(INTERRUPTED);
}
