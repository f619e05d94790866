//! Impacts of free spheres: nothing depends on the step but where they meet.

/// Relative error of a velocity after an impact: one contact is one division, but a solver that minimises an energy to rounding gives each
/// of two velocities to √ε, and both are subtracted.
/// Derived.
pub fn velocity(epsilon: f64) -> f64 {
    4.0 * epsilon.sqrt()
}

/// Angle \[rad\] by which the line of centres turns while spheres with the sum of radii R move by s = 2 v h, `offset` b beside each other:
/// its rate is b/d² per length with the distance d ≥ R − s.
/// Derived.
pub fn turned(offset: f64, reach: f64, speed: f64, h: f64) -> f64 {
    let moved = 2.0 * speed * h;
    offset * moved / (reach - moved).powi(2)
}

/// Relative change of an approach speed v cos φ when the normal turns by δ: |cos(φ ± δ)/cos φ − 1| ≤ δ tan φ + ½ δ².
/// Derived.
pub fn approach(tangent: f64, turned: f64) -> f64 {
    turned * tangent + 0.5 * turned * turned
}

/// Part of a velocity after at most two impacts that declared damping c leaves more than e^{−cT}: a step whose impact law takes the
/// approach from before the step damps nothing, c h.
/// Derived.
pub fn skipped(damping: f64, h: f64) -> f64 {
    2.0 * damping * h
}

/// The results that a declared law may give for an elastic impact of three equal spheres, two of which touch. Velocities are divided by
/// the speed of the first sphere, and the energy after the impact by the energy before it.
pub struct SoftCradle {
    /// Least and greatest energy after the impact.
    pub energy: [f64; 2],
    /// Least and greatest velocity of the first sphere.
    pub first: [f64; 2],
    /// Least and greatest velocity of the last sphere.
    pub last: [f64; 2],
}

/// A push of up to p times the speed makes each impulse up to 1 + p/2 times what it was; force mixing c, (W + c·diag W) r = b with
/// diag W = 2/m, changes r = W⁻¹b by at most 2c/m ‖W⁻¹‖‖r‖ with ‖W⁻¹‖ = m and r = m v (4/3, 2/3) for both at once: 3 c m v, which is 9/2 c
/// of the smaller impulse.
///
/// ```text
///     both at once        (1 − 4/3 s, 2/3 s, 2/3 s)     s from 1 − 9/2 c to 1 + p/2      energy 1 + 8/3 s (s − 1)
///     one after another   (1 − s, s (1 − s), s²)                                      energy 1 + 2 s (s − 1) (1 + s²)
/// ```
/// and everything between. The energies follow from ½ rᵀW r − r·b.
/// Derived.
pub fn soft_cradle(push: f64, mixing: f64) -> SoftCradle {
    let factors = [1.0 - 4.5 * mixing, 1.0 + 0.5 * push];
    let both = |s: f64| 1.0 + 8.0 / 3.0 * s * (s - 1.0);
    let chain = |s: f64| 1.0 + 2.0 * s * (s - 1.0) * (1.0 + s * s);
    let [least, most] = factors;
    SoftCradle {
        energy: [both(least).min(chain(least)), both(most).max(chain(most))],
        first: [1.0 - 4.0 / 3.0 * most, 1.0 - least],
        last: [2.0 / 3.0 * least, most * most],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Velocities of the three spheres after both impulses of (W + c·diag W) r = (2 + p, 0), solved by hand.
    fn both(push: f64, mixing: f64) -> [f64; 3] {
        let (diagonal, b) = (2.0 * (1.0 + mixing), 2.0 + push);
        let determinant = diagonal * diagonal - 1.0;
        let [first, second] = [diagonal * b / determinant, b / determinant];
        [1.0 - first, first - second, second]
    }

    #[test]
    fn impulses_solved_with_push_and_mixing_lie_within_and_without_them_nothing_is_allowed_beside_the_two_sound_answers() {
        for (push, mixing) in [(0.0, 0.0), (0.08, 0.0), (0.0, 1e-3), (0.01, 1e-5)] {
            let soft = soft_cradle(push, mixing);
            let [first, middle, last] = both(push, mixing);
            let energy = first * first + middle * middle + last * last;
            for (value, [low, high]) in [(energy, soft.energy), (first, soft.first), (last, soft.last)] {
                let rounding = moreau_exact::tolerance::rounding(16, 1.0);
                assert!(low - rounding <= value && value <= high + rounding, "p = {push}, c = {mixing}: {value} in {low}..{high}");
            }
        }
        let exact = soft_cradle(0.0, 0.0);
        assert_eq!((exact.energy, exact.last[1], exact.first[1]), ([1.0, 1.0], 1.0, 0.0));
    }
}
