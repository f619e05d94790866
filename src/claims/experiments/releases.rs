//! What releases of the engines hold: the source files that the chapter names, and Drake's default.
//!
//! The first control asks another release, or another setting, the second one for names that the chapter does not print.

use super::drake::{Facts as Drake, facts as drake_facts};
use super::facts;
use super::mujoco::facts as mujoco_facts;
use super::repositories::{CHRONO, DRAKE, MUJOCO, MUJOCO_SOLVERS, PINOCCHIO_3, SICONOS_450, SICONOS_2026};
use super::siconos::Facts as Siconos;
use crate::claims::prelude::*;
use std::collections::BTreeSet;

/// The findings, each of them a look-up.
fn looked_up(findings: Vec<Finding>) -> Result<Vec<Finding>> {
    Ok(findings.into_iter().map(Finding::looked_up).collect())
}

/// The files of Siconos that the chapter names.
const SICONOS_PRINTED: [&str; 4] = [
    "numerics/src/FrictionContact/fc3d_nsgs.c",
    "numerics/src/FrictionContact/fc3d_nonsmooth_Newton_AlartCurnier.c",
    "numerics/src/FrictionContact/gfc3d_ipm.c",
    "kernel/src/simulationTools/MoreauJeanOSI.cpp",
];

/// The same with the folder of other problems, and a folder that came later.
const SICONOS_OTHER: [&str; 4] = [
    "numerics/src/LCP/fc3d_nsgs.c",
    "numerics/src/LCP/fc3d_nonsmooth_Newton_AlartCurnier.c",
    "numerics/src/LCP/gfc3d_ipm.c",
    "kernel/src/simulation/MoreauJeanOSI.cpp",
];

/// Siconos: the libraries of 4.4.0, the trees of 4.5.0 and of August 2026.
///
/// # Errors
/// If the stored facts are not what the script writes.
pub fn siconos(reading: Reading) -> Result<Vec<Finding>> {
    let facts = Siconos::stored()?;
    let printed = reading.only(1).pick(SICONOS_PRINTED, SICONOS_OTHER);
    let [nsgs, newton, _, integrator] = printed;
    let function = reading.only(1).pick("gfc3d_ipm_set_default", "fc3d_ipm_set_default");
    let later = reading.only(0).pick(SICONOS_2026, SICONOS_450);
    looked_up(vec![
        Finding::decision("4.4.0: MoreauJeanOSI.cpp", facts.compiled(integrator), true),
        Finding::decision("4.4.0: fc3d_nsgs.c", facts.compiled(nsgs), true),
        Finding::decision("4.4.0: the Alart–Curnier file", facts.compiled(newton), true),
        Finding::decision("4.4.0: functions of gfc3d_ipm.c", facts.functions.iter().any(|name| name == function), true),
        Finding::count("Siconos 4.5.0: printed paths", SICONOS_450.count(&printed), 4),
        Finding::count("Siconos at 6070f0f6: printed paths", later.count(&printed), 2).says(4).violating("a release up to 4.5.0"),
    ])
}

/// MuJoCo 3.17.0 and its tree of August 2026.
///
/// # Errors
/// If the stored facts are not what the script writes.
pub fn mujoco(reading: Reading) -> Result<Vec<Finding>> {
    let facts = mujoco_facts()?;
    let prefixed = reading.only(1).pick(true, false);
    let name = |prefix: &str, rest: &str| format!("{}{rest}", if prefixed { prefix } else { "" });
    let files = ["solver.c", "core_constraint.c"].map(|file| name("engine_", file));
    let paths = files.clone().map(|file| format!("src/engine/{file}"));
    let functions = ["solPGS", "solCG", "solNewton"].map(|function| name("mj_", function));
    let mjx = name("mjx/", "_src/solver.py");
    let root = reading.only(0).pick("", "mjx/mujoco/");
    let exports = functions.iter().all(|function| MUJOCO_SOLVERS.contains(&function.as_str()));
    let mut findings = Vec::new();
    for (file, compiled) in ["engine_solver.c", "engine_core_constraint.c"].into_iter().zip(&files) {
        findings.push(Finding::decision(format!("compiled from {file}"), facts.lists(&["stated", "sources"], compiled), true));
    }
    let found = paths.iter().filter(|path| MUJOCO.has(path)).count();
    findings.extend([
        Finding::count("MuJoCo at a725507: printed paths of C files", found, 2),
        Finding::decision("mj_solPGS, mj_solCG and mj_solNewton", exports, true),
        Finding::decision("MJX's printed path from the package", MUJOCO.has_below("mjx/mujoco/", &mjx), true),
        Finding::decision("MJX's printed path from the repository", MUJOCO.has_below(root, "mjx/_src/solver.py"), false)
            .says(true)
            .violating("a path that starts at the Python package"),
    ]);
    looked_up(findings)
}

