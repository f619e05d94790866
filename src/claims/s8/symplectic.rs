//! Which steps are symplectic: semi-implicit Euler, corrections of the penetration, the variational integrator.

use super::systems::{
    Bowl, Coupled, CurvedFloor, FreeInPolar, MassOfPlace, entries, identity, mirror_step, projected_step, variational_start,
};
use crate::Result;
use crate::checks::Finding;
use crate::claims::s8::spring::{SEMI_IMPLICIT, is_stable};
use crate::claims::{Claim, ClaimVerdict, Evidence, Kind, Reading, Severity};
use crate::integrators::jacobian::jacobian;
use crate::integrators::root::root;
use crate::integrators::symplectic::{defect, volume};
use crate::integrators::variational::{Guess, ScalarField, Variational};
use crate::integrators::{Method, Phase};
use crate::scalar::{Dual, Rational, Scalar, ratio};
use crate::tolerance::claims::INTEGER_ORDER;
use nalgebra::{DMatrix, DVector};

pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S8.semi-symplectic",
        statement: "For smooth Hamiltonian systems semi-implicit Euler is symplectic, and its energy stays bounded for ever without drift.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Exact,
        correct_statement: "With a constant mass matrix, forces that have a potential, and hω < 2 for the fastest vibration. With M(q), as \
            in joint coordinates, the step that updates v and then q is not symplectic and its energy can drift; the variant with the \
            momentum, which is, needs an implicit solve.",
        argument: "DᵀJD = J exactly for two coupled masses in a cubic potential. One coordinate with M = q², which is a free particle: the \
            factor of phase volume is 1 − 5x² + 5x⁴ − 2x⁵ with x = h v/q, 0.95048 at x = 1/10; with the momentum, p⁺ = p + h p⁺²/q³, it is \
            1. A free particle in polar coordinates, r = 1, at 1 m/s across, to t = 2: the energy has grown by 1.27 % with h = 1/100 and \
            half of that with h = 1/200.",
        control: "The step with M = q² in place of the one with constant mass.",
        sources: &[
            "chapter §8, three levels",
            "Hairer, Lubich, Wanner, Geometric Numerical Integration, VI.3",
            "MuJoCo documentation, computation: numerical integration (3.17)",
        ],
        check: semi_symplectic,
    },
    Claim {
        id: "S8.cirak-west",
        statement: "Theorem (Cirak and West 2005): an explicit symplectic scheme necessarily loses symplecticity at the moment a contact \
            becomes active, and every operation that corrects penetration destroys it.",
        verdict: ClaimVerdict::False,
        kind: Kind::Assertion,
        severity: Some(Severity::WrongStatement),
        evidence: Evidence::Exact,
        correct_statement: "Projecting a penetrating state back does (its Jacobian is singular). Neither every correction nor every \
            activation does: the mirror image of a penetrating state in the wall, position and velocity together, is symplectic for a flat \
            wall and e = 1, and so is a variational step with an elastic impact. Whether the cited paper states such a theorem is not \
            decided here; its abstract announces an algorithm with good conservation of momentum and energy.",
        argument: "Two coupled masses, M = (2, 1; 1, 3), semi-implicit Euler in a cubic potential into the wall and mirrored in the metric \
            of M: DᵀJD − J = 0 exactly, in a step that penetrates. The projected step has determinant 0. The variational step is S8.kmow.",
        control: "Projection in place of the mirror image.",
        sources: &["chapter §8, the negative result", "Cirak and West, Int. J. Numer. Meth. Engng 64 (2005) 1078–1110 (abstract)"],
        check: corrections,
    },
    Claim {
        id: "S8.kmow",
        statement: "Kane, Marsden, Ortiz and West 2000 prove that variational integrators can preserve the symplectic form in elastic \
            contact (e = 1).",
        verdict: ClaimVerdict::Ambiguous,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: "The statement on elastic contact holds, for the variational integrator that makes the time of impact a \
            variable. It is in Fetecau, Marsden, Ortiz and West 2003; the abstract of the paper of 2000 speaks of the Newmark family and \
            of dissipation, and its text was not read.",
        argument: "Verlet's discrete Lagrangian with an elastic impact in the step, two coordinates, cubic potential, curved wall: DᵀJD − \
            J = 0 in rationals. The impact is solved exactly at a start for which it is rational.",
        control: "The same step with its velocity at the end cut to 4/5.",
        sources: &[
            "chapter §8, the negative result",
            "Kane, Marsden, Ortiz, West, Int. J. Numer. Meth. Engng 49 (2000) 1295–1325 (abstract)",
            "Fetecau, Marsden, Ortiz, West, SIAM J. Appl. Dyn. Syst. 2 (2003) 381–416",
        ],
        check: variational,
    },
];

