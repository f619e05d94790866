//! Pulling a sunken body out: velocity bias (Baumgarte, Bullet's ERP) and projection.

use crate::claims::experiments::push_out::{ball, biased_gain, biased_step, elastic_drop, elastic_throw, projected_gain, sunk, throw};
use crate::claims::lookups::{self, BULLET, ERP, SERVER_ERP};
use crate::claims::prelude::*;
use crate::closed_forms::baumgarte_decay::time_constant;
use crate::exact_particle::{Ball, BallState};
use crate::schemes::Activation;
use crate::stabilisation::{Baumgarte, Constrained, CoordinateProjection, Pendulum, Stabilisation};
use crate::tolerance::claims::pathology as tolerance;
use crate::tolerance::rounding;

pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S9.baumgarte-inject",
        statement: r"Baumgarte stabilisation: $(\alpha, \beta)$ are very hard to tune; too small, the drift is corrected slowly, too
            large, artificial energy is injected into the system (or it is overdamped).",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Certified,
        correct_statement: r"As stated, of a contact: as a velocity bias $v^+ = -\mathrm{ERP}\,\varphi/h$ it leaves
            $(1 - \mathrm{ERP})\varphi$ and injects $T = \tfrac12m(\mathrm{ERP}\,\delta/h)^2$, so that no value is free of both; on a
            joint it injects nothing (S9.erp-sim2real).",
        argument: r"1 kg, 1 mm deep, $h = 1/60$ s, $\mathrm{ERP} = 1/5$, no load: $v^+ = 0.012$ m/s, $T = 9/125000 = \text{7.2e-5}$ J;
            twice the $\mathrm{ERP}$ gives four times that. The body leaves for good: after 2 s it is 23 mm above the floor.
            $\mathrm{ERP} = 1/100$ leaves $(99/100)^5$ of the depth after five steps, and $\alpha = 2\beta$ is slower than
            $\alpha = \beta$.",
        controls: &[
            "Projection of the position, which leaves the velocity alone.",
            r"$\alpha = \beta/2$ in the place of $\alpha = 2\beta$.",
        ],
        sources: &["chapter §9, constraint drift, (1); pitfall “Baumgarte solves every drift”", "Baumgarte 1972"],
        check: check!(injection),
    },
    Claim {
        id: "S9.bullet-erp",
        statement: r"Bullet's default $\mathrm{ERP}$ (error reduction parameter) $= 0.2$ is in essence Baumgarte stabilisation.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Cited,
        correct_statement: r"As stated: it is the semi-implicit Baumgarte step with $2\alpha h = 1$ and $\beta^2h^2 = \mathrm{ERP}$,
            constants that follow the step: under load $\varphi^+ = (1 - \mathrm{ERP})\varphi$, a first-order decay by 4/5 per step
            whatever $h$ is (time constant 4.48 steps).",
        argument: r"PyBullet 3.2.7's btContactSolverInfo.h sets $m_{erp2} = 0.2$.
            $\dot\varphi^+ = \dot\varphi - h(2\alpha\dot\varphi + \beta^2\varphi)$ with $2\alpha h = 1$, $\beta^2h^2 = 1/5$ is
            $\dot\varphi^+ = -\varphi/(5h)$. Five loaded steps of 1/240 s: $\varphi_5/\varphi_0 = (4/5)^5$ for both. The $(\alpha, \beta)$
            that fit 1/60 s leave 79/80 of the error in the first step of 1/240 s.",
        controls: &[
            r"The constants $(\alpha, \beta)$ that fit $h = 1/60$ s, used at $h = 1/240$ s.",
            "The value that PyBullet's server gives m_erp2, 0.08.",
        ],
        sources: &[
            "chapter §9, constraint drift, (1)",
            "PyBullet 3.2.7, btContactSolverInfo.h and PhysicsServerCommandProcessor.cpp (references/bullet/package.json)",
        ],
        check: check!(error_reduction),
    },
    Claim {
        id: "S9.projection-energy",
        statement: "Coordinate projection is preferable to Baumgarte: it injects no artificial energy and is geometrically clean.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Certified,
        correct_statement: r"On a joint, from which it takes energy, and on a contact without load. On a contact under load projection
            leaves the kinetic energy alone but lifts the body, $\Delta E = m\,g\,\delta$. How often depends on the activation rule (with
            the forecast $\varphi + h\,v_\text{free} \le 0$ never) and on the start: a ball dropped from rest comes back to exactly
            $\varphi = 0$ after its first projection, so that rounding decides; thrown, it is projected at every impact.",
        argument: r"Elastic ball ($e = 1$) from 1 m, $g = 10$ m/s², $h = 1/100$ s, $\theta = 1/2$, 20 s: in rationals with the rules
            $\varphi \le 0$ and $\varphi + \tfrac12hv \le 0$ there is one projection and $E/E_0 = 81/80$, all of it $m\,g\,\delta$; from
            then on every landing is exactly at $\varphi = 0$. In double precision those landings fall on either side of zero and the ball
            is projected again and again: $E/E_0 = 1.152$. Thrown upwards with 3/100 m/s, no landing is at $\varphi = 0$ and
            $E/E_0 = 305809/200009 = 1.529$ in rationals, 20 projections under $\varphi \le 0$ and none under the other two rules. Without
            projection, and with $\varphi + h\,v_\text{free} \le 0$: 1. A pendulum with coordinate projection, from 1.5 rad, never has
            more energy than at its start.",
        controls: &[
            r"The activation $\varphi + h\,v_\text{free} \le 0$, under which the ball is never projected.",
            r"A ball with $e = 1/2$, a full velocity bias in place of the projection without load, a bias too strong for its step on the
                pendulum.",
        ],
        sources: &["chapter §9, constraint drift, (3) and table of stabilisations"],
        check: check!(projection),
    },
    Claim {
        id: "S9.clean-dirty",
        statement: "Stabilisations differ in whether they disturb the physics while pulling the constraint back: Baumgarte injects energy \
            (dirty), projection does not (clean).",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Exact,
        correct_statement: r"On a contact without load. Under load both pay the lift $m\,g\,\delta$ (S9.projection-energy), and Baumgarte
            pays $\tfrac12m(\mathrm{ERP}\,\delta/h)^2$ of kinetic energy on top; on a joint it is projection that takes energy, and
            Baumgarte hardly any (S9.erp-sim2real).",
        argument: r"1 kg, 1 mm deep, $g = 10$ m/s², $h = 1/60$ s: projection adds 0 J of kinetic and 1/100 J of potential energy, a full
            bias ($\mathrm{ERP} = 1$) 9/5000 J and the same 1/100 J. Without load: 0 J and 9/5000 J.",
        controls: &["Projection and bias without load.", "Projection and bias exchanged."],
        sources: &["chapter §9, essential insight"],
        check: check!(comparison),
    },
];

