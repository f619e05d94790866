//! The forward error of an answer, proved: the problem as it is given has a solution within a radius of the answer.
//!
//! ```text
//!     (r*, u*) solves the problem ,      ‖u*_k − u_k‖ ≤ ε_k [m/s] ,      ‖r*_k − r_k‖ ≤ ρ_k [N·s]      at every contact k
//! ```
//! The pattern – which contacts are open, stick or slide – is read off the answer. Its equations (`pattern`) are solved as near as
//! numbers allow, and a solution is enclosed in a box (`krawczyk`). Then every inequality of the pattern is decided for the whole box, so
//! that the solution of the equations is one of the law. Where an inequality is not decided – a contact on the border between two cases –
//! the equations of that contact become Coulomb's law itself.
//!
//! Where M̂ and H are known, the problem is the one of the exact H M̂⁻¹ Hᵀ, and the proof covers the stored W as well: both are within what
//! `mechanism` bounds. Rows that depend on each other exactly, decided in fractions from M̂ and H where they are known and from W otherwise
//! (`dependent`), leave impulses undetermined: those of the dependent rows are taken as the answer gives them, and the solution is one of
//! many; of M̂ and H the proof is then that of the exact operator alone. Where numbers are nearly but not exactly dependent, or equations
//! that are not linear in y alone, there is no proof, and the contact is named.

mod affine;
mod case;
mod dependent;
#[cfg(test)]
mod dependent_tests;
mod krawczyk;
mod mechanism;
mod pattern;
mod polygon;
#[cfg(test)]
mod polygon_tests;
mod reason;
#[cfg(test)]
mod tests;

use super::backward::TOO_FAST;
use super::interval::Interval;
use super::planted::{Plant, planted};
use crate::problem::{ByRows, ContactProblem, Coordinates, Solution};
use crate::tolerance::proof::{PATTERNS, ROWS, enlarged};
use affine::Affine;
pub(super) use affine::times;
use case::Case;
use dependent::LeftOut;
pub(super) use dependent::independent_rows;
use krawczyk::{Enclosed, System};
pub(super) use mechanism::{groups, uncertainty};
use moreau_exact::number::counted;
use moreau_exact::{Error, Result};
use nalgebra::{DMatrix, DVector};
use pattern::{Contact, of, pressed_rows, read_off};

pub use case::ContactState;
pub use reason::Reason;

/// What was decided about the solution near an answer.
#[derive(Clone, Debug, PartialEq)]
pub enum Forward {
    /// There is one.
    Proved(Radius),
    /// Nothing was decided.
    NotProved(Reason),
}

/// How far a solution is at most; all bounds are rounded outward.
#[derive(Clone, Debug, PartialEq)]
pub struct Radius {
    /// ‖u* − u‖ per contact \[m/s\], u as the answer stores it.
    pub velocity: Vec<f64>,
    /// ‖r* − r‖ per contact \[N·s\].
    pub impulse: Vec<f64>,
    /// What every contact does.
    pub states: Vec<ContactState>,
    /// Rows that depend exactly on others: their impulses are those that the proof began from, and other ones do as well.
    pub dependent: Vec<usize>,
    /// |v* − v| of every generalised velocity, v = v_free + M̂⁻¹Hᵀr \[m/s, rad/s\]; `None` where M̂ and H are not known.
    pub bodies: Option<Vec<f64>>,
}

impl Radius {
    /// The largest bound on u, and its contact; none without contacts.
    pub fn worst(&self) -> Option<(usize, f64)> {
        self.velocity.iter().copied().enumerate().reduce(|best, one| if one.1 > best.1 { one } else { best })
    }

    /// The largest bound on r \[N·s\].
    pub fn moved(&self) -> f64 {
        self.impulse.iter().copied().fold(0.0, f64::max)
    }
}

impl Forward {
    fn refused(text: impl Into<String>, contact: impl Into<Option<usize>>) -> Self {
        Forward::NotProved(Reason { text: text.into(), contact: contact.into() })
    }

    /// The bounds, if there are some.
    pub fn proved(self) -> Option<Radius> {
        match self {
            Forward::Proved(radius) => Some(radius),
            Forward::NotProved(_) => None,
        }
    }
}