/// One finding per entry of a matrix that should vanish.
pub fn vanishes(name: &str, matrix: &DMatrix<Rational>) -> Finding {
    let largest = matrix.iter().map(Scalar::magnitude).fold(ratio(0, 1), |a, b| if a > b { a } else { b });
    Finding::exact(format!("largest entry of {name}"), &largest, &ratio(0, 1), "1")
}

/// The factor of phase volume in (q, p) of a step with M = q² from q = 1, v = 1.
fn volume_with_mass_of_place(h: &Rational) -> Rational {
    let now = Phase::of_one(ratio(1, 1), ratio(1, 1));
    let after = SEMI_IMPLICIT.step(&MassOfPlace, &now, h).position[0].clone();
    volume(&SEMI_IMPLICIT.jacobian(&MassOfPlace, &now, h)) * &after * &after
}

/// The factor of phase volume of symplectic Euler with the momentum, p⁺ = p + h p⁺²/q³, q⁺ = q + h p⁺/q², for M = q²: from q = 1, with p⁺
/// = 1.
fn volume_with_momentum(h: &Rational) -> Rational {
    let step = |x: &DVector<Dual<Rational>>| {
        let (q, p, h) = (x[0].clone(), x[1].clone(), Dual::constant(h.clone()));
        let rate = h.clone() / (q.clone() * q.clone() * q.clone());
        let missing = |next: &Dual<Dual<Rational>>| {
            next.clone() - Dual::constant(p.clone()) - Dual::constant(rate.clone()) * next.clone() * next.clone()
        };
        let momentum = root(missing, &Dual::constant(ratio(1, 1)), 1);
        DVector::from_vec(vec![q.clone() + h * momentum.clone() / (q.clone() * q), momentum])
    };
    volume(&jacobian(&DVector::from_vec(vec![ratio(1, 1), ratio(1, 1) - h]), step))
}

/// The energy that a free particle in polar coordinates has gained at t = 2, relative.
fn polar_gain(steps: usize) -> f64 {
    let h = 2.0 / steps as f64;
    let start = Phase { position: DVector::from_vec(vec![1.0, 0.0]), velocity: DVector::from_vec(vec![0.0, 1.0]) };
    let energy = |at: &Phase<f64>| 0.5 * (at.velocity[0].powi(2) + (at.position[0] * at.velocity[1]).powi(2));
    let end = (0..steps).fold(start.clone(), |now, _| SEMI_IMPLICIT.step(&FreeInPolar, &now, &h));
    energy(&end) / energy(&start) - 1.0
}

