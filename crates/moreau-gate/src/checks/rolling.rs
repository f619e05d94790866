//! A sphere from sliding to rolling, and down a slope without slipping.
//!
//! ```text
//!     angular momentum about the floor      m v R + I ω = m v₀ R ,  I = ⅖ m R²   ⇒   v = 5/7 v₀ when v = ω R
//!     while it slips                        slip = v₀ − 7/2 μ (g t + v_n)        whatever the normal impulses
//!     rolling down without slip             v̇ = 5/7 g sin α
//! ```
//! The final speed does not depend on the friction law at all: only on the point where friction acts, and on the inertia. A contact at a
//! depth δ has a point on the body, at the lever R, one on the floor, at R − δ, and others between. With the lever ℓ:
//! ```text
//!     v = v₀ mℓ²/(I + mℓ²) ,    v − ω R = −ω (R − ℓ) ,    v̇ = g sin α mℓ²/(I + mℓ²) .
//! ```

use crate::check::{Control, Expected, Run};
use crate::checks::motion::{Sample, Slope, samples, start_gap, yields};
use crate::checks::scenery::{GRAVITY, between, over_floor, sphere};
use crate::model::Model;
use crate::model::addition::Addition;
use crate::model::damping::driven;
use crate::model::sliding::{SPHERE, full_slip, hops};
use crate::model::springs::swinging;
use crate::tolerance::flight::damped_velocity;
use crate::tolerance::rolling as tolerance;
use crate::{Bench, Check, Expectation, Level, Measurement, Refusal, Reply};
use moreau_dynamics::scenes::{Body, Ground, Scene};
use nalgebra::Vector3;

pub(super) const RADIUS: f64 = 0.1;
/// Speed without spin at the start, against what the sphere touches \[m/s\].
pub(super) const SPEED: f64 = 4.0;
pub(super) const FRICTION: f64 = 0.3;

/// The checks of the family.
pub const CHECKS: &[Check] = &[
    Check {
        name: "rolling/five-sevenths",
        level: Level::Simulate,
        question: "Does a sphere thrown along the floor end with 5/7 of its speed, rolling, and after the right time?",
        derivation: "Friction at the floor does not change the angular momentum about a point of the floor: v = 5/7 v₀. Slip falls as v₀ \
            − 7/2 μ (g t + v_n). So rolling begins at 2 v₀/(7 μ g), and by v_n/g earlier in a model that hops within the step. There is \
            no rolling resistance, so that speed and spin do not change after that; a declared one, a moment of a p_n, takes a g \
            t/R of v₀ and \
            5/2 a/R of 7/2 μ, under rigid laws, up to a = μ R/2, lest the sphere roll too late to be measured. A contact at the \
            measured depth δ has a lever ℓ \
            between R and R − δ, which makes v = v₀ ℓ²/(⅖R² + ℓ²). For the ideal δ is at most what a sound step makes out of rest, 3/2 \
            g h². A declared spring along the floor that friction has loaded swings the slip at up to μ g √(m W_t/k), damped as declared.",
        source: "Newton–Euler and Coulomb; Goldsmith, Impact (billiards)",
        run: Run::EachStep(throw),
        control: Control { passes: "moreau-jean", fails: "rolling/hollow-sphere" },
    },
    Check {
        name: "rolling/incline",
        level: Level::Simulate,
        question: "Does a sphere roll down a 20° slope with 5/7 g sin α?",
        derivation: "Sticking needs 2/7 tan α ≤ μ, here 0.10 < 0.5. Constant forces are integrated exactly; the acceleration is taken over \
            the \
                     second half, after the start has settled. A contact at the measured depth δ has a lever ℓ between R and R − δ, which \
            makes g sin α ℓ²/(⅖R² + ℓ²). For the ideal δ is at most what a sound step makes out of rest, 3/2 g h².",
        source: "Newton–Euler: a = g sin α/(1 + I/mR²)",
        run: Run::EachStep(incline),
        control: Control { passes: "moreau-jean", fails: "rolling/resistance" },
    },
];

