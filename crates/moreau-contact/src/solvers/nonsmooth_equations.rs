//! Alart and Curnier's or Jean and Moreau's equations of a problem, their Jacobian, and a step of Newton's method on them
//! ([`nonsmooth_newton`](super::nonsmooth_newton)).
//!
//! A factor of J serves again while its steps leave little of F: near a solution J hardly changes, and a step with an old factor costs a
//! tenth of one with its own.

use super::block_elimination::Slopes;
use super::contact_systems::ContactSystems;
use super::elimination;
use super::friction_equations::FrictionEquations;
use super::friction_set::{FrictionSet, Piece};
use crate::certificate::Judge;
use crate::memory::spare::{self, Lent, Spare};
use crate::problem::{ContactProblem, Law};
use crate::tolerance::newton::{REUSED_AFTER, REUSED_LEAVES};
use crate::tolerance::solvers as tolerance;
use moreau_exact::Result;
use nalgebra::{DMatrix, DVector, Matrix3};

/// F and J of a problem.
pub(super) struct Equations<'a> {
    problem: &'a ContactProblem,
    /// R of every contact.
    radius: FrictionEquations,
    /// S of every contact.
    set: FrictionSet,
    /// W + R where it is stored densely; blocks are taken as they are.
    pub operator: Option<DMatrix<f64>>,
    /// What solves with J where W is stored by blocks.
    systems: Option<&'a mut ContactSystems>,
    /// ρ_n, ρ_t per contact \[kg\].
    weights: &'a [[f64; 2]],
    /// ‖F‖ where the last step ended \[N·s\], infinite before the first.
    norm: f64,
    /// What the last step left of ‖F‖ where it was made whole with the factor that is kept, and F there; else all of it.
    left: f64,
    residual: Lent<DVector<f64>>,
    /// How often that factor has served again, and how often it may.
    reused: usize,
    reuses: usize,
}

impl<'a> Equations<'a> {
    /// At most so many steps in a row have a factor of an earlier J.
    pub(super) fn new(
        problem: &'a ContactProblem,
        radius: FrictionEquations,
        reuses: usize,
        systems: Option<&'a mut ContactSystems>,
    ) -> Result<Self> {
        let set = match problem.law().directions() {
            Some(directions) if problem.rows_per_contact() == 3 => FrictionSet::Polygon { directions },
            _ => FrictionSet::Disk,
        };
        let operator = problem.delassus().blocks().is_none().then(|| problem.law_delassus()).transpose()?;
        let (weights, residual) = (Judge::weights(problem), Lent::default());
        Ok(Equations { problem, radius, set, operator, systems, weights, norm: f64::INFINITY, left: 1.0, residual, reused: 0, reuses })
    }

    /// Whether the last step left more of F than an answer may leave, so that its residual need not be looked at; asked only where a
    /// factor serves again.
    pub(super) fn is_far(&self, impulse: &DVector<f64>) -> bool {
        self.reuses > 0 && self.norm > tolerance::ENOUGH * impulse.amax()
    }

    /// r + d with the factor of an earlier J, if the step before left little of F and this one does, too.
    pub(super) fn step_again(&mut self, from: &DVector<f64>) -> Option<Lent<DVector<f64>>> {
        if self.reused >= self.reuses || self.left > REUSED_AFTER {
            return None;
        }
        let w = self.problem.delassus().blocks()?;
        let (mut residual, mut moved) = (std::mem::take(&mut self.residual), Lent::from(spare::zeros(from.len())));
        residual.neg_mut();
        let direction = Lent::from(self.systems.as_mut()?.solve(w, &residual)?);
        let (norm, tried) = self.moved(from, &direction, 1.0, [&mut moved, &mut residual]);
        (self.left, self.reused, self.residual) = (norm / self.norm, self.reused + 1, residual);
        (self.left <= REUSED_LEAVES).then(|| {
            self.norm = norm;
            tried
        })
    }

