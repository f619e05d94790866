//! Several motions of one scene beside each other: a table of what they show, and their curves in common panels.

use super::motion::{MotionReport, Quantity};
use super::plot::{Panel, Role};
use super::quantity::shown;
use super::steps::StepSummary;
use crate::checks::text::Style;
use crate::number::significant;
use schemars::JsonSchema;
use serde::Serialize;

/// The quantities of a comparison, by their names in a motion's summary, with a short heading each.
const SHOWN: [(&str, &str); 7] = [
    ("deepest penetration", "penetration"),
    ("energy change", "energy change"),
    ("largest energy gain in a step", "gain in a step"),
    ("effective restitution of the first impact", "restitution"),
    ("creep speed at rest", "creep"),
    (SETTLING, "settling time"),
    ("largest position error", "position error"),
];

/// The quantity without which a motion has not come to rest, and what the table says then.
const SETTLING: &str = "settling time";
const NEVER: &str = "does not settle";

/// What `moreau compare --format json` writes.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Comparison {
    /// The scene.
    pub scene: String,
    /// h \[s\].
    pub time_step: f64,
    /// Simulated time \[s\].
    pub duration: f64,
    /// The solver of the contact problems.
    pub solver: String,
    /// The closed form that position errors are measured from.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub closed_form: Option<String>,
    /// Whether the scene's e is in it.
    #[serde(skip)]
    pub form_has_restitution: bool,
    /// The schemes, as asked for.
    pub schemes: Vec<SchemeOutcome>,
}

/// What one scheme made of the scene.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct SchemeOutcome {
    /// Its name on the command line.
    pub name: String,
    /// What its motion shows; empty if it did not run.
    pub quantities: Vec<ComparedQuantity>,
    /// What the certificate says of its steps; absent if it did not run.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub steps: Option<StepSummary>,
    /// What the scheme makes of the scene's restitution, where it has none; absent elsewhere.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub note: Option<&'static str>,
    /// Why it did not run to the end.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub unsupported: Option<String>,
}

/// One number of a motion.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct ComparedQuantity {
    /// What it is.
    pub name: String,
    /// Its value; absent where it is not defined for this motion. Without a settling time the motion goes on to the end, if only by creep.
    pub value: Option<f64>,
    /// Its unit.
    pub unit: String,
    /// What rounding alone can make of it: a value that is not larger says no more than 0; absent where that is not known.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rounding: Option<f64>,
}

impl SchemeOutcome {
    /// A scheme that ran.
    pub fn ran(name: &str, summary: &[Quantity], steps: StepSummary, note: Option<&'static str>) -> Self {
        let find = |(wanted, _): &(&str, &str)| summary.iter().find(|quantity| quantity.name == *wanted);
        let compared = |quantity: &Quantity| ComparedQuantity {
            name: quantity.name.into(),
            value: quantity.value,
            unit: quantity.unit.into(),
            rounding: quantity.rounding,
        };
        SchemeOutcome {
            name: name.into(),
            quantities: SHOWN.iter().filter_map(find).map(compared).collect(),
            steps: Some(steps),
            note,
            unsupported: None,
        }
    }

    /// A scheme that did not.
    pub fn refused(name: &str, reason: String) -> Self {
        SchemeOutcome { name: name.into(), quantities: Vec::new(), steps: None, note: None, unsupported: Some(reason) }
    }
}

impl Comparison {
    /// A table with a row per scheme that ran, in parts below each other where it is wider than a line; below it those that did not run,
    /// each with its reason.
    pub fn text(&self, style: Style) -> String {
        let form = self.closed_form.as_deref().unwrap_or("none for this scene");
        let [h, duration] = [self.time_step, self.duration].map(significant);
        let line = |text: String| style.wrapped("", "  ", &text) + "\n";
        let head = format!("scene {}, h = {h} s, {duration} s, solver {}", self.scene, self.solver);
        let mut text = line(head) + &line(format!("closed form: {form}")) + "\n";
        let ran: Vec<_> = self.schemes.iter().filter(|scheme| scheme.unsupported.is_none()).collect();
        let has = |k: usize| ran.iter().any(|scheme| SHOWN[k].0 == SETTLING || scheme.quantities[k].value.is_some());
        let columns: Vec<usize> = (0..SHOWN.len()).filter(|&k| has(k)).collect();
        let mut rows = vec![heading(&columns)];
        for scheme in &ran {
            let cell = |&k: &usize| {
                let ComparedQuantity { value, unit, rounding, .. } = &scheme.quantities[k];
                let missing = if SHOWN[k].0 == SETTLING { NEVER } else { "–" };
                value.map_or(missing.into(), |value| shown(value, unit, *rounding))
            };
            rows.push([scheme.name.clone()].into_iter().chain(columns.iter().map(cell)).collect());
        }
        if !ran.is_empty() {
            text += &in_parts(&rows, style.width).iter().map(|part| aligned(part)).collect::<Vec<_>>().join("\n");
        }
        for scheme in &ran {
            let steps = scheme.steps.as_ref().filter(|steps| steps.rejected + steps.unconverged > 0);
            text += &steps.map(|steps| line(format!("{}: {}", scheme.name, steps.text().trim_end()))).unwrap_or_default();
        }
        text += &self.notes(&ran).into_iter().map(line).collect::<String>();
        for scheme in &self.schemes {
            if let Some(reason) = &scheme.unsupported {
                text += &line(format!("{}: unsupported: {reason}", scheme.name));
            }
        }
        text
    }
}

