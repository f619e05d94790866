//! Claims of §5 on what the relaxation buys: convex solution sets, uniqueness, derivatives, and its independence of the shape of the cone.

use super::planar_step::{PlanarStep, box_on_two_corners, painleve_rod};
use crate::certificate::residuals;
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
        argument: "Painlevé's rod (W = (73, −36; −36, 52)/25, μ = 3 > 73/36, free velocity (1/10, −1)): enumeration of all complementary \
            cones gives exactly three isolated solutions, r = 0, the sliding jam r = (1/14, 3/14) and \
                   the sticking jam r = (77/250, 347/500). Their pairwise midpoints are not solutions.",
        controls: &["The same rod with μ = 1 < 73/36, where the solution is unique."],
        sources: &["chapter §5, why the original problem is not convex", "enumeration of the Stewart–Trinkle LCP"],
        check: three_solutions,
    },
    Claim {
        id: "S5.unique-vs-lcp",
        statement: "Against the LCP, whose solution may be non-unique, the convex step buys uniqueness, differentiability and stability.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Exact,
        correct_statement: "The convex step makes v⁺ and Nγ unique also where the LCP has several solutions; γ is unique only if N is \
            definite, and uniqueness does not make the relaxed answer the right one.",
        argument: "Painlevé's rod with μ = 3: the Stewart–Trinkle LCP has three solutions, the convex step one. On two sticking corners of \
            a box the convex step has infinitely many impulses with one velocity.",
        controls: &["The rod in place of the box: its convex step has one impulse."],
        sources: &["chapter §5, pitfalls", "enumeration of both LCPs"],
        check: uniqueness,
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
        controls: &["The rod's LCP in the place of the relaxed problem: its midpoint would have to be a solution."],
        sources: &["chapter §5, pitfalls"],
        check: midpoints,
    },
    Claim {
        id: "S5.orthogonal",
        statement: "The polyhedral cone (shape of the cone) and the convex relaxation (structure of the constraint) are two independent \
            approximations that can be combined freely.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Certified,
        correct_statement: "All four combinations exist. The relaxation decides whether a sliding contact lifts off, u_n = μ|u_t|-like or \
            0; the shape decides how strong friction is in which direction.",
        argument: "One contact with W = I, μ = 1/2, sliding at 2 m/s in the direction 22.5° from tangent 1 against u_n = −1: all four laws \
            are solved and certified. Round and polyhedral (d = 4) Coulomb keep u_n = 0, both relaxed laws lift off. \
                   The friction of the round cone opposes sliding, that of the polyhedral one points along a direction 22.5° beside it, \
                   relaxed or not.",
        controls: &["Coulomb's laws in the place of the relaxed ones: nothing lifts off."],
        sources: &["chapter §5, two orthogonal approximations"],
        check: four_combinations,
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
        argument: "By §3 the frictionless LCP is the optimality system of the QP, so their solutions are the same function and cannot \
            differ in differentiability. 0 ≤ z ⟂ 2z + θ ≥ 0 (Lemke) and min z² + θz over z ≥ 0 (projection of the unconstrained minimiser) \
            both have the slopes −1/2 for θ < 0 and 0 for θ > 0; \
                   §6 itself calls the convex problem only subdifferentiable at the boundary of the cone.",
        controls: &["The solution away from the change of the active set (at θ = −1): neither passage gives it a kink."],
        sources: &["chapter §5, convexity and differentiable contact", "chapter §3, QP form of the normal LCP", "chapter §6"],
        check: same_kink,
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
    corrected.shift[0] += step.friction[0].clone() * super::planar_step::magnitude(&y[1]);
    corrected.is_cone_complementary(impulse)
}

fn midpoint(one: &DVector<Rational>, other: &DVector<Rational>) -> DVector<Rational> {
    (one + other) * ratio(1, 2)
}

fn three_solutions(reading: Reading) -> Result<Vec<Finding>> {
    let rod = painleve_rod(reading.pick(ratio(3, 1), ratio(1, 1)));
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
    let resting = box_on_two_corners([ratio(0, 1), ratio(-1, 1), ratio(0, 1)], ratio(1, 2));
    let rod = painleve_rod(ratio(3, 1));
    let redundant = reading.pick(resting.clone(), rod.clone());
    let [one, other] = sticking_pair(&resting)?;
    Ok(vec![
        Finding::decision("the convex step of the rod has one impulse", all_solutions(&rod.edge_lcp())?.is_unique(), true),
        Finding::count("solutions of the LCP of the rod", rod_solutions(&rod)?.len(), 3),
        Finding::decision("the convex step of the box has one impulse", all_solutions(&redundant.edge_lcp())?.is_unique(), false)
            .says(true)
            .violating("a definite N"),
        Finding::decision("two impulses of the box give one velocity", resting.velocity(&one) == resting.velocity(&other), true).context(),
    ])
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
    let polyhedral = is_coulomb(&rod, &midpoint(&jams[0], &jams[jams.len() - 1]));
    let resting = box_on_two_corners([ratio(0, 1), ratio(-1, 1), ratio(0, 1)], ratio(1, 2));
    let [one, other] = sticking_pair(&resting)?;
    let relaxed = match reading {
        Reading::Recorded => resting.is_cone_complementary(&midpoint(&one, &other)),
        Reading::Control(_) => polyhedral,
    };
    Ok(vec![
        Finding::decision("the midpoint of two relaxed solutions is one", relaxed, true),
        Finding::decision("the midpoint of two polyhedral solutions is one", polyhedral, false),
        Finding::decision(
            "the two relaxed solutions are solutions",
            resting.is_cone_complementary(&one) && resting.is_cone_complementary(&other),
            true,
        ),
    ])
}

