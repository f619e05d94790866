//! What a stack may move by while it stands: what a solver leaves, what its landing left, what is declared.

use crate::checks::scenery::{GRAVITY, angle_between, worst};
use crate::checks::stack::pile::{GAP, HALF, Pile, Start, WIDTH, levels, width};
use crate::model::{Model, sink};
use crate::tolerance::metamorphic::vanishes;
use crate::tolerance::{SOLVED, stack as tolerance};
use crate::{Bench, Expectation, Kind, Measurement};
use moreau_dynamics::trajectory::{BodyTrack, ContactRecord, Trajectory};

/// Steps between samples.
pub(super) const EVERY: usize = 10;

/// Samples until the stack has landed: 0.1 s, at least 60 steps, in which overlaps are corrected.
pub(super) fn landed(h: f64) -> usize {
    ((0.1 / h).ceil() as usize).max(60).div_ceil(EVERY)
}

/// What is expected of a stack.
pub(super) struct Rest {
    /// The sample from which it stands.
    landed: usize,
    /// Velocity left per step \[m/s\].
    velocity: f64,
    /// Its sum over the standing \[m\].
    drift: f64,
    /// Depth of all landings, and of the deepest one \[m\].
    landings: [f64; 2],
    /// Declared sinking of all levels; on springs also the height to which the energy of all falls may lift the uppermost box \[m\].
    sink: Option<f64>,
    /// The deepest overlap of neighbours \[m\] that declared springs hold from the start.
    held: Option<f64>,
    /// Speed that the declared law leaves a heavy box, and any box \[m/s\].
    speeds: Option<[f64; 2]>,
    /// Angle \[rad\], shift and fall \[m\] by which boxes may tip whose depths are taken back by declaration.
    tipped: Option<[f64; 3]>,
    /// Relative accuracy of impulses.
    solved: f64,
    duration: f64,
}

impl Rest {
    pub fn new(bench: &Bench, h: f64, pile: &Pile, steps: usize) -> Self {
        let masses = pile.masses;
        let total: f64 = masses.iter().sum();
        let lightest = masses.iter().copied().fold(f64::INFINITY, f64::min);
        let velocity = tolerance::unsolved_velocity(GRAVITY, h, total / lightest);
        let fallen: f64 = (0..masses.len()).map(|k| masses[k] * (k + 1) as f64 * GAP).sum();
        let uppermost = masses.last().copied().unwrap_or(lightest);
        let compliant = bench.description().contact_model.kind == Kind::Compliant;
        let landings = landings(pile, h);
        let model = Model::of(bench.description());
        let declared = if matches!(pile.start, Start::Apart) { sink::sink(&model, &levels(masses), h) } else { None };
        let with_falls = |mass: f64| declared.map(|sink| sink + if compliant { fallen / mass } else { 0.0 });
        let speeds = [uppermost, lightest].map(|mass| tolerance::sinking_speed(GRAVITY, with_falls(mass).unwrap_or(0.0)));
        let through = landed(h) * EVERY + steps;
        let pushed = rise(&model, landings[0], (masses.len(), through), h);
        Rest {
            landed: landed(h),
            velocity,
            drift: tolerance::drift(velocity, steps, h),
            landings,
            sink: with_falls(uppermost),
            held: if let Start::Sprung(depths) = &pile.start { depths.iter().copied().reduce(worst) } else { None },
            speeds: (declared.is_some() || pushed > 0.0).then(|| speeds.map(|speed| speed + pushed)),
            tipped: opens(&model, through).then(|| tipped(pile, h)),
            solved: SOLVED,
            duration: steps as f64 * h,
        }
    }

