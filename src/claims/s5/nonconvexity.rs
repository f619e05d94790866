//! Claims of §5 on what the relaxation buys: convex solution sets, uniqueness, derivatives, and its independence of the shape of the cone.

use super::cone::{euclidean, one_sided};
use crate::certificate::residuals;
use crate::claims::experiments::planar_step::{PlanarStep, box_on_two_corners, magnitude, painleve_rod};
use crate::claims::prelude::*;
use crate::problem::{ContactProblem, Law, Lcp};
use crate::scalar::exact;
use crate::solvers::enumeration::all_solutions;
use crate::solvers::lemke::solution;
use crate::solvers::{Auto, ContactSolver};
use crate::tolerance;

/// The claims of this file.
pub(super) const CLAIMS: &[Claim] = &[
    Claim {
        id: "S5.nonconvex",
        statement: "The exact step problem with Coulomb friction has solutions, but their set may be non-convex (after Anitescu and Hart).",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: "Coulomb's step problem may have a non-convex solution set, for instance three isolated solutions.",
        argument: r"Painlevé's rod, $\mu = 3$, whose tip separates at 1/10 m/s while it slides at 1 m/s: enumeration of all complementary
            cones gives exactly three isolated solutions: no impulse, a jam that slides on and a jam that sticks. Their pairwise midpoints
            are not solutions.",
        controls: &[
            r"The same rod with $\mu = 1$, where the solution is unique.",
            "A box that sticks on two corners: midpoints of its solutions are solutions.",
        ],
        sources: &["chapter §5, why the original problem is not convex", "enumeration of the Stewart–Trinkle LCP"],
        check: check!(three_solutions),
    },
    Claim {
        id: "S5.unique-vs-lcp",
        statement: "The LCP is non-unique in simultaneous impacts of several bodies; with a little controllable slip the convex formats \
            buy uniqueness, differentiability and stability, usually a net gain in robot tasks.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Exact,
        correct_statement: r"The convex step makes $v^+$ and $N\gamma$ unique also where the LCP has several solutions; $\gamma$ is unique
            only if $N$ is definite. Its solution is differentiable inside stick, slip or separation, not where it changes from one to
            another. What a net gain is, is not decided here.",
        argument: r"Painlevé's rod with $\mu = 3$: the Stewart–Trinkle LCP has three solutions, the convex step one. A box that lands on
            two corners: both the LCP and the convex step have infinitely many impulses. One contact with $\mu = 1/2$ under the load
            $(-2, b_t)$: the one-sided derivatives of the relaxed impulse agree at $b_t = 1/2$, where it sticks, and differ at $b_t = 1$,
            where it begins to slip.",
        controls: &[
            "A single corner in place of the two: its convex step has one impulse, and so has its LCP.",
            "The box in place of the rod, whose convex step has many impulses.",
            "The loads at which derivatives are taken exchanged.",
        ],
        sources: &["chapter §5, pitfalls", "enumeration of both LCPs"],
        check: check!(uniqueness),
    },
    Claim {
        id: "S5.apitfall-poly",
        statement: "Polyhedral and relaxed are different things: polyhedral friction leaves an LCP that may be non-convex, the relaxation \
            makes the solution set convex.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: "The polyhedral step is an LCP whose solution set may be non-convex; the solution set of the relaxed step is \
            convex.",
        argument: "The midpoint of two solutions of the rod's Stewart–Trinkle LCP is not a solution. Minimisers of a convex program form a \
            convex set: the midpoint of two different optimal impulses of the sticking box is optimal.",
        controls: &[
            "The rod and its jams in place of the relaxed problem and its solutions.",
            "The box and its sticking impulses in place of the rod and its jams: their midpoint is a solution.",
        ],
        sources: &["chapter §5, pitfalls"],
        check: check!(midpoints),
    },
    Claim {
        id: "S5.orthogonal",
        statement: "The polyhedral cone (shape of the cone) and the convex relaxation (structure of the constraint) are two independent \
            approximations that can be combined freely.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Certified,
        correct_statement: r"All four combinations exist. The relaxation decides whether a sliding contact lifts off,
            $u_n = \mu|u_t|$-like or 0; the shape decides how strong friction is in which direction.",
        argument: r"One contact with $W = I$, $\mu = 1/2$, sliding at 2 m/s in the direction $\pi/8$ from tangent 1 against $u_n = -1$:
            all four laws are solved and certified. Round and polyhedral ($d = 4$) Coulomb keep $u_n = 0$, both relaxed laws lift off. The
            friction of the round cone opposes sliding, that of the polyhedral one points along a direction $\pi/8$ beside it, relaxed or
            not.",
        controls: &[
            "The answers of the other structure, Coulomb's for the relaxed laws and conversely.",
            "The answers of the other shape, the polyhedral for the round and conversely.",
        ],
        sources: &["chapter §5, two orthogonal approximations"],
        check: check!(four_combinations),
    },
    Claim {
        id: "S5.diff-necessary",
        statement: "Convexity is the necessary premise of differentiable contact: LCP solutions are not differentiable where the active \
            set changes, solutions of a strictly convex QP are; back-propagation through KKT conditions is well defined only in the convex \
            case.",
        verdict: ClaimVerdict::Inconsistent,
        kind: Kind::Assertion,
        severity: Some(Severity::WrongStatement),
        evidence: Evidence::Exact,
        correct_statement: "Convexity buys uniqueness and Lipschitz continuity, not derivatives. At a change of the active set both the \
            LCP and the QP have a kink; away from it both are differentiable by the implicit function theorem. (That the QP's solution is \
            differentiable at all parameters is S5.diff.)",
        argument: r"By §3 the frictionless LCP is the optimality system of the QP, so their solutions are the same function and cannot
            differ in differentiability. $0 \le z \perp 2z + \theta \ge 0$ (Lemke) and min $z^2 + \theta z$ over $z \ge 0$ (projection of
            the unconstrained minimiser) both have the slopes −1/2 for $\theta < 0$ and 0 for $\theta > 0$; §6 itself calls the convex
            problem only subdifferentiable at the boundary of the cone.",
        controls: &[
            r"The solution away from the change of the active set (at $\theta = -1$): neither passage gives it a kink.",
            r"The factor 2 of the gradient forgotten in the LCP: $0 \le z \perp z + \theta \ge 0$.",
        ],
        sources: &["chapter §5, convexity and differentiable contact", "chapter §3, QP form of the normal LCP", "chapter §6"],
        check: check!(same_kink),
    },
];

