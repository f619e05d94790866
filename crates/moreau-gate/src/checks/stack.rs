//! Boxes that are set down on each other and must stand.
//!
//! ```text
//!     gaps of δ between neighbours: level k lands with at most √(2 g k δ);   then the load Σ m g of each level is carried, nothing moves
//! ```
//! What an engine adds is its own: a solver that stops early lets the stack sink, lean and tremble; a declared rest depth lets it sink by
//! a known amount. No contact begins touching: a gap of 0 is open or closed by rounding. The standing lasts a fixed number of steps, so
//! that errors per step show at every h.
//!
//! Rigid contacts on declared springs settle within their own time, which may be longer than any wait here. Their boxes start where
//! the declared law carries the load, so that nothing has to settle.
//!
//! All fall together, and an engine that acts on a contact one step after it closes stops one level per step: the k-th falls for k more
//! steps and is found k g h² deep, 27 mm for ten boxes at 1/60 s. A corner that deep and 2 mm beside the side of the box below would be
//! pushed out sideways by every rule of the least distance; so the boxes are narrower by as much as a sound engine may find them late.

use crate::check::{Control, Run};
use crate::checks::motion::does_not_hop;
use crate::checks::scenery::{GRAVITY, angle_between, cuboid, over_floor, worst};
use crate::model::compression::LoadedPoint;
use crate::model::solid::box_moments;
use crate::model::{Model, sink};
use crate::tolerance::{SOLVED, stack as tolerance};
use crate::{Bench, Check, Expectation, Kind, Level, Measurement, Reply};
use moreau_dynamics::scenes::Scene;
use moreau_dynamics::trajectory::{BodyTrack, ContactRecord, Trajectory};
use moreau_forms::soft_rigid_contact::inverse_mass_at;
use nalgebra::{Matrix3, Vector3};

/// Half the height of every box \[m\].
const HALF: f64 = 0.05;

/// Half the width of the lowest box \[m\] at small steps.
const WIDTH: f64 = 0.1;

/// By how much of the lowest width each level is narrower.
const NARROWER: f64 = 0.02;

/// δ, between neighbours at the start \[m\].
const GAP: f64 = 0.0005;

/// Steps between samples.
const EVERY: usize = 10;

const RESTING: &str = "After landing nothing moves. A solver that leaves a part s of its impulses leaves velocities of s Σm g h/m_min, \
    which add up over the steps. A landing at v is found up to a step late, and the next step acts on it, so that each level is 3/2 h (v \
    + g h) deep. The engine may correct this depth later. A compliant or slack contact sinks by at most twice its declared rest depth \
    under the whole load, level by level, at up to √(2 g · sink). Springs may give the energy of the falls to one box, which lifts all \
    boxes above it. If an engine declares that a step takes back a part of each depth, the levels rise by that part of the landings' \
    depths; and the pile sways, and its boxes tip, when a corner has no depth left, opens and falls for a step. A part of more than a \
    third lets \
    corners fly for longer, and boxes hop: that is not asked. \
    Boxes on declared springs of a frequency start at the depth of each level, N/(m_p (2πf)²) at its corners, and stay there.";

/// The checks of the family.
pub const CHECKS: &[Check] = &[
    Check {
        name: "stack/five",
        level: Level::Simulate,
        question: "Do five boxes of 1 kg, set down on each other, stay where they are?",
        derivation: RESTING,
        source: "chapter §9 (stacks); the solution r ≥ 0 with u = 0 exists, as r_k = Σ m g h above",
        run: Run::EachStep(|bench, h| standing(bench, h, &[1.0; 5], 200)),
        control: Control { passes: "moreau-jean", fails: "solver/three-sweeps" },
    },
    Check {
        name: "stack/ten",
        level: Level::Simulate,
        question: "Do ten boxes of 1 kg, set down on each other, stay where they are?",
        derivation: RESTING,
        source: "as for five; a sweep over contacts carries the load one level further, so early stops show more",
        run: Run::EachStep(|bench, h| standing(bench, h, &[1.0; 10], 100)),
        control: Control { passes: "moreau-jean", fails: "solver/three-sweeps" },
    },
    Check {
        name: "stack/mass-ratio",
        level: Level::Simulate,
        question: "Does a box of 1 kg carry one of 1000 kg, and the ground both?",
        derivation: RESTING,
        source: "Gauss–Seidel contracts by 1/(1 + m/M) per sweep here; the ground's impulse is Σ m g t, from momentum",
        run: Run::EachStep(mass_ratio),
        control: Control { passes: "moreau-jean", fails: "stack/mass-ratio-clamped" },
    },
];

