//! What a trajectory must satisfy beyond being JSON of the right shape; every refusal names the field and a cure.

use super::file::{BodyTrack, GROUND, SCHEMA, Trajectory};
use crate::tolerance::trajectory::UNIT_LENGTH;
use moreau_exact::number::counted;
use moreau_exact::{Error, Result};

impl Trajectory {
    /// Checks sizes, times, names, finiteness and unit lengths.
    ///
    /// # Errors
    /// [`Error::Invalid`] names the first field that is not valid.
    pub fn validate(&self) -> Result<()> {
        if self.schema != SCHEMA {
            return Err(Error::invalid("schema", format!("is `{}`", self.schema), format!("use `{SCHEMA}`")));
        }
        self.scene.validate()?;
        if !(self.time_step.is_finite() && self.time_step > 0.0) {
            return Err(Error::invalid("time_step", format!("is {}", self.time_step), "use a positive number"));
        }
        self.validate_times()?;
        self.validate_bodies()?;
        self.validate_contacts()?;
        self.validate_steps()
    }

    fn validate_steps(&self) -> Result<()> {
        let Some(super::StepResiduals { limit, relative, accepted }) = &self.steps else { return Ok(()) };
        if relative.len() != accepted.len() {
            let problem = format!("has {}, but `steps.relative` has {}", counted(accepted.len(), "entry"), relative.len());
            return Err(Error::invalid("steps.accepted", problem, "give one entry per step in both"));
        }
        let is_size = |x: &f64| x.is_finite() && *x >= 0.0;
        match relative.iter().flatten().chain([limit]).find(|x| !is_size(x)) {
            None => Ok(()),
            Some(x) => {
                Err(Error::invalid("steps", format!("holds {x}"), "use finite numbers ≥ 0, and null for a step that solved nothing"))
            }
        }
    }

    fn validate_times(&self) -> Result<()> {
        if self.times.first() != Some(&0.0) {
            return Err(Error::invalid("times", "does not start at 0", "give the initial state at t = 0 as sample 0"));
        }
        finite("times", &self.times)?;
        match self.times.windows(2).position(|pair| pair[1] <= pair[0]) {
            None => Ok(()),
            Some(k) => Err(Error::invalid(format!("times[{}]", k + 1), "does not lie after its predecessor", "use increasing times")),
        }
    }

    fn validate_bodies(&self) -> Result<()> {
        if self.bodies.len() != self.scene.bodies.len() {
            let cure = format!("give {}, one per body of the scene", self.scene.bodies.len());
            return Err(Error::invalid("bodies", format!("has {}", counted(self.bodies.len(), "track")), cure));
        }
        for (index, (track, body)) in self.bodies.iter().zip(&self.scene.bodies).enumerate() {
            if track.name != body.name {
                let problem = format!("is `{}`", track.name);
                return Err(Error::invalid(format!("bodies[{index}].name"), problem, format!("use the scene's name `{}`", body.name)));
            }
            track.validate(&format!("bodies[{index}]"), self.times.len())?;
        }
        Ok(())
    }

    fn validate_contacts(&self) -> Result<()> {
        for (index, contact) in self.contacts.iter().enumerate() {
            let field = |name: &str| format!("contacts[{index}].{name}");
            if !(1..self.times.len()).contains(&contact.sample) {
                let cure = format!("use a sample from 1 to {}", self.times.len() - 1);
                return Err(Error::invalid(field("sample"), format!("is {}", contact.sample), cure));
            }
            if let Some(name) = contact.bodies.iter().find(|name| *name != GROUND && self.body(name).is_none()) {
                return Err(Error::invalid(field("bodies"), format!("names `{name}`"), "use a body of the scene, or `ground`"));
            }
            if contact.bodies[0] == contact.bodies[1] {
                return Err(Error::invalid(field("bodies"), "names one body twice", "name two different bodies"));
            }
            unit(&field("normal"), &contact.normal)?;
            finite(&field("impulse"), &contact.impulse)?;
        }
        Ok(())
    }
}

impl BodyTrack {
    fn validate(&self, path: &str, samples: usize) -> Result<()> {
        vectors(&format!("{path}.position"), &self.position, samples)?;
        vectors(&format!("{path}.linear_velocity"), &self.linear_velocity, samples)?;
        vectors(&format!("{path}.angular_velocity"), &self.angular_velocity, samples)?;
        vectors(&format!("{path}.orientation"), &self.orientation, samples)?;
        for (k, orientation) in self.orientation.iter().enumerate() {
            unit(&format!("{path}.orientation[{k}]"), orientation)?;
        }
        Ok(())
    }
}

