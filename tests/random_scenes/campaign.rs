//! The campaign in shards that can be stopped and taken up again.
//!
//! | variable | meaning | default |
//! |---|---|---|
//! | `MOREAU_CAMPAIGN=1` | run it | not run |
//! | `MOREAU_SHARD` | `i/n`: the scenes whose number is i modulo n | `0/1` |
//! | `MOREAU_SEED` | the first seed | 0 |
//! | `MOREAU_SCENES` | how many scenes in all shards together | 20 000 |
//! | `MOREAU_COMMIT` | what is tested, written into every line; lines of another commit are not taken for done | `unknown` |
//! | `MOREAU_SHARD_FOLDER` | where the files lie | `target/random-scenes` |
//!
//! A shard writes one JSON line per scene to `shard-i-of-n.jsonl`: seed, commit and what each scheme did. A line that was cut off is
//! dropped.

use crate::motion::Outcome;
use crate::motion::runs;
use crate::report::Report;
use crate::scenario::{Length, Scenario};
use moreau::schemes::NAMES;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;
use std::fs::{File, OpenOptions, create_dir_all, read_to_string, write};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::Mutex;

/// Scenes of the whole campaign.
const SCENES: u64 = 20_000;

/// One scene of a shard, as a line of its file.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Line {
    seed: u64,
    commit: String,
    outcomes: Vec<(String, Outcome)>,
    /// Everything needed to run the failed ones again.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    failed: Vec<serde_json::Value>,
}

/// Which scenes a shard runs, and where it writes.
pub struct Shard {
    index: u64,
    of: u64,
    first: u64,
    scenes: u64,
    commit: String,
    folder: PathBuf,
}

fn variable<T: std::str::FromStr>(name: &str, default: T) -> T {
    let Ok(text) = std::env::var(name) else { return default };
    text.parse().unwrap_or_else(|_| panic!("{name} is `{text}`, which is not a value for it"))
}

impl Shard {
    /// The shard that the environment asks for.
    pub fn of_environment() -> Self {
        let shard: String = variable("MOREAU_SHARD", "0/1".into());
        let parts: Vec<u64> = shard.split('/').filter_map(|part| part.parse().ok()).collect();
        let [index, of] = parts[..] else { panic!("MOREAU_SHARD is `{shard}`; use i/n") };
        assert!(index < of, "MOREAU_SHARD is `{shard}`; i counts from 0");
        let target = Path::new(env!("CARGO_MANIFEST_DIR")).join("target/random-scenes");
        Shard {
            index,
            of,
            first: variable("MOREAU_SEED", 0),
            scenes: variable("MOREAU_SCENES", SCENES),
            commit: variable("MOREAU_COMMIT", "unknown".into()),
            folder: variable("MOREAU_SHARD_FOLDER", target),
        }
    }

    fn file(&self) -> PathBuf {
        self.folder.join(format!("shard-{}-of-{}.jsonl", self.index, self.of))
    }

    /// The whole lines of this commit that a run before has left; the file holds nothing else afterwards.
    fn known(&self) -> Vec<Line> {
        let text = read_to_string(self.file()).unwrap_or_default();
        let lines = text.lines().filter_map(|line| serde_json::from_str::<Line>(line).ok());
        let known: Vec<Line> = lines.filter(|line| line.commit == self.commit).collect();
        let kept = known.iter().map(|line| serde_json::to_string(line).expect("it was read") + "\n");
        write(self.file(), kept.collect::<String>()).expect("the shard's file can be written");
        known
    }

    fn line(&self, seed: u64) -> Line {
        let scenario = Scenario::new(seed, Length::Full);
        let outcomes = runs(&scenario);
        let failed = outcomes.iter().filter(|(_, outcome)| outcome.failure.is_some()).map(|(name, _)| scenario.json(name));
        Line {
            seed,
            commit: self.commit.clone(),
            failed: failed.collect(),
            outcomes: outcomes.iter().map(|(name, outcome)| (name.to_string(), outcome.clone())).collect(),
        }
    }

    /// Runs what is left of the shard and gives the report of all of it.
    pub fn run(&self) -> Report {
        create_dir_all(&self.folder).expect("the shard's folder can be made");
        let known = self.known();
        let done: BTreeSet<u64> = known.iter().map(|line| line.seed).collect();
        let left: Vec<u64> =
            (self.first..self.first + self.scenes).filter(|seed| seed % self.of == self.index && !done.contains(seed)).collect();
        let file = Mutex::new(OpenOptions::new().append(true).open(self.file()).expect("the shard's file was written"));
        let made = left.into_par_iter().map(|seed| {
            let line = self.line(seed);
            append(&file, &line);
            line
        });
        let mut report = Report::default();
        for line in known.into_iter().chain(made.collect::<Vec<_>>()) {
            for (name, outcome) in &line.outcomes {
                let name = NAMES.iter().find(|known| *known == name).expect("a listed scheme");
                report.add(name, line.seed, outcome);
            }
        }
        report
    }
}

/// One line at a time, whole.
fn append(file: &Mutex<File>, line: &Line) {
    let text = serde_json::to_string(line).expect("numbers and texts") + "\n";
    file.lock().expect("no writer panics").write_all(text.as_bytes()).expect("the shard's file can be written");
}

#[test]
fn a_shard_goes_on_where_it_stopped_and_forgets_other_commits() {
    let folder = std::env::temp_dir().join(format!("moreau-random-scenes-{}", std::process::id()));
    let shard = |commit: &str, scenes: u64| Shard { index: 1, of: 3, first: 0, scenes, commit: commit.into(), folder: folder.clone() };
    let lines = || read_to_string(shard("a", 0).file()).expect("written").lines().map(String::from).collect::<Vec<_>>();
    let line = |seed: u64| Line { seed, commit: "a".into(), outcomes: Vec::new(), failed: Vec::new() };
    create_dir_all(&folder).expect("a temporary folder");
    let text = [1, 4, 7].map(|seed| serde_json::to_string(&line(seed)).expect("numbers and texts")).join("\n");
    write(shard("a", 0).file(), format!("{text}\n{{\"seed\": 10, \"com")).expect("a temporary file");
    // seeds 1, 4 and 7 are known, the cut one is not: nothing is left of the first ten
    shard("a", 10).run();
    assert_eq!(lines(), text.lines().collect::<Vec<_>>());
    assert!(shard("b", 0).run().is_empty() && lines().is_empty());
    std::fs::remove_dir_all(folder).expect("a temporary folder");
}
