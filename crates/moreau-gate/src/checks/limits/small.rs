//! A cube of 4 cm on a slope: as a large one, it rests on four points, not on one.
//!
//! ```text
//!     tan α < μ :   rest ,  if the weight passes through the base,  tan α < a/c = 1
//! ```
//! Gravity is a hundredth of the usual one, so that a step moves the cube by little of its size.

use crate::checks::incline::scenes::{angle, slope_box};
use crate::checks::incline::stick::creep_of;
use crate::checks::motion::start_gap;
use crate::model::addition::Addition;
use crate::{Bench, Measurement, Reply};
use moreau_dynamics::scenes::Scene;

/// Half the edge \[m\].
const HALF: f64 = 0.02;
/// g \[m/s²\].
const GRAVITY: f64 = 0.1;
const FRICTION: f64 = 0.5;

fn scene(bench: &Bench, h: f64) -> Scene {
    let gap = start_gap(bench, h, (1.0, 4.0), GRAVITY * angle().cos(), FRICTION, 0.0);
    Scene { gravity: [0.0, 0.0, -GRAVITY], ..slope_box("small cube", [HALF; 3], gap, FRICTION) }
}

pub(super) fn small(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    bench.predicts(&[Addition::StaticFriction, Addition::TorsionalFriction]);
    let scene = scene(bench, h);
    Ok(vec![creep_of(bench, h, &scene, "creep speed of a cube of 4 cm")?])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Verdict;
    use crate::exact::judge;
    use crate::runner::SWEEP;
    use nalgebra::Vector3;

    #[test]
    fn a_cube_that_rests_passes_and_one_that_falls_over_an_edge_or_slips_with_a_thousandth_of_gravity_fails() {
        for h in SWEEP {
            let verdict = |acceleration: f64| {
                let measured = judge("limits/small", h, |scene, index, _, t| {
                    let body = &scene.bodies[index];
                    let down = Vector3::new(angle().cos(), 0.0, -angle().sin()) * acceleration;
                    let place = Vector3::from(body.position) + down * (0.5 * t * t);
                    (place.into(), body.orientation, (down * t).into(), [0.0; 3])
                });
                measured.iter().map(Measurement::verdict).max().expect("a measurement")
            };
            assert_eq!(
                (verdict(0.0), verdict(1e-3 * GRAVITY), verdict(0.1 * GRAVITY)),
                (Verdict::Pass, Verdict::Fail, Verdict::Fail),
                "{h}"
            );
        }
    }
}
