//! Block projected Gauss–Seidel: contact after contact,
//! ```text
//!     r_k ← the answer of contact k alone with q_k = (u_free + shift)_k + Σ_{j≠k} W_kj r_j .
//! ```
//! Each contact is solved to rounding (`one_contact`). For symmetric positive semidefinite W and a convex law the
//! sweeps descend on ½rᵀ(W+R)r + (u_free+shift)ᵀr and converge; for Coulomb's law they usually do, and the certificate tells.
//!
//! Where W acts through bodies, their velocities are kept in place of y (`swept`). There, and where W is stored by the blocks of many
//! contacts in the plane, contacts are swept block by block in the order of the blocks' colours (`colours`), by several threads if many.
//!
//! The certificate's residual is measured seldom. In between the change of a sweep, (Σ A_nn‖Δr‖²)^½, tells how it falls: it is measured
//! again where that predicts the tolerance, and after as many sweeps as before, up to a limit. Every measurement computes y afresh, because
//! updates collect rounding.
//!
//! Accelerated sweeps keep the best of the iterates that are measured and return it. Sweeps that no longer halve its residual have stalled
//! and end with it too; plain sweeps that reach their declared number return the last one.

use super::ContactSolver;
use super::anderson::{Anderson, Point};
use super::block_sweep::{Change, Sweep};
use super::colours::Blocks;
use super::crew::Crew;
use super::one_contact::{Associated, Coulomb, Frictionless, OneContact, Polyhedral, is_definite};
use super::parts::copy;
use super::stopping::Stopping;
use super::swept::{Joined, Stored, Swept};
use super::swept_bodies::{Bodies, Free};
use crate::memory::spare::{self, Lent};
use crate::operator::passes;
use crate::problem::{ContactProblem, Law, Solution};
use crate::tolerance::solvers as tolerance;
use crate::tolerance::sweeps::{LOOK, PREDICTED};
use moreau_exact::number::counted;
use moreau_exact::{Error, Result};
use nalgebra::{DVector, Matrix3};

/// Block projected Gauss–Seidel for the frictionless, Coulomb and associated laws and, at spatial contacts, polyhedral Coulomb; W may be
/// asymmetric and rank deficient.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProjectedGaussSeidel {
    /// Sweep limit.
    pub sweeps: usize,
    /// Stops when the certificate's residuals of every contact are at most this times their scale; where it is negative none is measured,
    /// and plain sweeps answer the last iterate.
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

/// Contacts have one to three rows. Polyhedral Coulomb is solved at spatial contacts; in the plane it is an LCP better solved as one.
fn is_swept(law: Law, rows: usize) -> bool {
    match law {
        _ if rows > 3 => false,
        Law::PolyhedralCoulomb { .. } => rows == 3,
        Law::PolyhedralAssociated { .. } => false,
        _ => true,
    }
}

impl ContactSolver for ProjectedGaussSeidel {
    fn name(&self) -> &'static str {
        NAME
    }

    fn with_tolerance(&self, relative: f64) -> Option<Box<dyn ContactSolver>> {
        Some(Box::new(Self { tolerance: relative, ..*self }))
    }

    fn iteration_limit(&self) -> Option<usize> {
        Some(self.sweeps)
    }

    fn takes(&self, law: Law, rows: usize, _symmetric: bool) -> bool {
        is_swept(law, rows)
    }

    fn solve(&self, problem: &ContactProblem, warm_start: Option<&DVector<f64>>) -> Result<Solution> {
        let rows = problem.rows_per_contact();
        if !is_swept(problem.law(), rows) {
            let reason = format!("does not solve the law `{}` with {rows} per contact", problem.law().name(), rows = counted(rows, "row"));
            return Err(Error::refused(NAME, reason));
        }
        let is_declared = self.tolerance < 0.0;
        let start = if is_declared { super::start(problem, warm_start)? } else { super::start_of_use(problem, warm_start)? };
        match problem.law() {
            Law::Frictionless => self.solve_by(problem, start, |block, _| Frictionless::new(block)),
            Law::Associated => self.solve_by(problem, start, Associated::new),
            Law::PolyhedralCoulomb { directions } => self.solve_by(problem, start, |block, mu| Polyhedral::new(block, mu, directions)),
            _ => self.solve_by(problem, start, Coulomb::new),
        }
    }
}

