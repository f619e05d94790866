//! Which steps are symplectic: semi-implicit Euler, corrections of the penetration, the variational integrator.

use crate::claims::experiments::phase_maps::{
    Coupled, MassOfPlace, SpringInPolar, about_to_penetrate, entries, hitting, identity, kept_step, mirror_step, projected_step, vanishes,
};
use crate::claims::experiments::spring_damper::{OneStep, SEMI_IMPLICIT, is_stable, matrix};
use crate::claims::prelude::*;
use crate::integrators::jacobian::jacobian;
use crate::integrators::root::root;
use crate::integrators::symplectic::{defect, volume};
use crate::integrators::variational::{InPotential, ScalarField, Verlet};
use crate::integrators::{Method, Phase, SmoothSystem, SpringDamper};
use crate::scalar::Dual;

pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S8.semi-symplectic",
        statement: "For smooth Hamiltonian systems semi-implicit Euler is symplectic, and its energy stays bounded over long times, \
            without drift.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Measured,
        correct_statement: r"With a constant mass matrix, forces that have a potential, and $h\omega < 2$ for the fastest vibration. With
            $M(q)$, as in joint coordinates, the step that updates $v$ and then $q$ is not symplectic and its energy can drift; the
            variant with the momentum, which is, needs an implicit solve.",
        argument: r"$D^TJD = J$ exactly for two coupled masses in a cubic potential. One coordinate with $M = q^2$, which is a free
            particle: the factor of phase volume is $1 - 5x^2 + 5x^4 - 2x^5$ with $x = h\,v/q$, 0.95048 at $x = 1/10$; with the momentum,
            $p^+ = p + h\,p^{+2}/q^3$, it is 1. A mass on a spring, $\omega = 1/s$, sent across at 2 m/s from $r = 1$ m, $h = 1/100$ s: in
            polar coordinates every energy of the third turn lies above all of the first, in Cartesian ones the ranges are the same. At
            $h\omega = 2$ the powers of the step grow.",
        controls: &[
            r"A constant mass matrix – the unit mass in place of $M = q^2$, Cartesian in place of polar coordinates – and
                $h\omega = 199/100$.",
            "The position moved with the old velocity or momentum.",
        ],
        sources: &[
            "chapter §8, three levels",
            "Hairer, Lubich, Wanner, Geometric Numerical Integration, VI.3",
            "MuJoCo documentation, computation: numerical integration (3.17)",
        ],
        check: check!(semi_symplectic),
    },
    Claim {
        id: "S8.cirak-west",
        statement: r"Theorem (Cirak and West 2005): an explicit symplectic scheme necessarily loses symplecticity at the moment a contact
            becomes active; they prove that every operation that corrects penetration destroys it. (What the section excepts is $e = 1$
            without such a correction.)",
        verdict: ClaimVerdict::False,
        kind: Kind::Assertion,
        severity: Some(Severity::BrokenTheorem),
        evidence: Evidence::Exact,
        correct_statement: r"Projecting a penetrating state back does (its Jacobian is singular). Neither every correction nor every
            activation does: the mirror image of a penetrating state in the wall, position and velocity together, is symplectic for a flat
            wall and $e = 1$, and so is a variational step with an elastic impact. Whether the cited paper states such a theorem is not
            decided here; its abstract announces an algorithm with good conservation of momentum and energy.",
        argument: r"Two coupled masses, $M = (2, 1; 1, 3)$, semi-implicit Euler in a cubic potential into the wall and mirrored in the
            metric of $M$: $D^TJD - J = 0$ exactly, in a step that penetrates. The projected step has determinant 0. The variational step
            is S8.kmow; with $e = 1$ and no correction it is what the section excepts, so that the mirror image alone decides.",
        controls: &[
            "Projection in place of the mirror image.",
            "A step of 1/2000 s, which does not reach the wall.",
            "No correction in place of the mirror image.",
        ],
        sources: &["chapter §8, the negative result", "Cirak and West, Int. J. Numer. Meth. Engng 64 (2005) 1078–1110 (abstract)"],
        check: check!(corrections),
    },
    Claim {
        id: "S8.kmow",
        statement: r"Kane, Marsden, Ortiz and West 2000 prove that variational integrators can preserve the symplectic form in elastic
            contact ($e = 1$).",
        verdict: ClaimVerdict::Ambiguous,
        kind: Kind::Citation,
        severity: None,
        evidence: Evidence::NotDecidable,
        correct_statement: "The statement on elastic contact holds, for the variational integrator that makes the time of impact a \
            variable. It is in Fetecau, Marsden, Ortiz and West 2003; the abstract of the paper of 2000 speaks of the Newmark family and \
            of dissipation, and its text was not read.",
        argument: r"Verlet's discrete Lagrangian with an elastic impact in the step, two coordinates, cubic potential, curved wall:
            $D^TJD - J = 0$ in rationals. The impact is solved exactly at a start for which it is rational; without it the step would end
            behind the wall.",
        controls: &["The same step with its velocity at the end cut to 4/5.", "The body sent the other way, where no wall is."],
        sources: &[
            "chapter §8, the negative result",
            "Kane, Marsden, Ortiz, West, Int. J. Numer. Meth. Engng 49 (2000) 1295–1325 (abstract)",
            "Fetecau, Marsden, Ortiz, West, SIAM J. Appl. Dyn. Syst. 2 (2003) 381–416",
        ],
        check: check!(variational),
    },
];

