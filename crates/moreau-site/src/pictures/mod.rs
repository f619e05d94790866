//! The pictures, one question each.

use crate::picture::Picture;

mod ball;
mod cones;
mod drift;
pub(crate) mod engines;
mod motions;
mod order;
mod parts;
mod rod;
mod slope;
mod soft;
mod solvers;
mod stability;
mod theta;
mod work;

/// Every picture, in the order of the chapter.
pub const PICTURES: &[&Picture] = &[
    &ball::ZENO,
    &ball::HEIGHTS,
    &ball::MEASURE,
    &order::PICTURE,
    &theta::ENERGY,
    &theta::PORTRAITS,
    &cones::PROJECTION,
    &cones::DE_SAXCE,
    &cones::POLYHEDRAL,
    &cones::DIRECTION,
    &slope::GLIDING,
    &slope::CREEP,
    &engines::CREEP,
    &rod::PAINLEVE,
    &rod::GAIN,
    &rod::LAWS,
    &soft::GRAPHS,
    &soft::IMPEDANCE,
    &soft::BOUNCE,
    &soft::LOAD,
    &stability::REGIONS,
    &stability::BAUMGARTE,
    &solvers::PICTURE,
    &work::PICTURE,
    &drift::PICTURE,
    &motions::CRADLE,
    &motions::ROLLING,
    &motions::BAR,
    &motions::OSCILLATOR,
];

#[cfg(test)]
mod tests;
