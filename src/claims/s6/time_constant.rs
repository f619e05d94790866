//! The rule timeconst ≥ 2h: what it keeps away from, what it guarantees, and for which damping ratios.

use crate::claims::experiments::soft::{GRAVITY, land, limited_contact, unlimited_contact};
use crate::claims::experiments::spring_damper::{SEMI_IMPLICIT, both_sides, is_stable, matrix, powers_at};
use crate::claims::prelude::*;
use crate::closed_forms::mujoco_normal::NormalContact;
use crate::closed_forms::soft_impedance::SoftImpedance;
use crate::closed_forms::soft_reference::SoftReference;
use crate::closed_forms::spring_damper as closed;
use crate::integrators::stability::{Powers, invariants, spectral_radius};
use crate::integrators::{SpringDamper, Theta};
use crate::tolerance::claims::pathology as tolerance;
use crate::tolerance::rounding;

const STABILITY: &str = "chapter §6, why timeconst must be at least 2h";
const REFSAFE: &str = "MuJoCo documentation, option flag refsafe (3.17)";

pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S6.timeconst-2h-doc",
        statement: r"timeconst $\ge 2h$ is a hard recommendation of MuJoCo's documentation; behind it stands numerical stability.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Exact,
        correct_statement: r"MuJoCo enforces it: with refsafe, the default, a smaller timeconst counts as $2h$. The direct form
            (−stiffness, −damping) is not limited. It keeps contacts with dampratio $> 1/(2\sqrt2) = 0.354$ stable, and no others.",
        argument: r"$h = 2$ ms: timeconst 1, 2 and 3 ms have the $k$ and $b$ of 4 ms, in rationals. At timeconst $= 2h$,
            $s = h\omega_0 = 1/(2\zeta)$, which is below the bound $2(\sqrt{1 + \zeta^2} - \zeta)$ for $\zeta$ above $1/(2\sqrt2)$:
            decided at $\zeta = 36/100$ and 35/100.",
        controls: &["dampratio 0.4 in place of 0.35 and 0.2.", r"refsafe off and timeconst $= h$."],
        sources: &[STABILITY, REFSAFE],
        check: check!(enforced),
    },
    Claim {
        id: "S6.timeconst-lt-2h-unstable",
        statement: r"If timeconst $< 2h$, the discrete spring and damper oscillates unstably: the contact force switches between pressing
            and releasing at high frequency.",
        verdict: ClaimVerdict::False,
        kind: Kind::Assertion,
        severity: Some(Severity::WrongStatement),
        evidence: Evidence::Certified,
        correct_statement: r"At the default $\zeta = 1$ it is stable for timeconst $> (1 + \sqrt2)h/2 = 1.2071\,h$. Below $2h$ one
            eigenvalue is negative: a component that changes its sign every step and decays. Between $1.25h$ and $1.5h$ a contact, which
            cannot pull, starts to chatter.",
        argument: r"$w = h$/timeconst: $z^2 - (2 - 2w - w^2)z + (1 - 2w) = 0$. The determinant is 0 at $2h$ and negative below; decided in
            rationals: decay at $1.9h$, $1.5h$, $1.25h$, growth at $1.2h$, and both sides of $1.2071h$. Spectral radius 0.69906 at $1.5h$.
            Replayed contact: at rest with $1.5h$, thrown up again and again with $1.2h$.",
        controls: &[
            r"timeconst $= 1.2h$ in place of all longer ones.",
            "The implicit rule in place of the semi-implicit one, and refsafe on.",
        ],
        sources: &[STABILITY],
        check: check!(stability),
    },
    Claim {
        id: "S6.omega-gt-1-over-2h",
        statement: r"timeconst $< 2h$ means $\omega_0 > 1/(2h)$: the constraint is faster than the step.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Exact,
        correct_statement: r"For dampratio 1. Since $\omega_0 = 1$/(timeconst · dampratio), timeconst $< 2h$ means $\omega_0 > 1$/($2h$ ·
            dampratio).",
        argument: r"$h = 1$: timeconst $= 3$, dampratio 1/2: $\omega_0 > 1/(2h)$ although timeconst $\ge 2h$; timeconst $= 1$, dampratio
            4: $\omega_0 < 1/(2h)$ although timeconst $< 2h$. With dampratio 1, timeconst 199/100 and 201/100 lie on the two sides.",
        controls: &[
            "dampratio 1 in place of 1/2 and 4.",
            r"The impedance of the surface in place of $d_w$, with which the row is softer.",
            r"The step doubled, $h = 2$.",
        ],
        sources: &[STABILITY],
        check: check!(faster_than_the_step),
    },
    Claim {
        id: "S6.steps-per-period",
        statement: r"timeconst $\ge 2h$ guarantees that each period of the constraint is resolved by at least a few steps.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Certified,
        correct_statement: r"The undamped period $2\pi/\omega_0$ has $2\pi\,\zeta$ timeconst/$h \ge 4\pi\zeta$ steps: 12.6 at $\zeta = 1$,
            1.26 at $\zeta = 1/10$, where the rule does not prevent divergence (S6.timeconst-2h-doc).",
        argument: r"$h\,\omega_0 = 1/(2\zeta)$ at timeconst $= 2h$, in rationals from the coefficients: 1/2 at $\zeta = 1$, 5 at
            $\zeta = 1/10$; three steps per period need $h\omega_0 < 2\pi/3 < 21/10$.",
        controls: &[r"$\zeta = 1$ in place of 1/10.", r"timeconst $= h/4$, against the rule."],
        sources: &[STABILITY],
        check: check!(period),
    },
    Claim {
        id: "S6.2h-example",
        statement: r"At $h = 2$ ms timeconst must be at least 4 ms; the default 20 ms is far above that, so it is safe.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"As stated, at dampratio 1: the default has $w = h$/timeconst $= 1/10$ against the bound 0.828.",
        argument: r"Powers of the step matrix at $w = 1/10$ and at $w = 1/2$ decay; 20 ms is not moved by the limit, 3 ms is.",
        controls: &["timeconst 2 ms in place of 4 ms.", r"$h = 20$ ms in place of 2 ms."],
        sources: &[STABILITY],
        check: check!(example),
    },
    Claim {
        id: "S6.stiff-needs-small-h",
        statement: "Setting timeconst extremely small against penetration makes the simulation explode or jitter violently unless the step \
            shrinks too.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Certified,
        correct_statement: r"Without the limit of refsafe, or in the direct form. By default MuJoCo raises timeconst to $2h$: a smaller
            one changes nothing, neither stability nor depth.",
        argument: r"Ball of 1 kg dropped from 1 mm on the replayed contact, $h = 1$ ms, constant impedance: timeconst $= h/2$ throws it
            higher than it fell from without the limit, and not with a tenth of the step; with the limit it rests, at the same depth for
            timeconst $= h/2$, $h$ and $2h$.",
        controls: &["The unlimited contact in the place of the limited one.", "The step and its tenth exchanged."],
        sources: &["chapter §6, pitfall on stiffness", REFSAFE],
        check: check!(stiff),
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
        argument: r"$w = 1$, $\zeta = 1$: trace −1, determinant −1, $z^2 + z - 1 = 0$, $z = -(1 + \sqrt5)/2$.",
        controls: &["refsafe off.", r"The default timeconst, $10h$, in place of $h$."],
        sources: &["chapter §6, exercise 2", REFSAFE],
        check: check!(equal_to_the_step),
    },
];

