//! The engine's own arrays against the formulas of its contact model: R, k, b, the reference acceleration, the shift.

use crate::document::Document;
use libtest_mimic::Failed;
use moreau::checks::Finding;
use moreau::closed_forms::drake_sap::{SapContact, TANGENTIAL_RATIO};
use moreau::closed_forms::mujoco_contact::ContactParameters;
use moreau::problem::{ContactProblem, Solution};
use moreau::solvers::{ContactSolver, SemiAnalyticPrimal};
use moreau::tolerance::references as tolerance;
use nalgebra::{DMatrix, DVector};
use serde_json::Value;

/// Findings about the arrays the engine stored beside its step.
pub fn check(document: &Document, problem: &ContactProblem) -> Result<Vec<Finding>, Failed> {
    match document.engine() {
        "mujoco" => mujoco(document, problem),
        _ => drake(document, problem),
    }
}

/// The contact parameters a MuJoCo run was given.
pub fn parameters(options: &Value) -> Result<ContactParameters, Failed> {
    let list = |key: &str| -> Option<Vec<f64>> { options[key].as_array()?.iter().map(Value::as_f64).collect() };
    let reference = list("solref").and_then(|values| values.try_into().ok()).ok_or("options.solref has two numbers")?;
    let impedance = list("solimp").and_then(|values| values.try_into().ok()).ok_or("options.solimp has five numbers")?;
    let impedance_ratio = options["impratio"].as_f64().ok_or("options.impratio is a number")?;
    Ok(ContactParameters { reference, impedance, impedance_ratio })
}

/// h b = u_free + shift row by row; R_n = (1 − d)/d·Â, R_t = R_n/impratio (elliptic); a_ref,n = −b u_n + k d δ.
fn mujoco(document: &Document, problem: &ContactProblem) -> Result<Vec<Finding>, Failed> {
    let h = document.number(&["native", "time_step"])?;
    let parameters = parameters(&document.value["problem"]["provenance"]["options"])?;
    let (stiffness, damping) = parameters.stiffness_and_damping(h);
    let [softness, reference, approximation, depth, velocity] =
        ["efc_R", "efc_aref", "efc_diagA", "efc_pos", "efc_vel"].map(|key| document.vector(&["native", key]));
    let (softness, reference, approximation, depth, velocity) = (softness?, reference?, approximation?, -depth?, velocity?);
    let elliptic = document.value["native"]["cone"].as_str() == Some("elliptic");
    let mut worst = [0.0f64; 3];
    let per_contact = softness.len() / problem.contacts();
    for row in 0..softness.len() {
        let first = row - row % per_contact;
        let d = parameters.impedance_at(depth[first]);
        let ratio = if elliptic && row > first { parameters.impedance_ratio } else { 1.0 };
        let expected = parameters.normal_regularisation(depth[first], approximation[first]) / ratio;
        worst[0] = worst[0].max((softness[row] / expected - 1.0).abs());
        let spring = if elliptic && row > first { 0.0 } else { stiffness * d * depth[first] };
        let acceleration = spring - damping * velocity[row];
        worst[1] = worst[1].max((reference[row] - acceleration).abs() / (spring + damping * velocity[row].abs() + 1.0));
    }
    if elliptic {
        let offset = document.vector(&["native", "efc_b"])? * h - problem.free_velocity() - problem.shift();
        worst[2] = offset.amax() / (problem.free_velocity() + problem.shift()).amax();
    }
    let names = ["R against (1 − d)/d·Â", "a_ref against −b u + k d δ", "h·b against u_free + shift"];
    Ok(names.iter().zip(worst).map(|(name, difference)| Finding::at_most(*name, difference, tolerance::ENGINE_ROUNDING, "1")).collect())
}

