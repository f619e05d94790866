//! `gate` and `checks`: an engine that is a Python class, or a command, through the checks.

use crate::away::enter;
use crate::engine::{PythonEngine, Shared, Stoppable};
use crate::errors::{IntoPython, invalid};
use crate::interrupt;
use crate::report::Report;
use moreau::cli::progress as bars;
use moreau::gate::baseline::Baseline;
use moreau::gate::process::{Limits, ProcessEngine, end_engines};
use moreau::gate::runner::{QUICK, SWEEP, run_watched};
use moreau::gate::{Check, Engine, Options, Plan, Refusal, Run, checks as registry, conformance, planted};
use moreau::report::gate::conformance::text as conformance_text;
use moreau::report::json::pretty;
use moreau_checks::text::Style;
use pyo3::prelude::*;
use serde_json::json;
use std::collections::BTreeMap;
use std::sync::atomic::Ordering;
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

/// Every check, a JSON list.
#[pyfunction]
pub fn checks(py: Python<'_>) -> PyResult<String> {
    let entry = |check: &'static Check| {
        let others = planted::all().filter(|planted| planted.subject.caught_by.contains(&check.name)).map(|planted| planted.name);
        json!({
            "check": check.name,
            "family": check.family(),
            "level": check.level,
            "each_time_step": matches!(check.run, Run::EachStep(_)),
            "question": check.question,
            "derivation": check.derivation,
            "source": check.source,
            "failed_by": std::iter::once(check.control.fails).chain(others.filter(|name| *name != check.control.fails)).collect::<Vec<_>>(),
        })
    };
    pretty(&json!({
        "checks": registry::all().map(entry).collect::<Vec<_>>(),
        "quick": QUICK,
        "sweep": SWEEP,
    }))
    .python(py)
}

/// What is asked of the gate; the checks by name, the time steps as numbers.
#[pyfunction]
#[pyo3(signature = (engine, command, names, steps, options, jobs, repeats, time_limit, start_limit, probes, progress = None))]
#[expect(clippy::too_many_arguments, reason = "the arguments of the call in Python")]
pub fn gate(
    py: Python<'_>,
    engine: Option<Py<PyAny>>,
    command: Vec<String>,
    names: Vec<String>,
    steps: Vec<f64>,
    options: &str,
    jobs: usize,
    repeats: usize,
    time_limit: f64,
    start_limit: f64,
    probes: bool,
    progress: Option<Py<PyAny>>,
) -> PyResult<Report> {
    let _here = enter()?;
    let checks = names.iter().map(|name| registry::find(name).ok_or_else(|| unknown(py, name))).collect::<PyResult<Vec<_>>>()?;
    let options: Options = serde_json::from_str(options).map_err(moreau::Error::Json).python(py)?;
    let limits =
        Limits { reply: seconds(py, "time_limit", time_limit)?, start: seconds(py, "start_limit", start_limit)?, ..Limits::default() };
    let shared = Shared::default();
    let make: Box<dyn Fn() -> Box<dyn Engine> + Sync> = match engine {
        Some(class) => {
            let (class, shared) = (Mutex::new(class), shared.clone());
            Box::new(move || {
                let class = class.lock().unwrap_or_else(PoisonError::into_inner);
                let engine = PythonEngine::new(Python::attach(|py| class.clone_ref(py)), shared.clone());
                Box::new(Stoppable { engine: Box::new(engine), stopped: shared.stopped.clone() })
            })
        }
        None => {
            let stopped = shared.stopped.clone();
            Box::new(move || {
                let engine = ProcessEngine::new(command.clone(), limits);
                Box::new(Stoppable { engine: Box::new(engine), stopped: stopped.clone() })
            })
        }
    };
    let bar = bars::parts(0, "measurements");
    let plan = Plan { checks, sweep: steps, options, jobs, repeats, progress: &|| bar.inc(1) };
    bar.set_length(plan.tasks() as u64);
    let times = Mutex::new(BTreeMap::new());
    let work = || {
        let adapter = if probes { conformance::misreported(make().as_mut(), &plan.options)? } else { Vec::new() };
        let heard = |report: &moreau::gate::Report, name: &'static str, time: Duration| {
            times.lock().unwrap_or_else(PoisonError::into_inner).insert(name.to_string(), time);
            let verdict = report.checks.iter().find(|outcome| outcome.check == name).map_or("", |outcome| outcome.verdict.word());
            if let Some(listener) = &progress {
                // a listener that fails is told where Python tells what nobody catches, and the run goes on
                Python::attach(|py| {
                    if let Err(error) = listener.call1(py, (name, verdict, time.as_secs_f64())) {
                        error.write_unraisable(py, Some(listener.bind(py)));
                    }
                });
            }
        };
        let run = || run_watched(make.as_ref(), &plan, &heard);
        bars::shown(&bar, run).map(|report| moreau::gate::Report { adapter, ..report })
    };
    let report = interrupt::watched(py, work, || {
        shared.stopped.store(true, Ordering::Relaxed);
        end_engines();
        Python::attach(|py| {
            // the engine that is being asked is told; if even that fails, its answer is awaited
            let _ = py.import("moreau_contact._engine").and_then(|glue| glue.call_method0("interrupt"));
        });
    })?;
    let report = report.map_err(|refusal| cannot_run(py, &refusal))?;
    let motion = shared.last.lock().unwrap_or_else(PoisonError::into_inner).take();
    let times = times.into_inner().unwrap_or_else(PoisonError::into_inner);
    Ok(Report { report, changes: None, times, motion })
}

/// The steps [s] of a baseline that can be read.
#[pyfunction]
pub fn baseline_steps(py: Python<'_>, file: std::path::PathBuf) -> PyResult<Vec<f64>> {
    Baseline::read(&file).map(|baseline| baseline.sweep).python(py)
}

/// What the probes of `moreau protocol-check` find in a child: a text, a JSON object, and whether nothing is wrong.
#[pyfunction]
pub fn protocol_check(py: Python<'_>, command: Vec<String>, time_limit: f64) -> PyResult<(String, String, bool)> {
    let reply = seconds(py, "time_limit", time_limit)?;
    let limits = Limits { reply, start: reply, ..Limits::default() };
    let outcome = interrupt::watched(py, || conformance::conformance(&command, limits), end_engines)?;
    let outcome = outcome.map_err(|fault| cannot_run(py, &Refusal::errored(fault)))?;
    Ok((conformance_text(&outcome, Style::PLAIN), pretty(&outcome).python(py)?, outcome.is_sound()))
}

fn unknown(py: Python<'_>, name: &str) -> PyErr {
    invalid(py, "only", format!("`{name}` is no check"), "`moreau_contact.checks()` has every check")
}

fn seconds(py: Python<'_>, name: &str, number: f64) -> PyResult<Duration> {
    let limit = Duration::try_from_secs_f64(number).ok().filter(|limit| !limit.is_zero());
    limit.ok_or_else(|| invalid(py, name, format!("is {number}"), "use a positive number of seconds"))
}

fn cannot_run(py: Python<'_>, refusal: &Refusal) -> PyErr {
    let made = py
        .import("moreau_contact._errors")
        .and_then(|errors| errors.getattr("EngineError")?.call1((format!("the engine could not be run: {refusal}"),)));
    made.map_or_else(|failure| failure, PyErr::from_value)
}
