//! Probes of simulated motion: samples, initial state, gravity, restitution, repetition.

use crate::conformance::scenes::{EVERY, STEPS, bouncing_ball, landing_ball, thrown_ball, tumbling_brick};
use crate::conformance::{ProbeOutcome, Probes, Seen, contacts, demand, probe, problem, refused, rotation, skipped, unmoved};
use crate::model::Model;
use crate::tolerance::SAME_TIME;
use crate::tolerance::conformance::{FREE_FALL, RESTITUTION, STEP, same_state};
use crate::{Description, Engine, Options, Refusal};
use moreau_dynamics::scenes::{Body, Scene};
use moreau_dynamics::trajectory::{BodyTrack, Trajectory};
use moreau_exact::number::counted;
use nalgebra::{Vector3, Vector4};

/// The motion of a scene, or why there is none to look at.
type Motion = Result<Trajectory, ProbeOutcome>;

fn simulate(engine: &mut dyn Engine, description: &Description, scene: &Scene, every: usize) -> Motion {
    if let Some(reason) = description.lacks(scene) {
        return Err(skipped(reason));
    }
    engine.simulate(scene, STEP, every, &Options::new()).map_err(refused)
}

/// The motion as far as another probe needs it: its refusal is reported once.
fn as_far(motion: &Motion) -> Result<&Trajectory, ProbeOutcome> {
    motion.as_ref().map_err(|_| skipped("there is no motion to look at"))
}

pub(super) fn probe_all(engine: &mut dyn Engine, description: &Description, probes: &mut Probes) {
    probes.begin("simulate/answers");
    let (scene, thrown) = thrown(engine, description);
    probes.push(probe("simulate/answers", "a sound trajectory/1 is the result", thrown.as_ref().map(drop).map_err(Clone::clone)));
    if matches!(thrown, Err(ProbeOutcome::Problem { .. })) {
        // the other motions would have it as well
        return;
    }
    if thrown.is_ok() {
        probe_samples(engine, description, &scene, &thrown, probes);
        probes.ask("simulate/unknown-option", "an unknown option is an `error`", || unknown_option(engine, &scene));
    }
    probes.begin("simulate/orientation");
    let tumbling = tumbling_brick();
    let brick = simulate(engine, description, &tumbling, 1);
    let start = brick.as_ref().map_err(Clone::clone).and_then(|brick| initial_state(brick, &tumbling, description));
    probes.push(probe("simulate/orientation", "orientations are unit quaternions w, x, y, z from body to world, as in the scene", start));
    let frame = as_far(&brick).and_then(rotation::frame);
    probes.push(probe("simulate/angular-velocity", "angular velocities are in the world frame, given and reported", frame));
    probes.begin("contacts/normal");
    contacts::probe_all(simulate(engine, description, &landing_ball(), EVERY), description, &mut probes.done);
    probes.ask(
        "simulate/restitution",
        "a scene with restitution is simulated with it, or refused if the description says that there is none",
        || restitution(engine, description),
    );
    probes.ask(
        "simulate/unmoved",
        "declared static bodies stay where they are, and declared prescribed ones keep their velocity, whatever touches them",
        || unmoved::stay_or_move_as_prescribed(engine, description),
    );
    let again = || as_far(&thrown).and_then(|thrown| same_again(engine, description, &scene, thrown));
    probes.ask("simulate/same-twice", "the same request gets the same answer, bit by bit, whatever requests come between", again);
}

/// The motion of a thrown ball; of one without spin where the engine knows none.
fn thrown(engine: &mut dyn Engine, description: &Description) -> (Scene, Motion) {
    let spinning = thrown_ball();
    let motion = simulate(engine, description, &spinning, 1);
    if !matches!(motion, Err(ProbeOutcome::Skipped { .. })) {
        return (spinning, motion);
    }
    let mut scene = spinning;
    scene.bodies[0].angular_velocity = [0.0; 3];
    let motion = simulate(engine, description, &scene, 1);
    (scene, motion)
}

fn probe_samples(engine: &mut dyn Engine, description: &Description, scene: &Scene, thrown: &Motion, probes: &mut Probes) {
    let sampled = as_far(thrown).and_then(|thrown| samples(thrown, scene, 1));
    probes.push(probe("simulate/samples", "samples are at k·sample_every·h, beginning with t = 0, up to the duration", sampled));
    let start = as_far(thrown).and_then(|thrown| initial_state(thrown, scene, description));
    probes.push(probe("simulate/initial-state", "the first sample is the scene's initial state", start));
    let falling = as_far(thrown).and_then(|thrown| free_fall(thrown, scene, description));
    probes.push(probe("simulate/gravity", "a body without contact falls with the scene's gravity", falling));
    let sparse = || as_far(thrown).and_then(|thrown| sample_every(engine, thrown, scene, description));
    probes.ask("simulate/sample-every", "a request for every third state gives the same motion, sampled less often", sparse);
}