    /// r + s d with the first η and s that halve ‖F‖, or else those with the least; none where every d is not a number.
    pub(super) fn step(&mut self, from: &DVector<f64>, law_velocity: &DVector<f64>, proximals: &[f64]) -> Option<Lent<DVector<f64>>> {
        let mut best: Option<(f64, Lent<DVector<f64>>)> = None;
        (self.left, self.reused) = (1.0, 0);
        'tried: for &proximal in proximals {
            let (mut residual, slopes) = self.linearise(from, law_velocity, proximal);
            let enough = 0.5 * residual.norm();
            residual.neg_mut();
            let Some(direction) = self.direction(&slopes, &residual).map(Lent::from).filter(|d| d.iter().all(|x| x.is_finite())) else {
                continue;
            };
            let mut moved = Lent::from(spare::zeros(from.len()));
            for halvings in 0..tolerance::NONSMOOTH_HALVINGS {
                let part = 0.5f64.powi(halvings);
                let (norm, tried) = self.moved(from, &direction, part, [&mut moved, &mut residual]);
                if best.as_ref().is_none_or(|(least, _)| norm < *least) {
                    best = Some((norm, tried));
                }
                if norm <= enough {
                    if halvings == 0 {
                        (self.left, self.residual) = (0.5 * norm / enough, residual);
                    }
                    break 'tried;
                }
            }
        }
        let (norm, impulse) = best?;
        self.norm = norm;
        Some(impulse)
    }

    /// ‖F‖ at r + s d, and r + s d; y and F there are left in the memory that is given.
    fn moved(
        &self,
        from: &DVector<f64>,
        direction: &DVector<f64>,
        part: f64,
        [law_velocity, residual]: [&mut DVector<f64>; 2],
    ) -> (f64, Lent<DVector<f64>>) {
        let mut tried = Lent::from(from.copied());
        tried.zip_apply(direction, |tried, direction| *tried += direction * part);
        self.problem.write_law_velocity(tried.as_slice(), law_velocity.as_mut_slice());
        self.write_residual(&tried, law_velocity, residual);
        (residual.norm(), tried)
    }

    /// Overwrites `residual` with F(r).
    pub(super) fn write_residual(&self, impulse: &DVector<f64>, law_velocity: &DVector<f64>, residual: &mut DVector<f64>) {
        (0..self.problem.contacts()).for_each(|k| self.contact(k, [impulse, law_velocity], residual, None));
    }

    /// F(r), and A_k and B_k of J(r) with η for every contact; y = A r + q is given.
    pub(super) fn linearise(
        &self,
        impulse: &DVector<f64>,
        law_velocity: &DVector<f64>,
        proximal: f64,
    ) -> (Lent<DVector<f64>>, Lent<Vec<Slopes>>) {
        let mut residual = Lent::from(spare::zeros(self.problem.rows()));
        let mut slopes = Lent::from(spare::vector(self.problem.contacts()));
        for k in 0..self.problem.contacts() {
            self.contact(k, [impulse, law_velocity], &mut residual, Some((&mut slopes, proximal)));
        }
        (residual, slopes)
    }

    /// The d with J d = b.
    pub(super) fn direction(&mut self, slopes: &[Slopes], right_side: &DVector<f64>) -> Option<DVector<f64>> {
        match (&mut self.systems, self.problem.delassus().blocks()) {
            (Some(systems), Some(w)) => systems.factor(w, slopes, false).then(|| systems.solve(w, right_side)).flatten(),
            _ => elimination::solve(&self.jacobian(self.operator.as_ref()?, slopes), right_side),
        }
    }

    /// J, row by row: B times the rows of A, and A_k of the contact itself.
    pub(super) fn jacobian(&self, operator: &DMatrix<f64>, slopes: &[Slopes]) -> DMatrix<f64> {
        let (rows, mut jacobian) = (self.problem.rows_per_contact(), DMatrix::zeros(self.problem.rows(), self.problem.rows()));
        for (k, Slopes { own, through, .. }) in slopes.iter().enumerate() {
            for i in 0..rows {
                let mut changed = jacobian.row_mut(k * rows + i);
                // tangential columns first
                for column in (1..rows).chain([0]) {
                    if through[(i, column)] != 0.0 {
                        changed += operator.row(k * rows + column) * through[(i, column)];
                    }
                    changed[k * rows + column] += own[(i, column)];
                }
            }
        }
        jacobian
    }

    /// The rows of contact k of F and, if asked for, of J with its η.
    fn contact(
        &self,
        k: usize,
        [impulse, law_velocity]: [&DVector<f64>; 2],
        residual: &mut DVector<f64>,
        slopes: Option<(&mut Vec<Slopes>, f64)>,
    ) {
        let (rows, [rho_n, rho_t]) = (self.problem.rows_per_contact(), self.weights[k]);
        let (own, mu) = (k * rows..(k + 1) * rows, super::cone_friction(self.problem, k));
        let [r, y] = [impulse, law_velocity].map(|vector| &vector.as_slice()[own.clone()]);
        let residual = &mut residual.as_mut_slice()[own];
        let tangent = |of: &[f64], i: usize| of.get(1 + i).copied().unwrap_or(0.0);
        let [r_t, y_t] = [r, y].map(|of| [tangent(of, 0), tangent(of, 1)]);
        let associated = matches!(self.problem.law(), Law::Associated | Law::PolyhedralAssociated { .. });
        let lifted = if associated { self.set.against(y_t).map(|share| mu * share) } else { [0.0; 2] };
        let w = y[0] + lifted[0] * y_t[0] + lifted[1] * y_t[1];
        let a = r[0] - rho_n * w;
        let presses = a > 0.0;
        residual[0] = if presses { rho_n * w } else { r[0] };
        let radius = self.radius.radius(mu, [r[0], a]);
        let piece = self.set.piece(radius, [r_t[0] - rho_t * y_t[0], r_t[1] - rho_t * y_t[1]]);
        // F_t = (I − A) r_t + A ρ_t y_t − g R, without the difference of two numbers as large as r_t where the contact sticks
        for i in 0..rows - 1 {
            let moved = |j: usize| piece.stays(i, j) * r_t[j] + piece.along[i][j] * rho_t * y_t[j];
            residual[1 + i] = (0..rows - 1).map(moved).sum::<f64>() - piece.growth[i] * radius;
        }
        if let Some((slopes, proximal)) = slopes {
            slopes.push(self.slopes(k, presses, lifted, &piece, proximal));
        }
    }

    /// A_k and B_k: what the rows of contact k ask of its own impulse, and of its velocity y.
    fn slopes(&self, k: usize, presses: bool, lifted: [f64; 2], piece: &Piece, proximal: f64) -> Slopes {
        let (rows, [rho_n, rho_t]) = (self.problem.rows_per_contact(), self.weights[k]);
        let mu = super::cone_friction(self.problem, k);
        let (mut own, mut through) = (Matrix3::identity(), Matrix3::zeros());
        // ∂w/∂y
        let slope = [1.0, lifted[0], lifted[1]];
        own[(0, 0)] = if presses { proximal } else { 1.0 };
        if presses {
            (0..rows).for_each(|column| through[(0, column)] = rho_n * slope[column]);
        }
        for i in 0..rows - 1 {
            for j in 0..rows - 1 {
                let moves = piece.along[i][j];
                through[(1 + i, 1 + j)] = moves * rho_t;
                own[(1 + i, 1 + j)] = piece.stays(i, j) + moves * proximal;
            }
            if piece.growth[i] != 0.0 {
                // −g ∂R/∂r
                let falls = piece.growth[i] * self.radius.falls(mu) * rho_n;
                (0..rows).for_each(|column| through[(1 + i, column)] += slope[column] * falls);
                own[(1 + i, 0)] = -piece.growth[i] * mu;
            }
        }
        if self.operator.is_none() {
            // B R, which a dense operator holds already
            for column in 0..rows {
                let softness = self.problem.row_compliance(k * rows + column);
                (0..rows).for_each(|i| own[(i, column)] += through[(i, column)] * softness);
            }
        }
        Slopes { own, through, inverse: None }
    }
}
