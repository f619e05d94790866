//! Several contacts at once: what is unique, and what the order of impacts decides.

use super::impacts::{ContactsLaw, cradle, ends, frictionless_grid, impact, middle, rod};
use crate::claims::lookups;
use crate::claims::prelude::*;
use crate::closed_forms::newtons_cradle::{after_two_impacts, at_once};
use crate::closed_forms::rocking_block::landing;
use crate::contact::delassus::delassus;
use crate::elimination::rank;
use crate::impact_laws::energy_projection::Projection;
use crate::impact_laws::sequential::sequential;
use crate::impact_laws::{energy_projection, fremond, moreau, newton};
use crate::problem::{Lcp, PlanarProblem, Response};
use crate::solvers::enumeration::all_solutions;
use crate::tolerance::rounding;

pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S7.multi-nonunique",
        statement: r"Three balls colliding at once, or a block landing on four corners: there is no unique Newton solution; the jump of
            the velocities is not determined by an independent $e$ at each point but depends on the microscopic order of the contacts,
            which is singular for ideal rigid bodies.",
        verdict: ClaimVerdict::False,
        kind: Kind::Assertion,
        severity: Some(Severity::WrongStatement),
        evidence: Evidence::Exact,
        correct_statement: r"Posed at once without friction, the velocities are unique: $v^+$ solves a strictly convex program; for three
            balls even the impulses are, for four corners not. What is not unique is whether it happens at once: another order is another
            problem, and its outcome differs, as the chapter says of the order.",
        argument: r"Three balls, $e = 1$: one solution, $v^+ = (-1/3, 2/3, 2/3)$. One impact after the other: $(0, 0, 1)$. Both keep
            momentum and energy. $e = 1/2$: $v_3 - v_2 = 0$ at once, 21/64 one after the other. Four corners: a family of impulses, all
            with $U^+ = -eU^-$. The outer balls meet the middle one, $e = 1/2$: one outcome at once, two one after the other; a cube on
            its corners the same, one and several.",
        controls: &[
            "The impacts one after the other, in every order.",
            "At once in the place of one after the other; three corners in the place of four.",
        ],
        sources: &["chapter §7, simultaneous impacts"],
        check: check!(uniqueness),
    },
    Claim {
        id: "S7.four-corners",
        statement: "A block landing on the table with four corners at once has no unique Newton solution: the jump of the velocities is \
            not determined (the heading calls such cases pathological).",
        verdict: ClaimVerdict::False,
        kind: Kind::Assertion,
        severity: Some(Severity::WrongStatement),
        evidence: Evidence::Exact,
        correct_statement: r"The impulses are not unique: $W$ has rank 3 with null vector $(1, -1, 1, -1)$, so that any multiple of it may
            be added while $P$ stays $\ge 0$. The velocities are (S7.multi-nonunique).",
        argument: r"Cube of 1 kg and 1 m: $W_{ij} = 4$, 1 and −2 for a corner with itself, its neighbours and the opposite one. $U^- = -1$
            everywhere, $e = 1/2$: every solution has one $U^+$. $e = 0$: $P = (1, 1, 1, 1)/4 + t(1, -1, 1, -1)$ as long as $P \ge 0$, all
            with $U^+ = 0$.",
        controls: &["The corners hit one after the other, in every order.", r"Three corners, whose $W$ is nonsingular."],
        sources: &["chapter §7, simultaneous impacts"],
        check: check!(four_corners),
    },
    Claim {
        id: "S7.solver-pivot",
        statement: "Most simulators look away: they return some solution of such an impact (which depends on the solver's order of \
            pivots), without a guarantee of uniqueness; one more source of “another solver, another result”.",
        verdict: ClaimVerdict::Ambiguous,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"It depends on what a solution is. Of the impulses it holds where $W$ is singular. The velocities do not
            depend on it as long as there is no friction; with friction they may (S4.painleve-atom: three solutions).",
        argument: r"Four corners, $e = 1/2$, Lemke's method with the contacts in every order: several different $P$, one $U^+$. Three
            balls: one $P$.",
        controls: &[
            r"Three corners, whose $W$ is nonsingular, and four in the place of three balls.",
            "Impacts one after the other in these orders.",
        ],
        sources: &["chapter §7, simultaneous impacts"],
        check: check!(order_of_pivots),
    },
    Claim {
        id: "S7.fremond-2024",
        statement: "A solution: Frémond's law for several bodies (Acary and others, 2024), a global energy functional that constrains all \
            contacts.",
        verdict: ClaimVerdict::Ambiguous,
        kind: Kind::Citation,
        severity: None,
        evidence: Evidence::Cited,
        correct_statement: r"The paper was not read; it may be Acary and Collins-Craft's on the Moreau–Jean scheme with Frémond's law (HAL
            hal-04230941, known here from another project's reference list). Siconos has a law of that name: Newton's $e$ on the normal
            components and Coulomb friction on $\theta U_t^+ + (1 - \theta)U_t^-$. At $\theta = 1/2$ it cannot gain energy from
            approaching contacts, at any number of them. It does not settle the order: without friction it is Moreau's law.",
        argument: r"$\Delta T = -\tfrac12\sum(1 - e)P_n|U_n^-| - \sum\,\mu P_n\tfrac12|U_t^+ + U_t^-|$. The rod, $\mu = 1$, $e = 1$: 0
            where $e$ on the normal component gains 9/80. Two contacts with $\mu = 1/8$, $e = 1$: −3/8 J, as the formula says. Three
            balls: $(-1/3, 2/3, 2/3)$.",
        controls: &[r"Coulomb friction on $U_t^+$ alone.", "The balls one after the other; Siconos 4.4.0 in the place of 4.5.0."],
        sources: &[
            "chapter §7, simultaneous impacts",
            "Siconos, kernel/src/modelingTools/FremondImpactFrictionNSL.hpp and MoreauJeanOSI.cpp, source of 2024 or later",
        ],
        check: check!(fremond_law),
    },
    Claim {
        id: "S7.pfeiffer-glocker-proj",
        statement: "A solution: an energy-consistent Pfeiffer–Glocker projection, which projects the velocities after the impact on the \
            feasible set of no energy gain.",
        verdict: ClaimVerdict::Ambiguous,
        kind: Kind::Citation,
        severity: None,
        evidence: Evidence::Certified,
        correct_statement: r"Such a projection exists and is explicit: on the cone $U \ge 0$, then scaled, in the metric $W^{-1}$, which
            keeps momentum. But it may leave an impulse that pulls. Under this name no source was found; Pfeiffer and Glocker's two
            complementarity problems gain no energy by themselves.",
        argument: r"$W = (2, 1; 1, 2)$, $e = (1, 0)$, $U^- = (-1, -1/2)$, all reversed: a gain of 1/12 J; projected
            $U^+ = \sqrt{3/4}\,(1, 0)$, and $P_2 = -\sqrt{3/4}/3 < 0$. $W = (2, -1; -1, 2)$, $U^- = (-1, 1/2)$: the same factor, and
            $P > 0$.",
        controls: &["The second pair in the place of the first.", "No projection."],
        sources: &["chapter §7, simultaneous impacts", "Pfeiffer and Glocker 1996 for the two problems"],
        check: check!(projection),
    },
    Claim {
        id: "S7.rocking",
        statement: r"Velocity jumps with several contacts are not determined by a pointwise $e$ alone (the block that lands on its
            base).",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"As stated: with $e = 0$ at both edges the outcome depends on friction. If the edge that is hit holds,
            $\omega^+/\omega^- = 1 - 3/2 \sin^2\alpha$ (Housner); on a smooth floor $(c^2 - 2b^2)/(c^2 + 4b^2)$.",
        argument: r"Half width 1, half height 2: 7/10 for $\mu \ge 6/17$, 1/4 for $\mu = 0$, both from one Moreau step with two contacts;
            at $\mu = 1/3$ the edge slips and the ratio is another.",
        controls: &[r"A smooth floor throughout, on which $e$ alone determines the outcome.", r"A floor with $\mu = 1$ throughout."],
        sources: &["chapter §7, simultaneous impacts", "Housner 1963 for the ratio, derived again here"],
        check: check!(rocking),
    },
];

