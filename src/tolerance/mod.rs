//! Every tolerance, each with the reason for its value. The tolerances of the crates below are re-exported. Those of the claims and of the
//! command line are defined here.
//!
//! The last line of a tolerance's documentation says which of three it is:
//! - *derived*: a rounding bound (a constant times the unit roundoff times the size of the data), a proven bound of a scheme (a constant
//!   times a power of h), or an engine's documented stopping tolerance propagated through the conditioning of the problem;
//! - *required*: a promise, with who makes or needs it;
//! - *measured*: with the script that measures it.
//!
//! A fourth word, *set*, marks what is no tolerance: the step of a reference, a stopping rule whose answers are judged by something else, a
//! limit of work or size, what an inexact word of a sentence is taken to mean. `tests/architecture/` holds every one to its word.

pub use moreau_checks::tolerance::{self as checks, convergence, zeno};
pub use moreau_contact::tolerance::{certificate, complementarity, cones, joints, problem, proof, solvers};
pub use moreau_dynamics::tolerance::{event_driven, impact_laws, integrators, mechanics, scenes, schemes, stabilisation, trajectory};
pub use moreau_exact::tolerance::{EPSILON, rounding};
pub use moreau_gate::tolerance as gate;
pub use moreau_replicas::tolerance::{energy_balance, references};

pub mod limits;
pub mod regression;

/// How `moreau bench` sums up and shows times.
pub mod bench {
    /// The shift of the geometric mean \[s\]: differences of times far below it do not count.
    /// Set.
    pub const SHIFT: f64 = 1e-4;
    /// Shorter times are shown in microseconds \[s\].
    /// Set.
    pub const MILLISECOND: f64 = 1e-3;
}

/// Tolerances of [`crate::systems`], and how its table shows differences.
pub mod systems {
    pub use moreau_replicas::tolerance::systems::*;

    /// Differences below this are shown as a bound, the power of ten above them: their digits come from rounding and stopping tests and
    /// may be others on another processor.
    /// Set.
    pub const DIGITS_SHOWN: f64 = 1e-6;

    /// The smallest such bound, half the spacing of the numbers at 1 and whatever is below it.
    /// Set.
    pub const SMALLEST_SHOWN: f64 = 1e-16;
}

pub use moreau_forms::tolerance as closed_forms;

/// Tolerances of [`crate::claims`].
pub mod claims {
    pub mod drake;
    pub mod elastic;
    pub mod engines;
    pub mod events;
    pub mod impact;
    pub mod integrators;
    pub mod pathology;
    pub mod soft;
    pub mod stabilisation;
    pub mod thresholds;

    /// Relative difference of two creep speeds of MuJoCo's default contact that are one speed: what is left after a quarter of a second of
    /// its transient (1 + t/t_c) e^{−t/t_c}, t_c = 0.02 s, is 13.5 e^{−12.5} = 5.1e-5 of either speed, together below 2⁻¹³.
    /// Derived.
    pub const SAME_CREEP: f64 = 1.0 / 8192.0;

    /// Error of the height w²/(2g) to which a body that leaves the floor at w \[m/s\] rises under steps h: the launch is off by at most
    /// δ = g h (1 + μ), the load of the first step, hence the height by (2wδ + δ²)/(2g); the free flight q⁺ = q + h v⁺ rises by at most w h
    /// less, and is sampled to within g h².
    /// Derived.
    pub fn rolling_hop(launch: f64, friction: f64, gravity: f64, h: f64) -> f64 {
        let off = gravity * h * (1.0 + friction);
        (2.0 * launch * off + off * off) / (2.0 * gravity) + launch * h + gravity * h * h
    }

    /// Step of the Runge–Kutta integration of a soft impact in `S2.soft-limit`, in units of √(m/k).
    /// Set.
    pub const SOFT_STEP: f64 = 1.0 / 256.0;

