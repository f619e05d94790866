//! Feasible and solvable: when a Stewart–Trinkle step has a solution.

use super::copositive::is_feasible;
use super::matrices::{integers, jamming_matrix};
use crate::certificate::existence;
use crate::checks::stewart_trinkle::{RationalStep, chapter_example, rational_directions, reduced, reference, wedge};
use crate::claims::prelude::*;
use crate::problem::Lcp;
use crate::solvers::enumeration::all_solutions;
use crate::solvers::lemke::{LemkeOutcome, lemke};

pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S4.feasible",
        statement: r"The Stewart–Trinkle LCP is always feasible: $\beta = 0$, $\lambda_n = 0$, $\sigma = 0$ with free motion gives a
            feasible point (“the degenerate case can be constructed”).",
        verdict: ClaimVerdict::False,
        kind: Kind::Assertion,
        severity: Some(Severity::WrongStatement),
        evidence: Evidence::Exact,
        correct_statement: r"Zero is infeasible at every closing contact, and the LCP itself can be infeasible. If every gap is $\ge 0$ it
            is feasible, indeed solvable.",
        argument: r"At zero the normal slack is $\varphi/h + n\cdot v_\text{free}$, negative whenever the free motion would penetrate. A
            point between two walls that both penetrate it (normals $\pm y$, $\varphi_1 = \varphi_2 = -1$, $h = 1$): the two normal rows
            demand $v_y \ge 1$ and $-v_y \ge 1$; their sum is a Farkas certificate against any $v_y$, with any $\lambda$, $\beta$,
            $\sigma$. With $\varphi_1 = \varphi_2 = 0$ the same walls are feasible.",
        controls: &[
            "The same two walls with gaps 0, and a contact that opens in place of the closing one.",
            r"Gaps −1 in place of 0, and a friction row with the sign of $\mu$ wrong.",
        ],
        sources: &["chapter §4, corollary “every step is solvable”"],
        check: check!(feasible),
    },
    Claim {
        id: "S4.solvable",
        statement: "Every step of the Stewart–Trinkle scheme has a solution, because its matrix is copositive-plus and the LCP feasible.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Exact,
        correct_statement: r"A step is solvable if $b^T\lambda \ge 0$ for all $\lambda$, $\beta \ge 0$ with $n\lambda + D\beta = 0$ and
            $E^T\beta \le \mu\lambda$ ($b = \varphi/h$); in particular if all gaps are $\ge 0$ (any $\mu$, redundancy, jamming) or the
            friction cone is pointed (any gap). Otherwise it may be feasible and unsolvable.",
        argument: r"One contact with $n = 3/5$, $d = \pm4/5$ on a unit mass with one velocity, $\mu = 1$, $\varphi/h = -1$:
            $q = (-1, 0, 0, 0)$. $z = (3, 0, 0, 2)$ is feasible, none of the complementary cones contains $q$, and Lemke ends on a ray: to
            separate, friction must point against the motion, and $\beta_2 = \lambda$ takes back 4/5 of every 3/5 that $\lambda$ gives. A
            point in a wedge with normals $(\pm4/5, 3/5)$ and $\varphi = -h$ on both sides is solvable for $\mu = 7/10$ and not for
            $\mu = 3/4$. Newton's law on the normal alone ($\varphi = 0$, $e = 1/2$, $v = -1$, so $q = (-9/10, -4/5, 4/5, 0)$) is
            unsolvable with the same matrix; with $e$ on the full vector it is solvable.",
        controls: &[
            r"No friction, $\mu = 0$ in the jamming matrix and in the wedge: copositive-plus, and every step has a solution.",
            r"In place of what can be solved: two walls that overlap, restitution of the normal alone, the wedge with $\mu = 3/4$, a point
                inside it.",
        ],
        sources: &["chapter §4, corollary “every step is solvable”", "proof: module certificate::existence"],
        check: check!(solvable),
    },
];

/// A unit point mass between two walls with normals ±y, both at this gap, h = 1, μ = 1/2.
fn between_walls(gap: i64) -> RationalStep {
    RationalStep {
        mass: integers(&[1, 1]),
        jacobian: DMatrix::from_row_slice(4, 2, &[0, 1, 1, 0, 0, -1, 1, 0].map(|x| ratio(x, 1))),
        rows_per_contact: 2,
        directions: rational_directions(2),
        friction: vec![ratio(1, 2), ratio(1, 2)],
        gap: vec![ratio(gap, 1), ratio(gap, 1)],
        step: ratio(1, 1),
        free_velocity: integers(&[0, 0]),
    }
}

