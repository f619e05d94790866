//! §2, what the bipotential is said to have made provable.

use crate::claims::prelude::*;
use moreau_exact::witness::{Witness, decided};

pub const CLAIMS: &[Claim] = &[Claim {
    id: "S2.dzonou",
    statement: "De Saxcé's bipotential is the key of the convergence proof by Dzonou and Monteiro Marques (Nonlinear Analysis, 2007), \
        which gets over the lack of semicontinuity of Coulomb's law.",
    verdict: ClaimVerdict::Ambiguous,
    kind: Kind::Citation,
    severity: None,
    evidence: Evidence::Exact,
    correct_statement: r"The paper was not read. Those found under these names treat one perfect constraint without friction (with Paoli,
        Nonlinear Dynamics 58 (2009) 361). What can be decided: as a set-valued law, with or without a bipotential, Coulomb's law has a
        closed graph; what lacks it is the single-valued law with $r_t = 0$ at rest.",
    argument: r"$\mu = 7/10$, $r_n = 1$: the sliding pairs $u = (0, 1/k)$, $r = (1, -\mu)$, $k = 1$ … 64, satisfy both laws. Their limit
        $u = 0$ has $r \in K$ and $r\cdot\hat u = 0$, so the set-valued law holds there and lacks nothing; the single-valued law does not
        hold in the limit.",
    controls: &[r"$\mu = 0$: no reading of the law lacks semicontinuity.", "A coefficient at rest below that of sliding."],
    sources: &["chapter §2, friction by the bipotential, and §7, convergence with friction", "HAL hal-01552482 (abstract)"],
    check: check!(closed_graph),
}];

/// The coefficients of friction \[1\].
struct Friction {
    /// While sliding.
    sliding: Rational,
    /// At rest.
    rest: Rational,
}

/// K ∋ r ⟂ u + μ|u_t| n ∈ K* in the plane, r and u as (n, t).
fn coulomb(friction: &Friction, u: &[Rational; 2], r: &[Rational; 2]) -> bool {
    let zero = ratio(0, 1);
    let mu = if u[1] == zero { &friction.rest } else { &friction.sliding };
    let decide = || {
        let lifted = &u[0] + mu * u[1].magnitude();
        let admissible = r[1].magnitude() <= mu * &r[0] && lifted >= mu * u[1].magnitude();
        admissible && &r[0] * lifted + &r[1] * &u[1] == zero
    };
    let vectors = || [("velocity", u), ("impulse", r)].map(|(name, vector)| (name, vector.as_slice().into()));
    let parts = |found: bool| vectors().into_iter().chain([("friction", mu.into()), ("answer", found.into())]).collect();
    decided(decide, |found| Some(Witness::new("coulomb", parts(*found))))
}

/// r_t = −μ r_n sign(u_t), with sign(0) = 0.
fn single_valued(friction: &Friction, u: &[Rational; 2], r: &[Rational; 2]) -> bool {
    let (zero, mu) = (ratio(0, 1), &friction.sliding);
    let opposite = if u[1] > zero {
        -mu.clone()
    } else if u[1] < zero {
        mu.clone()
    } else {
        zero.clone()
    };
    u[0] == zero && r[0] >= zero && r[1] == opposite * &r[0]
}

fn closed_graph(reading: Reading) -> Result<Vec<Finding>> {
    type PlanarLaw = fn(&Friction, &[Rational; 2], &[Rational; 2]) -> bool;
    let mu = reading.only(0).pick(ratio(7, 10), ratio(0, 1));
    let friction = Friction { rest: reading.only(1).pick(mu.clone(), ratio(3, 5)), sliding: mu.clone() };
    let pressed = [ratio(1, 1), -mu];
    let at = |slip: Rational| [ratio(0, 1), slip];
    let breaks_off = |law: PlanarLaw| {
        let slides = (1..=64).all(|k| law(&friction, &at(ratio(1, k)), &pressed));
        slides && !law(&friction, &at(ratio(0, 1)), &pressed)
    };
    let pulled = [ratio(1, 1), ratio(7, 10)];
    Ok(vec![
        Finding::decision("the set-valued law holds on a sequence and not in its limit", breaks_off(coulomb), false)
            .says(true)
            .reading("Coulomb's law as a set-valued law"),
        Finding::decision("the single-valued law holds on a sequence and not in its limit", breaks_off(single_valued), true)
            .reading("Coulomb's law with r_t = 0 at rest"),
        Finding::decision("a pair that pulls along satisfies the set-valued law", coulomb(&friction, &at(ratio(1, 1)), &pulled), false)
            .context(),
    ])
}
