//! Explicit Euler: energy, stability, and a contact force that comes one step late.

use crate::claims::experiments::motion_step::step_matrix;
use crate::claims::experiments::phase_maps::vanishes;
use crate::claims::experiments::spring_damper::{OneStep, ends_at, energy_ratio, is_stable, matrix, undamped};
use crate::claims::prelude::*;
use crate::closed_forms::spring_damper::theta as bound;
use crate::exact_particle::{Ball, BallState};
use crate::integrators::stability::{invariants, spectral_radius};
use crate::integrators::{Method, Phase, SpringDamper};
use crate::scalar::exact;
use crate::schemes::Activation;
use crate::tolerance::rounding;

pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S8.explicit-injects",
        statement: "Explicit Euler adds energy to oscillating systems (it is unstable).",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"As stated for an undamped oscillator: $E^+ = (1 + h^2\omega^2)\,E$ from every state. A damper that takes more
            than that, $2\zeta > h\omega$, makes the same step decay (S8.explicit-G).",
        argument: r"With $D$ the step matrix and $Q = \operatorname{diag}(\omega^2, 1)$: $D^TQD = (1 + h^2\omega^2)\,Q$, an identity of
            matrices, checked in rationals with $\omega = 2$, $h = 3/20$.",
        controls: &["Semi-implicit Euler in place of explicit Euler."],
        sources: &["chapter §8, explicit Euler"],
        check: check!(injects),
    },
    Claim {
        id: "S8.explicit-bound",
        statement: r"Explicit Euler is stable only for $h < 2/\sqrt{k/m}$, a bound that shrinks with the stiffness.",
        verdict: ClaimVerdict::Inconsistent,
        kind: Kind::Assertion,
        severity: Some(Severity::WrongStatement),
        evidence: Evidence::Exact,
        correct_statement: r"Without damping no step is stable, as the same section derives a few lines later. $2/\omega$ is the bound of
            semi-implicit Euler. With damping the bound of explicit Euler is $s = h\omega < 2\zeta$ for $\zeta \le 1$ and
            $s < 2/(\zeta + \sqrt{\zeta^2 - 1})$ beyond; it equals 2 at $\zeta = 1$ only.",
        argument: r"Trace $2 - 2\zeta s$, determinant $1 - 2\zeta s + s^2$. $\zeta = 0$: the determinant is $1 + s^2 > 1$ for every $s$.
            Decided in rationals at $s = 1/1000$, 1, 199/100, all below 2: powers grow. Both sides of the bound at $\zeta = 0.3$, 1, 1.25
            and 2.",
        controls: &[r"Semi-implicit Euler, of which the example, too, says that it is stable below $2/\omega$."],
        sources: &["chapter §8, why explicit Euler fails, against the example on stability bounds"],
        check: check!(bound_of_explicit),
    },
    Claim {
        id: "S8.explicit-lag",
        statement: "With the old velocity in the position update the contact force comes too late to stop the penetration.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"As stated: the step in which the contact acts still moves by $h\,v$, so that a ball that touches the floor at
            speed $|v|$ ends the step $h|v|$ below it, whatever $e$.",
        argument: r"Moreau–Jean with $\theta = 0$, ball at $q = 0$ with $v = -2$ m/s, $h = 1/100$ s: $q^+ = -1/50$ m for $e = 0$ and
            $e = 1/2$, while $v^+$ is already 0 and 1. With $\theta = 1$ the ball ends at 0 and at 1/100 m.",
        controls: &[r"$\theta = 1$ in the position update.", "A ball 1 cm above the floor, whose contact does not act in this step."],
        sources: &["chapter §8, why explicit Euler fails"],
        check: check!(lag),
    },
    Claim {
        id: "S8.explicit-G",
        statement: r"On an undamped spring the amplification factor of explicit Euler is $|G| = \sqrt{1 + \omega^2h^2} > 1$: unstable for
            every step.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Certified,
        correct_statement: "As stated, for the undamped spring that it names.",
        argument: r"Eigenvalues $1 \pm i\,s$: trace 2 and determinant $1 + s^2$ exactly. At $\zeta = 3/10$ steps below
            $s = 2\zeta$ are stable: $|G|^2 = 0.9941$ at 0.59 and 1.0061 at 0.61.",
        controls: &[r"The spring with $\zeta = 3/10$ at $s = 1/2$."],
        sources: &["chapter §8, example on stability bounds"],
        check: check!(amplification),
    },
    Claim {
        id: "S8.ex1",
        statement: r"Exercise: on an undamped spring $E = \tfrac12(v^2 + \omega^2x^2)$ grows by ($1 + \omega^2h^2$) a step under explicit
            Euler; under semi-implicit Euler a conserved quantity bounds it over long times.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Exercise,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Exact,
        correct_statement: r"The conserved quantity is $v^2 + \omega^2x^2 - h\omega^2xv$, which bounds $E$ if and only if $h\omega < 2$.
            With the position updated first the sign of the last term is reversed.",
        argument: r"200 steps with $\omega = 2$, $h = 1/10$ in rationals from $(1, 1/3)$: one value. The form has determinant
            $\omega^2(1 - s^2/4)$, positive iff $s < 2$: the powers of the step are bounded at $h\omega = 199/100$ and grow at 2.",
        controls: &[r"$h\omega = 199/100$ in place of 2.", "The two methods exchanged."],
        sources: &["chapter §8, exercise 1"],
        check: check!(exercise),
    },
];

