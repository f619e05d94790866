//! A small engine with an adapter, written from the specification alone: one body, explicit steps – and a mistake to choose.
//!
//! It knows nothing of the crate's types, so that what the probes say of it is said of a stranger's adapter.

use crate::body::Simulation;
use serde_json::{Map, Value, json};
use std::io::{BufRead, Write};
use std::time::Duration;

/// Answers requests until `bye`, with this mistake.
pub fn run(mistake: &str) {
    let mut adapter = Adapter { mistake: mistake.into(), requests: 0 };
    for line in std::io::stdin().lock().lines() {
        let line = line.expect("UTF-8");
        adapter.requests += 1;
        let Some(reply) = adapter.reply(&line) else { continue };
        let mut output = std::io::stdout().lock();
        writeln!(output, "{reply}").and_then(|()| output.flush()).expect("the gate listens");
        drop(output);
        adapter.afterwards();
        if line.contains("\"bye\"") && !adapter.makes("stays-after-bye") {
            return;
        }
    }
    if adapter.makes("stays-after-end") {
        std::thread::sleep(Duration::from_secs(600));
    }
}

struct Adapter {
    mistake: String,
    requests: usize,
}

type Answer = Result<Value, (&'static str, String)>;

fn error(message: impl Into<String>) -> (&'static str, String) {
    ("error", message.into())
}

impl Adapter {
    fn makes(&self, mistake: &str) -> bool {
        self.mistake == mistake
    }

    fn afterwards(&self) {
        if self.makes("prints-late") {
            std::thread::sleep(Duration::from_millis(20));
            println!("done");
        }
    }

    fn reply(&self, line: &str) -> Option<Value> {
        if self.makes("prints") {
            println!("step 1 of 12");
        }
        let request: Value = match serde_json::from_str(line) {
            Ok(request) => request,
            Err(_) if self.makes("dies-of-garbage") => std::process::exit(1),
            Err(_) if self.makes("silent-about-garbage") => return None,
            Err(problem) => return Some(json!({"id": null, "error": problem.to_string()})),
        };
        // it has answered once; what starts it again hears nothing
        if self.makes("falls-silent") && request["id"] != 5_000_000_001_u64 {
            std::thread::sleep(Duration::from_secs(600));
        }
        let id = match &self.mistake[..] {
            "text-id" => json!(request["id"].to_string()),
            "small-id" => json!(request["id"].as_u64().expect("a number") as u32),
            "no-id" => Value::Null,
            _ => request["id"].clone(),
        };
        Some(match self.answer(&request) {
            Ok(result) => json!({"id": id, "result": result}),
            Err((kind, message)) => json!({"id": id, kind: message}),
        })
    }

    fn answer(&self, request: &Value) -> Answer {
        if request["protocol"] != "moreau-engine/1" && !self.makes("no-version-check") {
            return Err(error("another protocol"));
        }
        let options = request.get("options").and_then(Value::as_object).cloned().unwrap_or_default();
        self.check(&options)?;
        match request["request"].as_str() {
            Some("describe") => Ok(self.description()),
            Some("simulate") => self.simulate(request),
            Some("solve") => Ok(self.solve(&request["problem"])),
            Some("project") => Ok(self.project(request)),
            Some("bye") => Ok(json!({})),
            _ if self.makes("error-for-unknown") => Err(error("what?")),
            _ => Err(("unsupported", "not implemented".into())),
        }
    }

    fn check(&self, options: &Map<String, Value>) -> Result<(), (&'static str, String)> {
        let known: &[&str] = if self.makes("refuses-its-options") { &[] } else { &["iterations", "restitution_threshold"] };
        match options.keys().find(|name| !known.contains(&name.as_str())) {
            Some(name) if !self.makes("ignores-options") => Err(error(format!("no option {name}"))),
            _ => Ok(()),
        }
    }

    fn description(&self) -> Value {
        let mut description = json!({
            "name": "one body", "version": "0.1", "precision": "double",
            "contact_model": {"kind": "rigid", "law": "coulomb", "parameters": {"restitution_threshold": {"value": 0.1, "unit": "m/s"}}},
            "restitution": true, "friction": "cone", "reports_contacts": true,
            "levels": ["simulate", "solve", "project"], "laws": ["coulomb"], "options": {"iterations": 1}
        });
        match &self.mistake[..] {
            "extra-field" => description["colour"] = json!("red"),
            "unknown-level" => description["levels"] = json!(["simulate", "dance"]),
            "millimetres" => description["contact_model"]["parameters"]["restitution_threshold"]["unit"] = json!("mm/s"),
            "other-unit" => description["contact_model"]["parameters"]["restitution_threshold"]["unit"] = json!("m"),
            "own-law" => description["contact_model"]["law"] = json!("bouncy"),
            "counts" => description["options"]["iterations"] = json!(self.requests),
            "shape-twice" => description["shapes"] = json!(["sphere", "box", "sphere"]),
            "no-free-bodies" => description["bodies"] = json!([]),
            "slab-falls" => description["bodies"] = json!(["free", "static"]),
            "undeclared-restitution" => description["restitution"] = json!(false),
            _ => {}
        }
        description
    }

    fn simulate(&self, request: &Value) -> Answer {
        let steps =
            (request["scene"]["duration"].as_f64().expect("a number") / request["time_step"].as_f64().expect("a number")).round() as usize;
        let every = request["sample_every"].as_u64().expect("a number") as usize;
        let every = if self.makes("samples-all") { 1 } else { every };
        let mut simulation = Simulation::new(&self.mistake, &request["scene"], request["time_step"].as_f64().expect("a number"));
        if self.makes("remembers") {
            simulation.disturb(1e-15 * self.requests as f64);
        }
        if !self.makes("no-first-sample") {
            simulation.sample(0);
        }
        for step in 1..=steps {
            simulation.step();
            if step % every == 0 {
                simulation.sample(step);
            }
        }
        Ok(simulation.trajectory())
    }

    fn solve(&self, problem: &Value) -> Value {
        let numbers = |field: &str| -> Vec<f64> {
            problem[field].as_array().expect("a list").iter().map(|x| x.as_f64().expect("a number")).collect()
        };
        let (free, shift, friction) = (numbers("free_velocity"), numbers("shift"), numbers("friction"));
        let (mut impulse, mut velocity) = (vec![0.0; free.len()], free.clone());
        for (contact, mu) in friction.iter().enumerate() {
            let row = 3 * contact;
            let inverse_mass = problem["delassus"]["rows"][row][row].as_f64().expect("dense");
            let normal = (-(free[row] + shift[row]) / inverse_mass).max(0.0);
            let tangent = [-free[row + 1] / inverse_mass, -free[row + 2] / inverse_mass];
            let shrink = (mu * normal / tangent[0].hypot(tangent[1])).min(1.0);
            let answer = [normal, shrink * tangent[0], shrink * tangent[1]];
            for k in 0..3 {
                let place = if self.makes("tangents-first") { (k + 2) % 3 } else { k };
                impulse[row + place] = answer[k];
                velocity[row + place] = free[row + k] + inverse_mass * answer[k];
                if self.makes("shifted-velocity") {
                    velocity[row + place] += shift[row + k];
                }
            }
        }
        json!({"schema": "solution/1", "impulse": impulse, "velocity": velocity})
    }

    fn project(&self, request: &Value) -> Value {
        let mu = request["friction"].as_f64().expect("a number");
        let points = request["points"].as_array().expect("a list").iter().map(|point| {
            let row: Vec<f64> = point.as_array().expect("a list").iter().map(|x| x.as_f64().expect("a number")).collect();
            let length = row[1..].iter().map(|t| t * t).sum::<f64>().sqrt();
            let normal = match () {
                () if length <= mu * row[0] => return row,
                () if mu * length <= -row[0] => return vec![0.0; row.len()],
                () if self.makes("clamps") => row[0].max(0.0),
                () => (row[0] + mu * length) / (1.0 + mu * mu),
            };
            std::iter::once(normal).chain(row[1..].iter().map(|t| t / length * mu * normal)).collect()
        });
        json!({"points": points.collect::<Vec<_>>()})
    }
}
