//! d_H(gph a, gph b), the Hausdorff distance of filled-in velocity graphs in the plane (t/T_ref, v/V_ref).
//!
//! ```text
//!     d_H(A, B) = max( sup_{p∈A} dist(p, B), sup_{q∈B} dist(q, A) )
//! ```
//! The supremum is enclosed by branch and bound. For a part of A inside a box and any segment s of B, the distance to
//! the convex set s is convex, so over the box it is largest at a corner: that is an upper bound. Any point of the
//! part gives a lower bound. Boxes of segments are halved down to single segments, then segments are halved, always
//! where the upper bound is largest, until lower and upper bound agree to [`GRAPH_ACCURACY`].

use super::Normalisation;
use crate::tolerance::trajectory::{GRAPH_ACCURACY, GRAPH_ROUNDING};
use crate::trajectory::Graph;
use crate::trajectory::segment_tree::{Point, SegmentTree, distance_to_segment};
use moreau_exact::Result;
use serde::Serialize;
use std::collections::BinaryHeap;

/// An enclosure of the Hausdorff distance, with the scales it was normalised with.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct GraphDistance {
    /// Attained by a point of one of the graphs.
    pub lower: f64,
    /// Never exceeded; within [`GRAPH_ACCURACY`], relative, of `lower`.
    pub upper: f64,
    /// T_ref and V_ref.
    pub normalisation: Normalisation,
}

/// The Hausdorff distance of two filled-in velocity graphs in (t/T_ref, v/V_ref).
///
/// # Errors
/// If a scaled graph is not finite (a zero or non-finite normalisation).
///
/// # Source
/// Moreau's distance of graphs for functions of bounded variation; chapter §0–§1.
///
/// ```
/// use moreau_dynamics::trajectory::Graph;
/// use moreau_dynamics::trajectory::metrics::{Normalisation, graph_distance, velocity_sup};
///
/// // the same jump of 3 m/s, a hundredth of a second later
/// let jump = |at: f64| Graph::new(vec![[0.0, -2.0], [at, -2.0], [at, 1.0], [2.0, 1.0]]);
/// let (one, other) = (jump(1.0)?, jump(1.01)?);
/// let distance = graph_distance(&one, &other, Normalisation { time: 1.0, speed: 1.0 })?;
/// assert!((distance.upper - 0.01).abs() < 1e-6); // near as graphs
/// assert_eq!(velocity_sup(&one, &other), 3.0); // far apart in the maximum norm
/// # Ok::<(), moreau_exact::Error>(())
/// ```
pub fn graph_distance(a: &Graph, b: &Graph, normalisation: Normalisation) -> Result<GraphDistance> {
    let tree_a = SegmentTree::new(a.scaled(normalisation.time, normalisation.speed)?.points());
    let tree_b = SegmentTree::new(b.scaled(normalisation.time, normalisation.speed)?.points());
    let (there, back) = (directed(&tree_a, &tree_b), directed(&tree_b, &tree_a));
    Ok(GraphDistance { lower: there.0.max(back.0), upper: there.1.max(back.1), normalisation })
}

/// A part of the first graph, and an upper bound of its distance to the second.
struct Part {
    upper: f64,
    extent: Extent,
}

enum Extent {
    /// A node of the tree.
    Node(usize),
    /// A piece of one segment.
    Segment(Point, Point),
}

impl PartialEq for Part {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}
impl Eq for Part {}
impl PartialOrd for Part {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}
impl Ord for Part {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        self.upper.total_cmp(&other.upper)
    }
}

/// Lower and upper bound of sup_{p∈from} dist(p, to).
fn directed(from: &SegmentTree, to: &SegmentTree) -> (f64, f64) {
    let rounding = GRAPH_ROUNDING * from.root_box().magnitude().max(to.root_box().magnitude());
    let (mut lower, mut heap) = (0.0f64, BinaryHeap::from([Part { upper: f64::INFINITY, extent: Extent::Node(0) }]));
    while let Some(part) = heap.pop() {
        if part.upper <= lower * (1.0 + GRAPH_ACCURACY) + rounding {
            return (lower, part.upper);
        }
        for extent in split(from, part.extent) {
            let (attained, upper) = bounds(from, to, &extent);
            lower = lower.max(attained);
            heap.push(Part { upper: upper.min(part.upper), extent });
        }
    }
    (lower, lower)
}

