//! What enumerating solutions shows: all of them, in the plane, of few contacts in space and under polyhedral friction, or some.

use crate::certificate::forward::Radius;
use crate::certificate::patterns::{Exact, Solutions, solutions};
use crate::certificate::polyhedral_solutions::{PolyhedralSolutions, polyhedral_solutions};
use crate::certificate::several::{Distinct, distinct};
use crate::certificate::spatial::{Velocities, velocities};
use crate::certificate::uniqueness::Uniqueness;
use crate::number::{counted, significant};
use crate::problem::{ContactProblem, Law, Solution};
use crate::scalar::{Rational, Scalar, exact};
use crate::tolerance::proof::{SET_WORK, enlarged, pattern_work};
use crate::{Error, Result};
use nalgebra::DVector;
use schemars::JsonSchema;
use serde::Serialize;

/// Numbers of a velocity or an impulse that are shown to readers: six contacts in the plane.
const SHOWN: usize = 12;

/// Contacts of a part that are shown to readers.
const NAMED: usize = 6;

/// All solutions of a problem in the plane, of few contacts in space, or under polyhedral friction.
#[derive(Serialize, JsonSchema)]
#[schemars(rename = "AllSolutions")]
pub(super) struct All {
    /// How many patterns of open, sticking and sliding contacts were tried, or complementary cones of polyhedral friction: all there are.
    pub patterns: usize,
    /// Into how many pieces they were cut by directions of slip, in space.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pieces: Option<usize>,
    /// In how many sets the complementary cones were looked at, under polyhedral friction.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sets: Option<usize>,
    /// How many velocities; at the vertices, if they are a continuum.
    pub velocities: usize,
    /// Whether they are a continuum.
    pub continuum: bool,
    /// u of each \[m/s\], rounded; of the first 1000 where parts that share nothing have more together.
    pub found: Vec<Vec<f64>>,
    /// The parts that share nothing, of which these solutions are any together; of one that has none, that one alone.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub parts: Vec<Part>,
}

/// A part of a problem, which shares nothing with the others.
#[derive(Serialize, JsonSchema)]
#[schemars(rename = "PartOfSolutions")]
pub(super) struct Part {
    /// Its contacts.
    pub contacts: Vec<usize>,
    /// How many velocities it has; at the vertices, if they are a continuum.
    pub velocities: usize,
    /// Whether they are a continuum.
    pub continuum: bool,
}

impl Part {
    /// Its contacts, for reading.
    pub fn named(&self) -> String {
        named(&self.contacts)
    }
}

/// These contacts, for reading.
pub(super) fn named(contacts: &[usize]) -> String {
    let shown: Vec<String> = contacts.iter().take(NAMED).map(usize::to_string).collect();
    let more = if contacts.len() > NAMED { format!(", … {} in all", contacts.len()) } else { String::new() };
    format!("contact{} {}{more}", if contacts.len() == 1 { "" } else { "s" }, shown.join(", "))
}

/// Solutions with different velocities: answers whose enclosures are disjoint, or what an enumeration found before it stopped.
#[derive(Serialize, JsonSchema)]
pub(super) struct Several {
    /// How many velocities there are at least.
    at_least: usize,
    /// u of each \[m/s\].
    velocities: Vec<Vec<f64>>,
    /// The largest ‖u* − u‖ of a contact, of each \[m/s\].
    radii: Vec<f64>,
    /// Where the enumeration stopped that found them, in fractions.
    #[serde(skip_serializing_if = "Option::is_none")]
    stopped: Option<String>,
}

/// An end of a continuum of velocities.
#[derive(Serialize, JsonSchema)]
#[schemars(rename = "EndOfContinuum")]
pub(super) struct End {
    /// r \[N·s\], rounded.
    pub impulse: Vec<f64>,
    /// u \[m/s\], rounded.
    pub velocity: Vec<f64>,
}

