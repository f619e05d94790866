//! One elliptic contact of MuJoCo at rest: R f + A f + a₀ − a_ref = 0 with a₀ + A f = 0, so R f = a_ref.
//!
//! ```text
//!     normal      R_n f_n = k d δ ,   R_n = (1 − d)/d · Â   ⇒   k d² δ = (1 − d) Â f_n     (rest depth δ) ,
//!     tangential  R_t f_t = b v_t ,   R_t = R_n/impratio    ⇒   v_t = R_t f_t/b           (creep) .
//! ```
//! The impedance d(δ) rises from d₀ to d_w over `width`. Neither δ nor v_t depends on the step.

use moreau_exact::{Error, Result};

/// `solref` \[time constant s, damping ratio\] or negative \[−stiffness, −damping\], and `solimp`.
///
/// # Source
/// MuJoCo documentation, *Computation: constraint model* and *Modeling: solver parameters* (3.17).
///
/// ```
/// use moreau_forms::mujoco_contact::ContactParameters;
///
/// let defaults = ContactParameters::default();
/// let depth = defaults.rest_depth(0.001, 1.0, 9.81)?; // h, 1/m, m g: a ball of 1 kg
/// assert!((depth - 3.6718184e-4).abs() < 1e-11); // as measured in MuJoCo 3.17.0
/// let creep = |impratio| ContactParameters { impedance_ratio: impratio, ..defaults }.creep_speed(0.001, 1.0, 9.81, 1.0);
/// assert!((creep(1.0)? / creep(10.0)? - 10.0).abs() < 1e-9); // creep is inverse to `impratio`
/// # Ok::<(), moreau_exact::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactParameters {
    /// `solref`.
    pub reference: [f64; 2],
    /// `solimp`: d₀, d_w, width \[m\], midpoint, power.
    pub impedance: [f64; 5],
    /// `impratio`, R_n/R_t.
    pub impedance_ratio: f64,
}

impl Default for ContactParameters {
    /// MuJoCo's defaults.
    fn default() -> Self {
        ContactParameters { reference: [0.02, 1.0], impedance: [0.9, 0.95, 0.001, 0.5, 2.0], impedance_ratio: 1.0 }
    }
}

/// Smallest and largest impedance MuJoCo allows (`mjMINIMP`, `mjMAXIMP`).
const IMPEDANCE_LIMITS: [f64; 2] = [0.0001, 0.9999];

impl ContactParameters {
    /// d(δ) at a depth δ ≥ 0 below the margin.
    pub fn impedance_at(&self, depth: f64) -> f64 {
        let [start, end, width, midpoint, power] = self.impedance;
        let [start, end, midpoint] = [start, end, midpoint].map(|value| value.clamp(IMPEDANCE_LIMITS[0], IMPEDANCE_LIMITS[1]));
        if width <= 0.0 {
            return 0.5 * (start + end);
        }
        let x = (depth / width).clamp(0.0, 1.0);
        let y = if power == 1.0 {
            x
        } else if x <= midpoint {
            x.powf(power) / midpoint.powf(power - 1.0)
        } else {
            1.0 - (1.0 - x).powf(power) / (1.0 - midpoint).powf(power - 1.0)
        };
        start + y * (end - start)
    }

    /// k \[1/s²\] and b \[1/s\] at a step h: 1/(d_w²t_c²ζ²) and 2/(d_w t_c) with t_c ≥ 2h, or −`solref`/(d_w², d_w).
    pub fn stiffness_and_damping(&self, h: f64) -> (f64, f64) {
        let width_impedance = self.impedance[1].clamp(IMPEDANCE_LIMITS[0], IMPEDANCE_LIMITS[1]);
        let [first, second] = self.reference;
        if first > 0.0 {
            let time_constant = first.max(2.0 * h);
            let frequency = width_impedance * time_constant * second;
            (1.0 / (frequency * frequency), 2.0 / (width_impedance * time_constant))
        } else {
            (-first / (width_impedance * width_impedance), -second / width_impedance)
        }
    }

    /// R_n = (1 − d)/d · Â \[1/kg\] at a depth, Â the diagonal approximation (1/m for one free body).
    pub fn normal_regularisation(&self, depth: f64, diagonal: f64) -> f64 {
        let d = self.impedance_at(depth);
        (1.0 - d) / d * diagonal
    }

    /// Â of one edge of a four-edge pyramid, 2 μ² (1 + μ²) Â_n/impratio \[1/kg\], from the Â_n of the normal row.
    pub fn pyramid_diagonal(&self, diagonal: f64, friction: f64) -> f64 {
        2.0 * friction * friction * (1.0 + friction * friction) * diagonal / self.impedance_ratio
    }

    /// The depth δ \[m\] below the margin at which k d² δ = (1 − d) Â f_n for a normal force f_n \[N\].
    ///
    /// The left side rises and the right side falls with δ (d does not decrease), so the root is unique; bisection down
    /// to neighbouring floats.
    ///
    /// # Errors
    /// If Â, f_n or k is not positive and finite.
    pub fn rest_depth(&self, h: f64, diagonal: f64, normal_force: f64) -> Result<f64> {
        let (stiffness, _) = self.stiffness_and_damping(h);
        for (field, value) in [("diagonal", diagonal), ("normal_force", normal_force), ("solref", stiffness)] {
            if !(value.is_finite() && value > 0.0) {
                return Err(Error::invalid(field, format!("gives {value}"), "use a positive number"));
            }
        }
        let excess = |depth: f64| {
            let d = self.impedance_at(depth);
            stiffness * d * d * depth - (1.0 - d) * diagonal * normal_force
        };
        // d ≥ d_min bounds the root: k d_min² δ ≤ Â f_n.
        let (mut low, mut high) = (0.0, diagonal * normal_force / (stiffness * IMPEDANCE_LIMITS[0] * IMPEDANCE_LIMITS[0]));
        loop {
            let middle = 0.5 * (low + high);
            if middle <= low || middle >= high {
                return Ok(middle);
            }
            if excess(middle) > 0.0 { high = middle } else { low = middle }
        }
    }

