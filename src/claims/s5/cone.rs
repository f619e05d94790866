//! The projection on the friction cone, its dual, and derivatives of solutions – in the plane, where all of it is rational.

use crate::claims::experiments::planar_step::PlanarStep;
use crate::claims::prelude::*;
use crate::cones::second_order::project;
use crate::cones::{Case, decide};
use crate::problem::Law;
use crate::tolerance::rounding;
use moreau_exact::minimum::{Minimum, planar_cone};
use moreau_exact::witness::decided;

/// Claims on the cone and its projection.
pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S5.relaxed-constraint",
        statement: r"The relaxed friction constraint is $\mu(n\cdot v) + \|D^Tv\| \le 0$ (so printed in the section on creep; the display
            of step 3 is not legible in the source).",
        verdict: ClaimVerdict::False,
        kind: Kind::Assertion,
        severity: Some(Severity::WrongStatement),
        evidence: Evidence::Exact,
        correct_statement: r"$n\cdot v + \varphi/h \ge \mu\|D^Tv\|$: the law velocity lies in the dual cone $K_\mu^*$.",
        argument: r"The printed set is $-K_\mu$. It demands $n\cdot v \le 0$, so it excludes separation, and steady sliding: with
            $\mu = 1/2$ the velocity $(1/2, 1)$ of a relaxed step is in $K_\mu^*$ and orthogonal to its impulse, and the printed sum of
            two positive numbers should not exceed 0. Reversing $n$ gives $K_\mu$, not $K_\mu^*$: $\mu$ stands on the wrong factor unless
            $\mu = 1$. As the polar cone it fails too: $(-1, 19/10)$ is in $K_\mu^\circ$ but not in the printed set.",
        controls: &[
            r"The dual cone $K_\mu^*$ as the constraint: both velocities meet it.",
            "Coulomb's step in place of the relaxed one: its impulse takes power from the sliding velocity.",
        ],
        sources: &[
            "chapter §5, section on creep",
            "Anitescu, Optimization-based simulation of nonsmooth rigid multibody dynamics (2006, not read)",
        ],
        check: check!(relaxed_constraint),
    },
    Claim {
        id: "S5.proj",
        statement: r"The projection on $K$ has three cases: inside, unchanged; the force points along the negative normal (it would pull),
            zero; outside, the cone's surface. (The formula is not legible in the source; these are its words.)",
        verdict: ClaimVerdict::Ambiguous,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Certified,
        correct_statement: r"Zero iff $z$ is in the polar cone, $\mu\|z_t\| \le -z_n$; on the surface
            $r_n = (z_n + \mu\|z_t\|)/(1 + \mu^2)$, $r_t = \mu\,r_n\,z_t/\|z_t\|$.",
        argument: r#"Taken as the rule "$z_n < 0$ gives 0" the words are wrong: for $\mu = 1$ and $z = (-1/10, 1)$ the nearest point is
            $(9/20, 9/20)$, at the squared distance 121/200, while 0 is at 101/100. Taken as the gloss on the standard result the text
            refers to, they are right: what is sent to 0 has $z_n < 0$ or is 0. On a grid of 81 points the formula in rationals meets the
            three conditions that characterise the projection, and the library's projection agrees with it."#,
        controls: &[
            r"The words as the rule: every $z$ with $z_n < 0$ goes to 0.",
            r"The sign of $z_n$ reversed in the test for zero, $\mu\|z_t\| \le z_n$.",
        ],
        sources: &["chapter §5, analytic cone projection"],
        check: check!(projection),
    },
    Claim {
        id: "S5.proj-states",
        statement: "The three cases of the projection are the three states stick, separation and slip.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Exact,
        correct_statement: r"At a fixed point $r = P_K(r - \eta\,y)$ of the cone complementarity problem, with $y \ne 0$ unless it sticks;
            for an arbitrary iterate the case says nothing about the state.",
        argument: r#"At solutions: $y = 0$ gives $z = r \in K$; $y \in \operatorname{int} K^*$ gives $r = 0$ and
            $z = -\eta\,y \in K^\circ$; $y \ne 0$ on $\partial K^*$ orthogonal to $r \ne 0$ gives $z$ outside both. Away from them:
            $W = I$, $u_\text{free} = (-1, -2)$, $\mu = 1/2$ slips, $r = (8/5, 4/5)$, but for the iterate $r = (4, 0)$ with $\eta = 1/2$
            the point $z$ lies inside the cone – "stick"."#,
        controls: &[
            "The fixed point of a block that sticks in place of the iterate.",
            r"$z = r + \eta\,y$, the sign of the step reversed.",
            r"$\mu = 1/5$ in the projection, 1/2 in the step.",
        ],
        sources: &["chapter §5, physical meaning of the three cases"],
        check: check!(projection_states),
    },
    Claim {
        id: "S5.sap-inner",
        statement: "The analytic projection on the cone is the inner operation of every iteration of the convex primal methods, Chrono's \
            APGD and Drake's SAP.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Certified,
        correct_statement: r"Of APGD, yes. SAP projects in the norm of the regularisation $R$, with $\hat\mu = \mu\,R_t/R_n$ in the case
            conditions, inside a Newton method on velocities; the two projections agree for $R_t = R_n$ only.",
        argument: r"argmin over $K$ of $\tfrac12(\gamma - y)^TR(\gamma - y)$, $R = \operatorname{diag}(R_n, R_t)$, is characterised by
            $\gamma \in K$, $R(y - \gamma) \in K^\circ$, $\gamma\cdot R(y - \gamma) = 0$; in the third case
            $\gamma_n = (y_n + \hat\mu\|y_t\|)/(1 + \mu\,\hat\mu)$. With $R_t/R_n = 1/1000$, $\mu = 1/2$, $y = (1, 2)$:
            $\gamma_n = 4004/4001$ against 8/5 of the Euclidean projection, which violates the characterisation.",
        controls: &[
            r"$R_t = R_n$: the projection in the $R$-norm is the Euclidean one.",
            r"The two projections exchanged: the Euclidean one for SAP, that in the $R$-norm for APGD.",
        ],
        sources: &[
            "chapter §5, analytic cone projection",
            "Castro, Permenter and Han, An unconstrained convex formulation of compliant contact (2022)",
        ],
        check: check!(weighted_projection),
    },
    Claim {
        id: "S5.diff",
        statement: "The solution of the convex QP is, if strictly convex and unique, continuously differentiable in its parameters, with \
            gradients from the implicit function theorem on the KKT conditions.",
        verdict: ClaimVerdict::False,
        kind: Kind::Assertion,
        severity: Some(Severity::WrongStatement),
        evidence: Evidence::Exact,
        correct_statement: "It is Lipschitz and piecewise smooth. It is continuously differentiable where strict complementarity and \
            nondegeneracy hold, not across a change of the active set.",
        argument: r"min $\tfrac12(x - \theta)^2$ over $x \ge 0$ is strictly convex; $x = \max(0, \theta)$ has the one-sided derivatives 0
            and 1 at $\theta = 0$. With friction, min $\tfrac12\|\gamma\|^2 + r\cdot\gamma$ over $K_{1/2}$ ($W = I$): at the change from
            stick to slip, $r = (-2, 1)$, $\partial(\gamma_n, \gamma_t)/\partial r_t$ jumps from $(0, -1)$ to $(2/5, -1/5)$.",
        controls: &["A parameter inside the sticking region, where strict complementarity holds."],
        sources: &[
            "chapter §5, differentiability of the relaxed problem",
            "Fiacco, Introduction to Sensitivity and Stability Analysis (1983)",
        ],
        check: check!(differentiability),
    },
];

