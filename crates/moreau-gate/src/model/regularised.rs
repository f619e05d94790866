//! Friction of one contact under Drake's regularised laws, from the states around a step.
//!
//! ```text
//!     r_t = −μ r c(s/v_ε) u_t/s ,    s = ‖u_t‖ after the step
//!     n₀ = h k δ (1 − d v_n)₊        the normal impulse that the state before the step stands for
//!     Lagged     r = n₀             c sigmoid      v_ε = max(v_s, σ w μ n₀)
//!     Similar    r = r_n            c sigmoid      v_ε = max(v_s, σ w μ n₀)
//!     TAMSI      r = r_n            c parabola     v_ε = v_s
//! ```
//! r_n is the normal impulse of the step itself, w the mean diagonal of the contact's block and σ as in SAP.
//!
//! # Source
//! Castro et al., *Irrotational contact fields* (2023), §IV; Drake's `SapHuntCrossleyConstraint`.

use crate::Description;
use crate::model::Model;
use crate::model::creep::friction_curve;
use moreau_forms::drake_sap::TANGENTIAL_RATIO;
use moreau_forms::regularised_friction::FrictionCurve;
use nalgebra::Vector2;

/// A declared law of regularised friction whose approximation is known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Regularised {
    /// k \[N/m\].
    pub stiffness: f64,
    /// d \[s/m\].
    pub dissipation: f64,
    /// v_s \[m/s\].
    pub stiction_tolerance: f64,
    /// c.
    pub curve: FrictionCurve,
    /// Whether friction follows n₀.
    pub lagged: bool,
    /// μ.
    pub friction: f64,
    /// h \[s\].
    pub time_step: f64,
}

/// A contact before and after a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Foot {
    /// δ \[m\] before the step.
    pub depth: f64,
    /// v_n \[m/s\] before the step, positive when the contact opens.
    pub opening: f64,
    /// u_t \[m/s\] after the step.
    pub slip: Vector2<f64>,
    /// w \[1/kg\].
    pub diagonal_mean: f64,
}

impl Regularised {
    /// The law that is declared; `None` if it is another one or the option `approximation` does not name one.
    pub fn of(description: &Description, friction: f64, time_step: f64) -> Option<Self> {
        let Model::DrakeRegularised { stiffness, dissipation, stiction_tolerance } = Model::of(description) else { return None };
        let approximation = description.options.get("approximation").and_then(serde_json::Value::as_str)?;
        ["lagged", "similar", "tamsi"].contains(&approximation).then(|| Regularised {
            stiffness,
            dissipation,
            stiction_tolerance,
            curve: friction_curve(description),
            lagged: approximation == "lagged",
            friction,
            time_step,
        })
    }

    /// n₀ \[N·s\].
    pub fn explicit_normal(&self, foot: &Foot) -> f64 {
        self.time_step * self.stiffness * foot.depth.max(0.0) * (1.0 - self.dissipation * foot.opening).max(0.0)
    }