/// k and b of `solref` = (t_c, ζ) at h = 2 ms.
fn at_two_milliseconds(milliseconds: i64, limited: bool) -> SoftReference<Rational> {
    let (time, one) = (ratio(milliseconds, 1000), ratio(1, 1));
    match limited {
        true => with_limit(milliseconds, 2),
        false => SoftReference::unlimited(&time, &one, SoftImpedance::standard()),
    }
}

/// k and b of `solref` = (t_c, 1) with refsafe at a step, both in milliseconds.
fn with_limit(milliseconds: i64, h: i64) -> SoftReference<Rational> {
    SoftReference::limited(&ratio(milliseconds, 1000), &ratio(1, 1), &ratio(h, 1000), SoftImpedance::standard())
}

fn enforced(reading: Reading) -> Result<Vec<Finding>> {
    let limit = at_two_milliseconds(4, false);
    let refsafe = reading.only(1).pick(true, false);
    let same = [1, 2, 3].iter().all(|milliseconds| at_two_milliseconds(*milliseconds, refsafe) == limit);
    let mut findings = vec![Finding::decision("timeconst 1, 2 and 3 ms count as 4 ms", same, true)];
    // h/timeconst
    let share = reading.only(1).pick(ratio(1, 2), ratio(1, 1));
    let stable = |zeta: &Rational| is_stable(&SEMI_IMPLICIT, zeta, &(&share / zeta));
    for zeta in [ratio(1, 1), ratio(36, 100)] {
        findings.push(Finding::decision(format!("stable at timeconst = 2h, ζ = {zeta}"), stable(&zeta), true));
    }
    for zeta in [ratio(35, 100), ratio(20, 100)] {
        let name = format!("stable at timeconst = 2h, ζ = {zeta}");
        let found = stable(&reading.only(0).pick(zeta, ratio(40, 100)));
        findings.push(Finding::decision(name, found, false).says(true).violating("dampratio above 1/(2√2)"));
    }
    Ok(findings)
}

/// What becomes of the powers at ζ = 1 and h/t_c.
fn powers_with(share: &Rational) -> Powers {
    powers_at(&SEMI_IMPLICIT, &ratio(1, 1), share)
}

