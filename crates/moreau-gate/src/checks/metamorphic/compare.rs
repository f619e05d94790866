//! The largest differences between two motions of the same bodies, and how they are reported.

use crate::checks::scenery::{angle_between, distance, paired, worst};
use crate::{Expectation, Measurement};
use moreau_dynamics::trajectory::Trajectory;

/// Largest differences over bodies and samples.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Differences {
    /// Largest difference of a position \[m\].
    pub position: f64,
    /// \[m/s\], of the centres.
    pub velocity: f64,
    /// Largest difference of an orientation \[rad\].
    pub orientation: f64,
}

impl Differences {
    /// What velocities that differ by up to `velocity` \[m/s\] at a lever `arm` \[m\] make in the time \[s\].
    pub fn of_velocity(velocity: f64, duration: f64, arm: f64) -> Self {
        Differences { position: duration * velocity, velocity, orientation: duration * velocity / arm }
    }

    /// As measurements against zero, with the allowance and, if a declared law has no such symmetry, with its bound.
    pub fn measured(self, words: &str, allowed: Differences, law: Option<Differences>) -> Vec<Measurement> {
        let rows = [
            ("position", "m", self.position, allowed.position, law.map(|law| law.position)),
            ("velocity", "m/s", self.velocity, allowed.velocity, law.map(|law| law.velocity)),
            ("orientation", "rad", self.orientation, allowed.orientation, law.map(|law| law.orientation)),
        ];
        let measured = |(name, unit, value, allowed, law): (&str, &str, f64, f64, Option<f64>)| {
            let ideal = Expectation::equal(0.0, allowed, "the same motion");
            let model = law.map(|bound| {
                Expectation::at_most(
                    bound,
                    allowed,
                    "the declared friction cone has preferred directions, or declared corrections open contacts",
                )
            });
            Measurement::new(format!("largest difference in {name}{words}"), unit, value, ideal).predicted(model)
        };
        rows.map(measured).into()
    }
}

/// The largest differences between two motions of the same bodies, by name.
pub fn difference(one: &Trajectory, other: &Trajectory) -> Differences {
    let mut largest = Differences { position: 0.0, velocity: 0.0, orientation: 0.0 };
    for (a, b) in paired(one, other) {
        for k in 0..one.times.len().min(other.times.len()) {
            largest.position = worst(largest.position, distance(a.position[k], b.position[k]));
            largest.velocity = worst(largest.velocity, distance(a.linear_velocity[k], b.linear_velocity[k]));
            largest.orientation = worst(largest.orientation, angle_between(a.orientation[k], b.orientation[k]));
        }
    }
    largest
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::own::by_name;
    use crate::{Engine, Options};
    use moreau_dynamics::scenes::named;

    #[test]
    fn a_difference_of_one_kind_at_one_sample_of_one_body_is_seen() {
        let scene = moreau_dynamics::scenes::Scene { duration: 0.1, ..named("two-ball-impact").expect("built in") };
        let one = by_name("moreau-jean").expect("listed").simulate(&scene, 0.01, 1, &Options::new()).expect("simulates");
        let none = difference(&one, &one);
        assert_eq!([none.position, none.velocity, none.orientation], [0.0; 3]);
        type Change = fn(&mut Trajectory);
        let changes: [(Change, [bool; 3]); 3] = [
            (|other| other.bodies[1].position[3][1] += 0.5, [true, false, false]),
            (|other| other.bodies[1].linear_velocity[3][1] += 0.5, [false, true, false]),
            (|other| other.bodies[1].orientation[3] = [0.8, 0.6, 0.0, 0.0], [false, false, true]),
        ];
        for (change, seen) in changes {
            let mut other = one.clone();
            change(&mut other);
            let found = difference(&one, &other);
            assert_eq!([found.position, found.velocity, found.orientation].map(|size| size > 0.4), seen);
        }
    }
}
