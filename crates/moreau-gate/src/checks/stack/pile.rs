//! The boxes of a stack as they start.
//!
//! Rigid contacts on declared springs settle within their own time, which may be longer than any wait here. Their boxes start where
//! the declared law carries the load, so that nothing has to settle.
//!
//! All fall together, and an engine that acts on a contact one step after it closes stops one level per step: the k-th falls for k more
//! steps and is found k g h² deep, 27 mm for ten boxes at 1/60 s. A corner that deep and 2 mm beside the side of the box below would be
//! pushed out sideways by every rule of the least distance. So would one that the declared law lets in so far. The boxes are therefore
//! narrower by as much as a sound engine may find them late or lets them sink.

use crate::checks::scenery::{GRAVITY, cuboid, over_floor};
use crate::model::compression::LoadedPoint;
use crate::model::solid::box_moments;
use crate::model::{Model, sink};
use crate::tolerance::stack as tolerance;
use crate::{Bench, Kind};
use moreau_dynamics::scenes::Scene;
use moreau_forms::soft_rigid_contact::inverse_mass_at;
use nalgebra::{Matrix3, Vector3};

/// Half the height of every box \[m\].
pub(super) const HALF: f64 = 0.05;

/// Half the width of the lowest box \[m\] at small steps.
pub(super) const WIDTH: f64 = 0.1;

/// By how much of the lowest width each level is narrower.
pub(super) const NARROWER: f64 = 0.02;

/// δ, between neighbours at the start \[m\].
pub(super) const GAP: f64 = 0.0005;

/// Half the width of a level \[m\] with this ledge \[m\]: each is a little narrower than the one below, so that its corners are the
/// contacts.
pub(super) fn width(k: usize, levels: usize, ledge: f64) -> f64 {
    WIDTH * (1.0 - NARROWER * k as f64) + ledge * (levels - 1 - k) as f64
}

/// Boxes of these masses \[kg\], from below, with these gaps to what is below \[m\], each narrower by `ledge` \[m\] more than at small
/// steps.
fn stack(masses: &[f64], gaps: &[f64], ledge: f64) -> Scene {
    let height = |k: usize| (2 * k + 1) as f64 * HALF + gaps[..=k].iter().sum::<f64>();
    let width = |k: usize| width(k, masses.len(), ledge);
    let level = |(k, mass): (usize, &f64)| cuboid(&format!("box{}", k + 1), *mass, [width(k), width(k), HALF], [0.0, 0.0, height(k)]);
    over_floor("stack", masses.iter().enumerate().map(level).collect(), 0.5)
}

/// A corner of a level, which carries a quarter of the weight above it.
pub(super) fn corner(masses: &[f64], k: usize, ledge: f64) -> LoadedPoint {
    let width = |k: usize| width(k, masses.len(), ledge);
    let arm = Vector3::new(width(k), width(k), HALF);
    let inverse_mass = |body: usize| {
        let mass = masses[body];
        let moments = box_moments(mass, Vector3::new(width(body), width(body), HALF));
        inverse_mass_at(mass, &Matrix3::from_diagonal(&moments.map(|moment| 1.0 / moment)), &arm, &Vector3::z())
    };
    let below = if k > 0 { inverse_mass(k - 1) } else { 0.0 };
    LoadedPoint { load: 0.25 * GRAVITY * masses[k..].iter().sum::<f64>(), inverse_mass: inverse_mass(k) + below, on_ground: k == 0 }
}

/// The depths at which declared springs carry the load, level by level, of boxes with this ledge \[m\]; `None` without springs.
pub(super) fn sprung_depths(bench: &Bench, masses: &[f64], ledge: f64) -> Option<Vec<f64>> {
    let model = Model::of(bench.description());
    (0..masses.len()).map(|k| model.sprung_depth(&corner(masses, k, ledge))).collect()
}

/// What the boxes start with.
pub(super) enum Start {
    /// Gaps of δ.
    Apart,
    /// The declared depths \[m\].
    Sprung(Vec<f64>),
    /// Gaps of δ, for declared springs that would let a box sink by half its height or more. Other faces touch then, and no law gives the
    /// depth.
    Swallowed,
}

/// The boxes as they start, each narrower by `ledge` \[m\] more than [`width`] says. A corner that is found late or that the declared law
/// lets in is still nearer to the top of the box below than to its side.
pub(super) struct Pile<'a> {
    pub masses: &'a [f64],
    pub start: Start,
    pub ledge: f64,
}

impl<'a> Pile<'a> {
    /// At the step h \[s\].
    pub fn of(bench: &Bench, masses: &'a [f64], h: f64) -> Self {
        let room = |depth: f64| (depth - NARROWER * WIDTH).max(0.0);
        let deepest = |depths: &[f64]| depths.iter().copied().fold(0.0, f64::max);
        let Some(depths) = sprung_depths(bench, masses, 0.0) else {
            let found = tolerance::found_depth(GRAVITY, GAP, masses.len(), h);
            return Pile { masses, start: Start::Apart, ledge: room(found + let_in(bench, masses, h)) };
        };
        let ledge = room(tolerance::WIDER * deepest(&depths));
        match sprung_depths(bench, masses, ledge) {
            Some(depths) if deepest(&depths) < HALF => Pile { masses, start: Start::Sprung(depths), ledge },
            _ => Pile { masses, start: Start::Swallowed, ledge: 0.0 },
        }
    }

    /// Whether a compliant law carries a corner's load, a quarter of its level's, half a box deep: its bound is twice the depth at rest.
    pub fn is_swallowed_by_springs(&self, bench: &Bench, h: f64) -> bool {
        let compliant = bench.description().contact_model.kind == Kind::Compliant;
        compliant && sunk(&Model::of(bench.description()), self.masses, h) >= 2.0 * HALF
    }

    pub fn scene(&self) -> Scene {
        stack(self.masses, &self.start.gaps(self.masses.len()), self.ledge)
    }
}

/// How deep \[m\] the declared law lets the corners of a box into the one below, on springs after a fall through all gaps; at most half a
/// box, as deeper in other faces touch.
fn let_in(bench: &Bench, masses: &[f64], h: f64) -> f64 {
    let compliant = bench.description().contact_model.kind == Kind::Compliant;
    let fall = if compliant { masses.len() as f64 * GAP } else { 0.0 };
    let sunk = sunk(&Model::of(bench.description()), masses, h);
    if sunk > 0.0 { (sunk + fall).min(HALF) } else { 0.0 }
}

/// The deepest that the declared law lets a corner sink that is set down on a box \[m\]; 0 for a law that lets none.
fn sunk(model: &Model, masses: &[f64], h: f64) -> f64 {
    let corners = levels(masses).into_iter().map(|level| LoadedPoint { load: 0.25 * level.load, ..level });
    corners.skip(1).filter_map(|corner| sink::sink(model, &[corner], h)).fold(0.0, f64::max)
}

/// The weight that each level carries as if at one point between its bodies.
pub(super) fn levels(masses: &[f64]) -> Vec<LoadedPoint> {
    let level = |k: usize| LoadedPoint {
        load: masses[k..].iter().sum::<f64>() * GRAVITY,
        inverse_mass: 1.0 / masses[k] + if k > 0 { 1.0 / masses[k - 1] } else { 0.0 },
        on_ground: k == 0,
    };
    (0..masses.len()).map(level).collect()
}

impl Start {
    pub fn gaps(&self, levels: usize) -> Vec<f64> {
        match self {
            Start::Sprung(depths) => depths.iter().map(|depth| -depth).collect(),
            Start::Apart | Start::Swallowed => vec![GAP; levels],
        }
    }
}
