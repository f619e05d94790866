//! Intervals of numbers, rounded outward: what a proof on rounded numbers calculates with.
//!
//! ```text
//!     [a, b] ∘ [c, d] ⊇ { x ∘ y : x in [a, b], y in [c, d] } ,      ∘ one of + − × ÷ ,     √[a, b] ⊇ { √x }
//! ```
//! The rounding mode stays as it is. The error of a sum is known exactly (Knuth), that of a product by a fused operation, and its sign says
//! whether an end moves to the next number; so what is exact stays exact. An end that is NaN is inside of nothing and above nothing: every
//! question is asked such that NaN answers “not proved”.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// The numbers from `low` to `high`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// The lower end.
    pub low: f64,
    /// The upper end.
    pub high: f64,
}

/// Below this size the error of a product is no number any more, 2⁻⁹⁶⁰.
pub(crate) const SMALLEST_EXACT: f64 = f64::MIN_POSITIVE * (1u64 << 62) as f64;

impl Interval {
    /// Zero alone.
    pub const ZERO: Interval = Interval { low: 0.0, high: 0.0 };
    /// One alone.
    pub const ONE: Interval = Interval { low: 1.0, high: 1.0 };

    /// One number alone.
    pub fn point(number: f64) -> Self {
        Interval { low: number, high: number }
    }

    /// The numbers within `radius` of `middle`.
    pub fn ball(middle: f64, radius: f64) -> Self {
        Interval { low: (Interval::point(middle) - Interval::point(radius)).low, high: sum_up(middle, radius) }
    }

    /// The smallest interval around both.
    pub fn hull(self, other: Self) -> Self {
        Interval { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    /// A number near the middle.
    pub fn middle(self) -> f64 {
        0.5 * self.low + 0.5 * self.high
    }

    /// How far an element is from `number`, at most.
    pub fn reach(self, number: f64) -> f64 {
        (self - Interval::point(number)).magnitude()
    }

    /// The largest |x|; NaN if an end is.
    pub fn magnitude(self) -> f64 {
        let (low, high) = (self.low.abs(), self.high.abs());
        if low.is_nan() || low > high { low } else { high }
    }

    /// {x²}, which has no negative element.
    pub fn square(self) -> Self {
        let product = self * self;
        if self.low <= 0.0 && self.high >= 0.0 { Interval { low: 0.0, high: product.high } } else { product }
    }

    /// {√x : x in it, x ≥ 0}.
    pub fn sqrt(self) -> Self {
        let exact = |root: f64, of: f64| of == 0.0 || (of > SMALLEST_EXACT && root.mul_add(root, -of) == 0.0);
        let (low, high) = (self.low.max(0.0).sqrt(), self.high.sqrt());
        Interval {
            low: if exact(low, self.low.max(0.0)) { low } else { low.next_down().max(0.0) },
            high: if exact(high, self.high) { high } else { high.next_up() },
        }
    }

    /// {max(x, 0)}.
    pub fn positive_part(self) -> Self {
        let part = |end: f64| if end < 0.0 { 0.0 } else { end };
        Interval { low: part(self.low), high: part(self.high) }
    }

    /// Whether every element is above zero.
    pub fn is_positive(self) -> bool {
        self.low > 0.0 && self.high >= self.low
    }
}

/// a + b and its error: their sum is a + b exactly.
pub(crate) fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let from_b = sum - a;
    (sum, (a - (sum - from_b)) + (b - from_b))
}

/// a b and its error: their sum is a b exactly, unless it is so small that its error is no number.
pub(crate) fn two_product(a: f64, b: f64) -> (f64, f64) {
    let product = a * b;
    (product, a.mul_add(b, -product))
}

fn sum_up(a: f64, b: f64) -> f64 {
    match two_sum(a, b) {
        (sum, error) if error > 0.0 => sum.next_up(),
        (sum, error) if error <= 0.0 => sum,
        (sum, _) => sum.next_up(), // an overflow on the way
    }
}

fn product_up(a: f64, b: f64) -> f64 {
    if a == 0.0 || b == 0.0 {
        return 0.0;
    }
    let (product, error) = two_product(a, b);
    if product.abs() > SMALLEST_EXACT && error <= 0.0 { product } else { product.next_up() }
}

fn quotient_up(a: f64, b: f64) -> f64 {
    if a == 0.0 { 0.0 } else { (a / b).next_up() }
}

impl Add for Interval {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Interval { low: -sum_up(-self.low, -other.low), high: sum_up(self.high, other.high) }
    }
}

