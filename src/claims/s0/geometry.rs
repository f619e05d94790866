//! The admissible set C = {φ ≥ 0}, and what a distance algorithm says of φ.

use crate::certificate::definiteness::quadratic_form;
use crate::claims::prelude::*;
use crate::mechanics::planar::{PlanarBody, Shape};
use crate::mechanics::{Mechanism, PlanarBodies};
use crate::tolerance::claims::GILBERT_WIDTH;
use nalgebra::Vector2;
use num_traits::Zero;

pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S0.moving-convex",
        statement: r"Table of difficulties, (c): $C(q) = \{q : \varphi(q) \ge 0\}$ is a moving convex set.",
        verdict: ClaimVerdict::False,
        kind: Kind::Assertion,
        severity: Some(Severity::WrongStatement),
        evidence: Evidence::Exact,
        correct_statement: r"$C$ is a fixed subset of configuration space, in general not convex (prox-regular if $\varphi$ is smooth with
            $\nabla\varphi \ne 0$). What moves with $q$ and is convex is the tangent cone $T_C(q)$. (The chapter names the extension to
            prox-regular sets in §2.)",
        argument: r"Outside a disk, $\varphi = |q|^2 - 1$: $(2, 0)$ and $(-2, 0)$ are admissible with $\varphi = 3$, their midpoint has
            $\varphi = -1$. The tangent cones at $(1, 0)$ and $(0, 1)$ are the half-planes $v_1 \ge 0$ and $v_2 \ge 0$: each convex, and
            different. Inside the disk, $\varphi = 1 - |q|^2$, $C$ happens to be convex.",
        controls: &["The inside of the disk, where the midpoint is admissible."],
        sources: &["chapter §0, table of the three difficulties", "chapter §2, step 1"],
        check: check!(convexity),
    },
    Claim {
        id: "S0.gjk",
        statement: r"For convex bodies $\varphi$ can be computed by GJK (signed distance, negative in penetration).",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Certified,
        correct_statement: r"GJK computes the distance, which is $\varphi$ only while the bodies are disjoint. In penetration the distance
            is 0 for every depth; the negative branch needs another algorithm (EPA, or a closed form).",
        argument: r"GJK and its ancestor, Gilbert's algorithm, find the point of the Minkowski difference nearest to the origin, with a
            lower bound from its support function. Disk of radius 0.2 m and a box of half extents 0.4 and 0.3 m: with the centre at
            $(0.7, 0.7)$ the enclosure closes on $\varphi = 0.3$ m; at depths 0.05 and 0.1 m below the upper face it closes on 0 both
            times.",
        controls: &["Disks beside a corner of the box in the place of those inside it.", "The algorithm stopped after its first step."],
        sources: &["chapter §0, gap function", "Gilbert, Johnson, Keerthi, IEEE J. Robotics and Automation 4 (1988)"],
        check: check!(distance_is_not_depth),
    },
];

fn convexity(reading: Reading) -> Result<Vec<Finding>> {
    let sign = reading.pick(ratio(1, 1), ratio(-1, 1));
    // ±(|q|² − 1) is a form of (q, 1)
    let form = DMatrix::from_diagonal(&dvector![sign.clone(), sign.clone(), -sign.clone()]);
    let gap = |q: &[Rational; 2]| quadratic_form(&form, &dvector![q[0].clone(), q[1].clone(), ratio(1, 1)]);
    let edge = reading.pick(ratio(2, 1), ratio(1, 2));
    let (right, left) = ([edge.clone(), ratio(0, 1)], [-edge, ratio(0, 1)]);
    let middle = [(&right[0] + &left[0]) / ratio(2, 1), Rational::zero()];
    // T_C(q) = {v : ∇φ·v ≥ 0} on the boundary, ∇φ = ±2q and v = (0, −1)
    let tangent = |q: [i64; 2]| &sign * ratio(-2 * q[1], 1) >= Rational::zero();
    Ok(vec![
        Finding::exact("φ at the midpoint of two admissible points", &gap(&middle), &ratio(-1, 1), "m²").says_at_least(ratio(0, 1)),
        Finding::exact("the smaller φ at the two points", &gap(&right).min(gap(&left)), &ratio(3, 1), "m²").says_at_least(ratio(0, 1)),
        Finding::decision("(0, −1) is a tangent at (1, 0) and not at (0, 1)", tangent([1, 0]) && !tangent([0, 1]), true).context(),
    ])
}

