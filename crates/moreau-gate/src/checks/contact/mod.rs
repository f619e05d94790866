//! The reported impulses: in the friction cone, only in contact, opposed to slip, not a source of energy, and those that moved the body.
//!
//! ```text
//!     p ∈ K_μ ,   p_n > 0 ⇒ in contact ,   p_t = −μ p_n u_t/‖u_t‖ while sliding ,   ½ pᵀ(u⁻ + u⁺) ≤ 0
//!     m Δv = m g Δt + p ,   J Δω = ℓ × p
//! ```
//! Impulses are those of a pair of bodies, summed over its points: a sum of elements of K_μ with one normal is in K_μ. Where slip must be
//! known, the body is a sphere: one contact point, whose velocity follows from the body's.

mod feet;
mod laws;
mod momentum;
mod pairs;
mod thrown;

use crate::check::{Control, Expected, Run};
use crate::{Check, Level, Verdict};

/// The checks of the family.
pub const CHECKS: &[Check] = &[
    Check {
        name: "contact/cone",
        level: Level::Simulate,
        question: "Is every reported impulse in the friction cone, with the normal of the floor?",
        derivation: "‖p_t‖ ≤ μ p_n for every contact point, hence for their sum. A sphere and a tumbling box land and slide. The excess \
            is relative to the largest normal impulse of the motion. Lagged friction takes its bound from n₀ = h k δ (1 − d v_n) before \
            the step, softened over max(v_s, σ w μ n₀). It leaves the cone by what that formula gives for the measured states. A pyramid \
            around the cone leaves it by (√2 − 1) μ.",
        source: "Coulomb's law; protocol: normal from the second body to the first, impulse on the first",
        run: Run::EachStep(laws::cone),
        control: Control { passes: "moreau-jean", fails: "contact/lagged-normal" },
    },
    Check {
        name: "contact/complementarity",
        level: Level::Simulate,
        question: "Do impulses act only in contact, and does a sphere in contact stop approaching the floor?",
        derivation: "Signorini: p_n > 0 only at φ = 0. A step may act on a contact that it reaches: φ ≤ h (|v_n| + g h). The relaxation \
            also acts at φ ≤ μ h‖u_t‖. Without restitution, u_n ≥ −g h after a second step with impulse. Soft contacts approach while \
            they are compressed, so that only their impulses are checked.",
        source: "Signorini's condition; chapter §3–§5",
        run: Run::EachStep(laws::complementarity),
        control: Control { passes: "moreau-jean", fails: "contact/early" },
    },
    Check {
        name: "contact/dissipation",
        level: Level::Simulate,
        question: "While a sphere slides, is friction on the cone's boundary and opposed to the slip?",
        derivation: "Maximal dissipation: p_t = −μ p_n u_t/‖u_t‖ at the slip after the step. Steps that start or end near sticking are \
            left out. With d directions the force is off by at most 2 sin(π/2d). A regularised law is off by what its formula gives for \
            the measured states.",
        source: "principle of maximal dissipation; cones::polyhedral",
        run: Run::EachStep(laws::dissipation),
        control: Control { passes: "moreau-jean", fails: "incline/kinetic-friction" },
    },
    Check {
        name: "contact/increment",
        level: Level::Simulate,
        question: "Does a contact without restitution ever do positive work on a sphere?",
        derivation: "The work of an impulse over its step is ½ pᵀ(u⁻ + u⁺), which is not positive without restitution. A contact that is \
            found while the sphere still rises at u < g h takes p_n = m (g h − u), and may give ½ p_n u ≤ m g² h²/8. Where error \
            reduction is declared, a depth δ asks for w = r δ/h, which may give ½ m (w − u + g h) (u + w). A compliant contact gives back \
            the energy that it has stored, so that its sum since the start is checked. The work of friction alone is never positive, or \
            its sum is not with a declared spring along the floor: it opposes the slip after the step. The sphere slips until the end.",
        source: "ΔT = ½ pᵀ(u⁻ + u⁺), exact for one step",
        run: Run::EachStep(laws::increment),
        control: Control { passes: "moreau-jean", fails: "contact/friction-along-slip" },
    },
    Check {
        name: "contact/momentum",
        level: Level::Simulate,
        question: "Do the reported impulses account for every change of momentum and of angular momentum?",
        derivation: "m Δv = m g Δt + p in every interval, and J Δω = ℓ × p with the lever ℓ of the contact point. For a sphere ℓ = −(R + \
            φ) n. Its gap or depth φ is that at the start or at the end of the step, wherever the engine looks for contacts. For a box \
            that lands on an edge, ℓ leads to the middle of the edge. It is known up to the depth and the turn of the box in the step. \
            The differences are relative to the impulses of the interval. Declared damping takes c m Δx and c_ω J ω h.",
        source: "Newton–Euler; protocol: impulses summed over the interval that ends at the sample",
        run: Run::EachStep(momentum::momentum),
        control: Control { passes: "moreau-jean", fails: "contact/late" },
    },
    Check {
        name: "contact/pairs",
        level: Level::Simulate,
        question: "Do the impulses reported between two bodies account for the motion of both, also over several steps?",
        derivation: "m Δv = m g Δt + Σ p for both bodies of a pair, with p on the one named first and −p on the other, summed over all \
            steps since the sample before. A ball slides on a plate that lies on the floor, and two spheres meet; every step and every \
            seventh is sampled. The difference is relative to Σ‖p‖ + m g Δt. Declared damping takes at most m c Δt (v + g Δt). No impulse \
            pulls along the normal that is reported with it, which points to the body named first.",
        source: "Newton's second and third law; protocol: impulses summed over the interval that ends at the sample",
        run: Run::EachStep(pairs::pairs),
        control: Control { passes: "moreau-jean", fails: "contact/last-step-reported" },
    },
];

/// The derived verdicts that are not `pass`.
pub const EXPECTED: &[Expected] = &[
    Expected {
        scheme: "anitescu",
        check: "contact/complementarity",
        verdict: Verdict::Difference,
        why: "acts at gaps up to h |v_n| + μ h‖u_t‖, several millimetres at 1/60 s",
    },
    Expected {
        scheme: "stewart-trinkle",
        check: "contact/dissipation",
        verdict: Verdict::Difference,
        why: "friction along 45° turns the slip to the bisector at 22.5°, where the force is off by up to 2 sin(π/16) = 0.39",
    },
];
