//! Gap, contact Jacobian, generalised contact force, Delassus operator, impulses.

use crate::claims::prelude::*;
use crate::contact::delassus::delassus;
use crate::elimination::solve;
use crate::exact_particle::{Ball, BallState, BallStep};
use crate::mechanics::planar::{PlanarBody, Shape};
use crate::mechanics::{Mechanism, PlanarBodies, Plane, PointMass, State};
use crate::schemes::{Activation, MoreauJean, Scheme, StewartTrinkle, step};
use crate::solvers::LemkePivoting;
use crate::tolerance::{mechanics, rounding};
use num_traits::Zero;

pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S0.signorini",
        statement: r"$0 \le \varphi \perp \lambda_n \ge 0$: a positive distance means no force, a force means zero distance.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: "As stated. Of the discretisations, Stewart–Trinkle imposes it on the linearised gap at the end of a step; \
            Moreau–Jean imposes a velocity-level law instead.",
        argument: r"$\varphi\lambda = 0$ with both factors $\ge 0$ leaves only these cases. A ball stepped by Stewart–Trinkle in rationals
            from several states satisfies $\varphi^+\,r = 0$ exactly, and $r > 0$ where the free step ends below the floor.",
        controls: &[
            r"A Moreau–Jean step with $e = 1/2$, which ends with $\varphi^+ > 0$ and $r > 0$.",
            "A step that does not see the floor.",
        ],
        sources: &["chapter §0, opening"],
        check: check!(signorini),
    },
    Claim {
        id: "S0.phidot",
        statement: r"$\dot\varphi = J\,v$ with $J = \nabla\varphi$; $J\,v > 0$ means separation, $J\,v < 0$ approach.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Certified,
        correct_statement: r"As stated where $v = \dot q$. With quaternions $\dot q = N(q)v$ and $J = \nabla\varphi\,N(q)$.",
        argument: r"Chain rule. For the corners of a tilted box over the ground the central difference of the gap along the motion agrees
            with $J\,v$, rotation included, and so does its sign.",
        controls: &[r"$J$ without its column for the rotation."],
        sources: &["chapter §0, gap function and contact Jacobian"],
        check: check!(gap_rate),
    },
    Claim {
        id: "S0.JT",
        statement: r"By virtual work a contact force $\lambda$ acts as the generalised force $J^T\lambda$.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Certified,
        correct_statement: "As stated.",
        argument: r"$\lambda\cdot(Jv) = (J^T\lambda)\cdot v$ for all $v$. For a force at the corner of a tilted box, $J^T\lambda$ is the
            force and its moment about the centre of mass, computed from the corner's place.",
        controls: &[r"The pseudo-inverse $J^T(JJ^T)^{-1}$ in place of $J^T$."],
        sources: &["chapter §0, contact Jacobian"],
        check: check!(virtual_work),
    },
    Claim {
        id: "S0.delassus-ij",
        statement: r"$W = J\,M^{-1}J^T$: entry $ij$ is the velocity change at contact $j$ caused by a unit impulse at contact $i$.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"As stated; $W$ is symmetric, so the order of the indices does not matter.",
        argument: r"Three balls of 1, 2 and 4 kg in line: a unit impulse at the first contact changes $u$ by $(3/2, -1/2)$, one at the
            second by $(-1/2, 3/4)$, in rationals, with $M\,\Delta v = J^Te_i$ solved by elimination.",
        controls: &[r"$J\,M\,J^T$."],
        sources: &["chapter §0, several contacts"],
        check: check!(unit_impulses),
    },
    Claim {
        id: "S0.impulse-unit",
        statement: r"The unknowns of Moreau–Jean and of Stewart–Trinkle are impulses (N·s); in lasting contact $P \approx \lambda\,h$.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Certified,
        correct_statement: r"As stated; for a body at rest $P = m\,g\,h$ exactly.",
        argument: r"A 2 kg ball at rest under both schemes: $P/(m\,g\,h) = 1$, and halving $h$ halves $P$.",
        controls: &[r"A ball that arrives at 1 m/s, whose impulse does not halve with $h$."],
        sources: &["chapter §0 and §3"],
        check: check!(impulses),
    },
];

