//! Block projected Gauss–Seidel: contact after contact,
//! ```text
//!     r_k ← the answer of contact k alone with q_k = (u_free + shift)_k + Σ_{j≠k} W_kj r_j .
//! ```
//! Each contact is solved to rounding (`one_contact`). For symmetric positive semidefinite W and a convex law the
//! sweeps descend on ½rᵀ(W+R)r + (u_free+shift)ᵀr and converge; for Coulomb's law they usually do, and the certificate tells.
//!
//! Accelerated sweeps keep their best iterate and return it. Sweeps that no longer halve its residual have stalled and end with it too;
//! plain sweeps that reach their declared number return the last one.

use super::ContactSolver;
use super::anderson::Anderson;
use super::one_contact::OneContact;
use super::stopping::Stopping;
use crate::problem::{ContactProblem, Law, Solution};
use crate::tolerance::solvers as tolerance;
use moreau_exact::{Error, Result};
use nalgebra::{DVector, Matrix3, Vector3};

/// Block projected Gauss–Seidel for the frictionless, Coulomb and associated laws and, at spatial contacts, polyhedral Coulomb; W may be
/// asymmetric and rank deficient.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProjectedGaussSeidel {
    /// Sweep limit.
    pub sweeps: usize,
    /// Stops when the certificate's residuals of every contact are at most this times their scale.
    pub tolerance: f64,
    /// How many past sweeps Anderson's acceleration extrapolates from; 0 are plain sweeps.
    pub memory: usize,
}

impl ProjectedGaussSeidel {
    /// Accelerated sweeps: far fewer where many bodies stand on each other, no guarantee of descent.
    pub fn accelerated() -> Self {
        ProjectedGaussSeidel { memory: tolerance::MEMORY, ..ProjectedGaussSeidel::default() }
    }
}

impl Default for ProjectedGaussSeidel {
    fn default() -> Self {
        ProjectedGaussSeidel { sweeps: tolerance::SWEEPS, tolerance: tolerance::STOP, memory: 0 }
    }
}

/// Polyhedral Coulomb is solved at spatial contacts; in the plane it is an LCP better solved as one.
fn is_swept(law: Law, rows: usize) -> bool {
    match law {
        Law::PolyhedralCoulomb { .. } => rows == 3,
        Law::PolyhedralAssociated { .. } => false,
        _ => true,
    }
}

/// What a sweep works on: no sweep allocates.
struct Sweeper<'a> {
    problem: &'a ContactProblem,
    contacts: Vec<OneContact>,
    stopping: Stopping<'a>,
    /// r \[N·s\].
    impulse: DVector<f64>,
    /// y = u_free + shift + (W + R) r \[m/s\], updated column by column.
    law_velocity: DVector<f64>,
    best: Best,
    sweeps: usize,
}

impl ContactSolver for ProjectedGaussSeidel {
    fn name(&self) -> &'static str {
        "pgs"
    }

    fn takes(&self, law: Law, rows: usize, _symmetric: bool) -> bool {
        is_swept(law, rows)
    }

    fn solve(&self, problem: &ContactProblem, warm_start: Option<&DVector<f64>>) -> Result<Solution> {
        if !is_swept(problem.law(), problem.rows_per_contact()) {
            let reason = format!("does not solve the law `{}`; use `lemke` or `clarabel`", problem.law().name());
            return Err(Error::refused(self.name(), reason));
        }
        let impulse = super::start(problem, warm_start)?;
        let law_velocity = problem.law_velocity(&impulse);
        let stopping = Stopping::new(problem, self.tolerance);
        let contacts = (0..problem.contacts()).map(|k| prepare(problem, k)).collect::<Result<_>>()?;
        let best = Best::default();
        let mut sweeper = Sweeper { problem, contacts, stopping, impulse, law_velocity, best, sweeps: 0 };
        if self.memory == 0 {
            sweeper.plain(self)
        } else {
            sweeper.accelerated(self)
        }
        let sweeps = sweeper.sweeps;
        // plain sweeps that reach their declared number answer the last iterate
        let keeps_best = self.memory > 0 || sweeps < self.sweeps;
        let impulse = if keeps_best && sweeper.is_finite() { sweeper.best.impulse } else { sweeper.impulse };
        let velocity = problem.velocity(&impulse);
        super::finite(Solution::new(self.name(), impulse, velocity, sweeps))
    }
}

