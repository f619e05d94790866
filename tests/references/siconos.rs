//! Siconos's stored steps and events against ours, from each of its own states, and the whole motion from its start.

use libtest_mimic::Failed;
use moreau::checks::Finding;
use moreau::checks::siconos_alpha::SiconosAlpha;
use moreau::checks::siconos_events::SiconosEvents;
use moreau::checks::siconos_steps::SiconosSteps;
use moreau::event_driven::EventDriven;
use moreau::event_driven::flight::{Control, Location};
use moreau::schemes::{GeneralisedAlpha, StewartTrinkle};
use moreau::solvers::LemkePivoting;
use moreau::tolerance::claims::events::ACCURACY;
use moreau::tolerance::references::SICONOS_PER_STEP;
use nalgebra::{DVector, dvector};
use std::path::Path;

/// The Debian package that made the files.
pub const VERSION: &str = "4.4.0+dfsg-2";

/// Every finding about one stored run.
pub fn check(file: &Path) -> Result<Vec<Finding>, Failed> {
    let (name, text) = (file.to_string_lossy(), std::fs::read_to_string(file)?);
    if name.contains("__event-driven") {
        return events(&SiconosEvents::from_json(&text)?);
    }
    if name.contains("__generalised-alpha") {
        return alpha(&SiconosAlpha::from_json(&text)?);
    }
    let run = SiconosSteps::from_json(&text)?;
    if name.contains("bead_bounce") {
        return stale_normal(&run);
    }
    let mut findings = steps(&run)?;
    if name.contains("bead__moreau-jean") {
        findings.extend(normals_ahead(&run)?);
    }
    Ok(findings)
}

fn pinned(version: &str) -> Finding {
    Finding::decision("the package's version is the pinned one", version == VERSION, true)
}

fn steps(run: &SiconosSteps) -> Result<Vec<Finding>, Failed> {
    let scheme = run.scheme(0.0)?;
    let mut findings = vec![pinned(run.version())];
    let mut allowed = run.tolerances();
    if !run.is_two_step() {
        allowed = allowed.map(|one| one.min(SICONOS_PER_STEP));
    }
    for ((name, unit, apart), one) in units(run.deviations(scheme.as_ref())?).into_iter().zip(allowed) {
        findings.push(Finding::at_most(format!("{name} of every step against Siconos's"), apart, one, unit));
    }
    findings.push(Finding::at_most("position of the whole run", run.whole_run(scheme.as_ref())?, run.run_tolerance(), "m"));
    let (control, other) = match run.is_two_step() {
        true => ("control: a step without restitution is noticed", run.deviations(&StewartTrinkle::default())?),
        false => ("control: another θ is noticed", run.deviations(run.scheme(-0.25)?.as_ref())?),
    };
    let noticed = other.iter().zip(allowed).any(|(apart, one)| *apart > one);
    findings.push(Finding::decision(control, noticed, true));
    if run.is_two_step() {
        findings.extend(two_steps(run));
    }
    Ok(findings)
}

/// DIFFERENCE: the velocity that SchatzmanPaoliOSI shows is the central one, half a step behind ours; and the first of its positions is
/// q_0 + h v_0, wherever that is, so that its clock is a step behind its positions.
fn two_steps(run: &SiconosSteps) -> Vec<Finding> {
    let [start, first, velocity] = [run.positions[0][0], run.positions[1][0], run.velocities[0][0]];
    let shown = (1..run.positions.len()).map(|k| (run.velocities[k][0] - run.state(k).velocity[0]).abs()).fold(0.0, f64::max);
    let largest = run.impulses.iter().flatten().fold(0.0, |a: f64, b| a.max(b.abs()));
    vec![
        Finding::equal(
            "DIFFERENCE: the velocity shown is (q_k − q_{k−2})/2h",
            run.distance_from_central_differences(),
            0.0,
            run.tolerances()[1],
            "m/s",
        ),
        Finding::at_least("its distance from (q_k − q_{k−1})/h", shown, 0.1, "m/s"),
        Finding::equal("q_1 = q_0 + h v_0", first, start + run.time_step * velocity, run.tolerances()[0], "m"),
        Finding::at_least("largest impulse: there are impacts", largest, 0.1, "N·s"),
    ]
}

fn events(run: &SiconosEvents) -> Result<Vec<Finding>, Failed> {
    let (method, allowed) = (EventDriven::default(), run.tolerance());
    let apart = run.apart(&method)?;
    let late = EventDriven { control: Control::Fixed(1e-3), location: Location::EndOfStep, ..method };
    let mut findings = vec![
        pinned(run.version()),
        Finding::at_least("impacts compared", apart.impacts as f64, 3.0, "1"),
        Finding::at_most("instant of every impact against Siconos's, times the speed", apart.instant, allowed, "m"),
        Finding::at_most("velocity after every impact, over 1 + |a|/|v|", apart.velocity_after, allowed, "m/s"),
        Finding::at_most("position at every sample", apart.position, allowed, "m"),
        Finding::at_most("velocity at every sample", apart.velocity, allowed, "m/s"),
        Finding::at_most("position of the whole run", run.whole_run(&method)?, ACCURACY, "m"),
        Finding::decision("control: events noticed a millisecond late are noticed", run.apart(&late)?.instant > allowed, true),
    ];
    findings.extend(after_accumulation(run)?);
    Ok(findings)
}

