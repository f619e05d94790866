//! A primal–dual interior point method for the frictionless, associated and Coulomb laws.
//!
//! ```text
//!     ŷ = y + s μ‖y_t‖ n ,  s = 1 for Coulomb, 0 otherwise ;   x = (μ r_n, r_t) ,  z = (ŷ_n/μ, ŷ_t)    both in the cone ‖·_t‖ ≤ ·_n
//!     λ = P⁻¹x = P z (Nesterov and Todd) ,     λ ∘ (P⁻¹dx + P dz) = σ g e − λ∘λ − (P⁻¹dx_a)∘(P dz_a)
//!     (B (W + R) + T⁻¹P⁻²T⁻¹) dr = −ρ + T⁻¹P⁻¹c ,    T = diag(1/μ, 1, 1) ,   B = I + s μ n (y_t/‖y_t‖)ᵀ ,   ρ = ŷ − T⁻¹z
//! ```
//! with the gap g = x·z/contacts and Mehrotra's predictor dx_a. A convex problem is ended in some twenty steps, however redundant its
//! contacts are: what is not determined stays in the middle of what is possible. For Coulomb's law the lift s μ‖y_t‖ is carried along
//! with its derivative; that often works, and nothing promises it. The point it ends in has the right contacts pressing, sticking and
//! sliding; Newton's method takes it from there to rounding.
//!
//! One contact of thousands that comes to the boundary makes a step short for all. So what of P⁻¹x ∘ P z would leave the middle in a whole
//! step is put back by the right side, with the same factor, and the longer one of the two steps is made.
//!
//! # Source
//! Vandenberghe, *The CVXOPT linear and quadratic cone program solvers* (2010), for the scaling; Gondzio, *Multiple centrality correctors
//! in a primal-dual method for linear programming*, Comput. Optim. Appl. 6 (1996); Acary, Armand and Nguyen, on interior points with the
//! lift of Coulomb's law.

use super::ContactSolver;
use super::block_elimination::Slopes;
use super::contact_systems::ContactSystems;
use super::stopping::Stopping;
use crate::certificate::Judge;
use crate::cones::self_dual::{self, Scaling};
use crate::operator::{BlockSparse, Sparse};
use crate::problem::{ContactProblem, Law, Solution};
use crate::tolerance::solvers as tolerance;
use moreau_exact::{Error, Result};
use nalgebra::{DVector, Matrix3, Vector3};
use std::borrow::Cow;

/// Interior points for laws with round cones; a compliance may act on contact rows, and W may be rank deficient.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InteriorPoint {
    /// Step limit.
    pub steps: usize,
    /// Relative residual at which it stops.
    pub tolerance: f64,
    /// Part of the first gap, and of the first difference of z from ŷ, at which it stops as well: soon the right contacts press, stick and
    /// slide, and Newton's method is nearer to the end. It then stops, too, where elimination in velocities has lost too many digits. 0
    /// stops nothing.
    pub gap: f64,
    /// What x is at first, in impulses that give a contact alone the largest velocity of the data.
    pub first_impulse: f64,
    /// Whether what would leave the middle is put back. On large walls that takes fewer steps; on a few contacts some end early by it.
    pub recentres: bool,
}

impl Default for InteriorPoint {
    fn default() -> Self {
        InteriorPoint { steps: tolerance::INTERIOR_STEPS, tolerance: tolerance::STOP, gap: 0.0, first_impulse: 1.0, recentres: false }
    }
}

const NAME: &str = "interior-point";

