//! Several contacts at once: what is unique, and what the order of impacts decides.

use super::impacts::{cradle, ends, frictionless_grid, impact, middle, rod};
use crate::claims::prelude::*;
use crate::closed_forms::newtons_cradle::{after_two_impacts, at_once};
use crate::closed_forms::rocking_block::landing;
use crate::contact::delassus::delassus;
use crate::elimination::rank;
use crate::impact_laws::sequential::sequential;
use crate::impact_laws::{energy_projection, fremond, moreau, newton};
use crate::problem::{Lcp, PlanarProblem, Response};
use crate::solvers::enumeration::all_solutions;
use crate::tolerance::rounding;

pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S7.multi-nonunique",
        statement: "Three balls colliding at once, or a block landing on four corners: there is no unique Newton solution; the velocities \
            after it depend on the microscopic order of the contacts.",
        verdict: ClaimVerdict::False,
        kind: Kind::Assertion,
        severity: Some(Severity::WrongStatement),
        evidence: Evidence::Exact,
        correct_statement: "Posed at once without friction, the velocities are unique: v⁺ solves a strictly convex program; for three \
            balls even the impulses are, for four corners not. What is not unique is whether it happens at once: another order is another \
            problem, and its outcome differs, as the chapter says of the order.",
        argument: "Three balls, e = 1: one solution, v⁺ = (−1/3, 2/3, 2/3). One impact after the other: (0, 0, 1). Both keep momentum \
            and energy. e = 1/2: (0, 1/2, 1/2) against (13, 15, 36)/64. Four corners: a family of impulses, all with U⁺ = −eU⁻. The \
            outer balls meet the middle one, e = 1/2: one outcome at once, two outcomes one after the other; a cube on its corners the \
            same, one and several.",
        controls: &["The impacts one after the other, in every order."],
        sources: &["chapter §7, simultaneous impacts"],
        check: uniqueness,
    },
    Claim {
        id: "S7.four-corners",
        statement: "A block landing flat on four corners is a pathological case.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Exact,
        correct_statement: "For the impulses only: W has rank 3 with null vector (1, −1, 1, −1), so that any multiple of it may be added \
            while P stays ≥ 0. The velocities are unique.",
        argument: "Cube of 1 kg and 1 m: W_ij = 4, 1 and −2 for a corner with itself, its neighbours and the opposite one. U⁻ = −1 \
            everywhere, e = 0: P = (1, 1, 1, 1)/4 + t(1, −1, 1, −1), |t| ≤ 1/4, all with U⁺ = 0.",
        controls: &["Three corners, whose W is nonsingular."],
        sources: &["chapter §7, simultaneous impacts"],
        check: four_corners,
    },
    Claim {
        id: "S7.solver-pivot",
        statement: "Simulators return some solution of such an impact, which depends on the solver's order of pivots; one more reason for \
            “another solver, another result”.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Exact,
        correct_statement: "The impulses depend on it, the velocities do not as long as there is no friction. With friction the velocities \
            may (S4.painleve-atom: three solutions).",
        argument: "Four corners, e = 0, Lemke's method with the contacts in all 24 orders: several different P, one U⁺. Three balls: one \
            P.",
        controls: &["Three corners, whose W is nonsingular."],
        sources: &["chapter §7, simultaneous impacts"],
        check: order_of_pivots,
    },
    Claim {
        id: "S7.fremond-2024",
        statement: "A solution: Frémond's law for several bodies (Acary and others, 2024), a global energy functional that constrains all \
            contacts.",
        verdict: ClaimVerdict::Ambiguous,
        kind: Kind::Citation,
        severity: None,
        evidence: Evidence::Cited,
        correct_statement: "The paper was not read; it may be Acary and Collins-Craft's on the Moreau–Jean scheme with Frémond's law \
            (HAL hal-04230941, known here from another project's reference list). Siconos has a law of that name: Newton's e on the normal \
            components and Coulomb friction on θU_t⁺ + (1−θ)U_t⁻. At θ = 1/2 it cannot gain energy from approaching contacts, at any \
            number of them. It does not settle the order: without friction it is Moreau's law.",
        argument: "ΔT = −½Σ(1−e)P_n|U_n⁻| − Σ μP_n½|U_t⁺ + U_t⁻|. The rod, μ = 1, e = 1: 0 where e on the normal component gains 9/80. Two \
            contacts with μ = 1/8, U⁻ = (−5/2, 3/2), (−1, 2), e = 1: −3/8 J, as the formula says. Three balls: (−1/3, 2/3, 2/3).",
        controls: &["Coulomb friction on U_t⁺ alone."],
        sources: &[
            "chapter §7, simultaneous impacts",
            "Siconos, kernel/src/modelingTools/FremondImpactFrictionNSL.hpp and MoreauJeanOSI.cpp, source of 2024 or later",
        ],
        check: fremond_law,
    },
    Claim {
        id: "S7.pfeiffer-glocker-proj",
        statement: "A solution: an energy-consistent Pfeiffer–Glocker projection, which projects the velocities after the impact on the \
            feasible set of no energy gain.",
        verdict: ClaimVerdict::Ambiguous,
        kind: Kind::Citation,
        severity: None,
        evidence: Evidence::Certified,
        correct_statement: "Such a projection exists and is explicit: on the cone U ≥ 0, then scaled, in the metric W⁻¹, which keeps \
            momentum. But it may leave an impulse that pulls. Under this name no source was found; Pfeiffer and Glocker's two \
            complementarity problems gain no energy by themselves.",
        argument: "W = (2, 1; 1, 2), e = (1, 0), U⁻ = (−1, −1/2), all reversed: T from 1/4 to 1/3; projected U⁺ = √(3/4) (1, 0), T = 1/4, \
            and P₂ = −√(3/4)/3 < 0. W = (2, −1; −1, 2), U⁻ = (−1, 1/2): the same factor, and P > 0.",
        controls: &["The second pair in the place of the first."],
        sources: &["chapter §7, simultaneous impacts", "Pfeiffer and Glocker 1996 for the two problems"],
        check: projection,
    },
    Claim {
        id: "S7.rocking",
        statement: "Velocity jumps with several contacts are not determined by a pointwise e alone (the block that lands on its base).",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: "As stated: with e = 0 at both edges the outcome depends on friction. If the edge that is hit holds, ω⁺/ω⁻ = 1 \
            − 3/2 sin²α (Housner); on a smooth floor (c² − 2b²)/(c² + 4b²).",
        argument: "Half width 1, half height 2: 7/10 for μ ≥ 6/17, 1/4 for μ = 0, both from one Moreau step with two contacts; at μ = 1/3 \
            the edge slips and the ratio is another.",
        controls: &["μ = 1/3, at which the edge slips."],
        sources: &["chapter §7, simultaneous impacts", "Housner 1963 for the ratio, derived again here"],
        check: rocking,
    },
];

