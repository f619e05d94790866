//! One contact, solved to rounding: y = A r + q with (r, y) in the law, A = W_kk + R_kk positive definite.
//!
//! **Coulomb.** If q_n ≥ 0 the contact opens, r = 0. Otherwise friction acts like a damper of unknown strength κ ≥ 0:
//! ```text
//!     A_nn r_n + A_nt r_t + q_n = 0 ,   (A_tt + κ I) r_t + A_tn r_n + q_t = 0 ,   ‖r_t‖ ≤ μ r_n ⟂ κ ≥ 0 .
//! ```
//! Without friction (κ → ∞) r_n = −q_n/A_nn > 0 and r_t = 0, so ‖r_t‖ − μ r_n < 0; if the sticking answer (κ = 0)
//! is outside the cone, the intermediate value theorem gives a κ with ‖r_t‖ = μ r_n: a sliding contact always exists. Newton's method
//! finds it as the root of μ r_n/‖r_t‖ − 1, which is nearly a straight line of κ: the first time to rounding, then from the κ of the last
//! sweep until a step is short, whose error is its square and vanishes with the changes of the sweeps.
//!
//! **Associated.** min ½ rᵀA r + qᵀr over K_μ. With A = L Lᵀ and L⁻¹ diag(μ², −1, −1) L⁻ᵀ = Q diag(a, −b, −c) Qᵀ the
//! answer on the boundary is x = QᵀLᵀr, x_i = p_i / (1 − ν j_i), p = −QᵀL⁻¹q, with a multiplier ν ≥ 0 found from one
//! scalar equation that has exactly one root, by Newton's method from the ν of the last sweep.

use super::polyhedral_contact::PolyhedralContact;
use crate::memory::spare::{Entry, spare_entries};
use crate::tolerance::{
    solvers::ROOT_STEPS,
    sweeps::{SHORT, SQUARED},
};
use nalgebra::{Cholesky, Matrix3, Vector3};

/// A contact that is prepared once and solved for many q.
pub(super) trait OneContact: Send + Clone + Entry {
    /// A by rows, padded to 3 × 3: what the solution is exact for.
    fn block(&self) -> &[f64; 9];

    /// The impulse r for the velocity q without it.
    fn solve(&mut self, q: [f64; 3]) -> [f64; 3];
}

spare_entries![Frictionless, Coulomb, Associated, Polyhedral];

/// A by rows.
pub(super) fn by_rows(block: &Matrix3<f64>) -> [f64; 9] {
    std::array::from_fn(|place| block[(place / 3, place % 3)])
}

/// The positive definite symmetric part of A, or nothing.
fn definite(block: &Matrix3<f64>) -> Option<Cholesky<f64, nalgebra::Const<3>>> {
    Cholesky::new((block + block.transpose()) * 0.5)
}

/// Whether the symmetric part of A is positive definite: its three pivots are positive.
pub(super) fn is_definite(block: &Matrix3<f64>) -> bool {
    let of = |i: usize, j: usize| 0.5 * (block[(i, j)] + block[(j, i)]);
    let (first, second, third) = (of(0, 0), of(1, 0) / of(0, 0), of(2, 0) / of(0, 0));
    let [s, t, u] = [of(1, 1) - second * of(1, 0), of(2, 1) - third * of(1, 0), of(2, 2) - third * of(2, 0)];
    first > 0.0 && s > 0.0 && u - t / s * t > 0.0
}

/// 0 ≤ r_n ⟂ A_nn r_n + q_n ≥ 0 and r_t = 0.
#[derive(Clone, Debug)]
pub(super) struct Frictionless {
    block: [f64; 9],
}

impl Frictionless {
    /// Needs A_nn > 0.
    pub(super) fn new(block: &Matrix3<f64>) -> Option<Self> {
        (block[(0, 0)] > 0.0).then_some(Frictionless { block: by_rows(block) })
    }
}

impl OneContact for Frictionless {
    fn block(&self) -> &[f64; 9] {
        &self.block
    }

    #[inline(always)]
    fn solve(&mut self, q: [f64; 3]) -> [f64; 3] {
        [(-q[0] / self.block[0]).max(0.0), 0.0, 0.0]
    }
}

/// Coulomb's law, in two cache lines.
#[derive(Clone, Debug)]
pub(super) struct Coulomb {
    block: [f64; 9],
    /// 1/A_nn.
    inverse: f64,
    /// S⁻¹ by rows, S = A_tt − A_tn A_nt/A_nn.
    stick: [f64; 4],
    mu: f64,
    /// κ of the last time the contact slid, negative before.
    damper: f64,
}

