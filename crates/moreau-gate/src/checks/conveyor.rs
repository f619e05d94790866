//! Bodies that are laid on a conveyor: a box with a prescribed velocity V under them, along no edge of either, in a scene that is turned as
//! a whole with its gravity, so that V, the faces and the weight are along no axis of the world.
//!
//! ```text
//!     box        Σ p_t = μ Σ p_n  against the slip w = v − V:   ‖V‖ − ‖w‖ − μ v_z = μ g t ,   until t = V/(μ g) ,   then v = V
//!     sphere     from the belt it is thrown with −V:   it rolls after 2V/(7 μ g) ,   then v = 2/7 V
//!     belt       x(t) = x₀ + V t ,   whatever touches it
//! ```
//! The momentum of the box holds for every sequence of normal impulses and every load of its corners: Σ p_n = m (g t + v_z). Where friction
//! is as strong in the direction of every slip as the support function h of a polygon says, ‖w‖ falls with μ g h(w), c ≤ h ≤ C.

use crate::check::{Control, Expected, Run};
use crate::checks::motion::{Sample, does_not_hop, opens_within, samples, start_gap, stays_closed, yields};
use crate::checks::pair::view::View;
use crate::checks::rolling::{self, RADIUS};
use crate::checks::scenery::{GRAVITY, between, cuboid, over_floor, sphere};
use crate::description::Friction;
use crate::model::Model;
use crate::model::addition::Addition;
use crate::model::sliding::full_slip;
use crate::tolerance::conveyor as tolerance;
use crate::tolerance::rest::pushed_velocity;
use crate::{Bench, Check, Expectation, Level, Measurement, Reply, Verdict};
use moreau_contact::cones::polyhedral;
use moreau_dynamics::scenes::{Body, Scene};
use moreau_dynamics::trajectory::{BodyTrack, Trajectory};
use nalgebra::{UnitQuaternion, Vector3};
use std::f64::consts::{FRAC_1_SQRT_2, SQRT_2};

/// ‖V‖ \[m/s\] under the box.
const SPEED: f64 = 1.0;
/// μ of box and belt.
const FRICTION: f64 = 0.25;
/// Half extents of the box \[m\]: low, so that friction loads its corners little differently.
const LOAD: [f64; 3] = [0.4, 0.4, 0.1];
/// Half extents of the belt \[m\]: longer than its way.
const BELT: [f64; 3] = [6.0, 5.0, 0.5];

/// Direction of V in the plain scene: that of a triangle with the sides 3, 4, 5, along no edge and no diagonal.
fn along() -> Vector3<f64> {
    Vector3::new(4.0, 3.0, 0.0) / 5.0
}

/// How the scene is put to the engine.
fn view() -> View {
    View::turned(false)
}
/// Samples in the time to stick, at least, and at the end: also 1/√2 of the friction is enough until then.
const FIFTHS: [usize; 2] = [3, 9];

/// The checks of the family.
pub const CHECKS: &[Check] = &[
    Check {
        name: "conveyor/box",
        level: Level::Simulate,
        question: "Is a box that is laid on a conveyor accelerated by μ g along it until it has the belt's velocity, and not longer?",
        derivation: "All corners slip the same way, so that Σ p_t = μ Σ p_n against the slip w = v − V, whatever each carries, and Σ p_n = \
            m (g t + v_z): V − ‖w‖ − μ v_z = μ g t through every hop, and v stays along V. The slip ends at t = V/(μ g); then no impulse \
            is asked for and v = V. The belt has no mass to be changed by the impulses: its velocity is V, its place x₀ + V t. V is along \
            (4, 3)/5 of the faces, and the scene is turned with its gravity. A pyramid has between μ/√2 and √2 μ in the direction of the \
            slip, which turns, d directions μ cos(π/d) at least; a part c of μ leaves (c − 1) μ v_z. What goes across is asked where all \
            points slip alike: of a cone, in double precision, and not where contacts yield, hop or open. Where they yield the box \
            rocks, and the time alone is asked of a cone. Corners whose depth is taken \
            back by declaration open when nothing is left of it, and move at up to 3/2 g h; a part of more than a third lets the box \
            hop, and is not asked.",
        source: "Newton and Coulomb; Filippov's sliding mode at the belt's velocity",
        run: Run::EachStep(box_on_belt),
        control: Control { passes: "moreau-jean", fails: "conveyor/contacts-see-no-motion" },
    },
    Check {
        name: "conveyor/sphere",
        level: Level::Simulate,
        question: "Does a sphere that is laid on a conveyor roll with 2/7 of the belt's velocity after 2V/(7 μ g)?",
        derivation: "In the frame of the belt the sphere is thrown with −V and no spin: rolling/five-sevenths, with its derivation and its \
            allowances. So it rolls with −5/7 V there, 2/7 V here, after 2V/(7 μ g); V is along no edge, and a pyramid or \
            directions may take \
            longer or shorter, as for the box.",
        source: "Galilei; Newton–Euler and Coulomb",
        run: Run::EachStep(sphere_on_belt),
        control: Control { passes: "moreau-jean", fails: "conveyor/contacts-see-no-motion" },
    },
];

