//! Impacts of free spheres, without gravity, ground or friction: nothing but the impact law, so that no number depends on h.
//!
//! ```text
//!     m₁v₁⁺ + m₂v₂⁺ = m₁v₁ + m₂v₂ ,    n·(v₂⁺ − v₁⁺) = −e n·(v₂ − v₁) ,    ΔT = −½ (1 − e²) m̄ (n·Δv)² .
//! ```

use crate::check::{Control, Expected, Run};
use crate::checks::scenery::{between, over_floor, schedule, sphere};
use crate::model::Model;
use crate::model::normal::Normal;
use crate::tolerance::flight::damped_velocity;
use crate::tolerance::impact as tolerance;
use crate::{Bench, Check, Expectation, Level, Measurement, Reply};
use moreau_dynamics::scenes::{Body, Scene};
use moreau_dynamics::trajectory::Trajectory;
use nalgebra::Vector3;

/// The checks of the family.
pub const CHECKS: &[Check] = &[
    Check {
        name: "impact/two-spheres",
        level: Level::Simulate,
        question: "Do two spheres of different mass exchange momentum by Newton's law, head-on and obliquely?",
        derivation: "Velocities are constant except for the impact, so that v⁺ is exact for every h. Without friction the impulse lies \
            along the line of centres. The spheres may be up to the motion s of two steps away from the place of contact, which turns \
            that line by at most δ = b s/(R − s)². If the approach speed is taken along the normal of the step before, it is off by the \
            part δ tan φ + ½ δ² of itself, with the angle φ between the normal and the line of flight. A declared linear damping c \
            multiplies all velocities by e^{−cT}.",
        source: "closed form of the central impact; Newton's law",
        run: Run::EachStep(two_spheres),
        control: Control { passes: "moreau-jean", fails: "impact/one-sided-impulse" },
    },
    Check {
        name: "impact/cradle",
        level: Level::Simulate,
        question: "What do three equal elastic spheres do, two of them in contact?",
        derivation: "One impact after another gives (0, 0, v). Both impacts at once give (−v/3, 2v/3, 2v/3) by Newton's law. Both \
            results keep momentum and energy, and the theory of rigid bodies does not decide between them. The first sphere's velocity \
            shows which one the engine computes.",
        source: "Newton's cradle; non-uniqueness of multiple impacts",
        run: Run::EachStep(cradle),
        control: Control { passes: "moreau-jean", fails: "impact/one-sided-impulse" },
    },
    Check {
        name: "impact/plastic",
        level: Level::Simulate,
        question: "Do two spheres without restitution go on together, with the energy of their common motion?",
        derivation: "v⁺ = (m₁v₁ + m₂v₂)/(m₁ + m₂) and ΔT = −½ m̄ Δv². A compliant law separates them with the effective e of its replayed \
                     discrete map on the reduced mass m̄, and loses 1 − e² of that.",
        source: "closed form of the central impact",
        run: Run::EachStep(plastic),
        control: Control { passes: "moreau-jean", fails: "impact/averaged-mass" },
    },
];

/// The derived verdicts that are not `pass`.
pub const EXPECTED: &[Expected] = &[
    Expected::without_restitution("stewart-trinkle", "impact/two-spheres"),
    Expected::without_restitution("stewart-trinkle", "impact/cradle"),
    Expected::without_restitution("anitescu", "impact/two-spheres"),
    Expected::without_restitution("anitescu", "impact/cradle"),
];

const DURATION: f64 = 0.25;
/// \[m/s\]; no engine's threshold of restitution.
const SPEED: f64 = 2.5;
/// Radii \[m\], their sum R = 1 m: large against the motion of a step.
const RADII: [f64; 2] = [0.4, 0.6];
const MASSES: [f64; 2] = [1.0, 3.0];
/// Gap before the impact \[m\]. It is larger than the contact margin of any engine. It is not closed in a whole number of steps, because
/// rounding would then decide the step of the impact.
const GAP: f64 = 0.0473;