const NAME: &str = "pgs";

impl ProjectedGaussSeidel {
    /// Sweeps with one law of a single contact.
    fn solve_by<L: OneContact>(
        &self,
        problem: &ContactProblem,
        start: DVector<f64>,
        one: impl Fn(&Matrix3<f64>, f64) -> Option<L>,
    ) -> Result<Solution> {
        let mut contacts = Lent::from(spare::vector(problem.contacts()));
        for k in 0..problem.contacts() {
            contacts.push(prepare(problem, k, &one)?);
        }
        match problem.rows_per_contact() {
            1 => self.solve_rows::<L, 1>(problem, start, contacts),
            2 => self.solve_rows::<L, 2>(problem, start, contacts),
            _ => self.solve_rows::<L, 3>(problem, start, contacts),
        }
    }

    fn solve_rows<L: OneContact, const D: usize>(
        &self,
        problem: &ContactProblem,
        start: DVector<f64>,
        contacts: Lent<Vec<L>>,
    ) -> Result<Solution> {
        let free = problem.delassus().matrix_free();
        match (free, free.and_then(|free| Bodies::<3>::new(problem, free)), Joined::new(problem)) {
            (_, Some(bodies), _) => Sweeper::<_, _, D>::new(problem, bodies, contacts, start, self).solution(self),
            (Some(free), ..) => Sweeper::<_, _, D>::new(problem, Free::new(problem, free), contacts, start, self).solution(self),
            (.., Some(joined)) => Sweeper::<_, _, D>::new(problem, joined, contacts, start, self).solution(self),
            _ => Sweeper::<_, _, D>::new(problem, Stored(problem), contacts, start, self).solution(self),
        }
    }
}

/// What a sweep works on: a sweep in one thread allocates nothing.
struct Sweeper<'a, S, L: OneContact, const D: usize> {
    problem: &'a ContactProblem,
    swept: S,
    crew: Crew,
    contacts: Lent<Vec<L>>,
    blocks: Blocks,
    /// Of every block what the last sweep changed.
    changes: Lent<Vec<Change>>,
    stopping: Stopping<'a>,
    /// r \[N·s\], and what the sweep keeps beside it.
    point: Point,
    /// y at the last measurement \[m/s\].
    law_velocity: Lent<DVector<f64>>,
    best: Best,
    sweeps: usize,
    look: Look,
}

/// When the residual is measured next.
struct Look {
    /// The change of the last sweep \[√J\].
    change: f64,
    /// The residual over the change of the sweep before it, at the last measurement.
    ratio: f64,
    /// The sweep of the next measurement.
    next: usize,
}

/// The iterate with the smallest relative residual so far, and the sweep that last halved that residual.
struct Best {
    relative: f64,
    impulse: Lent<DVector<f64>>,
    /// The residual at the last mark, and the sweep of that mark. The next mark is set when the residual has halved.
    mark: (f64, usize),
}

impl Default for Best {
    fn default() -> Self {
        Best { relative: f64::INFINITY, impulse: Lent::default(), mark: (f64::INFINITY, 0) }
    }
}

impl Best {
    fn offer(&mut self, relative: f64, impulse: &DVector<f64>, sweep: usize) {
        if relative < self.relative || self.impulse.is_empty() {
            self.relative = relative;
            copy(impulse, &mut self.impulse);
        }
        if self.relative < 0.5 * self.mark.0 {
            self.mark = (self.relative, sweep);
        }
    }
}

