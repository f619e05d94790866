//! What can be chosen, with its value in force: `contact_model.parameters` (physical numbers, with units) and `options`.

use crate::protocol::{Outcome, Refusal};
use crate::version;
use serde_json::{Map, Value, json};

/// Settings by name: Rapier's own defaults, overridden by the scene's `engines.rapier`, then by the request.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings(Map<String, Value>);

/// Settings that count something, with the smallest value that makes sense.
const COUNTS: [(&str, u64); 4] =
    [("solver_iterations", 1), ("internal_pgs_iterations", 1), ("stabilization_iterations", 0), ("max_ccd_substeps", 0)];

/// Settings that may not be 0.
const POSITIVE: [&str; 4] = ["length_unit", "contact_frequency", "ground_contact_frequency", "ground_extent"];

/// Settings with a choice of words.
const CHOICES: [(&str, [&str; 2]); 2] = [("friction_model", ["Simplified", "Coulomb"]), ("ground_shape", ["halfspace", "box"])];

impl Settings {
    /// The settings in force for these sources, the later ones first in rank.
    ///
    /// # Errors
    /// An unknown name, or a value of the wrong kind.
    pub fn read<'a>(sources: impl IntoIterator<Item = &'a Map<String, Value>> + Clone) -> Outcome<Self> {
        let length_unit = sources.clone().into_iter().filter_map(|source| source.get("length_unit")).last();
        let length_unit = length_unit.map_or(Ok(1.0), |value| number("length_unit", value))?;
        let mut settings = version::defaults(length_unit);
        for (name, value) in sources.into_iter().flatten() {
            let Some(default) = settings.get(name) else {
                let known: Vec<&str> = settings.keys().map(String::as_str).collect();
                return Err(Refusal::error(format!("unknown option `{name}`; Rapier {} has {}", version::VERSION, known.join(", "))));
            };
            check(name, value, default)?;
            settings.insert(name.clone(), value.clone());
        }
        Ok(Settings(settings))
    }

    /// A number.
    pub fn number(&self, name: &str) -> f64 {
        self.0.get(name).and_then(Value::as_f64).expect("checked when it was read")
    }

    /// A count.
    pub fn count(&self, name: &str) -> usize {
        self.0.get(name).and_then(Value::as_u64).expect("checked when it was read") as usize
    }

    /// A switch.
    pub fn switch(&self, name: &str) -> bool {
        self.0.get(name).and_then(Value::as_bool).expect("checked when it was read")
    }

    /// Whether every contact point has its own friction (`Coulomb`), or every group of four one (`Simplified`).
    pub fn coulomb(&self) -> bool {
        self.0["friction_model"] == "Coulomb"
    }

    /// Half the width of the ground where it is a box \[m\]; otherwise it is a half-space.
    pub fn ground_box(&self) -> Option<f64> {
        (self.0["ground_shape"] == "box").then(|| self.number("ground_extent"))
    }

    /// All of them, as a JSON object.
    pub fn to_json(&self) -> Value {
        Value::Object(self.0.clone())
    }
}

fn check(name: &str, value: &Value, default: &Value) -> Outcome<()> {
    let wrong = |expected: &str| Err(Refusal::error(format!("option `{name}` is {value}; it must be {expected}")));
    if let Some((_, least)) = COUNTS.iter().find(|(count, _)| *count == name) {
        let fits = |count: u64| (*least..=u64::from(u16::MAX)).contains(&count);
        return if value.as_u64().is_some_and(fits) { Ok(()) } else { wrong(&format!("a whole number from {least} to 65535")) };
    }
    if let Some((_, words)) = CHOICES.iter().find(|(choice, _)| *choice == name) {
        return if words.map(Value::from).contains(value) { Ok(()) } else { wrong(&format!("`{}`", words.join("` or `"))) };
    }
    match default {
        Value::Bool(_) if !value.is_boolean() => wrong("true or false"),
        Value::Number(_) => number(name, value).map(drop),
        _ => Ok(()),
    }
}

fn number(name: &str, value: &Value) -> Outcome<f64> {
    let least = if POSITIVE.contains(&name) { f64::MIN_POSITIVE } else { 0.0 };
    match value.as_f64() {
        Some(number) if number >= least && version::representable(number) => Ok(number),
        _ => Err(Refusal::error(format!(
            "option `{name}` is {value}; it must be a number ≥ 0 that Rapier can hold, and not 0 if it divides"
        ))),
    }
}

