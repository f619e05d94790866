//! A stored MuJoCo step from our own formulas: R and a_ref from `solref`, `solimp`, gaps and velocities; forces and accelerations by our
//! Newton.
//!
//! # How near the accelerations must be
//! ½‖a − a₀‖²_M + s(Ja − a_ref) is strongly convex with modulus 1 in the norm of M. A primal solver that stops at a with the gradient
//! g = M(a − a₀) − Jᵀf is therefore within ‖g‖_{M⁻¹} of the minimiser in that norm, and its forces f = −∇s are within as much in the norm
//! of R, because −∇s is cocoercive in it: ‖Δa‖²_M + ‖Δf‖²_R ≤ gᵀΔa. The gradient is computed from the stored arrays. A dual solver's a has
//! no gradient with its own forces; those that a itself asks for have one.

use crate::document::Document;
use crate::dumps_native::parameters;
use libtest_mimic::Failed;
use moreau::checks::Finding;
use moreau::problem::ContactProblem;
use moreau::scenes::Scene;
use moreau::schemes::mujoco::Softness;
use moreau::solvers::GaussNewton;
use moreau::solvers::gauss::GaussProgram;
use moreau::tolerance::references as tolerance;
use nalgebra::DVector;
use std::path::Path;

/// Every finding about one MuJoCo dump.
pub fn check(document: &Document, problem: &ContactProblem) -> Result<Vec<Finding>, Failed> {
    let mut findings = rows(document)?;
    findings.extend(step(document, problem)?);
    Ok(findings)
}

/// Whether the engine went on until rounding was all that is left.
pub fn is_converged(document: &Document) -> bool {
    document.value["provenance"]["options"]["tolerance"].as_f64() == Some(tolerance::CONVERGED_MUJOCO)
}

/// The parameters of a run as the scheme takes them.
pub fn softness(options: &serde_json::Value) -> Result<Softness, Failed> {
    let given = parameters(options)?;
    Ok(Softness { reference: given.reference, impedance: given.impedance, impedance_ratio: given.impedance_ratio, ..Softness::default() })
}

/// efc_R and efc_aref, row by row; Â from the masses of the scene's bodies.
fn rows(document: &Document) -> Result<Vec<Finding>, Failed> {
    let softness = softness(&document.value["problem"]["provenance"]["options"])?;
    let h = document.number(&["native", "time_step"])?;
    let [stored_r, stored_reference, gap, velocity] =
        ["efc_R", "efc_aref", "efc_pos", "efc_vel"].map(|key| document.vector(&["native", key]));
    let (stored_r, stored_reference, gap, velocity) = (stored_r?, stored_reference?, gap?, velocity?);
    let elliptic = document.value["native"]["cone"].as_str() == Some("elliptic");
    let masses = inverse_masses(document)?;
    let per_contact = stored_r.len() / masses.len();
    let mut worst = [0.0f64; 2];
    for (contact, (inverse_mass, mu)) in masses.iter().enumerate() {
        let range = contact * per_contact..(contact + 1) * per_contact;
        let u = &velocity.as_slice()[range.clone()];
        let gap = gap[range.start];
        let (softness_of_rows, reference) = if elliptic {
            (softness.elliptic(gap, *inverse_mass, &[*mu; 2]), softness.reference_acceleration(h, gap, u))
        } else {
            let edge = |u: &f64| softness.reference_acceleration(h, gap, &[*u])[0];
            (vec![softness.pyramidal(gap, *inverse_mass, *mu); 4], u.iter().map(edge).collect())
        };
        for (k, row) in range.enumerate() {
            worst[0] = worst[0].max((softness_of_rows[k] / stored_r[row] - 1.0).abs());
            worst[1] = worst[1].max((reference[k] - stored_reference[row]).abs());
        }
    }
    Ok(vec![
        Finding::at_most("efc_R from solimp, gaps and the bodies' masses, relative", worst[0], tolerance::ENGINE_ROUNDING, "1"),
        Finding::at_most(
            "efc_aref from solref, solimp, gaps and velocities, relative",
            worst[1] / stored_reference.amax(),
            tolerance::ENGINE_ROUNDING,
            "1",
        ),
    ])
}