impl ContactSolver for InteriorPoint {
    fn name(&self) -> &'static str {
        NAME
    }

    fn with_tolerance(&self, relative: f64) -> Option<Box<dyn ContactSolver>> {
        Some(Box::new(Self { tolerance: relative, ..*self }))
    }

    fn iteration_limit(&self) -> Option<usize> {
        Some(self.steps)
    }

    fn takes_start(&self) -> bool {
        false
    }

    fn takes(&self, law: Law, _rows: usize, _symmetric: bool) -> bool {
        law.directions().is_none()
    }

    fn solve(&self, problem: &ContactProblem, warm_start: Option<&DVector<f64>>) -> Result<Solution> {
        if !self.takes(problem.law(), problem.rows_per_contact(), true) {
            return Err(Error::refused(NAME, format!("does not solve the law `{}`", problem.law().name())));
        }
        // where it starts is in the middle of the cone, whatever is known
        super::start_of_use(problem, warm_start)?;
        let mut path = Path::new(problem, self)?;
        let mut stopping = Stopping::new(problem, self.tolerance);
        let (mut steps, mut mark, mut marked) = (0, [f64::INFINITY; 2], 0);
        loop {
            let velocity = problem.law_velocity(&path.impulse);
            let now = [path.gap(), path.residual];
            if now.iter().zip(&mark).any(|(now, mark)| *now < 0.5 * mark) {
                mark = [now[0].min(mark[0]), now[1].min(mark[1])];
                marked = steps;
            }
            let has_stalled = steps - marked > tolerance::INTERIOR_PATIENCE;
            if has_stalled
                || steps >= self.steps
                || super::watch::is_over()
                || path.is_within(self.gap)
                || stopping.holds(&path.impulse, &velocity)
                || !path.step(&velocity)
            {
                break;
            }
            steps += 1;
            if self.gap > 0.0 && path.systems.has_lost_digits() {
                break;
            }
        }
        // the last point, even where the worst contact of an earlier one looked better: the gap tells how near it is
        let impulse = path.impulse;
        let velocity = problem.velocity(&impulse);
        super::finite(Solution::new(NAME, impulse, velocity, steps))
    }
}

/// Where the method stands.
struct Path<'a> {
    problem: &'a ContactProblem,
    operator: Cow<'a, BlockSparse>,
    systems: ContactSystems,
    /// Whether the linear systems are symmetric: W is, no lift is linearised, and every row takes part.
    is_symmetric: bool,
    is_recentred: bool,
    impulse: DVector<f64>,
    /// z of every contact, padded \[m/s\].
    dual: Vec<Vector3<f64>>,
    /// The gap per contact and the largest ρ at the beginning.
    first: Option<[f64; 2]>,
    /// The largest ρ before the last step \[m/s\].
    residual: f64,
}

/// dx and dz of every contact.
type Direction = Vec<(Vector3<f64>, Vector3<f64>)>;

/// What a step needs of one contact.
struct Local {
    scaling: Scaling,
    /// ρ = ŷ − T⁻¹z, padded.
    residual: Vector3<f64>,
}

impl<'a> Path<'a> {
    /// The middle of the cone: z as large as the largest velocity of the data, x as many times what gives it to a contact alone as asked.
    fn new(problem: &'a ContactProblem, solver: &InteriorPoint) -> Result<Self> {
        let rows = problem.rows_per_contact();
        let size = (problem.free_velocity() + problem.shift()).amax();
        let size = if size > 0.0 { size } else { 1.0 };
        let mut impulse = DVector::zeros(problem.rows());
        let mut dual = Vec::with_capacity(problem.contacts());
        for (k, [rho, _]) in Judge::weights(problem).iter().copied().enumerate() {
            let mu = super::cone_friction(problem, k);
            impulse[k * rows] = solver.first_impulse * rho * size / if mu > 0.0 { mu.max(1.0) } else { 1.0 };
            dual.push(Vector3::new(size, 0.0, 0.0));
        }
        let operator = match problem.delassus().blocks() {
            Some(blocks) => Cow::Borrowed(blocks),
            None => Cow::Owned(BlockSparse::from_sparse(&Sparse::of(problem.afforded_dense()?), rows)?),
        };
        let is_symmetric = problem.law() == Law::Associated
            && (0..problem.contacts()).all(|k| super::cone_friction(problem, k) > 0.0)
            && problem.asymmetry() <= tolerance::SYMMETRY;
        let systems = ContactSystems::new(problem, &operator);
        let is_recentred = solver.recentres;
        Ok(Path { problem, operator, systems, is_symmetric, is_recentred, impulse, dual, first: None, residual: f64::INFINITY })
    }

    /// x = T⁻¹ r of contact k, padded.
    fn primal(&self, k: usize) -> Vector3<f64> {
        let (rows, mu) = (self.problem.rows_per_contact(), super::cone_friction(self.problem, k));
        let part = |row: usize| if row < rows && (row == 0 || mu > 0.0) { self.impulse[k * rows + row] } else { 0.0 };
        Vector3::new(part(0) * scale(mu), part(1), part(2))
    }

    /// x·z over all contacts \[J\].
    fn gap(&self) -> f64 {
        (0..self.problem.contacts()).map(|k| self.primal(k).dot(&self.dual[k])).sum()
    }

