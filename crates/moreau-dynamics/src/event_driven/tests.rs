//! The event-driven method against closed forms: oscillators, belts and balls through all their events.

use super::filippov::{DryFriction, Mode, Side, advance, share_above};
use super::*;
use crate::mechanics::{BallChain, OscillatorWithStop, PainleveRod, PointMass};
use crate::scenes::named;
use crate::tolerance::event_driven::ACCURACY;
use moreau_contact::solvers::Auto;
use moreau_forms::{BeltOscillator, BouncingBall, DryFrictionOscillator, StopOscillator};
use nalgebra::dvector;

fn at(position: f64, velocity: f64) -> State {
    State { time: 0.0, position: dvector![position], velocity: dvector![velocity] }
}

fn go(mechanism: &dyn Mechanism, start: &State, duration: f64) -> Passage {
    EventDriven::default().advance(&Auto, mechanism, start, duration).expect("in scope")
}

#[test]
fn the_bouncing_ball_is_followed_through_its_accumulation_point() {
    for e in [0.0, 0.5, 0.9] {
        let exact = BouncingBall::new(9.81, 1.0, e).expect("valid");
        let ball = PointMass::ball_on_floor(2.0, 9.81, e);
        for time in [0.4, 0.6, 1.1, 1.5] {
            let end = go(&ball, &at(1.0, 0.0), time).state;
            let (q, v) = exact.state(time);
            assert!((end.position[0] - q).abs() <= ACCURACY && (end.velocity[0] - v).abs() <= ACCURACY, "e = {e}, t = {time}");
        }
        let after = go(&ball, &at(1.0, 0.0), 2.0 * exact.accumulation_time());
        assert!(after.state.velocity[0].abs() <= ACCURACY && after.state.position[0].abs() <= ACCURACY);
        // all the momentum that gravity gave went into the floor
        let impulse: f64 = after.impulses.iter().map(|one| one.impulse[0]).sum();
        // each is m = 2 kg times the jump between two velocities
        let error = 2.0 * 2.0 * ACCURACY * after.impulses.len() as f64;
        assert!((impulse - 2.0 * 9.81 * 2.0 * exact.accumulation_time()).abs() <= error, "{impulse} ± {error:e}");
    }
}

#[test]
fn the_oscillator_with_a_stop_is_followed_whether_its_impacts_end_go_on_or_accumulate() {
    for stop in [-0.5, 0.0, 0.5] {
        let exact = StopOscillator::new(2.0, stop, 1.0, 0.6).expect("valid");
        let body = OscillatorWithStop::new(1.5, 6.0, 0.0, stop, 0.6).expect("valid");
        for time in [0.5, 1.3, 2.9, 6.0, 9.7] {
            let end = go(&body, &at(1.0, 0.0), time).state;
            let (q, v) = exact.state(time);
            assert!(
                (end.position[0] - q).abs() <= ACCURACY && (end.velocity[0] - v).abs() <= ACCURACY,
                "s = {stop}, t = {time}: {end:?} {q} {v}"
            );
        }
    }
}

#[test]
fn order_five_survives_located_impacts_and_nothing_survives_late_ones() {
    let exact = StopOscillator::new(2.0, -0.5, 1.0, 0.6).expect("valid");
    let body = OscillatorWithStop::new(1.5, 6.0, 0.0, -0.5, 0.6).expect("valid");
    let error = |h: f64, location: Location| {
        let method = EventDriven { control: Control::Fixed(h), location, shortest_flight: FLIGHT };
        let end = method.advance(&Auto, &body, &at(1.0, 0.0), 2.0).expect("in scope").state;
        (end.position[0] - exact.state(2.0).0).abs()
    };
    let located = (error(0.1, Location::Root) / error(0.0125, Location::Root)).log2() / 3.0;
    assert!(located >= 3.9, "{located}");
    let h = 1.0 / 1024.0;
    let late = error(h, Location::EndOfStep);
    assert!(late > h * h, "{late}: an impact that is late by part of a step leaves no order two");
}

