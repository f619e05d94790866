//! How a scheme moves its positions.

/// How a scheme moves its positions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Position {
    /// q⁺ = q + h (θ v⁺ + (1−θ) v).
    Theta(f64),
    /// As θ = ½, but only for bodies without a gyroscopic term, whose accelerations the scheme remembers.
    Remembering,
    /// A free flight that keeps E under a constant force, whatever the impulses.
    Flight,
    /// Corrected by something else than velocities: V changes without a law.
    Corrected,
}

impl Position {
    /// Whether a body moves by at most h times the larger of its speeds before and after.
    pub fn moves_by_velocities(self) -> bool {
        self != Position::Corrected
    }
}
