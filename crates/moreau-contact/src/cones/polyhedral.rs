//! The friction cone with `d` directions, `K_d = cone{n + μ Dⱼ}`, `Dⱼ = (cos 2πj/d, sin 2πj/d)`, inscribed in K_μ.
//!
//! Relative to the friction bound μ r_n, for `d ≥ 2` equally spaced directions:
//! ```text
//!     strength error        1 − cos(π/d)     weakest direction: the middle of a side of the polygon
//!     Hausdorff distance    1 − cos(π/d)     between the disk and the polygon
//!     direction error       π/d              maximal dissipation picks a vertex, at most π/d beside −u_t
//!     force-vector error    2 sin(π/2d)      chord between that vertex and the true force
//! ```
//! In a two-dimensional contact d = 2 gives ±tangent₁, and K_2 = K_μ without error; the errors above are those of a
//! three-dimensional contact.

use std::f64::consts::PI;
use std::sync::OnceLock;

/// Numbers of directions whose sines are kept: those that people use.
const KEPT: usize = 65;

/// Direction j of d, the unit vector at angle 2πj/d from tangent₁.
pub fn direction(j: usize, d: usize) -> [f64; 2] {
    // a certificate asks for every direction of every contact in every iteration, and a sine costs as much as the rest
    static TABLE: [OnceLock<Vec<[f64; 2]>>; KEPT] = [const { OnceLock::new() }; KEPT];
    match TABLE.get(d) {
        Some(kept) if d > 0 => kept.get_or_init(|| (0..d).map(|j| at_angle(j, d)).collect())[j % d],
        _ => at_angle(j % d, d),
    }
}

/// The unit vector at angle 2πj/d, j < d; quarter turns are exact, so that d = 2 and d = 4 give rows of 0 and ±1.
fn at_angle(j: usize, d: usize) -> [f64; 2] {
    match (4 * j, d) {
        (0, _) => [1.0, 0.0],
        (turn, _) if turn == d => [0.0, 1.0],
        (turn, _) if turn == 2 * d => [-1.0, 0.0],
        (turn, _) if turn == 3 * d => [0.0, -1.0],
        _ => {
            let (sine, cosine) = (2.0 * PI * j as f64 / d as f64).sin_cos();
            [cosine, sine]
        }
    }
}

/// Edge j of K_d, `n + μ Dⱼ`.
pub fn edge(j: usize, d: usize, mu: f64) -> [f64; 3] {
    let [first, second] = direction(j, d);
    [1.0, mu * first, mu * second]
}

/// The decomposition r_t = a Dⱼ + b Dⱼ₊₁ along the two of d ≥ 3 directions beside r_t, as (j, \[a, b\]): of all decompositions with
/// β ≥ 0 the one with the smallest sum.
pub fn neighbours(r: [f64; 2], d: usize) -> (usize, [f64; 2]) {
    let turns = r[1].atan2(r[0]).rem_euclid(2.0 * PI) * d as f64 / (2.0 * PI);
    let j = (turns.floor() as usize) % d;
    let (left, right) = (direction(j, d), direction((j + 1) % d, d));
    let area = left[0] * right[1] - left[1] * right[0];
    // rounding may leave r_t a hair outside the sector
    let parts = [(r[0] * right[1] - r[1] * right[0]) / area, (left[0] * r[1] - left[1] * r[0]) / area];
    (j, parts.map(|part| part.max(0.0)))
}

/// β ≥ 0 with Σ Dⱼβⱼ = r_t and the smallest sum, along the two directions beside r_t; takes the place of an empty `beta`.
pub fn along_neighbours(r: [f64; 2], d: usize, beta: &mut Vec<f64>) {
    beta.resize(d, 0.0);
    if d == 2 {
        beta[usize::from(r[0] < 0.0)] = r[0].abs();
        return;
    }
    let (j, parts) = neighbours(r, d);
    beta[j] = parts[0];
    beta[(j + 1) % d] = parts[1];
}

/// f with Σ fⱼ(n + μDⱼ) = r: the neighbours carry r_t/μ, and what is left of r_n is spread evenly, which adds no tangential impulse;
/// `edges` is empty before.
pub fn along_edges(r: &[f64], mu: f64, d: usize, edges: &mut Vec<f64>) {
    let [first, second] = [r.get(1), r.get(2)].map(|r| r.copied().unwrap_or(0.0));
    if mu > 0.0 {
        along_neighbours([first / mu, second / mu], d, edges);
    }
    edges.resize(d, 0.0);
    let rest = (r[0] - edges.iter().sum::<f64>()) / d as f64;
    edges.iter_mut().for_each(|edge| *edge += rest);
}

/// Relative loss of friction strength in the worst direction of a three-dimensional contact, `1 − cos(π/d) = 2 sin²(π/2d)`.
pub fn strength_error(d: usize) -> f64 {
    // The second form does not cancel for many directions.
    let sine = (PI / (2.0 * d as f64)).sin();
    2.0 * sine * sine
}

/// Largest angle \[rad\] between the friction force of maximal dissipation and the direction opposite to sliding, `π/d`.
pub fn direction_error(d: usize) -> f64 {
    PI / d as f64
}

/// Hausdorff distance between the friction disk of radius 1 and its inscribed polygon, `1 − cos(π/d)`.
pub fn hausdorff_distance(d: usize) -> f64 {
    strength_error(d)
}

/// Largest distance between the friction force of maximal dissipation and Coulomb's, relative to μ r_n: `2 sin(π/2d)`.
pub fn force_error(d: usize) -> f64 {
    2.0 * (PI / (2.0 * d as f64)).sin()
}

