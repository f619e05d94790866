//! Small experiments that several claims share: a tower under truncated sweeps, a bead on a curve, energy by projection, a frictional
//! impact, a wall hit between two steps.

pub(super) mod cantor;
pub(super) mod corner;
pub(super) mod creep;
pub(super) mod curve;
pub(super) mod drake;
pub(super) mod envelopes;
pub(super) mod facts;
pub(super) mod floors;
pub(super) mod identifiers;
pub(super) mod motion_step;
pub(super) mod mujoco;
pub(super) mod painleve;
pub(super) mod pendulum;
pub(super) mod phase_maps;
pub(super) mod planar_step;
pub(super) mod polygon;
pub(super) mod push_out;
pub(super) mod rod;
pub(super) mod runge_kutta;
pub(super) mod siconos;
pub(super) mod soft;
pub(super) mod soft_stack;
pub(super) mod spring;
pub(super) mod spring_damper;
pub(super) mod stored;
pub(super) mod theta_energy;
pub(super) mod theta_step;
pub(super) mod touch;
pub(super) mod tower;
pub(super) mod wall;