impl Comparison {
    /// What schemes without restitution make of the scene, one sentence for all that make the same of it; and, where the closed form has e,
    /// why `simulate` says another position error.
    fn notes(&self, ran: &[&SchemeOutcome]) -> Vec<String> {
        let mut groups: Vec<(&str, Vec<&str>)> = Vec::new();
        for scheme in ran {
            let Some(note) = scheme.note else { continue };
            match groups.iter_mut().find(|(known, _)| *known == note) {
                Some((_, names)) => names.push(&scheme.name),
                None => groups.push((note, vec![&scheme.name])),
            }
        }
        let mut notes: Vec<String> = groups.iter().map(|(note, names)| format!("{}: {note}", names.join(", "))).collect();
        if !notes.is_empty() && self.form_has_restitution {
            notes.push(FROM_THE_SCENE.into());
        }
        notes
    }
}

/// What position errors of schemes without restitution are.
const FROM_THE_SCENE: &str = "position errors, theirs too, are measured from the closed form with the scene's e; `moreau simulate` \
                              measures them from that with e = 0";

fn heading(shown: &[usize]) -> Vec<String> {
    ["scheme".to_string()].into_iter().chain(shown.iter().map(|&k| SHOWN[k].1.to_string())).collect()
}

/// The rows in parts of columns that fit into a line, each with the first column; a part has at least one more.
fn in_parts(rows: &[Vec<String>], line: usize) -> Vec<Vec<Vec<String>>> {
    let width = |k: usize| rows.iter().map(|row| row[k].chars().count()).max().unwrap_or(0);
    let mut parts: Vec<Vec<usize>> = Vec::new();
    let mut used = line;
    for k in 1..rows[0].len() {
        if used + 2 + width(k) > line {
            parts.push(Vec::new());
            used = width(0);
        }
        used += 2 + width(k);
        parts.last_mut().expect("a part was begun").push(k);
    }
    let part = |columns: &Vec<usize>, row: &Vec<String>| [0].iter().chain(columns).map(|&k| row[k].clone()).collect();
    parts.iter().map(|columns| rows.iter().map(|row| part(columns, row)).collect()).collect()
}

/// Columns as wide as their widest cell, the first flush left.
fn aligned(rows: &[Vec<String>]) -> String {
    let width = |k: usize| rows.iter().map(|row| row[k].chars().count()).max().unwrap_or(0);
    let mut text = String::new();
    for row in rows {
        for (k, cell) in row.iter().enumerate() {
            let width = width(k);
            text += &if k == 0 { format!("{cell:width$}") } else { format!("  {cell:>width$}") };
        }
        text.push('\n');
    }
    text
}

/// The panels of all motions laid over each other; a closed form is drawn once.
pub fn overlaid(motions: &[(&str, MotionReport)]) -> Vec<Panel> {
    let mut overlaid: Vec<Panel> = Vec::new();
    for (scheme, motion) in motions {
        for (k, mut panel) in motion.panels().into_iter().enumerate() {
            let several = panel.curves.iter().filter(|curve| curve.role == Role::Computed).count() > 1;
            for curve in panel.curves.iter_mut().filter(|curve| curve.role == Role::Computed) {
                curve.label = if several { format!("{scheme}: {}", curve.label) } else { (*scheme).to_string() };
            }
            match overlaid.get_mut(k) {
                None => overlaid.push(panel),
                Some(common) => common.curves.extend(panel.curves.into_iter().filter(|curve| curve.role == Role::Computed)),
            }
        }
    }
    overlaid
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenes::named;
    use crate::schemes::{Anitescu, MoreauJean, Scheme, simulate};
    use crate::solvers::Auto;

    #[test]
    fn curves_of_all_schemes_share_their_panels_and_the_closed_form_is_drawn_once() {
        let scene = named("bouncing-ball").expect("built in");
        let (mechanism, start) = scene.mechanism().expect("planar");
        let exact = scene.exact_motion(&start);
        let schemes: [&dyn Scheme; 2] = [&MoreauJean::default(), &Anitescu];
        let runs = schemes.map(|scheme| simulate(scheme, &Auto, mechanism.as_ref(), start.clone(), 0.01, 100).expect("a ball"));
        let motion = |k: usize| MotionReport { mechanism: mechanism.as_ref(), recording: &runs[k], exact: exact.as_ref(), gravity: 9.81 };
        let panels = overlaid(&[("moreau-jean", motion(0)), ("anitescu", motion(1))]);
        let labels = |panel: &Panel| panel.curves.iter().map(|curve| curve.label.clone()).collect::<Vec<_>>();
        assert_eq!(panels.len(), 3);
        panels.iter().for_each(|panel| assert_eq!(labels(panel), ["closed form", "moreau-jean", "anitescu"]));
    }

    #[test]
    fn a_scheme_that_did_not_run_stands_below_the_table() {
        let quantity = |name, value| Quantity { name, value, unit: "m", rounding: None };
        let none = StepSummary { steps: 0, solved: 0, rejected: 0, unconverged: 0, worst: None };
        let ran =
            SchemeOutcome::ran("a", &SHOWN.map(|(name, _)| quantity(name, (name == "deepest penetration").then_some(0.5))), none, None);
        let schemes = vec![ran, SchemeOutcome::refused("b", "no joints".into())];
        let comparison = Comparison {
            scene: "x".into(),
            time_step: 0.01,
            duration: 1.0,
            solver: "auto".into(),
            closed_form: None,
            form_has_restitution: false,
            schemes,
        };
        let text = comparison.text(Style::PLAIN);
        let expected = "scheme  penetration    settling time\na             0.5 m  does not settle\nb: unsupported: no joints\n";
        assert!(text.contains(expected), "{text}");
    }
}
