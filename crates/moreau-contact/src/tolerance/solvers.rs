//! Tolerances of [`crate::solvers`].

use moreau_exact::scalar::Scalar;
use moreau_exact::tolerance::EPSILON;

/// A sum of n products whose absolute values sum to `magnitude` is rounding, hence zero, up to 2nε times that
/// ([`moreau_exact::tolerance::rounding`]). Zero for exact rationals, where only 0 is 0.
/// Derived.
pub fn cancellation<T: Scalar>(terms: usize, magnitude: T) -> T {
    T::ratio(2 * terms as i64, 1) * T::spacing() * magnitude
}

/// What rounding of the data changes in an equation Σ Bᵢⱼxⱼ = aᵢ of n terms, whose absolute values and |aᵢ| sum to `magnitude`:
/// (n + 1) ε times that. Every entry of B and a is itself the rounded result of a few operations, W = H M⁻¹Hᵀ of at most n. Zero for exact
/// rationals.
/// Derived.
pub fn sum_of_data<T: Scalar>(rows: usize, magnitude: T) -> T {
    T::ratio(rows as i64 + 1, 1) * T::spacing() * magnitude
}

/// The mean of what [`sum_of_data`] bounds, its 4(n + 1)th part: roundings lie anywhere in \[0, ε/2\], ε/4 in the mean, and those of a sum
/// cancel rather than add up. It decides which rows tie; a tie that is none, or a missed one, costs a longer path, and what ends it is
/// checked.
/// Derived.
pub fn mean_of_data<T: Scalar>(rows: usize, largest: T) -> T {
    largest / T::ratio(4 * (rows as i64 + 1), 1)
}

/// How many times its uncertainty an entry must be to become a pivot, 2¹⁰. The relative error of a pivot is that of all numbers of its row
/// at the next basis, so that three digits of them are left. A smaller entry is left out; what that costs is its size times the step, 2¹⁰
/// roundings of the data.
/// Set.
pub const KNOWN_PIVOT: i64 = 1 << 10;

/// Part of one that is left when half of the digits are lost, √ε. Zero for exact rationals. z₀ counts as zero below it, if rounding of the
/// data may have made it, and so does an entry of a matrix whose rank is asked for, relative to the largest.
/// Derived.
pub fn smallest_pivot<T: Scalar>() -> T {
    if T::spacing().is_zero() { T::zero() } else { T::ratio(1, 1 << 26) }
}

/// Pivots after which Lemke's method on rounded numbers is declared to cycle.
///
/// Lexicographic pivoting repeats no basis in exact arithmetic, so exact runs have no limit. On contact problems the count is a small
/// multiple of n. Ten times n pivots can only mean that rounding has broken the order, and each pivot costs n³. The limit decides nothing
/// about a solution. It turns an endless loop into an error, and another covering vector is tried.
/// Set.
pub fn lemke_pivot_limit<T: Scalar>(size: usize) -> usize {
    if T::spacing().is_zero() { usize::MAX } else { 10 * (size + 1) }
}

/// Relative natural map at which iterations stop, 2¹²·ε ≈ 9.1e-13. The rounding of u = W r + b is 2nε relative to the terms of a row, so
/// this is above rounding up to n ≈ 2000 rows. It is four decimal digits below the default of the certificate.
/// Set.
pub const STOP: f64 = 4096.0 * EPSILON;

/// Largest velocity of an impulse that an iteration starts from, in parts of the largest one given: its rounding is an eighth of what is
/// accepted by default. What moves its contact faster than that leaves nothing of the data but rounding.
/// Derived.
pub const LARGEST_START: f64 = super::certificate::CERTIFY / (8.0 * EPSILON);

/// Sweep limit of projected Gauss–Seidel. On a chain of n bodies a sweep contracts by cos²(π/(n+1)) ≈ 1 − π²/n², so that 100 000
/// sweeps reach [`STOP`] = e⁻²⁸ for n ≤ 180.
/// Set.
pub const SWEEPS: usize = 100_000;

/// Most iterations that a user may ask for: ten million, a hundred times [`SWEEPS`]. A problem that needs more needs another algorithm.
/// Set.
pub const MOST_ITERATIONS: usize = 100 * SWEEPS;

/// Sweeps that Anderson's acceleration remembers. A chain of n bodies has n slow modes, and ten is the height of the piles in use.
/// Set.
pub const MEMORY: usize = 10;