fn four_combinations(reading: Reading) -> Result<Vec<Finding>> {
    let direction = std::f64::consts::PI / 8.0;
    let relaxed = reading
        .pick([Law::Associated, Law::PolyhedralAssociated { directions: 4 }], [Law::Coulomb, Law::PolyhedralCoulomb { directions: 4 }]);
    let exact_laws = [Law::Coulomb, Law::PolyhedralCoulomb { directions: 4 }];
    let mut findings = Vec::new();
    for (laws, lifts) in [(relaxed, true), (exact_laws, false)] {
        for law in laws {
            let problem =
                ContactProblem::new(DMatrix::identity(3, 3), DVector::from_vec(vec![-1.0, 2.0 * direction.cos(), 2.0 * direction.sin()]))
                    .name(law.name())
                    .law(law)
                    .friction(vec![0.5])
                    .build()?;
            let solution = Auto.solve(&problem, None)?;
            let bound = tolerance::solvers::STOP;
            let residual = residuals(&problem, &solution)?.natural_map;
            // a relaxed contact lifts off by at least μ u_t cos(π/4) with u_t ≥ 2 − μ r_n, r_n ≤ 2
            let lifted = solution.velocity[0] > 1.0 / 8.0;
            findings.push(Finding::decision(format!("the sliding contact lifts off, law {}", law.name()), lifted, lifts));
            findings.push(Finding::at_most(format!("natural map, {}", law.name()), residual, bound * 4.0, "N·s"));
            let beside = (-solution.impulse[2]).atan2(-solution.impulse[1]) - direction;
            let round = law.directions().is_none();
            let expected = if round { 0.0 } else { direction };
            findings.push(Finding::equal(
                format!("angle of friction beside sliding, {}", law.name()),
                beside.abs(),
                expected,
                16.0 * bound,
                "rad",
            ));
        }
    }
    Ok(findings)
}

/// z(θ) of 0 ≤ z ⟂ 2z + θ ≥ 0.
fn by_lcp(theta: &Rational) -> Result<Rational> {
    let lcp = Lcp::new(DMatrix::from_element(1, 1, ratio(2, 1)), DVector::from_element(1, theta.clone()));
    Ok(solution(&lcp)?[0].clone())
}

/// z(θ) of min z² + θz over z ≥ 0: the minimiser −θ/2 projected on the half-line.
fn by_program(theta: &Rational) -> Rational {
    let free = -theta.clone() * ratio(1, 2);
    if free > ratio(0, 1) { free } else { ratio(0, 1) }
}

fn same_kink(reading: Reading) -> Result<Vec<Finding>> {
    let step = exact(2f64.powi(-20));
    let place = reading.pick(ratio(0, 1), ratio(-1, 1));
    let around = [place.clone() - step.clone(), place.clone(), place + step.clone()];
    let slope = |right: &Rational, left: &Rational| (right - left) / &step;
    let [left, middle, right] = [by_lcp(&around[0])?, by_lcp(&around[1])?, by_lcp(&around[2])?];
    let kink = slope(&middle, &left) != slope(&right, &middle);
    let switches = left.is_zero() != right.is_zero();
    let mut apart = 0;
    for theta in around.iter().cloned().chain((-8..=8).map(|k| ratio(k, 4))) {
        apart += usize::from(by_lcp(&theta)? != by_program(&theta));
    }
    let [before, zero, after] = [by_lcp(&-step.clone())?, by_lcp(&ratio(0, 1))?, by_lcp(&step)?];
    let finding = || Finding::decision("the solution, the same of LCP and QP, has a kink", kink, true);
    Ok(vec![
        Finding::count("parameters, of 20, at which LCP and QP have different solutions", apart, 0),
        finding().says(switches).passage("§5 on the LCP: not differentiable where the active set changes"),
        finding().says(false).passage("§5 on the strictly convex QP: continuously differentiable"),
        Finding::exact("slope of the LCP before the switch", &slope(&zero, &before), &ratio(-1, 2), "1"),
        Finding::exact("slope of the LCP after the switch", &slope(&after, &zero), &ratio(0, 1), "1"),
    ])
}