/// r of every solution of the rod's Stewart–Trinkle LCP.
fn rod_solutions(rod: &PlanarStep) -> Result<Vec<DVector<Rational>>> {
    let problem = rod.stewart_trinkle()?;
    let set = all_solutions(&problem.lcp)?;
    let mut impulses: Vec<_> = set.points.iter().map(|z| problem.impulse(z)).collect();
    impulses.sort_by(|a, b| a[0].cmp(&b[0]));
    impulses.dedup();
    Ok(impulses)
}

/// Whether r solves Coulomb's planar contact exactly: the cone complementarity with y_n + μ|y_t| in place of y_n.
fn is_coulomb(step: &PlanarStep, impulse: &DVector<Rational>) -> bool {
    let y = step.law_velocity(impulse);
    let mut corrected = step.clone();
    for (contact, mu) in step.friction.iter().enumerate() {
        corrected.shift[2 * contact] += mu.clone() * magnitude(&y[2 * contact + 1]);
    }
    corrected.is_cone_complementary(impulse)
}

fn midpoint(one: &DVector<Rational>, other: &DVector<Rational>) -> DVector<Rational> {
    (one + other) * ratio(1, 2)
}

fn three_solutions(reading: Reading) -> Result<Vec<Finding>> {
    let rod = match reading {
        Reading::Recorded => painleve_rod(ratio(3, 1)),
        Reading::Control(0) => painleve_rod(ratio(1, 1)),
        Reading::Control(_) => resting_box(),
    };
    let solutions = rod_solutions(&rod)?;
    let count = solutions.len();
    let pairs = (0..count).flat_map(|i| (0..i).map(move |j| (i, j)));
    let convex = pairs.filter(|&(i, j)| is_coulomb(&rod, &midpoint(&solutions[i], &solutions[j]))).count();
    Ok(vec![
        Finding::count("solutions of Coulomb's step", count, 3),
        Finding::count("solutions confirmed by Coulomb's law itself", solutions.iter().filter(|r| is_coulomb(&rod, r)).count(), 3),
        Finding::count("midpoints that are solutions", convex, 0),
    ])
}

