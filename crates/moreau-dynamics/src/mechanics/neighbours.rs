//! Which bodies are near each other, found on a grid and kept from one step to the next.
//!
//! ```text
//!     listed at centres c°:   ‖c°_i − c°_j‖ − R_i − R_j ≤ C                       C = reach asked for + margin
//!     still whole at c:       ρ + 2 max_k ‖c_k − c°_k‖ ≤ C                        ρ the reach that is asked for now
//! ```
//! For a distance shrinks by what its two ends move: a pair that is not listed is then farther apart than ρ. While that holds no pair is
//! looked for again. The list only says which pairs are looked at, and in which order; whether one is near is decided at c by whoever asks,
//! so that no answer depends on what was kept.
//!
//! The grid has cells as wide as two bodies with C between them; bodies much larger than the others are compared with all.

use crate::tolerance::neighbours::{LARGE, MARGIN, MOST_CELLS};
use moreau_exact::tolerance::rounding;
use nalgebra::Vector3;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};
use std::sync::{Mutex, PoisonError};

/// An eighth more room than there were candidates.
const ROOM: usize = 8;

/// The pairs of bodies near each other, as they were found last.
#[derive(Debug, Default)]
pub(super) struct Neighbours {
    list: Mutex<List>,
    /// How many contact candidates there were last time.
    candidates: AtomicUsize,
}

#[derive(Debug, Default)]
struct List {
    /// c°.
    centres: Vec<Vector3<f64>>,
    /// C \[m\].
    covered: f64,
    /// i < j, growing.
    pairs: Vec<[u32; 2]>,
    /// Room for the bodies sorted by their cells.
    cells: Vec<([i64; 3], u32)>,
    /// How often pairs were looked for.
    #[cfg(test)]
    searches: usize,
}

impl Clone for Neighbours {
    /// Nothing is kept: what is listed says nothing of a mechanism.
    fn clone(&self) -> Self {
        Neighbours::default()
    }
}

impl Neighbours {
    /// For how many contact candidates to make room: as many as there were last time, and some.
    pub fn expected(&self) -> usize {
        let last = self.candidates.load(Relaxed);
        last + last / ROOM
    }

    /// Remembers how many candidates there were.
    pub fn expect(&self, candidates: usize) {
        self.candidates.store(candidates, Relaxed);
    }

    /// Shows every pair i < j with ‖c_i − c_j‖ − R_i − R_j ≤ ρ, and perhaps others, in growing order of (i, j); R are the radii of spheres
    /// about the centres c that hold the bodies.
    pub fn near(&self, centres: &[Vector3<f64>], radius: impl Fn(usize) -> f64, reach: f64, mut show: impl FnMut(usize, usize)) {
        let mut list = std::mem::take(&mut *self.list.lock().unwrap_or_else(PoisonError::into_inner));
        // whoever asks for all pairs gets them, and leaves what is kept for the others
        if reach < f64::INFINITY && (list.holds(centres, reach) || list.find(centres, &radius, reach)) {
            list.pairs.iter().for_each(|&[i, j]| show(i as usize, j as usize));
        } else {
            (0..centres.len()).for_each(|i| (i + 1..centres.len()).for_each(|j| show(i, j)));
        }
        *self.list.lock().unwrap_or_else(PoisonError::into_inner) = list;
    }
}

impl List {
    /// Whether no pair within `reach` is missing.
    fn holds(&self, centres: &[Vector3<f64>], reach: f64) -> bool {
        if self.centres.len() != centres.len() {
            return false;
        }
        let (mut moved, mut size) = (0.0f64, 0.0f64);
        for (now, then) in centres.iter().zip(&self.centres) {
            moved = moved.max((now - then).norm_squared());
            size = size.max(now.amax());
        }
        // three differences, their squares, a sum, a root
        reach + 2.0 * moved.sqrt() + rounding(16, size + self.covered) <= self.covered
    }

    /// Lists the pairs anew; false if the bodies have no place in a grid.
    fn find(&mut self, centres: &[Vector3<f64>], radius: &impl Fn(usize) -> f64, reach: f64) -> bool {
        self.centres.clear();
        self.pairs.clear();
        let mean = (0..centres.len()).map(radius).sum::<f64>() / centres.len().max(1) as f64;
        let covered = reach + MARGIN * mean;
        let width = 2.0 * LARGE * mean + covered;
        let farthest = centres.iter().map(|centre| centre.amax()).fold(0.0, f64::max) / width;
        // written so that what is not a number has no place either
        if !(farthest <= MOST_CELLS && centres.iter().all(|centre| centre.iter().all(|x| x.is_finite()))) {
            return false;
        }
        #[cfg(test)]
        {
            self.searches += 1;
        }
        let is_large = |k: usize| radius(k) > LARGE * mean;
        let within = |i: usize, j: usize| {
            let distance = (centres[i] - centres[j]).norm();
            distance - radius(i) - radius(j) <= covered + rounding(16, distance + centres[i].amax())
        };
        let cell = |k: usize| -> [i64; 3] { std::array::from_fn(|axis| (centres[k][axis] / width).floor() as i64) };
        self.cells.clear();
        self.cells.extend((0..centres.len()).filter(|k| !is_large(*k)).map(|k| (cell(k), k as u32)));
        self.cells.sort_unstable();
        let large: Vec<usize> = (0..centres.len()).filter(|k| is_large(*k)).collect();
        for &large in &large {
            let others = (0..centres.len()).filter(|other| *other != large && (!is_large(*other) || *other > large));
            self.pairs.extend(others.filter(|other| within(large, *other)).map(|other| pair(large, other)));
        }
        for place in 0..self.cells.len() {
            let ([x, y, z], body) = self.cells[place];
            // the columns of cells from (x, y − 1) to (x + 1, y + 1) that follow, each three cells high
            for [column, row] in [[0, 0], [0, 1], [1, -1], [1, 0], [1, 1]] {
                let low = ([x + column, y + row, z - 1], 0);
                let begins = if [column, row] == [0, 0] { place + 1 } else { self.cells.partition_point(|one| *one < low) };
                let here = self.cells[begins..].iter().take_while(|(cell, _)| cell[..2] == [x + column, y + row] && cell[2] <= z + 1);
                let near = here.filter(|(_, other)| within(body as usize, *other as usize));
                self.pairs.extend(near.map(|(_, other)| pair(body as usize, *other as usize)));
            }
        }
        self.pairs.sort_unstable();
        self.centres.extend_from_slice(centres);
        self.covered = covered;
        true
    }
}

