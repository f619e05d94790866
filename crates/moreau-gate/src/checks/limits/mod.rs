//! Silent limits: of speed, of spin, of what sticks.

mod fast;
mod rim;
mod sloping;
mod small;
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
            u + 7/2 μ v_n = g sin α t/50, with one contact and no redundant ones. Its lever is R − δ for the measured depth. Above: four \
            corners share the load in many ways, and three that slide with μ leave the fourth less than it can hold, so that a plate hides \
            what sticks up to less than μ. A ball whose mass is far outside, J = 100 m R², has one contact and hardly turns: it \
            sticks with μ = 51/50 tan α · 100/101, and the mean of its slip is what solvers leave; v + 100 R ω = g sin α t tells its \
            inertia, whatever friction is, where nothing is declared that resists rolling. Not measured: pyramids, of which \
            one holds more or \
            less than μ, and laws that creep, whose slip incline/stick predicts.",
        source: "Coulomb's law: rest exactly for tan α ≤ μ",
        run: Run::EachStep(stick::stick),
        control: Control { passes: "moreau-jean", fails: "limits/static-friction" },
    },
    Check {
        name: "limits/small",
        level: Level::Simulate,
        question: "Does a cube of 4 cm stand on its four corners on a slope, as a large one does?",
        derivation: "As incline/stick: tan 20° = 0.364 < μ = 0.7, and the weight passes through the base, tan α < 1. With fewer points, \
            or all in one, it would slip aside, tip or turn within √(a/g) = 0.14 s; it is watched for 0.25 s. Gravity is 1 m/s², so that \
            a step of a thirtieth of a second finds it no deeper than 3/2 g h² = 1.7 mm. Engines whose contacts yield or creep by \
            declaration are not asked.",
        source: "equilibrium of Coulomb–Signorini contact; engines that merge or drop near contact points",
        run: Run::EachStep(small::small),
        control: Control { passes: "moreau-jean", fails: "limits/points-nearer-than-5-cm-merged" },
    },
];
