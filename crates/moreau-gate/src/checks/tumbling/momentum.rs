//! Whether the reported impulses are those that moved the bodies.
//!
//! ```text
//!     m_b Δv_b = m_b g h + Σ p      over the contacts of body b, p on the body named first and −p on the other
//! ```

use crate::checks::scenery::{GRAVITY, worst};
use crate::checks::tumbling::motion::Tumble;
use crate::checks::tumbling::scenes::{FRICTION, Throw, Thrown};
use crate::tolerance::tumbling as tolerance;
use crate::{Bench, Expectation, Measurement, Refusal, Reply};
use nalgebra::Vector3;

/// Duration of the motion \[s\].
const DURATION: f64 = 0.5;

const THROWS: [Throw; 3] = [
    Throw { thrown: Thrown::Box, seed: 12, restitution: 0.0 },
    Throw { thrown: Thrown::Pair, seed: 13, restitution: 0.0 },
    Throw { thrown: Thrown::Heavy, seed: 14, restitution: 0.0 },
];

/// `tumbling/momentum`.
pub(super) fn momentum(bench: &mut Bench, h: f64) -> Reply<Vec<Measurement>> {
    if !bench.description().reports_contacts {
        return Err(Refusal::unsupported("the engine does not report contact impulses"));
    }
    THROWS.iter().map(|throw| unaccounted(bench, throw, h)).collect()
}

fn unaccounted(bench: &mut Bench, throw: &Throw, h: f64) -> Reply<Measurement> {
    let tumble = Tumble::of(bench, throw, FRICTION, h, DURATION)?;
    let mut reported = vec![vec![(Vector3::zeros(), 0.0); tumble.bodies.len()]; tumble.states.len()];
    for record in &tumble.contacts {
        let impulse = Vector3::from(record.impulse);
        for (name, sign) in record.bodies.iter().zip([1.0, -1.0]) {
            if let Some(body) = tumble.names.iter().position(|known| known == name) {
                let (sum, size) = &mut reported[record.sample][body];
                *sum += impulse * sign;
                *size += impulse.norm();
            }
        }
    }
    let touched = reported.iter().flatten().any(|(_, size)| *size > 0.0);
    if !touched {
        return Err(Refusal::errored("the bodies fell on the floor and no impulse was reported"));
    }
    let fastest = tumble.states.iter().flatten().map(|state| state.velocity.norm()).fold(0.0, worst);
    let mut largest = 0.0;
    for (k, bodies) in reported.iter().enumerate().skip(1) {
        for (body, (sum, size)) in bodies.iter().enumerate() {
            let scale = size + tumble.bodies[body].mass * GRAVITY * h;
            let found = tumble.impulse(body, k) - sum;
            largest = worst(found.norm() / scale, largest);
        }
    }
    let allowed = tolerance::impulse() + crate::tolerance::contact::damped(tumble.damping, fastest, GRAVITY, h);
    let ideal = Expectation::at_most(0.0, allowed, "m Δv = m g h + Σ p, body by body, less the declared damping c m Δx");
    Ok(Measurement::new(format!("unaccounted momentum over impulse: {}", throw.words()), "1", largest, ideal))
}
