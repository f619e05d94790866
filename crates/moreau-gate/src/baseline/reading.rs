//! Reading a baseline: what is wrong with the file is told with its place and a cure, before anything is compared with it.

use super::{Baseline, BaselineCheck, BaselineValue, KnownIssue, SCHEMA, at};
use crate::audit::AUDITS;
use moreau_contact::files::{read_text, told};
use moreau_exact::{Error, Result};
use std::path::Path;

impl Baseline {
    /// Reads a baseline.
    ///
    /// # Errors
    /// [`Error::Read`], or [`Error::Invalid`] with file, line and field.
    pub fn read(file: &Path) -> Result<Self> {
        let text = read_text(file)?;
        let baseline: Baseline = toml::from_str(&text).map_err(|error| unreadable(&text, &error).in_file(file))?;
        baseline.require_sound().map_err(|error| error.in_file(file))?;
        Ok(baseline)
    }

    /// Refuses what could never be compared, or never be worse.
    fn require_sound(&self) -> Result<()> {
        if self.schema != SCHEMA {
            return Err(Error::invalid("schema", format!("is `{}`", self.schema), format!("this program reads `{SCHEMA}`")));
        }
        if let Err(error) = serde_json::from_str::<crate::Options>(&self.options) {
            let cure =
                "write the options as a JSON object in quotes, such as '{}', or make a new one with `moreau gate --save-baseline FILE`";
            return Err(Error::invalid("options", format!("is no JSON object: {error}"), cure));
        }
        self.known_issues.iter().try_for_each(|issue| self.require_issue(issue))?;
        let twice = (0..self.checks.len()).find(|k| self.checks[..*k].iter().any(|before| before.name == self.checks[*k].name));
        if let Some(k) = twice {
            let cure = "keep the right one, or make a new one with `moreau gate --save-baseline FILE`";
            return Err(Error::invalid("check", format!("`{}` stands there twice", self.checks[k].name), cure));
        }
        self.checks.iter().try_for_each(|check| self.require_values(check))
    }

    fn require_issue(&self, issue: &KnownIssue) -> Result<()> {
        if let Some(problem) = issue.contradiction() {
            let problem = format!("of `{}` {problem}: it can never hold", issue.check);
            return Err(Error::invalid("known_issue", problem, "bound the values from `least` up to `most`, at a positive `time_step`"));
        }
        let is_audit = issue.check.starts_with(AUDITS) && self.checks.iter().any(|check| check.name == issue.check);
        if crate::checks::find(&issue.check).is_none() && !is_audit {
            let problem = format!("names the check `{}`, which does not exist", issue.check);
            return Err(Error::invalid("known_issue", problem, "`moreau gate --list` shows every check"));
        }
        Ok(())
    }

    fn require_values(&self, check: &BaselineCheck) -> Result<()> {
        for (k, one) in check.values.iter().enumerate() {
            let is_same = |other: &BaselineValue| other.quantity == one.quantity && other.time_step == one.time_step;
            let wrong = self.wrong(check, one);
            let twice = || check.values[..k].iter().any(is_same).then(|| ("check.value", "stands there twice".to_string()));
            if let Some((field, problem)) = wrong.or_else(twice) {
                let problem = format!("of “{}”{} in the check `{}` {problem}", one.quantity, at(one.time_step), check.name);
                let cure = "put back what was measured, or make a new one with `moreau gate --save-baseline FILE`";
                return Err(Error::invalid(field, problem, cure));
            }
        }
        Ok(())
    }

    /// The field of a value with which nothing would ever be compared or be worse, and what is wrong with it. What is bad may be infinite.
    fn wrong(&self, check: &BaselineCheck, one: &BaselineValue) -> Option<(&'static str, String)> {
        if !one.value.is_finite() && !check.verdict.is_bad() {
            return Some(("value", format!("is {}, and its verdict is {}", one.value, check.verdict.word())));
        }
        if !(one.spread.is_finite() && one.spread >= 0.0) {
            return Some(("spread", format!("is {}, no finite number from 0", one.spread)));
        }
        // a stored trajectory has a time step of its own
        let is_swept = |h: f64| check.name.starts_with(AUDITS) || self.sweep.contains(&h);
        let stray = one.time_step.filter(|h| !is_swept(*h))?;
        Some(("time_step", format!("is {stray}, which is none of the time steps {:?} of the baseline", self.sweep)))
    }
}

