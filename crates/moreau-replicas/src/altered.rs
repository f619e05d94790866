//! Moreau–Jean with one mistake, under the checks of schemes that share no code with one another: the closed forms of a ball, the energy
//! balance of every step, and the agreements of the system.

use crate::energy_balance::{Balance, Taken};
use crate::systems::{Measured, on_a_ball, on_a_slope};
use moreau_checks::Finding;
use moreau_checks::defects::schemes::{Alteration, PLANTED};
use moreau_checks::defects::{energy, zeno};
use moreau_checks::planted::Family;
use moreau_contact::solvers::Auto;
use moreau_dynamics::mechanics::spatial::{Shape, SpatialBody};
use moreau_dynamics::mechanics::{Mechanism, Plane, PointMass, SpatialBodies, State};
use moreau_dynamics::schemes::{Activation, MoreauJean, RestitutionRule, step};
use moreau_exact::Result;
use moreau_exact::scalar::exact;
use nalgebra::dvector;

/// Alterations of Moreau–Jean.
pub static SCHEMES: Family<Alteration> = Family {
    reference: Alteration::NONE,
    checks: &[
        ("properties/energy", |mistake| energy::family(&mistake.of(energy::judged()))),
        ("properties/zeno", |mistake| zeno::family(&mistake.of(zeno::judged()))),
        ("properties/energy-balance", balance),
        ("systems/Moreau–Jean: velocity after each step of a bouncing ball, three activation rules", ball),
        ("systems/Moreau–Jean: position of a ball through all impacts to rest, h = 1/1024 s", |mistake| {
            let right = MoreauJean::default();
            Ok(vec![held(on_a_ball::drop_to_rest(&mistake.of(right), &right)?, "m")])
        }),
        ("systems/Moreau–Jean: speed of a block sliding down a slope", |mistake| {
            Ok(vec![held(on_a_slope::sliding_speed(&mistake.of(MoreauJean::default()))?, "m/s")])
        }),
        ("systems/Moreau–Jean: creep of a block that sticks", |mistake| {
            Ok(vec![held(on_a_slope::creep(&mistake.of(MoreauJean::default()))?, "m/s")])
        }),
    ],
    planted: PLANTED,
};

fn held(measured: Measured, unit: &'static str) -> Finding {
    Finding::at_most("difference", measured.difference, measured.expectation.tolerance, unit)
}

fn ball(mistake: &Alteration) -> Result<Vec<Finding>> {
    let of = |activation| {
        let scheme = mistake.of(MoreauJean { theta: 0.3, activation, restitution: RestitutionRule::NormalOnly });
        let measured = on_a_ball::velocities(&scheme, |ball, now, h| ball.moreau_jean(now, &exact(0.3), activation, h).motion)?;
        Ok(held(measured, "m/s"))
    };
    Activation::ALL.into_iter().map(of).collect()
}

/// Steps of a balance.
const STEPS: usize = 60;

/// A ball of 2 kg that falls, bounces and slides, and a box thrown on its edge: the balance of every step.
fn balance(mistake: &Alteration) -> Result<Vec<Finding>> {
    let ball = PointMass::ball_on_floor(2.0, 9.81, 0.5);
    let dropped = State { time: 0.0, position: dvector![0.1], velocity: dvector![-1.0] };
    let body = SpatialBody::solid("box", Shape::Box { half_extents: [0.3, 0.1, 0.2] }, 2.0)?;
    let ground = Plane::new(dvector![0.0, 0.0, 1.0], 0.0, 0.6, 0.5)?;
    let thrown = SpatialBodies::new("thrown box", vec![body], [0.0, 0.0, -9.81], ground)?;
    let position = dvector![0.0, 0.0, 0.35, 0.8, 0.6, 0.0, 0.0];
    let tumbling = State { time: 0.0, position, velocity: dvector![1.0, -0.5, -2.0, 4.0, -3.0, 5.0] };
    let mut findings = steps(mistake, &ball, dropped)?;
    findings.extend(steps(mistake, &thrown, tumbling)?);
    Ok(findings)
}

fn steps(mistake: &Alteration, mechanism: &dyn Mechanism, mut state: State) -> Result<Vec<Finding>> {
    let right = MoreauJean::default();
    let (scheme, balance, h) = (mistake.of(right), Balance::of_moreau_jean(&right), 0.01);
    let mut findings = Vec::new();
    for _ in 0..STEPS {
        let made = step(&scheme, &Auto, mechanism, &state, h)?;
        findings.extend(balance.judge(&Taken { mechanism, before: &state, step: &made, h })?.findings);
        state = made.state;
    }
    Ok(findings)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn moreau_jean_itself_passes_and_every_check_catches_a_mistake() {
        assert_eq!(SCHEMES.failing(&SCHEMES.reference).expect("simulated"), Vec::new());
        let caught: Vec<_> = SCHEMES.trials().flat_map(|trial| (trial.caught_by)().expect("simulated")).collect();
        for (check, _) in SCHEMES.checks {
            assert!(caught.iter().any(|caught| caught.check == *check), "{check} catches nothing");
        }
    }
}