/// Sweeps that are tried before a polyhedral problem goes to Lemke's method. They cost about as much as one factorisation of its tableau
/// with (2 + d) n unknowns: 8·1000 n² against 2·1000 n³/3 operations for d = 8, with the tens of contacts of a usual step.
/// Set.
pub const FIRST_SWEEPS: usize = 1000;

/// Relative residual, 2⁻³⁴ ≈ 5.8e-11, at which `auto` takes an answer whose iteration has stalled above [`STOP`]. It is the geometric mean
/// of [`STOP`] and the default of the certificate, so that the certificate accepts the answer with two digits to spare.
/// Set.
pub const ENOUGH: f64 = 1.0 / (1u64 << 34) as f64;

/// What Lemke's method adds to the diagonal of a problem with entries of order one where rounding has ended every path of the problem
/// itself: the same 2⁻³⁴, which is 10⁵ times the spacing of the entries and so well above what rounding does to them, and no more than
/// what may be left over. The certificate judges the answer by the problem itself.
/// Set.
pub const SOFTENED: f64 = ENOUGH;

/// Relative residual, 2⁻²⁸ ≈ 3.7e-9, at which `auto` does not try its most expensive algorithms. It is less than half of the default of the
/// certificate.
/// Set.
pub const ACCEPTABLE: f64 = 1.0 / (1u64 << 28) as f64;

/// Relative residual, 2⁻²⁰, below which the rounding of y is worth a pass over W. Above it rounding decides only if impulses cancel to a
/// millionth, and [`FRESH_ROUNDING`] covers that case.
/// Set.
pub const NEAR_SOLUTION: f64 = 1.0 / 1_048_576.0;

/// Calls after which the rounding of y is always computed again. It costs a sixteenth of the sweeps between.
/// Set.
pub const FRESH_ROUNDING: usize = 16;

/// Factor within which two impulses count as equal in size. The rounding of y is proportional to the impulses, so it is known within this
/// factor. Only the work until the next computation of the rounding depends on it.
/// Set.
pub const SAME_SIZE: f64 = 2.0;

/// Factor by which an extrapolated iterate may exceed the best residual so far before it is dropped: two. Residuals of an accelerated
/// iteration oscillate. A residual that doubles has left the piece on which the iteration is affine.
/// Set.
pub const GROWTH: f64 = 2.0;

/// Sweeps over n contacts without halving the residual after which plain sweeps have stalled. On a chain of n bodies a sweep contracts by
/// cos²(π/(n+1)) ≈ 1 − π²/n². So the residual halves in (ln 2/π²) n² sweeps, fewer than 1000 (1 + n) for n < 14 000.
/// Set.
pub fn stalled(contacts: usize) -> usize {
    FIRST_SWEEPS * (1 + contacts)
}

/// Accelerated sweeps over n contacts without halving the residual after which they have stalled. They need about one sweep for each of the
/// n slow modes of the chain, and as many as they remember for each change of a contact's state.
/// Set.
pub fn accelerated_stalled(contacts: usize) -> usize {
    MEMORY * (MEMORY + contacts)
}

/// Most steps of the nonsmooth Newton method, against endless loops. A step changes the state of some contact or squares the error.
/// Set.
pub const NONSMOOTH_STEPS: usize = 100;

/// Steps in a row that do not halve the residual after which the method is cycling. A contact has three states (open, sticking, sliding).
/// The number allows three rounds through them for a handful of contacts at the border of two states. Only the work depends on it.
/// Set.
pub const NONSMOOTH_STALLED: usize = 40;

/// Steps in a row that do not halve the residual after which the iteration ends, once an iterate is below [`ACCEPTABLE`]. There a step
/// squares the error, so that three steps without progress have reached rounding.
/// Set.
pub const NONSMOOTH_ENDED: usize = 3;

/// Lengths 1, ½, ¼ of a step that are tried. If a quarter of the step brings no progress, another η may.
/// Set.
pub const NONSMOOTH_HALVINGS: i32 = 3;

