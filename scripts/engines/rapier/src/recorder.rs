//! Writing `trajectory/1`: states at the samples, and the contact impulses of each pair summed over (t_{k−1}, t_k].

use crate::protocol::{Outcome, Refusal};
use crate::scene::GROUND;
use serde_json::{Value, json};
use std::collections::BTreeMap;

/// Position, orientation \[w, x, y, z\], linear and angular velocity in the world frame.
pub struct BodyState {
    pub position: [f64; 3],
    pub orientation: [f64; 4],
    pub linear_velocity: [f64; 3],
    pub angular_velocity: [f64; 3],
}

/// One contact point of one step, with the impulse \[N·s\] on the first body and the normal from the second to the first.
pub struct ContactPoint {
    pub normal: [f64; 3],
    pub impulse: [f64; 3],
}

#[derive(Default)]
struct Track {
    position: Vec<[f64; 3]>,
    orientation: Vec<[f64; 4]>,
    linear_velocity: Vec<[f64; 3]>,
    angular_velocity: Vec<[f64; 3]>,
}

/// Collects the samples of one run.
pub struct Recorder {
    names: Vec<String>,
    time_step: f64,
    times: Vec<f64>,
    tracks: Vec<Track>,
    contacts: Vec<Value>,
    /// Of each pair since the last sample: Σ impulse, and Σ (normal impulse) normal.
    pending: BTreeMap<(String, String), ([f64; 3], [f64; 3])>,
}

impl Recorder {
    /// An empty trajectory of these bodies.
    pub fn new(names: Vec<String>, time_step: f64) -> Self {
        let tracks = names.iter().map(|_| Track::default()).collect();
        Recorder { names, time_step, times: Vec::new(), tracks, contacts: Vec::new(), pending: BTreeMap::new() }
    }

    /// Adds a contact point between bodies `a` and `b`; the ground becomes the second of the pair.
    pub fn contact(&mut self, a: &str, b: &str, point: &ContactPoint) {
        let swap = a == GROUND || (b != GROUND && a > b);
        let sign = if swap { -1.0 } else { 1.0 };
        let pair = if swap { (b, a) } else { (a, b) };
        let weight: f64 = (0..3).map(|i| point.normal[i] * point.impulse[i]).sum();
        if point.impulse == [0.0; 3] {
            return;
        }
        let (total, direction) = self.pending.entry((pair.0.into(), pair.1.into())).or_default();
        for i in 0..3 {
            total[i] += sign * point.impulse[i];
            direction[i] += sign * weight * point.normal[i];
        }
    }

    /// Stores the state after `step` steps, in scene order, and the impulses since the last sample.
    ///
    /// # Errors
    /// A state that is not finite: the engine has diverged, and JSON has no word for it.
    pub fn sample(&mut self, step: u64, states: impl Iterator<Item = BodyState>) -> Outcome<()> {
        let index = self.times.len();
        self.times.push(step as f64 * self.time_step);
        for ((track, name), state) in self.tracks.iter_mut().zip(&self.names).zip(states) {
            let numbers = state.position.iter().chain(&state.orientation).chain(&state.linear_velocity).chain(&state.angular_velocity);
            if !numbers.into_iter().all(|number| number.is_finite()) {
                return Err(Refusal::error(format!("the engine's state of `{name}` is not finite after step {step}")));
            }
            track.position.push(state.position);
            track.orientation.push(state.orientation);
            track.linear_velocity.push(state.linear_velocity);
            track.angular_velocity.push(state.angular_velocity);
        }
        for ((a, b), (impulse, direction)) in std::mem::take(&mut self.pending) {
            let length = direction.iter().map(|x| x * x).sum::<f64>().sqrt();
            if !length.is_finite() || !impulse.iter().all(|x| x.is_finite()) {
                return Err(Refusal::error(format!("the engine's impulse between `{a}` and `{b}` is not finite before step {step}")));
            }
            if length > 0.0 {
                let normal = direction.map(|x| x / length);
                self.contacts.push(json!({"sample": index, "bodies": [a, b], "normal": normal, "impulse": impulse}));
            }
        }
        Ok(())
    }

    /// The trajectory, with the scene as it came.
    pub fn finish(self, scene: &Value, engine: Value) -> Value {
        let body = |(name, track): (String, Track)| {
            json!({"name": name, "position": track.position, "orientation": track.orientation,
                   "linear_velocity": track.linear_velocity, "angular_velocity": track.angular_velocity})
        };
        let bodies: Vec<Value> = self.names.into_iter().zip(self.tracks).map(body).collect();
        json!({"schema": "trajectory/1", "scene": scene, "engine": engine, "time_step": self.time_step,
               "times": self.times, "bodies": bodies, "contacts": self.contacts})
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn still() -> BodyState {
        BodyState { position: [0.0; 3], orientation: [1.0, 0.0, 0.0, 0.0], linear_velocity: [0.0; 3], angular_velocity: [0.0; 3] }
    }

    fn recorded(points: &[(&str, &str, [f64; 3], [f64; 3])]) -> Value {
        let mut recorder = Recorder::new(vec!["a".into(), "b".into()], 0.5);
        recorder.sample(0, [still(), still()].into_iter()).expect("finite");
        for (a, b, normal, impulse) in points {
            recorder.contact(a, b, &ContactPoint { normal: *normal, impulse: *impulse });
        }
        recorder.sample(2, [still(), still()].into_iter()).expect("finite");
        recorder.finish(&json!({}), json!({}))
    }

    #[test]
    fn points_of_a_pair_are_added_and_belong_to_the_sample_that_ends_them() {
        let up = [0.0, 0.0, 1.0];
        let trajectory = recorded(&[("a", "ground", up, [0.5, 0.0, 1.0]), ("a", "ground", up, [0.0, 0.0, 2.0])]);
        assert_eq!(trajectory["times"], json!([0.0, 1.0]));
        let expected = json!([{"sample": 1, "bodies": ["a", "ground"], "normal": up, "impulse": [0.5, 0.0, 3.0]}]);
        assert_eq!(trajectory["contacts"], expected);
    }

    #[test]
    fn a_pair_told_in_the_other_order_is_the_same_pair() {
        let (up, down) = ([0.0, 0.0, 1.0], [0.0, 0.0, -1.0]);
        let told = recorded(&[("a", "b", up, [0.0, 1.0, 2.0])]);
        assert_eq!(told["contacts"], recorded(&[("b", "a", down, [0.0, -1.0, -2.0])])["contacts"]);
        let ground = recorded(&[("ground", "b", down, [0.0, 0.0, -2.0])]);
        assert_eq!(ground["contacts"][0]["bodies"], json!(["b", "ground"]));
        assert_eq!(ground["contacts"][0]["impulse"], json!([0.0, 0.0, 2.0]));
    }

    #[test]
    fn contacts_without_impulse_are_left_out_and_a_diverged_state_is_an_error() {
        assert_eq!(recorded(&[("a", "b", [0.0, 0.0, 1.0], [0.0; 3])])["contacts"], json!([]));
        let mut recorder = Recorder::new(vec!["a".into()], 0.5);
        let lost = BodyState { position: [0.0, f64::NAN, 0.0], ..still() };
        assert!(matches!(recorder.sample(3, std::iter::once(lost)), Err(Refusal::Error(message)) if message.contains("step 3")));
    }
}
