//! A contact problem with joints: contacts, limits of one row, and bilateral constraints of one to six rows, on one W.
//!
//! ```text
//!     y = W r + u_free + shift + R r
//!     contact     (r_k, y_k) in the law              `dimension` rows
//!     limit       0 ≤ r_k ⟂ y_k ≥ 0                  1 row
//!     bilateral   y_k = 0 ,  r_k free                1 to 6 rows
//! ```
//! Rows stand in the order of the constraints. A [`ContactProblem`] is what is left once the bilateral rows are eliminated, or once their
//! impulses are given: [`unilateral`](JointedProblem::unilateral) makes it. A limit is there a contact without friction; its tangential
//! rows, where contacts have some, move nothing else and have no velocity.

mod by_rows;

use super::contact_problem::{finite, finite_matrix, not_negative, validate_dynamics};
use super::keys::two_bodies;
use super::{Compliance, ContactKey, ContactProblem, ContactProblemBuilder, Coordinates, Dynamics, Law};
use moreau_exact::{Error, Result};
use nalgebra::{DMatrix, DVector};
use std::ops::Range;

pub(crate) use by_rows::ByRows;

/// What a constraint of a [`JointedProblem`] is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ConstraintKind {
    /// A contact under the problem's law, of as many rows as its contacts have.
    Contact,
    /// One unilateral row: a joint at its stop.
    Limit,
    /// y_k = 0 with any impulse: a hinge, a rod, a weld.
    Bilateral {
        /// How many rows, 1 to 6.
        rows: usize,
    },
}

/// Most rows of a bilateral constraint: two bodies in space welded together.
pub const MOST_ROWS: usize = 6;

/// One step's contacts, limits and bilateral constraints, valid since it was made.
///
/// A bob of 1 kg on a rod of 1 m, 45° from the wall: the rod takes what would stretch it, and the wall stops what is left of 1 m/s.
/// ```
/// use moreau_contact::nalgebra::{self, dmatrix, dvector};
/// use moreau_contact::problem::{ConstraintKind, JointedProblem};
/// use moreau_contact::certificate::joints::jointed_residuals;
/// use moreau_contact::solvers::{Auto, solve_jointed};
/// use moreau_contact::Law;
///
/// let half = 0.5_f64.sqrt(); // wall normal (1, 0), rod (half, half)
/// let kinds = vec![ConstraintKind::Contact, ConstraintKind::Bilateral { rows: 1 }];
/// let bob = JointedProblem::new(1, kinds, dmatrix![1.0, half; half, 1.0], dvector![-1.0, -half])?.law(Law::Frictionless, vec![0.0; 2])?;
/// let answer = solve_jointed(&bob, &Auto, None)?;
/// assert!(jointed_residuals(&bob, &answer)?.is_solution(1e-8));
/// assert!((answer.impulse[0] - 1.0).abs() < 1e-12 && answer.impulse[1].abs() < 1e-12);
/// # Ok::<(), moreau_contact::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct JointedProblem {
    name: String,
    rows_per_contact: usize,
    law: Law,
    kinds: Vec<ConstraintKind>,
    /// Where the rows of each constraint begin, and the end.
    starts: Vec<usize>,
    friction: Vec<f64>,
    delassus: DMatrix<f64>,
    free_velocity: DVector<f64>,
    shift: DVector<f64>,
    softness: DVector<f64>,
    bodies: Option<Vec<[Option<usize>; 2]>>,
    keys: Option<Vec<ContactKey>>,
    dynamics: Option<Dynamics>,
}

impl JointedProblem {
    /// Begins with W \[1/kg\] and u_free \[m/s\] of all rows, without friction, shift and softness.
    ///
    /// # Errors
    /// [`Error::Invalid`] names the field whose size or number does not fit.
    pub fn new(rows_per_contact: usize, kinds: Vec<ConstraintKind>, delassus: DMatrix<f64>, free_velocity: DVector<f64>) -> Result<Self> {
        let starts = starts(rows_per_contact, &kinds)?;
        let rows = *starts.last().expect("the end is there");
        let problem = JointedProblem {
            name: String::new(),
            rows_per_contact,
            law: Law::Coulomb,
            friction: vec![0.0; kinds.len()],
            kinds,
            starts,
            delassus,
            free_velocity,
            shift: DVector::zeros(rows),
            softness: DVector::zeros(rows),
            bodies: None,
            keys: None,
            dynamics: None,
        };
        for (field, size) in
            [("delassus", problem.delassus.nrows()), ("delassus", problem.delassus.ncols()), ("free_velocity", problem.free_velocity.len())]
        {
            problem.require_rows(field, size)?;
        }
        finite_matrix("delassus", &problem.delassus)?;
        finite("free_velocity", problem.free_velocity.as_slice())?;
        Ok(problem)
    }

