//! The rule timeconst ≥ 2h: what it keeps away from, what it guarantees, and for which damping ratios.

use crate::claims::experiments::soft::{GRAVITY, land, limited_contact, unlimited_contact};
use crate::claims::prelude::*;
use crate::claims::s8::spring::{SEMI_IMPLICIT, both_sides, is_stable, matrix, powers_at};
use crate::closed_forms::soft_impedance::SoftImpedance;
use crate::closed_forms::soft_reference::SoftReference;
use crate::closed_forms::spring_damper as closed;
use crate::integrators::SpringDamper;
use crate::integrators::stability::{Powers, invariants, spectral_radius};
use crate::tolerance::claims::pathology as tolerance;
use crate::tolerance::rounding;

const STABILITY: &str = "chapter §6, why timeconst must be at least 2h";
const REFSAFE: &str = "MuJoCo documentation, option flag refsafe (3.17)";

pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S6.timeconst-2h-doc",
        statement: "timeconst ≥ 2h is a hard recommendation of MuJoCo's documentation; behind it stands numerical stability.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Exact,
        correct_statement: "MuJoCo enforces it: with refsafe, the default, a smaller timeconst counts as 2h. The direct form (−stiffness, \
            −damping) is not limited. It keeps contacts with dampratio > 1/(2√2) = 0.354 stable, and no others.",
        argument: "h = 2 ms: timeconst 1, 2 and 3 ms have the k and b of 4 ms, in rationals. At timeconst = 2h, s = hω₀ = 1/(2ζ), which is \
            below the bound 2(√(1+ζ²) − ζ) iff ζ² > 1/8: decided at ζ = 36/100 and 35/100. MuJoCo 3.17 itself, a ball of 1 kg released 1 \
            mm above the floor at timeconst = 2h and constant impedance, is calm with dampratio 0.4 and thrown 43 mm high and more with \
            0.35, 9 m with 0.2.",
        controls: &["dampratio 0.4 in place of 0.35 and 0.2."],
        sources: &[STABILITY, REFSAFE],
        check: enforced,
    },
    Claim {
        id: "S6.timeconst-lt-2h-unstable",
        statement: "If timeconst < 2h, the discrete spring and damper oscillates unstably: the contact force switches between pressing and \
            releasing at high frequency.",
        verdict: ClaimVerdict::False,
        kind: Kind::Assertion,
        severity: Some(Severity::WrongStatement),
        evidence: Evidence::Certified,
        correct_statement: "At the default ζ = 1 it is stable for timeconst > (1+√2)h/2 = 1.2071 h. Below 2h one eigenvalue is negative: a \
            component that changes its sign every step and decays. Between 1.25h and 1.5h a contact, which cannot pull, starts to chatter.",
        argument: "w = h/timeconst: z² − (2 − 2w − w²)z + (1 − 2w) = 0. The determinant is 0 at 2h and negative below; decided in \
            rationals: decay at 1.9h, 1.5h, 1.25h, growth at 1.2h, and both sides of 1.2071h. Spectral radius 0.69906 at 1.5h. Replayed \
            contact: at rest with 1.5h, thrown up again and again with 1.2h.",
        controls: &["timeconst = 1.2h in place of all longer ones."],
        sources: &[STABILITY],
        check: stability,
    },
    Claim {
        id: "S6.omega-gt-1-over-2h",
        statement: "timeconst < 2h means ω₀ > 1/(2h): the constraint is faster than the step.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Exact,
        correct_statement: "For dampratio 1. Since ω₀ = 1/(timeconst · dampratio), timeconst < 2h means ω₀ > 1/(2h · dampratio).",
        argument: "h = 1: timeconst = 3, dampratio 1/2: ω₀ = 2/3 > 1/2 although timeconst ≥ 2h; timeconst = 1, dampratio 4: ω₀ = 1/4 < 1/2 \
            although timeconst < 2h. With dampratio 1, timeconst 199/100 and 201/100 lie on the two sides.",
        controls: &["dampratio 1 in place of 1/2 and 4."],
        sources: &[STABILITY],
        check: faster_than_the_step,
    },
    Claim {
        id: "S6.steps-per-period",
        statement: "timeconst ≥ 2h guarantees that each period of the constraint is resolved by at least a few steps.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Certified,
        correct_statement: "The undamped period 2π/ω₀ has 2π ζ timeconst/h ≥ 4πζ steps: 12.6 at ζ = 1, 1.26 at ζ = 1/10, where the rule \
            does not prevent divergence (S6.timeconst-2h-doc).",
        argument: "h ω₀ = 1/(2ζ) at timeconst = 2h, in rationals from the coefficients: 1/2 at ζ = 1, 5 at ζ = 1/10; three steps per \
            period need hω₀ < 2π/3 < 21/10.",
        controls: &["ζ = 1 in place of 1/10."],
        sources: &[STABILITY],
        check: period,
    },
    Claim {
        id: "S6.2h-example",
        statement: "At h = 2 ms timeconst must be at least 4 ms; the default 20 ms is far above that, so it is safe.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: "As stated, at dampratio 1: the default has w = h/timeconst = 1/10 against the bound 0.828.",
        argument: "Powers of the step matrix at w = 1/10 and at w = 1/2 decay; 20 ms is not moved by the limit, 3 ms is.",
        controls: &["timeconst 2 ms in place of 4 ms."],
        sources: &[STABILITY],
        check: example,
    },
    Claim {
        id: "S6.stiff-needs-small-h",
        statement: "Setting timeconst extremely small against penetration makes the simulation explode or jitter violently unless the step \
            shrinks too.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Certified,
        correct_statement: "Without the limit of refsafe, or in the direct form. By default MuJoCo raises timeconst to 2h: a smaller one \
            changes nothing, neither stability nor depth.",
        argument: "Ball of 1 kg dropped from 1 mm on the replayed contact, h = 1 ms, constant impedance: timeconst = h/2 throws it higher \
            than it fell from without the limit, and not with a tenth of the step; with the limit it rests, at the same depth for \
            timeconst = h/2, h and 2h.",
        controls: &["The unlimited contact in the place of the limited one."],
        sources: &["chapter §6, pitfall on stiffness", REFSAFE],
        check: stiff,
    },
    Claim {
        id: "S6.ex2-tc-eq-h",
        statement: "Exercise: which numerical phenomenon occurs when timeconst is reduced to 2 ms, equal to the step?",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Exercise,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Certified,
        correct_statement: "By default nothing, for it counts as 4 ms. Without refsafe a two-sided row oscillates with alternating sign \
            and grows by the golden ratio, 1.618, every step; a contact is thrown up.",
        argument: "w = 1, ζ = 1: trace −1, determinant −1, z² + z − 1 = 0, z = −(1+√5)/2.",
        controls: &["refsafe off."],
        sources: &["chapter §6, exercise 2", REFSAFE],
        check: equal_to_the_step,
    },
];

