//! MuJoCo's convex program in rationals: its primal form in accelerations, its dual form in forces, and the solution of the dual by
//! enumeration.
//!
//! ```text
//!     primal   P(x) = ½ (x − a₀)ᵀM(x − a₀) + Σ sᵢ((J x − a_ref)ᵢ) ,      a₀ = M⁻¹(τ − c)
//!     dual     D(f) = ½ fᵀ(A + R) f + fᵀ(a_u − a_ref)   over f ∈ Ω ,      A = J M⁻¹Jᵀ ,  a_u = J a₀
//!     sᵢ(y) = y²/(2R) two-sided,  min(y, 0)²/(2R) one-sided,  Huber with friction loss
//! ```
//! A force is optimal if and only if its gradient g = (A+R)f + a_u − a_ref is 0 on rows inside their bounds, ≥ 0 on rows at the lower and
//! ≤ 0 on rows at the upper one. Weak duality is P(x) + D(f) ≥ 0; equality proves both optimal.

use crate::closed_forms::huber::Huber;
use crate::elimination::{principal, solve, solve_columns};
use crate::scalar::{Rational, ratio};
use nalgebra::{DMatrix, DVector};

/// What the force of a row may be.
#[derive(Clone, Debug, PartialEq)]
pub enum Row {
    /// Anything: an equality constraint.
    TwoSided,
    /// f ≥ 0: a contact or limit.
    OneSided,
    /// |f| ≤ η \[N\].
    FrictionLoss(Rational),
}

/// The program.
#[derive(Clone, Debug)]
pub struct Program {
    /// M, positive definite.
    pub mass: DMatrix<Rational>,
    /// J.
    pub jacobian: DMatrix<Rational>,
    /// a₀ \[m/s²\].
    pub free: DVector<Rational>,
    /// a_ref \[m/s²\].
    pub reference: DVector<Rational>,
    /// R > 0 \[1/kg\], one per row.
    pub regularisation: DVector<Rational>,
    /// Ω, row by row.
    pub rows: Vec<Row>,
}

impl Program {
    /// A two-sided row, one with friction loss and two one-sided ones on three coupled coordinates; one of the contacts separates.
    pub fn mixed() -> Self {
        let integers = |n: usize, entries: &[i64]| DMatrix::from_row_iterator(n, 3, entries.iter().map(|&x| ratio(x, 1)));
        let vector = |entries: &[i64]| DVector::from_iterator(entries.len(), entries.iter().map(|&x| ratio(x, 1)));
        Program {
            mass: integers(3, &[3, 1, 0, 1, 2, 0, 0, 0, 1]),
            jacobian: integers(4, &[1, 0, 1, 0, 1, 0, 1, 1, 0, 0, 1, 1]),
            free: vector(&[-4, 7, -9]),
            reference: vector(&[2, 0, 10, -20]),
            regularisation: DVector::from_vec([(1, 9), (1, 2), (1, 5), (1, 19)].map(|(n, d)| ratio(n, d)).to_vec()),
            rows: vec![Row::TwoSided, Row::FrictionLoss(ratio(2, 1)), Row::OneSided, Row::OneSided],
        }
    }

    /// M⁻¹Jᵀ.
    fn compliance(&self) -> DMatrix<Rational> {
        solve_columns(&self.mass, &self.jacobian.transpose()).expect("M is definite")
    }

    /// A.
    pub fn delassus(&self) -> DMatrix<Rational> {
        &self.jacobian * self.compliance()
    }

    /// A + R.
    pub fn hessian(&self) -> DMatrix<Rational> {
        self.delassus() + DMatrix::from_diagonal(&self.regularisation)
    }

    /// a_u − a_ref.
    pub fn linear(&self) -> DVector<Rational> {
        &self.jacobian * &self.free - &self.reference
    }

    /// P(x).
    pub fn primal(&self, acceleration: &DVector<Rational>) -> Rational {
        let away = acceleration - &self.free;
        let y = self.violation(acceleration);
        let penalties = (0..y.len()).map(|i| self.penalty(i, &y[i]));
        penalties.fold(away.dot(&(&self.mass * &away)) * ratio(1, 2), |sum, penalty| sum + penalty)
    }

