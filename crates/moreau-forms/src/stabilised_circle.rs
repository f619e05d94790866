//! A point on a circle of radius R at the speed v without load, stepped at velocity level and stabilised: what is left of its energy.
//!
//! With w = hv/R, L the angular momentum per mass and tan Δ = w the angle of a step:
//! ```text
//!     projection, and Gear–Gupta–Leimkuhler    w⁺ = w cos Δ = w/√(1 + w²) ,   1/w² grows by 1 per step:   Eₙ/E₀ = 1/(1 + n w²)
//!     no stabilisation                         impulses point to the centre, L stays:   r⁺² = r² + h²L²/r² ,   |v⁺| = L/r
//!     bias −ERP g/h                            L stays;  r⁺² = (r − ERP δ)² + h²L²/r² ,   δ = r − R ,   with a steady state
//! ```
//! So projection takes energy for ever, by n w² in n steps, and the bias settles at δ ≈ h²v²/(2 ERP R) and then takes none.

/// Eₙ/E₀ after n steps with projection; w = hv/R of the first step.
pub fn projected_energy(w: f64, steps: usize) -> f64 {
    1.0 / (1.0 + steps as f64 * w * w)
}

/// δ/R of the steady state under the bias: the root x > 0 of 2 ERP x (1+x) − ERP² x² = w²/(1+x)².
///
/// The left side grows from 0 and the right side falls, and at x = w²/(2 ERP) the left is the larger one for ERP ≤ 1: bisection.
pub fn biased_offset(w: f64, error_reduction: f64) -> f64 {
    let excess = |x: f64| 2.0 * error_reduction * x * (1.0 + x) - (error_reduction * x).powi(2) - (w / (1.0 + x)).powi(2);
    let (mut low, mut high) = (0.0, w * w / (2.0 * error_reduction));
    // each halving gains a bit; 1100 reach the spacing of any double
    for _ in 0..1100 {
        let middle = 0.5 * (low + high);
        if excess(middle) < 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

/// E∞/E₀ under the bias: (1/(1+x))² + (ERP x/w)², the motion along and the bias across the circle.
pub fn biased_energy(w: f64, error_reduction: f64) -> f64 {
    let x = biased_offset(w, error_reduction);
    (1.0 / (1.0 + x)).powi(2) + (error_reduction * x / w).powi(2)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_offset_is_the_sagitta_over_the_share_to_first_order() {
        for share in [0.2, 0.5, 1.0] {
            for w in [0.1, 0.01, 0.001] {
                let x = biased_offset(w, share);
                let first = w * w / (2.0 * share);
                // 2 ERP x (1+x) − ERP² x² = w² (1+x)⁻² puts x below its first order by at most 3x of it
                assert!(x <= first && x >= first * (1.0 - 3.0 * first), "{x} {first}");
            }
        }
    }
}