/// `options` of a request; absent is empty.
///
/// # Errors
/// If it is not an object.
pub fn of_request(request: &Map<String, Value>) -> Outcome<Map<String, Value>> {
    match request.get("options") {
        None | Some(Value::Null) => Ok(Map::new()),
        Some(Value::Object(options)) => Ok(options.clone()),
        Some(other) => Err(Refusal::error(format!("options is {other}; it must be an object"))),
    }
}

/// The description of the engine under the request's options.
pub fn describe(request: &Map<String, Value>) -> Outcome<Value> {
    let settings = Settings::read([&of_request(request)?])?;
    let unit_of = |name: &str| version::PARAMETERS.iter().find(|(parameter, _)| *parameter == name).map(|(_, unit)| *unit);
    let (mut parameters, mut options) = (Map::new(), Map::new());
    for (name, value) in &settings.0 {
        match unit_of(name) {
            Some(unit) => parameters.insert(name.clone(), json!({"value": value, "unit": unit})),
            None => options.insert(name.clone(), value.clone()),
        };
    }
    Ok(json!({
        "name": "rapier", "version": version::VERSION, "precision": version::PRECISION,
        "contact_model": {"kind": "rigid", "law": "coulomb", "parameters": parameters},
        "restitution": true, "friction": "cone", "reports_contacts": version::reports_contacts(&settings),
        "levels": ["simulate"], "bodies": ["free", "static", "prescribed"],
        "shapes": ["sphere", "box", "capsule", "cylinder"], "options": options,
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn settings(options: Value) -> Outcome<Settings> {
        Settings::read([options.as_object().expect("an object")])
    }

    #[test]
    fn later_sources_win_and_other_settings_keep_their_defaults() {
        let sources = [json!({"solver_iterations": 8, "warmstart_coefficient": 0.5}), json!({"solver_iterations": 12})];
        let settings = Settings::read(sources.iter().map(|source| source.as_object().expect("an object"))).expect("valid");
        assert_eq!((settings.count("solver_iterations"), settings.number("warmstart_coefficient")), (12, 0.5));
        assert_eq!(settings.count("internal_pgs_iterations"), 1);
    }

    #[test]
    fn unknown_names_and_impossible_values_are_errors_that_name_the_option() {
        for (name, value) in [
            ("colour", json!(1)),
            ("solver_iterations", json!(0)),
            ("solver_iterations", json!(1.5)),
            ("solver_iterations", json!(65536)),
            ("friction_model", json!("Dry")),
            ("ground_shape", json!("Coulomb")),
            ("gyroscopic_forces", json!(1)),
            ("contact_frequency", json!(0)),
            ("prediction_distance", json!(-1)),
            ("warmstart_coefficient", json!("much")),
        ] {
            let refusal = settings(json!({name: value})).expect_err("must be refused");
            assert!(matches!(&refusal, Refusal::Error(message) if message.contains(name)), "{name}: {refusal:?}");
        }
    }

    #[test]
    fn lengths_scale_with_the_length_unit_unless_they_are_given() {
        let (one, ten) = (settings(json!({})).expect("valid"), settings(json!({"length_unit": 10})).expect("valid"));
        let ratio = ten.number("prediction_distance") / one.number("prediction_distance");
        assert!((ratio - 10.0).abs() < 1e-6);
        let given = settings(json!({"length_unit": 10, "prediction_distance": 0.5})).expect("valid");
        assert_eq!(given.number("prediction_distance"), 0.5);
    }

    #[test]
    fn every_number_of_the_description_can_be_sent_back_as_an_option() {
        let request = |options: Value| json!({"options": options}).as_object().expect("an object").clone();
        let first = describe(&request(json!({}))).expect("a description");
        let mut options = first["options"].clone();
        for (name, parameter) in first["contact_model"]["parameters"].as_object().expect("an object") {
            options[name] = parameter["value"].clone();
        }
        assert_eq!(describe(&request(options)).expect("the same description"), first);
        assert_eq!(first["contact_model"]["parameters"].as_object().map(Map::len), Some(version::PARAMETERS.len()));
    }

    #[test]
    fn options_that_are_no_object_are_an_error() {
        let request = json!({"options": [1]});
        assert!(describe(request.as_object().expect("an object")).is_err());
    }
}
