//! A point mass over planes: m v̇ = m g + Σ Hᵀλ, φ_k(q) = n_k·q − c_k, in one, two or three dimensions.

use super::{BodyState, Mechanism};
use moreau_contact::contact::Contact;
use moreau_contact::contact::frame::{planar_tangent, spatial_tangents};
use moreau_exact::number::counted;
use moreau_exact::tolerance::rounding;
use moreau_exact::{Error, Result};
use nalgebra::{DMatrix, DVector, dvector};

/// A half-space n·x ≥ c that a body may not leave, with the law of contact on its boundary.
#[derive(Clone, Debug, PartialEq)]
pub struct Plane {
    /// Unit normal n, pointing to the allowed side; as many components as the space has dimensions.
    pub normal: DVector<f64>,
    /// c = n·x on the plane \[m\].
    pub offset: f64,
    /// μ ≥ 0.
    pub friction: f64,
    /// e ∈ \[0, 1\].
    pub restitution: f64,
}

impl Plane {
    /// The plane n·x = c.
    ///
    /// # Errors
    /// [`Error::Invalid`] if the normal is not of unit length, a number is not finite, μ < 0 or e ∉ \[0, 1\].
    pub fn new(normal: DVector<f64>, offset: f64, friction: f64, restitution: f64) -> Result<Self> {
        let length = normal.norm();
        let unit = (length - 1.0).abs() <= rounding(normal.len() + 1, 1.0);
        if !unit {
            return Err(Error::invalid("normal", format!("has length {length}"), "use a unit vector"));
        }
        if !offset.is_finite() {
            return Err(Error::invalid("offset", format!("is {offset}"), "use a finite number"));
        }
        material(friction, restitution)?;
        Ok(Plane { normal, offset, friction, restitution })
    }

    /// φ = n·x − c \[m\].
    pub fn gap(&self, point: &DVector<f64>) -> f64 {
        self.normal.dot(point) - self.offset
    }

    /// Rows n, t₁, t₂ (as many as the space has dimensions) of the contact frame.
    pub fn frame(&self) -> DMatrix<f64> {
        let n = &self.normal;
        match n.len() {
            2 => {
                let t = planar_tangent([n[0], n[1]]);
                DMatrix::from_row_slice(2, 2, &[n[0], n[1], t[0], t[1]])
            }
            3 => {
                let [t, s] = spatial_tangents([n[0], n[1], n[2]]);
                DMatrix::from_row_slice(3, 3, &[[n[0], n[1], n[2]], t, s].concat())
            }
            _ => DMatrix::from_row_slice(1, n.len(), n.as_slice()),
        }
    }
}

/// Checks μ ≥ 0 and e ∈ \[0, 1\].
pub(super) fn material(friction: f64, restitution: f64) -> Result<()> {
    if !(friction.is_finite() && friction >= 0.0) {
        return Err(Error::invalid("friction", format!("is {friction}"), "use a finite number ≥ 0"));
    }
    if !(0.0..=1.0).contains(&restitution) {
        return Err(Error::invalid("restitution", format!("is {restitution}"), "use a number between 0 and 1"));
    }
    Ok(())
}

/// Checks that a mass or inertia is positive and finite.
pub(super) fn positive(field: &str, value: f64) -> Result<()> {
    if value.is_finite() && value > 0.0 { Ok(()) } else { Err(Error::invalid(field, format!("is {value}"), "use a positive number")) }
}

/// A point mass under a constant acceleration, above planes; q is its place.
#[derive(Clone, Debug)]
pub struct PointMass {
    name: String,
    mass: f64,
    gravity: DVector<f64>,
    planes: Vec<Plane>,
}

