//! Rows 3 and 4: energy that grows, and energy that is lost.

use crate::claims::experiments::floors::{Floor, elastic_invariant, first_impact};
use crate::claims::experiments::push_out::{biased_gain, elastic_drop};
use crate::claims::experiments::rod::energy_gained;
use crate::claims::experiments::soft::{GRAVITY, land, rebound, unlimited_contact};
use crate::claims::experiments::spring::energy_ratio;
use crate::claims::experiments::tower::{Sweeps, Tower, energy_of_stale_impulses};
use crate::claims::prelude::*;
use crate::closed_forms::mujoco_normal::spring_damper_restitution;
use crate::exact_particle::{Ball, BallState};
use crate::schemes::{Activation, RestitutionRule};
use crate::solvers::ContactSolver;
use crate::tolerance::gate::ball::{OSCILLATOR_PARTS, oscillator_rebound};
use crate::tolerance::rounding;

pub(super) const CLAIMS: &[Claim] = &[
    Claim {
        id: "R3",
        statement: r"Energy grows, the system runs ever faster: possible causes (a) explicit Euler, (b) Baumgarte, (c) an unconverged
            solver. Check the integrator (semi-implicit or better), drop Baumgarte for coordinate projection or GGL, raise the iterations,
            look for $e > 1$.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Advice,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Certified,
        correct_statement: r"The listed causes are causes, and $e > 1$ is. The recommended projection is one itself: it lifts the body
            against gravity. An unconverged solver injects only from a warm start or through restitution: cold sweeps with $e = 0$ descend
            on the kinetic energy. (Others are Newton's $e$ with friction, and a contact too stiff for its step.)",
        argument: r"Gain of each: rod with friction, $e = 1$: a factor 25/16; projection 81/80; explicit Euler, $h\omega = 1/10$: 101/100
            per step; $\mathrm{ERP} = 1/5$ on 1 mm at 1/60 s: 7.2e-5 J/kg; $e = 11/10$: 121/100 per impact; MuJoCo's contact with
            $t_c = h$, dropped from 1 mm: thrown higher than 1 mm for good; one warm sweep on a tower whose weight is gone:
            $11/16\,(g\,h)^2$. Cold sweeps minimise $\tfrac12r^TWr + u_\text{free}^Tr = T(r) - T(0)$ coordinate by coordinate from
            $r = 0$: $T$ never exceeds $T_\text{free}$.",
        controls: &[
            r"The rod with $e$ on the whole velocity $v^+ + e\,v^-$, no projection, and the contact with $t_c = 1.5h$.",
            r"The remedies in place of the causes: $\theta = 1/2$, $\mathrm{ERP} = 0$, $e = 1$ and fifty warm sweeps; and a projection
                where there is none.",
        ],
        sources: &["chapter, troubleshooting manual, row 3"],
        check: check!(growth),
    },
    Claim {
        id: "R4",
        statement: r"Energy is lost, motion is viscous: possible causes (a) $\theta = 1$ or large numerical damping, (b) over-damped
            Baumgarte. Take $\theta = 1/2$ (energy neutral), reduce numerical damping or solref's damping ratio, check whether $e$ is too
            small.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Advice,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Certified,
        correct_statement: r"A smaller damping ratio helps: $e(\zeta) = \exp(-\zeta/\sqrt{1 - \zeta^2}\cdot\operatorname{acos}(2\zeta^2 -
            1))$. $\theta$ helps where forces depend on the state; a body under gravity bounces off a hard floor with the same loss for
            every $\theta$.",
        argument: r"Elastic ball, $\theta = 1$, 2000 steps: $(E - \tfrac12\,g\,h\,v)/E_0 = 1$ exactly; an impact with $e = 1/2$ loses the
            same at $\theta = 1$ and 1/2. On a soft floor, $h\omega = 1/5$, both lose more at $\theta = 1$. Spring, $h\omega = 1/10$:
            100/101 per step against 1. Replay of MuJoCo's contact, impact at 1 m/s, no load, constant impedance: $e = 0.744$, 0.451,
            0.298, 0.135, 0.048 for $\zeta = 0.1$, 0.3, 0.5, 1, 2, within the first-order bound of the step.",
        controls: &[
            "A soft floor, whose force depends on the state, in place of the hard one.",
            r"$\theta = 1/2$ and 1 exchanged on the spring, and twice the damping ratio.",
        ],
        sources: &["chapter, troubleshooting manual, row 4", "Schwager and Pöschel 2007"],
        check: check!(loss),
    },
];

/// Kinetic energy after over before an impact at 1 m/s.
fn impact(restitution: Rational) -> Rational {
    let ball = Ball { mass: ratio(1, 1), gravity: ratio(0, 1), restitution };
    let arriving = BallState { position: ratio(0, 1), velocity: ratio(-1, 1) };
    let after = ball.moreau_jean(&arriving, &ratio(1, 2), Activation::Gap, &ratio(1, 100)).motion;
    ball.kinetic_energy(&after.velocity) / ball.kinetic_energy(&arriving.velocity)
}