/// Proves that the problem has a solution near an answer.
///
/// # Errors
/// [`Error::Invalid`] if the answer has another size than the problem or an impulse that is not finite; near a velocity that is not finite
/// nothing is proved.
/// ```
/// use moreau_contact::certificate::forward::forward;
/// use moreau_contact::nalgebra::{DMatrix, dvector};
/// use moreau_contact::{ContactProblem, Solution};
///
/// let block = ContactProblem::new(DMatrix::identity(2, 2), dvector![-1.0, 2.0]).rows_per_contact(2).friction(vec![0.5]).build()?;
/// let answer = |r_n: f64| Solution::new("by hand", dvector![r_n, -0.5], dvector![r_n - 1.0, 1.5], 0);
/// let near = forward(&block, &answer(1.0 + 1e-9))?.proved().expect("a solution is near");
/// assert!(near.velocity[0] >= 1e-9 && near.velocity[0] < 1.001e-9); // as far as the answer was moved
/// # Ok::<(), moreau_contact::Error>(())
/// ```
pub fn forward(problem: &ContactProblem, answer: &Solution) -> Result<Forward> {
    forward_from(problem, answer, &answer.impulse)
}

/// The same with a pattern and equations that are read off other impulses than those of the answer: where impulses are not unique, those of
/// the answer may lie on a border that others with the same velocity do not touch. The bounds are distances from the answer.
///
/// # Errors
/// Those of [`forward`].
/// ```
/// use moreau_contact::certificate::forward::{forward, forward_from};
/// use moreau_contact::nalgebra::{DMatrix, dvector};
/// use moreau_contact::{ContactProblem, Law, Solution};
///
/// // one foot of two carries all of 1 N·s: it need not
/// let feet = ContactProblem::new(DMatrix::from_element(2, 2, 1.0), dvector![-1.0, -1.0]).rows_per_contact(1);
/// let feet = feet.law(Law::Frictionless).friction(vec![0.0; 2]).build()?;
/// let answer = Solution::new("by hand", dvector![1.0, 0.0], dvector![0.0, 0.0], 0);
/// let near = forward_from(&feet, &answer, &dvector![0.5, 0.5])?.proved().expect("both feet press");
/// assert!(near.velocity == [0.0, 0.0] && near.impulse[1] >= 0.5);
/// # Ok::<(), moreau_contact::Error>(())
/// ```
pub fn forward_from(problem: &ContactProblem, answer: &Solution, begun: &DVector<f64>) -> Result<Forward> {
    let rows = problem.rows();
    for (field, numbers) in [("impulse", &answer.impulse), ("begun", begun)] {
        if numbers.len() != rows || numbers.iter().any(|number| !number.is_finite()) {
            return Err(Error::invalid(field, format!("is not {rows} finite numbers"), "give one number per row"));
        }
    }
    problem.require_size("velocity", answer.velocity.len())?;
    if answer.velocity.iter().any(|number| !number.is_finite()) {
        return Ok(Forward::refused(TOO_FAST, None));
    }
    if problem.compliance().is_some_and(|soft| soft.coordinates == Coordinates::Edge) {
        return Ok(Forward::refused("a compliance on edges has no proof of a solution near", None));
    }
    Ok(Proof::new(problem, answer, None).run(begun))
}

/// The same of a problem whose contacts may stand for bilateral rows; all numbers are finite, and as many as there are rows.
pub(super) fn of_rows(rows: &ByRows, answer: &Solution) -> Forward {
    let problem = rows.contacts();
    if problem.compliance().is_some_and(|soft| soft.coordinates == Coordinates::Edge) {
        return Forward::refused("a compliance on edges has no proof of a solution near", None);
    }
    Proof::new(problem, answer, Some(rows)).run(&answer.impulse)
}

/// A proof under way.
struct Proof<'a> {
    problem: &'a ContactProblem,
    answer: &'a Solution,
    contacts: Vec<Contact>,
    joints: Option<&'a ByRows>,
    /// How far W may be from the stored one.
    radius: Option<DMatrix<f64>>,
}