/// The derived verdicts that are not `pass`: none. Anitescu's sphere starts at its own gap μ h v₀ and does not hop.
pub const EXPECTED: &[Expected] = &[];

/// Time until the thrown sphere rolls \[s\].
const TRANSITION: f64 = SPEED / (SPHERE * FRICTION * GRAVITY);

/// The most rolling friction a over μ R that is predicted: the sphere rolls after 14/9 of [`TRANSITION`], of which two are watched. With
/// 7/10 it would roll at the end only.
const MOST_RESISTED: f64 = 0.5;

/// A sphere thrown along the floor.
fn thrown(bench: &Bench, h: f64) -> Scene {
    let gap = start_gap(bench, h, (1.0, 1.0), GRAVITY, FRICTION, SPEED);
    let mut ball = sphere("ball", 1.0, RADIUS, [0.0, 0.0, RADIUS + gap]);
    ball.linear_velocity = [SPEED, 0.0, 0.0];
    over_floor("thrown sphere", vec![ball], FRICTION)
}

fn throw(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    bench.predicts(&[Addition::StaticFriction, Addition::TorsionalFriction]);
    let coulomb = matches!(Model::of(bench.description()), Model::Coulomb(_)) && !yields(bench);
    if coulomb {
        bench.predicts(&[Addition::StaticFriction, Addition::TorsionalFriction, Addition::RollingFriction]);
    }
    bench.without_damping()?;
    let rolling = Addition::RollingFriction.declared(bench.description());
    if rolling > MOST_RESISTED * FRICTION * RADIUS {
        let why = "the declared rolling friction is more than μ R/2: the sphere rolls too late to be measured";
        return Err(Refusal::unsupported(why));
    }
    let motion = bench.simulate(&thrown(bench, h), h, steps_to_rolling(h), 1)?;
    let states = samples(&motion.bodies[0]);
    let measured = thrown_along(bench, &states, [1.0; 2], h);
    Ok(if rolling > 0.0 { resisted(measured, &states, rolling, h) } else { measured })
}

/// The measurements of [`thrown_along`] under a declared moment of a p_n against rolling, from the start: the angular momentum about the
/// floor falls by a m g t, and 7/2 μ − 5/2 a/R for 7/2 μ ends the slip.
fn resisted(measured: Vec<Measurement>, states: &[Sample], rolling: f64, h: f64) -> Vec<Measurement> {
    let depth = Depth::of(states.iter().map(|state| RADIUS - state.position.z)).of_rigid(GRAVITY, h);
    let time = (states.len() - 1) as f64 * h;
    let allowed = tolerance::speed(SPEED);
    let speed = |lever: f64| (SPEED - rolling * GRAVITY * time / lever).max(0.0) * part(lever);
    let rate = GRAVITY * (SPHERE * FRICTION - (SPHERE - 1.0) * rolling / RADIUS);
    let ends = SPEED / rate;
    let why = "the declared rolling friction, with the lever of the contact";
    let late = tolerance::transition(h) + tolerance::later(ends, depth.size(), RADIUS);
    let laws = [
        depth.levers(allowed, why, speed),
        depth.levers(allowed, why, |lever| speed(lever) * (1.0 - RADIUS / lever)),
        Expectation::equal(ends, late, "v₀/(g (7/2 μ − 5/2 a/R)), with the declared rolling friction"),
    ];
    measured.into_iter().zip(laws).map(|(one, law)| one.predicted(Some(law))).collect()
}

/// Steps of twice the time until the thrown sphere rolls.
pub(super) fn steps_to_rolling(h: f64) -> usize {
    (2.0 * TRANSITION / h).round() as usize
}

