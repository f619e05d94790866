//! What friction may be for one normal impulse, a disk or a polygon of radius R, with its projection and the slope of that.
//!
//! ```text
//!     P_R(z) = argmin { ‖p − z‖ : p ∈ R·S } ,     P_R(z) = A z + g R ,     ∂P_R = A ∂z + g ∂R ,     support(y) = max { s·(−y) : s ∈ S }
//!     inside         A = I                       g = 0
//!     on the circle  A = (R/‖z‖)(I − ẑẑᵀ)        g = ẑ
//!     at a vertex    A = 0                       g = Dⱼ
//!     on a side      A = t tᵀ                    g = cos(π/d) m        t along the side, m its normal
//! ```
//! A point outside a regular polygon is nearest to the side in whose sector it lies: the reflections that keep the polygon keep its
//! projection.

use crate::cones::polyhedral::direction;
use std::f64::consts::PI;

/// S: the unit disk, an interval where there is one tangent, or the regular polygon with the vertices Dⱼ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum FrictionSet {
    Disk,
    Polygon { directions: usize },
}

/// A and g of P_R(z) = A z + g R.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Piece {
    pub along: [[f64; 2]; 2],
    pub growth: [f64; 2],
}

impl Piece {
    /// Entry of I − A.
    pub fn stays(&self, i: usize, j: usize) -> f64 {
        (if i == j { 1.0 } else { 0.0 }) - self.along[i][j]
    }
}

impl FrictionSet {
    /// The piece of P_R at z; `radius` ≥ 0, and a single tangent leaves the second entry of z zero.
    pub fn piece(self, radius: f64, z: [f64; 2]) -> Piece {
        match self {
            _ if radius == 0.0 => Piece { along: [[0.0; 2]; 2], growth: [0.0; 2] },
            FrictionSet::Disk => disk(radius, z),
            FrictionSet::Polygon { directions } => polygon(radius, z, directions),
        }
    }

    /// The s ∈ S with the largest s·(−y): friction of maximal dissipation, zero at rest.
    pub fn against(self, y: [f64; 2]) -> [f64; 2] {
        let length = y[0].hypot(y[1]);
        match self {
            _ if length == 0.0 => [0.0; 2],
            FrictionSet::Disk => [-y[0] / length, -y[1] / length],
            FrictionSet::Polygon { directions } => {
                let push = |j: usize| -dot(direction(j, directions), y);
                let best = (0..directions).max_by(|&a, &b| push(a).total_cmp(&push(b)));
                best.map_or([0.0; 2], |j| direction(j, directions))
            }
        }
    }
}

const INSIDE: Piece = Piece { along: [[1.0, 0.0], [0.0, 1.0]], growth: [0.0; 2] };

fn disk(radius: f64, z: [f64; 2]) -> Piece {
    let length = z[0].hypot(z[1]);
    if length <= radius {
        return INSIDE;
    }
    let unit = [z[0] / length, z[1] / length];
    let share = radius / length;
    let across = |i: usize, j: usize| share * (if i == j { 1.0 } else { 0.0 } - unit[i] * unit[j]);
    Piece { along: [[across(0, 0), across(0, 1)], [across(1, 0), across(1, 1)]], growth: unit }
}

fn polygon(radius: f64, z: [f64; 2], d: usize) -> Piece {
    let turns = z[1].atan2(z[0]).rem_euclid(2.0 * PI) * d as f64 / (2.0 * PI);
    let j = (turns.floor() as usize) % d;
    let (first, second) = (direction(j, d), direction((j + 1) % d, d));
    let side = [second[0] - first[0], second[1] - first[1]];
    let length = side[0].hypot(side[1]);
    let along = [side[0] / length, side[1] / length];
    let normal = [along[1], -along[0]];
    let reach = dot(normal, first);
    if d > 2 && dot(normal, z) <= radius * reach {
        return INSIDE;
    }
    let (place, vertex) = (dot(along, z), |vertex: [f64; 2]| Piece { along: [[0.0; 2]; 2], growth: vertex });
    if place <= radius * dot(along, first) {
        vertex(first)
    } else if place >= radius * dot(along, second) {
        vertex(second)
    } else {
        let outer = |i: usize, j: usize| along[i] * along[j];
        Piece { along: [[outer(0, 0), outer(0, 1)], [outer(1, 0), outer(1, 1)]], growth: normal.map(|m| m * reach) }
    }
}

fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_exact::tolerance::rounding;
    use proptest::prelude::*;

    const SETS: [FrictionSet; 5] = [
        FrictionSet::Disk,
        FrictionSet::Polygon { directions: 2 },
        FrictionSet::Polygon { directions: 3 },
        FrictionSet::Polygon { directions: 4 },
        FrictionSet::Polygon { directions: 7 },
    ];

    fn projected(set: FrictionSet, radius: f64, z: [f64; 2]) -> [f64; 2] {
        let Piece { along, growth } = set.piece(radius, z);
        [0, 1].map(|i| dot(along[i], z) + growth[i] * radius)
    }

    /// 1 000 points of the boundary of S and its middle.
    fn members(set: FrictionSet) -> Vec<[f64; 2]> {
        let around = (0..1000).map(|k| match set {
            FrictionSet::Disk => (2.0 * PI * k as f64 / 1000.0).sin_cos().into(),
            FrictionSet::Polygon { directions: d } => {
                let (j, share) = (k % d, (k / d) as f64 / (1000 / d) as f64);
                let (first, second) = (direction(j, d), direction((j + 1) % d, d));
                [0, 1].map(|i| (1.0 - share) * first[i] + share * second[i])
            }
        });
        around.chain([[0.0; 2]]).collect()
    }

    proptest! {
        /// (z − P)·(s R − P) ≤ 0 for every member s: the inequality that no other point of a convex set fulfils.
        #[test]
        fn the_piece_is_the_projection(x in -3.0..3.0f64, y in -3.0..3.0f64, radius in 0.0..2.0f64) {
            for set in SETS {
                let p = projected(set, radius, [x, y]);
                let farthest = members(set).into_iter().map(|s| dot([x - p[0], y - p[1]], [s[0] * radius - p[0], s[1] * radius - p[1]]));
                prop_assert!(farthest.fold(f64::NEG_INFINITY, f64::max) <= rounding(64, 25.0), "{set:?}");
            }
        }

        #[test]
        fn the_slope_is_the_derivative(x in -3.0..3.0f64, y in -3.0..3.0f64, radius in 0.1..2.0f64) {
            let step = crate::tolerance::cones::DIFFERENCE_STEP;
            for set in SETS {
                let piece = set.piece(radius, [x, y]);
                let neighbours = [[x + step, y], [x - step, y], [x, y + step], [x, y - step]];
                let radii = [radius - step, radius + step].map(|radius| set.piece(radius, [x, y]));
                let pieces = neighbours.map(|z| set.piece(radius, z)).into_iter().chain(radii);
                let same = |other: Piece| if set == FrictionSet::Disk { (other == INSIDE) == (piece == INSIDE) } else { other == piece };
                if !pieces.into_iter().all(same) {
                    continue; // a kink lies between
                }
                let [east, west, north, south] = neighbours.map(|z| projected(set, radius, z));
                let (larger, smaller) = (projected(set, radius + step, [x, y]), projected(set, radius - step, [x, y]));
                // third derivatives of the disk's projection are at most 6 R/‖z‖³ ≤ 6/R²
                let bound = crate::tolerance::cones::difference_error(radius.min(1.0), 4.0);
                for i in 0..2 {
                    let slopes = [(east[i] - west[i]), (north[i] - south[i]), (larger[i] - smaller[i])].map(|change| change / (2.0 * step));
                    for (slope, stated) in slopes.into_iter().zip([piece.along[i][0], piece.along[i][1], piece.growth[i]]) {
                        prop_assert!((slope - stated).abs() <= bound, "{set:?}: {slope} is not {stated}");
                    }
                }
            }
        }

        #[test]
        fn friction_of_maximal_dissipation_is_the_best_member(x in -3.0..3.0f64, y in -3.0..3.0f64) {
            for set in SETS {
                let best = -dot(set.against([x, y]), [x, y]);
                let largest = members(set).into_iter().map(|s| -dot(s, [x, y])).fold(0.0, f64::max);
                prop_assert!(best >= largest - rounding(16, 4.0), "{set:?}");
            }
        }
    }
}
