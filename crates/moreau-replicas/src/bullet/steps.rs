//! Stored steps of PyBullet, taken again from each of its own states with its own contact points: the scheme and its sweeps without a
//! difference in collision.
//!
//! ```text
//!     (q_k, v_k), contact points of step k ──► one step of ours ──► |v − v_{k+1}| , |x − x_{k+1}| , |Σ over rows − r_k|
//! ```
//! Two things of Bullet are modelled here because our mechanics have them otherwise. The gyroscopic torque, implicit midpoint with us:
//! ```text
//!     multibodies    J(Ω* − Ω) = −h Ω × JΩ
//!     rigid bodies   one step of Newton's method on J(Ω* − Ω) + h Ω* × JΩ* = 0 from Ω; their friction rows do not see it
//! ```
//! And which contact of the last step a contact continues: the nearest place on the ground, if nearer than the breaking threshold.

use crate::bullet::SequentialImpulses;
use crate::bullet::{BREAKING_THRESHOLD, Bodies, Bullet, Friction};
use crate::tolerance::references::bullet_step;
use moreau_contact::contact::frame::spatial_tangents;
use moreau_contact::contact::{Contact, Place};
use moreau_contact::problem::{ContactProblem, Law, Solution};
use moreau_contact::solvers::ContactSolver;
use moreau_dynamics::mechanics::{Mechanism, State, answers_as};
use moreau_dynamics::scenes::Scene;
use moreau_dynamics::schemes::step;
use moreau_exact::{Error, Result};
use nalgebra::{DMatrix, DVector, Matrix3, Quaternion, UnitQuaternion, Vector3};
use serde::Deserialize;
use serde_json::{Map, Value};

/// A run of PyBullet with one body, format `bullet-steps/1`.
#[derive(Clone, Debug, Deserialize)]
pub struct BulletSteps {
    /// What moves.
    pub scene: Scene,
    /// h \[s\].
    pub time_step: f64,
    engine: Engine,
    bodies: Track,
    native: Native,
}

#[derive(Clone, Debug, Deserialize)]
struct Engine {
    options: Map<String, Value>,
}

#[derive(Clone, Debug, Deserialize)]
struct Track {
    position: Vec<[f64; 3]>,
    orientation: Vec<[f64; 4]>,
    linear_velocity: Vec<[f64; 3]>,
    angular_velocity: Vec<[f64; 3]>,
}

#[derive(Clone, Debug, Deserialize)]
struct Native {
    points: Vec<Points>,
}

/// The contact points of one step, in Bullet's order.
#[derive(Clone, Debug, Deserialize)]
struct Points {
    position: Vec<[f64; 3]>,
    normal: Vec<[f64; 3]>,
    distance: Vec<f64>,
    impulse: Vec<[f64; 3]>,
}

/// The largest differences between our steps and the stored ones, over all steps.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Deviation {
    /// The largest difference of a component of v⁺ \[m/s\].
    pub velocity: f64,
    /// The largest difference of a component of ω⁺ \[rad/s\].
    pub spin: f64,
    /// The largest difference of a component of x⁺ \[m\].
    pub position: f64,
    /// The largest difference of a component of a contact's impulse, in world axes \[N·s\].
    pub impulse: f64,
}

impl Deviation {
    /// The largest number.
    pub fn largest(&self) -> f64 {
        self.velocity.max(self.spin).max(self.position).max(self.impulse)
    }
}

impl BulletSteps {
    /// Reads a stored run.
    ///
    /// # Errors
    /// If the text is not such a run, or its lists differ in length.
    pub fn from_json(text: &str) -> Result<Self> {
        let run: BulletSteps = serde_json::from_str(text)?;
        let states = run.native.points.len() + 1;
        let track = &run.bodies;
        let lengths = [track.position.len(), track.orientation.len(), track.linear_velocity.len(), track.angular_velocity.len()];
        let whole = |points: &Points| [points.position.len(), points.normal.len(), points.impulse.len()] == [points.distance.len(); 3];
        if states == 1 || lengths != [states; 4] || !run.native.points.iter().all(whole) {
            return Err(Error::invalid("bodies", "has lists of different length", "store the start and every step"));
        }
        Ok(run)
    }

