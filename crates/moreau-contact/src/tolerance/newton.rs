//! Tolerances of Newton's method on Fischer and Burmeister's equations, and of the proximal points around Newton's method.

/// Most steps on Fischer and Burmeister's equations. A convex problem of 300 contacts takes some fifty.
/// Set.
pub const SMOOTHED_STEPS: usize = 200;

/// Steps in which neither τ falls nor the certificate's residual is halved, after which the iteration has stalled. A line search that
/// shortens every step to 2⁻⁵ halves ‖φ_τ‖ in about as many.
/// Set.
pub const SMOOTHED_PATIENCE: usize = 30;

/// Lengths 1, ½, ¼, … of a step that are tried. Where 2⁻¹¹ is too long a larger η is tried.
/// Set.
pub const SMOOTHED_HALVINGS: i32 = 12;

/// Part of τ at which ‖φ_τ‖ counts as small: a tenth keeps x and z near the path, from which the steps of the next τ are long.
/// Set.
pub const ON_PATH: f64 = 0.1;

/// Part of τ that is left where ‖φ_τ‖ has just become small; less where it is smaller.
/// Set.
pub const SMOOTHING_FALLS: f64 = 0.5;

/// Least part of τ that is left at once.
/// Set.
pub const SMOOTHING_LEAST_LEFT: f64 = 0.1;

/// Part of the first τ below which it is zero: x ∘ z is τ², so that 10⁻⁹ leaves what is below the rounding of the first.
/// Set.
pub const LEAST_SMOOTHING: f64 = 1e-9;

/// η of the first step, in units of the contact's own W, 2⁻¹⁶: the first of those of [`super::solvers::NONSMOOTH_PROXIMALS`].
/// Set.
pub const FIRST_SOFTNESS: f64 = 1.0 / 65_536.0;

/// Part of η that is left after a whole step: six such steps take it from the first to the least.
/// Set.
pub const SOFTNESS_FALLS: f64 = 1.0 / 16.0;

/// What η is multiplied with where no step lowers ‖φ_τ‖: seven such factors take it from the least to the largest.
/// Set.
pub const SOFTNESS_GROWS: f64 = 128.0;

/// Least η, 2⁻⁴⁰, as of the last steps of [`super::solvers::NONSMOOTH_PROXIMALS`].
/// Set.
pub const LEAST_SOFTNESS: f64 = 1.0 / (1u64 << 40) as f64;

/// Largest η that is tried: a contact then is much softer than the bodies, and the step little more than one of each contact by itself.
/// Set.
pub const MOST_SOFTNESS: f64 = 128.0;

/// Most steps of Newton's method around all proximal points together.
/// Set.
pub const PROXIMAL_STEPS: usize = 2000;

/// Most steps of Newton's method around one proximal point, after which a softer one is tried: from 10⁻² of a contact's own W on, those of
/// walls and piles of 1 060 to 10 084 contacts that ended at all ended within as many.
/// Set.
pub const STEPS_AROUND: usize = 24;

/// Steps around a point that count as few.
/// Set.
pub const FEW_STEPS_AROUND: usize = STEPS_AROUND / 2;

/// Proximal points in a row that do not halve the certificate's residual after which the iteration has stalled.
/// Set.
pub const PROXIMAL_PATIENCE: usize = 30;

/// Proximal points in a row that do not halve it where a load wanders: a creep from contact to contact ends after some hundred. When
/// it was chosen, 250 ended all of 32 steps of thrown boxes that nothing else solved, and 100 ended 27.
/// Set.
pub const PATIENCE: usize = 400;

/// Most steps around those; the 32 took some 1 900 each in the mean.
/// Set.
pub const PATIENT_STEPS: usize = 8000;

/// The same times contacts, above 100 contacts, where each step costs more.
/// Set.
pub const PATIENT_WORK: usize = 100 * PATIENT_STEPS;

/// α of the first proximal point, in units of the contact's own W: contacts are nearly as soft as the bodies.
/// Set.
pub const FIRST_PROXIMAL: f64 = 0.125;

/// α of the first proximal point around what interior points have found.
/// Set.
pub const NEAR_PROXIMAL: f64 = 1.0 / 1024.0;

/// Relative residual up to which those points go, 2⁻²⁰; Newton's method squares it to rounding in two steps where contacts are told apart.
/// Set.
pub const NEAR: f64 = 1.0 / 1_048_576.0;

/// Steps around those points within `auto` before Fischer and Burmeister's equations are tried from where interior points ended: pushed
/// walls of 1 060 contacts are near after 20 to 33, and those of 3 044, which take some hundreds, after 24 to 107 steps of the equations.
/// Set.
pub const POINTS_AFTER_INTERIOR: usize = 40;

/// Most steps around those points within `auto`: pushed walls of 1 060 contacts took 20 to 33, of 3 044 some 300 and 430, and of 10 084
/// some 900.
/// Set.
pub const STEPS_AFTER_INTERIOR: usize = 1000;