fn semi_symplectic(reading: Reading) -> Result<Vec<Finding>> {
    let now = Phase { position: entries(&[(1, 2), (-1, 3)]), velocity: entries(&[(2, 1), (1, 5)]) };
    let separable = defect(&SEMI_IMPLICIT.jacobian(&Coupled, &now, &ratio(1, 7)), &Coupled::mass());
    let h = ratio(1, 10);
    let with_place = volume_with_mass_of_place(&h);
    let power = |n: usize| (0..n).fold(ratio(1, 1), |product, _| product * &h);
    let expected = ratio(1, 1) - ratio(5, 1) * power(2) + ratio(5, 1) * power(4) - ratio(2, 1) * power(5);
    let change = DMatrix::from_element(1, 1, &with_place - ratio(1, 1));
    Ok(vec![
        vanishes("DᵀJD − J", &reading.pick(separable, change)),
        Finding::exact("factor of phase volume with M = q², h v/q = 1/10", &with_place, &expected, "1"),
        Finding::exact("the same with the momentum, solved implicitly", &volume_with_momentum(&h), &ratio(1, 1), "1"),
        Finding::at_least("energy gained in polar coordinates, h = 1/100", polar_gain(200), 0.0126, "1"),
        Finding::equal("order in h of that gain", (polar_gain(200) / polar_gain(400)).log2(), 1.0, INTEGER_ORDER, "1"),
        Finding::decision("stable on a spring at hω = 2", is_stable(&SEMI_IMPLICIT, &ratio(0, 1), &ratio(2, 1)), false),
    ])
}

fn corrections(reading: Reading) -> Result<Vec<Finding>> {
    let now = Phase { position: entries(&[(1, 2), (1, 100)]), velocity: entries(&[(2, 1), (-3, 1)]) };
    let h = ratio(1, 20);
    let free = SEMI_IMPLICIT.step(&Coupled, &now, &h);
    let lifted = Dual::constant(h.clone());
    let mirrored = jacobian(&now.stacked(), |x| mirror_step(&Phase::from_stacked(x), &lifted).stacked());
    let projected = jacobian(&now.stacked(), |x| projected_step(&Phase::from_stacked(x), &lifted).stacked());
    let corrected = mirror_step(&now, &h);
    Ok(vec![
        vanishes("DᵀJD − J of a corrected step", &defect(&reading.pick(&mirrored, &projected).clone(), &Coupled::mass())),
        Finding::decision("the step penetrates before the correction", free.position[1] < ratio(0, 1), true),
        Finding::decision("and not after it", corrected.position[1] > ratio(0, 1), true),
        Finding::exact("determinant of the projected step", &volume(&projected), &ratio(0, 1), "1"),
    ])
}

/// The variational integrator, a start whose step of ½ hits the wall, and the impact's unknowns.
fn hitting() -> (Variational<Bowl, CurvedFloor>, Phase<Rational>, Guess<Rational>) {
    let integrator = Variational { potential: Bowl, gap: Bowl::wall() };
    let time = ratio(1, 4);
    let (start, jump) = variational_start(&integrator, &time);
    (integrator, start, Guess { time, jump, newton_steps: 1 })
}

/// D of that step with its velocity at the end multiplied by `kept`.
pub(in crate::claims) fn kept_step(kept: &Rational) -> DMatrix<Rational> {
    let (integrator, start, guess) = hitting();
    let constant = Guess { time: Dual::constant(guess.time), jump: Dual::constant(guess.jump), newton_steps: 1 };
    jacobian(&start.stacked(), |x| {
        let after = integrator.step_with_impact(&Phase::from_stacked(x), &Dual::constant(ratio(1, 2)), &constant);
        Phase { velocity: after.velocity * Dual::constant(kept.clone()), ..after }.stacked()
    })
}

fn variational(reading: Reading) -> Result<Vec<Finding>> {
    let (integrator, start, guess) = hitting();
    let after = integrator.step_with_impact(&start, &ratio(1, 2), &guess);
    let gaps = [&start, &after].map(|at| integrator.gap.value(&at.position));
    Ok(vec![
        vanishes("DᵀJD − J", &defect(&kept_step(&reading.pick(ratio(1, 1), ratio(4, 5))), &identity(2))),
        Finding::decision(
            "the body leaves the wall as it came",
            after.position == start.position && after.velocity == -&start.velocity,
            true,
        ),
        Finding::decision("and is outside it before and after", gaps.iter().all(|gap| *gap > ratio(0, 1)), true),
        Finding::decision("the impact turns the velocity", guess.jump > ratio(0, 1), true),
    ])
}
