//! `--law`: the same data under another contact law.

use crate::Result;
use crate::problem::{ContactProblem, Law};

/// The laws of round cones, between which data can be moved.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum NamedLaw {
    /// No friction.
    Frictionless,
    /// Coulomb's law.
    Coulomb,
    /// The associated law, that of a convex program.
    Associated,
}

/// The law in place of the file's own.
#[derive(clap::Args)]
pub struct LawOption {
    /// Pose the problem with this law in place of its own.
    #[arg(long, value_enum)]
    law: Option<NamedLaw>,
}

impl LawOption {
    /// The problem with the law that was asked for, or its own.
    ///
    /// # Errors
    /// [`crate::Error::Invalid`] where the data do not fit the law.
    pub fn pose(&self, problem: ContactProblem) -> Result<ContactProblem> {
        let law = match self.law {
            None => return Ok(problem),
            Some(NamedLaw::Frictionless) => Law::Frictionless,
            Some(NamedLaw::Coulomb) => Law::Coulomb,
            Some(NamedLaw::Associated) => Law::Associated,
        };
        problem.into_builder().law(law).build()
    }
}