impl Coulomb {
    /// The symmetric part of A must be positive definite, or A_nn positive where μ is zero.
    pub(super) fn new(block: &Matrix3<f64>, mu: f64) -> Option<Self> {
        let (a, mut stick) = (by_rows(block), [0.0; 4]);
        let inverse = 1.0 / a[0];
        if mu > 0.0 {
            is_definite(block).then_some(())?;
            let [s, t, u, v] = schur(&a, inverse);
            let determinant = s * v - t * u;
            stick = [v / determinant, -t / determinant, -u / determinant, s / determinant];
        }
        (a[0] > 0.0).then_some(Coulomb { block: a, inverse, stick, mu, damper: -1.0 })
    }

    /// μ.
    pub(super) fn friction(&self) -> f64 {
        self.mu
    }

    /// The sliding answer for r_n without friction and the velocity `rest` that sticking would stop; Newton's method on
    /// φ(κ) = μ r_n/‖r_t‖ − 1, which rises from below zero, within a bracket.
    #[inline]
    fn slide(&mut self, q: f64, pressed: f64, rest: [f64; 2]) -> [f64; 3] {
        let (a, mu) = (&self.block, self.mu);
        let [s, t, u, v] = schur(a, self.inverse);
        // the first time to rounding; then a short step is enough, whose error is its square
        let (short, start) = if self.damper < 0.0 { (SQUARED, 0.0) } else { (SHORT, self.damper) };
        let (mut low, mut high, mut kappa) = (0.0, f64::INFINITY, start);
        let mut tangential = [0.0; 2];
        for _ in 0..ROOT_STEPS {
            let (m, n) = (s + kappa, v + kappa);
            let inverse = 1.0 / (m * n - t * u);
            let solve = |x: [f64; 2]| [(t * x[1] - n * x[0]) * inverse, (u * x[0] - m * x[1]) * inverse];
            tangential = solve(rest);
            let slope = solve(tangential);
            let square = tangential[0] * tangential[0] + tangential[1] * tangential[1];
            let normal = pressed - (a[1] * tangential[0] + a[2] * tangential[1]) * self.inverse;
            let normal_slope = -(a[1] * slope[0] + a[2] * slope[1]) * self.inverse;
            let turned = tangential[0] * slope[0] + tangential[1] * slope[1];
            let excess = mu * normal - square.sqrt();
            let step = -excess * square / (mu * (normal_slope * square - normal * turned));
            let next = kappa + step;
            if excess < 0.0 {
                low = kappa
            } else {
                high = kappa
            }
            if !(next >= low && next <= high) {
                // Newton's method would leave the bracket
                let middle = if high.is_finite() { 0.5 * (low + high) } else { 2.0 * kappa + s + v };
                if middle <= low || middle >= high {
                    break;
                }
                kappa = middle;
                continue;
            }
            kappa = next;
            if step.abs() <= short * (kappa + s + v) {
                // the rest of the step changes the direction to second order
                tangential = [tangential[0] + slope[0] * step, tangential[1] + slope[1] * step];
                break;
            }
        }
        self.damper = kappa;
        let square = tangential[0] * tangential[0] + tangential[1] * tangential[1];
        let size = square.sqrt();
        if size == 0.0 {
            return [pressed, 0.0, 0.0];
        }
        let each = -q / (a[0] * size + mu * (a[1] * tangential[0] + a[2] * tangential[1]));
        [each * size, mu * each * tangential[0], mu * each * tangential[1]]
    }
}

/// A_tt − A_tn A_nt/A_nn by rows.
#[inline(always)]
fn schur(a: &[f64; 9], inverse: f64) -> [f64; 4] {
    let (first, second) = (a[3] * inverse, a[6] * inverse);
    [a[4] - first * a[1], a[5] - first * a[2], a[7] - second * a[1], a[8] - second * a[2]]
}

impl OneContact for Coulomb {
    fn block(&self) -> &[f64; 9] {
        &self.block
    }

    #[inline(always)]
    fn solve(&mut self, q: [f64; 3]) -> [f64; 3] {
        if q[0] >= 0.0 {
            return [0.0; 3];
        }
        let a = &self.block;
        let pressed = -q[0] * self.inverse;
        if self.mu == 0.0 {
            return [pressed, 0.0, 0.0];
        }
        let rest = [q[1] + a[3] * pressed, q[2] + a[6] * pressed];
        let stick = &self.stick;
        let tangential = [-(stick[0] * rest[0] + stick[1] * rest[1]), -(stick[2] * rest[0] + stick[3] * rest[1])];
        let normal = pressed - (a[1] * tangential[0] + a[2] * tangential[1]) * self.inverse;
        let most = self.mu * normal;
        if most >= 0.0 && tangential[0] * tangential[0] + tangential[1] * tangential[1] <= most * most {
            return [normal, tangential[0], tangential[1]];
        }
        self.slide(q[0], pressed, rest)
    }
}

