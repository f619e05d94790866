//! Rapier behind the engine protocol `moreau-engine/1`: requests on standard input, replies on standard output.
//!
//! ```text
//! main      the loop over lines
//! protocol  one line → one reply; errors, refusals and panics of the engine all become replies
//! options   the engine's settings: defaults, overrides, the description
//! scene     scene/1 as Rapier needs it, with every refusal
//! simulate  the scene in the engine, step by step
//! recorder  trajectory/1
//! version   what differs between the three versions of Rapier, one file each
//! ```

mod options;
mod protocol;
mod recorder;
mod scene;
mod simulate;
mod version;

use std::io::{BufRead, Write, stdin, stdout};

fn main() -> std::io::Result<()> {
    let (mut input, mut output) = (stdin().lock(), stdout().lock());
    while let Some(line) = next_line(&mut input)? {
        if line.trim_ascii().is_empty() {
            continue;
        }
        let (reply, go_on) = protocol::answer(&line);
        writeln!(output, "{reply}")?;
        output.flush()?;
        if !go_on {
            break;
        }
    }
    Ok(())
}

/// The next line, at most one byte longer than a message may be; the rest of a longer one is a message of its own.
fn next_line(input: &mut impl BufRead) -> std::io::Result<Option<Vec<u8>>> {
    let mut line = Vec::new();
    let limit = protocol::MAX_LINE_BYTES + 1;
    std::io::Read::take(input, limit as u64).read_until(b'\n', &mut line)?;
    Ok((!line.is_empty()).then_some(line))
}
