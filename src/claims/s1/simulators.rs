//! Which simulators step through events and which locate them.

use crate::claims::lookups::looked_up;
use crate::claims::prelude::*;

pub const CLAIMS: &[Claim] = &[Claim {
    id: "S1.all-ts",
    statement: "The engines of ROS, MuJoCo, Drake, Bullet, Pinocchio and Isaac are all time-stepping; only Siconos has both routes.",
    verdict: ClaimVerdict::False,
    kind: Kind::Assertion,
    severity: Some(Severity::WrongStatement),
    evidence: Evidence::Cited,
    correct_statement: "Siconos has both. Drake has more than time-stepping, too: a plant with time step 0 is a continuous system whose \
        integrator controls its error, with compliant contact and no located impact, and a system of one's own may have witness functions, \
        whose zeros the simulator locates. \
        ROS and Pinocchio are not simulators.",
    argument: "Asked of the packages: Siconos 4.4.0 has the classes TimeStepping and EventDriven; Drake 1.51.1 integrates a plant with \
        time step 0 by RungeKutta3Integrator under error control, and LeafSystem has MakeWitnessFunction. Bullet and Isaac were not \
        asked.",
    controls: &[
        "MuJoCo in the place of Drake: its stored facts name neither located events nor a continuous integrator.",
        "“EventTracking” in the place of EventDriven, the chapter's other word for it, which is no class of Siconos.",
    ],
    sources: &["chapter §1, table of the two routes", "references/facts/siconos.json", "references/facts/drake.json"],
    check: looked_up!("S1.all-ts"),
}];