/// The iterate with the smallest relative residual so far, and the sweep that last halved that residual.
struct Best {
    relative: f64,
    impulse: DVector<f64>,
    /// The residual at the last mark, and the sweep of that mark. The next mark is set when the residual has halved.
    mark: (f64, usize),
}

impl Default for Best {
    fn default() -> Self {
        Best { relative: f64::INFINITY, impulse: DVector::zeros(0), mark: (f64::INFINITY, 0) }
    }
}

impl Best {
    fn offer(&mut self, relative: f64, impulse: &DVector<f64>, sweep: usize) {
        if relative < self.relative || self.impulse.is_empty() {
            self.relative = relative;
            self.impulse.clone_from(impulse);
        }
        if self.relative < 0.5 * self.mark.0 {
            self.mark = (self.relative, sweep);
        }
    }
}

impl Sweeper<'_> {
    /// Sweep after sweep.
    fn plain(&mut self, solver: &ProjectedGaussSeidel) {
        while self.measure(solver.tolerance) > solver.tolerance
            && self.sweeps < solver.sweeps
            && !self.has_stalled(tolerance::stalled(self.problem.contacts()))
        {
            if !self.sweep() || !self.is_finite() {
                break;
            }
        }
    }

    /// Alternates sweeps with extrapolations by Anderson's method. An extrapolation that makes the residual grow is undone, and the method
    /// forgets its past sweeps.
    fn accelerated(&mut self, solver: &ProjectedGaussSeidel) {
        let patience = tolerance::accelerated_stalled(self.problem.contacts());
        let mut anderson = Anderson::new(solver.memory);
        let mut before = self.impulse.clone();
        let mut relative = self.measure(solver.tolerance);
        while relative > solver.tolerance && self.sweeps < solver.sweeps && !self.has_stalled(patience) {
            before.clone_from(&self.impulse);
            if !self.sweep() || !self.is_finite() || self.sweeps == solver.sweeps {
                self.measure(solver.tolerance);
                break;
            }
            let plain = self.measure(solver.tolerance);
            if plain <= solver.tolerance {
                break;
            }
            let image = self.impulse.clone();
            self.jump(anderson.next(&before, &image));
            relative = self.measure(solver.tolerance);
            if relative > plain.max(tolerance::GROWTH * self.best.relative) {
                relative = plain;
                self.jump(image);
                anderson = Anderson::new(solver.memory);
            }
        }
    }

    fn has_stalled(&self, patience: usize) -> bool {
        self.sweeps - self.best.mark.1 > patience
    }

    fn is_finite(&self) -> bool {
        self.impulse.iter().all(|r| r.is_finite())
    }

    /// Solves every contact once; returns whether any impulse changed.
    fn sweep(&mut self) -> bool {
        let rows = self.problem.rows_per_contact();
        let mut moved = false;
        self.sweeps += 1;
        for (k, contact) in self.contacts.iter().enumerate() {
            let first = k * rows;
            let old = padded(&self.impulse.as_slice()[first..first + rows]);
            let y = padded(&self.law_velocity.as_slice()[first..first + rows]);
            let new = contact.solve(&(y - contact.block * old));
            let mut change = [0.0; 3];
            for row in 0..rows {
                change[row] = new[row] - old[row];
                self.impulse[first + row] = new[row];
            }
            if change.iter().any(|change| *change != 0.0) {
                moved = true;
                self.problem.add_contact(k, &change[..rows], self.law_velocity.as_mut_slice());
            }
        }
        moved
    }

    /// Replaces the impulses and computes y for them.
    fn jump(&mut self, impulse: DVector<f64>) {
        self.law_velocity = self.problem.law_velocity(&impulse);
        self.impulse = impulse;
    }

    /// The largest relative residual. If it is within the tolerance, it is measured again with a freshly computed y, because the updated y
    /// carries the rounding of earlier sweeps.
    fn measure(&mut self, tolerance: f64) -> f64 {
        let mut relative = self.stopping.relative(&self.impulse, &self.law_velocity);
        if relative <= tolerance {
            self.law_velocity = self.problem.law_velocity(&self.impulse);
            relative = self.stopping.relative(&self.impulse, &self.law_velocity);
        }
        self.best.offer(relative, &self.impulse, self.sweeps);
        relative
    }
}