fn relative(v: [Rational; 3]) -> DVector<Rational> {
    DVector::from_vec(vec![&v[1] - &v[0], &v[2] - &v[1]])
}

/// A cube of 1 kg and 1 m that lands flat at 1 m/s on these of its corners, in order around the base.
fn cube(corners: &[usize]) -> PlanarProblem<Rational> {
    let place = [[1, 1], [-1, 1], [-1, -1], [1, -1]];
    // W_ij = 1/m + (x_i x_j + y_i y_j)/I with x, y = ±1/2 and I = 1/6
    let entry = |i: usize, j: usize| ratio(1, 1) + ratio(3, 2) * ratio(place[i][0] * place[j][0] + place[i][1] * place[j][1], 1);
    let size = corners.len();
    PlanarProblem::new(DMatrix::from_fn(size, size, |i, j| entry(corners[i], corners[j])), DVector::from_element(size, ratio(-1, 1)))
}

/// U⁺ of every solution that enumeration lists for a plastic or elastic impact, ends of families included.
fn all_velocities(impact: &PlanarProblem<Rational>, restitution: &Rational) -> Result<Vec<DVector<Rational>>> {
    let set = all_solutions(&Lcp::new(impact.delassus.clone(), &impact.velocity * (ratio(1, 1) + restitution)))?;
    let along = set.families.iter().map(|family| &family.point + &family.direction * ratio(1, 1000));
    Ok(set.points.iter().cloned().chain(along).map(|impulse| impact.response(impulse).after).collect())
}

