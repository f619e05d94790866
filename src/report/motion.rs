//! What a simulated scene shows: numbers with units, and panels of position, velocity and energy over time.

use super::plot::{Curve, Panel, Role};
pub use super::quantity::{Quantity, lines};
use super::sampled::{Sampled, length};
use crate::mechanics::{BodyState, Mechanism, State};
use crate::number::larger;
use crate::scenes::ExactMotion;
use crate::tolerance::report::{BARELY_MOVING, creep, energy_noise, length_noise};
use crate::trajectory::Recording;
use crate::trajectory::metrics::{EnergyBalance, creep_speed, creeps, effective_restitutions, penetration, settling_time};

/// A recorded motion, with the closed form that it is compared with.
pub struct MotionReport<'a> {
    /// The mechanism that moved.
    pub mechanism: &'a dyn Mechanism,
    /// Its motion.
    pub recording: &'a Recording,
    /// The closed form in the x–z plane, where there is one; the mechanism may be in the plane, with (x, z, angle) per body, or in space.
    pub exact: Option<&'a ExactMotion>,
    /// Gravity \[m/s²\].
    pub gravity: f64,
}

/// x, y or z of a body.
struct Coordinate {
    label: String,
    body: usize,
    axis: usize,
}

const AXES: [&str; 3] = ["x", "y", "z"];

impl Coordinate {
    /// Its index in a planar configuration (x, z, angle) per body.
    fn planar(&self) -> Option<usize> {
        [Some(0), None, Some(1)][self.axis].map(|index| 3 * self.body + index)
    }
}

/// Coordinates that a note names.
const NAMED: usize = 30;

/// Samples of a closed form in a picture.
const EXACT_SAMPLES: usize = 1500;