/// A step that corrects the position of a body by ERP.
type Correction = fn(&Ball<Rational>, &BallState<Rational>, &Rational, &Rational) -> BallState<Rational>;

/// Projection after the step: the velocity keeps what the floor leaves it.
fn projected_step(ball: &Ball<Rational>, now: &BallState<Rational>, _erp: &Rational, h: &Rational) -> BallState<Rational> {
    let next = ball.moreau_jean(now, &ratio(1, 1), Activation::Gap, h).motion;
    BallState { position: next.position.max(ratio(0, 1)), velocity: next.velocity }
}

/// Height and velocity after `steps` steps of 1/60 s from 1 mm below the floor, without load, ERP = 1/5.
fn unloaded(step: Correction, steps: usize) -> BallState<Rational> {
    let free = Ball { gravity: ratio(0, 1), ..ball(ratio(0, 1)) };
    (0..steps).fold(sunk(), |now, _| step(&free, &now, &ratio(1, 5), &ratio(1, 60)))
}

fn injection(reading: Reading) -> Result<Vec<Finding>> {
    let none = ratio(0, 1);
    let step: Correction = reading.only(0).pick(biased_step, projected_step);
    let gain = |erp: Rational| reading.only(0).pick(biased_gain(&erp, &none), projected_gain(&none))[0].clone();
    let (kinetic, doubled) = (gain(ratio(1, 5)), gain(ratio(2, 5)));
    let end = unloaded(step, 120);
    let slower = time_constant(reading.only(1).pick(10.0, 2.5), 5.0) / time_constant(5.0, 5.0);
    Ok(vec![
        Finding::exact("kinetic energy injected by the correction of 1 mm", &kinetic, &ratio(9, 125_000), "J"),
        Finding::exact("the same with twice the ERP", &doubled, &ratio(36, 125_000), "J"),
        Finding::exact("height 2 s later", &end.position, &ratio(23, 1000), "m"),
        Finding::exact("velocity 2 s later", &end.velocity, &ratio(12, 1000), "m/s"),
        Finding::exact("φ₅/φ₀ of ERP = 1/100 under load", &loaded(step, &ratio(1, 100), &ratio(1, 60)), &ratio(99, 100).pow(5), "1"),
        // the slower rate is α − √(α² − β²)
        Finding::equal("time constant with α = 2β over that with α = β", slower, 2.0 + 3f64.sqrt(), rounding(16, 4.0), "1"),
    ])
}

