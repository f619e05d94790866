//! Allowances of [`crate::checks::contact`].

use super::SOLVED;

/// Allowed error of an impulse, relative to the impulses that it is compared with.
/// Derived.
pub fn impulse() -> f64 {
    SOLVED
}

/// Error of a momentum balance in which declared damping c is accounted for by c times the way, relative to the impulses and the weight: a
/// step damps the velocity before it or after it, c h ‖Δv‖, and by 1 − c h, 1/(1 + c h) or e^{−ch}, ½ (c h)² v.
/// Derived.
pub fn damped(damping: f64, speed: f64, gravity: f64, h: f64) -> f64 {
    damping * h * (1.0 + 0.5 * damping * speed / gravity)
}

/// Allowed error of friction, relative to μ p_n. The impulse is known to [`SOLVED`], which is divided by μ.
/// Derived.
pub fn friction(friction: f64) -> f64 {
    SOLVED / friction
}

/// Largest ‖q + t‖ for q = p_t/(μ p_n) of a pyramid around the cone, or of one inside it, and a measured unit slip t that is turned by ψ
/// \[rad\] from the slip u of the point where p acts. Maximal dissipation over the square |q₁|, |q₂| ≤ 1 gives q·u = −(|u₁| + |u₂|) ≤ −‖u‖
/// with ‖q‖² ≤ 2, so that ‖q + t‖² = ‖q‖² + 1 + 2 q·t is greatest for a corner q, a slip u along an axis and a turn away from q:
/// ```text
///     ‖q + t‖² = 3 − 2 cos ψ + 2 sin ψ ,   1 for ψ = 0
/// ```
/// It grows until ψ = 3π/4. In the square inside the cone, ‖q‖ ≤ 1 and q·u ≤ −‖u‖/√2 give less.
/// Derived.
pub fn pyramid(turned: f64) -> f64 {
    let (sine, cosine) = turned.min(0.75 * std::f64::consts::PI).sin_cos();
    (3.0 - 2.0 * cosine + 2.0 * sine).sqrt()
}

/// Rounding of a gap \[m\] read from positions of the size of the body.
/// Derived.
pub fn gap(epsilon: f64, size: f64) -> f64 {
    8.0 * epsilon * size
}

/// Gap \[m\] up to which a body counts as touching. The body falls ½ g h² in one step from rest, and as much again if it starts a step
/// late.
/// Derived.
pub fn touching(gravity: f64, h: f64) -> f64 {
    gravity * h * h
}

/// Speed \[m/s\] with which a body may still approach after two steps in contact. An engine that adds gravity after the contacts leaves
/// g h. Its solver leaves a part [`SOLVED`] of the landing speed.
/// Derived.
pub fn approach(gravity: f64, h: f64, landing: f64) -> f64 {
    gravity * h + SOLVED * landing
}

/// Slip \[m/s\] above which a step counts as sliding. It is at least twice the slip that friction removes in a step (`rate` h). It is also
/// at least a twentieth of the speed: there regularised friction with a stiction tolerance of millimetres per second is full to 1e-4.
/// Set.
pub fn full_slip(rate: f64, h: f64, speed: f64) -> f64 {
    (2.0 * rate * h).max(0.05 * speed)
}

/// Half the impulse of the weight in a step \[N·s\]. A smaller normal impulse belongs to a contact that is just found or just lost.
/// Set.
pub fn light(weight: f64, h: f64) -> f64 {
    0.5 * weight * h
}

/// Work \[J\] that the contact may do in one step. A contact that is found while the body rises at u < g h takes p_n = m (g h − u) and does
/// ½ p_n u ≤ m g² h²/8. The solver leaves a part [`SOLVED`] of the energy.
/// Derived.
pub fn work(mass: f64, gravity: f64, h: f64, energy: f64) -> f64 {
    mass * (gravity * h).powi(2) / 8.0 + SOLVED * energy
}

/// Work \[J\] of a contact that asks for a normal velocity w \[m/s\], in a step that begins with u \[m/s\]: p = m (w − u + g h), and the
/// body leaves with w, ½ p (u + w); for w = 0 this is at most the m g² h²/8 of [`work`].
/// Derived.
pub fn pushing(mass: f64, gravity: f64, h: f64, velocity: f64, push: f64) -> f64 {
    (0.5 * mass * (push - velocity + gravity * h).max(0.0) * (velocity + push)).max(0.0)
}

/// Work \[J\] that friction may do in one step: none, since it opposes the slip after the step, which it has made smaller. The solver
/// leaves a part [`SOLVED`] of the largest impulse, at most at the speed of the throw.
/// Derived.
pub fn friction_work(largest_impulse: f64, speed: f64) -> f64 {
    SOLVED * largest_impulse * speed
}

#[cfg(test)]
mod tests {
    use super::{pushing, pyramid, work};
    use moreau_exact::tolerance::rounding;
    use nalgebra::Vector2;

    #[test]
    fn a_contact_that_asks_for_a_velocity_gives_the_energy_that_the_body_gains_and_falls_through() {
        let (mass, gravity, h) = (2.0, 9.81, 0.01);
        for (u, w) in [(-0.5, 0.7), (0.2, 0.3), (0.0, 0.0), (0.05, 0.0)] {
            // from u to w, less the work ½ (u + w) h of gravity
            let gained = 0.5 * mass * (w * w - u * u) + mass * gravity * h * 0.5 * (u + w);
            assert!((pushing(mass, gravity, h, u, w) - gained).abs() <= rounding(16, 2.0), "{u} {w}");
        }
        assert_eq!(pushing(mass, gravity, h, -0.7, 0.5), 0.0, "it takes energy");
        assert_eq!(pushing(mass, gravity, h, 0.2, 0.0), 0.0, "it rises by itself");
        let most = (0..=100).map(|k| pushing(mass, gravity, h, gravity * h * f64::from(k) / 100.0, 0.0)).fold(0.0, f64::max);
        assert!(most <= work(mass, gravity, h, 0.0) + rounding(16, 1.0));
    }

    #[test]
    fn no_pyramid_is_farther_from_a_turned_slip_than_its_bound_and_the_one_around_the_cone_reaches_it() {
        for turned in [0.0, 0.1, 0.35, 1.0, 2.0] {
            let bound = pyramid(turned);
            let mut farthest: f64 = 0.0;
            for k in 0..=360 {
                let slip = Vector2::new(f64::from(k).to_radians().cos(), f64::from(k).to_radians().sin());
                let seen = [-turned, turned].map(|angle: f64| nalgebra::Rotation2::new(angle) * slip);
                // Around the cone: a component that slips is saturated, one that sticks may be anything.
                let part = |u: f64| if u.abs() < 1e-9 { vec![-1.0, 0.0, 1.0] } else { vec![-u.signum()] };
                for (first, second) in part(slip.x).into_iter().flat_map(|q| part(slip.y).into_iter().map(move |r| (q, r))) {
                    farthest = seen.iter().map(|t| (Vector2::new(first, second) + t).norm()).fold(farthest, f64::max);
                }
                // Inside the cone: the corner that dissipates most.
                let inside =
                    if slip.x.abs() > slip.y.abs() { Vector2::new(-slip.x.signum(), 0.0) } else { Vector2::new(0.0, -slip.y.signum()) };
                assert!(seen.iter().all(|t| (inside + t).norm() <= bound + rounding(16, 2.0)), "{turned} {k}");
            }
            assert!((farthest - bound).abs() <= rounding(16, 2.0), "{farthest} {bound}");
        }
    }
}
