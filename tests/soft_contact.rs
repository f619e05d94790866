//! A soft contact of the solvers against its closed form: neither crate knows the other.

use moreau::closed_forms::soft_planar_contact::SoftPlanarContact;
use moreau::solvers::gauss::SoftPiece;
use moreau::tolerance::rounding;

#[test]
fn the_impulse_of_a_planar_contact_is_that_of_its_closed_form_without_mass() {
    // a planar cone with R = (2, 3) and μ = ½
    let planar = SoftPiece::Cone { normal: 2.0, tangential: 0.75, friction: vec![0.5] };
    let contact = SoftPlanarContact { softness: [2.0, 3.0], friction: 0.5 };
    for load in [[-4.0, 1.0], [-4.0, 9.0], [-1.0, -7.0], [1.0, 5.0], [3.0, 2.0], [0.0, 0.0]] {
        let found = planar.impulse(&load);
        let exact = contact.force(&load);
        assert!(found.iter().zip(exact).all(|(found, exact)| (found - exact).abs() <= rounding(8, 10.0)), "{load:?}: {found:?} {exact:?}");
    }
}
