//! The block on a 20° incline: creep of every engine in closed form where Coulomb's block sticks, and the momentum law of a slide.
//!
//! # Creep, where Coulomb says 0 (tan α < μ); four corners, Σ f_t = m g sin α
//! ```text
//!     MuJoCo, elliptic    b v = R_t,i f_t,i                     v = m g sin α / (b Σ 1/R_t,i)
//!     MuJoCo, pyramidal   R_i f_i± = (k d_i δ_i ± μ b v)₊       Σ μ (f_i⁺ − f_i⁻) = m g sin α determines v
//!     SAP                 v = σ w_i r_t,i                       v = σ h m g sin α / Σ 1/w_i ,  w_i = ‖J_i diag(M)⁻¹ J_iᵀ‖_F/3
//!     Similar, Lagged     tan α = μ s/√(1 + s²)                 v = v_s s
//!     TAMSI               tan α = μ s (2 − s)                   v = v_s s
//! ```
//! # Slide (tan α > μ)
//! Friction on the cone's boundary and opposed to slip gives v_t(T) + μ v_n(T) = g (sin α − μ cos α) T whatever the normal impulses do.

use crate::document::Document;
use crate::dumps_native::parameters;
use crate::momentum;
use libtest_mimic::Failed;
use moreau::checks::Finding;
use moreau::closed_forms::drake_sap::{diagonal_mean, shared_creep};
use moreau::closed_forms::mujoco_creep::HeldBody;
use moreau::closed_forms::regularised_friction::FrictionCurve;
use moreau::tolerance::references as tolerance;
use moreau::trajectory::Trajectory;
use nalgebra::{Matrix2, Matrix3, Quaternion, UnitQuaternion, Vector3};
use serde_json::Value;

/// The block in the frame of its incline at one sample.
pub struct Block {
    pub normal: Vector3<f64>,
    /// Down the slope.
    pub slope: Vector3<f64>,
    pub position: Vector3<f64>,
    pub velocity: Vector3<f64>,
    pub rotation: Matrix3<f64>,
    pub half: Vector3<f64>,
    pub mass: f64,
    /// g sin α and g cos α \[m/s²\].
    pub pull: f64,
    pub press: f64,
}

impl Block {
    pub fn at(trajectory: &Trajectory, sample: usize) -> Result<Self, Failed> {
        let (scene, track) = (&trajectory.scene, &trajectory.bodies[0]);
        let normal = Vector3::from(scene.ground.ok_or("the scene has a ground")?.normal);
        let gravity = Vector3::from(scene.gravity);
        let tangential = gravity - normal * gravity.dot(&normal);
        let [w, x, y, z] = track.orientation[sample];
        Ok(Block {
            normal,
            slope: tangential.normalize(),
            position: Vector3::from(track.position[sample]),
            velocity: Vector3::from(track.linear_velocity[sample]),
            rotation: UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z)).to_rotation_matrix().into_inner(),
            half: Vector3::from(scene.bodies[0].cuboid.ok_or("the block is a box")?.half_extents),
            mass: scene.bodies[0].mass,
            pull: tangential.norm(),
            press: -gravity.dot(&normal),
        })
    }

    /// Levers \[m\] of the four lower corners, each coordinate shortened by `inset` sideways.
    pub fn corners(&self, inset: f64) -> [Vector3<f64>; 4] {
        [[-1.0, -1.0], [-1.0, 1.0], [1.0, -1.0], [1.0, 1.0]]
            .map(|[x, y]| self.rotation * Vector3::new(x * (self.half.x - inset), y * (self.half.y - inset), -self.half.z))
    }

    fn depth(&self, lever: &Vector3<f64>) -> f64 {
        -(self.position + lever).dot(&self.normal)
    }

    /// Principal moments of inertia of the solid block \[kg·m²\].
    pub fn inertia(&self) -> Vector3<f64> {
        let square = self.half.map(|half| half * half);
        Vector3::new(square.y + square.z, square.x + square.z, square.x + square.y) * (self.mass / 3.0)
    }

    /// R diag(J) Rᵀ.
    fn world_inertia(&self) -> Matrix3<f64> {
        self.rotation * Matrix3::from_diagonal(&self.inertia()) * self.rotation.transpose()
    }

    /// K \[1/kg\]: the tangential velocity of a point at the lever, down the slope and across, per impulse there.
    pub fn tangential_response(&self, lever: &Vector3<f64>) -> Matrix2<f64> {
        let inverse = self.world_inertia().try_inverse().unwrap_or_else(|| Matrix3::repeat(f64::NAN));
        let tangents = [self.slope, self.normal.cross(&self.slope)];
        let turned = tangents.map(|tangent| lever.cross(&tangent));
        Matrix2::from_fn(|i, j| tangents[i].dot(&tangents[j]) / self.mass + turned[i].dot(&(inverse * turned[j])))
    }
}