/// Whether `z ∈ K_d`: `z_t = Σ Dⱼβⱼ`, `β ≥ 0`, `Σβⱼ ≤ μ z_n`.
///
/// Two entries are a two-dimensional contact with ±tangent₁. In three dimensions d = 2 is the segment along tangent₁, and
/// for d ≥ 3 the sides of the polygon are tested: `z_t·m ≤ μ z_n cos(π/d)` for the side normals m at the odd multiples of π/d.
/// ```
/// use moreau_contact::cones::polyhedral::{contains, strength_error};
///
/// let diagonal = [1.0, 0.4, 0.4]; // ‖r_t‖ = 0.57 r_n, between two of four directions
/// assert!(!contains(&diagonal, 0.6, 4) && contains(&diagonal, 0.6, 16));
/// assert!((strength_error(4) - (1.0 - 0.5f64.sqrt())).abs() < 1e-15);
/// ```
pub fn contains(z: &[f64], mu: f64, d: usize) -> bool {
    let bound = mu * z[0];
    if z[0].is_nan() || z[0] < 0.0 {
        return false;
    }
    match *z {
        [_] => true,
        [_, tangent] => tangent.abs() <= bound,
        [_, first, second] if d == 2 => second == 0.0 && first.abs() <= bound,
        [_, first, second] => (0..d).all(|j| {
            let [cosine, sine] = direction(2 * j + 1, 2 * d);
            cosine * first + sine * second <= bound * (PI / d as f64).cos()
        }),
        _ => false,
    }
}

/// The direction of maximal dissipation, the j that maximises `−Dⱼ·u_t`; the smallest such j.
pub fn most_dissipative(sliding: [f64; 2], d: usize) -> usize {
    let rate = |j: usize| {
        let [first, second] = direction(j, d);
        -(first * sliding[0] + second * sliding[1])
    };
    (1..d).fold(0, |best, j| if rate(j) > rate(best) { j } else { best })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tolerance::cones::sampling_error;
    use moreau_exact::tolerance::rounding;

    const SAMPLES: usize = 7200;

    /// Sliding directions, dense enough to come within π/SAMPLES of the worst one.
    fn sliding() -> impl Iterator<Item = [f64; 2]> {
        (0..SAMPLES).map(|k| {
            let (sine, cosine) = (2.0 * PI * k as f64 / SAMPLES as f64).sin_cos();
            [cosine, sine]
        })
    }

    fn largest(values: impl Iterator<Item = f64>) -> f64 {
        values.fold(0.0, f64::max)
    }

    #[test]
    fn measured_errors_equal_the_closed_forms() {
        for d in [2, 3, 4, 5, 8, 16, 64] {
            let tolerance = sampling_error(SAMPLES);
            let chosen = |u: [f64; 2]| direction(most_dissipative(u, d), d);
            let angle = largest(sliding().map(|u| {
                let [first, second] = chosen(u);
                (-first * u[0] - second * u[1]).clamp(-1.0, 1.0).acos()
            }));
            let vector = largest(sliding().map(|u| {
                let [first, second] = chosen(u);
                (first + u[0]).hypot(second + u[1])
            }));
            assert!((angle - direction_error(d)).abs() <= tolerance, "d = {d}: {angle}");
            assert!((vector - force_error(d)).abs() <= tolerance, "d = {d}: {vector}");
        }
    }

    #[test]
    fn measured_strength_by_bisection_of_the_membership_equals_the_closed_form() {
        for d in [2, 3, 4, 5, 8, 16] {
            let radius = |u: [f64; 2]| {
                let (mut inside, mut outside) = (0.0, 1.5);
                for _ in 0..50 {
                    let middle = 0.5 * (inside + outside);
                    let held = contains(&[1.0, middle * u[0], middle * u[1]], 1.0, d);
                    if held { inside = middle } else { outside = middle }
                }
                inside
            };
            let weakest = sliding().step_by(5).map(radius).fold(f64::INFINITY, f64::min);
            assert!((1.0 - weakest - strength_error(d)).abs() <= sampling_error(SAMPLES / 5), "d = {d}: {weakest}");
        }
    }

    #[test]
    fn edges_belong_to_both_cones_and_side_middles_mark_the_boundary() {
        for d in [2, 3, 4, 8] {
            for j in 0..d {
                let z = edge(j, d, 0.7);
                let shrunk = [z[0], z[1] * (1.0 - rounding(4, 1.0)), z[2] * (1.0 - rounding(4, 1.0))];
                assert!(contains(&shrunk, 0.7, d), "d = {d}, j = {j}");
                assert!(!contains(&[z[0], 1.01 * z[1], 1.01 * z[2]], 0.7, d));
            }
        }
        let reach = (PI / 8.0).cos();
        let [first, second] = direction(1, 16);
        assert!(contains(&[1.0, 0.999 * reach * first, 0.999 * reach * second], 1.0, 8));
        assert!(!contains(&[1.0, 1.001 * reach * first, 1.001 * reach * second], 1.0, 8));
    }

    #[test]
    fn two_directions_are_exact_in_the_plane() {
        assert!(contains(&[2.0, -1.0], 0.5, 2));
        assert!(!contains(&[2.0, -1.0f64.next_up()], 0.5, 2));
        assert!(!contains(&[-1.0, 0.0], 0.0, 2));
    }

    #[test]
    fn quarter_turns_are_exact() {
        assert_eq!(
            [direction(0, 4), direction(1, 4), direction(2, 4), direction(3, 4)],
            [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]]
        );
        assert_eq!(direction(6, 8), [0.0, -1.0]);
        assert_eq!(direction(1, 2), [-1.0, 0.0]);
    }
}
