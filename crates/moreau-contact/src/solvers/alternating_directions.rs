//! The alternating direction method of multipliers (ADMM) with a proximal term, for convex and for Coulomb's law
//!
//! ```text
//!     p ← P_K(x − z/ρ) ,                                                    impulse in the cone
//!     x ← argmin ½xᵀA x + (q + s)ᵀx − zᵀ(x − p) + ½ρ‖x − p‖² + ½η‖x − x₋‖² ,   impulse of the dynamics
//!     z ← z − ρ (x − p) ,                                                   velocity: at the solution z = A x + q + s
//! ```
//! with A = W + R and q = u_free + shift. The middle line is one system with the matrix A + (ρ + η)I: a Cholesky factor where W is
//! symmetric, L U where it is not, contact by contact where W is stored by blocks (`shifted_operator.rs`). For Coulomb's law s = μ‖z_t‖n is
//! de Saxcé's correction of the last z, contact by contact; for the convex laws s = 0. The answer is p.
//!
//! **ρ by itself.** With the primal residual ‖x − p‖ \[N·s\] and the dual one max(ρ, η)‖x − x₋‖ \[m/s\], ρ is multiplied by √(primal/dual)
//! as soon as that is a factor of five or more, for each change costs a factorisation. Everything is measured in units in which the mean
//! diagonal entry of A is 1 and so is the largest entry of q, so that a change of units changes nothing. For a convex law, W + Wᵀ + 2R ⪰ 0
//! and ρ held fixed the method converges from anywhere, for r ↦ A r + q is monotone then, symmetric or not; to that end ρ is held longer
//! and longer, the n-th value for n iterations. For another W and for Coulomb's law nothing is promised: the certificate decides.
//!
//! `DIFFERENCE` Pinocchio 4.1.0 writes τρ for ρ (τ = ½), may change ρ in every iteration, and has no units: its η = 10⁻⁶ and the bounds of
//! ρ are numbers. Project Chrono has the same iteration with the proximal term on p and ρ balanced every six iterations.

use super::ContactSolver;
use super::shifted_operator::{Shifted, ShiftedOperator};
use super::stopping::Stopping;
use super::watch;
use crate::certificate::natural_map;
use crate::problem::{ContactProblem, Law, Solution};
use crate::tolerance::solvers as tolerance;
use moreau_exact::{Error, Result};
use nalgebra::DVector;

/// Alternating directions for the frictionless, associated and Coulomb laws; W may be asymmetric.
///
/// # Source
/// Carpentier, Le Lidec, Montaut, *From compliant to rigid contact simulation: a unified and efficient approach* (2024); Pinocchio 4.1.0,
/// `ADMMConstraintSolver`; for the convex law Boyd and others, *Distributed optimization and statistical learning via ADMM* (2011).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AlternatingDirections {
    /// Iteration limit.
    pub iterations: usize,
    /// Relative natural map at which it stops.
    pub tolerance: f64,
}

impl Default for AlternatingDirections {
    fn default() -> Self {
        AlternatingDirections { iterations: tolerance::ALTERNATIONS, tolerance: tolerance::STOP }
    }
}

const NAME: &str = "admm";

/// The problem in its own units, and the factorised matrix A + (ρ + η)I.
struct Scaled<'a> {
    problem: &'a ContactProblem,
    operator: ShiftedOperator<'a>,
    free: DVector<f64>,
    penalty: f64,
    factor: Shifted,
}