/// What is measured of a sphere that begins with [`SPEED`] along x, without spin, against a level surface at z = 0; the states after every
/// step in the frame of this surface. `cone` is the least and the greatest friction over μ in the direction of a slip that x may become.
pub(super) fn thrown_along(bench: &Bench, states: &[Sample], cone: [f64; 2], h: f64) -> Vec<Measurement> {
    let end = states[states.len() - 1];
    let depth = Depth::of(states.iter().map(|state| RADIUS - state.position.z));
    let allowed = tolerance::speed(SPEED);
    let rigid = depth.of_rigid(GRAVITY, h);
    let lever = yields(bench).then_some(depth);
    let swing = swinging(&Model::of(bench.description()), FRICTION * GRAVITY, SPHERE, TRANSITION);
    let speed = |depth: Depth, why: &str| depth.levers(allowed + swing / SPHERE, why, |lever| SPEED * part(lever));
    let spun = |depth: Depth, why: &str| depth.levers(allowed + swing, why, |lever| SPEED * part(lever) * (1.0 - RADIUS / lever));
    vec![
        Measurement::new("final speed", "m/s", end.velocity.x, speed(rigid, "5/7 of the initial speed, with the lever of the contact"))
            .predicted(lever.map(|depth| speed(depth, LEVER))),
        Measurement::new("final slip", "m/s", slip(&end), spun(rigid, "v = ω ℓ, with the lever of the contact"))
            .predicted(lever.map(|depth| spun(depth, LEVER))),
        time_to_rolling(bench, states, (depth, cone), h),
    ]
}

const LEVER: &str = "the contact has a lever between R and R − δ";

/// I/(m R²) of a solid sphere.
const SPHERE_GYRATION: f64 = 0.4;

/// mℓ²/(I + mℓ²) of a solid sphere, 5/7 at the lever R.
fn part(lever: f64) -> f64 {
    share(SPHERE_GYRATION, lever)
}

/// mℓ²/(I + mℓ²) of a body with this I/(m R²).
fn share(gyration: f64, lever: f64) -> f64 {
    lever * lever / (gyration * RADIUS * RADIUS + lever * lever)
}

/// The least and the greatest measured depth \[m\], with 0 between them.
#[derive(Clone, Copy, Debug)]
struct Depth {
    least: f64,
    greatest: f64,
}

impl Depth {
    /// A contact deeper than nine tenths of the radius has no lever to speak of.
    fn of(depths: impl Iterator<Item = f64>) -> Self {
        let none = Depth { least: 0.0, greatest: 0.0 };
        depths.fold(none, |found, depth| Depth { least: found.least.min(depth), greatest: found.greatest.max(depth).min(0.9 * RADIUS) })
    }

    /// What of it a sound step makes.
    fn of_rigid(self, press: f64, h: f64) -> Self {
        let Depth { least, greatest } = self;
        Depth { least: -tolerance::rigid_depth(-least, press, h), greatest: tolerance::rigid_depth(greatest, press, h) }
    }

    /// What is expected of a value that grows with the lever R − δ, or falls with it.
    fn levers(self, allowed: f64, why: &str, value: impl Fn(f64) -> f64) -> Expectation {
        between([self.least, self.greatest].map(|depth| value(RADIUS - depth)), allowed, why)
    }

    /// The largest change of the lever \[m\].
    fn size(self) -> f64 {
        self.greatest.max(-self.least)
    }
}

