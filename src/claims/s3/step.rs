//! One step: which velocity moves the body, where restitution enters, and what the unknown is.

use crate::claims::prelude::*;
use crate::contact::delassus::{MassFactor, delassus};
use crate::exact_particle::{Ball, BallState};
use crate::mechanics::{Mechanism, OscillatorWithStop, PointMass, State};
use crate::problem::Lcp;
use crate::schemes::{Activation, MoreauJean, RestitutionRule, assembled, step};
use crate::solvers::LemkePivoting;
use crate::solvers::lemke::{LemkeOutcome, lemke};
use crate::tolerance::rounding;
use num_traits::{One, Zero};

pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S3.explicit-bad",
        statement: r"Naive explicit Euler: with $q^+ = q + h\,v$ and the old velocity $v$, the contact force acts too late and the body
            has already penetrated.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"With $\theta = 0$ the impulse of a step cannot change the position at its end; penetration follows whenever
            $q + h\,v < 0$.",
        argument: r"$q = 1/100$ m, $v = -2$ m/s, $h = 1/50$ s: $q^+ = q + h\,v = -3/100$ m although the step's impulse $r = 2$ N·s stops
            the ball ($v^+ = 0$). With $\theta = 1$ the same impulse gives $q^+ = 1/100$ m.",
        controls: &[
            r"The same step with the new velocity, $\theta = 1$.",
            r"Activation by $\varphi \le 0$, with which no impulse acts in this step.",
        ],
        sources: &["chapter §3, “what goes wrong with a naive discretisation”"],
        check: check!(explicit_position),
    },
    Claim {
        id: "S3.mj-condition",
        statement: r"At every active contact $0 \le U = H(v^+ + e\,v) \perp P \ge 0$.",
        verdict: ClaimVerdict::True,
        kind: Kind::Definition,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"This is the definition of the scheme's contact law; $U^+ = H\,v^+$ itself need not be complementary to $P$.",
        argument: r"Three balls of 1, 2 and 4 kg in line at velocities 3, 0, −1 m/s, both contacts closed, $e = 1/2$: Lemke in rationals
            gives $P$, and $U = H(v^+ + e\,v)$ is zero where $P > 0$.",
        controls: &[r"Restitution on the wrong side, the complementarity of $H(v^+ - e\,v)$.", "Balls that part."],
        sources: &["chapter §3, step 3 of the θ scheme"],
        check: check!(complementarity),
    },
    Claim {
        id: "S3.newton-embedded",
        statement: r"The argument $v^+ + e\,v$ embeds Newton's impact law $v^+ = -e\,v^-$.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Certified,
        correct_statement: r"$U_n^+ = -e\,U_n$ holds exactly at contacts with $P > 0$, and $U_n$ is the velocity at the start of the step,
            which differs from the velocity at the impact by at most $g\,h$ in free fall. At a contact with $P = 0$ the law is the
            inequality $U_n^+ \ge -e\,U_n$.",
        argument: r"$e = 1/2$, $h = 1/100$ s, $q = 1/200$ m, $v = -1$ m/s: $v^+ = 1/2$ exactly, while the ball reaches the floor faster
            than it started, so that $v^+$ differs from $e$ times that by $0.024 \le e\,g\,h = 0.049$ m/s. A rod of unit mass and inertia
            on two supports ½ and 1 m from its centre, on one side, $W = \begin{bmatrix}5/4 & 3/2 \\ 3/2 & 2\end{bmatrix}$, approaches
            them at 1 and 1/10 m/s: the first impulse lifts the second support, which takes no impulse and leaves with 17/10 m/s, not with
            $e$ times its approach.",
        controls: &["The rod that approaches both at 1 and 5/4 m/s, where both impulses act.", r"The argument $v^+$, without $e\,v$."],
        sources: &["chapter §3, step 3 of the θ scheme"],
        check: check!(newton_law),
    },
    Claim {
        id: "S3.ufree",
        statement: r"Step 4: solve for $v^+$ ($F$ explicit or linearised for the moment), with $v_\text{free}$ the velocity of this step
            without contact, and insert it into $U = H(v^+ + e\,v)$: an LCP in $P$ with $W = H\,M^{-1}H^T$ (the formulas of
            $v_\text{free}$ and $U_\text{free}$ are not legible in the source; exercise 1 asks for $U_\text{free}$).",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Certified,
        correct_statement: r"With $v_\text{free} = v + h\,M^{-1}F$: $U = W\,P + U_\text{free}$, $U_\text{free} = H(v_\text{free} + e\,v) =
            (1 + e)\,H\,v + h\,H\,M^{-1}F$, exact for an explicit force. For a linearised implicit force $-Kq - Cv$, $M$ is replaced by
            $\hat M = M + h\theta C + h^2\theta^2K$, in $W$ and in $v_\text{free}$ alike.",
        argument: r"$m = 1$ kg, $k = 100$ N/m, $h = 1/10$ s, $\theta = 1/2$: a unit impulse changes $v^+$ of the implicit step by
            $1/(1 + h^2\theta^2k) = 4/5$ m/s, not by $1/m = 1$ m/s.",
        controls: &[
            "The explicit step of the spring in place of the implicit one.",
            r"A ball of 1 kg without restitution in place of one of 2 kg with $e = 1/2$.",
        ],
        sources: &["chapter §3, step 4 and exercise 1"],
        check: check!(free_velocity),
    },
    Claim {
        id: "S3.P-force",
        statement: r"The unknown $P$ is an impulse in N·s; taking it for a force is off by the factor $1/h$.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Certified,
        correct_statement: r"A resting body has $P = m\,g\,h$; $P/h = m\,g$ is the force.",
        argument: r"Resting 2 kg block at $h = 1/64$ and 1/128 s: $P$ halves with $h$ while $P/h$ stays $m\,g = 19.62$ N.",
        controls: &[r"A block that lands at 1 m/s: its impulse does not halve with $h$, nor is it $m\,g\,h$."],
        sources: &["chapter §3, common pitfalls"],
        check: check!(impulse_scales_with_the_step),
    },
];

