//! Engines around an engine: one that is asked something else, one that reports something else, one that is corrected after every step.

use crate::description::OneOrMany;
use crate::{Description, Engine, Options, Parameter, Reply};
use moreau_dynamics::scenes::Scene;
use moreau_dynamics::trajectory::{BodyTrack, ContactRecord, Trajectory};

/// Our Moreau–Jean engine.
pub(super) fn moreau_jean() -> Box<dyn Engine> {
    Box::new(crate::own::by_name("moreau-jean").expect("a listed name"))
}

/// Misreads the scene, given h.
pub(super) struct Misread(pub fn(&mut Scene, f64));

impl Engine for Misread {
    fn describe(&mut self, options: &Options) -> Reply<Description> {
        moreau_jean().describe(options)
    }

    fn simulate(&mut self, scene: &Scene, h: f64, every: usize, options: &Options) -> Reply<Trajectory> {
        let mut misread = scene.clone();
        (self.0)(&mut misread, h);
        let trajectory = moreau_jean().simulate(&misread, h, every, options)?;
        Ok(Trajectory { scene: scene.clone(), ..trajectory })
    }
}

/// An engine with a wrong description.
pub(super) struct Misdeclare {
    /// The engine that computes.
    pub engine: fn() -> Box<dyn Engine>,
    /// Changes the description.
    pub declare: fn(&mut Description),
}

impl Engine for Misdeclare {
    fn describe(&mut self, options: &Options) -> Reply<Description> {
        let mut description = (self.engine)().describe(options)?;
        (self.declare)(&mut description);
        Ok(description)
    }

    fn simulate(&mut self, scene: &Scene, h: f64, every: usize, options: &Options) -> Reply<Trajectory> {
        (self.engine)().simulate(scene, h, every, options)
    }
}

/// Misreports the motion: every sample from the states of all steps up to its own.
pub(super) struct Misreport(pub fn(&BodyTrack, usize) -> [[f64; 3]; 3]);

impl Engine for Misreport {
    fn describe(&mut self, options: &Options) -> Reply<Description> {
        moreau_jean().describe(options)
    }

    fn simulate(&mut self, scene: &Scene, h: f64, every: usize, options: &Options) -> Reply<Trajectory> {
        let exact = moreau_jean().simulate(scene, h, 1, options)?;
        let mut reported = moreau_jean().simulate(scene, h, every, options)?;
        for (track, steps) in reported.bodies.iter_mut().zip(&exact.bodies) {
            for k in 0..track.position.len() {
                [track.position[k], track.linear_velocity[k], track.angular_velocity[k]] = (self.0)(steps, k * every);
            }
        }
        Ok(reported)
    }
}

/// One step, as its correction sees it.
pub(super) struct Moment<'a> {
    /// The scene with the states at the beginning of the step, after the changes by [`EachStep::before`].
    pub start: &'a Scene,
    /// The impulses of the step.
    pub contacts: &'a [ContactRecord],
    /// h \[s\].
    pub h: f64,
}

/// Changes the scene of every single step beforehand, or the states afterwards.
pub(super) struct EachStep {
    /// Given the number of the step, from 0.
    pub before: fn(&mut Scene, usize),
    /// Changes the bodies of the scene, which hold the states after the step.
    pub after: fn(&mut Scene, &Moment),
}

impl EachStep {
    /// Changes nothing.
    pub(super) const NOTHING: EachStep = EachStep { before: |_, _| {}, after: |_, _| {} };
}

impl Engine for EachStep {
    fn describe(&mut self, options: &Options) -> Reply<Description> {
        moreau_jean().describe(options)
    }

    fn simulate(&mut self, scene: &Scene, h: f64, every: usize, options: &Options) -> Reply<Trajectory> {
        let steps = (scene.duration / h).round() as usize;
        let mut state = Scene { duration: h, ..scene.clone() };
        let mut whole: Option<Trajectory> = None;
        let mut engine = moreau_jean();
        for step in 0..steps {
            let mut start = state.clone();
            (self.before)(&mut start, step);
            let one = engine.simulate(&start, h, 1, options)?;
            let whole = whole.get_or_insert_with(|| first_sample(&one, scene));
            take_over(&mut state, &one);
            (self.after)(&mut state, &Moment { start: &start, contacts: &one.contacts, h });
            let sample = step / every + 1;
            whole.contacts.extend(one.contacts.iter().map(|contact| ContactRecord { sample, ..contact.clone() }));
            if (step + 1) % every == 0 {
                whole.times.push((step + 1) as f64 * h);
                for (track, body) in whole.bodies.iter_mut().zip(&state.bodies) {
                    track.position.push(body.position);
                    track.orientation.push(body.orientation);
                    let [linear, angular] = body.velocities();
                    track.linear_velocity.push(linear);
                    track.angular_velocity.push(angular);
                }
            }
        }
        whole.ok_or_else(|| crate::Refusal::errored("no step"))
    }
}

fn first_sample(one: &Trajectory, scene: &Scene) -> Trajectory {
    let mut whole = Trajectory { scene: scene.clone(), times: vec![0.0], contacts: Vec::new(), steps: None, ..one.clone() };
    for track in &mut whole.bodies {
        track.position.truncate(1);
        track.orientation.truncate(1);
        track.linear_velocity.truncate(1);
        track.angular_velocity.truncate(1);
    }
    whole
}

/// The last sample becomes the state of the scene.
fn take_over(scene: &mut Scene, one: &Trajectory) {
    for (body, track) in scene.bodies.iter_mut().zip(&one.bodies) {
        let last = track.position.len() - 1;
        body.position = track.position[last];
        body.orientation = track.orientation[last];
        if !body.is_free() {
            continue;
        }
        body.linear_velocity = track.linear_velocity[last];
        body.angular_velocity = track.angular_velocity[last];
    }
}

/// Declares contact springs of this frequency \[1/s\].
pub(super) fn declare_springs(description: &mut Description, frequency: f64) {
    let frequency = Parameter { value: OneOrMany::One(frequency), unit: OneOrMany::One("1/s".into()) };
    description.contact_model.parameters.insert("contact_frequency".into(), frequency);
}