impl<'a, S: Swept<D>, L: OneContact, const D: usize> Sweeper<'a, S, L, D> {
    fn new(problem: &'a ContactProblem, swept: S, contacts: Lent<Vec<L>>, start: DVector<f64>, solver: &ProjectedGaussSeidel) -> Self {
        let mut state = spare::zeros(swept.size());
        swept.set_state(start.as_slice(), state.as_mut_slice());
        let blocks = swept.blocks();
        Sweeper {
            problem,
            crew: Crew::new(problem.contacts(), swept.size()),
            swept,
            contacts,
            changes: spare::repeated(blocks.count(), Change::default()).into(),
            blocks,
            stopping: Stopping::new(problem, solver.tolerance),
            law_velocity: spare::zeros(start.len()).into(),
            point: Point { x: start.into(), state: state.into() },
            best: Best::default(),
            sweeps: 0,
            look: Look { change: 0.0, ratio: f64::INFINITY, next: 0 },
        }
    }

    fn solution(mut self, solver: &ProjectedGaussSeidel) -> Result<Solution> {
        if solver.memory == 0 {
            self.plain(solver)
        } else {
            self.accelerated(solver)
        }
        // plain sweeps that reach their declared number answer the last iterate
        let keeps_best = solver.memory > 0 || self.sweeps < solver.sweeps;
        // one that is ended before its first look has none that was measured
        let measured = !self.best.impulse.is_empty();
        let impulse = if keeps_best && measured && self.is_finite() { self.best.impulse } else { self.point.x }.into_inner();
        let velocity = self.problem.velocity(&impulse);
        super::finite(Solution::new(spare::text(NAME), impulse, velocity, self.sweeps))
    }

    /// Sweep after sweep.
    fn plain(&mut self, solver: &ProjectedGaussSeidel) {
        let patience = tolerance::stalled(self.problem.contacts());
        let mut relative = self.begin(solver);
        while relative > solver.tolerance && self.sweeps < solver.sweeps && !self.has_stalled(patience) && !super::watch::is_over() {
            let goes_on = self.sweep() && self.look.change.is_finite();
            // a declared number of sweeps is answered as it is
            if self.sweeps < solver.sweeps && solver.tolerance >= 0.0 && (!goes_on || self.is_due(solver.tolerance)) {
                relative = self.measure();
            }
            if !goes_on {
                break;
            }
        }
    }

    /// Every sweep is followed by an extrapolation by Anderson's method. An extrapolation that makes the change of a sweep grow is taken
    /// back, and where the residual has grown the method forgets its past sweeps.
    fn accelerated(&mut self, solver: &ProjectedGaussSeidel) {
        let patience = tolerance::accelerated_stalled(self.problem.contacts());
        let mut anderson = Anderson::new(solver.memory);
        let mut before = self.point.x.clone();
        let mut relative = self.begin(solver);
        while relative > solver.tolerance && self.sweeps < solver.sweeps && !self.has_stalled(patience) && !super::watch::is_over() {
            copy(&self.point.x, &mut before);
            let goes_on = self.sweep() && self.look.change.is_finite() && self.sweeps < solver.sweeps;
            if !goes_on || self.is_due(solver.tolerance) {
                relative = self.measure();
                if relative > tolerance::GROWTH * self.best.relative {
                    anderson.forget();
                }
            }
            if !goes_on || relative <= solver.tolerance {
                break;
            }
            anderson.extrapolate(&before, &mut self.point);
        }
    }

    /// The residual at the start; r = 0, where a sweep tells at once whether no contact closes, is not measured.
    fn begin(&mut self, solver: &ProjectedGaussSeidel) -> f64 {
        let is_zero = || self.point.x.iter().all(|r| *r == 0.0);
        if solver.tolerance < 0.0 || (solver.sweeps > 0 && is_zero()) { f64::INFINITY } else { self.measure() }
    }

    fn has_stalled(&self, patience: usize) -> bool {
        self.sweeps - self.best.mark.1 > patience
    }

    fn is_finite(&self) -> bool {
        self.point.x.iter().all(|r| r.is_finite())
    }

    /// Whether the residual is to be measured after this sweep.
    fn is_due(&self, tolerance: f64) -> bool {
        self.sweeps >= self.look.next || self.look.change * self.look.ratio <= PREDICTED * tolerance
    }

