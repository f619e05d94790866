//! A failure that is known: what it covers, and until when.

use crate::Measurement;
use jiff::civil::Date;
use moreau_exact::number::significant;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A failure that is known and accepted, with its reason.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct KnownIssue {
    /// The check, by name.
    pub check: String,
    /// Only failures of this quantity; of every one without it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub quantity: Option<String>,
    /// Only failures at this h \[s\], with the digits that reports print; at every one without it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub time_step: Option<f64>,
    /// Only values from here on.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub least: Option<f64>,
    /// Only values up to here.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub most: Option<f64>,
    /// Why it is accepted.
    pub reason: String,
    /// The first day on which it is no longer accepted, `2027-01-31`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Option<String>")]
    pub expires: Option<Date>,
}

impl KnownIssue {
    /// Whether a failing value is the one that is known.
    pub(super) fn covers(&self, check: &str, step: Option<f64>, one: &Measurement) -> bool {
        self.check == check
            && self.quantity.as_ref().is_none_or(|quantity| *quantity == one.quantity)
            && self.time_step.is_none_or(|h| step.is_some_and(|step| significant(h) == significant(step)))
            && self.least.is_none_or(|least| one.value >= least)
            && self.most.is_none_or(|most| one.value <= most)
    }

    /// Why it can never hold.
    pub(super) fn contradiction(&self) -> Option<String> {
        let Self { least, most, time_step, .. } = self;
        if let (Some(least), Some(most)) = (least, most)
            && least > most
        {
            return Some(format!("has least = {least} above most = {most}"));
        }
        if [least, most].into_iter().flatten().any(|bound| bound.is_nan()) {
            return Some("has a bound that is no number".into());
        }
        time_step.filter(|h| !(h.is_finite() && *h > 0.0)).map(|h| format!("has the time_step {h}"))
    }

    /// Whether it is accepted no longer.
    pub(super) fn has_expired(&self, today: Date) -> bool {
        self.expires.is_some_and(|day| day <= today)
    }

    /// Which one it is.
    pub(super) fn named(&self) -> String {
        let quantity = self.quantity.as_ref().map(|name| format!("“{name}”"));
        let step = self.time_step.map(|h| format!("h = {} s", significant(h)));
        let of: Vec<String> = [quantity, step].into_iter().flatten().collect();
        let of = if of.is_empty() { String::new() } else { format!(", {}", of.join(" at ")) };
        format!("the known issue “{}” of {}{of}", self.reason, self.check)
    }

    /// Whether it speaks of the check as a whole, and so of failures without a value.
    pub(super) fn is_general(&self) -> bool {
        self.quantity.is_none() && self.time_step.is_none() && self.least.is_none() && self.most.is_none()
    }
}