fn uniqueness(reading: Reading) -> Result<Vec<Finding>> {
    let landing = reading.only(0).pick(resting_box(), PlanarStep::point([ratio(0, 1), ratio(-1, 1)], ratio(0, 1), ratio(1, 2)));
    let rod = reading.only(1).pick(painleve_rod(ratio(3, 1)), resting_box());
    let of_one_impulse = |step: &PlanarStep| -> Result<bool> { Ok(all_solutions(&step.edge_lcp())?.is_unique()) };
    // the impulse under the load (−2, b_t) with W = I is the projection of −b
    let impulse = |load: Rational| euclidean(&[ratio(2, 1), -load], &ratio(1, 2));
    let agree = |load: Rational| one_sided(impulse, &load).windows(2).all(|sides| sides[0] == sides[1]);
    let [inside, between] = reading.only(2).pick([ratio(1, 2), ratio(1, 1)], [ratio(1, 1), ratio(1, 2)]);
    Ok(vec![
        Finding::decision("the LCP of a box that lands on two corners has one impulse", rod_solutions(&landing)?.len() == 1, false),
        Finding::count("solutions of the LCP of the rod", rod_solutions(&rod)?.len(), 3),
        Finding::decision("the convex step of the rod has one impulse", of_one_impulse(&rod)?, true),
        Finding::decision("the convex step of the box has one impulse", of_one_impulse(&landing)?, false)
            .says(true)
            .violating("a definite N"),
        Finding::decision("one-sided derivatives of a relaxed impulse agree inside stick", agree(inside), true),
        Finding::decision("one-sided derivatives of a relaxed impulse agree where slip begins", agree(between), false)
            .says(true)
            .violating("the contact keeps its state"),
    ])
}

/// A box that lands flat on two corners and sticks.
fn resting_box() -> PlanarStep {
    box_on_two_corners([ratio(0, 1), ratio(-1, 1), ratio(0, 1)], ratio(1, 2))
}

/// Two different optimal impulses of the box on two sticking corners.
fn sticking_pair(resting: &PlanarStep) -> Result<[DVector<Rational>; 2]> {
    let one = DVector::from_vec(vec![ratio(1, 2), ratio(0, 1), ratio(1, 2), ratio(0, 1)]);
    let other = DVector::from_vec(vec![ratio(1, 2), ratio(1, 4), ratio(1, 2), ratio(-1, 4)]);
    debug_assert!(resting.is_cone_complementary(&one) && resting.is_cone_complementary(&other));
    Ok([one, other])
}

fn midpoints(reading: Reading) -> Result<Vec<Finding>> {
    let rod = painleve_rod(ratio(3, 1));
    let jams = rod_solutions(&rod)?;
    let jams = (rod, jams[0].clone(), jams[jams.len() - 1].clone());
    let resting = resting_box();
    let [one, other] = sticking_pair(&resting)?;
    let sticking = (resting, one, other);
    let (relaxed, one, other) = reading.only(0).pick(&sticking, &jams);
    let (polyhedral, first, last) = reading.only(1).pick(&jams, &sticking);
    Ok(vec![
        Finding::decision("the midpoint of two relaxed solutions is one", relaxed.is_cone_complementary(&midpoint(one, other)), true),
        Finding::decision("the midpoint of two polyhedral solutions is one", is_coulomb(polyhedral, &midpoint(first, last)), false),
        Finding::decision(
            "the two relaxed solutions are solutions",
            relaxed.is_cone_complementary(one) && relaxed.is_cone_complementary(other),
            true,
        ),
    ])
}

