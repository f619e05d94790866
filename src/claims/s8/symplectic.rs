//! Which steps are symplectic: semi-implicit Euler, corrections of the penetration, the variational integrator.

use super::systems::{
    Bowl, Coupled, CurvedFloor, MassOfPlace, SpringInPolar, entries, identity, mirror_step, projected_step, variational_start,
};
use crate::claims::prelude::*;
use crate::claims::s8::spring::{SEMI_IMPLICIT, is_stable, matrix};
use crate::integrators::jacobian::jacobian;
use crate::integrators::root::root;
use crate::integrators::symplectic::{defect, volume};
use crate::integrators::variational::{Guess, ScalarField, Variational};
use crate::integrators::{Method, Phase, SmoothSystem, SpringDamper};
use crate::scalar::Dual;

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
            1. A mass on a spring, ω = 1/s, sent across at 2 m/s from r = 1 m, h = 1/100 s: in polar coordinates every energy of the \
            third turn \
            lies above all of the first, in Cartesian ones the ranges are the same. At hω = 2 the powers of the step grow.",
        controls: &[
            "A constant mass matrix – the unit mass in place of M = q², Cartesian in place of polar coordinates – and hω = 199/100.",
        ],
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
        severity: Some(Severity::BrokenTheorem),
        evidence: Evidence::Exact,
        correct_statement: "Projecting a penetrating state back does (its Jacobian is singular). Neither every correction nor every \
            activation does: the mirror image of a penetrating state in the wall, position and velocity together, is symplectic for a flat \
            wall and e = 1, and so is a variational step with an elastic impact. Whether the cited paper states such a theorem is not \
            decided here; its abstract announces an algorithm with good conservation of momentum and energy.",
        argument: "Two coupled masses, M = (2, 1; 1, 3), semi-implicit Euler in a cubic potential into the wall and mirrored in the metric \
            of M: DᵀJD − J = 0 exactly, in a step that penetrates. The projected step has determinant 0. The variational step is S8.kmow.",
        controls: &["Projection in place of the mirror image."],
        sources: &["chapter §8, the negative result", "Cirak and West, Int. J. Numer. Meth. Engng 64 (2005) 1078–1110 (abstract)"],
        check: corrections,
    },
    Claim {
        id: "S8.kmow",
        statement: "Kane, Marsden, Ortiz and West 2000 prove that variational integrators can preserve the symplectic form in elastic \
            contact (e = 1).",
        verdict: ClaimVerdict::Ambiguous,
        kind: Kind::Citation,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: "The statement on elastic contact holds, for the variational integrator that makes the time of impact a \
            variable. It is in Fetecau, Marsden, Ortiz and West 2003; the abstract of the paper of 2000 speaks of the Newmark family and \
            of dissipation, and its text was not read.",
        argument: "Verlet's discrete Lagrangian with an elastic impact in the step, two coordinates, cubic potential, curved wall: DᵀJD − \
            J = 0 in rationals. The impact is solved exactly at a start for which it is rational.",
        controls: &["The same step with its velocity at the end cut to 4/5."],
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

/// Twice the energy of [`SpringInPolar`].
fn polar_energy(at: &Phase<f64>) -> f64 {
    let (r, rate, across) = (at.position[0], at.velocity[0], at.position[0] * at.velocity[1]);
    rate * rate + across * across + r * r
}

/// The same in Cartesian coordinates.
fn cartesian_energy(at: &Phase<f64>) -> f64 {
    at.velocity.norm_squared() + at.position.norm_squared()
}

/// Whether a mass on a spring, sent across at 2 m/s from 1 m with h = 1/100 s, has more energy all through its third turn of 628 steps than
/// it ever had in its first.
fn gains(system: &impl SmoothSystem, energy: fn(&Phase<f64>) -> f64) -> bool {
    // r and x, then the angle and y: the same start in both coordinates
    let mut now = Phase { position: DVector::from_vec(vec![1.0, 0.0]), velocity: DVector::from_vec(vec![0.0, 2.0]) };
    let mut energies = Vec::new();
    for _ in 0..3 * 628 {
        now = SEMI_IMPLICIT.step(system, &now, &0.01);
        energies.push(energy(&now));
    }
    let greatest = energies[..628].iter().copied().fold(f64::NEG_INFINITY, f64::max);
    energies[2 * 628..].iter().all(|late| *late > greatest)
}

fn semi_symplectic(reading: Reading) -> Result<Vec<Finding>> {
    let now = Phase { position: entries(&[(1, 2), (-1, 3)]), velocity: entries(&[(2, 1), (1, 5)]) };
    let separable = defect(&SEMI_IMPLICIT.jacobian(&Coupled, &now, &ratio(1, 7)), &Coupled::mass());
    let h = ratio(1, 10);
    let spring = SpringDamper::of_ratio(ratio(0, 1));
    let (with_place, gained) = match reading {
        Reading::Recorded => (volume_with_mass_of_place(&h), gains(&SpringInPolar, polar_energy)),
        Reading::Control(_) => (volume(&matrix(&SEMI_IMPLICIT, &spring, &h)), gains(&spring, cartesian_energy)),
    };
    let limit = reading.pick(ratio(2, 1), ratio(199, 100));
    let power = |n: usize| (0..n).fold(ratio(1, 1), |product, _| product * &h);
    let expected = ratio(1, 1) - ratio(5, 1) * power(2) + ratio(5, 1) * power(4) - ratio(2, 1) * power(5);
    Ok(vec![
        vanishes("DᵀJD − J", &separable),
        Finding::exact("factor of phase volume with M = q², h v/q = 1/10", &with_place, &expected, "1")
            .says(ratio(1, 1))
            .violating("a constant mass matrix"),
        Finding::exact("the same with the momentum, solved implicitly", &volume_with_momentum(&h), &ratio(1, 1), "1"),
        Finding::decision("a spring in polar coordinates gains energy from turn to turn", gained, true)
            .says(false)
            .violating("a constant mass matrix"),
        Finding::decision("stable on a spring at hω = 2", is_stable(&SEMI_IMPLICIT, &ratio(0, 1), &limit), false)
            .says(true)
            .violating("hω < 2"),
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
    let kept = defect(reading.pick(&mirrored, &projected), &Coupled::mass()).iter().all(|entry| *entry == ratio(0, 1));
    Ok(vec![
        Finding::decision("DᵀJD = J for a step whose penetration is mirrored in the wall", kept, true).says(false),
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
        vanishes("DᵀJD − J", &defect(&kept_step(&reading.pick(ratio(1, 1), ratio(4, 5))), &identity(2)))
            .opinion("whether the paper of 2000, of which the abstract alone was read, proves it"),
        Finding::decision(
            "the body leaves the wall as it came",
            after.position == start.position && after.velocity == -&start.velocity,
            true,
        ),
        Finding::decision("and is outside it before and after", gaps.iter().all(|gap| *gap > ratio(0, 1)), true),
        Finding::decision("the impact turns the velocity", guess.jump > ratio(0, 1), true),
    ])
}
