//! The exercises of §9 that are diagnoses: the melting stack and the trembling gripper.

use crate::claims::experiments::soft::{GRAVITY, default_contact, land, unlimited_contact};
use crate::claims::experiments::spring::{energy_ratio, explicit_peak, semi_implicit_peak};
use crate::claims::experiments::theta_energy::{SPRING, effect_of_theta_on_a_tower};
use crate::claims::experiments::tower::{Sweeps, Tower, approach_left};
use crate::claims::prelude::*;
use crate::closed_forms::mujoco_contact::ContactParameters;
use crate::closed_forms::mujoco_normal::NormalContact;
use crate::solvers::ProjectedGaussSeidel;
use crate::tolerance::{claims::pathology as tolerance, rounding};
use crate::trajectory::Recording;

pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S9.ex1",
        statement: "Exercise 1: stacked blocks slowly melt into each other. Is it constraint drift, soft penetration or energy? Give the \
            likeliest cause and the cure for Moreau–Jean, MuJoCo and Stewart–Trinkle.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Exercise,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Certified,
        correct_statement: r"On a flat table none of the three keeps sinking if the step is solved: Moreau–Jean stands still, MuJoCo stays
            at its static depth, Stewart–Trinkle has no residual. Continued sinking means a solver stopped early under a velocity-level
            scheme; $\varphi/h$ turns the same error into a static depth $h$ times smaller. The cure is more sweeps or a warm start;
            projection would hide it.",
        argument: r"Tower of five, $h = 1/100$ s, 10 cold sweeps a step: Moreau–Jean sinks at the constant speed $u = G^{10}(u + u_g)$,
            0.060 m/s at the top; Stewart–Trinkle stays at $h$ times that, 6.0e-4 m, after 2 s as after 1 s. Solved steps: 0. MuJoCo's
            ball: the same depth after 300 steps as after 600.",
        controls: &[
            "Towers on the velocity level, both with 10 sweeps a step, and a ball on a contact with a time constant of 10 s.",
            "Moreau–Jean's tower solved.",
        ],
        sources: &["chapter §9, exercise 1"],
        check: check!(melting_stack),
    },
    Claim {
        id: "S9.ex3",
        statement: r"Exercise 3: a gripper trembles. Check in this order: (a) is the integrator at least semi-implicit, (b) is $\theta$ or
            the numerical damping large enough, (c) has the solver converged, (d) do step and stiffness match; say which indicator shows
            each.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Exercise,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Certified,
        correct_statement: r"Four switches with four indicators: (a) energy per step, (b) energy of springs – nothing on rigid contacts
            under a constant load –, (c) the approach velocity left, (d) speed at rest against $h/t_c$.",
        argument: r"(a) spring, $h\omega = 1/10$: 101/100 per explicit step; the semi-implicit one keeps $v^2 + q^2 - h\,q\,v$, so
            $E/E_0 \le 1/0.95$. (b) $\theta = 1$ takes 1/101 of a spring's energy, $\theta = 1/2$ nothing; a tower's velocities do not
            change. (c) tower of ten: 200 more sweeps multiply what is left by 0.00705, the largest factor of a sweep to the power of 200.
            (d) $t_c = h$: thrown up; $t_c = 1.5h$: calm.",
        controls: &[
            "Switch (b) on a tower whose bodies hang on springs as well.",
            r"Every switch the other way: explicit and semi-implicit exchanged, $\theta = 1/2$, 300 sweeps, $t_c$ exchanged.",
        ],
        sources: &["chapter §9, exercise 3"],
        check: check!(four_switches),
    },
];

