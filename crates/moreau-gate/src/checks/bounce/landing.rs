//! A box that lands flat, and boxes that land on one corner.

use crate::checks::bounce::declared::Declared;
use crate::checks::bounce::scene::{GAP, PATIENCE, RESTITUTION, SPEED, steps_to_impact, weightless};
use crate::checks::motion::Sample;
use crate::checks::scenery::{between, cuboid};
use crate::model::solid::box_moments;
use crate::tolerance::bounce as tolerance;
use crate::{Bench, Expectation, Measurement, Reply};
use moreau_dynamics::scenes::{Body, Scene};
use moreau_forms::soft_rigid_contact::inverse_mass_at;
use nalgebra::{Matrix3, Quaternion, Rotation3, UnitQuaternion, Vector3};

/// \[kg\]
const MASS: f64 = 1.0;
/// Half extents of the box that lands flat \[m\].
const FLAT: [f64; 3] = [0.3, 0.2, 0.5];

/// Half extents of the boxes that land on a corner \[m\]: large, so that they turn slowly after it.
pub(super) const CORNERED: [(&str, [f64; 3]); 2] = [(", cube", [4.0; 3]), (", brick", [4.0, 3.0, 2.0])];

/// Principal moments \[kg·m²\].
pub(super) fn moments(half_extents: [f64; 3]) -> Vector3<f64> {
    box_moments(MASS, half_extents.into())
}

/// The state at the end of an impact over [`GAP`], and the time it took \[s\].
fn landed(bench: &mut Bench, scene: &Scene, h: f64) -> Reply<(Sample, f64)> {
    let steps = steps_to_impact(bench, GAP, SPEED, h)?;
    let motion = bench.simulate(scene, h, steps, steps)?;
    Ok((Sample::of(&motion.bodies[0], 1), steps as f64 * h))
}

pub(super) fn flat(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    let body = Body { linear_velocity: [0.0, 0.0, -SPEED], ..cuboid("box", MASS, FLAT, [0.0, 0.0, FLAT[2] + GAP]) };
    let (end, time) = landed(bench, &weightless("flat box", body, 0.0), h)?;
    let declared = Declared::of(bench, SPEED, time, h);
    let part = tolerance::solved(bench.epsilon());
    let impulse = (1.0 + RESTITUTION) * MASS * SPEED;
    let spin = tolerance::spin(part * impulse, FLAT, moments(FLAT).into());
    Ok(vec![
        Measurement::new("speed after over before", "1", end.velocity.z / SPEED, Expectation::equal(RESTITUTION, 2.0 * part, "v⁺ = −e v"))
            .predicted(declared.map(|law| law.rebound(2.0 * part))),
        Measurement::new("spin", "rad/s", end.spin.norm(), Expectation::at_most(0.0, spin, "the impulses' moments cancel")),
        Measurement::new(
            "sideways speed",
            "m/s",
            end.velocity.xy().norm(),
            Expectation::at_most(0.0, part * SPEED, "there is no friction"),
        ),
    ])
}

/// A box over the floor on its corner.
pub(super) fn on_corner(half_extents: [f64; 3]) -> Body {
    /// Angle \[rad\] of the lever off the vertical; the body rises after the impact.
    const LEAN: f64 = 0.3;
    /// Direction \[rad\] of the lean, along no axis of the box.
    const ACROSS: f64 = 1.1;
    let corner = -Vector3::from(half_extents);
    let lever = Vector3::new(ACROSS.cos() * LEAN.sin(), ACROSS.sin() * LEAN.sin(), -LEAN.cos()) * corner.norm();
    let rotation = UnitQuaternion::rotation_between(&corner, &lever).unwrap_or_default();
    let place = [0.0, 0.0, GAP - lever.z];
    let orientation = [rotation.w, rotation.i, rotation.j, rotation.k];
    Body { orientation, linear_velocity: [0.0, 0.0, -SPEED], ..cuboid("box", MASS, half_extents, place) }
}

/// One corner of a box that is turned like this.
#[derive(Clone, Copy)]
struct Corner {
    rotation: Rotation3<f64>,
    half_extents: [f64; 3],
}

