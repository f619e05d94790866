//! Reading a trajectory as mechanics: states as vectors, velocities of material points, components along a plane.

use crate::model::Model;
use crate::model::compression::LoadedPoint;
use crate::model::normal::Normal;
use crate::model::sliding::hops;
use crate::tolerance::conveyor::rounded_corner;
use crate::tolerance::metamorphic::vanishes;
use crate::tolerance::stack;
use crate::{Bench, Kind, Refusal, Reply};
use moreau_dynamics::scenes::Scene;
use moreau_dynamics::trajectory::BodyTrack;
use nalgebra::{Quaternion, UnitQuaternion, Vector3};

/// Bodies that lie on a plane start this far above it \[m\], 2⁻²⁶, so that all their corners touch in the same step and rounding does not
/// decide which do; in single precision it does, for coordinates of more than a centimetre.
pub(super) const CLEARANCE: f64 = 1.0 / (1u64 << 26) as f64;

/// Radius of the spheres of these families \[m\], and about the half extents of their boxes.
const SIZE: f64 = 0.1;

/// Where a body of mass m with some equal contacts starts above its plane \[m\]: at the depth that its declared law has at rest, so that no
/// landing disturbs what is measured; under Anitescu's law at the gap μ h v of its slip v; otherwise [`CLEARANCE`].
pub(super) fn start_gap(bench: &Bench, h: f64, (mass, contacts): (f64, f64), press: f64, friction: f64, slip: f64) -> f64 {
    let description = bench.description();
    let model = Model::of(description);
    let normal = Normal::spheres(&[(mass, SIZE)], press, friction, description.friction, h);
    if model == Model::Anitescu {
        return CLEARANCE + friction * h * slip;
    }
    let load = mass * press / contacts;
    let sprung = || model.sprung_depth(&LoadedPoint { load, inverse_mass: 1.0 / mass, on_ground: true });
    normal.rest_depth(&model, load).or_else(sprung).map_or(CLEARANCE, |depth| -depth)
}

/// Whether contacts yield by declaration: a compliant law, or a rigid one with springs or a penetration allowance. Such a body is not at
/// rest at once, and the lever of its contacts is shorter than its radius.
pub(super) fn yields(bench: &Bench) -> bool {
    let allowed = match Model::of(bench.description()) {
        Model::Coulomb(limits) => limits.penetration_allowance > 0.0 || limits.ground_contact_frequency > 0.0,
        _ => false,
    };
    allowed || bench.description().contact_model.kind == Kind::Compliant
}

/// The part of a depth that a step takes back by declaration, if nothing is left of the depth within so many steps but what solvers leave:
/// contacts open then, fall for a step and are pushed out again.
pub(super) fn opens_within(bench: &Bench, steps: usize) -> Option<f64> {
    let Model::Coulomb(limits) = Model::of(bench.description()) else { return None };
    let part = limits.taken_back();
    (limits.penetration_allowance == 0.0 && vanishes(part, steps as f64)).then_some(part)
}

/// Whether the points of a face that slides stay closed in so many steps, so that all of them slip as its middle does: rigid contacts that
/// open neither by their slip nor where a depth is taken back, laid down by a gap that rounding of coordinates of `size` \[m\] leaves
/// alike.
pub(super) fn stays_closed(bench: &Bench, steps: usize, size: f64) -> bool {
    let laid_alike = rounded_corner(bench.epsilon(), size) <= CLEARANCE;
    laid_alike && !yields(bench) && !hops(bench.description()) && opens_within(bench, steps).is_none()
}

/// Whether a declared error reduction lets boxes hop that nothing else moves: where they go then is not predicted.
pub(super) fn pushed_to_hop(bench: &Bench) -> bool {
    match Model::of(bench.description()) {
        Model::Coulomb(limits) => limits.penetration_allowance == 0.0 && stack::hops(limits.error_reduction),
        _ => false,
    }
}

/// Refuses the check to an engine whose declared error reduction lets boxes hop.
///
/// # Errors
/// `unsupported` with that reason.
pub(super) fn does_not_hop(bench: &Bench) -> Reply<()> {
    if pushed_to_hop(bench) {
        return Err(Refusal::unsupported(
            "the engine declares `error_reduction` of more than a third and no allowance: boxes that are pushed out hop, \
             and where they go is not predicted",
        ));
    }
    Ok(())
}

/// One body at one sample.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sample {
    pub position: Vector3<f64>,
    pub rotation: UnitQuaternion<f64>,
    pub velocity: Vector3<f64>,
    /// World frame.
    pub spin: Vector3<f64>,
}

impl Sample {
    /// Sample k of a track.
    pub fn of(track: &BodyTrack, k: usize) -> Self {
        let [w, x, y, z] = track.orientation[k];
        Sample {
            position: track.position[k].into(),
            rotation: UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z)),
            velocity: track.linear_velocity[k].into(),
            spin: track.angular_velocity[k].into(),
        }
    }

    /// Velocity \[m/s\] of the material point at `lever` \[m\] from the centre of mass.
    pub fn velocity_at(&self, lever: Vector3<f64>) -> Vector3<f64> {
        self.velocity + self.spin.cross(&lever)
    }
}

