//! What rounding hides of y: neither contacts that are not met nor the way W is stored change it, and where it hides too much y is computed
//! with twice the digits. Answers are decided in fractions.

use super::super::Judge;
use super::super::joints::{jointed_residuals, sharpen};
use super::super::residuals;
use super::super::scales::Scales;
use crate::contact::{Inertia, Jacobian, Mass};
use crate::operator::{BlockRows, MatrixFree, Operator, Sparse, SparseDynamics};
use crate::problem::{ConstraintKind, ContactProblem, Dynamics, JointedProblem, Law, Solution};
use crate::tolerance::certificate::CERTIFY;
use moreau_exact::scalar::{Rational, Scalar, exact};
use nalgebra::{DMatrix, DVector, dmatrix, dvector};
use std::sync::Arc;

/// Bodies of these masses one on the other, and each of `apart` bodies of 1 kg alone on the floor; W by bodies, by blocks and dense.
fn stacks(rows: usize, masses: &[f64], apart: usize) -> [Operator; 3] {
    let bodies = masses.len() + apart;
    let mut jacobian = BlockRows::new(rows, vec![rows; bodies]).unwrap();
    let side = |sign: f64| DMatrix::from_diagonal_element(rows, rows, sign).as_slice().to_vec();
    let (own, other) = (side(1.0), side(-1.0));
    for body in 0..bodies {
        let alone = body == 0 || body >= masses.len();
        let parts: &[(usize, &[f64])] = if alone { &[(body, &own)] } else { &[(body - 1, &other), (body, &own)] };
        jacobian.push(parts).unwrap();
    }
    let mass = |body: usize| DMatrix::from_diagonal_element(rows, rows, masses.get(body).copied().unwrap_or(1.0));
    let free = MatrixFree::new(&(0..bodies).map(mass).collect::<Vec<_>>(), jacobian).unwrap();
    let blocks = free.delassus().unwrap();
    [blocks.to_dense().into(), blocks.into(), free.into()]
}

/// A stack of two in which the upper one weighs `ratio` times as much: what the normals carry, and y = 0 without what is `off`.
struct Heavy {
    rows: usize,
    masses: [f64; 2],
    loads: [f64; 2],
    /// u_free of the normals.
    given: [f64; 2],
}

impl Heavy {
    fn new(rows: usize, light: f64, ratio: f64, load: f64) -> Self {
        let (masses, loads) = ([light, light * ratio], [load * ratio + 1.0, load * ratio]);
        let of = |i: usize| Scalar::to_f64(&-moved(&masses, &loads)[i].clone());
        Heavy { rows, masses, loads, given: [of(0), of(1)] }
    }

    /// V.
    fn fastest(&self) -> f64 {
        self.given[0].abs().max(self.given[1].abs())
    }

    /// The largest |y| with this load of the lower contact, of mass and Jacobian without any rounding.
    fn off(&self, lower: f64) -> f64 {
        let y = moved(&self.masses, &[lower, self.loads[1]]);
        (0..2).map(|i| Scalar::to_f64(&(y[i].clone() + exact(self.given[i]))).abs()).fold(0.0, f64::max)
    }

    /// Whether the answer with this load of the lower contact is accepted beside so many contacts alone, W stored in each way.
    fn accepts(&self, lower: f64, apart: usize, tolerance: f64) -> [bool; 3] {
        let (size, rows) = (self.rows * (2 + apart), self.rows);
        let of = |each: [f64; 3]| DVector::from_fn(size, |i, _| if i % rows == 0 { each[(i / rows).min(2)] } else { 0.0 });
        let impulse = of([lower, self.loads[1], 1.0]);
        let y = moved(&self.masses, &[lower, self.loads[1]]);
        let found = [0, 1].map(|i| Scalar::to_f64(&(y[i].clone() + exact(self.given[i]))));
        let velocity = of([found[0], found[1], 0.0]);
        stacks(rows, &self.masses, apart).map(|operator| {
            let problem = ContactProblem::new(operator, of([self.given[0], self.given[1], -1.0])).rows_per_contact(rows);
            let problem = problem.law(Law::Coulomb).friction(vec![if rows > 1 { 0.5 } else { 0.0 }; 2 + apart]).build().unwrap();
            let solution = Solution::new("by hand", impulse.clone(), velocity.clone(), 0);
            residuals(&problem, &solution).unwrap().is_solution(tolerance)
        })
    }
}