/// R_n = max(w/4π², 1/(hk(h + τ))), R_t = σw with w = ‖J_i diag(M)⁻¹ J_iᵀ‖_F/3, shift_n = φ/(h + τ), all from M, J, φ, k and τ;
/// and the sliding gap φ = (h + τ)[μ‖v_t‖ − (R_n + μ²R_t) r_n − u_n] where a contact slips.
fn drake(document: &Document, problem: &ContactProblem) -> Result<Vec<Finding>, Failed> {
    let [h, stiffness, relaxation_time] = ["time_step", "stiffness", "relaxation_time"].map(|key| document.number(&["native", key]));
    let (h, stiffness, relaxation_time) = (h?, stiffness?, relaxation_time?);
    let gap = document.vector(&["native", "phi"])?;
    let answer = Solution::from_json(&document.value["answer"].to_string())?;
    let dynamics = problem.dynamics().ok_or("a stored step gives mass and Jacobian")?;
    let inverse_diagonal = DMatrix::from_diagonal(&dynamics.mass.diagonal().map(|m| 1.0 / m));
    let diagonal = &problem.compliance().ok_or("a SAP step is compliant")?.diagonal;
    let mut worst = [0.0f64; 3];
    for contact in 0..problem.contacts() {
        let rows = dynamics.jacobian.rows(3 * contact, 3);
        let friction = problem.friction()[contact];
        let diagonal_mean = (rows * &inverse_diagonal * rows.transpose()).norm() / 3.0;
        let sap = SapContact { time_step: h, stiffness, relaxation_time, diagonal_mean, tangential_ratio: TANGENTIAL_RATIO, friction };
        let [normal, tangential] = [sap.normal_regularisation(), sap.tangential_regularisation()];
        worst[0] = worst[0].max((diagonal[3 * contact] / normal - 1.0).abs()).max((diagonal[3 * contact + 1] / tangential - 1.0).abs());
        worst[1] = worst[1].max((problem.shift()[3 * contact] * (h + relaxation_time) / gap[contact] - 1.0).abs());
        let (r, u) = (answer.impulse.rows(3 * contact, 3), answer.velocity.rows(3 * contact, 3));
        if document.name.starts_with("block_slide") {
            let predicted = sap.sliding_gap(u[1].hypot(u[2]), r[0] / h) - (h + relaxation_time) * u[0];
            worst[2] = worst[2].max((predicted / gap[contact] - 1.0).abs());
        }
    }
    let sliding = tolerance::sap_sliding_gap();
    let (distance, allowed) = next_velocities(document, problem)?;
    Ok(vec![
        Finding::at_most("next velocities against our SAP's, in kinetic norm", distance, allowed, "kg^½·m/s"),
        Finding::at_most("R against SAP's formula", worst[0], tolerance::ENGINE_ROUNDING, "1"),
        Finding::at_most("shift against φ/(h + τ)", worst[1], tolerance::ENGINE_ROUNDING, "1"),
        Finding::at_most("sliding gap against (h + τ)[μ‖v_t‖ − (R_n + μ²R_t) r_n − u_n]", worst[2], sliding, "1"),
    ])
}

/// ‖v_next − v_free − M⁻¹Hᵀr‖_M with r from our own SAP, and how far the engine's stopping rule allows it to be.
fn next_velocities(document: &Document, problem: &ContactProblem) -> Result<(f64, f64), Failed> {
    let dynamics = problem.dynamics().ok_or("a stored step gives mass and Jacobian")?;
    let inverse = dynamics.mass.clone().cholesky().ok_or("the mass is positive definite")?;
    let received = dynamics.jacobian.tr_mul(&SemiAnalyticPrimal.solve(problem, None)?.impulse);
    let [free, next] = ["v_free", "v_next"].map(|key| document.vector(&["native", key]));
    let (free, next) = (free?, next?);
    let difference = &next - free - inverse.solve(&received);
    let kinetic = |vector: &DVector<f64>| vector.dot(&(&dynamics.mass * vector)).sqrt();
    let allowed = tolerance::sap_velocity(&dynamics.mass, &(&dynamics.mass * &next), &received);
    Ok((kinetic(&difference), allowed + moreau::tolerance::rounding(64, kinetic(&next))))
}
