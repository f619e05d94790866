//! Shapes of rigid bodies in space, their solid inertia, and the rotation of their points.

use super::super::point_mass::positive;
use moreau_exact::Result;
use nalgebra::{DVector, Matrix3, Quaternion, UnitQuaternion, Vector3};

/// The surface of a rigid body, centred at its centre of mass, its axes the principal axes of inertia.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shape {
    /// A sphere of radius r \[m\].
    Sphere {
        /// r \[m\].
        radius: f64,
    },
    /// A box with half extents (a, b, c) \[m\] along its own axes.
    Box {
        /// (a, b, c) \[m\].
        half_extents: [f64; 3],
    },
}

impl Shape {
    /// Radius of the smallest sphere about the centre that holds the shape \[m\].
    pub fn radius(&self) -> f64 {
        match self {
            Shape::Sphere { radius } => *radius,
            Shape::Box { half_extents } => Vector3::from(*half_extents).norm(),
        }
    }
}

/// m/3 (b² + c², a² + c², a² + b²) of a solid box with half extents a, b, c \[kg·m²\].
pub(crate) fn box_moments(mass: f64, [a, b, c]: [f64; 3]) -> [f64; 3] {
    [b * b + c * c, a * a + c * c, a * a + b * b].map(|sum| mass * sum / 3.0)
}

/// A rigid body in space.
#[derive(Clone, Debug, PartialEq)]
pub struct SpatialBody {
    name: String,
    shape: Shape,
    mass: f64,
    moments: Vector3<f64>,
}

impl SpatialBody {
    /// A body with given principal moments of inertia J \[kg·m²\] about its own axes.
    ///
    /// # Errors
    /// [`moreau_exact::Error::Invalid`] if mass, a moment, the radius or a half extent is not positive.
    pub fn new(name: impl Into<String>, shape: Shape, mass: f64, moments: [f64; 3]) -> Result<Self> {
        positive("mass", mass)?;
        moments.into_iter().try_for_each(|moment| positive("inertia", moment))?;
        match shape {
            Shape::Sphere { radius } => positive("radius", radius)?,
            Shape::Box { half_extents } => half_extents.into_iter().try_for_each(|extent| positive("half_extents", extent))?,
        }
        Ok(SpatialBody { name: name.into(), shape, mass, moments: moments.into() })
    }

    /// A uniform body: J = ⅖ m r² (1, 1, 1) for a ball, m/3 (b² + c², a² + c², a² + b²) for a box.
    ///
    /// # Errors
    /// As [`SpatialBody::new`].
    pub fn solid(name: impl Into<String>, shape: Shape, mass: f64) -> Result<Self> {
        let moments = match shape {
            Shape::Sphere { radius } => [0.4 * mass * radius * radius; 3],
            Shape::Box { half_extents } => box_moments(mass, half_extents),
        };
        SpatialBody::new(name, shape, mass, moments)
    }

    /// The name in labels and files.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The surface.
    pub fn shape(&self) -> &Shape {
        &self.shape
    }

    /// m \[kg\].
    pub fn mass(&self) -> f64 {
        self.mass
    }

    /// J, principal moments about the body axes \[kg·m²\].
    pub fn moments(&self) -> &Vector3<f64> {
        &self.moments
    }
}

/// Place and orientation of a body, x_world = centre + R x_body.
#[derive(Clone, Copy, Debug)]
pub(in crate::mechanics) struct Pose {
    /// Centre of mass \[m\].
    pub centre: Vector3<f64>,
    /// The orientation as a unit quaternion.
    pub quaternion: UnitQuaternion<f64>,
    /// R.
    pub rotation: Matrix3<f64>,
}

impl Pose {
    /// The pose of body k in q = (x, y, z, w, i, j, k) per body.
    pub fn of(body: usize, position: &DVector<f64>) -> Self {
        let part = position.rows(7 * body, 7);
        let quaternion = UnitQuaternion::new_normalize(Quaternion::new(part[3], part[4], part[5], part[6]));
        Pose { centre: Vector3::new(part[0], part[1], part[2]), quaternion, rotation: *quaternion.to_rotation_matrix().matrix() }
    }

    /// centre + R x.
    pub fn world(&self, point: Vector3<f64>) -> Vector3<f64> {
        self.centre + self.rotation * point
    }

    /// Rᵀ (x − centre).
    pub fn body(&self, point: Vector3<f64>) -> Vector3<f64> {
        self.rotation.tr_mul(&(point - self.centre))
    }
}

/// The corners of a box; corner k has the signs of the bits of k, x first: 0 is (−a, −b, −c), 7 is (a, b, c).
pub(super) fn corners([a, b, c]: [f64; 3]) -> [Vector3<f64>; 8] {
    let signed = |k: usize, bit: usize, extent: f64| if k & bit == 0 { -extent } else { extent };
    std::array::from_fn(|k| Vector3::new(signed(k, 4, a), signed(k, 2, b), signed(k, 1, c)))
}
