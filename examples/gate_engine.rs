//! Gate an engine: `cargo run --example gate_engine`.
//!
//! The engine is a small library in Rust that projects impulses on the friction cone – once onto the nearest point, as it should, and once
//! as many engines do, by shortening friction to μ r_n. A simulator implements `Engine::simulate` in the same way, and a program in another
//! language speaks the protocol of `docs/protocol.md`. As tests of your own crate: `moreau::gate_tests!(MyEngine);`.

use moreau::checks::text::Style;
use moreau::cones::second_order;
use moreau::gate::description::{Friction, Precision};
use moreau::gate::report::text::table;
use moreau::gate::{ContactModel, Kind, Level, Plan, Report, checks, runner};
use moreau::prelude::*;

/// Projects on the cone, or clips friction.
struct Library {
    clips: bool,
}

impl Engine for Library {
    fn describe(&mut self, _: &Options) -> Reply<Description> {
        Ok(Description {
            name: if self.clips { "clipping" } else { "projecting" }.into(),
            version: "1".into(),
            precision: Precision::Double,
            contact_model: ContactModel { kind: Kind::Rigid, law: None, parameters: Default::default() },
            restitution: false,
            friction: Friction::Cone,
            reports_contacts: false,
            levels: vec![Level::Project],
            laws: vec![],
            shapes: vec![],
            bodies: vec![],
            sleeping: None,
            options: Options::new(),
        })
    }

    fn project(&mut self, friction: f64, points: &[Vec<f64>], _: &Options) -> Reply<Vec<Vec<f64>>> {
        let of = |point: &Vec<f64>| {
            let mut impulse = point.clone();
            if self.clips {
                clip(&mut impulse, friction)
            } else {
                second_order::project(&mut impulse, friction)
            }
            impulse
        };
        Ok(points.iter().map(of).collect())
    }
}

/// r_n ← max(r_n, 0), and r_t shortened to μ r_n: in the cone, but not the nearest point of it.
fn clip(impulse: &mut [f64], friction: f64) {
    impulse[0] = impulse[0].max(0.0);
    let (most, length) = (friction * impulse[0], second_order::tangential_norm(impulse));
    if length > most {
        impulse[1..].iter_mut().for_each(|r| *r *= most / length);
    }
}

/// The checks of projections on one of the two engines.
fn gate(clips: bool) -> Reply<Report> {
    let checks = checks::all().filter(|check| check.family() == "projection").collect();
    let plan = Plan { checks, sweep: vec![0.01], options: Options::new(), jobs: 1, repeats: 1, progress: &|| {} };
    runner::run(&|| Box::new(Library { clips }), &plan)
}

/// Prints both reports: the gate passes one engine and fails the other.
pub fn main() {
    for clips in [false, true] {
        let report = gate(clips).expect("it describes itself");
        println!("{}", table(&report, Style::PLAIN));
        assert_eq!(report.is_bad(), clips, "an engine that clips fails, one that projects does not");
    }
}