    /// Whether the gap and ρ are at most this part of the first ones.
    fn is_within(&self, part: f64) -> bool {
        let contacts = self.problem.contacts() as f64;
        self.first.is_some_and(|[gap, residual]| self.gap() <= part * gap * contacts && self.residual <= part * residual)
    }

    /// One predictor and one corrector with the same factor; false where no number comes out.
    fn step(&mut self, law_velocity: &DVector<f64>) -> bool {
        let contacts = self.problem.contacts();
        let points: Vec<Vector3<f64>> = (0..contacts).map(|k| self.primal(k)).collect();
        let gap = points.iter().zip(&self.dual).map(|(x, z)| x.dot(z)).sum::<f64>() / contacts.max(1) as f64;
        let (mut locals, mut slopes) = (Vec::with_capacity(contacts), Vec::with_capacity(contacts));
        for (k, point) in points.iter().enumerate() {
            let Some((local, own)) = self.local(k, point, law_velocity) else { return false };
            locals.push(local);
            slopes.push(own);
        }
        if !self.systems.factor(&self.operator, &slopes, self.is_symmetric) {
            return false;
        }
        let towards_zero: Vec<Vector3<f64>> = locals.iter().map(|local| -local.scaling.middle()).collect();
        let Some(predicted) = self.direction(&locals, &slopes, &towards_zero) else { return false };
        let affine = self.longest(&points, &predicted);
        let shifted =
            |(x, z): (Vector3<f64>, Vector3<f64>), (dx, dz): &(Vector3<f64>, Vector3<f64>)| (x + dx * affine).dot(&(z + dz * affine));
        let ahead: f64 =
            points.iter().zip(&self.dual).zip(&predicted).map(|((x, z), d)| shifted((*x, *z), d)).sum::<f64>() / contacts.max(1) as f64;
        let sigma = (ahead / gap).clamp(0.0, 1.0).powi(3).max(tolerance::LEAST_CENTRING);
        let residual = locals.iter().map(|local| local.residual.amax()).fold(0.0, f64::max);
        self.residual = residual;
        let [first_gap, first_residual] = *self.first.get_or_insert([gap, residual]);
        // a gap that closes before y fits leaves the path for good
        let open = if first_residual > 0.0 { tolerance::LAG * first_gap * residual / first_residual } else { 0.0 };
        let target = (sigma * gap).max(open.min(2.0 * gap));
        let corrected: Vec<Vector3<f64>> =
            locals.iter().zip(&predicted).map(|(local, (dx, dz))| local.scaling.corrector(target, dx, dz)).collect();
        let Some((direction, length)) = self.recentred(&points, &locals, &slopes, corrected, target) else { return false };
        self.advance(&direction, length)
    }

    /// The direction of the c of every contact and the length of its step, or those of the c that is put right, if that step is longer.
    fn recentred(
        &mut self,
        points: &[Vector3<f64>],
        locals: &[Local],
        slopes: &[Slopes],
        mut c: Vec<Vector3<f64>>,
        gap: f64,
    ) -> Option<(Direction, f64)> {
        let length = |path: &Self, direction: &Direction| (tolerance::BOUNDARY * path.longest(points, direction)).min(1.0);
        let direction = self.direction(locals, slopes, &c)?;
        let reached = length(self, &direction);
        if self.is_recentred && reached < 1.0 {
            for (k, (dx, dz)) in direction.iter().enumerate() {
                c[k] += locals[k].scaling.recentring(gap, &(points[k] + dx), &(self.dual[k] + dz));
            }
            if let Some(other) = self.direction(locals, slopes, &c) {
                let longer = length(self, &other);
                if longer > reached {
                    return Some((other, longer));
                }
            }
        }
        Some((direction, reached))
    }