#[test]
fn a_block_is_brought_to_rest_by_friction_and_stays_or_slides_on() {
    let angle = 0.35f64;
    for (friction, speed) in [(0.5, -1.0), (0.5, 2.0), (0.2, -1.0)] {
        let block = PointMass::block_on_incline(2.0, 9.81, angle, friction, 0.0);
        let exact = moreau_forms::InclineBlock::new(9.81, angle, friction, speed).expect("valid");
        let start = State { time: 0.0, position: dvector![0.0, 0.0], velocity: dvector![speed, 0.0] };
        for time in [0.05, 0.5, 3.0] {
            let end = go(&block, &start, time).state;
            let (x, v) = exact.state(time);
            assert!(
                (end.position[0] - x).abs() <= ACCURACY && (end.velocity[0] - v).abs() <= ACCURACY,
                "μ = {friction}, v₀ = {speed}, t = {time}"
            );
            assert!(end.position[1].abs() <= ACCURACY && end.velocity[1].abs() <= ACCURACY);
        }
    }
}

#[test]
fn every_built_in_scene_agrees_with_its_closed_form_or_stands() {
    for name in crate::scenes::NAMES {
        let scene = named(name).expect("built in");
        let (mechanism, start) = scene.mechanism().expect("planar");
        let exact = scene.exact_motion(&start);
        let mut state = start.clone();
        for _ in 0..8 {
            state = go(mechanism.as_ref(), &state, scene.duration / 8.0).state;
            let expected = exact.as_ref().map_or_else(|| start.clone(), |form| form.state(state.time));
            let error = (&state.position - &expected.position).amax().max((&state.velocity - &expected.velocity).amax());
            assert!(error <= ACCURACY, "{name} at {}: {error:e}", state.time);
        }
    }
}

#[test]
fn a_chain_of_balls_passes_a_simultaneous_impact_on_as_the_contact_problem_says() {
    let chain = BallChain::new(vec![1.0; 3], vec![0.1; 3], 1.0).expect("valid");
    let start = State { time: 0.0, position: dvector![-0.7, 0.0, 0.2], velocity: dvector![1.0, 0.0, 0.0] };
    let end = go(&chain, &start, 1.0).state;
    let expected = dvector![-1.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0];
    assert!(
        (&end.velocity - &expected).amax() <= ACCURACY
            && (&end.position - (&start.position + dvector![0.5, 0.0, 0.0] + expected * 0.5)).amax() <= ACCURACY
    );
}

#[test]
fn painleves_rod_stops_the_method_with_the_reason() {
    let rod = PainleveRod::new(1.0, 1.0, 9.81, 2.0, 0.0).expect("valid");
    let start = State { time: 0.0, position: dvector![0.0, 0.8, 0.8f64.atan2(0.6)], velocity: dvector![-1.0, 0.0, 0.0] };
    let message = EventDriven::default().advance(&Auto, &rod, &start, 0.1).expect_err("no force").to_string();
    assert!(message.contains("Painlevé"), "{message}");
}

#[test]
fn the_dry_friction_oscillator_ends_in_its_sliding_mode() {
    let exact = DryFrictionOscillator::new(1.0, 4.0, 0.6, 1.0).expect("valid");
    let system = DryFriction { frequency: 2.0, belt: 0.0, sticking: 0.15, slipping: 0.15 };
    for time in [0.7, 2.0, 4.0, 7.0] {
        let (end, switches) = advance(&EventDriven::default(), &system, &dvector![1.0, 0.0], time).expect("unique");
        let (q, v) = exact.state(time);
        assert!((end[0] - q).abs() <= ACCURACY && (end[1] - v).abs() <= ACCURACY, "t = {time}: {end}");
        if time > exact.sticking_time() {
            let last = switches.last().expect("it switched");
            assert!(last.mode == Mode::Sliding && (last.time - exact.sticking_time()).abs() <= ACCURACY);
            let share = share_above(&system, &end);
            assert!((share - 0.5 * (1.0 - end[0] / 0.15)).abs() <= ACCURACY && (0.0..=1.0).contains(&share));
        }
    }
}

#[test]
fn the_belt_sticks_and_slips_with_the_period_of_its_closed_form() {
    let exact = BeltOscillator::new(3.0, 0.2, 0.7, 0.5).expect("valid");
    let system = DryFriction { frequency: 3.0, belt: 0.2, sticking: 0.7, slipping: 0.5 };
    let (end, switches) = advance(&EventDriven::default(), &system, &dvector![0.0, 0.2], 12.0).expect("unique");
    let (q, v) = exact.carried_from_zero(12.0);
    assert!((end[0] - q).abs() <= ACCURACY && (end[1] - v).abs() <= ACCURACY, "{end} {q} {v}");
    let releases: Vec<f64> = switches.iter().filter(|switch| switch.mode == Mode::Beside(Side::Below)).map(|switch| switch.time).collect();
    assert!(releases.len() >= 3 && releases.windows(2).all(|pair| (pair[1] - pair[0] - exact.period()).abs() <= ACCURACY), "{releases:?}");
}

