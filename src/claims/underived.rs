//! Claims whose findings do not carry their verdict yet: what the sentence says of each instance is still to be written beside them.
//!
//! A claim that stands here is judged by its recorded verdict, as all were before. A test keeps the list honest: what can be
//! derived may not stand here.

/// Their ids.
pub const UNDERIVED: &[&str] = &[];