/// The derived verdicts that are not `pass`.
pub const EXPECTED: &[Expected] = &[
    Expected { scheme: "stewart-trinkle", check: "conveyor/box", verdict: Verdict::Difference, why: ALONG_DIRECTIONS },
    Expected { scheme: "stewart-trinkle", check: "conveyor/sphere", verdict: Verdict::Difference, why: ALONG_DIRECTIONS },
];

const ALONG_DIRECTIONS: &str =
    "friction along eight directions of a frame that the belt does not run along: between cos(π/8) and 1 of μ against the slip";

/// A load over a belt whose upper face is the plane z = 0, seen from elsewhere.
fn laid(name: &str, load: Body, friction: f64, velocity: f64) -> Scene {
    let belt = cuboid("belt", 1.0, BELT, [0.0, 0.0, -BELT[2]]).driven((along() * velocity).into());
    view().of_all(&Scene { ground: None, ..over_floor(name, vec![load, belt], friction) })
}

/// The load after every step, in the plain scene turned about z so that V is along x.
fn carried(motion: &Trajectory) -> Vec<Sample> {
    let turn = UnitQuaternion::rotation_between(&along(), &Vector3::x()).unwrap_or_default();
    let ahead = View { turn: turn.inverse(), reversed: false };
    samples(&motion.bodies[0]).iter().map(|seen| ahead.back(&view().back(seen))).collect()
}

/// ‖v − V‖ along the belt \[m/s\].
fn slip(state: &Sample) -> f64 {
    (state.velocity - Vector3::x() * SPEED).xy().norm()
}

/// V/(μ g) \[s\].
fn time_to_stick() -> f64 {
    SPEED / (FRICTION * GRAVITY)
}

fn box_on_belt(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    bench.predicts(&[Addition::StaticFriction, Addition::TorsionalFriction]);
    bench.without_damping()?;
    does_not_hop(bench)?;
    let gap = start_gap(bench, h, (1.0, 4.0), GRAVITY, FRICTION, SPEED);
    let scene = laid("box on a belt", cuboid("box", 1.0, LOAD, [0.0, 0.0, LOAD[2] + gap]), FRICTION, SPEED);
    let fifth = (time_to_stick() / (5.0 * h)).round().max(1.0) as usize;
    let motion = bench.simulate(&scene, h, FIFTHS[1] * fifth, 1)?;
    let states = carried(&motion);
    let [sliding, end] = FIFTHS.map(|fifths| states[fifths * fifth]);
    let time = (FIFTHS[0] * fifth) as f64 * h;
    let full = FRICTION * GRAVITY;
    let stuck = Expectation::at_most(0.0, tolerance::speed(SPEED), "v = V, since V/(μ g) is over");
    let slow = full_slip(bench.description(), full, h);
    let creeping = (slow > 0.0).then(|| Expectation::at_most(slow, tolerance::speed(SPEED), "a slip too small for full friction"));
    let rocking = opens_within(bench, FIFTHS[1] * fifth).map(|_| {
        let why = "corners whose depth is taken back open, fall and are pushed out: the middle turns about those that stick";
        Expectation::at_most(pushed_velocity(GRAVITY, h), tolerance::speed(SPEED), why)
    });
    let mut measured = Vec::new();
    // on contacts that yield the box rocks: its corners slip beside its middle, and their friction is not all against that
    if pyramid(bench).is_some() || !yields(bench) {
        measured.push(pulled(bench, &sliding, time));
    }
    measured.push(sticking(bench, &states, h));
    measured.push(Measurement::new("slip after 9/5 of the time to stick", "m/s", slip(&end), stuck).predicted(creeping.or(rocking)));
    // along a pyramid's edges friction is beside the slip, and where corners open the box turns
    if pyramid(bench).is_none() && stays_closed(bench, FIFTHS[0] * fifth, LOAD[0] + SPEED * time) {
        let aside = Expectation::at_most(0.0, tolerance::pull(full) * time, "friction is opposed to the slip");
        measured.push(Measurement::new("velocity across the belt while it slips", "m/s", sliding.velocity.y.abs(), aside));
    }
    measured.extend(belt_as_prescribed(bench, &motion.bodies[1], SPEED, (states.len() - 1, h)));
    Ok(measured)
}