    /// The same with a name for messages.
    #[must_use]
    pub fn named(self, name: impl Into<String>) -> Self {
        JointedProblem { name: name.into(), ..self }
    }

    /// The same under this law, with μ ≥ 0 of every constraint; 0 of limits and bilateral ones.
    ///
    /// # Errors
    /// [`Error::Invalid`] where the law does not fit the rows of a contact, or a constraint without friction has some.
    pub fn law(self, law: Law, friction: Vec<f64>) -> Result<Self> {
        self.require_one_each("friction", friction.len())?;
        not_negative("friction", &friction)?;
        let without = |kind: &ConstraintKind| *kind != ConstraintKind::Contact;
        if let Some(k) = (0..friction.len()).find(|&k| without(&self.kinds[k]) && friction[k] != 0.0) {
            let problem = format!("is {} at {}", friction[k], words(self.kinds[k]));
            return Err(Error::invalid(format!("friction[{k}]"), problem, "use 0: contacts alone have friction"));
        }
        JointedProblem { law, friction, ..self }.checked()
    }

    /// The same with what the scheme adds to y \[m/s\], as the stabilisation of a joint.
    ///
    /// # Errors
    /// [`Error::Invalid`] where there is not one finite number per row.
    pub fn shift(self, shift: DVector<f64>) -> Result<Self> {
        self.require_rows("shift", shift.len())?;
        finite("shift", shift.as_slice())?;
        Ok(JointedProblem { shift, ..self })
    }

    /// The same with R of every row \[1/kg\], 0 where it is hard.
    ///
    /// # Errors
    /// [`Error::Invalid`] where there is not one number ≥ 0 per row.
    pub fn softness(self, softness: DVector<f64>) -> Result<Self> {
        self.require_rows("compliance.diagonal", softness.len())?;
        not_negative("compliance.diagonal", softness.as_slice())?;
        Ok(JointedProblem { softness, ..self })
    }

    /// The same with the two bodies of every constraint, and with what tells each from the others.
    ///
    /// # Errors
    /// [`Error::Invalid`] where there is not one of each per constraint, or one names the same body twice.
    pub fn between(self, bodies: Option<Vec<[Option<usize>; 2]>>, keys: Option<Vec<ContactKey>>) -> Result<Self> {
        for (k, pair) in bodies.iter().flatten().enumerate() {
            two_bodies("bodies", k, *pair)?;
        }
        for (k, key) in keys.iter().flatten().enumerate() {
            two_bodies("keys", k, key.bodies)?;
        }
        let sizes = [("bodies", bodies.as_ref().map(Vec::len)), ("keys", keys.as_ref().map(Vec::len))];
        sizes.into_iter().try_for_each(|(field, size)| size.map_or(Ok(()), |size| self.require_one_each(field, size)))?;
        JointedProblem { bodies, keys, ..self }.checked()
    }

    /// The same with the mass and Jacobian that W came from, of all rows; or `None`.
    ///
    /// # Errors
    /// [`Error::Invalid`] where they do not fit the rows, or a number is not finite.
    pub fn made_of(self, dynamics: Option<Dynamics>) -> Result<Self> {
        if let Some(dynamics) = &dynamics {
            validate_dynamics(dynamics, self.rows())?;
        }
        Ok(JointedProblem { dynamics, ..self })
    }

    /// The mass and Jacobian that W came from, of all rows, where known.
    pub fn dynamics(&self) -> Option<&Dynamics> {
        self.dynamics.as_ref()
    }

    /// A name for messages.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The law of its contacts.
    pub fn contact_law(&self) -> Law {
        self.law
    }

    /// Rows of a contact: 1, 2 or 3.
    pub fn rows_per_contact(&self) -> usize {
        self.rows_per_contact
    }

