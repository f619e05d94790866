//! §10, the step sizes of the table.

use crate::claims::experiments::stored::standing;
use crate::claims::lookups;
use crate::claims::prelude::*;
use crate::tolerance::claims::SAME_CREEP;

pub const CLAIMS: &[Claim] = &[Claim {
    id: "S10.h-ranges",
    statement: "Typical step sizes: Siconos 1e-5 to 1e-3 s, TAMSI 1e-3, SAP and MuJoCo 1e-3 to 1e-2, Chrono 1e-3, Bullet 1e-3 to 1/60, \
        Pinocchio 1e-4 to 5e-3.",
    verdict: ClaimVerdict::Ambiguous,
    kind: Kind::Assertion,
    severity: None,
    evidence: Evidence::NotDecidable,
    correct_statement: r"What is typical is usage and not decidable. The defaults that can be read are MuJoCo 2e-3, Drake's plant 1e-3,
        Bullet's stepping 1/60 (PyBullet 1/240), all within. One end of a range means something in the code: beyond 1e-2 s MuJoCo's
        default contact, timeconst 0.02 s, is no longer the one that was asked for, because refsafe stretches timeconst to $2h$.",
    argument: "Stored runs of MuJoCo 3.17.0, block that Coulomb holds, creep: the same at 1000 and at 240 steps per second, more than \
        1.5 times as much at 60.",
    controls: &[
        "The run at 1/240 s in place of that at 1/60 s.",
        "The run at 1/60 s in place of that at 1/1000 s; dampratio for timeconst, timeconst for the step; PyBullet's server for Bullet's \
            solver.",
    ],
    sources: &["chapter §10, table of simulators", "the packages mujoco 3.17.0, drake 1.51.1 and pybullet 3.2.7, for the defaults"],
    check: check!(stretched),
}];

const MUJOCO: &str = "scoreboard/mujoco-elliptic.json";

/// Creep speed of MuJoCo's block at the step of this many per second \[m/s\].
fn creep(steps_per_second: f64) -> Result<f64> {
    standing(MUJOCO, "incline/stick", 1.0 / steps_per_second, "creep speed")
}

fn stretched(reading: Reading) -> Result<Vec<Finding>> {
    let [coarse, fine] = [creep(reading.only(0).pick(60.0, 240.0))?, creep(reading.only(1).pick(1000.0, 60.0))?];
    let middle = creep(240.0)?;
    let typical = "which step sizes are typical";
    let mut findings = vec![
        Finding::decision("the creep at 1/60 s, beyond MuJoCo's range, differs", (coarse / middle - 1.0).abs() > SAME_CREEP, true)
            .opinion(typical)
            .experiment(),
        Finding::at_most("relative difference of the creep at 1/240 and 1/1000 s, within it", (fine / middle - 1.0).abs(), SAME_CREEP, "1")
            .experiment(),
    ];
    findings.extend(lookups::check("S10.h-ranges", reading)?);
    findings.push(Finding::at_least("creep at 1/60 s over that at 1/240 s", creep(60.0)? / middle, 1.5, "1").experiment().context());
    Ok(findings)
}
