//! §12, the energy check and the exercises.

use super::motion::before_contact;
use crate::checks::energy::{ENERGY_OF_BOUNCE, impact, worked_ball, worked_step};
use crate::checks::zeno::DroppedBall;
use crate::claims::prelude::*;
use crate::defects::energy::RESTITUTION_ON_THE_WRONG_SIDE;
use crate::exact_particle::Ball;
use crate::schemes::{Activation, MoreauJean, RestitutionRule, Scheme};

/// The claims of this file.
pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S12.energy",
        statement: r"With the kinetic energies $E^- = \tfrac12 \cdot 0.99^2 = 0.490$ J (of $v^- = -0.99$) and
            $E^+ = \tfrac12 \cdot 0.495^2 = 0.1225$ J, $E^+/E^- = 0.25 = e^2$: 75 % are lost.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"As stated: the chapter names its reference, the kinetic energy of $v_\ell$, and with it the ratio is $e^2$
            for every $h$ and $\theta$. With $v_\text{free}$ it is 0.2062, with the speed $\sqrt{v_\ell^2 + 2\,g\,q_\ell}$ of the physical
            impact 0.2269; the ratio of the total energies is 0.4111 ($\theta = 1$) or 0.2736 ($\theta = \tfrac12$).",
        argument: r"$v^+ = -e\,v_\ell$ gives the ratio $e^2$, and the energies round to the printed digits. With other references:
            9801/47524 of the energy of $v_\text{free}$, 9801/43204 of that of the physical impact; the total energies are those of
            S12.ex2.",
        controls: &[r"$E^-$ taken with $v_\text{free}$.", r"$E^+$ taken with the rebound $-e\,v_\text{free}$."],
        sources: &["chapter §12, energy check"],
        check: check!(energy_ratio),
    },
    Claim {
        id: "S12.energy-limit",
        statement: r"$e < 1$ dissipates energy in a collision, the share $1 - e^2$.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Certified,
        correct_statement: r"As stated of the kinetic energy at the start of the step (S12.energy). Against the energy of the fall, which
            the section does not compute, to first order: $|v^{+2}/(2\,g\,q_0) - e^2| \le e^2(2\eta + \eta^2)$ with
            $\eta = \delta_0\,g\,h/\sqrt{2\,g\,q_0}$; the constant is a sawtooth in $h$.",
        argument: r"Free steps conserve $\tilde E = \tfrac12v^2 + g\,q - (\theta - \tfrac12)\,g\,h\,v$, and the bounce happens within one
            step of the floor, so $|v^-|$ differs from $\sqrt{2\,g\,q_0}$ by at most $\delta_0\,g\,h$ (derived at the bound in the
            source). The scheme is run for $h = 10^{-2}$, $10^{-3}$, $10^{-4}$ and held against that bound.",
        controls: &[r"The restitution coefficient on the other side of the complementarity, $0 \le e\,v^+ + v^- \perp P \ge 0$."],
        sources: &["chapter §12, energy check; chapter §7"],
        check: check!(energy_limit),
    },
    Claim {
        id: "S12.ex1",
        statement: "Continue by hand for two steps; at the second landing the speed should be close to the 0.495 m/s of the \
                    first rebound, because free flight conserves energy.",
        verdict: ClaimVerdict::True,
        kind: Kind::Exercise,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"As stated: after two steps $(0.0139, 0.395)$ and $(0.01685, 0.295)$; the second contact is the eleventh step,
            from $v = -0.505$ m/s, 1.0202 times the rebound, and leaves with 0.2525 m/s.",
        argument: r"Free steps from $v = 99/200$ end one step of gravity beyond −99/200, as $\tilde E = E - \tfrac12\,g\,h\,v$ and not $E$
            is conserved: the ratio of the speeds is $101/99 = 1.0202\ldots$",
        controls: &[
            r"$\theta = \tfrac12$ in the position update, with which the two heights of the exercise differ.",
            r"A duller ball, $e = 1/3$.",
        ],
        sources: &["chapter §12, exercise 1"],
        check: check!(two_more_steps),
    },
    Claim {
        id: "S12.ex2",
        statement: r"Recompute the contact step with $\theta = \tfrac12$: which $\theta$ comes closer to the theoretical energy ratio
            $e^2 = 0.25$, and why?",
        verdict: ClaimVerdict::Ambiguous,
        kind: Kind::Exercise,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"Neither for the kinetic energy: $P$, $v^+$ and the ratio 1/4 do not depend on $\theta$, which enters only the
            position (0.00995 m or 0.002525 m). For the total energy $\theta = \tfrac12$ comes closer: 0.2736 against 0.4111.",
        argument: r"$\theta$ multiplies velocities in the position update only; the LCP of the step does not contain it. The question
            presumes that one $\theta$ comes closer: with the kinetic energies, which the section compares, none does; with the total
            energy $\theta = \tfrac12$ does.",
        controls: &[
            r"The ball without gravity, whose total energy is the kinetic one: no $\theta$ comes closer in either reading.",
            r"An impact law of the velocity at $\theta$, $v^+ = -e(\theta\,v_\text{free} + (1 - \theta)\,v)$: it has another kinetic
                energy for each $\theta$.",
        ],
        sources: &["chapter §12, exercise 2"],
        check: check!(theta_and_energy),
    },
];