    /// Error of the speed after a soft impact: the classical Runge–Kutta method on y′ = A y errs by (‖A‖h)⁵/120 a step,
    /// ‖A‖ ≤ 1 + 2ζ ≤ 2 for ζ ≤ ½, over at most 4/h steps (contact lasts π/√(1−ζ²) < 4), in a norm that does not grow.
    /// The end of the contact moves with the state, which changes the speed by at most (1 + 2ζ)(1 + 1/(2ζ)) ≤ 8 times
    /// that for ζ ≥ 0.2 (for ζ = 0 contact ends where the force is zero, so the factor is 1).
    /// Derived.
    pub fn soft_restitution() -> f64 {
        8.0 * 4.0 * 32.0 / 120.0 * SOFT_STEP.powi(4) + super::EPSILON * 4.0 / SOFT_STEP
    }

    /// How far a fitted order may be from the order of the method, an integer. Over the fitted ranges (a factor 8 or more in h) the
    /// constant of an error C hᵖ then drifts by less than 8^⅛ < 1.3: where it drifts by more, h is too large to speak of an order. A
    /// neighbouring order is eight times as far away.
    /// Required: of a statement that names an order, by its readers.
    pub const ORDER_GAP: f64 = 0.125;

    /// Half a unit in the last printed digit of a time with twelve decimals \[s\].
    /// Derived.
    pub const PRINTED_TIME: f64 = 0.5e-12;

    /// How far the variation of the discrete velocity may be from the closed form: with the sums of
    /// [`crate::tolerance::convergence`], p ≤ 3/2 and λ ≤ 1, the speed before an impact is off by at most
    /// g h (½ + (1+e)/e · 3/2 + 1); the impacts up to speed g h count ln(t₁/h)/ln(1/e) + 1; each jump counts (1+e) times and
    /// each flight twice its speed over g. After that both motions vary by at most 2 g h (1+e)/(1−e), and twice as much for
    /// the discrete one.
    /// Derived.
    pub fn variation(gravity: f64, restitution: f64, fall: f64, h: f64) -> f64 {
        let e = restitution;
        let speed = 1.5 + 1.5 * (1.0 + e) / e;
        let impacts = (fall / h).ln() / (1.0 / e).ln() + 1.0;
        gravity * h * ((3.0 + e) * speed * impacts + 6.0 * (1.0 + e) / (1.0 - e))
    }

    /// Bound on |q_{k+1} − q_k|/h: the impact speed g t₁, one step late under any rule and θ, 2 g h.
    /// Derived.
    pub fn position_slope(gravity: f64, fall: f64, h: f64) -> f64 {
        gravity * (fall + 2.0 * h)
    }

    /// Step of the slide in `S4.d8` \[s\], about 1/1700 of its duration.
    /// Set.
    pub const SLIDE_STEP: f64 = 1.0 / 8192.0;

    /// Error of the sideways drift, over the stopping distance v²/(2a), of a slide from v = 1 m/s at the deceleration a:
    /// the position update is off by at most h v, the turn to the bisector by one step, that is 2 a h in velocity over the
    /// duration v/a, and the slide is cut one step before its end (h v): in all 4 h v, over v²/(2a).
    /// Derived.
    pub fn slide_drift(deceleration: f64) -> f64 {
        8.0 * deceleration * SLIDE_STEP
    }

    /// Width at which Gilbert's distance enclosure stops \[m\]: both bounds are rounded to a few ε times 1 m, and the
    /// distances and depths compared differ by 0.05 m, so any width far between serves; 2⁻³⁰.
    /// Set.
    pub const GILBERT_WIDTH: f64 = 1.0 / (1u64 << 30) as f64;

    /// Claims on the θ scheme (§3).
    pub mod theta_scheme {
        use super::super::{EPSILON, mechanics::DIFFERENCE_STEP};

