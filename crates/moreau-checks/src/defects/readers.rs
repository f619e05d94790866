//! Planted mistakes in readers of files: what stands where, in which unit, and what is let through.

use crate::planted::{Family, Kind, Planted};
use crate::readers::problem::{self, ReadsProblem, ReadsSolution};
use crate::readers::scene::{self, ReadsScene};
use moreau_contact::problem::{Compliance, ContactProblem, Coordinates, Solution};
use moreau_dynamics::scenes::Scene;
use moreau_exact::Result;
use nalgebra::{DMatrix, DVector};
use serde_json::{Value, json};

const fn planted<S>(name: &'static str, mistake: &'static str, subject: S) -> Planted<S> {
    Planted { name, mistake, kind: Kind::Reader, subject }
}

/// Readers of contact problems.
pub static PROBLEMS: Family<ReadsProblem> = Family {
    reference: ContactProblem::from_json,
    checks: &[("readers/problem-as-written", problem::as_written), ("readers/problem-refusals", problem::refusals)],
    planted: &[
        planted("readers/rows-as-columns", "takes the rows of W for its columns", |text| {
            let problem = ContactProblem::from_json(text)?;
            let transposed = problem.dense().transpose();
            problem.into_builder().dynamics(None).delassus(transposed).build()
        }),
        planted("readers/places-from-one", "counts rows and columns of entries from 1", |text| {
            edited(text, |file| {
                for matrix in ["mass", "jacobian"] {
                    for places in ["row", "column"] {
                        let places = file.pointer_mut(&format!("/{matrix}/triplets/{places}")).and_then(Value::as_array_mut);
                        places.into_iter().flatten().for_each(|place| *place = json!(place.as_u64().unwrap_or(0).saturating_sub(1)));
                    }
                }
            })
        }),
        planted("readers/tangents-exchanged", "reads (n, t₂, t₁) where (n, t₁, t₂) is written", |text| {
            ordered(text, |rows| if rows == 3 { vec![0, 2, 1] } else { (0..rows).collect() })
        }),
        planted("readers/normal-last", "reads (t₁, t₂, n) where (n, t₁, t₂) is written", |text| {
            ordered(text, |rows| (1..rows).chain([0]).collect())
        }),
        planted("readers/shift-not-read", "does not read the shift", |text| {
            edited(text, |file| drop(file.as_object_mut().map(|fields| fields.remove("shift"))))
        }),
        planted("readers/shift-in-the-velocity", "adds the shift to the free velocity, so that u is no velocity", |text| {
            let problem = ContactProblem::from_json(text)?;
            let (moved, none) = (problem.free_velocity() + problem.shift(), DVector::zeros(problem.rows()));
            problem.into_builder().free_velocity(moved).shift(none).build()
        }),
        planted("readers/bodies-not-read", "does not read which bodies touch", |text| {
            edited(text, |file| drop(file.as_object_mut().map(|fields| fields.remove("bodies"))))
        }),
        planted("readers/millimetres", "takes velocities for millimetres per second", |text| {
            let problem = ContactProblem::from_json(text)?;
            let scaled = problem.free_velocity() / 1000.0;
            problem.into_builder().free_velocity(scaled).build()
        }),
        planted("readers/single-precision", "reads numbers with 24 bits", |text| {
            let problem = ContactProblem::from_json(text)?;
            let [free, shift] = [problem.free_velocity(), problem.shift()].map(|vector| vector.map(|x| f64::from(x as f32)));
            problem.into_builder().free_velocity(free).shift(shift).build()
        }),
        planted("readers/mass-as-its-inverse", "takes M̂ for M̂⁻¹", |text| {
            let problem = ContactProblem::from_json(text)?;
            let Some(dynamics) = problem.dynamics() else { return Ok(problem) };
            let delassus = &dynamics.jacobian * &dynamics.mass * dynamics.jacobian.transpose();
            problem.into_builder().dynamics(None).delassus(delassus).build()
        }),
        planted("readers/edges-as-rows", "puts the softness of edges on the rows of the contact", |text| {
            let problem = ContactProblem::from_json(text)?;
            let Some(soft) = problem.compliance().filter(|soft| soft.coordinates == Coordinates::Edge) else { return Ok(problem) };
            let diagonal = soft.diagonal.rows(0, problem.rows()).into_owned();
            problem.into_builder().compliance(Compliance { coordinates: Coordinates::Contact, diagonal }).build()
        }),
        planted("readers/one-friction-for-all", "takes the first coefficient of friction for every contact", |text| {
            let problem = ContactProblem::from_json(text)?;
            let friction = vec![problem.friction()[0]; problem.contacts()];
            problem.into_builder().friction(friction).build()
        }),
        planted("readers/any-version", "does not look at the version", |text| {
            edited(text, |file| file["schema"] = json!("contact-problem/1"))
        }),
        planted("readers/unknown-law-is-coulomb", "takes a law that it does not know for Coulomb's", |text| {
            edited(text, |file| {
                let known = ["frictionless", "coulomb", "associated", "polyhedral-coulomb", "polyhedral-associated"];
                if !file["law"].as_str().is_some_and(|law| known.contains(&law)) {
                    file["law"] = json!("coulomb");
                }
            })
        }),
        planted("readers/unknown-fields-passed-over", "passes over fields that it does not know, misspelt ones too", |text| {
            edited(text, |file| drop(file.as_object_mut().map(|fields| fields.remove("shifts"))))
        }),
        planted("readers/not-a-number-as-zero", "reads a number that is none as zero", |text| {
            ContactProblem::from_json(&text.replace("NaN", "0"))
        }),
        planted("readers/null-as-zero", "reads a missing value as zero", |text| {
            edited(text, |file| {
                let numbers = file.get_mut("free_velocity").and_then(Value::as_array_mut);
                numbers.into_iter().flatten().filter(|number| number.is_null()).for_each(|number| *number = json!(0));
            })
        }),
        planted("readers/beyond-all-numbers", "takes a number beyond all numbers for the largest", |text| {
            ContactProblem::from_json(&text.replace("1e999", "1e308"))
        }),
        planted("readers/missing-numbers-as-zero", "fills up a list that is too short", |text| {
            edited(text, |file| {
                let rows = file["dimension"].as_u64().unwrap_or(0) as usize * file["friction"].as_array().map_or(0, Vec::len);
                if let Some(numbers) = file.get_mut("free_velocity").and_then(Value::as_array_mut) {
                    numbers.resize(rows, json!(0));
                }
            })
        }),
        planted("readers/short-rows-filled", "fills up a row of W that is too short", |text| {
            edited(text, |file| {
                let size = file.pointer("/delassus/shape/1").and_then(Value::as_u64).unwrap_or(0) as usize;
                let rows = file.pointer_mut("/delassus/rows").and_then(Value::as_array_mut);
                rows.into_iter().flatten().filter_map(Value::as_array_mut).for_each(|row| row.resize(size, json!(0)));
            })
        }),
        planted("readers/text-cut-short", "closes what a text that was cut short leaves open", |text| {
            let open = text.matches('{').count() - text.matches('}').count();
            ContactProblem::from_json(&(text.to_string() + &"}".repeat(open)))
        }),
        planted("readers/text-that-goes-on", "reads the first value of a text and no further", |text| {
            let mut values = serde_json::Deserializer::from_str(text).into_iter::<Value>();
            match values.next() {
                Some(Ok(first)) => ContactProblem::from_json(&first.to_string()),
                _ => ContactProblem::from_json(text),
            }
        }),
        planted("readers/last-of-two-entries", "takes the last of two entries for one place", |text| {
            edited(text, |file| {
                let places = |file: &Value, which: &str| file.pointer(&format!("/jacobian/triplets/{which}")).cloned();
                let (Some(rows), Some(columns)) = (places(file, "row"), places(file, "column")) else { return };
                if rows[1] == rows[2] && columns[1] == columns[2] {
                    for which in ["row", "column", "value"] {
                        let list = file.pointer_mut(&format!("/jacobian/triplets/{which}")).and_then(Value::as_array_mut);
                        list.into_iter().for_each(|list| drop(list.remove(1)));
                    }
                }
            })
        }),
        planted("readers/directions-by-default", "takes four directions where none are given", |text| {
            edited(text, |file| {
                if file["law"].as_str().is_some_and(|law| law.starts_with("polyhedral")) && file.get("directions").is_none() {
                    file["directions"] = json!(4);
                    file["compliance"] = Value::Null;
                }
            })
        }),
        planted("readers/negative-friction", "takes the size of a negative coefficient of friction", |text| {
            edited(text, |file| {
                let numbers = file.get_mut("friction").and_then(Value::as_array_mut);
                numbers.into_iter().flatten().for_each(|number| *number = json!(number.as_f64().unwrap_or(0.0).abs()));
            })
        }),
    ],
};

