//! What the scoreboard shows: some measured numbers side by side, each with its explanation. The numbers are read from the stored
//! results, never typed.

use crate::report::frame::{scrolled, with_code};
use crate::scoreboard::Standing;
use crate::{CheckOutcome, StepOutcome};
use maud::{Markup, html};
use moreau_exact::number::{significant, with_unit};

/// One thing worth seeing: a quantity of one check over several engines.
struct Highlight {
    title: &'static str,
    explanation: &'static str,
    check: &'static str,
    quantity: &'static str,
    /// The engines whose numbers are shown; none stands for all that measured it.
    engines: Option<&'static [&'static str]>,
}

const HIGHLIGHTS: &[Highlight] = &[
    Highlight {
        title: "Friction that is not opposed to slip",
        explanation: "A block on a 20° slope with μ = 0.3 gains 0.5897 m/s² whatever its direction. Rapier's `Coulomb` friction does so in \
            0.34; in 0.36 \
                      it gains 47 % more where the slip is along a friction direction of the contact: the impulse stays on the cone but \
                      does not \
                      oppose the slip. `Simplified`, the default, is right in both.",
        check: "incline/slide",
        quantity: "(v_t + μ v_n)/T, less the initial speed",
        engines: Some(&["rapier-0.34-coulomb", "rapier-0.36", "rapier-0.36-coulomb"]),
    },
    Highlight {
        title: "Does creep vanish with the time step?",
        explanation: "A block on a 20° slope with μ = 0.5 should stick. Every engine that answered, downhill positive: what falls with the \
            step belongs to the discretisation, what stays to the model, and what is slower than a nanometre per second is not told from \
            rounding.",
        check: "incline/stick",
        quantity: "creep speed",
        engines: None,
    },
    Highlight {
        title: "MuJoCo's creep does not vanish with the time step",
        explanation: "A block that Coulomb holds creeps in proportion to 1/impratio, as the declared law predicts: the creep belongs to \
            the softness of \
                      the model, and no smaller step removes it. Only where `refsafe` stretches the time constant to 2h, above h = 0.01 s, \
                      is it faster.",
        check: "incline/stick",
        quantity: "creep speed",
        engines: Some(&["mujoco", "mujoco-elliptic", "mujoco-elliptic-impratio10", "mujoco-elliptic-impratio100"]),
    },
    Highlight {
        title: "Drake: SAP creeps with the step, Lagged and TAMSI do not",
        explanation: "SAP's tangential regularisation is a share of the step's own stiffness, so its creep is proportional to h where the \
            block sticks. \
                      Lagged and TAMSI slip at a speed that the stiction tolerance fixes, at every h.",
        check: "incline/stick",
        quantity: "creep speed",
        engines: Some(&["drake-sap", "drake-lagged", "drake-tamsi"]),
    },
    Highlight {
        title: "Bullet's effective restitution",
        explanation: "A ball with e = 0.5, dropped from 5 m, keeps another share of its velocity at every step size, above e at large \
            steps and below it \
                      at small ones: Bullet's contacts may act before they close. DART, beside it, keeps e within the error of a step.",
        check: "ball/restitution",
        quantity: "e = 0.5 from 5 m, impact 1: v+/v-",
        engines: Some(&["bullet", "bullet-box-ground", "dart"]),
    },
    Highlight {
        title: "Stacks that a sweep method lets drift",
        explanation: "Ten equal cubes stand still in theory. Sweeps that end after a fixed number of iterations let them wander sideways \
            at 1/60 s: DART's \
                      projected Gauss–Seidel by a tenth of a metre, Bullet by centimetres, Rapier by millimetres to a centimetre, PhysX by \
                      more than half \
                      a millimetre; less at smaller steps. MuJoCo's solvers, DART's Dantzig pivoting and Siconos's sweeps, which go on \
                      until the residual is \
                      small, keep them within two micrometres at every step.",
        check: "stack/ten",
        quantity: "largest horizontal displacement while standing",
        engines: Some(&["mujoco", "mujoco-pgs", "siconos", "dart-ode", "dart-ode-nsgs", "bullet", "sapien", "rapier-0.34", "rapier-0.36"]),
    },
    Highlight {
        title: "A released engine that lost restitution, from 2 m",
        explanation: "Rapier 0.35.0-beta.0 loses the restitution of a contact that it finds before the step that closes it. From 2 m over \
            a box it \
                      bounces at h = 1/1000 s and not at 1/60 or 1/240 s, so that a test at the smallest of the three misses it; over a \
                      half-space it \
                      bounces at none of them. Which steps bounce depends on the height of the drop.",
        check: "ball/restitution",
        quantity: "e = 0.5 from 2 m, impact 1: v+/v-",
        engines: Some(&["rapier-0.34", "rapier-0.35-beta-box-ground", "rapier-0.35-beta", "rapier-0.36"]),
    },
    Highlight {
        title: "The same engine from 5 m",
        explanation: "From 5 m the first impact of Rapier 0.35.0-beta.0 bounces at h = 1/60 s, and is lost at 1/240 and 1/1000 s. No \
            single step and no \
                      single height is sure to show the loss; a sweep over both does.",
        check: "ball/restitution",
        quantity: "e = 0.5 from 5 m, impact 1: v+/v-",
        engines: Some(&["rapier-0.34", "rapier-0.35-beta-box-ground", "rapier-0.35-beta", "rapier-0.36"]),
    },
];

