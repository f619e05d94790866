//! Problems without any solution, by a witness that is checked in fractions.
//!
//! ```text
//!     p in P ,   −(Aᵀp)_k ∈ K_k* for every contact k ,   p·(u_free + shift) < 0 ,       A = W + R
//!     P = normal impulses p_n ≥ 0, p_t = 0   (frictionless, Coulomb, polyhedral) ,      P = K   (associated)
//!     at a bilateral row   p_b of any sign ,   (Aᵀp)_b = 0
//! ```
//! Such a p refutes every r ∈ K: the law asks y_n ≥ 0, or y ∈ K*, and y_b = 0, hence p·y ≥ 0; but p·y = (Aᵀp)·r + p·(u_free + shift), where
//! the first term is at most 0 and the second is negative. Two walls that close in on a body are the example, and rods that contradict each
//! other. A polygon's cone lies in the round one, and its edges' velocities y_n + μ Dⱼ·y_t ≥ 0 have y_n as their mean. A problem may have
//! no solution without such a witness; then this says nothing.
//!
//! Of up to twelve contacts that W joins the search is a linear program in fractions, with eight generators of each cone for the candidates
//! – of more than three contacts with normal impulses alone – and eight bounds around each dual cone. Of more contacts, witnesses are
//! looked for that move nothing, Aᵀp = 0 (`kernel_witness`), and of problems whose M̂ and H are known such with Hᵀp = 0, which refute the
//! exact W = H M̂⁻¹ Hᵀ, of which the stored one is rounded. What is found is checked against the round cones after squaring.

use super::feasibility::nonnegative_solution;
use super::kernel_witness;
use super::planted::{Plant, planted};
use super::true_operator::TrueOperator;
use crate::operator::Islands;
use crate::problem::{ContactProblem, Coordinates, Law};
use crate::tolerance::joints::AGREES;
use crate::tolerance::proof::{WITNESS_CONTACTS, WITNESS_ENTRIES, WITNESS_ROUND, WITNESS_STEPS, WITNESS_WORK};
use dashu_ratio::RBig;
use moreau_exact::scalar::{Rational, Scalar, exact, ratio};
use nalgebra::{DMatrix, DVector};

/// Impulses p that no velocity of the problem can agree with.
#[derive(Clone, Debug, PartialEq)]
pub struct Infeasible {
    /// p \[N·s\], one per row.
    pub witness: DVector<Rational>,
    /// p·(u_free + shift) < 0 \[J\].
    pub product: Rational,
    /// |p·(u_free + shift)|/Σ|p||u_free + shift|, rounded: near ε the problem contradicts itself by no more than the rounding of its data.
    pub relative: f64,
    /// Whether Hᵀp = 0, so that the proof is of W = H M̂⁻¹ Hᵀ itself; otherwise it is of W as the problem stores it.
    pub of_mechanism: bool,
}

/// Eight directions of rational length, five times unit vectors.
const DIRECTIONS: [[i64; 2]; 8] = [[5, 0], [4, 3], [0, 5], [-3, 4], [-5, 0], [-4, -3], [0, -5], [3, -4]];

/// A witness that the problem has no solution; none if the search finds none.
/// ```
/// use moreau_contact::certificate::infeasible::infeasible;
/// use moreau_contact::nalgebra::{DMatrix, dvector};
/// use moreau_contact::{ContactProblem, Law};
///
/// let between = |left: f64, right: f64| {
///     // walls on both sides of a body come nearer at these speeds
///     let w = DMatrix::from_row_slice(2, 2, &[1.0, -1.0, -1.0, 1.0]);
///     ContactProblem::new(w, dvector![-left, -right]).rows_per_contact(1).law(Law::Frictionless).build()
/// };
/// assert!(infeasible(&between(1.0, 0.5)?).is_some()); // it is crushed
/// assert!(infeasible(&between(1.0, -1.0)?).is_none()); // it is carried along
/// # Ok::<(), moreau_contact::Error>(())
/// ```
pub fn infeasible(problem: &ContactProblem) -> Option<Infeasible> {
    of_rows(problem, &vec![false; problem.contacts()])
}

