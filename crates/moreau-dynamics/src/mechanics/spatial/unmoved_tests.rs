//! Bodies that nothing moves: their masses are infinite, their motion is what it was.

use crate::scenes::{Body, Prescribed, Scene, named};
use crate::schemes::{MoreauJean, StepContext, Waist, simulate};
use moreau_contact::solvers::Auto;
use moreau_contact::tolerance::certificate::CERTIFY;
use moreau_exact::tolerance::rounding;

const GRAVITY: f64 = 9.81;

/// A box on a belt that runs with this velocity \[m/s\] along x, μ = 0.25.
fn on_a_belt(velocity: f64) -> Scene {
    let mut scene = named("box-stack").expect("built in");
    scene.ground = None;
    scene.material.friction = 0.25;
    let load = Body::cuboid("load", 2.0, [0.2, 0.2, 0.05], [0.0, 0.0, 0.05 - 1.0 / 1_048_576.0]);
    scene.bodies = vec![load, Body::cuboid("belt", 1.0, [4.0, 1.0, 0.5], [0.0, 0.0, -0.5]).driven([velocity, 0.0, 0.0])];
    scene
}

#[test]
fn the_load_of_a_belt_slips_with_mu_g_and_then_has_its_velocity_and_the_belt_keeps_it() {
    let (velocity, h) = (0.5, 1.0 / 256.0);
    let (mechanism, start) = on_a_belt(velocity).spatial_mechanism().expect("valid");
    let motion = simulate(&MoreauJean::default(), &Auto, mechanism.as_ref(), start, h, 100).expect("it moves");
    for state in &motion.samples {
        let bodies = mechanism.bodies(&state.position, &state.velocity);
        // Σ p_t = μ Σ p_n, also where rounding lets it fall for a step
        let expected = (0.25 * (GRAVITY * state.time + bodies[0].linear_velocity[2])).min(velocity);
        assert!(
            (bodies[0].linear_velocity[0] - expected).abs() <= 1e-8,
            "{} instead of {expected} at {}",
            bodies[0].linear_velocity[0],
            state.time
        );
        assert_eq!(bodies[1].linear_velocity, [velocity, 0.0, 0.0], "to the last bit");
        assert!((bodies[1].position[0] - velocity * state.time).abs() <= rounding(100, 1.0));
    }
}

#[test]
fn w_of_a_contact_with_an_unmoved_body_is_that_of_the_other_one_alone() {
    let scene = on_a_belt(1.0);
    let (mechanism, start) = scene.spatial_mechanism().expect("valid");
    let step = MoreauJean::default().assemble(&StepContext::new(mechanism.as_ref(), &start, 0.01).expect("valid")).expect("valid");
    let problem = step.problem.expect("it touches");
    let rows = step.jacobian.to_dense();
    let own = rows.columns(0, 6);
    let inverse = mechanism.mass(&start.position).to_dense().view((0, 0), (6, 6)).map(|m| if m > 0.0 { 1.0 / m } else { 0.0 });
    let expected = own * inverse * own.transpose();
    assert!((problem.dense().clone() - &expected).amax() <= rounding(64, expected.amax()));
    assert!(problem.dynamics().is_none(), "M is no matrix of numbers");
    // all rows see the belt come with −1 m/s along x, less what gravity does in the step
    let seen = rows.columns(6, 6) * start.velocity.rows(6, 6);
    assert!(seen.iter().any(|u| u.abs() == 1.0), "{seen}");
}

#[test]
fn unmoved_bodies_have_no_contact_with_each_other_and_none_with_the_ground_and_no_energy() {
    let mut scene = on_a_belt(1.0);
    scene.ground = named("box-stack").expect("built in").ground;
    scene.bodies[1].prescribed = Some(Prescribed { velocity: [1.0, 0.0, 0.0], angular_velocity: [0.0, 0.0, 2.0] });
    scene.bodies.push(Body::sphere("rock", 1.0, 0.5, [1.0, 0.0, 0.0]).fixed());
    let (mechanism, start) = scene.spatial_mechanism().expect("valid");
    let contacts = mechanism.contacts(&start.position);
    assert!(contacts.iter().all(|contact| contact.place.expect("bodies").bodies.0 == 0), "only the load touches anything");
    assert!(
        mechanism.contacts_between(&start.position, (1, None)).is_empty()
            && mechanism.contacts_between(&start.position, (1, Some(2))).is_empty()
    );
    assert_eq!(
        (mechanism.kinetic_energy(&start), mechanism.potential_energy(&start.position)),
        (0.0, 2.0 * GRAVITY * (0.05 - 1.0 / 1_048_576.0))
    );
    let later = mechanism.integrate(&start.position, &start.velocity, 0.25);
    let turned = &mechanism.bodies(&later, &start.velocity)[1];
    assert!((turned.orientation[3] - 0.25f64.sin()).abs() <= rounding(8, 1.0), "half of 2 rad/s · 0.25 s about z");
}

#[test]
fn a_scheme_that_computes_with_the_mass_itself_refuses_with_the_cure() {
    let (mechanism, start) = on_a_belt(1.0).spatial_mechanism().expect("valid");
    let refused = simulate(&crate::schemes::Variational, &Auto, mechanism.as_ref(), start, 0.01, 1);
    assert!(refused.expect_err("no matrix").to_string().contains("`moreau-jean`"));
}

/// μ g h a step, as long as it slides, and the belt's speed afterwards; what is planted is a belt of finite mass, which would be braked.
#[test]
fn generalised_alpha_carries_a_load_on_a_belt_whose_velocity_is_prescribed() {
    let (mechanism, start) = on_a_belt(1.0).spatial_mechanism().expect("valid");
    let scheme = crate::schemes::GeneralisedAlpha::default();
    let run = simulate(&scheme, &Auto, mechanism.as_ref(), start, 0.01, 200).expect("steps");
    let speeds = |step: usize| [run.samples[step].velocity[0], run.samples[step].velocity[6]];
    assert!((speeds(1)[0] - 0.25 * GRAVITY * 0.01).abs() <= CERTIFY, "{}", speeds(1)[0]);
    assert!((speeds(200)[0] - 1.0).abs() <= CERTIFY && speeds(200)[1] == 1.0, "{:?}", speeds(200));
}
