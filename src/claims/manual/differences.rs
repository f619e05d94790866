//! Row 7: another solver or simulator, another result.

use crate::claims::prelude::*;
use crate::claims::s5::planar_step::{Block, painleve_rod};
use crate::problem::{Law, Lcp};
use crate::solvers::enumeration::all_solutions;

pub(super) const CLAIMS: &[Claim] = &[Claim {
    id: "R7",
    statement: "Another solver or simulator gives another result: (a) simultaneous impacts, where the LCP's solution is not unique, (b) \
        different cones or relaxations, (c) gliding at large steps. Check whether there are simultaneous impacts (non-uniqueness is \
        normal), compare the schemes (§10); to reproduce, fix simulator, version, solver and step.",
    verdict: ClaimVerdict::Conditional,
    kind: Kind::Advice,
    severity: Some(Severity::MissingHypothesis),
    evidence: Evidence::Exact,
    correct_statement: "Without friction the impulses of a simultaneous impact may not be unique, but the velocities are: M is positive \
        definite. Two solvers of the same impact law agree in the motion; what differs is the law (simultaneous or one after another). \
        With friction velocities may differ too.",
    argument: "Body with M = 1 on four corners: W has the null vector (1, −1, 1, −1), the solutions of the LCP form a family, and all have \
        v⁺ = 0. Three equal balls, e = 1: the simultaneous LCP has one solution, v⁺ = (−1/3, 2/3, 2/3); pair by pair (0, 0, 1); both \
        conserve momentum and energy. Painlevé's rod with μ = 3: three solutions with three velocities. (b): a slide lifts with u_n = \
        μ|u_t| under the relaxation and 0 under Coulomb.",
    controls: &["Painlevé's rod in the place of the frictionless corners: with friction the velocities differ."],
    sources: &["chapter, troubleshooting manual, row 7"],
    check: differences,
}];

/// The velocities v = v_free + M⁻¹Hᵀr of these solutions, each once.
fn distinct(velocities: impl Iterator<Item = DVector<Rational>>) -> Vec<DVector<Rational>> {
    let mut distinct = Vec::new();
    for velocity in velocities {
        if !distinct.contains(&velocity) {
            distinct.push(velocity);
        }
    }
    distinct
}

/// The velocities and the number of vertices of the solution set when a body lands flat on its four corners.
fn four_corners() -> Result<(Vec<DVector<Rational>>, usize, bool)> {
    let rows = [[1, 1, 1], [1, 1, -1], [1, -1, -1], [1, -1, 1]];
    let jacobian = DMatrix::from_fn(4, 3, |i, j| ratio(rows[i][j], 1));
    let free = DVector::from_vec(vec![ratio(-1, 1), ratio(0, 1), ratio(0, 1)]);
    let delassus = &jacobian * jacobian.transpose();
    let null = DVector::from_vec([1, -1, 1, -1].map(|x| ratio(x, 1)).to_vec());
    let singular = (&delassus * null).iter().all(|x| *x == ratio(0, 1));
    let set = all_solutions(&Lcp::new(delassus, &jacobian * &free))?;
    let velocities = distinct(set.points.iter().map(|impulse| &free + jacobian.transpose() * impulse));
    Ok((velocities, set.points.len(), singular && !set.families.is_empty()))
}

/// The velocities of Painlevé's rod, μ = 3.
fn rod() -> Result<Vec<DVector<Rational>>> {
    let step = painleve_rod(ratio(3, 1));
    let problem = step.stewart_trinkle()?;
    let set = all_solutions(&problem.lcp)?;
    Ok(distinct(set.points.iter().map(|z| step.velocity(&problem.impulse(z)))))
}

/// Three equal balls, the first at 1 m/s, e = 1: all contacts at once, or pair by pair.
fn cradle() -> Result<[DVector<Rational>; 2]> {
    let balls = |entries: [Rational; 3]| DVector::from_vec(entries.to_vec());
    let jacobian = DMatrix::from_row_slice(2, 3, &[-1, 1, 0, 0, -1, 1].map(|x| ratio(x, 1)));
    let before = balls([ratio(1, 1), ratio(0, 1), ratio(0, 1)]);
    let set = all_solutions(&Lcp::new(&jacobian * jacobian.transpose(), &jacobian * &before * ratio(2, 1)))?;
    let together = &before + jacobian.transpose() * &set.points[0];
    let mut pairwise = before;
    // equal masses with e = 1 exchange their velocities
    for pair in [0, 1] {
        let [left, right] = [pairwise[pair].clone(), pairwise[pair + 1].clone()];
        if left > right {
            pairwise[pair] = right;
            pairwise[pair + 1] = left;
        }
    }
    Ok([together, pairwise])
}

/// u_n/(μ u_t) after one step of a slide on the 3-4-5 slope.
fn lift(law: Law) -> Result<Rational> {
    let mut block = Block { law, velocity: [ratio(0, 1), ratio(1, 1)], ..Block::at_rest(ratio(1, 2)) };
    block.step(&ratio(1, 100))?;
    Ok(&block.velocity[0] / (ratio(1, 2) * &block.velocity[1]))
}

fn differences(reading: Reading) -> Result<Vec<Finding>> {
    let (corners, vertices, family) = four_corners()?;
    let rod = rod()?;
    let subject = reading.pick(corners.len(), rod.len());
    let [together, pairwise] = cradle()?;
    let momentum = |v: &DVector<Rational>| v.iter().fold(ratio(0, 1), |sum, x| sum + x);
    let energy = |v: &DVector<Rational>| v.dot(v) * ratio(1, 2);
    let mut findings = vec![
        Finding::count("different velocities among all solutions of an impact on four corners", subject, 1)
            .says_at_least(2usize)
            .violating("friction acts at the contacts"),
        Finding::decision("its impulses are not unique", family && vertices > 1, true),
        Finding::count("different velocities among the solutions of Painlevé's rod", rod.len(), 3).says_at_least(2usize),
    ];
    for (name, velocity, expected) in [
        ("together", &together, [ratio(-1, 3), ratio(2, 3), ratio(2, 3)]),
        ("pair by pair", &pairwise, [ratio(0, 1), ratio(0, 1), ratio(1, 1)]),
    ] {
        for (ball, expected) in expected.iter().enumerate() {
            findings.push(Finding::exact(format!("cradle {name}, ball {}", ball + 1), &velocity[ball], expected, "m/s"));
        }
        findings.push(Finding::exact(format!("cradle {name}, momentum"), &momentum(velocity), &ratio(1, 1), "N·s"));
        findings.push(Finding::exact(format!("cradle {name}, energy"), &energy(velocity), &ratio(1, 2), "J"));
    }
    findings.push(Finding::exact("u_n/(μ u_t) in a slide, relaxed", &lift(Law::Associated)?, &ratio(1, 1), "1"));
    findings.push(Finding::exact("u_n/(μ u_t) in a slide, Coulomb", &lift(Law::Coulomb)?, &ratio(0, 1), "1"));
    Ok(findings)
}