    /// Solves every contact once; returns whether any impulse changed.
    fn sweep(&mut self) -> bool {
        let Sweeper { swept, crew, contacts, blocks, changes, point, .. } = self;
        let impulses = point.x.as_mut_slice().as_chunks_mut::<D>().0;
        swept.sweep(crew, Sweep { blocks, contacts, impulses, changes }, point.state.as_mut_slice());
        passes::note();
        self.sweeps += 1;
        self.look.change = changes.iter().map(|change| change.squares).sum::<f64>().sqrt();
        changes.iter().any(|change| change.moved)
    }

    /// The largest relative residual, with y computed afresh.
    fn measure(&mut self) -> f64 {
        let Sweeper { swept, point, law_velocity, .. } = self;
        swept.set_state(point.x.as_slice(), point.state.as_mut_slice());
        swept.law_velocity(point.x.as_slice(), point.state.as_mut_slice(), law_velocity.as_mut_slice());
        let relative = self.stopping.relative(&self.point.x, &self.law_velocity);
        self.best.offer(relative, &self.point.x, self.sweeps);
        let ratio = if self.look.change > 0.0 { relative / self.look.change } else { f64::INFINITY };
        self.look = Look { ratio, next: self.sweeps + self.sweeps.clamp(1, LOOK), ..self.look };
        relative
    }
}

/// Contact k alone, with its padded block made definite, and symmetric where its law needs it. The difference from W_kk + R_kk
/// multiplies the previous impulse (a proximal step), so the fixed points stay those of the given problem.
pub(super) fn prepare<L>(problem: &ContactProblem, k: usize, one: impl Fn(&Matrix3<f64>, f64) -> Option<L>) -> Result<L> {
    let rows = problem.rows_per_contact();
    let (mut own, mut block) = ([0.0; 9], Matrix3::identity());
    problem.delassus().of_contacts().diagonal_block(k, &mut own[..rows * rows]);
    (0..rows * rows).for_each(|place| block[(place % rows, place / rows)] = own[place]);
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
    let least = Matrix3::identity() * (tolerance::PROXIMAL * trace);
    // the smallest eigenvalue is below PROXIMAL times the trace
    if !is_definite(&(block - least)) {
        block += least;
    }
    one(&block, problem.friction()[k]).ok_or_else(|| {
        let reason = format!(
            "contact {k} has no positive definite diagonal block W_kk + R_kk, so it cannot be solved alone; remove it or give it compliance"
        );
        Error::refused(NAME, reason)
    })
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
    fn sweeps_without_a_tolerance_are_the_same_and_none_is_measured() {
        let problem = crate::solvers::test_problems::four_corners(Law::Coulomb, 0.5, 1.0);
        let interrupt = crate::solvers::watch::Interrupt::default();
        let seen = |tolerance: f64| {
            let solver = ProjectedGaussSeidel { sweeps: 5, tolerance, memory: 0 };
            crate::solvers::watch::watched(&interrupt, || solver.solve(&problem, Some(&DVector::from_element(12, 0.1))).unwrap())
        };
        let ((unmeasured, none), (measured, some)) = (seen(-1.0), seen(0.0));
        // a measurement computes y afresh
        let rounding = moreau_exact::tolerance::rounding(12 * 5, measured.impulse.amax());
        assert!((&unmeasured.impulse - &measured.impulse).amax() <= rounding && unmeasured.iterations == 5);
        assert!(none.history.is_empty() && !some.history.is_empty());
    }

    #[test]
    fn a_contact_that_touches_nothing_is_refused_by_name() {
        let problem = block(Law::Coulomb, 0.5, 0.75).into_builder().delassus(DMatrix::zeros(2, 2)).build().unwrap();
        let message = ProjectedGaussSeidel::default().solve(&problem, None).unwrap_err().to_string();
        assert!(message.contains("`pgs`") && message.contains("contact 0"), "{message}");
    }
}
