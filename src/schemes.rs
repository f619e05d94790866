//! Time-stepping schemes: those of the literature and the engines', by name.

pub use moreau_dynamics::schemes::*;
pub use moreau_replicas::bullet::{Bodies, Bullet, Friction};
pub use moreau_replicas::chrono::Chrono;
pub use moreau_replicas::drake::{DrakeLagged, DrakeSap, DrakeSimilar, DrakeTamsi};
pub use moreau_replicas::mujoco::Mujoco;
pub use moreau_replicas::schemes::{NAMES, SchemeParameters, by_name};
pub use moreau_replicas::{bullet, chrono, drake, mujoco};