/// The halves of a part.
fn split(tree: &SegmentTree, extent: Extent) -> [Extent; 2] {
    let (start, end) = match extent {
        Extent::Node(node) => match tree.children(node) {
            Ok([left, right]) => return [Extent::Node(left), Extent::Node(right)],
            Err(segment) => segment,
        },
        Extent::Segment(start, end) => (start, end),
    };
    let middle = [0.5 * (start[0] + end[0]), 0.5 * (start[1] + end[1])];
    [Extent::Segment(start, middle), Extent::Segment(middle, end)]
}

/// A distance attained on the part, and one never exceeded on it.
fn bounds(from: &SegmentTree, to: &SegmentTree, extent: &Extent) -> (f64, f64) {
    let (probe, corners) = match extent {
        Extent::Node(node) => (from.first_point(*node), from.bounding_box(*node).corners().to_vec()),
        Extent::Segment(start, end) => ([0.5 * (start[0] + end[0]), 0.5 * (start[1] + end[1])], vec![*start, *end]),
    };
    let (attained, nearest) = to.nearest(probe);
    let upper = corners.iter().map(|corner| distance_to_segment(*corner, nearest)).fold(0.0, f64::max);
    (attained, upper.max(attained))
}

#[cfg(test)]
mod tests {
    use super::*;

    const UNIT: Normalisation = Normalisation { time: 1.0, speed: 1.0 };

    fn distance(a: &[[f64; 2]], b: &[[f64; 2]]) -> GraphDistance {
        let (a, b) = (Graph::new(a.to_vec()).expect("ordered"), Graph::new(b.to_vec()).expect("ordered"));
        graph_distance(&a, &b, UNIT).expect("finite")
    }

    fn is(found: GraphDistance, expected: f64) {
        let slack = GRAPH_ACCURACY * expected + GRAPH_ROUNDING * 10.0;
        assert!(found.lower <= expected + slack && expected <= found.upper + slack, "{found:?} against {expected}");
        assert!(found.upper - found.lower <= slack, "{found:?}");
    }

    #[test]
    fn equal_graphs_have_distance_zero() {
        let zigzag: Vec<[f64; 2]> = (0..100).map(|k| [k as f64 / 10.0, if k % 2 == 0 { 1.0 } else { -1.0 }]).collect();
        is(distance(&zigzag, &zigzag), 0.0);
    }

    #[test]
    fn a_jump_shifted_in_time_is_at_the_distance_of_the_shift() {
        let jump = |t: f64| vec![[0.0, -1.0], [t, -1.0], [t, 1.0], [4.0, 1.0]];
        is(distance(&jump(1.0), &jump(1.25)), 0.25);
        is(distance(&jump(1.0), &jump(1.0 + 1e-6)), 1e-6);
    }

    #[test]
    fn a_jump_that_only_one_graph_has_is_at_the_distance_of_its_height() {
        // The spike's tip at (1, 2) is 2 away from the axis; the axis is nowhere farther from the spike's foot.
        is(distance(&[[0.0, 0.0], [2.0, 0.0]], &[[0.0, 0.0], [1.0, 0.0], [1.0, 2.0], [1.0, 0.0], [2.0, 0.0]]), 2.0);
    }

    #[test]
    fn times_are_divided_by_t_ref_and_speeds_by_v_ref() {
        let graph = |points: &[[f64; 2]]| Graph::new(points.to_vec()).expect("ordered");
        let normalisation = Normalisation { time: 2.0, speed: 8.0 };
        let jump = |t: f64| graph(&[[0.0, -8.0], [t, -8.0], [t, 8.0], [4.0, 8.0]]);
        is(graph_distance(&jump(1.0), &jump(1.25), normalisation).expect("finite"), 0.25 / 2.0);
        let level = |v: f64| graph(&[[0.0, v], [4.0, v]]);
        is(graph_distance(&level(0.0), &level(2.0), normalisation).expect("finite"), 2.0 / 8.0);
    }