/// The last sample's creep against the closed form; Coulomb's block does not move, so the creep is the difference.
pub fn stick(document: &Document, trajectory: &Trajectory) -> Result<Vec<Finding>, Failed> {
    let last = trajectory.times.len() - 1;
    let block = Block::at(trajectory, last)?;
    let friction = trajectory.scene.material.friction;
    let expected = match (document.engine(), document.config()) {
        ("mujoco", config) => mujoco_creep(trajectory, &block, friction, config.contains("pyramidal"))?,
        (_, "sap") => sap_creep(trajectory, &block),
        (_, config) => {
            let curve = if config == "tamsi" { FrictionCurve::Parabola } else { FrictionCurve::Sigmoid };
            let slip = curve.slip(block.pull / (friction * block.press)).ok_or("Coulomb's block sticks")?;
            stiction_tolerance(trajectory)? * slip
        }
    };
    let creep = block.velocity.dot(&block.slope);
    let before = Block::at(trajectory, last - 1)?;
    let unsteady = (creep - before.velocity.dot(&before.slope)).abs();
    let own = document.accuracy("bodies/linear_velocity", creep)? + unsteady + tolerance::CREEP_GEOMETRY * expected;
    let middle = Block::at(trajectory, last / 2)?;
    let moved = (block.position - middle.position).dot(&block.slope);
    let seconds = trajectory.times[last] - trajectory.times[last / 2];
    let drift = document.accuracy("bodies/position", block.position.norm())? + (own + unsteady) * seconds;
    Ok(vec![
        Finding::equal("creep speed (Coulomb: 0) against its own model", creep, expected, own, "m/s"),
        Finding::equal("displacement over the second half (Coulomb: 0) is that creep", moved, expected * seconds, drift, "m"),
    ])
}

fn mujoco_creep(trajectory: &Trajectory, block: &Block, friction: f64, pyramidal: bool) -> Result<f64, Failed> {
    let parameters = parameters(&Value::Object(trajectory.engine.options.clone()))?;
    let held = HeldBody { parameters, time_step: trajectory.time_step, diagonal: 1.0 / block.mass, friction };
    let depths = block.corners(0.0).map(|lever| block.depth(&lever));
    let load = block.mass * block.pull;
    Ok(if pyramidal { held.pyramidal_creep(&depths, load) } else { held.elliptic_creep(&depths, load) })
}

/// σ h m g sin α / Σ 1/w_i, with the mass matrix of the tilted block in world axes and corner spheres of the stored radius.
fn sap_creep(trajectory: &Trajectory, block: &Block) -> f64 {
    let radius = trajectory.engine.options.get("corner_radius").and_then(Value::as_f64).unwrap_or(0.0);
    let world = block.world_inertia();
    let means = block.corners(radius).map(|lever| diagonal_mean(block.mass, world.diagonal(), lever));
    shared_creep(trajectory.time_step, &means, block.mass * block.pull)
}

fn stiction_tolerance(trajectory: &Trajectory) -> Result<f64, Failed> {
    trajectory.engine.options.get("stiction_tolerance").and_then(Value::as_f64).ok_or_else(|| "no stiction tolerance stored".into())
}

/// The momentum law of the slide, and the acceleration of the engines that do not hop.
pub fn slide(document: &Document, trajectory: &Trajectory) -> Result<Vec<Finding>, Failed> {
    let last = trajectory.times.len() - 1;
    let (block, friction) = (Block::at(trajectory, last)?, trajectory.scene.material.friction);
    let (along, away) = (block.velocity.dot(&block.slope), block.velocity.dot(&block.normal));
    let exact = block.pull - friction * block.press;
    let time = trajectory.times[last];
    let mut findings = Vec::new();
    let accuracy = document.accuracy("bodies/linear_velocity", along)?;
    let lagged = document.config() == "lagged";
    if !lagged {
        let steps = document.number(&["provenance", "steps"])?;
        let unbalanced = (1.0 + friction) * momentum::unbalanced(document, trajectory, steps)? / block.mass;
        let slack = accuracy + unbalanced + regularisation(document, trajectory, &block, exact)?;
        findings.push(Finding::equal("v_t + μ v_n against g (sin α − μ cos α) T", along + friction * away, exact * time, slack, "m/s"));
    }
    if lagged || document.config() == "tamsi" {
        let before = Block::at(trajectory, last - 1)?;
        let interval = time - trajectory.times[last - 1];
        let slip = stiction_tolerance(trajectory)? / before.velocity.dot(&block.slope);
        let slack = 2.0 * accuracy / interval + 0.5 * friction * block.press * slip * slip;
        let acceleration = (along - before.velocity.dot(&block.slope)) / interval;
        findings.push(Finding::equal("sliding acceleration against Coulomb's", acceleration, exact, slack, "m/s²"));
        findings.push(Finding::equal("no lift-off: normal velocity", away, 0.0, accuracy, "m/s"));
    }
    Ok(findings)
}

/// Friction missing while the slip is too small to saturate it: v_s grows to the full force over slips of a few v_s, so the lost impulse
/// per mass is at most μ g cos α ∫ (1 − s/√(1+s²)) dt ≤ μ g cos α v_s/a for Drake's regularised laws and nothing for hard cones.
fn regularisation(document: &Document, trajectory: &Trajectory, block: &Block, acceleration: f64) -> Result<f64, Failed> {
    if ["similar", "tamsi"].contains(&document.config()) {
        return Ok(trajectory.scene.material.friction * block.press * stiction_tolerance(trajectory)? / acceleration);
    }
    Ok(0.0)
}
