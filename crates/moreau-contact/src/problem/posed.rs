//! What a file poses.

use super::{ContactProblem, JointedProblem};

/// A contact problem, with joints or without.
#[derive(Clone, Debug, PartialEq)]
pub enum Posed {
    /// Contacts alone.
    Contacts(Box<ContactProblem>),
    /// Contacts with joints.
    Jointed(Box<JointedProblem>),
}
