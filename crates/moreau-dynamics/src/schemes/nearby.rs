//! A mechanism that shows only the contact candidates nearby.
//!
//! A step may leave out every candidate whose gap exceeds a reach ρ if, after the step,
//! ```text
//!     ρ ≥ h (|u_n| + μ‖u_t‖)     at every candidate there could be, for u at v, v_free and v⁺.
//! ```
//! For then φ/h + u_n⁺ − μ‖u_t⁺‖ > 0 at the candidates left out: with r = 0 they satisfy the laws of Stewart–Trinkle and of Anitescu, so
//! the answer without them is an answer with them. And φ + λ h u_n > 0 for λ ≤ 1 and u at v or v_free: no activation rule of
//! Moreau–Jean would have taken them.

use crate::mechanics::{LinearForce, Mechanism, State, answers_as};
use delegate::delegate;
use moreau_contact::contact::{Contact, Rows};
use moreau_exact::Result;
use nalgebra::{DMatrix, DVector};

/// The mechanism with the candidates within `reach` only.
pub(super) struct Nearby<'a> {
    /// The mechanism itself.
    pub mechanism: &'a dyn Mechanism,
    /// ρ \[m\].
    pub reach: f64,
}

impl Mechanism for Nearby<'_> {
    answers_as!(self, mechanism);

    delegate! {
        to self.mechanism {
            fn mean_force(&self, position: &DVector<f64>, velocity: &DVector<f64>, h: f64) -> DVector<f64>;
            fn check_speed(&self, velocity: &DVector<f64>, h: f64) -> Result<()>;
            fn most_candidates(&self) -> Option<usize>;
            fn contacts_between(&self, position: &DVector<f64>, bodies: (usize, Option<usize>)) -> Vec<Contact>;
            /// Uses the caller's reach and not the reach of this wrapper.
            fn contacts_halfway(&self, position: &DVector<f64>, reach: f64) -> Vec<Contact>;
            fn inverse_mass(&self, contact: &Contact) -> Option<f64>;
            fn contact_rotation(&self, position: &DVector<f64>, contact: &Contact) -> Option<Rows>;
            fn gyroscopic_slope(&self, position: &DVector<f64>, velocity: &DVector<f64>) -> Option<Vec<DMatrix<f64>>>;
            fn reach(&self, velocity: &DVector<f64>, h: f64) -> f64;
            fn linear_force(&self) -> Option<LinearForce>;
            fn integrate(&self, position: &DVector<f64>, velocity: &DVector<f64>, h: f64) -> DVector<f64>;
            fn kinetic_energy(&self, state: &State) -> f64;
        }
    }

    fn contacts(&self, position: &DVector<f64>) -> Vec<Contact> {
        self.mechanism.contacts_within(position, self.reach)
    }

    fn count_within(&self, position: &DVector<f64>, reach: f64) -> usize {
        self.mechanism.count_within(position, reach.min(self.reach))
    }

    fn contacts_within(&self, position: &DVector<f64>, reach: f64) -> Vec<Contact> {
        self.mechanism.contacts_within(position, reach.min(self.reach))
    }
}
