//! Energy of the θ scheme without contact: work of the mean force, and what θ adds.
//!
//! ```text
//!     ΔT = h · ½(v⁺ + v)·F_θ = h v_θ·F_θ − (θ − ½) h² F_θᵀM⁻¹F_θ         (every θ, every force)
//!     constant force:   Δ(T + V) = −(θ − ½) h² FᵀM⁻¹F
//!     linear spring:    E⁺/E = (1 + (1−θ)²h²ω²)/(1 + θ²h²ω²)
//! ```

use crate::claims::experiments::pendulum::Swing;
use crate::claims::experiments::theta_energy::{energy_change_under, pendulum_energy_change};
use crate::claims::experiments::theta_step::{LinearSystem, Phase, coupled_pair, phase};
use crate::claims::prelude::*;
use crate::tolerance::claims::theta_scheme::pendulum_energy;
use num_traits::Zero;

pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S3.energy-half",
        statement: r"$\theta = 1/2$, no contact: $\Delta E_\text{kin} = h\,v_{1/2}^TF$, exactly the work of the force.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"As stated; with the mean velocity $\tfrac12(v^+ + v)$ and the scheme's own force $F_\theta$ the identity
            holds for every $\theta$.",
        argument: r"$\Delta T = \tfrac12(v^+ + v)^TM(v^+ - v) = \tfrac12(v^+ + v)^T\,h\,F_\theta$, and $v_{1/2} = \tfrac12(v^+ + v)$.
            Residual zero in rationals for two coupled masses on springs under a constant force, $\theta = 0$, 1/4, 1/2, 1.",
        controls: &[r"$v_\theta$ at $\theta = 1$ in place of $v_{1/2}$."],
        sources: &["chapter §3, energy estimate, and exercise 2"],
        check: check!(work_of_the_force),
    },
    Claim {
        id: "S3.energy-neutral",
        statement: r"$\theta = 1/2$: $\Delta E_\text{kin} = h\,v_{1/2}^TF$, exactly the work of the force, hence energy neutral (no
            numerical dissipation, no injection), the analogue of the discrete conservation of energy of symplectic and symmetric
            integrators.",
        verdict: ClaimVerdict::Ambiguous,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Certified,
        correct_statement: r"The kinetic energy changes by the work of the scheme's force. Kinetic plus potential energy is conserved
            exactly for constant and linear forces only; for a nonlinear force the error per step is $O(h^3)$, of either sign.",
        argument: r"“Neutral” as the name of the printed identity: its residual is zero in rationals for two coupled masses. “Neutral” of
            kinetic plus potential energy: for gravity and springs the change is exactly 0 over 100 steps; for the pendulum the
            trapezoidal rule changes $E$ by the error of trapezoidal quadrature, $(q^+ - q)^3 \sin(\xi)/12$ with $\xi$ between $q$ and
            $q^+$: from $(1.3, 0.7)$ 2.2e-5, 3.1e-6, 4.1e-7 at $h = 0.1$, 0.05, 0.025 – small, and not zero.",
        controls: &["A spring in place of the pendulum.", r"$\theta = 1$."],
        sources: &["chapter §3, energy estimate and table of θ"],
        check: check!(neutral),
    },
    Claim {
        id: "S3.energy-one",
        statement: r"$\theta = 1$ adds $-(h^2/2)\|F\|_{M^{-1}}^2 < 0$ to the work $h\,v_\theta\cdot F$ in the change of the kinetic energy
            in one step: numerical dissipation $O(h^2)$.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Exact,
        correct_statement: r"The identity holds for every force: $\Delta T = h\,v^+\cdot F - \tfrac12h^2F^TM^{-1}F$. It is a dissipation
            of total energy where the potential is convex, per step, so $O(h)$ over a fixed time; where it is concave $\theta = 1$ gains
            energy.",
        argument: r"$\Delta T = h\cdot\tfrac12(v^+ + v)\cdot F$ and $\tfrac12(v^+ + v) = v^+ - \tfrac12hM^{-1}F$. In rationals for a fall,
            a spring and two coupled masses. Free fall of 1 kg for 1 s at $h = 1/1000$ s loses
            $\tfrac12\,m\,g^2\,h\,T = (981/100)^2/2000 = 0.04811805$ J exactly. A spring with $h\omega = 1/2$ keeps 4/5 of its energy in a
            step. On the hill $\ddot q = q$, $E = \tfrac12v^2 - \tfrac12q^2$, a step of $h = 1/2$ from $q = 0$ at $v = 1$ gains 1/6 J.",
        controls: &[r"$\theta = 1/2$, whose term is zero."],
        sources: &["chapter §3, energy estimate, and exercise 2"],
        check: check!(backward_euler),
    },
    Claim {
        id: "S3.theta-mid",
        statement: r"Table, smooth phase, $\theta$ in $(1/2, 1)$: intermediate dissipation.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Exact,
        correct_statement: r"The loss carries the factor $2\theta - 1$ between 0 at $\theta = 1/2$ and 1 at $\theta = 1$, for a constant
            force; a spring loses a fraction that grows with $\theta$. Where the potential is concave every $\theta > 1/2$ gains energy.",
        argument: r"Free fall: loss at $\theta = 3/4$ over loss at $\theta = 1$ is exactly 1/2. Spring with $h\omega = 1/2$:
            $E^+/E = 65/73$ at 3/4, between 1 and 4/5. On the hill $\ddot q = q$, $E = \tfrac12v^2 - \tfrac12q^2$, a step of $h = 1/2$
            with $\theta = 3/4$ from $q = 0$ at $v = 1$ gains 4/55 J.",
        controls: &[r"$\theta = 1/4$, outside the interval: it gains energy."],
        sources: &["chapter §3, table of θ"],
        check: check!(between),
    },
];

