//! The spring and damper of compliant contact: what damping does to the bound hω ≤ 2, and what MuJoCo's limit t_c ≥ 2h is.

use crate::claims::experiments::soft::unlimited_contact;
use crate::claims::experiments::spring_damper::{OneStep, SEMI_IMPLICIT, end_of_stable_steps, ends_at, is_stable, matrix};
use crate::claims::prelude::*;
use crate::closed_forms::spring_damper as closed;
use crate::integrators::SpringDamper;
use crate::integrators::stability::{invariants, spectral_radius};
use crate::scalar::exact;
use crate::tolerance::{claims::integrators as tolerance, rounding};

pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S8.spring-damper-model",
        statement: r"A contact as in MuJoCo is modelled as a spring and a damper, $m\,\ddot\varphi = -k\,\varphi - c\,\dot\varphi$, with
            $\omega_0 = \sqrt{k/m}$.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Certified,
        correct_statement: r"As stated; MuJoCo's contact of constant impedance at depth $\delta > 0$ is that oscillator under
            semi-implicit Euler, with $\omega_0 = 1/(t_c\,\zeta)$ and $c/m = 2/t_c$. So $t_c = 1/\omega_0$, as the chapter has it, at
            $\zeta = 1$ only.",
        argument: r"The replay of MuJoCo's contact that reproduces its stored runs, $h = 1$ ms, $t_c = 2$ and 5 ms, $\zeta = 1$: its step
            matrix for $(\delta, -v)$, from two depths and two velocities, is that of semi-implicit Euler on the spring and damper, entry
            by entry to rounding.",
        controls: &["A contact of twice the time constant, against the same spring and damper."],
        sources: &["chapter §8, example on stability bounds", "MuJoCo documentation, solver parameters (3.17)"],
        check: check!(soft_contact),
    },
    Claim {
        id: "S8.damped-bound",
        statement: r"The stability bound $h \le 2/\omega_0$, derived before without damping, is the link between §6 (the time constant of
            MuJoCo's contact), §8 (the integrator) and §9 (jitter from a step beyond the bound).",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Certified,
        correct_statement: r"For contacts without damping. §6's are damped: with damping at the old velocity the bound is
            $s = h\omega_0 < 2(\sqrt{1 + \zeta^2} - \zeta)$, 0.82843 at MuJoCo's default $\zeta = 1$. With damping at the new velocity it
            is $2(\sqrt{1 + \zeta^2} + \zeta)$, above 2.",
        argument: r"Trace $2 - 2\zeta s - s^2$, determinant $1 - 2\zeta s$; Jury's condition $1 + T + D = 4 - 4\zeta s - s^2 > 0$. Decided
            in rationals: the stable steps end at $s = 1$ for $\zeta = 3/4$, at 4/3 for $\zeta = 5/12$. Bisected for $\zeta = 0.05$, 0.1,
            0.5, 1, 2: 1.90250, 1.80998, 1.23607, 0.82843, 0.47214. The smaller $s$ at which a soft contact starts to jitter is this one
            (S9.jitter).",
        controls: &[
            "No damping anywhere, for which the printed bound is right.",
            "Explicit Euler in place of semi-implicit Euler, on the undamped spring as well.",
        ],
        sources: &["chapter §8, essential insight on the bound, and the example before it"],
        check: check!(bound),
    },
    Claim {
        id: "S8.semi-much-better",
        statement: "The stability of semi-implicit Euler is far better than that of explicit Euler.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Exact,
        correct_statement: r"Up to $\zeta = 1/\sqrt3$: beyond it explicit Euler, with bound $2\zeta$ ($\zeta \le 1$), bears the larger
            step. At $\zeta = 1$ the bounds are 2 for explicit and 0.828 for semi-implicit Euler with explicit damping.",
        argument: r"$2\zeta = 2(\sqrt{1 + \zeta^2} - \zeta)$ at $\zeta = 1/\sqrt3$. $\zeta = 1$, $s = 1$: explicit Euler has both
            eigenvalues 0, semi-implicit Euler has trace −1 and determinant −1. $\zeta = 1/2$, $s = 11/10$: the other way round.",
        controls: &[
            r"The spring with $\zeta = 1/2$ and $s = 11/10$ in place of $\zeta = 1$ and $s = 1$.",
            "The position updated with the old velocity: explicit Euler in place of semi-implicit Euler.",
        ],
        sources: &["chapter §8, three levels"],
        check: check!(comparison),
    },
    Claim {
        id: "S8.timeconst-origin",
        statement: r"The bound is where MuJoCo's rule timeconst $\ge 2h$ comes from: with timeconst $= 1/\omega_0$, $h \le 2$ timeconst
            means timeconst $\ge h/2$, and MuJoCo takes $2h$ to leave a margin.",
        verdict: ClaimVerdict::False,
        kind: Kind::Assertion,
        severity: Some(Severity::WrongReason),
        evidence: Evidence::Certified,
        correct_statement: r"The default contact is critically damped, so its limit is $t_c > (1 + \sqrt2)h/2 = 1.2071\,h$, not $h/2$.
            $t_c \ge 2h$ does leave a margin to that, of 1.66; what it marks is $h\cdot2/t_c = 1$, the largest step whose matrix has no
            negative eigenvalue.",
        argument: r"$\zeta = 1$, $s = h/t_c$. At $t_c = h/2$ ($s = 2$): $z^2 + 6z - 3 = 0$, spectral radius $3 + 2\sqrt3 = 6.46$. At
            $t_c = 2h$ ($s = 1/2$): determinant exactly 0, eigenvalues 0 and 3/4; for larger $s$ it is negative. The stable time
            constants, bisected in rationals, start at $1.2071\,h$. Why MuJoCo chose $2h$ is not decided here.",
        controls: &[r"The contact without damping, where $t_c = h/2$ is the bound."],
        sources: &["chapter §8, example on stability bounds", "MuJoCo documentation, solver parameters: refsafe (3.17)"],
        check: check!(time_constant),
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
        // by columns: (δ, −v) after the step for δ, then for −v
        // a depth of 1 mm times k = 1/t_c² in 32 operations, over the difference of 1 mm
        let bound = rounding(32, 1.0 / (parts as f64 * h).powi(2));
        for (k, (unit, (entry, wanted))) in ["1", "1/s", "s", "1"].into_iter().zip(measured.iter().zip(expected.iter())).enumerate() {
            findings.push(Finding::equal(format!("entry {k} of the step matrix, t_c = {parts} h"), *entry, *wanted, bound, unit));
        }
    }
    Ok(findings)
}