/// (W r)_n of the two normals.
fn moved(masses: &[f64; 2], loads: &[f64; 2]) -> [Rational; 2] {
    let [m, big, r, s] = [masses[0], masses[1], loads[0], loads[1]].map(exact);
    let lower = (r - &s) / m;
    [lower.clone(), s / big - lower]
}

#[test]
fn contacts_that_are_not_met_and_the_way_w_is_stored_change_no_rounding() {
    for rows in 1..=3 {
        let floors = |apart: usize| {
            stacks(rows, &[1.0, 3.0, 0.5], apart).map(|operator| {
                let size = rows * (3 + apart);
                let problem = ContactProblem::new(operator, DVector::from_element(size, -1.0)).rows_per_contact(rows);
                let problem = problem.friction(vec![if rows > 1 { 0.5 } else { 0.0 }; 3 + apart]).build().unwrap();
                let mut scales = Scales::default();
                scales.prepare(&problem);
                scales.set_floors(&problem, &vec![1.0; size]);
                scales.floors[..3 * rows].to_vec()
            })
        };
        let alone = floors(0);
        for apart in [1, 40] {
            assert_eq!(floors(apart), alone, "{rows} {apart}");
        }
        // the middle one meets both others, the last one only it
        let gamma = |contacts: usize| crate::tolerance::certificate::row_rounding(contacts * rows);
        let terms = [1.0 + 1.0 + 1.0, 1.0 + 1.0 + 4.0 / 3.0 + 1.0 / 3.0, 1.0 + 1.0 / 3.0 + 1.0 / 3.0 + 2.0];
        for (k, (terms, contacts)) in terms.into_iter().zip([2, 3, 2]).enumerate() {
            alone.iter().for_each(|floors| {
                let expected = gamma(contacts) * terms;
                assert!((floors[k * rows] - expected).abs() < 1e-12 * expected, "{rows} {k} {floors:?}");
            });
        }
    }
}

#[test]
fn an_answer_is_judged_alone_as_beside_contacts_that_it_does_not_meet() {
    let heavy = (1 << 26) as f64;
    for (rows, apart) in [(1, 0), (1, 400), (3, 0), (3, 130)] {
        let stack = Heavy::new(rows, 1.0, heavy, 1.0);
        assert_eq!(stack.accepts(stack.loads[0], apart, CERTIFY), [true; 3], "{rows} {apart}");
        assert_eq!(stack.accepts(stack.loads[0] + 3e-5, apart, CERTIFY), [false; 3], "{rows} {apart}");
        // between the rounding of two contacts and that of all
        let off = 60.0 * rows as f64 * f64::EPSILON * heavy;
        assert_eq!(stack.accepts(stack.loads[0] + off, apart, 1e-15), [false; 3], "{rows} {apart}");
        assert_eq!(stack.accepts(stack.loads[0] + f64::EPSILON * heavy, apart, 1e-15), [true; 3], "{rows} {apart}");
    }
}

#[test]
fn answers_are_accepted_or_refused_by_what_they_are_up_to_ratios_of_2_to_the_45() {
    let (mut right, mut wrong) = ([0; 2], [0; 2]);
    for power in 20..=45 {
        for (rows, light, load) in [(1, 1.0, 1.0), (2, 1.0, 3.0), (3, 0.5, 1.0), (1, 3.0, 1.0), (3, 7.0, 1.0 / 3.0)] {
            let is_rounded = light > 1.0;
            let stack = Heavy::new(rows, light, 2f64.powi(power), load);
            let changes = [0.0, 1e-6, 3e-5, 1e-4, 1e-2, 1.0, -1e-6, -3e-5, -1e-3].map(|part| part * stack.fastest() * light);
            for lower in changes.map(|change| stack.loads[0] + change) {
                let off = stack.off(lower) / stack.fastest();
                let found = stack.accepts(lower, 0, CERTIFY);
                // the entries of a stored W are rounded, by half an ε of terms as large as the load
                let stored = if is_rounded { 4.0 * f64::EPSILON * stack.loads[0] / light / stack.fastest() } else { 0.0 };
                for (found, data) in found.into_iter().zip([stored, stored, 0.0]) {
                    if off + data < 0.4e-5 {
                        assert!(found, "2^{power}, {rows} rows, {light} kg: off by {off:e} V");
                        right[usize::from(power > 31)] += 1;
                    } else if off - data > 2.1e-5 {
                        assert!(!found, "2^{power}, {rows} rows, {light} kg: off by {off:e} V");
                        wrong[usize::from(power > 31)] += 1;
                    }
                }
            }
        }
    }
    println!("{right:?} right, {wrong:?} wrong");
    assert!(right.iter().chain(&wrong).all(|count| *count > 300), "{right:?} {wrong:?}");
}