    /// What each constraint is.
    pub fn kinds(&self) -> &[ConstraintKind] {
        &self.kinds
    }

    /// μ of each constraint.
    pub fn friction(&self) -> &[f64] {
        &self.friction
    }

    /// W of all rows \[1/kg\].
    pub fn delassus(&self) -> &DMatrix<f64> {
        &self.delassus
    }

    /// u_free of all rows \[m/s\].
    pub fn free_velocity(&self) -> &DVector<f64> {
        &self.free_velocity
    }

    /// What the scheme adds to y, of all rows \[m/s\].
    pub fn shifts(&self) -> &DVector<f64> {
        &self.shift
    }

    /// R of all rows \[1/kg\].
    pub fn softnesses(&self) -> &DVector<f64> {
        &self.softness
    }

    /// The two bodies of each constraint, where known.
    pub fn bodies(&self) -> Option<&[[Option<usize>; 2]]> {
        self.bodies.as_deref()
    }

    /// What tells each constraint from the others, where known.
    pub fn keys(&self) -> Option<&[ContactKey]> {
        self.keys.as_deref()
    }

    /// Number of rows of all constraints.
    pub fn rows(&self) -> usize {
        self.free_velocity.len()
    }

    /// The rows of constraint k.
    ///
    /// # Panics
    /// If there is no such constraint.
    pub fn rows_of(&self, k: usize) -> Range<usize> {
        self.starts[k]..self.starts[k + 1]
    }

    /// The constraints that push only: contacts and limits.
    pub fn pushing(&self) -> Vec<usize> {
        (0..self.kinds.len()).filter(|&k| !matches!(self.kinds[k], ConstraintKind::Bilateral { .. })).collect()
    }

    /// The bilateral constraints.
    pub fn bilateral(&self) -> Vec<usize> {
        (0..self.kinds.len()).filter(|&k| matches!(self.kinds[k], ConstraintKind::Bilateral { .. })).collect()
    }

    /// u = W r + u_free \[m/s\] for impulses r \[N·s\] of all rows.
    pub fn velocity(&self, impulse: &DVector<f64>) -> DVector<f64> {
        &self.delassus * impulse + &self.free_velocity
    }

    /// The contact problem of contacts and limits with this W \[1/kg\] and this u_free \[m/s\] of all rows in place of its own; those of
    /// bilateral rows are not read. Constraint [`pushing`](Self::pushing)\[i\] is contact i of it.
    ///
    /// # Errors
    /// [`Error::Invalid`] where the law does not fit the rows of a contact.
    pub fn unilateral(&self, delassus: &DMatrix<f64>, free_velocity: &DVector<f64>) -> Result<ContactProblem> {
        let pushing = self.pushing();
        self.of_units(&self.units(&pushing), delassus, free_velocity)
            .bodies(self.bodies.as_ref().map(|bodies| pushing.iter().map(|k| bodies[*k]).collect::<Vec<_>>()))
            .keys(self.keys.as_ref().map(|keys| pushing.iter().map(|k| keys[*k]).collect::<Vec<_>>()))
            .build()
    }

    /// The contact problem of these rows, each with the constraint that it is of: as many as a contact has, or one, beside which rows stand
    /// that move nothing else.
    fn of_units(&self, units: &[(usize, Range<usize>)], delassus: &DMatrix<f64>, free_velocity: &DVector<f64>) -> ContactProblemBuilder {
        let (places, size) = (self.places(units), units.len() * self.rows_per_contact);
        let mut w = DMatrix::zeros(size, size);
        for (from, to) in &places {
            places.iter().for_each(|(column, at)| w[(*to, *at)] = delassus[(*from, *column)]);
        }
        for (i, (_, rows)) in units.iter().enumerate() {
            let first = i * self.rows_per_contact;
            let own = if w[(first, first)] > 0.0 { w[(first, first)] } else { 1.0 };
            (first + rows.len()..first + self.rows_per_contact).for_each(|row| w[(row, row)] = own);
        }
        let spread = |all: &DVector<f64>| {
            let mut spread = DVector::zeros(size);
            places.iter().for_each(|(from, to)| spread[*to] = all[*from]);
            spread
        };
        let soft = self.softness.iter().any(|soft| *soft != 0.0);
        let compliance = soft.then(|| Compliance { coordinates: Coordinates::Contact, diagonal: spread(&self.softness) });
        ContactProblem::new(w, spread(free_velocity))
            .name(self.name.clone())
            .law(self.law)
            .rows_per_contact(self.rows_per_contact)
            .friction(units.iter().map(|(k, _)| self.friction[*k]).collect())
            .shift(spread(&self.shift))
            .compliance(compliance)
    }

