//! One spinning ball of 1 kg, 1 mm deep, with 1, 3, 4 and 6 contact directions (sliding, torsion, rolling): MuJoCo's R, a_ref, f and a from
//! our formulas.
//!
//! A pyramid's edges are n ± μ_j times row j, with one R for all; an elliptic cone is Σ(f_j/μ_j)² ≤ f_n² with R_j μ_j² the same for every
//! j. The minimiser is that of ½‖a − a₀‖²_M + s(Ja − a_ref), written for velocities with h = 1 s.

use crate::top::facts;
use libtest_mimic::Failed;
use moreau::checks::Finding;
use moreau::schemes::mujoco::Softness;
use moreau::solvers::gauss::{GaussProgram, SoftPiece};
use moreau::solvers::{GaussConjugateGradient, GaussNewton, GaussSweeps};
use moreau::tolerance::references::ENGINE_ROUNDING;
use nalgebra::{DMatrix, DVector};
use serde_json::Value;
use std::path::Path;

/// The step of the stored experiment, MuJoCo's default [s].
const TIME_STEP: f64 = 0.002;

/// Findings about the stored experiment of this name, for instance `elliptic 6`.
pub fn check(root: &Path, name: &str) -> Result<Vec<Finding>, Failed> {
    let facts = facts(root)?;
    let stored = &facts["computed"]["one_contact"][name];
    let list = |key: &str| -> Result<Vec<f64>, Failed> {
        let numbers: Option<Vec<f64>> = stored[key].as_array().and_then(|values| values.iter().map(Value::as_f64).collect());
        numbers.ok_or_else(|| format!("{name}: no numbers `{key}`").into())
    };
    let (elliptic, dimension) = name.split_once(' ').ok_or("a cone and a dimension")?;
    let (elliptic, dimension) = (elliptic == "elliptic" || dimension == "1", dimension.parse::<usize>()?);
    let friction = &list("friction")?[..dimension - 1];
    let gap = stored["gap"].as_f64().ok_or("no gap")?;
    let softness = Softness::default();
    let pieces = if elliptic {
        let diagonal = softness.elliptic(gap, 1.0, friction);
        vec![match friction {
            [] => SoftPiece::OneSided { softness: diagonal[0] },
            [sliding, ..] => {
                SoftPiece::Cone { normal: diagonal[0], tangential: diagonal[1] * sliding * sliding, friction: friction.to_vec() }
            }
        }]
    } else {
        vec![SoftPiece::OneSided { softness: softness.pyramidal(gap, 1.0, friction[0]) }; 2 * (dimension - 1)]
    };
    let velocity = list("efc_vel")?;
    let reference = if elliptic {
        softness.reference_acceleration(TIME_STEP, gap, &velocity)
    } else {
        velocity.iter().map(|u| softness.reference_acceleration(TIME_STEP, gap, &[*u])[0]).collect()
    };
    let relative = |ours: &[f64], theirs: &[f64]| {
        let size = theirs.iter().fold(0.0f64, |size, x| size.max(x.abs()));
        ours.iter().zip(theirs).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / size
    };
    let ours: Vec<f64> = pieces.iter().flat_map(SoftPiece::softness).collect();
    let mut findings = vec![
        Finding::at_most("efc_R, relative", relative(&ours, &list("efc_R")?), ENGINE_ROUNDING, "1"),
        Finding::at_most("efc_aref, relative", relative(&reference, &list("efc_aref")?), ENGINE_ROUNDING, "1"),
    ];
    let jacobian = DMatrix::from_row_slice(velocity.len(), 6, &list("jacobian")?);
    let (free, stored_acceleration) = (DVector::from_vec(list("qacc_smooth")?), DVector::from_vec(list("qacc")?));
    let offset = &jacobian * &free - DVector::from_vec(reference);
    let program = GaussProgram::new(DMatrix::from_diagonal(&DVector::from_vec(list("mass")?)), jacobian, offset, pieces)?;
    let start = || DVector::zeros(6);
    let newton = GaussNewton::default().minimise(&program, start())?;
    let force = list("efc_force")?;
    findings.push(Finding::at_most(
        "efc_force against our Newton, relative",
        relative(newton.impulse.as_slice(), &force),
        ENGINE_ROUNDING,
        "1",
    ));
    let acceleration = &newton.change + free;
    let far = relative(acceleration.as_slice(), stored_acceleration.as_slice());
    findings.push(Finding::at_most("qacc against our Newton, relative", far, ENGINE_ROUNDING, "1"));
    for (solver, other) in
        [("cg", GaussConjugateGradient::default().minimise(&program, start())), ("gauss-pgs", GaussSweeps::default().minimise(&program)?)]
    {
        let far = relative(other.impulse.as_slice(), newton.impulse.as_slice());
        findings.push(Finding::at_most(format!("{solver} against Newton, relative"), far, ENGINE_ROUNDING, "1"));
    }
    Ok(findings)
}