/// The η on the diagonal of J, whose entries are of order one, start by start. An error falls by η/σ a step, σ the smallest singular
/// value of J that is not rounding, and what
/// rounding or a state that is not final leaves moves the step along the null space by its 1/η-fold: from 2⁻¹² to 2⁻²⁰ such an error
/// stays a small step, with 2⁻⁴⁰ the last steps
/// square what is left. The zeros of F are the same for all; only whether and when they are found depends on them.
/// Set.
pub const NONSMOOTH_PROXIMALS: [&[f64]; 3] = {
    const fn half(exponent: u32) -> f64 {
        1.0 / (1u64 << exponent) as f64
    }
    [&[half(16), half(40)], &[half(20)], &[half(12), half(16), half(40)]]
};

/// Iterations of the alternating directions between two evaluations of the certificate's residuals. An evaluation costs about half an
/// iteration.
/// Set.
pub const LOOK: usize = 8;

/// Directions of the polygons that Lemke's method solves in place of a round cone, one after the other. Newton's method starts from their
/// answers. The friction of the octagon is within 1 − cos(π/8) = 8 % of the round one. The sides of the pentagon lie elsewhere. Only the
/// states of the contacts are taken from the polygons.
/// Set.
pub const LEMKE_DIRECTIONS: [usize; 2] = [8, 5];

/// Most unknowns of the linear complementarity problems that `auto` pivots: λ, β and σ of 20 contacts with eight directions. Some 2n pivots
/// with 2n³/3 operations each make 2·10⁹ operations there, and sixteen times as many for twice the contacts. `lemke` by name has no such
/// limit.
/// Set.
pub const LEMKE_UNKNOWNS: usize = 200;

/// Most unknowns of the linear complementarity problems that `auto` pivots before it makes all its sweeps. Those take some ten seconds on
/// the 212 contacts of a pyramid of 91 boxes in the plane, 848 unknowns, where Lemke takes seven.
/// Set.
pub const LEMKE_SOON: usize = 1000;

/// Pivots for each contact after which `auto` leaves principal pivoting: 322 of 245 contacts ended a pyramid of 91 boxes, and a problem on
/// which they are many times the contacts is one of the contrived ones that need 2ⁿ.
/// Set.
pub const PIVOTS_OF_A_CONTACT: usize = 10;

/// Most unknowns of the linear complementarity problems that `auto` pivots where nothing else ended them.
/// Set.
pub const LEMKE_LAST: usize = 2000;

/// Rows of a basis up to which Lemke's method computes B⁻¹ from the data at every pivot.
/// Set.
pub const SMALL_BASIS: usize = 64;

/// Pivots for which B⁻¹ of a larger basis of n rows is updated before it is computed anew: an update takes n² operations, computing it n³,
/// so that n/8 updates cost about as much. What the updates lose is measured by residuals of the data at every pivot.
/// Set.
pub const fn updates(rows: usize) -> usize {
    if rows < 256 { 32 } else { rows / 8 }
}

/// Unknowns of the linear complementarity problems that `auto` pivots for a polygon in place of a round cone. The limit is lower because
/// other algorithms follow: 3·10⁸ operations are what the alternating directions take for as many contacts.
/// Set.
pub const POLYGON_UNKNOWNS: usize = 128;

/// The compliances α of contacts that are made harder step by step, in units of their own W. They start as soft as the bodies themselves
/// and end at √[`f64::EPSILON`], because Newton's η is no smaller. A factor of a quarter usually changes the answer by less than the states
/// of its contacts.
/// Set.
pub fn softnesses() -> impl Iterator<Item = f64> {
    (0..14).map(|k| 0.25f64.powi(k))
}

/// Newton's steps on a softer contact problem, whose answer is only used as a start.
/// Set.
pub const SOFT_STEPS: usize = 12;

/// Accelerated sweeps that `auto` makes before it goes on to other algorithms. It makes as many sweeps of over-relaxation after them.
/// Set.
pub const AUTO_SWEEPS: usize = 20 * FIRST_SWEEPS;

/// Most contacts of a problem without friction on which `auto` tries direct methods first: elimination over so few rows takes about a
/// microsecond, as much as a few sweeps.
/// Set.
pub const DIRECT_CONTACTS: usize = 12;

/// Steps of the first of them for n contacts: as many as there are changes of side from nothing to everything and back.
/// Set.
pub const fn direct_steps(contacts: usize) -> usize {
    2 * contacts
}

/// Fewest rows of a dense W that `auto` looks for blocks that are zero: by blocks a tower of 240 rows took a twentieth of the time, of
/// problems of 96 to 240 rows most a half or less, and those of up to 80 rows up to twice as long.
/// Set.
pub const FEWEST_BY_BLOCKS: usize = 96;

