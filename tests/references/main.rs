//! One named trial per stored engine run: `cargo test --test references mujoco/block_stick` runs some of them.
//!
//! A trajectory is held against the closed form of the engine's own contact model and against Signorini–Coulomb with the difference
//! derived; a step problem is solved again by our solvers and the engine's answer judged by our certificate.
//! `MOREAU_FINDINGS=1` prints every finding, not only those that fail.

mod answers;
mod ball;
mod block;
mod bullet;
mod bullet_steps;
mod contact_dimensions;
mod convexity;
mod dart;
mod document;
mod dumps;
mod dumps_native;
mod facts;
mod inverse;
mod momentum;
mod planted;
mod rapier;
mod replay;
mod replayed_contacts;
mod siconos;
mod soft_motion;
mod soft_step;
mod stack;
mod top;
mod trajectories;
mod turning;

use document::{Document, stored};
use libtest_mimic::{Arguments, Failed, Trial};
use moreau::checks::Finding;
use std::path::Path;

fn main() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("references");
    let mut trials = Vec::new();
    for engine in ["mujoco", "drake", "bullet", "pinocchio", "dart", "rapier"] {
        for file in stored(&root.join(engine)) {
            let stem = file.file_name().map(|name| name.to_string_lossy().replace(".json", "")).unwrap_or_default();
            trials.push(Trial::test(format!("{engine}/{stem}"), move || judge(&file)));
        }
    }
    for file in stored(&root.join("siconos")) {
        let stem = file.file_name().map(|name| name.to_string_lossy().replace(".json", "")).unwrap_or_default();
        trials.push(Trial::test(format!("siconos/{stem}"), move || conclude(siconos::check(&file)?)));
    }
    for file in stored(&root.join("facts")) {
        let stem = file.file_name().map(|name| name.to_string_lossy().replace(".json", "")).unwrap_or_default();
        trials.push(Trial::test(format!("facts/{stem}"), move || judge(&file)));
    }
    assert!(!trials.is_empty(), "no stored reference under {}", root.display());
    let folder = root.join("mujoco");
    for solver in ["pgs", "cg"] {
        let folder = folder.clone();
        let name = format!("mujoco_{solver}_leaves_some_step_unconverged_and_the_certificate_says_so");
        trials.push(Trial::test(name, move || dumps::some_unconverged(&folder, solver)));
    }
    for dimension in [1, 3, 4, 6] {
        for cone in ["elliptic", "pyramidal"] {
            let root = root.clone();
            let name = format!("mujoco_one_contact_with_{dimension}_directions_{cone}");
            trials.push(Trial::test(name, move || conclude(contact_dimensions::check(&root, &format!("{cone} {dimension}"))?)));
        }
    }
    for name in ["elliptic 3", "elliptic 6", "pyramidal 3", "pyramidal 6"] {
        let (root, trial) = (root.clone(), format!("mujoco_inverse_dynamics_{}", name.replace(' ', "_")));
        trials.push(Trial::test(trial, move || conclude(inverse::check(&root, name)?)));
    }
    for name in ["Euler", "implicitfast", "RK4"] {
        let (root, trial) = (root.clone(), format!("mujoco_energy_of_a_top_under_{name}"));
        trials.push(Trial::test(trial, move || conclude(top::check(&root, name)?)));
    }
    libtest_mimic::run(&Arguments::from_args(), trials).exit();
}

fn judge(file: &Path) -> Result<(), Failed> {
    let document = Document::read(file)?;
    let findings = match document.schema() {
        "answer/1" => answers::check(&document)?,
        "facts/1" => facts::check(&document)?,
        "repositories/1" => facts::repositories(&document)?,
        "literature/1" => facts::literature(&document)?,
        "bullet-steps/1" => [document.provenance()?, bullet_steps::check(&document)?].concat(),
        "dump/1" => [document.provenance()?, dumps::check(&document)?].concat(),
        "contact-geometry/1" => [document.provenance()?, replayed_contacts::check(&document)?].concat(),
        "trajectory/1" => [document.provenance()?, trajectories::check(&document)?].concat(),
        other => return Err(format!("{}: unknown schema `{other}`", file.display()).into()),
    };
    conclude(findings)
}

/// Prints what holds if asked, and fails with what does not.
fn conclude(findings: Vec<Finding>) -> Result<(), Failed> {
    let (held, failed): (Vec<&Finding>, Vec<&Finding>) = findings.iter().partition(|finding| finding.holds());
    if std::env::var_os("MOREAU_FINDINGS").is_some() {
        held.iter().for_each(|finding| println!("  {finding}"));
    }
    if failed.is_empty() {
        return Ok(());
    }
    Err(failed.iter().map(|finding| format!("\n  FAILS {finding}")).collect::<String>().into())
}
