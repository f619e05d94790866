//! MuJoCo's impedance of a soft constraint as a function of the violation δ ≥ 0, in any ordered field.
//!
//! ```text
//!     x = δ/w ,   y = 0 (x ≤ 0) ,   xᵖ/mᵖ⁻¹ (x ≤ m) ,   1 − (1−x)ᵖ/(1−m)ᵖ⁻¹ (m ≤ x ≤ 1) ,   1 (x ≥ 1) ;      d = d₀ + y (d_w − d₀)
//! ```
//! The slopes p x^{p−1}/m^{p−1} and p (1−x)^{p−1}/(1−m)^{p−1} meet at x = m, where both are p: d is continuously differentiable for p > 1.
//! d₀, d_w and m are first moved into \[10⁻⁴, 1 − 10⁻⁴\], so that d → 0 and d → 1 are never reached. Without a width d is the mean (d₀ +
//! d_w)/2.

use moreau_exact::scalar::{Rational, Scalar};
use moreau_exact::witness::{Part, Witness, decided, rational};

/// `solimp` with a natural power: d₀, d_w, width \[m\], midpoint, power.
///
/// # Source
/// MuJoCo documentation, *Modeling: solver parameters* (3.17).
#[derive(Clone, Debug, PartialEq)]
pub struct SoftImpedance<T> {
    /// d₀, at the surface.
    pub start: T,
    /// d_w, beyond the width.
    pub end: T,
    /// w ≥ 0 \[m\].
    pub width: T,
    /// m, of the width.
    pub midpoint: T,
    /// p ≥ 1.
    pub power: u32,
}

impl<T: Scalar> SoftImpedance<T> {
    /// MuJoCo's default, (9/10, 19/20, 1 mm, 1/2, 2).
    pub fn standard() -> Self {
        let [start, end] = [T::ratio(9, 10), T::ratio(19, 20)];
        SoftImpedance { start, end, width: T::ratio(1, 1000), midpoint: T::ratio(1, 2), power: 2 }
    }

    /// The same impedance d at every depth.
    pub fn constant(value: T) -> Self {
        SoftImpedance { start: value.clone(), end: value, ..Self::standard() }
    }

    /// d at a violation δ \[m\].
    pub fn at(&self, violation: &T) -> T {
        decided(
            || self.along_the_curve(violation),
            |found| {
                let of = |number: &T| rational::<T, Rational>(number).cloned();
                let data = [&self.start, &self.end, &self.width, &self.midpoint, violation].map(of);
                let data = data.into_iter().collect::<Option<Vec<_>>>()?;
                let power = Part::Counts(vec![self.power as usize]);
                Some(Witness::new("impedance", vec![("data", Part::Vector(data)), ("power", power), ("value", Part::Number(of(found)?))]))
            },
        )
    }

    fn along_the_curve(&self, violation: &T) -> T {
        let [start, end] = [limited(&self.start), limited(&self.end)];
        if self.width <= T::zero() {
            return (start + end) / T::ratio(2, 1);
        }
        start.clone() + self.share(violation) * (end - start)
    }

    /// d_w as it is used.
    pub fn at_width(&self) -> T {
        limited(&self.end)
    }

    /// y in \[0, 1\].
    fn share(&self, violation: &T) -> T {
        let (x, m) = (violation.clone() / self.width.clone(), limited(&self.midpoint));
        let power = |base: T, n: u32| (0..n).fold(T::one(), |product, _| product * base.clone());
        if x <= T::zero() {
            T::zero()
        } else if x >= T::one() {
            T::one()
        } else if x <= m {
            power(x, self.power) / power(m, self.power - 1)
        } else {
            T::one() - power(T::one() - x, self.power) / power(T::one() - m, self.power - 1)
        }
    }
}

/// The nearest number in [10⁻⁴, 1 − 10⁻⁴].
fn limited<T: Scalar>(value: &T) -> T {
    let [low, high] = [T::ratio(1, 10_000), T::ratio(9999, 10_000)];
    if *value < low {
        low
    } else if *value > high {
        high
    } else {
        value.clone()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mujoco_contact::ContactParameters;
    use moreau_exact::scalar::{Dual, Rational, ratio};
    use moreau_exact::tolerance::rounding;

    fn rubber() -> SoftImpedance<Rational> {
        SoftImpedance { start: ratio(1, 5), end: ratio(4, 5), width: ratio(1, 100), midpoint: ratio(3, 10), power: 3 }
    }

    #[test]
    fn the_curve_in_rationals_is_that_of_the_rounded_formula() {
        let parameters = ContactParameters { impedance: [0.2, 0.8, 0.01, 0.3, 3.0], ..Default::default() };
        for thousandth in 0..14 {
            let curve = Scalar::to_f64(&rubber().at(&ratio(thousandth, 1000)));
            let rounded = parameters.impedance_at(thousandth as f64 / 1000.0);
            assert!((curve - rounded).abs() <= rounding(32, 1.0), "{thousandth} mm: {curve} {rounded}");
        }
    }

    #[test]
    fn outside_its_limits_and_without_width_the_curve_is_what_mujoco_3_17_reports() {
        // efc_KBIP[2] of a sphere 0.2 mm in the floor: 0.076092, 0.080084 and 0.5
        let at = |start, end, width| {
            let curve = SoftImpedance { start, end, width, ..SoftImpedance::<Rational>::standard() };
            curve.at(&ratio(1, 5000))
        };
        assert_eq!(at(ratio(0, 1), ratio(19, 20), ratio(1, 1000)), ratio(76_092, 1_000_000));
        assert_eq!(at(ratio(0, 1), ratio(1, 1), ratio(1, 1000)), ratio(80_084, 1_000_000));
        assert_eq!(at(ratio(1, 5), ratio(4, 5), ratio(0, 1)), ratio(1, 2));
    }

    #[test]
    fn both_branches_have_value_and_slope_of_the_midpoint() {
        let at = |slope: i64| {
            let lift = |x: Rational| Dual::constant(x);
            let SoftImpedance { start, end, width, midpoint, power } = rubber();
            let curve = SoftImpedance { start: lift(start), end: lift(end), width: lift(width), midpoint: lift(midpoint), power };
            curve.at(&Dual { value: ratio(3, 1000), slope: ratio(slope, 1) })
        };
        // y = m = 3/10 and dy/dx = p = 3, dx/dδ = 100/m
        assert_eq!(at(1).value, ratio(1, 5) + ratio(3, 10) * ratio(3, 5));
        assert_eq!([at(1).slope, at(-1).slope], [ratio(180, 1), ratio(-180, 1)]);
    }
}
