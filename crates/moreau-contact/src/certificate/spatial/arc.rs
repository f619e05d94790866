//! Arcs of the unit circle whose ends are given by numbers, so that everything about them is enclosed without an angle.
//!
//! ```text
//!     d(t) = ± ( (1 − t²)/(1 + t²) ,  2t/(1 + t²) ) ,      low ≤ t ≤ high          (t = tan φ/2, φ from the axis ± e₁)
//! ```

use crate::certificate::interval::Interval;

/// A direction of slip, enclosed.
pub(super) type Direction = [Interval; 2];

/// Directions between two ends, less than half of the circle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Arc {
    /// ± 1.
    side: f64,
    low: f64,
    high: f64,
}

impl Arc {
    /// Four arcs that cover the circle.
    pub const QUARTERS: [Arc; 4] = [
        Arc { side: 1.0, low: 0.0, high: 1.0 },
        Arc { side: 1.0, low: -1.0, high: 0.0 },
        Arc { side: -1.0, low: 0.0, high: 1.0 },
        Arc { side: -1.0, low: -1.0, high: 0.0 },
    ];

    fn at(self, t: f64) -> Direction {
        let (square, side) = (Interval::point(t).square(), Interval::point(self.side));
        let below = Interval::ONE + square;
        [side * (Interval::ONE - square) / below, side * (Interval::point(2.0) * Interval::point(t)) / below]
    }

    /// d of both ends, the second counter-clockwise of the first.
    pub fn ends(self) -> [Direction; 2] {
        [self.at(self.low), self.at(self.high)]
    }

    /// A direction inside.
    pub fn middle(self) -> Direction {
        self.at(0.5 * self.low + 0.5 * self.high)
    }

    /// All directions of the arc, and of every mean of two of them that is made a unit vector.
    pub fn all(self) -> Direction {
        let [one, other] = self.ends();
        let mut hull = [one[0].hull(other[0]), one[1].hull(other[1])];
        let side = Interval::point(self.side);
        if self.low < 0.0 && self.high > 0.0 {
            hull[0] = hull[0].hull(side);
        }
        for t in [-1.0, 1.0] {
            if self.low < t && t < self.high {
                hull[1] = hull[1].hull(side * Interval::point(t));
            }
        }
        hull
    }

    /// Three directions in whose hull the arc is: its ends, and where the tangents there meet.
    pub fn corners(self) -> [Direction; 3] {
        let [one, other] = self.ends();
        let below = Interval::ONE + dot(one, other);
        [one, other, [(one[0] + other[0]) / below, (one[1] + other[1]) / below]]
    }

    /// The cosine of half of the angle between two directions of the arc, and 1.
    pub fn cosine(self) -> Interval {
        let [one, other] = self.ends();
        let half = ((Interval::ONE + dot(one, other)) / Interval::point(2.0)).sqrt();
        Interval { low: half.low.clamp(0.0, 1.0), high: 1.0 }
    }

    /// high − low.
    pub fn width(self) -> f64 {
        self.high - self.low
    }

    /// Both halves.
    pub fn halves(self) -> [Arc; 2] {
        let middle = 0.5 * self.low + 0.5 * self.high;
        [Arc { high: middle, ..self }, Arc { low: middle, ..self }]
    }

    /// The arc and this direction, and a part of its width more at both ends; none if that is far beyond it.
    pub fn around(self, direction: [f64; 2], part: f64) -> Option<Arc> {
        let [along, across] = direction.map(|x| self.side * x);
        let (t, width) = (across / (1.0 + along), self.width());
        let (low, high) = (self.low.min(t) - part * width, self.high.max(t) + part * width);
        // it is less than half of the circle where tan(φ_high − φ_low)/2 is finite and positive
        let near = low >= self.low - 2.0 * width && high <= self.high + 2.0 * width && low * high > -0.5;
        near.then_some(Arc { low, high, ..self })
    }

    /// Whether this vector, whatever it is in its box, points strictly between the ends.
    pub fn points_inside(self, vector: Direction) -> bool {
        let [one, other] = self.ends();
        cross(one, vector).is_positive() && cross(vector, other).is_positive()
    }

    /// Whether all of another arc is in this one.
    pub fn covers(self, other: Arc) -> bool {
        if self.side == other.side {
            return self.low <= other.low && other.high <= self.high;
        }
        other.ends().into_iter().all(|end| self.points_inside(end))
    }
}

/// a·b.
pub(super) fn dot(a: Direction, b: Direction) -> Interval {
    a[0] * b[0] + a[1] * b[1]
}

/// a₁b₂ − a₂b₁.
pub(super) fn cross(a: Direction, b: Direction) -> Interval {
    a[0] * b[1] - a[1] * b[0]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn holds(hull: Direction, direction: [f64; 2]) -> bool {
        (0..2).all(|i| hull[i].low <= direction[i] && direction[i] <= hull[i].high)
    }

    #[test]
    fn every_direction_is_in_one_quarter_and_in_its_hull_its_corners_and_the_halves() {
        for step in 0..720 {
            let angle = f64::from(step).to_radians() * 0.5 + 0.001;
            let direction = [angle.cos(), angle.sin()];
            let found: Vec<Arc> = Arc::QUARTERS.into_iter().filter(|arc| arc.points_inside(direction.map(Interval::point))).collect();
            let [arc] = found[..] else { panic!("{angle}: {found:?}") };
            assert!(holds(arc.all(), direction) && arc.halves().iter().any(|half| holds(half.all(), direction)));
            // inside of the triangle of its corners
            let [one, other, tip] = arc.corners();
            let at = direction.map(Interval::point);
            let beside = |a: Direction, b: Direction| cross([b[0] - a[0], b[1] - a[1]], [at[0] - a[0], at[1] - a[1]]);
            assert!(beside(one, tip).low >= 0.0 && beside(tip, other).low >= 0.0 && beside(other, one).low >= 0.0, "{angle}");
        }
    }

    #[test]
    fn an_arc_around_a_direction_covers_both_across_the_quarters() {
        let arc = Arc::QUARTERS[0];
        let wide = arc.around([-0.1, 0.99], 0.25).expect("it is near");
        assert!(wide.covers(arc) && wide.points_inside([-0.1, 0.99].map(Interval::point)));
        assert!(!arc.covers(wide) && !arc.points_inside([-0.1, 0.99].map(Interval::point)));
        assert!(wide.covers(Arc { side: -1.0, low: -1.0, high: -0.9 }) && !wide.covers(Arc::QUARTERS[3]));
        assert!(arc.around([-1.0, -0.1], 0.25).is_none(), "it is on the other side");
        assert!(wide.cosine().low > 0.0 && wide.cosine().low < arc.cosine().low);
    }
}
