//! A bead on the unit circle, without friction: inside it without gravity, or outside it, sliding down from the top; unit speed at the
//! start.
//!
//! ```text
//!     Moreau–Jean, θ = 1, inside:   v⁺ = P_q v ,  q⁺ = q + h v⁺ :   |q × v⁺| = 1 is conserved, so |v_k⁺| = 1/|q_k| and
//!         |q_{k+1}|² = |q_k|² + h²/|q_k|²   ⇒   1 + 2 n h² ≤ |q_n|⁴ ≤ 1 + 2 n h² + n h⁴ .
//!     Stewart–Trinkle, inside:   |q| + h q̂·v⁺ ≤ 1   ⇒   |q⁺| ≤ √(1 + h²|v|²) whatever happened before.
//! ```

use crate::contact::Contact;
use crate::mechanics::{BeadInCircle, BodyState, Mechanism, State};
use crate::schemes::{Scheme, simulate};
use crate::solvers::LemkePivoting;
use crate::{Result, tolerance};
use nalgebra::{DMatrix, DVector, dvector};

/// On which side of the circle the bead is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// φ = 1 − |q|, concave.
    Inside,
    /// φ = |q| − 1, convex.
    Outside,
}

/// The bead and its obstacle.
struct Bead {
    circle: BeadInCircle,
    side: Side,
}

/// Final and deepest penetration of a run \[m\]; negative while there is a gap.
#[derive(Clone, Copy, Debug)]
pub struct Penetration {
    /// At the end.
    pub last: f64,
    /// The largest after the start.
    pub deepest: f64,
}

/// `steps` steps of size h along the circle.
pub fn slide(scheme: &dyn Scheme, side: Side, h: f64, steps: usize) -> Result<Penetration> {
    let (gravity, position, velocity) = match side {
        Side::Inside => (0.0, dvector![1.0, 0.0], dvector![0.0, 1.0]),
        Side::Outside => (10.0, dvector![0.0, 1.0], dvector![1.0, 0.0]),
    };
    let bead = Bead { circle: BeadInCircle::new(1.0, 1.0, gravity, 0.0, 0.0)?, side };
    let start = State { time: 0.0, position, velocity };
    let recording = simulate(scheme, &LemkePivoting, &bead, start, h, steps)?;
    let depth = |state: &State| -bead.contacts(&state.position)[0].gap;
    let deepest = recording.samples.iter().skip(1).map(depth).fold(f64::NEG_INFINITY, f64::max);
    Ok(Penetration { last: depth(recording.last()), deepest })
}

/// Centre and half width of the enclosure of the drift of Moreau–Jean after n steps inside \[m\].
pub fn drift(h: f64, steps: usize) -> [f64; 2] {
    let n = steps as f64;
    let [low, high] = [0.0, n * h.powi(4)].map(|excess| (1.0 + 2.0 * n * h * h + excess).powf(0.25) - 1.0);
    [0.5 * (low + high), 0.5 * (high - low) + tolerance::claims::pathology::bead_rounding(steps)]
}

impl Mechanism for Bead {
    fn name(&self) -> &str {
        "bead at a circle"
    }
    fn degrees_of_freedom(&self) -> usize {
        2
    }
    fn rows_per_contact(&self) -> usize {
        2
    }
    fn mass_matrix(&self, position: &DVector<f64>) -> DMatrix<f64> {
        self.circle.mass_matrix(position)
    }
    fn force(&self, position: &DVector<f64>, velocity: &DVector<f64>) -> DVector<f64> {
        self.circle.force(position, velocity)
    }
    fn contacts(&self, position: &DVector<f64>) -> Vec<Contact> {
        let turn = |mut contact: Contact| {
            if self.side == Side::Outside {
                contact.gap = -contact.gap;
                contact.jacobian = (-contact.jacobian.to_dense()).into();
            }
            contact
        };
        self.circle.contacts(position).into_iter().map(turn).collect()
    }
    fn potential_energy(&self, position: &DVector<f64>) -> f64 {
        self.circle.potential_energy(position)
    }
    fn bodies(&self, position: &DVector<f64>, velocity: &DVector<f64>) -> Vec<BodyState> {
        self.circle.bodies(position, velocity)
    }
}
