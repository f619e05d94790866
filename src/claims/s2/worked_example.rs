//! The worked example of §2 – a point on the line and a wall at 0 – and the exercises on it.

use super::half_space::{Impact, TangentCone, grid, line_normal_cone_contains, pairs, whole};
use crate::claims::prelude::*;
use crate::problem::PlanarProblem;
use crate::solvers::enumeration::all_solutions;
use std::cmp::Ordering::{self, Equal, Greater, Less};
use std::collections::BTreeSet;

/// Claims of the worked example and the exercises.
pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S2.case2",
        statement: r"Case two of the example: from $-M\,dv \in N_{T_C(0)}(v^+)$, with $v^- < 0$, the impulse makes $v^+ = 0$ (plastic,
            $e = 0$) or $v^+ = -e\,v^- = e|v^-| > 0$ (rebound).",
        verdict: ClaimVerdict::False,
        kind: Kind::Assertion,
        severity: Some(Severity::WrongStatement),
        evidence: Evidence::Exact,
        correct_statement: r"$-M\,dv \in N_{T_C(0)}(v^+)$ has the one solution $v^+ = 0$. A rebound needs the argument $v^+ + e\,v^-$ of
            §3, whose one solution is $v^+ = -e\,v^-$.",
        argument: r"If $v^+ > 0$, then $v^+$ is interior to $T_C(0) = \{u \ge 0\}$, $N = \{0\}$, and $v^+ = v^- < 0$: a contradiction.
            From $v^- = -1$ the solutions of the printed inclusion are $\{0\}$; $v^+ = 1/2$ is none of them. The text means the two impact
            laws and labels them by $e$; only the replacement of the argument is missing.",
        controls: &[r"The inclusion with the argument $v^+ + e\,v^-$, whose solution is $-e\,v^-$ for either $e$.", r"The argument $v^-$."],
        sources: &["chapter §2, worked example, case two"],
        check: check!(case_two),
    },
    Claim {
        id: "S2.cone-direction",
        statement: r"In case two the normal cone $N_{T_C(0)}(0) = \{g \le 0\}$ is the normal pointing into the set.",
        verdict: ClaimVerdict::False,
        kind: Kind::Assertion,
        severity: Some(Severity::Misprint),
        evidence: Evidence::Exact,
        correct_statement: r"The set $\{g \le 0\}$ is right; for $C = \{q \ge 0\}$ it points out of $C$. The force $-g$ is what points
            in.",
        argument: r"$0 + t\,g = -t \notin C$ for $g = -1$ and every $t > 0$. Only the words in parentheses are wrong; three lines on, the
            text has the wall push along the inward normal, which is right.",
        controls: &[r"The force $-g$ in place of the members $g$ of the cone.", r"A wall on the other side, $C = \{q \le 0\}$."],
        sources: &["chapter §2, worked example, case two"],
        check: check!(cone_direction),
    },
    Claim {
        id: "S2.case13",
        statement: r"Cases one and three: inside ($q > 0$), or at the wall and leaving ($q = 0$, $v > 0$), there is no force and $v$ does
            not change.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"As stated: the normal cone is $\{0\}$.",
        argument: r"Inside $T_C = \mathbb{R}$, at the wall with $v > 0$ the velocity is interior to $T_C = \{u \ge 0\}$; in both
            $N = \{0\}$, hence $P = m(v^+ - v^-) = 0$. The solution sets for $v^- = 1/3$, 2 are $\{v^-\}$, and of all $g = -2$ … 2 only 0
            is in the cone.",
        controls: &[r"Case two in place of both: at the wall with $v^- < 0$."],
        sources: &["chapter §2, worked example, cases one and three"],
        check: check!(cases_one_and_three),
    },
    Claim {
        id: "S2.branches",
        statement: r"The three cases are the three branches of $0 \le \varphi \perp \lambda \ge 0$: ($\varphi > 0$, $\lambda = 0$),
            ($\varphi = 0$, $\lambda > 0$), ($\varphi = 0$, $\lambda = 0$).",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: "As stated; these are all branches.",
        argument: r"At $q = 0$, 1/2, 2 and $v^- = -2$ … 2 the inclusion gives $\lambda = v^+ - v^-$: it is 0 inside, positive against the
            wall, 0 where the point leaves it. These are three of the nine pairs of signs of $\varphi$ and $\lambda$, and the only ones
            with $0 \le \varphi$, $0 \le \lambda$ and $\varphi\lambda = 0$.",
        controls: &[
            r"A wall that holds the point fast: leaving has $\lambda < 0$.",
            "A wall at 1/2 in place of 0, its gap measured from 0.",
        ],
        sources: &["chapter §2, insight after the worked example"],
        check: check!(branches),
    },
    Claim {
        id: "S2.ex1",
        statement: r"Exercise 1: with Newton's law the impulse at the wall is $P = -2\,m\,v^-$ for $e = 1$ and $P = -m\,v^-$ for
            $e = 0$.",
        verdict: ClaimVerdict::True,
        kind: Kind::Exercise,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"$P = m(v^+ - v^-) = -(1 + e)\,m\,v^-$.",
        argument: r"Integrating the inclusion over the atom gives $P = m(v^+ - v^-)$; $v^+ = -e\,v^-$ is the only solution with argument
            $v^+ + e\,v^-$. For $m = 3/2$ and $v^- = -2$: $P = 3$, 9/2, 6 N·s for $e = 0$, 1/2, 1.",
        controls: &[r"The argument $v^+ + v^-/3$ instead of $v^+ + e\,v^-$.", r"The argument $v^-$ alone, with which there is no impact."],
        sources: &["chapter §2, exercise 1"],
        check: check!(exercise_one),
    },
    Claim {
        id: "S2.ex3",
        statement: r"Exercise 3: in persistent contact (no impact, $d\mu = dt$) $-M\,\dot v + F \in N_{T_C}(v^+)$ is equivalent to
            $0 \le \lambda_n$ ⟂ ($\nabla\varphi^Tv^+$ or $\varphi$) $\ge 0$; with the friction cone $\|\beta\| \le \mu\lambda_n$ added
            this becomes an NCP and not an LCP.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Exercise,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Exact,
        correct_statement: r"The equivalence holds on $\varphi = 0$. The printed cone leaves an LCP in the plane, where it is a
            polyhedron; the nonlinear problem comes with the circular cone of a spatial contact.",
        argument: r"At $\varphi > 0$ the inclusion admits every $v^+$ with $\lambda = 0$, the complementarity only those with
            $\nabla\varphi\cdot v^+ \ge 0$. In the plane the Stewart–Trinkle LCP with $\pm t$ has for $W = I$, $u_\text{free} = (-1, 1)$,
            $\mu = 1/2$ the one solution $r = (1, -1/2)$, on the cone and opposed to $u = (0, 1/2)$: Coulomb's law, exactly. In space,
            four directions and $u_\text{free} = (-1, 1, 1)$, the same LCP gives $\|r_t\|^2/(\mu\,r_n)^2 = 1/2$ instead of 1. No rational
            LCP with one solution can do better there: Coulomb's $r_t = -(1, 1)/(2\sqrt2)$ is irrational.",
        controls: &[
            "The spatial contact in place of the planar one.",
            r"The force along $-\nabla\varphi$, and the planar contact in place of the spatial one.",
        ],
        sources: &["chapter §2, exercise 3"],
        check: check!(exercise_three),
    },
];

