//! A system: where it stands on the four axes, what it agrees with, and the mistakes that each agreement catches.

use super::Measured;
use super::planted::{Measure, Planted};
use crate::stored::StoredRuns;
use moreau_exact::Result;
use serde::Serialize;
use std::fmt;

/// What the contact constraint is written on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, schemars::JsonSchema)]
#[serde(rename_all = "kebab-case")]
#[schemars(rename = "Level")]
pub enum ConstraintLevel {
    /// φ/h + u⁺: the gap at the end of the step, linearised.
    Position,
    /// u⁺ with restitution; the gap only chooses the active contacts.
    Velocity,
    /// (u⁺ − u)/h against a reference acceleration.
    Acceleration,
}

/// The set of admissible impulses of one contact.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, schemars::JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Cone {
    /// ‖r_t‖ ≤ μ r_n.
    SecondOrder,
    /// d edges in place of the circle.
    Polyhedral,
    /// No contact, hence no cone.
    None,
}

/// How impulse and velocity exclude each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, schemars::JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum ContactLaw {
    /// Signorini–Coulomb, not convex.
    Coulomb,
    /// The associated relaxation K ∋ r ⟂ y ∈ K*, convex.
    Associated,
    /// Either of them with a compliance R > 0.
    Compliant,
    /// No contact, hence no law.
    None,
}

/// A simulator or integrator of the chapter, as it is built here.
#[derive(Clone, Copy, Debug)]
pub struct System {
    /// Its name, as the chapter uses it.
    pub name: &'static str,
    /// First axis.
    pub level: ConstraintLevel,
    /// Second axis.
    pub cone: Cone,
    /// Third axis.
    pub law: ContactLaw,
    /// Fourth axis, in words.
    pub algorithm: &'static str,
    /// What becomes of e.
    pub restitution: &'static str,
    /// How positions follow, in symbols.
    pub position_update: &'static str,
    /// `moreau simulate --scheme` takes these names; further options in words.
    pub schemes: &'static [&'static str],
    /// What it was compared with.
    pub held_against: &'static [Agreement],
}

/// A comparison with something that was computed in another way.
#[derive(Clone, Copy, Debug)]
pub struct Agreement {
    /// A closed form, another algorithm, or an engine with its version.
    pub against: &'static str,
    /// What is compared.
    pub quantity: &'static str,
    /// Unit of the difference.
    pub unit: &'static str,
    /// Measures it.
    ///
    /// # Errors
    /// Those of the scheme, and a stored run that is missing or malformed.
    pub measure: fn(&dyn StoredRuns) -> Result<Measured>,
    /// Mistakes that it catches, at least one.
    pub planted: &'static [Planted<Measure>],
}

impl Agreement {
    /// What it is called among the checks, as one of its system.
    pub fn check(&self, system: &System) -> String {
        format!("systems/{}: {}", system.name, self.quantity)
    }
}

impl fmt::Display for ConstraintLevel {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(match self {
            ConstraintLevel::Position => "position",
            ConstraintLevel::Velocity => "velocity",
            ConstraintLevel::Acceleration => "acceleration",
        })
    }
}

impl fmt::Display for Cone {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(match self {
            Cone::SecondOrder => "second-order",
            Cone::Polyhedral => "polyhedral",
            Cone::None => "–",
        })
    }
}

impl fmt::Display for ContactLaw {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(match self {
            ContactLaw::Coulomb => "Coulomb",
            ContactLaw::Associated => "associated",
            ContactLaw::Compliant => "compliant",
            ContactLaw::None => "–",
        })
    }
}