impl ContactSolver for AlternatingDirections {
    fn name(&self) -> &'static str {
        NAME
    }

    fn with_tolerance(&self, relative: f64) -> Option<Box<dyn ContactSolver>> {
        Some(Box::new(Self { tolerance: relative, ..*self }))
    }

    fn iteration_limit(&self) -> Option<usize> {
        Some(self.iterations)
    }

    fn takes(&self, law: Law, _rows: usize, _symmetric: bool) -> bool {
        law.directions().is_none()
    }

    fn solve(&self, problem: &ContactProblem, warm_start: Option<&DVector<f64>>) -> Result<Solution> {
        if problem.law().directions().is_some() {
            return Err(Error::refused(NAME, format!("does not solve the law `{}`", problem.law().name())));
        }
        let start = super::start_of_use(problem, warm_start)?;
        let data = problem.law_velocity(&DVector::zeros(problem.rows()));
        let operator = ShiftedOperator::new(problem)?;
        let speed = if data.amax() > 0.0 { data.amax() } else { 1.0 };
        let unit = operator.mass() * speed;
        let mut stopping = Stopping::new(problem, self.tolerance);
        let mut scaled = Scaled::new(problem, operator, data / speed)?;
        let mut x = start / unit;
        let mut z = scaled.corrected(&(scaled.operator.apply(&x) + &scaled.free));
        let mut cone = x.clone();
        super::project(problem, &mut cone);
        let (mut done, mut held, mut changes, mut is_over) = (0, 0, 0, false);
        let mut before_overflow = DVector::zeros(0);
        loop {
            if is_over || done == self.iterations || done % tolerance::LOOK == 0 {
                let impulse = &cone * unit;
                let law_velocity = problem.law_velocity(&impulse);
                if impulse.iter().chain(&law_velocity).all(|x| x.is_finite()) {
                    before_overflow.clone_from(&cone);
                } else {
                    require_no_descent(problem, &before_overflow)?;
                }
                if is_over || done == self.iterations || stopping.holds(&impulse, &law_velocity) {
                    let velocity = problem.velocity(&impulse);
                    return super::finite(Solution::new(NAME, impulse, velocity, done));
                }
            }
            let before = x.clone();
            (cone, x) = scaled.alternate(&x, &z);
            z -= (&x - &cone) * scaled.penalty;
            (done, held) = (done + 1, held + 1);
            let residuals = ((&x - &cone).amax(), scaled.penalty.max(tolerance::ADMM_PROXIMAL) * (&x - before).amax());
            if held > changes {
                match scaled.balance(residuals) {
                    Ok(true) => (held, changes) = (0, changes + 1),
                    Ok(false) => {}
                    // a factorisation that was ended early leaves the impulses so far
                    Err(_) if watch::was_over() => is_over = true,
                    Err(error) => return Err(error),
                }
            }
        }
    }
}

/// Impulses grow without end along r where r·(W + R)r < 0, and then the method is not made for the problem.
///
/// # Errors
/// [`Error::Solver`], a refusal, where the last finite impulses are such an r.
fn require_no_descent(problem: &ContactProblem, impulse: &DVector<f64>) -> Result<()> {
    let size = impulse.amax();
    if size == 0.0 || !size.is_finite() {
        return Ok(());
    }
    let unit = impulse / size;
    let at_rest = DVector::zeros(unit.len());
    let curvature = unit.dot(&(problem.law_velocity(&unit) - problem.law_velocity(&at_rest)));
    if curvature >= 0.0 {
        return Ok(());
    }
    let reason = "needs a positive semidefinite W + R: its impulses grew without end, along r with r·(W + R)r < 0";
    Err(Error::refused(NAME, reason))
}

impl<'a> Scaled<'a> {
    fn new(problem: &'a ContactProblem, operator: ShiftedOperator<'a>, free: DVector<f64>) -> Result<Self> {
        let factor = operator.shifted(NAME, 1.0 + tolerance::ADMM_PROXIMAL)?;
        Ok(Scaled { problem, operator, free, penalty: 1.0, factor })
    }

    /// p and x of the module's equations.
    fn alternate(&mut self, x: &DVector<f64>, z: &DVector<f64>) -> (DVector<f64>, DVector<f64>) {
        let mut cone = x - z / self.penalty;
        super::project(self.problem, &mut cone);
        // −(q + s) + z + ρ p + η x₋, where s = corrected − z
        let right = z * 2.0 - &self.free - self.corrected(z) + &cone * self.penalty + x * tolerance::ADMM_PROXIMAL;
        let next = self.operator.solve(&mut self.factor, &right);
        (cone, next)
    }

    /// z + μ‖z_t‖n for Coulomb's law, z otherwise.
    fn corrected(&self, z: &DVector<f64>) -> DVector<f64> {
        let mut corrected = z.clone();
        for (k, part) in corrected.as_mut_slice().chunks_exact_mut(self.problem.rows_per_contact()).enumerate() {
            natural_map::correct(self.problem.law(), self.problem.friction()[k], part);
        }
        corrected
    }

