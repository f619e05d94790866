//! Time-stepping schemes: those of the literature and the engines', by name.

pub use moreau_dynamics::schemes::*;

pub mod bullet;
pub mod chrono;
pub mod drake;
pub mod mujoco;
mod names;

pub use bullet::{Bodies, Bullet, Friction};
pub use chrono::Chrono;
pub use drake::{DrakeLagged, DrakeSap, DrakeSimilar, DrakeTamsi};
pub use mujoco::Mujoco;
pub use names::{NAMES, Parameters, by_name};
