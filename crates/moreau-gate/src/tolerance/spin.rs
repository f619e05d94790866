//! Allowances of [`crate::checks::spin`].

use moreau_forms::free_top::FreeTop;
use nalgebra::Vector3;

pub use moreau_forms::tolerance::TOP_STEPS;

/// Angle \[rad\] that steps of h miss of a steady turn by ω t. A step by 2 atan(½ h ω) misses 1/12 (h ω)² of itself, and one by atan(h ω)
/// misses ⅓ (h ω)² of itself, because x − atan x ≤ ⅓ x³.
/// Derived.
pub fn turn(speed: f64, time: f64, h: f64) -> f64 {
    speed * time * (speed * h).powi(2) / 3.0
}

/// Part of an upright spin that friction may take through the rounding of its lever. The lever of a ball is along the normal, which a
/// search for the nearest points finds to √ε of itself; `turns` is the angular impulse of all friction at a lever R over J ω.
/// Derived.
pub fn lever(epsilon: f64, turns: f64) -> f64 {
    epsilon.sqrt() * turns
}

/// Error of the part of an upright spin that declared torsional friction takes: the solver leaves a part [`super::SOLVED`] of it.
/// Derived.
pub fn torsion(lost: f64) -> f64 {
    super::SOLVED * lost
}

/// Relative error of the friction that brakes a flat spin: its direction is that of the slip at one end of the step, which turns by h ω in
/// it, so that up to 1 − cos(h ω) ≤ ½ (h ω)² of its moment may be missing. To this comes a part [`super::SOLVED`] of the solver.
/// Derived.
pub fn braking(spin: f64, h: f64) -> f64 {
    0.5 * (h * spin).powi(2) + super::SOLVED
}

/// Spin \[rad/s\] that may be left where friction has stopped one of `spin`: the solver leaves a part [`super::SOLVED`] of it.
/// Derived.
pub fn stopped(spin: f64) -> f64 {
    super::SOLVED * spin
}

/// What steps of first order do to a quadratic invariant of the free top, relative to it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Secular {
    /// What implicit steps lose over the whole motion, and explicit ones gain.
    pub drift: f64,
    /// How far symplectic steps, or a state whose parts belong to different ends of a step, may be off at any time.
    pub swing: f64,
}

/// [`Secular`] of the kinetic energy and of the size of the angular momentum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gyroscopic {
    /// Of T.
    pub energy: Secular,
    /// Of ‖L‖.
    pub momentum: Secular,
}

/// Bounds along the exact motion Ω(t), given in equal parts over `time` \[s\], with τ = JΩ × Ω.
///
/// An Euler step changes T = ½ΩᵀJΩ by ½h² τᵀJ⁻¹τ and ‖L‖² by h²‖τ‖², which adds up to
/// ```text
///     drift     ½ h ∫ τᵀJ⁻¹τ dt / T          ½ h ∫ ‖τ‖² dt / ‖L‖²
/// ```
/// A splitting into the parts T_i = L_i²/2J_i keeps T + ½h Σ_{i<j} {T_i, T_j} up to higher orders, with |{T_i, T_j}| = J_k|Ω₁Ω₂Ω₃|; two
/// states differ by twice that. It keeps ‖L‖. An orientation and a spin from different ends of a step change ‖L‖ to second order only,
/// since L·(ω × L) = 0: by ½(hω)² times the ratio of the moments.
/// ```text
///     swing     h Σ J_k · max|Ω₁Ω₂Ω₃| / T    ½ (h ω)² max J/min J
/// ```
/// Derived.
pub fn gyroscopic(moments: &Vector3<f64>, path: &[Vector3<f64>], time: f64, h: f64) -> Gyroscopic {
    let start = path[0];
    let momentum = moments.component_mul(&start);
    let energy = 0.5 * start.dot(&momentum);
    let torques: Vec<Vector3<f64>> = path.iter().map(|rate| moments.component_mul(rate).cross(rate)).collect();
    let mean = |of: &dyn Fn(&Vector3<f64>) -> f64| torques.iter().map(of).sum::<f64>() / torques.len() as f64;
    let product = path.iter().map(|rate| rate.product().abs()).fold(0.0, f64::max);
    let half = 0.5 * h * time;
    Gyroscopic {
        energy: Secular {
            drift: half * mean(&|torque| torque.dot(&torque.component_div(moments))) / energy,
            swing: h * moments.sum() * product / energy,
        },
        momentum: Secular {
            drift: half * mean(&|torque| torque.norm_squared()) / momentum.norm_squared(),
            swing: 0.5 * (h * start.norm()).powi(2) * moments.max() / moments.min(),
        },
    }
}

/// Parts of T and of ‖L‖ that implicit steps Ω⁺ = Ω + h J⁻¹(JΩ⁺ × Ω⁺) lose, made one after another. Over many turns this is less than
/// [`gyroscopic`] has for a motion that stays what it was: the box turns towards its axis of the smallest moment, about which it loses
/// nothing.
/// Derived.
pub fn lost_by_implicit_steps(top: &FreeTop, start: Vector3<f64>, steps: usize, h: f64) -> [f64; 2] {
    let measures = |rate: &Vector3<f64>| {
        let momentum = top.moments.component_mul(rate);
        [rate.dot(&momentum), momentum.norm()]
    };
    let implicit = |rate: Vector3<f64>| (0..IMPLICIT_PASSES).fold(rate, |next, _| rate + top.body_acceleration(&next) * h);
    let end = (0..steps).fold(start, |rate, _| implicit(rate));
    let [before, after] = [start, end].map(|rate| measures(&rate));
    [1.0 - after[0] / before[0], 1.0 - after[1] / before[1]]
}

/// Passes of a fixed point that shrinks its error to hω ≤ 0.1 of itself: what is left is far below what a step loses.
/// Set.
const IMPLICIT_PASSES: usize = 8;

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_forms::free_top::Spin;
    use nalgebra::UnitQuaternion;

    #[test]
    fn implicit_steps_lose_over_a_turn_what_the_integral_says_and_over_many_they_end_in_the_axis_of_the_smallest_moment() {
        let top = FreeTop { moments: Vector3::new(0.13 / 3.0, 0.1 / 3.0, 0.05 / 3.0) };
        let (start, h, steps) = (Vector3::new(1.0, 0.0, 2.0).normalize(), 0.001, 6283);
        let time = h * f64::from(steps);
        let path = top.path(Spin { orientation: UnitQuaternion::identity(), body_rate: start }, time, TOP_STEPS);
        let rates: Vec<Vector3<f64>> = path.iter().map(|spin| spin.body_rate).collect();
        let bound = gyroscopic(&top.moments, &rates, time, h);
        let lost = lost_by_implicit_steps(&top, start, steps as usize, h);
        for (made, integral) in lost.into_iter().zip([bound.energy.drift, bound.momentum.drift]) {
            assert!((made / integral - 1.0).abs() < 0.02, "{made} and {integral}");
        }
        // 2T J₃ = ‖L‖² about that axis
        let [energy, momentum] = lost_by_implicit_steps(&top, start, 126_000, 0.05);
        let (twice, square) = (start.dot(&top.moments.component_mul(&start)), top.moments.component_mul(&start).norm_squared());
        let ratio = twice * (1.0 - energy) * top.moments[2] / (square * (1.0 - momentum).powi(2));
        assert!((ratio - 1.0).abs() < 0.001, "{ratio}");
    }
}