/// How an attempt with one pattern ended.
enum Ended {
    Proved(Radius),
    /// The equations have no enclosure.
    NotEnclosed(usize),
    /// The inequalities of these contacts are not decided, at these impulses and velocities.
    Undecided {
        contacts: Vec<usize>,
        impulse: Vec<f64>,
        velocity: Vec<f64>,
    },
}

/// How many rows depend, in words.
fn depending(rows: usize) -> String {
    format!("{} depend{}", counted(rows, "row"), if rows == 1 { "s" } else { "" })
}

impl<'a> Proof<'a> {
    fn new(problem: &'a ContactProblem, answer: &'a Solution, joints: Option<&'a ByRows>) -> Self {
        let radius = mechanism::uncertainty(problem);
        let joined = |k: usize| joints.is_some_and(|joints| joints.is_joined(k) && !planted(Plant::Joined));
        let contacts = (0..problem.contacts()).map(|k| Contact::new(problem, k, joined(k))).collect();
        Proof { problem, answer, contacts, joints, radius }
    }

    /// A contact in messages: with joints a constraint, by its place in the `kinds`.
    fn name(&self, contact: usize) -> String {
        self.joints.map_or_else(|| format!("contact {contact}"), |joints| format!("constraint {}", joints.constraint(contact)))
    }

    fn run(&self, begun: &DVector<f64>) -> Forward {
        let rows = self.problem.rows_per_contact();
        let mut impulse = begun.as_slice().to_vec();
        let mut cases = read_off(&self.contacts, rows, &impulse, self.problem.law_velocity(begun).as_slice());
        let [mut left, mut borders] = [PATTERNS; 2];
        loop {
            if pressed_rows(&self.contacts, &cases).len() > ROWS {
                return Forward::refused(format!("more than {ROWS} rows have an impulse; proofs are dense"), None);
            }
            match self.attempt(&cases, &impulse, &[]) {
                Ended::Proved(radius) => return Forward::Proved(radius),
                Ended::NotEnclosed(contact) => return self.with_dependent_rows(&cases, &impulse, contact),
                Ended::Undecided { contacts, impulse: found, velocity } => {
                    let again = read_off(&self.contacts, rows, &found, &velocity);
                    let changed = contacts.iter().any(|k| again[*k] != cases[*k] && cases[*k].state() != ContactState::Undecided);
                    if changed && left > 0 {
                        left -= 1;
                        contacts.iter().for_each(|k| cases[*k] = again[*k]);
                        impulse = found;
                    } else if borders == 0 || !contacts.iter().all(|k| self.contacts[*k].has_borders()) {
                        return Forward::refused(self.border(contacts[0], &cases), contacts[0]);
                    } else {
                        (left, borders) = (0, borders - 1);
                        contacts.iter().for_each(|k| cases[*k] = Case::Is(ContactState::Undecided));
                    }
                }
            }
        }
    }

    fn border(&self, contact: usize, cases: &[Case]) -> String {
        if let Case::Edge(_) | Case::Side(_) = cases[contact] {
            return format!("{} is on the border of the edge or side of its cone on which it slides", self.name(contact));
        }
        let between = match cases[contact].state() {
            ContactState::Open => "opening and pressing",
            ContactState::Pressing => "pressing and opening",
            ContactState::Sticking => "sticking and sliding or opening",
            ContactState::Sliding | ContactState::Undecided => "sliding and sticking or opening",
            ContactState::Joined => "its joint and none",
        };
        let contact = self.name(contact);
        format!("{contact} is on the border between {between}")
    }

    /// Takes the impulses of exactly dependent rows as given.
    fn with_dependent_rows(&self, cases: &[Case], impulse: &[f64], contact: usize) -> Forward {
        let rows = self.problem.rows_per_contact();
        match dependent::dependent_rows(self.problem, &self.contacts, cases, &|k| self.name(k)) {
            Err(reason) => Forward::NotProved(reason),
            Ok(dependent) if dependent.is_empty() => {
                let what = match cases[contact] {
                    Case::Is(ContactState::Undecided) => "on a border, and coupled to others",
                    _ => "nearly dependent on others",
                };
                Forward::refused(format!("the equations of {} are {what}", self.name(contact)), contact)
            }
            Ok(dependent) => match self.attempt(cases, impulse, &dependent) {
                Ended::Proved(radius) => Forward::Proved(radius),
                Ended::NotEnclosed(contact) => {
                    let text = format!(
                        "{} exactly on others, and the equations of {} are nearly dependent besides",
                        depending(dependent.len()),
                        self.name(contact)
                    );
                    Forward::refused(text, contact)
                }
                Ended::Undecided { contacts, .. } => {
                    let k = contacts[0];
                    let text = format!(
                        "{}, where {} exactly on others (the first at {})",
                        self.border(k, cases),
                        depending(dependent.len()),
                        self.name(dependent[0].given / rows)
                    );
                    Forward::refused(text, k)
                }
            },
        }
    }

