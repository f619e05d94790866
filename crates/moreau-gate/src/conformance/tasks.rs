//! Probes of the levels `solve` and `project`: sizes, order, conventions.

use crate::conformance::{Probes, Seen, demand, problem, refused, skipped};
use crate::tolerance::conformance::{PROJECTION, SOLUTION};
use crate::{Description, Engine, Level, Options};
use moreau_contact::problem::{ContactProblem, Law};
use nalgebra::{DMatrix, DVector};

/// μ of the probes.
const FRICTION: f64 = 0.5;

pub(super) fn probe_all(engine: &mut dyn Engine, description: &Description, probes: &mut Probes) {
    if description.levels.contains(&Level::Solve) {
        let demand = "impulse and velocity are ordered (normal, tangent 1, tangent 2), and u = W r + u_free";
        probes.ask("solve/conventions", demand, || solve(engine, description));
    }
    if description.levels.contains(&Level::Project) {
        let demand = "points are (n, t…) in the same order as asked, projected on ‖t‖ ≤ μ n";
        probes.ask("project/conventions", demand, || project(engine));
    }
}

/// Two bodies of 1 kg and 2 kg that meet the ground, one after the other, with a shift as restitution gives it.
fn problem_with(law: Law) -> ContactProblem {
    let friction = if law == Law::Frictionless { 0.0 } else { FRICTION };
    ContactProblem::new(
        DMatrix::from_diagonal(&DVector::from_vec(vec![1.0, 1.0, 1.0, 0.5, 0.5, 0.5])),
        DVector::from_vec(vec![-2.0, 0.25, 0.0, -1.0, 0.0, -0.125]),
    )
    .name("two balls")
    .law(law)
    .friction(vec![friction; 2])
    .shift(DVector::from_vec(vec![-1.0, 0.0, 0.0, 0.0, 0.0, 0.0]))
    .build()
    .expect("two balls are a contact problem")
}

fn law(description: &Description) -> Option<Law> {
    description.laws.iter().find_map(|name| match name.as_str() {
        "coulomb" => Some(Law::Coulomb),
        "associated" => Some(Law::Associated),
        "frictionless" => Some(Law::Frictionless),
        "polyhedral-coulomb" => Some(Law::PolyhedralCoulomb { directions: 4 }),
        "polyhedral-associated" => Some(Law::PolyhedralAssociated { directions: 4 }),
        _ => None,
    })
}

fn solve(engine: &mut dyn Engine, description: &Description) -> Seen {
    let law = law(description).ok_or_else(|| skipped("`laws` names no known law"))?;
    let problem = problem_with(law);
    let mut ask = || engine.solve(&problem, &Options::new()).map_err(refused);
    let solution = ask()?;
    for contact in 0..2 {
        let normal = solution.impulse[3 * contact];
        let tangent = solution.impulse.rows(3 * contact + 1, 2).norm();
        let why = || format!("contact {contact} has normal impulse {normal} and tangential impulse {tangent}");
        // the four directions of a pyramid reach √2 beyond the cone
        let inside = normal > 0.0 && tangent <= std::f64::consts::SQRT_2 * FRICTION * normal * (1.0 + SOLUTION);
        demand(inside, why, "order the entries contact by contact, the normal first; a positive normal impulse pushes apart")?;
    }
    let product = problem.velocity(&solution.impulse);
    let scale = product.norm().max(solution.velocity.norm());
    let off = (&product - &solution.velocity).norm();
    let why = || format!("`velocity` differs from W r + u_free by {off:.3} m/s");
    demand(off <= SOLUTION * scale, why, "report u = W r + u_free: without `shift`, after the impulses")?;
    let again = ask()?;
    demand(again == solution, || "the same request, repeated, gives another solution".into(), "start every request from the same guess")
}

fn project(engine: &mut dyn Engine) -> Seen {
    // inside, in the polar cone, outside; for the last, n = (n₀ + μ t₀)/(1 + μ²) by hand, (1 + ½·3)/(5/4) = 2
    for (tangents, ends) in [(1, "(n, t)"), (2, "(n, t₁, t₂)")] {
        let row = |normal: f64, tangent: f64| if tangents == 1 { vec![normal, tangent] } else { vec![normal, 0.0, tangent] };
        let asked = [row(1.0, 0.25), row(-2.0, 0.5), row(1.0, 3.0)];
        let expected = [row(1.0, 0.25), row(0.0, 0.0), row(2.0, 1.0)];
        let seen = engine.project(FRICTION, &asked, &Options::new()).map_err(refused)?;
        let off = seen.iter().flatten().zip(expected.iter().flatten()).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max);
        if off > PROJECTION {
            let why = format!("the projections of {asked:?} are {seen:?} instead of {expected:?}");
            return Err(problem(why, format!("project rows {ends} on ‖t‖ ≤ μ n in the Euclidean metric, μ = `friction`")));
        }
    }
    Ok(())
}