fn feasible(reading: Reading) -> Result<Vec<Finding>> {
    let walls = reference(&between_walls(reading.only(0).pick(-1, 0)))?;
    let open = reference(&between_walls(reading.only(1).pick(0, -1)))?;
    let mut contact = chapter_example(ratio(0, 1), [ratio(0, 1), ratio(reading.only(0).pick(-1, 1), 1)]);
    contact.friction = vec![reading.only(1).pick(ratio(1, 2), ratio(-1, 2))];
    let touching = reference(&contact)?;
    Ok(vec![
        Finding::decision("the step between two penetrating walls is feasible", is_feasible(&walls), false).says(true),
        Finding::decision("zero is feasible at a closing contact", touching.vector.iter().all(|q| *q >= ratio(0, 1)), false).says(true),
        Finding::decision("the closing contact is feasible", is_feasible(&touching), true),
        Finding::decision("the same walls with gaps 0 are solvable", solves(&open)?, true),
    ])
}

fn solvable(reading: Reading) -> Result<Vec<Finding>> {
    const CONDITION: &str = "no gap is negative, or the friction cone is pointed";
    let mut matrix = jamming_matrix();
    if reading.only(0).is_control() {
        matrix[(3, 0)] = ratio(0, 1);
    }
    let with = |vector: DVector<Rational>| Lcp::new(matrix.clone(), vector);
    let jammed = with(integers(&[-1, 0, 0, 0]));
    let newton = with(DVector::from_vec(vec![ratio(-9, 10), ratio(-4, 5), ratio(4, 5), ratio(0, 1)]));
    let full = with(DVector::from_vec(vec![ratio(-9, 10), ratio(-6, 5), ratio(6, 5), ratio(0, 1)]));
    let reversed = reading.only(1).pick(&full, &newton);
    let overlapping = reference(&between_walls(-1))?;
    let pushed = reading.only(1).pick(&jammed, &overlapping);
    let solved = !all_solutions(&jammed)?.is_empty();
    let by_newton = all_solutions(&newton)?.points.len();
    let mut findings = vec![
        Finding::decision("the jammed step has a solution in one of the 16 cones", solved, false).says(true).violating(CONDITION),
        Finding::decision("it is feasible", is_feasible(pushed), true),
        Finding::decision("Lemke solves it", solves(&jammed)?, false).says(true).violating(CONDITION),
        Finding::count("solutions with Newton's law on the normal alone", by_newton, 0).context(),
        Finding::decision("Lemke solves it with restitution on the full vector", solves(reversed)?, true),
    ];
    let friction = |mu: Rational| reading.only(0).pick(mu, ratio(0, 1));
    let pointed = wedge(friction(reading.only(1).pick(ratio(7, 10), ratio(3, 4))));
    let flat = wedge(friction(ratio(3, 4)));
    let is_pointed = |system: &RationalStep| -> Result<bool> { Ok(existence::pointed(&reduced(system)?.0, &system.friction).holds()) };
    let is_solvable = |system: &RationalStep| -> Result<bool> { Ok(!all_solutions(&reference(system)?)?.is_empty()) };
    findings.extend([
        Finding::decision("wedge with μ = 7/10: solvable", is_solvable(&pointed)?, true),
        Finding::decision("wedge with μ = 3/4: solvable", is_solvable(&flat)?, false).says(true).violating(CONDITION),
        Finding::decision("the wedge is pointed with μ = 7/10 only", is_pointed(&pointed)? && !is_pointed(&flat)?, true).context(),
    ]);
    let mut open = wedge(ratio(1, 1));
    open.gap = reading.only(1).pick(vec![ratio(0, 1), ratio(1, 100)], open.gap);
    open.free_velocity = reading.only(1).pick(integers(&[1, -2]), open.free_velocity);
    findings.push(Finding::decision("wedge with μ = 1 and gaps ≥ 0: Lemke solves it", solves(&reference(&open)?)?, true));
    Ok(findings)
}

/// Whether Lemke's method ends at a solution.
fn solves(lcp: &Lcp<Rational>) -> Result<bool> {
    let covering = DVector::from_element(lcp.size(), ratio(1, 1));
    Ok(matches!(lemke(lcp, &covering)?, LemkeOutcome::Solution { .. }))
}