    /// v_t = R_t f_t/b \[m/s\], the speed at which a loaded contact creeps, at the rest depth under f_n.
    ///
    /// # Errors
    /// Those of [`ContactParameters::rest_depth`].
    pub fn creep_speed(&self, h: f64, diagonal: f64, normal_force: f64, tangential_force: f64) -> Result<f64> {
        let depth = self.rest_depth(h, diagonal, normal_force)?;
        let (_, damping) = self.stiffness_and_damping(h);
        Ok(self.normal_regularisation(depth, diagonal) / self.impedance_ratio * tangential_force / damping)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::soft_impedance::SoftImpedance;
    use crate::tolerance::PRINTED_DIGITS;
    use moreau_exact::scalar::{Rational, Scalar, ratio};

    #[test]
    fn rest_depth_of_one_kilogram_is_the_documented_number() {
        let depth = ContactParameters::default().rest_depth(1e-3, 1.0, 9.81).expect("positive");
        assert!((depth - 3.671818e-4).abs() <= PRINTED_DIGITS * 3.671818e-4, "{depth:e}");
    }

    #[test]
    fn at_the_rest_depth_the_regularised_force_balances_the_reference_acceleration() {
        for reference in [[0.02, 1.0], [0.05, 0.3], [-2000.0, -50.0]] {
            let parameters = ContactParameters { reference, ..Default::default() };
            let (mass, force) = (2.5, 20.0);
            let depth = parameters.rest_depth(1e-3, 1.0 / mass, force).expect("positive");
            let (stiffness, _) = parameters.stiffness_and_damping(1e-3);
            let reference_acceleration = stiffness * parameters.impedance_at(depth) * depth;
            let regularised = parameters.normal_regularisation(depth, 1.0 / mass) * force;
            assert!((reference_acceleration - regularised).abs() <= PRINTED_DIGITS * regularised);
        }
    }

    #[test]
    fn the_impedance_is_continuous_at_its_midpoint_and_constant_beyond_its_width() {
        let parameters = ContactParameters { impedance: [0.2, 0.8, 0.01, 0.3, 3.0], ..Default::default() };
        let [below, above] = [0.003 - 1e-12, 0.003 + 1e-12].map(|depth| parameters.impedance_at(depth));
        assert!((above - below).abs() <= 1e-9);
        assert_eq!(parameters.impedance_at(0.0), 0.2);
        // Beyond the midpoint 3/10 at x = 1/2: y = 1 − (1/2)³/(7/10)² = 365/490, d = 0.2 + 0.6 y.
        assert!((parameters.impedance_at(0.005) - (0.2 + 0.6 * 365.0 / 490.0)).abs() <= moreau_exact::tolerance::rounding(8, 1.0));
        assert_eq!(parameters.impedance_at(0.01), parameters.impedance_at(1.0));
    }

    #[test]
    fn outside_its_limits_and_without_width_the_impedance_is_what_mujoco_3_17_reports() {
        let at = |start, end, width| {
            ContactParameters { impedance: [start, end, width, 0.5, 2.0], ..ContactParameters::default() }.impedance_at(0.0002)
        };
        assert!((at(0.0, 0.95, 0.001) - 0.076092).abs() <= moreau_exact::tolerance::rounding(8, 1.0));
        assert!((at(0.0, 1.0, 0.001) - 0.080084).abs() <= moreau_exact::tolerance::rounding(8, 1.0));
        assert_eq!(at(0.2, 0.8, 0.0), 0.5);
    }

    #[test]
    fn the_midpoint_is_limited_as_the_curve_in_rationals_limits_it() {
        for midpoint in [0, 1] {
            let curve = SoftImpedance { midpoint: ratio(midpoint, 1), ..SoftImpedance::<Rational>::standard() };
            let solimp = [0.9, 0.95, 0.001, midpoint as f64, 2.0];
            for depth in [1, 5, 9] {
                let rounded = ContactParameters { impedance: solimp, ..ContactParameters::default() }.impedance_at(f64::from(depth) / 1e4);
                let exact = Scalar::to_f64(&curve.at(&ratio(i64::from(depth), 10_000)));
                assert!((rounded - exact).abs() <= moreau_exact::tolerance::rounding(16, 1.0), "{midpoint} {depth}");
            }
        }
    }

    #[test]
    fn creep_does_not_depend_on_the_step_until_the_time_constant_is_limited() {
        let parameters = ContactParameters::default();
        let creep = |h: f64| parameters.creep_speed(h, 1.0, 9.2, 3.4).expect("positive");
        assert_eq!(creep(1e-3), creep(1e-2));
        assert_ne!(creep(1e-3), creep(2e-2));
    }

    #[test]
    fn creep_falls_with_the_impedance_ratio() {
        let creep = |impedance_ratio: f64| {
            let parameters = ContactParameters { impedance_ratio, ..Default::default() };
            parameters.creep_speed(1e-3, 1.0, 9.2, 3.4).expect("positive")
        };
        assert!((creep(1.0) / creep(10.0) - 10.0).abs() <= PRINTED_DIGITS);
    }

    #[test]
    fn a_contact_without_load_or_stiffness_has_no_rest_depth() {
        assert!(ContactParameters::default().rest_depth(1e-3, 1.0, 0.0).is_err());
        let slack = ContactParameters { reference: [0.0, 0.0], ..Default::default() };
        assert!(slack.rest_depth(1e-3, 1.0, 9.81).is_err());
    }
}