/// Gravity of the exact examples, 9.81 m/s².
fn gravity() -> Rational {
    ratio(981, 100)
}

fn explicit_position(reading: Reading) -> Result<Vec<Finding>> {
    let theta = reading.only(0).pick(ratio(0, 1), ratio(1, 1));
    let rule = reading.only(1).pick(Activation::FreeVelocityForecast, Activation::Gap);
    let ball = Ball { mass: ratio(1, 1), gravity: ratio(0, 1), restitution: ratio(0, 1) };
    let start = BallState { position: ratio(1, 100), velocity: ratio(-2, 1) };
    let outcome = ball.moreau_jean(&start, &theta, rule, &ratio(1, 50));
    Ok(vec![
        Finding::exact("position at the end of the step", &outcome.motion.position, &ratio(-3, 100), "m"),
        Finding::exact("impulse of the step", &outcome.impulse, &ratio(2, 1), "N·s"),
    ])
}

fn complementarity(reading: Reading) -> Result<Vec<Finding>> {
    let r = |x: i64| ratio(x, 1);
    let mass = DMatrix::from_diagonal(&DVector::from_vec(vec![r(1), r(2), r(4)]));
    let jacobian = DMatrix::from_row_slice(2, 3, &[r(-1), r(1), r(0), r(0), r(-1), r(1)]);
    let before = DVector::from_vec(reading.only(1).pick(vec![r(3), r(0), r(-1)], vec![r(-1), r(0), r(3)]));
    let restitution = ratio(1, 2);
    let imposed = reading.only(0).pick(restitution.clone(), -restitution.clone());
    let lcp = Lcp::new(delassus(&mass, &jacobian)?, &jacobian * &before * (Rational::one() + imposed));
    let LemkeOutcome::Solution { z: impulse, .. } = lemke(&lcp, &DVector::from_element(2, r(1)))? else {
        return Err(Error::breakdown("lemke", "a positive definite problem has a solution"));
    };
    let after = &before + MassFactor::new(&mass)?.solve(&(jacobian.transpose() * &impulse));
    let law = &jacobian * (&after + &before * restitution);
    let smallest = |x: &DVector<Rational>| x.iter().min().cloned().unwrap_or_else(Rational::zero);
    Ok(vec![
        Finding::exact("P · H(v⁺ + e v)", &impulse.dot(&law), &Rational::zero(), "J"),
        Finding::decision("U ≥ 0 and P ≥ 0", smallest(&law) >= Rational::zero() && smallest(&impulse) >= Rational::zero(), true),
        Finding::decision("an impulse acts", impulse.iter().any(|p| *p > Rational::zero()), true),
    ])
}