/// (V − ‖w‖ − μ v_z)/t of a box that slips. A part c of μ gives c μ (g t + v_z), of which μ v_z is taken in full.
fn pulled(bench: &Bench, sliding: &Sample, time: f64) -> Measurement {
    let (full, rising) = (FRICTION * GRAVITY, FRICTION * sliding.velocity.z / time);
    let allowed = tolerance::pull(full);
    let law = pyramid(bench).map(|(ends, why)| between(ends.map(|part| part * full + (part - 1.0) * rising), allowed, why));
    let ideal = Expectation::equal(full, allowed, "μ g, for every load of the corners");
    let value = (SPEED - slip(sliding)) / time - rising;
    Measurement::new("(V − ‖v − V‖ − μ v_z)/t while it slips", "m/s^2", value, ideal).predicted(law)
}

/// Least and greatest μ of the declared cone in the direction of a slip, over μ.
pub(super) fn pyramid(bench: &Bench) -> Option<([f64; 2], &'static str)> {
    match Model::of(bench.description()) {
        Model::StewartTrinkle { directions } => {
            Some(([1.0 - polyhedral::strength_error(directions), 1.0], "friction between μ cos(π/d) and μ"))
        }
        _ if bench.description().friction == Friction::Pyramid => Some(([FRAC_1_SQRT_2, SQRT_2], "a pyramid within or around the cone")),
        _ => None,
    }
}

/// The first sample at which the slip is gone, or too small for the declared law's full friction.
fn sticking(bench: &Bench, states: &[Sample], h: f64) -> Measurement {
    let rate = FRICTION * GRAVITY;
    let full = full_slip(bench.description(), rate, h);
    let found = states.iter().position(|state| slip(state) <= full + tolerance::no_slip(rate, h));
    let measured = found.map_or(f64::INFINITY, |k| k as f64 * h);
    let transition = (SPEED - full) / rate;
    let allowed = tolerance::transition(h);
    // v = μ (g t + v_z): a body that rises when the slip ends has been accelerated for a time v_z/g less
    let earlier = found.map_or(0.0, |k| states[k.saturating_sub(1)].velocity.z.max(states[k].velocity.z).max(0.0) / GRAVITY);
    let [low, high] = pyramid(bench).map_or([1.0; 2], |(range, _)| range);
    let (soonest, latest) = (transition / high - earlier, transition / low);
    let why = "V/(μ g), less v_z/g of a hop, with the declared cone";
    let law = (soonest != latest).then(|| Expectation::equal(0.5 * (soonest + latest), 0.5 * (latest - soonest) + allowed, why));
    let ideal = Expectation::equal(transition, allowed, "V/(μ g), less the time of slips too small for full friction");
    Measurement::new("time to stick", "s", measured, ideal).predicted(law)
}