    /// Changes ρ where the residuals ask for it; returns whether it did.
    fn balance(&mut self, (primal, dual): (f64, f64)) -> Result<bool> {
        let factor = (primal / dual).sqrt();
        if factor < tolerance::BALANCE && 1.0 / factor < tolerance::BALANCE {
            return Ok(false);
        }
        let penalty = (self.penalty * factor).clamp(tolerance::PENALTIES.0, tolerance::PENALTIES.1);
        if !penalty.is_finite() || penalty == self.penalty {
            return Ok(false);
        }
        self.factor = self.operator.shifted(NAME, penalty + tolerance::ADMM_PROXIMAL)?;
        self.penalty = penalty;
        Ok(true)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::problem::Law;
    use nalgebra::DMatrix;

    fn block(law: Law) -> ContactProblem {
        ContactProblem::new(DMatrix::identity(2, 2), DVector::from_vec(vec![-0.8, 0.6]))
            .name("block")
            .law(law)
            .rows_per_contact(2)
            .friction(vec![0.5])
            .build()
            .unwrap()
    }

    #[test]
    fn one_switch_tells_coulomb_s_slide_from_the_associated_hop() {
        // 3-4-5 slope, μ = ½: Coulomb u = (0, 0.6 − ½·0.8); associated r = 0.88(1, −½), u = (0.08, 0.16)
        for (law, expected) in [(Law::Coulomb, [0.0, 0.2]), (Law::Associated, [0.08, 0.16])] {
            let answer = AlternatingDirections::default().solve(&block(law), None).unwrap();
            assert!((answer.velocity - DVector::from_row_slice(&expected)).amax() <= 2.0 * tolerance::STOP, "{law:?}");
        }
    }

    #[test]
    fn units_of_mass_and_time_change_nothing() {
        let problem = block(Law::Coulomb);
        let (delassus, free_velocity) = (problem.dense() * 2f64.powi(60), problem.free_velocity() * 2f64.powi(-40));
        let other = problem.clone().into_builder().delassus(delassus).free_velocity(free_velocity).build().unwrap();
        let [one, two] = [&problem, &other].map(|problem| AlternatingDirections::default().solve(problem, None).unwrap());
        // powers of two: the same numbers, bit for bit
        assert_eq!(one.iterations, two.iterations);
        assert_eq!(one.impulse * 2f64.powi(-100), two.impulse);
    }

    #[test]
    fn an_asymmetric_w_is_solved_dense_and_by_blocks() {
        // rows (1, ½) and (−½, 1): W + Wᵀ = 2 I. Sticking, r = −W⁻¹q = (1, 0) N·s for q = (−1, ½)
        let rolling = DMatrix::from_row_slice(2, 2, &[1.0, 0.5, -0.5, 1.0]);
        let free = DVector::from_vec(vec![-1.0, 0.5]);
        for law in [Law::Coulomb, Law::Associated] {
            let dense = block(law).into_builder().delassus(rolling.clone()).free_velocity(free.clone()).build().unwrap();
            let blocks = crate::operator::BlockSparse::new(2, 1, vec![(0, 0, rolling.clone())]).unwrap();
            let stored = dense.clone().into_builder().delassus(blocks).build().unwrap();
            for problem in [dense, stored] {
                let answer = AlternatingDirections::default().solve(&problem, None).unwrap();
                assert!((answer.impulse - DVector::from_vec(vec![1.0, 0.0])).amax() <= 8.0 * tolerance::STOP, "{law:?}");
            }
        }
    }

    #[test]
    fn what_is_ended_in_a_later_factorisation_leaves_the_impulses_so_far() {
        let one = DMatrix::from_diagonal(&DVector::from_vec(vec![1.0, 64.0]));
        let blocks = crate::operator::BlockSparse::new(2, 1, vec![(0, 0, one)]).unwrap();
        let problem = block(Law::Coulomb).into_builder().delassus(blocks).build().unwrap();
        let solver = AlternatingDirections::default();
        let whole = solver.solve(&problem, None).unwrap().iterations;
        let ended: Vec<_> = (0..)
            .map(|asks| watch::watched_until(asks, || solver.solve(&problem, None)))
            .take_while(|(_, seen)| seen.interrupted)
            .collect();
        let answered = ended.iter().skip_while(|(answer, _)| answer.is_err());
        let iterations: Vec<usize> =
            answered.map(|(answer, _)| answer.as_ref().expect("none before the first factor").iterations).collect();
        assert!(ended[0].0.is_err() && iterations[0] == 0 && iterations.iter().all(|done| *done <= whole), "{iterations:?} of {whole}");
        let between_looks = iterations.iter().filter(|done| *done % tolerance::LOOK != 0).count();
        assert!(between_looks > 0, "a factor is changed between two looks: {iterations:?}");
    }

    #[test]
    fn an_indefinite_operator_is_refused_by_name() {
        let indefinite = DMatrix::from_row_slice(2, 2, &[1.0, 100.0, 100.0, 1.0]);
        let problem = block(Law::Associated).into_builder().delassus(indefinite).build().unwrap();
        let message = AlternatingDirections::default().solve(&problem, None).unwrap_err().to_string();
        assert!(message.contains("`admm`") && message.contains("semidefinite"), "{message}");
        // its impulses grow until they are no numbers: that is no matter of units
        let falling = ContactProblem::new(-DMatrix::identity(2, 2), DVector::from_vec(vec![-1.0, -2.0])).rows_per_contact(1);
        let falling = falling.law(Law::Frictionless).build().unwrap();
        let message = AlternatingDirections::default().solve(&falling, None).unwrap_err().to_string();
        assert!(message.contains("(refused)") && message.contains("r·(W + R)r < 0"), "{message}");
    }
}