#[test]
fn a_stored_velocity_is_no_righter_than_rounding_may_hide() {
    let stack = Heavy::new(1, 1.0, 2f64.powi(40), 1.0);
    for operator in stacks(1, &stack.masses, 0) {
        let problem = ContactProblem::new(operator, DVector::from_row_slice(&stack.given)).rows_per_contact(1).build().unwrap();
        let accepts = |u: f64| {
            let solution = Solution::new("by hand", DVector::from_row_slice(&stack.loads), DVector::from_row_slice(&[u, 0.0]), 0);
            residuals(&problem, &solution).unwrap().is_solution(CERTIFY)
        };
        assert!(accepts(0.0) && accepts(0.9e-5) && !accepts(1.2e-5) && !accepts(-1e-3));
    }
}

/// One contact presses with 2⁴⁰ N·s and opens the other one at ±2⁴⁰ m/s, of which an ε is more than 10⁻⁵ V.
#[test]
fn a_contact_that_opens_is_open_however_its_velocity_is_rounded() {
    let large = 2f64.powi(40);
    for (open, sign) in [(0, 1.0), (1, 1.0), (0, -1.0), (1, -1.0)] {
        let place = |own: f64, other: f64| if open == 0 { [own, other] } else { [other, own] };
        let [first, second] = [[2.0 * large, sign], [sign, 1.0 / large]];
        let w = if open == 0 { [first, second] } else { [[second[1], second[0]], [first[1], first[0]]] };
        let free = DVector::from_row_slice(&place(0.0, -1.0));
        let problem = ContactProblem::new(DMatrix::from_fn(2, 2, |i, j| w[i][j]), free).rows_per_contact(1).build().unwrap();
        let accepts = |off: f64| {
            let [impulse, velocity] = [place(0.0, large), place(sign * large + off, 0.0)].map(|of| DVector::from_row_slice(&of));
            residuals(&problem, &Solution::new("by hand", impulse, velocity, 0)).unwrap().is_solution(CERTIFY)
        };
        assert_eq!(accepts(0.0), sign > 0.0, "contact {open} opens at {sign}·2⁴⁰ m/s");
        assert!(!accepts(0.01) && !accepts(-0.01), "a stored velocity of contact {open}");
    }
}

/// The sum of a double is wrong by 3·10⁻³ of V.
#[test]
fn a_velocity_is_summed_again_with_twice_the_digits_where_it_must_be() {
    let (mass, jacobian) = (dmatrix![7.0, 0.0; 0.0, 123_145_302_310_913.0], dmatrix![1.0, 0.0; -1.0, 1.0]);
    let impulse = dvector![246_290_604_621_833.0, 246_290_604_621_826.0];
    let made = ContactProblem::from_dynamics(mass.clone(), jacobian.clone(), &DVector::zeros(2)).free_velocity(dvector![-1.0, -1.0]);
    let problem = made.law(Law::Frictionless).rows_per_contact(1).build().unwrap();
    let mut solution = Solution::new("by hand", impulse.clone(), problem.velocity(&impulse), 0);
    assert!(!residuals(&problem, &solution).unwrap().is_solution(CERTIFY), "{}", solution.velocity);
    assert!(Judge::default().sharpen(&problem, &mut solution).unwrap());
    assert!(residuals(&problem, &solution).unwrap().is_solution(CERTIFY), "{}", solution.velocity);

    let kinds = vec![ConstraintKind::Contact, ConstraintKind::Bilateral { rows: 1 }];
    let joined = JointedProblem::new(1, kinds, problem.dense().clone(), dvector![-1.0, -1.0]).unwrap();
    let joined = joined.law(Law::Frictionless, vec![0.0; 2]).unwrap().made_of(Some(Dynamics { mass, jacobian })).unwrap();
    let mut solution = Solution::new("by hand", impulse.clone(), joined.velocity(&impulse), 0);
    assert!(!jointed_residuals(&joined, &solution).unwrap().is_solution(CERTIFY));
    assert!(sharpen(&joined, &mut solution).unwrap());
    assert!(jointed_residuals(&joined, &solution).unwrap().is_solution(CERTIFY), "{}", solution.velocity);

    let plain = ContactProblem::new(dmatrix![0.3], dvector![-1.0]).rows_per_contact(1).build().unwrap();
    let mut solution = Solution::new("by hand", dvector![1.0 / 0.3], dvector![1e-20], 0);
    assert!(!Judge::default().sharpen(&plain, &mut solution).unwrap() && solution.velocity[0] == 1e-20, "nothing is lost here");
}