/// The associated law.
#[derive(Clone, Debug)]
pub(super) struct Associated {
    block: [f64; 9],
    mu: f64,
    basis: Matrix3<f64>,
    cone: [f64; 3],
    /// s of the last sweep, in which ν = s/(1 − s)/a.
    place: f64,
}

impl Associated {
    /// A must be symmetric positive definite; without friction A_nn > 0 is enough.
    pub(super) fn new(block: &Matrix3<f64>, mu: f64) -> Option<Self> {
        if mu == 0.0 {
            let frictionless = Associated { block: by_rows(block), mu, basis: Matrix3::zeros(), cone: [0.0; 3], place: 0.0 };
            return (block[(0, 0)] > 0.0).then_some(frictionless);
        }
        let inverse = Cholesky::new(*block)?.l().try_inverse()?;
        let quadratic = Matrix3::from_diagonal(&Vector3::new(mu * mu, -1.0, -1.0));
        let eigen = (inverse * quadratic * inverse.transpose()).symmetric_eigen();
        let mut basis = inverse.transpose() * eigen.eigenvectors;
        let mut cone = eigen.eigenvalues;
        let positive = cone.imax();
        basis.swap_columns(0, positive);
        cone.swap_rows(0, positive);
        if basis[(0, 0)] < 0.0 {
            basis.column_mut(0).neg_mut();
        }
        let has_signs = cone[0] > 0.0 && cone[1] < 0.0 && cone[2] < 0.0;
        has_signs.then(|| Associated { block: by_rows(block), mu, basis, cone: cone.into(), place: 0.25 })
    }
}

impl OneContact for Associated {
    fn block(&self) -> &[f64; 9] {
        &self.block
    }

    fn solve(&mut self, q: [f64; 3]) -> [f64; 3] {
        let mu = self.mu;
        if q[0] >= mu * q[1].hypot(q[2]) {
            return [0.0; 3];
        }
        if mu == 0.0 {
            return [-q[0] / self.block[0], 0.0, 0.0];
        }
        let q = Vector3::from(q);
        let p = -self.basis.tr_mul(&q);
        let stick = self.basis * p;
        if mu * stick[0] >= stick[1].hypot(stick[2]) {
            return stick.into();
        }
        // the pole ν = 1/a sits at s = ½
        let (root_a, b, c) = (self.cone[0].sqrt(), -self.cone[1], -self.cone[2]);
        let (grow_b, grow_c) = (b / self.cone[0] - 1.0, c / self.cone[0] - 1.0);
        let boundary = |s: f64| {
            let (second, third) = (1.0 + s * grow_b, 1.0 + s * grow_c);
            let (x, y) = (b.sqrt() * p[1] / second, c.sqrt() * p[2] / third);
            let (length, side) = (x.hypot(y), 1.0 - 2.0 * s);
            let shrink = if length > 0.0 { (x * x * grow_b / second + y * y * grow_c / third) / length } else { 0.0 };
            (root_a * p[0] - side * length, 2.0 * length + side * shrink)
        };
        let s = increasing_root(self.place, boundary);
        self.place = s;
        let (second, third) = (1.0 + s * grow_b, 1.0 + s * grow_c);
        let (x1, x2) = (p[1] * (1.0 - s) / second, p[2] * (1.0 - s) / third);
        let x0 = (b.sqrt() * x1).hypot(c.sqrt() * x2) / root_a;
        let guess = self.basis * Vector3::new(x0, x1, x2);
        let size = guess[1].hypot(guess[2]);
        if size == 0.0 {
            return [0.0; 3];
        }
        let edge = Vector3::new(1.0, mu * guess[1] / size, mu * guess[2] / size);
        let a = Matrix3::from_row_slice(&self.block);
        (edge * (-q.dot(&edge) / edge.dot(&(a * edge))).max(0.0)).into()
    }
}

/// The s in \[0, 1\] where a function, given with its derivative, changes from negative to non-negative, to rounding: Newton's method from
/// `start` within a bracket, halved at least every third step.
fn increasing_root(start: f64, f: impl Fn(f64) -> (f64, f64)) -> f64 {
    let (mut low, mut high, mut x) = (0.0, 1.0, start);
    for step in 1..=ROOT_STEPS {
        let (value, slope) = f(x);
        if value == 0.0 {
            return x;
        }
        if value < 0.0 {
            low = x
        } else {
            high = x
        }
        let (newton, middle) = (x - value / slope, 0.5 * (low + high));
        let next = if step % 3 != 0 && newton > low && newton < high { newton } else { middle };
        if next <= low || next >= high {
            break;
        }
        if (newton - x).abs() <= SQUARED * SQUARED * x {
            return newton.clamp(low, high);
        }
        x = next;
    }
    x
}

