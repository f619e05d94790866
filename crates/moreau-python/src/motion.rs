//! `simulate` and `Motion`: a scene through a scheme, as arrays.

use crate::arrays::{to_rows, to_vector};
use crate::away::{away, enter};
use crate::certificate::accepted;
use crate::errors::{IntoPython, invalid, rejected};
use crate::interrupt;
use moreau::cli::motion::{Motion as Moved, Question, motion};
use moreau::number::counted;
use moreau::scenes::{LINKAGES, NAMES, Scene};
use moreau::trajectory::{BodyTrack, Trajectory};
use moreau::{Error, files};
use numpy::{PyArray1, PyArray2};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyString};
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};

/// A motion, every step of which was certified.
#[pyclass(frozen, module = "moreau_contact")]
pub struct Motion {
    moved: Moved,
}

/// Simulates a scene: a name, a file scene/1, or its text where it is a dict.
#[pyfunction]
#[pyo3(signature = (scene, scheme, step, duration, solver, tolerance, accept_rejected, options))]
#[expect(clippy::too_many_arguments, reason = "the arguments of the call in Python")]
pub fn simulate(
    py: Python<'_>,
    scene: &Bound<'_, PyAny>,
    scheme: &str,
    step: f64,
    duration: Option<f64>,
    solver: &str,
    tolerance: Option<f64>,
    accept_rejected: bool,
    options: Vec<String>,
) -> PyResult<Py<Motion>> {
    let _here = enter()?;
    let (name, given) = match scene.cast::<PyDict>() {
        Ok(dict) => (String::new(), Some(text_of(dict)?)),
        Err(_) if scene.is_instance_of::<PyString>() => (scene.extract::<String>()?, None),
        Err(_) => match scene.extract::<PathBuf>() {
            Ok(file) => (file.to_string_lossy().into_owned(), None),
            Err(_) => {
                return Err(invalid(py, "scene", "is no scene", "give a name of `moreau_contact.scenes()`, a file scene/1 or a dict"));
            }
        },
    };
    let scene = given.map(|text| Scene::from_json(&text)).transpose().python(py)?;
    let tolerance = accepted(py, tolerance)?;
    let question = Question { name: &name, scene, scheme, options: &options, solver, step, duration, tolerance };
    let stopped = AtomicBool::new(false);
    let go_on = || match stopped.load(Ordering::Relaxed) {
        true => Err(Error::Unsupported("the motion was interrupted".into())),
        false => Ok(()),
    };
    let moved = interrupt::watched(py, || motion(question, go_on), || stopped.store(true, Ordering::Relaxed))?.python(py)?;
    let refused = moved.steps.rejected;
    let told = format!("the certificate rejects {refused} of {}; accept_rejected=True lets them pass", counted(moved.steps.steps, "step"));
    let motion = Py::new(py, Motion { moved })?;
    if refused > 0 && !accept_rejected {
        return Err(rejected(py, &told, solver, motion.into_any()));
    }
    Ok(motion)
}

/// The names of the built-in scenes.
#[pyfunction]
pub fn scenes() -> Vec<&'static str> {
    NAMES.into_iter().chain(LINKAGES.iter().map(|linkage| linkage.name)).collect()
}

fn text_of(dict: &Bound<'_, PyDict>) -> PyResult<String> {
    dict.py().import("moreau_contact._engine")?.call_method1("text_of", (dict,))?.extract()
}

#[pymethods]
impl Motion {
    /// The name of what moves.
    #[getter]
    fn mechanism(&self) -> &str {
        &self.moved.recording.mechanism
    }

    /// The scheme with its parameters.
    #[getter]
    fn scheme(&self) -> &str {
        &self.moved.recording.scheme
    }

    /// h [s].
    #[getter]
    fn step(&self) -> f64 {
        self.moved.recording.time_step
    }

    /// What was changed of the scene for the scheme and of its duration for the step, or None.
    #[getter]
    fn note(&self) -> Option<&str> {
        self.moved.note.as_deref()
    }

