//! Probes of a description: whether its content can be used.

use crate::conformance::{Probe, Seen, demand, probe, problem, skipped};
use crate::description::{BodyKind, OneOrMany, Parameter};
use crate::model::Model;
use crate::model::addition::Addition;
use crate::{Description, Kind, Level, unit};
use moreau_exact::number::counted;

/// Names of numbers with their units; no unit where the number is a list of several.
type Numbers = &'static [(&'static str, &'static str)];

/// The laws of `docs/protocol.md` with the kind they belong to, and the numbers they need with their units.
const LAWS: [(&str, Kind, Numbers); 7] = [
    ("coulomb", Kind::Rigid, &[]),
    ("anitescu", Kind::Rigid, &[]),
    ("stewart-trinkle", Kind::Rigid, &[("directions", "1")]),
    ("mujoco", Kind::Compliant, &[("solref", ""), ("solimp", ""), ("impratio", "1")]),
    ("drake-sap", Kind::Compliant, &[("stiffness", "N/m"), ("relaxation_time", "s")]),
    ("drake-regularised", Kind::Compliant, &[("stiffness", "N/m"), ("dissipation", "s/m"), ("stiction_tolerance", "m/s")]),
    ("spring-damper", Kind::Compliant, &[("stiffness", "N/m"), ("damping", "N*s/m")]),
];

/// Numbers that any law may have, with their units: see [`Addition`].
fn addition_unit(name: &str) -> Option<&'static str> {
    Addition::ALL.into_iter().find(|(_, other, ..)| *other == name).map(|(_, _, unit, _)| unit)
}

/// Numbers that the law `coulomb` may have, with their units.
const LIMITS: [(&str, &str); 8] = [
    ("penetration_allowance", "m"),
    ("contact_margin", "m"),
    ("restitution_threshold", "m/s"),
    ("error_reduction", "1"),
    ("correction_speed", "m/s"),
    ("force_mixing", "1"),
    ("linear_damping", "1/s"),
    ("angular_damping", "1/s"),
];

/// The laws of `contact-problem/1`.
const PROBLEM_LAWS: [&str; 5] = ["frictionless", "coulomb", "associated", "polyhedral-coulomb", "polyhedral-associated"];

pub(super) fn probe_all(description: &Description, probes: &mut Vec<Probe>) {
    probes.push(probe("describe/name", "`name` and `version` say which engine was judged", names(description)));
    probes.push(probe("describe/levels", "`levels` names what is answered, once each", levels(description)));
    probes.push(probe("describe/laws", "`laws` names laws of contact-problem/1, if the engine solves any", laws(description)));
    probes.push(probe(
        "describe/law",
        "`contact_model.law` is a law of the specification with the numbers it needs, or null",
        law(description),
    ));
    probes.push(probe(
        "describe/scenes",
        "`shapes` and `bodies` name what scenes may have, once each, with free bodies among them",
        scenes(description),
    ));
    probes.push(probe("describe/units", "every parameter has a unit that can be read and that fits the law", units(description)));
}

fn names(description: &Description) -> Seen {
    let blank = description.name.trim().is_empty() || description.version.trim().is_empty();
    demand(!blank, || "`name` or `version` is empty".into(), "ask the engine for its version, so that a report can be repeated")
}

fn levels(description: &Description) -> Seen {
    let levels = &description.levels;
    demand(!levels.is_empty(), || "`levels` is empty".into(), "name at least one of `simulate`, `solve` and `project`")?;
    let twice = levels.iter().enumerate().any(|(k, level)| levels[..k].contains(level));
    demand(!twice, || format!("`levels` names a level twice: {levels:?}"), "name each level once")
}