    /// How many contact points Bullet had in every step.
    pub fn points(&self) -> Vec<usize> {
        self.native.points.iter().map(|points| points.distance.len()).collect()
    }

    /// Normal and total tangential impulse of every contact point of every step \[N·s\].
    pub fn impulses(&self) -> impl Iterator<Item = [f64; 2]> {
        self.native.points.iter().flat_map(|points| points.impulse.iter().zip(&points.normal)).map(|(impulse, normal)| {
            let (impulse, normal) = (Vector3::from(*impulse), Vector3::from(*normal));
            let along = impulse.dot(&normal);
            [along, (impulse - normal * along).norm()]
        })
    }

    /// How far the body moves in the k-th step \[m\].
    pub fn travel(&self, k: usize) -> f64 {
        (Vector3::from(self.bodies.position[k + 1]) - Vector3::from(self.bodies.position[k])).norm()
    }

    /// Velocity of the body after k steps \[m/s\].
    pub fn velocity(&self, k: usize) -> [f64; 3] {
        self.bodies.linear_velocity[k]
    }

    /// Distance \[m\] at which a contact point is a new one, and from which on one that slides is dropped.
    ///
    /// # Errors
    /// If the scene has no body.
    pub fn breaking_distance(&self) -> Result<f64> {
        let body = self.scene.bodies.first().ok_or_else(|| Error::Unsupported("the scene has no body".into()))?;
        let half_diagonal = match (&body.cuboid, &body.sphere) {
            (Some(cuboid), _) => Vector3::from(cuboid.half_extents).norm(),
            (None, Some(sphere)) => 3f64.sqrt() * sphere.radius,
            _ => f64::NAN,
        };
        Ok(BREAKING_THRESHOLD * half_diagonal)
    }

    fn number(&self, key: &str) -> Result<f64> {
        let value = self.engine.options.get(key).and_then(Value::as_f64);
        value.ok_or_else(|| Error::Unsupported(format!("the stored run has no number `{key}`")))
    }

    fn holds(&self, key: &str) -> bool {
        self.engine.options.get(key) == Some(&Value::Bool(true))
    }

    /// Our scheme with the run's parameters.
    ///
    /// # Errors
    /// If one is missing.
    pub fn scheme(&self) -> Result<Bullet> {
        Ok(Bullet {
            bodies: if self.holds("maximal_coordinates") { Bodies::Rigid } else { Bodies::Multi },
            friction: if self.holds("cone_friction") { Friction::Cone } else { Friction::Pyramid },
            error_reduction: self.number("error_reduction")?,
            slop: self.number("penetration_allowance")?,
            restitution_threshold: self.number("restitution_threshold")?,
            margin: self.number("processing_threshold")?,
        })
    }

    /// Our sweeps with the run's parameters; multibodies start from zero whatever the factor.
    ///
    /// # Errors
    /// If one is missing.
    pub fn solver(&self) -> Result<SequentialImpulses> {
        Ok(SequentialImpulses {
            sweeps: self.number("iterations")? as usize,
            warm_start: if self.holds("maximal_coordinates") { self.number("warm_starting_factor")? } else { 0.0 },
            residual: self.number("residual_threshold")?,
        })
    }

    /// The stored state after k steps.
    fn state(&self, k: usize) -> State {
        let [w, x, y, z] = self.bodies.orientation[k];
        let spin = rotation([w, x, y, z]).tr_mul(&Vector3::from(self.bodies.angular_velocity[k]));
        State {
            time: k as f64 * self.time_step,
            position: DVector::from_iterator(7, self.bodies.position[k].into_iter().chain([w, x, y, z])),
            velocity: DVector::from_iterator(6, self.bodies.linear_velocity[k].into_iter().chain(spin.iter().copied())),
        }
    }

