//! De Saxcé's bipotential and Coulomb's law as a complementarity of cones, on a grid of exact pairs.

use super::half_space::{pairs, whole};
use crate::claims::prelude::*;
use moreau_exact::witness::{Part, Witness, decided};

/// Claims on the bipotential.
pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S2.bipotential",
        statement: r"De Saxcé's bipotential is $b(v, r) = \mu\|v_t\|\,r_n + \langle v, r\rangle$.",
        verdict: ClaimVerdict::False,
        kind: Kind::Definition,
        severity: Some(Severity::WrongStatement),
        evidence: Evidence::Exact,
        correct_statement: r"$b(-u, r) = \mu\,r_n\|u_t\|$ plus the indicators of $u_n \ge 0$ and $r \in K_\mu$. The printed expression is
            its residual $b(-u, r) + \langle u, r\rangle$ without the indicators, zero exactly on the contact law.",
        argument: r"A bipotential satisfies $b(-u, r) \ge -\langle u, r\rangle$ with equality exactly on the law. Sliding with
            $u = (0, 1, 0)$, $r = (1, -\mu, 0)$, $\mu = 7/10$: $-\langle u, r\rangle = 7/10 = \mu\,r_n\|u_t\|$, but the printed expression
            is 7/5 with $v = -u$, and 0 with $v = u$. With $v = u$ it is right under another name: as the residual it vanishes on all
            stick, slip and open pairs of the grid with $r \in K_\mu$, $u_n \ge 0$, and on no other of them.",
        controls: &[r"$\mu\|v_t\|\,r_n$ without the term $\langle v, r\rangle$."],
        sources: &["chapter §2, friction by the bipotential", "de Saxcé and Feng, The bipotential method (1998)"],
        check: check!(bipotential),
    },
    Claim {
        id: "S2.desaxce-incl",
        statement: "With the bipotential, contact with friction becomes one implicit inclusion that unites normal complementarity and \
            maximal dissipation.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Exact,
        correct_statement: r"$K_\mu \ni r \perp u + \mu\|u_t\|\,n \in K_\mu^*$.",
        argument: r"$\hat u_n = u_n + \mu\|u_t\|$, so $\hat u \in K^*$ iff $u_n \ge 0$, and
            $r\cdot\hat u = r_n\,u_n + (\mu\,r_n\|u_t\| + r_t\cdot u_t)$ is a sum of two terms that are $\ge 0$ on $r \in K$: it vanishes
            iff Signorini's and Coulomb's laws hold. On a grid of rational pairs with rational norms the two formulations agree
            everywhere; stick, slip and separation all satisfy the inclusion somewhere.",
        controls: &[r"The inclusion without the term $\mu\|u_t\|\,n$."],
        sources: &["chapter §2, friction by the bipotential", "de Saxcé and Feng, The bipotential method (1998)"],
        check: check!(inclusion),
    },
];

/// A vector (n, t) whose tangential part `size · unit` has a rational norm.
struct Vector {
    normal: Rational,
    size: Rational,
    unit: [Rational; 2],
}

impl Vector {
    fn tangent(&self) -> [Rational; 2] {
        self.unit.clone().map(|entry| entry * self.size.clone())
    }

    /// ⟨self, other⟩.
    fn dot(&self, other: &Vector) -> Rational {
        let ([a, b], [c, d]) = (self.tangent(), other.tangent());
        self.normal.clone() * other.normal.clone() + a * c + b * d
    }
}

const MU: [i64; 2] = [7, 10];

fn mu() -> Rational {
    ratio(MU[0], MU[1])
}

/// Normal entries times tangents of four directions and several lengths.
fn vectors(normals: &[Rational], sizes: &[Rational]) -> Vec<Vector> {
    let units = [
        [ratio(3, 5), ratio(4, 5)],
        [ratio(-3, 5), ratio(-4, 5)],
        [ratio(4, 5), ratio(-3, 5)],
        [whole(1), whole(0)],
        [whole(-1), whole(0)],
    ];
    let lengths_and_units: Vec<_> = pairs(sizes, &units).collect();
    pairs(normals, &lengths_and_units)
        .map(|(normal, (size, unit))| Vector { normal: normal.clone(), size: (*size).clone(), unit: (*unit).clone() })
        .collect()
}