    /// P, the rows of the linear system and ρ of contact k; none where it has left the cone.
    fn local(&self, k: usize, x: &Vector3<f64>, law_velocity: &DVector<f64>) -> Option<(Local, Slopes)> {
        let (rows, mu) = (self.problem.rows_per_contact(), super::cone_friction(self.problem, k));
        let y = |row: usize| if row < rows { law_velocity[k * rows + row] } else { 0.0 };
        let z = self.dual[k];
        let (mut through, mut own) = (Matrix3::identity(), Matrix3::identity());
        if mu == 0.0 {
            let scaling = Scaling::half_line(x[0], z[0])?;
            through = Matrix3::from_diagonal(&Vector3::new(1.0, 0.0, 0.0));
            own[(0, 0)] = scaling.inverse_square()[(0, 0)] + self.problem.row_compliance(k * rows);
            let local = Local { scaling, residual: Vector3::new(y(0) - z[0], 0.0, 0.0) };
            return Some((local, Slopes { own, through, inverse: None }));
        }
        let scaling = Scaling::round(x, &z, rows)?;
        let slip = y(1).hypot(y(2));
        let lift = if self.problem.law() == Law::Coulomb { mu } else { 0.0 };
        if slip > 0.0 {
            through[(0, 1)] = lift * y(1) / slip;
            through[(0, 2)] = lift * y(2) / slip;
        }
        let square = scaling.inverse_square();
        let t = [scale(mu), 1.0, 1.0];
        own = Matrix3::from_fn(|i, j| t[i] * square[(i, j)] * t[j]);
        for row in 0..rows {
            let softness = self.problem.row_compliance(k * rows + row);
            (0..rows).for_each(|i| own[(i, row)] += through[(i, row)] * softness);
        }
        let residual = Vector3::new(y(0) + lift * slip - t[0] * z[0], y(1) - z[1], y(2) - z[2]);
        let square = scaling.square();
        let known = self.problem.compliance().is_none() && rows == 3;
        let inverse = known.then(|| Matrix3::from_fn(|i, j| square[(i, j)] / (t[i] * t[j])));
        Some((Local { scaling, residual }, Slopes { own, through, inverse }))
    }

    /// (dx, dz) of every contact for the c of every contact. dz comes from the velocities, dz = T(ρ + B (W + R) dr), so that rounding
    /// leaves y and z together and goes into the gap.
    fn direction(&mut self, locals: &[Local], slopes: &[Slopes], c: &[Vector3<f64>]) -> Option<Direction> {
        let rows = self.problem.rows_per_contact();
        let mut right_side = DVector::zeros(self.problem.rows());
        for (k, (local, c)) in locals.iter().zip(c).enumerate() {
            let pushed = local.scaling.unscaled(c);
            let t = scale(super::cone_friction(self.problem, k));
            (0..rows).for_each(|row| right_side[k * rows + row] = pushed[row] * if row == 0 { t } else { 1.0 } - local.residual[row]);
        }
        let moved = self.systems.solve(&self.operator, &right_side)?;
        let mut answered = self.systems.moved(self.problem, &moved);
        moved.iter().enumerate().for_each(|(row, dr)| answered[row] += self.problem.row_compliance(row) * dr);
        let padded = |of: &DVector<f64>, k: usize| Vector3::from_fn(|row, _| if row < rows { of[k * rows + row] } else { 0.0 });
        let one = |(k, local): (usize, &Local)| {
            let mu = super::cone_friction(self.problem, k);
            let (t, dr) = (scale(mu), padded(&moved, k));
            let dx = if mu > 0.0 { Vector3::new(dr[0] * t, dr[1], dr[2]) } else { Vector3::new(dr[0], 0.0, 0.0) };
            let dz = local.residual + slopes[k].through * padded(&answered, k);
            (dx, Vector3::new(dz[0] / t, dz[1], dz[2]))
        };
        Some(locals.iter().enumerate().map(one).collect())
    }

    /// The longest step, at most 1/BOUNDARY, that stays in the cone.
    fn longest(&self, points: &[Vector3<f64>], direction: &[(Vector3<f64>, Vector3<f64>)]) -> f64 {
        let ends = points.iter().zip(&self.dual).zip(direction);
        ends.map(|((x, z), (dx, dz))| self_dual::to_boundary(x, dx).min(self_dual::to_boundary(z, dz)))
            .fold(1.0 / tolerance::BOUNDARY, f64::min)
    }

    fn advance(&mut self, direction: &[(Vector3<f64>, Vector3<f64>)], length: f64) -> bool {
        let rows = self.problem.rows_per_contact();
        for (k, (dx, dz)) in direction.iter().enumerate() {
            let mu = super::cone_friction(self.problem, k);
            self.impulse[k * rows] += length * dx[0] / scale(mu);
            (1..rows).for_each(|row| self.impulse[k * rows + row] += length * dx[row]);
            self.dual[k] += dz * length;
        }
        length > tolerance::LEAST_LENGTH && self.impulse.iter().all(|r| r.is_finite())
    }
}