/// Σ 1/m of the two bodies of every contact, and its μ.
fn inverse_masses(document: &Document) -> Result<Vec<(f64, f64)>, Failed> {
    let file = document.value["provenance"]["scene"].as_str().ok_or("no scene")?;
    let scene = Scene::read(&Path::new(env!("CARGO_MANIFEST_DIR")).join("references").join(file))?;
    let of_body = |name: &serde_json::Value| {
        scene.bodies.iter().find(|body| Some(body.name.as_str()) == name.as_str()).map_or(0.0, |body| 1.0 / body.mass)
    };
    let contacts = document.value["native"]["contacts"].as_array().ok_or("no contacts")?;
    let of = |contact: &serde_json::Value| {
        let bodies = contact["bodies"].as_array()?;
        Some((bodies.iter().map(of_body).sum(), contact["mu"].as_f64()?))
    };
    contacts.iter().map(|contact| of(contact).ok_or_else(|| "a contact has bodies and mu".into())).collect()
}

/// efc_force and qacc from our own Newton on the problem.
fn step(document: &Document, problem: &ContactProblem) -> Result<Vec<Finding>, Failed> {
    let h = document.number(&["native", "time_step"])?;
    let program = GaussProgram::of_problem("newton", problem)?;
    let ours = GaussNewton::default().minimise(&program, DVector::zeros(program.velocities()))?;
    let own_gradient = program.relative_gradient(&ours.change, &ours.impulse);
    let stored = (document.vector(&["native", "qacc"])? - document.vector(&["native", "qacc_smooth"])?) * h;
    let energy = |x: &DVector<f64>| x.dot(&program.mass().times(x)).sqrt();
    let asked = program.impulse(&program.violation(&stored));
    let left = program.gradient(&stored, &asked);
    let left = left.dot(&program.accelerate(&left)).max(0.0).sqrt();
    let distance = energy(&(&stored - &ours.change));
    let rounding = tolerance::ENGINE_ROUNDING * energy(&stored);
    let mut findings = vec![
        Finding::at_most("our Newton: relative gradient", own_gradient, tolerance::OUR_SOLVERS, "1"),
        Finding::at_most("velocity change against our Newton, within the gradient the engine left", distance, left + rounding, "kg^½·m/s"),
    ];
    if document.config().starts_with("newton") {
        let force = force(document)? * h;
        let root = DVector::from_iterator(force.len(), program.pieces().flat_map(|(_, piece)| piece.softness())).map(f64::sqrt);
        let size = |r: &DVector<f64>| r.component_mul(&root).norm();
        let difference = size(&(&force - &ours.impulse));
        let rounding = tolerance::ENGINE_ROUNDING * size(&force);
        findings.push(Finding::at_most(
            "efc_force against our Newton, within the gradient the engine left",
            difference,
            left + rounding,
            "kg^½·m/s",
        ));
        let relative = (distance / energy(&stored)).max(difference / size(&force));
        findings.push(Finding::at_most("qacc and efc_force against our Newton, relative", relative, tolerance::REPLAYED_STEP, "1"));
        if is_converged(document) {
            let promised = tolerance::CONVERGED_STEP;
            findings.push(Finding::at_most("the same, engine run to the end", relative, promised, "1"));
        }
    }
    Ok(findings)
}

/// efc_force in the program's order of rows: MuJoCo's edges are n ± μ t₁, n ± μ t₂, the program's go around the circle.
fn force(document: &Document) -> Result<DVector<f64>, Failed> {
    let force = document.vector(&["native", "efc_force"])?;
    if document.value["native"]["cone"].as_str() == Some("elliptic") {
        return Ok(force);
    }
    let order = [0, 2, 1, 3];
    Ok(DVector::from_fn(force.len(), |row, _| force[row - row % 4 + order[row % 4]]))
}
