//! Problems without any solution, by a witness that is checked in fractions.
//!
//! ```text
//!     p in P ,   −(Wᵀp)_k ∈ K_k* for every contact k ,   p·(u_free + shift) < 0
//!     P = normal impulses p_n ≥ 0, p_t = 0   (frictionless, Coulomb, polyhedral) ,      P = K   (associated)
//! ```
//! Such a p refutes every r ∈ K: the law asks y_n ≥ 0, or y ∈ K*, hence p·y ≥ 0; but p·y = (Wᵀp)·r + p·(u_free + shift), where the first
//! term is at most 0 and the second is negative. Two walls that close in on a body are the example. A polygon's cone lies in
//! the round one, and its edges' velocities y_n + μ Dⱼ·y_t ≥ 0 have y_n as their mean. Contacts are hard: R = 0. A problem may
//! have no solution without such a witness; then this says nothing.
//!
//! The search is a linear program in fractions, with eight generators of each cone for the candidates – of many contacts with normal
//! impulses alone – and eight bounds around each dual cone; what it finds is checked against the round cones after squaring.

use super::feasibility::nonnegative_solution;
use crate::operator::Islands;
use crate::problem::{ContactProblem, Law};
use crate::tolerance::proof::{WITNESS_CONTACTS, WITNESS_ROUND, WITNESS_WORK};
use dashu_ratio::RBig;
use moreau_exact::scalar::{Rational, exact, ratio};
use nalgebra::{DMatrix, DVector};

/// Impulses p that no velocity of the problem can agree with.
#[derive(Clone, Debug, PartialEq)]
pub struct Infeasible {
    /// p \[N·s\], one per row.
    pub witness: DVector<Rational>,
    /// p·(u_free + shift) < 0 \[J\].
    pub product: Rational,
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
    let soft = problem.compliance().is_some();
    if soft || problem.contacts() == 0 {
        return None;
    }
    let islands = problem.islands();
    let witness = match islands.members.len() > 1 || islands.last_is_of_lone {
        true => of_an_island(problem, islands)?,
        false if problem.contacts() <= WITNESS_CONTACTS => of_joined(problem)?,
        false => return None,
    };
    let product = check(problem, &witness)?;
    Some(Infeasible { witness, product })
}

/// A witness of the first island that has one: what cannot be solved there cannot be solved at all. The smallest are looked at first, and
/// not more than a limited work.
fn of_an_island(problem: &ContactProblem, islands: &Islands) -> Option<DVector<Rational>> {
    let (last, of_lone) = (islands.members.len() - 1, islands.last_is_of_lone);
    let apart = |(place, members): (usize, &[usize])| -> Vec<Vec<usize>> {
        if of_lone && place == last { members.iter().map(|k| vec![*k]).collect() } else { vec![members.to_vec()] }
    };
    let mut all: Vec<Vec<usize>> = islands.members.iter().enumerate().flat_map(apart).collect();
    all.sort_by_key(Vec::len);
    let (rows, mut work) = (problem.rows_per_contact(), 0);
    for members in all.iter().take_while(|members| members.len() <= WITNESS_CONTACTS) {
        work += members.len().pow(3);
        if work > WITNESS_WORK {
            return None;
        }
        if let Some(own) = of_joined(&problem.island(islands, members)) {
            let mut witness = DVector::from_element(problem.rows(), RBig::ZERO);
            for (place, k) in members.iter().enumerate() {
                (0..rows).for_each(|row| witness[k * rows + row] = own[place * rows + row].clone());
            }
            return Some(witness);
        }
    }
    None
}

/// A witness of contacts that W joins; it is checked by the caller.
fn of_joined(problem: &ContactProblem) -> Option<DVector<Rational>> {
    let (rows, data) = (problem.rows_per_contact(), [problem.free_velocity(), problem.shift()]);
    let closes = |k: usize| data[0][k * rows] + data[1][k * rows] < 0.0;
    if problem.law() != Law::Associated && !(0..problem.contacts()).any(closes) {
        return None; // p·q < 0 needs a contact with q_n < 0
    }
    let generators = generators(problem);
    let moved = products(problem, &generators);
    let free: Vec<Rational> = problem.free_velocity().iter().zip(problem.shift()).map(|(q, s)| exact(*q) + exact(*s)).collect();
    let bounds = bounds(problem, &moved);
    // λ ≥ 0 of the generators and slacks s ≥ 0:   B λ + s = 0 ,   (Gᵀ free) λ = −1
    let (n, m) = (generators.len(), bounds.len());
    let mut system = DMatrix::from_element(m + 1, n + m, RBig::ZERO);
    for (i, bound) in bounds.iter().enumerate() {
        (0..n).for_each(|j| system[(i, j)] = bound[j].clone());
        system[(i, n + i)] = RBig::ONE;
    }
    for (j, generator) in generators.iter().enumerate() {
        system[(m, j)] = generator.iter().fold(RBig::ZERO, |sum, (row, part)| sum + part * &free[*row]);
    }
    let right = DVector::from_fn(m + 1, |i, _| if i == m { -RBig::ONE } else { RBig::ZERO });
    let weights = nonnegative_solution(&system, &right).point()?;
    let mut witness = DVector::from_element(problem.rows(), RBig::ZERO);
    for (generator, weight) in generators.iter().zip(weights.iter()) {
        generator.iter().for_each(|(row, part)| witness[*row] += part * weight);
    }
    Some(witness)
}

