//! Complementarity, normal cone and proximal operator as the preface recalls them; the cone's errors in the misconception table.

use crate::certificate::lcp::residuals;
use crate::claims::experiments::polygon::Spread;
use crate::claims::prelude::*;
use crate::cones::polyhedral::strength_error;
use crate::problem::{Lcp, PlanarProblem};
use crate::solvers::enumeration::all_solutions;
use crate::solvers::lemke::{LemkeOutcome, lemke};
use crate::tolerance::rounding;

/// Claims of the preface.
pub const PREFACE: &[Claim] = &[Claim {
    id: "P.lcp-slack",
    statement: r"A solution of $0 \le z \perp w = Mz + q \ge 0$ has $z_i = 0$ or $w_i = 0$ for each $i$; $N_C(x)$ = {$g$ :
        $\langle g, y - x\rangle \le 0$ for all $y$ in $C$}; $\operatorname{prox}_f(v)$ = argmin $f(x) + \tfrac12\|x - v\|^2$.",
    verdict: ClaimVerdict::True,
    kind: Kind::Definition,
    severity: None,
    evidence: Evidence::Exact,
    correct_statement: r"As stated, for $C$ closed and convex and $x$ in $C$; the prox of an indicator is the projection, and
        $v - \operatorname{prox}(v)$ lies in the normal cone.",
    argument: r"$\sum\,z_iw_i = 0$ with every term $\ge 0$ makes every term 0. All solutions of three rational LCPs, found by enumerating
        complementary supports, satisfy it entry by entry. For $C = [0, 2]$ and $v = -1$, 1/3, 2, 5 the minimiser $x$ of
        $\tfrac12(x - v)^2$ over a fine grid of $C$ leaves $v - x$ in $N_C(x)$.",
    controls: &[
        "A feasible point of each LCP, shifted off the complementary face.",
        "The second matrix with the sign of its lower row changed: that LCP has no solution.",
        r"The two ends of $[0, 2]$ in the place of $C$, which are not convex.",
    ],
    sources: &["chapter, recollections before §0", "Cottle, Pang and Stone, The Linear Complementarity Problem (1992), §1.1"],
    check: check!(complementary_slackness),
}];

/// Claims of the table of misconceptions.
pub const MISCONCEPTIONS: &[Claim] = &[Claim {
    id: "M.cone-error",
    statement: r"The polyhedral cone changes the cone's shape: an error $O(1/d)$, its LCP exact.",
    verdict: ClaimVerdict::Ambiguous,
    kind: Kind::Assertion,
    severity: None,
    evidence: Evidence::Certified,
    correct_statement: r"As an upper bound it holds of all errors. The order of the shape is $1/d^2$: the radius is short by
        $1 - \cos(\pi/d)$, 0.2929, 0.0761, 0.0192, 0.0048 for $d = 4$, 8, 16, 32. $O(1/d)$ is the order of the direction of the force,
        $\pi/d$. The LCP of that cone is solved exactly.",
    argument: r"From $d$ to $2d$ the missing strength falls by $1/(4 \cos^2(\pi/4d))$, nearly 1/4 and below 1/2, the largest error of the
        direction by 1/2. Lemke's method in rational arithmetic solves the LCP of a sliding contact with four directions with all
        residuals zero; its friction has half the squared strength of the circular cone's along the bisector, which is the error of the
        shape.",
    controls: &[
        r"The cone with the half axes and all other directions in one quadrant: neither error falls, and $O(1/d)$ holds of it in no
                reading.",
        r"$d$ counted as the number of pairs ±, so that the cone has $2d$ directions.",
        r"Lemke's answer for $\mu = 1$ in the LCP with $\mu = \tfrac12$.",
    ],
    sources: &["chapter, table of misconceptions, polyhedral cone and convex relaxation"],
    check: check!(cone_error),
}];

fn number(entry: &i64) -> Rational {
    ratio(*entry, 1)
}

fn problem(matrix: &[i64], vector: &[i64]) -> Lcp<Rational> {
    let size = vector.len();
    Lcp::new(
        DMatrix::from_iterator(size, size, matrix.iter().map(number)).transpose(),
        DVector::from_iterator(size, vector.iter().map(number)),
    )
}