pub(super) type Plane = [Rational; 2];

fn plane(normal: [i64; 2], tangent: [i64; 2]) -> Plane {
    [ratio(normal[0], normal[1]), ratio(tangent[0], tangent[1])]
}

fn dot(left: &Plane, right: &Plane) -> Rational {
    left[0].clone() * right[0].clone() + left[1].clone() * right[1].clone()
}

fn magnitude(number: &Rational) -> Rational {
    if *number < ratio(0, 1) { -number.clone() } else { number.clone() }
}

fn in_cone(z: &Plane, mu: &Rational) -> bool {
    z[0] >= ratio(0, 1) && magnitude(&z[1]) <= mu.clone() * z[0].clone()
}

fn in_dual(u: &Plane, mu: &Rational) -> bool {
    u[0] >= mu.clone() * magnitude(&u[1])
}

fn in_polar(z: &Plane, mu: &Rational) -> bool {
    in_dual(&[-z[0].clone(), -z[1].clone()], mu)
}

/// The minimiser of ½(γ − z)ᵀ diag(1, weight)(γ − z) over K_μ: μ̂ = μ·weight, weight 1 is the Euclidean projection.
fn project_weighted(z: &Plane, mu: &Rational, weight: &Rational) -> Plane {
    let least = || Minimum::projection([ratio(1, 1), weight.clone()], z, planar_cone(mu));
    decided(|| nearest(z, mu, weight), |found| least().witness(found))
}

