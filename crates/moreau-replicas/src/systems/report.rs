//! The report of `moreau systems`: every system with its agreements, measured when the command runs.

use super::{ALL, Agreement, Cone, ConstraintLevel, ContactLaw, System};
use crate::stored::StoredRuns;
use moreau_exact::{Error, Result};
use schemars::JsonSchema;
use serde::Serialize;

/// What `moreau systems --format json` writes.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Report {
    /// The systems, in the order of the chapter.
    pub systems: Vec<SystemReport>,
}

/// A system, where it stands on the four axes, and how closely it agrees.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct SystemReport {
    /// Its name.
    pub name: String,
    /// What the contact constraint is written on.
    pub level: ConstraintLevel,
    /// The set of admissible impulses of one contact.
    pub cone: Cone,
    /// How impulse and velocity exclude each other.
    pub law: ContactLaw,
    /// The algorithm that solves the step.
    pub algorithm: String,
    /// How the system treats the coefficient of restitution.
    pub restitution: String,
    /// How positions follow.
    pub position_update: String,
    /// Names for `moreau simulate --scheme`.
    pub schemes: Vec<String>,
    /// What the system was compared with.
    pub held_against: Vec<AgreementReport>,
}

/// A comparison, as measured.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct AgreementReport {
    /// A closed form, another algorithm, or an engine with its version.
    pub against: String,
    /// What is compared.
    pub quantity: String,
    /// Unit of difference and tolerance.
    pub unit: String,
    /// The difference measured; absent if it is not a finite number.
    pub difference: Option<f64>,
    /// What it may be by derivation.
    pub tolerance: f64,
    /// Whether the difference is within the tolerance.
    pub holds: bool,
    /// How much of the tolerance the difference is; absent if it must be 0 or is not a finite number.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub used: Option<f64>,
}

impl Report {
    /// Measures every agreement; `done` is called after each.
    ///
    /// # Errors
    /// The first one of an agreement that cannot be measured, named.
    pub fn measure(runs: &dyn StoredRuns, done: impl Fn()) -> Result<Report> {
        let systems = ALL.iter().map(|system| SystemReport::measure(system, runs, &done)).collect::<Result<_>>()?;
        Ok(Report { systems })
    }

    /// How many agreements there are.
    pub fn size() -> usize {
        ALL.iter().map(|system| system.held_against.len()).sum()
    }

    /// Whether every agreement is within its tolerance.
    pub fn holds(&self) -> bool {
        self.systems.iter().flat_map(|system| &system.held_against).all(|agreement| agreement.holds)
    }
}

impl SystemReport {
    /// Measures the agreements of one system; `done` is called after each.
    ///
    /// # Errors
    /// The first one of an agreement that cannot be measured, named.
    pub fn measure(system: &System, runs: &dyn StoredRuns, done: impl Fn()) -> Result<SystemReport> {
        let agreements = system.held_against.iter().map(|agreement| {
            let measured = AgreementReport::measure(agreement, runs);
            done();
            measured.map_err(|error| Error::Unsupported(format!("{}, {}: {error}", system.name, agreement.quantity)))
        });
        Ok(SystemReport {
            name: system.name.into(),
            level: system.level,
            cone: system.cone,
            law: system.law,
            algorithm: system.algorithm.into(),
            restitution: system.restitution.into(),
            position_update: system.position_update.into(),
            schemes: system.schemes.iter().map(ToString::to_string).collect(),
            held_against: agreements.collect::<Result<_>>()?,
        })
    }
}

impl AgreementReport {
    fn measure(agreement: &Agreement, runs: &dyn StoredRuns) -> Result<AgreementReport> {
        let measured = (agreement.measure)(runs)?;
        Ok(AgreementReport {
            against: agreement.against.into(),
            quantity: agreement.quantity.into(),
            unit: agreement.unit.into(),
            difference: Some(measured.difference).filter(|difference| difference.is_finite()),
            tolerance: measured.expectation.tolerance,
            holds: measured.holds(),
            used: measured.used(),
        })
    }
}
