//! What can be asked of stored facts.

use super::release::Release;
use crate::claims::experiments::identifiers::{issn_agrees, sici_agrees, volume_and_page};
use crate::scalar::{Rational, ratio};
use crate::{Error, Result};
use serde_json::Value;
use std::collections::BTreeSet;

/// Where something stands in what is stated: keys from the outside in, of a list the number of an entry.
pub type Keys = &'static [&'static str];

/// What is stated at a place.
#[derive(Clone, Copy, Debug)]
pub enum Holds {
    /// This text.
    Text(Keys, &'static str),
    /// That it is so.
    True(Keys),
    /// These numbers.
    Numbers(Keys, &'static [f64]),
    /// The same as at another place.
    Same(Keys, Keys),
}

/// A part of the identifier SICI.
#[derive(Clone, Copy, Debug)]
pub enum Sici {
    /// Whether its check character agrees with the others.
    Agrees,
    /// Whether the check digit of the ISSN in it does.
    Issn,
    /// Its volume.
    Volume,
    /// Its first page.
    Page,
}

/// A question to what is stated.
#[derive(Clone, Copy, Debug)]
pub enum Query {
    /// Whether the version starts so.
    Version(&'static str),
    /// Which of these paths from the root there are.
    Files(&'static [&'static str]),
    /// Whether there is a file at this path from a folder, which ends in `/` or is the root.
    Below(&'static str, &'static str),
    /// Which of these names of files there are, in whatever folder.
    Named(&'static [&'static str]),
    /// Of which of these ends there is a path.
    PathsEnding(&'static [&'static str]),
    /// How many files below these folders end so.
    CountEnding(&'static [&'static str], &'static str),
    /// Whether a file whose path ends so has this line.
    Line(&'static str, &'static str),
    /// The decimal that follows these words in a line of a file whose path ends so.
    Decimal(&'static str, &'static str),
    /// Which of these names are in the list, or among the keys, at a place.
    Lists(Keys, &'static [&'static str]),
    /// Whether a text of the list at a place has these words.
    Words(Keys, &'static str),
    /// How often these words occur in the texts of the list at a place.
    Mentions(Keys, &'static str),
    /// How many texts of the list at a place have all these numbers.
    Numbered(Keys, &'static [&'static str]),
    /// Which of these hold.
    Holds(&'static [Holds]),
    /// The count at a place.
    Count(Keys),
    /// The number at a place, times a factor.
    Times(Keys, f64),
    /// Whether the number at a place is between these.
    Within(Keys, [f64; 2]),
    /// How many different names stand at a place on a day from which one of them is gone if it comes after the day at another place.
    LeftOn {
        /// Where the names stand.
        among: Keys,
        /// The name that goes.
        leaves: &'static str,
        /// Where the day stands from which it is gone.
        from: Keys,
        /// The day that is asked about.
        day: &'static str,
    },
    /// A part of the SICI, with one text in it mistyped for another.
    Sici(Sici, &'static [[&'static str; 2]]),
}

/// The answer.
#[derive(Clone, Debug, PartialEq)]
pub enum LookedUp {
    /// How many there are of those that were asked for.
    Share {
        /// Those that there are.
        found: usize,
        /// All.
        of: usize,
    },
    /// How many there are.
    Count(usize),
    /// A number.
    Number(f64),
    /// An exact one.
    Fraction(Rational),
}