fn nearest(z: &Plane, mu: &Rational, weight: &Rational) -> Plane {
    let hat = mu.clone() * weight.clone();
    let zero = ratio(0, 1);
    if in_cone(z, mu) {
        return z.clone();
    }
    let along = z[0].clone() + hat.clone() * magnitude(&z[1]);
    if along <= zero {
        return [zero.clone(), zero];
    }
    let normal = along / (ratio(1, 1) + mu.clone() * hat);
    let tangent = mu.clone() * normal.clone();
    [normal, if z[1] < zero { -tangent } else { tangent }]
}

pub(super) fn euclidean(z: &Plane, mu: &Rational) -> Plane {
    project_weighted(z, mu, &ratio(1, 1))
}

fn relaxed_constraint(reading: Reading) -> Result<Vec<Finding>> {
    let mu = ratio(1, 2);
    let printed = |u: &Plane| mu.clone() * u[0].clone() + magnitude(&u[1]) <= ratio(0, 1);
    let meets = |u: &Plane| match reading {
        Reading::Control(0) => in_dual(u, &mu),
        _ => printed(u),
    };
    let law = reading.only(1).pick(Law::Associated, Law::Coulomb);
    // velocity and impulse of a relaxed step of a unit point at φ = 0
    let step = |free: Plane| -> Result<(Plane, Plane)> {
        let answer = PlanarStep::point(free, ratio(0, 1), mu.clone()).solve(law)?;
        let both = |vector: &DVector<Rational>| [vector[0].clone(), vector[1].clone()];
        Ok((both(&answer.velocity), both(&answer.impulse)))
    };
    let (sliding, impulse) = step(plane([-1, 2], [3, 2]))?;
    let (separating, _) = step(plane([1, 1], [0, 1]))?;
    let beside = plane([-1, 1], [19, 10]);
    let as_polar = printed(&beside) == in_polar(&beside, &mu);
    Ok(vec![
        Finding::decision("the velocity of a relaxed step that slides, (1/2, 1), meets the constraint", meets(&sliding), false).says(true),
        Finding::exact("power of its impulse on it", &dot(&impulse, &sliding), &ratio(0, 1), "J"),
        Finding::decision("the velocity of one that separates, (1, 0), meets it", meets(&separating), false).says(true),
        Finding::decision("printed set and polar cone differ on (−1, 19/10)", !as_polar, true).context(),
    ])
}

fn negative_normal_to_zero(z: &Plane, mu: &Rational) -> Plane {
    if z[0] < ratio(0, 1) { plane([0, 1], [0, 1]) } else { euclidean(z, mu) }
}

fn reversed_normal_to_zero(z: &Plane, mu: &Rational) -> Plane {
    if in_dual(z, mu) { plane([0, 1], [0, 1]) } else { euclidean(z, mu) }
}

/// Whether p ∈ K, z − p ∈ K° and p·(z − p) = 0, which the projection p of z meets and nothing else does.
fn is_nearest(p: &Plane, z: &Plane, mu: &Rational) -> bool {
    let rest = [z[0].clone() - p[0].clone(), z[1].clone() - p[1].clone()];
    in_cone(p, mu) && in_polar(&rest, mu) && dot(p, &rest) == ratio(0, 1)
}

/// Distance of the library's projection of z from this point.
fn beside_the_library(p: &Plane, z: &Plane, mu: &Rational) -> f64 {
    let rounded = |point: &Plane| [point[0].to_f64().value(), point[1].to_f64().value()];
    let (mut library, [normal, tangent]) = (rounded(z), rounded(p));
    project(&mut library, mu.to_f64().value());
    (library[0] - normal).hypot(library[1] - tangent)
}