/// p·(u_free + shift), if p is a witness.
pub fn check(problem: &ContactProblem, witness: &DVector<Rational>) -> Option<Rational> {
    let (d, law) = (problem.rows_per_contact(), problem.law());
    if witness.len() != problem.rows() || problem.compliance().is_some() {
        return None;
    }
    let mu = |k: usize| exact(if d == 1 { 0.0 } else { law.cone_friction(problem.friction()[k]) });
    let squares = |of: &[Rational]| of[1..].iter().fold(RBig::ZERO, |sum, x| sum + x * x);
    let contact = |k: usize| &witness.as_slice()[k * d..(k + 1) * d];
    let tests = |k: usize| {
        let (p, mu) = (contact(k), if law == Law::Associated { mu(k) } else { RBig::ZERO });
        p[0] >= RBig::ZERO && squares(p) <= &mu * &mu * &p[0] * &p[0]
    };
    let pushes_nothing = |k: usize| {
        let velocity: Vec<Rational> = (k * d..(k + 1) * d).map(|column| -transposed(problem, witness, column)).collect();
        let mu = mu(k);
        velocity[0] >= RBig::ZERO && &velocity[0] * &velocity[0] >= &mu * &mu * squares(&velocity)
    };
    let product = (0..problem.rows())
        .filter(|row| !witness[*row].is_zero())
        .fold(RBig::ZERO, |sum, row| sum + &witness[row] * (exact(problem.free_velocity()[row]) + exact(problem.shift()[row])));
    let holds = product < RBig::ZERO && (0..problem.contacts()).all(|k| tests(k) && pushes_nothing(k));
    holds.then_some(product)
}

/// (Wᵀp) at one row.
fn transposed(problem: &ContactProblem, p: &DVector<Rational>, column: usize) -> Rational {
    let mut sum = RBig::ZERO;
    problem.delassus().for_each_in_column(column, |row, w| {
        if !p[row].is_zero() {
            sum += exact(w) * &p[row];
        }
    });
    sum
}

type Generator = Vec<(usize, Rational)>;

