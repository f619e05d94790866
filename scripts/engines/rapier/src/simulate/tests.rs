use super::*;
use crate::scene::tests::ball;

/// `simulate` of a scene with step h, every step a sample.
fn run(scene: &Value, time_step: f64, options: Value) -> Outcome<Value> {
    let request = json!({"scene": scene, "time_step": time_step, "sample_every": 1, "options": options});
    simulate(request.as_object().expect("an object"))
}

fn rows<Row: serde::de::DeserializeOwned>(trajectory: &Value, body: usize, field: &str) -> Vec<Row> {
    serde_json::from_value(trajectory["bodies"][body][field].clone()).expect("rows of numbers")
}

/// What n steps of four substeps may lose in sums of numbers up to `size`: half an ulp for each of two roundings.
#[allow(clippy::useless_conversion)] // Real is f32 or f64
fn rounding(steps: usize, size: f64) -> f64 {
    4.0 * steps as f64 * f64::from(Real::EPSILON) * size
}

/// A unit-mass box 0.4 × 0.4 × 0.2 on the plane z = 0 under a slope's gravity, 20° towards `direction` in the plane.
fn block(friction: f64, direction: f64) -> (Value, [f64; 3]) {
    let (sin, cos) = 20_f64.to_radians().sin_cos();
    let gravity = [9.81 * sin * direction.cos(), 9.81 * sin * direction.sin(), -9.81 * cos];
    let scene = json!({"schema": "scene/1", "name": "block", "gravity": gravity, "ground": {"normal": [0, 0, 1], "offset": 0},
        "bodies": [{"name": "block", "box": {"half_extents": [0.2, 0.2, 0.1]}, "mass": 1, "position": [0, 0, 0.1]}],
        "material": {"friction": friction}, "duration": 0.5});
    (scene, gravity)
}

#[test]
fn a_falling_ball_gains_g_t() {
    let mut scene = ball();
    scene["ground"] = Value::Null;
    let trajectory = run(&scene, 1.0 / 128.0, json!({})).expect("runs");
    let speed = rows::<[f64; 3]>(&trajectory, 0, "linear_velocity")[64][2];
    assert!((speed + 5.0).abs() <= rounding(64, 5.0), "{speed}");
    assert_eq!(trajectory["times"].as_array().map(Vec::len), Some(65));
    assert_eq!(trajectory["scene"], scene);
}

#[test]
fn the_impulses_of_a_sample_are_the_momentum_gained_since_the_last() {
    let (scene, gravity) = block(0.3, 0.5);
    let trajectory = run(&scene, 1.0 / 128.0, json!({"friction_model": "Coulomb"})).expect("runs");
    let velocities = rows::<[f64; 3]>(&trajectory, 0, "linear_velocity");
    let contacts = trajectory["contacts"].as_array().expect("a list");
    let settings = Settings::read([json!({"friction_model": "Coulomb"}).as_object().expect("an object")]).expect("valid");
    if !version::reports_contacts(&settings) {
        return assert!(contacts.is_empty());
    }
    assert_eq!(contacts.len(), 64);
    for contact in contacts {
        let k = contact["sample"].as_u64().expect("a number") as usize;
        let impulse: [f64; 3] = serde_json::from_value(contact["impulse"].clone()).expect("a vector");
        for i in 0..3 {
            let gained = velocities[k][i] - velocities[k - 1][i] - gravity[i] / 128.0;
            // Four points in four substeps add up to one step's share of momentum, next to a speed below 1 m/s.
            assert!((gained - impulse[i]).abs() <= rounding(4, 1.0), "sample {k}, component {i}: {gained} {}", impulse[i]);
        }
    }
}

#[test]
fn a_resting_ball_lies_as_deep_as_the_spring_of_its_contact_says() {
    let mut scene = ball();
    (scene["bodies"][0]["position"], scene["duration"]) = (json!([0, 0, 1]), json!(2));
    let trajectory = run(&scene, 1.0 / 128.0, json!({})).expect("runs");
    let depth = 1.0 - rows::<[f64; 3]>(&trajectory, 0, "position")[256][2];
    let settings = Settings::read([&Map::new()]).expect("valid");
    let (allowance, frequency) = match version::VERSION {
        "0.34.0" => (settings.number("penetration_allowance"), "contact_frequency"),
        _ => (0.0, "ground_contact_frequency"),
    };
    // k = m ω² carries the weight m g. The slow mode of ζ ≥ 5 has the time constant T = 2 ζ/ω ≤ 0.054 s and has died out after 2 s;
    // it stops where a substep's share of it, h/4 in T, is lost in rounding a height of 1.
    let expected = allowance + 10.0 / (std::f64::consts::TAU * settings.number(frequency)).powi(2);
    let stuck = rounding(1, 1.0) / 4.0 * 0.054 * 4.0 * 128.0;
    assert!((depth - expected).abs() <= stuck, "{depth} {expected}");
}