fn melting_stack(reading: Reading) -> Result<Vec<Finding>> {
    let (bodies, h, sweeps) = (5, 0.01, 10);
    let tower = Tower { bodies, gravity: GRAVITY, stiffness: 0.0 };
    let cold = Sweeps::cold(sweeps);
    let (velocities, positions) = (tower.simulate(&cold, 1.0, h, 200)?, tower.simulate_positions(&cold, h, 200)?);
    let solved = tower.simulate(&ProjectedGaussSeidel::default(), 1.0, h, 200)?;
    // how far each sinks in its second second; MuJoCo's ball from 3 to 6 s
    let second = |recording: &Recording| tower.sinking(recording, 200) - tower.sinking(recording, 100);
    let speed = tower.sinking_speed(sweeps, h);
    let sinking = second(reading.only(1).pick(&velocities, &solved));
    let rounding_error = tolerance::tower_rounding(bodies, sweeps, 200);
    let contact = reading.only(0).pick(default_contact(h), NormalContact::elliptic(sluggish(), h, 1.0));
    let ball = |steps: usize| land(&contact, 0.0, steps).depth;
    let [rigid, lifted] = reading.only(0).pick([&solved, &positions], [&velocities, &velocities]).map(second);
    let soft = ball(600) - ball(300);
    let melts = |name: &str, sunk: f64, width: f64| {
        Finding::decision(format!("{name} goes on sinking"), sunk > width, false)
            .says(true)
            .violating("a velocity-level scheme whose solver is stopped early")
    };
    Ok(vec![
        melts("Moreau–Jean's tower, solved,", rigid, tolerance::solved_tower(bodies, h, 200)),
        melts("Stewart–Trinkle's tower, 10 sweeps a step,", lifted, rounding_error),
        melts("MuJoCo's ball", soft, tolerance::AT_REST * land(&default_contact(h), 0.0, 300).depth),
        Finding::equal("sinking of Moreau–Jean's tower in the second second, 10 sweeps a step", sinking, speed, rounding_error, "m"),
        Finding::equal(
            "depth of Stewart–Trinkle's tower, 10 sweeps a step",
            tower.sinking(&positions, 100),
            h * speed,
            rounding_error,
            "m",
        )
        .context(),
    ])
}

/// A contact that takes longer than the run to come to rest.
fn sluggish() -> ContactParameters {
    ContactParameters { reference: [10.0, 1.0], ..ContactParameters::default() }
}

fn four_switches(reading: Reading) -> Result<Vec<Finding>> {
    let ten = Tower { bodies: 10, gravity: GRAVITY, stiffness: 0.0 };
    let h = 0.01;
    let [fewer, more] = [approach_left(&ten, 200, h)?, approach_left(&ten, reading.only(1).pick(400, 300), h)?];
    let spring = ratio(1, 1) - energy_ratio(&reading.only(1).pick(ratio(1, 1), ratio(1, 2)), 1);
    let effect = effect_of_theta_on_a_tower(reading.only(0).pick(0.0, SPRING))?;
    let peak = reading.only(1).pick(semi_implicit_peak(1000), explicit_peak(1000));
    let explicit = reading.only(1).pick(ratio(0, 1), ratio(1, 2));
    let [stiff, soft] = reading.only(1).pick([1.0, 1.5], [1.5, 1.0]);
    let speed = |parts: f64| land(&unlimited_contact(0.001, parts * 0.001), 0.001, 2000).speed;
    Ok(vec![
        Finding::decision("(b) θ = 1 changes the velocities of a tower", effect > 0.0, false)
            .says(true)
            .violating("forces that depend on the state"),
        Finding::exact("(b) share of energy taken from a spring by θ = 1", &spring, &ratio(1, 101), "1"),
        Finding::exact("(a) E⁺/E of an explicit step", &energy_ratio(&explicit, 1), &ratio(101, 100), "1"),
        Finding::at_most("(a) largest E/E₀ of 1000 semi-implicit steps", peak, 1.0 / 0.95 + rounding(8000, 1.0), "1"),
        Finding::equal(
            "(c) approach velocity left by 400 sweeps over that of 200",
            more / fewer,
            ten.sweep_factor(1).powi(200),
            tolerance::sweep_ratio(10, 400, fewer),
            "1",
        ),
        Finding::at_least("(d) speed at rest, t_c = h", speed(stiff), GRAVITY * 0.001, "m/s"),
        Finding::equal("(d) speed at rest, t_c = 1.5h", speed(soft), 0.0, tolerance::rest_speed(GRAVITY, 0.001), "m/s"),
    ])
}