fn projection(reading: Reading) -> Result<Vec<Finding>> {
    let (z, mu) = (plane([-1, 10], [1, 1]), ratio(1, 1));
    let onto: fn(&Plane, &Rational) -> Plane = match reading {
        Reading::Recorded => euclidean,
        Reading::Control(0) => negative_normal_to_zero,
        Reading::Control(_) => reversed_normal_to_zero,
    };
    let nearest = onto(&z, &mu);
    let squared = |from: &Plane| {
        let apart = [z[0].clone() - from[0].clone(), z[1].clone() - from[1].clone()];
        dot(&apart, &apart)
    };
    let grid: Vec<Plane> = (-4..=4).flat_map(|n| (-4..=4).map(move |t| plane([n, 2], [t, 2]))).collect();
    let pulled = grid.iter().filter(|z| onto(z, &mu) == plane([0, 1], [0, 1]) && z[0] > ratio(0, 1)).count();
    let found = grid.iter().filter(|z| is_nearest(&onto(z, &mu), z, &mu)).count();
    let beside = grid.iter().map(|z| beside_the_library(&onto(z, &mu), z, &mu)).fold(0.0, f64::max);
    Ok(vec![
        Finding::exact("r_n of the projection of (−1/10, 1), μ = 1", &nearest[0], &ratio(9, 20), "N·s")
            .says(ratio(0, 1))
            .reading("the rule: every z with z_n < 0 goes to zero"),
        Finding::exact("its squared distance", &squared(&nearest), &ratio(121, 200), "N²·s²")
            .says(ratio(101, 100))
            .reading("the rule: every z with z_n < 0 goes to zero"),
        Finding::count("points of a grid that go to zero with z_n > 0", pulled, 0).reading("a gloss on the standard projection"),
        Finding::count("points of a grid, of 81, whose image meets the conditions of the projection", found, 81),
        Finding::at_most("largest distance from the library's projection", beside, rounding(16, 4.0), "N·s"),
    ])
}

/// z = r − η y for W = I.
fn argument(impulse: &Plane, free: &Plane, step: &Rational) -> (Plane, Plane) {
    let velocity = [impulse[0].clone() + free[0].clone(), impulse[1].clone() + free[1].clone()];
    let z = [impulse[0].clone() - step.clone() * velocity[0].clone(), impulse[1].clone() - step.clone() * velocity[1].clone()];
    (z, velocity)
}

fn projection_states(reading: Reading) -> Result<Vec<Finding>> {
    let mu = reading.only(2).pick(ratio(1, 2), ratio(1, 5));
    let step = reading.only(1).pick(ratio(1, 2), ratio(-1, 2));
    let slipping = plane([-1, 1], [-2, 1]);
    let points = [
        ("slip", plane([8, 5], [4, 5]), slipping.clone(), Case::Boundary),
        ("stick", plane([2, 1], [1, 2]), plane([-2, 1], [-1, 2]), Case::Stays),
        ("separation", plane([0, 1], [0, 1]), plane([2, 1], [1, 1]), Case::Apex),
    ];
    let mut findings = Vec::new();
    for (state, impulse, free, case) in points {
        let (z, _) = argument(&impulse, &free, &step);
        findings.push(Finding::decision(format!("{state}: r = P_K(r − ηy)"), euclidean(&z, &mu) == impulse, true));
        findings.push(Finding::decision(format!("{state}: the projection is in the case {case:?}"), decide(&z, &mu) == case, true));
    }
    // an iterate that is no fixed point, or the fixed point of a block that sticks
    let (iterate, load) = reading.only(0).pick((plane([4, 1], [0, 1]), slipping), (plane([2, 1], [1, 2]), plane([-2, 1], [-1, 2])));
    let (z, velocity) = argument(&iterate, &load, &step);
    findings.push(Finding::decision("the iterate (4, 0) is in the case Stays", decide(&z, &mu) == Case::Stays, true));
    findings.push(
        Finding::decision("its tangential velocity vanishes", velocity[1] == ratio(0, 1), false)
            .says(true)
            .violating("a fixed point r = P_K(r − ηy)"),
    );
    Ok(findings)
}