fn scenes(description: &Description) -> Seen {
    let (shapes, bodies) = (&description.shapes, &description.bodies);
    demand(!shapes.is_empty(), || "`shapes` is empty".into(), "name at least one shape, or leave the field out: spheres and boxes")?;
    let free = bodies.contains(&BodyKind::Free);
    demand(free, || "`bodies` does not name `free`".into(), "name `free` and what else there is, or leave the field out: free bodies")?;
    let twice = shapes.iter().enumerate().any(|(k, shape)| shapes[..k].contains(shape));
    let again = bodies.iter().enumerate().any(|(k, body)| bodies[..k].contains(body));
    demand(!twice && !again, || format!("a word is there twice: {shapes:?}, {bodies:?}"), "name each once")?;
    let Some(sleeping) = &description.sleeping else { return Ok(()) };
    let is_switch = description.options.get(sleeping).is_some_and(serde_json::Value::is_boolean);
    demand(is_switch, || format!("`sleeping` is `{sleeping}`, which is no option that is true or false"), "name an entry of `options`")
}

fn laws(description: &Description) -> Seen {
    if !description.levels.contains(&Level::Solve) {
        return Err(skipped("the engine does not solve contact problems"));
    }
    let known = || format!("name those of {} that the solver takes", PROBLEM_LAWS.join(", "));
    demand(!description.laws.is_empty(), || "`laws` is empty".into(), &known())?;
    match description.laws.iter().find(|law| !PROBLEM_LAWS.contains(&law.as_str())) {
        Some(law) => Err(problem(format!("`{law}` is not a law of contact-problem/1"), known())),
        None => Ok(()),
    }
}

fn law(description: &Description) -> Seen {
    let model = &description.contact_model;
    let Some(name) = &model.law else { return Ok(()) };
    let Some((_, kind, numbers)) = LAWS.iter().find(|(other, ..)| other == name) else {
        let names: Vec<_> = LAWS.iter().map(|(name, ..)| *name).collect();
        return Err(problem(format!("`{name}` is not a law of the specification"), format!("use null, or one of {}", names.join(", "))));
    };
    demand(model.kind == *kind, || format!("`{name}` does not belong to kind {:?}", model.kind), "correct `kind` or `law`")?;
    for (number, _) in *numbers {
        let listed = model.parameters.contains_key(*number);
        demand(listed, || format!("`{name}` needs `{number}`"), "add it to `contact_model.parameters`, with value and unit")?;
    }
    let known = Model::of(description) != Model::Unknown;
    demand(
        known,
        || format!("the numbers of `{name}` have other sizes than the law's"),
        "give a number where the law has one, a list where it has several",
    )
}

fn units(description: &Description) -> Seen {
    let model = &description.contact_model;
    for (name, parameter) in &model.parameters {
        let field = || format!("`contact_model.parameters.{name}`");
        for unit in each_unit(parameter) {
            unit::parse(unit).map_err(|error| problem(format!("{}: {error}", field()), "write the unit in kg, m, s, N, rad and 1"))?;
        }
        if let (OneOrMany::One(_), OneOrMany::Many(_)) = (&parameter.value, &parameter.unit) {
            return Err(problem(format!("{} has several units for one number", field()), "give one unit"));
        }
        if let (OneOrMany::Many(values), OneOrMany::Many(units)) = (&parameter.value, &parameter.unit) {
            let why = || format!("{} has {} and {}", field(), counted(values.len(), "value"), counted(units.len(), "unit"));
            demand(values.len() == units.len(), why, "give one unit for all, or one per entry")?;
        }
        if let (Some(expected), OneOrMany::One(unit)) = (expected_unit(model.law.as_deref(), name), &parameter.unit) {
            let fits = unit::parse(unit).ok() == unit::parse(expected).ok();
            demand(fits, || format!("{} is given in `{unit}`", field()), &format!("the law has it in `{expected}`: convert it"))?;
            let is_negative = matches!(parameter.value, OneOrMany::One(value) if value < 0.0);
            demand(!is_negative, || format!("{} is negative", field()), "every number of the law is 0 or more")?;
        }
    }
    Ok(())
}

fn each_unit(parameter: &Parameter) -> &[String] {
    match &parameter.unit {
        OneOrMany::One(unit) => std::slice::from_ref(unit),
        OneOrMany::Many(units) => units,
    }
}

