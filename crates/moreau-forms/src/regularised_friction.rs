//! Regularised Coulomb friction f_t = μ f_n c(s), s = v/v_s: at rest on a slope it creeps at the speed where c(s) = tan α/μ.
//!
//! ```text
//!     sigmoid    c(s) = s/√(1 + s²)                  s = ρ/√(1 − ρ²) ,     ρ = F_t/(μ F_n) < 1 ,
//!     parabola   c(s) = s (2 − s) for s < 1, else 1   s = 1 − √(1 − ρ) .
//! ```
//! v_s is the stiction tolerance \[m/s\]. The creep v_s s depends neither on the step nor on how contacts share the load.

/// How friction grows with the slip.
///
/// # Source
/// Drake's documentation of `DiscreteContactApproximation`: Similar and Lagged, TAMSI.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FrictionCurve {
    /// Similar and Lagged.
    Sigmoid,
    /// TAMSI.
    Parabola,
}

impl FrictionCurve {
    /// c(s), the part of the full friction that acts at a slip s ≥ 0 in units of v_s.
    pub fn strength(self, slip: f64) -> f64 {
        match self {
            FrictionCurve::Sigmoid => slip / (1.0 + slip * slip).sqrt(),
            FrictionCurve::Parabola if slip < 1.0 => slip * (2.0 - slip),
            FrictionCurve::Parabola => 1.0,
        }
    }

    /// s with c(s) = ρ, or `None` if no friction reaches ρ: the body slides.
    pub fn slip(self, ratio: f64) -> Option<f64> {
        let holds = (0.0..1.0).contains(&ratio);
        holds.then(|| match self {
            FrictionCurve::Sigmoid => ratio / (1.0 - ratio * ratio).sqrt(),
            FrictionCurve::Parabola => 1.0 - (1.0 - ratio).sqrt(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_exact::tolerance::rounding;

    #[test]
    fn the_slip_gives_the_friction_it_was_computed_from() {
        for curve in [FrictionCurve::Sigmoid, FrictionCurve::Parabola] {
            for k in 0..16 {
                let ratio = f64::from(k) / 16.0;
                let slip = curve.slip(ratio).expect("below the full friction");
                assert!((curve.strength(slip) - ratio).abs() <= rounding(8, 1.0), "{curve:?} at {ratio}");
            }
            assert_eq!(curve.slip(1.0), None);
            assert_eq!(curve.slip(f64::NAN), None);
        }
        assert_eq!(FrictionCurve::Parabola.strength(2.0), 1.0);
    }
}