impl Query {
    /// What is stated of the release.
    ///
    /// # Errors
    /// If nothing is stored of it, or no number where one is asked for.
    pub fn ask(self, of: Release) -> Result<LookedUp> {
        let stated = of.stated()?;
        let files = texts(&stated, &["files"]);
        let has = |fits: &dyn Fn(&str) -> bool| files.iter().any(|file| fits(file));
        Ok(match self {
            Query::Version(start) => whether(of.version().starts_with(start)),
            Query::Files(paths) => share(paths, |path| has(&|file| file == *path)),
            Query::Below(folder, path) => whether(has(&|file| file.strip_prefix(folder) == Some(path))),
            Query::Named(names) => share(names, |name| has(&|file| file.rsplit('/').next() == Some(*name))),
            Query::PathsEnding(ends) => share(ends, |end| has(&|file| file.ends_with(end))),
            Query::CountEnding(folders, end) => {
                let below = |file: &&&str| folders.iter().any(|folder| file.starts_with(folder)) && file.ends_with(end);
                LookedUp::Count(files.iter().filter(below).count())
            }
            Query::Line(file, text) => whether(lines(&stated, file).contains(&text)),
            Query::Decimal(file, before) => LookedUp::Fraction(decimal(&stated, file, before)?),
            Query::Lists(keys, names) => {
                let place = at(&stated, keys);
                let keyed = |name: &str| place.is_some_and(|place| place.get(name).is_some());
                share(names, |name| keyed(name) || texts(&stated, keys).contains(name))
            }
            Query::Words(keys, words) => whether(texts(&stated, keys).iter().any(|text| text.contains(words))),
            Query::Mentions(keys, words) => LookedUp::Count(texts(&stated, keys).iter().map(|text| text.matches(words).count()).sum()),
            Query::Numbered(keys, numbers) => {
                let all = texts(&stated, keys);
                let of_text = |text: &&str| numbers.iter().all(|number| digits(text).any(|other| other == *number));
                LookedUp::Count(all.iter().filter(|text| of_text(text)).count())
            }
            Query::Holds(facts) => share(facts, |fact| fact.so(&stated)),
            Query::Count(keys) => LookedUp::Count(number(&stated, keys)? as usize),
            Query::Times(keys, factor) => LookedUp::Number(number(&stated, keys)? * factor),
            Query::Within(keys, [low, high]) => whether((low..=high).contains(&number(&stated, keys)?)),
            Query::LeftOn { among, leaves, from, day } => {
                let gone = at(&stated, from).and_then(Value::as_str).is_some_and(|from| day >= from);
                let names: BTreeSet<&str> = texts(&stated, among).into_iter().collect();
                LookedUp::Count(names.into_iter().filter(|name| !(gone && *name == leaves)).count())
            }
            Query::Sici(part, mistyped) => {
                let typed = of.text("sici")?;
                part.of(&mistyped.iter().fold(typed, |text, [right, wrong]| text.replace(right, wrong)))
            }
        })
    }

    /// The exact number that is stated of the release.
    ///
    /// # Errors
    /// As [`Query::ask`], and if the answer is none.
    pub fn fraction(self, of: Release) -> Result<Rational> {
        match self.ask(of)? {
            LookedUp::Fraction(number) => Ok(number),
            other => Err(Error::Unsupported(format!("{other:?} is no fraction"))),
        }
    }
}

impl Holds {
    /// Whether it is so.
    fn so(&self, stated: &Value) -> bool {
        match *self {
            Holds::Text(keys, text) => at(stated, keys).and_then(Value::as_str) == Some(text),
            Holds::True(keys) => at(stated, keys) == Some(&Value::Bool(true)),
            Holds::Numbers(keys, numbers) => {
                let found = at(stated, keys).and_then(Value::as_array);
                found.is_some_and(|list| list.iter().map(Value::as_f64).eq(numbers.iter().copied().map(Some)))
            }
            Holds::Same(one, other) => at(stated, one).is_some_and(|found| at(stated, other) == Some(found)),
        }
    }
}

impl Sici {
    fn of(self, sici: &str) -> LookedUp {
        let (volume, page) = volume_and_page(sici).unwrap_or_default();
        match self {
            Sici::Agrees => whether(sici_agrees(sici)),
            Sici::Issn => whether(sici.get(..9).is_some_and(issn_agrees)),
            Sici::Volume => LookedUp::Count(volume as usize),
            Sici::Page => LookedUp::Count(page as usize),
        }
    }
}

fn whether(so: bool) -> LookedUp {
    LookedUp::Share { found: usize::from(so), of: 1 }
}

fn share<T>(asked: &[T], so: impl Fn(&T) -> bool) -> LookedUp {
    LookedUp::Share { found: asked.iter().filter(|one| so(one)).count(), of: asked.len() }
}

