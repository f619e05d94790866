//! Energy of the θ scheme and the unknown impulse, as the front matter and the tables put them.

use crate::claims::experiments::theta_energy::{chain_energies, distinct, pendulum_energy_change};
use crate::claims::experiments::theta_step::{LinearSystem, Phase, phase};
use crate::claims::prelude::*;
use crate::closed_forms::ElasticBall;
use crate::exact_particle::{Ball, BallState};
use crate::schemes::Activation;
use crate::tolerance::claims::theta_scheme::pendulum_energy;
use num_traits::Zero;

pub const PREFACE: &[Claim] = &[Claim {
    id: "P.modA",
    statement: r"Project, module A: $\theta = 0.5$ conserves the energy of an elastic collision chain, $\theta = 1$ dissipates.",
    verdict: ClaimVerdict::False,
    kind: Kind::Exercise,
    severity: Some(Severity::WrongStatement),
    evidence: Evidence::Certified,
    correct_statement: r"For elastic collisions under constant forces no $\theta$ drifts: without force the kinetic energy is constant,
        under gravity $E - (\theta - \tfrac12)\,m\,g\,h\,v$ is. $\theta = 1$ dissipates when springs (or other position-dependent forces)
        act. The half about $\theta = 0.5$ is right; the other is the mistake of S3.energy-runs-down, counted there.",
    argument: r"Three equal balls, $e = 1$, two collisions: the kinetic energy takes one value at $\theta = 1/2$ and one at $\theta = 1$.
        Elastic ball in rationals, $\theta = 1$, activation rules A, B, D (A: $\varphi \le 0$, B: $\varphi + \tfrac12hu \le 0$, D:
        $\varphi + h\,u_\text{free} \le 0$): the invariant of the closed form keeps its value over 300 steps. An oscillator loses
        $1 - (1 + h^2)^{-N}$ of its energy.",
    controls: &[r"$e = 1/2$ for the chain at $\theta = 1$ and for the ball.", r"$e = 1/2$ for the chain at $\theta = 1/2$."],
    sources: &["chapter, cumulative project, module A"],
    check: check!(elastic_chain),
}];

pub const MISCONCEPTIONS: &[Claim] = &[Claim {
    id: "M.force-vs-impulse",
    statement: r"A lasting contact force is a finite function, an impact is an atom of impulse; the unknown of time-stepping is the
        impulse $P$ throughout.",
    verdict: ClaimVerdict::True,
    kind: Kind::Assertion,
    severity: None,
    evidence: Evidence::Exact,
    correct_statement: "As stated.",
    argument: r"$m = 2$ kg, $g = 981/100$ m/s². Resting: $P = m\,g\,h$, so $P/h = m\,g$ at every $h$. Impact at −3 m/s with $e = 1/2$ and
        no force: $P = (1 + e)\,m \cdot 3 = 9$ N·s at every $h$, so $P/h$ grows like $1/h$.",
    controls: &[
        r"A ball at rest in the place of the impact: its impulse shrinks with $h$.",
        "A ball on its way up in the place of the one at rest: no contact lasts.",
    ],
    sources: &["chapter, table of misconceptions"],
    check: check!(force_or_atom),
}];

pub const TABLES: &[Claim] = &[Claim {
    id: "T.energy",
    statement: r"Table of theorems: $\theta = 1/2$ is energy neutral, $\theta = 1$ dissipates $O(h^2)$.",
    verdict: ClaimVerdict::Conditional,
    kind: Kind::Assertion,
    severity: Some(Severity::MissingHypothesis),
    evidence: Evidence::Certified,
    correct_statement: r"$\theta = 1/2$: the kinetic energy changes by the work of the scheme's force, and with the potential energy the
        sum is kept exactly for constant and linear forces, to $O(h^3)$ per step otherwise (S3.energy-neutral). $\theta = 1$ loses
        $\tfrac12h^2F^TM^{-1}F$ per step for a constant force – $O(h^2)$ per step, $O(h)$ over a fixed time – and loses energy where the
        potential is convex; where it is concave it can gain.",
    argument: r"Gravity and a spring, $\theta = 1/2$: change 0 in rationals; a pendulum with $h = 0.1$: 2.2e-5 J. Free fall, $\theta = 1$:
        halving $h$ divides the loss of a step by 4 and that of a fixed time by 2. On $\ddot q = q$, $h = 1/2$, from $q = 0$ with $v = 1$
        a step of $\theta = 1$ raises $\tfrac12v^2 - \tfrac12q^2$ by 1/6.",
    controls: &[
        r"$\ddot q = -q$ in the place of $\ddot q = q$: the potential is convex; a spring in the place of the pendulum.",
        r"$\theta = 1$ in the place of $\theta = 1/2$ on gravity and a spring.",
        "A fixed time in the place of a step.",
    ],
    sources: &["chapter, table of theorems", "chapter §3, energy estimate"],
    check: check!(theta_table),
}];