fn complementary_slackness(reading: Reading) -> Result<Vec<Finding>> {
    let zero = ratio(0, 1);
    let exchange = reading.only(1).pick([0, 1, 1, 0], [0, 1, -1, 0]);
    let problems =
        [problem(&[2, 1, 1, 2], &[-1, -1]), problem(&exchange, &[-1, -1]), problem(&[3, -1, 0, -1, 2, 1, 0, 1, 4], &[-2, 1, -5])];
    let (mut both, mut solved) = (0, 0);
    for lcp in &problems {
        let solutions = all_solutions(lcp)?.points;
        let shift = DVector::from_element(lcp.size(), reading.only(0).pick(ratio(0, 1), ratio(1, 1)));
        let both_positive = |point: &DVector<Rational>| {
            let z = point + &shift;
            let slack = lcp.slack(&z);
            z.iter().zip(slack.iter()).filter(|(z, w)| **z > zero && **w > zero).count()
        };
        both += solutions.iter().map(both_positive).sum::<usize>();
        solved += usize::from(!solutions.is_empty());
    }
    let set: Vec<Rational> = reading.only(2).pick((0..=24).map(|k| ratio(k, 12)).collect(), vec![ratio(0, 1), ratio(2, 1)]);
    let points = [[-1, 1], [1, 3], [2, 1], [5, 1]].map(|[a, b]| ratio(a, b));
    let outside = points.iter().filter(|v| !proximal_point_is_normal(&set, v)).count();
    Ok(vec![
        Finding::count("entries with z_i > 0 and w_i > 0 in all solutions of three LCPs", both, 0),
        Finding::count("LCPs with a solution", solved, 3),
        Finding::count("points v with v − prox(v) not normal to C at prox(v)", outside, 0),
    ])
}

/// Whether the minimiser x of ½(x − v)² over the points of a set satisfies `(v − x)(y − x) ≤ 0` for every y of the set.
fn proximal_point_is_normal(set: &[Rational], v: &Rational) -> bool {
    let cost = |x: &Rational| (x - v) * (x - v);
    let nearest = set.iter().fold(&set[0], |best, x| if cost(x) < cost(best) { x } else { best });
    set.iter().all(|y| (v - nearest) * (y - nearest) <= ratio(0, 1))
}

fn cone_error(reading: Reading) -> Result<Vec<Finding>> {
    let spread = reading.only(0).pick(Spread::Even, Spread::OneQuadrant);
    let mut findings = Vec::new();
    for d in [4, 8, 16] {
        let ([coarse, coarse_angle], [fine, fine_angle]) = (spread.errors(d), spread.errors(2 * d));
        // the strength is the smallest of the four and a difference of numbers of size 1, known to 8 roundings
        let bound = 2.0 * rounding(8, 1.0) / fine;
        let expected = 0.25 / (std::f64::consts::PI / (4 * d) as f64).cos().powi(2);
        let shape = || {
            Finding::equal(format!("error of the radius with 2d directions over that with d = {d}"), fine / coarse, expected, bound, "1")
        };
        findings.push(shape().says_at_most(0.5).reading("O(1/d) as an upper bound"));
        findings.push(shape().says(0.5).reading("1/d as the order of the shape"));
        let halved = fine_angle / coarse_angle;
        findings.push(Finding::equal(format!("error of the direction with 2d directions over that with d = {d}"), halved, 0.5, bound, "1"));
    }
    // cos(π/4) = 1/√2 and the half-angle formula, twice
    let half_angle = |cosine: f64| ((1.0 + cosine) / 2.0).sqrt();
    let quarter = 0.5f64.sqrt();
    let eighth = half_angle(quarter);
    for (d, cosine) in [(4, quarter), (8, eighth), (16, half_angle(eighth)), (32, half_angle(half_angle(eighth)))] {
        let missing = strength_error(reading.only(1).pick(d, 2 * d));
        findings.push(Finding::equal(format!("missing strength, d = {d}"), missing, 1.0 - cosine, rounding(8, 1.0), "1"));
    }
    let directions = [[1, 0], [0, 1], [-1, 0], [0, -1]].map(|axis| axis.map(|entry| ratio(entry, 1)));
    let free = DVector::from_iterator(3, [-1, 1, 1].iter().map(number));
    let posed = |friction| PlanarProblem::new(DMatrix::identity(3, 3), free.clone()).polyhedral(&[friction], &directions);
    let (lcp, solved) = (posed(ratio(1, 2))?.lcp, posed(reading.only(2).pick(ratio(1, 2), ratio(1, 1)))?.lcp);
    let exact = match lemke(&solved, &DVector::from_element(lcp.size(), ratio(1, 1)))? {
        LemkeOutcome::Solution { z, .. } => residuals(&lcp, &z).vanish(),
        LemkeOutcome::Ray { .. } => false,
    };
    findings.push(Finding::decision("all residuals of the polyhedral LCP are exactly zero", exact, true));
    Ok(findings)
}
