//! The incline: where Coulomb's block sticks, where it slides and how fast, and whether it stays on the plane.
//!
//! ```text
//!     tan α ≤ μ      rest
//!     tan α > μ      v̇ = g (sin α − μ cos α) ,   φ = 0
//!     any normal impulses, friction on the cone and opposed to slip:   v_t + μ v_n = g (sin α − μ cos α) t
//! ```

mod hop;
pub(super) mod scenes;
pub(super) mod slide;
pub(super) mod stick;

use crate::check::{Control, Expected, Run};
use crate::{Check, Level, Verdict};

/// The checks of the family.
pub const CHECKS: &[Check] = &[
    Check {
        name: "incline/stick",
        level: Level::Simulate,
        question: "Does a box rest on a 20° slope with μ = 0.5, or does it creep?",
        derivation: "tan 20° = 0.364 < μ, so that Coulomb's box does not move. Creep is the displacement over the second half of 1 s. A \
            solver that leaves √ε of single precision of a step's impulse creeps with √2⁻²³ g sin α h. These laws creep: MuJoCo with m \
            g sin α/(b Σ 1/R_t), independent of h, and its pyramid with the root of Σ μ(f⁺ − f⁻) = m g sin α; SAP with σ h m g sin α/Σ \
            1/w_i; Similar and Lagged with v_s s, s/√(1 + s²) = tan α/μ; TAMSI with s (2 − s) = tan α/μ. The corners carry the loads ¼ m \
            g (cos α ± (c/a) sin α).",
        source: "Coulomb's law; chapter §5, §6; MuJoCo and Drake documentation",
        run: Run::EachStep(stick::stick),
        control: Control { passes: "moreau-jean", fails: "incline/regularised-friction" },
    },
    Check {
        name: "incline/stick-threshold",
        level: Level::Simulate,
        question: "Does a flat box stick with tan α just below μ, and slide with tan α just above?",
        derivation: "μ = tan α (1 ± 1/16). Above tan α the creep is that of incline/stick. Below it v_t + μ v_n = g sin α t/16 for any \
            normal impulses. A law that needs a slip v_c to saturate gains at most μ g cos α v_c/a. A law that hops may land with less \
            than full friction.",
        source: "Coulomb's law: rest exactly for tan α ≤ μ",
        run: Run::EachStep(stick::threshold),
        control: Control { passes: "moreau-jean", fails: "incline/friction-squared" },
    },
    Check {
        name: "incline/slide",
        level: Level::Simulate,
        question: "Does a box slide down a 20° slope with g (sin α − μ cos α), and keep the momentum law through every hop?",
        derivation: "Constant forces are integrated exactly, so that only one step's friction at the start may be off: μ g cos α h/T. If \
            friction is on the cone's boundary and opposed to slip, v_t + μ v_n = g (sin α − μ cos α) T for every sequence of normal \
            impulses. Convex laws hop, and their acceleration differs from the ideal by exactly −μ v_n/T.",
        source: "Coulomb's law; chapter §5 for the lift-off of the relaxation",
        run: Run::EachStep(slide::slide),
        control: Control { passes: "moreau-jean", fails: "incline/friction-not-opposed" },
    },
    Check {
        name: "incline/hop",
        level: Level::Simulate,
        question: "Does a sphere that is set on the floor with a slip of 2 m/s stay on it?",
        derivation: "Friction has no vertical part, so that Coulomb's sphere stays. The associated law asks u_n ≥ μ‖u_t‖ − φ/h of a \
            contact. So a sphere that starts at φ = 0 jumps with v_n = μ (v − μ c g h)/(1 + μ² c), c = 7/2 (Anitescu). The jumps of SAP \
            and MuJoCo are replayed step by step in closed form. A step that pushes the sphere out of a depth δ in which it was seen lifts \
            it by δ + (δ/h)²/2g, with δ ≤ 3/2 g h².",
        source: "chapter §5; closed_forms::sliding_contact",
        run: Run::EachStep(hop::hop),
        control: Control { passes: "moreau-jean", fails: "incline/undeclared-relaxation" },
    },
    Check {
        name: "incline/gap",
        level: Level::Simulate,
        question: "How far above a 40° slope is a sphere that slides down it?",
        derivation: "Under Coulomb's law the gap is 0. The associated law asks φ/h + u_n ≥ μ‖u_t‖ of a hard contact, so that a steady \
            slide from rest opens by μ h‖u_t‖. SAP's and MuJoCo's contacts end at φ = 0, so that they hop. Their motion is replayed step \
            by step in closed form. The allowance is multiplied by the distance that two replays from neighbouring starts reach.",
        source: "chapter §5; closed_forms::sliding_contact, drake_sap",
        run: Run::EachStep(hop::gap),
        control: Control { passes: "moreau-jean", fails: "incline/undeclared-relaxation" },
    },
];

/// The derived verdicts that are not `pass`.
pub const EXPECTED: &[Expected] = &[
    Expected {
        scheme: "anitescu",
        check: "incline/hop",
        verdict: Verdict::Difference,
        why: "set down at φ = 0 with a slip of 2 m/s it jumps with μ (v − μ c g h)/(1 + μ² c) ≈ 0.45 m/s",
    },
    Expected { scheme: "anitescu", check: "incline/gap", verdict: Verdict::Difference, why: "a slide opens by μ h‖u_t‖" },
];
