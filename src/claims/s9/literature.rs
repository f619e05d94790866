//! What §9 says of Siconos's projection and of the schemes of higher order it announces.

use crate::claims::experiments::siconos::{Projection, projected_energy, projected_moves, unprojected_energy};
use crate::claims::lookups;
use crate::claims::prelude::*;
use crate::tolerance::claims::pathology::elastic_drop;
use crate::tolerance::rounding;

pub const CLAIMS: &[Claim] = &[
    Claim {
        id: "S9.siconos-class",
        statement: "Siconos's CombinedProjectedMoreauJeanOSI is a coordinate projection of this kind: it injects no artificial energy and \
            is geometrically clean.",
        verdict: ClaimVerdict::False,
        kind: Kind::Path,
        severity: Some(Severity::Misprint),
        evidence: Evidence::Cited,
        correct_statement: r"The class is MoreauJeanCombinedProjectionOSI. It injects no energy but takes it: the step of an impact ends
            on $\varphi = 0$ from whatever height $q$ it started, and an elastic ball loses $m\,g\,q$ each time. And it moves bodies along
            $H_n^T$, not along $M^{-1}H_n^T$: the nearest place in the coordinates, not in the kinetic metric.",
        argument: r"Siconos 4.4.0 has no class of the printed name. Elastic ball from 1 m, $\theta = 1/2$: after 500 steps
            $E/E_0 = 0.8778$, less by exactly $\sum\,m\,g\,q$ over the steps that were projected. Masses 1, 2, 4 kg in a row: the moves by
            the projection add up to zero; times the masses they are −1/300 kg·m, so that the centre of mass moves.",
        controls: &[
            "The name of the class that is there.",
            r"The run of the ball without projection, and the balls moved along $M^{-1}H_n^T$, computed from the same step, which leaves
                their centre of mass.",
        ],
        sources: &[
            "chapter §9, constraint drift, (3)",
            "stored steps of Siconos 4.4.0, see tests/references; S9.projection-energy for clipping at φ ≤ 0",
        ],
        check: check!(combined_projection),
    },
    Claim {
        id: "S9.refs",
        statement: "Chen, Acary, Brüls 2013 (IJNME 96:487): nonsmooth generalised-α with adjustable numerical damping, compatible with \
            HHT; Acary 2013 (CMAME 256:224): projected event-capturing Runge–Kutta with adaptive steps; Brüls, Acary, Cardona 2014: \
            Lie-group generalised-α.",
        verdict: ClaimVerdict::Ambiguous,
        kind: Kind::Citation,
        severity: None,
        evidence: Evidence::NotDecidable,
        correct_statement: "The three papers exist; two are described as others are titled. CMAME 256:224–250 is on projected \
            event-capturing schemes with contact and friction; the higher-order event-capturing schemes are Acary, Appl. Numer. Math. 62 \
            (2012) 1259. Brüls, Acary and Cardona, CMAME 281 (2014) 131, is on enforcing constraints at position and velocity level at \
            once. The papers were not read. The damping claimed for generalised-α is true.",
        argument: r"Volume, pages and title of Acary 2013 stand in Siconos's headers. Generalised-α with
            $\alpha_m = (2\rho - 1)/(\rho + 1)$, $\alpha_f = \rho/(\rho + 1)$ has for an infinitely stiff spring the characteristic
            polynomial $(x + \rho)^3$, exactly, for $\rho = 0$, 1/4, 1/2, 3/4; HHT is the same rule with $\alpha_m = 0$.",
        controls: &[
            r"The trapezoidal rule, whose polynomial is that of $\rho = 1$.",
            "Volume 265, schemes that are event-driven, and a word of \
            the title in place of Runge's name.",
        ],
        sources: &[
            "chapter §9, higher order",
            "Siconos 4.4.0, MoreauJeanCombinedProjectionOSI.hpp; Chung and Hulbert, J. Appl. Mech. 60 (1993) 371",
        ],
        check: check!(literature),
    },
];