/// Readers of answers.
pub static SOLUTIONS: Family<ReadsSolution> = Family {
    reference: Solution::from_json,
    checks: &[("readers/answer-as-written", problem::answer_as_written), ("readers/answer-refusals", problem::answer_refusals)],
    planted: &[
        planted("readers/velocity-as-impulse", "exchanges impulses and velocities", |text| {
            let mut answer = Solution::from_json(text)?;
            std::mem::swap(&mut answer.impulse, &mut answer.velocity);
            Ok(answer)
        }),
        planted("readers/multipliers-not-read", "does not read β and σ", |text| {
            let answer = Solution::from_json(text)?;
            Ok(Solution::new(answer.solver, answer.impulse, answer.velocity, answer.iterations))
        }),
        planted("readers/friction-of-the-other-body", "reads tangential impulses as those on the ground", |text| {
            let mut answer = Solution::from_json(text)?;
            answer.impulse.iter_mut().skip(1).step_by(2).for_each(|r| *r = -*r);
            Ok(answer)
        }),
        planted("readers/velocity-by-default", "takes the velocity for zero where none is given", |text| {
            let mut file: Value = serde_json::from_str(text)?;
            if file.get("velocity").is_none() {
                file["velocity"] = json!(vec![0.0; file["impulse"].as_array().map_or(0, Vec::len)]);
            }
            Solution::from_json(&file.to_string())
        }),
    ],
};