fn bound(reading: Reading) -> Result<Vec<Finding>> {
    const OMITTED: &str = "a contact without damping";
    let damping = |zeta: Rational| reading.only(0).pick(zeta, ratio(0, 1));
    let (explicit, implicit) =
        reading.only(1).pick((OneStep::SemiImplicit, OneStep::ImplicitDamping), (OneStep::Explicit, OneStep::Explicit));
    let within = tolerance::end_of_stable_steps();
    let end = |method: &OneStep, zeta: f64| end_of_stable_steps(method, &damping(exact(zeta)));
    let mut findings = vec![
        Finding::equal("end of the stable steps without damping", end(&explicit, 0.0), closed::semi_implicit(0.0), within, "1").says(2.0),
        Finding::decision("stable at ζ = 1, s = 199/100", is_stable(&explicit, &damping(ratio(1, 1)), &ratio(199, 100)), false)
            .says(true)
            .violating(OMITTED),
    ];
    for (zeta, s) in [(ratio(3, 4), ratio(1, 1)), (ratio(5, 12), ratio(4, 3))] {
        let ends = ends_at(&explicit, &damping(zeta.clone()), Scalar::to_f64(&s));
        findings.push(Finding::decision(format!("ζ = {zeta}: the stable steps end at s = {s}"), ends, true).says(false).violating(OMITTED));
    }
    for zeta in [0.05, 0.1, 0.5, 1.0, 2.0] {
        let last = Finding::equal(
            format!("end of the stable steps at ζ = {zeta}, damping explicit"),
            end(&explicit, zeta),
            closed::semi_implicit(zeta),
            within,
            "1",
        );
        findings.push(last.says(2.0).violating(OMITTED));
        let implicit = Finding::equal(
            format!("end of the stable steps at ζ = {zeta}, damping implicit"),
            end(&implicit, zeta),
            closed::semi_implicit_with_implicit_damping(zeta),
            within,
            "1",
        );
        findings.push(implicit.says(2.0).violating(OMITTED));
    }
    Ok(findings)
}

fn comparison(reading: Reading) -> Result<Vec<Finding>> {
    let subject = reading.only(1).pick(OneStep::SemiImplicit, OneStep::Explicit);
    let stable = |(zeta, s): &(Rational, Rational)| [is_stable(&OneStep::Explicit, zeta, s), is_stable(&subject, zeta, s)];
    let (undamped, light) = ((ratio(0, 1), ratio(199, 100)), (ratio(1, 2), ratio(11, 10)));
    let [explicit, semi] = stable(&reading.only(0).pick((ratio(1, 1), ratio(1, 1)), light.clone()));
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
    let zeta = reading.pick(ratio(1, 1), ratio(0, 1));
    let half_a_step = matrix(&SEMI_IMPLICIT, &SpringDamper::of_ratio(zeta.clone()), &ratio(2, 1));
    let radius = spectral_radius(&half_a_step.map(|entry| Scalar::to_f64(&entry)));
    let [trace, determinant] = invariants(&matrix(&SEMI_IMPLICIT, &SpringDamper::of_ratio(ratio(1, 1)), &ratio(1, 2)));
    let smallest = 1.0 / end_of_stable_steps(&SEMI_IMPLICIT, &zeta);
    // the smallest time constant is 1/s, and |1/s − 1/s'| ≤ |s − s'|/(s s') ≤ 2|s − s'| for s above 0.8
    let within = 2.0 * tolerance::end_of_stable_steps();
    let derived = 0.5 * (1.0 + 2f64.sqrt());
    Ok(vec![
        Finding::equal("spectral radius at t_c = h/2", radius, 3.0 + 2.0 * 3f64.sqrt(), rounding(32, 7.0), "1").says_at_most(1.0),
        Finding::equal("smallest stable t_c/h", smallest, derived, within, "1").says(0.5),
        Finding::equal("MuJoCo's limit 2h over the smallest stable t_c", 2.0 / smallest, 2.0 / derived, 2.0 * within, "1").says(4.0),
        Finding::exact("determinant at t_c = 2h", &determinant, &ratio(0, 1), "1").context(),
        Finding::exact("trace at t_c = 2h", &trace, &ratio(3, 4), "1").context(),
    ])
}