/// U⁺ of every solution of the impact posed at once, or, in a control, of its impacts one after the other in every order.
fn outcomes(reading: Reading, impact: &PlanarProblem<Rational>, restitution: &Rational) -> Result<Vec<DVector<Rational>>> {
    if !reading.is_control() {
        return all_velocities(impact, restitution);
    }
    orders(impact.velocity.len()).iter().map(|order| Ok(sequential(impact, restitution, order)?.after)).collect()
}

/// How many of them differ.
fn different(outcomes: &[DVector<Rational>]) -> usize {
    outcomes.iter().enumerate().filter(|(i, outcome)| !outcomes[..*i].contains(outcome)).count()
}

fn uniqueness(reading: Reading) -> Result<Vec<Finding>> {
    let (balls, e, posed) = (cradle(), ratio(1, 1), reading.only(0));
    let velocities = outcomes(posed, &balls, &e)?;
    let law = reading.only(1).pick(one_after_the_other as ContactsLaw, moreau::frictionless);
    let ordered = law(&balls, &[e.clone(), e.clone()])?;
    let half = law(&balls, &[ratio(1, 2), ratio(1, 2)])?;
    let corners = reading.only(1).pick(cube(&[0, 1, 2, 3]), cube(&[0, 1, 2]));
    let solutions = all_solutions(&Lcp::new(corners.delassus.clone(), corners.velocity.clone()))?;
    let landed = outcomes(posed, &cube(&[0, 1, 2, 3]), &ratio(1, 2))?;
    let met = outcomes(posed, &ends([ratio(-1, 1), ratio(-1, 1)]), &ratio(1, 2))?;
    let expected = relative(at_once(&e));
    Ok(vec![
        Finding::decision("three balls at once: every solution is (−1/3, 2/3, 2/3)", velocities.iter().all(|u| *u == expected), true)
            .says(false),
        Finding::count("different velocities after the outer balls meet the middle one", different(&met), 1).says_at_least(2),
        Finding::count("different velocities of four corners", different(&landed), 1).says_at_least(2),
        Finding::decision("one after the other: (0, 0, 1)", ordered.after == relative(after_two_impacts(&e)), true),
        Finding::exact("v₃⁺ − v₂⁺ one after the other, e = 1/2", &half.after[1], &ratio(21, 64), "m/s"),
        Finding::decision("four corners: the impulses are not unique", !solutions.is_unique(), true),
        Finding::exact("energy changed at once", &balls.energy_change(&moreau::frictionless(&balls, &[e.clone(), e])?), &ratio(0, 1), "J")
            .context(),
        Finding::exact("energy changed one after the other", &balls.energy_change(&ordered), &ratio(0, 1), "J").context(),
    ])
}

