//! The reference acceleration of MuJoCo's soft constraint, in any ordered field: gap φ \[m\], violated while negative, and its rate v = φ̇
//! \[m/s\].
//!
//! ```text
//!     a_ref = −b v − k d(δ) φ ,    δ = −φ ;        time constant and ratio:   b = 2/(d_w t_c) ,   k = 1/(d_w t_c ζ)² ,   t_c ≥ 2h
//!                                                  −stiffness and −damping:   b = c/d_w ,         k = s/d_w²
//! ```
//! A row with R = (1−d)/d·A that carries no other load moves with d a_ref: φ̈ = −d b v − d² k φ. Where d = d_w, that is ω₀ = 1/(t_c ζ) with
//! the damping ratio ζ, and stiffness s and damping c per mass.

use super::soft_impedance::SoftImpedance;
use moreau_exact::scalar::Scalar;

/// k \[1/s²\] and b \[1/s\] with the impedance they are scaled by.
///
/// # Source
/// MuJoCo documentation, *Modeling: solver parameters* (3.17).
#[derive(Clone, Debug, PartialEq)]
pub struct SoftReference<T> {
    /// k \[1/s²\].
    pub stiffness: T,
    /// b \[1/s\].
    pub damping: T,
    /// d(δ).
    pub impedance: SoftImpedance<T>,
}

impl<T: Scalar> SoftReference<T> {
    /// `solref` = (t_c, ζ) without a limit on t_c.
    pub fn unlimited(time_constant: &T, damping_ratio: &T, impedance: SoftImpedance<T>) -> Self {
        let time = impedance.at_width() * time_constant.clone();
        let period = time.clone() * damping_ratio.clone();
        SoftReference { stiffness: T::one() / (period.clone() * period), damping: T::ratio(2, 1) / time, impedance }
    }

    /// `solref` = (t_c, ζ) at a step h \[s\] with `refsafe`, MuJoCo's default: t_c is at least 2h.
    pub fn limited(time_constant: &T, damping_ratio: &T, h: &T, impedance: SoftImpedance<T>) -> Self {
        let least = T::ratio(2, 1) * h.clone();
        let time_constant = if *time_constant < least { least } else { time_constant.clone() };
        Self::unlimited(&time_constant, damping_ratio, impedance)
    }

    /// `solref` = (−s, −c): stiffness s \[1/s²\] and damping c \[1/s\] per mass.
    pub fn direct(stiffness: &T, damping: &T, impedance: SoftImpedance<T>) -> Self {
        let end = impedance.at_width();
        SoftReference { stiffness: stiffness.clone() / (end.clone() * end.clone()), damping: damping.clone() / end, impedance }
    }

    /// k d(δ) and b: what multiplies −φ and −φ̇ in a_ref \[1/s², 1/s\].
    pub fn coefficients(&self, violation: &T) -> [T; 2] {
        [self.stiffness.clone() * self.impedance.at(violation), self.damping.clone()]
    }

    /// d² k and d b: what multiplies −φ and −φ̇ in the motion of an unloaded row \[1/s², 1/s\].
    pub fn effective(&self, violation: &T) -> [T; 2] {
        let d = self.impedance.at(violation);
        self.coefficients(violation).map(|coefficient| coefficient * d.clone())
    }

    /// a_ref \[m/s²\] at the gap φ \[m\] and its rate \[m/s\].
    pub fn acceleration(&self, gap: &T, rate: &T) -> T {
        let [stiffness, damping] = self.coefficients(&-gap.clone());
        -(stiffness * gap.clone()) - damping * rate.clone()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mujoco_contact::ContactParameters;
    use moreau_exact::scalar::{Rational, ratio};
    use moreau_exact::tolerance::rounding;

    #[test]
    fn both_signs_of_solref_give_the_coefficients_of_the_rounded_formula() {
        let standard = || SoftImpedance::<Rational>::standard();
        let h = ratio(1, 500);
        let cases = [
            ([0.02, 1.0], SoftReference::limited(&ratio(1, 50), &ratio(1, 1), &h, standard())),
            ([0.001, 0.5], SoftReference::limited(&ratio(1, 1000), &ratio(1, 2), &h, standard())),
            ([-2500.0, -100.0], SoftReference::direct(&ratio(2500, 1), &ratio(100, 1), standard())),
        ];
        for (reference, exact) in cases {
            let (stiffness, damping) = ContactParameters { reference, ..Default::default() }.stiffness_and_damping(0.002);
            let (k, b) = (Scalar::to_f64(&exact.stiffness), Scalar::to_f64(&exact.damping));
            assert!((stiffness - k).abs() <= rounding(8, k) && (damping - b).abs() <= rounding(8, b), "{reference:?}");
        }
    }

    #[test]
    fn the_time_constant_form_and_the_direct_form_mean_the_same_oscillator() {
        let standard = || SoftImpedance::<Rational>::standard();
        let by_time = SoftReference::unlimited(&ratio(1, 50), &ratio(1, 1), standard());
        assert_eq!(by_time, SoftReference::direct(&ratio(2500, 1), &ratio(100, 1), standard()));
        assert_eq!(by_time.effective(&ratio(1, 500)), [ratio(2500, 1), ratio(100, 1)]);
    }
}
