//! The problems of each check.

use crate::checks::solver::problems::{Does, Solved, bar, corners, plate, point, solved, tower};
use moreau_contact::problem::Law;
use moreau_exact::Result;

const STICK: Does = Does::Stick { push: 2.0, part: 0.5 };
const SLIDE: Does = Does::Slide { push: 1.5, speed: 0.75 };
const OPEN: Does = Does::Open { apart: 0.5, speed: 0.25 };

/// One contact of a point mass in two and three dimensions: it sticks, slides, opens, and does so with a shift of both signs.
pub(super) fn small(law: Law) -> Result<Vec<Solved>> {
    let mut problems = Vec::new();
    for spatial in [false, true] {
        for (name, does) in
            [("stick", STICK), ("slide", SLIDE), ("open", OPEN), ("stick at the limit", Does::Stick { push: 1.0, part: 1.0 })]
        {
            for shift in [0.0, 0.625, -0.375] {
                let (mass, jacobian) = point(1.0, &[[0.0, 1.0]], spatial);
                problems.push(solved(&format!("a point: {name}, shift {shift}"), law, (&mass, &jacobian), 0.5, &[does], shift)?);
            }
        }
    }
    Ok(problems)
}

/// Plates on four corners and on eight contacts: sticking under uneven loads, sliding, and tipping over an edge.
pub(super) fn redundant(law: Law) -> Result<Vec<Solved>> {
    let (a, b, c) = (0.5, 0.25, 0.125);
    let four = plate([a, b, c], &corners(a, b));
    let middles = [[a, 0.0], [0.0, -b], [-a, 0.0], [0.0, b]];
    let eight = plate([a, b, c], &[corners(a, b), middles].concat());
    let uneven = [4.0, 1.0, 2.0, 0.5].map(|push| Does::Stick { push, part: 0.5 });
    let sliding = [4.0, 1.0, 2.0, 0.5].map(|push| Does::Slide { push, speed: 0.75 });
    // Turning about the edge x = a at 0.5 rad/s: the other corners rise by 2 a · 0.5.
    let tipping = [STICK, STICK, Does::Open { apart: 1.0 * a, speed: 0.0 }, Does::Open { apart: 1.0 * a, speed: 0.0 }];
    let feet = [-0.5, -0.25, 0.25, 0.5];
    let planar = bar([0.5, 0.125], &feet);
    let pose = |name, (mass, jacobian): &(_, _), contacts: &[Does], shift| solved(name, law, (mass, jacobian), 0.5, contacts, shift);
    Ok(vec![
        pose("a plate on four corners", &four, &uneven, 0.0)?,
        pose("a plate sliding on four corners", &four, &sliding, 0.0)?,
        pose("a plate tipping over an edge", &four, &tipping, 0.0)?,
        pose("a plate on eight contacts", &eight, &[uneven, uneven].concat(), -0.25)?,
        pose("a plate sliding on eight contacts", &eight, &[sliding, sliding].concat(), 0.0)?,
        pose("a bar on four feet", &planar, &uneven, 0.25)?,
        pose("a bar sliding on four feet", &planar, &sliding, 0.0)?,
    ])
}

/// A point between two parallel walls, between the walls of a wedge, and between four.
pub(super) fn jamming(law: Law) -> Result<Vec<Solved>> {
    let walls: [(&str, &[[f64; 2]]); 3] = [
        ("parallel walls", &[[1.0, 0.0], [-1.0, 0.0]]),
        ("a wedge", &[[0.96, 0.28], [-0.96, 0.28]]),
        ("four walls", &[[0.96, 0.28], [-0.96, 0.28], [0.8, -0.6], [-0.8, -0.6]]),
    ];
    let mut problems = Vec::new();
    for spatial in [false, true] {
        for mu in [0.25, 1.0, 4.0] {
            for (name, normals) in walls {
                let (mass, jacobian) = point(2.0, normals, spatial);
                let contacts: Vec<Does> =
                    (0..normals.len()).map(|k| Does::Stick { push: 1.0 + k as f64, part: 0.75 - 0.5 * k as f64 }).collect();
                problems.push(solved(&format!("a point between {name}, μ = {mu}"), law, (&mass, &jacobian), mu, &contacts, 0.0)?);
            }
        }
    }
    Ok(problems)
}

/// A flat plate on four corners, once sticking and once sliding. It is so flat that a c μ < I/m + a² for every friction coefficient. So
/// friction never lifts the load, and there is no Painlevé paradox.
pub(super) fn friction_range(law: Law) -> Result<Vec<Solved>> {
    let (a, b, c) = (1.0, 0.5, 1.0 / 16.0);
    let mut problems = Vec::new();
    for mu in [0.0, 1.0 / 1024.0, 0.1, 0.5, 1.0, 2.0, 5.0, 10.0] {
        let (mass, jacobian) = plate([a, b, c], &corners(a, b));
        for (name, does) in [("resting", STICK), ("sliding", SLIDE)] {
            problems.push(solved(&format!("a plate {name}, μ = {mu}"), law, (&mass, &jacobian), mu, &[does; 4], 0.0)?);
        }
    }
    Ok(problems)
}

/// W with condition numbers up to 10¹².
pub(super) fn ill_conditioned(law: Law) -> Result<Vec<Solved>> {
    let (a, b, c) = (0.5, 0.25, 0.125);
    let mut problems = Vec::new();
    for apart in [0.01, 0.0001, 0.000_001] {
        let (mass, jacobian) = plate([a, b, c], &[[a, b], [a - apart, b], [-a, b], [0.0, -b]]);
        let name = format!("contacts {apart} m apart");
        problems.push(solved(&name, law, (&mass, &jacobian), 0.5, &[STICK, STICK, Does::Stick { push: 1.0, part: -0.5 }, STICK], 0.0)?);
    }
    for ratio in [10.0, 1000.0] {
        let (mass, jacobian) = tower(&[1.0, ratio]);
        let contacts = [Does::Stick { push: 1.0 + ratio, part: 0.5 }, Does::Stick { push: ratio, part: 0.25 }];
        problems.push(solved(&format!("{ratio} kg on 1 kg"), law, (&mass, &jacobian), 0.5, &contacts, 0.0)?);
    }
    let light = 1.0 / 1e12;
    let (mut mass, jacobian) = tower(&[1.0, 1.0]);
    // Side by side instead of on top of each other: each mass has the floor to itself.
    let jacobian = jacobian.map(|entry: f64| entry.max(0.0));
    mass.view_mut((3, 3), (3, 3)).scale_mut(light);
    let contacts = [STICK, Does::Slide { push: 1.0 * light, speed: 0.75 }];
    problems.push(solved("masses of 1 and 1e-12 kg", law, (&mass, &jacobian), 0.5, &contacts, 0.0)?);
    Ok(problems)
}
