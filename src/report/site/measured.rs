//! What pictures show that others measured: the creep of engines, and the work of iterations.

use crate::gate::scoreboard::Standing;
use crate::gate::{CheckOutcome, StepOutcome};
use crate::problems::work::Table;
use crate::report::profile::{Cost, rises};
use moreau_site::pages::data::{Creep, CreepStep, CreepTrend, Given, Work};

/// The check of the gate whose creep is shown, and the words of its quantity.
const CHECK: &str = "incline/stick";
const QUANTITY: &str = "creep speed";

/// The given data of the pictures.
pub fn given(standings: &[Standing], work: &[Table]) -> Given {
    Given { creep: standings.iter().filter_map(creep).collect(), work: work.iter().map(profiles).collect() }
}

/// The creep of an engine that answered at some step.
fn creep(standing: &Standing) -> Option<Creep> {
    let report = standing.report.as_ref()?;
    let outcome = report.checks.iter().find(|outcome| outcome.check == CHECK)?;
    let steps: Vec<CreepStep> = outcome.steps.iter().filter_map(step).collect();
    let (engine, program) = (standing.entry.name.clone(), report.engine.name.clone());
    (!steps.is_empty()).then(|| Creep { engine, program, steps, trend: trend(outcome) })
}

fn step(step: &StepOutcome) -> Option<CreepStep> {
    let measured = step.measurements.iter().find(|one| one.quantity == QUANTITY)?;
    Some(CreepStep { time_step: step.time_step?, speed: measured.value, allowed: measured.ideal.tolerance })
}

fn trend(outcome: &CheckOutcome) -> Option<CreepTrend> {
    let trend = outcome.trends.iter().find(|trend| trend.quantity == QUANTITY)?;
    Some(CreepTrend { order: trend.order, origin: trend.cause })
}

/// The performance profile of every iteration of a table.
fn profiles(table: &Table) -> Work {
    let least = |row: &[f64]| row.iter().copied().fold(f64::INFINITY, f64::min);
    let costs = |k: usize| table.passes.iter().map(|row| Cost { own: row[k], least: least(row) }).collect::<Vec<_>>();
    let profiles = table.solvers.iter().enumerate().map(|(k, name)| ((*name).to_string(), rises(&costs(k)))).collect();
    Work { laws: table.laws.into(), problems: table.passes.len(), profiles }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::board;
    use moreau_gate::trend::Origin;

    #[test]
    fn every_stored_engine_that_answers_the_slope_is_shown_with_the_stored_numbers() {
        let (standings, _) = board::stored().expect("stored");
        let shown = given(&standings, &[]).creep;
        // what the files say, read as text
        let mut expected = Vec::new();
        for standing in &standings {
            let text = serde_json::to_value(standing).expect("a document");
            let checks = text["report"]["checks"].as_array().cloned().unwrap_or_default();
            for check in checks.iter().filter(|check| check["check"] == "incline/stick") {
                let steps = check["steps"].as_array().expect("steps");
                let speeds: Vec<f64> = steps.iter().filter_map(|step| step["measurements"][0]["value"].as_f64()).collect();
                if !speeds.is_empty() {
                    expected.push((text["entry"]["name"].as_str().expect("a name").to_string(), speeds));
                }
            }
        }
        let found: Vec<(String, Vec<f64>)> =
            shown.iter().map(|creep| (creep.engine.clone(), creep.steps.iter().map(|step| step.speed).collect())).collect();
        assert!(found.len() >= 20, "{}", found.len());
        assert_eq!(found, expected);
        let origin = |name: &str| shown.iter().find(|creep| creep.engine == name).and_then(|creep| creep.trend).map(|trend| trend.origin);
        assert_eq!(origin("drake-sap"), Some(Origin::Discretisation), "a share of the step's own stiffness");
        assert_eq!(origin("drake-tamsi"), Some(Origin::Model), "the stiction tolerance fixes the slip");
        assert_eq!(origin("moreau-jean"), None, "sticks");
    }

    #[test]
    fn the_least_work_of_a_problem_is_that_of_the_best_iteration_there() {
        let passes = vec![vec![2.0, 4.0], vec![9.0, 3.0], vec![f64::INFINITY, 5.0], vec![f64::INFINITY, f64::INFINITY]];
        let work = profiles(&Table { laws: "laws", solvers: vec!["a", "b"], passes });
        assert_eq!(work.problems, 4);
        assert_eq!(work.profiles[0], ("a".into(), vec![[1.0, 0.25], [3.0, 0.5]]));
        assert_eq!(work.profiles[1], ("b".into(), vec![[1.0, 0.5], [2.0, 0.75]]));
    }
}