/// k and b of `solref` = (t_c, ζ) at h = 2 ms.
fn at_two_milliseconds(milliseconds: i64, limited: bool) -> SoftReference<Rational> {
    let (time, one) = (ratio(milliseconds, 1000), ratio(1, 1));
    match limited {
        true => SoftReference::limited(&time, &one, &ratio(2, 1000), SoftImpedance::standard()),
        false => SoftReference::unlimited(&time, &one, SoftImpedance::standard()),
    }
}

fn enforced(reading: Reading) -> Result<Vec<Finding>> {
    let limit = at_two_milliseconds(4, false);
    let mut findings = Vec::new();
    for milliseconds in [1, 2, 3] {
        let same = at_two_milliseconds(milliseconds, true) == limit;
        findings.push(Finding::decision(format!("timeconst {milliseconds} ms counts as 4 ms"), same, true));
    }
    let stable = |hundredths: i64| {
        let zeta = ratio(hundredths, 100);
        is_stable(&SEMI_IMPLICIT, &zeta, &(ratio(1, 2) / &zeta))
    };
    for hundredths in [100, 36] {
        findings.push(Finding::decision(format!("stable at timeconst = 2h, ζ = {hundredths}/100"), stable(hundredths), true));
    }
    for hundredths in [35, 20] {
        let name = format!("stable at timeconst = 2h, ζ = {hundredths}/100");
        let found = stable(reading.pick(hundredths, 40));
        findings.push(Finding::decision(name, found, false).says(true).violating("dampratio above 1/(2√2)"));
    }
    Ok(findings)
}

