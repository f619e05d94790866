//! A step as it was made, what a balance says of it, and the names of its findings.

use moreau_checks::Finding;
use moreau_dynamics::mechanics::{Mechanism, State};
use moreau_dynamics::schemes::Step;

/// Name of the finding T(v⁺) − T(v_free) = r·u⁺ − ½ rᵀW r.
pub const IDENTITY: &str = "kinetic energy from the reported impulses";

/// Name of the finding on w, which fails in a step that is no solution.
pub const RESIDUAL: &str = "work of the residual";

/// Name of the finding T(v⁺) − T(v_free) ≤ −r·(shift + R r) − ½ rᵀW r + w.
pub const KINETIC: &str = "kinetic energy over that of the free motion";

/// Name of the finding ΔẼ = ½ r·(u⁺ + u_g) + ….
pub const TOTAL_IDENTITY: &str = "total energy from the reported impulses";

/// Name of the finding on the rise of Ẽ.
pub const TOTAL: &str = "total energy over that of the step before";

/// Name of the finding on T(v_g) − T(v).
pub const GYROSCOPIC_ENERGY: &str = "kinetic energy from the gyroscopic term";

/// Name of the finding on ‖v_g − v‖²_M.
pub const GYROSCOPIC: &str = "square of the gyroscopic change of velocity";

/// One step as it was made.
#[derive(Clone, Copy)]
pub struct Taken<'a> {
    /// What moves.
    pub mechanism: &'a dyn Mechanism,
    /// The state before the step.
    pub before: &'a State,
    /// What the scheme made of it.
    pub step: &'a Step,
    /// h \[s\].
    pub h: f64,
}

/// What a balance says of one step.
#[derive(Clone, Debug)]
pub struct Judged {
    /// The equalities and bounds; none where there is no theorem.
    pub findings: Vec<Finding>,
    /// w \[J\].
    pub residual: f64,
    /// By how much T may exceed ½(‖v‖_M + h‖F‖_{M⁻¹})² after the step \[J\]; `None` without a theorem.
    pub gain: Option<f64>,
    /// By how much Ẽ may rise in the step \[J\]; `None` without a theorem.
    pub rise: Option<f64>,
}
