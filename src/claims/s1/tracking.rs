//! Event-driven methods: where they are defined, and what many contacts cost them.

use crate::claims::experiments::painleve::rod;
use crate::claims::prelude::*;
use crate::closed_forms::BouncingBall;
use crate::event_driven::EventDriven;
use crate::mechanics::planar::{PlanarBody, Shape};
use crate::mechanics::{PainleveRod, PlanarBodies, Plane, PointMass, State};
use crate::problem::Lcp;
use crate::solvers::Auto;
use crate::solvers::enumeration::all_solutions;
use crate::tolerance::claims::events::ACCURACY;

pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S1.ed-undefined",
        statement: "Event-driven methods are mathematically undefined at Zeno accumulations and at Painlevé's paradox.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Certified,
        correct_statement: r"Before an accumulation of impacts every time is reached after finitely many events; beyond it the method is
            defined by a continuation rule, or not at all. At Painlevé's paradox the contact forces between events do not exist or are not
            unique, for $\mu > \mu_P$ only, and there the method is undefined.",
        argument: r"The ball with $e = 4/5$ has 10 impacts until $9/10\,T_\infty$ and 21 until 99/100. With the declared rule, a bounce
            shorter than $2^{-20}$ s is plastic, the method agrees with the closed form before and after $T_\infty$. Rod at cos $= 3/5$,
            $\mu = 2$: $0 \le \lambda \perp -(4/5)\lambda + b \ge 0$ has no solution for $b = -1$ and two for $b = 1$; the method stops
            and says so. With $\mu = 1$ it goes on.",
        controls: &[r"The rod with $\mu = 1 < \mu_P = 13/9$.", r"A livelier ball, $e = 9/10$."],
        sources: &["chapter §1, history and table", "Champneys and Várkonyi, The Painlevé paradox in contact mechanics (2016)"],
        check: check!(undefined),
    },
    Claim {
        id: "S1.scale",
        statement: r"Event-driven methods are acceptable for up to about ten contacts, time-stepping scales well to $10^6$.",
        verdict: ClaimVerdict::Ambiguous,
        kind: Kind::Opinion,
        severity: None,
        evidence: Evidence::NotDecidable,
        correct_statement: "“Acceptable” and “well” are judgements, and no number is a limit. What can be said: the work of an \
            event-driven method grows with the number of events, which contacts add up; \
            that of a time-stepping method with the number of steps, which they do not.",
        argument: r"Twelve balls over one floor, dropped from different heights with $e = 4/5$: the event-driven method meets the sum of
            their impacts, as many events as the closed forms count, and stays within $10^{-10}$ of them. One ball alone meets its own.",
        controls: &[r"A floor with $e = 1/2$ in the simulation."],
        sources: &["chapter §1, table and bridge to robotics"],
        check: check!(many_contacts),
    },
];

/// Number of impacts of a ball until the share p of 9 t₁, the T∞ of e = 4/5: exactly.
fn impacts_until(share: &Rational, restitution: &Rational) -> usize {
    let end = share * ratio(9, 1);
    let (mut time, mut flight, mut count) = (ratio(1, 1), ratio(2, 1), 0);
    while time <= end {
        count += 1;
        flight *= restitution;
        time += &flight;
    }
    count
}

fn undefined(reading: Reading) -> Result<Vec<Finding>> {
    let friction = reading.only(0).pick(2, 1);
    let restitution = reading.only(1).pick(ratio(4, 5), ratio(9, 10));
    let system = rod(ratio(friction, 1), ratio(0, 1));
    let inverse = |k: usize| ratio(1, 1) / &system.mass[k];
    let product =
        |a: usize, b: usize| (0..3).fold(ratio(0, 1), |sum, k| sum + &system.jacobian[(a, k)] * &system.jacobian[(b, k)] * inverse(k));
    let slope = product(0, 0) + ratio(friction, 1) * product(0, 1);
    let forces = |b: i64| all_solutions(&Lcp::new(DMatrix::from_element(1, 1, slope.clone()), DVector::from_element(1, ratio(b, 1))));
    let mut findings = vec![
        Finding::count("sliding forces of the rod for b = −1", forces(-1)?.points.len(), 0),
        Finding::count("sliding forces of the rod for b = +1", forces(1)?.points.len(), 2),
    ];
    let body = PainleveRod::new(1.0, 1.0, 9.81, friction as f64, 0.0)?;
    let start = State { time: 0.0, position: dvector![0.0, 0.8, 0.8f64.atan2(0.6)], velocity: dvector![-1.0, 0.0, 0.0] };
    let refused = EventDriven::default().advance(&Auto, &body, &start, 1.0 / 64.0).is_err();
    findings.push(Finding::decision("the event-driven method stops at the rod", refused, true));
    findings.push(Finding::count("impacts until 9/10 of T∞", impacts_until(&ratio(9, 10), &restitution), 10));
    findings.push(Finding::count("impacts until 99/100 of T∞", impacts_until(&ratio(99, 100), &restitution), 21));
    let [before, near, beyond] = through_the_accumulation(reading.only(1).pick(0.8, 0.9))?;
    let passes = beyond.holds();
    findings.extend([before, near, beyond.context()]);
    findings.push(
        Finding::decision("with a rule of continuation the method passes T∞", passes, true).says(false).violating("no rule continues it"),
    );
    Ok(findings)
}

