//! The spring and damper of compliant contact: what damping does to the bound hω ≤ 2, and what MuJoCo's limit t_c ≥ 2h is.

use super::spring::{SEMI_IMPLICIT, against_two, is_stable, matrix, powers_at};
use crate::claims::experiments::soft::unlimited_contact;
use crate::claims::prelude::*;
use crate::closed_forms::spring_damper as closed;
use crate::integrators::stability::{Powers, invariants, spectral_radius};
use crate::integrators::{Damping, ExplicitEuler, SemiImplicitEuler, SpringDamper};
use crate::scalar::exact;
use crate::tolerance::claims::pathology::FIVE_DECIMALS;
use crate::tolerance::rounding;

pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S8.spring-damper-model",
        statement: "A contact as in MuJoCo is modelled as a spring and a damper, m φ̈ = −k φ − c φ̇, with ω₀ = √(k/m).",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Certified,
        correct_statement: "As stated; MuJoCo's contact of constant impedance at depth δ > 0 is that oscillator under semi-implicit Euler, \
            with ω₀ = 1/(t_c ζ) and c/m = 2/t_c. So t_c = 1/ω₀, as the chapter has it, at ζ = 1 only.",
        argument: "The replay of MuJoCo's contact that reproduces its stored runs, h = 1 ms, t_c = 2 and 5 ms, ζ = 1: its step matrix for \
            (δ, −v), from two depths and two velocities, is that of semi-implicit Euler on the spring and damper, entry by entry to \
            rounding.",
        controls: &["A contact of twice the time constant, against the same spring and damper."],
        sources: &["chapter §8, example on stability bounds", "MuJoCo documentation, solver parameters (3.17)"],
        check: soft_contact,
    },
    Claim {
        id: "S8.damped-bound",
        statement: "The stability bound h ≤ 2/ω₀ of the spring-damper contact links the time constant of §6, the integrator of §8 and the \
            jitter of §9.",
        verdict: ClaimVerdict::False,
        kind: Kind::Assertion,
        severity: Some(Severity::WrongStatement),
        evidence: Evidence::Certified,
        correct_statement: "h ≤ 2/ω₀ is derived, rightly, without damping, and does not carry over to the damped contact: with damping at \
            the old velocity the bound is s = hω₀ < 2(√(1+ζ²) − ζ), 0.828 at MuJoCo's default ζ = 1. With damping at the new velocity it \
            is 2(√(1+ζ²) + ζ), above 2.",
        argument: "Trace 2 − 2ζs − s², determinant 1 − 2ζs; Jury's condition 1 + T + D = 4 − 4ζs − s² > 0. Rational cases, decided at the \
            bound itself: ζ = 3/4 gives s < 1, ζ = 5/12 gives 4/3. Both sides for ζ = 0.05, 0.1, 0.5, 1, 2: 1.90250, 1.80998, 1.23607, \
            0.82843, 0.47214. At ζ = 1 the printed bound is 2.41 times too large. \
                   The smaller s at which a soft contact starts to jitter is this one (S9.jitter).",
        controls: &["No damping anywhere, for which the printed bound is right."],
        sources: &["chapter §8, essential insight on the bound, and the example before it"],
        check: bound,
    },
    Claim {
        id: "S8.semi-much-better",
        statement: "The stability of semi-implicit Euler is far better than that of explicit Euler.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Exact,
        correct_statement: "Up to ζ = 1/√3: beyond it explicit Euler, with bound 2ζ (ζ ≤ 1), bears the larger step. At ζ = 1 the bounds \
            are 2 for explicit and 0.828 for semi-implicit Euler with explicit damping.",
        argument: "2ζ = 2(√(1+ζ²) − ζ) at ζ = 1/√3. ζ = 1, s = 1: explicit Euler has both eigenvalues 0, semi-implicit Euler has trace −1 \
            and determinant −1. ζ = 1/2, s = 11/10: the other way round.",
        controls: &["The spring with ζ = 1/2 and s = 11/10 in place of ζ = 1 and s = 1."],
        sources: &["chapter §8, three levels"],
        check: comparison,
    },
    Claim {
        id: "S8.timeconst-origin",
        statement: "The bound is where MuJoCo's rule timeconst ≥ 2h comes from: with timeconst = 1/ω₀, h ≤ 2 timeconst means timeconst ≥ \
            h/2, and MuJoCo takes 2h to leave a margin.",
        verdict: ClaimVerdict::False,
        kind: Kind::Assertion,
        severity: Some(Severity::WrongReason),
        evidence: Evidence::Certified,
        correct_statement: "The default contact is critically damped, so its limit is t_c > (1 + √2)h/2 = 1.2071 h, not h/2. t_c ≥ 2h does \
            leave a margin to that, of 1.66; what it marks is h·2/t_c = 1, the largest step whose matrix has no negative eigenvalue.",
        argument: "ζ = 1, s = h/t_c. At t_c = h/2 (s = 2): z² + 6z − 3 = 0, spectral radius 3 + 2√3 = 6.46. At t_c = 2h (s = 1/2): \
            determinant exactly 0, eigenvalues 0 and 3/4; for larger s it is negative. Both sides of 1.2071 h. Why MuJoCo chose 2h is not \
            decided here.",
        controls: &["The contact without damping, where t_c = h/2 is the bound."],
        sources: &["chapter §8, example on stability bounds", "MuJoCo documentation, solver parameters: refsafe (3.17)"],
        check: time_constant,
    },
];

