//! Determinism on one machine: the same question has one answer, bit for bit.
//!
//! ```text
//!     simulate(scene) = simulate(scene)       asked twice, and with another question in between
//! ```
//! Tolerance zero: no arithmetic differs between the two. An engine that keeps impulses of the last request to start the next one, orders
//! contacts by a global random number or reads memory it did not write answers the second time differently.

use crate::check::{Control, Run};
use crate::checks::scenery::{cuboid, over_floor, paired, sphere, worst};
use crate::{Bench, Check, Expectation, Level, Measurement, Reply};
use moreau_dynamics::scenes::Scene;
use moreau_dynamics::trajectory::{BodyTrack, Trajectory};

/// Steps of every motion: the sphere touches from the first on, the box after half a millisecond.
const STEPS: usize = 40;

/// The checks of the family.
pub const CHECKS: &[Check] = &[
    Check {
        name: "determinism/repeat",
        level: Level::Simulate,
        question: "Does the same scene asked twice move in the same way, bit for bit?",
        derivation: "A function of its input has one value: the difference is 0, with tolerance 0.",
        source: "protocol: a request never changes the answer to a later one",
        run: Run::EachStep(repeat),
        control: Control { passes: "moreau-jean", fails: "determinism/random-order" },
    },
    Check {
        name: "determinism/company",
        level: Level::Simulate,
        question: "Does a scene move in the same way, bit for bit, after another scene was simulated?",
        derivation: "A function of its input has one value: the difference is 0, with tolerance 0.",
        source: "protocol: a request never changes the answer to a later one",
        run: Run::EachStep(company),
        control: Control { passes: "moreau-jean", fails: "determinism/impulses-kept" },
    },
];

/// A tilted box that falls over, and a sphere that runs into it: contacts come and go.
fn tumble() -> Scene {
    let mut block = cuboid("block", 1.0, [0.1, 0.15, 0.05], [0.0, 0.0, 0.0963]);
    block.orientation = [0.96, 0.0, 0.28, 0.0];
    block.linear_velocity = [0.5, 0.1, -0.8];
    block.angular_velocity = [1.0, -2.0, 0.5];
    let mut ball = sphere("ball", 0.5, 0.08, [-0.25, 0.02, 0.08]);
    ball.linear_velocity = [2.0, 0.0, -0.2];
    over_floor("tumble", vec![block, ball], 0.4)
}

/// Two boxes on each other.
fn company_scene() -> Scene {
    let bodies = vec![cuboid("below", 1.0, [0.1; 3], [0.0, 0.0, 0.1]), cuboid("above", 3.0, [0.1; 3], [0.02, 0.0, 0.3])];
    over_floor("company", bodies, 0.5)
}

fn repeat(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    let [first, second] = [bench.simulate(&tumble(), h, STEPS, 1)?, bench.simulate(&tumble(), h, STEPS, 1)?];
    Ok(identical(&first, &second, "asked twice"))
}

fn company(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    let first = bench.simulate(&tumble(), h, STEPS, 1)?;
    bench.simulate(&company_scene(), h, STEPS, 1)?;
    let second = bench.simulate(&tumble(), h, STEPS, 1)?;
    Ok(identical(&first, &second, "asked again after another scene"))
}

/// The largest differences of single entries, in each unit.
fn identical(first: &Trajectory, second: &Trajectory, words: &str) -> Vec<Measurement> {
    let measured = |quantity: &str, unit: &str, value: f64| {
        let ideal = Expectation::equal(0.0, 0.0, "one question, one answer");
        Measurement::new(format!("largest difference in {quantity}, {words}"), unit, value, ideal)
    };
    let over = |entries: fn(&BodyTrack, &BodyTrack) -> f64| paired(first, second).map(|(a, b)| entries(a, b)).fold(0.0, worst);
    vec![
        measured("position", "m", over(|a, b| largest(&a.position, &b.position))),
        measured("velocity", "m/s", over(|a, b| largest(&a.linear_velocity, &b.linear_velocity))),
        measured("orientation", "1", over(|a, b| largest(&a.orientation, &b.orientation))),
        measured("angular velocity", "rad/s", over(|a, b| largest(&a.angular_velocity, &b.angular_velocity))),
    ]
}

fn largest<const N: usize>(one: &[[f64; N]], other: &[[f64; N]]) -> f64 {
    one.iter().flatten().zip(other.iter().flatten()).fold(0.0, |largest, (a, b)| worst(largest, (a - b).abs()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Verdict;
    use crate::exact::{Reporting, measure};

    #[test]
    fn one_bit_of_one_body_at_one_sample_is_seen_in_the_answer_that_has_it() {
        type Change = fn(&mut BodyTrack);
        let changes: [Change; 4] = [
            |track| track.position[STEPS][1] += f64::EPSILON,
            |track| track.linear_velocity[STEPS][1] += f64::EPSILON,
            |track| track.orientation[STEPS][1] += f64::EPSILON,
            |track| track.angular_velocity[STEPS][1] += f64::EPSILON,
        ];
        for (check, asked) in [("determinism/repeat", 2), ("determinism/company", 3)] {
            for body in 0..2 {
                for (kind, change) in changes.iter().enumerate() {
                    let mut answers = 0;
                    let mut engine = Reporting(|motion: &mut Trajectory| {
                        answers += 1;
                        if answers == asked {
                            change(&mut motion.bodies[body]);
                        }
                    });
                    let verdicts: Vec<Verdict> = measure(check, 0.01, &mut engine).iter().map(Measurement::verdict).collect();
                    let expected: Vec<Verdict> = (0..4).map(|k| if k == kind { Verdict::Fail } else { Verdict::Pass }).collect();
                    assert_eq!(verdicts, expected, "{check}, body {body}");
                }
            }
        }
    }
}
