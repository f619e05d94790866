//! Every number in an argument is found by the check, or fed into it.
//!
//! A number of the text is accounted for if it is
//!
//! ```text
//!     found       measured or expected by a finding of the claim, to the digits given
//!     a datum     a literal of the code of the check, of a module that it names in its folder, or of an experiment that it names;
//!                 where all is looked up, of an experiment that the queries name
//!     printed     a number of the statement
//!     a place     a year, a section, a page, a version, an exercise
//! ```
//! or if its sentence names the test that shows it. 0, 1 and 2 are not asked for.

use super::strip::strip;
use moreau::claims::{Claim, JudgedClaim};
use regex::{Captures, Regex};
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

static NUMBER: LazyLock<Regex> = LazyLock::new(|| {
    Regex::new(r"(?P<number>\d+(?:[.]\d+)?)(?:/(?P<below>\d+))?(?:e(?P<power>-?\d+))?(?:·10(?P<above>[⁰¹²³⁴⁵⁶⁷⁸⁹⁻]+))?").expect("a pattern")
});
static LITERAL: LazyLock<Regex> = LazyLock::new(|| Regex::new(r"\b\d[\d_]*(?:\.[\d_]+)?(?:e-?\d+)?").expect("a pattern"));
static RATIO: LazyLock<Regex> = LazyLock::new(|| Regex::new(r"\b(\d+)(?:\.0)?\s*[,/]\s*(\d+)(?:\.0)?").expect("a pattern"));
static NAMED: LazyLock<Regex> = LazyLock::new(|| Regex::new(r"(super|experiments)::(\w+)").expect("a pattern"));
static PLACE: LazyLock<Regex> = LazyLock::new(|| {
    let before =
        "§|[Ee]xercises?|[Ss]ections?|[Cc]hapter|[Tt]heorem|[Ee]q\\.|[Ff]igure|[Tt]able|pages?|pp?\\.|[Ll]ines?|[Vv]ol\\.|No\\.|[Rr]ow|DOI";
    let releases = "MuJoCo|Drake|Siconos|Pinocchio|Chrono|Bullet|PyBullet";
    Regex::new(&format!("(?:{before}|{releases}) ?\\(?(?:\\d+–)?$")).expect("a pattern")
});

/// A number of a text: its value, and half a unit of its last digit.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Number {
    value: f64,
    half: f64,
}

impl Number {
    fn read(found: &Captures) -> Option<Number> {
        let digits = &found["number"];
        let decimals = digits.split_once('.').map_or(0, |(_, decimals)| decimals.len());
        let power: i32 = found.name("power").map_or(Some(0), |power| power.as_str().parse().ok())?;
        let above: i32 = found.name("above").map_or(Some(0), |above| lowered(above.as_str()).parse().ok())?;
        let below: f64 = found.name("below").map_or(Some(1.0), |below| below.as_str().parse().ok())?;
        let scale = 10f64.powi(power + above) / below;
        let half = if found.name("below").is_some() { 0.0 } else { 0.5 * 10f64.powi(-i32::try_from(decimals).ok()?) };
        Some(Number { value: digits.parse::<f64>().ok()? * scale, half: half * scale })
    }

    fn is(self, other: f64) -> bool {
        (self.value - other).abs() <= 4.0 * f64::EPSILON * self.value.abs()
    }

    fn rounds(self, other: f64) -> bool {
        (self.value - other.abs()).abs() <= self.half * (1.0 + 1e-9) || self.is(other.abs())
    }

    fn times(self, factor: f64) -> Number {
        Number { value: self.value * factor, half: self.half * factor }
    }
}

/// Superscripts as a number.
fn lowered(superscripts: &str) -> String {
    superscripts
        .chars()
        .map(|letter| {
            if letter == '⁻' {
                '-'
            } else {
                "0123456789".as_bytes()["⁰¹²³⁴⁵⁶⁷⁸⁹".chars().position(|c| c == letter).unwrap_or(0)] as char
            }
        })
        .collect()
}

/// The data of a piece of code: its literals, and the ratios of two of them.
fn data(code: &str) -> Vec<f64> {
    let literals = LITERAL.find_iter(code).filter_map(|literal| literal.as_str().replace('_', "").parse().ok());
    let ratio = |found: Captures| Some(found[1].parse::<f64>().ok()? / found[2].parse::<f64>().ok().filter(|below| *below > 0.0)?);
    literals.chain(RATIO.captures_iter(code).filter_map(ratio)).collect()
}

/// The folder of the claims, and each file in it with the texts taken out.
pub struct Sources {
    files: Vec<(PathBuf, String, String)>,
}

impl Sources {
    pub fn read() -> Self {
        let mut sources = Sources { files: Vec::new() };
        sources.enter(&Path::new(env!("CARGO_MANIFEST_DIR")).join("src/claims"));
        sources
    }

    fn enter(&mut self, folder: &Path) {
        for entry in std::fs::read_dir(folder).expect("a folder") {
            let path = entry.expect("readable").path();
            if path.is_dir() {
                self.enter(&path);
            } else {
                let text = std::fs::read_to_string(&path).expect("a text");
                let code = strip(&text);
                self.files.push((path, text, code));
            }
        }
    }

