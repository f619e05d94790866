//! What the scoreboard shows: some measured numbers side by side, each with its explanation. The numbers are read from the stored
//! results, never typed.

use crate::gate::scoreboard::Standing;
use crate::report::number::{significant, with_unit};

/// One thing worth seeing: a quantity of one check over several engines.
struct Highlight {
    title: &'static str,
    explanation: &'static str,
    check: &'static str,
    quantity: &'static str,
    engines: &'static [&'static str],
}

const HIGHLIGHTS: &[Highlight] = &[
    Highlight {
        title: "Friction that is not opposed to slip",
        explanation: "A block on a 20° slope with μ = 0.3 gains 0.5897 m/s² whatever its direction. Rapier's `Coulomb` friction does so in 0.34; in 0.36 \
                      it gains 47 % more where the slip is along a friction direction of the contact: the impulse stays on the cone but does not \
                      oppose the slip. `Simplified`, the default, is right in both.",
        check: "incline/slide",
        quantity: "(v_t + μ v_n)/T, less the initial speed",
        engines: &["rapier-0.34-coulomb", "rapier-0.36", "rapier-0.36-coulomb"],
    },
    Highlight {
        title: "MuJoCo's creep does not depend on the time step",
        explanation: "A block that Coulomb holds creeps in proportion to 1/impratio, as the declared law predicts: the creep belongs to the softness of \
                      the model, and no smaller step removes it. Only where `refsafe` stretches the time constant to 2h, above h = 0.01 s, is it faster.",
        check: "incline/stick",
        quantity: "creep speed",
        engines: &["mujoco", "mujoco-elliptic", "mujoco-elliptic-impratio10", "mujoco-elliptic-impratio100"],
    },
    Highlight {
        title: "Drake: SAP creeps with the step, Lagged and TAMSI do not",
        explanation: "SAP's tangential regularisation is a share of the step's own stiffness, so its creep is proportional to h where the block sticks. \
                      Lagged and TAMSI slip at a speed that the stiction tolerance fixes, at every h.",
        check: "incline/stick",
        quantity: "creep speed",
        engines: &["drake-sap", "drake-lagged", "drake-tamsi"],
    },
    Highlight {
        title: "Bullet's effective restitution",
        explanation: "A ball with e = 0.5, dropped from 5 m, keeps another share of its velocity at every step size, above e at large steps and below it \
                      at small ones: Bullet's contacts may act before they close. DART, beside it, keeps e within the error of a step.",
        check: "ball/restitution",
        quantity: "e = 0.5 from 5 m, impact 1: v+/v-",
        engines: &["bullet", "bullet-box-ground", "dart"],
    },
    Highlight {
        title: "Stacks that a sweep method lets drift",
        explanation: "Five equal cubes stand still in theory. Solvers that go over the contacts one by one and stop early let them wander sideways, at \
                      1/60 s by millimetres to centimetres. MuJoCo's Newton method, DART's Dantzig pivoting and Siconos's sweeps, which go on until the \
                      residual is small, keep them within 1e-5 m.",
        check: "stack/five",
        quantity: "largest horizontal displacement while standing",
        engines: &["mujoco", "mujoco-pgs", "dart-ode", "dart-ode-nsgs", "siconos", "bullet", "rapier-0.34", "rapier-0.36"],
    },
    Highlight {
        title: "A released engine that lost restitution, from 2 m",
        explanation: "Rapier 0.35.0-beta.0 loses the restitution of a contact that it finds before the step that closes it. From 2 m over a box it \
                      bounces at h = 1/1000 s and not at 1/60 or 1/240 s, so that a test at the smallest of the three misses it; over a half-space it \
                      bounces at none of them. Which steps bounce depends on the height of the drop.",
        check: "ball/restitution",
        quantity: "e = 0.5 from 2 m, impact 1: v+/v-",
        engines: &["rapier-0.34", "rapier-0.35-beta-box-ground", "rapier-0.35-beta", "rapier-0.36"],
    },
    Highlight {
        title: "The same engine from 5 m",
        explanation: "From 5 m the first impact of Rapier 0.35.0-beta.0 bounces at h = 1/60 s, and is lost at 1/240 and 1/1000 s. No single step and no \
                      single height is sure to show the loss; a sweep over both does.",
        check: "ball/restitution",
        quantity: "e = 0.5 from 5 m, impact 1: v+/v-",
        engines: &["rapier-0.34", "rapier-0.35-beta-box-ground", "rapier-0.35-beta", "rapier-0.36"],
    },
];

/// A table per highlight: engines down, time steps across.
pub fn markdown(standings: &[Standing]) -> String {
    HIGHLIGHTS.iter().map(|highlight| highlight.markdown(standings)).collect()
}

impl Highlight {
    fn markdown(&self, standings: &[Standing]) -> String {
        let rows: Vec<_> = self.engines.iter().map(|name| self.row(standings, name)).collect();
        let longest = rows.iter().max_by_key(|row| row.values.len());
        let heading: String = longest.map(|row| row.values.iter().map(|(at, _)| format!(" {at} |")).collect()).unwrap_or_default();
        let columns = longest.map_or(0, |row| row.values.len());
        let mut text =
            format!("**{}** (`{}`: {})\n\n| |{heading}\n|---|{}\n", self.title, self.check, self.quantity, "---|".repeat(columns));
        for row in rows {
            let values: String = row.values.iter().map(|(_, value)| format!(" {value} |")).collect();
            text += &format!("| {} | {}\n", row.name, if values.is_empty() { "not run |".into() } else { values });
        }
        text + &format!("\n{}\n\n", self.explanation)
    }

    fn row<'a>(&self, standings: &'a [Standing], name: &'a str) -> Row<'a> {
        let report = standings.iter().find(|standing| standing.entry.name == name).and_then(|standing| standing.report.as_ref());
        let outcome = report.and_then(|report| report.checks.iter().find(|outcome| outcome.check == self.check));
        let steps = outcome.map(|outcome| outcome.steps.as_slice()).unwrap_or_default();
        let value = |step: &crate::gate::StepOutcome| {
            let at = step.time_step.map_or("value".into(), |h| format!("h = {} s", significant(h)));
            let measured = step.measurements.iter().find(|one| one.quantity == self.quantity);
            let shown = measured.map(|one| with_unit(&significant(one.value), &one.unit));
            (at, shown.unwrap_or_else(|| step.verdict.word().into()))
        };
        Row { name, values: steps.iter().map(value).collect() }
    }
}

struct Row<'a> {
    name: &'a str,
    values: Vec<(String, String)>,
}

#[cfg(test)]
mod tests {
    use super::HIGHLIGHTS;
    use crate::gate::{Bench, Engine, Options, Run, check, own};

    #[test]
    fn every_highlight_names_a_check_and_the_words_of_one_of_its_quantities() {
        let mut engine = own::by_name("moreau-jean").expect("our scheme");
        let options = Options::new();
        let description = engine.describe(&options).expect("a description");
        for highlight in HIGHLIGHTS {
            let check = check::find(highlight.check).expect("a check");
            let Run::EachStep(run) = check.run else { panic!("{} has no time step", highlight.check) };
            let measured = run(&mut Bench::new(&mut engine, &description, &options), 1.0 / 60.0).expect("measurements");
            assert!(measured.iter().any(|one| one.quantity == highlight.quantity), "{}: {}", highlight.check, highlight.quantity);
        }
    }
}
