//! Drake's rows of the comparison.

use crate::claims::experiments::drake::{MATERIAL, damped_lift, predicted_damped_lift};
use crate::claims::experiments::stored::{Fall, Faller};
use crate::claims::lookups::{self, looked_up};
use crate::claims::prelude::*;
use crate::cones::projection_jacobian;
use crate::mechanics::{PointMass, State};
use crate::schemes::drake::{Material, Touch, tamsi_law};
use crate::schemes::{DrakeSap, SchemeParameters, assembled, by_name, step};
use crate::solvers::{ContactSolver, SemiAnalyticPrimal};
use crate::tolerance::claims::drake as tolerance;
use crate::tolerance::claims::engines::same_answer;
use crate::tolerance::{rounding, solvers::STOP};

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
        evidence: Evidence::Cited,
        correct_statement: r"As stated where contacts slip faster than the stiction tolerance $v_s$. Below it friction is regularised: it
            lies inside the cone although the contact slips, which no complementarity allows. The step is a nonlinear equation that no
            function has as its gradient. Drake 1.51.1 has TAMSI, and announces its removal from 2026-09-01 on.",
        argument: r"A touching contact that slips, $\mu = 3/4$: $\partial r_t/\partial u_n = -\mu\,n'$, $\partial r_n/\partial u_t = 0$,
            so $\partial r/\partial u$ is not symmetric and $r$ is no gradient. $\|r_t\| = \mu\,r_n$ at $8\,v_s$, but $0.75\,\mu\,r_n$ at
            $v_s/2$.",
        controls: &[
            r"A contact that slips at $8\,v_s$ in place of $v_s/2$.",
            r"A contact without friction, one that slips at $v_s/2$ in place of $8\,v_s$, and kLagged asked whether it may fail.",
        ],
        sources: &["chapter §10, table of simulators", PACKAGE],
        check: check!(tamsi),
    },
    Claim {
        id: "S10.drake-sap-row",
        statement: r"Drake SAP: semi-implicit Euler or midpoint of second order, Newton with exact line search on a convex potential,
            compliant Kelvin–Voigt contact with a rigid limit; globally convergent; glides by $O(\delta t)$.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::MissingHypothesis),
        evidence: Evidence::Cited,
        correct_statement: r"Kelvin–Voigt contact and its rigid limit belong to the approximation kSap, which is not the default; the
            default, kLagged, has Hunt–Crossley contact and does not glide. A discrete plant steps by semi-implicit Euler only: the
            midpoint rule is in the paper. The lift of a sliding block is $(\delta t + \tau)\,\mu\,v$, which vanishes with $\delta t$ only
            where $\tau = 0$.",
        argument: r"Stored fall at $h = 1/100$ s: $q^+ - q - h\,v^+ = 0$ to rounding. One step of our SAP on a contact 1 mm deep:
            $r_n = h\,k(-\varphi^+ - \tau\,u_n^+)$. With $k = \text{1e9}$ and 1e10 N/m the step is the same. Sliding at 0.7 instead of 0.2
            m/s: lifted by 0.00135 m for $\tau = 0.005$ s and $h = 0.004$ s, more than twice $h\,\mu\,\Delta v$; by
            $0.0012\,\mathrm{m} = h\,\mu\,\Delta v$ for $\tau = 0$ at twice that step.",
        controls: &[
            "kLagged's lift in place of kSap's: none.",
            "kLagged's contact, one that is not stiff, a fall that moves with the old velocity, another word, another law.",
        ],
        sources: &["chapter §10, table of simulators", PACKAGE, SAP_PAPER],
        check: check!(sap),
    },
    Claim {
        id: "S10.drake-default-sap",
        statement: "SAP, the convex primal, is Drake's current default.",
        verdict: ClaimVerdict::True,
        kind: Kind::Path,
        severity: None,
        evidence: Evidence::Cited,
        correct_statement: "As a solver. The default contact model that it solves is not kSap but kLagged.",
        argument: "A plant of 1.51.1 answers kSap when asked for its solver and kLagged when asked for its approximation; kSap, kSimilar \
            and kLagged all take the solver kSap.",
        controls: &["The default approximation in place of the default solver, and TAMSI among the approximations."],
        sources: &["chapter §10, table of choices", PACKAGE],
        check: looked_up!("S10.drake-default-sap"),
    },
    Claim {
        id: "S10.sap-theorem",
        statement: "SAP's potential is strictly convex with a Lipschitz Hessian, hence Newton's method converges globally, linearly and \
            then quadratically.",
        verdict: ClaimVerdict::Conditional,
        kind: Kind::Assertion,
        severity: Some(Severity::WrongReason),
        evidence: Evidence::Certified,
        correct_statement: "It converges globally because the objective is strongly convex with a Lipschitz gradient, and quadratically \
            once it is in the region of one mode per contact. The Hessian itself is Lipschitz there only: it jumps where a contact opens \
            or begins to slip.",
        argument: r"$\mu = 1/2$: while a contact slips, the derivative of the projection changes by 2/5 per unit of the normal impulse.
            Across the boundary between stick and slip it jumps by 1 in norm, however close the two points are: the projector $I - gg^T$
            drops out. Newton's method from impulses of $\pm10^3$ and $\pm10^6$ N·s ends at the same velocity as from none.",
        controls: &[
            "Two points that both slip.",
            "Points across the boundary in the place of two that slip; no iteration from the impulses far off.",
        ],
        sources: &["chapter, table of theorems", SAP_PAPER],
        check: check!(theorem),
    },
    Claim {
        id: "S10.path-drake",
        statement: "Drake's two contact solvers are in multibody/plant/tamsi_solver.cc and multibody/contact_solvers/sap/sap_solver.cc: \
            as of 2026, on the main branch; files may move a little from version to version.",
        verdict: ClaimVerdict::True,
        kind: Kind::Path,
        severity: None,
        evidence: Evidence::Cited,
        correct_statement: "As stated up to the removal of TAMSI, announced for 2026-09-01 and later, of which the printed caveat warns. \
            The Python package holds neither file; it offers both solvers.",
        argument: "The tree of the repository at be259df7 of August 2026 has both files. 1.51.1 offers the solvers kSap and kTamsi, and \
            documents the second as deprecated, to be removed from September 2026 on; one solver is left then.",
        controls: &["A day after the announced removal.", "The two folders exchanged."],
        sources: &["chapter §10, source files", PACKAGE, "Drake's repository at be259df7; pull request 24831 for the removal"],
        check: looked_up!("S10.path-drake"),
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

/// ‖r_t‖/(μ r_n) of TAMSI's contact that slips at this multiple of v_s: 1 on the cone.
fn share_of_cone(slip: f64) -> f64 {
    let (impulse, _) = tamsi_law(&TOUCH, &[0.25, slip * TOUCH.material.stiction_tolerance, 0.0]);
    impulse[1].abs() / (TOUCH.friction * impulse[0])
}

fn tamsi(reading: Reading) -> Result<Vec<Finding>> {
    let velocity = [0.25, 4.0, 0.0];
    let (_, derivative) = tamsi_law(&Touch { friction: reading.only(1).pick(TOUCH.friction, 0.0), ..TOUCH }, &velocity);
    let (_, slope) = TOUCH.normal(velocity[0]);
    let soft = 4.0 / 4f64.hypot(0.005);
    let asymmetry = derivative[(1, 0)] - derivative[(0, 1)];
    let (fast, slow) = (reading.only(1).pick(8.0, 0.5), reading.only(0).pick(0.5, 8.0));
    let mut findings = vec![
        Finding::equal("∂r_t/∂u_n − ∂r_n/∂u_t", asymmetry, -TOUCH.friction * slope * soft, rounding(16, slope.abs()), "kg"),
        Finding::equal("‖r_t‖/(μ r_n) at the slip 8 v_s", share_of_cone(fast), 1.0, tolerance::regularised(8.0), "1"),
        Finding::equal("‖r_t‖/(μ r_n) at a slower slip", share_of_cone(slow), 0.75, tolerance::regularised(slow), "1")
            .says(1.0)
            .violating("slip faster than the stiction tolerance"),
    ];
    findings.extend(lookups::check("S10.drake-tamsi-row", reading)?);
    Ok(findings)
}

/// φ⁺, u_n⁺ and r_n after one step of a ball of 1 kg that starts 1 mm deep, under this approximation.
fn one_step(approximation: &str, stiffness: f64, h: f64) -> Result<[f64; 3]> {
    let drake = Material { stiffness, ..MATERIAL };
    let scheme = by_name(approximation, SchemeParameters { drake, ..SchemeParameters::default() })?;
    let ball = PointMass::ball_on_floor(1.0, 9.81, 0.0);
    let start = State { time: 0.0, position: dvector![-0.001], velocity: dvector![-0.5] };
    let taken = step(scheme.as_ref(), &SemiAnalyticPrimal, &ball, &start, h)?;
    let impulse = taken.impulses.first().ok_or_else(|| Error::Unsupported("the ball touches".into()))?;
    Ok([taken.state.position[0], taken.state.velocity[0], impulse.impulse[0]])
}

fn sap(reading: Reading) -> Result<Vec<Finding>> {
    let (h, other) = (0.004, reading.only(1));
    let [gap, opening, impulse] = one_step(other.pick("drake-sap", "drake-lagged"), MATERIAL.stiffness, h)?;
    let spring = h * MATERIAL.stiffness * (-gap - MATERIAL.relaxation_time * opening);
    let [softer, stiffer] =
        other.pick([1e9, 1e10], [1e3, 1e4]).map(|stiffness| one_step("drake-sap", stiffness, h).map(|[_, velocity, _]| velocity));
    let [with_new, _] = other.pick(Fall::stored(Faller::Drake)?, Fall::explicit()).residuals();
    let approximation = reading.only(0).pick("drake-sap", "drake-lagged");
    let (damping, no_damping) = (MATERIAL.relaxation_time, 0.0);
    let settled = tolerance::settled(9.81 / MATERIAL.stiffness, 1000);
    let lifted = |name: &str, relaxation_time: f64, h: f64| -> Result<Finding> {
        let expected = predicted_damped_lift(relaxation_time, h);
        Ok(Finding::equal(name, damped_lift(approximation, relaxation_time, h)?, expected, settled, "m"))
    };
    let mut findings = vec![
        lifted("lift of a slide, h = 8 ms, τ = 0, μ Δv = 0.15 m/s", no_damping, 2.0 * h)?,
        lifted("lift of a slide, h = 4 ms, τ = 5 ms", damping, h)?
            .says(predicted_damped_lift(no_damping, h))
            .violating("a contact without τ"),
        Finding::equal("r_n − h k(−φ⁺ − τ u_n⁺)", impulse - spring, 0.0, tolerance::spring_balance(), "N·s"),
        Finding::equal("v⁺ at k = 1e10 less that at 1e9 N/m", stiffer? - softer?, 0.0, STOP, "m/s"),
        Finding::at_most("q⁺ − q − h v⁺ in the stored fall", with_new, rounding(64, 1.0), "m").experiment(),
    ];
    findings.extend(lookups::check("S10.drake-sap-row", reading)?);
    Ok(findings)
}

/// How much the derivative of the projection on K_½ changes between two points `apart` of each other in z_n, around z = (`middle`, 1, 0).
/// For `middle` = 2 one of them sticks and the other slips, for 1 both slip.
fn change(middle: f64, apart: f64) -> f64 {
    let at = |offset: f64| projection_jacobian(&[middle + offset, 1.0, 0.0], 0.5);
    (at(0.5 * apart) - at(-0.5 * apart)).norm()
}

/// The largest difference \[m/s\] of a step's velocity that Newton's method finds from impulses far off and from none; or, without
/// iteration, of the velocity to which those impulses lead.
fn from_afar(iterates: bool) -> Result<f64> {
    let slope = PointMass::block_on_incline(1.0, 9.81, 0.35, 0.2, 0.0);
    let start = State { time: 0.0, position: dvector![0.0, -0.001], velocity: dvector![1.0, 0.0] };
    let problem = assembled(&DrakeSap { material: MATERIAL }, &slope, &start, 0.004)?.problem;
    let problem = problem.ok_or_else(|| Error::Unsupported("the block touches".into()))?;
    let near = SemiAnalyticPrimal.solve(&problem, None)?.velocity;
    let mut largest = 0.0f64;
    for size in [1e3, -1e3, 1e6, -1e6] {
        let far = dvector![size, size];
        let unmoved = problem.dense() * &far + problem.free_velocity();
        let velocity = if iterates { SemiAnalyticPrimal.solve(&problem, Some(&far))?.velocity } else { unmoved };
        largest = largest.max((velocity - &near).amax());
    }
    Ok(largest)
}

fn theorem(reading: Reading) -> Result<Vec<Finding>> {
    let (boundary, slipping) = (reading.only(0).pick(2.0, 1.0), reading.only(1).pick(1.0, 2.0));
    let afar = from_afar(reading.only(1).pick(true, false))?;
    let mut findings = vec![Finding::at_most("velocity from impulses far off against that from none", afar, same_answer(1.0), "m/s")];
    for (name, apart) in [("2⁻¹⁰", 1.0 / 1024.0), ("2⁻²⁰", 1.0 / 1_048_576.0)] {
        let lipschitz = 0.4 * apart;
        findings.extend([
            Finding::equal(
                format!("change of the derivative over {name} of slip"),
                change(slipping, apart),
                lipschitz,
                rounding(16, 1.0),
                "1",
            ),
            // the slipping side lacks the projector I − ggᵀ in the plane of n and t₁, g = (2, 1)/√5
            Finding::equal(
                format!("change over {name} from stick to slip"),
                change(boundary, apart),
                1.0,
                tolerance::mode_change(apart),
                "1",
            )
            .says_at_most(lipschitz)
            .violating("one mode per contact"),
        ]);
    }
    Ok(findings)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_number_printed_in_the_claim_is_the_closed_forms() {
        assert!((predicted_damped_lift(MATERIAL.relaxation_time, 0.004) - 0.00135).abs() <= rounding(8, 0.01));
    }
}
