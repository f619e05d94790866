//! Nonlinear conjugate gradients on the program of Gauss's principle, preconditioned by M, with an exact line search.
//!
//! ```text
//!     g = MΔ − Hᵀr ,   z = M⁻¹g ,   p ← −z + β p ,   Δ ← Δ + α p ,   α exact ,      δ = g − g_old , w = z − z_old
//!     Polak–Ribière-plus   β = max(0, gᵀw / g_oldᵀz_old)
//!     Hager–Zhang          β = max(η, (δᵀz − 2 (δᵀw/pᵀδ) pᵀg)/pᵀδ) ,   η = −1/(‖p‖ min(1/100, ‖g‖))
//! ```
//! The first direction is −M⁻¹g.

use crate::tolerance::solvers::{CONJUGATE_STALLED, CONJUGATE_STEPS};
use moreau_contact::problem::{ContactProblem, Law, Solution};
use moreau_contact::solvers::gauss::{GaussProgram, Minimiser, Progress, exact_step, through_program};
use moreau_contact::solvers::watch::is_over;
use moreau_contact::solvers::{ContactSolver, SolverEntry, parts};
use moreau_contact::tolerance::solvers::STOP;
use moreau_exact::Result;
use nalgebra::DVector;

/// How the next direction is made conjugate.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Direction {
    /// β = max(0, gᵀw / g_oldᵀz_old).
    #[default]
    PolakRibierePlus,
    /// Hager and Zhang's β with its lower bound η.
    HagerZhang,
    /// β = 0, steepest descent in the norm of M: what the others are better than.
    Steepest,
}

/// Conjugate gradients for soft convex contact.
///
/// # Source
/// Chapter §6, table of solvers; Hager and Zhang, *A new conjugate gradient method with guaranteed descent* (2005).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GaussConjugateGradient {
    /// The formula of β.
    pub direction: Direction,
    /// Most steps.
    pub steps: usize,
    /// As in [`moreau_contact::solvers::GaussNewton`].
    pub tolerance: f64,
}

/// Its line in a table of solvers.
pub const CONJUGATE_GRADIENT: SolverEntry = SolverEntry {
    name: "cg",
    default: || Box::new(GaussConjugateGradient::default()),
    limited: Some(|limit| Box::new(GaussConjugateGradient { steps: limit, ..Default::default() })),
};

impl Default for GaussConjugateGradient {
    fn default() -> Self {
        GaussConjugateGradient { direction: Direction::default(), steps: CONJUGATE_STEPS, tolerance: STOP }
    }
}

impl Direction {
    fn factor(self, [old, new]: [&Slope; 2], direction: &DVector<f64>) -> f64 {
        let (change, accelerated) = (&new.gradient - &old.gradient, &new.preconditioned - &old.preconditioned);
        match self {
            Direction::PolakRibierePlus => (new.gradient.dot(&accelerated) / old.gradient.dot(&old.preconditioned)).max(0.0),
            Direction::Steepest => 0.0,
            Direction::HagerZhang => {
                let along = direction.dot(&change);
                if along <= 0.0 {
                    return 0.0;
                }
                let bend = change.dot(&new.preconditioned) - 2.0 * change.dot(&accelerated) / along * direction.dot(&new.gradient);
                (bend / along).max(-1.0 / (direction.norm() * new.gradient.norm().min(0.01)))
            }
        }
    }
}

/// The gradient g and M⁻¹g.
struct Slope {
    gradient: DVector<f64>,
    preconditioned: DVector<f64>,
}

impl Slope {
    fn at(program: &GaussProgram, change: &DVector<f64>, impulse: &DVector<f64>) -> Self {
        let gradient = program.gradient(change, impulse);
        let preconditioned = program.accelerate(&gradient);
        Slope { gradient, preconditioned }
    }
}

impl GaussConjugateGradient {
    /// The minimiser, from a start Δ; it ends as [`moreau_contact::solvers::GaussNewton::minimise`] does.
    pub fn minimise(&self, program: &GaussProgram, start: DVector<f64>) -> Minimiser {
        let mut change = start;
        let mut impulse = program.impulse(&program.violation(&change));
        let mut slope = Slope::at(program, &change, &impulse);
        let mut direction = -&slope.preconditioned;
        let mut progress = Progress::new(program, &change, &impulse);
        let mut iterations = 0;
        while progress.gradient() > self.tolerance && iterations < self.steps && progress.stalled() < CONJUGATE_STALLED && !is_over() {
            let step = exact_step(program, &change, &direction);
            if step == 0.0 {
                break;
            }
            change += &direction * step;
            impulse = program.impulse(&program.violation(&change));
            let next = Slope::at(program, &change, &impulse);
            direction = -&next.preconditioned + &direction * self.direction.factor([&slope, &next], &direction);
            slope = next;
            iterations += 1;
            progress.take(&change, &impulse);
        }
        progress.ends(iterations)
    }
}

impl ContactSolver for GaussConjugateGradient {
    fn name(&self) -> &'static str {
        "cg"
    }

    fn takes(&self, law: Law, _rows: usize, symmetric: bool) -> bool {
        symmetric && law.is_convex()
    }

    /// From the motion that the given impulses would cause, or from free motion.
    fn solve(&self, problem: &ContactProblem, warm_start: Option<&DVector<f64>>) -> Result<Solution> {
        let start = parts::start(problem, warm_start)?;
        through_program(self.name(), problem, |program| {
            let pushed = problem.dynamics().map(|dynamics| dynamics.jacobian.tr_mul(&start));
            let change = pushed.map_or_else(|| DVector::zeros(program.velocities()), |push| program.accelerate(&push));
            Ok(self.minimise(program, change))
        })
    }
}
