//! Exact solutions of mechanical problems; nothing here imports what it verifies.

pub mod bouncing_ball;
pub mod drake_sap;
pub mod elastic_ball;
pub mod incline_block;
pub mod mujoco_contact;
pub mod two_body_impact;

pub use bouncing_ball::BouncingBall;
pub use elastic_ball::ElasticBall;
pub use incline_block::InclineBlock;
