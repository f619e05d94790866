//! `solref`: the virtual spring and damper behind the reference acceleration, and its damping.

use crate::claims::experiments::soft::rebound;
use crate::claims::prelude::*;
use crate::closed_forms::mujoco_contact::ContactParameters;
use crate::closed_forms::mujoco_normal::spring_damper_restitution;
use crate::closed_forms::soft_impedance::SoftImpedance;
use crate::closed_forms::soft_reference::SoftReference;
use crate::tolerance::gate::ball::{OSCILLATOR_PARTS, oscillator_rebound};
use crate::tolerance::rounding;

const DOCUMENTATION: &str = "MuJoCo documentation, Modeling: solver parameters (3.17)";

pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S6.aref-form",
        statement: r"The reference acceleration is that of a virtual spring and damper, with stiffness $k_p$ and damping $k_d$.",
        verdict: ClaimVerdict::True,
        kind: Kind::Definition,
        severity: None,
        evidence: Evidence::Certified,
        correct_statement: r"As stated: $a_\text{ref} = -b\,\dot\varphi - k\,d\,\varphi$. The stiffness $k\,d$ depends on the depth
            through the impedance $d$, so that the spring is linear only where $d$ is constant.",
        argument: r"Default parameters, $\varphi = -1$ mm, $\dot\varphi = -3/10$ m/s: $a_\text{ref} = 650/19 = 34.2105$ m/s², in
            rationals, and from the rounded formula that reproduces the stored runs of MuJoCo. The stiffness at half a millimetre is
            another one.",
        controls: &[r"$\dot\varphi = +3/10$ m/s, with the damper's sign reversed."],
        sources: &["chapter §6, step 3", DOCUMENTATION],
        check: check!(form),
    },
    Claim {
        id: "S6.solref-meaning",
        statement: r"solref = (timeconst, dampratio) defines time constant and damping ratio of the virtual spring and damper, as natural
            frequency and damping ratio, with $\omega_0 = 1$/timeconst (so in the rule timeconst $\ge 2h$, and in §8 where that rule comes
            from).",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Exact,
        correct_statement: r"$\omega_0 = 1$/(timeconst · dampratio), so 1/timeconst only at dampratio 1; the frequency and the ratio are
            those of an unloaded row where $d = d_w$. A negative solref means (−stiffness, −damping) per mass.",
        argument: r"From $d^2\,k = \omega_0^2$ and $d\,b = 2\zeta\omega_0$ at $d = d_w$, in rationals: $(1/50\,\mathrm{s}, 1)$ has
            $\omega_0 = 50$ 1/s; $(1/50, 1/2)$ has $\omega_0 = 100$, $\zeta = 1/2$; $(1/50, 2)$ has $\omega_0^2 = 625$. $(-2500, -100)$ is
            the same as $(1/50, 1)$.",
        controls: &["dampratio 1 in place of 1/2 and 2.", r"The surface, where $d = d_0$, in place of a depth beyond the width."],
        sources: &["chapter §6, step 3 and the numerical example of solref", DOCUMENTATION],
        check: check!(meaning),
    },
    Claim {
        id: "S6.kp-kd",
        statement: r"The default solref $= (0.02, 1)$ means $k_p = \omega_0^2 = 2500$ and $k_d = 2\zeta\omega_0 = 100$ per unit of
            effective mass.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Exact,
        correct_statement: r"They are $d^2\,k$ and $d\,b$, the coefficients of the motion of a row that carries no load, from a depth of 1
            mm on, where $d = d_w$. At the surface, $d = 9/10$, they are $810000/361 = 2243.77$ 1/s² and $1800/19 = 94.74$ 1/s.",
        argument: r"MuJoCo's $k$ and $b$, which it divides by $d_w$, and the default impedance, in rationals at depths of 0, 1/2, 1 and 5
            mm.",
        controls: &[
            "A depth of 1 mm in place of 1/2 mm and the surface.",
            r"2500 and 100 taken for the coefficients of $a_\text{ref}$ at $d_w$: $k\,d_w = 2500$, $b = 100$.",
        ],
        sources: &["chapter §6, numerical example of solref", DOCUMENTATION],
        check: check!(effective),
    },
    Claim {
        id: "S6.aref-2500-100",
        statement: r"With the default parameters $a_\text{ref} = -2500\,\varphi - 100\,\dot\varphi$.",
        verdict: ClaimVerdict::False,
        kind: Kind::Assertion,
        severity: Some(Severity::WrongStatement),
        evidence: Evidence::Exact,
        correct_statement: r"$a_\text{ref} = -k\,d\,\varphi - b\,\dot\varphi$ with $b = 2000/19 = 105.26$ 1/s and $k\,d$ from
            $900000/361 = 2493.07$ 1/s² at the surface to $50000/19 = 2631.58$ from 1 mm on: MuJoCo divides by $d_w$ so that the motion,
            which is $d\,a_\text{ref}$, gets 2500 and 100 there.",
        argument: r"$\varphi = -1$ mm at rest: $a_\text{ref} = 50/19 = 2.632$ m/s², not 5/2. $\varphi = 0$, $\dot\varphi = -1$ m/s:
            2000/19 m/s², not 100. $d\,a_\text{ref}$ is 5/2 and 100 at $d = d_w$.",
        controls: &[r"solref $= (-2375, -95)$ with constant impedance 19/20, where the printed coefficients are right."],
        sources: &["chapter §6, numerical example of solref", DOCUMENTATION],
        check: check!(coefficients),
    },
    Claim {
        id: "S6.critical-no-overshoot",
        statement: r"Critical damping, $\zeta = 1$, pushes the violation back to zero without overshoot; it is the default because it
            returns fastest and does not oscillate.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Certified,
        correct_statement: r"Without overshoot for a two-sided row without load, pushed back from rest or hit. A contact cannot pull: an
            impact leaves the surface at $e^{-2} = 13.5$ % of its speed. Fastest holds for a given $\omega_0$; for a given timeconst,
            which is what solref holds fixed, every $\zeta \le 1$ decays at the same rate 1/timeconst.",
        argument: r"Characteristic polynomial $\lambda^2 + (2/t_c)\,\lambda + 1/(t_c\,\zeta)^2$: discriminant 0 at $\zeta = 1$, complex
            roots with real part $-1/t_c$ for $\zeta < 1$, at $\zeta = 5/4$ a root −2/5 of $1/t_c$. An impact at $\zeta = 1$ in steps of
            $2^{-14}$ of $1/\omega_0$: a two-sided row never comes back through the surface; the replay of MuJoCo's contact, constant
            impedance, rebounds at $e^{-2}$.",
        controls: &[
            "The two-sided row in place of the contact.",
            r"Half the damping ratio, as if the damping were $\zeta\omega_0$ and not $2\zeta\omega_0$.",
        ],
        sources: &[
            "chapter §6, numerical example of solref",
            "Schwager and Pöschel, Coefficient of restitution and linear–dashpot model revisited (2007)",
        ],
        check: check!(critical),
    },
    Claim {
        id: "S6.zeta-bounce",
        statement: r"$\zeta < 1$ is underdamped and bounces; $\zeta > 1$ returns more slowly.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Certified,
        correct_statement: r"As stated. The bounce of a contact falls with $\zeta$ without vanishing at 1: $e(\zeta) = \exp(-\zeta/\sqrt{1
            - \zeta^2} \cdot \operatorname{acos}(2\zeta^2 - 1))$, $e^{-2}$ at 1, and smaller beyond.",
        argument: r"Replay of MuJoCo's contact at $\zeta = 1/10$, 3/10, 1/2, 1, 2: rebound 0.74408, 0.45098, 0.29844, 0.13534, 0.04777.
            For $\zeta \le 1$ the violation decays as $1/t_c$; at $\zeta = 5/4$ the slower root is −2/5 of $1/t_c$.",
        controls: &[
            r"$1/\zeta$ in place of $\zeta$.",
            r"Half the damping ratio, as if the damping were $\zeta\omega_0$ and not $2\zeta\omega_0$.",
        ],
        sources: &["chapter §6, numerical example of solref", "Schwager and Pöschel (2007)"],
        check: check!(bounce),
    },
];

