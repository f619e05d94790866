//! `--law`: the same data under another contact law.

use crate::Result;
use crate::problem::{Law, Posed};

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
    pub fn pose(&self, posed: Posed) -> Result<Posed> {
        let law = match self.law {
            None => return Ok(posed),
            Some(NamedLaw::Frictionless) => Law::Frictionless,
            Some(NamedLaw::Coulomb) => Law::Coulomb,
            Some(NamedLaw::Associated) => Law::Associated,
        };
        Ok(match posed {
            Posed::Contacts(problem) => Posed::Contacts(Box::new(problem.into_builder().law(law).build()?)),
            Posed::Jointed(problem) => {
                let friction = problem.friction().to_vec();
                Posed::Jointed(Box::new(problem.law(law, friction)?))
            }
        })
    }
}
