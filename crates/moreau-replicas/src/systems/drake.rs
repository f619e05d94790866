//! Drake's four contact approximations, each held against Drake's own stored runs.
//!
//! ```text
//!     SAP       K_μ ∋ r ⟂ u⁺ + φ/(h + τ) n + R r ∈ K_μ* ,   R > 0
//!     Similar, Lagged, TAMSI     r_n = h k (δ − h u_n)₊ (1 − d u_n)₊ ,   friction regularised below a slip v_s
//! ```

use super::planted::{Kind, Measure, Planted, mistake};
use super::{Agreement, Cone, ConstraintLevel, ContactLaw, Measured, System};
use crate::drake::replay::Replay;
use crate::drake::{Material, by_name};
use crate::stored::{StoredRuns, read_by};
use moreau_checks::Finding;
use moreau_dynamics::schemes::Scheme;
use moreau_dynamics::trajectory::Trajectory;
use moreau_exact::Result;

const ENGINE: &str = "Drake 1.51.1";
const RESTITUTION: &str = "none; what dissipation leaves";
const POSITION: &str = "q + h v⁺";

/// One of Drake's approximations: all compliant, written on the gap at the end of the step, with the round cone.
const fn drake(
    name: &'static str,
    algorithm: &'static str,
    schemes: &'static [&'static str],
    held_against: &'static [Agreement],
) -> System {
    System {
        name,
        level: ConstraintLevel::Position,
        cone: Cone::SecondOrder,
        law: ContactLaw::Compliant,
        algorithm,
        restitution: RESTITUTION,
        position_update: POSITION,
        schemes,
        held_against,
    }
}

/// Velocities, weighed by the mass, against a stored motion of Drake's.
const fn velocity(
    quantity: &'static str,
    measure: fn(&dyn StoredRuns) -> Result<Measured>,
    planted: &'static [Planted<Measure>],
) -> Agreement {
    Agreement { against: ENGINE, quantity, unit: "kg^½·m/s", measure, planted }
}

/// The agreement of a stored motion, whole or step by step, with schemes that are not the one that made it.
macro_rules! agreement {
    ($how:ident, $name:literal, $quantity:literal, $($kind:ident $slug:literal $mistake:literal => $scheme:expr),+) => {
        velocity(
            $quantity,
            |runs| $how(runs, $name, None),
            &[$(mistake(Kind::$kind, $slug, $mistake, |runs| $how(runs, $name, Some($scheme)))),+],
        )
    };
}

/// The agreement of five boxes that land on each other, with boxes that are not those of the stored motion.
macro_rules! landing {
    ($name:literal) => {
        velocity(
            "velocity after every step of five boxes that land on each other, h = 5 ms",
            |runs| one_step(runs, $name, None),
            &[
                mistake(Kind::Reader, "systems/friction-larger", "friction 1 % larger", |runs| altered(runs, $name, rougher)),
                mistake(Kind::Reader, "systems/rounded-corners", "corners of 6 mm", |runs| altered(runs, $name, rounder)),
                mistake(Kind::Reader, "systems/narrower-box", "the first box a tenth narrower", |runs| altered(runs, $name, narrower)),
            ],
        )
    };
}

pub static SAP: System = drake(
    "Drake SAP",
    "Newton on velocities, analytic projection, exact line search",
    &["drake-sap"],
    &[
        agreement!(
            whole,
            "block_stick__sap__h0.01",
            "velocity of a block that sticks and creeps, whole motion, h = 10 ms",
            Assembly "systems/stiffness-larger" "stiffness 1 % larger" => |material| by_name("drake-sap", stiffer(material)),
            Assembly "systems/no-relaxation-time" "no relaxation time" => |material| by_name("drake-sap", prompt(material))
        ),
        agreement!(
            whole,
            "block_slide__sap__h0.001",
            "velocity of a sliding block, whole motion, h = 1 ms",
            Assembly "systems/stiffness-larger" "stiffness 1 % larger" => |material| by_name("drake-sap", stiffer(material)),
            Scheme "systems/lagged-law" "Lagged's law" => |material| by_name("drake-lagged", material)
        ),
        agreement!(
            one_step,
            "block_slide__sap__h0.01",
            "velocity after a step from each sample, sliding and hopping, h = 10 ms",
            Assembly "systems/stiffness-larger" "stiffness 1 % larger" => |material| by_name("drake-sap", stiffer(material)),
            Assembly "systems/no-relaxation-time" "no relaxation time" => |material| by_name("drake-sap", prompt(material)),
            Scheme "systems/lagged-law" "Lagged's law" => |material| by_name("drake-lagged", material)
        ),
        agreement!(
            one_step,
            "block_impact__sap__h0.001",
            "velocity after every step of a block that falls on three corners in turn, h = 1 ms",
            Assembly "systems/stiffness-larger" "stiffness 1 % larger" => |material| by_name("drake-sap", stiffer(material)),
            Scheme "systems/lagged-law" "Lagged's law" => |material| by_name("drake-lagged", material)
        ),
        landing!("stack_landing__sap__h0.005"),
    ],
);

