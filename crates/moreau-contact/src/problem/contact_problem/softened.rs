//! The problem with other softness and shift, in place: W and what was found of it alone stay.

use super::number::Number;
use super::once::Once;
use super::{Compliance, ContactProblem, Coordinates};
use nalgebra::DVector;

impl ContactProblem {
    /// Replaces R of the contact rows \[1/kg\] and the shift \[m/s\].
    ///
    /// # Panics
    /// If one has not as many entries as the problem has rows, or a compliance acts on edges.
    pub(crate) fn soften(&mut self, softness: DVector<f64>, shift: DVector<f64>) {
        let on_edges = self.compliance.as_ref().is_some_and(|compliance| compliance.coordinates == Coordinates::Edge);
        assert!(!on_edges, "a compliance on edges has no rows of contacts");
        assert!(softness.len() == self.rows() && shift.len() == self.rows(), "one entry per row");
        self.compliance = Some(Compliance { coordinates: Coordinates::Contact, diagonal: softness });
        self.shift = shift.into();
        self.weights = Once::default(); // they have R in them
        self.number = Number::default();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{DMatrix, dvector};

    #[test]
    fn it_is_the_problem_that_is_built_anew() {
        let hard =
            ContactProblem::new(DMatrix::identity(2, 2), dvector![-1.0, 2.0]).rows_per_contact(2).friction(vec![0.5]).build().unwrap();
        let (softness, shift) = (dvector![0.5, 0.25], dvector![-0.5, 0.0]);
        let compliance = Compliance { coordinates: Coordinates::Contact, diagonal: softness.clone() };
        let built = hard.clone().into_builder().compliance(compliance).shift(shift.clone()).build().unwrap();
        let mut softened = hard.clone();
        softened.soften(softness, shift);
        assert_eq!(softened, built);
        assert_ne!(softened, hard);
    }
}