/// Readers of scenes.
pub static SCENES: Family<ReadsScene> = Family {
    reference: Scene::from_json,
    checks: &[("readers/scene-as-written", scene::as_written), ("readers/scene-refusals", scene::refusals)],
    planted: &[
        planted("readers/scalar-last", "reads quaternions as (x, y, z, w)", |text| {
            let mut scene = Scene::from_json(text)?;
            scene.bodies.iter_mut().for_each(|body| body.orientation.rotate_left(1));
            Ok(scene)
        }),
        planted("readers/world-to-body", "reads an orientation as the turn from the world to the body", |text| {
            let mut scene = Scene::from_json(text)?;
            scene.bodies.iter_mut().flat_map(|body| &mut body.orientation[1..]).for_each(|entry| *entry = -*entry);
            Ok(scene)
        }),
        planted("readers/edges-for-halves", "reads half extents as edges", |text| {
            let mut scene = Scene::from_json(text)?;
            let boxes = scene.bodies.iter_mut().filter_map(|body| body.cuboid.as_mut());
            boxes.for_each(|cuboid| cuboid.half_extents = cuboid.half_extents.map(|half| 0.5 * half));
            Ok(scene)
        }),
        planted("readers/gravity-downwards", "takes the size of gravity and points it down", |text| {
            let mut scene = Scene::from_json(text)?;
            let [x, y, z] = scene.gravity;
            scene.gravity = [0.0, 0.0, -(x * x + y * y + z * z).sqrt()];
            Ok(scene)
        }),
        planted("readers/ground-at-the-origin", "does not read the offset of the ground", |text| {
            let mut scene = Scene::from_json(text)?;
            scene.ground.iter_mut().for_each(|ground| ground.offset = 0.0);
            Ok(scene)
        }),
        planted("readers/pairs-not-read", "does not read the pairs that differ", |text| {
            let mut scene = Scene::from_json(text)?;
            scene.material.pairs.clear();
            Ok(scene)
        }),
        planted("readers/inertia-of-the-solid", "computes the inertia of every body, given or not", |text| {
            let mut scene = Scene::from_json(text)?;
            scene.bodies.iter_mut().for_each(|body| body.inertia = None);
            Ok(scene)
        }),
        planted("readers/scene-not-validated", "does not look at what it has read", |text| Ok(serde_json::from_str(text)?)),
    ],
};

/// The reader on a text that was changed before.
fn edited(text: &str, edit: impl Fn(&mut Value)) -> Result<ContactProblem> {
    match serde_json::from_str(text) {
        Ok(mut file) => {
            edit(&mut file);
            ContactProblem::from_json(&file.to_string())
        }
        Err(_) => ContactProblem::from_json(text),
    }
}

/// The problem whose rows are those of the text in another order within each contact.
fn ordered(text: &str, order: fn(usize) -> Vec<usize>) -> Result<ContactProblem> {
    let problem = ContactProblem::from_json(text)?;
    let rows = problem.rows_per_contact();
    let order = order(rows);
    let from = |i: usize| i / rows * rows + order[i % rows];
    let vector = |given: &DVector<f64>| DVector::from_fn(given.len(), |i, _| given[from(i)]);
    let (free, shift) = (vector(problem.free_velocity()), vector(problem.shift()));
    let delassus = DMatrix::from_fn(problem.rows(), problem.rows(), |i, j| problem.entry(from(i), from(j)));
    problem.into_builder().dynamics(None).delassus(delassus).free_velocity(free).shift(shift).build()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::planted::passes;

    #[test]
    fn every_reader_passes_its_checks_and_every_wrong_one_does_not() {
        passes(&PROBLEMS);
        passes(&SOLUTIONS);
        passes(&SCENES);
    }
}