#[test]
fn beside_joints_answers_are_accepted_or_refused_by_what_they_are_too() {
    let (mut right, mut wrong) = (0, 0);
    let kinds = [ConstraintKind::Contact, ConstraintKind::Bilateral { rows: 1 }, ConstraintKind::Limit];
    // the lower body stands on a contact or hangs on a rod, and a rod or a limit holds the upper one on it
    for (power, [lower, upper]) in (20..=45).flat_map(|power| [[0, 1], [1, 2], [2, 1], [1, 1]].map(|pair| (power, pair))) {
        // no product of these is exact in a double, and W is what is stored
        let stack = Heavy::new(1, 3.0, 2f64.powi(power), 1.0 / 3.0);
        let [dense, ..] = stacks(1, &stack.masses, 0);
        let w = dense.dense().map(exact);
        let moved = |load: f64| &w * DVector::from_vec(vec![exact(load), exact(stack.loads[1])]);
        let given = moved(stack.loads[0]).map(|u| -Scalar::to_f64(&u));
        let problem = JointedProblem::new(1, vec![kinds[lower], kinds[upper]], dense.dense().clone(), given.clone()).unwrap();
        let problem = problem.law(Law::Frictionless, vec![0.0; 2]).unwrap();
        for part in [0.0, 1e-6, 3e-5, 1e-3, 1.0, -1e-6, -3e-5, -1e-3] {
            let load = stack.loads[0] + part * 3.0 * given.amax();
            let velocity = (moved(load) + given.map(exact)).map(|u| Scalar::to_f64(&u));
            let accepts = |velocity: &DVector<f64>| {
                let solution = Solution::new("by hand", DVector::from_row_slice(&[load, stack.loads[1]]), velocity.clone(), 0);
                jointed_residuals(&problem, &solution).unwrap().is_solution(CERTIFY)
            };
            let off = velocity.amax() / given.amax();
            if off < 0.4e-5 {
                // a joint whose own impulse moves it is held against V, not 10³ V
                assert!(off > 0.4e-8 || accepts(&velocity), "2^{power} {lower} {upper}: {off:e}");
                assert!(!accepts(&velocity.add_scalar(3e-5 * given.amax())), "2^{power} {lower} {upper}: a stored velocity");
                right += usize::from(off < 0.4e-8);
            } else if off > 2.1e-5 {
                assert!(!accepts(&velocity), "2^{power} {lower} {upper}: {off:e}");
                wrong += 1;
            }
        }
    }
    assert!(right > 100 && wrong > 300, "{right} {wrong}");
}