/// A sphere that flies along x at another at rest, `offset` \[m\] beside the line of flight.
fn pair(offset: f64, restitution: f64) -> Scene {
    let along = ((RADII[0] + RADII[1]).powi(2) - offset * offset).sqrt() + GAP;
    let first = Body { linear_velocity: [SPEED, 0.0, 0.0], ..sphere("first", MASSES[0], RADII[0], [-along, 0.0, 1.0]) };
    in_space("two spheres", vec![first, sphere("second", MASSES[1], RADII[1], [0.0, offset, 1.0])], restitution)
}

fn in_space(name: &str, bodies: Vec<Body>, restitution: f64) -> Scene {
    let mut scene = Scene { ground: None, gravity: [0.0; 3], ..over_floor(name, bodies, 0.0) };
    scene.material.restitution = restitution;
    scene
}

/// Velocities before and after.
struct Impact {
    masses: Vec<f64>,
    before: Vec<Vector3<f64>>,
    after: Vec<Vector3<f64>>,
    /// Largest angular velocity afterwards \[rad/s\].
    spin: f64,
    /// What a declared damping leaves of the velocities.
    slowing: Option<Slowing>,
}

/// What a declared linear damping c leaves of every velocity after the time T without forces, e^{−cT}, and the error of its steps. Impacts
/// are linear in the velocities, so that it does not matter when they happen.
#[derive(Clone, Copy, Debug)]
struct Slowing {
    kept: f64,
    error: f64,
    /// The damping of the steps that find an impact: u⁺ = −e u⁻ may take u⁻ before it.
    skipped: f64,
}

impl Slowing {
    fn of(bench: &Bench, time: f64, h: f64) -> Option<Self> {
        let (damping, _) = Model::of(bench.description()).damping()?;
        Some(Slowing {
            kept: (-damping * time).exp(),
            error: damped_velocity(damping, 0.0, 1.0, time, h),
            skipped: tolerance::skipped(damping, h),
        })
    }

    /// A quantity of this power of the velocities, which is `undamped` without damping.
    fn slowed(&self, undamped: &Expectation, power: i32) -> Expectation {
        let error = f64::from(power) * (self.error + self.skipped) * (undamped.value.abs() + undamped.tolerance);
        let value = undamped.value * self.kept.powi(power);
        Expectation {
            value,
            tolerance: undamped.tolerance + error,
            why: format!("{}, and the declared damping", undamped.why),
            ..*undamped
        }
    }
}

impl Impact {
    fn of(bench: &mut Bench, scene: &Scene, duration: f64, h: f64) -> Reply<Self> {
        let (steps, every) = schedule(duration, 1, h);
        let trajectory = bench.simulate(scene, h, steps, every)?;
        Ok(Impact::measured(scene, &trajectory, Slowing::of(bench, steps as f64 * h, h)))
    }

    fn measured(scene: &Scene, trajectory: &Trajectory, slowing: Option<Slowing>) -> Self {
        let last = trajectory.times.len() - 1;
        let velocities = |k: usize| trajectory.bodies.iter().map(|track| Vector3::from(track.linear_velocity[k])).collect();
        let spins = trajectory.bodies.iter().map(|track| Vector3::from(track.angular_velocity[last]).norm());
        let masses = scene.bodies.iter().map(|body| body.mass).collect();
        Impact { masses, before: velocities(0), after: velocities(last), spin: spins.fold(0.0, crate::checks::scenery::worst), slowing }
    }

    /// What the declared law predicts of a quantity of this power of the velocities: `law`, or else the ideal, under the declared damping.
    fn law(&self, law: Option<Expectation>, ideal: &Expectation, power: i32) -> Option<Expectation> {
        match self.slowing {
            Some(slowing) => Some(slowing.slowed(law.as_ref().unwrap_or(ideal), power)),
            None => law,
        }
    }

    fn momentum(&self, velocities: &[Vector3<f64>]) -> Vector3<f64> {
        self.masses.iter().zip(velocities).map(|(mass, v)| v * *mass).sum()
    }

