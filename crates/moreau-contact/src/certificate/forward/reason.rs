//! Why nothing was proved about the solution near an answer.

/// Why nothing was proved.
#[derive(Clone, Debug, PartialEq)]
pub struct Reason {
    /// In words, with the contact.
    pub text: String,
    /// The contact where the proof failed.
    pub contact: Option<usize>,
}