fn case_two(reading: Reading) -> Result<Vec<Finding>> {
    let pre = whole(-1);
    let mut findings = Vec::new();
    for (e, admitted) in [(whole(0), true), (ratio(1, 2), false)] {
        let argument = reading.only(1).pick([whole(1), reading.only(0).pick(whole(0), e.clone())], [whole(0), whole(1)]);
        let [after, before] = argument;
        let inclusion = Impact { mass: whole(1), after, before };
        let post = -(&e * &pre);
        findings.push(Finding::decision(format!("v⁺ = −e v⁻ = {post} is a solution"), inclusion.admits(&pre, &post), admitted).says(true));
        findings.push(Finding::count(format!("solutions from v⁻ = −1, e = {e}"), inclusion.solutions(&pre).len(), 1));
    }
    Ok(findings)
}

fn cone_direction(reading: Reading) -> Result<Vec<Finding>> {
    let (side, wall) = (reading.only(0).pick(1, -1), reading.only(1).pick(1, -1));
    let members: Vec<i64> = (-2..=2).filter(|g| line_normal_cone_contains(true, &whole(0), &whole(wall * g))).collect();
    let inside = |q: Rational| q * whole(wall) >= whole(0);
    let mut findings = vec![Finding::decision("of −2 … 2 the members of N(0) are those with g ≤ 0", members == [-2, -1, 0], true)];
    for g in [-2, -1] {
        let stays = inside(whole(side * g) * ratio(1, 1000));
        findings.push(Finding::decision(format!("g = {g} points into C"), stays, false).says(true));
    }
    Ok(findings)
}