/// DᵀQD − (1 + s²)Q of a step with ω = 2, h = 3/20, s = 3/10.
fn energy_defect(method: &OneStep) -> DMatrix<Rational> {
    let (spring, _) = undamped();
    let d = step_matrix(method, &spring, &ratio(3, 20));
    let q = DMatrix::from_row_slice(2, 2, &[ratio(4, 1), ratio(0, 1), ratio(0, 1), ratio(1, 1)]);
    d.transpose() * &q * d - q * ratio(109, 100)
}

fn injects(reading: Reading) -> Result<Vec<Finding>> {
    let method = reading.pick(OneStep::Explicit, OneStep::SemiImplicit);
    Ok(vec![vanishes("DᵀQD − (1 + s²) Q", &energy_defect(&method))])
}

/// What the example on stability bounds says of a step s without damping: |G|² = 1 + s² under explicit Euler, |G| = 1 iff s ≤ 2 under the
/// other.
fn example(method: &OneStep, s: &Rational) -> bool {
    match method {
        OneStep::Explicit => ratio(1, 1) + s * s <= ratio(1, 1),
        _ => *s <= ratio(2, 1),
    }
}

fn bound_of_explicit(reading: Reading) -> Result<Vec<Finding>> {
    let method = reading.pick(OneStep::Explicit, OneStep::SemiImplicit);
    let mut findings = Vec::new();
    for s in [ratio(1, 1000), ratio(1, 1), ratio(199, 100)] {
        let found = Finding::decision(format!("stable without damping at s = {s}"), is_stable(&method, &ratio(0, 1), &s), false);
        findings.push(found.clone().says(s < ratio(2, 1)).passage("the limit by stiffness"));
        findings.push(found.says(example(&method, &s)).passage("the example on stability bounds"));
    }
    for zeta in [0.3, 1.0, 1.25, 2.0] {
        let bound = bound(0.0, zeta);
        let ends = ends_at(&method, &exact(zeta), bound);
        let found = Finding::decision(format!("ζ = {zeta}: the stable steps end at s = {bound:.6}"), ends, true).says(bound == 2.0);
        findings.push(if zeta == 1.0 { found } else { found.violating("critical damping") });
    }
    Ok(findings)
}

