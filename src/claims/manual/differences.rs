//! Row 7: another solver or simulator, another result.

use crate::claims::experiments::planar_step::{Block, painleve_rod};
use crate::claims::prelude::*;
use crate::problem::{Law, Lcp};
use crate::solvers::enumeration::all_solutions;

pub(super) const CLAIMS: &[Claim] = &[Claim {
    id: "R7",
    statement: "Another solver or simulator gives another result: possible causes (a) simultaneous impacts, where the LCP's solution is \
        not unique, (b) different cones or relaxations, (c) gliding at large steps. Check whether there are simultaneous impacts \
        (non-uniqueness is normal), compare the schemes (§10); to reproduce, fix simulator, version, solver and step.",
    verdict: ClaimVerdict::Conditional,
    kind: Kind::Advice,
    severity: Some(Severity::MissingHypothesis),
    evidence: Evidence::Exact,
    correct_statement: r"Without friction the impulses of a simultaneous impact may not be unique, but the velocities are: $M$ is positive
        definite. Two solvers of the same impact law agree in the motion; what differs is the law (simultaneous or one after another).
        With friction velocities may differ too.",
    argument: r"Body with $M = 1$ on four corners: $W$ has the null vector $(1, -1, 1, -1)$, the solutions of the LCP form a family, and
        all have $v^+ = 0$. Three equal balls, $e = 1$: the simultaneous LCP has one solution, $v^+ = (-1/3, 2/3, 2/3)$; pair by pair
        $(0, 0, 1)$; both conserve momentum and energy. Painlevé's rod with $\mu = 3$: three solutions with three velocities. (b): a slide
        lifts with $u_n = \mu|u_t|$ under the relaxation and 0 under Coulomb.",
    controls: &[
        "Painlevé's rod in the place of the frictionless corners: with friction the velocities differ.",
        r"Three corners in place of four, $\mu = 1$ for the rod, $e = 1/2$ for the balls, and the two laws of the slide exchanged.",
    ],
    sources: &["chapter, troubleshooting manual, row 7"],
    check: check!(differences),
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

/// The velocities when a body lands flat on the first of its four corners, and whether the impulses are unique.
fn corners(count: usize) -> Result<(Vec<DVector<Rational>>, bool)> {
    let rows = [[1, 1, 1], [1, 1, -1], [1, -1, -1], [1, -1, 1]];
    let jacobian = DMatrix::from_fn(count, 3, |i, j| ratio(rows[i][j], 1));
    let free = DVector::from_vec(vec![ratio(-1, 1), ratio(0, 1), ratio(0, 1)]);
    let set = all_solutions(&Lcp::new(&jacobian * jacobian.transpose(), &jacobian * &free))?;
    let velocities = distinct(set.points.iter().map(|impulse| &free + jacobian.transpose() * impulse));
    Ok((velocities, set.is_unique()))
}

/// The velocities of Painlevé's rod.
fn rod(friction: Rational) -> Result<Vec<DVector<Rational>>> {
    let step = painleve_rod(friction);
    let problem = step.stewart_trinkle()?;
    let set = all_solutions(&problem.lcp)?;
    Ok(distinct(set.points.iter().map(|z| step.velocity(&problem.impulse(z)))))
}

/// Three equal balls, the first at 1 m/s: all contacts at once, or pair by pair.
fn cradle(restitution: &Rational) -> Result<[DVector<Rational>; 2]> {
    let balls = |entries: [Rational; 3]| DVector::from_vec(entries.to_vec());
    let jacobian = DMatrix::from_row_slice(2, 3, &[-1, 1, 0, 0, -1, 1].map(|x| ratio(x, 1)));
    let before = balls([ratio(1, 1), ratio(0, 1), ratio(0, 1)]);
    let set = all_solutions(&Lcp::new(&jacobian * jacobian.transpose(), &jacobian * &before * (restitution + ratio(1, 1))))?;
    let together = &before + jacobian.transpose() * &set.points[0];
    let mut pairwise = before;
    // two equal masses: their mean, and −e times their difference about it
    for pair in [0, 1] {
        let [left, right] = [pairwise[pair].clone(), pairwise[pair + 1].clone()];
        if left > right {
            let (sum, apart) = (&left + &right, (left - right) * restitution);
            pairwise[pair] = (&sum - &apart) * ratio(1, 2);
            pairwise[pair + 1] = (sum + apart) * ratio(1, 2);
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
    let (landed, unique) = corners(reading.only(1).pick(4, 3))?;
    let rod = rod(reading.only(1).pick(ratio(3, 1), ratio(1, 1)))?;
    let subject = reading.only(0).pick(&landed, &rod).len();
    let [together, pairwise] = cradle(&reading.only(1).pick(ratio(1, 1), ratio(1, 2)))?;
    let [relaxed, exact] = reading.only(1).pick([Law::Associated, Law::Coulomb], [Law::Coulomb, Law::Associated]);
    let energy = |v: &DVector<Rational>| v.dot(v) * ratio(1, 2);
    let is = |v: &DVector<Rational>, entries: [Rational; 3]| v.as_slice() == entries;
    let apart = is(&together, [ratio(-1, 3), ratio(2, 3), ratio(2, 3)]) && is(&pairwise, [ratio(0, 1), ratio(0, 1), ratio(1, 1)]);
    Ok(vec![
        Finding::count("different velocities among all solutions of an impact on four corners", subject, 1)
            .says_at_least(2usize)
            .violating("friction acts at the contacts"),
        Finding::decision("its impulses are not unique", !unique, true),
        Finding::count("different velocities among the solutions of Painlevé's rod", rod.len(), 3).says_at_least(2usize),
        Finding::decision("three balls leave with (−1/3, 2/3, 2/3) m/s together and with (0, 0, 1) m/s pair by pair", apart, true),
        Finding::exact("their energy, together", &energy(&together), &ratio(1, 2), "J"),
        Finding::exact("their energy, pair by pair", &energy(&pairwise), &ratio(1, 2), "J"),
        Finding::exact("u_n/(μ u_t) in a slide, relaxed", &lift(relaxed)?, &ratio(1, 1), "1"),
        Finding::exact("u_n/(μ u_t) in a slide, Coulomb", &lift(exact)?, &ratio(0, 1), "1"),
    ])
}