/// What the enumeration of a problem's solutions shows; nothing where it is not tried.
#[derive(Default)]
pub(super) struct Enumerated {
    /// What is unique, in a word, and why, or why that is not known; under polyhedral friction alone.
    pub unique: Option<(&'static str, String)>,
    pub all: Option<All>,
    pub several: Option<Several>,
    pub continuum: Option<[End; 2]>,
    /// Answers that were met, where they are not all.
    pub met: Vec<Solution>,
    /// Where others may be.
    pub undecided: Vec<String>,
    /// One solution, where the enumeration met any.
    pub one: Option<End>,
    /// What that took, in pieces of contacts in space.
    pub work: usize,
}

impl Enumerated {
    /// What it shows of this problem, of all contacts at once.
    pub fn of(problem: &ContactProblem) -> Self {
        if let Law::PolyhedralCoulomb { .. } = problem.law() {
            return match polyhedral_solutions(problem) {
                Ok(all) => Enumerated::polyhedral(problem.rows_per_contact(), all),
                Err(Error::Unsupported(reason)) => Enumerated { unique: Some(("unknown", reason)), ..Enumerated::default() },
                Err(error) => Enumerated { unique: Some(("unknown", error.to_string())), ..Enumerated::default() },
            };
        }
        if let Ok(mut all) = solutions(problem) {
            let (continuum, one, work) =
                (all.continuum.take().map(ends), all.found.first().map(End::of), all.patterns * pattern_work(problem.rows()));
            return Enumerated { all: Some(All::planar(all, continuum.is_some())), continuum, one, work, ..Enumerated::default() };
        }
        let Ok(all) = velocities(problem) else { return Enumerated::default() };
        let (work, near) = (all.pieces, |(answer, _): &(Solution, Radius)| End::near(answer));
        let one = all.found.first().map(near);
        if all.exactly().is_some() {
            return Enumerated { all: Some(All::spatial(all)), one, work, ..Enumerated::default() };
        }
        let undecided = all.undecided.into_iter().map(|reason| reason.text).collect();
        Enumerated { met: all.found.into_iter().map(|(answer, _)| answer).collect(), undecided, one, work, ..Enumerated::default() }
    }

    fn polyhedral(rows: usize, mut found: PolyhedralSolutions) -> Self {
        let continuum = found.continuum.take().map(ends);
        let unique = match (found.found.len(), &found.stopped) {
            _ if continuum.is_some() => ("unknown", "there are infinitely many".into()),
            (1, None) => {
                let what = if found.same_impulse { "solution" } else { "velocity" };
                (what, format!("all 2^{} complementary cones of λ, β, σ were looked at, in fractions", found.unknowns))
            }
            (count, None) => ("unknown", format!("there are {count}")),
            (count, Some(_)) if count > 1 => ("unknown", "there are several".into()),
            (_, Some(stopped)) => ("unknown", stopped.clone()),
        };
        let (one, work) = (found.found.first().map(End::of), found.sets * SET_WORK);
        let (all, several) = match found.stopped.take() {
            None => (Some(All::polyhedral(found, continuum.is_some())), None),
            Some(stopped) => (None, Several::until(rows, &found.found, stopped)),
        };
        Enumerated { unique: Some(unique), all, several, continuum, one, work, ..Enumerated::default() }
    }

    /// What is unique, and why: the velocity, too, where all solutions are known and have one.
    pub fn or_counted(&self, known: (&'static str, String)) -> (&'static str, String) {
        let has_one = self.all.as_ref().is_some_and(|all| all.velocities == 1 && !all.continuum);
        if known.0 == "unknown" && has_one { ("velocity", "all patterns were tried and one velocity was found".into()) } else { known }
    }

    /// The same, where no solution was found and one is proved to exist: that is one of the exact H M̂⁻¹ Hᵀ, and the stored W is rounded.
    pub fn unless_contradicted(self, exists: bool) -> Self {
        match &self.all {
            Some(all) if exists && all.velocities == 0 && all.sets.is_some() => {
                let why = "W as it is stored, rounded, has no solution, and H M̂⁻¹ Hᵀ has one";
                Enumerated { unique: Some(("unknown", why.into())), ..Enumerated::default() }
            }
            _ => self,
        }
    }

    /// Whether other velocities than those known may be looked for.
    pub fn is_open(&self) -> bool {
        self.all.is_none() && self.continuum.is_none() && self.several.is_none()
    }
}

/// In a word, and why.
pub(super) fn told(found: Uniqueness) -> (&'static str, String) {
    match found {
        Uniqueness::Solution(reason) => ("solution", reason.into()),
        Uniqueness::Velocity(reason) => ("velocity", reason.into()),
        Uniqueness::Unknown(reason) => ("unknown", reason),
    }
}

fn rounded(numbers: &DVector<Rational>) -> Vec<f64> {
    numbers.iter().map(Scalar::to_f64).collect()
}

pub(super) fn ends(ends: [Exact; 2]) -> [End; 2] {
    ends.map(|end| End::of(&end))
}

impl End {
    fn of(exact: &Exact) -> Self {
        End { impulse: rounded(&exact.impulse), velocity: rounded(&exact.velocity) }
    }