    /// Numbers of all rows as those of [`unilateral`](Self::unilateral), 0 at the tangential rows of limits.
    pub fn spread(&self, all: &DVector<f64>) -> DVector<f64> {
        let pushing = self.pushing();
        let mut spread = DVector::zeros(pushing.len() * self.rows_per_contact);
        self.places(&self.units(&pushing)).iter().for_each(|(from, to)| spread[*to] = all[*from]);
        spread
    }

    /// Puts numbers of [`unilateral`](Self::unilateral) to their rows in those of all.
    pub fn gather(&self, spread: &DVector<f64>, all: &mut DVector<f64>) {
        self.places(&self.units(&self.pushing())).iter().for_each(|(to, from)| all[*to] = spread[*from]);
    }

    /// Refuses a list that has not one number per row.
    ///
    /// # Errors
    /// [`Error::Invalid`] names the field, its size and that of the problem.
    pub fn require_rows(&self, field: &str, size: usize) -> Result<()> {
        let rows = *self.starts.last().expect("the end is there");
        require(field, size, rows, &format!("the rows of the {} `kinds`", self.kinds.len()))
    }

    /// Constraints with all of their rows.
    fn units(&self, constraints: &[usize]) -> Vec<(usize, Range<usize>)> {
        constraints.iter().map(|k| (*k, self.rows_of(*k))).collect()
    }

    /// Row of all, row of the contact problem.
    fn places(&self, units: &[(usize, Range<usize>)]) -> Vec<(usize, usize)> {
        let own = |(i, (_, rows)): (usize, &(usize, Range<usize>))| {
            rows.clone().enumerate().map(move |(row, at)| (at, i * self.rows_per_contact + row)).collect::<Vec<_>>()
        };
        units.iter().enumerate().flat_map(own).collect()
    }

    fn require_one_each(&self, field: &str, size: usize) -> Result<()> {
        require(field, size, self.kinds.len(), "one for each of the `kinds`")
    }

    /// Itself, if its contacts make a valid problem.
    fn checked(self) -> Result<Self> {
        self.unilateral(&self.delassus, &self.free_velocity)?;
        Ok(self)
    }
}

fn require(field: &str, size: usize, needed: usize, what: &str) -> Result<()> {
    if size == needed {
        return Ok(());
    }
    Err(Error::invalid(field, format!("has size {size}"), format!("give size {needed}, {what}")))
}

/// A kind in a sentence.
fn words(kind: ConstraintKind) -> &'static str {
    match kind {
        ConstraintKind::Contact => "a contact",
        ConstraintKind::Limit => "a limit",
        ConstraintKind::Bilateral { .. } => "a bilateral constraint",
    }
}

/// Refuses so many rows where W and its elimination take more memory than is allowed.
#[cfg(feature = "files")]
pub(super) fn require_room(rows: usize) -> Result<()> {
    /// Square matrices that are alive while a problem is read, eliminated and judged.
    const MATRICES: u128 = 6;
    crate::memory::require("storing and solving this problem with joints", crate::memory::matrix(rows, rows).saturating_mul(MATRICES))
}

/// Where the rows of each constraint begin, and the end.
pub(super) fn starts(rows_per_contact: usize, kinds: &[ConstraintKind]) -> Result<Vec<usize>> {
    let mut starts = vec![0];
    for (k, kind) in kinds.iter().enumerate() {
        let rows = match *kind {
            ConstraintKind::Contact => rows_per_contact,
            ConstraintKind::Limit => 1,
            ConstraintKind::Bilateral { rows } if (1..=MOST_ROWS).contains(&rows) => rows,
            ConstraintKind::Bilateral { rows } => {
                let problem = format!("has {rows} bilateral rows");
                return Err(Error::invalid(format!("kinds[{k}]"), problem, format!("use 1 to {MOST_ROWS}, or several constraints")));
            }
        };
        starts.push(starts[k] + rows);
    }
    Ok(starts)
}

#[cfg(test)]
mod tests;