    /// t_k [s], samples; the first is the start.
    #[getter]
    fn times<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        let times: Vec<f64> = self.moved.recording.samples.iter().map(|state| state.time).collect();
        to_vector(py, &times)
    }

    /// Coordinates of the mechanism [m, rad], samples × nq.
    #[getter]
    fn q<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let samples = &self.moved.recording.samples;
        to_rows(py, samples.iter().flat_map(|state| state.position.iter().copied()).collect(), samples[0].position.len())
    }

    /// Velocities of the mechanism [m/s, rad/s], samples × nv.
    #[getter]
    fn v<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let samples = &self.moved.recording.samples;
        to_rows(py, samples.iter().flat_map(|state| state.velocity.iter().copied()).collect(), samples[0].velocity.len())
    }

    /// The names of the bodies; none of a linkage.
    #[getter]
    fn bodies(&self) -> Vec<&str> {
        self.moved.trajectory.iter().flat_map(|trajectory| &trajectory.bodies).map(|track| track.name.as_str()).collect()
    }

    /// Of a body: `position` [m], samples × 3; `orientation`, unit quaternions (w, x, y, z); `linear_velocity` [m/s];
    /// `angular_velocity` [rad/s], world frame.
    fn body<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyDict>> {
        let track = self.tracks().iter().find(|track| track.name == name);
        let track =
            track.ok_or_else(|| invalid(py, "name", format!("`{name}` is no body"), format!("use one of {}", self.bodies().join(", "))))?;
        let all = PyDict::new(py);
        all.set_item("position", to_rows(py, track.position.concat(), 3)?)?;
        all.set_item("orientation", to_rows(py, track.orientation.concat(), 4)?)?;
        all.set_item("linear_velocity", to_rows(py, track.linear_velocity.concat(), 3)?)?;
        all.set_item("angular_velocity", to_rows(py, track.angular_velocity.concat(), 3)?)?;
        Ok(all)
    }

    /// Every pair and step with an impulse: `sample` at its end, `bodies`, `normal` from the second to the first, `impulse` on the first
    /// [N·s], n × 3.
    #[getter]
    fn contacts<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let contacts = self.moved.trajectory.as_ref().map_or(&[][..], |trajectory| &trajectory.contacts);
        let all = PyDict::new(py);
        all.set_item("sample", PyArray1::from_iter(py, contacts.iter().map(|contact| contact.sample)))?;
        all.set_item("bodies", contacts.iter().map(|contact| contact.bodies.clone()).map(|[a, b]| (a, b)).collect::<Vec<_>>())?;
        all.set_item("normal", to_rows(py, contacts.iter().flat_map(|contact| contact.normal).collect(), 3)?)?;
        all.set_item("impulse", to_rows(py, contacts.iter().flat_map(|contact| contact.impulse).collect(), 3)?)?;
        Ok(all)
    }

    /// The largest relative residual of every step; not a number where nothing was solved.
    #[getter]
    fn residuals<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        let residuals = &self.moved.recording.residuals;
        let relative: Vec<f64> = residuals.iter().map(|residual| residual.map_or(f64::NAN, |residual| residual.relative)).collect();
        to_vector(py, &relative)
    }

    /// How many steps the certificate rejects.
    #[getter]
    fn rejected(&self) -> usize {
        self.moved.steps.rejected
    }

    /// How many steps of a declared number of sweeps are above the limit.
    #[getter]
    fn unconverged(&self) -> usize {
        self.moved.steps.unconverged
    }

    /// The text of a trajectory/1.
    fn to_json(&self, py: Python<'_>) -> PyResult<String> {
        let none = || invalid(py, "scene", "is a linkage, of which there is no trajectory/1", "use q, v and times");
        self.moved.trajectory.as_ref().ok_or_else(none)?.to_json().python(py)
    }

    /// Writes a trajectory/1, whole or not at all.
    fn write(&self, py: Python<'_>, file: PathBuf) -> PyResult<()> {
        let text = self.to_json(py)?;
        away(py, || files::write_atomically(&file, text.as_bytes()))?.python(py)
    }

    fn __repr__(&self) -> String {
        let recording = &self.moved.recording;
        let steps = recording.samples.len() - 1;
        format!(
            "Motion({:?}, {:?}, {steps} steps of {} s, rejected={})",
            recording.mechanism,
            recording.scheme,
            recording.time_step,
            self.rejected()
        )
    }
}

impl Motion {
    fn tracks(&self) -> &[BodyTrack] {
        self.moved.trajectory.as_ref().map_or(&[], |trajectory: &Trajectory| &trajectory.bodies)
    }
}