    fn energy(&self, velocities: &[Vector3<f64>]) -> f64 {
        self.masses.iter().zip(velocities).map(|(mass, v)| 0.5 * mass * v.norm_squared()).sum()
    }

    fn lost(&self) -> f64 {
        self.energy(&self.before) - self.energy(&self.after)
    }

    /// Direction of the impulse on the second body; the line of flight if there is none.
    fn direction(&self) -> Vector3<f64> {
        (self.after[1] - self.before[1]).try_normalize(0.0).unwrap_or(Vector3::x())
    }

    /// −n·(v₂⁺ − v₁⁺)/n·(v₂ − v₁).
    fn restitution(&self) -> f64 {
        let normal = self.direction();
        -normal.dot(&(self.after[1] - self.after[0])) / normal.dot(&(self.before[1] - self.before[0]))
    }

    fn momentum_change(&self, words: &str, epsilon: f64) -> Measurement {
        let before = self.momentum(&self.before);
        let change = (self.momentum(&self.after) - before).norm();
        let allowed = tolerance::velocity(epsilon) * before.norm();
        let ideal = Expectation::at_most(0.0, allowed, "impulses are opposite");
        let lost = |slowing: Slowing| {
            let [lost, error] = [1.0 - slowing.kept, slowing.error].map(|part| part * before.norm());
            Expectation::equal(lost, allowed + error, "impulses are opposite, and the declared damping")
        };
        Measurement::new(format!("change of momentum{words}"), "kg*m/s", change, ideal).predicted(self.slowing.map(lost))
    }
}

fn reduced_mass() -> f64 {
    MASSES[0] * MASSES[1] / (MASSES[0] + MASSES[1])
}

/// The restitution of an impact, 0 below a declared threshold, with what a declared law adds to it.
pub(super) fn declared(bench: &Bench, restitution: f64, approach: f64, allowed: f64, h: f64) -> Option<Expectation> {
    let Model::Coulomb(limits) = Model::of(bench.description()) else { return None };
    let [push, mixing] = softness(bench, approach, h);
    let still = approach <= limits.restitution_threshold || restitution * approach <= limits.rebound_threshold;
    let value = if still { 0.0 } else { restitution };
    let (low, high) = (value - mixing * (1.0 + value), value + push);
    let why = "the declared threshold, force mixing and error reduction";
    (still || low < high).then(|| Expectation::equal(0.5 * (low + high), allowed + 0.5 * (high - low), why))
}

/// [p, c]: what a declared law adds to the velocity after an impact at `approach` \[m/s\], over it: up to p where it takes back a part of
/// the depth, at most v h, at which the impact was found; and down to −c (1 + e) where it mixes forces.
pub(super) fn softness(bench: &Bench, approach: f64, h: f64) -> [f64; 2] {
    match Model::of(bench.description()) {
        Model::Coulomb(limits) => [limits.push(approach * h, h) / approach, limits.force_mixing],
        _ => [0.0; 2],
    }
}

fn two_spheres(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    const RESTITUTION: f64 = 0.5;
    const OFFSET: f64 = 0.5;
    let allowed = tolerance::velocity(bench.epsilon());
    let mut measured = Vec::new();
    let reach = RADII[0] + RADII[1];
    for (words, offset) in [(", head-on", 0.0), (", oblique", OFFSET)] {
        let impact = Impact::of(bench, &pair(offset, RESTITUTION), DURATION, h)?;
        let exact = Vector3::new((reach * reach - offset * offset).sqrt(), offset, 0.0);
        let angle = impact.direction().cross(&exact).norm().atan2(impact.direction().dot(&exact));
        let turned = tolerance::turned(offset, reach, SPEED, h) + allowed;
        let older = RESTITUTION * tolerance::approach(offset / exact.x, tolerance::turned(offset, reach, SPEED, h));
        let newton =
            Expectation::equal(RESTITUTION, allowed + older, "Newton's law, whatever h; the approach perhaps along an older normal");
        let approach = SPEED * exact.x / reach;
        let law = impact.law(declared(bench, RESTITUTION, approach, allowed + older, h), &newton, 1);
        measured.extend([
            impact.momentum_change(words, bench.epsilon()),
            Measurement::new(format!("restitution{words}"), "1", impact.restitution(), newton).predicted(law),
            Measurement::new(
                format!("impulse off the line of centres{words}"),
                "rad",
                angle,
                Expectation::at_most(0.0, turned, "b s/(R − s)²"),
            ),
            Measurement::new(
                format!("spin without friction{words}"),
                "rad/s",
                impact.spin,
                Expectation::at_most(0.0, allowed * SPEED / RADII[0], "no torque"),
            ),
        ]);
    }
    Ok(measured)
}