/// What is wrong with a text that is no baseline.
fn unreadable(text: &str, error: &toml::de::Error) -> Error {
    if has_no_issues(text) && text.lines().any(|line| line.trim() == "[[known_issue]]") {
        let problem = "stands there twice: as the empty list `known_issue = []` and as entries `[[known_issue]]`";
        return Error::invalid("known_issue", problem, "delete the line `known_issue = []`");
    }
    let line = error.span().map_or(String::new(), |span| format!("line {}: ", 1 + text[..span.start].matches('\n').count()));
    let (said, cure) = match told(error.message()) {
        Some(told) => (told.problem, format!("{}, or ", told.cure)),
        None => (error.message().into(), String::new()),
    };
    let problem = format!("{line}{said}");
    let wrong = error.span().and_then(|span| text[..span.end].lines().last()).unwrap_or("").trim_start();
    let is_day = wrong.starts_with("expires") && !is_missing(error);
    // a line with its end, or a text that is TOML, is not cut there
    let is_whole = text.ends_with('\n') || text.parse::<toml::Table>().is_ok();
    if !is_day && is_whole && is_in_an_issue(text, error) {
        let cure = "an entry has `check` and `reason`, and where they are wanted `quantity`, `time_step`, `least`, `most` and `expires`";
        return Error::invalid("known_issue", problem, cure);
    }
    if let Some(told) = cut(text, error).filter(|_| !(is_day && is_whole)) {
        return told;
    }
    if is_day {
        return Error::invalid("known_issue.expires", problem, "write the day as \"2027-01-31\"");
    }
    let field = error.span().and_then(|span| key_before(text, span.start)).unwrap_or("baseline");
    Error::invalid(field, problem, format!("{cure}make a new one with `moreau gate --save-baseline FILE`"))
}

/// Whether what is wrong stands in an entry that is written by hand, or is missing there.
fn is_in_an_issue(text: &str, error: &toml::de::Error) -> bool {
    let Some(span) = error.span() else { return false };
    let end = text[span.start..].find('\n').map_or(text.len(), |end| span.start + end);
    text[..end].lines().rfind(|line| line.trim_start().starts_with('[')).is_some_and(|line| line.trim() == "[[known_issue]]")
}

/// Whether the text has the line `known_issue = []`, which a new baseline has.
fn has_no_issues(text: &str) -> bool {
    let mut pairs = text.lines().filter_map(|line| line.split_once('='));
    pairs.any(|(key, value)| key.trim() == "known_issue" && value.trim() == "[]")
}

/// The key of the line that a place in a text stands in.
fn key_before(text: &str, place: usize) -> Option<&str> {
    let start = text[..place].rfind('\n').map_or(0, |end| end + 1);
    let (key, _) = text[start..].lines().next()?.split_once('=')?;
    Some(key.trim()).filter(|key| !key.is_empty())
}

fn is_missing(error: &toml::de::Error) -> bool {
    error.message().starts_with("missing field")
}