fn cases_one_and_three(reading: Reading) -> Result<Vec<Finding>> {
    let sign = reading.pick(whole(1), whole(-1));
    let mut findings = Vec::new();
    for speed in [ratio(1, 3), whole(2)] {
        let pre = sign.clone() * &speed;
        for post in Impact::moreau(whole(1), whole(0)).solutions(&pre) {
            findings.push(Finding::exact(format!("impulse at the wall, |v⁻| = {speed}"), &(post - pre.clone()), &whole(0), "N·s"));
        }
        let members = |contact| (-2..=2).filter(|g| line_normal_cone_contains(contact, &pre, &whole(*g))).count();
        let at_the_wall = reading.is_control();
        findings.push(Finding::count(format!("members of the cone inside, |v| = {speed}"), members(at_the_wall), 1));
        findings.push(Finding::count(format!("members of the cone at the wall, |v| = {speed}"), members(true), 1));
    }
    Ok(findings)
}

fn branches(reading: Reading) -> Result<Vec<Finding>> {
    let wall = reading.only(1).pick(whole(0), ratio(1, 2));
    let impulse = |q: &Rational, pre: &Rational| {
        let solution = || Impact::moreau(whole(1), whole(0)).solutions(pre)[0].clone();
        let after = if *q == wall { reading.only(0).pick(solution(), whole(0)) } else { pre.clone() };
        after - pre
    };
    let (places, velocities) = ([whole(0), ratio(1, 2), whole(2)], [-2, -1, 0, 1, 2].map(whole));
    let sign = |x: &Rational| x.cmp(&whole(0));
    let met = |case: fn(&Rational, &Rational) -> bool| {
        let of_case = pairs(&places, &velocities).filter(|(q, v)| case(q, v));
        of_case.map(|(q, v)| (sign(q), sign(&impulse(q, v)))).collect::<BTreeSet<_>>()
    };
    let (inside, pressing, leaving) =
        (met(|q, _| *q > whole(0)), met(|q, v| *q == whole(0) && *v < whole(0)), met(|q, v| *q == whole(0) && *v >= whole(0)));
    let signs = [Less, Equal, Greater];
    let solves = |gap: Ordering, force: Ordering| gap != Less && force != Less && (gap == Equal || force == Equal);
    let all: BTreeSet<_> = pairs(&signs, &signs).map(|(a, b)| (*a, *b)).filter(|(gap, force)| solves(*gap, *force)).collect();
    Ok(vec![
        Finding::decision("inside: φ > 0, λ = 0", inside == BTreeSet::from([(Greater, Equal)]), true),
        Finding::decision("against the wall: φ = 0, λ > 0", pressing == BTreeSet::from([(Equal, Greater)]), true),
        Finding::decision("leaving: φ = 0, λ = 0", leaving == BTreeSet::from([(Equal, Equal)]), true),
        Finding::decision("together they are the branches of 0 ≤ φ ⟂ λ ≥ 0", met(|_, _| true) == all, true),
    ])
}

