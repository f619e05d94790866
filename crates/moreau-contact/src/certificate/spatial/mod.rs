//! All velocities of a problem with at most three contacts in space under Coulomb's law, by pieces of which each is decided in intervals.
//!
//! ```text
//!     { (r, y) of the law } = ⋃ pieces :      open, sticking, or sliding in one of four quarters of the circle, at every contact
//! ```
//! A piece has no solution if a vector separates its impulses from its velocities (`separation`), or if the bounds of its linear
//! equations contradict an inequality (`bounds`). It has at most one velocity if the equation for the difference of two is regular; near
//! the candidate from Newton's method a solution is then proved as for any answer ([`forward`]). All other pieces are halved along their
//! longest arc. What is left when the arcs are too short, or the pieces too many, is undecided and named: *exactly k* is said only
//! where nothing is left. It is said of W as it is stored and, where M̂ and H are known, of the exact H M̂⁻¹ Hᵀ as well; of the latter
//! alone where rows of H depend on each other, for those of a rounded W need not.

mod arc;
mod bounds;
mod candidate;
mod piece;
mod separation;
mod system;
#[cfg(test)]
mod tests;

use super::forward::{ContactState, Forward, Radius, Reason, forward};
use super::interval::Interval;
use super::several::apart;
use crate::problem::{ContactProblem, Law, Solution};
use crate::tolerance::proof::{BEYOND, NARROWEST, PIECES, SPATIAL_CONTACTS};
use arc::Arc;
use moreau_exact::{Error, Result};
use piece::{Data, Doing, Rows};

/// Every velocity there is, near these answers, but for what is undecided.
#[derive(Clone, Debug, PartialEq)]
pub struct Velocities {
    /// Answers with a solution within their radii; the velocities of any two of these solutions are different.
    pub found: Vec<(Solution, Radius)>,
    /// Where further velocities may be.
    pub undecided: Vec<Reason>,
    /// Patterns of open, sticking and sliding contacts: all there are.
    pub patterns: usize,
    /// Pieces that were looked at.
    pub pieces: usize,
}

impl Velocities {
    /// How many velocities there are, if that is decided.
    pub fn exactly(&self) -> Option<usize> {
        self.undecided.is_empty().then_some(self.found.len())
    }
}

/// All velocities of a problem in space.
///
/// # Errors
/// [`Error::Unsupported`] for more than [`SPATIAL_CONTACTS`] contacts, contacts in the plane, other laws and compliant contacts.
/// ```
/// use moreau_contact::certificate::spatial::velocities;
/// use moreau_contact::nalgebra::{DMatrix, dvector};
/// use moreau_contact::ContactProblem;
///
/// // Painlevé's rod in space: pushed along twice as much as away, it lifts off, slides or is jammed
/// let w = DMatrix::from_row_slice(3, 3, &[1.0, 2.0, 0.0, 2.0, 5.0, 0.0, 0.0, 0.0, 1.0]);
/// let rod = |free: f64| ContactProblem::new(w.clone(), dvector![free, 4.0, 0.0]).friction(vec![1.0]).build();
/// assert_eq!(velocities(&rod(1.0)?)?.exactly(), Some(3));
/// assert_eq!(velocities(&rod(9.0)?)?.exactly(), Some(1));
/// # Ok::<(), moreau_contact::Error>(())
/// ```
pub fn velocities(problem: &ContactProblem) -> Result<Velocities> {
    let space = problem.rows_per_contact() == 3 && problem.law() == Law::Coulomb;
    if !space || problem.compliance().is_some() || problem.contacts() > SPATIAL_CONTACTS {
        let text = format!("all directions of slip are tried with hard contacts in space under Coulomb's law, {SPATIAL_CONTACTS} at most");
        return Err(Error::Unsupported(text));
    }
    searched(problem, patterns(problem), &Arc::QUARTERS)
}

/// The velocities of these patterns, with slip along these arcs.
fn searched(problem: &ContactProblem, patterns: Vec<Vec<Doing>>, arcs: &[Arc]) -> Result<Velocities> {
    let data = Data::new(problem);
    let mut search = Search { data: &data, all: Velocities { found: Vec::new(), undecided: Vec::new(), patterns: 0, pieces: 0 } };
    for pattern in patterns {
        search.all.patterns += 1;
        search.decide(&pattern, arcs)?;
    }
    Ok(search.all)
}

/// All patterns, with one arc for every sliding contact.
fn patterns(problem: &ContactProblem) -> Vec<Vec<Doing>> {
    let doings = |mu: f64| match mu > 0.0 {
        true => vec![Doing::Open, Doing::Sticking, Doing::Sliding(Arc::QUARTERS[0])],
        false => vec![Doing::Open, Doing::Pressing],
    };
    product(&problem.friction().iter().map(|mu| doings(*mu)).collect::<Vec<_>>())
}

/// The pieces that a pattern is cut into.
fn cut(pattern: &[Doing], arcs: &[Arc]) -> Vec<Vec<Doing>> {
    let choices = |doing: &Doing| match doing {
        Doing::Sliding(_) => arcs.iter().copied().map(Doing::Sliding).collect(),
        other => vec![*other],
    };
    product(&pattern.iter().map(choices).collect::<Vec<_>>())
}

fn product(choices: &[Vec<Doing>]) -> Vec<Vec<Doing>> {
    choices.iter().fold(vec![Vec::new()], |made, choices| {
        made.iter().flat_map(|first| choices.iter().map(|last| [first.as_slice(), &[*last]].concat())).collect()
    })
}

/// What was decided about a piece.
enum Seen {
    Nothing,
    /// All of this larger piece has one velocity, near this answer.
    One(Vec<Doing>, Box<(Solution, Radius)>),
    /// All of this larger piece has one velocity, that of a solution that is found already.
    Again(Vec<Doing>),
    Unknown,
}