#[test]
fn where_both_sides_push_away_the_motion_is_refused() {
    let repelling = DryFriction { frequency: 2.0, belt: 0.0, sticking: -1.0, slipping: -0.5 };
    assert!(advance(&EventDriven::default(), &repelling, &dvector![0.0, 0.0], 1.0).is_err());
}

/// Samples of a random scene in the plane, in which the method met what it could not do.
fn sampled(scene: &str, h: f64, samples: usize) -> Result<State> {
    let (mechanism, mut state) = crate::scenes::Scene::from_json(scene).and_then(|scene| scene.mechanism()).expect("a planar scene");
    for _ in 0..samples {
        state = EventDriven::default().advance(&moreau_contact::solvers::Auto, mechanism.as_ref(), &state, h)?.state;
    }
    Ok(state)
}

/// Seed 10 of the random scenes: at the end of a sample the only closed contact has parted, and nothing is left to project onto.
#[test]
fn a_contact_that_has_parted_by_the_end_of_a_sample_is_not_projected_onto() {
    let scene = r#"{"schema": "scene/1", "name": "random 10", "gravity": [0.0, 0.0, -9.81], "duration": 1.0,
        "ground": {"normal": [0.0, 0.0, 1.0], "offset": 0.0}, "material": {"friction": 0.576464949682639, "restitution": 0.0},
        "bodies": [{"name": "b0", "mass": 59519.03682266205, "position": [0.39948056338448823, 0.0, 0.4107180333214066],
            "box": {"half_extents": [0.09756162031181928, 0.36935666843521564, 0.11679941030056055]},
            "orientation": [0.2183517878134019, 0.0, 0.9758701228947892, 0.0],
            "linear_velocity": [1.9929390126045359, 0.0, 0.6079440012119282], "angular_velocity": [0.0, -15.057662473242424, 0.0]}]}"#;
    let end = sampled(scene, 0.00985492797184611, 101).expect("it comes to rest");
    assert!(end.velocity.amax() <= ACCURACY, "{end:?}");
}

/// Seed 12 of the random scenes: a corner of a box on a disk, whose friction limit is met again at once.
#[test]
fn more_events_in_a_row_than_the_rows_can_take_end_the_motion() {
    let (mut stall, rows) = (Stall::default(), 4);
    let most = stalled_events(rows);
    assert!((0..most).all(|_| !stall.ends(false, rows)), "as many as there may be");
    assert!(!stall.ends(true, rows), "an impact or time in between");
    assert!((0..most).all(|_| !stall.ends(false, rows)));
    assert!(stall.ends(false, rows), "one more");
}

/// Two bodies whose events went round in circles while Lemke's method decided ties by rounding.
#[test]
fn events_without_time_between_them_are_left_behind() {
    let scene = r#"{"schema": "scene/1", "name": "random 12", "gravity": [0.0, 0.0, -9.81], "duration": 1.0,
        "ground": {"normal": [-0.5125643218906326, 0.0, 0.8586488315515232], "offset": -2.0},
        "material": {"friction": 0.6317704914396122, "restitution": 0.0},
        "bodies": [{"name": "b0", "mass": 1326.4292492342806, "position": [0.2182367649042714, 0.0, 0.23655531774169314],
            "sphere": {"radius": 0.2182367649042714}, "orientation": [0.32251332834310614, 0.0, 0.9465649227818723, 0.0],
            "linear_velocity": [0.676045773207476, 0.0, -0.46582224152248175], "angular_velocity": [0.0, 3.1566735421456276, 0.0]},
            {"name": "b1", "mass": 134.4613175114717, "position": [0.9035753706822068, 0.0, 0.4584550409145584],
            "box": {"half_extents": [0.1846616960293946, 0.0873887954500934, 0.39930075231832957]},
            "orientation": [0.17687029443483213, 0.0, -0.9842341687558586, 0.0],
            "linear_velocity": [-0.5297315943391965, 0.0, -0.5916673303434443], "angular_velocity": [0.0, -2.255321961124112, 0.0]}]}"#;
    let reached = sampled(scene, 0.01055634336828368, 53).expect("the events end");
    assert!((reached.time - 53.0 * 0.01055634336828368).abs() < 53.0 * f64::EPSILON, "{reached:?}");
}