/// The factor of phase volume in (q, p) of a step with M = q² from q = 1, v = 1.
fn volume_with_mass_of_place(h: &Rational) -> Rational {
    let now = Phase::of_one(ratio(1, 1), ratio(1, 1));
    let after = SEMI_IMPLICIT.step(&MassOfPlace, &now, h).position[0].clone();
    volume(&SEMI_IMPLICIT.jacobian(&MassOfPlace, &now, h)) * &after * &after
}

/// The factor of phase volume of Euler with the momentum, p⁺ = p + h p⁺²/q³, for M = q²: q⁺ = q + h p⁺/q², which is symplectic, or with
/// the old momentum, q⁺ = q + h p/q². From q = 1, with p⁺ = 1.
fn volume_with_momentum(h: &Rational, moved_with_old: bool) -> Rational {
    let step = |x: &DVector<Dual<Rational>>| {
        let (q, p, h) = (x[0].clone(), x[1].clone(), Dual::constant(h.clone()));
        let rate = h.clone() / (q.clone() * q.clone() * q.clone());
        let missing = |next: &Dual<Dual<Rational>>| {
            next.clone() - Dual::constant(p.clone()) - Dual::constant(rate.clone()) * next.clone() * next.clone()
        };
        let momentum = root(missing, &Dual::constant(ratio(1, 1)), 1);
        let moving = if moved_with_old { p.clone() } else { momentum.clone() };
        DVector::from_vec(vec![q.clone() + h * moving / (q.clone() * q), momentum])
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
    let (method, moved_with_old) = reading.only(1).pick((OneStep::SemiImplicit, false), (OneStep::Explicit, true));
    let now = Phase { position: entries(&[(1, 2), (-1, 3)]), velocity: entries(&[(2, 1), (1, 5)]) };
    let separable = defect(&method.jacobian(&Coupled, &now, &ratio(1, 7)), &Coupled::mass());
    let h = ratio(1, 10);
    let spring = SpringDamper::of_ratio(ratio(0, 1));
    let (with_place, gained) = match reading.only(0) {
        Reading::Recorded => (volume_with_mass_of_place(&h), gains(&SpringInPolar, polar_energy)),
        Reading::Control(_) => (volume(&matrix(&SEMI_IMPLICIT, &spring, &h)), gains(&spring, cartesian_energy)),
    };
    let limit = reading.only(0).pick(ratio(2, 1), ratio(199, 100));
    let power = |n: usize| (0..n).fold(ratio(1, 1), |product, _| product * &h);
    let expected = ratio(1, 1) - ratio(5, 1) * power(2) + ratio(5, 1) * power(4) - ratio(2, 1) * power(5);
    Ok(vec![
        vanishes("DᵀJD − J", &separable),
        Finding::exact("factor of phase volume with M = q², h v/q = 1/10", &with_place, &expected, "1")
            .says(ratio(1, 1))
            .violating("a constant mass matrix"),
        Finding::exact("the same with the momentum, solved implicitly", &volume_with_momentum(&h, moved_with_old), &ratio(1, 1), "1"),
        Finding::decision("a spring in polar coordinates gains energy from turn to turn", gained, true)
            .experiment()
            .says(false)
            .violating("a constant mass matrix"),
        Finding::decision("stable on a spring at hω = 2", is_stable(&SEMI_IMPLICIT, &ratio(0, 1), &limit), false)
            .says(true)
            .violating("hω < 2"),
    ])
}

fn corrections(reading: Reading) -> Result<Vec<Finding>> {
    let now = about_to_penetrate();
    let h = reading.only(1).pick(ratio(1, 20), ratio(1, 2000));
    let free = SEMI_IMPLICIT.step(&Coupled, &now, &h);
    let lifted = Dual::constant(h.clone());
    let mirrored = jacobian(&now.stacked(), |x| mirror_step(&Phase::from_stacked(x), &lifted).stacked());
    let projected = jacobian(&now.stacked(), |x| projected_step(&Phase::from_stacked(x), &lifted).stacked());
    let correction = reading.only(0).pick(&mirrored, &projected);
    let corrected = match reading {
        Reading::Control(0) => projected_step(&now, &h),
        Reading::Control(2) => free.clone(),
        _ => mirror_step(&now, &h),
    };
    let kept = defect(correction, &Coupled::mass()).iter().all(|entry| *entry == ratio(0, 1));
    Ok(vec![
        Finding::decision("DᵀJD = J for a step whose penetration is mirrored in the wall", kept, true).says(false),
        Finding::decision("the step penetrates before the correction", free.position[1] < ratio(0, 1), true),
        Finding::decision("and is not behind the wall after it", corrected.position[1] >= ratio(0, 1), true),
        Finding::exact("determinant of the projected step", &volume(&projected), &ratio(0, 1), "1"),
    ])
}

fn variational(reading: Reading) -> Result<Vec<Finding>> {
    const POINT: &str = "whether the paper of 2000, of which the abstract alone was read, proves it";
    let kept = reading.only(0).pick(ratio(1, 1), ratio(4, 5));
    let (integrator, start, guess) = hitting();
    let mut after = integrator.step_with_impact(&start, &ratio(1, 2), &guess);
    after.velocity *= kept.clone();
    let sent = reading.only(1).pick(start.velocity.clone(), -&start.velocity);
    let without = Verlet.step(&InPotential(integrator.potential), &Phase { velocity: sent, ..start.clone() }, &ratio(1, 2));
    Ok(vec![
        vanishes("DᵀJD − J", &defect(&kept_step(&kept), &identity(2))).opinion(POINT),
        Finding::decision(
            "the body leaves the wall as it came",
            after.position == start.position && after.velocity == -&start.velocity,
            true,
        ),
        Finding::decision("without the impact the step ends behind the wall", integrator.gap.value(&without.position) < ratio(0, 1), true),
    ])
}