/// The default contact.
fn standard() -> SoftReference<Rational> {
    SoftReference::unlimited(&ratio(1, 50), &ratio(1, 1), SoftImpedance::standard())
}

fn millimetres(numerator: i64, denominator: i64) -> Rational {
    ratio(numerator, 1000 * denominator)
}

fn form(reading: Reading) -> Result<Vec<Finding>> {
    let (gap, rate) = (millimetres(-1, 1), reading.pick(ratio(-3, 10), ratio(3, 10)));
    let printed = Scalar::to_f64(&ratio(650, 19));
    let exact = standard().acceleration(&gap, &rate);
    let parameters = ContactParameters::default();
    let (stiffness, damping) = parameters.stiffness_and_damping(0.002);
    let rounded = stiffness * parameters.impedance_at(0.001) * 0.001 - damping * Scalar::to_f64(&rate);
    let [shallow, deep] = [millimetres(1, 2), millimetres(1, 1)].map(|depth| standard().coefficients(&depth)[0].clone());
    Ok(vec![
        Finding::exact("a_ref at φ = −1 mm", &exact, &ratio(650, 19), "m/s²"),
        Finding::equal("a_ref by the rounded formula", rounded, printed, rounding(16, printed), "m/s²"),
        Finding::decision("the stiffness is the same at half the depth", shallow == deep, false).context(),
    ])
}