pub static SIMILAR: System = drake(
    "Drake Similar",
    "Newton on velocities, convex potential, exact line search",
    &["drake-similar"],
    &[
        agreement!(
            whole,
            "block_slide__similar__h0.001",
            "velocity of a sliding block, whole motion, h = 1 ms",
            Assembly "systems/stiffness-larger" "stiffness 1 % larger" => |material| by_name("drake-similar", stiffer(material)),
            Scheme "systems/lagged-law" "Lagged's law" => |material| by_name("drake-lagged", material),
            Scheme "systems/tamsi-law" "TAMSI's law" => |material| by_name("drake-tamsi", material)
        ),
        agreement!(
            one_step,
            "block_stick__similar__h0.01",
            "velocity after a step from each sample, sticking, h = 10 ms",
            Assembly "systems/stiffness-larger" "stiffness 1 % larger" => |material| by_name("drake-similar", stiffer(material)),
            Scheme "systems/lagged-law" "Lagged's law" => |material| by_name("drake-lagged", material),
            Scheme "systems/tamsi-law" "TAMSI's law" => |material| by_name("drake-tamsi", material)
        ),
        agreement!(
            one_step,
            "block_impact__similar__h0.001",
            "velocity after every step of a block that falls on three corners in turn, h = 1 ms",
            Assembly "systems/stiffness-larger" "stiffness 1 % larger" => |material| by_name("drake-similar", stiffer(material)),
            Scheme "systems/lagged-law" "Lagged's law" => |material| by_name("drake-lagged", material),
            Scheme "systems/tamsi-law" "TAMSI's law" => |material| by_name("drake-tamsi", material)
        ),
        landing!("stack_landing__similar__h0.005"),
    ],
);

pub static LAGGED: System = drake(
    "Drake Lagged",
    "Newton on velocities, convex potential, exact line search",
    &["drake-lagged"],
    &[
        agreement!(
            whole,
            "block_slide__lagged__h0.001",
            "velocity of a sliding block, whole motion, h = 1 ms",
            Assembly "systems/stiffness-larger" "stiffness 1 % larger" => |material| by_name("drake-lagged", stiffer(material)),
            Scheme "systems/tamsi-law" "TAMSI's law" => |material| by_name("drake-tamsi", material),
            Scheme "systems/similar-law" "Similar's law" => |material| by_name("drake-similar", material)
        ),
        agreement!(
            one_step,
            "block_stick__lagged__h0.01",
            "velocity after a step from each sample, sticking, h = 10 ms",
            Assembly "systems/stiffness-larger" "stiffness 1 % larger" => |material| by_name("drake-lagged", stiffer(material)),
            Scheme "systems/tamsi-law" "TAMSI's law" => |material| by_name("drake-tamsi", material),
            Scheme "systems/similar-law" "Similar's law" => |material| by_name("drake-similar", material)
        ),
        agreement!(
            one_step,
            "block_impact__lagged__h0.001",
            "velocity after every step of a block that falls on three corners in turn, h = 1 ms",
            Assembly "systems/stiffness-larger" "stiffness 1 % larger" => |material| by_name("drake-lagged", stiffer(material)),
            Scheme "systems/tamsi-law" "TAMSI's law" => |material| by_name("drake-tamsi", material),
            Scheme "systems/similar-law" "Similar's law" => |material| by_name("drake-similar", material)
        ),
        landing!("stack_landing__lagged__h0.005"),
    ],
);

