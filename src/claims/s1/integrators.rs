//! Which integrators simulators have.

use crate::claims::experiments::runge_kutta;
use crate::claims::lookups;
use crate::claims::prelude::*;
use crate::tolerance::claims::ORDER_GAP;
use crate::trajectory::{Refinement, fit_order};

pub const CLAIMS: &[Claim] = &[Claim {
    id: "S1.mujoco-euler",
    statement: "MuJoCo uses the semi-implicit Euler rule, of first order.",
    verdict: ClaimVerdict::True,
    kind: Kind::Assertion,
    severity: None,
    evidence: Evidence::Cited,
    correct_statement: "As stated: by default, as the chapter's list of defaults says. It also has implicit, implicitfast, RK4 and, in \
        newer versions, discrete; §6 of the chapter names two of them.",
    argument: r"Asked of the pinned release, 3.17.0: the default integrator is number 0, and Euler has the number 0. Semi-implicit Euler
        on $\ddot q = -4q$, error of $q$ at 2 s for $h = 2^{-6}$ … $2^{-9}$ s: order 1.",
    controls: &["RK4, another integrator of MuJoCo."],
    sources: &["chapter §1 and the list of defaults at its end", "MuJoCo 3.17.0, answers in references/facts/mujoco.json"],
    check: check!(integrators),
}];

fn stiffness(q: f64) -> f64 {
    -4.0 * q
}

fn semi_implicit_euler([q, v]: [f64; 2], h: f64) -> [f64; 2] {
    let velocity = v + h * stiffness(q);
    [q + h * velocity, velocity]
}

fn integrators(reading: Reading) -> Result<Vec<Finding>> {
    type Method = fn([f64; 2], f64) -> [f64; 2];
    let fourth: Method = |state, h| runge_kutta::step(&stiffness, state, h);
    let method = reading.pick(semi_implicit_euler as Method, fourth);
    let level = |exponent: i32| {
        let steps = 1usize << (exponent + 1);
        let time_step = 2.0 / steps as f64;
        let [end, _] = (0..steps).fold([1.0, 0.0], |state, _| method(state, time_step));
        Refinement { time_step, error: (end - 4f64.cos()).abs() }
    };
    let mut findings = lookups::check("S1.mujoco-euler", reading)?;
    findings.push(Finding::equal("its order", fit_order((6..=9).map(level).collect())?.slope, 1.0, ORDER_GAP, "1").experiment());
    Ok(findings)
}
