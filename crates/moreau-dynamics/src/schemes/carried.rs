//! The impulses that a step starts from.
//!
//! Impulses of the step before that still solve the problem up to a tolerance are kept. What they leave, δ, moves the bodies a little more
//! in every step, until they are found anew; and those stop that motion besides carrying the load r*, so that they leave −kδ in the step
//! after, which is kept in its turn, and again every other step. In the mean of the k kept steps and the one that ends them only the load
//! is left, for velocities before and after are zero:
//!
//! ```text
//!     r_kept = r* + δ ,    r = r* − k δ ,    r_kept + (r − r_kept)/(k + 1) = r*
//! ```
//! From there a body at rest keeps its impulses for a long time. Answers are not touched: each is what its solver makes of its start.

use crate::tolerance::schemes::SAME_LOAD;
use moreau_contact::contact::{ContactImpulse, Place};
use moreau_contact::memory::spare::{self, Spare};

/// What the next step starts from.
#[derive(Debug, Default)]
pub(super) struct Carried {
    impulses: Vec<ContactImpulse>,
    /// How many steps in a row kept each impulse to the last bit.
    kept: Vec<usize>,
}

impl Carried {
    /// The impulses of the step before, contact by contact, or their means; none before the first step.
    pub(super) fn impulses(&self) -> &[ContactImpulse] {
        &self.impulses
    }

    /// Goes on to the step after the one that started from these and found `impulses`.
    pub(super) fn follow(&mut self, mut impulses: Vec<ContactImpulse>) {
        let (mut kept, mut next) = (spare::vector(impulses.len()), 0);
        let largest = impulses.iter().map(|found| square(found.impulse.iter().copied())).fold(0.0, f64::max);
        for found in &mut impulses {
            let before = place_of(&self.impulses, &mut next, found.contact, found.place.as_ref());
            kept.push(before.map_or(0, |at| follow(&self.impulses[at].impulse, self.kept[at], &mut found.impulse, largest)));
        }
        std::mem::replace(&mut self.impulses, impulses).leave();
        std::mem::replace(&mut self.kept, kept).leave();
    }
}

fn square(impulse: impl Iterator<Item = f64>) -> f64 {
    impulse.map(|r| r * r).sum()
}

/// How many steps have kept an impulse that was kept for `kept` steps before; where it was found anew under the same load, beside the
/// square of the largest impulse, it becomes the mean of them all.
fn follow(start: &[f64], kept: usize, found: &mut [f64], largest: f64) -> usize {
    if found == start {
        return kept + 1;
    }
    if kept > 0 && square(found.iter().zip(start).map(|(found, start)| found - start)) <= SAME_LOAD.powi(2) * largest {
        let steps = kept as f64 + 1.0;
        found.iter_mut().zip(start).for_each(|(found, start)| *found = start + (*found - start) / steps);
    }
    0
}

/// Where this contact stands in a list that has nearly the same order: it is looked for from `next` on, behind the one that was found last.
pub(super) fn place_of(list: &[ContactImpulse], next: &mut usize, contact: usize, place: Option<&Place>) -> Option<usize> {
    let (behind, ahead) = list.split_at(*next);
    let ahead = ahead.iter().chain(behind).position(|known| known.acts_at(contact, place))?;
    let at = (*next + ahead) % list.len();
    *next = at + 1;
    Some(at)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenes::Scene;
    use crate::schemes::{MoreauJean, run};
    use moreau_contact::solvers::Auto;
    use moreau_exact::tolerance::rounding;

    fn one(contact: usize, impulse: &[f64]) -> ContactImpulse {
        ContactImpulse { contact, impulse: impulse.into(), place: None }
    }

    fn carried<const N: usize>(steps: [&[&ContactImpulse]; N]) -> Vec<ContactImpulse> {
        let mut carried = Carried::default();
        steps.iter().for_each(|impulses| carried.follow(impulses.iter().map(|one| (*one).clone()).collect()));
        carried.impulses().to_vec()
    }

    #[test]
    fn between_rest_and_rest_the_mean_carries_the_load() {
        let (load, left) = ([2.0, -0.5], [3e-9, 1e-9]);
        let with = |times: f64| one(4, &[load[0] + times * left[0], load[1] + times * left[1]]);
        for kept in 1..6 {
            let mut carried = Carried::default();
            (0..=kept).for_each(|_| carried.follow(vec![with(1.0)]));
            carried.follow(vec![with(-(kept as f64))]);
            let next = carried.impulses();
            assert!(next[0].impulse.iter().zip(load).all(|(r, load)| (r - load).abs() <= rounding(4, load.abs())), "{kept} {next:?}");
        }
    }

    #[test]
    fn what_was_not_kept_or_carries_another_load_is_carried_as_it_is() {
        let (before, after, loaded, other) = (one(4, &[2.0, -0.5]), one(4, &[2.0 + 1e-9, -0.5]), one(4, &[2.1, -0.5]), one(5, &[2.0, 0.0]));
        assert_eq!(carried([&[&before], &[&after]])[0], after, "a start that was not kept");
        assert_eq!(carried([&[&before], &[&before], &[&loaded]])[0], loaded, "another load");
        assert_eq!(carried([&[&before], &[&before], &[&other]])[0], other, "another contact");
        // a light contact beside a heavy one: both are of one balance, and what changes is small beside the heavy one
        let [light, more] = [1e-8, 3e-8].map(|r| one(7, &[r, 0.0]));
        let next = carried([&[&before, &light], &[&before, &light], &[&more, &after]]);
        assert_eq!((next[0].contact, next[1].contact), (7, 4));
        assert!((next[0].impulse[0] - 2e-8).abs() <= rounding(4, 1e-8) && (next[1].impulse[0] - 2.0 - 0.5e-9).abs() <= rounding(4, 2.0));
    }

    /// Without the mean every second step of this stack at rest is found anew, and with it none.
    #[test]
    fn a_stack_at_rest_keeps_its_impulses() {
        let cube = |k: usize| {
            let [x, y, z] = [1e-3 * ((7 * k) % 5) as f64, 7e-4 * ((4 * k) % 7) as f64, 0.05 + 0.1 * k as f64];
            format!(r#"{{"name": "b{k}", "box": {{"half_extents": [0.05, 0.05, 0.05]}}, "mass": 1, "position": [{x}, {y}, {z}]}}"#)
        };
        let text = format!(
            r#"{{"schema": "scene/1", "name": "stack", "gravity": [0, 0, -9.81], "ground": {{"normal": [0, 0, 1], "offset": 0}},
                "bodies": [{}], "material": {{"friction": 0.5, "restitution": 0}}, "duration": 1}}"#,
            (0..6).map(cube).collect::<Vec<_>>().join(", ")
        );
        let (mechanism, start) = Scene::from_json(&text).expect("a scene").spatial_mechanism().expect("cubes");
        let (mut taken, mut found) = (0, 0);
        run(&MoreauJean::default(), &Auto, &*mechanism, start, 0.002, 600, |step| {
            taken += 1;
            found += usize::from(taken > 300 && step.solution.as_ref().is_some_and(|solution| solution.iterations > 0));
        })
        .expect("every step has an answer");
        assert!(found <= 30, "{found} of 300 steps");
    }
}