/// φ₅/φ₀ of φ̇⁺ = φ̇ − h(2αφ̇ + β²φ), φ⁺ = φ + hφ̇⁺ from φ̇ = 0 with 2αh = 1 and β²h² = 1/5 at the step `tuned`, used at `h`; and φ₁/φ₀.
fn baumgarte(tuned: &Rational, h: &Rational) -> [Rational; 2] {
    let damping = ratio(1, 1) / tuned;
    let stiffness = ratio(1, 5) / (tuned * tuned);
    let (mut gap, mut rate) = (ratio(1, 1), ratio(0, 1));
    let mut gaps = Vec::new();
    for _ in 0..5 {
        rate = &rate - h * (&damping * &rate + &stiffness * &gap);
        gap += h * &rate;
        gaps.push(gap.clone());
    }
    [gaps[4].clone(), gaps[0].clone()]
}

/// φ₅/φ₀ of a plastic ball of 1 kg under gravity, pulled out by ERP.
fn loaded(step: Correction, erp: &Rational, h: &Rational) -> Rational {
    let ball = ball(ratio(0, 1));
    let end = (0..5).fold(sunk(), |now, _| step(&ball, &now, erp, h));
    end.position / sunk().position
}

fn error_reduction(reading: Reading) -> Result<Vec<Finding>> {
    let (coarse, fine) = (ratio(1, 60), ratio(1, 240));
    let tuned = reading.only(0).pick(fine.clone(), coarse.clone());
    let [fifth, _] = baumgarte(&tuned, &fine);
    let [_, first] = baumgarte(&coarse, &fine);
    let erp = reading.only(1).pick(ERP, SERVER_ERP).fraction(BULLET)?;
    let left = |h: &Rational| loaded(biased_step, &erp, h);
    let five = ratio(4, 5).pow(5);
    let mut findings = vec![Finding::exact("φ₅/φ₀ of Baumgarte with 2αh = 1, β²h² = 1/5, h = 1/240 s", &fifth, &five, "1")];
    findings.extend(lookups::check("S9.bullet-erp", reading)?);
    findings.extend([
        Finding::exact("φ₅/φ₀ with this ERP under load, h = 1/240 s", &left(&fine), &five, "1"),
        Finding::exact("φ₅/φ₀ with this ERP under load, h = 1/60 s", &left(&coarse), &five, "1"),
        Finding::exact("φ₁/φ₀ at 1/240 s of the constants that fit 1/60 s", &first, &ratio(79, 80), "1").context(),
    ]);
    Ok(findings)
}

/// The most energy that a pendulum, released at 1.5 rad, has in 1000 steps of 1/100 s, less that of its start \[J\]; the first time that
/// it has more ends the run.
fn highest_of_a_joint(stabilisation: &dyn Stabilisation) -> Result<f64> {
    let pendulum = Pendulum::new(1.0, 1.0, 9.81)?;
    let start = pendulum.at(1.5, 0.0);
    let (mut now, mut highest) = (start.clone(), f64::NEG_INFINITY);
    for _ in 0..1000 {
        if highest > 0.0 {
            break;
        }
        now = stabilisation.step(&pendulum, &now, 0.01)?;
        highest = highest.max(pendulum.energy(&now) - pendulum.energy(&start));
    }
    Ok(highest)
}