const RADIUS: f64 = 0.2;
const HALF_EXTENTS: [f64; 2] = [0.4, 0.3];

/// Most steps of Gilbert's algorithm.
const STEPS: usize = 10_000;

/// Bounds of the distance between a disk centred at c and a box about the origin, by so many steps of Gilbert's algorithm on A − B.
fn distance_bounds(centre: Vector2<f64>, steps: usize) -> [f64; 2] {
    // the point of A − B farthest against v: disk centre − r v/|v| minus the box corner along v
    let support = |v: Vector2<f64>| {
        let corner = Vector2::new(HALF_EXTENTS[0].copysign(v.x), HALF_EXTENTS[1].copysign(v.y));
        centre - v.normalize() * RADIUS - corner
    };
    let (mut nearest, mut lower) = (centre, 0.0f64);
    for _ in 0..steps {
        let candidate = support(nearest);
        lower = lower.max(nearest.dot(&candidate) / nearest.norm());
        let edge = candidate - nearest;
        let step = (-nearest.dot(&edge) / edge.norm_squared()).clamp(0.0, 1.0);
        let improved = nearest + edge * step;
        if improved.norm() - lower <= GILBERT_WIDTH || edge.norm_squared() == 0.0 {
            return [lower, improved.norm()];
        }
        nearest = improved;
    }
    [lower, nearest.norm()]
}

/// φ of the same pair, by the closed form of the planar mechanism.
fn gap(centre: Vector2<f64>) -> Result<f64> {
    let [a, b] = HALF_EXTENTS;
    let disk = PlanarBody::solid("disk", Shape::Disk { radius: RADIUS }, 1.0)?;
    let cuboid = PlanarBody::solid("box", Shape::Box { half_extents: [a, b] }, 1.0)?;
    let pair = PlanarBodies::without_ground("pair", vec![disk, cuboid], [0.0, 0.0], 0.0, 0.0)?;
    let position: DVector<f64> = dvector![centre.x, centre.y, 0.0, 0.0, 0.0, 0.0];
    Ok(pair.contacts(&position)[0].gap)
}

fn distance_is_not_depth(reading: Reading) -> Result<Vec<Finding>> {
    let centre = Vector2::new(0.7, 0.7);
    let [lower, upper] = distance_bounds(centre, reading.only(1).pick(STEPS, 1));
    let phi = gap(centre)?;
    let mut findings = vec![
        Finding::equal("φ against the enclosed distance", 0.5 * (lower + upper), phi, GILBERT_WIDTH, "m"),
        Finding::at_most("width of the enclosure", upper - lower, GILBERT_WIDTH, "m"),
    ];
    for distance in [0.05, 0.1] {
        let depth = reading.only(0).pick(distance, -distance);
        let below_the_face = Vector2::new(0.05, RADIUS + HALF_EXTENTS[1] - depth);
        let beside_a_corner = Vector2::from(HALF_EXTENTS) + Vector2::new(0.6, 0.8) * (RADIUS - depth);
        let centre = reading.only(0).pick(below_the_face, beside_a_corner);
        let ([lower, upper], phi) = (distance_bounds(centre, STEPS), gap(centre)?);
        findings.push(
            Finding::equal(
                format!("distance less φ, {distance} m from touching"),
                0.5 * (lower + upper) - phi,
                distance,
                GILBERT_WIDTH,
                "m",
            )
            .says(0.0)
            .violating("the bodies are disjoint"),
        );
        findings.push(Finding::equal(format!("φ, {distance} m from touching"), phi, -distance, GILBERT_WIDTH, "m"));
    }
    Ok(findings)
}