/// The error of a file that ends within an entry, as a copy does that was broken off: what is wrong comes with the end of the text, or is
/// missing in the last table.
fn cut(text: &str, error: &toml::de::Error) -> Option<Error> {
    let span = error.span()?;
    let rest = text.get(span.end..)?;
    let is_missing = is_missing(error);
    if !(rest.trim().is_empty() || is_missing && !rest.contains("\n[")) {
        return None;
    }
    let missing = if is_missing { format!(": {}", error.message()) } else { String::new() };
    let problem = match text.lines().count() {
        0 => "the file is empty".into(),
        last => format!("line {last} is the last one, and ends within an entry{missing}"),
    };
    let cure = "take a whole copy of the file, or make a new one with `moreau gate --save-baseline FILE`";
    Some(Error::invalid(key_before(text, span.start).unwrap_or("baseline"), problem, cure))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Expectation, Measurement, StepOutcome, Verdict};

    /// A baseline of two checks at two time steps, as a text, and one of a file.
    fn text() -> String {
        let step = |h: f64| StepOutcome::new(Some(h), Ok(vec![Measurement::new("error", "m", 0.25, Expectation::equal(0.0, 1.0, ""))]));
        let check =
            |name: &str, steps: &[f64]| BaselineCheck::of(&crate::CheckOutcome::new(name, steps.iter().map(|h| step(*h)).collect()));
        let baseline = Baseline {
            schema: SCHEMA.into(),
            engine: "toy".into(),
            version: "1".into(),
            sweep: vec![0.5, 0.125],
            options: "{}".into(),
            known_issues: Vec::new(),
            checks: vec![check("rest/depth", &[0.5, 0.125]), check("trajectory/a", &[0.75])],
        };
        baseline.to_toml().expect("a text")
    }

    /// What is said of a file with this text.
    fn said(name: &str, text: &str) -> Result<Baseline> {
        let file = std::env::temp_dir().join(format!("moreau-baseline-{name}-{}.toml", std::process::id()));
        std::fs::write(&file, text).expect("a folder for temporary files");
        let read = Baseline::read(&file);
        std::fs::remove_file(&file).expect("it was written");
        read
    }

    #[test]
    fn a_value_that_would_hide_what_gets_worse_is_refused_with_its_entry() {
        let whole = text();
        assert!(said("sound", &whole).is_ok(), "{whole}");
        for (right, wrong, words) in [
            ("spread = 0.0", "spread = inf", "`spread`: of “error” at h = 0.5 s in the check `rest/depth` is inf"),
            ("spread = 0.0", "spread = -1.0", "is -1, no finite number from 0"),
            ("spread = 0.0", "spread = nan", "is NaN"),
            ("value = 0.25", "value = inf", "`value`: of “error” at h = 0.5 s in the check `rest/depth` is inf, and its verdict is pass"),
            ("time_step = 0.5", "time_step = 0.25", "`time_step`: of “error” at h = 0.25 s"),
            ("time_step = 0.5", "time_step = 0.125", "at h = 0.125 s in the check `rest/depth` stands there twice"),
        ] {
            assert!(whole.contains(right), "{right}: {whole}");
            let told = said("unsound", &whole.replacen(right, wrong, 1)).expect_err(wrong).to_string();
            assert!(told.contains("moreau-baseline-unsound") && told.contains(words) && told.contains("put back"), "{wrong}: {told}");
        }
        // a failing engine may have given an infinite number
        let failed = whole.replacen("verdict = \"pass\"", "verdict = \"fail\"", 1).replacen("value = 0.25", "value = inf", 1);
        assert_eq!(said("failed", &failed).expect("as it was measured").checks[0].verdict, Verdict::Fail);
    }

    #[test]
    fn options_that_are_no_object_are_refused() {
        for wrong in ["{", "[]", "7", ""] {
            let told =
                said("options", &text().replace("options = \"{}\"", &format!("options = \"{wrong}\""))).expect_err(wrong).to_string();
            assert!(told.contains("`options`: is no JSON object") && told.contains("--save-baseline"), "{wrong}: {told}");
        }
    }

    #[test]
    fn what_is_wrong_in_an_entry_written_by_hand_has_its_own_cure() {
        let of = |entry: &str| {
            let issue = format!("\n[[known_issue]]\ncheck = \"rest/depth\"\n{entry}\n");
            said("by-hand", &(text().replace("known_issue = []\n", "") + &issue))
        };
        assert!(of("reason = \"issue 7\"").is_ok());
        for (entry, words) in [
            ("", "missing field"),
            ("reason = \"issue 7\"\nmoost = 1.0", "moost"),
            ("reason = \"issue 7\"\ntime_step = \"1/60\"", "is the text"),
        ] {
            let told = of(entry).expect_err(entry).to_string();
            assert!(told.contains("`known_issue`") && told.contains(words) && told.contains("an entry has `check` and `reason`"), "{told}");
        }
    }

    #[test]
    fn a_check_that_stands_there_twice_is_refused() {
        let whole = text();
        let entry = &whole[whole.find("[[check]]").expect("a check")..whole.find("[[check]]\nname = \"trajectory/a\"").expect("another")];
        let told = said("twice-check", &format!("{whole}\n{entry}")).expect_err("twice").to_string();
        assert!(told.contains("`check`: `rest/depth` stands there twice") && told.contains("keep the right one"), "{told}");
    }

    #[test]
    fn an_issue_beside_the_empty_list_of_them_is_told_to_delete_that_line() {
        let issue = "\n[[known_issue]]\ncheck = \"rest/depth\"\nreason = \"issue 7\"\n";
        let told = said("twice", &(text() + issue)).expect_err("twice").to_string();
        assert!(told.contains("delete the line `known_issue = []`") && !told.contains("--save-baseline"), "{told}");
        assert!(said("once", &(text().replace("known_issue = []\n", "") + issue)).is_ok());
    }

    #[test]
    fn a_day_that_is_none_in_the_last_line_is_no_cut_and_a_cut_day_is_one() {
        let issue = "\n[[known_issue]]\ncheck = \"rest/depth\"\nreason = \"issue 7\"\nexpires = ";
        let of = |day: &str| said("day", &(text().replace("known_issue = []\n", "") + issue + day));
        assert!(of("\"2027-01-31\"\n").is_ok());
        for day in ["\"2027-02-31\"\n", "\"2027-02-31\"", "\"soon\"\n", "2027-01-31\n", "2027-02-31\n", "31.1.2027\n", "20270131\n"] {
            let told = of(day).expect_err(day).to_string();
            assert!(
                told.contains("known_issue.expires") && told.contains("2027-01-31") && !told.contains("is the last one"),
                "{day}: {told}"
            );
        }
        for day in ["\"2027-01", "", "2027-"] {
            let told = of(day).expect_err(day).to_string();
            assert!(told.contains("is the last one"), "{day}: {told}");
        }
    }

    #[test]
    fn an_issue_may_be_of_a_stored_trajectory_that_the_baseline_has() {
        let of = |check: &str| {
            let issue = format!("\n[[known_issue]]\ncheck = \"{check}\"\nreason = \"issue 7\"\n");
            said("audit", &(text().replace("known_issue = []\n", "") + &issue))
        };
        assert!(of("trajectory/a").is_ok());
        for unknown in ["trajectory/b", "rest/forgotten"] {
            assert!(of(unknown).expect_err(unknown).to_string().contains("does not exist"), "{unknown}");
        }
    }
}
