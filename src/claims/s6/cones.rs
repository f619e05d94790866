//! The two friction cones as sets of forces.

use crate::certificate::definiteness::quadratic_form;
use crate::certificate::feasibility::nonnegative_solution;
use crate::claims::prelude::*;

const MODEL: &str = "MuJoCo documentation, Computation: friction cones (3.17)";

pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S6.elliptic-cone",
        statement: r"The elliptic cone $\{f_1 \ge 0, f_1^2 \ge \sum\,f_i^2/\mu_{i-1}^2\}$ is the exact second-order cone, with sliding,
            torsional and rolling friction, and isotropic.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Exact,
        correct_statement: r"It is the second-order cone of the scaled forces $f_i/\mu_{i-1}$. Isotropic in the tangent plane only if the
            two sliding coefficients are equal, as by default; torsion and rolling need condim 4 and 6.",
        argument: r"$\mu = (1/2, 1/2)$: the forces $1/2\,(3/5, 4/5)$ and $1/2\,(1, 0)$ per unit of normal force are both on the boundary.
            $\mu = (1, 1/2)$: $(4/5, 0)$ inside, $(0, 4/5)$ outside, where an isotropic cone has both or none. In rationals.",
        controls: &[
            r"$\mu = (1, 1)$ in place of $(1, 1/2)$.",
            r"$\mu_i$ in place of $\mu_i^2$, the square forgotten.",
            r"$\mu = (1/2, 1)$, the coefficients exchanged.",
        ],
        sources: &["chapter §6, step 4", MODEL],
        check: check!(elliptic),
    },
    Claim {
        id: "S6.pyramidal-cone",
        statement: r"The pyramidal cone $\{f \in \mathbb{R}^{2(n - 1)}, f \ge 0\}$ is a polyhedral approximation in edge forces, as of
            Stewart and Trinkle, and anisotropic. (That it is faster to compute is another claim.)",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"As stated: at condim 3 the four-sided cone of Stewart and Trinkle, $1/\sqrt2$ as strong along the diagonals
            as along the axes. Whether it is faster is the matter of S6.pyr-faster.",
        argument: r"Edges $(1, \pm\mu, 0)$, $(1, 0, \pm\mu)$, $\mu = 1$: of the twentieths along an axis and along the diagonal, 1 and
            $(1/2, 1/2)$ are the last that edge forces reach, a squared strength of 1/2 on the diagonal; all forces of a grid of edge
            forces with sum 1 have $|t_1| + |t_2| \le 1$.",
        controls: &[r"Edges along $(\pm3/5, \pm4/5)$ in place of the axes."],
        sources: &["chapter §6, step 4", MODEL],
        check: check!(pyramidal),
    },
];

/// f₁² − Σ fᵢ²/μᵢ² for f₁ = 1, a form of (1, f₂, f₃); or with μᵢ for μᵢ².
fn room(tangent: [Rational; 2], friction: [Rational; 2], squared: bool) -> Rational {
    let [first, second] = [0, 1].map(|i| {
        let scale = if squared { &friction[i] * &friction[i] } else { friction[i].clone() };
        ratio(1, 1) / scale
    });
    let one = ratio(1, 1);
    let form = DMatrix::from_diagonal(&dvector![one.clone(), -first, -second]);
    quadratic_form(&form, &dvector![one, tangent[0].clone(), tangent[1].clone()])
}

fn elliptic(reading: Reading) -> Result<Vec<Finding>> {
    let (half, zero) = (ratio(1, 2), ratio(0, 1));
    let equal = || [half.clone(), half.clone()];
    let squared = reading.only(1).pick(true, false);
    let room = |tangent: [Rational; 2], friction: [Rational; 2]| room(tangent, friction, squared);
    let unequal = || match reading {
        Reading::Control(0) => [ratio(1, 1), ratio(1, 1)],
        Reading::Control(2) => [half.clone(), ratio(1, 1)],
        _ => [ratio(1, 1), half.clone()],
    };
    let inside = |tangent: [Rational; 2]| room(tangent, unequal()) > zero;
    let along_first = inside([ratio(4, 5), zero.clone()]);
    Ok(vec![
        Finding::exact("room in the direction (3/5, 4/5), equal coefficients", &room([ratio(3, 10), ratio(4, 10)], equal()), &zero, "1"),
        Finding::exact("room in the direction (1, 0), equal coefficients", &room([half.clone(), zero.clone()], equal()), &zero, "1"),
        Finding::decision("(4/5, 0) is inside for μ = (1, 1/2)", along_first, true),
        Finding::decision("(0, 4/5) is inside as (4/5, 0) is, for μ = (1, 1/2)", inside([zero.clone(), ratio(4, 5)]) == along_first, false)
            .says(true)
            .violating("equal sliding coefficients"),
    ])
}

/// The tangential forces per unit of normal force, μ = 1, that edge forces in quarters with sum 1 make.
fn reached(edges: &[[Rational; 2]; 4]) -> Vec<[Rational; 2]> {
    let quarters = (0..625i64).map(|k| [k % 5, k / 5 % 5, k / 25 % 5, k / 125]).filter(|edges| edges.iter().sum::<i64>() == 4);
    let sum = |forces: [i64; 4], i: usize| {
        let parts = forces.iter().zip(edges).map(|(force, edge)| ratio(*force, 4) * &edge[i]);
        parts.fold(ratio(0, 1), |sum, part| sum + part)
    };
    quarters.map(|forces| [sum(forces, 0), sum(forces, 1)]).collect()
}

/// Whether edge forces make this tangential force with the normal force 1.
fn is_reached(edges: &[[Rational; 2]; 4], [first, second]: &[Rational; 2]) -> bool {
    let of_edges = DMatrix::from_fn(3, 4, |i, edge| if i == 0 { ratio(1, 1) } else { edges[edge][i - 1].clone() });
    nonnegative_solution(&of_edges, &dvector![ratio(1, 1), first.clone(), second.clone()]).point().is_some()
}

fn pyramidal(reading: Reading) -> Result<Vec<Finding>> {
    let one = ratio(1, 1);
    let pair = |first: (i64, i64), second: (i64, i64)| [ratio(first.0, first.1), ratio(second.0, second.1)];
    let edges = reading.pick(
        [pair((1, 1), (0, 1)), pair((-1, 1), (0, 1)), pair((0, 1), (1, 1)), pair((0, 1), (-1, 1))],
        [pair((3, 5), (4, 5)), pair((-3, 5), (4, 5)), pair((3, 5), (-4, 5)), pair((-3, 5), (-4, 5))],
    );
    let strength = |along: [i64; 2]| {
        let sizes = (0..=20).map(|size| along.map(|entry| ratio(entry * size, 20))).filter(|force| is_reached(&edges, force));
        sizes.map(|[first, second]| &first * &first + &second * &second).fold(ratio(0, 1), Rational::max)
    };
    let within = reached(&edges).iter().all(|[first, second]| first.magnitude() + second.magnitude() <= one);
    Ok(vec![
        Finding::exact("squared strength along the diagonal", &strength([1, 1]), &ratio(1, 2), "1"),
        Finding::exact("squared strength along an axis", &strength([0, 1]), &one, "1"),
        Finding::decision("edge forces of sum 1 stay within |t₁| + |t₂| ≤ 1", within, true),
    ])
}