/// A bouncing ball before and after the T∞ of e = 4/5 against the closed form of that ball.
fn through_the_accumulation(restitution: f64) -> Result<[Finding; 3]> {
    let exact = BouncingBall::new(9.81, 1.0, 0.8)?;
    let ball = PointMass::ball_on_floor(1.0, 9.81, restitution);
    let start = State { time: 0.0, position: dvector![1.0], velocity: dvector![0.0] };
    let compare = |share: f64| -> Result<Finding> {
        let time = share * exact.accumulation_time();
        let end = EventDriven::default().advance(&Auto, &ball, &start, time)?.state;
        let (q, v) = exact.state(time);
        let error = (end.position[0] - q).abs().max((end.velocity[0] - v).abs());
        Ok(Finding::at_most(format!("error of q [m] and v [m/s] at {share} T∞"), error, ACCURACY, "1"))
    };
    Ok([compare(0.5)?, compare(0.9)?, compare(1.1)?])
}

/// Disks that fall onto one floor, far apart.
fn rain(count: usize, restitution: f64) -> Result<(PlanarBodies, State)> {
    let disk = |k: usize| PlanarBody::solid(format!("disk{k}"), Shape::Disk { radius: 0.1 }, 1.0);
    let bodies = (0..count).map(disk).collect::<Result<Vec<_>>>()?;
    let floor = Plane::new(dvector![0.0, 1.0], 0.0, 0.0, restitution)?;
    let mechanism = PlanarBodies::new("rain", bodies, [0.0, -9.81], floor)?;
    let places = (0..count).flat_map(|k| [k as f64, 0.1 + height(k), 0.0]);
    let position = DVector::from_iterator(3 * count, places);
    Ok((mechanism, State { time: 0.0, velocity: DVector::zeros(3 * count), position }))
}

/// Height of the k-th drop \[m\].
fn height(k: usize) -> f64 {
    1.0 + k as f64 / 16.0
}

fn many_contacts(reading: Reading) -> Result<Vec<Finding>> {
    const TIME: f64 = 1.5;
    let mut findings = Vec::new();
    for count in [12usize, 1] {
        let (mechanism, start) = rain(count, reading.pick(0.8, 0.5))?;
        let motion = EventDriven::default().advance(&Auto, &mechanism, &start, TIME)?;
        let balls = (0..count).map(|k| BouncingBall::new(9.81, height(k), 0.8)).collect::<Result<Vec<_>>>()?;
        let impacts: Vec<usize> = balls.iter().map(|ball| ball.impacts_until(TIME).unwrap_or(0)).collect();
        let point = "what is acceptable and what scales well";
        findings.push(Finding::count(format!("events of {count} balls until 1.5 s"), motion.events, impacts.iter().sum()).opinion(point));
        let error = balls.iter().enumerate().map(|(k, ball)| (motion.state.position[3 * k + 1] - 0.1 - ball.state(TIME).0).abs());
        findings.push(Finding::at_most(format!("error of the heights of {count} balls"), error.fold(0.0, f64::max), ACCURACY, "m"));
    }
    Ok(findings)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scalar::Scalar;

    #[test]
    fn the_impacts_before_a_share_of_the_accumulation_time_are_those_of_the_closed_form() {
        let ball = BouncingBall::new(9.81, 1.0, 0.8).expect("valid");
        for share in [ratio(9, 10), ratio(99, 100)] {
            let time = Scalar::to_f64(&share) * ball.accumulation_time();
            assert_eq!(ball.impacts_until(time), Some(impacts_until(&share, &ratio(4, 5))));
        }
    }
}