fn work_of_the_force(reading: Reading) -> Result<Vec<Finding>> {
    let theta = reading.pick(ratio(1, 2), ratio(1, 1));
    let mut findings = vec![Finding::exact("ΔT − h v_θ·F_θ", &work_residual(&theta, &theta), &Rational::zero(), "J")];
    for theta in [ratio(0, 1), ratio(1, 4), ratio(1, 1)] {
        let left = work_residual(&theta, &reading.pick(ratio(1, 2), theta.clone()));
        findings.push(Finding::exact(format!("ΔT − h ½(v⁺ + v)·F_θ, θ = {theta}"), &left, &Rational::zero(), "J"));
    }
    Ok(findings)
}

/// ΔT − h v_w·F_θ of two coupled masses, with v_w = v + w (v⁺ − v).
fn work_residual(theta: &Rational, weight: &Rational) -> Rational {
    let (system, start) = coupled_pair();
    let h = ratio(1, 10);
    let (next, force) = system.step(&start, theta, &h);
    let mean = &start.velocity + (&next.velocity - &start.velocity) * weight.clone();
    system.kinetic_energy(&next) - system.kinetic_energy(&start) - mean.dot(&force) * &h
}

fn neutral(reading: Reading) -> Result<Vec<Finding>> {
    let theta = reading.only(1).pick(ratio(1, 2), ratio(1, 1));
    let (identity, total) = ("neutral as the name of the identity", "neutral of kinetic plus potential energy");
    let mut findings = vec![
        Finding::exact("ΔE_kin − h v_θ·F of coupled masses", &work_residual(&theta, &theta), &Rational::zero(), "J").reading(identity),
        Finding::exact("energy change under gravity and springs", &energy_change_under(&theta), &Rational::zero(), "J").reading(total),
    ];
    for (h, exact) in [(0.1, ratio(1, 10)), (0.05, ratio(1, 20)), (0.025, ratio(1, 40))] {
        let swing = Swing { angle: 1.3, rate: 0.7 };
        let next = swing.step(h);
        let cube = (next.angle - swing.angle).powi(3) / 12.0;
        let spring_change = step_change(&spring(), &phase(ratio(1, 1), ratio(1, 3)), &ratio(1, 2), &exact).0;
        let change = reading.only(0).pick(pendulum_energy_change(h), Scalar::to_f64(&spring_change));
        let centre = 0.5 * cube * (swing.angle.sin() + next.angle.sin());
        let half_width = 0.5 * cube * (next.angle.sin() - swing.angle.sin()).abs();
        let name = format!("energy change of a pendulum in a step, h = {h}");
        findings.push(Finding::equal(name, change, centre, half_width + pendulum_energy(), "J").says(0.0).reading(total));
    }
    Ok(findings)
}

