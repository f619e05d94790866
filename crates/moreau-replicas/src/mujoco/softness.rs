//! One soft contact of MuJoCo: its regularisation R and its reference acceleration a_ref from `solref`, `solimp`, `margin` and `impratio`.
//!
//! ```text
//!     x = |φ − margin|/width ,   d = d₀ + y(x)(d_w − d₀) ,   y = xᵖ/mᵖ⁻¹ (x ≤ m) ,  1 − (1−x)ᵖ/(1−m)ᵖ⁻¹ ,  1 (x ≥ 1)
//!     solref = (t_c, ζ):   k = 1/(d_w t_c ζ)² ,  b = 2/(d_w t_c) ,  t_c ≥ 2h (refsafe)          (−s, −c):   k = s/d_w² ,  b = c/d_w
//!     a_ref,n = −b u_n − k d (φ − margin) ,     a_ref,j = −b u_j
//!     elliptic    R_n = (1−d)/d·Â ,   R_1 = R_n/impratio ,   R_j = R_1 μ₁²/μ_j²
//!     pyramidal   R of every edge = 2 μ₁²/impratio · (1−d)/d · (1 + μ₁²) Â
//! ```
//! φ is the gap \[m\], u the contact velocity \[m/s\], Â \[1/kg\] the sum of the two bodies' inverse masses, which stands for the diagonal
//! of the Delassus operator. An edge n ± μ_j t_j has the reference acceleration a_ref,n ± μ_j a_ref,j. The units of u_j, μ_j and R_j are
//! those of a rotation for torsion and rolling: rad/s, m and 1/(kg·m²).

use moreau_exact::{Error, Result};

/// `solref`, `solimp`, `margin` and `impratio` of every contact.
///
/// # Source
/// MuJoCo documentation, *Computation: constraint model* and *Modeling: solver parameters* (3.17).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Softness {
    /// `solref`: (time constant \[s\], damping ratio), or (−stiffness \[1/s²\], −damping \[1/s\]).
    pub reference: [f64; 2],
    /// `solimp`: d₀, d_w, width \[m\], midpoint, power.
    pub impedance: [f64; 5],
    /// `margin`: contacts with a smaller gap are active \[m\].
    pub margin: f64,
    /// `impratio`, R_n/R_1.
    pub impedance_ratio: f64,
    /// Whether the time constant is at least two steps, as MuJoCo's flag `refsafe` has it.
    pub safe_reference: bool,
}

/// Smallest and largest impedance (`mjMINIMP`, `mjMAXIMP`).
const IMPEDANCE: [f64; 2] = [0.0001, 0.9999];

impl Default for Softness {
    /// [`Softness::STANDARD`].
    fn default() -> Self {
        Softness::STANDARD
    }
}

impl Softness {
    /// MuJoCo's defaults.
    pub const STANDARD: Softness = Softness {
        reference: [0.02, 1.0],
        impedance: [0.9, 0.95, 0.001, 0.5, 2.0],
        margin: 0.0,
        impedance_ratio: 1.0,
        safe_reference: true,
    };

    /// Checks signs and sizes.
    ///
    /// # Errors
    /// [`Error::Invalid`] names the number that is not valid.
    pub fn validate(&self) -> Result<()> {
        let invalid = |field: &str, given: String, cure: &str| Err(Error::invalid(field, given, cure));
        let [first, second] = self.reference;
        if !(first.is_finite() && second.is_finite() && first != 0.0 && (if first > 0.0 { second > 0.0 } else { second <= 0.0 })) {
            return invalid("solref", format!("is {:?}", self.reference), "use two positive numbers, or −stiffness < 0 and −damping ≤ 0");
        }
        let [_, _, width, midpoint, power] = self.impedance;
        let shares = [self.impedance[0], self.impedance[1], midpoint];
        if !(shares.iter().all(|share| (0.0..=1.0).contains(share)) && width >= 0.0 && power >= 1.0 && (width + power).is_finite()) {
            return invalid(
                "solimp",
                format!("is {:?}", self.impedance),
                "use d₀, d_w and the midpoint in [0, 1], a width ≥ 0 m, a power ≥ 1",
            );
        }
        if !(self.impedance_ratio > 0.0 && self.impedance_ratio.is_finite()) {
            return invalid("impratio", format!("is {}", self.impedance_ratio), "use a positive number");
        }
        if !self.margin.is_finite() {
            return invalid("margin", format!("is {}", self.margin), "use a length");
        }
        Ok(())
    }

    /// d at a gap.
    pub fn impedance_at(&self, gap: f64) -> f64 {
        let [start, end, width, midpoint, power] = self.impedance;
        let [start, end, midpoint] = [start, end, midpoint].map(limited);
        if start == end || width <= 0.0 {
            return 0.5 * (start + end);
        }
        let (x, power) = (((gap - self.margin) / width).abs(), power.max(1.0));
        let rise = if x >= 1.0 {
            1.0
        } else if x <= midpoint {
            x.powf(power) / midpoint.powf(power - 1.0)
        } else {
            1.0 - (1.0 - x).powf(power) / (1.0 - midpoint).powf(power - 1.0)
        };
        start + rise * (end - start)
    }

