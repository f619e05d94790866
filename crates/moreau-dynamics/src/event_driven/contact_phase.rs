//! The motion between two events: which contacts are closed, and which of their complementary unknowns are not zero.
//!
//! ```text
//!     x = (q, v, p) ,   q̇ = v ,   v̇ and ṗ = G z from   N_BB z_B = −b_B ,  z elsewhere 0
//!     ends when    z_i < 0 in the basis B, or (Nz + b)_i < 0 outside;
//!                  a slipping contact stops, s u_t < 0;   an open contact closes, φ < 0
//! ```
//! p collects the impulses of the contact forces. With B fixed the motion is as smooth as the mechanism, so that a step keeps its order.

use super::flight::Phase;
use super::forces::{Accelerations, Closed, Tangent};
use crate::least_squares::least_squares;
use crate::mechanics::Mechanism;
use crate::tolerance::event_driven::DEGENERATE;
use moreau_contact::problem::Lcp;
use moreau_contact::tolerance::solvers::smallest_pivot;
use moreau_exact::Result;
use nalgebra::{DMatrix, DVector};

/// A mode of a mechanism with contacts.
pub struct ContactPhase<'a> {
    mechanism: &'a dyn Mechanism,
    /// The closed contacts.
    pub closed: Vec<Closed>,
    open: Vec<usize>,
    basis: Vec<bool>,
    /// Sizes of z \[N\] and of accelerations \[m/s²\] at the start.
    scales: [f64; 2],
}

impl<'a> ContactPhase<'a> {
    /// The phase that begins at (q, v) with these contacts touching and not parting; `ahead` is where the basis is decided, the state
    /// itself or one that the last phase reaches a moment later.
    ///
    /// # Errors
    /// Those of [`Accelerations::solve`].
    pub fn new(mechanism: &'a dyn Mechanism, mut closed: Vec<Closed>, candidates: usize, ahead: [&DVector<f64>; 2]) -> Result<Self> {
        let open = (0..candidates).filter(|&k| closed.iter().all(|one| one.contact != k)).collect();
        let mut decided = decide(mechanism, &closed, ahead)?;
        if start_slips(&mut closed, &decided) {
            decided = decide(mechanism, &closed, ahead)?;
        }
        let scales = decided.scales();
        let basis = decided.z.iter().map(|z| *z > DEGENERATE * scales[0]).collect();
        Ok(ContactPhase { mechanism, closed, open, basis, scales })
    }

    /// q and v of a state x.
    pub fn split(&self, x: &DVector<f64>) -> [DVector<f64>; 2] {
        let n = self.mechanism.degrees_of_freedom();
        [x.rows(0, n).into_owned(), x.rows(n, n).into_owned()]
    }

    /// x at the start of the phase, with no impulse yet.
    pub fn joined(&self, position: &DVector<f64>, velocity: &DVector<f64>) -> DVector<f64> {
        let impulses = self.mechanism.rows_per_contact() * self.closed.len();
        let entries = position.iter().chain(velocity).copied().chain(std::iter::repeat_n(0.0, impulses));
        DVector::from_iterator(2 * position.len() + impulses, entries)
    }

    /// Whether this entry of [`Phase::events`] is the gap of an open contact.
    pub fn is_gap(&self, event: usize) -> bool {
        let slipping = self.closed.iter().filter(|one| matches!(one.tangent, Tangent::Slipping(_))).count();
        event >= self.basis.len() + slipping
    }

    /// The forces of this basis at a state.
    fn forces(&self, position: &DVector<f64>, velocity: &DVector<f64>) -> Result<(Accelerations, DVector<f64>)> {
        let problem = Accelerations::new(self.mechanism, &self.closed, position, velocity)?;
        let z = on_basis(&problem.lcp, &self.basis)?;
        Ok((problem, z))
    }
}

/// A solution of the acceleration problem, to choose a basis by.
struct Decided {
    lcp: Lcp<f64>,
    z: DVector<f64>,
}

impl Decided {
    fn scales(&self) -> [f64; 2] {
        let pull = self.lcp.vector.amax().max(f64::MIN_POSITIVE);
        [pull / self.lcp.matrix.amax().max(f64::MIN_POSITIVE), pull]
    }
}

fn decide(mechanism: &dyn Mechanism, closed: &[Closed], [position, velocity]: [&DVector<f64>; 2]) -> Result<Decided> {
    let problem = Accelerations::new(mechanism, closed, position, velocity)?;
    let z = if closed.is_empty() { DVector::zeros(0) } else { problem.solve()? };
    Ok(Decided { lcp: problem.lcp, z })
}

/// Lets the sticking contacts slip that cannot be held: those with σ > 0, in the direction of a_t.
fn start_slips(closed: &mut [Closed], decided: &Decided) -> bool {
    let slack = decided.lcp.slack(&decided.z);
    let limit = DEGENERATE * decided.scales()[1];
    let (mut at, mut any) = (0, false);
    for one in closed {
        let unknowns = one.unknowns();
        if one.tangent == Tangent::Sticking && decided.z[at + 3] > limit {
            let acceleration = slack[at + 1] - decided.z[at + 3];
            (one.tangent, any) = (Tangent::Slipping(acceleration.signum()), true);
        }
        at += unknowns;
    }
    any
}

/// z with N_BB z_B = −b_B and zeros elsewhere.
fn on_basis(lcp: &Lcp<f64>, basis: &[bool]) -> Result<DVector<f64>> {
    let members: Vec<usize> = (0..basis.len()).filter(|&i| basis[i]).collect();
    let mut z = DVector::zeros(basis.len());
    if members.is_empty() {
        return Ok(z);
    }
    let matrix = DMatrix::from_fn(members.len(), members.len(), |i, j| lcp.matrix[(members[i], members[j])]);
    let right = DVector::from_fn(members.len(), |i, _| -lcp.vector[members[i]]);
    // redundant contacts share their forces in several ways that give one acceleration: the least is taken
    let values = least_squares("event-driven", matrix, &right, |largest| smallest_pivot::<f64>() * largest)?;
    for (&member, value) in members.iter().zip(values.iter()) {
        z[member] = *value;
    }
    Ok(z)
}

impl Phase for ContactPhase<'_> {
    fn rate(&self, x: &DVector<f64>) -> Result<DVector<f64>> {
        let [position, velocity] = self.split(x);
        let (problem, z) = self.forces(&position, &velocity)?;
        let acceleration = problem.acceleration(&z);
        let forces = problem.forces(&z);
        Ok(DVector::from_iterator(x.len(), velocity.iter().chain(acceleration.iter()).chain(forces.iter()).copied()))
    }

    fn events(&self, x: &DVector<f64>) -> Result<Vec<f64>> {
        let [position, velocity] = self.split(x);
        let (problem, z) = self.forces(&position, &velocity)?;
        let slack = problem.lcp.slack(&z);
        let [force, pull] = self.scales;
        let sign = |i: usize| if self.basis[i] { z[i] / force + DEGENERATE } else { slack[i] / pull + DEGENERATE };
        let contacts = self.mechanism.contacts(&position);
        let slips = self.closed.iter().filter_map(|one| match one.tangent {
            Tangent::Slipping(sign) => Some(sign * (&contacts[one.contact].jacobian * &velocity)[1]),
            _ => None,
        });
        let gaps = self.open.iter().map(|&k| contacts[k].gap);
        Ok((0..z.len()).map(sign).chain(slips).chain(gaps).collect())
    }
}