/// Energy change of one step.
fn step_change(system: &LinearSystem, start: &Phase, theta: &Rational, h: &Rational) -> (Rational, Rational) {
    let (next, force) = system.step(start, theta, h);
    (system.energy(&next) - system.energy(start), system.inverse_mass_norm(&force))
}

fn fall() -> LinearSystem {
    LinearSystem::scalar(ratio(1, 1), ratio(0, 1), ratio(-981, 100))
}

/// The condition that the text omits.
const CONVEX: &str = "a potential that is convex";

/// Energy gained in a step of h = 1/2 on the hill q̈ = q from q = 0 at v = 1.
fn gain_on_a_hill(theta: &Rational) -> Rational {
    let hill = LinearSystem::scalar(ratio(1, 1), ratio(-1, 1), ratio(0, 1));
    step_change(&hill, &phase(ratio(0, 1), ratio(1, 1)), theta, &ratio(1, 2)).0
}

/// hω = 1/2 at h = 1/4.
fn spring() -> LinearSystem {
    LinearSystem::scalar(ratio(1, 1), ratio(4, 1), ratio(0, 1))
}

fn backward_euler(reading: Reading) -> Result<Vec<Finding>> {
    let theta = reading.pick(ratio(1, 1), ratio(1, 2));
    let h = ratio(1, 4);
    let start = || phase(ratio(1, 1), ratio(1, 3));
    let (coupled, moving) = coupled_pair();
    let mut findings = Vec::new();
    for (name, system, start) in [("a fall", fall(), start()), ("a spring", spring(), start()), ("coupled masses", coupled, moving)] {
        let (next, force) = system.step(&start, &theta, &h);
        let velocity = &start.velocity + (&next.velocity - &start.velocity) * theta.clone();
        let added = system.kinetic_energy(&next) - system.kinetic_energy(&start) - velocity.dot(&force) * &h;
        let term = -(&h * &h * system.inverse_mass_norm(&force)) / ratio(2, 1);
        findings.push(Finding::exact(format!("ΔT − h v_θ·F over −½h²F·M⁻¹F, {name}"), &(added / term), &ratio(1, 1), "1"));
    }
    let mut now = phase(ratio(1, 1), ratio(0, 1));
    let before = fall().energy(&now);
    for _ in 0..1000 {
        now = fall().step(&now, &theta, &ratio(1, 1000)).0;
    }
    let lost = fall().energy(&now) - before;
    findings.push(Finding::exact("energy change of a fall of 1 s, h = 1/1000 s", &lost, &ratio(-962_361, 20_000_000), "J"));
    findings.push(Finding::exact("E⁺/E on a spring, θ = 1, hω = 1/2", &spring_ratio(&theta), &ratio(4, 5), "1"));
    let gain = Finding::exact("energy gained on the hill q̈ = q, θ = 1, h = 1/2", &gain_on_a_hill(&theta), &ratio(1, 6), "J");
    findings.push(gain.says_at_most(ratio(0, 1)).violating(CONVEX));
    Ok(findings)
}

fn spring_ratio(theta: &Rational) -> Rational {
    let start = phase(ratio(1, 1), ratio(1, 3));
    let next = spring().step(&start, theta, &ratio(1, 4)).0;
    spring().energy(&next) / spring().energy(&start)
}

fn between(reading: Reading) -> Result<Vec<Finding>> {
    let theta = reading.pick(ratio(3, 4), ratio(1, 4));
    let start = phase(ratio(1, 1), ratio(0, 1));
    let loss = |theta: &Rational| step_change(&fall(), &start, theta, &ratio(1, 4)).0;
    let spring = spring_ratio(&theta);
    Ok(vec![
        Finding::exact("loss in free fall over that of θ = 1", &(loss(&theta) / loss(&ratio(1, 1))), &ratio(1, 2), "1"),
        Finding::decision(
            "E⁺/E on a spring lies between that of θ = 1 and 1",
            spring > spring_ratio(&ratio(1, 1)) && spring < ratio(1, 1),
            true,
        ),
        Finding::exact("E⁺/E on a spring at θ = 3/4, hω = 1/2", &spring, &ratio(65, 73), "1"),
        Finding::exact("energy gained on the hill q̈ = q, θ = 3/4, h = 1/2", &gain_on_a_hill(&theta), &ratio(4, 55), "J")
            .says_at_most(ratio(0, 1))
            .violating(CONVEX),
    ])
}