fn whole(entries: &[i64]) -> DVector<Rational> {
    DVector::from_iterator(entries.len(), entries.iter().map(|&x| ratio(x, 1)))
}

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

/// U⁺ of every solution of the impact posed at once, or of its impacts one after the other in every order.
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
    let (balls, e) = (cradle(), ratio(1, 1));
    let velocities = outcomes(reading, &balls, &e)?;
    let ordered = sequential(&balls, &e, &[0, 1])?;
    let half = sequential(&balls, &ratio(1, 2), &[0, 1])?;
    let corners = cube(&[0, 1, 2, 3]);
    let solutions = all_solutions(&Lcp::new(corners.delassus.clone(), corners.velocity.clone()))?;
    let landed = outcomes(reading, &corners, &ratio(1, 2))?;
    let met = outcomes(reading, &ends([ratio(-1, 1), ratio(-1, 1)]), &ratio(1, 2))?;
    let expected = relative(at_once(&e));
    Ok(vec![
        Finding::decision("three balls at once: every solution is (−1/3, 2/3, 2/3)", velocities.iter().all(|u| *u == expected), true)
            .says(false),
        Finding::count("different velocities after the outer balls meet the middle one", different(&met), 1).says_at_least(2),
        Finding::count("different velocities of four corners", different(&landed), 1).says_at_least(2),
        Finding::decision("one after the other: (0, 0, 1)", ordered.after == relative(after_two_impacts(&e)), true),
        Finding::exact("energy changed at once", &balls.energy_change(&moreau::frictionless(&balls, &[e.clone(), e])?), &ratio(0, 1), "J")
            .context(),
        Finding::exact("energy changed one after the other", &balls.energy_change(&ordered), &ratio(0, 1), "J").context(),
        Finding::exact("v₃⁺ − v₂⁺ one after the other, e = 1/2", &half.after[1], &ratio(21, 64), "m/s"),
        Finding::decision("four corners: the impulses are unique", solutions.is_unique(), false),
    ])
}