/// μ, with which r_n is multiplied, and 1 for a contact without friction.
fn scale(mu: f64) -> f64 {
    if mu > 0.0 { mu } else { 1.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::certificate::residuals;
    use crate::operator::wall;
    use crate::solvers::NonsmoothNewton;
    use nalgebra::{DMatrix, dvector};

    fn block(law: Law, mu: f64, free: DVector<f64>) -> ContactProblem {
        let w = DMatrix::from_row_slice(3, 3, &[2.0, 0.3, 0.1, 0.3, 1.5, 0.2, 0.1, 0.2, 1.0]);
        ContactProblem::new(w, free).law(law).friction(vec![mu]).build().unwrap()
    }

    #[test]
    fn one_contact_opens_sticks_and_slides() {
        for law in [Law::Frictionless, Law::Associated, Law::Coulomb] {
            for (mu, free) in [
                (0.5, dvector![-1.0, 0.1, 0.0]),
                (0.5, dvector![-1.0, 2.0, -1.0]),
                (0.5, dvector![1.0, 2.0, -1.0]),
                (0.0, dvector![-1.0, 2.0, 0.5]),
                (2.0, dvector![-1.0, 0.5, 3.0]),
            ] {
                let problem = block(law, mu, free.clone());
                let near = InteriorPoint::default().solve(&problem, None).unwrap();
                // the direction of slip is known to the root of the gap only, and less where the contact hardly presses
                assert!(residuals(&problem, &near).unwrap().is_solution(1e-3), "{law:?} {mu} {free:?} {}", near.iterations);
                let ended = NonsmoothNewton { steps: 3, ..Default::default() }.solve(&problem, Some(&near.impulse)).unwrap();
                assert!(residuals(&problem, &ended).unwrap().is_solution(1e-12), "{law:?} {mu} {free:?}");
            }
        }
    }

    #[test]
    fn redundant_contacts_keep_their_impulses_in_the_middle() {
        // two points of one mass carry the same load
        let w = DMatrix::from_element(2, 2, 1.0);
        let problem = ContactProblem::new(w, dvector![-1.0, -1.0]).rows_per_contact(1).build().unwrap();
        let solution = InteriorPoint::default().solve(&problem, None).unwrap();
        assert!((solution.impulse - dvector![0.5, 0.5]).amax() < 1e-8);
    }

    /// The same contact n times over is on the same path, whatever n is.
    #[test]
    fn a_part_of_the_gap_is_the_same_part_however_many_contacts_there_are() {
        let steps = |n: usize, gap: f64| {
            let q = DVector::from_fn(3 * n, |row, _| [-1.0, 2.0, -1.0][row % 3]);
            let problem = ContactProblem::new(DMatrix::identity(3 * n, 3 * n), q).friction(vec![0.5; n]).build().unwrap();
            InteriorPoint { gap, ..Default::default() }.solve(&problem, None).unwrap().iterations
        };
        for gap in [1e-2, 1e-5] {
            assert_eq!(steps(1, gap), steps(100, gap), "{gap}");
        }
        assert!(steps(100, 1e-2) < steps(100, 1e-5) && steps(100, 1e-5) < steps(100, 0.0));
    }

    /// Bricks that fall with the lowest course already on the ground, of which the upper half is pushed.
    #[test]
    fn what_leaves_the_middle_is_put_back_and_fewer_steps_lead_to_the_same_answer() {
        let w = wall(8, 6, 1.0);
        let n = w.contacts();
        let q = DVector::from_fn(3 * n, |row, _| if row < 3 * 32 { [-0.1, 0.02, 0.01][row % 3] } else { [0.0, 0.3, 0.0][row % 3] });
        let problem = ContactProblem::new(w, q).law(Law::Associated).friction(vec![0.5; n]).build().unwrap();
        let solver =
            |recentres: bool| InteriorPoint { recentres, first_impulse: tolerance::FIRST_IMPULSE, gap: 1e-9, ..Default::default() };
        let solve = |recentres: bool| solver(recentres).solve(&problem, None).unwrap();
        let (with, without) = (solve(true), solve(false));
        assert!(with.iterations < without.iterations, "{} and {}", with.iterations, without.iterations);
        assert!((&with.velocity - &without.velocity).amax() < 1e-4, "{}", (&with.velocity - &without.velocity).amax());
    }

    #[test]
    fn polyhedral_laws_are_refused() {
        let problem = block(Law::PolyhedralCoulomb { directions: 4 }, 0.5, dvector![-1.0, 0.0, 0.0]);
        assert!(InteriorPoint::default().solve(&problem, None).unwrap_err().to_string().contains("polyhedral-coulomb"));
    }
}
