//! Scenes: files `scene/1` that describe bodies to any simulator, named ones, and the mechanisms they stand for.

mod corner_spheres;
mod exact;
mod linkages;
mod named;
mod planar;
mod scene;
mod spatial;
mod staged;
mod validation;

pub use exact::ExactMotion;
pub use linkages::{LINKAGES, Linkage, linkage};
pub use named::{NAMES, named};
pub use scene::{Body, Capsule, Cuboid, Cylinder, Ground, Material, PairOverride, Prescribed, SCHEMA, Scene, Sphere};
pub use staged::Staged;
