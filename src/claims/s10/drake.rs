//! Drake's rows of the comparison.

use crate::checks::Finding;
use crate::claims::experiments::drake::{MATERIAL, facts, lift, predicted_lift};
use crate::claims::experiments::stored::{Faller, update_residuals};
use crate::claims::{Claim, ClaimVerdict, Evidence, Kind, Reading, Severity};
use crate::cones::projection_jacobian;
use crate::mechanics::{PointMass, State};
use crate::schemes::drake::{Material, Touch, tamsi_law};
use crate::schemes::{DrakeSap, step};
use crate::solvers::SemiAnalyticPrimal;
use crate::tolerance::claims::drake as tolerance;
use crate::tolerance::{rounding, solvers::STOP};
use crate::{Error, Result};
use nalgebra::dvector;

const PACKAGE: &str = "Drake 1.51.1, its Python module and the documentation in it (references/facts/drake.json)";
const SAP_PAPER: &str = "Castro, Permenter and Han, IEEE Trans. Robotics 39 (2023) 1301";

pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S10.drake-tamsi-row",
        statement: "Drake TAMSI: semi-implicit Euler, non-convex complementarity with a line search that limits the angle of slip, \
            compliant Hunt–Crossley contact; mature, but may fail.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Exact,
        correct_statement: "As stated for releases that have it: Drake 1.51.1 does, and announces its removal from 2026-09-01 on. There is \
            no complementarity left in it: friction is regularised, and the step is a nonlinear equation that no function has as its \
            gradient.",
        argument: "A touching contact that slips, μ = 3/4: ∂r_t/∂u_n = −μ n′, ∂r_n/∂u_t = 0, so ∂r/∂u is not symmetric and r is no \
            gradient.",
        control: "A symmetric ∂r/∂u, as Lagged's and Similar's are.",
        sources: &["chapter §10, table of simulators", PACKAGE],
        check: tamsi,
    },
    Claim {
        id: "S10.drake-sap-row",
        statement: "Drake SAP: semi-implicit Euler or midpoint of second order, Newton with exact line search on a convex potential, \
            compliant Kelvin–Voigt contact with a rigid limit; globally convergent; glides by O(δt).",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Certified,
        correct_statement: "Kelvin–Voigt contact and its rigid limit belong to the approximation kSap, which is not the default; the \
            default, kLagged, has Hunt–Crossley contact and does not glide. A discrete plant steps by semi-implicit Euler only: the \
            midpoint rule is in the paper. The lift of a sliding block is (δt + τ) μ v, which vanishes with δt only where τ = 0.",
        argument: "Stored fall at h = 1/100 s: q⁺ − q − h v⁺ = 0 to rounding. One step of our SAP on a contact 1 mm deep: r_n = h k(−φ⁺ − \
            τ u_n⁺). With k = 1e9 and 1e10 N/m the step is the same. Sliding at 0.7 instead of 0.2 m/s, τ = 5 ms, h = 4 ms: lifted by 1.35 \
            mm; Lagged by nothing.",
        control: "kLagged's lift in place of kSap's.",
        sources: &["chapter §10, table of simulators", PACKAGE, SAP_PAPER],
        check: sap,
    },
    Claim {
        id: "S10.drake-default-sap",
        statement: "SAP, the convex primal, is Drake's current default.",
        verdict: ClaimVerdict::True,
        kind: Kind::Assertion,
        severity: None,
        evidence: Evidence::Cited,
        correct_statement: "As a solver. The default contact model that it solves is not kSap but kLagged.",
        argument: "A plant of 1.51.1 answers kSap when asked for its solver and kLagged when asked for its approximation; kSap, kSimilar \
            and kLagged all take the solver kSap.",
        control: "The default approximation in place of the default solver.",
        sources: &["chapter §10, table of choices", PACKAGE],
        check: default_solver,
    },
    Claim {
        id: "S10.sap-theorem",
        statement: "SAP: a strictly convex objective with a Lipschitz Hessian makes Newton's method with exact line search converge \
            globally, linearly at first and quadratically at the end.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Certified,
        correct_statement: "It converges globally because the objective is strongly convex with a Lipschitz gradient, and quadratically \
            once it is in the region of one mode per contact. The Hessian itself is not Lipschitz: it jumps where a contact opens or \
            begins to slip.",
        argument: "Across the boundary between stick and slip at μ = 1/2 the derivative of the projection jumps by 1 in norm, however \
            close the two points are: the projector I − ggᵀ drops out.",
        control: "Two points on the same side of the boundary.",
        sources: &["chapter §11, table of theorems", SAP_PAPER],
        check: theorem,
    },
    Claim {
        id: "S10.path-drake",
        statement: "Drake's two contact solvers are in tamsi_solver.cc and contact_solvers/sap/sap_solver.cc.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Cited,
        correct_statement: "Both below multibody/, the first in plant/, in releases up to the removal of TAMSI, announced for 2026-09-01 \
            and later. The Python package holds neither file; it offers both solvers.",
        argument: "1.51.1 offers the solvers kSap and kTamsi, and documents the second as deprecated.",
        control: "A release without an announced removal.",
        sources: &["chapter §10, source files", PACKAGE, "Drake's repository, multibody/plant and multibody/contact_solvers/sap"],
        check: paths,
    },
];

/// A touching contact whose numbers are of size one.
const TOUCH: Touch = Touch {
    time_step: 0.25,
    material: Material { stiffness: 40.0, dissipation: 0.25, stiction_tolerance: 0.5, relaxation_time: 0.0 },
    depth: 0.5,
    friction: 0.75,
    explicit: 3.0,
    slip_scale: 0.5,
};

