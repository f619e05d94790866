//! The scenes of the sweep as files, for simulators that are run elsewhere.

use crate::checks::text::counted;
use crate::cli::Answer;
use crate::cli::output::{print, style};
use crate::cli::progress;
use crate::cli::several::make_folder;
use crate::files::write_atomically;
use crate::gate::library::{Requests, read_description};
use crate::gate::runner::{self, Plan};
use crate::gate::{Check, Engine, Options, own};
use crate::report::json::pretty;
use crate::scenes::Scene;
use crate::{Error, Result};
use serde::Serialize;
use std::path::Path;
use std::sync::{Arc, Mutex};

/// A request of the index.
#[derive(PartialEq, Serialize)]
struct Request {
    /// The file with the scene/1, beside the index.
    file: String,
    /// h \[s\].
    time_step: f64,
    /// How many steps apart the samples are.
    sample_every: usize,
}

/// Writes every scene that the checks ask for as a scene/1, once for each time step, and `index.json` with h and `sample_every` of each.
///
/// # Errors
/// [`Error::Invalid`] where they ask for none, as at time steps that are longer than their motions.
pub fn write(folder: &Path, checks: &[&'static Check], sweep: &[f64], description: Option<&Path>) -> Result<Answer> {
    let description = description.map(read_description).transpose()?;
    make_folder("--write-scenes", folder)?;
    let asked = Arc::new(Mutex::new(Vec::new()));
    let make = || -> Box<dyn Engine> {
        let inner = own::by_name("moreau-jean").expect("a built-in scheme");
        Box::new(Requests { inner: Box::new(inner), description: description.clone(), asked: asked.clone() })
    };
    let bar = progress::parts(0, "measurements");
    let progress = || bar.inc(1);
    let plan = Plan { checks: checks.to_vec(), sweep: sweep.to_vec(), options: Options::new(), jobs: 1, repeats: 1, progress: &progress };
    bar.set_length(plan.tasks() as u64);
    progress::shown(&bar, || runner::run(&make, &plan)).map_err(|refusal| Error::Unsupported(refusal.to_string()))?;
    let asked = asked.lock().map(|asked| asked.clone()).unwrap_or_default();
    let mut distinct: Vec<(Scene, f64, usize)> = Vec::new();
    for request in asked {
        if !distinct.contains(&request) {
            distinct.push(request);
        }
    }
    if distinct.is_empty() {
        let problem = "has no scene to write: at these time steps the checks ask for no motion";
        return Err(Error::invalid("--write-scenes", problem, "take shorter ones with `--steps`"));
    }
    let named = distinct.iter().enumerate().map(|(k, (scene, ..))| format!("{k:03}-{}.json", plain(&scene.name)));
    refuse_others(folder, &named.collect::<Vec<_>>())?;
    let mut index = Vec::new();
    for (k, (scene, time_step, sample_every)) in distinct.into_iter().enumerate() {
        let file = format!("{k:03}-{}.json", plain(&scene.name));
        write_atomically(&folder.join(&file), scene.to_json()?.as_bytes())?;
        index.push(Request { file, time_step, sample_every });
    }
    write_atomically(&folder.join(INDEX), pretty(&index)?.as_bytes())?;
    let (count, folder) = (counted(index.len(), "scene"), folder.display());
    let line = format!("{count} in {folder}; {INDEX} there has time_step and sample_every of each. Answer each with a trajectory/1.");
    print(&(style().wrapped("", "", &line) + "\n"))?;
    Ok(Answer::Yes)
}

/// Refuses a folder with scenes of another call, which would be answered as if they were of this one.
fn refuse_others(folder: &Path, named: &[String]) -> Result<()> {
    let Ok(text) = std::fs::read_to_string(folder.join(INDEX)) else { return Ok(()) };
    let Ok(old) = serde_json::from_str::<Vec<serde_json::Value>>(&text) else {
        let problem = format!("is {}, whose {INDEX} is no list of scenes", folder.display());
        return Err(Error::invalid("--write-scenes", problem, "give an empty folder"));
    };
    let old = old.iter().filter_map(|request| request["file"].as_str());
    match old.filter(|file| folder.join(file).exists()).find(|file| !named.iter().any(|name| name == file)) {
        Some(file) => {
            let problem = format!("is {}, which has scenes of another call, such as {file}", folder.display());
            Err(Error::invalid("--write-scenes", problem, "give an empty folder, or empty this one"))
        }
        None => Ok(()),
    }
}

/// The list of what is asked for.
const INDEX: &str = "index.json";

/// The name of a scene as a part of a file's name: letters, digits and hyphens.
fn plain(name: &str) -> String {
    name.chars().map(|letter| if letter.is_ascii_alphanumeric() { letter } else { '-' }).collect()
}
