//! Checks of closed forms, which derive in another way what the form says, and forms with one mistake each.
//!
//! A form is a function here, so that the check runs on the right one and on the wrong ones.

pub mod bodies;
pub mod impacts;
pub mod motions;
mod parts;
pub mod soft;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::planted::passes;

    #[test]
    fn every_form_passes_its_check_and_every_wrong_one_does_not() {
        passes(&impacts::TWO_BODIES);
        passes(&impacts::CRADLE);
        passes(&impacts::ROUGH);
        passes(&motions::BALL);
        passes(&motions::SLOPE);
        passes(&motions::ROLLING);
        passes(&motions::TURNING_POINTS);
        passes(&motions::DECAY);
        passes(&bodies::LANDING);
        passes(&bodies::TOP);
        passes(&bodies::BAR);
        passes(&bodies::EDGE);
        passes(&soft::IMPEDANCE);
        passes(&soft::REFERENCE);
        passes(&soft::HUBER);
        passes(&soft::HUNT_CROSSLEY);
    }
}
