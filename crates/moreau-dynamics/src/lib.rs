//! Motions with contact: mechanisms, scenes, time-stepping schemes of the literature and trajectories.
//!
//! Contact dynamics is a measure differential inclusion,
//! ```text
//!     −M(q) dv + F(t, q, v) dt ∈ N_{T_C(q)}(v⁺) dμ ,
//! ```
//! and a scheme that passes the [waist](schemes::Waist) turns a step of it into a [`moreau_contact::ContactProblem`] and the answer into a
//! state:
//! ```text
//! Mechanism ──► Scheme ──► ContactProblem ──► Solver ──► Solution + Certificate ──► Recording
//! ```

pub mod elastic_bar;
pub mod equations;
pub mod event_driven;
pub mod exact_particle;
pub mod impact_laws;
pub mod integrators;
mod least_squares;
pub mod mechanics;
pub mod scenes;
pub mod schemes;
pub mod stabilisation;
pub mod tolerance;
pub mod trajectory;