fn square(x: &Rational) -> Rational {
    x.clone() * x.clone()
}

/// (½ v⁺² + g q⁺)/(½ v_ℓ² + g q_ℓ) of the worked contact step.
fn total_energy_ratio(ball: &Ball<Rational>, theta: &Rational) -> Rational {
    ball.energy(&worked_step(ball, theta).motion) / ball.energy(&before_contact())
}

/// v⁺²/v_ℓ² of that step with the impact law v⁺ = −e(θ v_free + (1−θ) v_ℓ).
fn kinetic_energy_ratio_at_theta(ball: &Ball<Rational>, theta: &Rational) -> Rational {
    let (before, free) = (before_contact().velocity, worked_step(ball, theta).free_velocity);
    square(&(&ball.restitution * (theta * free + (ratio(1, 1) - theta) * &before))) / square(&before)
}

/// v⁺²/v_ℓ² of the worked contact step.
fn kinetic_energy_ratio(ball: &Ball<Rational>, theta: &Rational) -> Rational {
    square(&worked_step(ball, theta).motion.velocity) / square(&before_contact().velocity)
}

fn energy_ratio(reading: Reading) -> Result<Vec<Finding>> {
    let (ball, outcome) = (worked_ball(), worked_step(&worked_ball(), &ratio(1, 1)));
    let reference = reading.only(0).pick(before_contact().velocity, outcome.free_velocity.clone());
    let rebound = reading.only(1).pick(outcome.motion.velocity, -&ball.restitution * &outcome.free_velocity);
    let (before, after) = (ball.kinetic_energy(&reference), ball.kinetic_energy(&rebound));
    let free = ball.kinetic_energy(&outcome.free_velocity);
    let fall = ball.energy(&before_contact());
    let to_decimals = |x: &Rational, unit: i64| (x * ratio(unit, 1) + ratio(1, 2)).floor() / ratio(unit, 1);
    Ok(vec![
        Finding::exact("E⁺/E⁻", &(&after / &before), &ratio(1, 4), "1"),
        Finding::exact("E⁻, to three decimals", &to_decimals(&before, 1000), &ratio(490, 1000), "J"),
        Finding::exact("E⁺, to four decimals", &to_decimals(&after, 10_000), &ratio(1225, 10_000), "J"),
        Finding::exact("E⁺ over the energy of the physical impact", &(&after / fall), &ratio(9801, 43204), "1").context(),
        Finding::exact("E⁺ over the energy of v_free", &(after / free), &ratio(9801, 47524), "1").context(),
    ])
}