/// What stands at a place.
fn at<'a>(stated: &'a Value, keys: &[&str]) -> Option<&'a Value> {
    keys.iter().try_fold(stated, |value, key| key.parse().map_or_else(|_| value.get(*key), |number: usize| value.get(number)))
}

/// The number at a place.
///
/// # Errors
/// If there is none.
pub fn number(stated: &Value, keys: &[&str]) -> Result<f64> {
    let missing = || Error::invalid(keys.join("/"), "is no number of the stored facts", "see references/README.md");
    at(stated, keys).and_then(Value::as_f64).ok_or_else(missing)
}

/// The texts of a list, or of the entries of an object; none where there is neither.
fn texts<'a>(stated: &'a Value, keys: &[&str]) -> Vec<&'a str> {
    match at(stated, keys) {
        Some(Value::Array(list)) => list.iter().filter_map(Value::as_str).collect(),
        Some(Value::Object(entries)) => entries.values().filter_map(Value::as_str).collect(),
        _ => Vec::new(),
    }
}

/// The numbers of a text, as they are written.
fn digits(text: &str) -> impl Iterator<Item = &str> {
    text.split(|letter: char| !letter.is_ascii_digit())
}

/// The lines of source of the files whose paths end so.
fn lines<'a>(stated: &'a Value, end: &str) -> Vec<&'a str> {
    let all = stated["lines"].as_array().into_iter().flatten();
    let of_file = all.filter(|line| line["file"].as_str().is_some_and(|file| file.ends_with(end)));
    of_file.filter_map(|line| line["text"].as_str()).collect()
}

/// The decimal below one that follows the words.
fn decimal(stated: &Value, end: &str, before: &str) -> Result<Rational> {
    let found = lines(stated, end).into_iter().find_map(|line| line.strip_prefix(before));
    let places = found.map(|rest| rest.trim_end_matches([';', ')'])).and_then(|number| number.strip_prefix("0."));
    let parsed = places.and_then(|places| Some(ratio(places.parse().ok()?, 10i64.checked_pow(places.len() as u32)?)));
    parsed.ok_or_else(|| Error::invalid(end.to_string(), "has no decimal after these words", "see references/README.md"))
}

#[cfg(test)]
mod tests {
    use super::super::release::{BULLET, MUJOCO, MUJOCO_2026};
    use super::*;

    #[test]
    fn a_path_is_asked_from_its_folder_on_and_not_in_part() {
        let ask = |query: Query| query.ask(MUJOCO_2026).expect("stored");
        assert_eq!(ask(Query::Files(&["src/engine/engine_solver.c", "engine_solver.c"])), LookedUp::Share { found: 1, of: 2 });
        assert_eq!(ask(Query::Below("mjx/mujoco/", "mjx/_src/solver.py")), whether(true));
        assert_eq!(ask(Query::Below("", "mjx/_src/solver.py")), whether(false));
        assert_eq!(ask(Query::Named(&["engine_solver.c", "olver.c"])), LookedUp::Share { found: 1, of: 2 });
        assert_eq!(ask(Query::PathsEnding(&["olver.c", ".py", ".cu"])), LookedUp::Share { found: 2, of: 3 });
        assert_eq!(ask(Query::CountEnding(&["mjx/", "src/"], ".c")), LookedUp::Count(2));
    }

    #[test]
    fn what_stands_at_no_place_does_not_hold_and_is_no_number() {
        let ask = |query: Query| query.ask(MUJOCO);
        assert_eq!(
            ask(Query::Holds(&[Holds::True(&["nowhere"]), Holds::Same(&["x"], &["y"])])).ok(),
            Some(LookedUp::Share { found: 0, of: 2 })
        );
        assert_eq!(ask(Query::Lists(&[], &["solvers", "nowhere"])).ok(), Some(LookedUp::Share { found: 1, of: 2 }));
        assert_eq!(ask(Query::Times(&["defaults", "solref", "0"], 2.0)).ok(), Some(LookedUp::Number(0.04)));
        assert!(ask(Query::Count(&["nowhere"])).is_err());
        assert!(Query::Decimal("btContactSolverInfo.h", "m_numIterations = ").ask(BULLET).is_err());
        assert!(Release::Package("facts/mujoco.json", "4.0.0").stated().is_err());
    }
}