    /// The normal impulses that Bullet's contact points bring along from the step before \[N·s\], with three rows per point.
    fn brought(&self, k: usize) -> Result<DVector<f64>> {
        let (now, reach) = (&self.native.points[k], self.breaking_distance()?);
        let mut start = DVector::zeros(3 * now.distance.len());
        let Some(before) = k.checked_sub(1).map(|k| &self.native.points[k]) else { return Ok(start) };
        for i in 0..now.distance.len() {
            let apart = |j: &usize| (now.on_ground(i) - before.on_ground(*j)).norm();
            let nearest = (0..before.distance.len()).min_by(|a, b| apart(a).total_cmp(&apart(b)));
            if let Some(j) = nearest.filter(|j| apart(j) < reach) {
                start[3 * i] = Vector3::from(before.impulse[j]).dot(&Vector3::from(before.normal[j]));
            }
        }
        Ok(start)
    }

    /// The largest differences of all single steps of a scheme, solved in its way, from the stored ones.
    ///
    /// # Errors
    /// Those of the scheme and the solver.
    pub fn deviation(&self, scheme: &Bullet, solver: &dyn ContactSolver) -> Result<Deviation> {
        let (mechanism, _) = self.scene.spatial_mechanism()?;
        let mut worst = Deviation::default();
        for k in 0..self.native.points.len() {
            let one = self.one_step(k, mechanism.as_ref(), scheme, solver)?;
            worst.velocity = worse(worst.velocity, one.velocity);
            worst.spin = worse(worst.spin, one.spin);
            worst.position = worse(worst.position, one.position);
            worst.impulse = worse(worst.impulse, one.impulse);
        }
        Ok(worst)
    }

    fn one_step(&self, k: usize, mechanism: &dyn Mechanism, scheme: &Bullet, solver: &dyn ContactSolver) -> Result<Deviation> {
        let (state, points) = (self.state(k), &self.native.points[k]);
        let seen = Seen { mechanism, contacts: self.contacts(k), bodies: scheme.bodies };
        let hidden = match scheme.bodies {
            Bodies::Rigid => seen.gyroscopic_change(&state.velocity, self.time_step),
            Bodies::Multi => DVector::zeros(6),
        };
        let started = Started { solver, start: self.brought(k)?, hidden };
        let made = step(scheme, &started, &seen, &state, self.time_step)?;
        let body = mechanism.bodies(&made.state.position, &made.state.velocity).swap_remove(0);
        let impulse = (0..points.distance.len()).map(|i| {
            let ours = made.impulses.iter().find(|one| one.contact == i);
            let ours = ours.and_then(|one| Some(one.place?.world_impulse(&one.impulse))).unwrap_or([0.0; 3]);
            apart(&ours, &points.impulse[i])
        });
        Ok(Deviation {
            velocity: apart(&body.linear_velocity, &self.bodies.linear_velocity[k + 1]),
            spin: apart(&body.angular_velocity, &self.bodies.angular_velocity[k + 1]),
            position: apart(&body.position, &self.bodies.position[k + 1]),
            impulse: impulse.fold(0.0, worse),
        })
    }

    /// Bullet's contact points of step k as contacts of the body.
    fn contacts(&self, k: usize) -> Vec<Contact> {
        let points = &self.native.points[k];
        let (centre, turned) = (Vector3::from(self.bodies.position[k]), rotation(self.bodies.orientation[k]));
        let of = |i: usize| {
            let [t1, t2] = spatial_tangents(points.normal[i]);
            let (frame, arm) = ([points.normal[i], t1, t2], Vector3::from(points.position[i]) - centre);
            let jacobian = DMatrix::from_fn(3, 6, |row, column| {
                let direction = Vector3::from(frame[row]);
                if column < 3 { direction[column] } else { turned.tr_mul(&arm.cross(&direction))[column - 3] }
            });
            Contact {
                gap: points.distance[i],
                jacobian: jacobian.into(),
                friction: self.scene.material.friction,
                restitution: self.scene.material.restitution,
                place: Some(Place { bodies: (0, None), features: [i as u32, 0], frame }),
            }
        };
        (0..points.distance.len()).map(of).collect()
    }

