//! A planted mistake: a subject with one line of reasoning wrong, and the checks that must notice it.
//!
//! A check that no planted mistake can fail is not a check, and a mistake that no check catches would go unnoticed.

use crate::finding::Finding;
use moreau_exact::Result;
use serde::Serialize;

/// What a planted mistake is a mistake of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Kind {
    /// What a step poses: W, the LCP, what is added to the velocity.
    Assembly,
    /// A projection on a friction cone.
    Projection,
    /// A contact solver.
    Solver,
    /// A certificate of an answer or of a matrix, or the judgement of a claim.
    Certificate,
    /// A time-stepping scheme or the mechanism that it moves.
    Scheme,
    /// A closed form, or an engine's own formula.
    ClosedForm,
    /// A reader of a file or of a scene.
    Reader,
    /// What an engine reports or declares of itself.
    Report,
}

/// Every kind, in the order in which they are shown.
pub const KINDS: [Kind; 8] =
    [Kind::Assembly, Kind::Projection, Kind::Solver, Kind::Certificate, Kind::Scheme, Kind::ClosedForm, Kind::Reader, Kind::Report];

impl Kind {
    /// Its name in the plural.
    pub fn plural(self) -> &'static str {
        match self {
            Kind::Assembly => "assemblies",
            Kind::Projection => "projections",
            Kind::Solver => "solvers",
            Kind::Certificate => "certificates",
            Kind::Scheme => "schemes",
            Kind::ClosedForm => "closed forms",
            Kind::Reader => "readers",
            Kind::Report => "reports",
        }
    }
}

/// One planted mistake; `subject` has it, in the form that its checks take.
///
/// Planted mistakes of one name are one mistake, met in several subjects.
#[derive(Clone, Copy, Debug)]
pub struct Planted<S> {
    /// A short name, `family/mistake`.
    pub name: &'static str,
    /// The mistake in one sentence.
    pub mistake: &'static str,
    /// What it is a mistake of.
    pub kind: Kind,
    /// What has it.
    pub subject: S,
}

impl<S> Planted<S> {
    /// The same mistake under checks that tell by name which of them catch it.
    pub fn trial<'a>(&'a self, caught_by: impl Fn(&S) -> Result<Vec<Catch>> + Send + Sync + 'a) -> Trial<'a>
    where
        S: Sync,
    {
        Trial { name: self.name, mistake: self.mistake, kind: self.kind, caught_by: Box::new(move || caught_by(&self.subject)) }
    }
}

/// A check that catches a planted mistake.
#[derive(Clone, Debug, PartialEq)]
pub struct Catch {
    /// The check, by name.
    pub check: String,
    /// The time steps at which it does \[s\]; empty if the check has none.
    pub time_steps: Vec<f64>,
}

impl From<&str> for Catch {
    fn from(check: &str) -> Self {
        Catch { check: check.into(), time_steps: Vec::new() }
    }
}

/// A planted mistake under some checks.
pub struct Trial<'a> {
    /// The mistake's name.
    pub name: &'static str,
    /// The mistake in one sentence.
    pub mistake: &'static str,
    /// What it is a mistake of.
    pub kind: Kind,
    /// Runs the checks and names those that catch it.
    ///
    /// # Errors
    /// If a check cannot be computed.
    pub caught_by: Box<dyn Fn() -> Result<Vec<Catch>> + Send + Sync + 'a>,
}

/// One check on a subject with a mistake, beside the same check on the right subject.
#[derive(Clone, Copy, Debug)]
pub struct Beside {
    /// The check, by name.
    pub check: &'static str,
    /// The check on the subject with the mistake: at least one finding must fail.
    pub defective: fn() -> Result<Vec<Finding>>,
    /// The same check on the reference: every finding must hold.
    pub reference: fn() -> Result<Vec<Finding>>,
}

impl Planted<Beside> {
    /// The mistake under its one check.
    pub fn beside(&self) -> Trial<'_> {
        self.trial(|beside| Ok(Vec::from_iter(fails(&(beside.defective)()?).then(|| Catch::from(beside.check)))))
    }
}

/// A check of a family: its name, and the findings on a subject.
pub type FamilyCheck<S> = (&'static str, fn(&S) -> Result<Vec<Finding>>);

/// Subjects of one type, every one of which every check of the family is run on.
pub struct Family<S: 'static> {
    /// The right subject: every finding must hold.
    pub reference: S,
    /// The checks.
    pub checks: &'static [FamilyCheck<S>],
    /// Subjects with one mistake each.
    pub planted: &'static [Planted<S>],
}

impl<S: Sync> Family<S> {
    /// Every mistake under every check.
    pub fn trials(&'static self) -> impl Iterator<Item = Trial<'static>> {
        self.planted.iter().map(|planted| planted.trial(|subject| self.failing(subject)))
    }

    /// The checks that fail on a subject.
    ///
    /// # Errors
    /// If a check cannot be computed.
    ///
    /// ```
    /// use moreau_checks::Finding;
    /// use moreau_checks::planted::Family;
    ///
    /// type Area = fn(f64) -> f64;
    /// static CIRCLES: Family<Area> = Family {
    ///     reference: |r| std::f64::consts::PI * r * r,
    ///     checks: &[("doubling", |area| Ok(vec![Finding::equal("A(2)/A(1)", area(2.0) / area(1.0), 4.0, 1e-12, "1")]))],
    ///     planted: &[],
    /// };
    /// assert!(CIRCLES.failing(&CIRCLES.reference)?.is_empty());
    /// let circumference: Area = |r| 2.0 * std::f64::consts::PI * r;
    /// assert_eq!(CIRCLES.failing(&circumference)?[0].check, "doubling");
    /// # Ok::<(), moreau_exact::Error>(())
    /// ```
    pub fn failing(&self, subject: &S) -> Result<Vec<Catch>> {
        let mut failing = Vec::new();
        for (name, check) in self.checks {
            if fails(&check(subject)?) {
                failing.push(Catch::from(*name));
            }
        }
        Ok(failing)
    }
}

/// Whether a finding fails; a check that finds nothing shows nothing, and fails too.
fn fails(findings: &[Finding]) -> bool {
    findings.is_empty() || !findings.iter().all(Finding::holds)
}

/// Holds a family to what it promises: the reference passes every check, and every planted mistake fails one.
#[cfg(test)]
pub(crate) fn passes<S: Sync>(family: &'static Family<S>) {
    assert_eq!(family.failing(&family.reference).expect("computed"), Vec::new());
    for trial in family.trials() {
        assert!(!(trial.caught_by)().expect("computed").is_empty(), "{} is not caught", trial.name);
    }
}