/// Half the width of a level \[m\] where nothing falls: each is a little narrower than the one below, so that its corners are the contacts.
fn width(k: usize) -> f64 {
    WIDTH * (1.0 - NARROWER * k as f64)
}

/// Boxes of these masses \[kg\], from below, with these gaps to what is below \[m\], each narrower by `ledge` \[m\] more than [`width`]
/// says.
fn stack(masses: &[f64], gaps: &[f64], ledge: f64) -> Scene {
    let height = |k: usize| (2 * k + 1) as f64 * HALF + gaps[..=k].iter().sum::<f64>();
    let width = |k: usize| width(k) + ledge * (masses.len() - 1 - k) as f64;
    let level = |(k, mass): (usize, &f64)| cuboid(&format!("box{}", k + 1), *mass, [width(k), width(k), HALF], [0.0, 0.0, height(k)]);
    over_floor("stack", masses.iter().enumerate().map(level).collect(), 0.5)
}

/// A corner of a level, which carries a quarter of the weight above it.
fn corner(masses: &[f64], k: usize) -> LoadedPoint {
    let arm = Vector3::new(width(k), width(k), HALF);
    let inverse_mass = |body: usize| {
        let mass = masses[body];
        let moments = box_moments(mass, Vector3::new(width(body), width(body), HALF));
        inverse_mass_at(mass, &Matrix3::from_diagonal(&moments.map(|moment| 1.0 / moment)), &arm, &Vector3::z())
    };
    let below = if k > 0 { inverse_mass(k - 1) } else { 0.0 };
    LoadedPoint { load: 0.25 * GRAVITY * masses[k..].iter().sum::<f64>(), inverse_mass: inverse_mass(k) + below, on_ground: k == 0 }
}

/// The depths at which declared springs carry the load, level by level; `None` without springs.
fn sprung_depths(bench: &Bench, masses: &[f64]) -> Option<Vec<f64>> {
    let model = Model::of(bench.description());
    (0..masses.len()).map(|k| model.sprung_depth(&corner(masses, k))).collect()
}

/// What the boxes start with.
enum Start {
    /// Gaps of δ.
    Apart,
    /// The declared depths \[m\].
    Sprung(Vec<f64>),
    /// Gaps of δ, for declared springs that would let a box sink by half its height or more. Other faces touch then, and no law gives the
    /// depth.
    Swallowed,
}

impl Start {
    fn of(bench: &Bench, masses: &[f64]) -> Self {
        match sprung_depths(bench, masses) {
            None => Start::Apart,
            Some(depths) if depths.iter().all(|depth| *depth < HALF) => Start::Sprung(depths),
            Some(_) => Start::Swallowed,
        }
    }

    /// The boxes as they start. Where they fall apart, a corner which is found late, at the step h \[s\], is still nearer to the top of the
    /// box below than to its side.
    fn scene(&self, masses: &[f64], h: f64) -> Scene {
        let ledge = match self {
            Start::Apart => (tolerance::found_depth(GRAVITY, GAP, masses.len(), h) - NARROWER * WIDTH).max(0.0),
            Start::Sprung(_) | Start::Swallowed => 0.0,
        };
        stack(masses, &self.gaps(masses.len()), ledge)
    }

    fn gaps(&self, levels: usize) -> Vec<f64> {
        match self {
            Start::Sprung(depths) => depths.iter().map(|depth| -depth).collect(),
            Start::Apart | Start::Swallowed => vec![GAP; levels],
        }
    }
}

/// Samples until the stack has landed: 0.1 s, at least 60 steps, in which overlaps are corrected.
fn landed(h: f64) -> usize {
    ((0.1 / h).ceil() as usize).max(60).div_ceil(EVERY)
}

