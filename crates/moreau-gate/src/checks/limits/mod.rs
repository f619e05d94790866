//! Silent limits: of speed, of spin, of what sticks.

mod fast;
mod stick;

use crate::check::{Control, Run};
use crate::{Check, Level};

/// The checks of the family.
pub const CHECKS: &[Check] = &[
    Check {
        name: "limits/fast",
        level: Level::Simulate,
        question: "Do free bodies keep a speed of 300 m/s and a spin of 200 rad/s?",
        derivation: "Without forces v and, for equal moments of inertia (a sphere, a cube), ω are constant for every h. Only rounding \
            remains. Declared damping takes 1 − e^{−ct} of them.",
        source: "Newton's first law; engines that clamp speeds and spins",
        run: Run::EachStep(fast::fast),
        control: Control { passes: "moreau-jean", fails: "limits/spin-at-most-50" },
    },
    Check {
        name: "limits/stick",
        level: Level::Simulate,
        question: "Is there one coefficient of friction, for what sticks and for what slides, to two percent?",
        derivation: "As incline/stick-threshold, with a plate and μ = tan α (1 ± 1/50). Below tan α v_t + μ v_n = g sin α t/50 for any \
            normal impulses: 0.07 m/s². A ball rolls as long as 2/7 tan α ≤ μ; with a fiftieth less friction its slip u = v − ωR obeys \
            u + 7/2 μ v_n = g sin α t/50, with one contact and no redundant ones. Its lever is R − δ for the measured depth.",
        source: "Coulomb's law: rest exactly for tan α ≤ μ",
        run: Run::EachStep(stick::stick),
        control: Control { passes: "moreau-jean", fails: "limits/static-friction" },
    },
];