impl PointMass {
    /// A point of mass m \[kg\] under the acceleration g \[m/s²\] in as many dimensions as g has components.
    ///
    /// # Errors
    /// [`Error::Invalid`] if the mass is not positive, the dimension is not 1, 2 or 3, or a plane has another dimension.
    pub fn new(name: impl Into<String>, mass: f64, gravity: DVector<f64>, planes: Vec<Plane>) -> Result<Self> {
        positive("mass", mass)?;
        if !(1..=3).contains(&gravity.len()) || gravity.iter().any(|g| !g.is_finite()) {
            return Err(Error::invalid("gravity", format!("is {:?}", gravity.as_slice()), "use 1, 2 or 3 finite components"));
        }
        if let Some(plane) = planes.iter().find(|plane| plane.normal.len() != gravity.len()) {
            let problem = format!("has {}", counted(plane.normal.len(), "component"));
            return Err(Error::invalid("normal", problem, format!("gravity has {}", gravity.len())));
        }
        Ok(PointMass { name: name.into(), mass, gravity, planes })
    }

    /// The bouncing ball: q = height of its lowest point, φ = q, force −m g.
    ///
    /// # Panics
    /// If the mass is not positive or e ∉ \[0, 1\]; use [`PointMass::new`] for numbers from outside.
    pub fn ball_on_floor(mass: f64, gravity: f64, restitution: f64) -> Self {
        let built = Plane::new(dvector![1.0], 0.0, 0.0, restitution)
            .and_then(|floor| PointMass::new("ball on floor", mass, dvector![-gravity], vec![floor]));
        built.expect("mass > 0 and restitution in [0, 1] are required of the caller")
    }

    /// A block, as a point, on an incline of angle α: q = (distance down the slope, height above it); contact rows
    /// n = (0, 1) and t = (1, 0), down the slope; force m g (sin α, −cos α).
    ///
    /// # Panics
    /// If the mass is not positive, μ < 0 or e ∉ \[0, 1\]; use [`PointMass::new`] for numbers from outside.
    ///
    /// ```
    /// use moreau_dynamics::mechanics::{Mechanism, PointMass};
    /// use nalgebra::dvector;
    ///
    /// let block = PointMass::block_on_incline(1.0, 9.81, 0.3, 0.5, 0.0); // m, g, α, μ, e
    /// let [contact] = &block.contacts(&dvector![2.0, 0.0])[..] else { panic!("one contact") };
    /// assert_eq!((contact.gap, contact.friction), (0.0, 0.5)); // it touches the slope wherever it slides
    /// ```
    pub fn block_on_incline(mass: f64, gravity: f64, angle: f64, friction: f64, restitution: f64) -> Self {
        let acceleration = dvector![gravity * angle.sin(), -gravity * angle.cos()];
        let built = Plane::new(dvector![0.0, 1.0], 0.0, friction, restitution)
            .and_then(|slope| PointMass::new("block on incline", mass, acceleration, vec![slope]));
        built.expect("mass > 0, friction ≥ 0 and restitution in [0, 1] are required of the caller")
    }

    /// m \[kg\].
    pub fn mass(&self) -> f64 {
        self.mass
    }
}

impl Mechanism for PointMass {
    fn name(&self) -> &str {
        &self.name
    }

    fn degrees_of_freedom(&self) -> usize {
        self.gravity.len()
    }

    fn rows_per_contact(&self) -> usize {
        self.gravity.len()
    }

    fn mass_matrix(&self, _position: &DVector<f64>) -> DMatrix<f64> {
        DMatrix::identity(self.gravity.len(), self.gravity.len()) * self.mass
    }

    fn force(&self, _position: &DVector<f64>, _velocity: &DVector<f64>) -> DVector<f64> {
        &self.gravity * self.mass
    }

    fn contacts(&self, position: &DVector<f64>) -> Vec<Contact> {
        let contact = |plane: &Plane| Contact {
            gap: plane.gap(position),
            jacobian: plane.frame().into(),
            friction: if self.rows_per_contact() == 1 { 0.0 } else { plane.friction },
            restitution: plane.restitution,
            place: None,
        };
        self.planes.iter().map(contact).collect()
    }

    fn inverse_mass(&self, _contact: &Contact) -> Option<f64> {
        Some(1.0 / self.mass)
    }

