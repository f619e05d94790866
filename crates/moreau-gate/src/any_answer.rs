//! What every answer is asked, whatever a check looks at: that bodies move as their reported velocities say, and that reported impulses
//! push and account for momentum. A measurement is only there where something is wrong.

use crate::{Description, Measurement, Refusal, Reply};
use crate::{accounted, moved};
use moreau_dynamics::scenes::Scene;
use moreau_dynamics::trajectory::Trajectory;

/// Whether it is one of these measurements, which no check asked for.
#[cfg(test)]
pub fn is_of_any_answer(measurement: &Measurement) -> bool {
    use crate::accounted::{PULLS, UNACCOUNTED_FOR};
    use crate::moved::{MOVED, STARTS_ELSEWHERE, STARTS_TURNED, TURNED};
    [PULLS, UNACCOUNTED_FOR, MOVED, TURNED, STARTS_ELSEWHERE, STARTS_TURNED].contains(&measurement.quantity.as_str())
}

/// What is wrong with the answers so far, the worst of each kind.
#[derive(Default)]
pub struct AnyAnswer {
    worst: Vec<Measurement>,
}

impl AnyAnswer {
    /// Looks at one more answer to this scene; what sleeps has contacts, and need not report them.
    ///
    /// # Errors
    /// `errored` if the scene is none.
    pub fn look_at(&mut self, scene: &Scene, trajectory: &Trajectory, description: &Description, may_sleep: bool) -> Reply<()> {
        let mut found = moved::wrong(scene, trajectory, description).map_err(Refusal::errored)?;
        if !may_sleep {
            found.extend(accounted::wrong(scene, trajectory, description));
        }
        found.into_iter().for_each(|one| self.keep(one));
        Ok(())
    }

    fn keep(&mut self, found: Measurement) {
        match self.worst.iter_mut().find(|kept| kept.quantity == found.quantity) {
            None => self.worst.push(found),
            Some(kept) if kept.value < found.value => *kept = found,
            Some(_) => {}
        }
    }

    /// The measurements of what is wrong.
    pub fn wrong(self) -> impl Iterator<Item = Measurement> {
        self.worst.into_iter()
    }
}