fn standing(bench: &mut Bench, h: f64, masses: &[f64], steps: usize) -> Reply<Vec<Measurement>> {
    does_not_hop(bench)?;
    let start = Start::of(bench, masses);
    let scene = start.scene(masses, h);
    let trajectory = bench.simulate(&scene, h, landed(h) * EVERY + steps, EVERY)?;
    Ok(Rest::new(bench, h, masses, steps, &start).measured(&trajectory))
}

fn mass_ratio(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    does_not_hop(bench)?;
    let (masses, steps) = ([1.0, 1000.0], 50);
    let start = Start::of(bench, &masses);
    let scene = start.scene(&masses, h);
    let trajectory = bench.simulate(&scene, h, landed(h) * EVERY + steps, EVERY)?;
    let rest = Rest::new(bench, h, &masses, steps, &start);
    let mut measurements = rest.measured(&trajectory);
    if bench.description().reports_contacts {
        measurements.push(rest.carried(&trajectory, masses.iter().sum()));
    }
    Ok(measurements)
}

/// What is expected of a stack.
struct Rest {
    /// The sample from which it stands.
    landed: usize,
    /// Velocity left per step \[m/s\].
    velocity: f64,
    /// Its sum over the standing \[m\].
    drift: f64,
    /// Depth of all landings \[m\].
    landing: f64,
    /// Declared sinking of all levels; on springs also the height to which the energy of all falls may lift the uppermost box \[m\].
    sink: Option<f64>,
    /// The deepest overlap of neighbours \[m\] that declared springs hold from the start.
    held: Option<f64>,
    /// Speed that the declared law leaves a heavy box, and any box \[m/s\].
    speeds: Option<[f64; 2]>,
    /// Angle \[rad\] by which a declared error reduction may tip the boxes.
    tipped: Option<f64>,
    /// Height of the pile \[m\].
    height: f64,
    /// Relative accuracy of impulses.
    solved: f64,
    duration: f64,
}

impl Rest {
    fn new(bench: &Bench, h: f64, masses: &[f64], steps: usize, start: &Start) -> Self {
        let total: f64 = masses.iter().sum();
        let lightest = masses.iter().copied().fold(f64::INFINITY, f64::min);
        let velocity = tolerance::unsolved_velocity(GRAVITY, h, total / lightest);
        let level = |k: usize| LoadedPoint {
            load: masses[k..].iter().sum::<f64>() * GRAVITY,
            inverse_mass: 1.0 / masses[k] + if k > 0 { 1.0 / masses[k - 1] } else { 0.0 },
            on_ground: k == 0,
        };
        let levels: Vec<LoadedPoint> = (0..masses.len()).map(level).collect();
        let fallen: f64 = (0..masses.len()).map(|k| masses[k] * (k + 1) as f64 * GAP).sum();
        let uppermost = masses.last().copied().unwrap_or(lightest);
        let compliant = bench.description().contact_model.kind == Kind::Compliant;
        let fall = |k: usize| if matches!(start, Start::Sprung(_)) { 0.0 } else { (k + 1) as f64 * GAP };
        let landing: f64 = (0..masses.len()).map(|k| tolerance::landing(GRAVITY, fall(k), h)).sum();
        let model = Model::of(bench.description());
        let declared = if matches!(start, Start::Apart) { sink::sink(&model, &levels, h) } else { None };
        let with_falls = |mass: f64| declared.map(|sink| sink + if compliant { fallen / mass } else { 0.0 });
        let speeds = [uppermost, lightest].map(|mass| tolerance::sinking_speed(GRAVITY, with_falls(mass).unwrap_or(0.0)));
        let pushed = rise(&model, landing, h);
        Rest {
            landed: landed(h),
            velocity,
            drift: tolerance::drift(velocity, steps, h),
            landing,
            sink: with_falls(uppermost),
            held: if let Start::Sprung(depths) = start { depths.iter().copied().reduce(worst) } else { None },
            speeds: (declared.is_some() || pushed > 0.0).then(|| speeds.map(|speed| speed + pushed)),
            tipped: tipped(&model, masses.len(), h, steps),
            height: 2.0 * HALF * masses.len() as f64,
            solved: SOLVED,
            duration: steps as f64 * h,
        }
    }