/// A block of 7·2⁴⁴ + 1 kg on one of 7 kg: the entries of W = H M⁻¹ Hᵀ are rounded, and that is all of y of these impulses. An answer that
/// is wrong by 3·10⁻³ of V would be right of the rounded W; mass and Jacobian tell which is right.
#[test]
fn where_w_was_made_of_mass_and_jacobian_they_decide() {
    let (mass, jacobian) = (dmatrix![7.0, 0.0; 0.0, 123_145_302_310_913.0], dmatrix![1.0, 0.0; -1.0, 1.0]);
    let w = crate::contact::delassus::delassus(&mass, &jacobian).unwrap();
    let [right, wrong] = [[246_290_604_621_833.0, 246_290_604_621_826.0], [245_930_355_078_259.34, 245_930_355_078_252.34]];
    let accepts = |problem: &ContactProblem, impulse: [f64; 2]| {
        let solution = Solution::new("by hand", DVector::from_row_slice(&impulse), DVector::zeros(2), 0);
        residuals(problem, &solution).unwrap().is_solution(CERTIFY)
    };
    let given = || ContactProblem::new(w.clone(), dvector![-1.0, -1.0]).law(Law::Frictionless).rows_per_contact(1);
    let made = given().dynamics(Dynamics { mass: mass.clone(), jacobian: jacobian.clone() }).build().unwrap();
    assert!(accepts(&made, right) && !accepts(&made, wrong));
    let mut rows = BlockRows::new(1, [1, 1]).unwrap();
    rows.push(&[(0, &[1.0])]).unwrap();
    rows.push(&[(0, &[-1.0]), (1, &[1.0])]).unwrap();
    let free = MatrixFree::new(&[dmatrix![7.0], dmatrix![123_145_302_310_913.0]], rows).unwrap();
    let bodies = given().delassus(free).build().unwrap();
    assert!(accepts(&bodies, right) && !accepts(&bodies, wrong), "where W is never formed it is known which is right");
    assert!(accepts(&given().build().unwrap(), wrong), "W alone is another problem");

    let kinds = vec![ConstraintKind::Contact, ConstraintKind::Bilateral { rows: 1 }];
    let joined = JointedProblem::new(1, kinds, w.clone(), dvector![-1.0, -1.0]).unwrap().law(Law::Frictionless, vec![0.0; 2]).unwrap();
    let accepts = |problem: &JointedProblem, impulse: &[f64; 2]| {
        let solution = Solution::new("by hand", DVector::from_row_slice(impulse), DVector::zeros(2), 0);
        jointed_residuals(problem, &solution).unwrap().is_solution(CERTIFY)
    };
    assert!(accepts(&joined, &wrong), "W alone is another problem");
    let made = joined.made_of(Some(Dynamics { mass, jacobian })).unwrap();
    assert!(accepts(&made, &right) && !accepts(&made, &wrong), "beside joints, too");
}

/// M = [[3, c], [c + s, 0.7]], c = √2.1 (1 − e), and H = (1, −½): W is of the order of 1/e, and factors of M lose 1/e of its digits. M by
/// bodies, by rows, by lists, and beside a joint that holds a body of its own.
#[test]
fn a_mass_that_is_nearly_singular_hides_what_its_factors_lose() {
    let (mut right, mut wrong) = ([0; 4], [0; 4]);
    for (power, skew) in (4..=48).flat_map(|power| [0.0, 0.25].map(|skew| (power, skew))) {
        // no product of these is exact
        let off = 2.1f64.sqrt() * (1.0 - 2f64.powi(-power) / 3.0);
        let across = off - skew * 2f64.powi(-power);
        let mass = dmatrix![3.0, off, 0.0; across, 0.7, 0.0; 0.0, 0.0, 1.0];
        let jacobian = dmatrix![1.0, -0.5, 0.0; 0.0, 0.0, 1.0];
        let Ok(problems) = each_way(&mass, &jacobian) else { continue };
        let [row, half, other, across, three, small] = [1.0, -0.5, off, across, 3.0, 0.7].map(exact);
        let one: Rational = exact(1.0);
        let determinant = three.clone() * small.clone() - other.clone() * across.clone();
        let w = (row.clone() * row * small + half.clone() * half.clone() * three - half * (other + across)) / determinant;
        let answer = Scalar::to_f64(&(one.clone() / w.clone()));
        for (way, problem) in problems.iter().enumerate() {
            let solution = |impulse: &[f64], velocity: &[f64]| {
                Solution::new("by hand", DVector::from_row_slice(impulse), DVector::from_row_slice(velocity), 0)
            };
            let formed = match problem {
                Way::Alone(problem) => problem.entry(0, 0),
                Way::Joined(problem) => problem.delassus()[(0, 0)],
            };
            let moved = [0.0, 1e-6, 1e-4, 1e-2, 0.5, -1e-4, -1e-2].map(|part| answer * (1.0 + part));
            // and the answer to the W that lost the digits
            for impulse in moved.into_iter().chain([1.0 / formed]) {
                let y = Scalar::to_f64(&(w.clone() * exact(impulse) - one.clone()));
                // with its velocity, or with that which the law asks for
                let accepted = [y, 0.0].into_iter().any(|u| match problem {
                    Way::Alone(problem) => residuals(problem, &solution(&[impulse], &[u])).unwrap().is_solution(CERTIFY),
                    Way::Joined(problem) => jointed_residuals(problem, &solution(&[impulse, 1.0], &[u, 0.0])).unwrap().is_solution(CERTIFY),
                });
                if impulse == answer {
                    assert!(accepted || power > 20, "2^-{power} {skew}, way {way}");
                    right[way] += usize::from(accepted);
                } else if y.abs() > 2.1e-5 {
                    assert!(!accepted, "2^-{power} {skew}, way {way}: {y:e} m/s, {impulse:e} N·s, {formed:e}/kg");
                    wrong[way] += 1;
                }
            }
        }
    }
    assert!(right.iter().all(|count| *count > 34) && wrong.iter().all(|count| *count > 400), "{right:?} {wrong:?}");
}

