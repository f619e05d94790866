//! §12, the energy check and the exercises.

use super::motion::before_contact;
use crate::Result;
use crate::checks::Finding;
use crate::checks::energy::{ENERGY_OF_BOUNCE, impact, worked_ball, worked_step};
use crate::checks::zeno::DroppedBall;
use crate::claims::{Claim, ClaimVerdict, Evidence, Kind, Reading, Severity};
use crate::defects::energy::{Misassembled, restitution_on_the_wrong_side};
use crate::scalar::{Rational, ratio};
use crate::schemes::{Activation, MoreauJean, RestitutionRule, Scheme};

/// The claims of this file.
pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S12.energy",
        statement: "E⁻ = ½ · 0.99² = 0.490 J, E⁺ = ½ · 0.495² = 0.1225 J, E⁺/E⁻ = 0.25 = e²: 75 % are lost.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Exact,
        correct_statement: "The kinetic energy ratio is exactly e² for every h and θ if E⁻ is taken with v_ℓ. Against other \
                            natural references it is not: 0.2062 with v_free, 0.2269 with the speed √(v_ℓ² + 2 g q_ℓ) of the \
                            physical impact; the ratio of the total energies is 0.4111 (θ = 1) or 0.2736 (θ = ½).",
        argument: "v⁺ = −e v_ℓ gives the ratio e². Exactly: (99/200)²/(109/100)² = 9801/47524; (99/200)²/(1.0801) = \
                   9801/43204; total (½·(99/200)² + 10 q⁺)/(0.54005) = 17761/43204 for q⁺ = 199/20000 and \
                   11821/43204 for q⁺ = 101/40000.",
        control: "E⁻ taken with v_free.",
        sources: &["chapter §12, energy check"],
        check: energy_ratio,
    },
    Claim {
        id: "S12.energy-limit",
        statement: "The energy ratio of the bounce is e² (as h → 0, against the energy of the fall).",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Certified,
        correct_statement: "As stated, to first order: |v⁺²/(2 g q₀) − e²| ≤ e²(2η + η²) with η = δ₀ g h/√(2 g q₀); the constant \
                            is a sawtooth in h.",
        argument: "Free steps conserve Ẽ = ½v² + g q − (θ−½) g h v, and the bounce happens within one step of the floor, so \
                   |v⁻| differs from √(2 g q₀) by at most δ₀ g h (δ₀ = 3/2 for the rule of §12 with θ = 1). The scheme is run \
                   for h = 10⁻², 10⁻³, 10⁻⁴ and held against that bound.",
        control: "The restitution coefficient on the other side of the complementarity, 0 ≤ e v⁺ + v⁻ ⟂ P ≥ 0.",
        sources: &["chapter §12, energy check; chapter §7"],
        check: energy_limit,
    },
    Claim {
        id: "S12.ex1",
        statement: "Continue by hand for two steps; at the second landing the speed should be close to the 0.495 m/s of the \
                    first rebound, because free flight conserves energy.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: "As stated: after two steps (0.0139, 0.395) and (0.01685, 0.295); the second contact is the eleventh \
                            step, from v = −0.505 m/s, 1.0202 times the rebound, and leaves with 0.2525 m/s.",
        argument: "Ten free steps from v = 99/200 give v = −101/200, one step of gravity beyond −99/200, as Ẽ = E − ½ g h v and \
                   not E is conserved: 101/99 = 1.0202…",
        control: "θ = ½ in the position update, with which the two heights of the exercise differ.",
        sources: &["chapter §12, exercise 1"],
        check: two_more_steps,
    },
    Claim {
        id: "S12.ex2",
        statement: "Recompute the contact step with θ = ½: which θ comes closer to the theoretical energy ratio e² = 0.25, and why?",
        verdict: ClaimVerdict::Ambiguous,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: "Neither for the kinetic energy: P, v⁺ and the ratio 1/4 do not depend on θ, which enters only the \
                            position (0.00995 m or 0.002525 m). For the total energy θ = ½ comes closer: 0.2736 against 0.4111.",
        argument: "θ multiplies velocities in the position update only; the LCP of the step does not contain it. A question, \
                   not an assertion: with the total energy it has the answer θ = ½.",
        control: "The ratio of the total energies as the quantity that is expected not to depend on θ.",
        sources: &["chapter §12, exercise 2"],
        check: theta_and_energy,
    },
];

fn square(x: &Rational) -> Rational {
    x.clone() * x.clone()
}

/// (½ v⁺² + g q⁺)/(½ v_ℓ² + g q_ℓ) of the worked contact step.
fn total_energy_ratio(theta: &Rational) -> Rational {
    let ball = worked_ball();
    ball.energy(&worked_step(&ball, theta).motion) / ball.energy(&before_contact())
}

/// v⁺²/v_ℓ² of the worked contact step.
fn kinetic_energy_ratio(theta: &Rational) -> Rational {
    square(&worked_step(&worked_ball(), theta).motion.velocity) / square(&before_contact().velocity)
}

fn energy_ratio(reading: Reading) -> Result<Vec<Finding>> {
    let outcome = worked_step(&worked_ball(), &ratio(1, 1));
    let (before, after) = (before_contact(), square(&outcome.motion.velocity));
    let reference = reading.pick(before.velocity.clone(), outcome.free_velocity.clone());
    let physical = square(&before.velocity) + ratio(20, 1) * before.position;
    Ok(vec![
        Finding::exact("E⁺/E⁻", &(after.clone() / square(&reference)), &ratio(1, 4), "1"),
        Finding::exact("against v_free", &(after.clone() / square(&outcome.free_velocity)), &ratio(9801, 47524), "1"),
        Finding::exact("against the physical impact", &(after / physical), &ratio(9801, 43204), "1"),
        Finding::exact("total energy, θ = 1", &total_energy_ratio(&ratio(1, 1)), &ratio(17761, 43204), "1"),
        Finding::exact("total energy, θ = ½", &total_energy_ratio(&ratio(1, 2)), &ratio(11821, 43204), "1"),
    ])
}

fn energy_limit(reading: Reading) -> Result<Vec<Finding>> {
    let right = MoreauJean { theta: 1.0, activation: Activation::FreeVelocityForecast, restitution: RestitutionRule::NormalOnly };
    let wrong = Misassembled { base: right, alter: restitution_on_the_wrong_side };
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
    let (ball, h) = (worked_ball(), ratio(1, 100));
    let theta = reading.pick(ratio(1, 1), ratio(1, 2));
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
    let quantity = reading.pick(kinetic_energy_ratio as fn(&Rational) -> Rational, total_energy_ratio);
    let (implicit, midpoint) = (ratio(1, 1), ratio(1, 2));
    let distance = |theta: &Rational| total_energy_ratio(theta) - ratio(1, 4);
    Ok(vec![
        Finding::exact("ratio with θ = 1 minus ratio with θ = ½", &(quantity(&implicit) - quantity(&midpoint)), &ratio(0, 1), "1"),
        Finding::exact("kinetic energy ratio", &kinetic_energy_ratio(&midpoint), &ratio(1, 4), "1"),
        Finding::exact("q⁺, θ = ½", &worked_step(&worked_ball(), &midpoint).motion.position, &ratio(101, 40000), "m"),
        Finding::decision("the total energy of θ = ½ is nearer to e²", distance(&midpoint) < distance(&implicit), true),
    ])
}