/// The belt's velocity and place after so many steps of h.
fn belt_as_prescribed(bench: &Bench, belt: &BodyTrack, velocity: f64, (steps, h): (usize, f64)) -> Vec<Measurement> {
    let last = belt.position.len() - 1;
    let way = velocity * steps as f64 * h;
    let direction = view().turn * along();
    let part = |vector: Vector3<f64>, exact: f64| exact.signum() * (exact.abs() + (vector - direction * exact).norm());
    let moved = Vector3::from(belt.position[last]) - Vector3::from(belt.position[0]);
    let speed = Expectation::equal(velocity, tolerance::belt_speed(bench.epsilon(), velocity, way, h), "V is prescribed");
    let place = Expectation::equal(way, tolerance::belt_way(bench.epsilon(), way, steps), "V t");
    vec![
        Measurement::new("velocity of the belt", "m/s", part(belt.linear_velocity[last].into(), velocity), speed),
        Measurement::new("way of the belt", "m", part(moved, way), place),
    ]
}

fn sphere_on_belt(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    bench.predicts(&[Addition::StaticFriction, Addition::TorsionalFriction]);
    bench.without_damping()?;
    let gap = start_gap(bench, h, (1.0, 1.0), GRAVITY, rolling::FRICTION, rolling::SPEED);
    let ball = sphere("ball", 1.0, RADIUS, [0.0, 0.0, RADIUS + gap]);
    let scene = laid("sphere on a belt", ball, rolling::FRICTION, -rolling::SPEED);
    let steps = rolling::steps_to_rolling(h);
    let motion = bench.simulate(&scene, h, steps, 1)?;
    let mut states = carried(&motion);
    states.iter_mut().for_each(|state| state.velocity.x += rolling::SPEED);
    let mut measured = rolling::thrown_along(bench, &states, pyramid(bench).map_or([1.0; 2], |(cone, _)| cone), h);
    measured.iter_mut().for_each(|one| one.quantity += ", seen from the belt");
    measured.extend(belt_as_prescribed(bench, &motion.bodies[1], -rolling::SPEED, (steps, h)));
    Ok(measured)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Verdict;
    use crate::exact::{RigidState, declaring_a_pyramid, judge, measure, refusal};
    use crate::runner::SWEEP;

    /// A state of a body that moves along the belt, or at this angle \[rad\] to it, in the scene as it is put to the engine.
    fn moving(scene: &Scene, index: usize, [moved, speed, rolling, aside]: [f64; 4]) -> RigidState {
        let body = &scene.bodies[index];
        let beside = UnitQuaternion::from_scaled_axis(Vector3::z() * aside);
        let direction = view().turn * (beside * along());
        let spin = view().turn * Vector3::z().cross(&along()) * rolling;
        let place = Vector3::from(body.position) + direction * moved;
        (place.into(), body.orientation, (direction * speed).into(), spin.into())
    }

    /// The closed form with another friction, a box that ends with a part of the belt's velocity, or that goes beside it until it sticks,
    /// and a belt that is braked.
    fn verdicts(h: f64, friction: f64, carried: f64, [braked, aside]: [f64; 2]) -> Vec<Verdict> {
        let measured = judge("conveyor/box", h, |scene, index, _, t| {
            if !scene.bodies[index].is_free() {
                return moving(scene, index, [SPEED * t - 0.5 * braked * t * t, SPEED - braked * t, 0.0, 0.0]);
            }
            let ends = carried * SPEED / (friction * GRAVITY);
            let slipping = t.min(ends);
            let velocity = friction * GRAVITY * slipping;
            let moved = 0.5 * velocity * slipping + carried * SPEED * (t - slipping);
            moving(scene, index, [moved, velocity, 0.0, if t < ends { aside } else { 0.0 }])
        });
        measured.iter().map(Measurement::verdict).collect()
    }

    #[test]
    fn the_closed_form_passes_and_other_friction_a_slower_load_one_that_goes_beside_and_a_belt_that_is_braked_fail() {
        use Verdict::{Fail, Pass};
        for h in SWEEP {
            assert_eq!(verdicts(h, FRICTION, 1.0, [0.0; 2]), [Pass; 6], "{h}");
            assert_eq!(verdicts(h, 1.02 * FRICTION, 1.0, [0.0; 2])[0], Fail, "{h}");
            assert_eq!(verdicts(h, FRICTION, 0.99, [0.0; 2])[2], Fail, "{h}");
            assert_eq!(verdicts(h, FRICTION, 1.0, [0.0, 0.01])[3], Fail, "{h}");
            assert_eq!(verdicts(h, FRICTION, 1.0, [1e-6, 0.0])[4..], [Fail; 2], "{h}");
        }
        assert_eq!(verdicts(SWEEP[SWEEP.len() / 2], 1.1 * FRICTION, 1.0, [0.0; 2])[1], Fail, "it sticks too early");
    }

    /// The worst verdicts of a planted engine: of what is carried, and of the belt.
    fn of_planted(name: &str, check: &str, h: f64) -> [Option<Verdict>; 2] {
        let planted = crate::planted::find(name).expect("listed");
        let measured = measure(check, h, (planted.subject.engine)().as_mut());
        let (belt, load): (Vec<_>, Vec<_>) = measured.iter().partition(|one| one.quantity.ends_with("of the belt"));
        [load, belt].map(|some| some.into_iter().map(Measurement::verdict).max())
    }

    #[test]
    fn a_belt_that_moves_and_carries_nothing_fails_by_its_load_and_one_that_stands_by_itself_as_well() {
        use Verdict::{Fail, Pass};
        for (check, h) in
            [("conveyor/box", 1.0 / 60.0), ("conveyor/box", 0.004), ("conveyor/sphere", 1.0 / 60.0), ("conveyor/sphere", 0.004)]
        {
            assert_eq!(of_planted("conveyor/contacts-see-no-motion", check, h), [Some(Fail), Some(Pass)], "{check} at {h}");
            assert_eq!(of_planted("conveyor/stands-still", check, h), [Some(Fail); 2], "{check} at {h}");
        }
    }

    #[test]
    fn a_box_that_rises_at_either_end_of_a_pyramid_is_a_difference_and_one_beyond_it_fails() {
        let verdict = |part: f64, rising: f64| {
            let time = 0.25;
            let pulled = part * FRICTION * (GRAVITY * time + rising);
            let (position, rotation, spin) = (Vector3::zeros(), UnitQuaternion::identity(), Vector3::zeros());
            let state = Sample { position, rotation, velocity: Vector3::new(pulled, 0.0, rising), spin };
            declaring_a_pyramid(|bench| pulled_verdict(bench, &state, time))
        };
        for rising in [-0.2, 0.0, 0.2] {
            assert_eq!([FRAC_1_SQRT_2, SQRT_2].map(|part| verdict(part, rising)), [Verdict::Difference; 2], "{rising}");
            assert_eq!([0.7, 1.42].map(|part| verdict(part, rising)), [Verdict::Fail; 2], "{rising}");
        }
    }

    fn pulled_verdict(bench: &Bench, state: &Sample, time: f64) -> Verdict {
        pulled(bench, state, time).verdict()
    }

    #[test]
    fn a_box_that_declared_corrections_let_hop_is_not_asked() {
        let reason = refusal("conveyor/box", 0.01, &[("error_reduction", 0.4, "1")]);
        assert!(reason.is_some_and(|reason| reason.contains("error_reduction")));
        assert_eq!(refusal("conveyor/box", 0.01, &[("error_reduction", 0.3, "1")]), None);
    }

    #[test]
    fn a_sphere_that_keeps_two_sevenths_passes_and_one_that_is_carried_along_fails() {
        let rate = FRICTION_OF_SPHERE * GRAVITY;
        const FRICTION_OF_SPHERE: f64 = rolling::FRICTION;
        for h in SWEEP {
            let verdict = |share: f64| {
                let measured = judge("conveyor/sphere", h, |scene, index, _, t| {
                    if !scene.bodies[index].is_free() {
                        return moving(scene, index, [-rolling::SPEED * t, -rolling::SPEED, 0.0, 0.0]);
                    }
                    let slipping = t.min(share * rolling::SPEED / rate);
                    let moved = 0.5 * rate * slipping * slipping + share * rolling::SPEED * (t - slipping);
                    moving(scene, index, [-moved, -rate * slipping, 2.5 * rate * slipping / RADIUS, 0.0])
                });
                measured.iter().map(Measurement::verdict).max().expect("measurements")
            };
            assert_eq!((verdict(2.0 / 7.0), verdict(0.3)), (Verdict::Pass, Verdict::Fail), "{h}");
        }
    }
}