/// Rows 0 and 2 are nearly orthogonal in M⁻¹, rows 0 and 1 carry 2^p N·s on each other: the terms of W_20 cancel, and what is left of its
/// rounding times 2^p is a velocity of contact 2. By mass and Jacobian alone is it known which impulse of it is right.
#[test]
fn rows_whose_terms_cancel_are_judged_by_mass_and_jacobian() {
    let (mut right, mut wrong) = ([0; 3], [0; 3]);
    for (power, coupled) in (16..=56).flat_map(|power| [0.0, 0.7, 2.9997].map(|coupled| (power, coupled))) {
        let load = 2f64.powi(power);
        let mass = dmatrix![3.0, coupled, 0.0; coupled, 3.0, 0.0; 0.0, 0.0, load];
        // h₂ᵀ M⁻¹ h₀ = 0 but for rounding
        let orthogonal = [0.64 * (3.0 - 3.0 * coupled) / 3.0, -0.64 * (9.0 - coupled) / 3.0];
        let jacobian = dmatrix![3.0, 1.0, 0.0; -9.0, -3.0, 1.0; orthogonal[0], orthogonal[1], 0.0];
        let r = [3.0 * load + 1.0, load, 1.0];
        let [exact_mass, exact_jacobian] = [&mass, &jacobian].map(|of| of.map(exact));
        let identity = DMatrix::identity(3, 3).map(|x: f64| exact(x));
        let inverse = moreau_exact::elimination::solve_columns(&exact_mass, &identity).unwrap();
        let w = &exact_jacobian * inverse * exact_jacobian.transpose();
        let moved = |r: &[f64; 3]| &w * DVector::from_iterator(3, r.iter().map(|r| exact(*r)));
        let given = moved(&r).map(|u| -Scalar::to_f64(&u));
        let dynamics = || Dynamics { mass: mass.clone(), jacobian: jacobian.clone() };
        let listed = SparseDynamics::new(&Sparse::of(&mass), &Sparse::of(&jacobian), 1).unwrap();
        let formed = listed.delassus().unwrap().to_dense();
        let build = |w: Operator| ContactProblem::new(w, given.clone()).law(Law::Frictionless).rows_per_contact(1);
        let made = build(formed.clone().into()).dynamics(dynamics()).build().unwrap();
        let bodies = build(listed.matrix_free().unwrap().into()).build().unwrap();
        let kinds = vec![ConstraintKind::Contact, ConstraintKind::Bilateral { rows: 1 }, ConstraintKind::Contact];
        let joined = JointedProblem::new(1, kinds, formed.clone(), given.clone()).unwrap().law(Law::Frictionless, vec![0.0; 3]).unwrap();
        let joined = joined.made_of(Some(dynamics())).unwrap();
        let of_formed = -(given[2] + formed[(2, 0)] * r[0] + formed[(2, 1)] * r[1]) / formed[(2, 2)];
        for last in [1.0, 1.0 + 1e-3, 1.0 - 1e-4, of_formed, 0.0].into_iter().filter(|last| *last >= 0.0) {
            let impulse = [r[0], r[1], last];
            let y = (moved(&impulse) + given.map(exact)).map(|u| Scalar::to_f64(&u));
            let off = y.amax() / given.amax();
            for (way, count) in (0..3).zip(right.iter_mut().zip(&mut wrong)) {
                let accepted = [y.clone(), DVector::zeros(3)].into_iter().any(|velocity| {
                    let solution = Solution::new("by hand", DVector::from_row_slice(&impulse), velocity, 0);
                    match way {
                        0 => residuals(&made, &solution).unwrap().is_solution(CERTIFY),
                        1 => residuals(&bodies, &solution).unwrap().is_solution(CERTIFY),
                        _ => jointed_residuals(&joined, &solution).unwrap().is_solution(CERTIFY),
                    }
                });
                let shown = || format!("2^{power} {coupled}, way {way}, {last} N·s: y {off:e} of V, accepted {accepted}");
                if last == 1.0 {
                    assert!(accepted || power > 40, "{}", shown());
                    *count.0 += usize::from(accepted);
                } else if off > 2.1e-5 && (last > 0.0 || y[2] < 0.0) {
                    assert!(!accepted, "{}", shown());
                    *count.1 += 1;
                }
            }
        }
    }
    println!("{right:?} right, {wrong:?} wrong");
    assert!(right.iter().all(|count| *count > 100) && wrong.iter().all(|count| *count > 200), "{right:?} {wrong:?}");
}

