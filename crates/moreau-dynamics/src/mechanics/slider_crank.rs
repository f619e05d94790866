//! A slider-crank whose slider has clearance in its guide: crank, rod and a slider that may turn and hit either side.
//!
//! ```text
//!     q = (θ₁, θ₂, θ₃) of crank, rod and slider;  the slider's centre is the end of the rod, p = l₁ e(θ₁) + l₂ e(θ₂)
//!     corners p ± a e(θ₃) ± b e′(θ₃) ;   guide |z| ≤ b + c ;   φ = b + c ∓ z_corner,  four contacts with friction
//! ```
//! M(q) and F(q, v) are those of [`super::hinged_links`] with three links, the third hinged at its centre of mass.

use super::hinged_links::{HingedLinks, Link};
use super::point_mass::positive;
use super::{BodyState, Mechanism, Plane};
use moreau_contact::contact::Contact;
use moreau_exact::Result;
use nalgebra::{DMatrix, DVector, dvector};

/// Dimensions and masses of a slider-crank; crank and rod have their centres of mass in the middle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SliderCrankData {
    /// l of crank and rod \[m\].
    pub lengths: [f64; 2],
    /// m of crank, rod and slider \[kg\].
    pub masses: [f64; 3],
    /// I of crank, rod and slider about their centres \[kg·m²\].
    pub inertias: [f64; 3],
    /// a and b, half length and half height of the slider \[m\].
    pub half_extents: [f64; 2],
    /// c on either side \[m\].
    pub clearance: f64,
    /// μ at the guide.
    pub friction: f64,
    /// e at the guide.
    pub restitution: f64,
    /// g along −z \[m/s²\].
    pub gravity: f64,
}

/// The mechanism with these data.
///
/// # Source
/// Flores, Leine and Glocker, *Modeling and analysis of planar rigid multibody systems with translational clearance joints based on the
/// non-smooth dynamics approach* (2010), for the mechanism.
#[derive(Clone, Debug)]
pub struct SliderCrank {
    links: HingedLinks,
    half_extents: [f64; 2],
    /// Upper and lower side of the guide.
    guide: [Plane; 2],
}

/// The corners, (along, across) in half extents, with the side of the guide each may hit.
const CORNERS: [([f64; 2], usize); 4] = [([1.0, 1.0], 0), ([-1.0, 1.0], 0), ([1.0, -1.0], 1), ([-1.0, -1.0], 1)];

impl SliderCrank {
    /// The mechanism with the hinge of the crank at the origin.
    ///
    /// # Errors
    /// [`moreau_exact::Error::Invalid`] if a length, mass, inertia, extent or the clearance is not positive, μ < 0 or e ∉ \[0, 1\].
    pub fn new(data: SliderCrankData) -> Result<Self> {
        let [a, b] = data.half_extents;
        for (field, value) in
            [("lengths[1]", data.lengths[1]), ("half_extents[0]", a), ("half_extents[1]", b), ("clearance", data.clearance)]
        {
            positive(field, value)?;
        }
        let link = |k: usize, length: f64| Link { length, centre: 0.5 * length, mass: data.masses[k], inertia: data.inertias[k] };
        let links = HingedLinks::new(vec![link(0, data.lengths[0]), link(1, data.lengths[1]), link(2, 0.0)], data.gravity)?;
        let side = |normal: f64| Plane::new(dvector![0.0, normal], -b - data.clearance, data.friction, data.restitution);
        Ok(SliderCrank { links, half_extents: data.half_extents, guide: [side(-1.0)?, side(1.0)?] })
    }

    fn corner(&self, [along, across]: [f64; 2]) -> [f64; 2] {
        [along * self.half_extents[0], across * self.half_extents[1]]
    }
}

impl Mechanism for SliderCrank {
    fn name(&self) -> &str {
        "slider-crank"
    }

    fn degrees_of_freedom(&self) -> usize {
        3
    }

    fn rows_per_contact(&self) -> usize {
        2
    }

    fn mass_matrix(&self, position: &DVector<f64>) -> DMatrix<f64> {
        self.links.mass_matrix(position)
    }

    fn force(&self, position: &DVector<f64>, velocity: &DVector<f64>) -> DVector<f64> {
        self.links.force(position, velocity)
    }

    fn contacts(&self, position: &DVector<f64>) -> Vec<Contact> {
        let corner = |(place, side): &([f64; 2], usize)| self.links.contact(position, 2, self.corner(*place), &self.guide[*side]);
        CORNERS.iter().map(corner).collect()
    }

    fn potential_energy(&self, position: &DVector<f64>) -> f64 {
        self.links.potential_energy(position)
    }

    fn bodies(&self, position: &DVector<f64>, velocity: &DVector<f64>) -> Vec<BodyState> {
        self.links.bodies(position, velocity, |k| ["crank", "rod", "slider"][k].into())
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::{assert_consistent, assert_lagrangian, assert_tangents};
    use super::*;

    fn data() -> SliderCrankData {
        SliderCrankData {
            lengths: [0.2, 0.5],
            masses: [0.3, 0.4, 0.7],
            inertias: [0.002, 0.01, 0.004],
            half_extents: [0.05, 0.025],
            clearance: 0.001,
            friction: 0.1,
            restitution: 0.4,
            gravity: 9.81,
        }
    }

    #[test]
    fn masses_forces_gaps_and_rows_belong_together() {
        let crank = SliderCrank::new(data()).expect("valid");
        let (angles, rates) = (dvector![0.9, -0.4, 0.05], dvector![2.0, -1.3, 0.6]);
        assert_consistent(&crank, &angles, &rates);
        assert_lagrangian(&crank, &angles, &rates);
        let corners = |q: &DVector<f64>| CORNERS.iter().map(|(place, _)| crank.links.point(q, 2, crank.corner(*place))).collect::<Vec<_>>();
        assert_tangents(&crank, &angles, &rates, corners, |k| crank.guide[CORNERS[k].1].frame());
    }

    #[test]
    fn a_stretched_mechanism_has_its_slider_in_the_middle_of_the_guide() {
        let crank = SliderCrank::new(data()).expect("valid");
        let gaps: Vec<f64> = crank.contacts(&dvector![0.0, 0.0, 0.0]).iter().map(|contact| contact.gap).collect();
        assert!(gaps.iter().all(|gap| (gap - 0.001).abs() <= moreau_exact::tolerance::rounding(8, 0.1)), "{gaps:?}");
        let bodies = crank.bodies(&dvector![0.0, 0.0, 0.0], &dvector![1.0, 1.0, 0.0]);
        let centres: Vec<f64> = bodies.iter().map(|body| body.position[0]).collect();
        let speeds: Vec<f64> = bodies.iter().map(|body| body.linear_velocity[2]).collect();
        for (found, expected) in centres.into_iter().chain(speeds).zip([0.1, 0.45, 0.7].into_iter().cycle()) {
            assert!((found - expected).abs() <= moreau_exact::tolerance::rounding(8, 1.0), "{found} against {expected}");
        }
    }

    #[test]
    fn nonsense_is_refused() {
        let refused = |change: fn(&mut SliderCrankData)| {
            let mut wrong = data();
            change(&mut wrong);
            SliderCrank::new(wrong).is_err()
        };
        assert!(refused(|data| data.lengths[0] = 0.0) && refused(|data| data.lengths[1] = -1.0));
        assert!(refused(|data| data.masses[2] = 0.0) && refused(|data| data.inertias[1] = f64::NAN));
        assert!(refused(|data| data.clearance = 0.0) && refused(|data| data.restitution = 1.5));
    }
}