fn cradle(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    const RADIUS: f64 = 0.1;
    let places = [-2.0 * RADIUS - GAP, 0.0, 2.0 * RADIUS];
    let mut bodies: Vec<Body> =
        places.iter().enumerate().map(|(k, x)| sphere(&format!("sphere{k}"), 1.0, RADIUS, [*x, 0.0, 1.0])).collect();
    bodies[0].linear_velocity = [SPEED, 0.0, 0.0];
    let impact = Impact::of(bench, &in_space("cradle", bodies, 1.0), DURATION, h)?;
    let allowed = tolerance::velocity(bench.epsilon());
    let [first, middle, last] = [0, 1, 2].map(|k| impact.after[k].x / SPEED);
    let energy = impact.energy(&impact.after) / impact.energy(&impact.before);
    let approaching = (first - middle).max(middle - last);
    let either = |low: f64, high: f64| between([low, high], allowed, "between one after another and both at once");
    let [push, mixing] = softness(bench, SPEED, h);
    let soft = tolerance::soft_cradle(push, mixing);
    let law = |range: [f64; 2], ideal: &Expectation, power: i32| {
        let soft = (push + mixing > 0.0).then(|| between(range, allowed, "the declared error reduction and force mixing"));
        impact.law(soft, ideal, power)
    };
    let elastic = Expectation::equal(1.0, 2.0 * allowed, "elastic");
    let [first_ideal, last_ideal] = [either(-1.0 / 3.0, 0.0), either(2.0 / 3.0, 1.0)];
    let [energy_law, first_law, last_law] =
        [law(soft.energy, &elastic, 2), law(soft.first, &first_ideal, 1), law(soft.last, &last_ideal, 1)];
    Ok(vec![
        impact.momentum_change("", bench.epsilon()),
        Measurement::new("energy after over before", "1", energy, elastic).predicted(energy_law),
        Measurement::new("velocity of the first sphere over v", "1", first, first_ideal).predicted(first_law),
        Measurement::new("velocity of the last sphere over v", "1", last, last_ideal).predicted(last_law),
        Measurement::new("largest approach left over v", "1", approaching, Expectation::at_most(0.0, allowed, "no impact is left over"))
            .predicted((mixing > 0.0).then(|| Expectation::at_most(3.0 * mixing, allowed, "the declared force mixing"))),
    ])
}

