//! Static bodies: a box that nothing moves is a floor.
//!
//! ```text
//!     1/m = 0 , J⁻¹ = 0        so that W, and with it every impact and every load, is that of the other body alone
//! ```

use crate::check::{Control, Expected, Run};
use crate::checks::bounce::spinning;
use crate::checks::rest;
use crate::checks::scenery::over_static_box;
use crate::{Bench, Check, Level, Measurement, Reply};

/// The checks of the family.
pub const CHECKS: &[Check] = &[
    Check {
        name: "fixed/bounce",
        level: Level::Simulate,
        question: "Does a spinning ball bounce from a static box as from the floor, slipping and sticking?",
        derivation: "A static body has 1/m = 0 and J⁻¹ = 0, so that W at the contact is the ball's alone, as on the floor: p_n = (1 + e) m \
            v, p_t = min(μ p_n, 2/7 m u_t). A box of a finite mass M would take m/(m + M) of it. The contact may act up to the way of two \
            steps from the surface. No gravity, one impact: no number depends on h but by this lever.",
        source: "closed form of a sphere's impact, see bounce/spinning-ball",
        run: Run::EachStep(bounce),
        control: Control { passes: "moreau-jean", fails: "fixed/heavy" },
    },
    Check {
        name: "fixed/rest",
        level: Level::Simulate,
        question: "Do a sphere and a box rest on a static box as on the floor, and does this box stay where it is?",
        derivation: "0 = m g + Σ r_n/h for the two bodies; the static one takes r_n and does not move. The velocity after each step is 0 \
            up to rounding and to the solver, which may leave a part √2⁻²³ of the impulse m g h of each step, as everywhere.",
        source: "equilibrium of Coulomb–Signorini contact, see rest/drift and rest/jitter",
        run: Run::EachStep(at_rest),
        control: Control { passes: "moreau-jean", fails: "fixed/heavy" },
    },
];

/// The derived verdicts that are not `pass`.
pub const EXPECTED: &[Expected] =
    &[Expected::without_restitution("stewart-trinkle", "fixed/bounce"), Expected::without_restitution("anitescu", "fixed/bounce")];

fn bounce(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    spinning::spinning_over(bench, h, over_static_box)
}

fn at_rest(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    rest::over(bench, h, over_static_box)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Verdict;
    use crate::exact::judge;
    use crate::runner::SWEEP;

    #[test]
    fn a_box_that_stays_passes_and_one_that_yields_fails() {
        for h in SWEEP {
            let verdict = |speed: f64| {
                let measured = judge("fixed/rest", h, move |scene, index, _, t| {
                    let [x, y, z] = scene.bodies[index].position;
                    let speed = if scene.bodies[index].is_static { speed } else { 0.0 };
                    ([x, y, z - speed * t], [1.0, 0.0, 0.0, 0.0], [0.0, 0.0, -speed], [0.0; 3])
                });
                measured.iter().map(Measurement::verdict).max().expect("measurements")
            };
            assert_eq!((verdict(0.0), verdict(0.01)), (Verdict::Pass, Verdict::Fail), "{h}");
        }
    }
}