/// One highlight, measured: engines down, time steps across.
struct Table<'a> {
    of: &'a Highlight,
    /// The time steps.
    heading: Vec<String>,
    /// Name of the engine and a value per time step; none if it was not run.
    rows: Vec<(&'a str, Vec<String>)>,
}

/// A table per highlight, as Markdown.
pub fn markdown(standings: &[Standing]) -> String {
    tables(standings).map(|table| table.markdown()).collect()
}

/// A table per highlight, as HTML.
pub fn html(standings: &[Standing]) -> Markup {
    html! {
        @for table in tables(standings) {
            h3 { (table.of.title) }
            p { code { (table.of.check) } ": " (table.of.quantity) }
            (scrolled(table.of.title, &table.html()))
            p { (with_code(table.of.explanation)) }
        }
    }
}

fn tables(standings: &[Standing]) -> impl Iterator<Item = Table<'_>> {
    HIGHLIGHTS.iter().map(|highlight| highlight.table(standings))
}

impl Highlight {
    fn table<'a>(&'a self, standings: &'a [Standing]) -> Table<'a> {
        let names: Vec<&str> = match self.engines {
            Some(names) => names.to_vec(),
            None => standings.iter().filter(|standing| self.is_measured(standing)).map(|standing| standing.entry.name.as_str()).collect(),
        };
        let outcomes: Vec<_> = names.into_iter().map(|name| (name, self.outcome(standings, name))).collect();
        let steps = outcomes.iter().filter_map(|(_, outcome)| *outcome).map(|outcome| &outcome.steps).max_by_key(|steps| steps.len());
        let at = |step: &StepOutcome| step.time_step.map_or("value".into(), |h| format!("h = {} s", significant(h)));
        let values = |outcome: &CheckOutcome| outcome.steps.iter().map(|step| self.value(step)).collect();
        Table {
            of: self,
            heading: steps.map(|steps| steps.iter().map(at).collect()).unwrap_or_default(),
            rows: outcomes.into_iter().map(|(name, outcome)| (name, outcome.map(values).unwrap_or_default())).collect(),
        }
    }

    fn outcome<'a>(&self, standings: &'a [Standing], name: &str) -> Option<&'a CheckOutcome> {
        let report = standings.iter().find(|standing| standing.entry.name == name)?.report.as_ref()?;
        report.checks.iter().find(|outcome| outcome.check == self.check)
    }

    /// Whether an engine answered at some step.
    fn is_measured(&self, standing: &Standing) -> bool {
        let steps =
            standing.report.iter().flat_map(|report| &report.checks).filter(|one| one.check == self.check).flat_map(|one| &one.steps);
        steps.flat_map(|step| &step.measurements).any(|one| one.quantity == self.quantity)
    }

    fn value(&self, step: &StepOutcome) -> String {
        let measured = step.measurements.iter().find(|one| one.quantity == self.quantity);
        measured.map_or_else(|| step.verdict.word().into(), |one| with_unit(&significant(one.value), &one.unit))
    }
}

impl Table<'_> {
    fn html(&self) -> Markup {
        html! {
            table {
                thead { tr { th { "engine" } @for at in &self.heading { th { (at) } } } }
                tbody {
                    @for (name, values) in &self.rows {
                        tr { td { (name) } @for value in values { td.n { (value) } } @if values.is_empty() { td { "not run" } } }
                    }
                }
            }
        }
    }

    fn markdown(&self) -> String {
        let line = |cells: &[String]| format!("| {} |\n", cells.join(" | "));
        let mut heading = vec![String::new()];
        heading.extend(self.heading.iter().cloned());
        let mut text = format!("**{}** (`{}`: {})\n\n", self.of.title, self.of.check, self.of.quantity);
        text += &line(&heading);
        text += &line(&vec!["---".into(); heading.len()]);
        for (name, values) in &self.rows {
            let cells = if values.is_empty() { vec!["not run".into()] } else { values.clone() };
            text += &line(&[vec![(*name).to_string()], cells].concat());
        }
        text + &format!("\n{}\n\n", self.of.explanation)
    }
}

#[cfg(test)]
mod tests {
    use super::HIGHLIGHTS;
    use crate::{Bench, Engine, Options, Run, checks, own};

    #[test]
    fn every_highlight_names_a_check_and_the_words_of_one_of_its_quantities() {
        let mut engine = own::by_name("moreau-jean").expect("our scheme");
        let options = Options::new();
        let description = engine.describe(&options).expect("a description");
        for highlight in HIGHLIGHTS {
            let check = checks::find(highlight.check).expect("a check");
            let Run::EachStep(run) = check.run else { panic!("{} has no time step", highlight.check) };
            let measured = run(&mut Bench::new(&mut engine, &description, &options), 1.0 / 60.0).expect("measurements");
            assert!(measured.iter().any(|one| one.quantity == highlight.quantity), "{}: {}", highlight.check, highlight.quantity);
        }
    }
}
