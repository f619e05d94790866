//! Bodies that spin: freely, upright on a floor, flat on a floor.
//!
//! ```text
//!     free about a principal axis      R(t) = exp(t ω) R₀
//!     free about no principal axis     T = ½ωᵀRJRᵀω and ‖RJRᵀω‖ constant
//!     ball, upright, on a floor        ω·n constant
//!     box, flat, on a floor            ⅓ ρ (ω₀ − ω) = μ (g t + v_n)
//! ```

mod drilling;
mod flat_box;
mod free;
mod gyroscopic;

pub(crate) use gyroscopic::LONG_STEP;

use crate::check::{Control, Expected, Run};
use crate::{Check, Level, Verdict};

/// The checks of the family.
pub const CHECKS: &[Check] = &[
    Check {
        name: "spin/free-sphere",
        level: Level::Simulate,
        question: "Does the orientation of a free spinning ball turn with its angular velocity, and that of a box about a principal axis?",
        derivation: "ω is constant, so that R(t) = exp(t ω) R₀. A step turns by h ω exactly (exponential), by 2 atan(½ h ω) (a quaternion \
            that is normalised, Cayley's map) or by atan(h ω) (a matrix that is made orthogonal): at most ⅓ (h ω)² of the angle is \
            missing. Declared damping turns it by (1 − e^{−ct})/c ω.",
        source: "kinematics of the rigid body; Hairer, Lubich, Wanner, Geometric Numerical Integration, §IV",
        run: Run::EachStep(free::sphere_and_box),
        control: Control { passes: "moreau-jean", fails: "spin/sphere-not-turned" },
    },
    Check {
        name: "spin/drilling",
        level: Level::Simulate,
        question: "Does a ball that spins upright on the floor keep its spin about the normal?",
        derivation: "A contact point has the lever −R n, so that n·(ℓ × p) = 0 for every impulse. Friction against drilling needs a \
            length that Coulomb's law of a point does not have. The lever is along the normal to √ε of itself; the rest is rounding. \
            Declared damping takes 1 − e^{−ct}.",
        source: "Newton–Euler; Contensou's friction has the radius of a contact patch",
        run: Run::EachStep(drilling::drilling),
        control: Control { passes: "moreau-jean", fails: "spin/drilling-friction" },
    },
    Check {
        name: "spin/flat-box",
        level: Level::Simulate,
        question: "Is a box that is spun flat, on the floor or on a slab, stopped at J ω₀/(μ m g √(a² + b²))?",
        derivation: "The balance of moments gives opposite corners the same load, whatever the solver chooses: no net friction, and the \
            moment μ ρ Σ N with ρ² = a² + b². With J = ⅓ m ρ² and Σ N = m (g + v̇_z) this is ⅓ ρ (ω₀ − ω) − μ v_z = μ g t through \
            every hop. A step may take the direction of friction at either of its ends: ½ (h ω)² of it. Corner spheres of a declared \
            radius have a shorter ρ; a pyramid has between μ/√2 and √2 μ, d directions μ cos(π/d) at least. A declared torsional \
            friction a ≤ ½ μ ρ adds a/ρ \
            to μ beside Coulomb's cone; with more the box stops too early to be measured, and other laws with one are not asked. \
            Corners whose depth is taken back by declaration open when nothing is left of it, and move at up to 3/2 g h; a part of more \
            than a third lets the box hop, and is not asked. A heavier and longer slab, \
            which the floor holds, stops it as the floor does.",
        source: "Newton–Euler and Coulomb, summed over four points",
        run: Run::EachStep(flat_box::flat_box),
        control: Control { passes: "moreau-jean", fails: "spin/no-yaw-friction" },
    },
    Check {
        name: "spin/gyroscopic",
        level: Level::Simulate,
        question: "Does a free box keep its kinetic energy and its angular momentum over ten turns, at 0.003 s over a thousand, or do \
            they grow?",
        derivation: "An explicit step of J Ω̇ = JΩ × Ω = τ adds ½h² τᵀJ⁻¹τ to the energy and h²‖τ‖² to ‖L‖² every time, an implicit one \
            takes as much: both add up over the turns. Symplectic steps swing by h Σ J_k |Ω₁Ω₂Ω₃| at most, a sixth of that over ten \
            turns, whatever h. So growth beyond the swing fails, and a loss beyond that of implicit steps. A step turns the box by 0.1 \
            rad at most. At 0.003 s, a step of the whole sweep, an engine that passes is asked for a hundred and a thousand turns with \
            0.05 rad in a step, of a box whose moments are given; hω alone decides the motion. Explicit steps add 0.032 of the energy and \
            0.022 of ‖L‖ in a turn; the swing, 0.049 and 0.003, does not add up, so that a growth by one swing over the thousand turns \
            fails. Implicit steps lose 0.52 of the energy and 0.46 of ‖L‖ and end in a spin about the axis of the smallest moment: more \
            than they lose fails. Where damping of spins is declared, ten turns are all.",
        source: "Hairer, Lubich, Wanner, Geometric Numerical Integration, §VII.5, §IX.8",
        run: Run::EachStep(gyroscopic::gyroscopic),
        control: Control { passes: "moreau-jean", fails: "spin/explicit-gyroscopic-torque" },
    },
];

/// The derived verdicts that are not `pass`.
pub const EXPECTED: &[Expected] = &[Expected {
    scheme: "stewart-trinkle",
    check: "spin/flat-box",
    verdict: Verdict::Difference,
    why: "friction along the nearest of eight directions, cos(π/8) = 0.92 of it at least as the slip turns past them",
}];
