//! Jitter at rest: stiffness against step, sweeps, numerical damping; and the penetration of soft contact.

use crate::claims::experiments::curve::{Side, drift, slide};
use crate::claims::experiments::soft::{GRAVITY, default_contact, land, limited_contact, stiffest_contact, unlimited_contact};
use crate::claims::experiments::spring::energy_ratio;
use crate::claims::experiments::theta_energy::{SPRING, effect_of_theta_on_a_tower};
use crate::claims::experiments::tower::{Sweeps, Tower};
use crate::claims::prelude::*;
use crate::closed_forms::mujoco_contact::ContactParameters;
use crate::closed_forms::mujoco_normal::NormalContact;
use crate::schemes::{Activation, MoreauJean, RestitutionRule, Scheme, StewartTrinkle};
use crate::stabilisation::{Constrained, CoordinateProjection, Pendulum, Stabilisation, VelocityLevel, run};
use crate::tolerance::claims::pathology as tolerance;
use crate::tolerance::stabilisation::on_constraint;

pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S9.penetration-rigid-vs-soft",
        statement: "Not every penetration is a bug: that of soft contact (MuJoCo) is by design, set by solref and solimp; to reduce it, \
            stiffen and take smaller steps. That of velocity-level schemes is drift and needs projection.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Certified,
        correct_statement: r"As stated, of both measures together: the depth at rest is that of the soft law, independent of $h$, and a
            smaller step helps by allowing a stiffer contact, because MuJoCo keeps $t_c \ge 2h$; above $h = t_c/2$ the depth grows with
            $h^2$.",
        argument: r"Replay of MuJoCo's contact with default parameters, 1 kg laid on the floor: 3.6718e-4 m at $h = 0.0005$, 0.005 and
            0.01 s, 6.0156e-4 m at 0.015 s, 8.3329e-4 m at 0.02 s, where $t_c = 2h$ is larger than its default. With $t_c = 2h$ at
            $h = 0.001$ s: 4.3720e-6 m. A bead in a circle under Moreau–Jean leaves it by 4.963e-3 m in 1 s with $h = 0.01$ s, and with
            coordinate projection not at all.",
        controls: &[
            "The smaller step alone, with the default stiffness.",
            "A time constant of 0.05 s in place of the default.",
            "The position level (Stewart–Trinkle) for the bead, and nothing in place of its projection.",
        ],
        sources: &[
            "chapter §9, penetration, and the pitfall “every penetration is a bug”",
            "MuJoCo documentation, solver parameters (3.17); stored runs agree with the replay, see tests/references",
        ],
        check: check!(soft_penetration),
    },
    Claim {
        id: "S9.jitter",
        statement: r"Jitter of a stack at rest is almost always a numerical artefact: contact forces switch between pressing and releasing
            because the step is too large, the stiffness too high or the solver not converged. Cure: more iterations, more numerical
            damping ($\theta \to 1$), smaller steps, warm start.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Certified,
        correct_statement: r"Step and stiffness are one cause, $h/t_c$: a critically damped contact of constant impedance cannot rest for
            $h/t_c > 2\sqrt2 - 2 = 0.83$ (a little more with MuJoCo's default impedance, which is lower at small depths), and MuJoCo's
            limit $t_c \ge 2h$ keeps it away from there. A solver stopped early switches nothing under a velocity-level scheme: it lets a
            stack sink steadily (S9.velocity-drift). $\theta \to 1$ has no effect on rigid contacts under a constant load
            (S9.theta-damps-jitter). How often jitter is numerical is not decided here.",
        argument: r"Ball dropped from 1 mm on MuJoCo's contact at $h = 1$ ms, constant impedance: calm (speed 0 to rounding) for
            $t_c = 2h$ and $1.5h$; for $t_c = 1.2h$ and $1h$ it is thrown up again and again, faster than $g\,h$. With the limit,
            $t_c = 1h$ is calm. Tower of five, 10 cold sweeps a step: the velocities of successive steps are equal to rounding, with
            $\theta = 1/2$ and $\theta = 1$ bit for bit.",
        controls: &[
            r"The same contacts under MuJoCo's limit $t_c \ge 2h$.",
            r"The contacts that are calm made stiffer, $t_c = 1.2h$, without that limit.",
            r"Bodies of the tower that hang on springs as well: there $\theta$ matters.",
        ],
        sources: &["chapter §9, energy drift and jitter, and the pitfall “jitter is physical”", "MuJoCo documentation, refsafe"],
        check: check!(jitter),
    },
    Claim {
        id: "S9.theta-damps-jitter",
        statement: r"Against jitter: increase the numerical damping moderately, $\theta \to 1$.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Advice,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Measured,
        correct_statement: r"It damps what a spring stores: $E^+/E = 1/(1 + h^2\omega^2)$ at $\theta = 1$. On rigid contacts under a
            constant load it does nothing: $\theta$ multiplies state-dependent forces and the position update, and neither enters the
            contact problem.",
        argument: r"Tower of five, 10 cold sweeps a step, 100 steps with $\theta = 1/2$ and with $\theta = 1$: all velocities are the same
            bit for bit. A spring with $h\omega = 1/10$ loses 1/101 of its energy per step at $\theta = 1$ and none at $\theta = 1/2$.",
        controls: &["Bodies of the tower that hang on springs as well.", r"$\theta = 1/2$ and $\theta = 1$ exchanged on the spring."],
        sources: &["chapter §9, energy drift and jitter"],
        check: check!(damping),
    },
];