    fn measured(&self, trajectory: &Trajectory) -> Vec<Measurement> {
        let from = self.landed;
        let over = |value: &dyn Fn(&BodyTrack, usize) -> f64| {
            let samples = |track| (from..trajectory.times.len()).map(move |k| value(track, k)).fold(0.0, worst);
            trajectory.bodies.iter().map(samples).fold(0.0, worst)
        };
        let sideways =
            over(&|track, k| (track.position[k][0] - track.position[from][0]).hypot(track.position[k][1] - track.position[from][1]));
        let upwards = over(&|track, k| (track.position[k][2] - track.position[from][2]).abs());
        let tilt = over(&|track, k| angle_between(track.orientation[from], track.orientation[k]));
        let still = |allowed: f64| Expectation::equal(0.0, allowed, "nothing moves");
        let law = |allowed: f64| self.sink.map(|sink| Expectation::at_most(sink, allowed, "the declared contacts sink under their load"));
        let speed = |[_, any]: [f64; 2]| Expectation::at_most(any, self.velocity, "the declared contacts sink or are pushed out");
        let opened = |lever: f64, allowed: f64| {
            self.tipped.map(|angle| Expectation::at_most(lever * angle, allowed, "corners whose depth is taken back open and fall"))
        };
        let depth = self.drift + self.landing;
        let held = self.held.map(|held| Expectation::equal(held, depth, "the declared springs carry the load"));
        vec![
            Measurement::new("largest horizontal displacement while standing", "m", sideways, still(self.drift))
                .predicted(opened(self.height, self.drift)),
            Measurement::new("largest vertical displacement while standing", "m", upwards, still(depth)).predicted(law(depth)),
            Measurement::new("largest turn while standing", "rad", tilt, still(self.drift / (0.5 * WIDTH)))
                .predicted(opened(1.0, self.drift / (0.5 * WIDTH))),
            Measurement::new("deepest overlap of neighbours", "m", overlap(trajectory), still(depth))
                .predicted(held.or_else(|| law(depth))),
            Measurement::new("RMS speed while standing", "m/s", trembling(trajectory, from), still(self.velocity))
                .predicted(self.speeds.map(speed)),
        ]
    }

    /// The impulse of the ground while the stack stands, over its weight.
    fn carried(&self, trajectory: &Trajectory, mass: f64) -> Measurement {
        let of_ground = |contact: &&ContactRecord| contact.sample > self.landed && contact.bodies.iter().any(|name| name == "ground");
        let upwards = |contact: &ContactRecord| if contact.bodies[1] == "ground" { contact.impulse[2] } else { -contact.impulse[2] };
        let impulse: f64 = trajectory.contacts.iter().filter(of_ground).map(upwards).sum();
        let ideal = Expectation::equal(1.0, self.solved, "momentum: Σ m g t");
        let model = self.speeds.map(|[heavy, _]| {
            // The momentum may change by the load times twice the speed of sinking.
            let swing = 2.0 * heavy / (GRAVITY * self.duration);
            Expectation::equal(1.0, swing + self.solved, "momentum, with the declared contacts still swinging")
        });
        let weight = mass * GRAVITY * self.duration;
        Measurement::new("impulse of the ground over the weight while standing", "1", impulse / weight, ideal).predicted(model)
    }
}

/// Speed \[m/s\] at which the uppermost box rises while the depths of all landings \[m\] are taken back; the declared cap of an impact need
/// not hold in a pile.
fn rise(model: &Model, landing: f64, h: f64) -> f64 {
    match model {
        Model::Coulomb(limits) => limits.error_reduction * landing / h,
        _ => 0.0,
    }
}

/// Angle \[rad\] by which boxes may tip where each depth is taken back to nothing: see [`tolerance::sway`].
fn tipped(model: &Model, levels: usize, h: f64, steps: usize) -> Option<f64> {
    match model {
        Model::Coulomb(limits) if limits.error_reduction > 0.0 && limits.penetration_allowance == 0.0 => {
            Some(tolerance::sway(limits.error_reduction, 1.0, 2.0 * width(levels - 1), GRAVITY, h, steps))
        }
        _ => None,
    }
}