/// As before, with a body that nothing moves, +∞ kg: W acts through no such body, and nothing has twice the digits. The rows of the third
/// contact are so long that it alone is in doubt, and not those that press.
#[test]
fn where_nothing_has_twice_the_digits_what_forming_may_have_moved_is_not_believed() {
    let mut refused = 0;
    for (power, small) in (20..=27).flat_map(|power| [0.64, 0.1, 0.7, 1.3, 0.37].map(|small| (power, small))) {
        let (load, small) = (2f64.powi(power), small * 2f64.powi(18));
        let inertia = Inertia::of(Mass::Diagonal(dvector![3.0, 7.0, load, f64::INFINITY])).unwrap();
        // h₂ᵀ M⁻¹ h₀ = 0 but for rounding
        let rows = dmatrix![3.0, 1.0, 0.0, 0.0; -9.0, -3.0, 1.0, 0.0; small, -7.0 * small, 0.0, 1.0];
        let r = [3.0 * load + 1.0, load, 2f64.powi(-36)];
        let jacobian = rows.view((0, 0), (3, 3)).map(exact);
        let inverse = DMatrix::from_diagonal(&DVector::from_iterator(3, [3.0, 7.0, load].map(|m| exact(1.0) / exact(m))));
        let w = &jacobian * inverse * jacobian.transpose();
        let moved = |r: &[f64; 3]| &w * DVector::from_iterator(3, r.iter().map(|r| exact(*r)));
        let given = moved(&r).map(|u| -Scalar::to_f64(&u));
        let jacobian = Jacobian::from_dense(&rows, 1);
        let problem = ContactProblem::from_free_velocity(&Arc::new(inertia), &Arc::new(jacobian), given.clone());
        let problem = problem.law(Law::Frictionless).rows_per_contact(1).build().unwrap();
        let entry = |column: usize| problem.entry(2, column);
        let last = -(given[2] + entry(0) * r[0] + entry(1) * r[1]) / entry(2);
        let impulse = [r[0], r[1], last];
        let off = (moved(&impulse) + given.map(exact)).map(|u| Scalar::to_f64(&u)).amax() / given.amax();
        if last < 0.0 || off < 2.1e-5 {
            continue;
        }
        let solution = Solution::new("by hand", DVector::from_row_slice(&impulse), DVector::zeros(3), 0);
        assert!(!residuals(&problem, &solution).unwrap().is_solution(CERTIFY), "2^{power} {small}: {off:e} of V");
        refused += 1;
    }
    assert!(refused > 5, "{refused}");
}

