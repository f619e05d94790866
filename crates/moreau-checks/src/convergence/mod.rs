//! Family 6: convergence as h → 0, in four metrics, through impacts, Zeno sequences, sticking and sliding.
//!
//! ```text
//!     sup|q| O(h) ,   ‖v‖_{L¹} O(h) ,   sup|v| O(1) ,   graph distance O(h), through Zeno O(h ln 1/h), O(√h) if a plastic
//!     ball is stopped above the floor.
//! ```
//! The expected constants, and with them the intervals for the slopes, are derived in [`crate::tolerance::convergence`].

mod ball;
mod errors;
mod plastic;
mod slide;

pub use ball::{Horizon, bouncing_ball};
pub use errors::{BallErrors, Study, ball_errors, study};
pub use plastic::{Stop, plastic_ball};
pub use slide::{Incline, anitescu_hop, anitescu_slide, coulomb_slide, sticking};
