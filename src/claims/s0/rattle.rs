//! The order of RATTLE, on a pendulum in Cartesian coordinates: q̈ = g − λ q, |q| = 1.
//!
//! ```text
//!     v½ = v + ½h (g − λ q) ,   q⁺ = q + h v½ ,   |q⁺| = 1 ;      v⁺ = v½ + ½h (g − μ q⁺) ,   q⁺·v⁺ = 0 .
//! ```

use crate::claims::prelude::*;
use crate::tolerance::claims::ORDER_GAP;
use crate::trajectory::order::{Refinement, fit_order};
use nalgebra::{Vector2, Vector4};

pub const CLAIMS: &[Claim] = &[Claim {
    id: "S0.rattle-high",
    statement: "Purely equality-constrained DAEs have mature high-order integrators, for example SHAKE/RATTLE.",
    verdict: ClaimVerdict::False,
    kind: Kind::Assertion,
    severity: Some(Severity::WrongReason),
    evidence: Evidence::Measured,
    correct_statement: "The statement is right, the example is not: SHAKE and RATTLE have order 2 (the chapter itself calls orders 1–2 \
        low). High order comes from compositions of RATTLE or from Radau-type methods.",
    argument: r"RATTLE is symmetric, so its order is even. Pendulum of unit length from the horizontal, $g = 1$, to $t = 1$: differences
        between $h$ and $h/2$ fall with slope 2.0 for RATTLE and 4.0 for the triple jump composed of it, steps $\gamma h$,
        $(1 - 2\gamma)h$, $\gamma h$ with $\gamma = 1/(2 - \sqrt[3]2)$.",
    controls: &["The composition, as if it were RATTLE.", "RATTLE, as if it were the composition."],
    sources: &[
        "chapter §0, essential insight on equality constraints",
        "Hairer, Lubich, Wanner, Geometric Numerical Integration, II.4 and VII.1",
    ],
    check: check!(order),
}];

/// Place and velocity of the bob.
#[derive(Clone, Copy)]
struct Bob {
    place: Vector2<f64>,
    velocity: Vector2<f64>,
}

impl Bob {
    fn rattle(self, h: f64) -> Bob {
        let gravity = Vector2::new(0.0, -1.0);
        // a − c q of unit length with c = ½h²λ: the smaller root of c² − 2c a·q + |a|² − 1 = 0
        let a = self.place + self.velocity * h + gravity * (0.5 * h * h);
        let along = a.dot(&self.place);
        let place = a - self.place * (along - (along * along - a.norm_squared() + 1.0).sqrt());
        let free = (place - self.place) / h + gravity * (0.5 * h);
        Bob { place, velocity: free - place * place.dot(&free) }
    }

    fn triple_jump(self, h: f64) -> Bob {
        let gamma = 1.0 / (2.0 - 2f64.cbrt());
        self.rattle(gamma * h).rattle((1.0 - 2.0 * gamma) * h).rattle(gamma * h)
    }

    /// The state at t = 1 after the given number of steps.
    fn reached(step: impl Fn(Bob, f64) -> Bob, steps: usize) -> Vector4<f64> {
        let start = Bob { place: Vector2::new(1.0, 0.0), velocity: Vector2::zeros() };
        let end = (0..steps).fold(start, |bob, _| step(bob, 1.0 / steps as f64));
        Vector4::new(end.place.x, end.place.y, end.velocity.x, end.velocity.y)
    }
}

fn slope(step: impl Fn(Bob, f64) -> Bob) -> Result<f64> {
    let level = |steps: usize| Refinement {
        time_step: 1.0 / steps as f64,
        error: (Bob::reached(&step, steps) - Bob::reached(&step, 2 * steps)).norm(),
    };
    Ok(fit_order([16, 32, 64, 128].map(level).to_vec())?.slope)
}

fn order(reading: Reading) -> Result<Vec<Finding>> {
    let (rattle, composed) = (slope(Bob::rattle)?, slope(Bob::triple_jump)?);
    Ok(vec![
        // high is what is above the orders 1 and 2 that the chapter calls low
        Finding::equal("order of RATTLE", reading.only(0).pick(rattle, composed), 2.0, ORDER_GAP, "1").experiment().says_at_least(3.0),
        Finding::equal("order of the triple jump of RATTLE", reading.only(1).pick(composed, rattle), 4.0, ORDER_GAP, "1").experiment(),
    ])
}