/// ω₀² \[1/s²\] and 2ζω₀ \[1/s\] of `solref` = (1/50 s, ζ) at a depth.
fn at_depth(zeta: &Rational, depth: &Rational) -> [Rational; 2] {
    SoftReference::unlimited(&ratio(1, 50), zeta, SoftImpedance::standard()).effective(depth)
}

fn meaning(reading: Reading) -> Result<Vec<Finding>> {
    let one = ratio(1, 1);
    // 1/timeconst, squared, and with 2ζ before it
    let printed = |zeta: &Rational| [ratio(2500, 1), ratio(2, 1) * zeta * ratio(50, 1)];
    let depth = reading.only(1).pick(millimetres(5, 1), ratio(0, 1));
    let [square, twice] = at_depth(&one, &depth);
    let mut findings = vec![
        Finding::exact("ω₀² at ζ = 1", &square, &ratio(2500, 1), "1/s²").says(&printed(&one)[0]),
        Finding::exact("2ζω₀ at ζ = 1", &twice, &ratio(100, 1), "1/s").says(&printed(&one)[1]),
    ];
    for (zeta, expected, share, name) in [(ratio(1, 2), 10_000, ratio(2, 1), "1/2"), (ratio(2, 1), 625, ratio(1, 2), "2")] {
        let zeta = reading.only(0).pick(zeta, one.clone());
        let [square, twice] = at_depth(&zeta, &depth);
        let [stated, stated_twice] = printed(&zeta);
        findings
            .push(Finding::exact(format!("ω₀² at ζ = {name}"), &square, &ratio(expected, 1), "1/s²").says(stated).violating("dampratio 1"));
        findings.push(
            Finding::exact(format!("2ζω₀ over 2ζ/timeconst at ζ = {name}"), &(&twice / stated_twice), &share, "1")
                .says(ratio(1, 1))
                .violating("dampratio 1"),
        );
        findings.push(Finding::exact(format!("2ζω₀ at ζ = {name}"), &twice, &ratio(100, 1), "1/s").context());
    }
    let direct = SoftReference::direct(&ratio(2500, 1), &ratio(100, 1), SoftImpedance::standard());
    findings.push(Finding::decision("(−2500, −100) is (1/50, 1)", direct == standard(), true).context());
    Ok(findings)
}

fn effective(reading: Reading) -> Result<Vec<Finding>> {
    let (millimetre, half) = (millimetres(1, 1), ratio(37, 40));
    let undivided = SoftReference { stiffness: ratio(2500, 1) * ratio(20, 19), damping: ratio(100, 1), ..standard() };
    let contact = reading.only(1).pick(standard(), undivided);
    let mut findings = Vec::new();
    for (place, depth) in [("1 mm", millimetre.clone()), ("5 mm", millimetres(5, 1))] {
        let [k, b] = contact.effective(&depth);
        findings.push(Finding::exact(format!("d² k at {place}"), &k, &ratio(2500, 1), "1/s²"));
        findings.push(Finding::exact(format!("d b at {place}"), &b, &ratio(100, 1), "1/s"));
    }
    let within = [
        ("1/2 mm", millimetres(1, 2), &half * &half * ratio(1_000_000, 361), &half * ratio(2000, 19)),
        ("the surface", ratio(0, 1), ratio(810_000, 361), ratio(1800, 19)),
    ];
    for (place, depth, stiffness, damping) in within {
        let [k, b] = contact.effective(&reading.only(0).pick(depth, millimetre.clone()));
        let condition = "a depth of at least the width, where d = d_w";
        findings.push(Finding::exact(format!("d² k at {place}"), &k, &stiffness, "1/s²").says(ratio(2500, 1)).violating(condition));
        findings.push(Finding::exact(format!("d b at {place}"), &b, &damping, "1/s").says(ratio(100, 1)).violating(condition));
    }
    Ok(findings)
}

fn coefficients(reading: Reading) -> Result<Vec<Finding>> {
    let end = SoftImpedance::<Rational>::standard().at_width();
    let contact = match reading {
        Reading::Recorded => standard(),
        Reading::Control(_) => SoftReference::direct(&ratio(2375, 1), &ratio(95, 1), SoftImpedance::constant(end.clone())),
    };
    let pushed = contact.acceleration(&millimetres(-1, 1), &ratio(0, 1));
    let damped = contact.acceleration(&ratio(0, 1), &ratio(-1, 1));
    let [surface, _] = contact.coefficients(&ratio(0, 1));
    Ok(vec![
        Finding::exact("a_ref at φ = −1 mm and rest", &pushed, &ratio(50, 19), "m/s²").says(ratio(5, 2)),
        Finding::exact("a_ref at φ = 0, φ̇ = −1 m/s", &damped, &ratio(2000, 19), "m/s²").says(ratio(100, 1)),
        Finding::exact("k d at the surface", &surface, &ratio(900_000, 361), "1/s²").says(ratio(2500, 1)),
        Finding::exact("d_w a_ref at φ = −1 mm and rest", &(&end * pushed), &ratio(5, 2), "m/s²").context(),
        Finding::exact("d_w a_ref at φ = 0, φ̇ = −1 m/s", &(&end * damped), &ratio(100, 1), "m/s²").context(),
    ])
}