    fn near(answer: &Solution) -> Self {
        End { impulse: answer.impulse.as_slice().to_vec(), velocity: answer.velocity.as_slice().to_vec() }
    }
}

impl All {
    fn planar(all: Solutions, continuum: bool) -> Self {
        let found: Vec<_> = all.found.iter().map(|one| rounded(&one.velocity)).collect();
        All { patterns: all.patterns, pieces: None, sets: None, velocities: found.len(), continuum, found, parts: Vec::new() }
    }

    fn spatial(all: Velocities) -> Self {
        let found: Vec<_> = all.found.iter().map(|(answer, _)| answer.velocity.as_slice().to_vec()).collect();
        All {
            patterns: all.patterns,
            pieces: Some(all.pieces),
            sets: None,
            velocities: found.len(),
            continuum: false,
            found,
            parts: Vec::new(),
        }
    }

    fn polyhedral(all: PolyhedralSolutions, continuum: bool) -> Self {
        let found: Vec<_> = all.found.iter().map(|one| rounded(&one.velocity)).collect();
        All {
            patterns: 1 << all.unknowns,
            pieces: None,
            sets: Some(all.sets),
            velocities: found.len(),
            continuum,
            found,
            parts: Vec::new(),
        }
    }

    /// For reading.
    pub fn line(&self) -> String {
        let count = match (self.velocities, self.continuum) {
            (0, _) => "there is no solution".into(),
            (_, true) => "the velocities of the solutions are a continuum".into(),
            (1, false) => "the solutions have exactly 1 velocity".into(),
            (count, false) => format!("the solutions have exactly {count} velocities"),
        };
        let count = match self.parts.len() {
            0 => count,
            1 if self.velocities == 0 => format!("{count} of {}, which shares nothing with the others", self.parts[0].named()),
            parts => format!("{count}, those of {parts} parts that share nothing in any combination"),
        };
        let patterns = counted(self.patterns, "pattern");
        match (self.pieces, self.sets) {
            (Some(pieces), _) => format!("proved by intervals: all {patterns} tried in {}, {count}", counted(pieces, "piece")),
            (_, Some(sets)) => {
                let (cones, sets) = (counted(self.patterns, "complementary cone"), counted(sets, "set"));
                format!("proved in fractions: all {cones} looked at in {sets}, {count}")
            }
            _ => format!("proved in fractions: all {patterns} tried, {count}"),
        }
    }
}

impl Several {
    /// Those among some answers that are proved to lie apart, if they are two or more.
    pub fn among(problem: &ContactProblem, answers: &[Solution]) -> Result<Option<Self>> {
        let found = distinct(problem, answers)?;
        let velocity = |one: &Distinct| answers[one.answer].velocity.as_slice().to_vec();
        let radius = |one: &Distinct| one.radius.worst().map_or(0.0, |(_, radius)| radius);
        Ok((found.len() > 1).then(|| Several {
            at_least: found.len(),
            velocities: found.iter().map(velocity).collect(),
            radii: found.iter().map(radius).collect(),
            stopped: None,
        }))
    }