fn elastic_chain(reading: Reading) -> Result<Vec<Finding>> {
    let half = chain_energies(0.5, reading.only(1).pick(1.0, 0.5))?;
    let one = chain_energies(1.0, reading.only(0).pick(1.0, 0.5))?;
    let lost = 1.0 - one[one.len() - 1] / one[0];
    let mut findings = vec![
        // that it loses any: the least part that a rounded number can be short of one
        Finding::equal("part of its energy that the chain loses, θ = 1", lost, 0.0, 0.0, "1").says_at_least(f64::EPSILON / 2.0),
        Finding::count("distinct kinetic energies of the chain, θ = 1/2", distinct(&half), 1),
        Finding::count("distinct kinetic energies of the chain, θ = 1", distinct(&one), 1).says_at_least(2usize),
    ];
    let (theta, h) = (ratio(1, 1), ratio(1, 100));
    let ball = Ball { mass: ratio(1, 1), gravity: ratio(981, 100), restitution: reading.only(0).pick(ratio(1, 1), ratio(1, 2)) };
    let closed_form = ElasticBall { mass: ratio(1, 1), gravity: ratio(981, 100) };
    for activation in Activation::ALL {
        let mut now = BallState { position: ratio(1, 2), velocity: ratio(0, 1) };
        for _ in 0..300 {
            now = ball.moreau_jean(&now, &theta, activation, &h).motion;
        }
        let invariant = closed_form.discrete_invariant(&theta, &h, &now.position, &now.velocity);
        let name = format!("E − ½ m g h v falls over 300 steps, rule {}", activation.name());
        findings.push(Finding::decision(name, invariant < ratio(981, 200), false).says(true));
    }
    Ok(findings)
}

fn force_or_atom(reading: Reading) -> Result<Vec<Finding>> {
    let impulse = |gravity: Rational, velocity: Rational, h: &Rational| {
        let ball = Ball { mass: ratio(2, 1), gravity, restitution: ratio(1, 2) };
        ball.moreau_jean(&BallState { position: Rational::zero(), velocity }, &ratio(1, 1), Activation::Gap, h).impulse
    };
    let (coarse, fine) = (ratio(1, 100), ratio(1, 1000));
    let (gravity, arriving) = reading.only(0).pick((ratio(0, 1), ratio(-3, 1)), (ratio(981, 100), ratio(0, 1)));
    let impact = |h: &Rational| impulse(gravity.clone(), arriving.clone(), h);
    let resting = reading.only(1).pick(ratio(0, 1), ratio(1, 1));
    let rest = |h: &Rational| impulse(ratio(981, 100), resting.clone(), h) / h;
    Ok(vec![
        Finding::exact("unknown of an impact at h over that at h/10", &(impact(&coarse) / impact(&fine)), &ratio(1, 1), "1"),
        Finding::exact("impulse of the impact", &impact(&fine), &ratio(9, 1), "N·s"),
        Finding::exact("P/h at rest, h = 1/100 s", &rest(&coarse), &ratio(1962, 100), "N"),
        Finding::exact("P/h at rest, h = 1/1000 s", &rest(&fine), &ratio(1962, 100), "N"),
    ])
}

fn theta_table(reading: Reading) -> Result<Vec<Finding>> {
    let spring = LinearSystem::scalar(ratio(1, 1), ratio(4, 1), ratio(-981, 100));
    let change = |system: &LinearSystem, start: &Phase, theta: &Rational, h: &Rational| {
        system.energy(&system.step(start, theta, h).0) - system.energy(start)
    };
    let hanging = phase(ratio(1, 1), ratio(1, 3));
    let swung = match reading {
        Reading::Control(0) => Scalar::to_f64(&change(&spring, &hanging, &ratio(1, 2), &ratio(1, 10))),
        _ => pendulum_energy_change(0.1),
    };
    let of_spring = change(&spring, &hanging, &reading.only(1).pick(ratio(1, 2), ratio(1, 1)), &ratio(1, 10));
    let stiffness = reading.only(0).pick(ratio(-1, 1), ratio(1, 1));
    let climb =
        change(&LinearSystem::scalar(ratio(1, 1), stiffness, ratio(0, 1)), &phase(ratio(0, 1), ratio(1, 1)), &ratio(1, 1), &ratio(1, 2));
    let fall = LinearSystem::scalar(ratio(1, 1), ratio(0, 1), ratio(-981, 100));
    let loss = |steps: i64, h: Rational| {
        let mut now = phase(ratio(1, 1), ratio(0, 1));
        let before = fall.energy(&now);
        for _ in 0..steps {
            now = fall.step(&now, &ratio(1, 1), &h).0;
        }
        before - fall.energy(&now)
    };
    let (one_step, half_step) = (loss(1, ratio(1, 10)), loss(reading.only(2).pick(1, 2), ratio(1, 20)));
    let (one_second, same_second) = (loss(10, ratio(1, 10)), loss(20, ratio(1, 20)));
    Ok(vec![
        Finding::exact("energy change, θ = 1/2, gravity and a spring", &of_spring, &ratio(0, 1), "J"),
        Finding::at_least("energy change of a pendulum, θ = 1/2", swung, pendulum_energy(), "J")
            .says(0.0)
            .violating("the forces are constant or linear"),
        Finding::exact("θ = 1: loss of a step at h over h/2", &(one_step / half_step), &ratio(4, 1), "1"),
        Finding::exact("θ = 1: energy change of a step on q̈ = q", &climb, &ratio(1, 6), "J")
            .says_at_most(ratio(0, 1))
            .violating("the forces are constant, or the potential is convex"),
        Finding::exact("θ = 1: loss of a second at h over h/2", &(one_second / same_second), &ratio(2, 1), "1").context(),
    ])
}