fn weighted_projection(reading: Reading) -> Result<Vec<Finding>> {
    let (mu, weight) = (ratio(1, 2), reading.only(0).pick(ratio(1, 1000), ratio(1, 1)));
    let in_norm = |y: &Plane| project_weighted(y, &mu, &weight);
    let without = |y: &Plane| euclidean(y, &mu);
    let [of_sap, of_apgd]: [&dyn Fn(&Plane) -> Plane; 2] = reading.only(1).pick([&in_norm, &without], [&without, &in_norm]);
    let mut findings = Vec::new();
    let (mut beside, mut bound) = (0.0f64, 0.0f64);
    for (y, normal) in [
        (plane([1, 1], [2, 1]), ratio(4004, 4001)),
        (plane([-1, 10_000], [1, 1]), ratio(8, 20_005)),
        (plane([0, 1], [-3, 1]), ratio(6, 4001)),
    ] {
        let gamma = of_sap(&y);
        // in the norm of R with R_t/R_n = 1/1000, whatever the subject takes
        let rest = [y[0].clone() - gamma[0].clone(), ratio(1, 1000) * (y[1].clone() - gamma[1].clone())];
        let nearest = in_cone(&gamma, &mu) && in_polar(&rest, &mu) && dot(&gamma, &rest) == ratio(0, 1);
        let name = format!("y = ({}, {})", y[0], y[1]);
        findings.push(Finding::decision(format!("SAP's γ meets the conditions in the norm of R, {name}"), nearest, true));
        findings.push(
            Finding::exact(format!("SAP's γ_n, {name}"), &gamma[0], &normal, "N·s").says(&euclidean(&y, &mu)[0]).violating("R_t = R_n"),
        );
        beside = beside.max(beside_the_library(&of_apgd(&y), &y, &mu));
        bound = bound.max(rounding(16, y[0].to_f64().value().hypot(y[1].to_f64().value())));
    }
    findings.push(Finding::at_most("APGD's projection less that of the library", beside, bound, "N·s"));
    Ok(findings)
}

/// One-sided difference quotients in the last parameter; exact, as the solutions are piecewise linear.
pub(super) fn one_sided<const N: usize>(solution: impl Fn(Rational) -> [Rational; N], at: &Rational) -> [[Rational; N]; 2] {
    [ratio(-1, 100), ratio(1, 100)].map(|step| {
        let (here, there) = (solution(at.clone()), solution(at.clone() + step.clone()));
        std::array::from_fn(|i| (there[i].clone() - here[i].clone()) / step.clone())
    })
}

fn differentiability(reading: Reading) -> Result<Vec<Finding>> {
    let zero = ratio(0, 1);
    let half_line = |theta: &Rational| Minimum::projection([ratio(1, 1)], std::array::from_ref(theta), vec![[ratio(1, 1)]]);
    let positive_part = |theta: Rational| {
        let part = || [if theta > zero { theta.clone() } else { ratio(0, 1) }];
        decided(part, |found| half_line(&theta).witness(found))
    };
    let [[left], [right]] = one_sided(positive_part, &reading.pick(ratio(0, 1), ratio(1, 1)));
    let mu = ratio(1, 2);
    // minimiser of ½‖γ‖² + r·γ over K is the projection of −r
    let contact = |tangent: Rational| euclidean(&[ratio(2, 1), -tangent], &mu);
    let [stick, slip] = one_sided(contact, &reading.pick(ratio(1, 1), ratio(1, 2)));
    let jump = |name: &str, sides: [&Rational; 2], expected: Rational| {
        Finding::exact(format!("jump of {name}"), &(sides[1] - sides[0]), &expected, "1").says(ratio(0, 1))
    };
    Ok(vec![
        jump("the derivative of max(0, θ)", [&left, &right], ratio(1, 1)),
        jump("∂γ_n/∂r_t from stick to slip", [&stick[0], &slip[0]], ratio(2, 5)),
        jump("∂γ_t/∂r_t from stick to slip", [&stick[1], &slip[1]], ratio(4, 5)),
        Finding::exact("∂γ_t/∂r_t on the side of slip", &slip[1], &ratio(-1, 5), "1").context(),
    ])
}