    #[test]
    fn a_staircase_below_a_slope_is_at_the_distance_of_its_corners() {
        // Steps of width and height δ under the line y = t: corners at (kδ, (k−1)δ) are δ/√2 away.
        let n = 1000;
        let delta = 1.0 / n as f64;
        let step = |k: usize| [[(k - 1) as f64 * delta, (k - 1) as f64 * delta], [k as f64 * delta, (k - 1) as f64 * delta]];
        let stairs: Vec<[f64; 2]> = (1..=n).flat_map(step).chain([[1.0, 1.0]]).collect();
        is(distance(&[[0.0, 0.0], [1.0, 1.0]], &stairs), delta / 2.0f64.sqrt());
    }

    #[test]
    fn the_supremum_may_lie_inside_a_segment() {
        // Both ends lie on the other graph; the middle of the floor is 1 from the walls and from the ceiling.
        let found = distance(&[[0.0, 0.0], [2.0, 0.0]], &[[0.0, 0.0], [0.0, 1.0], [2.0, 1.0], [2.0, 0.0]]);
        is(found, 1.0);
    }

    #[test]
    fn a_brute_force_sampling_agrees_on_random_polylines() {
        // Linear congruential numbers: no dependence on a generator's version.
        let mut seed = 12345u64;
        let mut next = || {
            seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (seed >> 11) as f64 / (1u64 << 53) as f64
        };
        for _ in 0..40 {
            let mut polyline = || {
                let mut time = 0.0;
                (0..8)
                    .map(|_| {
                        if next() > 0.3 {
                            time += next();
                        }
                        [time, 4.0 * next()]
                    })
                    .collect::<Vec<[f64; 2]>>()
            };
            let (a, b) = (polyline(), polyline());
            let found = distance(&a, &b);
            let samples = 400;
            let brute = |from: &[[f64; 2]], to: &[[f64; 2]]| {
                from.windows(2)
                    .flat_map(|s| (0..=samples).map(move |k| lerp(s[0], s[1], k as f64 / samples as f64)))
                    .map(|p| to.windows(2).map(|s| distance_to_segment(p, [s[0], s[1]])).fold(f64::INFINITY, f64::min))
                    .fold(0.0, f64::max)
            };
            let sampled = brute(&a, &b).max(brute(&b, &a));
            // Sampling misses at most half a spacing, of a segment no longer than 1 + 4.
            assert!(sampled <= found.upper + GRAPH_ROUNDING * 10.0, "{sampled} above {found:?}");
            assert!(found.lower <= sampled + 0.5 * 5.0 / samples as f64, "{sampled} below {found:?}");
        }
    }

    #[test]
    fn cost_is_near_linear_for_near_and_for_far_graphs() {
        // 40 000 segments each: a quadratic method would visit 1.6e9 pairs.
        let curve = |offset: f64| (0..40_000).map(|k| [k as f64 * 1e-4, (k as f64 * 1e-3).sin() + offset]).collect::<Vec<_>>();
        let start = std::time::Instant::now();
        let near = distance(&curve(0.0), &curve(1e-3));
        let far = distance(&curve(0.0), &curve(30.0));
        assert!(near.lower > 0.0 && near.upper <= 1.001e-3 && far.lower >= 28.0);
        assert!(start.elapsed().as_secs() < 20, "took {:?}", start.elapsed());
    }

    #[test]
    fn a_normalisation_of_zero_is_refused() {
        let graph = Graph::new(vec![[0.0, 0.0], [1.0, 1.0]]).expect("ordered");
        assert!(graph_distance(&graph, &graph, Normalisation { time: 0.0, speed: 1.0 }).is_err());
    }

    fn lerp(a: [f64; 2], b: [f64; 2], s: f64) -> [f64; 2] {
        [a[0] + (b[0] - a[0]) * s, a[1] + (b[1] - a[1]) * s]
    }
}