fn projection(reading: Reading) -> Result<Vec<Finding>> {
    const MET: &str = "a joint, or a contact without load";
    let one = ratio(1, 1);
    let forecast = Activation::FreeVelocityForecast;
    let [gap, half] = reading.only(0).pick([Activation::Gap, Activation::HalfStepForecast], [forecast, forecast]);
    let e = reading.only(1).pick(ratio(1, 1), ratio(1, 2));
    let [projected, half_step] = [gap, half].map(|rule| throw(e.clone(), ratio(0, 1), rule, true));
    let thrown = throw(e.clone(), ratio(3, 100), gap, true);
    let rounded = throw(Scalar::to_f64(&e), 0.0, gap, true);
    let untouched = elastic_drop::<Rational>(Activation::Gap, false);
    let counts = Activation::ALL.map(|rule| elastic_throw::<Rational>(ratio(3, 100), rule, true).projections);
    let none = ratio(0, 1);
    let [kinetic, _] = reading.only(1).pick(projected_gain(&none), biased_gain(&one, &none));
    // 2αh = 1 and β²h² = 3 at h = 1/100 s: the violation grows
    let strong = Baumgarte { damping: 50.0, frequency: 30_000f64.sqrt() };
    let joint: &dyn Stabilisation = reading.only(1).pick(&CoordinateProjection, &strong);
    let width = tolerance::elastic_drop(2000);
    Ok(vec![
        Finding::exact("E(20 s)/E(0) with projection, φ ≤ 0", &projected.energy, &ratio(81, 80), "1").says(&one).violating(MET),
        Finding::exact("E(20 s)/E(0), φ + ½hv ≤ 0", &half_step.energy, &ratio(81, 80), "1").says(&one).violating(MET),
        Finding::exact("E(20 s)/E(0) of a thrown ball", &thrown.energy, &ratio(305_809, 200_009), "1").says(&one).violating(MET),
        Finding::at_least("E(20 s)/E(0) in double precision", rounded.energy, 81.0 / 80.0, "1").says_at_most(1.0 + width).violating(MET),
        Finding::exact("kinetic energy added without load", &kinetic, &ratio(0, 1), "J"),
        Finding::at_most("energy of a pendulum with projection above that of its start", highest_of_a_joint(joint)?, 0.0, "J"),
        Finding::exact("E(20 s)/E(0) less the lift m g δ", &(&projected.energy - &projected.lift), &one, "1"),
        Finding::equal("the same in double precision", rounded.energy - rounded.lift, 1.0, width, "1"),
        Finding::exact("E(20 s)/E(0) without projection", &untouched.energy, &one, "1").context(),
        Finding::decision("a thrown ball is projected 20 times under φ ≤ 0 and never under the other rules", counts == [20, 0, 0], true)
            .context(),
    ])
}

fn comparison(reading: Reading) -> Result<Vec<Finding>> {
    let (gravity, none) = (ratio(10, 1), ratio(0, 1));
    let one = ratio(1, 1);
    let load = reading.only(0).pick(gravity.clone(), none.clone());
    let exchanged = |gravity: &Rational| reading.only(1).pick([false, true], [true, false]).map(|bias| gain(bias, gravity, &one));
    let [[kinetic, lift], [bias, bias_lift]] = exchanged(&load);
    let [[unloaded, _], [unloaded_bias, _]] = exchanged(&none);
    Ok(vec![
        Finding::exact("kinetic energy added by projection", &kinetic, &none, "J"),
        Finding::exact("potential energy added by projection under load", &lift, &ratio(1, 100), "J")
            .says(&none)
            .violating("a contact without load"),
        Finding::exact("kinetic energy added by projection without load", &unloaded, &none, "J"),
        Finding::exact("kinetic energy added by a full bias", &bias, &ratio(9, 5000), "J"),
        Finding::exact("kinetic energy added by a full bias without load", &unloaded_bias, &ratio(9, 5000), "J"),
        Finding::exact("potential energy added by a full bias", &bias_lift, &ratio(1, 100), "J"),
    ])
}

/// Kinetic and potential energy \[J\] added by a bias with this ERP, or by projection.
fn gain(bias: bool, gravity: &Rational, erp: &Rational) -> [Rational; 2] {
    if bias { biased_gain(erp, gravity) } else { projected_gain(gravity) }
}
