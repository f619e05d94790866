//! Engines rebuilt from their equations, one folder per engine: scheme, parameters, the engine's own iteration and the replay of its stored
//! runs.
//!
//! [`schemes`] lists every scheme by name, those of the literature and the engines'; [`energy_balance`] states what each of them may gain
//! in a step. [`systems`] holds the simulators of the chapter against closed forms, exact rationals and [`stored`] runs of the engines.

pub mod altered;
pub mod bullet;
pub mod chrono;
pub mod drake;
pub mod energy_balance;
pub mod equations;
pub mod mujoco;
pub mod schemes;
pub mod siconos;
pub mod solvers;
pub mod staging;
pub mod stored;
pub mod systems;
pub mod tolerance;