/// Impulses whose combinations are tried, row by row.
fn generators(problem: &ContactProblem) -> Vec<Generator> {
    let d = problem.rows_per_contact();
    let of = |k: usize| -> Vec<Generator> {
        let mu = exact(problem.law().cone_friction(problem.friction()[k]));
        if d == 1 || problem.law() != Law::Associated || mu.is_zero() || problem.contacts() > WITNESS_ROUND {
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

/// Wᵀ times every generator.
fn products(problem: &ContactProblem, generators: &[Generator]) -> Vec<DVector<Rational>> {
    let column = |generator: &Generator| {
        let mut p = DVector::from_element(problem.rows(), RBig::ZERO);
        generator.iter().for_each(|(row, part)| p[*row] = part.clone());
        DVector::from_fn(problem.rows(), |row, _| transposed(problem, &p, row))
    };
    generators.iter().map(column).collect()
}

/// Rows that must not be positive: (Wᵀp)_n + μ c d·(Wᵀp)_t for directions d, where c makes the polygon contain the disk.
fn bounds(problem: &ContactProblem, moved: &[DVector<Rational>]) -> Vec<Vec<Rational>> {
    let d = problem.rows_per_contact();
    let mut made = Vec::new();
    for k in 0..problem.contacts() {
        let mu = exact(if d == 1 { 0.0 } else { problem.law().cone_friction(problem.friction()[k]) });
        if mu.is_zero() {
            made.push(moved.iter().map(|w| w[k * d].clone()).collect());
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

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::dvector;

    /// A body between two walls, normals (0, ±1) with tangents along the walls, that close in at these speeds.
    fn between(law: Law, dimension: usize, speeds: [f64; 2]) -> ContactProblem {
        let jacobian = DMatrix::from_fn(2 * dimension, dimension, |row, column| {
            let (wall, i) = (row / dimension, row % dimension);
            let sign = if wall == 1 && i == 0 { -1.0 } else { 1.0 };
            if i == column { sign } else { 0.0 }
        });
        let w = &jacobian * jacobian.transpose();
        let mut free = DVector::zeros(2 * dimension);
        (free[0], free[dimension]) = (-speeds[0], -speeds[1]);
        if dimension > 1 {
            (free[1], free[dimension + 1]) = (2.0, 2.0);
        }
        ContactProblem::new(w, free)
            .law(law)
            .rows_per_contact(dimension)
            .friction(vec![if dimension > 1 { 0.5 } else { 0.0 }; 2])
            .build()
            .unwrap()
    }

    #[test]
    fn walls_that_close_in_have_a_witness_and_walls_that_do_not_have_none() {
        let round = [Law::Frictionless, Law::Coulomb, Law::Associated].map(|law| (law, 1..=3));
        let polyhedral = [Law::PolyhedralCoulomb { directions: 4 }, Law::PolyhedralAssociated { directions: 5 }].map(|law| (law, 3..=3));
        for (law, dimensions) in round.into_iter().chain(polyhedral) {
            for dimension in dimensions {
                let crushed = between(law, dimension, [1.0, 2.0_f64.powi(-40) - 1.0]);
                let found = infeasible(&crushed).unwrap_or_else(|| panic!("{law:?} {dimension}"));
                assert!(found.product < RBig::ZERO && check(&crushed, &found.witness) == Some(found.product.clone()));
                assert!(infeasible(&between(law, dimension, [1.0, -1.0])).is_none(), "{law:?} {dimension}: carried along");
            }
        }
    }

    /// Contacts that meet no other, normal rows alone, with these diagonal entries of W and free velocities.
    fn lone(entries: &[[f64; 2]]) -> ContactProblem {
        let diagonal = DVector::from_iterator(entries.len(), entries.iter().map(|[w, _]| *w));
        let free = DVector::from_iterator(entries.len(), entries.iter().map(|[_, q]| *q));
        ContactProblem::new(DMatrix::from_diagonal(&diagonal), free).law(Law::Frictionless).rows_per_contact(1).build().unwrap()
    }

    #[test]
    fn one_contact_that_nothing_moves_refutes_any_number_of_others() {
        let mut entries = vec![[1.0, -1.0]; 40];
        assert!(infeasible(&lone(&entries)).is_none());
        entries[17] = [0.0, 2.0_f64.powi(-60)];
        assert!(infeasible(&lone(&entries)).is_none(), "it opens");
        entries[17] = [0.0, -(2.0_f64.powi(-60))];
        let found = infeasible(&lone(&entries)).expect("contact 17 closes, and no impulse moves it");
        assert_eq!(found.witness.iter().enumerate().filter(|(_, p)| !p.is_zero()).map(|(k, _)| k).collect::<Vec<_>>(), [17]);
        let crushed = between(Law::Coulomb, 3, [1.0, 0.5]);
        // twenty such jaws, of which the last is carried along like the others, or closes
        let w = DMatrix::from_fn(120, 120, |i, j| if i / 6 == j / 6 { crushed.dense()[(i % 6, j % 6)] } else { 0.0 });
        let many = |last: f64| {
            let free = |i: usize, _| match (i, i % 6) {
                (117, _) => last,
                (_, 0) => -1.0,
                (_, 3) => 1.0,
                _ => 2.0,
            };
            ContactProblem::new(w.clone(), DVector::from_fn(120, free)).friction(vec![0.5; 40]).build().unwrap()
        };
        assert!(infeasible(&many(1.0)).is_none() && infeasible(&many(1.0 - 2.0_f64.powi(-50))).is_some());
    }

    #[test]
    fn a_witness_that_is_none_is_not_believed() {
        let crushed = between(Law::Coulomb, 2, [1.0, 0.5]);
        let right = infeasible(&crushed).unwrap().witness;
        let mut pulled = right.clone();
        pulled[0] = -RBig::ONE;
        let mut lopsided = right.clone();
        lopsided[0] += ratio(1, 1 << 50);
        let mut rubbed = right.clone();
        rubbed[1] = ratio(1, 1 << 50);
        for wrong in [pulled, lopsided, rubbed, DVector::from_element(4, RBig::ZERO), DVector::from_element(3, RBig::ONE)] {
            assert_eq!(check(&crushed, &wrong), None, "{wrong:?}");
        }
        assert!(check(&crushed, &(right * ratio(1, 3))).is_some(), "its length does not matter");
    }

    #[test]
    fn painleve_s_block_is_feasible_and_has_no_witness() {
        let w = DMatrix::from_row_slice(2, 2, &[1.0, 2.0, 2.0, 5.0]);
        let problem = ContactProblem::new(w, dvector![-1.0, 1.0]).rows_per_contact(2).friction(vec![1.0]).build().unwrap();
        assert!(infeasible(&problem).is_none());
    }
}