    /// D(f), for f ∈ Ω.
    pub fn dual(&self, force: &DVector<Rational>) -> Rational {
        force.dot(&(self.hessian() * force)) * ratio(1, 2) + force.dot(&self.linear())
    }

    /// x = a₀ + M⁻¹Jᵀf.
    pub fn acceleration(&self, force: &DVector<Rational>) -> DVector<Rational> {
        &self.free + self.compliance() * force
    }

    /// J x − a_ref.
    pub fn violation(&self, acceleration: &DVector<Rational>) -> DVector<Rational> {
        &self.jacobian * acceleration - &self.reference
    }

    /// The force f = −s′(J x − a_ref) that an acceleration shows, row by row.
    pub fn inverse(&self, acceleration: &DVector<Rational>) -> DVector<Rational> {
        let y = self.violation(acceleration);
        DVector::from_fn(y.len(), |i, _| {
            let spring = -&y[i] / &self.regularisation[i];
            match &self.rows[i] {
                Row::TwoSided => spring,
                Row::OneSided => spring.max(ratio(0, 1)),
                Row::FrictionLoss(bound) => self.huber(i, bound).force(&y[i]),
            }
        })
    }

    /// Every force in Ω that satisfies the conditions of optimality, by going through all assignments of rows to their bounds; those
    /// with a singular system are left out.
    pub fn optima(&self) -> Vec<DVector<Rational>> {
        let (hessian, linear) = (self.hessian(), self.linear());
        let mut optima: Vec<DVector<Rational>> = Vec::new();
        for choice in 0..3usize.pow(self.rows.len() as u32) {
            let places: Vec<usize> = (0..self.rows.len()).map(|i| choice / 3usize.pow(i as u32) % 3).collect();
            let Some(force) = self.candidate(&hessian, &linear, &places) else { continue };
            if !optima.contains(&force) {
                optima.push(force);
            }
        }
        optima
    }

    /// The force with each row inside (0), at its lower (1) or upper bound (2), if it is optimal.
    fn candidate(&self, hessian: &DMatrix<Rational>, linear: &DVector<Rational>, places: &[usize]) -> Option<DVector<Rational>> {
        let mut force = DVector::from_element(places.len(), ratio(0, 1));
        for (i, &place) in places.iter().enumerate() {
            let [lower, upper] = self.bounds(i);
            force[i] = match place {
                0 => ratio(0, 1),
                1 => lower?,
                _ => upper?,
            };
        }
        let inside: Vec<usize> = (0..places.len()).filter(|&i| places[i] == 0).collect();
        let load = hessian * &force + linear;
        let right = DVector::from_iterator(inside.len(), inside.iter().map(|&i| -load[i].clone()));
        let values = solve(&principal(hessian, &inside), &right)?;
        inside.iter().zip(values.iter()).for_each(|(&i, value)| force[i] = value.clone());
        let gradient = hessian * &force + linear;
        let optimal = (0..places.len()).all(|i| {
            let [lower, upper] = self.bounds(i);
            let within = lower.is_none_or(|bound| force[i] >= bound) && upper.is_none_or(|bound| force[i] <= bound);
            within
                && match places[i] {
                    0 => true,
                    1 => gradient[i] >= ratio(0, 1),
                    _ => gradient[i] <= ratio(0, 1),
                }
        });
        optimal.then_some(force)
    }

    fn bounds(&self, row: usize) -> [Option<Rational>; 2] {
        match &self.rows[row] {
            Row::TwoSided => [None, None],
            Row::OneSided => [Some(ratio(0, 1)), None],
            Row::FrictionLoss(bound) => [Some(-bound.clone()), Some(bound.clone())],
        }
    }

    fn huber(&self, row: usize, bound: &Rational) -> Huber<Rational> {
        Huber { bound: bound.clone(), regularisation: self.regularisation[row].clone() }
    }

    fn penalty(&self, row: usize, y: &Rational) -> Rational {
        let square = y * y / (ratio(2, 1) * &self.regularisation[row]);
        match &self.rows[row] {
            Row::TwoSided => square,
            Row::OneSided if *y < ratio(0, 1) => square,
            Row::OneSided => ratio(0, 1),
            Row::FrictionLoss(bound) => self.huber(row, bound).penalty(y),
        }
    }
}