#[test]
fn simplified_friction_reports_no_contacts() {
    let trajectory = run(&block(0.3, 0.0).0, 1.0 / 128.0, json!({"friction_model": "Simplified"})).expect("runs");
    assert_eq!(trajectory["contacts"], json!([]));
}

#[test]
fn angular_velocity_is_in_the_world_frame_and_the_quaternion_begins_with_its_real_part() {
    let mut scene = ball();
    let (sin, cos) = 0.3_f64.sin_cos();
    scene["gravity"] = json!([0, 0, 0]);
    scene["bodies"][0]["orientation"] = json!([cos, sin, 0, 0]);
    scene["bodies"][0]["angular_velocity"] = json!([0, 0, 1]);
    let trajectory = run(&scene, 1.0 / 128.0, json!({})).expect("runs");
    // A ball keeps its angular velocity: after t the orientation is (cos t/2, 0, 0, sin t/2) times the first one.
    let (s, c) = 0.25_f64.sin_cos();
    let expected = [c * cos, c * sin, s * sin, s * cos];
    let found = rows::<[f64; 4]>(&trajectory, 0, "orientation")[64];
    for i in 0..4 {
        // The engine turns by the chord: an angle of h/4 per substep is off by its third power.
        assert!((found[i] - expected[i]).abs() <= 64.0 * 4.0 * (1.0_f64 / 512.0).powi(3) + rounding(64, 1.0), "{found:?} {expected:?}");
    }
}

#[test]
fn the_same_question_has_the_same_answer_whatever_was_asked_between() {
    let (scene, _) = block(0.3, 0.5);
    let first = run(&scene, 1.0 / 128.0, json!({})).expect("runs").to_string();
    run(&ball(), 1.0 / 128.0, json!({"solver_iterations": 2})).expect("runs");
    assert_eq!(run(&scene, 1.0 / 128.0, json!({})).expect("runs").to_string(), first);
}

#[test]
fn the_own_coefficients_of_a_pair_act_as_if_they_were_the_common_ones() {
    let (common, _) = block(0.3, 0.0);
    let (mut own, _) = block(0.9, 0.0);
    own["material"]["pairs"] = json!([{"bodies": ["ground", "block"], "friction": 0.3}]);
    let speed = |scene: &Value| rows::<[f64; 3]>(&run(scene, 1.0 / 128.0, json!({})).expect("runs"), 0, "linear_velocity")[64][0];
    let (common, own) = (speed(&common), speed(&own));
    // Hooks turn the recycling of contacts off, so that the two may differ by roundings, not by friction.
    assert!(common > 0.25 && (common - own).abs() < 1e-3 * common, "{common} {own}");
}

#[test]
fn requests_that_cannot_be_meant_are_errors() {
    let scene = ball();
    let message = |request: Value| match simulate(request.as_object().expect("an object")) {
        Err(Refusal::Error(message)) => message,
        other => panic!("{other:?}"),
    };
    assert!(message(json!({})).contains("scene"));
    assert!(message(json!({"scene": scene, "time_step": 0.3, "sample_every": 1})).contains("does not divide"));
    assert!(message(json!({"scene": scene, "time_step": -0.25, "sample_every": 1})).contains("out of range"));
    assert!(message(json!({"scene": scene, "time_step": 0.25})).contains("sample_every"));
    assert!(message(json!({"scene": scene, "time_step": 0.25, "sample_every": 0})).contains("sample_every"));
    assert!(message(json!({"scene": scene, "time_step": 0.25, "sample_every": 1, "options": {"x": 1}})).contains("`x`"));
}

#[test]
fn the_scene_chooses_options_and_the_request_has_the_last_word() {
    let mut scene = ball();
    scene["engines"] = json!({"rapier": {"solver_iterations": 2, "internal_pgs_iterations": 3}, "other": {"x": 1}});
    let options = run(&scene, 0.25, json!({"solver_iterations": 5})).expect("runs")["engine"]["options"].clone();
    assert_eq!((&options["solver_iterations"], &options["internal_pgs_iterations"]), (&json!(5), &json!(3)));
}

#[test]
fn a_state_that_is_no_number_is_an_error() {
    let mut scene = ball();
    scene["bodies"][0]["linear_velocity"] = json!([1e308, 0, 0]);
    scene["gravity"] = json!([1e308, 0, 0]);
    assert!(matches!(run(&scene, 0.25, json!({"solver_iterations": 1})), Err(Refusal::Error(_))));
}