    /// r_t \[N·s\] of a contact with the normal impulse r_n \[N·s\] in this step.
    pub fn impulse(&self, foot: &Foot, normal: f64) -> Vector2<f64> {
        let slip = foot.slip.norm();
        if slip == 0.0 {
            return Vector2::zeros();
        }
        let explicit = self.explicit_normal(foot);
        let softened = match self.curve {
            FrictionCurve::Sigmoid => TANGENTIAL_RATIO * foot.diagonal_mean * self.friction * explicit,
            FrictionCurve::Parabola => 0.0,
        };
        let strength = self.curve.strength(slip / self.stiction_tolerance.max(softened));
        let full = self.friction * if self.lagged { explicit } else { normal };
        foot.slip * (-full * strength / slip)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The law of the stored scoreboard, with μ = 0.3.
    fn drake(curve: FrictionCurve, lagged: bool) -> Regularised {
        Regularised { stiffness: 1e5, dissipation: 50.0, stiction_tolerance: 1e-3, curve, lagged, friction: 0.3, time_step: 1e-3 }
    }

    /// w of a sphere on the floor, undeformed.
    fn mean() -> f64 {
        (1.0f64 + 2.0 * 3.5 * 3.5).sqrt() / 3.0
    }

    fn foot(slip: f64) -> Foot {
        // n₀ = h k δ (1 + d·2) with v_n = −2 m/s.
        Foot { depth: 5e-4, opening: -2.0, slip: Vector2::new(0.0, slip), diagonal_mean: mean() }
    }

    #[test]
    fn lagged_friction_follows_the_force_of_the_state_before_and_similar_that_of_the_step() {
        let explicit = 1e-3 * 1e5 * 5e-4 * 101.0;
        let [lagged, similar] = [true, false].map(|lagged| drake(FrictionCurve::Sigmoid, lagged).impulse(&foot(1e3), 1.0));
        assert!((lagged.y + 0.3 * explicit).abs() < 1e-9 * explicit, "{lagged}");
        assert!((similar.y + 0.3).abs() < 1e-9, "{similar}");
    }

    #[test]
    fn the_explicit_force_widens_the_stiction_tolerance() {
        // v_ε = σ w μ n₀ = 2.5e-3 m/s > v_s: half of the full friction at v_ε/√3.
        let law = drake(FrictionCurve::Sigmoid, true);
        let widened = TANGENTIAL_RATIO * mean() * 0.3 * law.explicit_normal(&foot(1.0));
        assert!(widened > 2.0 * law.stiction_tolerance);
        let half = law.impulse(&foot(widened / 3f64.sqrt()), 0.0).norm() / (0.3 * law.explicit_normal(&foot(1.0)));
        assert!((half - 0.5).abs() < 1e-12, "{half}");
        // A contact that opens faster than 1/d has no explicit force, and v_ε = v_s.
        let opening = Foot { opening: 0.1, ..foot(1e-3 / 3f64.sqrt()) };
        let similar = drake(FrictionCurve::Sigmoid, false).impulse(&opening, 2.0).norm();
        assert!((similar - 0.3).abs() < 1e-12, "{similar}");
    }

    /// A thrown sphere in Drake 1.51.1: h, w, n₀, the slip after the step and ‖r_t‖/(μ r) as it reports them, to five digits.
    #[test]
    fn drakes_own_steps_are_reproduced() {
        let steps = [
            (false, 1.0 / 60.0, 1.505_66, 2921.9, 1.946_8, 0.827_724),
            (false, 1.0 / 240.0, 1.614_85, 268.8, 1.438_9, 0.995_930),
            (true, 1.0 / 60.0, 1.505_66, 2921.9, 0.001_932_7, 0.001_464),
            (true, 1e-3, 1.677_02, 5.714_1, 0.002_586_4, 0.668_831),
        ];
        for (lagged, time_step, diagonal_mean, explicit, slip, strength) in steps {
            let law = Regularised { time_step, ..drake(FrictionCurve::Sigmoid, lagged) };
            let depth = explicit / (time_step * law.stiffness * (1.0 + 2.0 * law.dissipation));
            let foot = Foot { depth, opening: -2.0, slip: Vector2::new(slip, 0.0), diagonal_mean };
            let normal = 1.0;
            let found = law.impulse(&foot, normal).norm() / (law.friction * if lagged { explicit } else { normal });
            assert!((found / strength - 1.0).abs() < 5e-4, "{found} {strength}");
        }
    }

    #[test]
    fn tamsi_is_full_from_its_stiction_tolerance_on() {
        let law = drake(FrictionCurve::Parabola, false);
        assert_eq!(law.impulse(&foot(1e-3), 2.0), Vector2::new(0.0, -0.6));
        assert_eq!(law.impulse(&foot(0.0), 2.0), Vector2::zeros());
    }
}