fn four_corners(reading: Reading) -> Result<Vec<Finding>> {
    let landed = outcomes(reading.only(0), &cube(&[0, 1, 2, 3]), &ratio(1, 2))?;
    let subject = cube(reading.only(1).pick(&[0, 1, 2, 3], &[0, 1, 2]));
    let size = subject.velocity.len();
    let solutions = all_solutions(&Lcp::new(subject.delassus.clone(), subject.velocity.clone()))?;
    let first = |all: [i64; 4]| DVector::from_iterator(size, all.into_iter().take(size).map(|x| ratio(x, 4)));
    let zero = DVector::from_element(size, ratio(0, 1));
    let stops = |impulses: [i64; 4]| subject.response(first(impulses)).after == zero;
    Ok(vec![
        Finding::count("different velocities of the cube", different(&landed), 1).says_at_least(2),
        Finding::decision("the impulses are not unique", !solutions.is_unique(), true),
        Finding::decision("(1, −1, 1, −1) is in the kernel of W", &subject.delassus * first([4, -4, 4, -4]) == zero, true),
        Finding::decision("P = (1, 1, 1, 1)/4 and (1/2, 0, 1/2, 0) stop it", stops([1, 1, 1, 1]) && stops([2, 0, 2, 0]), true),
        Finding::count("rank of W", rank(&subject.delassus), 3).context(),
    ])
}

/// All orders of `size` contacts.
fn orders(size: usize) -> Vec<Vec<usize>> {
    let mut all = vec![vec![]];
    for next in 0..size {
        all = all
            .iter()
            .flat_map(|order: &Vec<usize>| {
                (0..=order.len()).map(move |at| {
                    let mut o = order.clone();
                    o.insert(at, next);
                    o
                })
            })
            .collect();
    }
    all
}

/// Impacts of contacts with one e, the contacts visited in the order in which they stand.
fn one_after_the_other(impact: &PlanarProblem<Rational>, restitution: &[Rational]) -> Result<Response<Rational>> {
    sequential(impact, &restitution[0], &(0..restitution.len()).collect::<Vec<_>>())
}

/// Different impulses and different velocities that a law gives for the contacts in all orders, e = 1/2.
fn outcomes_in_all_orders(law: ContactsLaw, impact: &PlanarProblem<Rational>) -> Result<[usize; 2]> {
    let (mut impulses, mut velocities): (Vec<DVector<Rational>>, Vec<DVector<Rational>>) = (vec![], vec![]);
    let size = impact.velocity.len();
    for order in orders(size) {
        let permuted = PlanarProblem::new(
            DMatrix::from_fn(size, size, |i, j| impact.delassus[(order[i], order[j])].clone()),
            DVector::from_fn(size, |i, _| impact.velocity[order[i]].clone()),
        );
        let outcome = law(&permuted, &vec![ratio(1, 2); size])?;
        let mut impulse = DVector::from_element(size, ratio(0, 1));
        order.iter().enumerate().for_each(|(i, &contact)| impulse[contact] = outcome.impulse[i].clone());
        velocities.push(impact.response(impulse.clone()).after);
        impulses.push(impulse);
    }
    Ok([different(&impulses), different(&velocities)])
}

fn order_of_pivots(reading: Reading) -> Result<Vec<Finding>> {
    let law = reading.only(1).pick(moreau::frictionless as ContactsLaw, one_after_the_other);
    let (four, three) = (cube(&[0, 1, 2, 3]), cube(&[0, 1, 2]));
    let [corners, balls] = reading.only(0).pick([four.clone(), cradle()], [three, four]);
    let [impulses, velocities] = outcomes_in_all_orders(law, &corners)?;
    Ok(vec![
        Finding::decision("several different impulses of four corners", impulses > 1, true).reading("as the impulses"),
        Finding::count("different velocities of four corners", velocities, 1).says_at_least(2).reading("as the velocities"),
        Finding::count("different impulses of three balls", outcomes_in_all_orders(law, &balls)?[0], 1)
            .says_at_least(2)
            .violating("a singular W"),
    ])
}

/// The three balls with a tangent each, along which nothing moves: rows (n, t).
fn cradle_with_tangents() -> PlanarProblem<Rational> {
    impact(&[2, 0, -1, 0, 0, 1, 0, 0, -1, 0, 2, 0, 0, 0, 0, 1], [-1, 0, 0, 0].map(|u| ratio(u, 1)))
}