/// Largest overlap \[m\] of boxes that are neighbours, and of the lowest with the ground, from the heights of their centres.
fn overlap(trajectory: &Trajectory) -> f64 {
    let depth = |k: usize| {
        let mut below = -HALF;
        trajectory.bodies.iter().fold(0.0, |deepest, track| {
            let depth = below + 2.0 * HALF - track.position[k][2];
            below = track.position[k][2];
            worst(deepest, depth)
        })
    };
    (0..trajectory.times.len()).map(depth).fold(0.0, worst)
}

/// Root mean square of the speeds of all bodies from a sample on \[m/s\].
fn trembling(trajectory: &Trajectory, from: usize) -> f64 {
    let speeds = trajectory.bodies.iter().flat_map(|track| &track.linear_velocity[from..]);
    let squares: Vec<f64> = speeds.map(|v| v.iter().map(|x| x * x).sum::<f64>()).collect();
    (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::runner::SWEEP;
    use moreau_exact::tolerance::rounding;

    #[test]
    fn a_corner_of_the_lowest_box_feels_its_turn_and_of_the_next_both_boxes() {
        // A box of half extents a, a, c: 1/m + 2 a²/J with J = m (a² + c²)/3.
        let alone = |mass: f64, arm: f64, width: f64| (1.0 + 6.0 * arm * arm / (width * width + HALF * HALF)) / mass;
        let masses = [2.0, 3.0];
        let [lowest, next] = [0, 1].map(|k| corner(&masses, k));
        assert!((lowest.inverse_mass - alone(2.0, WIDTH, WIDTH)).abs() <= rounding(16, lowest.inverse_mass));
        let both = alone(3.0, width(1), width(1)) + alone(2.0, width(1), WIDTH);
        assert!((next.inverse_mass - both).abs() <= rounding(16, both));
        assert!((lowest.load - 1.25 * GRAVITY).abs() <= rounding(8, GRAVITY) && lowest.on_ground && !next.on_ground);
    }

    #[test]
    fn a_pile_is_not_asked_of_an_engine_whose_declared_correction_lets_boxes_hop() {
        use crate::{Engine, Refusal};
        let mut engine = crate::own::by_name("moreau-jean").expect("listed");
        let options = crate::Options::new();
        let described = engine.describe(&options).expect("describes itself");
        let mut refused = |parameters: &[(&str, f64)]| {
            let mut description = described.clone();
            for (name, value) in parameters {
                let (value, unit) = (crate::description::OneOrMany::One(*value), crate::description::OneOrMany::One("1".into()));
                description.contact_model.parameters.insert((*name).into(), crate::Parameter { value, unit });
            }
            let reply = standing(&mut Bench::new(&mut engine, &description, &options), 0.01, &[1.0; 2], 20);
            matches!(reply, Err(Refusal::Unsupported(reason)) if reason.contains("error_reduction"))
        };
        assert!(refused(&[("error_reduction", 0.4)]));
        assert!(!refused(&[("error_reduction", 0.3)]) && !refused(&[]));
        assert!(!refused(&[("error_reduction", 0.4), ("penetration_allowance", 0.001)]));
    }

    #[test]
    fn springs_too_soft_for_the_boxes_say_no_place() {
        assert_eq!(Start::Swallowed.gaps(2), Start::Apart.gaps(2));
        assert_eq!(Start::Sprung(vec![0.01, 0.02]).gaps(2), [-0.01, -0.02]);
    }

    #[test]
    fn a_corner_found_late_is_farther_from_the_side_of_the_box_below_than_from_its_top() {
        for (h, levels) in SWEEP.into_iter().flat_map(|h| [2, 5, 10].map(|levels| (h, levels))) {
            let scene = Start::Apart.scene(&vec![1.0; levels], h);
            let widths: Vec<f64> = scene.bodies.iter().filter_map(|body| body.cuboid).map(|cuboid| cuboid.half_extents[0]).collect();
            assert_eq!(widths.len(), levels);
            let ledge = tolerance::found_depth(GRAVITY, GAP, levels, h).max(NARROWER * WIDTH);
            for pair in widths.windows(2) {
                assert!((pair[0] - pair[1] - ledge).abs() <= rounding(16, 1.0), "{widths:?} at {h}");
            }
            assert_eq!(widths[levels - 1], width(levels - 1));
        }
    }
}
