//! Exact solutions of mechanical problems; nothing here imports what it verifies.

pub mod bouncing_ball;
pub mod double_pendulum_impact;
pub mod drake_normal;
pub mod drake_sap;
pub mod elastic_ball;
pub mod free_top;
pub mod huber;
pub mod incline_block;
pub mod mujoco_contact;
pub mod mujoco_creep;
pub mod mujoco_normal;
pub mod newtons_cradle;
pub mod painleve_impact;
pub mod regularised_friction;
pub mod rocking_block;
pub mod rough_impact;
pub mod sliding_contact;
pub mod soft_impedance;
pub mod soft_planar_contact;
pub mod soft_reference;
pub mod soft_rigid_contact;
pub mod soft_row;
pub mod spring_damper;
pub mod two_body_impact;

pub use bouncing_ball::BouncingBall;
pub use elastic_ball::ElasticBall;
pub use incline_block::InclineBlock;
pub use painleve_impact::SlidingEdge;
pub use rocking_block::RockingBlock;