    /// What was found until an enumeration stopped, if it is two or more.
    fn until(rows: usize, found: &[Exact], stopped: String) -> Option<Self> {
        // how far the rounded velocity is from the exact one, at most: ‖·‖ ≤ the sum of the sizes
        let radius = |one: &Exact| {
            let rounding = |u: &Rational| enlarged(Scalar::to_f64(&(u - exact(Scalar::to_f64(u))).magnitude()), 1);
            let errors: Vec<f64> = one.velocity.iter().map(rounding).collect();
            errors.chunks(rows).map(|errors| enlarged(errors.iter().sum(), rows)).fold(0.0, f64::max)
        };
        (found.len() > 1).then(|| Several {
            at_least: found.len(),
            velocities: found.iter().map(|one| rounded(&one.velocity)).collect(),
            radii: found.iter().map(radius).collect(),
            stopped: Some(stopped),
        })
    }

    /// For reading.
    pub fn line(&self) -> String {
        let count = self.at_least;
        match &self.stopped {
            None => format!("proved by intervals: at least {count} different velocities: so many answers have disjoint enclosures"),
            Some(stopped) => format!("proved in fractions: at least {count} different velocities; {stopped}"),
        }
    }
}

/// Two ends of a continuum, for reading.
pub(super) fn end_lines([one, other]: &[End; 2]) -> Vec<String> {
    let lines = |name: &str, end: &End| {
        [format!("  {name} u = {} m/s", listed(&end.velocity)), format!("  {:9} r = {} N·s", "", listed(&end.impulse))]
    };
    [lines("one end  ", one), lines("other end", other)].concat()
}

/// The first numbers of a vector.
fn listed(numbers: &[f64]) -> String {
    let shown: Vec<String> = numbers.iter().take(SHOWN).map(|number| significant(*number)).collect();
    let more = if numbers.len() > SHOWN { format!(", … {} numbers", numbers.len()) } else { String::new() };
    format!("({}{more})", shown.join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scalar::ratio;

    #[test]
    fn long_vectors_are_shortened_and_say_how_long_they_are() {
        let end = |count: usize| End { impulse: vec![0.25; count], velocity: vec![-1.5; count] };
        let lines = end_lines(&[end(2), end(13)]);
        assert_eq!(lines[0], "  one end   u = (-1.5, -1.5) m/s");
        assert_eq!(lines[1], "            r = (0.25, 0.25) N·s");
        assert!(lines[2].starts_with("  other end u = (") && lines[3].ends_with(", 0.25, … 13 numbers) N·s"), "{lines:?}");
        assert_eq!(lines[3].matches("0.25").count(), SHOWN);
    }

    #[test]
    fn what_stopped_says_at_least_and_a_rounded_velocity_is_within_its_radius() {
        let one = |u: Rational| Exact { impulse: DVector::from_element(2, ratio(0, 1)), velocity: DVector::from_element(2, u) };
        let all = |found: Vec<Exact>, stopped: Option<&str>| PolyhedralSolutions {
            found,
            continuum: None,
            same_impulse: true,
            unknowns: 4,
            sets: 9,
            stopped: stopped.map(Into::into),
        };
        let told = |found: Vec<Exact>, stopped| Enumerated::polyhedral(2, all(found, stopped));
        let stopped = told(vec![one(ratio(1, 3)), one(ratio(1, 2))], Some("stopped"));
        let several = stopped.several.as_ref().expect("two");
        assert!(stopped.all.is_none() && several.at_least == 2 && several.line().ends_with("at least 2 different velocities; stopped"));
        // ⅓ is stored too small by 2⁻⁵⁴/3
        assert!(several.radii[0] > 2e-17 && several.radii[0] < 1e-16 && several.radii[1] < 1e-300, "{:?}", several.radii);
        // one solution is unique where all cones were looked at, and not where that stopped
        assert_eq!(told(vec![one(ratio(1, 3))], Some("stopped")).unique, Some(("unknown", "stopped".into())));
        assert_eq!(told(vec![one(ratio(1, 3))], None).unique.unwrap().0, "solution");
        assert_eq!(told(vec![one(ratio(1, 3)), one(ratio(1, 2))], None).unique.unwrap(), ("unknown", "there are 2".into()));
        // none is none, unless one is proved to exist
        let none = |exists| told(Vec::new(), None).unless_contradicted(exists).all.is_some_and(|all| all.velocities == 0);
        assert!(none(false) && !none(true));
    }
}