impl MotionReport<'_> {
    /// Penetration, energy, restitution, rest and the distance from the closed form.
    pub fn summary(&self) -> Vec<Quantity> {
        let sampled = &Sampled::of(self.recording, self.mechanism);
        let balance = EnergyBalance::of(&sampled.energies);
        let last = sampled.energies[sampled.energies.len() - 1];
        let ratios = self.restitutions();
        let slow = settling_time(&sampled.times, &sampled.speeds, self.resting_speed());
        let settled = slow.filter(|slow| !self.creeps(sampled, *slow)).and_then(|slow| self.at_its_end(sampled, slow));
        let steps = self.recording.impulses.len();
        let (length, energy) = (self.length_noise(sampled), sampled.largest_energy);
        let quantity = |name, value, unit| Quantity { name, value, unit, rounding: None };
        let rounded = |name, value, unit, bound| Quantity { name, value, unit, rounding: Some(bound) };
        let gain = Some(balance.largest_gain).filter(|gain| gain.is_finite());
        vec![
            quantity("time step", Some(self.recording.time_step), "s"),
            quantity("steps", Some(steps as f64), "1"),
            rounded("deepest penetration", Some(penetration(&sampled.gaps)), "m", length),
            quantity("initial energy", Some(balance.initial), "J"),
            rounded("energy change", Some(last - balance.initial), "J", energy_noise(steps, energy)),
            rounded("largest energy gain in a step", gain, "J", energy_noise(1, energy)),
            quantity("impacts", ratios.as_ref().map(|ratios| ratios.len() as f64), "1"),
            quantity("effective restitution of the first impact", ratios.and_then(|ratios| ratios.first().copied()), "1"),
            quantity("settling time", settled, "s"),
            // two positions, half of the motion apart
            rounded(
                "creep speed at rest",
                slow.and_then(|slow| creep_of_bodies(sampled, slow)),
                "m/s",
                4.0 * length / self.recording.last().time,
            ),
            rounded("largest position error", self.exact.map(|exact| self.position_error(exact)), "m", length),
        ]
    }

    /// Position, velocity and energy; only coordinates that move appreciably, or all heights if none does.
    pub fn panels(&self) -> Vec<Panel> {
        let coordinates = self.moving();
        let panel = |axis: &str, part: &dyn Fn(&BodyState) -> [f64; 3], exact: &dyn Fn(&State, usize) -> f64| {
            let closed = coordinates.iter().filter_map(|place| self.exact_curve(&|state| Some(exact(state, place.planar()?))));
            let value = |state: &State, place: &Coordinate| part(&self.bodies(state)[place.body])[place.axis];
            let computed = coordinates.iter().map(|place| self.curve(&place.label, &|state| value(state, place)));
            Panel { axis: axis.into(), curves: closed.chain(computed).collect() }
        };
        let energy = |state: &State| self.mechanism.energy(state);
        // the closed form's state is one of the mechanism's in the plane only
        let is_planar = |state: &State| state.position.len() == self.recording.samples[0].position.len();
        let exact = self.exact_curve(&|state| is_planar(state).then(|| energy(state)));
        let total = exact.into_iter().chain([self.curve("kinetic + potential", &energy)]);
        vec![
            panel("position [m]", &|body| body.position, &|state, index| state.position[index]),
            panel("velocity [m/s]", &|body| body.linear_velocity, &|state, index| state.velocity[index]),
            Panel { axis: "energy [J]".into(), curves: total.collect() },
        ]
    }

    /// Which coordinates [`panels`](Self::panels) leave out although they move; empty if none.
    pub fn left_out(&self) -> String {
        let (drawn, noise) = (self.moving(), self.length_noise(&Sampled::of(self.recording, self.mechanism)));
        let is_drawn = |(body, axis): (usize, usize)| drawn.iter().any(|one| (one.body, one.axis) == (body, axis));
        let all = self.ranges().into_iter().filter(|(place, range)| *range > 2.0 * noise && !is_drawn(*place));
        let names: Vec<_> = all.map(|((body, axis), _)| self.coordinate(body, axis).label).collect();
        let more = names.len().saturating_sub(NAMED);
        let named = names[..names.len() - more].join(", ") + &if more > 0 { format!(" and {more} more") } else { String::new() };
        if names.is_empty() { named } else { format!("not drawn, for they move less than a twentieth of what moves farthest: {named}") }
    }

    fn bodies(&self, state: &State) -> Vec<BodyState> {
        self.mechanism.bodies(&state.position, &state.velocity)
    }

    fn curve(&self, label: &str, value: &dyn Fn(&State) -> f64) -> Curve {
        let points = self.recording.samples.iter().map(|state| (state.time, value(state)));
        Curve { label: label.into(), role: Role::Computed, points: points.collect() }
    }

    fn exact_curve(&self, value: &dyn Fn(&State) -> Option<f64>) -> Option<Curve> {
        let end = self.recording.last().time;
        let states =
            (0..=EXACT_SAMPLES).map(|k| end * k as f64 / EXACT_SAMPLES as f64).map(|time| self.exact.map(|exact| exact.state(time)));
        let points = states.map(|state| state.and_then(|state| Some((state.time, value(&state)?)))).collect::<Option<_>>()?;
        Some(Curve { label: "closed form".into(), role: Role::ClosedForm, points })
    }

    /// The coordinates that vary by more than a twentieth of the largest variation, or all heights if nothing moves.
    fn moving(&self) -> Vec<Coordinate> {
        let all = self.ranges();
        let largest = all.iter().map(|(_, range)| *range).fold(0.0, f64::max);
        let moving: Vec<_> = all.iter().filter(|(_, range)| *range > BARELY_MOVING * largest).collect();
        let shown = if moving.is_empty() { all.iter().filter(|((_, axis), _)| *axis == 2).collect() } else { moving };
        shown.into_iter().map(|((body, axis), _)| self.coordinate(*body, *axis)).collect()
    }

    fn coordinate(&self, body: usize, axis: usize) -> Coordinate {
        Coordinate { label: format!("{} {}", self.bodies(&self.recording.samples[0])[body].name, AXES[axis]), body, axis }
    }

    /// By how much every coordinate of every body varies \[m\].
    fn ranges(&self) -> Vec<((usize, usize), f64)> {
        let samples: Vec<Vec<BodyState>> = self.recording.samples.iter().map(|state| self.bodies(state)).collect();
        let range = |(body, axis): (usize, usize)| {
            let values = || samples.iter().map(|bodies| bodies[body].position[axis]);
            values().fold(f64::NEG_INFINITY, f64::max) - values().fold(f64::INFINITY, f64::min)
        };
        let all = (0..samples[0].len()).flat_map(|body| (0..3).map(move |axis| (body, axis)));
        all.map(|place| (place, range(place))).collect()
    }

    /// What rounding alone can make of a length \[m\].
    fn length_noise(&self, sampled: &Sampled) -> f64 {
        length_noise(self.recording.impulses.len(), sampled.farthest())
    }

    /// −u_n⁺/u_n⁻ of each impact of a mechanism with a single contact: at the impacts where the scheme has located them, from the samples
    /// around them otherwise.
    fn restitutions(&self) -> Option<Vec<f64>> {
        let Some(located) = &self.recording.impacts else {
            return self.normal_velocities().map(|u| effective_restitutions(&u, self.resting_speed()));
        };
        let ratios = located.iter().map(|impact| match impact.normal_velocities.as_slice() {
            [[before, after]] => Some((-before > self.resting_speed()).then_some(-after / before)),
            _ => None,
        });
        let ratios: Option<Vec<Option<f64>>> = ratios.collect();
        ratios
            .filter(|ratios| !ratios.is_empty() || self.has_one_contact(&self.recording.samples[0]))
            .map(|all| all.into_iter().flatten().collect())
    }

    /// Two bodies over a ground may have more candidates at one place than at another, at most some forty: 16 of two boxes and 8 of each
    /// with the ground. Of more bodies there are always several, and counting them takes time that grows with the square of their number.
    fn has_one_contact(&self, state: &State) -> bool {
        const MOST_OF_TWO_BODIES: usize = 64;
        let may_be = self.mechanism.most_candidates().is_none_or(|most| most <= MOST_OF_TWO_BODIES);
        may_be && self.mechanism.count_within(&state.position, f64::INFINITY) == 1
    }

    /// u_n at each sample, for a mechanism with a single contact.
    fn normal_velocities(&self) -> Option<Vec<f64>> {
        let normal = |state: &State| match self.has_one_contact(state).then(|| self.mechanism.contacts(&state.position))?.as_slice() {
            [contact] => Some((&contact.jacobian * &state.velocity)[0]),
            _ => None,
        };
        self.recording.samples.iter().map(normal).collect()
    }

    /// The speed 2 g h \[m/s\], below which a body counts as resting. A resting body falls freely for at most one step, and it rebounds
    /// with at most the speed of that fall.
    fn resting_speed(&self) -> f64 {
        2.0 * self.gravity * self.recording.time_step
    }

    /// Whether a body that is slow from a time on still goes on at the end.
    fn creeps(&self, sampled: &Sampled, slow: f64) -> bool {
        let quarter = 0.25 * (self.recording.last().time - slow);
        let least = creep(self.resting_speed(), self.length_noise(sampled), quarter);
        let goes_on = |body: usize, axis: usize| creeps(&sampled.times, &sampled.coordinate(body, axis), slow, least);
        (0..sampled.bodies).any(|body| (0..3).any(|axis| goes_on(body, axis)))
    }

    /// The time \[s\] from which on every body is slow and where it ends, but for 4 g h²: one step there and one back at the speed of rest.
    /// `None` if that is so from the start of a motion that goes farther than 2 g h²: such steps do not tell rest from motion.
    fn at_its_end(&self, sampled: &Sampled, slow: f64) -> Option<f64> {
        let last = sampled.places(sampled.times.len() - 1);
        let apart = |one: &[f64; 3], end: &[f64; 3]| length(std::array::from_fn(|axis| one[axis] - end[axis]));
        let away = |sample: usize| sampled.places(sample).iter().zip(last).fold(0.0, |worst, (one, end)| larger(apart(one, end), worst));
        let away: Vec<f64> = (0..sampled.times.len()).map(away).collect();
        let of_a_step = self.gravity * self.recording.time_step * self.recording.time_step;
        let noise = self.length_noise(sampled);
        let settled = slow.max(settling_time(&sampled.times, &away, 4.0 * of_a_step + noise)?);
        (settled > sampled.times[0] || away.iter().all(|way| *way <= 2.0 * of_a_step + noise)).then_some(settled)
    }

    /// max ‖x(t_k) − x_exact(t_k)‖ over bodies and samples \[m\].
    fn position_error(&self, exact: &ExactMotion) -> f64 {
        let error = |state: &State| {
            let wanted = exact.state(state.time).position;
            let off = |(k, body): (usize, BodyState)| {
                let [x, y, z] = body.position;
                length([x - wanted[3 * k], y, z - wanted[3 * k + 1]])
            };
            self.bodies(state).into_iter().enumerate().map(off).fold(0.0, f64::max)
        };
        self.recording.samples.iter().map(error).fold(0.0, f64::max)
    }
}

