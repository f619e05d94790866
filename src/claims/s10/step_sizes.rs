//! §10, the step sizes of the table.

use crate::Result;
use crate::checks::Finding;
use crate::claims::experiments::stored::standing;
use crate::claims::{Claim, ClaimVerdict, Evidence, Kind, Reading};
use crate::tolerance::claims::SAME_CREEP;

pub const CLAIMS: &[Claim] = &[Claim {
    id: "S10.h-ranges",
    statement: "Typical step sizes: Siconos 1e-5 to 1e-3 s, TAMSI 1e-3, SAP and MuJoCo 1e-3 to 1e-2, Chrono 1e-3, Bullet 1e-3 to 1/60, \
        Pinocchio 1e-4 to 5e-3.",
    verdict: ClaimVerdict::Ambiguous,
    kind: Kind::Assertion,
    severity: None,
    evidence: Evidence::Measured,
    correct_statement: "What is typical is usage and not decidable. The defaults that can be read are MuJoCo 2e-3, Drake's plant 1e-3, \
        Bullet's stepping 1/60 (PyBullet 1/240), all within. One end of a range means something in the code: beyond 1e-2 s MuJoCo's \
        default contact, timeconst 0.02 s, is no longer the one that was asked for, because refsafe stretches timeconst to 2h.",
    argument: "Stored runs of MuJoCo 3.17.0, block that Coulomb holds, creep: the same at 1/1000 and 1/240 s, 1.56 times as much at 1/60 \
        s.",
    control: "1/60 s expected to behave like 1/240 s.",
    sources: &["chapter §10, table of simulators", "the packages mujoco 3.17.0, drake 1.51.1 and pybullet 3.2.7, for the defaults"],
    check: stretched,
}];

const MUJOCO: &str = "scoreboard/mujoco-elliptic.json";

/// Creep speed of MuJoCo's block at the step of this many per second \[m/s\].
fn creep(steps_per_second: f64) -> Result<f64> {
    standing(MUJOCO, "incline/stick", 1.0 / steps_per_second, "creep speed")
}

fn stretched(reading: Reading) -> Result<Vec<Finding>> {
    let (fine, middle, coarse) = (creep(1000.0)?, creep(240.0)?, creep(60.0)?);
    let limit = 0.02 / 2.0;
    Ok(vec![
        Finding::decision("the creep at 1/60 s differs", (coarse / middle - 1.0).abs() > SAME_CREEP, reading.pick(true, false)),
        Finding::at_most("relative difference of the creep at 1/240 and 1/1000 s", (fine / middle - 1.0).abs(), SAME_CREEP, "1"),
        Finding::decision("1/240 s is below timeconst/2 and 1/60 s above", 1.0 / 240.0 < limit && limit < 1.0 / 60.0, true),
    ])
}