fn samples(trajectory: &Trajectory, scene: &Scene, every: usize) -> Seen {
    let repeated = trajectory.scene.bodies.iter().map(|body| &body.name).eq(scene.bodies.iter().map(|body| &body.name));
    demand(repeated, || "`scene` is not the scene of the request".into(), "repeat the scene of the request in the trajectory")?;
    let same_step = trajectory.time_step == STEP;
    demand(
        same_step,
        || format!("`time_step` is {} instead of {STEP}", trajectory.time_step),
        "report the engine's step, as it was asked for",
    )?;
    let (count, expected) = (trajectory.times.len(), STEPS / every + 1);
    let why = || format!("there are {count} instead of {expected}", count = counted(count, "sample"));
    demand(count == expected, why, missing_sample(count, expected, every))?;
    let late = (0..expected).find(|&k| (trajectory.times[k] - (k * every) as f64 * STEP).abs() > SAME_TIME * scene.duration);
    match late {
        None => Ok(()),
        Some(k) => {
            let why = format!("times[{k}] is {} instead of {}", trajectory.times[k], (k * every) as f64 * STEP);
            Err(problem(why, "compute times as k·sample_every·time_step; do not add them up"))
        }
    }
}

fn missing_sample(count: usize, expected: usize, every: usize) -> &'static str {
    match count {
        _ if every > 1 && count == STEPS + 1 => "keep only every `sample_every`-th state",
        _ if count + 1 == expected => "record the initial state before the first step, and the state after the last",
        _ => "take duration/time_step steps, rounded to the nearest whole number",
    }
}

fn initial_state(trajectory: &Trajectory, scene: &Scene, description: &Description) -> Seen {
    const CURE: &str =
        "set positions (of the centre of mass) and velocities as the scene gives them, and record them before the first step";
    let (body, track) = (&scene.bodies[0], &trajectory.bodies[0]);
    let tolerance = same_state(description.precision.epsilon());
    orientation(body, track, tolerance)?;
    let pairs = [
        ("position", body.position, track.position[0]),
        ("linear_velocity", body.linear_velocity, track.linear_velocity[0]),
        ("angular_velocity", body.angular_velocity, track.angular_velocity[0]),
    ];
    for (field, given, seen) in pairs {
        let (given, seen) = (Vector3::from(given), Vector3::from(seen));
        let why = || format!("{field}[0] is {:?} instead of {:?}", seen.as_slice(), given.as_slice());
        demand((seen - given).amax() <= tolerance * given.norm(), why, CURE)?;
    }
    Ok(())
}

fn orientation(body: &Body, track: &BodyTrack, tolerance: f64) -> Seen {
    let (given, seen) = (Vector4::from(body.orientation), Vector4::from(track.orientation[0]));
    let off = |other: Vector4<f64>| (other - given).amax().min((other + given).amax());
    if off(seen) <= tolerance {
        return Ok(());
    }
    let rotated = Vector4::new(seen[3], seen[0], seen[1], seen[2]);
    let conjugate = Vector4::new(seen[0], -seen[1], -seen[2], -seen[3]);
    let cure = if off(rotated) <= tolerance {
        "the components are in the order x, y, z, w: put w first"
    } else if off(conjugate) <= tolerance {
        "the quaternion is the rotation from world to body; conjugate it"
    } else {
        "set the scene's orientation, w first, and record it before the first step"
    };
    Err(problem(format!("orientation[0] is {:?} instead of {:?}", seen.as_slice(), given.as_slice()), cure))
}

fn free_fall(trajectory: &Trajectory, scene: &Scene, description: &Description) -> Seen {
    let track = &trajectory.bodies[0];
    let gained = Vector3::from(scene.gravity) * scene.duration;
    let start = Vector3::from(scene.bodies[0].linear_velocity);
    let expected = start + gained;
    // declared damping c takes at most c T of any velocity
    let damped = Model::of(description).damping().map_or(0.0, |(linear, _)| linear * scene.duration * (start.norm() + gained.norm()));
    let last = track.linear_velocity.last().copied().unwrap_or_default();
    let why = || format!("after {} s without contact the velocity is {last:?} instead of {:?}", scene.duration, expected.as_slice());
    let met = (Vector3::from(last) - expected).norm() <= FREE_FALL * gained.norm() + damped;
    demand(met, why, "use the scene's gravity, all three components, and record states after their steps")
}

fn sample_every(engine: &mut dyn Engine, dense: &Trajectory, scene: &Scene, description: &Description) -> Seen {
    let sparse = simulate(engine, description, scene, EVERY)?;
    samples(&sparse, scene, EVERY)?;
    let scale = dense.bodies[0].position.iter().flatten().fold(0.0, |largest: f64, x| largest.max(x.abs()));
    for (k, position) in sparse.bodies[0].position.iter().enumerate() {
        let Some(expected) = dense.bodies[0].position.get(k * EVERY) else { return Ok(()) };
        let off = (Vector3::from(*position) - Vector3::from(*expected)).amax();
        let why = || format!("sample {k} of every third state is {position:?}, but state {} of all states is {expected:?}", k * EVERY);
        demand(
            off <= same_state(description.precision.epsilon()) * scale,
            why,
            "sample k is the state after k·sample_every steps of time_step",
        )?;
    }
    Ok(())
}