fn stability(reading: Reading) -> Result<Vec<Finding>> {
    let one = ratio(1, 1);
    let shorter = |time: Rational| reading.only(0).pick(time, ratio(6, 5));
    let implicit = Theta { theta: ratio(1, 1) };
    let step = |share: &Rational| match reading {
        Reading::Control(1) => matrix(&implicit, &SpringDamper::of_ratio(one.clone()), share),
        _ => matrix(&SEMI_IMPLICIT, &SpringDamper::of_ratio(one.clone()), share),
    };
    let powers = |share: &Rational| match reading {
        Reading::Control(1) => powers_at(&implicit, &one, share),
        _ => powers_with(share),
    };
    let mut findings = Vec::new();
    for time in [ratio(19, 10), ratio(3, 2), ratio(5, 4)] {
        let decays = powers(&(&one / shorter(time.clone()))) == Powers::Decay;
        findings.push(Finding::decision(format!("t_c = {time} h decays"), decays, true).says(false));
    }
    findings.push(Finding::decision("t_c = 6/5 h grows", powers(&ratio(5, 6)) == Powers::GrowExponentially, true));
    let bound = closed::semi_implicit(1.0);
    let place = reading.only(0).pick(bound, 5.0 / 6.0);
    let [below, above] = match reading {
        Reading::Control(1) => both_sides("critical damping", &implicit, 1.0, place),
        _ => both_sides("critical damping", &SEMI_IMPLICIT, 1.0, place),
    };
    findings.extend([below.says(false), above]);
    let [_, under] = invariants(&step(&ratio(100, 199)));
    let [_, at] = invariants(&step(&ratio(1, 2)));
    let radius = spectral_radius(&step(&(&one / shorter(ratio(3, 2)))).map(|entry| Scalar::to_f64(&entry)));
    // trace 2 − 4/3 − 4/9 = 2/9 and determinant −1/3: 1/9 + √(1/81 + 1/3)
    let expected = (1.0 + 28f64.sqrt()) / 9.0;
    let contact = reading.only(1).pick(unlimited_contact as fn(f64, f64) -> NormalContact, limited_contact);
    let speed = |time: &Rational| land(&contact(0.001, Scalar::to_f64(time) * 0.001), 0.001, 2000).speed;
    let (rest, jitter) = (tolerance::rest_speed(GRAVITY, 0.001), GRAVITY * 0.001);
    findings.extend([
        Finding::equal("bound of t_c/h", 1.0 / bound, 0.5 * (1.0 + 2f64.sqrt()), rounding(4, 2.0), "1").context(),
        Finding::exact("determinant at t_c = 2h", &at, &ratio(0, 1), "1").context(),
        Finding::decision("determinant negative at 1.99h", under < ratio(0, 1), true),
        Finding::equal("spectral radius at t_c = 1.5h", radius, expected, rounding(16, 1.0), "1").says_at_least(1.0),
        Finding::equal("speed of a ball at rest, t_c = 1.5h", speed(&shorter(ratio(3, 2))), 0.0, rest, "m/s").says_at_least(jitter),
        Finding::at_least("speed with t_c = 1.25h", speed(&ratio(5, 4)), jitter, "m/s"),
        Finding::at_least("speed with t_c = 1.2h", speed(&ratio(6, 5)), jitter, "m/s"),
    ]);
    Ok(findings)
}

/// Whether ω₀ > 1/(2h), from d² k = ω₀² at a depth \[m\].
fn is_faster(time_constant: &Rational, zeta: &Rational, depth: &Rational, h: &Rational) -> bool {
    let unit = SoftReference::unlimited(time_constant, zeta, SoftImpedance::standard());
    unit.effective(depth)[0] > ratio(1, 4) / (h * h)
}

fn faster_than_the_step(reading: Reading) -> Result<Vec<Finding>> {
    let one = ratio(1, 1);
    let [light, heavy] = [ratio(1, 2), ratio(4, 1)].map(|zeta| reading.only(0).pick(zeta, one.clone()));
    let depth = reading.only(1).pick(one.clone(), ratio(0, 1));
    let h = reading.only(2).pick(one.clone(), ratio(2, 1));
    let faster = |time_constant: Rational, zeta: &Rational| is_faster(&time_constant, zeta, &depth, &h);
    Ok(vec![
        Finding::decision("ω₀ > 1/(2h) at timeconst 3h, ζ = 1/2", faster(ratio(3, 1), &light), true).says(false).violating("dampratio 1"),
        Finding::decision("ω₀ > 1/(2h) at timeconst h, ζ = 4", faster(one.clone(), &heavy), false).says(true).violating("dampratio 1"),
        Finding::decision("ω₀ > 1/(2h) at timeconst 1.99h, ζ = 1", faster(ratio(199, 100), &one), true),
        Finding::decision("ω₀ > 1/(2h) at timeconst 2.01h, ζ = 1", faster(ratio(201, 100), &one), false),
    ])
}