/// Largest T(after k cold sweeps)/T_free of a falling tower of ten, k = 1 … 40.
fn cold_energy() -> Result<f64> {
    let tower = Tower { bodies: 10, gravity: GRAVITY, stiffness: 0.0 };
    let problem = tower.first_step(0.01);
    let free = nalgebra::DVector::from_element(10, -GRAVITY * 0.01);
    let mut largest = 0.0f64;
    for sweeps in 1..=40 {
        let impulse = Sweeps::cold(sweeps).solve(&problem, None)?.impulse;
        let after = &free + tower.jacobian().tr_mul(&impulse);
        largest = largest.max(after.norm_squared() / free.norm_squared());
    }
    Ok(largest)
}

fn growth(reading: Reading) -> Result<Vec<Finding>> {
    let rule = reading.only(0).pick(RestitutionRule::NormalOnly, RestitutionRule::FullVector);
    let (before, zero, one) = (ratio(1, 5), ratio(0, 1), ratio(1, 1));
    let rod = (&before + energy_gained(&one, rule)?) / before;
    let projected = elastic_drop::<Rational>(Activation::Gap, reading.only(0).pick(true, false));
    let (h, height) = (0.001, 0.001);
    let stiff = unlimited_contact(h, reading.only(0).pick(1.0, 1.5) * h);
    let remedied = reading.only(1);
    let theta = remedied.pick(zero.clone(), ratio(1, 2));
    let bias = biased_gain(&remedied.pick(ratio(1, 5), zero.clone()), &zero);
    let superelastic = impact(remedied.pick(ratio(11, 10), one.clone()));
    let stale = energy_of_stale_impulses(remedied.pick(1, 50))?;
    let falling = elastic_drop::<Rational>(Activation::Gap, remedied.pick(false, true));
    Ok(vec![
        Finding::exact("energy of a rod after over before an impact with friction, e = 1", &rod, &ratio(25, 16), "1").context(),
        Finding::exact("E(20 s)/E(0) with projection", &projected.energy, &ratio(81, 80), "1")
            .says_at_most(&one)
            .violating("the projection lifts nothing"),
        Finding::exact("E⁺/E of explicit Euler on a spring", &energy_ratio(&theta, 1), &ratio(101, 100), "1"),
        Finding::exact("energy from Baumgarte, ERP = 1/5, 1 mm", &bias[0], &ratio(9, 125_000), "J"),
        Finding::exact("energy of an impact with e = 11/10, after over before", &superelastic, &ratio(121, 100), "1"),
        Finding::at_least("height reached after a drop from 1 mm, t_c = h", land(&stiff, height, 2000).height, height, "m").context(),
        Finding::equal("energy from one warm sweep over (g h)²", stale, 11.0 / 16.0, rounding(64, 1.0), "kg"),
        Finding::at_most("energy after cold sweeps over free energy", cold_energy()?, 1.0, "1").context(),
        Finding::exact("E(20 s)/E(0), no projection", &falling.energy, &one, "1"),
    ])
}

fn loss(reading: Reading) -> Result<Vec<Finding>> {
    let (half, one) = (ratio(1, 2), ratio(1, 1));
    let floor = reading.only(0).pick(Floor::Hard, Floor::Soft);
    let (kept, impacts) = (elastic_invariant(floor), [first_impact(floor, &one), first_impact(floor, &half)]);
    let (damped, neutral) = reading.only(1).pick((&one, &half), (&half, &one));
    let state_dependent = "the forces depend on the state";
    let mut findings = vec![
        Finding::decision("E − ½ g h v falls over 2000 steps with θ = 1", kept < one, false).says(true).violating(state_dependent),
        Finding::decision("an impact with e = 1/2 loses more at θ = 1 than at θ = 1/2", impacts[0] < impacts[1], false)
            .says(true)
            .violating(state_dependent),
        Finding::exact("E⁺/E on a spring, θ = 1", &energy_ratio(damped, 1), &ratio(100, 101), "1"),
        Finding::exact("E⁺/E on a spring, θ = 1/2", &energy_ratio(neutral, 1), &one, "1"),
    ];
    let twice = reading.only(1).pick(1.0, 2.0);
    for damping in [0.1, 0.3, 0.5, 1.0, 2.0] {
        let expected = spring_damper_restitution(damping);
        let measured = rebound(twice * damping, 1.0 / OSCILLATOR_PARTS as f64);
        findings.push(Finding::equal(format!("e at ζ = {damping}"), measured, expected, oscillator_rebound(damping), "1"));
    }
    Ok(findings)
}