/// Part of its first gap at which the interior point method hands over: 10⁻⁵ of the gap with one in place of [`FIRST_IMPULSE`]. To 10⁻⁶
/// proximal points took a pushed wall of 1 060 contacts 20 of Newton's steps from there and 90 from ten times as much, one at rest 1 and 3,
/// and 78 from a thousand times; one of 10 084 at rest 1, 3 and 177.
/// Set.
pub const IDENTIFIED: f64 = 1e-6;

/// Fewest contacts of a problem on which `auto` begins with interior points where there are fewer velocities than rows: below, a few dozen
/// sweeps cost less than their twenty steps. With 64 in place of 200, 96 towers and walls of 20 to 300 contacts took two thirds of the time
/// in the geometric mean, tall towers a quarter; walls of some hundred contacts of which most slip, which sweeps all but end, took up to
/// 2.6 times. With 32 there was no more to win.
/// Set.
pub const FEWEST_REDUNDANT: usize = 64;

/// Fewest contacts of a problem of that kind on which it goes to them where a few of Newton's steps have failed; fewer contacts are ended
/// by what follows.
/// Set.
pub const FEWEST_STUCK: usize = 16;

/// How many rows for each velocity make interior points come first: bricks in a wall have four. A pile of spheres with 2.7 contacts each
/// has 1.3; there sweeps come near a solution, and the lift of Coulomb's law leads interior points astray.
/// Set.
pub const REDUNDANT: usize = 2;

/// Fewest contacts of a problem with fewer rows than that on which `auto` makes plain sweeps before interior points: a pile of 623 ended
/// without them, in some fifty steps.
/// Set.
pub const FEWEST_FREE: usize = 1000;

/// Fewest contacts of a problem with fewer rows than that on which `auto` makes sweeps and proximal points in turn from the impulses of the
/// step before: fewer are ended by what follows in less time.
/// Set.
pub const FEWEST_IN_ROUNDS: usize = 150;

/// Most contacts of a problem with a W that is stored densely on which `auto` solves Fischer and Burmeister's equations: some sixty steps
/// of 2(3n)³/3 operations make 10⁹ there.
/// Set.
pub const SMOOTHED_CONTACTS: usize = 100;

/// Most contacts of a problem of which `auto` leaves out some: of more, twelve are seldom all that press.
/// Set.
pub const CONTACTS_LEFT_OUT: usize = 50;

/// The contacts of which every set is tried: the 4095 sets of twelve take half a second, and only problems come to them that some thousand
/// steps of other algorithms did not solve.
/// Set.
pub const CONTACTS_IN_SETS: usize = 12;

/// Newton's steps for each of those sets: from the right one a few square the error to rounding.
/// Set.
pub const STEPS_LEFT_OUT: usize = 20;

/// Steps of the QR iteration for each singular value of a system of contacts that all stick: two or three are usual, and LAPACK allows 30.
/// Only the work depends on it.
/// Set.
pub const SINGULAR_VALUE_STEPS: usize = 30;

/// How many contacts may be left out for Fischer and Burmeister's equations to be solved, too: 79 sets of twelve contacts, a millisecond or
/// two for each.
/// Set.
pub const LEFT_OUT_OF_SMOOTHED: usize = 2;

/// Plain sweeps there, and before proximal points where fewer contacts were not ended by anything else. 8 000 over the 5 464 contacts of a
/// pile of spheres take as long as twenty steps of Newton's method; from there proximal points took 52 steps, 89 from 5 000 and 97 from
/// 3 000. Of 28 steps of falling piles with 162 to 1 155 contacts (μ = 0.3, 0.5 and 0.8) they end more, and sooner, from 8 000 than in
/// rounds that begin with 2 000 or 4 000.
/// Set.
pub const SWEEPS_OF_FREE: usize = 8000;

/// Fewest contacts of a problem that `auto` takes apart into islands, or begins with Newton's method from the step before: what is smaller
/// is solved to the last bit by sweeps, in the time that takes.
/// Set.
pub const FEWEST_IN_ISLANDS: usize = 16;

/// Most contacts of a problem whose certificate leaves its memory to the next one: a megabyte or two for each thread.
/// Set.
pub const KEPT: usize = 4096;