fn lag(reading: Reading) -> Result<Vec<Finding>> {
    let theta = reading.only(0).pick(ratio(0, 1), ratio(1, 1));
    let place = reading.only(1).pick(ratio(0, 1), ratio(1, 100));
    let mut findings = Vec::new();
    for (restitution, speed) in [(ratio(0, 1), ratio(0, 1)), (ratio(1, 2), ratio(1, 1))] {
        let ball = Ball { mass: ratio(1, 1), gravity: ratio(0, 1), restitution: restitution.clone() };
        let touching = BallState { position: place.clone(), velocity: ratio(-2, 1) };
        let after = ball.moreau_jean(&touching, &theta, Activation::Gap, &ratio(1, 100)).motion;
        findings.push(Finding::exact(
            format!("q⁺ of a ball that touches at −2 m/s, e = {restitution}"),
            &after.position,
            &ratio(-1, 50),
            "m",
        ));
        findings.push(Finding::exact(format!("v⁺, e = {restitution}"), &after.velocity, &speed, "m/s"));
    }
    Ok(findings)
}

fn amplification(reading: Reading) -> Result<Vec<Finding>> {
    let zeta = reading.pick(ratio(0, 1), ratio(3, 10));
    let steps = [ratio(1, 1_000_000), ratio(1, 2), ratio(3, 1)];
    let stable = steps.iter().filter(|s| is_stable(&OneStep::Explicit, &zeta, s)).count();
    let mut findings = vec![Finding::count("stable steps among s = 1/1000000, 1/2 and 3", stable, 0)];
    for s in steps {
        let step = matrix(&OneStep::Explicit, &SpringDamper::of_ratio(zeta.clone()), &s);
        let [trace, determinant] = invariants(&step);
        findings.push(Finding::exact(format!("trace at s = {s}"), &trace, &ratio(2, 1), "1"));
        findings.push(Finding::exact(format!("determinant |G|² at s = {s}"), &determinant, &(ratio(1, 1) + &s * &s), "1"));
        let size = (1.0 + Scalar::to_f64(&s).powi(2)).sqrt();
        let radius = spectral_radius(&step.map(|entry| Scalar::to_f64(&entry)));
        findings.push(Finding::equal(format!("|G| in floating point at s = {s}"), radius, size, rounding(16, size), "1"));
    }
    for (s, square) in [(ratio(59, 100), ratio(9941, 10_000)), (ratio(61, 100), ratio(10_061, 10_000))] {
        let [_, determinant] = invariants(&matrix(&OneStep::Explicit, &SpringDamper::of_ratio(ratio(3, 10)), &s));
        findings.push(Finding::exact(format!("|G|² with ζ = 3/10 at s = {s}"), &determinant, &square, "1").context());
    }
    Ok(findings)
}

fn exercise(reading: Reading) -> Result<Vec<Finding>> {
    let (spring, start) = undamped();
    let h = ratio(1, 10);
    let (explicit, semi) = reading.only(1).pick((OneStep::Explicit, OneStep::SemiImplicit), (OneStep::SemiImplicit, OneStep::Explicit));
    let grown = energy_ratio(&explicit, &undamped(), &h);
    let invariant = |at: &Phase<Rational>| {
        let (x, v) = (&at.position[0], &at.velocity[0]);
        v * v + ratio(4, 1) * x * x - &h * ratio(4, 1) * x * v
    };
    let end = (0..200).fold(start.clone(), |now, _| semi.step(&spring, &now, &h));
    let step = reading.only(0).pick(ratio(2, 1), ratio(199, 100));
    Ok(vec![
        Finding::exact("conserved quantity after 200 semi-implicit steps", &invariant(&end), &invariant(&start), "m²/s²"),
        Finding::exact("E⁺/E of explicit Euler, hω = 1/5", &grown, &ratio(26, 25), "1"),
        Finding::decision("semi-implicit Euler at hω = 199/100 is stable", is_stable(&semi, &ratio(0, 1), &ratio(199, 100)), true),
        Finding::decision("and at hω = 2", is_stable(&semi, &ratio(0, 1), &step), false).says(true).violating("hω < 2"),
    ])
}
