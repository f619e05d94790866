//! Where the bodies of a mechanism touch, in the order of the candidates. The memory of a search is used again by the next one, and holds
//! nothing of the search before.

use super::SpatialBodies;
use super::features::{ground_touches, pair_touches};
use super::shape::Pose;
use super::touch::{Touch, Touches};
use nalgebra::{DVector, Vector3};
use std::cell::Cell;

/// What a search works on.
#[derive(Default)]
struct Scratch {
    poses: Vec<Pose>,
    centres: Vec<Vector3<f64>>,
    touches: Touches,
}

thread_local! {
    static FREE: Cell<Option<Box<Scratch>>> = const { Cell::new(None) };
}

/// Runs a search; one within another has memory of its own.
fn with<T>(search: impl FnOnce(&mut Scratch) -> T) -> T {
    let mut own = FREE.take().unwrap_or_default();
    own.poses.clear();
    own.centres.clear();
    own.touches.list.clear();
    let found = search(&mut own);
    FREE.set(Some(own));
    found
}

impl SpatialBodies {
    /// Shows where bodies touch with a gap of at most `reach`, in the order of the candidates.
    pub(super) fn touches(&self, position: &DVector<f64>, reach: f64, show: impl FnMut(&[Pose], usize, Option<usize>, &Touch)) {
        with(|scratch| {
            scratch.poses.extend(self.poses(position));
            scratch.centres.extend(scratch.poses.iter().map(|pose| pose.centre));
            self.touches_at(&scratch.poses, &scratch.centres, reach, &mut scratch.touches, show);
        });
    }

    fn touches_at(
        &self,
        poses: &[Pose],
        centres: &[Vector3<f64>],
        reach: f64,
        touches: &mut Touches,
        mut show: impl FnMut(&[Pose], usize, Option<usize>, &Touch),
    ) {
        let mut keep = |first: usize, second: Option<usize>, touches: &mut Vec<Touch>| {
            touches.iter().filter(|touch| touch.gap <= reach).for_each(|touch| show(poses, first, second, touch));
            touches.clear();
        };
        if let Some(ground) = &self.ground {
            let normal = Vector3::new(ground.normal[0], ground.normal[1], ground.normal[2]);
            let lowest = |body: usize| normal.dot(&poses[body].centre) - ground.offset - self.radii[body];
            for (first, body) in self.free().filter(|(body, _)| lowest(*body) <= reach) {
                ground_touches(body.shape(), &poses[first], ground, &mut touches.list);
                keep(first, None, &mut touches.list);
            }
        }
        let radius = |body: usize| self.radii[body];
        self.neighbours.near(centres, radius, reach, |first, second| {
            let distance = (centres[first] - centres[second]).norm();
            let moves = || self.bodies[first].is_free() || self.bodies[second].is_free();
            if distance - radius(first) - radius(second) <= reach && moves() {
                let (own, other) = (self.bodies[first].shape(), self.bodies[second].shape());
                pair_touches(own, &poses[first], other, &poses[second], touches);
                keep(first, Some(second), &mut touches.list);
            }
        });
    }
}
