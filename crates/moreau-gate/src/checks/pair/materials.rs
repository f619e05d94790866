//! The values of single pairs: every pair of shapes meets at once with μ and e of its own, a ball and a plate land with theirs, and a floor
//! has no friction for one body.
//!
//! ```text
//!     pair k:   p_t = μ_k p_n ,    p_n = (1 + e_k) m̄ |u_n|         and nothing of the common μ and e
//! ```

use crate::checks::pair::directions::encounter;
use crate::checks::pair::encounter::{Encounter, Shapes, falling};
use crate::checks::pair::landings::{self, COMMON};
use crate::checks::pair::meeting::{steps, undamped};
use crate::checks::pair::planks;
use crate::{Bench, Measurement, Reply};
use moreau_dynamics::scenes::{PairOverride, Scene};

/// Pairs far from each other that meet at the same time, no two with the same values of both.
const ENCOUNTERS: [Encounter; 6] = [
    encounter("spheres, μ = 0.1, e = ¾", Shapes::Spheres, false, [0.1, 0.75, 8.0]),
    encounter("plates, μ = 0.3, e = ¼", Shapes::Plates, false, [0.3, 0.25, 4.0]),
    encounter("spheres, μ = 0.3, e = ¼", Shapes::Spheres, true, [0.3, 0.25, 12.0]),
    encounter("ball and box, μ = 0.2, e = ¼", Shapes::BallAndBox, false, [0.2, 0.25, 8.0]),
    encounter("plates, μ = 0.1, e = ¾", Shapes::Plates, true, [0.1, 0.75, 4.0]),
    encounter("box and ball, μ = 0.1, e = ¾", Shapes::BallAndBox, true, [0.1, 0.75, 8.0]),
];
/// Every second override names the body that is listed second first; `bouncing` is 0 for engines without restitution.
fn scene(bouncing: f64) -> Scene {
    let bodies = ENCOUNTERS.iter().enumerate().flat_map(|(k, one)| one.listed(k)).collect();
    let mut scene = falling("pairs of their own", bodies, COMMON[0], COMMON[1] * bouncing);
    let own = |(k, one): (usize, &Encounter)| {
        let [first, second] = Encounter::names(k);
        let bodies = if k % 2 == 0 { [second, first] } else { [first, second] };
        PairOverride { bodies, friction: Some(one.friction), restitution: Some(one.restitution * bouncing) }
    };
    scene.material.pairs = ENCOUNTERS.iter().enumerate().map(own).collect();
    scene
}

pub(super) fn material_pairs(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    undamped(bench)?;
    let bouncing = f64::from(u8::from(bench.description().restitution));
    let scene = scene(bouncing);
    let motion = bench.simulate(&scene, h, steps(h), 1)?;
    let mut measured = Vec::new();
    for (k, one) in ENCOUNTERS.iter().enumerate() {
        measured.extend(one.measured(bench, h, (&scene, &motion, 2 * k)));
    }
    measured.extend(landings::with_the_ground(bench, h, bouncing)?);
    measured.extend(planks::on_smooth_floor(bench, h)?);
    Ok(measured)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Verdict;
    use crate::exact::measure;

    #[test]
    fn every_encounter_is_held_to_the_restitution_of_its_own_pair() {
        let mut engine = crate::own::by_name("moreau-jean").expect("listed");
        let measured = measure("pair/material-pairs", 0.01, &mut engine);
        assert!(measured.iter().all(|one| one.verdict() == Verdict::Pass), "{measured:?}");
        for one in ENCOUNTERS {
            let held = |found: &&Measurement| found.quantity.starts_with("restitution") && found.quantity.ends_with(one.words);
            let found = measured.iter().find(held).unwrap_or_else(|| panic!("{} is not asked", one.words));
            assert_eq!(found.ideal.value, one.restitution, "{}", found.quantity);
            assert_ne!(one.restitution, COMMON[1]);
        }
    }
}