pub static TAMSI: System = drake(
    "Drake TAMSI",
    "Newton on velocities, residual halved along each step",
    &["drake-tamsi"],
    &[
        agreement!(
            whole,
            "block_slide__tamsi__h0.001",
            "velocity of a sliding block, whole motion, h = 1 ms",
            Assembly "systems/stiffness-larger" "stiffness 1 % larger" => |material| by_name("drake-tamsi", stiffer(material)),
            Scheme "systems/lagged-law" "Lagged's law" => |material| by_name("drake-lagged", material),
            Scheme "systems/similar-law" "Similar's law" => |material| by_name("drake-similar", material)
        ),
        agreement!(
            one_step,
            "block_stick__tamsi__h0.01",
            "velocity after a step from each sample, sticking, h = 10 ms",
            Assembly "systems/stiffness-larger" "stiffness 1 % larger" => |material| by_name("drake-tamsi", stiffer(material)),
            Scheme "systems/lagged-law" "Lagged's law" => |material| by_name("drake-lagged", material),
            Scheme "systems/similar-law" "Similar's law" => |material| by_name("drake-similar", material)
        ),
        agreement!(
            one_step,
            "block_impact__tamsi__h0.001",
            "velocity after every step of a block that falls on three corners in turn, h = 1 ms",
            Assembly "systems/stiffness-larger" "stiffness 1 % larger" => |material| by_name("drake-tamsi", stiffer(material)),
            Scheme "systems/lagged-law" "Lagged's law" => |material| by_name("drake-lagged", material),
            Scheme "systems/similar-law" "Similar's law" => |material| by_name("drake-similar", material)
        ),
        landing!("stack_landing__tamsi__h0.005"),
    ],
);

fn stiffer(material: Material) -> Material {
    Material { stiffness: 1.01 * material.stiffness, ..material }
}

fn prompt(material: Material) -> Material {
    Material { relaxation_time: 0.0, ..material }
}

/// What makes a scheme of the stored material; `None` is the scheme that the stored motion names.
type Other = Option<fn(Material) -> Result<Box<dyn Scheme>>>;

/// The velocity of the whole stored motion, in the kinetic norm: of a body of 1 kg, the speed.
fn whole(runs: &dyn StoredRuns, name: &str, scheme: Other) -> Result<Measured> {
    let [velocity, _] = replay(&stored(runs, name)?, scheme)?.whole()?;
    Ok(measured(velocity))
}

/// The velocity after the steps between two samples, from the stored state before.
fn one_step(runs: &dyn StoredRuns, name: &str, scheme: Other) -> Result<Measured> {
    Ok(measured(replay(&stored(runs, name)?, scheme)?.intervals()?))
}

/// The velocity after the steps between two samples, in a scene that differs from the scene of the stored motion.
fn altered(runs: &dyn StoredRuns, name: &str, alter: fn(&mut Trajectory)) -> Result<Measured> {
    let mut trajectory = stored(runs, name)?;
    alter(&mut trajectory);
    Ok(measured(replay(&trajectory, None)?.intervals()?))
}

fn rougher(trajectory: &mut Trajectory) {
    trajectory.scene.material.friction *= 1.01;
}

fn rounder(trajectory: &mut Trajectory) {
    trajectory.engine.options.insert("corner_radius".into(), 0.006.into());
}

fn narrower(trajectory: &mut Trajectory) {
    let first = trajectory.scene.bodies.iter_mut().take(1);
    first.filter_map(|body| body.cuboid.as_mut()).for_each(|cuboid| cuboid.half_extents[0] *= 0.9);
}

fn stored(runs: &dyn StoredRuns, name: &str) -> Result<Trajectory> {
    read_by(runs, &format!("drake/{name}.json"), Trajectory::from_json)
}

fn replay(stored: &Trajectory, scheme: Other) -> Result<Replay<'_>> {
    scheme.map_or_else(|| Replay::new(stored), |scheme| Replay::by(stored, scheme))
}

fn measured(finding: Finding) -> Measured {
    Measured::within(finding.measured, finding.expectation.value)
}
