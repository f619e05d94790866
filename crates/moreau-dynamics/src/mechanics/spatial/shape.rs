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
    /// The points within r of a segment of length 2l along the body's z axis.
    Capsule {
        /// r \[m\].
        radius: f64,
        /// l \[m\].
        half_height: f64,
    },
    /// A cylinder about the body's z axis.
    Cylinder {
        /// r \[m\].
        radius: f64,
        /// Half of its height \[m\].
        half_height: f64,
    },
}

impl Shape {
    /// Radius of the smallest sphere about the centre that holds the shape \[m\].
    pub fn radius(&self) -> f64 {
        match self {
            Shape::Sphere { radius } => *radius,
            Shape::Box { half_extents } => Vector3::from(*half_extents).norm(),
            Shape::Capsule { radius, half_height } => half_height + radius,
            Shape::Cylinder { radius, half_height } => half_height.hypot(*radius),
        }
    }

    /// Its word in messages, that of `scene/1`.
    pub fn word(&self) -> &'static str {
        match self {
            Shape::Sphere { .. } => "sphere",
            Shape::Box { .. } => "box",
            Shape::Capsule { .. } => "capsule",
            Shape::Cylinder { .. } => "cylinder",
        }
    }

    /// Principal moments of the solid of mass m \[kg·m²\]: ⅖ m r² of a ball, m/3 (b² + c², a² + c², a² + b²) of a box,
    /// m (r²/4 + l²/3), the same and m r²/2 of a cylinder. A capsule is a cylinder and two half balls of the same density, whose centres of
    /// mass lie 3r/8 beyond its ends.
    pub fn solid_moments(&self, mass: f64) -> [f64; 3] {
        match *self {
            Shape::Sphere { radius } => [0.4 * mass * radius * radius; 3],
            Shape::Box { half_extents } => box_moments(mass, half_extents),
            Shape::Cylinder { radius: r, half_height: l } => {
                let across = mass * (0.25 * r * r + l * l / 3.0);
                [across, across, 0.5 * mass * r * r]
            }
            Shape::Capsule { radius: r, half_height: l } => {
                // volumes 2π r² l and 4/3 π r³
                let balls = mass * 2.0 * r / (3.0 * l + 2.0 * r);
                let middle = mass - balls;
                let across = middle * (0.25 * r * r + l * l / 3.0) + balls * (0.4 * r * r + l * l + 0.75 * l * r);
                [across, across, 0.5 * middle * r * r + 0.4 * balls * r * r]
            }
        }
    }

    fn validate(&self) -> Result<()> {
        match self {
            Shape::Sphere { radius } => positive("radius", *radius),
            Shape::Box { half_extents } => half_extents.iter().try_for_each(|extent| positive("half_extents", *extent)),
            Shape::Capsule { radius, half_height } | Shape::Cylinder { radius, half_height } => {
                positive("radius", *radius)?;
                positive("half_height", *half_height)
            }
        }
    }
}

/// m/3 (b² + c², a² + c², a² + b²) of a solid box with half extents a, b, c \[kg·m²\].
fn box_moments(mass: f64, [a, b, c]: [f64; 3]) -> [f64; 3] {
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
        shape.validate()?;
        Ok(SpatialBody { name: name.into(), shape, mass, moments: moments.into() })
    }

    /// A body that keeps its velocity whatever touches it: 1/m = 0 and J⁻¹ = 0.
    ///
    /// # Errors
    /// [`moreau_exact::Error::Invalid`] if the radius or a half extent is not positive.
    pub fn unmoved(name: impl Into<String>, shape: Shape) -> Result<Self> {
        shape.validate()?;
        Ok(SpatialBody { name: name.into(), shape, mass: f64::INFINITY, moments: Vector3::repeat(f64::INFINITY) })
    }

    /// A uniform body: J as [`Shape::solid_moments`].
    ///
    /// # Errors
    /// As [`SpatialBody::new`].
    pub fn solid(name: impl Into<String>, shape: Shape, mass: f64) -> Result<Self> {
        let moments = shape.solid_moments(mass);
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

    /// Whether forces and impulses move it.
    pub fn is_free(&self) -> bool {
        self.mass.is_finite()
    }

    /// m \[kg\], infinite if nothing moves the body.
    pub fn mass(&self) -> f64 {
        self.mass
    }

    /// J, principal moments about the body axes \[kg·m²\], infinite if nothing moves the body.
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
        let (centre, quaternion) = Pose::placed(body, position);
        Pose { centre, quaternion, rotation: *quaternion.to_rotation_matrix().matrix() }
    }

    /// Centre and orientation alone.
    pub fn placed(body: usize, position: &DVector<f64>) -> (Vector3<f64>, UnitQuaternion<f64>) {
        let part: &[f64; 7] = position.as_slice()[7 * body..].first_chunk().expect("seven numbers a body");
        let [x, y, z, w, i, j, k] = *part;
        (Vector3::new(x, y, z), UnitQuaternion::new_normalize(Quaternion::new(w, i, j, k)))
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