    pub fn measured(&self, trajectory: &Trajectory) -> Vec<Measurement> {
        let from = self.landed;
        let over = |value: &dyn Fn(&BodyTrack, usize) -> f64| {
            let samples = |track| (from..trajectory.times.len()).map(move |k| value(track, k)).fold(0.0, worst);
            trajectory.bodies.iter().map(samples).fold(0.0, worst)
        };
        let sideways =
            over(&|track, k| (track.position[k][0] - track.position[from][0]).hypot(track.position[k][1] - track.position[from][1]));
        let rise = |track: &BodyTrack, k: usize| track.position[k][2] - track.position[from][2];
        let [upwards, downwards] = [over(&|track, k| rise(track, k).max(0.0)), over(&|track, k| (-rise(track, k)).max(0.0))];
        let tilt = over(&|track, k| angle_between(track.orientation[from], track.orientation[k]));
        let still = |allowed: f64| Expectation::equal(0.0, allowed, "nothing moves");
        let law = |allowed: f64| self.sink.map(|sink| Expectation::at_most(sink, allowed, "the declared contacts sink under their load"));
        let speed = |[_, any]: [f64; 2]| Expectation::at_most(any, self.velocity, "the declared contacts sink or are pushed out");
        let opened = |part: usize, allowed: f64| {
            self.tipped.map(|tipped| Expectation::at_most(tipped[part], allowed, "corners whose depth is taken back open and fall"))
        };
        let lowered = (self.sink.is_some() || self.tipped.is_some()).then(|| {
            let [sink, fall] = [self.sink.unwrap_or(0.0), self.tipped.map_or(0.0, |[.., fall]| fall)];
            Expectation::at_most(sink + fall, self.drift, "the declared contacts sink, and corners whose depth is taken back fall")
        });
        let [depth, deepest] = self.landings.map(|landing| self.drift + landing);
        let held = self.held.map(|held| Expectation::equal(held, deepest, "the declared springs carry the load"));
        vec![
            Measurement::new("largest horizontal displacement while standing", "m", sideways, still(self.drift))
                .predicted(opened(1, self.drift)),
            Measurement::new("largest rise while standing", "m", upwards, still(depth)).predicted(law(depth)),
            Measurement::new("largest sinking while standing", "m", downwards, still(self.drift)).predicted(lowered),
            Measurement::new("largest turn while standing", "rad", tilt, still(self.drift / (0.5 * WIDTH)))
                .predicted(opened(0, self.drift / (0.5 * WIDTH))),
            Measurement::new("deepest overlap of neighbours", "m", overlap(trajectory), still(deepest))
                .predicted(held.or_else(|| law(deepest))),
            Measurement::new("RMS speed while standing", "m/s", trembling(trajectory, from), still(self.velocity))
                .predicted(self.speeds.map(speed)),
        ]
    }

    /// The impulse of the ground while the stack stands, over its weight.
    pub fn carried(&self, trajectory: &Trajectory, mass: f64) -> Measurement {
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

/// Depths \[m\] of all landings together, and of the deepest one. What stands on springs from the start falls for a step at most.
pub(super) fn landings(pile: &Pile, h: f64) -> [f64; 2] {
    let one = |k: usize| match pile.start {
        Start::Sprung(_) => tolerance::landing(GRAVITY, 0.0, 1, h),
        Start::Apart | Start::Swallowed => tolerance::landing(GRAVITY, (k + 1) as f64 * GAP, k + 1, h),
    };
    (0..pile.masses.len()).map(one).fold([0.0, 0.0], |[sum, most], depth| [sum + depth, worst(most, depth)])
}

/// Speed \[m/s\] that a declared error reduction may leave the uppermost box of a pile that has landed: it takes back what is left of the
/// landings' depths \[m\], and of those of corners that open within so many steps. A declared cap of an impact need not hold in a pile, but
/// it lets depths stay.
pub(super) fn rise(model: &Model, landing: f64, (levels, steps): (usize, usize), h: f64) -> f64 {
    let Model::Coulomb(limits) = model else { return 0.0 };
    let reduction = limits.error_reduction;
    let left = if limits.correction_speed > 0.0 { 1.0 } else { tolerance::left(reduction, landed(h) * EVERY) };
    let opening = if opens(model, steps) { levels as f64 * tolerance::tipping_speed(reduction, GRAVITY, h) } else { 0.0 };
    reduction * landing * left / h + opening
}

/// Whether each depth is taken back to nothing within so many steps, by velocities or in the positions alone, so that corners open.
fn opens(model: &Model, steps: usize) -> bool {
    match model {
        Model::Coulomb(limits) => limits.penetration_allowance == 0.0 && vanishes(limits.taken_back(), steps as f64),
        _ => false,
    }
}

/// Angle \[rad\], shift and fall \[m\] of the uppermost box from one sample to another, of which each may have all levels tipped to one
/// side: every level turns, shifts and lowers what stands on it.
pub(super) fn tipped(pile: &Pile, h: f64) -> [f64; 3] {
    let levels = pile.masses.len();
    (0..levels).fold([0.0; 3], |[angle, shift, fall], k| {
        let width = 2.0 * width(k, levels, pile.ledge);
        let tip = tolerance::tip(width, GRAVITY, h);
        [angle + 2.0 * tip, shift + 2.0 * tip * 2.0 * HALF * (levels - k) as f64, fall + tip * width]
    })
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
