//! A cube of 4 cm on a slope: as a large one, it rests on four points, not on one.
//!
//! ```text
//!     tan α < μ :   rest ,  if the weight passes through the base,  tan α < a/c = 1
//! ```
//! Gravity is about a tenth of the usual one, so that a step moves the cube by little of its size. Stopping rules that are absolute leave
//! more of a small gravity, and creep loads the upper corners less than they can hold only with more friction: engines whose contacts
//! yield or creep are not asked.

use crate::checks::incline::scenes::{angle, slope_box};
use crate::checks::incline::stick::creep_of;
use crate::checks::motion::{start_gap, yields};
use crate::model::Model;
use crate::model::addition::Addition;
use crate::{Bench, Measurement, Refusal, Reply};
use moreau_dynamics::scenes::Scene;

/// Half the edge \[m\].
const HALF: f64 = 0.02;
/// g \[m/s²\].
const GRAVITY: f64 = 1.0;
/// Also a pyramid within the cone holds it, in every direction: μ/√2 > tan α.
const FRICTION: f64 = 0.7;

fn scene(bench: &Bench, h: f64) -> Scene {
    let gap = start_gap(bench, h, (1.0, 4.0), GRAVITY * angle().cos(), FRICTION, 0.0);
    Scene { gravity: [0.0, 0.0, -GRAVITY], ..slope_box("small cube", [HALF; 3], gap, FRICTION) }
}

/// Whether what sticks moves on by declaration.
fn creeps(bench: &Bench) -> bool {
    match Model::of(bench.description()) {
        Model::Coulomb(limits) => limits.force_mixing > 0.0,
        Model::Mujoco(_) | Model::DrakeSap { .. } | Model::DrakeRegularised { .. } | Model::SpringDamper { .. } => true,
        Model::Anitescu | Model::StewartTrinkle { .. } | Model::Unknown => false,
    }
}

pub(super) fn small(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    bench.predicts(&[Addition::StaticFriction, Addition::TorsionalFriction]);
    if yields(bench) || creeps(bench) {
        return Err(Refusal::unsupported("contacts yield or creep by declaration, and little gravity does not tell it from merged points"));
    }
    let scene = scene(bench, h);
    Ok(vec![creep_of(bench, h, &scene, "creep speed of a cube of 4 cm")?])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Verdict;
    use crate::exact::{judge, refusal};
    use crate::runner::SWEEP;
    use nalgebra::Vector3;

    #[test]
    fn what_yields_or_creeps_by_declaration_is_not_asked() {
        for declared in [("penetration_allowance", 1e-3, "m"), ("force_mixing", 0.01, "1")] {
            assert!(refusal("limits/small", 0.01, &[declared]).is_some(), "{declared:?}");
        }
        assert_eq!(refusal("limits/small", 0.01, &[("error_reduction", 0.2, "1")]), None);
    }

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
