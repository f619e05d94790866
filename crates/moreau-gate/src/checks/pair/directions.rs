//! Friction between bodies in a direction along no axis, of every pair of shapes, listed in either order: see
//! [`encounter`](crate::checks::pair::encounter).

use crate::checks::pair::encounter::{Encounter, Shapes, falling};
use crate::checks::pair::meeting::{steps, undamped};
use crate::{Bench, Measurement, Reply};

/// Every pair of shapes, in both orders. μ is more than 1 once, and the slip fast.
const ENCOUNTERS: [Encounter; 6] = [
    encounter("spheres", Shapes::Spheres, false, [1.5, 0.0, 30.0]),
    encounter("spheres, the heavy one first", Shapes::Spheres, true, [0.2, 0.5, 8.0]),
    encounter("ball and box", Shapes::BallAndBox, false, [0.3, 0.5, 8.0]),
    encounter("turned box and ball", Shapes::BallAndBox, true, [0.2, 0.0, 8.0]),
    encounter("plates", Shapes::Plates, false, [0.3, 0.0, 4.0]),
    encounter("turned plates, the heavy one first", Shapes::Plates, true, [0.2, 0.5, 4.0]),
];

pub(super) const fn encounter(words: &'static str, shapes: Shapes, swapped: bool, [friction, restitution, slip]: [f64; 3]) -> Encounter {
    Encounter { words, shapes, swapped, friction, restitution, slip }
}

pub(super) fn any_direction(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    undamped(bench)?;
    let mut measured = Vec::new();
    for one in ENCOUNTERS {
        let e = if bench.description().restitution { one.restitution } else { 0.0 };
        let scene = falling(one.words, one.listed(0).into(), one.friction, e);
        let motion = bench.simulate(&scene, h, steps(h), 1)?;
        measured.extend(one.measured(bench, h, (&scene, &motion, 0)));
    }
    Ok(measured)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Verdict;
    use crate::checks::pair::encounter::tests::{RIGHT, Wrong, motion};
    use crate::exact::judge;
    use crate::runner::SWEEP;

    fn verdict(h: f64, wrong: Wrong) -> Verdict {
        let measured = judge("pair/any-direction", h, |scene, index, _, t| {
            motion(scene, index, t, [scene.material.friction, scene.material.restitution], wrong)
        });
        measured.iter().map(Measurement::verdict).max().expect("measurements")
    }

    #[test]
    fn the_closed_form_passes_and_other_friction_directions_levers_restitution_or_drilling_fail_at_every_step() {
        for h in SWEEP {
            assert_eq!(verdict(h, RIGHT), Verdict::Pass, "{h}");
            let wrong = [
                Wrong { friction: 0.9, ..RIGHT },
                Wrong { friction: 1.1, ..RIGHT },
                Wrong { upwards: 0.9, ..RIGHT },
                Wrong { lever: 0.7, ..RIGHT },
                Wrong { restitution: 0.8, ..RIGHT },
                Wrong { drilled: 0.2, ..RIGHT },
            ];
            for (k, wrong) in wrong.into_iter().enumerate() {
                assert_eq!(verdict(h, wrong), Verdict::Fail, "{k} at {h}");
            }
        }
    }
}
