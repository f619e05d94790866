//! The same scene in other units of length, mass and time.

use crate::checks::metamorphic::allowance::{SAMPLES, allowance};
use crate::checks::metamorphic::compare::difference;
use crate::checks::metamorphic::opened::opened;
use crate::checks::metamorphic::scenes::{DURATION, slide};
use crate::checks::scenery::schedule;
use crate::description::OneOrMany;
use crate::{Bench, Description, Measurement, Options, Parameter, Refusal, Reply};
use moreau_dynamics::scenes::Scene;
use moreau_dynamics::trajectory::Trajectory;

/// How many of the new units one of the old ones is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Units {
    length: f64,
    mass: f64,
    time: f64,
}

/// Millimetres and grams; and milliseconds besides.
const OTHERS: [(&str, Units); 2] = [
    (", in millimetres and grams", Units { length: 1000.0, mass: 1000.0, time: 1.0 }),
    (", in millimetres, grams and milliseconds", Units { length: 1000.0, mass: 1000.0, time: 1000.0 }),
];

pub(super) fn run(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    let (steps, every) = schedule(DURATION, SAMPLES, h);
    let original = bench.simulate(&slide(), h, steps, every)?;
    let mut measurements = Vec::new();
    for (words, units) in OTHERS {
        let options = units.parameters(bench.description()).map_err(Refusal::Errored)?;
        let image = bench.simulate_with(&units.scene(&slide()), h * units.time, steps, every, &options)?;
        measurements.extend(difference(&original, &units.undo(&image)).measured(words, allowance(), opened(bench, h)));
    }
    Ok(measurements)
}

impl Units {
    /// The scene in the new units; its duration is set by the bench.
    fn scene(&self, scene: &Scene) -> Scene {
        let Units { length, mass, time } = *self;
        let mut image = scene.clone();
        image.gravity = scene.gravity.map(|g| g * length / (time * time));
        if let Some(ground) = &mut image.ground {
            ground.offset *= length;
        }
        for body in &mut image.bodies {
            if let Some(sphere) = &mut body.sphere {
                sphere.radius *= length;
            }
            if let Some(cuboid) = &mut body.cuboid {
                cuboid.half_extents = cuboid.half_extents.map(|a| a * length);
            }
            for lengths in [
                body.capsule.as_mut().map(|c| [&mut c.radius, &mut c.half_height]),
                body.cylinder.as_mut().map(|c| [&mut c.radius, &mut c.half_height]),
            ]
            .into_iter()
            .flatten()
            {
                lengths.into_iter().for_each(|x| *x *= length);
            }
            body.mass *= mass;
            body.inertia = body.inertia.map(|moments| moments.map(|moment| moment * mass * length * length));
            body.position = body.position.map(|x| x * length);
            body.linear_velocity = body.linear_velocity.map(|v| v * length / time);
            body.angular_velocity = body.angular_velocity.map(|w| w / time);
            if let Some(prescribed) = &mut body.prescribed {
                prescribed.velocity = prescribed.velocity.map(|v| v * length / time);
                prescribed.angular_velocity = prescribed.angular_velocity.map(|w| w / time);
            }
        }
        image
    }

    /// The trajectory in the old units.
    fn undo(&self, image: &Trajectory) -> Trajectory {
        let Units { length, time, .. } = *self;
        let mut original = image.clone();
        original.times.iter_mut().for_each(|t| *t /= time);
        for track in &mut original.bodies {
            track.position.iter_mut().flatten().for_each(|x| *x /= length);
            track.linear_velocity.iter_mut().flatten().for_each(|v| *v *= time / length);
            track.angular_velocity.iter_mut().flatten().for_each(|w| *w *= time);
        }
        original
    }

    /// The declared parameters in the new units, as options.
    fn parameters(&self, description: &Description) -> Result<Options, String> {
        let convert = |(name, parameter): (&String, &Parameter)| {
            let factor =
                |unit: &str| self.factor(unit).ok_or_else(|| format!("the unit `{unit}` of `{name}` is not one of docs/protocol.md"));
            let value = match (&parameter.value, &parameter.unit) {
                (OneOrMany::One(value), OneOrMany::One(unit)) => (value * factor(unit)?).into(),
                (OneOrMany::Many(values), OneOrMany::One(unit)) => {
                    let factor = factor(unit)?;
                    values.iter().map(|value| value * factor).collect::<Vec<f64>>().into()
                }
                (OneOrMany::Many(values), OneOrMany::Many(units)) if values.len() == units.len() => {
                    let entries = values.iter().zip(units).map(|(value, unit)| Ok(value * factor(unit)?));
                    entries.collect::<Result<Vec<f64>, String>>()?.into()
                }
                _ => return Err(format!("`{name}` has other numbers of values than of units")),
            };
            Ok((name.clone(), value))
        };
        description.contact_model.parameters.iter().map(convert).collect()
    }

    /// By what a number in a unit of the protocol (`kg`, `m/s^2`, `N*s/m`, …) is multiplied; `None` for another unit.
    fn factor(&self, unit: &str) -> Option<f64> {
        let Units { length, mass, time } = *self;
        let mut factor = 1.0;
        for (k, quotient) in unit.split('/').enumerate() {
            for power in quotient.split('*') {
                let (symbol, exponent) = power.split_once('^').unwrap_or((power, "1"));
                let exponent: i32 = exponent.trim().parse().ok()?;
                let one = match symbol.trim() {
                    "kg" => mass,
                    "m" => length,
                    "s" => time,
                    "N" => mass * length / (time * time),
                    "rad" | "1" => 1.0,
                    _ => return None,
                };
                factor *= f64::powi(one, if k == 0 { exponent } else { -exponent });
            }
        }
        Some(factor)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const UNITS: Units = Units { length: 1000.0, mass: 10.0, time: 100.0 };

    #[test]
    fn units_are_products_and_quotients_of_whole_powers() {
        let expected = [
            ("m", 1e3),
            ("1", 1.0),
            ("rad/s", 1e-2),
            ("m/s^2", 0.1),
            ("N/m", 1e-3),
            ("N*s/m", 0.1),
            ("1/s", 1e-2),
            ("kg*m^2", 1e7),
            ("s^-1", 1e-2),
        ];
        for (unit, factor) in expected {
            let found = UNITS.factor(unit).expect(unit);
            assert!((found / factor - 1.0).abs() <= moreau_exact::tolerance::rounding(8, 1.0), "{unit}: {found}");
        }
        for unit in ["mm", "", "m^x", "m per s"] {
            assert_eq!(UNITS.factor(unit), None, "{unit}");
        }
    }

    #[test]
    fn a_scene_in_other_units_is_the_same_scene() {
        let (scene, image) = (slide(), UNITS.scene(&slide()));
        assert!((image.gravity[2] - scene.gravity[2] / 10.0).abs() <= moreau_exact::tolerance::rounding(4, 10.0));
        assert_eq!(image.bodies[0].sphere.map(|sphere| sphere.radius), Some(100.0));
        assert_eq!(image.bodies[0].mass, 20.0);
        image.validate().expect("valid");
    }
}