struct Search<'a> {
    data: &'a Data<'a>,
    all: Velocities,
}

impl Search<'_> {
    fn decide(&mut self, pattern: &[Doing], arcs: &[Arc]) -> Result<()> {
        let Some(rows) = Rows::new(self.data.problem, pattern) else {
            self.leave(pattern, "which rows depend on others is not decided");
            return Ok(());
        };
        let (mut known, mut waiting, mut left): (Vec<Vec<Doing>>, _, _) = (Vec::new(), cut(pattern, arcs), PIECES);
        while let Some(piece) = waiting.pop() {
            if known.iter().any(|known| covers(known, &piece)) {
                continue;
            }
            if left == 0 {
                self.leave(&piece, "the pieces are too many");
                break;
            }
            left -= 1;
            self.all.pieces += 1;
            match self.look(&rows, &piece)? {
                Seen::Nothing => {}
                Seen::Again(region) => known.push(region),
                Seen::One(region, met) => {
                    known.push(region);
                    self.add(pattern, *met);
                }
                Seen::Unknown => match halves(&piece) {
                    Some(halves) => waiting.extend(halves),
                    None => {
                        self.leave(&piece, "a solution is neither proved nor excluded");
                        break;
                    }
                },
            }
        }
        Ok(())
    }

    fn look(&self, rows: &Rows, piece: &[Doing]) -> Result<Seen> {
        let found = bounds::bounds(self.data, rows, piece);
        if found.as_ref().is_some_and(|found| bounds::refuted(self.data, rows, piece, found)) || separation::separated(self.data, piece) {
            return Ok(Seen::Nothing);
        }
        if found.is_none() {
            return Ok(Seen::Unknown);
        }
        let Some(near) = candidate::candidate(self.data, rows, piece) else { return Ok(Seen::Unknown) };
        let Some(region) = around(piece, rows, &near.directions) else { return Ok(Seen::Unknown) };
        let Some(found) = bounds::bounds(self.data, rows, &region) else { return Ok(Seen::Unknown) };
        if !bounds::has_one_velocity(self.data, rows, &region, &found) {
            return Ok(Seen::Unknown);
        }
        if self.all.found.iter().any(|(answer, radius)| self.is_inside(&region, answer, radius)) {
            return Ok(Seen::Again(region));
        }
        Ok(match forward(self.data.problem, &near.answer)? {
            Forward::Proved(radius) if self.is_inside(&region, &near.answer, &radius) => Seen::One(region, Box::new((near.answer, radius))),
            _ => Seen::Unknown,
        })
    }

    /// Whether the solution near this answer is in this piece.
    fn is_inside(&self, piece: &[Doing], answer: &Solution, radius: &Radius) -> bool {
        piece.iter().enumerate().all(|(k, doing)| {
            let slip = || {
                [1, 2].map(|i| {
                    let row = 3 * k + i;
                    Interval::ball(answer.velocity[row], radius.velocity[k]) + Interval::point(self.data.problem.shift()[row])
                })
            };
            match (doing, radius.states[k]) {
                (Doing::Open, ContactState::Open) | (Doing::Pressing, ContactState::Pressing) => true,
                (Doing::Sticking, ContactState::Sticking) => true,
                (Doing::Sliding(arc), ContactState::Sliding) => arc.points_inside(slip()),
                _ => false,
            }
        })
    }

    fn add(&mut self, pattern: &[Doing], met: (Solution, Radius)) {
        let is_new = self.all.found.iter().all(|(other, near)| apart(3, [&met.0, other], [&met.1, near]));
        if is_new {
            self.all.found.push(met);
        } else {
            self.leave(pattern, "a solution is not told apart from another one");
        }
    }

    fn leave(&mut self, piece: &[Doing], why: &str) {
        let name = |doing: &Doing| match doing {
            Doing::Open => "open",
            Doing::Pressing => "pressing",
            Doing::Sticking => "sticking",
            Doing::Sliding(_) => "sliding",
        };
        let pattern: Vec<&str> = piece.iter().map(name).collect();
        let text = format!("{why} where the contacts are {}", pattern.join(", "));
        self.all.undecided.push(Reason { text, contact: piece.iter().position(|doing| doing.arc().is_some()) });
    }
}

/// Both halves of the longest arc; none if no arc is long enough.
fn halves(piece: &[Doing]) -> Option<[Vec<Doing>; 2]> {
    let arcs = piece.iter().enumerate().filter_map(|(k, doing)| doing.arc().map(|arc| (k, arc)));
    let (k, arc) = arcs.max_by(|(_, one), (_, other)| one.width().total_cmp(&other.width()))?;
    let with = |half: Arc| piece.iter().enumerate().map(|(i, doing)| if i == k { Doing::Sliding(half) } else { *doing }).collect();
    (arc.width() > NARROWEST).then(|| arc.halves().map(with))
}

/// The piece, with arcs that reach beyond these directions.
fn around(piece: &[Doing], rows: &Rows, directions: &[[f64; 2]]) -> Option<Vec<Doing>> {
    let wider = |(k, doing): (usize, &Doing)| match doing {
        Doing::Sliding(arc) => {
            let place = rows.sliding.iter().position(|sliding| *sliding == k)?;
            arc.around(directions[place], BEYOND).map(Doing::Sliding)
        }
        other => Some(*other),
    };
    piece.iter().enumerate().map(wider).collect()
}

fn covers(known: &[Doing], piece: &[Doing]) -> bool {
    known.iter().zip(piece).all(|(known, doing)| match (known.arc(), doing.arc()) {
        (Some(known), Some(arc)) => known.covers(arc),
        _ => true,
    })
}
