//! §5, who wrote and who uses what: papers, simulators, and what scales.

use super::gradient::{grown, pressed_row};
use crate::checks::Finding;
use crate::claims::experiments::identifiers::issn_agrees;
use crate::claims::experiments::siconos::Facts;
use crate::claims::{Claim, ClaimVerdict, Evidence, Kind, Reading, Severity};
use crate::mechanics::{Plane, PointMass, State};
use crate::problem::Law;
use crate::schemes::{SchemeParameters, assembled, by_name};
use crate::solvers::Momentum;
use crate::{Error, Result};
use nalgebra::dvector;

pub(super) const CLAIMS: &[Claim] = &[
    Claim {
        id: "S5.cite",
        statement: "Anitescu, Math. Program. 105:113 (2006).",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Cited,
        correct_statement: "As stated: Optimization-based simulation of nonsmooth rigid multibody dynamics, 105 (1), 113–143.",
        argument: "Volume and page as other papers' lists of references have them; the DOI carries neither. The journal's ISSN, 0025-5610, \
            agrees with its check digit.",
        control: "ISSN 0025-5601, two digits exchanged.",
        sources: &["chapter §5, and the list of papers at its end", "doi:10.1007/s10107-005-0590-7"],
        check: journal,
    },
    Claim {
        id: "S5.apgd-credit",
        statement: "APGD, Nesterov's accelerated projected gradient, is of Tasora and Anitescu (2011), and Chrono's main solver.",
        verdict: ClaimVerdict::False,
        kind: Kind::Assertion,
        severity: Some(Severity::WrongStatement),
        evidence: Evidence::Cited,
        correct_statement: "The paper of 2011 has an iterated fixed point with separable projections, which its abstract calls a \
            contractive mapping. Accelerated gradients for these problems came with Mazhar, Heyn, Negrut and Tasora (2015). That they are \
            in Chrono is so.",
        argument: "A contractive mapping never moves away from the solution. On a row of 40 pressed masses the plain projected gradient \
            does not in 300 iterations; with Nesterov's momentum it does.",
        control: "The plain iteration in place of the accelerated one.",
        sources: &[
            "chapter §5, APGD; list of papers",
            "Tasora and Anitescu, A matrix-free cone complementarity approach (2011), abstract; Mazhar et al., ACM Trans. Graph. 34 \
                (2015), not read",
            "S10.path-chrono",
        ],
        check: contraction,
    },
    Claim {
        id: "S5.who-uses",
        statement: "Drake's SAP and Chrono use the convex relaxation with second-order cones; Siconos offers both kinds of cone.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Cited,
        correct_statement: "As stated; SAP with regularisation R > 0.",
        argument: "The schemes that reproduce SAP's stored motions and Chrono's closed forms pose the associated law over round cones. The \
            pinned Siconos has, among its solvers for friction, FRICTION_3D_SOCLCP, over second-order cones, and \
            FRICTION_3D_GAMS_LCP_PATH, over polyhedral ones.",
        control: "Moreau–Jean in place of SAP: Coulomb's law, not its relaxation.",
        sources: &["chapter §5, table of cones", "moreau systems", "references/facts/siconos.json"],
        check: users,
    },
    Claim {
        id: "S5.pivot-scale",
        statement: "Pivoting is less scalable than first-order methods at 10⁵ contacts.",
        verdict: ClaimVerdict::Ambiguous,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::NotDecidable,
        correct_statement: "Scalable with respect to what is not said: a pivoting method ends with an exact answer, a first-order one with \
            an error. What can be said is memory: a dense tableau does not fit.",
        argument: "Stewart–Trinkle with four directions has 6 unknowns per contact: at 10⁵ contacts a tableau of 3.6·10¹¹ entries, \
            2.9·10¹² bytes; H with two bodies per contact 12 entries in each of three rows, 2.9·10⁷ bytes.",
        control: "10³ contacts, whose tableau fits.",
        sources: &["chapter §5, motivation"],
        check: tableau,
    },
];

fn journal(reading: Reading) -> Result<Vec<Finding>> {
    let issn = reading.pick("0025-5610", "0025-5601");
    Ok(vec![Finding::decision(format!("the check digit of ISSN {issn} agrees"), issn_agrees(issn), true)])
}

fn contraction(reading: Reading) -> Result<Vec<Finding>> {
    let problem = pressed_row(40);
    let accelerated = grown(&problem, reading.pick(Momentum::Nesterov, Momentum::Plain))?;
    Ok(vec![
        Finding::decision("the accelerated iteration moves away from the solution at times", accelerated > 0, true),
        Finding::count("iterations of the plain one that do", grown(&problem, Momentum::Plain)?, 0),
    ])
}

fn users(reading: Reading) -> Result<Vec<Finding>> {
    let law = |scheme: &str| -> Result<Option<Law>> {
        let block = PointMass::new("block", 1.0, dvector![0.0, 0.0, -9.81], vec![Plane::new(dvector![0.0, 0.0, 1.0], 0.0, 0.5, 0.0)?])?;
        let state = State { time: 0.0, position: dvector![0.0, 0.0, -0.001], velocity: dvector![1.0, 0.0, 0.0] };
        let scheme = by_name(scheme, SchemeParameters::default())?;
        let waist = scheme.waist().ok_or_else(|| Error::Unsupported("the scheme does not pass the waist".into()))?;
        Ok(assembled(waist, &block, &state, 0.01)?.problem.map(|problem| problem.law()))
    };
    let relaxed = Some(Law::Associated);
    let siconos = Facts::stored()?;
    Ok(vec![
        Finding::decision("SAP poses the associated law over round cones", law(reading.pick("drake-sap", "moreau-jean"))? == relaxed, true),
        Finding::decision("Chrono poses the associated law over round cones", law("chrono")? == relaxed, true),
        Finding::decision("Siconos solves over second-order cones", siconos.solves_with("FRICTION_3D_SOCLCP"), true),
        Finding::decision("Siconos solves over polyhedral cones", siconos.solves_with("FRICTION_3D_GAMS_LCP_PATH"), true),
    ])
}

fn tableau(reading: Reading) -> Result<Vec<Finding>> {
    let contacts = reading.pick(1e5, 1e3);
    let unknowns = 6.0 * contacts;
    let terabyte = 1e12;
    Ok(vec![
        Finding::at_least("dense tableau", 8.0 * unknowns * unknowns, terabyte, "B"),
        Finding::at_most("H of two bodies per contact", 8.0 * 3.0 * 12.0 * contacts, terabyte, "B"),
    ])
}