/// The padded block of contact k, made definite and symmetric where its law needs it. Its difference from W_kk + R_kk
/// multiplies the previous impulse (a proximal step), so the fixed points stay those of the given problem.
fn prepare(problem: &ContactProblem, k: usize) -> Result<OneContact> {
    let rows = problem.rows_per_contact();
    let mut block = Matrix3::identity();
    for (i, j) in (0..rows).flat_map(|i| (0..rows).map(move |j| (i, j))) {
        block[(i, j)] = problem.entry(k * rows + i, k * rows + j);
    }
    for i in 0..rows {
        block[(i, i)] += super::compliance(problem, k * rows + i);
    }
    let trace: f64 = (0..rows).map(|i| block[(i, i)]).sum();
    for i in rows..3 {
        block[(i, i)] = trace / rows as f64;
    }
    if !matches!(problem.law(), Law::Coulomb | Law::PolyhedralCoulomb { .. }) {
        block = (block + block.transpose()) * 0.5;
    }
    let symmetric = (block + block.transpose()) * 0.5;
    let smallest = symmetric.symmetric_eigenvalues().min();
    if smallest < tolerance::PROXIMAL * trace {
        block += Matrix3::identity() * (tolerance::PROXIMAL * trace);
    }
    let friction = problem.friction()[k];
    let contact = match problem.law() {
        Law::Coulomb if friction > 0.0 => OneContact::coulomb(block, friction),
        Law::PolyhedralCoulomb { directions } if friction > 0.0 => OneContact::polyhedral(block, friction, directions),
        Law::Associated if friction > 0.0 => OneContact::associated(block, friction),
        _ => OneContact::frictionless(block),
    };
    contact.ok_or_else(|| {
        let reason = format!(
            "contact {k} has no positive definite diagonal block W_kk + R_kk, so it cannot be solved alone; remove it or give it compliance"
        );
        Error::refused("pgs", reason)
    })
}

fn padded(values: &[f64]) -> Vector3<f64> {
    Vector3::from_fn(|k, _| values.get(k).copied().unwrap_or(0.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::DMatrix;

    /// One contact of a unit mass on an incline of slope tan α at rest, step h: u_free = h g (−cos α, sin α).
    fn block(law: Law, friction: f64, slope: f64) -> ContactProblem {
        let (cos, sin) = (1.0 / slope.hypot(1.0), slope / slope.hypot(1.0));
        ContactProblem::new(DMatrix::identity(2, 2), DVector::from_vec(vec![-cos, sin]))
            .name("block")
            .law(law)
            .rows_per_contact(2)
            .friction(vec![friction])
            .build()
            .unwrap()
    }

    #[test]
    fn a_block_sticks_up_to_the_friction_angle_and_slides_beyond_under_both_laws() {
        for law in [Law::Coulomb, Law::Associated] {
            let stuck = ProjectedGaussSeidel::default().solve(&block(law, 0.76, 0.75), None).unwrap();
            assert!(stuck.velocity.amax() <= f64::EPSILON, "{law:?}");
            assert_eq!(stuck.iterations, 1);
        }
        let sliding = ProjectedGaussSeidel::default().solve(&block(Law::Coulomb, 0.5, 0.75), None).unwrap();
        // u_t = sin − μ cos = 0.6 − 0.4, u_n = 0
        assert!((sliding.velocity[1] - 0.2).abs() <= 4.0 * f64::EPSILON && sliding.velocity[0].abs() <= f64::EPSILON);
    }

    #[test]
    fn the_associated_law_lifts_a_sliding_contact_by_mu_times_its_slip() {
        let sliding = ProjectedGaussSeidel::default().solve(&block(Law::Associated, 0.5, 0.75), None).unwrap();
        // r = r_n (1, −½), r·u = 0: r_n = (0.8 + 0.3)/1.25 = 0.88, u = (0.08, 0.16)
        assert!((sliding.impulse[0] - 0.88).abs() <= 4.0 * f64::EPSILON);
        assert!((sliding.velocity[0] - 0.5 * sliding.velocity[1]).abs() <= 4.0 * f64::EPSILON);
    }

    #[test]
    fn a_contact_that_touches_nothing_is_refused_by_name() {
        let problem = block(Law::Coulomb, 0.5, 0.75).into_builder().delassus(DMatrix::zeros(2, 2)).build().unwrap();
        let message = ProjectedGaussSeidel::default().solve(&problem, None).unwrap_err().to_string();
        assert!(message.contains("`pgs`") && message.contains("contact 0"), "{message}");
    }
}
