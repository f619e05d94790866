//! Claims of §5 on the convex program of one step: its form, its optimality conditions and the uniqueness of its solution.

use crate::certificate::definiteness::{Definiteness, definiteness, quadratic_form};
use crate::claims::experiments::planar_step::{PlanarStep, box_on_two_corners, magnitude};
use crate::claims::prelude::*;
use crate::problem::Law;
use crate::solvers::enumeration::all_solutions;

/// The claims of this file.
pub(super) const CLAIMS: &[Claim] = &[
    Claim {
        id: "S5.strict-qp",
        statement: r"Every step solves a strictly convex quadratic program in the contact impulses $\gamma$, whose Hessian is the Delassus
            operator $N = D^TM^{-1}D$ (step 5: in general $N$ is positive semidefinite; it is definite, and the program strictly convex,
            when $D$ has full column rank).",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"As stated with the condition of step 5, which the summaries of the section leave out: for every $D$ the
            program is strictly convex in the velocity, so $v^+$ and $N\gamma$ are unique; in $\gamma$ it is strictly convex only if $D$
            has full column rank.",
        argument: r"$N = D^TM^{-1}D$ is positive semidefinite, and $x^TNx = 0$ exactly for Dx $= 0$. A single corner of a box has as many
            columns as its $D$ has rank, and $LDL^T$ over the rationals finds $N$ definite; two corners have 4 columns of rank 3, and $N$
            is singular.",
        controls: &["The two corners in place of the one, and the one in place of the two."],
        sources: &["chapter §5, steps 3 and 5 of the construction"],
        check: check!(strictness),
    },
    Claim {
        id: "S5.D-rank",
        statement: r"$D_i = [d_1, \ldots, d_d]$ collects tangential direction vectors, whose impulses are $\beta \ge 0$; when $D$ has full
            column rank (no redundant contact) N is positive definite, the program strictly convex and the solution unique.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Exact,
        correct_statement: r"The implication holds, but its hypothesis is not that no contact is redundant: it needs columns
            $(n, t_1, t_2)$ per contact, with tangential impulses of either sign, and independent contacts. Directions whose non-negative
            impulses reach every sense are dependent for every single contact, and $N$ is singular.",
        argument: r"Non-negative combinations of $k$ vectors fill a space of $k - 1$ dimensions at most, so the $d$ directions of one
            contact are dependent. A point of unit mass with columns $(n, t)$: $N = I$, definite. With columns $(n, d, -d)$:
            $N = (1, 0, 0; 0, 1, -1; 0, -1, 1)$, which has the kernel (0,1,1): adding the same amount to both opposite impulses changes
            nothing.",
        controls: &[
            r"Columns $(n, t)$ fed in place of the directions for $\beta \ge 0$.",
            r"The same contact taken twice, $(n, t, n, t)$: a redundant contact in place of a single one.",
        ],
        sources: &["chapter §4, construction of the polyhedral cone", "chapter §5, steps 1 and 5"],
        check: check!(symmetric_directions_are_dependent),
    },
    Claim {
        id: "S5.psd-unique",
        statement: r"Even if $N$ is only positive semidefinite, the solution is usually still unique once the friction cone is added; or a
            proximal regularisation guarantees it.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Exact,
        correct_statement: r"If $N$ is singular, $v^+$ and $N\gamma$ stay unique. The impulses are unique where the contacts slide, for
            then the cone fixes their direction; a box that sticks on two corners has a segment of optimal impulses for every load inside
            the cones. The alternative the text names does hold: a regularised program is strictly convex in $\gamma$.",
        argument: r"Both corners of a box have the same tangential row, so $k = (0, 1, 0, -1)$ has Nk $= 0$. If $\gamma$ is optimal with
            both corners strictly inside their cones, $\gamma + s\,k$ is feasible with the same objective, hence optimal, for all small
            $s$; and being strictly inside is an open condition on the load. All optimal impulses are enumerated in rationals for 14 loads
            along the ground, that the box bears at rest and for 14 that make it slide: under none of the first is the solution unique,
            under all of the second it is. “Usually” counts as more than half. A proximal term $I/1000$ makes $N$ definite.",
        controls: &[
            r"A single corner in place of the two: its $N$ is definite, and every load has one solution.",
            r"$\mu = 4$ in place of 1/2, with which the loads that slide stick.",
            "The proximal term on the normal rows only.",
        ],
        sources: &["chapter §5, step 5"],
        check: check!(many_optimal_impulses),
    },
    Claim {
        id: "S5.gap-term",
        statement: r"The relaxed non-penetration constraint is written on velocities with a gap term, $n\cdot v + \varphi/h \ge 0$.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"$n\cdot v^+ + \varphi/h \ge 0$: for a gap that is linear in $q$ the gap after the step,
            $\varphi + h\,n\cdot v^+$, is non-negative, and zero where the contact pushes without sliding.",
        argument: r"$\varphi^+ = \varphi + h\,n\cdot v^+ = h\,(n\cdot v^+ + \varphi/h)$. A ball 1/250 m above the ground falling at 1 m/s
            ($h = 1/100$) lands at $\varphi^+ = 0$ exactly, with $n\cdot v^+ = -2/5$.",
        controls: &[r"The constraint without the gap term, $n\cdot v \ge 0$, which stops the ball in the air."],
        sources: &["chapter §5, step 2 of the construction"],
        check: check!(gap_term),
    },
    Claim {
        id: "S5.qp-form",
        statement: r"Eliminating the velocity, each step is min $\tfrac12\gamma^TN\gamma + r^T\gamma$ over the friction cones, where $r$
            contains the free velocity and the gap term $\varphi/h$.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"With $v^+ = v_\text{free} + M^{-1}D\gamma$: $\tfrac12\|v^+\|_M^2 - \tfrac12\|v_\text{free}\|_M^2 +
            (\varphi/h)\cdot\gamma_n = \tfrac12\gamma^TN\gamma + r^T\gamma$, $r = D^Tv_\text{free} + \varphi/h$ on the normal rows.",
        argument: r"Expand $\tfrac12(v_\text{free} + M^{-1}D\gamma)^TM(v_\text{free} + M^{-1}D\gamma)$. Checked as an identity of
            rationals on a dozen impulses of a box on two corners with gaps 1/7 and 2/7 m/s.",
        controls: &[r"$r$ without the gap term."],
        sources: &["chapter §5, step 3 and exercise 1"],
        check: check!(elimination),
    },
    Claim {
        id: "S5.ccp",
        statement: r"The optimality conditions of the program are the cone complementarity problem
            $K \ni \gamma \perp N\gamma + r \in K^*$, $K^*$ the dual of the friction cone.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"$\gamma$ minimises $\tfrac12\gamma^TN\gamma + r^T\gamma$ over $K$ if and only if
            $K \ni \gamma \perp N\gamma + r \in K^*$, with $K^* = \{u_n \ge \mu\|u_t\|\}$.",
        argument: r"$f$ is convex with gradient $y = N\gamma + r$, so $\gamma$ is optimal iff $y\cdot(x - \gamma) \ge 0$ for all
            $x \in K$; $x = 0$ and $x = 2\gamma$ give $y\cdot\gamma = 0$, and then $y\cdot x \ge 0$ on $K$ is $y \in K^*$. Conversely
            $f(x) - f(\gamma) = y\cdot(x - \gamma) + \tfrac12\|x - \gamma\|_N^2 \ge 0$. Checked exactly for a sliding box: the answer is
            cone complementary, and no cone point of a grid around it has a smaller objective.",
        controls: &["Coulomb's answer to the same step: it satisfies another complementarity and is not optimal."],
        sources: &["chapter §5, step 4", "first-order optimality over a convex cone"],
        check: check!(optimality),
    },
    Claim {
        id: "S5.continuous",
        statement: "The global optimum is unique and depends continuously on the parameters.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Exact,
        correct_statement: r"$v^+$ is unique and depends on $v_\text{free}$ with Lipschitz constant 1 in the $M$-norm. Continuity in the
            geometry and in $\mu$ needs a pointed cone of generalised impulses (Slater's condition); $\gamma$ need not be unique.",
        argument: r"$v^+$ is the $M$-projection of $v_\text{free}$ on the convex set $\{v : D^Tv + \varphi/h \in K^*\}$, and projections
            do not expand: for every pair of loads on a box that is tried, $\|\Delta v^+\|_M^2 \le \|\Delta v_\text{free}\|_M^2$ exactly.
            Without Slater continuity fails: constraints $v_y \ge 0$ and $\varepsilon v_x - v_y \ge 0$ and $v_\text{free} = (-1, 0)$ give
            $v^+ = (-1, 0)$ at $\varepsilon = 0$ but $v^+ = (0, 0)$ for every $\varepsilon > 0$ ($\varepsilon = 10^{-3}$, $10^{-6}$,
            $10^{-9}$: distance 1).",
        controls: &[
            r"The second constraint as $\varepsilon v_x + v_y \ge 0$, which leaves the cone pointed: the solution moves by
                $O(\varepsilon)$ only.",
            r"The two wedges, $\varepsilon = 0$ and $\varepsilon = 10^{-6}$, under one load in place of pairs of loads on the box.",
        ],
        sources: &["chapter §5, motivation", "non-expansiveness of projections on convex sets"],
        check: check!(continuity),
    },
];

/// A load that two corners with μ = ½ carry strictly inside their cones.
fn resting(tangential: Rational) -> PlanarStep {
    box_on_two_corners([tangential, ratio(-1, 1), ratio(0, 1)], ratio(1, 2))
}

/// The step with its first contact only.
fn first_contact(mut step: PlanarStep) -> PlanarStep {
    step.jacobian = step.jacobian.rows(0, 2).into_owned();
    step.shift = step.shift.rows(0, 2).into_owned();
    step.softness = step.softness.rows(0, 2).into_owned();
    step.friction.truncate(1);
    step
}

fn strictness(reading: Reading) -> Result<Vec<Finding>> {
    let (two, one) = (resting(ratio(0, 1)), first_contact(resting(ratio(0, 1))));
    let (independent, redundant) = reading.pick((&one, &two), (&two, &one));
    let definite = |step: &PlanarStep| definiteness(&step.delassus()) == Definiteness::Definite;
    let rank = match definiteness(&redundant.delassus()) {
        Definiteness::Semidefinite { rank, .. } => rank,
        Definiteness::Definite => redundant.jacobian.nrows(),
        Definiteness::Indefinite { .. } => 0,
    };
    Ok(vec![
        Finding::decision("N of a box on one corner, D of full column rank, is definite", definite(independent), true),
        Finding::decision("N of a box on two corners, D not of full column rank, is definite", definite(redundant), false),
        Finding::count("rank of its N, of 4 columns and 3 velocities", rank, 3),
    ])
}

fn symmetric_directions_are_dependent(reading: Reading) -> Result<Vec<Finding>> {
    let of = |columns: &[[i64; 2]]| {
        let d = DMatrix::from_fn(2, columns.len(), |i, j| ratio(columns[j][i], 1));
        definiteness(&(d.transpose() * d))
    };
    let (basis, twice): (&[[i64; 2]], &[[i64; 2]]) = (&[[1, 0], [0, 1]], &[[1, 0], [0, 1], [1, 0], [0, 1]]);
    let symmetric = of(reading.only(0).pick(&[[1, 0], [0, 1], [0, -1]], basis));
    let single = of(reading.only(1).pick(basis, twice));
    Ok(vec![
        Finding::decision("N of one contact with (n, d, −d) is positive definite", symmetric == Definiteness::Definite, false)
            .says(true)
            .violating("columns (n, t₁, t₂) per contact, no directions for β ≥ 0"),
        Finding::decision("N of (n, t) is positive definite", single == Definiteness::Definite, true),
    ])
}

fn many_optimal_impulses(reading: Reading) -> Result<Vec<Finding>> {
    let friction = reading.only(1).pick(ratio(1, 2), ratio(4, 1));
    // loads ±k/20 m/s and ±k/4 + 1/2 m/s along the ground, pressed with 1 m/s
    let unique_among = |size: fn(i64) -> Rational| -> Result<usize> {
        let mut unique = 0;
        for k in (-7..=7).filter(|k| *k != 0) {
            let two = box_on_two_corners([size(k), ratio(-1, 1), ratio(0, 1)], friction.clone());
            let step = reading.only(0).pick(two.clone(), first_contact(two));
            unique += usize::from(all_solutions(&step.edge_lcp())?.is_unique());
        }
        Ok(unique)
    };
    let ones = if reading == Reading::Control(2) { [1, 0, 1, 0] } else { [1; 4] };
    let term = DMatrix::from_diagonal(&DVector::from_vec(ones.map(|one| ratio(one, 1000)).to_vec()));
    let proximal = resting(ratio(0, 1)).delassus() + term;
    Ok(vec![
        // usually: under more than half of them
        Finding::count("loads, of 14 that the box bears at rest, with one optimal impulse", unique_among(|k| ratio(k, 20))?, 0)
            .says_at_least(8usize)
            .violating("contacts that share a tangent do not stick together"),
        Finding::count("loads, of 14 that make it slide, with one optimal impulse", unique_among(|k| ratio(k + 2 * k.signum(), 4))?, 14)
            .says_at_least(8usize),
        Finding::decision("with a proximal term the program is strictly convex", definiteness(&proximal) == Definiteness::Definite, true),
    ])
}

fn gap_term(reading: Reading) -> Result<Vec<Finding>> {
    let (h, gap) = (ratio(1, 100), ratio(1, 250));
    let gap_rate = reading.pick(gap.clone() / h.clone(), ratio(0, 1));
    let step = PlanarStep::point([ratio(-1, 1), ratio(0, 1)], gap_rate, ratio(1, 2));
    let velocity = step.solve(Law::Associated)?.velocity;
    Ok(vec![
        Finding::exact("gap after the step", &(gap + h * velocity[0].clone()), &ratio(0, 1), "m"),
        Finding::exact("n·v⁺", &velocity[0], &ratio(-2, 5), "m/s"),
    ])
}

fn elimination(reading: Reading) -> Result<Vec<Finding>> {
    let mut step = box_on_two_corners([ratio(1, 3), ratio(-1, 1), ratio(1, 5)], ratio(1, 2));
    let gap_rate = DVector::from_vec(vec![ratio(1, 7), ratio(0, 1), ratio(2, 7), ratio(0, 1)]);
    step.shift = reading.pick(gap_rate.clone(), DVector::from_element(4, ratio(0, 1)));
    let half_mass = DMatrix::from_diagonal(&DVector::from_vec(step.mass.clone())) * ratio(1, 2);
    let kinetic = |v: &DVector<Rational>| quadratic_form(&half_mass, v);
    let program = step.program();
    let mut largest = ratio(0, 1);
    for k in 0..12i64 {
        let impulse = DVector::from_fn(4, |i, _| ratio((7 * k + 3 * i as i64) % 11 - 5, 4 + i as i64));
        let primal = kinetic(&step.velocity(&impulse)) - kinetic(&step.free_velocity) + gap_rate.dot(&impulse);
        let difference = magnitude(&(primal - quadratic_form(&program, &impulse.push(ratio(1, 1)))));
        largest = if difference > largest { difference } else { largest };
    }
    Ok(vec![Finding::exact("largest difference of the two objectives", &largest, &ratio(0, 1), "J")])
}

fn optimality(reading: Reading) -> Result<Vec<Finding>> {
    let step = box_on_two_corners([ratio(2, 1), ratio(-1, 1), ratio(0, 1)], ratio(1, 2));
    let answer = step.solve(reading.pick(Law::Associated, Law::Coulomb))?;
    let best = step.objective(&answer.impulse);
    let mut better = 0;
    for k in 0..81i64 {
        let place = |power: u32| ratio(k / 3i64.pow(power) % 3 - 1, 10);
        let mut trial = &answer.impulse + DVector::from_fn(4, |i, _| place(i as u32));
        for contact in 0..2 {
            // into the cone: r_n ≥ 0, then r_t within ±μ r_n
            let normal = if trial[2 * contact] < ratio(0, 1) { ratio(0, 1) } else { trial[2 * contact].clone() };
            let bound = step.friction[contact].clone() * normal.clone();
            let tangential = trial[2 * contact + 1].clone();
            let clipped = if tangential > bound {
                bound
            } else if tangential < -bound.clone() {
                -bound
            } else {
                tangential
            };
            (trial[2 * contact], trial[2 * contact + 1]) = (normal, clipped);
        }
        better += usize::from(step.objective(&trial) < best);
    }
    Ok(vec![
        Finding::decision("K ∋ γ ⟂ Nγ + r ∈ K*", step.is_cone_complementary(&answer.impulse), true),
        Finding::count("cone points with a smaller objective", better, 0),
    ])
}

fn continuity(reading: Reading) -> Result<Vec<Finding>> {
    let load = |k: i64| [ratio(k * 37 % 41 - 20, 10), ratio(k * 17 % 23 - 18, 10), ratio(k * 29 % 31 - 15, 10)];
    let energy = |v: &DVector<Rational>, mass: &[Rational]| {
        v.iter().zip(mass).fold(ratio(0, 1), |sum, (v, m)| sum + m.clone() * v.clone() * v.clone())
    };
    let pairs: Vec<[PlanarStep; 2]> = match reading {
        Reading::Control(1) => vec![[squeezed(ratio(0, 1), -1), squeezed(ratio(1, 1_000_000), -1)]],
        _ => (0..32).map(|k| [load(k), load(k + 101)].map(|load| box_on_two_corners(load, ratio(1, 2)))).collect(),
    };
    let mut expansions = 0;
    for [one, other] in pairs {
        let after = one.solve(Law::Associated)?.velocity - other.solve(Law::Associated)?.velocity;
        let before = &one.free_velocity - &other.free_velocity;
        expansions += usize::from(energy(&after, &one.mass) > energy(&before, &one.mass));
    }
    let mut findings = Vec::new();
    let sign = reading.only(0).pick(-1, 1);
    let answer = |epsilon: Rational| -> Result<DVector<Rational>> { Ok(squeezed(epsilon, sign).solve(Law::Associated)?.velocity) };
    let zero = answer(ratio(0, 1))?;
    let moved = |exponent: u32| -> Result<Rational> {
        let step = answer(ratio(1, 10i64.pow(exponent)))? - &zero;
        Ok(step.dot(&step))
    };
    let coarse = moved(3)?;
    for exponent in [6, 9] {
        findings.push(
            Finding::exact(
                format!("|Δv⁺|² from ε = 0 to 1e-{exponent}, over that to 1e-3"),
                &(moved(exponent)? / &coarse),
                &ratio(1, 1),
                "1",
            )
            .says_at_most(ratio(1, 2))
            .violating("Slater's condition, a pointed cone of impulses"),
        );
    }
    findings.push(Finding::count("pairs of loads whose distance grows", expansions, 0));
    Ok(findings)
}

/// The step from v_free = (−1, 0) under v_y ≥ 0 and εv_x ± v_y ≥ 0, without friction.
fn squeezed(epsilon: Rational, sign: i64) -> PlanarStep {
    let zero = || ratio(0, 1);
    PlanarStep {
        mass: vec![ratio(1, 1); 2],
        // tangential rows without effect: there is no friction
        jacobian: DMatrix::from_row_slice(4, 2, &[zero(), ratio(1, 1), zero(), zero(), epsilon, ratio(sign, 1), zero(), zero()]),
        free_velocity: DVector::from_vec(vec![ratio(-1, 1), zero()]),
        shift: DVector::from_element(4, zero()),
        friction: vec![zero(); 2],
        softness: DVector::from_element(4, zero()),
    }
}
