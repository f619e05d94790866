//! One number that is zero at a solution, with its scale and its rounding.
//!
//! ```text
//!     limit = max(τ · scale, floor) ,      relative = 0 if value ≤ floor, value/scale otherwise ,      accepted ⟺ relative ≤ τ
//! ```
//! The scale is the size of what the number is made of at its own contact, the floor is the rounding of its evaluation. `relative` does not
//! depend on τ, so that an answer is judged once and compared with any τ.

/// A residual of one contact; all three numbers have its unit.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Part {
    /// The residual, ≥ 0.
    pub value: f64,
    /// What its relative size refers to.
    pub scale: f64,
    /// The rounding error of its evaluation.
    pub floor: f64,
}

impl Part {
    /// value/scale, or 0 where the value is rounding. Not a number, or infinite, where value and floor show nothing.
    pub fn relative(&self) -> f64 {
        if !self.floor.is_finite() {
            f64::NAN
        } else if self.value <= self.floor {
            0.0
        } else {
            self.value / self.scale
        }
    }

    /// max(τ · scale, floor).
    pub fn limit(&self, tolerance: f64) -> f64 {
        (tolerance * self.scale).max(self.floor)
    }

    /// Whether the relative size is larger, or among equals the value; what is not a number exceeds every number.
    pub(super) fn exceeds(&self, other: &Part) -> bool {
        let (own, others) = (self.relative(), other.relative());
        (own.is_nan() && !others.is_nan()) || own > others || (own == others && self.value > other.value)
    }

    /// The part with the larger relative size; the larger value among equals; one that is not a number if there is one.
    pub(super) fn worse(self, other: Part) -> Part {
        if other.exceeds(&self) { other } else { self }
    }

    /// The part with the smaller relative size; one that is not a number if there is one.
    pub(super) fn better(self, other: Part) -> Part {
        if other.relative().is_nan() || (self.exceeds(&other) && !self.relative().is_nan()) { other } else { self }
    }

    /// The same residual in another unit.
    pub(super) fn times(self, factor: f64) -> Part {
        Part { value: self.value * factor, scale: self.scale * factor, floor: self.floor * factor }
    }
}

/// 0 ≤ z ⟂ w ≥ 0: a negative member must be small, and one of the two must be.
///
/// The floor belongs to one member alone: the rounding of a velocity excuses no impulse.
pub(super) fn pair([z, w]: [f64; 2], impulse: Part, velocity: Part) -> Part {
    match (z < 0.0, w < 0.0) {
        (true, true) => impulse.worse(velocity),
        (true, false) => impulse,
        (false, true) => velocity,
        (false, false) => impulse.better(velocity),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn part(value: f64, scale: f64, floor: f64) -> Part {
        Part { value, scale, floor }
    }

    #[test]
    fn a_part_is_relative_to_its_scale_above_its_floor_and_zero_below() {
        assert_eq!(part(2.0, 4.0, 1.0).relative(), 0.5);
        assert_eq!(part(1.0, 4.0, 1.0).relative(), 0.0);
        assert_eq!(part(1.0f64.next_up(), 4.0, 1.0).relative(), 0.25f64.next_up());
        assert_eq!(part(0.0, 0.0, 0.0).relative(), 0.0);
        assert!(part(1.0, 0.0, 0.0).relative().is_infinite());
        for shows_nothing in [part(f64::NAN, 1.0, 0.0), part(1.0, 1.0, f64::INFINITY), part(f64::INFINITY, f64::INFINITY, 0.0)] {
            assert!(shows_nothing.relative().is_nan());
        }
    }

    #[test]
    fn one_member_of_a_pair_may_be_large_and_a_negative_one_may_not() {
        let (small, large) = (part(1e-9, 1.0, 0.0), part(1.0, 1.0, 0.0));
        assert_eq!(pair([1e-9, 1.0], small, large), small);
        assert_eq!(pair([1.0, 1e-9], large, small), small);
        assert_eq!(pair([1.0, 1.0], large, large).relative(), 1.0);
        assert_eq!(pair([-1.0, 1e-9], large, small), large);
        assert_eq!(pair([1e-9, -1.0], small, large), large);
        assert_eq!(pair([-1e-9, -1.0], small, large), large);
    }

    #[test]
    fn what_is_not_a_number_is_the_worst_and_never_the_better() {
        let (known, unknown) = (part(1.0, 1.0, 0.0), part(f64::NAN, 1.0, 0.0));
        for (one, other) in [(known, unknown), (unknown, known)] {
            assert!(one.worse(other).relative().is_nan() && one.better(other).relative().is_nan());
        }
    }
}
