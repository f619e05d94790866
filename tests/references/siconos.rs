//! Siconos's stored steps against ours, from each of its own states, and the whole motion from its start.

use libtest_mimic::Failed;
use moreau::checks::Finding;
use moreau::checks::siconos_steps::SiconosSteps;
use moreau::tolerance::references::{SICONOS_PER_STEP, siconos_run};
use nalgebra::{DVector, dvector};
use std::path::Path;

/// The Debian package that made the files.
const VERSION: &str = "4.4.0+dfsg-2";

/// Every finding about one stored run.
pub fn check(file: &Path) -> Result<Vec<Finding>, Failed> {
    let run = SiconosSteps::from_json(&std::fs::read_to_string(file)?)?;
    if file.to_string_lossy().contains("bead_bounce") {
        return stale_normal(&run);
    }
    let scheme = run.scheme(0.0)?;
    let mut findings = vec![Finding::decision("the package's version is the pinned one", run.version() == VERSION, true)];
    let allowed = run.tolerance().min(SICONOS_PER_STEP);
    for (name, unit, apart) in units(run.deviations(scheme.as_ref())?) {
        findings.push(Finding::at_most(format!("{name} of every step against Siconos's"), apart, allowed, unit));
    }
    let whole = run.whole_run(scheme.as_ref())?;
    findings.push(Finding::at_most("position of the whole run", whole, siconos_run(run.impulses.len(), run.tolerance()), "m"));
    let off = run.deviations(run.scheme(-0.25)?.as_ref())?;
    findings.push(Finding::decision("control: another θ is noticed", off.iter().any(|apart| *apart > allowed), true));
    if file.to_string_lossy().contains("bead__moreau-jean") {
        findings.extend(normals_ahead(&run)?);
    }
    Ok(findings)
}

fn units([position, velocity, impulse]: [f64; 3]) -> [(&'static str, &'static str, f64); 3] {
    [("position", "m", position), ("velocity", "m/s", velocity), ("impulse", "N·s", impulse)]
}

/// DIFFERENCE: the velocity that e reverses is H v_k with the normal of the step before, at q_{k−1} + h v_{k−1}; ours is H(q_k) v_k. Read off the first impact:
/// n = (v_{k+1} − v_k − h g)/r, and n·v_{k+1} = −e u.
fn stale_normal(run: &SiconosSteps) -> Result<Vec<Finding>, Failed> {
    let k = run.impulses.iter().position(|r| r[0] > 0.0).ok_or("the bead hits the circle")?;
    let mechanism = run.mechanism()?;
    let (earlier, before, after) = (run.state(k - 1), run.state(k), run.state(k + 1));
    let contact = |q: &DVector<f64>| mechanism.contacts(q).swap_remove(0);
    let along = |q: &DVector<f64>, v: &DVector<f64>| (contact(q).jacobian * v)[0];
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

/// DIFFERENCE: Siconos takes H at q + h v, we at q. On a circle the normals differ by the angle of a step, at most asin(h|v|/|q|), and where
/// both act the velocity by no more than the sine of it times |v_free|.
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