impl Corner {
    /// J in the world \[kg·m²\].
    fn inertia(&self) -> Matrix3<f64> {
        self.rotation * Matrix3::from_diagonal(&moments(self.half_extents)) * self.rotation.transpose()
    }

    /// J⁻¹(l × n) \[1/(kg·m)\] and W_nn \[1/kg\].
    fn response(&self) -> (Vector3<f64>, f64) {
        let inverse = self.rotation * Matrix3::from_diagonal(&moments(self.half_extents).map(f64::recip)) * self.rotation.transpose();
        let lever = self.rotation * -Vector3::from(self.half_extents);
        (inverse * lever.cross(&Vector3::z()), inverse_mass_at(MASS, &inverse, &lever, &Vector3::z()))
    }
}

pub(super) fn corner(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    let mut measured = Vec::new();
    for (words, half_extents) in CORNERED {
        let body = on_corner(half_extents);
        let rotation = oriented(body.orientation);
        let (end, time) = landed(bench, &weightless("corner", body, 0.0), h)?;
        measured.extend(judged(bench, words, Corner { rotation, half_extents }, &end, time, h));
    }
    Ok(measured)
}

fn judged(bench: &Bench, words: &str, corner: Corner, end: &Sample, time: f64, h: f64) -> Vec<Measurement> {
    let (turn, normal) = corner.response();
    let impulse = MASS * (end.velocity.z + SPEED);
    // the body as the impact turns it within its step
    let spin = turn * ((1.0 + RESTITUTION) * SPEED / normal);
    let (turn_end, normal_end) = Corner { rotation: Rotation3::from_scaled_axis(spin * h) * corner.rotation, ..corner }.response();
    let at = |response: f64| impulse * response / SPEED - 1.0;
    let twice = end.spin.dot(&(Corner { rotation: end.rotation.to_rotation_matrix(), ..corner }.inertia() * end.spin));
    let energy = (twice / impulse + impulse / MASS) / SPEED - 1.0;
    let off = (end.spin - turn * impulse).norm() / (turn.norm() * impulse.abs());

    let allowed = 2.0 * tolerance::velocity(bench.epsilon());
    let precession = tolerance::precession(spin.norm(), moments(corner.half_extents).into(), (PATIENCE + 1) as f64 * h);
    let declared = Declared::of(bench, SPEED, time, h);
    let drag = declared.as_ref().map_or(0.0, |law| law.drag);
    let newton = Expectation::equal(
        RESTITUTION,
        allowed + (1.0 + RESTITUTION) * tolerance::turned_energy(precession),
        "p = (1 + e) v/W_nn at any lever",
    );
    let turned = (1.0 + RESTITUTION) * normal / normal_end - 1.0;
    let lever = between([turned.min(RESTITUTION), turned.max(RESTITUTION)], allowed, "p = (1 + e) v/W_nn before or after the step's turn");
    let straight = Expectation::at_most(0.0, allowed * SPEED, "there is no friction");
    let moved = (turn_end - turn).norm() / turn.norm();
    let along = Expectation::at_most(0.0, allowed + precession + moved, "ω⁺ = J⁻¹(l × n) p, and the step's turn");
    let law = |ideal: &Expectation| declared.as_ref().map(|law| law.rebound(ideal.tolerance + 2.0 * drag));
    vec![
        Measurement::new(format!("restitution by the energies{words}"), "1", energy, newton.clone()).predicted(law(&newton)),
        Measurement::new(format!("restitution by the impulse{words}"), "1", at(normal), lever.clone()).predicted(law(&lever)),
        Measurement::new(format!("spin off the impulse's{words}"), "1", off, along.clone())
            .predicted(declared.as_ref().and_then(|law| law.damped(&along, 2.0))),
        Measurement::new(format!("sideways speed{words}"), "m/s", end.velocity.xy().norm(), straight),
    ]
}

/// A quaternion \[w, x, y, z\] as a matrix.
pub(super) fn oriented([w, x, y, z]: [f64; 4]) -> Rotation3<f64> {
    UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z)).to_rotation_matrix()
}