        /// Largest over smallest constant C in error = C hᵖ for q̈ = −q at t = 2 and h ≤ 1/32.
        ///
        /// θ = ½ turns by 2 atan(h/2) instead of h: phase error t h²/12·(1 − 3h²/20…). θ = 1 has
        /// n(−ln(1−z) − z) = n z²/2·(1 + 2z/3 + …), |z| = h, so C lies within (1 ± 0.022)(1 ± 0.032) of t/2.
        /// Derived.
        pub const METHOD_CONSTANTS: f64 = 1.15;

        /// Error of a determinant of two central differences of one step of the pendulum: each entry has truncation
        /// d²/6·|f‴| ≤ d² and rounding of 32 operations of size 1 over 2d; the determinant doubles it.
        /// Derived.
        pub fn central_difference_of_step() -> f64 {
            2.0 * (DIFFERENCE_STEP * DIFFERENCE_STEP + 16.0 * EPSILON / DIFFERENCE_STEP)
        }

        /// Rounding of the energy of a pendulum before and after a step: 16 operations on terms of size at most 2,
        /// and a step solved to relative ε with ∂E at most 1 in both coordinates.
        /// Derived.
        pub fn pendulum_energy() -> f64 {
            super::super::rounding(16, 2.0)
        }

        /// Error of r/R − 1 = y/2 for r² = R²(1 + y(1 − x)) with 0 ≤ x ≤ y: y²/2 from x and y²/8 from the root.
        /// Derived.
        pub fn bead_sagitta(growth: f64) -> f64 {
            growth * growth
        }

        /// Largest speed of an elastic ball dropped from rest at q₀ under θ = 1, on the floor or one step below it: E − ½ m g h v is
        /// conserved and q ≥ −h|v|, so v² − g h|v| ≤ 2 g q₀.
        fn fastest(gravity: f64, height: f64, h: f64) -> f64 {
            (2.0 * gravity * height).sqrt() + gravity * h
        }

        /// How far the energy of such a ball may be from its start, over its start m g q₀: ½ m g h|v| for the largest |v|.
        /// Derived.
        pub fn elastic_energy_swing(gravity: f64, height: f64, h: f64) -> f64 {
            0.5 * h * fastest(gravity, height, h) / height
        }

        /// Bounces that such a ball makes at least: it lands √(2q₀/g) after the start, two steps late at most. It leaves with a speed v
        /// from at most 2 h v + g h² above the floor, and by the conserved E − ½ m g h v it is down again when it falls with v + g h, so
        /// a flight and its bounce last at most 2v/g + 3h.
        /// Derived.
        pub fn fewest_bounces(gravity: f64, height: f64, h: f64, duration: f64) -> f64 {
            let landing = (2.0 * height / gravity).sqrt() + 2.0 * h;
            let flight = 2.0 * fastest(gravity, height, h) / gravity + 3.0 * h;
            ((duration - landing) / flight).floor() + 1.0
        }

        /// By how much the largest |E − E₀| of one window of a swing may exceed that of another: E − E₀ goes through two cycles in a
        /// swing, of frequency at most 1, so between samples h apart its peak is missed by at most ½ (2 · h/2)² = h²/2 of it, in either.
        /// Derived.
        pub fn sampled_peak(h: f64) -> f64 {
            h * h
        }
    }

    /// Claims on the Stewart–Trinkle LCP and the normal LCP.
    pub mod lcp {
        use super::super::{EPSILON, rounding};

        /// Impulse \[N·s\] of one Stewart–Trinkle step of Painlevé's rod against its closed form W⁻¹(g h, 1).
        ///
        /// The gap y − l sin θ of a touching rod is rounded by 4 operations at size 1, and φ/h by that over h; W has entries
        /// up to 3 from some 16 products, and ‖W⁻¹‖ ≤ trace W / det W = 5/4 carries both into the impulse.
        /// Derived.
        pub fn painleve_impulse(h: f64) -> f64 {
            1.25 * (rounding(4, 1.0) / h + rounding(16, 3.0))
        }

        /// Gap after a tangential step h on the unit circle with unit speed, over h²: √(1 + h²) − 1 lies in (½h² − h⁴/8, ½h²),
        /// and the gap 1 − |q| of size 1 is rounded by 4 operations.
        /// Derived.
        pub fn circle_residual(h: f64) -> f64 {
            h * h / 8.0 + rounding(4, 1.0) / (h * h)
        }