    /// How far a step may be from the stored one, in each unit: the numbers are of the size of the largest velocity, 1 kg and 1 m.
    pub fn tolerance(&self) -> f64 {
        let track = &self.bodies;
        let speed = track.linear_velocity.iter().chain(&track.angular_velocity).flatten().fold(1.0, |a: f64, b| a.max(b.abs()));
        let rows = 3 * self.points().into_iter().max().unwrap_or(0);
        bullet_step(self.number("iterations").unwrap_or(f64::NAN) as usize, rows, speed)
    }
}

impl Points {
    /// Where the i-th point touches the ground.
    fn on_ground(&self, i: usize) -> Vector3<f64> {
        Vector3::from(self.position[i]) - Vector3::from(self.normal[i]) * self.distance[i]
    }
}

fn rotation([w, x, y, z]: [f64; 4]) -> Matrix3<f64> {
    UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z)).to_rotation_matrix().into_inner()
}

/// The larger one; what is not a number is infinitely far.
fn worse(one: f64, other: f64) -> f64 {
    if other.is_nan() { f64::INFINITY } else { one.max(other) }
}

fn apart(one: &[f64; 3], other: &[f64; 3]) -> f64 {
    (0..3).map(|i| (one[i] - other[i]).abs()).fold(0.0, worse)
}

/// Hands a solver the impulses to start from, and hides a change of velocity from friction.
struct Started<'a> {
    solver: &'a dyn ContactSolver,
    start: DVector<f64>,
    hidden: DVector<f64>,
}

impl ContactSolver for Started<'_> {
    fn name(&self) -> &'static str {
        self.solver.name()
    }

    fn takes(&self, law: Law, rows: usize, symmetric: bool) -> bool {
        self.solver.takes(law, rows, symmetric)
    }

    fn solve(&self, problem: &ContactProblem, _warm_start: Option<&DVector<f64>>) -> Result<Solution> {
        let mut shift = problem.shift().clone();
        if let Some(dynamics) = problem.dynamics() {
            let hidden = &dynamics.jacobian * &self.hidden;
            for row in (0..shift.len()).filter(|row| row % 3 != 0) {
                shift[row] -= hidden[row];
            }
        }
        let seen = problem.clone().into_builder().shift(shift).build()?;
        self.solver.solve(&seen, Some(&self.start))
    }
}

/// A body with Bullet's contact points and gyroscopic torque.
struct Seen<'a> {
    mechanism: &'a dyn Mechanism,
    contacts: Vec<Contact>,
    bodies: Bodies,
}

impl Seen<'_> {
    /// (0, Ω* − Ω) of the module's equations.
    fn gyroscopic_change(&self, velocity: &DVector<f64>, h: f64) -> DVector<f64> {
        let moments = self.mass_matrix(velocity).diagonal().fixed_rows::<3>(3).into_owned();
        let spin = velocity.fixed_rows::<3>(3).into_owned();
        let momentum = moments.component_mul(&spin);
        let torque = spin.cross(&momentum) * h;
        let inertia = Matrix3::from_diagonal(&moments);
        let slope = match self.bodies {
            Bodies::Multi => inertia,
            Bodies::Rigid => inertia + (spin.cross_matrix() * inertia - momentum.cross_matrix()) * h,
        };
        let change = slope.lu().solve(&-torque).unwrap_or_else(|| Vector3::repeat(f64::NAN));
        DVector::from_iterator(6, [0.0; 3].into_iter().chain(change.iter().copied()))
    }
}

impl Mechanism for Seen<'_> {
    answers_as!(self, mechanism);

    fn integrate(&self, position: &DVector<f64>, velocity: &DVector<f64>, h: f64) -> DVector<f64> {
        self.mechanism.integrate(position, velocity, h)
    }

    fn mean_force(&self, position: &DVector<f64>, velocity: &DVector<f64>, h: f64) -> DVector<f64> {
        let weight = self.mechanism.force(position, &DVector::zeros(velocity.len()));
        weight + self.mass_matrix(position) * self.gyroscopic_change(velocity, h) / h
    }

    fn contacts(&self, _position: &DVector<f64>) -> Vec<Contact> {
        self.contacts.clone()
    }
}