/// Largest mean speed of a body over the second half of the motion, if it was slow by then.
fn creep_of_bodies(sampled: &Sampled, settled: f64) -> Option<f64> {
    let half = 0.5 * sampled.times[sampled.times.len() - 1];
    let mean = |body: usize, axis: usize| creep_speed(&sampled.times, &sampled.coordinate(body, axis), half);
    let bodies = (0..sampled.bodies).map(|body| Some(length([mean(body, 0)?, mean(body, 1)?, mean(body, 2)?])));
    let fastest = bodies.collect::<Option<Vec<_>>>()?.into_iter().fold(0.0, f64::max);
    (settled <= half).then_some(fastest)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenes::{Ground, Scene, named};
    use crate::schemes::{Anitescu, Events, MoreauJean, Scheme, simulate};
    use crate::solvers::Auto;
    use crate::tolerance::rounding;

    fn with_motion(scene: &str, scheme: &dyn Scheme, check: impl FnOnce(&MotionReport, &dyn Fn(&str) -> Option<f64>)) {
        let scene = named(scene).expect("a built-in scene");
        let (mechanism, start) = scene.mechanism().expect("planar");
        let exact = scene.exact_motion(&start);
        let recording = simulate(scheme, &Auto, mechanism.as_ref(), start, 0.01, 200).expect("a solvable scene");
        let motion = MotionReport { mechanism: mechanism.as_ref(), recording: &recording, exact: exact.as_ref(), gravity: 9.81 };
        let summary = motion.summary();
        check(&motion, &|name| summary.iter().find(|quantity| quantity.name == name).expect("a known name").value);
    }

    #[test]
    fn the_first_bounce_shows_the_restitution_and_the_ball_comes_to_rest() {
        with_motion("bouncing-ball", &MoreauJean::default(), |motion, value| {
            assert!((value("effective restitution of the first impact").expect("one contact") - 0.5).abs() <= rounding(64, 1.0));
            assert!(value("settling time").expect("it rests") < 2.0);
            assert!(value("largest position error").expect("a closed form") < 0.1);
            let panels = motion.panels();
            assert_eq!(panels.iter().map(|panel| panel.curves.len()).collect::<Vec<_>>(), [2, 2, 2]);
            assert_eq!(panels[0].curves[1].label, "ball z");
        });
    }

    #[test]
    fn a_located_impact_shows_its_restitution_whatever_the_time_between_samples() {
        with_motion("bouncing-ball", &Events::default(), |motion, value| {
            let found = value("effective restitution of the first impact").expect("one contact");
            assert!((found - 0.5).abs() <= rounding(64, 1.0), "{found}");
            // the samples around it miss up to g h of either speed
            let sampled = effective_restitutions(&motion.normal_velocities().expect("one contact"), motion.resting_speed())[0];
            assert!((sampled - 0.5).abs() > 1e-3, "{sampled}");
        });
    }

    #[test]
    fn a_motion_in_space_has_the_same_distance_from_the_closed_form_as_in_the_plane() {
        let scene = named("ball-drop").expect("a built-in scene");
        let (planar, start) = scene.mechanism().expect("planar");
        let exact = scene.exact_motion(&start);
        let (spatial, turned) = scene.spatial_mechanism().expect("in space too");
        let summaries = [(planar, start), (spatial, turned)].map(|(mechanism, start)| {
            let recording = simulate(&MoreauJean::default(), &Auto, mechanism.as_ref(), start, 0.01, 100).expect("a solvable scene");
            let motion = MotionReport { mechanism: mechanism.as_ref(), recording: &recording, exact: exact.as_ref(), gravity: 9.81 };
            let closed =
                motion.panels().iter().map(|panel| panel.curves.iter().filter(|curve| curve.role == Role::ClosedForm).count()).collect();
            (motion.position_error(exact.as_ref().expect("a fall")), closed)
        });
        let [(in_plane, curves), (in_space, fewer)]: [(f64, Vec<usize>); 2] = summaries;
        assert!(in_plane > 0.0 && (in_plane - in_space).abs() <= rounding(100_000, 1.0), "{in_plane} {in_space}");
        assert_eq!((curves, fewer), (vec![1, 1, 1], vec![1, 1, 0]));
    }

    #[test]
    fn a_sticking_block_does_not_creep_and_a_sliding_one_never_rests() {
        with_motion("incline-stick", &Anitescu, |_, value| {
            assert!(value("creep speed at rest").expect("it rests") <= rounding(10_000, 1.0));
        });
        with_motion("incline-slide", &MoreauJean::default(), |_, value| {
            assert_eq!((value("settling time"), value("creep speed at rest")), (None, None));
            assert_eq!(value("impacts"), None);
        });
    }

    /// The settling time of a scene by steps of h.
    fn of_scene(scene: &Scene, h: f64) -> Option<f64> {
        let (mechanism, start) = scene.mechanism().expect("planar");
        let steps = (scene.duration / h).round() as usize;
        let recording = simulate(&MoreauJean::default(), &Auto, mechanism.as_ref(), start, h, steps).expect("a solvable scene");
        let motion = MotionReport { mechanism: mechanism.as_ref(), recording: &recording, exact: None, gravity: 9.81 };
        motion.summary().iter().find(|quantity| quantity.name == "settling time").expect("a known name").value
    }

    /// A block of 0.3 m/s that friction stops after 0.3/(μ g) = 1.53 s is slow by every step of 1/60 s.
    #[test]
    fn a_slow_body_settles_where_it_stops_and_long_steps_tell_nothing() {
        let mut scene = named("incline-slide").expect("built in");
        (scene.gravity, scene.ground) = ([0.0, 0.0, -9.81], Some(Ground { normal: [0.0, 0.0, 1.0], offset: 0.0 }));
        (scene.material.friction, scene.duration) = (0.02, 3.0);
        let body = &mut scene.bodies[0];
        let height = body.cuboid.expect("a box").half_extents[2];
        (body.position, body.orientation, body.linear_velocity) = ([0.0, 0.0, height], [1.0, 0.0, 0.0, 0.0], [0.3, 0.0, 0.0]);
        let stops = 0.3 / (0.02 * 9.81);
        for (h, early) in [(0.001, 0.02), (1.0 / 240.0, 0.1), (1.0 / 60.0, 0.4)] {
            let settled = of_scene(&scene, h).expect("it stops");
            assert!(settled <= stops + 2.0 * h && settled >= stops - early, "{h}: {settled}");
        }
        assert_eq!(of_scene(&scene, 0.1), None, "it stops within what such a step moves what rests");
    }

    #[test]
    fn a_block_that_creeps_for_ever_does_not_settle_and_one_that_stands_or_sinks_does() {
        for scheme in ["mujoco", "drake-sap", "drake-tamsi"] {
            let scheme = crate::schemes::by_name(scheme, Default::default()).expect("a scheme");
            with_motion("incline-stick", scheme.as_ref(), |_, value| {
                assert_eq!(value("settling time"), None);
                assert!(value("creep speed at rest").expect("it is slow") > 0.0);
            });
            // the softness lets the ball sink for a while, and then it stands
            with_motion("ball-drop", scheme.as_ref(), |_, value| assert!(value("settling time").is_some()));
        }
        with_motion("incline-stick", &MoreauJean::default(), |_, value| assert_eq!(value("settling time"), Some(0.0)));
    }

    #[test]
    fn a_stack_at_rest_shows_its_heights() {
        with_motion("box-stack", &MoreauJean::default(), |motion, _| {
            let labels: Vec<_> = motion.panels()[0].curves.iter().map(|curve| curve.label.clone()).collect();
            assert!(labels.contains(&"box5 z".to_string()), "{labels:?}");
        });
    }

    #[test]
    fn the_energy_of_an_elastic_ball_changes_by_rounding_alone() {
        let change = |scene: &str, scheme: &dyn Scheme| {
            let mut text = String::new();
            with_motion(scene, scheme, |motion, _| text = lines(&motion.summary()));
            text.lines().find(|line| line.contains("energy change")).expect("a line").to_string()
        };
        assert!(!change("bouncing-ball", &MoreauJean::default()).contains("rounding"), "an impact takes energy");
        let elastic = change("elastic-ball", &MoreauJean::default());
        assert!(elastic.contains(" 0 J"), "{elastic}");
    }

    #[test]
    fn coordinates_that_move_and_are_not_drawn_are_named() {
        with_motion("two-ball-impact", &MoreauJean::default(), |motion, _| assert_eq!(motion.left_out(), ""));
        with_motion("incline-slide", &MoreauJean::default(), |motion, _| assert_eq!(motion.left_out(), "", "x and z are drawn, y is 0"));
        let mut scene = named("two-ball-impact").expect("a built-in scene");
        scene.bodies[1].linear_velocity = [0.0, 0.0, 0.0];
        scene.bodies[1].position[0] += 9.0;
        scene.bodies[0].linear_velocity = [1.0, 0.0, 0.0];
        scene.gravity = [0.0, 0.0, 0.0];
        scene.bodies[1].linear_velocity = [0.01, 0.0, 0.0];
        let (mechanism, start) = scene.mechanism().expect("planar");
        let recording = simulate(&MoreauJean::default(), &Auto, mechanism.as_ref(), start, 0.01, 20).expect("a solvable scene");
        let motion = MotionReport { mechanism: mechanism.as_ref(), recording: &recording, exact: None, gravity: 0.0 };
        assert_eq!(
            motion.left_out(),
            format!("not drawn, for they move less than a twentieth of what moves farthest: {} x", scene.bodies[1].name)
        );
    }
}