fn signorini(reading: Reading) -> Result<Vec<Finding>> {
    let ball = Ball { mass: ratio(1, 1), gravity: ratio(981, 100), restitution: reading.only(0).pick(ratio(0, 1), ratio(1, 2)) };
    let h = ratio(1, 100);
    let (mut product, mut smallest, mut held, mut below) = (Rational::zero(), Rational::zero(), 0usize, 0usize);
    for position in [ratio(0, 1), ratio(1, 200), ratio(1, 2)] {
        for velocity in [ratio(-2, 1), ratio(-1, 10), ratio(0, 1), ratio(1, 1)] {
            let now = BallState { position: position.clone(), velocity };
            let reached = &now.position + &h * (&now.velocity - &h * &ball.gravity);
            let (impulse, height) = match reading {
                Reading::Recorded => taken(ball.stewart_trinkle(&now, &h)),
                Reading::Control(0) => taken(ball.moreau_jean(&now, &ratio(1, 1), Activation::FreeVelocityForecast, &h)),
                Reading::Control(_) => (Rational::zero(), reached.clone()),
            };
            below += usize::from(reached < Rational::zero());
            held += usize::from(impulse > Rational::zero());
            product += (&height * &impulse).magnitude();
            smallest = smallest.min(impulse).min(height);
        }
    }
    Ok(vec![
        Finding::exact("sum of φ⁺ r over 12 steps", &product, &Rational::zero(), "m·N·s"),
        Finding::exact("smallest of all φ⁺ and r, or 0", &smallest, &Rational::zero(), "m, N·s"),
        Finding::count("steps with an impulse, against those whose free step ends below the floor", held, below),
    ])
}

/// Impulse and height at the end of a step.
fn taken(step: BallStep<Rational>) -> (Rational, Rational) {
    (step.impulse, step.motion.position)
}

/// A box of half extents (0.3, 0.2) m and 1.5 kg, turned by 0.4 rad, over the ground; and its velocity.
fn tilted_box() -> Result<(PlanarBodies, State)> {
    let body = PlanarBody::solid("box", Shape::Box { half_extents: [0.3, 0.2] }, 1.5)?;
    let ground = Plane::new(dvector![0.0, 1.0], 0.0, 0.5, 0.0)?;
    let state = State { time: 0.0, position: dvector![0.1, 0.4, 0.4], velocity: dvector![0.3, -0.2, 1.1] };
    Ok((PlanarBodies::new("tilted box", vec![body], [0.0, -9.81], ground)?, state))
}

fn gap_rate(reading: Reading) -> Result<Vec<Finding>> {
    let (mechanism, State { position, velocity, .. }) = tilted_box()?;
    let h = mechanics::DIFFERENCE_STEP;
    let gaps = |time: f64| mechanism.contacts(&mechanism.integrate(&position, &velocity, time));
    let bound = mechanics::central_difference(velocity.norm(), position.norm() + 1.0);
    let (mut findings, mut wrong) = (Vec::new(), 0);
    for (k, contact) in mechanism.contacts(&position).iter().enumerate() {
        let mut normal = contact.jacobian.row(0);
        normal[2] *= reading.pick(1.0, 0.0);
        let rate = (normal * &velocity)[0];
        let difference = (gaps(h)[k].gap - gaps(-h)[k].gap) / (2.0 * h);
        findings.push(Finding::equal(format!("J v of corner {k} against dφ/dt"), rate, difference, bound, "m/s"));
        wrong += usize::from((gaps(h)[k].gap > contact.gap) != (rate > 0.0));
    }
    findings.push(Finding::count("corners that separate with J v ≤ 0, or approach with J v > 0", wrong, 0));
    Ok(findings)
}

