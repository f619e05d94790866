//! One-sided thresholds of claims: from where on a number is what a sentence calls it.

/// Order above which an error converges rather than not, halfway between the orders 0 and 1.
/// Derived.
pub const CONVERGES: f64 = 0.5;

/// Error with a quarter of the step over that with the step below which it converges, 4^(−½), from [`CONVERGES`].
/// Derived.
pub const QUARTERED: f64 = 0.5;

/// Factor from which on an energy that should be constant “grows”: it doubles.
/// Set.
pub const DOUBLED: f64 = 2.0;

/// Share of what a model does from which on a motion follows that model and not the other one, which does nothing of it: halfway.
/// Derived.
pub const FOLLOWS: f64 = 0.5;

/// Bytes that no computer of a reader holds: a terabyte.
/// Set.
pub const TERABYTE: f64 = 1e12;

/// Steps in which a method that squares its error gets from 10⁻² to 10⁻¹⁰: 10⁻⁴, 10⁻⁸, 10⁻¹⁶.
/// Derived.
pub const SQUARINGS: f64 = 3.0;

/// Ratio of two amounts of work, known to a factor of the order of one, from which on one is more than the other.
/// Set.
pub const MORE_WORK: f64 = 2.0;

/// Relative distance of two answers from which on a reader sees that they differ in the fourth digit.
/// Set.
pub const DIFFERENT: f64 = 1e-4;

/// Share of a top's energy that an integrator adds in a second from which on a reader calls it a gain, five thousand times what
/// [`super::soft::COMPUTED`] hides.
/// Set.
pub const GAINED: f64 = 0.005;
