//! A scene through a scheme for who is not at the terminal: what `simulate` runs, with its options as words.

use super::asked::Asked;
use super::certificate_options::asked;
use super::scene::{count_steps, find, in_scene, positive};
use super::scheme_options::SchemeOptions;
use crate::report::steps::StepSummary;
use crate::scenes::{self, Scene, Staged};
use crate::schemes::{self, Certified};
use crate::trajectory::{Producer, Recording, Trajectory};
use crate::{Error, Result, solvers};
use moreau_replicas::staging::{for_scheme, plastic_if_needed};

/// What is asked.
pub struct Question<'a> {
    /// A built-in scene of bodies, a linkage, or a file scene/1; unless `scene` is given.
    pub name: &'a str,
    /// The scene itself.
    pub scene: Option<Scene>,
    /// The scheme by name.
    pub scheme: &'a str,
    /// Its options as on the command line, `--theta`, `1`.
    pub options: &'a [String],
    /// The solver of the contact problems.
    pub solver: &'a str,
    /// h \[s\].
    pub step: f64,
    /// \[s\]; the scene's own if absent.
    pub duration: Option<f64>,
    /// Largest relative residual of a step that is accepted.
    pub tolerance: f64,
}

/// What came out.
pub struct Motion {
    /// Positions, velocities and impulses of the mechanism.
    pub recording: Recording,
    /// The same body by body; none of a linkage.
    pub trajectory: Option<Trajectory>,
    /// What the certificate says of the steps.
    pub steps: StepSummary,
    /// What was changed of the scene for the scheme, and of its duration for the step.
    pub note: Option<String>,
}

/// Simulates; `go_on` is asked after every step, and may end the motion with an error.
///
/// # Errors
/// [`Error::Invalid`] names the option; those of the steps.
pub fn motion(question: Question, mut go_on: impl FnMut() -> Result<()>) -> Result<Motion> {
    let options = SchemeOptions::of_words(question.options)?;
    let scheme = options.build(question.scheme)?;
    let solver = asked(solvers::ALL.by_name(question.solver)?, question.tolerance);
    let (staged, scene, note) = match scenes::linkage(question.name) {
        Some(linkage) if question.scene.is_none() => {
            if options.restitution()?.is_some() {
                return Err(Error::invalid("--restitution", format!("is fixed in {}", linkage.name), "give it to a scene of bodies"));
            }
            (linkage.staged()?, None, None)
        }
        _ => {
            let scene = question.scene.map_or_else(|| find(question.name, "--scene"), Ok)?;
            let (scene, note) = plastic_if_needed(scene, scheme.as_ref(), question.scheme, options.restitution()?);
            (for_scheme(&scene, question.scheme).map_err(|error| in_scene(error, question.name))?, Some(scene), note)
        }
    };
    let Staged { mechanism, start, duration, .. } = staged;
    let duration = question.duration.map_or(Ok(duration), |duration| positive("--duration", duration))?;
    let steps = count_steps(duration, question.step)?;
    let scene = scene.map(|scene| Scene { duration, ..scene });
    let notes: Vec<String> = note.map(String::from).into_iter().chain(steps.remark).collect();
    let asked = Asked::new(solver.as_ref());
    let certified = Certified::with_tolerance(&asked, question.tolerance);
    let observe = |_: &schemes::Step| go_on();
    let recording =
        schemes::simulate_certified(scheme.as_ref(), &certified, mechanism.as_ref(), start, question.step, steps.count, observe);
    let recording = recording.map_err(|error| in_scene(error, question.name))?;
    let engine = Producer::ours(&recording.scheme, solver.name());
    let trajectory = scene.map(|scene| Trajectory::from_recording(&recording, mechanism.as_ref(), &scene, engine)).transpose()?;
    let steps = StepSummary::of(&recording, mechanism.as_ref());
    Ok(Motion { recording, trajectory, steps, note: (!notes.is_empty()).then(|| notes.join("; ")) })
}
