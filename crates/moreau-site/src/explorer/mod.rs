//! One page to try things on: a scene, a scheme and its parameters, and what each step does.
//!
//! ```text
//! SCENES × SCHEMES × STEPS × θ × μ × e ──► runs, computed by the library of the command ──► files of scripts ──► run(scene, scheme, …)
//! ```
//! [`files`] computes every run and gives the files of the folder `explorer/`; [`content`] is what stands between a page's header and its
//! footer and asks for them, and [`page`] is a whole page. The page's program knows the runs by one function, so that something that
//! computes them in the browser could stand in for the stored ones.
//!
//! For programs that drive the page: `#explorer` gets `data-ready`, another number after every choice that is drawn; the controls are
//! `#explorer-scene`, `-scheme`, `-theta`, `-restitution`, `-friction`, `-step`, `-time`, `-play`, `-back`, `-on` and `-speed`, the line for
//! readers aloud `-numbers`; a panel is `#explorer-P` with `-P-certificate`, `-P-refusal`, `-P-motion`, `-P-cone`, `-P-gap`, `-P-energy`,
//! `-P-natural`, `-P-numbers`, `-P-note` and `-P-command`, P one of `coulomb`, `anitescu`, `sap` and `mujoco`.
//!
//! ```no_run
//! use moreau_site::{Language, explorer};
//!
//! for (name, text) in explorer::files(&|done, of| eprintln!("{done} of {of}"))? {
//!     std::fs::write(std::path::Path::new("site/explorer").join(name), text).expect("a writable folder");
//! }
//! // the folder of the files, seen from the page
//! let page = explorer::page(Language::English, "explorer/");
//! # Ok::<(), moreau_exact::Error>(())
//! ```

mod code;
mod data;
mod grid;
mod run;
mod texts;
mod view;

pub use code::{DECIMALS, decode, fixed, residual};
pub use data::{Stored, stored};
pub use grid::{Choice, SCENES, SCHEMES, STEPS, SceneEntry, SchemeEntry};
pub use run::{Run, Slot, WIDTHS, compute, posed, unwound};
pub use view::{TITLE, content, page};

use moreau_exact::Result;
use std::collections::BTreeMap;

/// The files of the folder `explorer/` by name: the runs, the program, the style, and the scene of every run as a scene/1. `progress` is
/// told how many runs are done, and of how many; it may be called from several threads.
///
/// # Errors
/// If a scene of the table is not valid; a run that a scheme refuses is stored as what the scheme says.
pub fn files(progress: &(dyn Fn(usize, usize) + Sync)) -> Result<Vec<(String, String)>> {
    let mut files = data::scripts(&SCENES, progress)?;
    let mut scenes = BTreeMap::new();
    for entry in &SCENES {
        for choice in entry.choices() {
            scenes.insert(choice.scene_file(), entry.with(choice.friction, choice.restitution)?.to_json()?);
        }
    }
    files.extend(scenes);
    files.extend(view::FILES.map(|(name, text)| (name.into(), text.into())));
    Ok(files)
}

#[cfg(test)]
mod tests;