fn period(reading: Reading) -> Result<Vec<Finding>> {
    // h = 1 s, t_c = 2h: (hω₀)² from the coefficients
    let time = reading.only(1).pick(ratio(2, 1), ratio(1, 4));
    let square = |zeta: &Rational| SoftReference::unlimited(&time, zeta, SoftImpedance::standard()).effective(&ratio(1, 1))[0].clone();
    let light = square(&reading.only(0).pick(ratio(1, 10), ratio(1, 1)));
    let critical = square(&ratio(1, 1));
    let three_steps = ratio(21, 10) * ratio(21, 10);
    let steps = std::f64::consts::TAU / Scalar::to_f64(&critical).sqrt();
    Ok(vec![
        Finding::decision("three steps per period at ζ = 1/10", light < three_steps, false).says(true).violating("dampratio 1"),
        Finding::decision("three steps per period at ζ = 1", critical < three_steps, true),
        Finding::exact("(hω₀)² at ζ = 1", &critical, &ratio(1, 4), "1"),
        Finding::equal("steps per period at ζ = 1", steps, 4.0 * std::f64::consts::PI, rounding(4, steps), "1"),
    ])
}

fn example(reading: Reading) -> Result<Vec<Finding>> {
    let h = reading.only(1).pick(2, 20);
    let decays = |milliseconds: i64| powers_with(&ratio(h, milliseconds)) == Powers::Decay;
    let moved = |milliseconds: i64| with_limit(milliseconds, h) != at_two_milliseconds(milliseconds, false);
    Ok(vec![
        Finding::decision("timeconst 4 ms decays", decays(reading.only(0).pick(4, 2)), true),
        Finding::decision("timeconst 20 ms decays", decays(20), true),
        Finding::decision("of 3, 4 and 20 ms the limit moves the first alone", [3, 4, 20].map(moved) == [true, false, false], true),
    ])
}

fn stiff(reading: Reading) -> Result<Vec<Finding>> {
    let (h, height) = (0.001, 0.001);
    let unlimited = unlimited_contact(h, 0.5 * h);
    let limited = limited_contact(h, 0.5 * h);
    let smaller_step = unlimited_contact(0.1 * h, 0.5 * h);
    let depth = |parts: f64| land(&limited_contact(h, parts * h), height, 3000).depth;
    let asked = reading.only(0).pick(&limited, &unlimited);
    let [coarse, fine] = reading.only(1).pick([(&unlimited, 2000), (&smaller_step, 20_000)], [(&smaller_step, 20_000), (&unlimited, 2000)]);
    let reached = |(contact, steps): (&NormalContact, usize)| land(contact, height, steps).height;
    Ok(vec![
        Finding::at_least("height reached after a drop from 1 mm, t_c = h/2, no limit", reached(coarse), height, "m"),
        Finding::at_most("height reached with h/10 and the same t_c, no limit", reached(fine), 0.0, "m"),
        Finding::at_most("height reached with the limit, t_c = h/2", land(asked, height, 2000).height, 0.0, "m")
            .says_at_least(height)
            .violating("refsafe is off"),
        Finding::equal("depth with the limit, t_c = h/2", depth(0.5), depth(2.0), 0.0, "m").context(),
        Finding::equal("depth with the limit, t_c = h", depth(1.0), depth(2.0), 0.0, "m").context(),
    ])
}

fn equal_to_the_step(reading: Reading) -> Result<Vec<Finding>> {
    let share = reading.only(1).pick(ratio(1, 1), ratio(1, 10));
    let step = matrix(&SEMI_IMPLICIT, &SpringDamper::of_ratio(ratio(1, 1)), &share);
    let [trace, determinant] = invariants(&step);
    let radius = spectral_radius(&step.map(|entry| Scalar::to_f64(&entry)));
    let golden = 0.5 * (1.0 + 5f64.sqrt());
    let tenfold = reading.only(1).pick(1.0, 10.0);
    let speed = land(&unlimited_contact(0.002, tenfold * 0.002), 0.001, 1000).speed;
    let changes = at_two_milliseconds(2, reading.only(0).pick(true, false)) != at_two_milliseconds(4, false);
    Ok(vec![
        Finding::exact("trace", &trace, &ratio(-1, 1), "1").context(),
        Finding::exact("determinant", &determinant, &ratio(-1, 1), "1").context(),
        Finding::equal("spectral radius without refsafe", radius, golden, rounding(8, 2.0), "1"),
        Finding::at_least("speed of a ball on such a contact", speed, GRAVITY * 0.002, "m/s"),
        Finding::decision("timeconst 2 ms is another contact than 4 ms", changes, false).says(true).violating("refsafe is off"),
    ])
}
