//! Exact solutions of mechanical problems; nothing here imports what it verifies.

pub mod bouncing_ball;

pub use bouncing_ball::BouncingBall;