fn tamsi(reading: Reading) -> Result<Vec<Finding>> {
    let facts = facts()?;
    let velocity = [0.25, 4.0, 0.0];
    let (_, derivative) = tamsi_law(&TOUCH, &velocity);
    let (_, slope) = TOUCH.normal(velocity[0]);
    let soft = 4.0 / 4f64.hypot(0.005);
    let expected = reading.pick(-TOUCH.friction * slope * soft, 0.0);
    Ok(vec![
        Finding::equal("∂r_t/∂u_n", derivative[(1, 0)], expected, rounding(16, slope.abs()), "kg"),
        Finding::equal("∂r_n/∂u_t", derivative[(0, 1)], 0.0, 0.0, "kg"),
        Finding::decision("documented as non-convex, and able to fail", facts.may_fail == "kTamsi", true),
        Finding::decision("announced for removal from 2026-09-01 on", facts.tamsi_removed_from == "2026-09-01", true),
    ])
}

/// φ⁺, u_n⁺ and r_n after one step of a ball of 1 kg that starts 1 mm deep.
fn one_step(stiffness: f64, h: f64) -> Result<[f64; 3]> {
    let scheme = DrakeSap { material: Material { stiffness, ..MATERIAL } };
    let ball = PointMass::ball_on_floor(1.0, 9.81, 0.0);
    let start = State { time: 0.0, position: dvector![-0.001], velocity: dvector![-0.5] };
    let taken = step(&scheme, &SemiAnalyticPrimal, &ball, &start, h)?;
    let impulse = taken.impulses.first().ok_or_else(|| Error::Unsupported("the ball touches".into()))?;
    Ok([taken.state.position[0], taken.state.velocity[0], impulse.impulse[0]])
}

fn sap(reading: Reading) -> Result<Vec<Finding>> {
    let facts = facts()?;
    let h = 0.004;
    let [gap, opening, impulse] = one_step(MATERIAL.stiffness, h)?;
    let spring = h * MATERIAL.stiffness * (-gap - MATERIAL.relaxation_time * opening);
    let rigid = [1e9, 1e10].map(|stiffness| one_step(stiffness, h).map(|[_, velocity, _]| velocity));
    let [one, other] = rigid;
    let ([with_new, _], gliding) = (update_residuals(Faller::Drake)?, lift(reading.pick("drake-sap", "drake-lagged"), h)?);
    let settled = tolerance::settled(9.81 / MATERIAL.stiffness, 1000);
    Ok(vec![
        Finding::equal("lift of a slide, h = 4 ms, τ = 5 ms, μ Δv = 0.15 m/s", gliding, predicted_lift(h), settled, "m"),
        Finding::equal("the same under Lagged", lift("drake-lagged", h)?, 0.0, settled, "m"),
        Finding::equal("r_n − h k(−φ⁺ − τ u_n⁺)", impulse - spring, 0.0, 1e3 * STOP, "N·s"),
        Finding::equal("v⁺ at k = 1e10 less that at 1e9 N/m", other? - one?, 0.0, STOP, "m/s"),
        Finding::at_most("q⁺ − q − h v⁺ in the stored fall", with_new, rounding(64, 1.0), "m"),
        Finding::count("mentions of a midpoint in the plant's documentation", facts.mentions["midpoint"], 0),
        Finding::decision("dissipation of kSap is Kelvin–Voigt", facts.dissipation_of_sap == "Kelvin–Voigt", true),
        Finding::decision("the default approximation is kLagged", facts.default_approximation == "kLagged", true),
    ])
}

fn default_solver(reading: Reading) -> Result<Vec<Finding>> {
    let facts = facts()?;
    let default = reading.pick(&facts.default_solver, &facts.default_approximation);
    let takes_sap = ["kSap", "kSimilar", "kLagged"].iter().all(|name| facts.solvers[*name] == "kSap");
    Ok(vec![
        Finding::decision("the default is kSap", default == "kSap", true),
        Finding::decision("every approximation but TAMSI takes the solver kSap", takes_sap && facts.solvers["kTamsi"] == "kTamsi", true),
    ])
}

/// How much the derivative of the projection on K_½ changes between two points `apart` of each other around a boundary point, or inside the
/// cone.
fn jump(apart: f64, across: bool) -> f64 {
    let middle = if across { 2.0 } else { 3.0 };
    let at = |offset: f64| projection_jacobian(&[middle + offset, 1.0, 0.0], 0.5);
    (at(0.5 * apart) - at(-0.5 * apart)).norm()
}

fn theorem(reading: Reading) -> Result<Vec<Finding>> {
    let across = reading == Reading::Recorded;
    let (near, nearer) = (jump(1.0 / 1024.0, across), jump(1.0 / 1_048_576.0, across));
    // the slipping side lacks the projector I − ggᵀ in the plane of n and t₁, g = (2, 1)/√5; across it the stretch changes by s c = 2/5 per
    // unit of z_n
    let expected = 1.0;
    Ok(vec![
        Finding::equal("jump of the derivative at a distance of 2⁻²⁰", nearer, expected, 1.0 / 1_048_576.0, "1"),
        Finding::equal("the same at 2⁻¹⁰", near, expected, 1.0 / 1024.0, "1"),
    ])
}

fn paths(reading: Reading) -> Result<Vec<Finding>> {
    let facts = facts()?;
    let offered = facts.solvers.values().any(|solver| solver == "kTamsi") && facts.solvers.values().any(|solver| solver == "kSap");
    let announced = !facts.tamsi_removed_from.is_empty();
    Ok(vec![
        Finding::decision("TAMSI's removal is announced", announced, reading.pick(true, false)),
        Finding::decision("1.51.1 offers both solvers", offered, true),
    ])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_number_printed_in_the_claim_is_the_closed_forms() {
        assert!((predicted_lift(0.004) - 0.00135).abs() <= rounding(8, 0.01));
    }
}