fn energy_limit(reading: Reading) -> Result<Vec<Finding>> {
    let right = MoreauJean { theta: 1.0, activation: Activation::FreeVelocityForecast, restitution: RestitutionRule::NormalOnly };
    let wrong = RESTITUTION_ON_THE_WRONG_SIDE.of(right);
    let subject: &dyn Scheme = reading.pick(&right, &wrong);
    let ball = DroppedBall { mass: 1.0, gravity: 10.0, height: 0.05, restitution: 0.5 };
    let mut findings = Vec::new();
    for inverse in [10_000, 1_000, 100] {
        let of_impact = impact(subject, &right, &ball, 1.0 / f64::from(inverse))?;
        findings.extend(of_impact.into_iter().filter(|finding| finding.name == ENERGY_OF_BOUNCE).map(|mut finding| {
            finding.name = format!("v⁺²/(2 g q₀), h = 1/{inverse}");
            finding
        }));
    }
    Ok(findings)
}

fn two_more_steps(reading: Reading) -> Result<Vec<Finding>> {
    let ball = Ball { restitution: reading.only(1).pick(ratio(1, 2), ratio(1, 3)), ..worked_ball() };
    let (h, theta) = (ratio(1, 100), reading.only(0).pick(ratio(1, 1), ratio(1, 2)));
    let step = |now| ball.moreau_jean(&now, &theta, Activation::FreeVelocityForecast, &h);
    let rebound = worked_step(&ball, &theta).motion;
    let first = step(rebound.clone()).motion;
    let second = step(first.clone()).motion;
    let mut steps = 3usize;
    let mut before = second.clone();
    let mut contact = step(before.clone());
    while contact.impulse == ratio(0, 1) {
        before = contact.motion;
        contact = step(before.clone());
        steps += 1;
    }
    Ok(vec![
        Finding::exact("landing speed over rebound speed", &(-before.velocity / rebound.velocity), &ratio(101, 99), "1"),
        Finding::exact("q after one step", &first.position, &ratio(139, 10000), "m"),
        Finding::exact("v after one step", &first.velocity, &ratio(79, 200), "m/s"),
        Finding::exact("q after two steps", &second.position, &ratio(337, 20000), "m"),
        Finding::exact("v after two steps", &second.velocity, &ratio(59, 200), "m/s"),
        Finding::count("the step of the second contact", steps, 11),
        Finding::exact("second rebound", &contact.motion.velocity, &ratio(101, 400), "m/s"),
    ])
}

fn theta_and_energy(reading: Reading) -> Result<Vec<Finding>> {
    let ball = Ball { gravity: reading.only(0).pick(ratio(10, 1), ratio(0, 1)), ..worked_ball() };
    let kinetic = reading.only(1).pick(kinetic_energy_ratio as fn(&Ball<Rational>, &Rational) -> Rational, kinetic_energy_ratio_at_theta);
    let one_is_nearer = |quantity: fn(&Ball<Rational>, &Rational) -> Rational| {
        let distance = |theta: Rational| square(&(quantity(&ball, &theta) - ratio(1, 4)));
        distance(ratio(1, 1)) != distance(ratio(1, 2))
    };
    let ratio_of = |theta: Rational| total_energy_ratio(&ball, &theta);
    Ok(vec![
        Finding::decision("one θ comes closer with the kinetic energy", one_is_nearer(kinetic), false)
            .says(true)
            .reading("as the kinetic energy"),
        Finding::decision("one θ comes closer with the total energy", one_is_nearer(total_energy_ratio), true)
            .reading("as the total energy"),
        Finding::exact("total energy ratio, θ = 1", &ratio_of(ratio(1, 1)), &ratio(17761, 43204), "1").reading("as the total energy"),
        Finding::exact("total energy ratio, θ = ½", &ratio_of(ratio(1, 2)), &ratio(11821, 43204), "1").reading("as the total energy"),
    ])
}