    fn attempt(&self, cases: &[Case], impulse: &[f64], left_out: &[LeftOut]) -> Ended {
        let columns = pressed_rows(&self.contacts, cases);
        let affine = Affine::new(self.problem, columns.clone(), self.radius.as_ref());
        let unknown = columns.iter().copied().filter(|row| left_out.iter().all(|left| left.given != *row)).collect();
        let equations = columns.iter().copied().filter(|row| left_out.iter().all(|left| left.equation != *row)).collect();
        let system = System { affine: &affine, contacts: &self.contacts, cases, unknown, equations };
        let middle = system.corrected(columns.iter().map(|row| impulse[*row]).collect());
        let found = match system.enclosed(middle) {
            Ok(found) => found,
            Err(failed) => return Ended::NotEnclosed(failed.contact),
        };
        let (rows, boxed) = (self.problem.rows_per_contact(), system.impulses(&found.middle, Some(&found.radius)));
        let at = |k: usize| self.contacts[k].holds(cases[k], &of(&boxed, k, rows)[..rows], &of(&found.velocity, k, rows)[..rows]);
        let undecided: Vec<usize> = (0..cases.len()).filter(|k| !at(*k) && !planted(Plant::Signs)).collect();
        if undecided.is_empty() {
            let mut given: Vec<usize> = left_out.iter().map(|left| left.given).collect();
            given.sort_unstable();
            return Ended::Proved(self.measured(cases, &boxed, &found, given));
        }
        let middle = |all: &[Interval]| all.iter().map(|x| x.middle()).collect();
        Ended::Undecided { contacts: undecided, impulse: middle(&boxed), velocity: middle(&found.velocity) }
    }

    /// The distances of the answer from everything in the box.
    fn measured(&self, cases: &[Case], impulse: &[Interval], found: &Enclosed, given: Vec<usize>) -> Radius {
        let rows = self.problem.rows_per_contact();
        let contact = |k: usize, row: usize| -> Interval {
            // u = y − shift − R r; y is zero where the pattern says so
            let at = k * rows + row;
            let y = if self.contacts[k].is_zero(cases[k], row) { Interval::ZERO } else { found.velocity[at] };
            y - Interval::point(self.problem.shift()[at]) - Interval::point(self.problem.row_compliance(at)) * impulse[at]
        };
        let size = |differences: Vec<f64>| enlarged(differences.iter().fold(0.0_f64, |sum, d| enlarged(sum.hypot(*d), 1)), 1);
        let part = if planted(Plant::Radius) { 0.5 } else { 1.0 };
        let bound = |differences: Vec<f64>| if differences.iter().all(|d| *d == 0.0) { 0.0 } else { part * size(differences) };
        let all = 0..self.contacts.len();
        let told = |k: usize| self.contacts[k].told(cases[k], &of(impulse, k, rows)[..rows], &of(&found.velocity, k, rows)[..rows]);
        let velocity = |k: usize| (0..rows).map(|row| contact(k, row).reach(self.answer.velocity[k * rows + row])).collect();
        let moved = |k: usize| (0..rows).map(|row| impulse[k * rows + row].reach(self.answer.impulse[k * rows + row])).collect();
        Radius {
            velocity: all.clone().map(|k| bound(velocity(k))).collect(),
            impulse: all.clone().map(|k| bound(moved(k))).collect(),
            states: all.map(told).collect(),
            dependent: given,
            bodies: mechanism::moved(self.problem, impulse, &self.answer.impulse).map(|moved| moved.iter().map(|v| part * v).collect()),
        }
    }
}