fn exercise_one(reading: Reading) -> Result<Vec<Finding>> {
    let (mass, pre) = (ratio(3, 2), whole(-2));
    let mut findings = Vec::new();
    for (e, expected) in [(whole(1), whole(6)), (whole(0), whole(3)), (ratio(1, 2), ratio(9, 2))] {
        let [after, before] = reading.only(1).pick([whole(1), reading.only(0).pick(e.clone(), ratio(1, 3))], [whole(0), whole(1)]);
        let solutions = Impact { mass: mass.clone(), after, before }.solutions(&pre);
        let impulse = |post: &Rational| mass.clone() * (post.clone() - pre.clone());
        findings.extend(solutions.iter().map(|post| Finding::exact(format!("P for e = {e}"), &impulse(post), &expected, "N·s")));
        findings.push(Finding::count(format!("solutions for e = {e}"), solutions.len(), 1));
    }
    Ok(findings)
}

/// How many grid pairs (v, λ) satisfy one of inclusion and complementarity, but not both; the force is λ `sense` ∇φ.
fn disagreements(in_contact: bool, sense: i64) -> usize {
    let cone = TangentCone::new([1, 2], in_contact);
    let forces: Vec<i64> = (-2..=2).collect();
    let velocities = grid(2);
    let differs = |v, force: i64| {
        let inclusion = cone.normal_cone_contains(v, &[whole(-sense * force), whole(-2 * sense * force)]);
        let rate = cone.rate(v);
        let complementarity = force >= 0 && rate >= whole(0) && whole(force) * rate == whole(0);
        inclusion != complementarity
    };
    pairs(&velocities, &forces).filter(|(v, force)| differs(*v, **force)).count()
}

/// (‖r_t‖/(μ r_n))² and the number of solutions of the LCP of one sliding contact with W = I, μ = 1/2, u_free = (−1, 1, …).
fn strength_of_lcp_solution(rows: usize) -> Result<(Rational, usize)> {
    let [one, none] = [whole(1), whole(0)];
    let axes = [[one.clone(), none.clone()], [none.clone(), one.clone()], [whole(-1), none.clone()], [none, whole(-1)]];
    let directions: Vec<_> = if rows == 2 { vec![axes[0].clone(), axes[2].clone()] } else { axes.to_vec() };
    let free = DVector::from_fn(rows, |row, _| if row == 0 { whole(-1) } else { one.clone() });
    let mu = ratio(1, 2);
    let problem = PlanarProblem::new(DMatrix::identity(rows, rows), free).polyhedral(std::slice::from_ref(&mu), &directions)?;
    let set = all_solutions(&problem.lcp)?;
    let Some(z) = set.points.first() else { return Ok((whole(0), 0)) };
    let impulse = problem.impulse(z);
    let tangential = impulse.iter().skip(1).fold(whole(0), |sum, entry| sum + entry.clone() * entry.clone());
    let bound = mu * impulse[0].clone();
    Ok((tangential / (bound.clone() * bound), set.points.len()))
}

/// Whether the LCP has one solution, and that is Coulomb's: on the cone, ‖r_t‖ = μ r_n.
fn lcp_is_coulombs(rows: usize) -> Result<bool> {
    Ok(strength_of_lcp_solution(rows)? == (whole(1), 1))
}

fn exercise_three(reading: Reading) -> Result<Vec<Finding>> {
    let (planar, spatial) = (reading.only(0).pick(2, 3), reading.only(1).pick(3, 2));
    let (strength, _) = strength_of_lcp_solution(spatial)?;
    Ok(vec![
        Finding::count("differences of inclusion and complementarity in contact", disagreements(true, reading.only(1).pick(1, -1)), 0),
        Finding::decision("an LCP gives Coulomb's law in the plane", lcp_is_coulombs(planar)?, true)
            .says(false)
            .violating("a spatial contact"),
        Finding::decision("the LCP with four directions gives it in space", lcp_is_coulombs(spatial)?, false),
        Finding::exact("(‖r_t‖/(μ r_n))² in space with four directions", &strength, &ratio(1, 2), "1"),
        Finding::decision("inclusion and λ ⟂ ∇φ·v⁺ differ out of contact", disagreements(false, 1) > 0, true).context(),
    ])
}
