//! One rigid body over a plane, in explicit steps, with the mistakes of an adapter at its two ends.

use nalgebra::{Matrix3, Quaternion, UnitQuaternion, Vector3};
use serde_json::{Value, json};

/// A body on its way, and what was recorded.
pub struct Simulation {
    mistake: String,
    scene: Value,
    time_step: f64,
    gravity: Vector3<f64>,
    restitution: f64,
    mass: f64,
    /// Principal moments.
    inertia: Vector3<f64>,
    /// Radius, if there is a ground to touch.
    radius: Option<f64>,
    position: Vector3<f64>,
    orientation: UnitQuaternion<f64>,
    velocity: Vector3<f64>,
    /// World frame.
    spin: Vector3<f64>,
    /// Normal impulses since the last sample, step by step.
    impulses: Vec<f64>,
    times: Vec<f64>,
    samples: Vec<[Value; 4]>,
    contacts: Vec<(usize, f64)>,
}

fn vector(value: &Value) -> Vector3<f64> {
    let number = |k: usize| value[k].as_f64().unwrap_or(0.0);
    Vector3::new(number(0), number(1), number(2))
}

impl Simulation {
    pub fn new(mistake: &str, scene: &Value, time_step: f64) -> Self {
        let body = &scene["bodies"][0];
        let mass = body["mass"].as_f64().expect("a number");
        let inertia = match body["box"]["half_extents"].as_array() {
            Some(_) => {
                let [a, b, c]: [f64; 3] = vector(&body["box"]["half_extents"]).into();
                Vector3::new(b * b + c * c, a * a + c * c, a * a + b * b) * (mass / 3.0)
            }
            None => Vector3::repeat(0.4 * mass * body["sphere"]["radius"].as_f64().expect("a number").powi(2)),
        };
        let number = |k: usize| body["orientation"][k].as_f64().expect("a number");
        let four = match mistake {
            "w-last" => Quaternion::new(number(3), number(0), number(1), number(2)),
            _ => Quaternion::new(number(0), number(1), number(2), number(3)),
        };
        let mut orientation = UnitQuaternion::from_quaternion(four);
        if mistake == "conjugate" {
            orientation = orientation.inverse();
        }
        let given = vector(&body["angular_velocity"]);
        Simulation {
            mistake: mistake.into(),
            scene: scene.clone(),
            time_step,
            gravity: if mistake == "own-gravity" { Vector3::new(0.0, 0.0, -9.81) } else { vector(&scene["gravity"]) },
            restitution: match (mistake, scene["material"]["restitution"].as_f64().expect("a number")) {
                ("no-restitution", _) => 0.0,
                ("mixed-restitution", e) => e * e,
                (_, e) => e,
            },
            mass,
            inertia,
            radius: body["sphere"]["radius"].as_f64().filter(|_| !scene["ground"].is_null()),
            position: vector(&body["position"]),
            orientation,
            velocity: vector(&body["linear_velocity"]),
            spin: if mistake == "body-frame" { orientation * given } else { given },
            impulses: Vec::new(),
            times: Vec::new(),
            samples: Vec::new(),
            contacts: Vec::new(),
        }
    }

    pub fn disturb(&mut self, by: f64) {
        self.position[0] += by;
    }

    /// Gravity, contact, motion, in this order.
    pub fn step(&mut self) {
        let h = self.time_step;
        self.velocity += h * self.gravity;
        let mut impulse = 0.0;
        if self.radius.is_some_and(|radius| self.position[2] <= radius) && self.velocity[2] < 0.0 {
            let e = if self.velocity[2] < -0.1 { self.restitution } else { 0.0 };
            impulse = -(1.0 + e) * self.velocity[2] * self.mass;
        }
        self.velocity[2] += impulse / self.mass;
        self.impulses.push(impulse);
        self.position += h * self.velocity;
        // the angular momentum stays as it is
        let world = |orientation: &UnitQuaternion<f64>, moments: Vector3<f64>| -> Matrix3<f64> {
            let turn = orientation.to_rotation_matrix().into_inner();
            turn * Matrix3::from_diagonal(&moments) * turn.transpose()
        };
        let momentum = world(&self.orientation, self.inertia) * self.spin;
        self.orientation = UnitQuaternion::from_scaled_axis(h * self.spin) * self.orientation;
        self.spin = world(&self.orientation, self.inertia.map(f64::recip)) * momentum;
    }

