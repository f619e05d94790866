//! A solution of the problem itself near an answer: how far it is at most, or why none is proved.

use super::bound::above;
use super::text::counted;
use crate::certificate::forward::{ContactState, Forward, Radius};
use crate::certificate::impulse_set::ImpulseSet;
use crate::number::with_unit;
use schemars::JsonSchema;
use serde::Serialize;

/// Whether a solution near was proved.
#[derive(Serialize, JsonSchema)]
pub(super) struct Near {
    /// Whether there is one.
    proved: bool,
    /// Why not.
    #[serde(skip_serializing_if = "Option::is_none")]
    reason: Option<String>,
    /// Where the bound on u is largest, or where the proof failed.
    contact: Option<usize>,
    /// How far it is at most.
    #[serde(skip_serializing_if = "Option::is_none")]
    radius: Option<Bounds>,
    /// How many dimensions the impulses have that give its velocity.
    #[serde(skip_serializing_if = "Option::is_none")]
    impulse_set: Option<Dimension>,
}

/// Bounds of a dimension.
#[derive(Serialize, JsonSchema)]
#[schemars(rename = "DimensionOfImpulses")]
struct Dimension {
    /// So many or more.
    at_least: usize,
    /// So many or fewer.
    at_most: usize,
}

/// How far a solution is at most.
#[derive(Serialize, JsonSchema)]
struct Bounds {
    /// The largest ‖u* − u‖ of a contact \[m/s\].
    velocity: f64,
    /// The largest ‖r* − r‖ \[N·s\].
    impulse: f64,
    /// Of every contact.
    states: Vec<&'static str>,
    /// ‖u* − u‖ at most, of every contact \[m/s\].
    velocities: Vec<f64>,
    /// ‖r* − r‖ at most, of every contact \[N·s\].
    impulses: Vec<f64>,
    /// Rows that depend exactly on others.
    dependent_rows: Vec<usize>,
    /// |v* − v| at most, of every generalised velocity \[m/s, rad/s\], where mass and Jacobian are known.
    #[serde(skip_serializing_if = "Option::is_none")]
    bodies: Option<Vec<f64>>,
}

impl Bounds {
    fn new(radius: &Radius) -> Self {
        let word = |state: &ContactState| match state {
            ContactState::Open => "open",
            ContactState::Pressing => "pressing",
            ContactState::Sticking => "sticking",
            ContactState::Sliding => "sliding",
            ContactState::Undecided => "on a border",
            ContactState::Joined => "held",
        };
        Bounds {
            velocity: radius.worst().map_or(0.0, |(_, velocity)| velocity),
            impulse: radius.moved(),
            states: radius.states.iter().map(word).collect(),
            velocities: radius.velocity.clone(),
            impulses: radius.impulse.clone(),
            dependent_rows: radius.dependent.clone(),
            bodies: radius.bodies.clone(),
        }
    }
}

impl Near {
    /// What was proved, and how many dimensions its impulses have.
    pub(super) fn new(found: &Forward, impulses: Option<ImpulseSet>) -> Self {
        let impulse_set = impulses.map(|ImpulseSet { at_least, at_most }| Dimension { at_least, at_most });
        match found {
            Forward::Proved(radius) => {
                let contact = radius.worst().map(|(contact, _)| contact);
                Near { proved: true, reason: None, contact, radius: Some(Bounds::new(radius)), impulse_set }
            }
            Forward::NotProved(reason) => {
                Near { proved: false, reason: Some(reason.text.clone()), contact: reason.contact, radius: None, impulse_set: None }
            }
        }
    }

    /// Whether there is a solution near.
    pub(super) fn is_proved(&self) -> bool {
        self.radius.is_some()
    }

    /// For reading, line by line; a place is a contact or a row, with the units of a velocity and an impulse.
    pub(super) fn lines(&self, place: &str, [speed, push]: [&str; 2]) -> Vec<String> {
        let Some(bounds) = &self.radius else {
            let reason = self.reason.as_deref().unwrap_or_default();
            return vec![format!("not proved that the problem itself has a solution near: {reason}")];
        };
        let [velocity, impulse] = [(bounds.velocity, speed), (bounds.impulse, push)].map(|(number, unit)| with_unit(&above(number), unit));
        let at = self.contact.map_or(String::new(), |contact| format!(" ({place} {contact})"));
        let mut lines =
            vec![format!("proved by intervals: the problem has a solution whose velocity differs by at most {velocity} at a {place}{at},")];
        lines.push(format!("  and its impulse by at most {impulse}"));
        if let Some(bodies) = &bounds.bodies {
            let most = above(bodies.iter().copied().fold(0.0, f64::max));
            lines.push(format!("  and no velocity of a body by more than {most} (m/s, rad/s)"));
        }
        if !bounds.dependent_rows.is_empty() {
            lines.push(match bounds.dependent_rows.len() {
                1 => "  1 row depends exactly on others; its impulse is taken as it is".into(),
                many => {
                    format!("  {many} rows depend exactly on others; their impulses are taken as they are")
                }
            });
        }
        lines.extend(self.impulse_set.as_ref().map(|set| match (set.at_least, set.at_most) {
            (_, 0) => "  no other impulses give this velocity".into(),
            (one, other) if one == other => {
                format!("  the impulses that give this velocity are a set of exactly {}", counted(one, "dimension"))
            }
            (one, other) => format!("  the impulses that give this velocity are a set of {one} to {other} dimensions"),
        }));
        lines
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_row_depends_and_two_rows_depend_on_others() {
        let near = |dependent: usize, dimensions: usize| {
            let radius = Bounds {
                velocity: 0.0,
                impulse: 0.0,
                states: vec![],
                velocities: vec![],
                impulses: vec![],
                dependent_rows: vec![0; dependent],
                bodies: None,
            };
            let impulse_set = Some(Dimension { at_least: dimensions, at_most: dimensions });
            Near { proved: true, reason: None, contact: None, radius: Some(radius), impulse_set }
                .lines("contact", ["m/s", "N·s"])
                .join("\n")
        };
        assert!(near(1, 1).contains("1 row depends exactly") && near(1, 1).ends_with("exactly 1 dimension"), "{}", near(1, 1));
        assert!(near(2, 2).contains("2 rows depend exactly") && near(2, 2).ends_with("exactly 2 dimensions"), "{}", near(2, 2));
    }
}