fn virtual_work(reading: Reading) -> Result<Vec<Finding>> {
    let (mechanism, State { position, velocity, .. }) = tilted_box()?;
    let jacobian = &mechanism.contacts(&position)[0].jacobian.to_dense();
    let (normal_force, friction_force) = (7.0, -2.0);
    let reaction = dvector![normal_force, friction_force];
    let square = jacobian * jacobian.transpose();
    let weighted = square.lu().solve(&reaction).ok_or_else(|| Error::Unsupported("J has independent rows".into()))?;
    let generalised = jacobian.transpose() * reading.pick(reaction, weighted);
    // the corner (−0.3, −0.2) of the body, turned about ŷ by θ: (a cos θ + b sin θ, b cos θ − a sin θ)
    let (s, c) = position[2].sin_cos();
    let arm = [-0.3 * c - 0.2 * s, -0.2 * c + 0.3 * s];
    let moment = arm[1] * friction_force - arm[0] * normal_force;
    let corner_velocity = [velocity[0] + velocity[2] * arm[1], velocity[1] - velocity[2] * arm[0]];
    let power = friction_force * corner_velocity[0] + normal_force * corner_velocity[1];
    let bound = rounding(16, 10.0);
    Ok(vec![
        Finding::equal("moment about the centre of mass", generalised[2], moment, bound, "N·m"),
        Finding::equal("force along the ground", generalised[0], friction_force, bound, "N"),
        Finding::equal("force across the ground", generalised[1], normal_force, bound, "N"),
        Finding::equal("power of the generalised force", generalised.dot(&velocity), power, bound, "W"),
    ])
}

fn unit_impulses(reading: Reading) -> Result<Vec<Finding>> {
    let r = |x: i64| ratio(x, 1);
    let mass = DMatrix::from_diagonal(&DVector::from_vec(vec![r(1), r(2), r(4)]));
    let jacobian = DMatrix::from_row_slice(2, 3, &[-1, 1, 0, 0, -1, 1].map(r));
    let w = reading.pick(delassus(&mass, &jacobian)?, &jacobian * &mass * jacobian.transpose());
    let mut findings = Vec::new();
    for i in 0..2 {
        let change = solve(&mass, &jacobian.row(i).transpose()).ok_or_else(|| Error::invalid("mass", "is singular", "use masses > 0"))?;
        let response = &jacobian * change;
        for j in 0..2 {
            findings.push(Finding::exact(format!("W[{i}, {j}] against Δu_{j} of a unit impulse at {i}"), &w[(i, j)], &response[j], "1/kg"));
        }
    }
    Ok(findings)
}

fn impulses(reading: Reading) -> Result<Vec<Finding>> {
    let (coarse, fine) = (1.0 / 64.0, 1.0 / 128.0);
    let schemes: [(&str, &dyn Scheme); 2] =
        [("Moreau–Jean", &MoreauJean::default()), ("Stewart–Trinkle", &StewartTrinkle { directions: 4 })];
    let bound = rounding(8, 2.0);
    let mut findings = Vec::new();
    for (name, scheme) in schemes {
        let unknown = |h: f64| impulse_on_the_floor(scheme, reading.pick(0.0, -1.0), h);
        findings.push(Finding::equal(format!("{name}: unknown at h over that at h/2"), unknown(coarse)? / unknown(fine)?, 2.0, bound, "1"));
        let scaled = unknown(coarse)? / (2.0 * 9.81 * coarse);
        findings.push(Finding::equal(format!("{name}: P/(m g h) at rest"), scaled, 1.0, bound, "1"));
    }
    Ok(findings)
}

/// The impulse of one step of a 2 kg ball on the floor, which it has reached at this velocity.
fn impulse_on_the_floor(scheme: &dyn Scheme, velocity: f64, h: f64) -> Result<f64> {
    let ball = PointMass::ball_on_floor(2.0, 9.81, 0.5);
    let now = State { time: 0.0, position: dvector![0.0], velocity: dvector![velocity] };
    let taken = step(scheme, &LemkePivoting, &ball, &now, h)?;
    taken.impulses.first().map(|impulse| impulse.impulse[0]).ok_or_else(|| Error::Unsupported("the ball touches the floor".into()))
}