    /// Data of the file of a claim and of the modules that it names.
    fn data(&self, claim: &Claim) -> Vec<f64> {
        let wanted = format!("id: \"{}\"", claim.id);
        let (path, _, code) = self.files.iter().find(|(_, text, _)| text.contains(&wanted)).expect("the file of the claim");
        let folder = path.parent().expect("a folder");
        let mut all = data(code);
        let queries = self.files.iter().filter(|(path, ..)| claim.check.path.contains("::lookups::") && path.ends_with("lookups/query.rs"));
        let asked = queries.flat_map(|(_, _, code)| NAMED.captures_iter(code)).filter(|named| &named[1] == "experiments");
        for named in NAMED.captures_iter(code).chain(asked) {
            let at = if &named[1] == "super" { folder.to_path_buf() } else { folder.with_file_name("experiments") };
            let file = at.join(format!("{}.rs", &named[2]));
            all.extend(self.files.iter().filter(|(path, _, _)| *path == file).flat_map(|(_, _, code)| data(code)));
        }
        all
    }
}

/// The sentence around a place in a text.
fn sentence(text: &str, start: usize, end: usize) -> &str {
    let from = text[..start].rfind([';', ':']).max(text[..start].rfind(". ")).map_or(0, |at| at + 1);
    let to = text[end..].find([';', ':']).into_iter().chain(text[end..].find(". ")).min().map_or(text.len(), |at| end + at);
    &text[from..to]
}

/// Whether the number is part of a word, a year, a version or the number of a place.
fn is_name(text: &str, start: usize, end: usize, number: Number) -> bool {
    let (before, after) = (&text[..start], &text[end..]);
    let joined = before.ends_with(|letter: char| letter.is_alphanumeric() || "._^#".contains(letter));
    let version = after.starts_with('.') && after[1..].starts_with(|letter: char| letter.is_ascii_digit());
    let year = number.half == 0.5 && (1900.0..=2030.0).contains(&number.value);
    let tested = sentence(text, start, end).contains("tests/");
    joined || version || year || tested || PLACE.is_match(before)
}

/// Numbers of the argument that nothing accounts for, with the words around them.
pub fn unaccounted(outcome: &JudgedClaim, sources: &Sources) -> Vec<String> {
    let claim = outcome.claim;
    let mut data = sources.data(claim);
    data.extend(NUMBER.captures_iter(&claim.statement()).filter_map(|found| Number::read(&found)).map(|number| number.value));
    let found: Vec<f64> =
        outcome.findings.iter().flat_map(|finding| [finding.measured, finding.expectation.value, finding.expectation.tolerance]).collect();
    let accounted = |number: Number| {
        number.value <= 2.0 && number.value.fract() == 0.0
            || data.iter().any(|datum| number.is(*datum))
            || found.iter().any(|value| number.rounds(*value))
    };
    let argument = claim.argument();
    let mut missing = Vec::new();
    for captures in NUMBER.captures_iter(&argument) {
        let (Some(whole), Some(number)) = (captures.get(0), Number::read(&captures)) else { continue };
        let (start, end) = (whole.start(), whole.end());
        let percent = argument[end..].trim_start().starts_with('%') && accounted(number.times(0.01));
        if !is_name(&argument, start, end, number) && !accounted(number) && !percent {
            let from = argument[..start].char_indices().rev().nth(25).map_or(0, |(at, _)| at);
            missing.push(argument[from..end].to_string());
        }
    }
    missing
}

/// What the patterns take for a number, a datum and a name.
pub fn planted() -> Result<(), String> {
    let read = |text: &str| NUMBER.captures(text).and_then(|found| Number::read(&found)).map(|number| number.value);
    let texts = [("3/4", 0.75), ("4.9e-4", 4.9e-4), ("2.5·10⁻³", 2.5e-3), ("17 m", 17.0)];
    let wrong = texts.iter().find(|(text, value)| read(text).is_none_or(|found| (found - value).abs() > 1e-15));
    let rounded = Number::read(&NUMBER.captures("0.0163").expect("a number")).expect("a number");
    if let Some((text, _)) = wrong {
        return Err(format!("{text} is read as {:?}", read(text)));
    }
    if !rounded.rounds(0.01634) || rounded.rounds(0.01636) {
        return Err("the digits given are not the digits asked for".into());
    }
    if data("f(1_000, ratio(3, 8), 0.25)") != [1000.0, 3.0, 8.0, 0.25, 0.375] {
        return Err(format!("data: {:?}", data("f(1_000, ratio(3, 8), 0.25)")));
    }
    let text = "see §4, version 1.51.1 of 1998, and 37 m";
    let named = |word: &str| {
        is_name(
            text,
            text.find(word).expect("in the text"),
            text.find(word).expect("in the text") + word.len(),
            Number { value: word.parse().unwrap_or(0.0), half: 0.5 },
        )
    };
    if !named("4") || !named("1998") || named("37") {
        return Err("a name is taken for a result, or a result for a name".into());
    }
    Ok(())
}