impl Sub for Interval {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Neg for Interval {
    type Output = Self;
    fn neg(self) -> Self {
        Interval { low: -self.high, high: -self.low }
    }
}

/// The hull of four numbers that are rounded up, and of their opposites.
fn of_ends(a: Interval, b: Interval, up: fn(f64, f64) -> f64) -> Interval {
    let largest =
        |values: [f64; 4]| values.into_iter().fold(f64::NEG_INFINITY, |most, x| if most.is_nan() || x <= most { most } else { x });
    let ends = [(a.low, b.low), (a.low, b.high), (a.high, b.low), (a.high, b.high)];
    Interval { low: -largest(ends.map(|(x, y)| up(-x, y))), high: largest(ends.map(|(x, y)| up(x, y))) }
}

impl Mul for Interval {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        of_ends(self, other, product_up)
    }
}

impl Div for Interval {
    type Output = Self;
    /// All numbers where the divisor may be zero.
    fn div(self, other: Self) -> Self {
        if other.low > 0.0 || other.high < 0.0 {
            of_ends(self, other, quotient_up)
        } else {
            Interval { low: f64::NEG_INFINITY, high: f64::INFINITY }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_exact::scalar::{Rational, exact};

    fn around(x: Interval, value: &Rational) -> bool {
        (x.low == f64::NEG_INFINITY || exact(x.low) <= *value) && (x.high == f64::INFINITY || *value <= exact(x.high))
    }

    /// Numbers of all signs and sizes, from a linear congruence.
    fn numbers() -> Vec<f64> {
        let mut state = 88_172_645_463_325_252_u64;
        let mut next = || {
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            state
        };
        let sized = |bits: u64| (bits as i64 >> 11) as f64 * 2.0_f64.powi((bits % 140) as i32 - 120);
        (0..400).map(|_| sized(next())).chain([0.0, 1.0, -1.0, f64::MIN_POSITIVE, f64::from_bits(1), -3e-310, 0.1]).collect()
    }

    #[test]
    fn every_operation_contains_the_exact_result() {
        let all = numbers();
        for (i, &a) in all.iter().enumerate() {
            let b = all[(7 * i + 3) % all.len()];
            let (x, y) = (Interval::point(a), Interval::point(b));
            let (p, q) = (exact(a), exact(b));
            assert!(around(x + y, &(&p + &q)) && around(x - y, &(&p - &q)) && around(x * y, &(&p * &q)), "{a:e} {b:e}");
            if b != 0.0 {
                assert!(around(x / y, &(&p / &q)), "{a:e} / {b:e}");
            }
            let root = Interval::point(a.abs()).sqrt();
            assert!(exact(root.low) * exact(root.low) <= exact(a.abs()) && exact(a.abs()) <= exact(root.high) * exact(root.high));
            let (wide, other) = (x.hull(y), y.hull(Interval::point(all[(11 * i + 1) % all.len()])));
            for (v, w) in [(wide.low, other.low), (wide.high, other.low), (wide.low, other.high), (wide.high, other.high)] {
                assert!(around(wide * other, &(exact(v) * exact(w))) && around(wide + other, &(exact(v) + exact(w))));
            }
        }
    }

    #[test]
    fn rounding_to_nearest_or_inward_would_be_seen() {
        // 0.1 + 0.2, 0.1 × 0.1, 1/3 and √2 are no numbers: both ends differ from the nearest one on one side
        let tenth = Interval::point(0.1);
        let thirds = Interval::ONE / Interval::point(3.0);
        let results = [
            (tenth + Interval::point(0.2), exact(0.1) + exact(0.2)),
            (tenth * tenth, exact(0.1) * exact(0.1)),
            (thirds, exact(1.0) / exact(3.0)),
        ];
        for (found, value) in results {
            assert!(found.low < found.high && around(found, &value));
            assert!(!around(Interval { low: found.low.next_up(), high: found.high.next_down() }, &value), "as tight as it can be");
        }
    }

    #[test]
    fn what_is_exact_stays_exact_and_nan_is_never_positive() {
        assert_eq!(Interval::point(0.5) + Interval::point(0.25), Interval::point(0.75));
        assert_eq!(Interval::point(3.0) * Interval::point(-2.0), Interval::point(-6.0));
        assert_eq!(Interval::point(9.0).sqrt(), Interval::point(3.0));
        assert_eq!(Interval { low: -2.0, high: 1.0 }.square(), Interval { low: 0.0, high: 4.0 });
        let unknown = Interval::ONE / Interval { low: -1.0, high: 1.0 };
        assert_eq!((unknown.low, unknown.high), (f64::NEG_INFINITY, f64::INFINITY));
        assert!(!Interval::point(f64::NAN).is_positive() && !(Interval::point(f64::NAN) + Interval::ONE).is_positive());
        assert!(!(Interval::point(f64::INFINITY) - Interval::point(f64::INFINITY)).is_positive());
        assert!(Interval::point(f64::NAN).magnitude().is_nan());
    }
}