    pub fn sample(&mut self, step: usize) {
        if self.mistake == "samples-after-step" && step == 0 {
            self.step();
            self.impulses.clear();
        }
        let unit = if self.mistake == "milliseconds" { 1000.0 } else { 1.0 };
        self.times.push(unit * step as f64 * self.time_step);
        let orientation = if self.mistake == "conjugate" { self.orientation.inverse() } else { self.orientation };
        let length = if self.mistake == "long-quaternion" { 1.01 } else { 1.0 };
        let [x, y, z, w] = <[f64; 4]>::from(orientation.into_inner().coords * length);
        let orientation = if ["w-last", "w-last-out"].contains(&self.mistake.as_str()) { json!([x, y, z, w]) } else { json!([w, x, y, z]) };
        let spin = if ["body-frame", "body-frame-out"].contains(&self.mistake.as_str()) {
            self.orientation.inverse() * self.spin
        } else {
            self.spin
        };
        self.samples.push([json!(self.position.as_slice()), orientation, json!(self.velocity.as_slice()), json!(spin.as_slice())]);
        let steps = std::mem::take(&mut self.impulses);
        let total: f64 = match &self.mistake[..] {
            "last-step" => steps.last().copied().unwrap_or(0.0),
            "forces" => steps.iter().sum::<f64>() / self.time_step,
            "mean-forces" => steps.iter().sum::<f64>() / (self.time_step * steps.len().max(1) as f64),
            _ => steps.iter().sum(),
        };
        self.contacts.push((self.times.len() - 1, total));
    }

    fn contact(&self, sample: usize, impulse: f64) -> Value {
        let (bodies, normal, impulse) = match &self.mistake[..] {
            "on-ground" => (["probe", "ground"], 1.0, -impulse),
            "exchanged" => (["ground", "probe"], -1.0, impulse),
            "downward-normal" => (["probe", "ground"], -1.0, impulse),
            // as good as the other way
            "ground-first" => (["ground", "probe"], -1.0, -impulse),
            _ => (["probe", "ground"], 1.0, impulse),
        };
        json!({"sample": sample, "bodies": bodies, "normal": [0, 0, normal], "impulse": [0, 0, impulse]})
    }

    /// A further body, which nothing holds.
    fn falling(&self, body: &Value) -> Value {
        let each = |of: &dyn Fn(f64) -> Vector3<f64>| self.times.iter().map(|t| json!(of(*t).as_slice())).collect::<Vec<_>>();
        let still = self.times.iter().map(|_| json!([1.0, 0.0, 0.0, 0.0])).collect::<Vec<_>>();
        json!({"name": body["name"], "position": each(&|t| vector(&body["position"]) + self.gravity * (0.5 * t * t)), "orientation": still,
            "linear_velocity": each(&|t| self.gravity * t), "angular_velocity": each(&|_| Vector3::zeros())})
    }

    pub fn trajectory(self) -> Value {
        let column = |k: usize| self.samples.iter().map(|sample| sample[k].clone()).collect::<Vec<_>>();
        let last = self.times.len() - 1;
        let late = match &self.mistake[..] {
            "late-contacts" => 1,
            "early-contacts" => -1,
            _ => 0,
        };
        let placed = self.contacts.iter().map(|(sample, impulse)| (*sample as i64 + late, *impulse));
        let kept =
            placed.filter(|(sample, impulse)| *impulse != 0.0 && (1..=last as i64).contains(sample) && self.mistake != "no-contacts");
        let contacts: Vec<_> = kept.map(|(sample, impulse)| self.contact(sample as usize, impulse)).collect();
        let own = json!({"name": self.scene["bodies"][0]["name"], "position": column(0), "orientation": column(1),
            "linear_velocity": column(2), "angular_velocity": column(3)});
        let others = self.scene["bodies"].as_array().expect("a list").iter().skip(1).map(|body| self.falling(body));
        let bodies: Vec<_> = std::iter::once(own).chain(others).collect();
        json!({
            "schema": "trajectory/1", "scene": self.scene, "engine": {"name": "one body", "version": "0.1", "options": {}},
            "time_step": self.time_step, "times": self.times,
            "bodies": bodies,
            "contacts": contacts
        })
    }
}