/// A body with M = 1 that hits a rough floor with contacts at (−1, −1) and (2, −2) from its centre, rows (n, t) each.
fn two_rough_contacts() -> PlanarProblem<Rational> {
    let jacobian = DMatrix::from_row_slice(4, 3, &[0, 1, -1, 1, 0, 1, 0, 1, 2, 1, 0, 2].map(|x| ratio(x, 1)));
    let before = &jacobian * DVector::from_vec(vec![ratio(1, 1), ratio(-2, 1), ratio(1, 2)]);
    PlanarProblem::new(&jacobian * jacobian.transpose(), before)
}

type Law = fn(&PlanarProblem<Rational>, &[Rational], &Rational) -> Result<Response<Rational>>;

/// The relative velocities of three balls after a law for contacts with tangents, e = 1.
fn settled(law: Law) -> Result<DVector<Rational>> {
    let after = law(&cradle_with_tangents(), &[ratio(1, 2), ratio(1, 2)], &ratio(1, 1))?.after;
    Ok(DVector::from_vec(vec![after[0].clone(), after[2].clone()]))
}

fn fremond_law(reading: Reading) -> Result<Vec<Finding>> {
    let (rod, e, one) = (rod(), ratio(1, 1), [ratio(1, 1)]);
    let law = reading.only(0).pick(fremond::planar as Law, moreau::normal_only);
    let [mean, after] = [law(&rod, &one, &e)?, moreau::normal_only(&rod, &one, &e)?].map(|end| rod.energy_change(&end));
    let pair = two_rough_contacts();
    let rough = law(&pair, &[ratio(1, 8), ratio(1, 8)], &e)?;
    let friction = (0..2).map(|k| {
        let mean = (&rough.after[2 * k + 1] + &pair.velocity[2 * k + 1]) * ratio(1, 2);
        -(ratio(1, 8) * &rough.impulse[2 * k] * mean.magnitude())
    });
    let predicted = friction.fold(ratio(0, 1), |sum, work| sum + work);
    let normal = match reading.only(1) {
        Reading::Recorded => settled(law)?,
        Reading::Control(_) => one_after_the_other(&cradle(), &[e.clone(), e.clone()])?.after,
    };
    let mut findings = vec![
        Finding::exact("ΔT of the rod, e = 1", &mean, &ratio(0, 1), "J").says_at_most(ratio(0, 1)).reading("as a law that gains no energy"),
        Finding::exact("ΔT of two rough contacts against −Σ μP_n½|U_t⁺ + U_t⁻|", &pair.energy_change(&rough), &predicted, "J"),
        Finding::decision("three balls: (−1/3, 2/3, 2/3), as if at once", normal == relative(at_once(&e)), true),
        Finding::decision("three balls: (0, 0, 1), as one after the other", normal == relative(after_two_impacts(&e)), false)
            .says(true)
            .reading("as what settles the order of the impacts"),
    ];
    findings.extend(lookups::check("S7.fremond-2024", reading)?);
    findings.push(Finding::exact("ΔT of the rod with Coulomb friction on U_t⁺", &after, &ratio(9, 80), "J").context());
    Ok(findings)
}

/// Energies gained by the impacts of the grid with e = (1, 0), all reversed, after a projection.
fn gaining(project: impl Fn(&PlanarProblem<Rational>) -> Result<Projection<Rational>>) -> Result<usize> {
    let mut gaining = 0;
    for impact in frictionless_grid(false) {
        let projected = project(&impact)?;
        let after = energy_projection::energy(&impact, &projected.direction)? * projected.factor_squared;
        gaining += usize::from(after > energy_projection::energy(&impact, &impact.velocity)?);
    }
    Ok(gaining)
}