    /// k \[1/s²\] and b \[1/s\] at a step h \[s\].
    ///
    /// ```
    /// use moreau_replicas::mujoco::Softness;
    ///
    /// let soft = Softness::STANDARD; // t_c = 0.02 s
    /// assert_eq!(soft.stiffness_and_damping(0.001), soft.stiffness_and_damping(0.01));
    /// let [fine, coarse] = [0.01, 0.02].map(|h| soft.stiffness_and_damping(h)[0]);
    /// assert!((fine / coarse - 4.0).abs() < 1e-12); // beyond h = t_c/2 `refsafe` softens the contact
    /// ```
    pub fn stiffness_and_damping(&self, h: f64) -> [f64; 2] {
        let end = limited(self.impedance[1]);
        let [first, second] = self.reference;
        let time = if self.safe_reference { first.max(2.0 * h) } else { first };
        let stiffness = if first > 0.0 { 1.0 / (end * time * second).powi(2) } else { -first / (end * end) };
        let damping = if second > 0.0 { 2.0 / (end * time) } else { -second / end };
        [stiffness, damping]
    }

    /// a_ref of the rows (n, t₁, t₂, …) at a gap and contact velocity \[m/s²\].
    pub fn reference_acceleration(&self, h: f64, gap: f64, velocity: &[f64]) -> Vec<f64> {
        let [stiffness, damping] = self.stiffness_and_damping(h);
        let mut reference: Vec<f64> = velocity.iter().map(|u| -damping * u).collect();
        reference[0] -= stiffness * self.impedance_at(gap) * (gap - self.margin);
        reference
    }

    /// R of the rows (n, t₁, t₂, …) of an elliptic or frictionless contact with one μ_j > 0 per tangential row.
    pub fn elliptic(&self, gap: f64, inverse_mass: f64, friction: &[f64]) -> Vec<f64> {
        let normal = self.regularisation(gap, inverse_mass);
        let first = normal / self.impedance_ratio;
        let tangential = friction.iter().map(|mu| first * (friction[0] / mu).powi(2));
        std::iter::once(normal).chain(tangential).collect()
    }

    /// R of every edge of a pyramid with the sliding coefficient μ₁ > 0.
    pub fn pyramidal(&self, gap: f64, inverse_mass: f64, friction: f64) -> f64 {
        let square = friction * friction;
        2.0 * square / self.impedance_ratio * self.regularisation(gap, (1.0 + square) * inverse_mass)
    }

    /// (1−d)/d·Â.
    fn regularisation(&self, gap: f64, diagonal: f64) -> f64 {
        let d = self.impedance_at(gap);
        (1.0 - d) / d * diagonal
    }
}

fn limited(value: f64) -> f64 {
    value.clamp(IMPEDANCE[0], IMPEDANCE[1])
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_exact::tolerance::rounding;
    use moreau_forms::mujoco_contact::ContactParameters;

    #[test]
    fn rows_are_those_of_the_closed_forms_at_rest_and_in_motion() {
        for (reference, impedance) in [([0.02, 1.0], [0.9, 0.95, 0.001, 0.5, 2.0]), ([-2500.0, -80.0], [0.2, 0.8, 0.01, 0.3, 3.0])] {
            let softness = Softness { reference, impedance, impedance_ratio: 4.0, ..Softness::default() };
            let form = ContactParameters { reference, impedance, impedance_ratio: 4.0 };
            for gap in [-1e-5, -4e-4, -2e-3, -0.02] {
                let (k, b) = form.stiffness_and_damping(0.001);
                let a = softness.reference_acceleration(0.001, gap, &[0.3, -0.4]);
                let expected = [-b * 0.3 - k * form.impedance_at(-gap) * gap, b * 0.4];
                let r = softness.elliptic(gap, 0.5, &[0.6, 0.6]);
                let edge = softness.pyramidal(gap, 0.5, 0.6);
                let normal = form.normal_regularisation(-gap, 0.5);
                let pairs = [(a[0], expected[0]), (a[1], expected[1]), (r[0], normal), (r[1], normal / 4.0), (r[2], normal / 4.0)];
                assert!(pairs.iter().all(|(a, b)| (a - b).abs() <= rounding(16, b.abs())), "{pairs:?}");
                let closed = form.normal_regularisation(-gap, form.pyramid_diagonal(0.5, 0.6));
                assert!((edge - closed).abs() <= rounding(16, closed), "{edge} {closed}");
            }
        }
    }

    #[test]
    fn the_margin_moves_the_surface() {
        let moved = Softness { margin: 0.01, ..Softness::default() };
        let plain = Softness::default();
        assert!((moved.impedance_at(0.0096) - plain.impedance_at(-0.0004)).abs() <= rounding(64, 1.0));
        assert!(moved.reference_acceleration(0.001, 0.0, &[0.0])[0] > 0.0 && plain.reference_acceleration(0.001, 0.0, &[0.0])[0] == 0.0);
    }

    #[test]
    fn the_time_constant_is_two_steps_at_least_unless_told_otherwise() {
        let safe = Softness::default();
        let unsafe_ = Softness { safe_reference: false, ..safe };
        assert_eq!(safe.stiffness_and_damping(0.02)[1], 2.0 / (0.95 * 0.04));
        assert_eq!(unsafe_.stiffness_and_damping(0.02)[1], 2.0 / (0.95 * 0.02));
    }

    #[test]
    fn torsion_has_the_regularisation_that_makes_the_scaled_cone_round() {
        let r = Softness::default().elliptic(-1e-3, 1.0, &[0.5, 0.5, 0.02]);
        assert!((r[3] * 0.02 * 0.02 - r[1] * 0.25).abs() <= rounding(8, r[1]));
    }
}