    fn potential_energy(&self, position: &DVector<f64>) -> f64 {
        -self.mass * self.gravity.dot(position)
    }

    /// In one dimension q is the height z; in two, q = (x, z).
    fn bodies(&self, position: &DVector<f64>, velocity: &DVector<f64>) -> Vec<BodyState> {
        let place = |q: &DVector<f64>| match q.as_slice() {
            [z] => [0.0, 0.0, *z],
            [x, z] => [*x, 0.0, *z],
            [x, y, z, ..] => [*x, *y, *z],
            [] => [0.0; 3],
        };
        vec![BodyState {
            name: "point".into(),
            position: place(position),
            orientation: [1.0, 0.0, 0.0, 0.0],
            linear_velocity: place(velocity),
            angular_velocity: [0.0; 3],
        }]
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::assert_consistent;
    use super::*;

    #[test]
    fn block_slides_down_the_positive_tangent() {
        let block = PointMass::block_on_incline(2.0, 9.81, 0.3, 0.5, 0.0);
        let contact = &block.contacts(&dvector![0.4, 0.1])[0];
        assert_eq!((contact.gap, contact.friction), (0.1, 0.5));
        assert_eq!(contact.jacobian.to_dense(), DMatrix::from_row_slice(2, 2, &[0.0, 1.0, 1.0, 0.0]));
        assert!((&contact.jacobian * &block.force(&dvector![0.0, 0.0], &dvector![0.0, 0.0]))[1] > 0.0);
    }

    #[test]
    fn gaps_and_jacobians_agree_in_every_dimension() {
        let steep = |n: DVector<f64>| Plane::new(n.normalize(), 0.3, 0.5, 0.0).expect("unit normal");
        let ball = PointMass::ball_on_floor(1.5, 9.81, 0.5);
        assert_consistent(&ball, &dvector![0.7], &dvector![-0.2]);
        let plane = PointMass::new("2D", 2.0, dvector![0.1, -9.81], vec![steep(dvector![1.0, 0.2]), steep(dvector![-0.3, 1.0])]);
        assert_consistent(&plane.expect("valid"), &dvector![0.7, 0.1], &dvector![-0.2, 0.9]);
        let normals = [dvector![0.0, 1.0, 0.0], dvector![0.0, -1.0, 1e-3], dvector![1.0, 2.0, -3.0]];
        let space = PointMass::new("3D", 0.5, dvector![0.0, 0.0, -9.81], normals.into_iter().map(steep).collect());
        assert_consistent(&space.expect("valid"), &dvector![0.7, 0.1, -0.4], &dvector![-0.2, 0.9, 0.3]);
    }

    #[test]
    fn energy_of_a_raised_ball_is_m_g_h() {
        let ball = PointMass::ball_on_floor(2.0, 10.0, 0.5);
        let state = super::super::State { time: 0.0, position: dvector![3.0], velocity: dvector![-4.0] };
        assert_eq!(ball.energy(&state), 2.0 * 10.0 * 3.0 + 0.5 * 2.0 * 16.0);
    }

    #[test]
    fn nonsense_is_refused_by_name() {
        let message = |result: Result<Plane>| result.expect_err("invalid").to_string();
        assert!(message(Plane::new(dvector![0.0, 2.0], 0.0, 0.0, 0.0)).contains("normal"));
        assert!(message(Plane::new(dvector![f64::NAN], 0.0, 0.0, 0.0)).contains("normal"));
        assert!(message(Plane::new(dvector![1.0], f64::NAN, 0.0, 0.0)).contains("offset"));
        assert!(message(Plane::new(dvector![1.0], 0.0, -0.1, 0.0)).contains("friction"));
        assert!(message(Plane::new(dvector![1.0], 0.0, 0.0, 1.1)).contains("restitution"));
        assert!(PointMass::new("x", 0.0, dvector![-1.0], vec![]).is_err());
        assert!(PointMass::new("x", 1.0, DVector::zeros(4), vec![]).is_err());
    }
}