/// Accelerated sweeps before Newton's method is tried: four times as many as the acceleration remembers. They show which contacts press,
/// and they solve easy contacts: of the 26 friction files of Siconos and FCLIB that were tried 22 are solved within them, at half the time
/// of fewer sweeps with Newton's method after them. For n contacts ten steps of Newton's method cost as much as 10 n of these sweeps.
/// Set.
pub const FEW_SWEEPS: usize = 4 * MEMORY;

/// Plain sweeps that `auto` makes after accelerated ones have stalled. A problem that they bring no nearer to a solution goes to the other
/// algorithms.
/// Set.
pub const PLAIN_SWEEPS: usize = 2 * FIRST_SWEEPS;

/// Iterations of the alternating directions within `auto` before Newton's method starts from them. They separate sticking from sliding
/// contacts long before they converge.
/// Set.
pub const FIRST_ALTERNATIONS: usize = FIRST_SWEEPS;

/// Most steps of the accelerated projected gradient. Its bound 2LR²/(k+1)² reaches the relative objective error 2⁻³⁴ at k = 2¹⁷·√2. A
/// problem that needs more is ill conditioned and left to the other solvers.
/// Set.
pub const GRADIENT_STEPS: usize = 200_000;

/// Most iterations of the alternating directions. Each costs a triangular solve and two matrix products, so that 100 000 of them cost as
/// much as [`GRADIENT_STEPS`]. A problem that needs more is left to the other solvers.
/// Set.
pub const ALTERNATIONS: usize = 100_000;

/// Proximal weight η of the alternating directions in units of the mean diagonal entry of W + R: a millionth, Pinocchio's default. It does
/// not change the fixed points, and it makes a singular W definite.
/// Set.
pub const ADMM_PROXIMAL: f64 = 1e-6;

/// Bounds of the penalty ρ in units of the mean diagonal entry of W + R, as in Pinocchio. A millionth and a million keep ten digits of W in
/// W + ρI.
/// Set.
pub const PENALTIES: (f64, f64) = (1e-6, 1e6);

/// Factor by which ρ of the alternating directions is changed at least: five, as in OSQP. A smaller change is not worth the factorisation
/// of W + ρI. Only the number of iterations depends on it.
/// Set.
pub const BALANCE: f64 = 5.0;

/// Number of past values of the objective that a Barzilai–Borwein step must stay below: ten, as Birgin, Martínez and Raydan choose. Only
/// the number of steps depends on it.
/// Set.
pub const PAST_VALUES: usize = 10;

/// Share γ of the predicted fall that a Barzilai–Borwein step must achieve: 10⁻⁴, as Birgin, Martínez and Raydan choose. The exact minimum
/// along the direction meets any γ < ½.
/// Set.
pub const ARMIJO: f64 = 1e-4;

/// Relative asymmetry max|W − Wᵀ|/max|W| up to which W counts as symmetric: the rounding of sums of 1000 products, 2000 ε ≈ 4e-13.
/// Derived.
pub const SYMMETRY: f64 = 2000.0 * EPSILON;

/// Stopping tolerances asked of Clarabel. Its default 1e-8 leaves natural maps up to 2e-5, and near 1e-14 it breaks down. The answer is
/// polished and judged in any case.
/// Set.
pub const CLARABEL: f64 = 1e-10;

/// How far the velocities y of two answers to one convex problem may differ \[m/s\], when their natural maps are e₁ and e₂ and
/// `residual` = ‖e₁‖ + ‖e₂‖, `impulses` = ‖r₁ − r₂‖ + ‖e₁‖ + ‖e₂‖, `norm` ≥ ‖W + R‖, `rho` = smallest ρ.
///
/// p_i = r_i − e_i is the projection of r_i − ρy_i, so ⟨e_i − ρy_i, p_j − p_i⟩ ≤ 0; the sum of the two is
/// ρ⟨Δy, Δp⟩ ≤ ⟨Δe, Δp⟩. With Δy = (W + R)Δr: ‖Δy‖² ≤ norm·ΔrᵀΔy ≤ norm·residual·(impulses/ρ + ‖Δy‖), a quadratic
/// inequality for ‖Δy‖ whose larger root is at most `b + √c`, b = norm·residual, c = b·impulses/ρ. A ρ that varies between contacts weighs
/// them, which the smallest one covers.
/// Derived.
pub fn agreement(norm: f64, residual: f64, impulses: f64, rho: f64) -> f64 {
    let linear = norm * residual;
    linear + (linear * impulses / rho).sqrt()
}

