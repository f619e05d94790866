//! The scenes of the sweep as files, for simulators that are run elsewhere.

use crate::cli::Answer;
use crate::cli::output::print;
use crate::files::write_atomically;
use crate::gate::library::Requests;
use crate::gate::runner::{self, Plan};
use crate::gate::{Check, Engine, Options, own};
use crate::report::json::pretty;
use crate::{Error, Result};
use std::path::Path;
use std::sync::{Arc, Mutex};

/// Writes every scene the checks ask for, once per scene and time step, and an index with h and `sample_every`.
pub fn write(folder: &Path, checks: &[&'static Check], sweep: &[f64]) -> Result<Answer> {
    let asked = Arc::new(Mutex::new(Vec::new()));
    let make = || -> Box<dyn Engine> {
        let inner = own::by_name("moreau-jean").expect("a built-in scheme");
        Box::new(Requests { inner: Box::new(inner), asked: asked.clone() })
    };
    let plan = Plan { checks: checks.to_vec(), sweep: sweep.to_vec(), options: Options::new(), jobs: 1, repeats: 1, progress: &|| {} };
    runner::run(&make, &plan).map_err(|refusal| Error::Unsupported(refusal.to_string()))?;
    let asked = asked.lock().map(|asked| asked.clone()).unwrap_or_default();
    std::fs::create_dir_all(folder).map_err(|source| Error::Write { file: folder.to_path_buf(), source })?;
    let mut index = Vec::new();
    for (scene, time_step, sample_every) in asked {
        let entry = serde_json::json!({"scene": scene, "time_step": time_step, "sample_every": sample_every});
        if index.contains(&entry) {
            continue;
        }
        let file = folder.join(format!("{:03}-{}.json", index.len(), scene.name));
        write_atomically(&file, pretty(&entry)?.as_bytes())?;
        index.push(entry);
    }
    print(&format!(
        "{} requests in {}: each file has scene, time_step and sample_every; answer each with a trajectory/1\n",
        index.len(),
        folder.display()
    ))?;
    Ok(Answer::Yes)
}