/// The matrix of one step of MuJoCo's contact for (δ, −v), mass 1 kg, without load, from its values at depths and velocities in contact.
fn replayed(h: f64, time_constant: f64) -> DMatrix<f64> {
    let contact = unlimited_contact(h, time_constant);
    let step = |depth: f64, opening: f64| {
        let after = opening + contact.impulse(depth, opening, 0.0) / contact.mass;
        [depth - h * after, -after]
    };
    // depths 1 mm and 2 mm, opening speeds 0 and −1 m/s: the contact presses in all of them
    let (base, deeper, faster) = (step(0.001, 0.0), step(0.002, 0.0), step(0.001, -1.0));
    DMatrix::from_fn(2, 2, |i, j| if j == 0 { (deeper[i] - base[i]) / 0.001 } else { faster[i] - base[i] })
}

fn soft_contact(reading: Reading) -> Result<Vec<Finding>> {
    let h = 0.001;
    let mut findings = Vec::new();
    for parts in [2, 5] {
        let rate = ratio(1000, parts);
        let spring = SpringDamper { stiffness_per_mass: &rate * &rate, damping_per_mass: ratio(2, 1) * &rate };
        let expected = matrix(&SEMI_IMPLICIT, &spring, &ratio(1, 1000)).map(|entry| Scalar::to_f64(&entry));
        let measured = replayed(h, (reading.pick(1, 2) * parts) as f64 * h);
        // a depth of 1 mm times k = 1/t_c² in 32 operations, over the difference of 1 mm
        let bound = rounding(32, 1.0 / (parts as f64 * h).powi(2));
        for (k, (entry, wanted)) in measured.iter().zip(expected.iter()).enumerate() {
            findings.push(Finding::equal(format!("entry {k} of the step matrix, t_c = {parts} h"), *entry, *wanted, bound, "SI"));
        }
    }
    Ok(findings)
}

