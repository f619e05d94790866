//! `Report`: what the gate found, as text, records and files.

use crate::errors::{IntoPython, invalid};
use moreau::files::write_together;
use moreau::gate::baseline::{Baseline, Change, ChangeKind};
use moreau::gate::{self, CheckOutcome, StepOutcome, Verdict, checks};
use moreau::report::gate::{junit, page, text};
use moreau::report::json::pretty;
use moreau::report::plot::{Curve, Panel, Role, svg};
use moreau::trajectory::Trajectory;
use moreau_checks::text::Style;
use pyo3::prelude::*;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// The day by Python's clock, as ISO 8601 writes it.
fn today(py: Python<'_>) -> PyResult<String> {
    py.import("datetime")?.getattr("date")?.call_method0("today")?.call_method0("isoformat")?.extract()
}

/// What the gate found; true where something was answered, nothing is bad, and nothing became worse than the baseline.
#[pyclass(frozen, module = "moreau_contact")]
pub struct Report {
    /// Verdicts and measurements.
    pub report: gate::Report,
    /// What became worse or better, where a baseline was compared.
    pub changes: Option<Vec<Change>>,
    /// How long each check took.
    pub times: BTreeMap<String, Duration>,
    /// The motion that an engine of this process answered last.
    pub motion: Option<Trajectory>,
}

#[pymethods]
impl Report {
    fn __bool__(&self) -> bool {
        let answered = self.report.count(Verdict::Pass) + self.report.count(Verdict::Difference);
        let fine = match &self.changes {
            Some(changes) => changes.iter().all(|change| change.kind != ChangeKind::Regression),
            None => !self.report.is_bad(),
        };
        answered > 0 && fine
    }

    /// The engine's name.
    #[getter]
    fn engine(&self) -> &str {
        &self.report.engine.name
    }

    /// Its version.
    #[getter]
    fn version(&self) -> &str {
        &self.report.engine.version
    }