fn unknown_option(engine: &mut dyn Engine, scene: &Scene) -> Seen {
    let options = [("moreau-does-not-exist".to_string(), 1.into())].into_iter().collect();
    match engine.simulate(scene, STEP, 1, &options) {
        Err(Refusal::Errored(_)) => Ok(()),
        Err(Refusal::Unsupported(reason)) => Err(problem(format!("the request was answered `unsupported`: {reason}"), "answer `error`")),
        Ok(_) => Err(problem("the request was carried out", "check the names in `options` of every request")),
    }
}

fn restitution(engine: &mut dyn Engine, description: &Description) -> Seen {
    const ASKED: f64 = 0.5;
    if let Some(reason) = description.lacks(&bouncing_ball(ASKED)) {
        return Err(skipped(reason));
    }
    let answer = engine.simulate(&bouncing_ball(ASKED), STEP, 1, &Options::new());
    let trajectory = match answer {
        Err(Refusal::Unsupported(_)) if !description.restitution => return Ok(()),
        Err(refusal) => return Err(refused(refusal)),
        Ok(trajectory) => trajectory,
    };
    let cure = "answer `unsupported` to a scene with restitution if the engine has none; never simulate something else";
    demand(
        description.restitution,
        || "the description says that there is no restitution, but a scene with restitution was simulated".into(),
        cure,
    )?;
    let heights = trajectory.bodies[0].linear_velocity.iter().map(|v| v[2]);
    let (down, up) = heights.fold((0.0_f64, f64::NEG_INFINITY), |(down, up), v| (down.min(v), up.max(v)));
    let seen = -up / down;
    let why = || format!("restitution {ASKED} was asked for, and the ball leaves with {seen:.3} of its speed");
    let cure = "use the scene's pair value as it is, without the engine's mixing rule; declare a threshold speed as a parameter";
    demand(bounced(seen, ASKED, description), why, cure)
}

/// Whether a ball leaves as e asks, or as fast as a declared error reduction pushes it out of up to a step's way.
fn bounced(seen: f64, asked: f64, description: &Description) -> bool {
    let pushed = match Model::of(description) {
        Model::Coulomb(limits) => limits.error_reduction,
        _ => 0.0,
    };
    (asked - RESTITUTION..=asked.max(pushed) + RESTITUTION).contains(&seen)
}

fn same_again(engine: &mut dyn Engine, description: &Description, scene: &Scene, first: &Trajectory) -> Seen {
    let cure = "build the engine's world anew for every request, and seed what is random";
    let second = simulate(engine, description, scene, 1)?;
    demand(second == *first, || "the same request, repeated after other scenes, gives another motion".into(), cure)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::description::OneOrMany;
    use crate::exact::Reporting;
    use crate::{Parameter, Reply, own};

    /// Moreau–Jean of bodies without spin; it forgets to record the first state where it is told to.
    struct WithoutSpin {
        forgets: bool,
    }

    impl Engine for WithoutSpin {
        fn describe(&mut self, options: &Options) -> Reply<Description> {
            Reporting(|_: &mut Trajectory| ()).describe(options)
        }

        fn simulate(&mut self, scene: &Scene, h: f64, every: usize, options: &Options) -> Reply<Trajectory> {
            if scene.bodies.iter().any(|body| body.angular_velocity != [0.0; 3]) {
                return Err(Refusal::unsupported("bodies do not turn"));
            }
            let turned = usize::from(self.forgets);
            let forget = |motion: &mut Trajectory| motion.bodies.iter_mut().for_each(|track| track.position.rotate_left(turned));
            Reporting(forget).simulate(scene, h, every, options)
        }
    }

    #[test]
    fn an_engine_without_spin_is_looked_at_as_well() {
        let wrong = |forgets: bool| {
            let mut probes = Probes::heard_by(&|_| ());
            let mut engine = WithoutSpin { forgets };
            let description = engine.describe(&Options::new()).expect("describes itself");
            probe_all(&mut engine, &description, &mut probes);
            probes.done.retain(|probe| matches!(probe.outcome, ProbeOutcome::Problem { .. }));
            probes.done.into_iter().map(|probe| probe.probe).collect::<Vec<_>>()
        };
        assert_eq!(wrong(false), [""; 0]);
        assert!(wrong(true).contains(&"simulate/initial-state".to_string()));
    }

    #[test]
    fn a_ball_may_leave_as_fast_as_a_declared_error_reduction_pushes_it_and_no_faster() {
        let mut description = own::by_name("moreau-jean").expect("listed").describe(&Options::new()).expect("describes itself");
        let mut right = |part: f64, seen: f64| {
            let part = Parameter { value: OneOrMany::One(part), unit: OneOrMany::One("1".into()) };
            description.contact_model.parameters.insert("error_reduction".into(), part);
            bounced(seen, 0.5, &description)
        };
        assert!(right(0.0, 0.5) && !right(0.0, 0.75) && !right(0.0, 0.25));
        assert!(right(0.8, 0.75) && right(0.8, 0.5) && !right(0.8, 1.0) && !right(0.8, 0.25));
        assert!(!right(0.2, 0.75));
    }
}
