//! §2, what the bipotential is said to have made provable.

use crate::Result;
use crate::checks::Finding;
use crate::claims::{Claim, ClaimVerdict, Evidence, Kind, Reading};
use crate::scalar::{Rational, Scalar, ratio};

pub const CLAIMS: &[Claim] = &[Claim {
    id: "S2.dzonou",
    statement: "De Saxcé's bipotential is the key of the convergence proof by Dzonou and Monteiro Marques (Nonlinear Analysis, 2007), \
        which gets over the lack of semicontinuity of Coulomb's law.",
    verdict: ClaimVerdict::Ambiguous,
    kind: Kind::Assertion,
    severity: None,
    evidence: Evidence::Cited,
    correct_statement: "The paper was not read. Those found under these names treat one perfect constraint without friction (with Paoli, \
        Nonlinear Dynamics 58 (2009) 361). What can be decided: as a set-valued law, with or without a bipotential, Coulomb's law has a \
        closed graph; what lacks it is the single-valued law with r_t = 0 at rest.",
    argument: "μ = 7/10, r_n = 1: the sliding pairs u = (0, 1/k), r = (1, −μ), k = 1 … 64, have r ∈ K and r·û = 0, and so has their limit \
        u = 0. The single-valued law holds at every k and not in the limit.",
    control: "The single-valued law in the limit.",
    sources: &["chapter §2, friction by the bipotential, and §7, convergence with friction", "HAL hal-01552482 (abstract)"],
    check: closed_graph,
}];

fn mu() -> Rational {
    ratio(7, 10)
}

/// K ∋ r ⟂ u + μ|u_t| n ∈ K* in the plane, r and u as (n, t).
fn coulomb(u: &[Rational; 2], r: &[Rational; 2]) -> bool {
    let zero = ratio(0, 1);
    let lifted = &u[0] + mu() * u[1].magnitude();
    let admissible = r[1].magnitude() <= mu() * &r[0] && lifted >= mu() * u[1].magnitude();
    admissible && &r[0] * lifted + &r[1] * &u[1] == zero
}

/// r_t = −μ r_n sign(u_t), with sign(0) = 0.
fn single_valued(u: &[Rational; 2], r: &[Rational; 2]) -> bool {
    let zero = ratio(0, 1);
    let opposite = if u[1] > zero {
        -mu()
    } else if u[1] < zero {
        mu()
    } else {
        zero.clone()
    };
    u[0] == zero && r[0] >= zero && r[1] == opposite * &r[0]
}

fn closed_graph(reading: Reading) -> Result<Vec<Finding>> {
    let law: fn(&[Rational; 2], &[Rational; 2]) -> bool = reading.pick(coulomb, single_valued);
    let pressed = [ratio(1, 1), -mu()];
    let sliding = (1..=64).filter(|k| law(&[ratio(0, 1), ratio(1, *k)], &pressed)).count();
    Ok(vec![
        Finding::decision("the limit of the sliding pairs satisfies the law", law(&[ratio(0, 1), ratio(0, 1)], &pressed), true),
        Finding::count("sliding pairs that satisfy it", sliding, 64),
        Finding::decision("a pair that pulls along satisfies it", law(&[ratio(0, 1), ratio(1, 1)], &[ratio(1, 1), mu()]), false),
    ])
}