/// Coulomb's law along d ≥ 3 directions.
#[derive(Clone, Debug)]
pub(super) struct Polyhedral {
    block: [f64; 9],
    contact: Option<PolyhedralContact>,
}

impl Polyhedral {
    /// A must be positive definite, and d ≥ 3; without friction A_nn > 0 is enough.
    pub(super) fn new(block: &Matrix3<f64>, mu: f64, directions: usize) -> Option<Self> {
        let contact = if mu > 0.0 {
            definite(block)?;
            Some(PolyhedralContact::new(block, mu, directions)?)
        } else {
            None
        };
        (block[(0, 0)] > 0.0).then(|| Polyhedral { block: by_rows(block), contact })
    }
}

impl OneContact for Polyhedral {
    fn block(&self) -> &[f64; 9] {
        &self.block
    }

    fn solve(&mut self, q: [f64; 3]) -> [f64; 3] {
        match &self.contact {
            Some(contact) => contact.solve(&Matrix3::from_row_slice(&self.block), &q.into()).into(),
            None => [(-q[0] / self.block[0]).max(0.0), 0.0, 0.0],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cones::second_order::{distance, dual_distance};
    use moreau_exact::tolerance::rounding;
    use proptest::prelude::*;

    fn entries() -> impl Strategy<Value = [f64; 9]> {
        prop::array::uniform9(-1.0..1.0f64)
    }

    fn velocity(a: &Matrix3<f64>, r: [f64; 3], q: [f64; 3]) -> [f64; 3] {
        (a * Vector3::from(r) + Vector3::from(q)).into()
    }

    proptest! {
        /// (r, ŷ) in K × K* with r·ŷ = 0, from every earlier multiplier: Coulomb's law of one contact.
        #[test]
        fn coulomb_and_associated_answers_satisfy_their_law(
            root in entries(), q in prop::array::uniform3(-1.0..1.0f64), before in prop::array::uniform3(-1.0..1.0f64), mu in 0.05..1.5f64,
        ) {
            let root = Matrix3::from_row_slice(&root);
            let a = root * root.transpose() + Matrix3::identity() * 0.25;
            // entries of A are at most 3.25, those of A⁻¹ at most 4, r at most 8; a quotient by a multiplier's slope loses a factor more
            let bound = rounding(1024, 64.0) * 16.0;
            let mut coulomb = Coulomb::new(&a, mu).unwrap();
            coulomb.solve(before);
            // four short steps square an error of a thousandth to rounding
            let r = [(); 4].map(|()| coulomb.solve(q))[3];
            let mut y = velocity(&a, r, q);
            y[0] += mu * y[1].hypot(y[2]);
            let off = [distance(&r, mu), dual_distance(&y, mu), (0..3).map(|k| r[k] * y[k]).sum::<f64>().abs()];
            prop_assert!(off.iter().all(|off| *off <= bound), "Coulomb: {off:?}");
            let mut associated = Associated::new(&a, mu).unwrap();
            associated.solve(before);
            let r = associated.solve(q);
            let y = velocity(&a, r, q);
            let off = [distance(&r, mu), dual_distance(&y, mu), (0..3).map(|k| r[k] * y[k]).sum::<f64>().abs()];
            prop_assert!(off.iter().all(|off| *off <= bound), "associated: {off:?}");
        }

        /// An asymmetric A with a definite symmetric part has a sliding answer, too.
        #[test]
        fn coulomb_answers_of_asymmetric_blocks_satisfy_the_law(
            q in prop::array::uniform3(-1.0..1.0f64),
            skew in -0.5..0.5f64,
            mu in 0.05..1.0f64,
        ) {
            let a = Matrix3::new(1.0, 0.2 + skew, 0.1, 0.2 - skew, 1.0, skew, 0.1, -skew, 2.0);
            let r = Coulomb::new(&a, mu).unwrap().solve(q);
            let mut y = velocity(&a, r, q);
            y[0] += mu * y[1].hypot(y[2]);
            let off = [distance(&r, mu), dual_distance(&y, mu), (0..3).map(|k| r[k] * y[k]).sum::<f64>().abs()];
            prop_assert!(off.iter().all(|off| *off <= rounding(1024, 64.0) * 16.0), "{off:?}");
        }
    }

    #[test]
    fn blocks_that_are_not_definite_are_refused() {
        let weak = Matrix3::new(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, -1.0);
        assert!(Coulomb::new(&weak, 0.5).is_none() && Associated::new(&weak, 0.5).is_none() && Polyhedral::new(&weak, 0.5, 4).is_none());
        assert!(Coulomb::new(&weak, 0.0).is_some() && Frictionless::new(&weak).is_some() && Frictionless::new(&-weak).is_none());
    }
}
