//! Tolerances of the sweeps of projected Gauss–Seidel.

/// √ε/2: a Newton step that is this small leaves an error of the size of its square, which is rounding.
/// Derived.
pub const SQUARED: f64 = 1.0 / 134_217_728.0;

/// A Newton step from the multiplier of the last sweep that is as short as this, relative to the operator, ends the local step: its error
/// is a millionth, the square, while the sweep moves the contact by a thousandth. Sweeps that converge make it vanish.
/// Set.
pub const SHORT: f64 = 1.0 / 1024.0;

/// Most sweeps between two evaluations of the certificate's residual; an evaluation costs about three sweeps. Between them the change of a
/// sweep tells when the residual may be small enough.
/// Set.
pub const LOOK: usize = 64;

/// Factor of the tolerance at which the change of a sweep predicts a residual that is worth an evaluation.
/// Set.
pub const PREDICTED: f64 = 2.0;

/// Consecutive contacts that are swept one after the other, while other such blocks that touch nothing of theirs may be swept at the same
/// time. A block of 1024 contacts takes some 30 µs, and a few blocks fill no thread; so smaller problems are one block.
/// Set.
pub const BLOCK: usize = 1024;

/// Contacts from which on a sweep is shared out among threads: it takes some milliseconds there, and to begin and end threads some tens of
/// microseconds. Fewer contacts of a W that is stored by blocks, and those in space, are swept as they are listed.
/// Set.
pub const THREADED: usize = 32_768;

/// 2⁻⁴⁰: what is left of the square of a difference of sweeps, beside the others, if it is more than the rounding of its inner products,
/// which are relatively off by as many ε as there are rows in the worst case and by their root in the mean.
/// Derived.
pub const DEPENDENT_SQUARE: f64 = 1.0 / 1_099_511_627_776.0;

/// Contacts that are swept between two looks at whether the caller ends the sweeps: some microseconds, and a thousandth of their time.
/// Set.
pub const LOOKED: usize = 128;