/// Sweeps that polish an interior-point answer. That answer shows which contacts stick, slide and open. If it shows them correctly, a few
/// sweeps finish. 2000 sweeps cost as much as one interior-point solve.
/// Set.
pub const POLISHING_SWEEPS: usize = 2000;

/// Relative weight 2⁻²⁰ of the proximal term of a rank-deficient diagonal block. The factorised block keeps 52 − 20 bits. Every sweep
/// reduces the error of the stiff directions by the factor 2⁻²⁰.
/// Set.
pub const PROXIMAL: f64 = 1.0 / 1_048_576.0;

/// Most steps of a bracketed root search in \[0, 1\] that halves the bracket at least every third step. 3·53 steps make its ends
/// neighbours, and as many again find roots down to 2⁻¹⁰⁶.
/// Set.
pub const ROOT_STEPS: usize = 2 * 3 * 53;

/// Slope of a line search, relative to that at its start, at which a step counts as exact: 2⁻⁴⁰. The step is off by less than that part of
/// itself. Newton's method then squares its error only down to 2⁻⁴⁰ of the last one, which is below what a solution needs after two steps.
/// Set.
pub const LINE_SLOPE: f64 = 1.0 / (1u64 << 40) as f64;

/// Most steps of Newton's method on a soft convex problem, against endless loops. Each step changes the zone of at least one contact or
/// squares the error. No bound depends on this number.
/// Set.
pub const NEWTON_STEPS: usize = 200;

/// Relative fall of the cost ½ΔᵀMΔ + s that is more than rounding: 2⁻⁴². A sum of at most 500 squares has the relative error 2·500 ε.
/// Derived.
pub const COST_FLOOR: f64 = 1.0 / (1u64 << 42) as f64;

/// Steps of Newton's method in a row that reduce neither cost nor gradient, after which only rounding is left. A step with an exact line
/// search reduces the cost, unless the reduction is as small as rounding. Three steps leave room for one exception.
/// Set.
pub const NEWTON_STALLED: usize = 3;

/// Most steps of the interior point method. A convex problem takes some twenty; Coulomb's lift may take a few times as many.
/// Set.
pub const INTERIOR_STEPS: usize = 100;

/// Steps of the interior point method in which neither the gap nor the residual of y is halved, after which rounding has ended it.
/// Set.
pub const INTERIOR_PATIENCE: usize = 3;

/// Steps of the first Newton iteration where W is stored by blocks: where it does not end soon, interior points lead it.
/// Set.
pub const SHORT_STEPS: usize = 12;

/// The same at up to [`SMOOTHED_CONTACTS`] contacts with friction, where Fischer and Burmeister's equations lead it: of 171 steps of thrown
/// bodies that twelve did not end eight more ended 24, the eight after these six.
/// Set.
pub const STEPS_OF_FEW: usize = 20;

/// How far of the way to the boundary a step of the interior point method goes: the usual share, which keeps it inside.
/// Set.
pub const BOUNDARY: f64 = 0.99;

/// The least part of the gap that a step aims at: without it the last steps leave the middle.
/// Set.
pub const LEAST_CENTRING: f64 = 1e-6;

/// What x is at first, in impulses that give a contact alone the largest velocity of the data: contacts carry what stands on them, and from
/// too little the first steps are short. Twelve walls of 100 to 10 084 contacts, nine of them pushed, took auto to 10⁻⁶ a geometric mean of
/// 0.118 s from ten where what leaves the middle is put back, 0.129 s where it is not, and 0.164 and 0.143 s from one.
/// Set.
pub const FIRST_IMPULSE: f64 = 10.0;

/// Roots of products within this part of the gap and as many times it are in the middle: as in the source of the method.
/// Set.
pub const MIDDLE: f64 = 0.1;

/// How far the gap may close before the equations of y: it stays above this times its first value, times how much is left of their
/// residual.
/// Set.
pub const LAG: f64 = 1.0 / 32.0;

/// The shortest step of the interior point method that is progress.
/// Set.
pub const LEAST_LENGTH: f64 = 1e-10;

/// Contacts up to which `auto` ends Coulomb's law by convex problems, each of which takes the time of a solve.
/// Set.
pub const LIFTED_CONTACTS: usize = 600;