/// The unit in which a law has a number, where it is one number.
fn expected_unit(law: Option<&str>, name: &str) -> Option<&'static str> {
    if let Some(unit) = addition_unit(name) {
        return Some(unit);
    }
    let needed = LAWS.iter().find(|(other, ..)| Some(*other) == law)?.2;
    let limits: Numbers = if law == Some("coulomb") { &LIMITS } else { &[] };
    let (_, unit) = needed.iter().chain(limits).find(|(other, _)| *other == name)?;
    Some(*unit).filter(|unit| !unit.is_empty())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::conformance::ProbeOutcome;
    use serde_json::json;

    fn description(law: &str, kind: &str, parameters: serde_json::Value) -> Description {
        let value = json!({"name": "x", "version": "1", "precision": "double", "restitution": true, "friction": "cone",
            "reports_contacts": true, "levels": ["simulate"],
            "contact_model": {"kind": kind, "law": law, "parameters": parameters}});
        serde_json::from_value(value).expect("a description")
    }

    fn seen(description: &Description) -> Vec<String> {
        let mut probes = Vec::new();
        probe_all(description, &mut probes);
        probes.retain(|probe| matches!(probe.outcome, ProbeOutcome::Problem { .. }));
        probes.into_iter().map(|probe| probe.probe).collect()
    }

    #[test]
    fn sound_descriptions_pass() {
        let allowance = json!({"penetration_allowance": {"value": 0.001, "unit": "m"}, "anything": {"value": [1, 2], "unit": ["s", "1"]}});
        assert!(seen(&description("coulomb", "rigid", allowance)).is_empty());
        let mujoco = json!({"solref": {"value": [0.02, 1], "unit": ["s", "1"]}, "impratio": {"value": 1, "unit": "1"},
            "solimp": {"value": [0.9, 0.95, 0.001, 0.5, 2], "unit": ["1", "1", "m", "1", "1"]}});
        assert!(seen(&description("mujoco", "compliant", mujoco)).is_empty());
    }

    #[test]
    fn each_mistake_is_named() {
        let law: &[&str] = &["describe/law"];
        let units: &[&str] = &["describe/units"];
        let stiffness = |unit: &str| json!({"stiffness": {"value": 1e4, "unit": unit}, "damping": {"value": 1, "unit": "N*s/m"}});
        assert_eq!(seen(&description("spring-damper", "compliant", stiffness("N/m"))), [""; 0]);
        assert_eq!(seen(&description("spring-damper", "compliant", stiffness("kg/s^2"))), [""; 0]);
        assert_eq!(seen(&description("spring-damper", "compliant", stiffness("N/mm"))), units);
        assert_eq!(seen(&description("spring-damper", "compliant", stiffness("N"))), units);
        assert_eq!(seen(&description("spring-damper", "rigid", stiffness("N/m"))), law);
        assert_eq!(seen(&description("spring-damper", "compliant", json!({}))), law);
        assert_eq!(seen(&description("bouncy", "rigid", json!({}))), law);
        assert_eq!(seen(&description("coulomb", "rigid", json!({"x": {"value": [1, 2], "unit": ["m"]}}))), units);
        assert_eq!(seen(&description("coulomb", "rigid", json!({"x": {"value": 1, "unit": ["m"]}}))), units);
        let deep = |depth: f64| description("coulomb", "rigid", json!({"penetration_allowance": {"value": depth, "unit": "m"}}));
        assert_eq!((seen(&deep(0.0)), seen(&deep(-0.001))), (vec![], units.iter().map(ToString::to_string).collect()));
        let mut nameless = description("coulomb", "rigid", json!({}));
        nameless.version.clear();
        nameless.levels.clear();
        assert_eq!(seen(&nameless), ["describe/name", "describe/levels"]);
        nameless.levels = vec![Level::Solve, Level::Solve];
        nameless.laws = vec!["hertz".into()];
        assert_eq!(seen(&nameless), ["describe/name", "describe/levels", "describe/laws"]);
    }
}