fn four_combinations(reading: Reading) -> Result<Vec<Finding>> {
    let direction = std::f64::consts::PI / 8.0;
    let bound = tolerance::solvers::STOP;
    let (relaxed, exact) = (Law::Associated, Law::Coulomb);
    let [relaxed_edges, exact_edges] = [Law::PolyhedralAssociated { directions: 4 }, Law::PolyhedralCoulomb { directions: 4 }];
    let laws = [relaxed, relaxed_edges, exact, exact_edges];
    // whose answers stand for theirs
    let solved = match reading {
        Reading::Recorded => laws,
        Reading::Control(0) => [exact, exact_edges, relaxed, relaxed_edges],
        Reading::Control(_) => [relaxed_edges, relaxed, exact_edges, exact],
    };
    let mut findings = Vec::new();
    for ((law, solved), lifts) in laws.into_iter().zip(solved).zip([true, true, false, false]) {
        let solution = Auto.solve(&slide(solved, direction)?, None)?;
        let residual = residuals(&slide(law, direction)?, &solution)?.natural_map;
        // a relaxed contact lifts off by at least μ u_t cos(π/4) with u_t ≥ 2 − μ r_n, r_n ≤ 2
        let lifted = solution.velocity[0] > 1.0 / 8.0;
        findings.push(Finding::decision(format!("the sliding contact lifts off, law {}", law.name()), lifted, lifts));
        findings.push(Finding::at_most(format!("natural map, {}", law.name()), residual, bound * 4.0, "N·s"));
        let beside = (-solution.impulse[2]).atan2(-solution.impulse[1]) - direction;
        let round = law.directions().is_none();
        let expected = if round { 0.0 } else { direction };
        let name = format!("angle of friction beside sliding, {}", law.name());
        findings.push(Finding::equal(name, beside.abs(), expected, 16.0 * bound, "rad"));
    }
    Ok(findings)
}

/// A contact with W = I and μ = ½ that slides at 2 m/s in a direction and arrives at 1 m/s.
fn slide(law: Law, direction: f64) -> Result<ContactProblem> {
    let free = dvector![-1.0, 2.0 * direction.cos(), 2.0 * direction.sin()];
    ContactProblem::new(DMatrix::identity(3, 3), free).name(law.name()).law(law).friction(vec![0.5]).build()
}

/// z(θ) of 0 ≤ z ⟂ a z + θ ≥ 0.
fn by_lcp(a: i64, theta: &Rational) -> Result<Rational> {
    let lcp = Lcp::new(DMatrix::from_element(1, 1, ratio(a, 1)), DVector::from_element(1, theta.clone()));
    Ok(solution(&lcp)?[0].clone())
}

/// z(θ) of min z² + θz over z ≥ 0: the minimiser −θ/2 projected on the half-line.
fn by_program(theta: &Rational) -> Rational {
    let free = -theta.clone() * ratio(1, 2);
    if free > ratio(0, 1) { free } else { ratio(0, 1) }
}

fn same_kink(reading: Reading) -> Result<Vec<Finding>> {
    let step = exact(2f64.powi(-20));
    let place = reading.only(0).pick(ratio(0, 1), ratio(-1, 1));
    let factor = reading.only(1).pick(2, 1);
    let by_lcp = |theta: &Rational| by_lcp(factor, theta);
    let around = [place.clone() - step.clone(), place.clone(), place + step.clone()];
    let slope = |right: &Rational, left: &Rational| (right - left) / &step;
    let [left, middle, right] = [by_lcp(&around[0])?, by_lcp(&around[1])?, by_lcp(&around[2])?];
    let kink = slope(&middle, &left) != slope(&right, &middle);
    let switches = left.is_zero() != right.is_zero();
    let mut apart = 0;
    for theta in around.iter().cloned().chain((-8..=8).map(|k| ratio(k, 4))) {
        apart += usize::from(by_lcp(&theta)? != by_program(&theta));
    }
    let finding = || Finding::decision("the solution, the same of LCP and QP, has a kink", kink, true);
    Ok(vec![
        Finding::count("parameters, of 20, at which LCP and QP have different solutions", apart, 0),
        finding().says(switches).passage("§5 on the LCP: not differentiable where the active set changes"),
        finding().says(false).passage("§5 on the strictly convex QP: continuously differentiable"),
        Finding::exact("slope of the LCP before the place", &slope(&middle, &left), &ratio(-1, 2), "1"),
        Finding::exact("slope of the LCP after the place", &slope(&right, &middle), &ratio(0, 1), "1"),
    ])
}
