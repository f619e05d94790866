//! Tolerances of [`crate::event_driven`].

use moreau_exact::tolerance::EPSILON;

/// Share of 1 + |x| that the estimated error of a step may have, 2¹²ε ≈ 9·10⁻¹³. It is a factor of 100 below 10⁻¹⁰, the accuracy that is
/// asked of motions over tens of steps. It is as far above the rounding of a step's 7 stages.
/// Set.
pub const TOLERANCE: f64 = 4096.0 * EPSILON;

/// Factor on the step that the estimate proposes, so that the next step is rarely refused (Hairer, Nørsett, Wanner, §II.4).
/// Set.
pub const SAFETY: f64 = 0.9;

/// Factor by which a step may grow or shrink at once. Hairer, Nørsett and Wanner, §II.4, advise 5 to 10.
/// Set.
pub const GROWTH: f64 = 5.0;

/// 2⁻¹⁰. A remaining time shorter than this share of a step is added to the step. A step shorter than the square of this share, a
/// millionth, of the time of the flight is refused.
/// Set.
pub const SHORTEST_STEP: f64 = 1.0 / 1024.0;

/// Share of 1 + |q| up to which a gap counts as closed, and of 1 + |v| up to which a speed counts as zero, 2⁻³⁶ ≈ 1.5·10⁻¹¹. It is sixteen
/// times [`TOLERANCE`] and [`moreau_contact::tolerance::solvers::STOP`], the errors that steps and impacts leave. It is below the speed g
/// τ/2 = 5·10⁻⁶ m/s of the slowest bounce.
/// Set.
pub const TOUCHING: f64 = 1.0 / (1u64 << 36) as f64;

/// Share of the largest force or acceleration up to which a complementary unknown counts as zero, 2⁻³⁰ ≈ 10⁻⁹. It is above the error 10⁻¹⁰
/// of Ḣv by central differences ([`moreau_contact::tolerance::cones::DIFFERENCE_STEP`]²), and above the square of
/// [`moreau_contact::tolerance::solvers::smallest_pivot`].
/// Set.
pub const DEGENERATE: f64 = 1.0 / (1u64 << 30) as f64;

/// Share of a step after an event at which the next basis is chosen, 2⁻²⁰. A force that vanishes at the event differs from zero there by
/// 10⁻⁶ of its change over a step, which is above [`DEGENERATE`]. All other signs are still those of the event.
/// Set.
pub const LOOK_AHEAD: f64 = 1.0 / 1_048_576.0;

/// τ \[s\] of the Zeno rule, 2⁻²⁰. Under g = 10 m/s² the highest flight that is left out rises by g τ²/8 ≈ 10⁻¹² m. This is a few thousand
/// times the rounding of a gap between bodies a metre away from the origin, so that every flight that is followed differs from rounding.
/// Set.
pub const FLIGHT: f64 = 1.0 / 1_048_576.0;

/// Events in one advance after which the events are declared endless. A ball with e = 0.99 needs ln(2⁻²⁰)/ln 0.99 ≈ 1400 impacts from 1 s
/// to τ.
/// Set.
pub const EVENT_LIMIT: usize = 10_000;

/// Events in a row after which a method with this many contact rows is declared to cycle, if none is an impact and none comes later than
/// [`LOOK_AHEAD`] of the time asked for. A basis is chosen at an event for at least that time. Rounding may make each row leave it once in
/// either direction, and sixteen more events leave room for exceptions.
/// Set.
pub fn stalled_events(rows: usize) -> usize {
    2 * rows + 16
}

/// Error of an event-driven motion of size 1 to 10 over a few seconds: 100 · 10⁻¹² = 10⁻¹⁰. Each of at most 10 events adds at most 10 steps
/// of error [`TOLERANCE`] (1 + |x|), and hands errors on with a factor below 1 + e.
/// Derived.
pub const ACCURACY: f64 = 1e-10;

/// Error of an event-driven motion that sticks and slips. The instant of a switch is off by the error of s divided by ṡ, which is at least
/// 1/10 here.
/// Derived.
pub const SWITCHING: f64 = 10.0 * ACCURACY;