/// The same of a problem whose contacts stand for bilateral rows where `joined` says so.
pub(super) fn of_rows(problem: &ContactProblem, joined: &[bool]) -> Option<Infeasible> {
    let on_edges = problem.compliance().is_some_and(|soft| soft.coordinates == Coordinates::Edge);
    let rows = problem.rows_per_contact();
    // where W ⪰ 0 and every row of p is soft, p·A p > 0
    let all_soft = (0..problem.contacts()).all(|k| problem.row_compliance(k * rows) > 0.0);
    if on_edges || all_soft {
        return None;
    }
    let w = TrueOperator::of(problem);
    let (is_known, is_made) = (!matches!(w, TrueOperator::Unknown), matches!(w, TrueOperator::Made(_)));
    let sought = Sought { problem, joined, made: if let TrueOperator::Made(made) = w { Some(made) } else { None } };
    let of_w = || sought.of_islands().and_then(|witness| Some((sought.check(&witness)?, witness, is_made)));
    let of_w = if is_known { of_w() } else { None };
    let found = of_w.or_else(|| sought.of_mechanism().map(|(product, witness)| (product, witness, true)));
    found.map(|(product, witness, of_mechanism)| Infeasible { relative: sought.relative(&witness), witness, product, of_mechanism })
}

/// p·(u_free + shift), if p is a witness.
pub fn check(problem: &ContactProblem, witness: &DVector<Rational>) -> Option<Rational> {
    let made = match TrueOperator::of(problem) {
        TrueOperator::Stored => None,
        TrueOperator::Made(made) => Some(made),
        TrueOperator::Unknown => return None,
    };
    Sought { problem, joined: &vec![false; problem.contacts()], made }.check(witness)
}

/// A problem, or some of its contacts, and which of them are bilateral rows.
struct Sought<'a> {
    problem: &'a ContactProblem,
    joined: &'a [bool],
    /// W in fractions, where mass and Jacobian make it.
    made: Option<DMatrix<Rational>>,
}

type Generator = Vec<(usize, Rational)>;