/// The first sample at which the slip is gone, or too small for the declared law's full friction.
fn time_to_rolling(bench: &Bench, states: &[Sample], (depth, [weak, strong]): (Depth, [f64; 2]), h: f64) -> Measurement {
    let rate = SPHERE * FRICTION * GRAVITY;
    let full = full_slip(bench.description(), rate, h);
    let transition = (SPEED - full) / rate;
    let found = states.iter().position(|state| left(state) <= full + tolerance::no_slip(rate, h));
    let measured = found.map_or(f64::INFINITY, |k| k as f64 * h);
    let allowed = tolerance::transition(h) + tolerance::later(transition, depth.of_rigid(GRAVITY, h).size(), RADIUS);
    let ideal = Expectation::equal(transition, allowed, "2 v₀/(7 μ g), less the time of slips too small for full friction");
    let measurement = Measurement::new("time to rolling", "s", measured, ideal);
    let edged = weak < strong;
    let Some(k) = found.filter(|k| *k > 0 && (edged || hops(bench.description()) || yields(bench))) else { return measurement };
    // Still slipping at sample k − 1, no more at k: 7/2 μ (g t + v_n) passes v₀ between them.
    let [late, early] = [k - 1, k].map(|k| transition - states[k].velocity.z / GRAVITY);
    let (low, high) = (early.min(late) / strong, early.max(late) / weak);
    let allowed = 0.5 * (high - low) + tolerance::transition(h) + tolerance::later(transition, depth.size(), RADIUS);
    measurement.predicted(Some(Expectation::equal(
        0.5 * (low + high),
        allowed,
        "the same, less v_n/g of a hop, with the lever R − δ and the declared cone",
    )))
}

/// The slip that is left \[m/s\], along x until it is gone and across.
fn left(state: &Sample) -> f64 {
    state.velocity_at(Vector3::new(0.0, 0.0, -RADIUS)).y.hypot(slip(state).max(0.0))
}

/// Velocity of the sphere's lowest point along x \[m/s\].
fn slip(state: &Sample) -> f64 {
    state.velocity_at(Vector3::new(0.0, 0.0, -RADIUS)).x
}

fn incline(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    let why = "5/7 g sin α, with the lever of the contact";
    Ok(vec![rolls_down(bench, h, &sphere("ball", 1.0, RADIUS, [0.0; 3]), (SPHERE_GYRATION, 1.0), why)?])
}

/// The acceleration of a body of 1 kg that rolls down a slope of 20° on the radius [`RADIUS`], with its I/(m R²) and the number of its
/// contacts; what the ideal is, in words.
pub(super) fn rolls_down(bench: &mut Bench, h: f64, body: &Body, (gyration, contacts): (f64, f64), why: &str) -> Reply<Measurement> {
    bench.predicts(&[Addition::StaticFriction, Addition::TorsionalFriction, Addition::RollingFriction]);
    let rolling = Addition::RollingFriction.declared(bench.description());
    if rolling > 0.0 {
        bench.without_damping()?;
    }
    let (sine, cosine) = 20f64.to_radians().sin_cos();
    let height = RADIUS + start_gap(bench, h, (1.0, contacts), GRAVITY * cosine, 0.5, 0.0);
    let rolling_body = Body { position: [height * sine, 0.0, height * cosine], ..body.clone() };
    let mut scene = over_floor("rolling down", vec![rolling_body], 0.5);
    scene.ground = Some(Ground { normal: [sine, 0.0, cosine], offset: 0.0 });
    let slope = Slope::of(&scene).ok_or_else(|| Refusal::errored("the scene has no plane"))?;
    let half = (0.5 / h).round() as usize;
    let motion = bench.simulate(&scene, h, 2 * half, half)?;
    let [middle, end] = [1, 2].map(|k| Sample::of(&motion.bodies[0], k));
    let time = half as f64 * h;
    let acceleration = (end.velocity - middle.velocity).dot(&slope.down) / time;
    let depth = Depth::of([middle, end].iter().map(|state| RADIUS - slope.height(&state.position)));
    let law = |depth: Depth, why: &str| depth.levers(tolerance::acceleration(slope.pull), why, |lever| slope.pull * share(gyration, lever));
    let ideal = law(depth.of_rigid(slope.press, h), why);
    let yielding = yields(bench).then(|| law(depth, LEVER));
    // m a = m g sin α − F, J a/R = F R − a_r m g cos α; a ball that is held does not move
    let braked = (rolling > 0.0).then(|| {
        let pull = (slope.pull - rolling / RADIUS * slope.press).max(0.0);
        let allowed = tolerance::acceleration(slope.pull);
        depth.levers(allowed, "the declared rolling friction, with the lever R − δ", |lever| pull * share(gyration, lever))
    });
    let model = Model::of(bench.description());
    let taken = match &model {
        Model::Coulomb(limits) if limits.taken_back() > 0.0 => Some(limits.taken_back()),
        _ => None,
    };
    let hopping = taken.map(|part| {
        let why = "the ideal, with what a body gains that declared corrections let hop";
        Expectation { why: why.into(), tolerance: ideal.tolerance + tolerance::hopping(part, slope.pull, h, time), ..ideal.clone() }
    });
    let yielding = yielding.or(hopping);
    let damped = model.damping().map(|rates| damped(yielding.as_ref().unwrap_or(&ideal), gyration, rates, time, h));
    Ok(Measurement::new("acceleration", "m/s^2", acceleration, ideal).predicted(damped.or(braked).or(yielding)))
}