/// Every step of a flight agrees. DIFFERENCE: NewMarkAlphaOSI of 4.4.0 forgets a between steps, and ours does not; at an impact it
/// multiplies the velocity by a factor with the unit 1/s, in which e does not occur.
fn alpha(run: &SiconosAlpha) -> Result<Vec<Finding>, Failed> {
    let (scheme, [position, velocity]) = (run.scheme()?, run.tolerances());
    let radius = scheme.spectral_radius();
    let apart = run.deviations(&scheme)?;
    let mut findings = vec![
        pinned(run.version()),
        Finding::at_most("position after every step of the flight against Siconos's", apart[0], position, "m"),
        Finding::at_most("velocity after every step of the flight", apart[1], velocity, "m/s"),
    ];
    let Some(impact) = run.first_impact() else {
        let other = run.deviations(&GeneralisedAlpha::new(radius - 0.01)?)?;
        findings.push(Finding::decision("control: another spectral radius is noticed", other[1] > velocity, true));
        let whole = run.whole_flight(&scheme)?;
        findings.push(Finding::decision("DIFFERENCE: for ρ < 1 ours remembers a from step to step", whole > 1e6 * velocity, radius < 1.0));
        return Ok(findings);
    };
    findings.extend([
        Finding::equal("DIFFERENCE: v⁺ = v⁻ (1 − (1−α_m)/((1−α_f) γ) h'/h²)", impact.leaving, impact.predicted, impact.rounding, "m/s"),
        Finding::at_least("its distance from −e v⁻", (impact.leaving - impact.newton).abs(), 10.0 * impact.arriving.abs(), "m/s"),
    ]);
    Ok(findings)
}

/// DIFFERENCE: where impacts accumulate Siconos goes on until v⁺ is below its event tolerance, which it then takes for zero and keeps; ours
/// ends them by its declared rule, with v = 0.
fn after_accumulation(run: &SiconosEvents) -> Result<Vec<Finding>, Failed> {
    let last = run.times.len() - 1;
    let left = run.velocities[last][0];
    if left.abs() > 1e-6 {
        return Ok(Vec::new());
    }
    let whole = EventDriven::default().advance(&LemkePivoting, run.mechanism()?.as_ref(), &run.state(0), run.times[last])?;
    Ok(vec![
        Finding::at_least("DIFFERENCE: at rest Siconos keeps a velocity", left, f64::MIN_POSITIVE, "m/s"),
        Finding::at_most("which is below its event tolerance", left, run.event_tolerance, "m/s"),
        Finding::equal("ours keeps none", whole.state.velocity[0], 0.0, f64::MIN_POSITIVE, "m/s"),
    ])
}

fn units([position, velocity, impulse]: [f64; 3]) -> [(&'static str, &'static str, f64); 3] {
    [("position", "m", position), ("velocity", "m/s", velocity), ("impulse", "N·s", impulse)]
}

/// DIFFERENCE: the velocity that e reverses is H v_k with the normal of the step before, at q_{k−1} + h v_{k−1}; ours is H(q_k) v_k. Read
/// off the first impact: n = (v_{k+1} − v_k − h g)/r, and n·v_{k+1} = −e u.
fn stale_normal(run: &SiconosSteps) -> Result<Vec<Finding>, Failed> {
    let k = run.impulses.iter().position(|r| r[0] > 0.0).ok_or("the bead hits the circle")?;
    let mechanism = run.mechanism()?;
    let (earlier, before, after) = (run.state(k - 1), run.state(k), run.state(k + 1));
    let contact = |q: &DVector<f64>| mechanism.contacts(q).swap_remove(0);
    let along = |q: &DVector<f64>, v: &DVector<f64>| (&contact(q).jacobian * v)[0];
    let normal = (&after.velocity - &before.velocity + dvector![0.0, 9.81 * run.time_step]) / run.impulses[k][0];
    let reversed = -normal.dot(&after.velocity) / contact(&before.position).restitution;
    let stale = along(&(&earlier.position + &earlier.velocity * run.time_step), &before.velocity);
    let present = along(&before.position, &before.velocity);
    Ok(vec![
        Finding::equal(
            "DIFFERENCE: the velocity that e reverses has the normal of the step before",
            reversed,
            stale,
            SICONOS_PER_STEP,
            "m/s",
        ),
        Finding::at_least("its distance from H(q) v", (reversed - present).abs(), 1e-4, "m/s"),
    ])
}

/// DIFFERENCE: Siconos takes H at q + h v, we at q. On a circle the normals differ by the angle of a step, at most asin(h|v|/|q|), and
/// where both act the velocity by no more than the sine of it times |v_free|.
fn normals_ahead(run: &SiconosSteps) -> Result<Vec<Finding>, Failed> {
    let plain = run.deviations_with_present_normals(run.scheme(0.0)?.as_ref())?;
    let turn = (0..run.impulses.len()).map(|k| {
        let state = run.state(k);
        let speed = state.velocity.norm();
        run.time_step * speed / state.position.norm() * (speed + run.time_step * 9.81)
    });
    Ok(vec![
        Finding::at_most("DIFFERENCE: velocity of a step with H at q in place of q + h v", plain[1], turn.fold(0.0, f64::max), "m/s"),
        Finding::at_least("and it is more than rounding", plain[1], SICONOS_PER_STEP, "m/s"),
    ])
}