/// M = [[1, 1 − 2⁻³⁴], [1 − 2⁻³⁴, 1]], H = [1 1], q = −1: W is nearly 1, whatever M loses, and the answer solves it to the last bit.
#[test]
fn an_exact_answer_to_a_nearly_singular_mass_is_accepted() {
    for power in (20..=44).step_by(2) {
        let off = 1.0 - 2f64.powi(-power);
        let (mass, jacobian) = (dmatrix![1.0, off; off, 1.0], dmatrix![1.0, 1.0]);
        let problem = ContactProblem::from_dynamics(mass, jacobian, &DVector::zeros(2)).free_velocity(dvector![-1.0]);
        let problem = problem.law(Law::Frictionless).rows_per_contact(1).build().unwrap();
        let impulse = (1.0 + off) / 2.0;
        let accepts = |impulse: f64| {
            let solution = Solution::new("by hand", dvector![impulse], dvector![0.0], 0);
            residuals(&problem, &solution).unwrap().is_solution(CERTIFY)
        };
        assert!(accepts(impulse) && !accepts(impulse * 1.0001) && !accepts(impulse * 0.9999), "2^-{power}");
    }
}

#[test]
fn a_velocity_of_infinite_mass_hides_nothing_of_what_it_never_meets() {
    // a body on the floor, and two that touch and part by their last digit; another one is driven
    let rows = Arc::new(Jacobian::from_dense(&dmatrix![1.0, 0.0, 0.0, 0.0; 0.0, 1.0, -1.0, 0.0; 0.0, 0.0, 1.0, 1.0], 1));
    let free = dvector![-0.05, 1.0, 1.0f64.next_up(), 0.5];
    for driven in [2.0, f64::INFINITY] {
        let mass = Arc::new(Inertia::of(Mass::Diagonal(dvector![1.0, 1.0, 1.0, driven])).unwrap());
        let made = ContactProblem::from_inertia(&mass, &rows, &free).law(Law::Frictionless).rows_per_contact(1).friction(vec![0.0; 3]);
        let problem = made.build().unwrap();
        let accepts = |part: f64| {
            let impulse = dvector![0.05, part * f64::EPSILON, 0.0];
            let answer = Solution::new("", impulse.clone(), problem.velocity(&impulse), 0);
            Judge::default().judge(&problem, &answer).unwrap().accepts(CERTIFY)
        };
        assert!(accepts(0.5) && !accepts(0.499) && !accepts(0.0), "{driven}");
    }
}

enum Way {
    Alone(Box<ContactProblem>),
    Joined(Box<JointedProblem>),
}

/// The contact of the first row alone – by bodies, by rows and by lists – and with the second one as a joint.
fn each_way(mass: &DMatrix<f64>, jacobian: &DMatrix<f64>) -> moreau_exact::Result<[Way; 4]> {
    let part = |matrix: &DMatrix<f64>, rows: usize| matrix.view((0, 0), (rows, 2)).clone_owned();
    let (own, row) = (part(mass, 2), part(jacobian, 1));
    let mut rows = BlockRows::new(1, [2])?;
    rows.push(&[(0, row.transpose().as_slice())])?;
    let build = |problem: crate::problem::ContactProblemBuilder| {
        problem.law(Law::Frictionless).rows_per_contact(1).build().map(|problem| Way::Alone(Box::new(problem)))
    };
    let bodies = build(ContactProblem::new(MatrixFree::new(std::slice::from_ref(&own), rows)?, dvector![-1.0]))?;
    let listed = SparseDynamics::new(&Sparse::of(&own), &Sparse::of(&row), 1)?;
    let lists = build(ContactProblem::new(listed.delassus()?, dvector![-1.0]).sparse_dynamics(listed))?;
    let w = SparseDynamics::new(&Sparse::of(mass), &Sparse::of(jacobian), 1)?.delassus()?.to_dense();
    let given = ContactProblem::new(w.view((0, 0), (1, 1)).clone_owned(), dvector![-1.0]);
    let made = build(given.dynamics(Dynamics { mass: own, jacobian: row }))?;
    let kinds = vec![ConstraintKind::Contact, ConstraintKind::Bilateral { rows: 1 }];
    let joined = JointedProblem::new(1, kinds, w, dvector![-1.0, -1.0])?.law(Law::Frictionless, vec![0.0; 2])?;
    let joined = joined.made_of(Some(Dynamics { mass: mass.clone(), jacobian: jacobian.clone() }))?;
    Ok([bodies, made, lists, Way::Joined(Box::new(joined))])
}