impl Sought<'_> {
    fn free(&self) -> Vec<Rational> {
        self.problem.free_velocity().iter().zip(self.problem.shift()).map(|(q, s)| exact(*q) + exact(*s)).collect()
    }

    /// A witness of the first island that has one: what cannot be solved there cannot be solved at all. The smallest are looked at first,
    /// and not more than a limited work.
    fn of_islands(&self) -> Option<DVector<Rational>> {
        let islands = self.problem.islands();
        if islands.members.len() == 1 && !islands.last_is_of_lone {
            return self.of_joined();
        }
        let mut all = islands.one_by_one();
        all.sort_by_key(Vec::len);
        let (mut work, mut entries, mut by_rounding) = (0, 0, None);
        for members in &all {
            let is_small = members.len() <= WITNESS_CONTACTS;
            let [mine, beyond] = if is_small { [members.len().pow(3), 0] } else { [0, members.len() * self.problem.rows_per_contact()] };
            (work, entries) = (work + mine, entries + beyond * beyond);
            if work > WITNESS_WORK || entries > 8 * WITNESS_ENTRIES {
                break;
            }
            match self.of_island(islands, members) {
                // another one may contradict more than the last digits
                Some(witness) if self.relative(&witness) <= AGREES => by_rounding = by_rounding.or(Some(witness)),
                Some(witness) => return Some(witness),
                None => {}
            }
        }
        by_rounding
    }

    fn of_island(&self, islands: &Islands, members: &[usize]) -> Option<DVector<Rational>> {
        let rows = self.problem.rows_per_contact();
        let joined: Vec<bool> = members.iter().map(|k| self.joined[*k]).collect();
        let place = |row: usize| members[row / rows] * rows + row % rows;
        let size = members.len() * rows;
        let made = self.made.as_ref().map(|w| DMatrix::from_fn(size, size, |i, j| w[(place(i), place(j))].clone()));
        let own = Sought { problem: &self.problem.island(islands, members), joined: &joined, made }.of_joined()?;
        let mut witness = DVector::from_element(self.problem.rows(), RBig::ZERO);
        for (place, k) in members.iter().enumerate() {
            (0..rows).for_each(|row| witness[k * rows + row] = own[place * rows + row].clone());
        }
        Some(witness)
    }

    /// A witness of contacts that W joins; it is checked by the caller.
    fn of_joined(&self) -> Option<DVector<Rational>> {
        let (problem, rows) = (self.problem, self.problem.rows_per_contact());
        let given = |row: usize| problem.free_velocity()[row] + problem.shift()[row];
        let closes = |k: usize| if self.joined[k] { given(k * rows) != 0.0 } else { given(k * rows) < 0.0 };
        if problem.law() != Law::Associated && !(0..problem.contacts()).any(closes) {
            return None; // p·q < 0 needs a contact with q_n < 0, or a joint with q_b ≠ 0
        }
        if problem.contacts() > WITNESS_CONTACTS {
            let generators = self.generators(true);
            if generators.len() * problem.rows() > WITNESS_ENTRIES {
                return None;
            }
            let moved = self.products(&generators);
            let matrix = DMatrix::from_fn(problem.rows(), generators.len(), |row, j| moved[j][row].clone());
            return self.of_kernel(&generators, &matrix);
        }
        self.of_program()
    }

    /// A witness B λ = 0 of these generators.
    fn of_kernel(&self, generators: &[Generator], matrix: &DMatrix<Rational>) -> Option<DVector<Rational>> {
        let weights = kernel_witness::weights(matrix, &self.given(generators), WITNESS_STEPS)?;
        Some(self.combined(generators, &weights))
    }

    /// A witness with Hᵀp = 0, and p·(u_free + shift).
    fn of_mechanism(&self) -> Option<(Rational, DVector<Rational>)> {
        let jacobian = &self.problem.dynamics()?.jacobian;
        let hard = |generator: &Generator| generator.iter().all(|(row, _)| self.problem.row_compliance(*row) == 0.0);
        let generators: Vec<Generator> = self.generators(true).into_iter().filter(hard).collect();
        if generators.len() * jacobian.ncols() > WITNESS_ENTRIES {
            return None;
        }
        let along =
            |generator: &Generator, v: usize| generator.iter().fold(RBig::ZERO, |sum, (row, part)| sum + exact(jacobian[(*row, v)]) * part);
        let matrix = DMatrix::from_fn(jacobian.ncols(), generators.len(), |v, j| along(&generators[j], v));
        let witness = self.of_kernel(&generators, &matrix)?;
        let still = (0..jacobian.ncols()).all(|v| {
            let pressed = witness.iter().enumerate().filter(|(_, p)| !p.is_zero());
            pressed.fold(RBig::ZERO, |sum, (row, p)| sum + exact(jacobian[(row, v)]) * p).is_zero()
        });
        let product = self.product(&witness);
        let holds = still && product < RBig::ZERO && (0..self.problem.contacts()).all(|k| self.may_press(&witness, k));
        holds.then_some((product, witness))
    }

    /// A witness by a linear program in fractions.
    fn of_program(&self) -> Option<DVector<Rational>> {
        let generators = self.generators(false);
        let moved = self.products(&generators);
        let (bounds, given) = (self.bounds(&moved), self.given(&generators));
        // λ ≥ 0 of the generators and slacks s ≥ 0:   B λ + s = 0 ,   (Gᵀ free) λ = −1
        let (n, m) = (generators.len(), bounds.len());
        let mut system = DMatrix::from_element(m + 1, n + m, RBig::ZERO);
        for (i, bound) in bounds.iter().enumerate() {
            (0..n).for_each(|j| system[(i, j)] = bound[j].clone());
            system[(i, n + i)] = RBig::ONE;
        }
        (0..n).for_each(|j| system[(m, j)] = given[j].clone());
        let right = DVector::from_fn(m + 1, |i, _| if i == m { -RBig::ONE } else { RBig::ZERO });
        let weights = nonnegative_solution(&system, &right).point()?;
        Some(self.combined(&generators, &weights.rows(0, n).into_owned()))
    }

    /// Their products with u_free + shift.
    fn given(&self, generators: &[Generator]) -> Vec<Rational> {
        let free = self.free();
        generators.iter().map(|generator| generator.iter().fold(RBig::ZERO, |sum, (row, part)| sum + part * &free[*row])).collect()
    }

    fn combined(&self, generators: &[Generator], weights: &DVector<Rational>) -> DVector<Rational> {
        let mut witness = DVector::from_element(self.problem.rows(), RBig::ZERO);
        for (generator, weight) in generators.iter().zip(weights.iter()) {
            generator.iter().for_each(|(row, part)| witness[*row] += part * weight);
        }
        witness
    }

    /// |p·(u_free + shift)|/Σ|p||u_free + shift|, of a p with a negative product.
    fn relative(&self, witness: &DVector<Rational>) -> f64 {
        let terms = witness.iter().zip(self.free()).fold(RBig::ZERO, |sum, (p, q)| sum + (p * q).magnitude());
        if terms.is_zero() { 0.0 } else { Scalar::to_f64(&(-self.product(witness) / terms)) }
    }

    fn product(&self, witness: &DVector<Rational>) -> Rational {
        let pressed = witness.iter().zip(self.free()).filter(|(p, _)| !p.is_zero());
        pressed.fold(RBig::ZERO, |sum, (p, q)| sum + p * q)
    }

    /// p·(u_free + shift), if p is a witness.
    fn check(&self, witness: &DVector<Rational>) -> Option<Rational> {
        let on_edges = self.problem.compliance().is_some_and(|soft| soft.coordinates == Coordinates::Edge);
        if witness.len() != self.problem.rows() || on_edges {
            return None;
        }
        let product = self.product(witness);
        let obeyed = |k: usize| self.may_press(witness, k) && self.pushes_nothing(witness, k);
        (product < RBig::ZERO && (0..self.problem.contacts()).all(obeyed)).then_some(product)
    }

    /// μ of the cone of contact k.
    fn friction(&self, k: usize) -> Rational {
        let problem = self.problem;
        exact(if problem.rows_per_contact() == 1 { 0.0 } else { problem.law().cone_friction(problem.friction()[k]) })
    }

    /// Whether p ∈ P at contact k.
    fn may_press(&self, witness: &DVector<Rational>, k: usize) -> bool {
        let d = self.problem.rows_per_contact();
        let p = &witness.as_slice()[k * d..(k + 1) * d];
        if self.joined[k] {
            return p[1..].iter().all(RBig::is_zero);
        }
        let mu = if self.problem.law() == Law::Associated { self.friction(k) } else { RBig::ZERO };
        p[0] >= RBig::ZERO && squares(p) <= &mu * &mu * &p[0] * &p[0]
    }

    /// Whether −(Aᵀp)_k ∈ K_k*, or is zero at a bilateral row.
    fn pushes_nothing(&self, witness: &DVector<Rational>, k: usize) -> bool {
        let d = self.problem.rows_per_contact();
        let velocity: Vec<Rational> = (k * d..(k + 1) * d).map(|column| -self.transposed(witness, column)).collect();
        if self.joined[k] && !planted(Plant::Held) {
            return velocity.iter().all(RBig::is_zero);
        }
        let mu = self.friction(k);
        velocity[0] >= RBig::ZERO && &velocity[0] * &velocity[0] >= &mu * &mu * squares(&velocity)
    }

    /// (Aᵀp) at one row.
    fn transposed(&self, p: &DVector<Rational>, column: usize) -> Rational {
        let mut sum = exact(self.problem.row_compliance(column)) * &p[column];
        self.problem.delassus().for_each_in_column(column, |row, w| {
            if !p[row].is_zero() {
                sum += exact(w) * &p[row];
            }
        });
        sum
    }

    /// Impulses whose combinations are tried, row by row; of round cones the directions of as many contacts as a linear program takes, or
    /// of all.
    fn generators(&self, round: bool) -> Vec<Generator> {
        let (problem, d) = (self.problem, self.problem.rows_per_contact());
        let of = |k: usize| -> Vec<Generator> {
            let mu = exact(problem.law().cone_friction(problem.friction()[k]));
            if self.joined[k] {
                return vec![vec![(k * d, RBig::ONE)], vec![(k * d, -RBig::ONE)]];
            }
            if d == 1 || problem.law() != Law::Associated || mu.is_zero() || (problem.contacts() > WITNESS_ROUND && !round) {
                return vec![vec![(k * d, RBig::ONE)]];
            }
            let along = |[x, y]: [i64; 2]| {
                let tangents = [x, y].into_iter().enumerate().take(d - 1).map(|(i, part)| (k * d + 1 + i, &mu * ratio(part, 5)));
                [(k * d, RBig::ONE)].into_iter().chain(tangents).collect()
            };
            DIRECTIONS.into_iter().filter(|direction| d == 3 || direction[1] == 0).map(along).collect()
        };
        (0..problem.contacts()).flat_map(of).collect()
    }

    /// Aᵀ times every generator.
    fn products(&self, generators: &[Generator]) -> Vec<DVector<Rational>> {
        let at = |generator: &Generator, column: usize| {
            let soft = |row: usize| if row == column { exact(self.problem.row_compliance(row)) } else { RBig::ZERO };
            let entry =
                |row: usize| self.made.as_ref().map_or_else(|| exact(self.problem.entry(row, column)), |w| w[(row, column)].clone());
            let moved = |row: usize| entry(row) + soft(row);
            generator.iter().fold(RBig::ZERO, |sum, (row, part)| sum + part * moved(*row))
        };
        generators.iter().map(|generator| DVector::from_fn(self.problem.rows(), |column, _| at(generator, column))).collect()
    }

    /// Rows that must not be positive: (Aᵀp)_n + μ c d·(Aᵀp)_t for directions d, where c makes the polygon contain the disk; at a bilateral
    /// row (Aᵀp)_b and its opposite.
    fn bounds(&self, moved: &[DVector<Rational>]) -> Vec<Vec<Rational>> {
        let d = self.problem.rows_per_contact();
        let mut made = Vec::new();
        for k in 0..self.problem.contacts() {
            let mu = self.friction(k);
            if self.joined[k] || mu.is_zero() {
                made.push(moved.iter().map(|w| w[k * d].clone()).collect());
                if self.joined[k] {
                    made.push(moved.iter().map(|w| -w[k * d].clone()).collect());
                }
                continue;
            }
            // the widest angle between directions is 53.2°, and 1/cos(26.6°) < 9/8
            let wider = if d == 3 { ratio(9, 8) } else { RBig::ONE };
            for [x, y] in DIRECTIONS.into_iter().filter(|direction| d == 3 || direction[1] == 0) {
                let parts = [ratio(x, 5), ratio(y, 5)];
                let along = |w: &DVector<Rational>| (1..d).fold(RBig::ZERO, |sum, i| sum + &parts[i - 1] * &w[k * d + i]);
                made.push(moved.iter().map(|w| &w[k * d] + &mu * &wider * along(w)).collect());
            }
        }
        made
    }
}

/// Σ x² of the tangential components.
fn squares(of: &[Rational]) -> Rational {
    of[1..].iter().fold(RBig::ZERO, |sum, x| sum + x * x)
}

#[cfg(test)]
#[path = "infeasible_tests.rs"]
mod tests;