fn four_corners(reading: Reading) -> Result<Vec<Finding>> {
    let all = cube(&[0, 1, 2, 3]);
    let subject = reading.pick(all.clone(), cube(&[0, 1, 2]));
    let solutions = all_solutions(&Lcp::new(subject.delassus.clone(), subject.velocity.clone()))?;
    let landed = all_velocities(&all, &ratio(0, 1))?;
    let even = all.response(DVector::from_element(4, ratio(1, 4)));
    let tilted = all.response(DVector::from_vec(vec![ratio(1, 2), ratio(0, 1), ratio(1, 2), ratio(0, 1)]));
    Ok(vec![
        Finding::decision("the impulses are unique", solutions.is_unique(), false),
        Finding::count("different velocities of the cube", different(&landed), 1).says_at_least(2).violating("that the impulses are meant"),
        Finding::count("rank of W", rank(&all.delassus), 3).context(),
        Finding::decision("(1, −1, 1, −1) is in the kernel of W", &all.delassus * whole(&[1, -1, 1, -1]) == whole(&[0; 4]), true),
        Finding::decision("P = (1, 1, 1, 1)/4 stops the cube", even.after == whole(&[0; 4]), true),
        Finding::decision("P = (1/2, 0, 1/2, 0) stops it as well", tilted.after == whole(&[0; 4]), true),
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

/// Different impulses and different velocities that Lemke's method returns for the contacts in all orders.
fn outcomes_in_all_orders(impact: &PlanarProblem<Rational>) -> Result<[usize; 2]> {
    let (mut impulses, mut velocities): (Vec<DVector<Rational>>, Vec<DVector<Rational>>) = (vec![], vec![]);
    let size = impact.velocity.len();
    for order in orders(size) {
        let permuted = PlanarProblem::new(
            DMatrix::from_fn(size, size, |i, j| impact.delassus[(order[i], order[j])].clone()),
            DVector::from_fn(size, |i, _| impact.velocity[order[i]].clone()),
        );
        let outcome = moreau::frictionless(&permuted, &vec![ratio(0, 1); size])?;
        let mut impulse = DVector::from_element(size, ratio(0, 1));
        order.iter().enumerate().for_each(|(i, &contact)| impulse[contact] = outcome.impulse[i].clone());
        let velocity = impact.response(impulse.clone()).after;
        if !impulses.contains(&impulse) {
            impulses.push(impulse);
        }
        if !velocities.contains(&velocity) {
            velocities.push(velocity);
        }
    }
    Ok([impulses.len(), velocities.len()])
}

fn order_of_pivots(reading: Reading) -> Result<Vec<Finding>> {
    let [impulses, velocities] = outcomes_in_all_orders(&reading.pick(cube(&[0, 1, 2, 3]), cube(&[0, 1, 2])))?;
    Ok(vec![
        Finding::count("different velocities of four corners", velocities, 1)
            .says_at_least(2)
            .violating("that the impulses are meant, or friction"),
        Finding::decision("several different impulses", impulses > 1, true),
        Finding::count("different impulses of three balls", outcomes_in_all_orders(&cradle())?[0], 1)
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

fn fremond_law(reading: Reading) -> Result<Vec<Finding>> {
    let (rod, e, one) = (rod(), ratio(1, 1), [ratio(1, 1)]);
    let law = reading.pick(fremond::planar as Law, moreau::normal_only);
    let [mean, after] = [law(&rod, &one, &e)?, moreau::normal_only(&rod, &one, &e)?].map(|end| rod.energy_change(&end));
    let pair = two_rough_contacts();
    let rough = fremond::planar(&pair, &[ratio(1, 8), ratio(1, 8)], &e)?;
    let friction = (0..2).map(|k| {
        let mean = (&rough.after[2 * k + 1] + &pair.velocity[2 * k + 1]) * ratio(1, 2);
        -(ratio(1, 8) * &rough.impulse[2 * k] * mean.magnitude())
    });
    let predicted = friction.fold(ratio(0, 1), |sum, work| sum + work);
    let settled = law(&cradle_with_tangents(), &[ratio(1, 2), ratio(1, 2)], &e)?.after;
    let normal = DVector::from_vec(vec![settled[0].clone(), settled[2].clone()]);
    Ok(vec![
        Finding::exact("ΔT of the rod, e = 1", &mean, &ratio(0, 1), "J").says_at_most(ratio(0, 1)).reading("as a law that gains no energy"),
        Finding::exact("with Coulomb friction on U_t⁺", &after, &ratio(9, 80), "J").context(),
        Finding::exact("ΔT of two rough contacts against −Σ μP_n½|U_t⁺ + U_t⁻|", &pair.energy_change(&rough), &predicted, "J"),
        Finding::exact("which is", &predicted, &ratio(-3, 8), "J"),
        Finding::decision("three balls: (−1/3, 2/3, 2/3), as if at once", normal == relative(at_once(&e)), true),
        Finding::decision("three balls: (0, 0, 1), as one after the other", normal == relative(after_two_impacts(&e)), false)
            .says(true)
            .reading("as what settles the order of the impacts"),
    ])
}

fn projection(reading: Reading) -> Result<Vec<Finding>> {
    let pulled = middle([ratio(-1, 1), ratio(-1, 2)]);
    let lifted = ends([ratio(-1, 1), ratio(1, 2)]);
    let pair = [ratio(1, 1), ratio(0, 1)];
    let subject = reading.pick(&pulled, &lifted);
    let candidate = newton::together(&pulled, &pair)?;
    let projected = energy_projection::project(&pulled, &candidate.after)?;
    let rounded = super::impacts::rounded(subject);
    let start = energy_projection::project(&rounded, &newton::together(&rounded, &[1.0, 0.0])?.after)?;
    let end = start.outcome(&rounded)?;
    let mut gaining = 0;
    for impact in frictionless_grid(false) {
        let candidate = newton::together(&impact, &pair)?;
        let projected = energy_projection::project(&impact, &candidate.after)?;
        let energy = energy_projection::energy(&impact, &projected.direction)? * projected.factor_squared;
        gaining += usize::from(energy > energy_projection::energy(&impact, &impact.velocity)?);
    }
    let root = 0.75f64.sqrt();
    Ok(vec![
        Finding::equal("impulse at the second contact", end.impulse[1], -root / 3.0, rounding(16, 1.0), "N·s")
            .says_at_least(0.0)
            .reading("as an impact law, whose impulses push"),
        Finding::exact("energy gained by the candidate", &pulled.energy_change(&candidate), &ratio(1, 12), "J"),
        Finding::exact("square of the factor", &projected.factor_squared, &ratio(3, 4), "1"),
        Finding::equal("U₁⁺ after projection", end.after[0], root, rounding(16, 1.0), "m/s"),
        Finding::count("projected impacts that gain energy", gaining, 0).reading("as a projection of velocities"),
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
    let held = landing_ratio(&reading.pick(least.clone(), ratio(1, 3)))?;
    Ok(vec![
        Finding::exact("ω⁺/ω⁻ at μ = 6/17", &held, &landing::pivoting(&b, &c), "1"),
        Finding::exact("ω⁺/ω⁻ at μ = 1", &landing_ratio(&ratio(1, 1))?, &ratio(7, 10), "1"),
        Finding::exact("ω⁺/ω⁻ on a smooth floor", &landing_ratio(&ratio(0, 1))?, &landing::smooth(&b, &c), "1"),
        Finding::exact("its closed form", &landing::smooth(&b, &c), &ratio(1, 4), "1"),
        Finding::exact("least friction that holds the edge", &least, &ratio(6, 17), "1"),
        Finding::decision("at μ = 1/3 the ratio is another", landing_ratio(&ratio(1, 3))? != ratio(7, 10), true),
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
