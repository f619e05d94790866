//! Distances and properties of motions, one per file; every distance that mixes units states its reference scales.

mod creep_speed;
mod creeps;
mod effective_restitution;
mod energy_balance;
mod graph_distance;
mod jitter;
mod normalisation;
mod penetration;
mod position_sup;
mod settling_time;
mod total_variation;
mod velocity_l1;
mod velocity_sup;

pub use creep_speed::creep_speed;
pub use creeps::creeps;
pub use effective_restitution::effective_restitutions;
pub use energy_balance::EnergyBalance;
pub use graph_distance::{GraphDistance, graph_distance};
pub use jitter::jitter;
pub use normalisation::Normalisation;
pub use penetration::{largest_gap, penetration};
pub use position_sup::position_sup;
pub use settling_time::settling_time;
pub use total_variation::total_variation;
pub use velocity_l1::velocity_l1;
pub use velocity_sup::velocity_sup;