fn bound(reading: Reading) -> Result<Vec<Finding>> {
    // the sentence: stable up to s = 2, whatever the damping
    let critical = reading.pick(ratio(1, 1), ratio(0, 1));
    let at_critical = is_stable(&SEMI_IMPLICIT, &critical, &ratio(199, 100));
    let mut findings = vec![Finding::decision("stable at s = 199/100", at_critical, false).says(true)];
    for (damped, s) in [(ratio(3, 4), ratio(1, 1)), (ratio(5, 12), ratio(4, 3))] {
        let zeta = reading.pick(damped.clone(), ratio(0, 1));
        let stable = |factor: Rational| is_stable(&SEMI_IMPLICIT, &zeta, &(&s * factor));
        let at = powers_at(&SEMI_IMPLICIT, &zeta, &s);
        findings.push(Finding::decision(format!("ζ = {damped}: stable below s = {s}"), stable(ratio(999_999, 1_000_000)), true));
        findings.push(Finding::decision("bounded at it", at == Powers::Bounded, true));
        findings.push(Finding::decision("stable above it", stable(ratio(1_000_001, 1_000_000)), false).says(true));
    }
    for (damped, printed) in [(0.05, 1.9025), (0.1, 1.80998), (0.5, 1.23607), (1.0, 0.82843), (2.0, 0.47214)] {
        let zeta = reading.pick(damped, 0.0);
        let bound = closed::semi_implicit(zeta);
        findings.push(Finding::equal(format!("bound at ζ = {damped}"), bound, printed, FIVE_DECIMALS, "1").says(2.0));
        findings.extend(against_two("damping explicit", &SEMI_IMPLICIT, zeta, bound));
        let implicit = SemiImplicitEuler { damping: Damping::Implicit };
        findings.extend(against_two("damping implicit", &implicit, zeta, closed::semi_implicit_with_implicit_damping(zeta)));
    }
    Ok(findings)
}

fn comparison(reading: Reading) -> Result<Vec<Finding>> {
    let stable = |(zeta, s): &(Rational, Rational)| [is_stable(&ExplicitEuler, zeta, s), is_stable(&SEMI_IMPLICIT, zeta, s)];
    let (undamped, light) = ((ratio(0, 1), ratio(199, 100)), (ratio(1, 2), ratio(11, 10)));
    let [explicit, semi] = stable(&reading.pick((ratio(1, 1), ratio(1, 1)), light.clone()));
    let crossing = 1.0 / 3f64.sqrt();
    let bounds = |zeta: f64| closed::theta(0.0, zeta) - closed::semi_implicit(zeta);
    Ok(vec![
        Finding::decision("ζ = 1, s = 1: explicit Euler alone is stable", explicit && !semi, true).says(false).violating("ζ below 1/√3"),
        Finding::decision("ζ = 1/2, s = 11/10: semi-implicit Euler alone is stable", stable(&light) == [false, true], true),
        Finding::decision("ζ = 0, s = 199/100: semi-implicit Euler alone is stable", stable(&undamped) == [false, true], true),
        Finding::equal("difference of the bounds at ζ = 1/√3", bounds(crossing), 0.0, rounding(8, 2.0), "1").context(),
    ])
}

fn time_constant(reading: Reading) -> Result<Vec<Finding>> {
    let (zeta, damping_ratio) = reading.pick((ratio(1, 1), 1.0), (ratio(0, 1), 0.0));
    let half_a_step = matrix(&SEMI_IMPLICIT, &SpringDamper::of_ratio(zeta), &ratio(2, 1));
    let radius = spectral_radius(&half_a_step.map(|entry| Scalar::to_f64(&entry)));
    let critical = |s| matrix(&SEMI_IMPLICIT, &SpringDamper::of_ratio(ratio(1, 1)), &s);
    let [trace, determinant] = invariants(&critical(ratio(1, 2)));
    let [_, beyond] = invariants(&critical(ratio(501, 1000)));
    let largest = closed::semi_implicit(damping_ratio);
    let mut findings = vec![
        Finding::equal("spectral radius at t_c = h/2", radius, 3.0 + 2.0 * 3f64.sqrt(), rounding(32, 7.0), "1").says_at_most(1.0),
        Finding::equal("smallest stable t_c/h", 1.0 / largest, 1.20711, FIVE_DECIMALS, "1").says(0.5),
        Finding::exact("determinant at t_c = 2h", &determinant, &ratio(0, 1), "1").context(),
        Finding::exact("trace at t_c = 2h", &trace, &ratio(3, 4), "1").context(),
        Finding::decision("determinant positive beyond it", beyond > ratio(0, 1), false).context(),
    ];
    findings.extend(against_two("MuJoCo's contact", &SEMI_IMPLICIT, damping_ratio, largest));
    let stable = is_stable(&SEMI_IMPLICIT, &ratio(1, 1), &exact(0.5));
    findings.push(Finding::decision("stable at t_c = 2h", stable, true));
    Ok(findings)
}
