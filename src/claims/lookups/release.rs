//! Of what a row asks: a package at its version, a repository at a commit, or a record of literature.

use crate::stored::{RUNS, read};
use crate::{Error, Result};
use serde::Deserialize;
use serde_json::Value;

const REPOSITORIES: &str = "facts/repositories.json";
const LITERATURE: &str = "facts/literature.json";

/// Something of which facts are stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Release {
    /// A package: its file below `references/`, and its version.
    Package(&'static str, &'static str),
    /// A public repository: its name, and the tag or the commit.
    Tree(&'static str, &'static str),
    /// A record of literature, by its name.
    Record(&'static str),
}

/// Debian's packages of Siconos.
pub const SICONOS: Release = Release::Package("facts/siconos.json", "4.4.0+dfsg-2");
/// MuJoCo's Python package.
pub const MUJOCO: Release = Release::Package("facts/mujoco.json", "3.17.0");
/// Drake's Python package.
pub const DRAKE: Release = Release::Package("facts/drake.json", "1.51.1");
/// The source distribution of PyBullet.
pub const BULLET: Release = Release::Package("bullet/package.json", "3.2.7");
/// The wheel libpinocchio.
pub const PINOCCHIO: Release = Release::Package("pinocchio/package.json", "4.1.0");
/// Siconos, tag 4.4.0 of September 2021.
pub const SICONOS_440: Release = Release::Tree("siconos/siconos", "4.4.0");
/// Siconos, tag 4.5.0 of March 2024.
pub const SICONOS_450: Release = Release::Tree("siconos/siconos", "4.5.0");
/// Siconos's main branch of August 2026.
pub const SICONOS_2026: Release = Release::Tree("siconos/siconos", "6070f0f6");
/// Drake's main branch of August 2026.
pub const DRAKE_2026: Release = Release::Tree("RobotLocomotion/drake", "be259df7");
/// MuJoCo's main branch of August 2026.
pub const MUJOCO_2026: Release = Release::Tree("google-deepmind/mujoco", "a7255075");
/// Chrono's main branch of August 2026.
pub const CHRONO_2026: Release = Release::Tree("projectchrono/chrono", "7689fbc0");
/// Pinocchio, tag v2.7.0.
pub const PINOCCHIO_2: Release = Release::Tree("stack-of-tasks/pinocchio", "v2.7.0");
/// Pinocchio, tag v3.7.0 of May 2025.
pub const PINOCCHIO_3: Release = Release::Tree("stack-of-tasks/pinocchio", "v3.7.0");
/// Stewart's survey of 2000.
pub const SURVEY: Release = Release::Record("stewart-2000");
/// Anitescu's paper of 2006.
pub const ANITESCU: Release = Release::Record("anitescu-2006");
/// Eich's paper of 1993.
pub const EICH: Release = Release::Record("eich-1993");
/// Stewart's paper of 1998, by the chapter the proof that resolves Painlevé's paradox.
pub const STEWART: Release = Release::Record("stewart-1998");
/// The paper of 2007 that the chapter calls the first proof with friction; the record says what the chapter prints.
pub const DZONOU: Release = Release::Record("dzonou-2007");
/// Stewart and Trinkle's paper of 1996.
pub const STEWART_TRINKLE: Release = Release::Record("stewart-trinkle-1996");

/// The part of `repositories/1` that is asked.
#[derive(Deserialize)]
struct Repositories {
    trees: Vec<StoredTree>,
}

/// A repository at a commit.
#[derive(Deserialize)]
struct StoredTree {
    repository: String,
    revision: String,
    stated: Value,
}

/// The part of `literature/1` that is asked.
#[derive(Deserialize)]
struct Literature {
    records: Vec<StoredRecord>,
}

/// A record of literature.
#[derive(Deserialize)]
struct StoredRecord {
    id: String,
    stated: Value,
}

/// The part of `facts/1` that is asked.
#[derive(Deserialize)]
struct StoredPackage {
    version: String,
    stated: Value,
}

impl Release {
    /// What is stated of it.
    ///
    /// # Errors
    /// If nothing is stored of it, or of another version.
    pub fn stated(self) -> Result<Value> {
        match self {
            Release::Package(file, version) => {
                let package: StoredPackage = read(&RUNS, file)?;
                if package.version == version { Ok(package.stated) } else { Err(missing(file, version)) }
            }
            Release::Tree(repository, revision) => {
                let trees = read::<Repositories>(&RUNS, REPOSITORIES)?.trees;
                let found = trees.into_iter().find(|tree| tree.repository == repository && tree.revision == revision);
                found.map(|tree| tree.stated).ok_or_else(|| missing(repository, revision))
            }
            Release::Record(id) => {
                let records = read::<Literature>(&RUNS, LITERATURE)?.records;
                records.into_iter().find(|record| record.id == id).map(|record| record.stated).ok_or_else(|| missing(LITERATURE, id))
            }
        }
    }

    /// Its version; of a record, its name.
    pub fn version(self) -> &'static str {
        match self {
            Release::Package(_, version) | Release::Tree(_, version) | Release::Record(version) => version,
        }
    }

    /// The text that is stated under a key.
    ///
    /// # Errors
    /// As [`Release::stated`], and if there is no text.
    pub fn text(self, key: &str) -> Result<String> {
        self.stated()?[key].as_str().map(String::from).ok_or_else(|| missing(self.version(), key))
    }
}

/// The year that is stated of a record.
///
/// # Errors
/// As [`Release::stated`], and if there is no year.
pub fn year(record: Release) -> Result<usize> {
    let year = record.stated()?["year"].as_u64().ok_or_else(|| missing(record.version(), "year"))?;
    usize::try_from(year).map_err(|_| missing(record.version(), "year"))
}

fn missing(file: &str, what: &str) -> Error {
    Error::invalid("stored facts", format!("`{file}` has no {what}"), "see references/README.md")
}
