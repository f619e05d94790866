//! A plastic unit mass, g = 10 m/s², that reaches a corner of the floor and a wall, both at 1/10 s with v = (−1, −1) m/s, and stays there.
//!
//! ```text
//!     q(t) = (1/10 − t, 1/20 − 5 t²) for t < 1/10, 0 after it
//! ```
//! −v⁻ lies in the cone of the normals of both walls given here, so that v⁺ = 0 is the projection of v⁻ onto the tangent cone.

use crate::Result;
use crate::claims::prelude::*;
use crate::problem::Lcp;
use crate::solvers::lemke::solution;
use crate::tolerance::claims::thresholds::QUARTERED;

/// The normal of a wall at the floor's right angle, x ≥ 0.
pub fn upright() -> [Rational; 2] {
    [ratio(1, 1), ratio(0, 1)]
}

/// The normal of the wall 4x + 3y ≥ 0.
pub fn leaning() -> [Rational; 2] {
    [ratio(4, 5), ratio(3, 5)]
}

/// max |q_h − q| up to 1/5 s of Moreau–Jean with θ = 1 and activation φ ≤ 0, for the floor y ≥ 0 and a wall given by its normal.
pub fn error_in_corner(wall: &[Rational; 2], h: &Rational) -> Result<Rational> {
    let normals = [[ratio(0, 1), ratio(1, 1)], wall.clone()];
    let (mut place, mut velocity) =
        (DVector::from_vec(vec![ratio(1, 10), ratio(1, 20)]), DVector::from_vec(vec![ratio(-1, 1), ratio(0, 1)]));
    let (mut time, mut worst) = (ratio(0, 1), ratio(0, 1));
    while time < ratio(1, 5) {
        let free = &velocity - DVector::from_vec(vec![ratio(0, 1), ratio(10, 1) * h]);
        let closed: Vec<&[Rational; 2]> = normals.iter().filter(|n| &n[0] * &place[0] + &n[1] * &place[1] <= ratio(0, 1)).collect();
        let jacobian = DMatrix::from_fn(closed.len(), 2, |i, j| closed[i][j].clone());
        velocity = if closed.is_empty() {
            free
        } else {
            let step = Lcp::new(&jacobian * jacobian.transpose(), &jacobian * &free);
            free + jacobian.transpose() * solution(&step)?
        };
        place += &velocity * h.clone();
        time += h;
        let left = (ratio(1, 10) - &time).max(ratio(0, 1));
        let height = if left > ratio(0, 1) { ratio(1, 20) - ratio(5, 1) * &time * &time } else { ratio(0, 1) };
        worst = worst.max((&place[0] - left).magnitude()).max((&place[1] - height).magnitude());
    }
    Ok(worst)
}

/// The error in the corner with h/4 over that with h = 2/(20N + `remainder`) s: with 0 both walls close in one step, with 5
/// the floor closes before the wall.
pub fn quartered(wall: &[Rational; 2], remainder: i64) -> Result<Rational> {
    let error = |count: i64| error_in_corner(wall, &ratio(2, 20 * count + remainder));
    Ok(error(256)? / error(64)?)
}

/// The finding on a mass that reaches the floor before the wall, of whose motion the sentence says that it converges.
pub fn floor_before_wall(wall: &[Rational; 2]) -> Result<Finding> {
    let apart = quartered(wall, 5)?.to_f64().value();
    let name = "sup |q_h − q| with h/4 over that with h, floor closed before the wall";
    Ok(Finding::at_least(name, apart, QUARTERED, "1")
        .says_at_most(QUARTERED)
        .violating("one contact, or contacts that meet at right angles"))
}
