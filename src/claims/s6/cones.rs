//! The two friction cones as sets of forces.

use crate::Result;
use crate::checks::Finding;
use crate::claims::{Claim, ClaimVerdict, Evidence, Kind, Reading, Severity};
use crate::scalar::{Rational, Scalar, ratio};

const MODEL: &str = "MuJoCo documentation, Computation: friction cones (3.17)";

pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S6.elliptic-cone",
        statement: "The elliptic cone {f₁ ≥ 0, f₁² ≥ Σ fᵢ²/μᵢ₋₁²} is the exact second-order cone, with sliding, torsional and rolling \
            friction, and isotropic.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Exact,
        correct_statement: "It is the second-order cone of the scaled forces fᵢ/μᵢ₋₁. Isotropic in the tangent plane only if the two \
            sliding coefficients are equal, as by default; torsion and rolling need condim 4 and 6.",
        argument: "μ = (1/2, 1/2): the forces 1/2 (3/5, 4/5) and 1/2 (1, 0) per unit of normal force are both on the boundary. μ = (1, \
            1/2): (4/5, 0) inside, (0, 4/5) outside. In rationals.",
        control: "Isotropy for μ = (1, 1/2).",
        sources: &["chapter §6, step 4", MODEL],
        check: elliptic,
    },
    Claim {
        id: "S6.pyramidal-cone",
        statement: "The pyramidal cone {f ∈ ℝ^{2(n−1)}, f ≥ 0} is a polyhedral approximation in edge forces, as of Stewart and Trinkle; \
            faster to compute, but anisotropic.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Exact,
        correct_statement: "As a set of forces it is the four-sided cone of Stewart and Trinkle at condim 3, 1/√2 as strong along the \
            diagonals as along the axes. That it is faster is not decided here.",
        argument: "Edges (1, ±μ, 0), (1, 0, ±μ): forces with |t₁| + |t₂| ≤ μ f₁. μ = 1: along an axis 1 is reached, along the diagonal \
            (1/2, 1/2) and no more, a squared strength of 1/2.",
        control: "The strength of the elliptic cone along the diagonal.",
        sources: &["chapter §6, step 4", MODEL],
        check: pyramidal,
    },
];

/// f₁² − Σ fᵢ²/μᵢ² for f₁ = 1.
fn room(tangent: [Rational; 2], friction: [Rational; 2]) -> Rational {
    let [first, second] = [0, 1].map(|i| &tangent[i] / &friction[i]);
    ratio(1, 1) - &first * &first - &second * &second
}

fn elliptic(reading: Reading) -> Result<Vec<Finding>> {
    let (half, zero) = (ratio(1, 2), ratio(0, 1));
    let second = reading.pick(half.clone(), ratio(1, 4));
    let equal = || [half.clone(), second.clone()];
    let unequal = || [ratio(1, 1), half.clone()];
    Ok(vec![
        Finding::exact("room in the direction (3/5, 4/5), equal coefficients", &room([ratio(3, 10), ratio(4, 10)], equal()), &zero, "1"),
        Finding::exact("room in the direction (1, 0), equal coefficients", &room([half.clone(), zero.clone()], equal()), &zero, "1"),
        Finding::decision("(4/5, 0) is inside for μ = (1, 1/2)", room([ratio(4, 5), zero.clone()], unequal()) > zero, true),
        Finding::decision("(0, 4/5) is inside for μ = (1, 1/2)", room([zero.clone(), ratio(4, 5)], unequal()) > zero, false),
    ])
}

/// The edge forces f ≥ 0 of least sum that make (t₁, t₂) with μ = 1, and their sum, the normal force they need.
fn normal_force(tangent: &[Rational; 2]) -> Rational {
    tangent[0].magnitude() + tangent[1].magnitude()
}

fn pyramidal(reading: Reading) -> Result<Vec<Finding>> {
    let reached = |direction: [Rational; 2]| {
        let scale = ratio(1, 1) / normal_force(&direction);
        direction.iter().fold(ratio(0, 1), |sum, entry| sum + entry * entry * &scale * &scale)
    };
    let one = ratio(1, 1);
    // every non-negative choice of edge forces in quarters with sum 1 stays within |t₁| + |t₂| ≤ 1
    let quarters = (0..625i64).map(|k| [k % 5, k / 5 % 5, k / 25 % 5, k / 125]).filter(|edges| edges.iter().sum::<i64>() == 4);
    let within = quarters.into_iter().all(|[a, b, c, d]| normal_force(&[ratio(a - b, 4), ratio(c - d, 4)]) <= one);
    Ok(vec![
        Finding::exact(
            "squared strength along the diagonal",
            &reached([one.clone(), one.clone()]),
            &reading.pick(ratio(1, 2), one.clone()),
            "1",
        ),
        Finding::exact("squared strength along an axis", &reached([ratio(0, 1), one.clone()]), &one, "1"),
        Finding::decision("edge forces of sum 1 stay within |t₁| + |t₂| ≤ 1", within, true),
    ])
}