    /// How many checks have each verdict.
    #[getter]
    fn counts(&self) -> BTreeMap<&'static str, usize> {
        let verdicts = [Verdict::Pass, Verdict::Difference, Verdict::Unsupported, Verdict::Errored, Verdict::Fail];
        verdicts.into_iter().map(|verdict| (verdict.word(), self.report.count(verdict))).collect()
    }

    /// Every check with its steps and measurements.
    #[getter]
    fn checks<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        loads(py, pretty(&self.report.checks))
    }

    /// What the probes find wrong with how the engine reports.
    #[getter]
    fn adapter<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        loads(py, pretty(&self.report.adapter))
    }

    /// What changed from the baseline; none where none was compared.
    #[getter]
    fn changes<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyAny>>> {
        self.changes.as_ref().map(|changes| loads(py, pretty(changes))).transpose()
    }

    /// The same report beside a baseline, of which it may hold a part: some checks, some of its time steps.
    fn compare(&self, py: Python<'_>, file: PathBuf) -> PyResult<Self> {
        let today = today(py)?;
        let compared = Baseline::read(&file).and_then(|baseline| {
            let today = today.parse().map_err(|error| moreau::Error::Unsupported(format!("the date {today} is none: {error}")))?;
            baseline.at(&self.report.sweep).compare(&self.report, today).map_err(|error| error.in_file(&file))
        });
        let changes = Some(compared.python(py)?);
        Ok(Report { report: self.report.clone(), changes, times: self.times.clone(), motion: self.motion.clone() })
    }

    /// The reports of one engine at several checks and time steps as one.
    #[staticmethod]
    fn joined(py: Python<'_>, parts: Vec<PyRef<'_, Report>>) -> PyResult<Self> {
        let Some(first) = parts.first() else {
            return Err(invalid(py, "parts", "is empty", "give at least one report"));
        };
        let of = |part: &Report| format!("{} {} with the options {}", part.engine(), part.version(), options_of(part));
        if let Some(other) = parts.iter().find(|part| of(part) != of(first)) {
            let problem = format!("is of {} and of {}", of(first), of(other));
            return Err(invalid(py, "parts", problem, "join the reports of one engine"));
        }
        let mut sweep: Vec<f64> = parts.iter().flat_map(|part| &part.report.sweep).copied().collect();
        sweep.sort_by(|one, other| other.total_cmp(one));
        sweep.dedup();
        let steps_of = |name: &str| -> Vec<StepOutcome> {
            let all = parts.iter().flat_map(|part| &part.report.checks).filter(|outcome| outcome.check == name);
            let mut steps: Vec<_> = all.flat_map(|outcome| outcome.steps.iter().cloned()).collect();
            steps.sort_by(|one, other| other.time_step.unwrap_or(0.0).total_cmp(&one.time_step.unwrap_or(0.0)));
            steps
        };
        let twice = checks::all().find(|check| {
            let steps: Vec<_> = steps_of(check.name).into_iter().map(|step| step.time_step).collect();
            steps.windows(2).any(|pair| pair[0] == pair[1])
        });
        if let Some(check) = twice {
            return Err(invalid(py, "parts", format!("has `{}` twice at one time step", check.name), "give each measurement once"));
        }
        let outcomes = checks::all().map(|check| (check.name, steps_of(check.name))).filter(|(_, steps)| !steps.is_empty());
        let checks = outcomes.map(|(name, steps)| CheckOutcome::new(name, steps)).collect();
        let times = parts.iter().flat_map(|part| part.times.clone()).collect();
        Ok(Report { report: gate::Report { sweep, checks, ..first.report.clone() }, changes: None, times, motion: None })
    }

    /// Writes a gate-report/1, a page, JUnit and a baseline, all or none.
    #[pyo3(signature = (*, json = None, html = None, junit = None, baseline = None))]
    fn write(
        &self,
        py: Python<'_>,
        json: Option<PathBuf>,
        html: Option<PathBuf>,
        junit: Option<PathBuf>,
        baseline: Option<PathBuf>,
    ) -> PyResult<()> {
        let mut texts: Vec<(PathBuf, String)> = Vec::new();
        let day = today(py)?;
        let day = || day.parse().map_err(|error| moreau::Error::Unsupported(format!("the date {day} is none: {error}")));
        for (file, text) in [
            (json, &(|| pretty(&self.report)) as &dyn Fn() -> moreau::Result<String>),
            (html, &|| page::html(&self.report, self.changes.as_deref(), day()?)),
            (junit, &|| junit::xml(&self.report, self.changes.as_deref(), &self.times)),
            (baseline, &|| Baseline::of(&self.report).to_toml()),
        ] {
            if let Some(file) = file {
                texts.push((file, text().python(py)?));
            }
        }
        let files: Vec<(&Path, &[u8])> = texts.iter().map(|(file, text)| (file.as_path(), text.as_bytes())).collect();
        write_together(&files).python(py)
    }

    /// This report, told what the probes before another one found wrong with the adapter.
    fn with_adapter_of(&self, other: &Report) -> Report {
        let report = gate::Report { adapter: other.report.adapter.clone(), ..self.report.clone() };
        Report { report, changes: self.changes.clone(), times: self.times.clone(), motion: self.motion.clone() }
    }

    /// What is wrong with the adapter and may explain why a check is bad: dicts of the probe, what the protocol demands, why, cure.
    fn explaining<'py>(&self, py: Python<'py>, check: &str) -> PyResult<Bound<'py, PyAny>> {
        let outcome = self.report.checks.iter().find(|outcome| outcome.check == check);
        let probes: Vec<_> = outcome.into_iter().flat_map(|outcome| self.report.explaining(outcome)).collect();
        loads(py, pretty(&probes))
    }

    /// A picture of the motion that an engine of this process answered last; none where there is none.
    fn motion_svg(&self, py: Python<'_>) -> PyResult<Option<String>> {
        self.motion.as_ref().map(picture).transpose().python(py)
    }

    /// The text of a gate-report/1.
    fn to_json(&self, py: Python<'_>) -> PyResult<String> {
        pretty(&self.report).python(py)
    }

    fn __str__(&self) -> String {
        let changes = self.changes.as_deref().map(|changes| text::changes(changes, Style::PLAIN)).unwrap_or_default();
        text::table(&self.report, Style::PLAIN) + &changes
    }

    fn __repr__(&self) -> String {
        let counts = self.counts().into_iter().map(|(word, count)| format!("{count} {word}")).collect::<Vec<_>>().join(", ");
        format!("Report({:?}, {counts})", self.report.engine.name)
    }
}

/// The options of an engine, as JSON.
fn options_of(report: &Report) -> String {
    serde_json::Value::Object(report.report.engine.options.clone()).to_string()
}

fn loads<'py>(py: Python<'py>, text: moreau::Result<String>) -> PyResult<Bound<'py, PyAny>> {
    py.import("json")?.call_method1("loads", (text.python(py)?,))
}

/// Position, velocity and spin of every body over time.
fn picture(motion: &Trajectory) -> moreau::Result<String> {
    type Values<'a> = (&'a str, fn(&moreau::trajectory::BodyTrack) -> &[[f64; 3]]);
    let kinds: [Values; 3] = [
        ("position [m]", |track| &track.position),
        ("velocity [m/s]", |track| &track.linear_velocity),
        ("spin [rad/s]", |track| &track.angular_velocity),
    ];
    let panel = |(axis, values): &Values| {
        let curve = |track: &moreau::trajectory::BodyTrack, place: usize| Curve {
            label: format!("{} {}", track.name, ["x", "y", "z"][place]),
            role: Role::Computed,
            points: motion.times.iter().copied().zip(values(track).iter().map(|value| value[place])).collect(),
        };
        let curves = motion.bodies.iter().flat_map(|track| [0, 1, 2].map(|place| curve(track, place))).collect();
        Panel { axis: axis.to_string(), curves }
    };
    let title = format!("{}, {}, h = {} s", motion.scene.name, motion.engine.name, motion.time_step);
    svg(&title, &kinds.iter().map(panel).collect::<Vec<_>>())
}