/// How many contact solvers are left of those that 1.51.1 offers, on a day after which deprecated ones are removed as announced.
fn solvers_on(facts: &Drake, day: &str) -> usize {
    let offered: BTreeSet<&String> = facts.solvers.values().collect();
    let removed = |solver: &str| solver == "kTamsi" && day >= facts.tamsi_removed_from.as_str();
    offered.into_iter().filter(|solver| !removed(solver)).count()
}

/// Drake's tree of August 2026, and its solvers.
///
/// # Errors
/// If the stored facts are not what the script writes.
pub fn drake(reading: Reading) -> Result<Vec<Finding>> {
    let facts = drake_facts()?;
    let (that_day, later) = ("2026-08-20", "2026-11-21");
    let printed = ["multibody/plant/tamsi_solver.cc", "multibody/contact_solvers/sap/sap_solver.cc"];
    let exchanged = ["multibody/contact_solvers/sap/tamsi_solver.cc", "multibody/plant/sap_solver.cc"];
    let paths = reading.only(1).pick(printed, exchanged);
    looked_up(vec![
        Finding::count("Drake at be259df7: printed paths", DRAKE.count(&paths), 2),
        Finding::count("contact solvers that day", solvers_on(&facts, reading.only(0).pick(that_day, later)), 2),
        Finding::count("contact solvers later", solvers_on(&facts, later), 1).context(),
    ])
}

/// The solver that a plant of Drake 1.51.1 takes.
///
/// # Errors
/// If the stored facts are not what the script writes.
pub fn drake_default(reading: Reading) -> Result<Vec<Finding>> {
    let facts = drake_facts()?;
    let default = reading.pick(&facts.default_solver, &facts.default_approximation);
    let convex: &[&str] = reading.pick(&["kSap", "kSimilar", "kLagged"], &["kSap", "kSimilar", "kLagged", "kTamsi"]);
    let takes_sap = convex.iter().all(|name| facts.solvers[*name] == "kSap");
    looked_up(vec![
        Finding::decision("the default is kSap", default == "kSap", true),
        Finding::decision("every approximation but TAMSI takes the solver kSap", takes_sap, true),
    ])
}

/// Chrono's tree of August 2026.
///
/// # Errors
/// None.
pub fn chrono(reading: Reading) -> Result<Vec<Finding>> {
    let folder = reading.pick("src/chrono/solver/", "src/chrono_multicore/solver/");
    let names = ["ChSolverAPGD.cpp", "ChSolverADMM.cpp", "ChSolverPSOR.cpp"];
    looked_up(names.map(|name| Finding::decision(format!("Chrono at 7689fbc: {name}"), CHRONO.has_below(folder, name), true)).to_vec())
}

/// The source distribution of PyBullet 3.2.7.
///
/// # Errors
/// If the stored facts are not what the script writes.
pub fn bullet(reading: Reading) -> Result<Vec<Finding>> {
    let printed = "src/BulletDynamics/ConstraintSolver/btSequentialImpulseConstraintSolver.cpp";
    let other = "src/BulletDynamics/MLCPSolvers/btSequentialImpulseConstraintSolver.cpp";
    let multibody = "src/BulletDynamics/Featherstone/btMultiBodyConstraintSolver.cpp";
    let package = facts::bullet()?.stated;
    looked_up(vec![
        Finding::decision(printed, package.has(reading.pick(printed, other)), true),
        Finding::decision(multibody, package.has(multibody), true).context(),
    ])
}

/// The files of Pinocchio 3 that the chapter names; the second is printed without the folder that it shares with the first.
const PINOCCHIO_PRINTED: [&str; 2] = ["include/pinocchio/algorithm/admm-solver.hxx", "include/pinocchio/algorithm/contact-cholesky.hpp"];

/// Pinocchio's tree of 3.7.0, and the wheel of 4.1.0.
///
/// # Errors
/// If the stored facts are not what the script writes.
pub fn pinocchio(reading: Reading) -> Result<Vec<Finding>> {
    let package = facts::pinocchio()?.stated;
    let of_package = PINOCCHIO_PRINTED.iter().filter(|path| package.has(path)).count();
    let of_release = reading.pick(PINOCCHIO_3.count(&PINOCCHIO_PRINTED), of_package);
    let moved = package.has("include/pinocchio/algorithm/solvers/admm-solver.hpp")
        && package.has("deprecated/pinocchio/algorithm/contact-cholesky.hpp");
    looked_up(vec![
        Finding::count("Pinocchio 3.7.0: printed paths", of_release, 2),
        Finding::count("Pinocchio 4.1.0: printed paths", of_package, 0).context(),
        Finding::decision("4.1.0: the new places", moved, true).context(),
    ])
}
