//! How far a polygon inscribed in the circle, the cut of a polyhedral friction cone, is from it.

use crate::cones::polyhedral::direction;

/// How the d directions of a polyhedral cone are spread over the turn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Spread {
    /// At equal angles: the regular polygon.
    Even,
    /// The four half axes, and all that are left at equal angles in one quadrant; of four, the half axes.
    OneQuadrant,
}

impl Spread {
    /// The sides of the polygon with d ≥ 4 vertices, as their ends \[turns/n\], and n.
    fn sides(self, d: usize) -> (Vec<[usize; 2]>, usize) {
        let (refined, quadrant) = match self {
            Spread::Even => (d, d),
            Spread::OneQuadrant => (d - 3, d - 3),
        };
        let coarse = (refined..d).map(|side| {
            let end = side - refined + 1;
            [end * quadrant, (end + 1) * quadrant]
        });
        let turn = if self == Spread::Even { d } else { 4 * quadrant };
        ((0..refined).map(|side| [side, side + 1]).chain(coarse).collect(), turn)
    }

    /// The largest defect of the radius, and the largest angle \[rad\] between a direction of the plane and the nearest of the d.
    ///
    /// They are measured at the middle of each side, where the polygon is nearest to the centre and its vertices are farthest away.
    pub fn errors(self, d: usize) -> [f64; 2] {
        let (sides, turn) = self.sides(d);
        let reach = sides.into_iter().map(|[start, end]| {
            let ([x, y], [a, b]) = (direction(start, turn), direction(start + end, 2 * turn));
            x * a + y * b
        });
        let least = reach.fold(1.0, f64::min);
        [1.0 - least, least.acos()]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cones::polyhedral::{direction_error, strength_error};
    use crate::tolerance::rounding;

    #[test]
    fn equal_angles_have_the_errors_of_the_regular_polygon() {
        for d in [4, 8, 16, 64] {
            let [radius, angle] = Spread::Even.errors(d);
            let sine = direction_error(d).sin();
            assert!((radius - strength_error(d)).abs() <= rounding(8, 1.0), "{d}: {radius}");
            assert!((angle - direction_error(d)).abs() <= rounding(8, 1.0) / sine, "{d}: {angle}");
        }
    }

    #[test]
    fn every_spread_has_d_sides_around_the_turn() {
        for (spread, d) in [(Spread::Even, 8), (Spread::OneQuadrant, 4), (Spread::OneQuadrant, 8), (Spread::OneQuadrant, 33)] {
            let (sides, turn) = spread.sides(d);
            assert!(sides.len() == d && sides[0][0] == 0 && sides[d - 1][1] == turn, "{spread:?} {d}: {sides:?}");
            assert!(sides.windows(2).all(|pair| pair[0][1] == pair[1][0]), "{spread:?} {d}: {sides:?}");
        }
    }

    #[test]
    fn outside_the_refined_quadrant_the_error_stays() {
        let [few, many] = [4, 64].map(|d| Spread::OneQuadrant.errors(d)[0]);
        assert!((few - many).abs() <= rounding(8, 1.0), "{few} {many}");
    }
}