fn vectors<const N: usize>(field: &str, rows: &[[f64; N]], samples: usize) -> Result<()> {
    if rows.len() != samples {
        return Err(Error::invalid(field, format!("has {}", counted(rows.len(), "sample")), format!("give {samples}, one per time")));
    }
    rows.iter().enumerate().try_for_each(|(k, row)| finite(&format!("{field}[{k}]"), row))
}

fn finite(field: &str, values: &[f64]) -> Result<()> {
    match values.iter().position(|x| !x.is_finite()) {
        None => Ok(()),
        Some(k) => Err(Error::invalid(format!("{field}[{k}]"), format!("is {}", values[k]), "use a finite number")),
    }
}

fn unit(field: &str, vector: &[f64]) -> Result<()> {
    let length = vector.iter().map(|x| x * x).sum::<f64>().sqrt();
    if (length - 1.0).abs() <= UNIT_LENGTH {
        return Ok(());
    }
    Err(Error::invalid(field, format!("has length {length}"), "use a unit vector"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mechanics::State;
    use crate::scenes;
    use crate::trajectory::{Producer, Recording};

    fn valid() -> Trajectory {
        let scene = scenes::named(scenes::NAMES[0]).expect("a listed scene");
        let (mechanism, initial) = scene.mechanism().expect("a planar scene");
        let mut recording = Recording::new(mechanism.name(), "none".into(), 0.25, initial.clone());
        recording.push(State { time: initial.time + 0.25, ..initial }, Vec::new());
        Trajectory::from_recording(&recording, mechanism.as_ref(), &scene, Producer::ours("none", "none")).expect("fits")
    }

    fn refused(change: impl Fn(&mut Trajectory), field: &str) {
        let mut trajectory = valid();
        change(&mut trajectory);
        let message = trajectory.validate().expect_err("must be refused").to_string();
        assert!(message.contains(field), "{message} does not name {field}");
        assert!(trajectory.to_json().is_err());
    }

    #[test]
    fn what_is_written_is_read_back_bit_for_bit() {
        let trajectory = valid();
        let text = trajectory.to_json().expect("valid");
        assert_eq!(Trajectory::from_json(&text).expect("written by us"), trajectory);
    }

    #[test]
    fn times_must_start_at_zero_and_increase() {
        refused(|t| t.times[0] = 0.1, "times");
        refused(|t| t.times[1] = 0.0, "times[1]");
        refused(|t| t.times.clear(), "times");
        refused(|t| t.time_step = 0.0, "time_step");
    }

    #[test]
    fn every_track_has_one_row_per_time_and_finite_numbers() {
        refused(|t| t.bodies[0].position.truncate(1), "bodies[0].position");
        refused(|t| t.bodies[0].linear_velocity[1][2] = f64::NAN, "bodies[0].linear_velocity[1][2]");
        refused(|t| t.bodies[0].orientation[1] = [2.0, 0.0, 0.0, 0.0], "bodies[0].orientation[1]");
        refused(|t| t.bodies[0].name = "other".into(), "bodies[0].name");
        refused(|t| t.bodies.clear(), "bodies");
    }

    #[test]
    fn a_contact_names_two_known_bodies_and_an_interval() {
        let record = |trajectory: &Trajectory| super::super::ContactRecord {
            sample: 1,
            bodies: [trajectory.bodies[0].name.clone(), GROUND.into()],
            normal: [0.0, 0.0, 1.0],
            impulse: [0.0, 0.0, 0.5],
        };
        let mut fine = valid();
        fine.contacts.push(record(&fine));
        fine.validate().expect("a fair contact");
        refused(|t| t.contacts.push(super::super::ContactRecord { sample: 0, ..record(t) }), "contacts[0].sample");
        refused(|t| t.contacts.push(super::super::ContactRecord { sample: 2, ..record(t) }), "contacts[0].sample");
        refused(|t| t.contacts.push(super::super::ContactRecord { normal: [0.0; 3], ..record(t) }), "contacts[0].normal");
        refused(|t| t.contacts.push(super::super::ContactRecord { bodies: [GROUND.into(), "nobody".into()], ..record(t) }), "nobody");
        refused(|t| t.contacts.push(super::super::ContactRecord { bodies: [GROUND.into(), GROUND.into()], ..record(t) }), "twice");
    }

    #[test]
    fn another_format_and_unknown_fields_are_named() {
        let text = valid().to_json().expect("valid");
        let other = text.replacen("trajectory/1", "trajectory/2", 1);
        assert!(Trajectory::from_json(&other).expect_err("refused").to_string().contains("trajectory/2"));
        let unknown = text.replacen("\"time_step\"", "\"colour\":1,\"time_step\"", 1);
        assert!(Trajectory::from_json(&unknown).expect_err("refused").to_string().contains("colour"));
    }
}