fn projection(reading: Reading) -> Result<Vec<Finding>> {
    let pulled = middle([ratio(-1, 1), ratio(-1, 2)]);
    let lifted = ends([ratio(-1, 1), ratio(1, 2)]);
    let candidate = |impact: &PlanarProblem<Rational>| newton::together(impact, &[ratio(1, 1), ratio(0, 1)]);
    let project = |impact: &PlanarProblem<Rational>| -> Result<Projection<Rational>> {
        let after = candidate(impact)?.after;
        let projected = energy_projection::project(impact, &after)?;
        Ok(reading.only(1).pick(projected, Projection { direction: after, factor_squared: ratio(1, 1) }))
    };
    let rounded = super::impacts::rounded(reading.only(0).pick(&pulled, &lifted));
    let start = energy_projection::project(&rounded, &newton::together(&rounded, &[1.0, 0.0])?.after)?;
    let end = start.outcome(&rounded)?;
    let gained = pulled.energy_change(&candidate(&pulled)?);
    let root = 0.75f64.sqrt();
    Ok(vec![
        Finding::equal("impulse at the second contact", end.impulse[1], -root / 3.0, rounding(16, 1.0), "N·s")
            .says_at_least(0.0)
            .reading("as an impact law, whose impulses push"),
        Finding::count("projected impacts that gain energy", gaining(project)?, 0).reading("as a projection of velocities"),
        Finding::exact("square of the factor", &project(&pulled)?.factor_squared, &ratio(3, 4), "1"),
        Finding::exact("energy gained by the candidate", &gained, &ratio(1, 12), "J").context(),
    ])
}

/// ω⁺/ω⁻ of a block of 1 kg, half width 1 m and half height 2 m, that turns about its left edge and lands on the right one, e = 0.
fn landing_ratio(friction: &Rational) -> Result<Rational> {
    let [one, two, zero] = [1, 2, 0].map(|x| ratio(x, 1));
    let mass = DMatrix::from_diagonal(&DVector::from_vec(vec![one.clone(), one.clone(), ratio(5, 3)]));
    // rows n = (0, 1, x), t = (1, 0, −y) of the edges at (∓1, −2) from the centre
    let jacobian = DMatrix::from_row_slice(4, 3, &[0, 1, -1, 1, 0, 2, 0, 1, 1, 1, 0, 2].map(|x| ratio(x, 1)));
    let before = DVector::from_vec(vec![two, -one.clone(), -one]);
    let impact = PlanarProblem::new(delassus(&mass, &jacobian)?, &jacobian * &before);
    let outcome = moreau::normal_only(&impact, &[friction.clone(), friction.clone()], &zero)?;
    let change = (jacobian.transpose() * outcome.impulse)[2].clone() * ratio(3, 5);
    Ok((&before[2] + change) / &before[2])
}

fn rocking(reading: Reading) -> Result<Vec<Finding>> {
    let (b, c) = (ratio(1, 1), ratio(2, 1));
    let least = landing::least_friction(&b, &c);
    let floors = [ratio(1, 1), least.clone(), ratio(1, 3), ratio(0, 1)];
    let floors = match reading {
        Reading::Recorded => floors,
        Reading::Control(0) => [ratio(0, 1), ratio(0, 1), ratio(0, 1), ratio(0, 1)],
        Reading::Control(_) => [ratio(1, 1), ratio(1, 1), ratio(1, 1), ratio(1, 1)],
    };
    let ratios = floors.iter().map(landing_ratio).collect::<Result<Vec<_>>>()?;
    let held = landing::pivoting(&b, &c);
    let outcomes: Vec<_> = ratios.iter().map(|ratio| DVector::from_element(1, ratio.clone())).collect();
    Ok(vec![
        Finding::count("different outcomes with e = 0, μ = 1, 6/17, 1/3, 0", different(&outcomes), 3).says_at_least(2),
        Finding::exact("ω⁺/ω⁻ at μ = 1", &ratios[0], &held, "1"),
        Finding::exact("ω⁺/ω⁻ at μ = 6/17", &ratios[1], &held, "1"),
        Finding::decision("at μ = 1/3 the ratio is another", ratios[2] != held, true),
        Finding::exact("ω⁺/ω⁻ on a smooth floor", &ratios[3], &landing::smooth(&b, &c), "1"),
        Finding::exact("least friction that holds the edge", &least, &ratio(6, 17), "1").context(),
    ])
}

/// Used by the exercises: the uniform rod of 1 kg and length 2 m with supports at ±d from its centre, W = 1 ± 3d².
pub(super) fn rod_above_supports(distance: &Rational, before: [Rational; 2]) -> PlanarProblem<Rational> {
    let arm = ratio(3, 1) * distance * distance;
    let mut rod = impact(&[0, 0, 0, 0], before);
    for i in 0..2 {
        for j in 0..2 {
            rod.delassus[(i, j)] = if i == j { ratio(1, 1) + &arm } else { ratio(1, 1) - &arm };
        }
    }
    rod
}