/// Part of the last proximal point's step by which this one may differ from it for the two to be one creep. When it was
/// chosen, any from a tenth to one ended all of 32 steps of thrown boxes.
/// Set.
pub const STRAIGHT: f64 = 0.5;

/// How many times as far each leap along a creep goes as the one before. With four, three of the 32 were not solved.
/// Set.
pub const LEAPS_GROW: f64 = 2.0;

/// What the length of a leap is divided by where Newton's steps around its end do not end.
/// Set.
pub const LEAPS_SHRINK: f64 = 4.0;

/// What α is divided by after few steps, and multiplied with where they were too many.
/// Set.
pub const PROXIMAL_CHANGES: f64 = 4.0;

/// Least α, 2⁻⁴⁰: below, it is less than the η of Newton's method itself.
/// Set.
pub const LEAST_PROXIMAL: f64 = LEAST_SOFTNESS;

/// Largest α: a point then moves by a hundredth of the way that its contact by itself would go.
/// Set.
pub const MOST_PROXIMAL: f64 = MOST_SOFTNESS;

/// Largest relative residual of the problem around a point that is left there, 2⁻¹⁰.
/// Set.
pub const LARGEST_LEFT: f64 = 1.0 / 1024.0;

/// Part of the certificate's residual that is left in the problem around a point.
/// Set.
pub const PART_LEFT: f64 = 1.0 / 16.0;

/// Most steps around proximal points within `auto`: of the 186 problems of the collection that they end, they end those that are easier
/// for them than for sweeps in at most 42; the hardest, 270 contacts of capsules across each other, took 159.
/// Set.
pub const STEPS_IN_AUTO: usize = 200;

/// Sweeps over a few contacts before Newton's method is tried, four times as many in each further round: two show of most which press.
/// Set.
pub const FEW_SWEEPS_BEFORE: usize = 2;

/// Rounds of sweeps and Newton's method over a few contacts, before the longer chain begins.
/// Set.
pub const FEW_ROUNDS: usize = 2;

/// Steps of Newton's method in a round: from the right pattern three square the error to rounding, and the others find the pattern.
/// Set.
pub const FEW_NEWTON_STEPS: usize = 6;

/// Least pivot of the system of a few contacts that all stick, whose rows are of order one, from which it is taken for regular: of a
/// singular one the least is of the order of η, 2⁻¹² at most. Where it is not regular after all, corrections do not fall, and the step is
/// one of Newton's method like others.
/// Set.
pub const REGULAR_PIVOT: f64 = 1.0 / 64.0;

/// Corrections that take η out of such a system at most: each leaves η/σ of what was wrong, so that four leave rounding where σ ≥ 2⁻¹.
/// Set.
pub const FEW_CORRECTIONS: usize = 4;

/// Steps in a row with the factor of an earlier J, from the impulses of the step before: each leaves some 10⁻³ of F in a heap of spheres,
/// so that four take a millionth to rounding.
/// Set.
pub const REUSES: usize = 4;

/// Part of ‖F‖ that the step before left at most where its factor serves again, 2⁻⁶: while contacts change their state a step leaves more.
/// Set.
pub const REUSED_AFTER: f64 = 1.0 / 64.0;

/// Part of ‖F‖ that a step with an earlier factor leaves at most, 2⁻³; where it leaves more, J is factored anew from where it began.
/// Set.
pub const REUSED_LEAVES: f64 = 1.0 / 8.0;

/// Plain sweeps from the impulses of the step before where contacts close. In a heap of spheres they cost as much as a third of a factor,
/// and of 4.7 factors a solve one is left; 8 sweeps left 1.3 and 32 left 0.7, which costs the same.
/// Set.
pub const SWEEPS_FROM_KEPT: usize = 16;

/// Contacts for each plain sweep from the impulses of the step before where so many contacts leave bodies so free
/// ([`super::solvers::FEWEST_IN_ROUNDS`]), before Newton's method: sweeps and factors of a pile cost as much then as its twelve steps at
/// most. A pile of 3 147 contacts at rest takes one or two of its 786 sweeps, one of 2 472 in which a sphere rolls 50 to 256 of 618.
/// Set.
pub const CONTACTS_OF_A_SWEEP: usize = 4;

/// Plain sweeps of the first round from the impulses of the step before, twice as many in each further one. Of 30 steps of a falling pile
/// with 511 to 1 638 contacts that came to it, 24 ended in the first round, two in the second, one in the last and three in none; 500
/// sweeps carry the load too short a way for most.
/// Set.
pub const FIRST_ROUND: usize = 2000;

/// Rounds of sweeps and proximal points, 30 000 sweeps in all.
/// Set.
pub const ROUNDS: usize = 4;

/// Most steps around proximal points in a round. Where they end it they take some 10 to 80, each as long as some 100 sweeps.
/// Set.
pub const STEPS_OF_ROUND: usize = 80;
