//! Tolerances of motions, each with the reason it has the value it has: a rounding bound, a proven bound of a scheme, or a limit of sizes.

pub mod event_driven;
pub mod impact_laws;
pub mod integrators;
pub mod limits;
pub mod mechanics;
pub mod neighbours;
pub mod scenes;
pub mod schemes;
pub mod stabilisation;
pub mod trajectory;