/// λ² + 2λ + 1/ζ², the characteristic polynomial in units of 1/t_c.
fn characteristic(rate: &Rational, zeta: &Rational) -> Rational {
    rate * rate + ratio(2, 1) * rate + ratio(1, 1) / (zeta * zeta)
}

/// A quarter of its discriminant.
fn discriminant(zeta: &Rational) -> Rational {
    ratio(1, 1) - ratio(1, 1) / (zeta * zeta)
}

fn rebound_at(zeta: f64) -> f64 {
    rebound(zeta, 1.0 / OSCILLATOR_PARTS as f64)
}

/// Speed [m/s] at which a row that may pull comes back through the surface after an impact at 1 m/s, in the steps of [`rebound_at`] and
/// units of ω₀ = 1; 0 if it does not within 40/ω₀.
fn two_sided_rebound(zeta: f64) -> f64 {
    let h = 1.0 / OSCILLATOR_PARTS as f64;
    let (mut depth, mut inwards) = (0.0, 1.0);
    for _ in 0..40 * OSCILLATOR_PARTS {
        inwards -= h * (depth + 2.0 * zeta * inwards);
        depth += h * inwards;
        if depth < 0.0 {
            return -inwards;
        }
    }
    0.0
}

fn critical(reading: Reading) -> Result<Vec<Finding>> {
    let share = reading.only(1).pick(ratio(1, 1), ratio(1, 2));
    let zeta = |numerator: i64, denominator: i64| ratio(numerator, denominator) * &share;
    let critical = Scalar::to_f64(&zeta(1, 1));
    let contact = match reading {
        Reading::Control(0) => two_sided_rebound(critical),
        _ => rebound_at(critical),
    };
    let zero = ratio(0, 1);
    let oscillates = [zeta(99, 100), zeta(1, 1), zeta(5, 4)].map(|zeta| discriminant(&zeta) < zero);
    Ok(vec![
        Finding::equal("rebound of an impact at 1 m/s, ζ = 1", contact, (-2.0f64).exp(), oscillator_rebound(1.0), "m/s")
            .says(0.0)
            .violating("the row may pull"),
        Finding::equal("rebound of an impact on a row that may pull, ζ = 1", two_sided_rebound(critical), 0.0, 0.0, "m/s"),
        Finding::exact("discriminant at ζ = 1", &discriminant(&zeta(1, 1)), &zero, "1/t_c²"),
        Finding::decision("of ζ = 99/100, 1 and 5/4 the first alone oscillates", oscillates == [true, false, false], true),
        Finding::exact("characteristic polynomial at −2/5 of 1/t_c, ζ = 5/4", &characteristic(&ratio(-2, 5), &zeta(5, 4)), &zero, "1/t_c²"),
    ])
}

fn bounce(reading: Reading) -> Result<Vec<Finding>> {
    let mut findings = Vec::new();
    let mut rebounds = Vec::new();
    for zeta in [0.1, 0.3, 0.5, 1.0, 2.0] {
        let subject = match reading {
            Reading::Recorded => zeta,
            Reading::Control(0) => 1.0 / zeta,
            Reading::Control(_) => 0.5 * zeta,
        };
        let measured = rebound_at(subject);
        let expected = spring_damper_restitution(zeta);
        findings.push(Finding::equal(format!("rebound at ζ = {zeta}"), measured, expected, oscillator_rebound(zeta), "m/s"));
        rebounds.push(measured);
    }
    let falls = rebounds.windows(2).all(|pair| pair[1] < pair[0]);
    let over = reading.only(0).pick(ratio(5, 4), ratio(4, 5)) * reading.only(1).pick(ratio(1, 1), ratio(1, 2));
    findings.push(Finding::decision("the rebound falls with ζ", falls, true));
    findings.push(Finding::decision(
        "ζ = 5/4 returns more slowly than 1/t_c, having two real roots about it",
        discriminant(&over) > ratio(0, 1),
        true,
    ));
    let root = characteristic(&ratio(-2, 5), &over);
    findings.push(Finding::exact("characteristic polynomial at −2/5 of 1/t_c, ζ = 5/4", &root, &ratio(0, 1), "1/t_c²"));
    Ok(findings)
}
