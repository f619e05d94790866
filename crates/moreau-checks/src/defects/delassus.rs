//! Planted defects of the family `delassus`: W = H M⁻¹ Hᵀ with one mistake each.

use crate::delassus::{DelassusRule, Library, check};
use crate::finding::Finding;
use crate::planted::{Beside, Kind, Planted};
use moreau_exact::Result;
use moreau_exact::scalar::{Rational, Scalar, ratio};
use nalgebra::DMatrix;

/// The defects of this family.
pub const DEFECTS: &[Planted<Beside>] = &[
    Planted {
        name: "delassus/mass-instead-of-its-inverse",
        mistake: "W = H M Hᵀ: symmetric, positive semidefinite, and not what an impulse does",
        kind: Kind::Assembly,
        subject: Beside {
            check: "properties/delassus",
            defective: || on_the_coupled_pair(&MassNotInverted),
            reference: || on_the_coupled_pair(&Library),
        },
    },
    Planted {
        name: "delassus/lumped-mass",
        mistake: "W = H diag(M)⁻¹ Hᵀ: the inertial coupling of the velocities is forgotten",
        kind: Kind::Assembly,
        subject: Beside {
            check: "properties/delassus",
            defective: || on_the_coupled_pair(&LumpedMass),
            reference: || on_the_coupled_pair(&Library),
        },
    },
    Planted {
        name: "delassus/sign-dropped-in-transpose",
        mistake: "the reaction of the second contact acts in the wrong sense: row 2 of Hᵀ has the wrong sign",
        kind: Kind::Assembly,
        subject: Beside {
            check: "properties/delassus",
            defective: || on_the_coupled_pair(&SignDropped),
            reference: || on_the_coupled_pair(&Library),
        },
    },
    Planted {
        name: "delassus/asymmetry-averaged-away",
        mistake: "the wrong sign again, hidden by taking ½(W + Wᵀ)",
        kind: Kind::Assembly,
        subject: Beside {
            check: "properties/delassus",
            defective: || on_the_coupled_pair(&Averaged),
            reference: || on_the_coupled_pair(&Library),
        },
    },
    Planted {
        name: "delassus/triangle-not-mirrored",
        mistake: "only the lower triangle is filled in",
        kind: Kind::Assembly,
        subject: Beside {
            check: "properties/delassus",
            defective: || on_the_coupled_pair(&NotMirrored),
            reference: || on_the_coupled_pair(&Library),
        },
    },
];

/// Two coupled velocities and three contact rows, the third the sum of the first two.
fn on_the_coupled_pair(rule: &impl DelassusRule) -> Result<Vec<Finding>> {
    let matrix = |rows, entries: &[i64]| DMatrix::from_row_slice(rows, 2, &entries.iter().map(|&x| ratio(x, 1)).collect::<Vec<Rational>>());
    check(rule, &matrix(2, &[2, 1, 1, 3]), &matrix(3, &[1, 0, 1, 1, 2, 1]))
}

struct MassNotInverted;

impl DelassusRule for MassNotInverted {
    fn delassus<T: Scalar>(&self, mass: &DMatrix<T>, jacobian: &DMatrix<T>) -> Result<DMatrix<T>> {
        Ok(jacobian * mass * jacobian.transpose())
    }
}

struct LumpedMass;

impl DelassusRule for LumpedMass {
    fn delassus<T: Scalar>(&self, mass: &DMatrix<T>, jacobian: &DMatrix<T>) -> Result<DMatrix<T>> {
        Library.delassus(&DMatrix::from_diagonal(&mass.diagonal()), jacobian)
    }
}

struct SignDropped;

impl DelassusRule for SignDropped {
    fn delassus<T: Scalar>(&self, mass: &DMatrix<T>, jacobian: &DMatrix<T>) -> Result<DMatrix<T>> {
        let mut w = Library.delassus(mass, jacobian)?;
        for entry in w.column_mut(1).iter_mut() {
            *entry = -entry.clone();
        }
        Ok(w)
    }
}

struct Averaged;

impl DelassusRule for Averaged {
    fn delassus<T: Scalar>(&self, mass: &DMatrix<T>, jacobian: &DMatrix<T>) -> Result<DMatrix<T>> {
        let w = SignDropped.delassus(mass, jacobian)?;
        Ok((&w + w.transpose()) * T::ratio(1, 2))
    }
}

struct NotMirrored;

impl DelassusRule for NotMirrored {
    fn delassus<T: Scalar>(&self, mass: &DMatrix<T>, jacobian: &DMatrix<T>) -> Result<DMatrix<T>> {
        Ok(Library.delassus(mass, jacobian)?.lower_triangle())
    }
}