fn plastic(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    let impact = Impact::of(bench, &pair(0.0, 0.0), DURATION, h)?;
    let allowed = tolerance::velocity(bench.epsilon());
    let separation = (impact.after[1] - impact.after[0]).norm() / SPEED;
    let lost = impact.lost() / (0.5 * reduced_mass() * SPEED * SPEED);
    let (steps, _) = schedule(DURATION, 1, h);
    let contact = Normal::spheres(&[(MASSES[0], RADII[0]), (MASSES[1], RADII[1])], 0.0, 0.0, bench.description().friction, h);
    let replayed = contact.replays(&Model::of(bench.description()), GAP, -SPEED, steps);
    let left = replayed.map(|all| all.iter().filter_map(|states| states.last()).map(|(_, v)| v.abs() / SPEED).collect::<Vec<_>>());
    let error = crate::tolerance::ball::replay(steps, bench.epsilon());
    let model = |values: &[f64], kept: fn(f64) -> f64| {
        between(values.iter().copied().map(kept), error, "replay of the declared law's discrete map")
    };
    let together = Expectation::equal(0.0, allowed, "one velocity");
    let spent = Expectation::equal(1.0, 2.0 * allowed, "½ m̄ Δv²");
    let [push, mixing] = softness(bench, SPEED, h);
    let apart = push.max(mixing);
    let soft = |value: f64, far: f64| {
        let (middle, half) = (value + 0.5 * far, 0.5 * far.abs() + 2.0 * allowed);
        (apart > 0.0).then(|| Expectation::equal(middle, half, "the declared error reduction and force mixing"))
    };
    let parting = left.as_ref().map(|left| model(left, |e| e)).or_else(|| soft(0.0, apart));
    let wasted = left.as_ref().map(|left| model(left, |e| 1.0 - e * e)).or_else(|| soft(1.0, -apart * apart));
    // The common motion has a third of ½ m̄ Δv², of which damping leaves e^{−2cT}.
    let damped = impact.slowing.map(|Slowing { kept, error, .. }| {
        let undamped = wasted.as_ref().unwrap_or(&spent);
        let common = MASSES[0] / MASSES[1];
        let value = undamped.value + (1.0 - kept * kept) * (common + 1.0 - undamped.value);
        Expectation { value, tolerance: undamped.tolerance + 2.0 * error * (1.0 + common), why: DAMPED.into(), ..*undamped }
    });
    Ok(vec![
        impact.momentum_change("", bench.epsilon()),
        Measurement::new("relative velocity after over before", "1", separation, together.clone())
            .predicted(impact.law(parting, &together, 1)),
        Measurement::new("energy lost over ½ m̄ Δv²", "1", lost, spent.clone()).predicted(damped.or(wasted)),
    ])
}

const DAMPED: &str = "½ m̄ Δv², and the declared damping";

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Verdict;
    use crate::exact::{RigidState, judge};
    use crate::runner::QUICK;
    use moreau_forms::two_body_impact::TwoBodyImpact;

    /// The exact motion of the head-on and oblique pair; three spheres strike one after another.
    fn exact(scene: &Scene, index: usize, restitution: f64, t: f64) -> RigidState {
        let body = &scene.bodies[index];
        let start = Vector3::from(body.position);
        let contact = GAP / SPEED;
        let velocity = if t < contact { Vector3::from(body.linear_velocity) } else { after(scene, index, restitution) };
        let place = start + Vector3::from(body.linear_velocity) * t.min(contact) + velocity * (t - contact).max(0.0);
        (place.into(), [1.0, 0.0, 0.0, 0.0], velocity.into(), [0.0; 3])
    }

    fn after(scene: &Scene, index: usize, restitution: f64) -> Vector3<f64> {
        if scene.bodies.len() == 3 {
            return Vector3::x() * if index == 2 { SPEED } else { 0.0 };
        }
        let offset = scene.bodies[1].position[1];
        let normal = Vector3::new((1.0 - offset * offset).sqrt(), offset, 0.0);
        let approach = SPEED * normal.x;
        let post = TwoBodyImpact { masses: MASSES, velocities: [approach, 0.0], restitution }.velocities_post();
        if index == 0 { Vector3::x() * SPEED + normal * (post[0] - approach) } else { normal * post[1] }
    }

    fn verdict(check: &str, h: f64, restitution: impl Fn(f64) -> f64 + Send + Sync) -> Verdict {
        let measured = judge(check, h, |scene, index, _, t| exact(scene, index, restitution(scene.material.restitution), t));
        measured.iter().map(Measurement::verdict).max().expect("measurements")
    }

    #[test]
    fn the_closed_forms_pass_and_another_restitution_fails_at_every_step() {
        for h in QUICK {
            for check in CHECKS {
                assert_eq!(verdict(check.name, h, |e| e), Verdict::Pass, "{} at {h}", check.name);
            }
            for check in ["impact/two-spheres", "impact/plastic"] {
                assert_eq!(verdict(check, h, |e| e + 1e-3), Verdict::Fail, "{check} at {h}");
            }
        }
    }
}