/// What becomes of the powers at t_c = `tenths` h/100, ζ = 1.
fn powers_with(hundredths: i64) -> Powers {
    powers_at(&SEMI_IMPLICIT, &ratio(1, 1), &ratio(100, hundredths))
}

fn stability(reading: Reading) -> Result<Vec<Finding>> {
    let one = ratio(1, 1);
    let mut findings = Vec::new();
    for hundredths in [190, 150, 125] {
        let decays = powers_with(reading.pick(hundredths, 120)) == Powers::Decay;
        findings.push(Finding::decision(format!("t_c = {hundredths}/100 h decays"), decays, true).says(false));
    }
    findings.push(Finding::decision("t_c = 120/100 h grows", powers_with(120) == Powers::GrowExponentially, true));
    let bound = closed::semi_implicit(1.0);
    let [below, above] = both_sides("critical damping", &SEMI_IMPLICIT, 1.0, reading.pick(bound, 100.0 / 120.0));
    findings.extend([below.says(false), above]);
    let critical = |w: &Rational| matrix(&SEMI_IMPLICIT, &SpringDamper::of_ratio(one.clone()), w);
    let [_, under] = invariants(&critical(&ratio(100, 199)));
    let [_, at] = invariants(&critical(&ratio(1, 2)));
    let radius = spectral_radius(&critical(&reading.pick(ratio(2, 3), ratio(5, 6))).map(|entry| Scalar::to_f64(&entry)));
    // trace 2 − 4/3 − 4/9 = 2/9 and determinant −1/3: 1/9 + √(1/81 + 1/3)
    let expected = (1.0 + 28f64.sqrt()) / 9.0;
    let speed = |parts: f64| land(&unlimited_contact(0.001, parts * 0.001), 0.001, 2000).speed;
    let (step, jitter) = (tolerance::rest_speed(GRAVITY, 0.001), GRAVITY * 0.001);
    findings.extend([
        Finding::exact("determinant at t_c = 2h", &at, &ratio(0, 1), "1").context(),
        Finding::decision("determinant negative at 1.99h", under < ratio(0, 1), true),
        Finding::equal("spectral radius at t_c = 1.5h", radius, expected, rounding(16, 1.0), "1").says_at_least(1.0),
        Finding::equal("speed of a ball at rest, t_c = 1.5h", speed(reading.pick(1.5, 1.2)), 0.0, step, "m/s").says_at_least(jitter),
        Finding::at_least("speed with t_c = 1.25h", speed(1.25), jitter, "m/s"),
        Finding::at_least("speed with t_c = 1.2h", speed(1.2), jitter, "m/s"),
    ]);
    Ok(findings)
}

/// Whether ω₀ > 1/(2h) with h = 1 s, from d² k = ω₀².
fn is_faster(time_constant: &Rational, zeta: &Rational) -> bool {
    let unit = SoftReference::unlimited(time_constant, zeta, SoftImpedance::standard());
    unit.effective(&ratio(1, 1))[0] > ratio(1, 4)
}

fn faster_than_the_step(reading: Reading) -> Result<Vec<Finding>> {
    let one = ratio(1, 1);
    let [light, heavy] = [ratio(1, 2), ratio(4, 1)].map(|zeta| reading.pick(zeta, one.clone()));
    Ok(vec![
        Finding::decision("ω₀ > 1/(2h) at timeconst 3h, ζ = 1/2", is_faster(&ratio(3, 1), &light), true)
            .says(false)
            .violating("dampratio 1"),
        Finding::decision("ω₀ > 1/(2h) at timeconst h, ζ = 4", is_faster(&one, &heavy), false).says(true).violating("dampratio 1"),
        Finding::decision("ω₀ > 1/(2h) at timeconst 1.99h, ζ = 1", is_faster(&ratio(199, 100), &one), true),
        Finding::decision("ω₀ > 1/(2h) at timeconst 2.01h, ζ = 1", is_faster(&ratio(201, 100), &one), false),
    ])
}