fn newton_law(reading: Reading) -> Result<Vec<Finding>> {
    let (e, h) = (ratio(1, 2), ratio(1, 100));
    let imposed = reading.only(1).pick(e.clone(), Rational::zero());
    let ball = Ball { mass: ratio(1, 1), gravity: gravity(), restitution: imposed.clone() };
    let falling = BallState { position: ratio(1, 200), velocity: ratio(-1, 1) };
    let impact = ball.moreau_jean(&falling, &ratio(1, 1), Activation::FreeVelocityForecast, &h).motion.velocity;
    let speed = (1.0 + 2.0 * 9.81 / 200.0f64).sqrt();
    let late = (Scalar::to_f64(&impact) - 0.5 * speed).abs();
    let rod = DMatrix::from_row_slice(2, 2, &[ratio(5, 4), ratio(3, 2), ratio(3, 2), ratio(2, 1)]);
    let before = DVector::from_vec(vec![ratio(-1, 1), reading.only(0).pick(ratio(-1, 10), ratio(-5, 4))]);
    let lcp = Lcp::new(rod.clone(), &before * (Rational::one() + imposed));
    let LemkeOutcome::Solution { z: impulse, .. } = lemke(&lcp, &DVector::from_element(2, ratio(1, 1)))? else {
        return Err(Error::breakdown("lemke", "a positive definite problem has a solution"));
    };
    let after = &before + rod * impulse;
    Ok(vec![
        Finding::exact("v⁺ against −e v", &impact, &-(&e * &falling.velocity), "m/s"),
        Finding::at_most("distance from −e times the velocity at the impact", late, 0.5 * 9.81 / 100.0, "m/s"),
        Finding::exact("U⁺ of the rod's first support", &after[0], &ratio(1, 2), "m/s"),
        Finding::exact("U⁺ + e U⁻ of its second support", &(&after[1] + &e * &before[1]), &ratio(33, 20), "m/s")
            .says(Rational::zero())
            .violating("P > 0 at the contact"),
        Finding::exact("U⁺ of the second support, which takes no impulse", &after[1], &ratio(17, 10), "m/s").context(),
    ])
}

/// The library's assembly against the θ step solved by hand for v⁺(P).
fn free_velocity(reading: Reading) -> Result<Vec<Finding>> {
    let (h, theta) = (ratio(1, 10), ratio(1, 2));
    let (mass, stiffness) = (ratio(1, 1), ratio(100, 1));
    // m (v⁺ − v) = −h k (q + hθ(θ v⁺ + (1−θ) v)) + P is linear in v⁺ with slope 1/(m + h²θ²k) in P
    let response = mass.clone() / (mass.clone() + &h * &h * &theta * &theta * &stiffness);
    let oscillator = OscillatorWithStop::new(1.0, 100.0, 0.0, 0.0, 0.5)?;
    let implicit = posed(&oscillator, 0.5, dvector![0.0], dvector![-1.0])?;
    let explicit = posed(&oscillator, 0.0, dvector![0.0], dvector![-1.0])?;
    let operator = reading.only(0).pick(implicit.0, explicit.0);
    let (mass, restitution) = reading.only(1).pick((2.0, 0.5), (1.0, 0.0));
    let (falling_operator, law_velocity) = posed(&PointMass::ball_on_floor(mass, 9.81, restitution), 0.5, dvector![0.0], dvector![-1.0])?;
    let bound = |size: f64| rounding(8, size);
    Ok(vec![
        Finding::equal("velocity change of a unit impulse, implicit spring", operator, Scalar::to_f64(&response), bound(1.0), "1/kg")
            .says(1.0)
            .violating("a force that does not depend on v⁺"),
        Finding::equal("W for the explicit force", falling_operator, 0.5, bound(0.5), "1/kg"),
        Finding::equal("U_free = (1+e) v + h F/m for the explicit force", law_velocity, -1.5 - 0.981, bound(3.0), "m/s"),
    ])
}

/// W and U_free = u_free + shift of the only contact, at h = 1/10 s.
fn posed(mechanism: &dyn Mechanism, theta: f64, position: DVector<f64>, velocity: DVector<f64>) -> Result<(f64, f64)> {
    let scheme = MoreauJean { theta, activation: Activation::Gap, restitution: RestitutionRule::NormalOnly };
    let problem = assembled(&scheme, mechanism, &State { time: 0.0, position, velocity }, 0.1)?.problem;
    let problem = problem.ok_or_else(|| Error::Unsupported("the contact is closed, so the step has a problem".into()))?;
    Ok((problem.entry(0, 0), problem.free_velocity()[0] + problem.shift()[0]))
}

fn impulse_scales_with_the_step(reading: Reading) -> Result<Vec<Finding>> {
    let (coarse, fine) = (1.0 / 64.0, 1.0 / 128.0);
    let unknown = |h: f64| impulse_on_the_floor(h, reading.pick(0.0, -1.0));
    let bound = rounding(8, 2.0);
    Ok(vec![
        Finding::equal("unknown at h over unknown at h/2", unknown(coarse)? / unknown(fine)?, 2.0, bound, "1"),
        Finding::equal("P/h", unknown(coarse)? / coarse, 2.0 * 9.81, rounding(8, 20.0), "N"),
    ])
}

/// The normal impulse of a 2 kg block on a level floor that has this velocity upwards.
fn impulse_on_the_floor(h: f64, upwards: f64) -> Result<f64> {
    let block = PointMass::block_on_incline(2.0, 9.81, 0.0, 0.5, 0.0);
    let state = State { time: 0.0, position: dvector![0.0, 0.0], velocity: dvector![0.0, upwards] };
    let taken = step(&MoreauJean::default(), &LemkePivoting, &block, &state, h)?;
    taken.impulses.first().map(|impulse| impulse.impulse[0]).ok_or_else(|| Error::Unsupported("the block touches the floor".into()))
}