/// Velocities and impulses of all kinds, inside, on and outside their cones.
fn pairs_of_the_grid() -> (Vec<Vector>, Vec<Vector>) {
    let velocities = vectors(&[whole(-1), whole(0), ratio(1, 2)], &[whole(0), whole(1), whole(2)]);
    let impulses = vectors(&[whole(0), whole(1), whole(3)], &[whole(0), ratio(1, 2), ratio(7, 10), ratio(21, 10), whole(3)]);
    (velocities, impulses)
}

fn in_cone(r: &Vector) -> bool {
    r.normal >= whole(0) && r.size <= mu() * r.normal.clone()
}

/// Signorini's and Coulomb's laws, case by case.
fn case_by_case(u: &Vector, r: &Vector) -> bool {
    let signorini = u.normal >= whole(0) && r.normal >= whole(0) && u.normal.clone() * r.normal.clone() == whole(0);
    let coulomb = if u.size == whole(0) {
        r.size <= mu() * r.normal.clone()
    } else {
        let bound = mu() * r.normal.clone();
        r.tangent() == u.unit.clone().map(|entry| -(bound.clone() * entry))
    };
    signorini && coulomb
}

/// The same, told to whoever collects witnesses.
fn law_holds(u: &Vector, r: &Vector) -> bool {
    let vector = |of: &Vector| {
        let [a, b] = of.tangent();
        Part::Vector(vec![of.normal.clone(), a, b])
    };
    let parts =
        |found: bool| vec![("friction", Part::Number(mu())), ("velocity", vector(u)), ("impulse", vector(r)), ("answer", found.into())];
    decided(|| case_by_case(u, r), |found| Some(Witness::new("coulomb", parts(*found))))
}

fn bipotential(reading: Reading) -> Result<Vec<Finding>> {
    let weight = reading.pick(whole(1), whole(0));
    let dissipation = |u: &Vector, r: &Vector| mu() * r.normal.clone() * u.size.clone();
    // b(−u, r): the printed expression with v = −u has ⟨v, r⟩ = −⟨u, r⟩
    let potential = |u: &Vector, r: &Vector| dissipation(u, r) - &weight * u.dot(r);
    let excess = |u: &Vector, r: &Vector| potential(u, r) + u.dot(r);
    let slip = Vector { normal: whole(0), size: whole(1), unit: [whole(1), whole(0)] };
    let opposed = Vector { normal: whole(1), size: mu(), unit: [whole(-1), whole(0)] };
    let (velocities, impulses) = pairs_of_the_grid();
    let admissible = |u: &Vector, r: &Vector| u.normal >= whole(0) && in_cone(r);
    let (mut mismatches, mut as_residual) = (0, 0);
    for (u, r) in pairs(&velocities, &impulses).filter(|(u, r)| admissible(u, r)) {
        mismatches += usize::from((excess(u, r) == whole(0)) != law_holds(u, r));
        as_residual += usize::from((dissipation(u, r) + u.dot(r) == whole(0)) != law_holds(u, r));
    }
    Ok(vec![
        Finding::exact("b(−u, r) of a sliding pair with −⟨u, r⟩ = 7/10 J", &potential(&slip, &opposed), &ratio(7, 5), "J").says(mu()),
        Finding::decision("b(−u, r) = −⟨u, r⟩ exactly on the law", mismatches == 0, false).says(true),
        Finding::count("admissible pairs where μ r_n‖u_t‖ + ⟨u, r⟩ = 0 and the law differ", as_residual, 0).context(),
    ])
}

fn inclusion(reading: Reading) -> Result<Vec<Finding>> {
    let (velocities, impulses) = pairs_of_the_grid();
    let (mut mismatches, mut stick, mut slip, mut open) = (0, 0, 0, 0);
    for (u, r) in pairs(&velocities, &impulses) {
        let correction = reading.pick(mu() * u.size.clone(), whole(0));
        let corrected = u.normal.clone() + correction.clone();
        let dual = corrected >= mu() * u.size.clone();
        let complementary = u.dot(r) + r.normal.clone() * correction == whole(0);
        let included = in_cone(r) && dual && complementary;
        mismatches += usize::from(included != law_holds(u, r));
        stick += usize::from(included && r.normal > whole(0) && u.size == whole(0));
        slip += usize::from(included && r.normal > whole(0) && u.size > whole(0));
        open += usize::from(included && u.normal > whole(0));
    }
    Ok(vec![
        Finding::count("pairs where inclusion and Coulomb–Signorini differ", mismatches, 0),
        Finding::decision("stick, slip and separation all satisfy the inclusion", stick > 0 && slip > 0 && open > 0, true),
    ])
}