fn period(reading: Reading) -> Result<Vec<Finding>> {
    // h = 1 s, t_c = 2h: (hω₀)² from the coefficients
    let square =
        |zeta: &Rational| SoftReference::unlimited(&ratio(2, 1), zeta, SoftImpedance::standard()).effective(&ratio(1, 1))[0].clone();
    let light = square(&reading.pick(ratio(1, 10), ratio(1, 1)));
    let critical = square(&ratio(1, 1));
    let three_steps = ratio(21 * 21, 100);
    let steps = std::f64::consts::TAU / Scalar::to_f64(&critical).sqrt();
    Ok(vec![
        Finding::decision("three steps per period at ζ = 1/10", light < three_steps, false).says(true).violating("dampratio 1"),
        Finding::decision("three steps per period at ζ = 1", critical < three_steps, true),
        Finding::exact("(hω₀)² at ζ = 1", &critical, &ratio(1, 4), "1"),
        Finding::equal("steps per period at ζ = 1", steps, 4.0 * std::f64::consts::PI, rounding(4, steps), "1"),
    ])
}

fn example(reading: Reading) -> Result<Vec<Finding>> {
    let decays = |milliseconds: i64| powers_with(50 * milliseconds) == Powers::Decay;
    let moved = |milliseconds: i64| at_two_milliseconds(milliseconds, true) != at_two_milliseconds(milliseconds, false);
    Ok(vec![
        Finding::decision("timeconst 4 ms decays", decays(reading.pick(4, 2)), true),
        Finding::decision("timeconst 20 ms decays", decays(20), true),
        Finding::decision("the limit moves 20 ms", moved(20), false),
        Finding::decision("the limit moves 4 ms", moved(4), false),
        Finding::decision("the limit moves 3 ms", moved(3), true),
    ])
}

fn stiff(reading: Reading) -> Result<Vec<Finding>> {
    let (h, height) = (0.001, 0.001);
    let unlimited = unlimited_contact(h, 0.5 * h);
    let limited = limited_contact(h, 0.5 * h);
    let smaller_step = unlimited_contact(0.1 * h, 0.5 * h);
    let depth = |parts: f64| land(&limited_contact(h, parts * h), height, 3000).depth;
    let asked = reading.pick(&limited, &unlimited);
    Ok(vec![
        Finding::at_least("height reached after a drop from 1 mm, t_c = h/2, no limit", land(&unlimited, height, 2000).height, height, "m"),
        Finding::at_most("height reached with h/10 and the same t_c, no limit", land(&smaller_step, height, 20_000).height, 0.0, "m"),
        Finding::at_most("height reached with the limit, t_c = h/2", land(asked, height, 2000).height, 0.0, "m")
            .says_at_least(height)
            .violating("refsafe is off"),
        Finding::equal("depth with the limit, t_c = h/2", depth(0.5), depth(2.0), 0.0, "m").context(),
        Finding::equal("depth with the limit, t_c = h", depth(1.0), depth(2.0), 0.0, "m").context(),
    ])
}

fn equal_to_the_step(reading: Reading) -> Result<Vec<Finding>> {
    let step = matrix(&SEMI_IMPLICIT, &SpringDamper::of_ratio(ratio(1, 1)), &ratio(1, 1));
    let [trace, determinant] = invariants(&step);
    let radius = spectral_radius(&step.map(|entry| Scalar::to_f64(&entry)));
    let golden = 0.5 * (1.0 + 5f64.sqrt());
    let speed = land(&unlimited_contact(0.002, 0.002), 0.001, 1000).speed;
    let changes = at_two_milliseconds(2, reading.pick(true, false)) != at_two_milliseconds(4, false);
    Ok(vec![
        Finding::exact("trace", &trace, &ratio(-1, 1), "1").context(),
        Finding::exact("determinant", &determinant, &ratio(-1, 1), "1").context(),
        Finding::equal("spectral radius without refsafe", radius, golden, rounding(8, 2.0), "1"),
        Finding::at_least("speed of a ball on such a contact", speed, GRAVITY * 0.002, "m/s"),
        Finding::decision("timeconst 2 ms is another contact than 4 ms", changes, false).says(true).violating("refsafe is off"),
    ])
}