/// Every sample of a track.
pub(super) fn samples(track: &BodyTrack) -> Vec<Sample> {
    (0..track.position.len()).map(|k| Sample::of(track, k)).collect()
}

/// A plane under gravity: its axes and the components of gravity.
#[derive(Clone, Copy, Debug)]
pub(super) struct Slope {
    pub normal: Vector3<f64>,
    /// c of the plane n·x = c \[m\].
    pub offset: f64,
    /// Down the slope; x where the plane is level.
    pub down: Vector3<f64>,
    /// n × down.
    pub side: Vector3<f64>,
    /// g sin α \[m/s²\].
    pub pull: f64,
    /// g cos α \[m/s²\].
    pub press: f64,
}

impl Slope {
    /// The plane of a scene that has one.
    pub fn of(scene: &Scene) -> Option<Self> {
        let ground = scene.ground?;
        let (normal, gravity) = (Vector3::from(ground.normal), Vector3::from(scene.gravity));
        let press = -gravity.dot(&normal);
        let along = gravity + normal * press;
        let level = normal.y.hypot(normal.x) == 0.0;
        let down = if level { Vector3::x() } else { along.normalize() };
        let pull = if level { 0.0 } else { along.norm() };
        Some(Slope { normal, offset: ground.offset, down, side: normal.cross(&down), pull, press })
    }

    /// n·x − c \[m\].
    pub fn height(&self, point: &Vector3<f64>) -> f64 {
        self.normal.dot(point) - self.offset
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::checks::scenery::{GRAVITY, over_floor, sphere};
    use moreau_dynamics::scenes::Ground;
    use moreau_exact::tolerance::rounding;

    #[test]
    fn q_and_its_negative_are_one_orientation_to_every_check_that_reads_one() {
        let families = ["rocking/", "painleve/", "flight/", "round/", "tumbling/", "stack/three"];
        let reads = |check: &&crate::Check| families.iter().any(|family| check.name.starts_with(family));
        let each_step = |check: &&crate::Check| matches!(check.run, crate::Run::EachStep(_));
        for check in crate::checks::all().filter(reads).filter(each_step) {
            let values = |every: usize| {
                let negated = move |motion: &mut moreau_dynamics::trajectory::Trajectory| {
                    for (k, q) in motion.bodies.iter_mut().flat_map(|track| track.orientation.iter_mut().enumerate()) {
                        *q = q.map(|part| if (k + 1).is_multiple_of(every) { -part } else { part });
                    }
                };
                let measured = crate::exact::measure(check.name, 1.0 / 60.0, &mut crate::exact::Reporting(negated));
                measured.into_iter().map(|one| (one.verdict(), one.value)).collect::<Vec<_>>()
            };
            let plain = values(usize::MAX); // no sample of them
            // a change of all signs rounds nothing
            for every in [1, 2] {
                assert_eq!(plain, values(every), "{}", check.name);
            }
        }
    }

    #[test]
    fn gravity_splits_into_pull_and_press() {
        let mut scene = over_floor("slope", vec![sphere("ball", 1.0, 0.1, [0.0; 3])], 0.0);
        let (sine, cosine) = 0.3f64.sin_cos();
        scene.ground = Some(Ground { normal: [sine, 0.0, cosine], offset: 0.25 });
        let slope = Slope::of(&scene).expect("a plane");
        assert!((slope.pull - GRAVITY * sine).abs() + (slope.press - GRAVITY * cosine).abs() <= rounding(8, GRAVITY));
        assert!((slope.down - Vector3::new(cosine, 0.0, -sine)).norm() <= rounding(8, 1.0));
        assert!((slope.height(&(slope.normal * 2.0)) - 1.75).abs() <= rounding(8, 1.0));
        scene.ground = Some(Ground { normal: [0.0, 0.0, 1.0], offset: 0.0 });
        let floor = Slope::of(&scene).expect("a plane");
        assert_eq!((floor.down, floor.side, floor.pull), (Vector3::x(), Vector3::y(), 0.0));
    }

    #[test]
    fn the_lowest_point_of_a_rolling_ball_is_at_rest() {
        let track = BodyTrack {
            name: "ball".into(),
            position: vec![[0.0, 0.0, 0.1]],
            orientation: vec![[1.0, 0.0, 0.0, 0.0]],
            linear_velocity: vec![[2.0, 0.0, 0.0]],
            angular_velocity: vec![[0.0, 20.0, 0.0]],
        };
        let velocity = Sample::of(&track, 0).velocity_at(Vector3::new(0.0, 0.0, -0.1));
        assert!(velocity.norm() <= rounding(4, 2.0), "{velocity}");
    }
}