fn soft_penetration(reading: Reading) -> Result<Vec<Finding>> {
    let soft = ContactParameters { reference: [0.05, 1.0], ..ContactParameters::default() };
    let contact = |h: f64| reading.only(1).pick(default_contact(h), NormalContact::elliptic(soft, h, 1.0));
    let depth = |h: f64| land(&contact(h), 0.0, (3.0 / h).round() as usize).depth;
    let stiffer = reading.only(0).pick(stiffest_contact(0.001), default_contact(0.001));
    let velocity_level = MoreauJean { theta: 1.0, activation: Activation::Gap, restitution: RestitutionRule::NormalOnly };
    let position_level = StewartTrinkle::default();
    let scheme: &dyn Scheme = reading.only(2).pick(&velocity_level, &position_level);
    let stabilisation: &dyn Stabilisation = reading.only(2).pick(&CoordinateProjection, &VelocityLevel);
    let [expected, width] = drift(0.01, 100);
    let circle = Pendulum::new(1.0, 1.0, 0.0)?;
    let projected = run(stabilisation, &circle, &circle.at(0.0, 1.0), 0.01, 100)?;
    let left = circle.violation(&projected.position)[0];
    let mut findings = vec![
        Finding::equal("drift of a bead in a circle, Moreau–Jean", slide(scheme, Side::Inside, 0.01, 100)?.last, expected, width, "m"),
        Finding::equal("the same with coordinate projection", left, 0.0, on_constraint(1.0), "m"),
    ];
    let table = [(0.0005, 0.000_367_18), (0.005, 0.000_367_18), (0.01, 0.000_367_18), (0.015, 0.000_601_56), (0.02, 0.000_833_29)];
    for (h, printed) in table {
        let bound = tolerance::FOUR_DIGITS * printed;
        findings.push(Finding::equal(format!("depth at rest, h = {h}"), depth(h), printed, bound, "m"));
    }
    let printed = 0.000_004_372_0;
    findings.push(Finding::equal(
        "depth at rest, h = 0.001, t_c = 2h",
        land(&stiffer, 0.0, 3000).depth,
        printed,
        tolerance::FOUR_DIGITS * printed,
        "m",
    ));
    Ok(findings)
}

fn jitter(reading: Reading) -> Result<Vec<Finding>> {
    let (h, height) = (0.001, 0.001);
    let speed = |parts: f64| land(&unlimited_contact(h, reading.only(1).pick(parts, 1.2) * h), height, 2000).speed;
    let limited = land(&reading.only(1).pick(limited_contact(h, h), unlimited_contact(h, 1.2 * h)), height, 2000).speed;
    let (calm, thrown) = (tolerance::rest_speed(GRAVITY, h), GRAVITY * h);
    let tower = Tower { bodies: 5, gravity: GRAVITY, stiffness: 0.0 };
    let recording = tower.simulate(&Sweeps::cold(10), 0.5, 0.01, 200)?;
    let [before, last] = [199, 200].map(|sample| &recording.samples[sample].velocity);
    // a stack that only sinks has one velocity in every step; the ball has another every time it is thrown up
    let change = (last - before).amax();
    let effect = effect_of_theta_on_a_tower(reading.only(2).pick(0.0, SPRING))?;
    let stiff = |parts: f64| {
        let contact = reading.only(0).pick(unlimited_contact(h, parts * h), limited_contact(h, parts * h));
        land(&contact, height, 2000).speed
    };
    Ok(vec![
        Finding::decision("a tower solved with 10 sweeps a step sinks steadily", change <= tolerance::tower_rounding(5, 10, 1), true)
            .context(),
        Finding::equal("effect of θ = 1 instead of 1/2 on a tower", effect, 0.0, 0.0, "m/s")
            .says_at_least(f64::MIN_POSITIVE)
            .violating("the load depends on the state"),
        Finding::at_least("speed at rest with t_c = h", stiff(1.0), thrown, "m/s"),
        Finding::at_least("speed at rest with t_c = 1.2h", stiff(1.2), thrown, "m/s"),
        Finding::equal("speed at rest with t_c = 1.5h", speed(1.5), 0.0, calm, "m/s"),
        Finding::equal("speed at rest with t_c = 2h", speed(2.0), 0.0, calm, "m/s"),
        Finding::equal("speed at rest with t_c = h under MuJoCo's limit", limited, 0.0, calm, "m/s"),
    ])
}

fn damping(reading: Reading) -> Result<Vec<Finding>> {
    let thetas = reading.only(1).pick([ratio(1, 2), ratio(1, 1)], [ratio(1, 1), ratio(1, 2)]);
    let [half, one] = thetas.map(|theta| energy_ratio(&theta, 1));
    let effect = effect_of_theta_on_a_tower(reading.only(0).pick(0.0, SPRING))?;
    Ok(vec![
        Finding::decision("θ = 1 instead of 1/2 changes the velocities of a tower", effect > 0.0, false)
            .experiment()
            .says(true)
            .violating("forces that depend on the state"),
        Finding::exact("E⁺/E on a spring, θ = 1/2", &half, &ratio(1, 1), "1"),
        Finding::exact("share of a spring's energy that a step with θ = 1 takes", &(ratio(1, 1) - one), &ratio(1, 101), "1"),
    ])
}
