//! A rigid contact whose points lie on springs of a given frequency, whatever they carry.
//!
//! ```text
//!     1/m_p = Σ_bodies ( 1/m + (r × n)·J⁻¹(r × n) ) ,     k = m_p (2πf)² ,     depth = N/k .
//! ```
//! *Derivation.* A point that moves along n under an impulse p gains the velocity p/m_p. A spring that makes it swing at the frequency f
//! has the stiffness m_p (2πf)²; whatever its damping, at rest it carries N where it is compressed by N/k.
//!
//! r is the arm from the centre of mass to the point \[m\], J the inertia \[kg·m²\], both in the world frame.

use nalgebra::{Matrix3, Vector3};
use std::f64::consts::TAU;

/// A contact point on its spring.
///
/// # Source
/// E. Catto, *Solver2D* (2024), soft contact constraints; the documentation of Rapier's `contact_softness`.
///
/// ```
/// use moreau_forms::soft_rigid_contact::SoftContact;
///
/// let contact = SoftContact { frequency: 30.0, inverse_mass: 1.0 };
/// let depth = contact.compression(9.81);
/// assert!((depth - 2.761e-4).abs() < 1e-7); // 9.81/(2π · 30)² m
/// assert!((contact.compression(2.0 * 9.81) / depth - 2.0).abs() < 1e-12);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SoftContact {
    /// f \[1/s\]; 0 for a contact without spring.
    pub frequency: f64,
    /// 1/m_p \[1/kg\], see [`inverse_mass_at`].
    pub inverse_mass: f64,
}

impl SoftContact {
    /// Compression N/(m_p (2πf)²) \[m\] under a load N \[N\]; 0 without spring.
    pub fn compression(&self, load: f64) -> f64 {
        if self.frequency == 0.0 { 0.0 } else { load * self.inverse_mass / (TAU * self.frequency).powi(2) }
    }
}

/// One body's part of 1/m_p \[1/kg\]: 1/m + (r × n)·J⁻¹(r × n).
pub fn inverse_mass_at(mass: f64, inverse_inertia: &Matrix3<f64>, arm: &Vector3<f64>, normal: &Vector3<f64>) -> f64 {
    let turn = arm.cross(normal);
    1.0 / mass + turn.dot(&(inverse_inertia * turn))
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_exact::tolerance::rounding;

    /// Follows m ẍ = −m ω² x − 2 ζ ω m ẋ − N to rest with the implicit Euler rule; −x is the compression.
    fn settled(mass: f64, frequency: f64, load: f64) -> f64 {
        let (omega, zeta, h) = (TAU * frequency, 5.0, 0.01);
        let (mut x, mut v) = (0.0, 0.0);
        for _ in 0..2_000 {
            v = (v - h * (load / mass + omega * omega * x)) / (1.0 + 2.0 * zeta * omega * h + (omega * h).powi(2));
            x += h * v;
        }
        -x
    }

    #[test]
    fn a_damped_oscillator_comes_to_rest_at_the_compression() {
        for (mass, frequency, load) in [(1.0, 30.0, 9.81), (2.0, 60.0, 9.81), (0.25, 10.0, 100.0)] {
            let predicted = SoftContact { frequency, inverse_mass: 1.0 / mass }.compression(load);
            // A contraction to its fixed point: a step of it is off by a few roundings of load/m h, its inverse is below 1/(ω h)².
            let stuck = rounding(16, load / mass * 0.01) / (TAU * frequency) + rounding(16, predicted);
            assert!((settled(mass, frequency, load) - predicted).abs() <= stuck, "{predicted}");
        }
    }

    #[test]
    fn the_inverse_mass_of_a_corner_is_the_delassus_diagonal() {
        let (mass, moments) = (3.0, [0.2, 0.5, 0.7]);
        let (arm, normal) = (Vector3::new(0.4, -0.3, -0.1), Vector3::new(0.48, -0.6, 0.64));
        let turn = arm.cross(&normal);
        // H M⁻¹ Hᵀ with H = (nᵀ, (arm × n)ᵀ) and M diagonal
        let jacobian = [normal.x, normal.y, normal.z, turn.x, turn.y, turn.z];
        let masses = [mass, mass, mass, moments[0], moments[1], moments[2]];
        let expected: f64 = jacobian.iter().zip(masses).map(|(h, m)| h * h / m).sum();
        let inverse = Matrix3::from_diagonal(&Vector3::from(moments.map(|moment| 1.0 / moment)));
        assert!((inverse_mass_at(mass, &inverse, &arm, &normal) - expected).abs() <= rounding(32, expected));
    }

    #[test]
    fn four_corners_of_a_cube_share_its_weight() {
        // m = 1, half extents ½: J = 1/6, arm of a corner (½, ½): 1/m_p = 1 + 6 (¼ + ¼) = 4. Each carries mg/4, so the cube is as deep as a
        // ball.
        let inverse = Matrix3::identity() * 6.0;
        let corner = inverse_mass_at(1.0, &inverse, &Vector3::new(0.5, 0.5, -0.5), &Vector3::z());
        assert_eq!(corner, 4.0);
        let (ball, cube) = (SoftContact { frequency: 60.0, inverse_mass: 1.0 }, SoftContact { frequency: 60.0, inverse_mass: corner });
        assert_eq!(cube.compression(9.81 / 4.0), ball.compression(9.81));
    }

    #[test]
    fn without_a_spring_nothing_is_compressed() {
        assert_eq!(SoftContact { frequency: 0.0, inverse_mass: 1.0 }.compression(9.81), 0.0);
    }
}