/// The mean acceleration over the second half, from T to 2T, under damping: v̇ = a − κ v with κ = (c + j c_ω)/(1 + j), j = I/(m R²), from
/// rest.
fn damped(undamped: &Expectation, gyration: f64, (linear, angular): (f64, f64), time: f64, h: f64) -> Expectation {
    let rate = (linear + gyration * angular) / (1.0 + gyration);
    let [middle, end] = [time, 2.0 * time].map(|time| driven(rate, undamped.value, 0.0, time));
    let error = damped_velocity(linear.max(angular), GRAVITY, end, 2.0 * time, h) / time;
    // κ itself changes with the lever by no more than the acceleration does.
    let lever = undamped.tolerance * (1.0 + linear.max(angular) * time);
    Expectation::equal((end - middle) / time, lever + error, "the same under the declared damping")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Verdict;
    use crate::exact::{judge_declaring, refusal};
    use crate::runner::SWEEP;

    /// Worst verdict on a thrown sphere with rolling friction a \[m\] that declares another one. While it slips, v̇ = −μ g and ω̇ R = 5/2 g
    /// (μ − a/R); when it rolls, v̇ = −5/7 g a/R.
    fn verdict(h: f64, acts: f64, declared: f64) -> Verdict {
        let part = acts / RADIUS;
        let ends = SPEED / (GRAVITY * (3.5 * FRICTION - 2.5 * part));
        let measured = judge_declaring("rolling/five-sevenths", h, &[("rolling_friction", declared, "m")], |scene, index, _, t| {
            let (slipping, rolling) = (t.min(ends), (t - ends).max(0.0));
            let slowed = 5.0 / 7.0 * GRAVITY * part * rolling;
            let velocity = SPEED - FRICTION * GRAVITY * slipping - slowed;
            let rim = 2.5 * GRAVITY * (FRICTION - part) * slipping - slowed;
            (scene.bodies[index].position, [1.0, 0.0, 0.0, 0.0], [velocity, 0.0, 0.0], [0.0, rim / RADIUS, 0.0])
        });
        measured.iter().map(Measurement::verdict).max().expect("measurements")
    }

    #[test]
    fn a_sphere_that_would_roll_too_late_is_not_asked() {
        let refused = |part: f64| refusal("rolling/five-sevenths", 0.01, &[("rolling_friction", part * FRICTION * RADIUS, "m")]);
        assert!(refused(0.51).is_some_and(|reason| reason.contains("rolling friction")));
        assert_eq!(refused(0.49), None);
    }

    #[test]
    fn declared_rolling_friction_is_a_difference_where_it_acts_and_fails_where_it_does_not_or_is_another() {
        for h in SWEEP {
            assert_eq!(verdict(h, 0.01, 0.01), Verdict::Difference, "{h}");
            for acts in [0.0, 0.009, 0.011] {
                assert_eq!(verdict(h, acts, 0.01), Verdict::Fail, "{acts} at {h}");
            }
        }
    }
}
