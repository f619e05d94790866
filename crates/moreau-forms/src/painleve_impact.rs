//! The impact of a sliding edge that friction sends to rest: one contact with two rows, u = W P + u⁻.
//!
//! ```text
//!     the edge lies at (−X, −Z) from the centre, moment of inertia I about it
//!     W_nn = 1/m + X²/I ,   W_nt = −X Z/I ,   W_tt = 1/m + Z²/I ,   μ_P = W_nn/|W_nt|
//!     u⁻ = (−w, −v) ,   u⁺ = 0 :     P = W⁻¹ (w, v) ,     inside the cone if  P_t ≤ μ P_n
//! ```
//! For w = 0 this is μ ≥ μ_P: a slide that no sliding force can carry on ends at once, by an impulse of size m v (impact without
//! collision).

/// A body of mass m \[kg\] whose edge slides towards the side it lies on.
///
/// # Source
/// Painlevé 1895; Génot and Brogliato 1999.
///
/// ```
/// use moreau_forms::SlidingEdge;
///
/// let edge = SlidingEdge { mass: 1.0, inertia: 1.0, arm: [1.0, 1.0] };
/// assert_eq!(edge.delassus(), [2.0, -1.0, 2.0]);
/// assert_eq!(edge.critical_friction(), 2.0); // from μ = 2 on no sliding force exists
/// assert_eq!(edge.stopping_impulse(0.0, 3.0), [1.0, 2.0]); // an impulse without any approach
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SlidingEdge {
    /// m \[kg\].
    pub mass: f64,
    /// I \[kg·m²\] about the centre.
    pub inertia: f64,
    /// (X, Z) \[m\]: how far the edge is behind and below the centre.
    pub arm: [f64; 2],
}

impl SlidingEdge {
    /// (W_nn, W_nt, W_tt) \[1/kg\].
    pub fn delassus(&self) -> [f64; 3] {
        let [x, z] = self.arm;
        [1.0 / self.mass + x * x / self.inertia, -x * z / self.inertia, 1.0 / self.mass + z * z / self.inertia]
    }

    /// μ_P = W_nn/|W_nt|, from which on no sliding force exists.
    pub fn critical_friction(&self) -> f64 {
        let [normal, mixed, _] = self.delassus();
        normal / mixed.abs()
    }

    /// (P_n, P_t) \[N·s\] that stop an edge that approaches at w and slides at v \[m/s\].
    pub fn stopping_impulse(&self, approach: f64, slide: f64) -> [f64; 2] {
        let [normal, mixed, tangential] = self.delassus();
        let determinant = normal * tangential - mixed * mixed;
        [(tangential * approach - mixed * slide) / determinant, (normal * slide - mixed * approach) / determinant]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_exact::tolerance::rounding;

    /// The uniform rod of `mechanics::painleve_rod`, cos θ = 3/5: X = 3/5, Z = 4/5, I = 1/3.
    const ROD: SlidingEdge = SlidingEdge { mass: 1.0, inertia: 1.0 / 3.0, arm: [0.6, 0.8] };

    #[test]
    fn the_rod_has_its_known_threshold_and_atom() {
        assert!((ROD.critical_friction() - 13.0 / 9.0).abs() <= rounding(8, 2.0));
        // P = (3 s c/4, (1 + 3 c²)/4) m v.
        let [normal, tangential] = ROD.stopping_impulse(0.0, 1.0);
        assert!((normal - 0.36).abs() <= rounding(16, 1.0) && (tangential - 0.52).abs() <= rounding(16, 1.0));
    }

    #[test]
    fn the_impulse_stops_the_edge() {
        let [normal, mixed, tangential] = ROD.delassus();
        let [p, q] = ROD.stopping_impulse(0.5, 2.0);
        assert!((normal * p + mixed * q - 0.5).abs() <= rounding(16, 4.0) && (mixed * p + tangential * q - 2.0).abs() <= rounding(16, 4.0));
    }
}