/// Keeps the two largest values, the largest first: those of the two bodies that may close a gap fastest.
pub(super) fn largest(two: &mut [f64; 2], value: f64) {
    if value > two[0] {
        *two = [value, two[0]];
    } else if value > two[1] {
        two[1] = value;
    }
}

fn pair(i: usize, j: usize) -> [u32; 2] {
    [i.min(j) as u32, i.max(j) as u32]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers of no pattern in [0, 1).
    fn scattered(seed: u64) -> f64 {
        let mixed = (seed ^ (seed >> 31)).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        ((mixed ^ (mixed >> 29)).wrapping_mul(0xbf58_476d_1ce4_e5b9) >> 11) as f64 / (1u64 << 53) as f64
    }

    fn centres(count: u64, seed: u64, size: f64) -> Vec<Vector3<f64>> {
        let at = |k: u64, axis: u64| size * (scattered(seed + 3 * k + axis) - 0.5);
        (0..count).map(|k| Vector3::new(at(k, 0), at(k, 1), at(k, 2))).collect()
    }

    fn radius(k: usize) -> f64 {
        if k.is_multiple_of(37) { 1.3 } else { 0.05 + 0.1 * scattered(k as u64) }
    }

    fn all(centres: &[Vector3<f64>], reach: f64) -> Vec<[usize; 2]> {
        let pairs = (0..centres.len()).flat_map(|i| (i + 1..centres.len()).map(move |j| [i, j]));
        pairs.filter(|&[i, j]| (centres[i] - centres[j]).norm() - radius(i) - radius(j) <= reach).collect()
    }

    fn shown(kept: &Neighbours, centres: &[Vector3<f64>], reach: f64) -> Vec<[usize; 2]> {
        let mut found = Vec::new();
        kept.near(centres, radius, reach, |i, j| found.push([i, j]));
        assert!(found.is_sorted() && found.windows(2).all(|two| two[0] != two[1]), "in order, and each once");
        found.retain(|&[i, j]| (centres[i] - centres[j]).norm() - radius(i) - radius(j) <= reach);
        found
    }

    #[test]
    fn every_pair_within_reach_is_shown_wherever_the_bodies_are_and_have_been() {
        let kept = Neighbours::default();
        for (count, size) in [(1, 1.0), (2, 0.1), (200, 2.0), (200, 20.0), (300, 6.0)] {
            let mut centres = centres(count, 17 * count, size);
            for step in 0..40u64 {
                for (k, centre) in centres.iter_mut().enumerate() {
                    *centre += Vector3::repeat(0.01 * (scattered(step * 1000 + k as u64) - 0.3));
                }
                let reach = 0.02 * scattered(step);
                assert_eq!(shown(&kept, &centres, reach), all(&centres, reach), "{count} bodies, step {step}");
            }
        }
    }

    #[test]
    fn bodies_that_move_little_are_not_looked_for_again() {
        let (kept, mut centres) = (Neighbours::default(), centres(200, 5, 4.0));
        for _ in 0..20 {
            centres.iter_mut().for_each(|centre| centre.x += 1e-4);
            shown(&kept, &centres, 0.01);
        }
        assert_eq!(kept.list.lock().unwrap().searches, 1);
        centres[7].y += 1.0;
        assert_eq!(shown(&kept, &centres, 0.01), all(&centres, 0.01), "one that jumps is seen where it arrives");
        assert_eq!(kept.list.lock().unwrap().searches, 2);
        assert_eq!(shown(&kept, &centres, f64::INFINITY).len(), 200 * 199 / 2, "all");
        let pairs = |kept: &Neighbours| kept.list.lock().unwrap().pairs.len();
        assert!(
            shown(&kept, &centres, 0.01) == all(&centres, 0.01) && pairs(&kept) < 200 * 199 / 4,
            "{}: still those nearby",
            pairs(&kept)
        );
        assert_eq!(kept.list.lock().unwrap().searches, 2, "who asks for all changes nothing for the others");
    }

    #[test]
    fn places_that_no_grid_holds_show_all_pairs() {
        for far in [f64::NAN, f64::INFINITY, 1e300] {
            let centres = [Vector3::zeros(), Vector3::repeat(far), Vector3::repeat(0.1)];
            let mut count = 0;
            Neighbours::default().near(&centres, |_| 0.1, 0.01, |_, _| count += 1);
            assert_eq!(count, 3, "{far}");
        }
        let mut count = 0;
        Neighbours::default().near(&[Vector3::zeros(), Vector3::repeat(5.0)], |_| 0.1, f64::INFINITY, |_, _| count += 1);
        assert_eq!(count, 1, "any distance is within an infinite reach");
    }
}