        /// Rounding of a linearised gap constraint of size 1, solved and evaluated in some 16 operations.
        /// Derived.
        pub const LINEARISED_GAP: f64 = 32.0 * EPSILON;

        /// Rounding of n steps of one contact with velocities up to 10 m/s. Each step rounds some 20 operations on numbers of that
        /// size. The map of a step is non-expansive, so errors do not grow from step to step.
        /// Derived.
        pub fn repeated_steps(steps: usize) -> f64 {
            rounding(20 * steps, 10.0)
        }

        /// Velocity \[m/s\] of two answers of projected Gauss–Seidel to one problem with impulses up to 8 and diagonal up to 3: each
        /// stops at a natural map of at most STOP·8, which bounds |u| at its pressed contacts by 3·8·STOP.
        /// Derived.
        pub const SWEEP_VELOCITY: f64 = 48.0 * super::super::solvers::STOP;
    }
}

/// Tolerances of [`crate::report`].
pub mod report {
    /// A lower bound below this is the rounding of a check, for the chapter prints no length, speed or energy as small; a reader is told
    /// that the quantity is “more than 0”.
    /// Set.
    pub const BELOW_ALL_THAT_IS_STATED: f64 = 1e-9;

    /// What rounding alone can make of a length in a motion of coordinates up to `size` \[m\], after `steps` steps: each rounds the product
    /// h v, whose size is that of a way travelled, and the sum it is added to; a gap or a distance is then evaluated in 16 operations.
    /// Derived.
    pub fn length_noise(steps: usize, size: f64) -> f64 {
        super::rounding(2 * steps + 16, size)
    }

    /// What rounding alone can make of the difference of two energies of a motion, each the sum of terms up to `size` \[J\]: a step rounds
    /// velocity and position twice each, and T changes by 2 T, V by V relative to them; each energy is evaluated in 32 operations.
    /// Derived.
    pub fn energy_noise(steps: usize, size: f64) -> f64 {
        super::rounding(4 * steps + 64, size)
    }

    /// The mean speed \[m/s\] above which a body that rests, with speeds up to `resting` \[m/s\], creeps: what a step leaves of a velocity
    /// whose residual is accepted at [`CERTIFY`](super::cli::CERTIFY) of that speed's scale, and the rounding `length` \[m\] of both
    /// positions over the `time` \[s\] between them.
    /// Derived.
    pub fn creep(resting: f64, length: f64, time: f64) -> f64 {
        super::cli::CERTIFY * resting + 2.0 * length / time
    }

    /// Part of a body's smallest half extent from which on a penetration is remarked on: nothing is judged by it.
    /// Set.
    pub const DEEP: f64 = 0.1;

    /// Part of the largest way of a coordinate below which a coordinate is not drawn.
    /// Set.
    pub const BARELY_MOVING: f64 = 0.05;
}

/// Tolerances of [`crate::cli`].
pub mod cli {
    pub use moreau_contact::tolerance::certificate::CERTIFY;

    /// Part of the tolerance asked for at which a solver stops: a half, so that the certificate, which computes y anew, accepts it.
    /// Set.
    pub const ASKED_SHARE: f64 = 0.5;

    /// Longest time that a solve may be given \[s\]: thirty years, beyond which clocks of some machines do not count.
    /// Set.
    pub const LONGEST_SECONDS: f64 = 1e9;

    /// A time limit that is over before any work begins \[s\]: a thread that is to end it takes longer to begin.
    /// Set.
    pub const SHORTEST_SECONDS: f64 = 1e-6;

    /// Most steps `simulate` records: a body takes about 200 bytes per step in memory and 300 in a file, so that a scene
    /// of a few bodies stays near a gigabyte.
    /// Set.
    pub const STEP_LIMIT: usize = 1_000_000;
}