fn combined_projection(reading: Reading) -> Result<Vec<Finding>> {
    let [kept, taken] = reading.only(1).pick(projected_energy()?, unprojected_energy()?);
    let [moved, mass_moved] = projected_moves(reading.only(1).pick(Projection::Stored, Projection::InKineticMetric))?;
    let mut findings = lookups::check("S9.siconos-class", reading)?;
    findings.extend([
        Finding::equal("E(5 s)/E(0) of Siconos's elastic ball", kept, 1.0 - taken, elastic_drop(500), "1").says_at_most(1.0).experiment(),
        // onto φ = 0, the nearest place in the coordinates: (2/3, −1/3, −1/3) of the gap
        Finding::equal("sum of the balls' moves", moved, 0.0, rounding(64, 1.0), "m").experiment(),
        Finding::equal("the same, each times its mass", mass_moved, -1.0 / 300.0, rounding(64, 1.0), "kg·m").context(),
    ]);
    Ok(findings)
}

/// The step of generalised-α in (d, v, a) with h = 1 for ä = −Ω d, in the limit Ω → ∞; δ = α_f, μ = α_m.
///
/// (1−δ) d⁺ + δ d = 0 there, and d⁺ = d + v + (½ − β) a + β a⁺, v⁺ = v + (1 − γ) a + γ a⁺.
fn stiff_step(mean_acceleration: &Rational, mean_force: &Rational) -> DMatrix<Rational> {
    let (one, half) = (ratio(1, 1), ratio(1, 2));
    let gamma = &half + mean_force - mean_acceleration;
    let sum = &one + mean_force - mean_acceleration;
    let beta = ratio(1, 4) * &sum * &sum;
    let next = -(mean_force / (&one - mean_force));
    let acceleration = [(&next - &one) / &beta, -(&one / &beta), -((&half - &beta) / &beta)];
    let velocity: Vec<Rational> = acceleration.iter().map(|entry| &gamma * entry).collect();
    let zero = ratio(0, 1);
    let rows = [
        vec![next, zero.clone(), zero],
        vec![velocity[0].clone(), &one + &velocity[1], &one - &gamma + &velocity[2]],
        acceleration.to_vec(),
    ];
    DMatrix::from_row_slice(3, 3, &rows.concat())
}

/// The coefficients (c₀, c₁, c₂) of x³ + c₂x² + c₁x + c₀ of a 3×3 matrix: −det, the sum of the principal minors, −trace.
fn characteristic(matrix: &DMatrix<Rational>) -> [Rational; 3] {
    let minor = |[i, j]: [usize; 2], [k, l]: [usize; 2]| &matrix[(i, k)] * &matrix[(j, l)] - &matrix[(i, l)] * &matrix[(j, k)];
    let principal = minor([0, 1], [0, 1]) + minor([0, 2], [0, 2]) + minor([1, 2], [1, 2]);
    let determinant =
        &matrix[(0, 0)] * minor([1, 2], [1, 2]) - &matrix[(0, 1)] * minor([1, 2], [0, 2]) + &matrix[(0, 2)] * minor([1, 2], [0, 1]);
    [-determinant, principal, -(&matrix[(0, 0)] + &matrix[(1, 1)] + &matrix[(2, 2)])]
}

fn literature(reading: Reading) -> Result<Vec<Finding>> {
    let mut findings = Vec::new();
    for radius in [ratio(0, 1), ratio(1, 4), ratio(1, 2), ratio(3, 4)] {
        let (above, two) = (&radius + ratio(1, 1), ratio(2, 1));
        let (force, acceleration) = (&radius / &above, (&two * &radius - ratio(1, 1)) / &above);
        let [force, acceleration] = reading.only(0).pick([force, acceleration], [ratio(1, 2), ratio(1, 2)]);
        let step = stiff_step(&acceleration, &force);
        let wanted = [radius.clone() * &radius * &radius, ratio(3, 1) * &radius * &radius, ratio(3, 1) * &radius];
        findings.push(Finding::decision(format!("x³ + … = (x + ρ)³ at ρ = {radius}"), characteristic(&step) == wanted, true));
    }
    findings.extend(lookups::check("S9.refs", reading)?);
    Ok(findings)
}
