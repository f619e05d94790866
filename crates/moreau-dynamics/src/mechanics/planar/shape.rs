//! Shapes of planar bodies, their solid inertia, and the rotation of their points.

use super::super::point_mass::positive;
use moreau_exact::Result;

/// The outline of a planar body, centred at its centre of mass.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shape {
    /// A disk of radius r \[m\].
    Disk {
        /// r \[m\].
        radius: f64,
    },
    /// A box with half extents (a, b) \[m\] along its own x and z axes.
    Box {
        /// (a, b) \[m\].
        half_extents: [f64; 2],
    },
}

/// A rigid body in the plane.
#[derive(Clone, Debug, PartialEq)]
pub struct PlanarBody {
    name: String,
    shape: Shape,
    mass: f64,
    inertia: f64,
}

impl PlanarBody {
    /// A body with a given moment of inertia I \[kg·m²\] about ŷ through its centre of mass.
    ///
    /// # Errors
    /// [`moreau_exact::Error::Invalid`] if mass, inertia, radius or a half extent is not positive.
    pub fn new(name: impl Into<String>, shape: Shape, mass: f64, inertia: f64) -> Result<Self> {
        positive("mass", mass)?;
        positive("inertia", inertia)?;
        match shape {
            Shape::Disk { radius } => positive("radius", radius)?,
            Shape::Box { half_extents } => half_extents.into_iter().try_for_each(|extent| positive("half_extents", extent))?,
        }
        Ok(PlanarBody { name: name.into(), shape, mass, inertia })
    }

    /// A uniform body: I = m r²/2 for a disk, m (a² + b²)/3 for a box.
    ///
    /// # Errors
    /// As [`PlanarBody::new`].
    pub fn solid(name: impl Into<String>, shape: Shape, mass: f64) -> Result<Self> {
        let inertia = match shape {
            Shape::Disk { radius } => mass * radius * radius / 2.0,
            Shape::Box { half_extents: [a, b] } => mass * (a * a + b * b) / 3.0,
        };
        PlanarBody::new(name, shape, mass, inertia)
    }

    /// The name in labels and files.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The outline.
    pub fn shape(&self) -> &Shape {
        &self.shape
    }

    /// m \[kg\].
    pub fn mass(&self) -> f64 {
        self.mass
    }

    /// I \[kg·m²\].
    pub fn inertia(&self) -> f64 {
        self.inertia
    }
}

/// Place and orientation of a body, x_world = centre + R(θ) x_body.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pose {
    /// Centre of mass \[m\].
    pub centre: [f64; 2],
    sine: f64,
    cosine: f64,
}

impl Pose {
    pub fn new(centre: [f64; 2], angle: f64) -> Self {
        let (sine, cosine) = angle.sin_cos();
        Pose { centre, sine, cosine }
    }

    /// R(θ) d.
    pub fn rotate(&self, direction: [f64; 2]) -> [f64; 2] {
        let [a, b] = direction;
        [a * self.cosine + b * self.sine, b * self.cosine - a * self.sine]
    }

    /// centre + R(θ) x.
    pub fn world(&self, point: [f64; 2]) -> [f64; 2] {
        let [x, z] = self.rotate(point);
        [self.centre[0] + x, self.centre[1] + z]
    }

    /// R(θ)ᵀ (x − centre).
    pub fn body(&self, point: [f64; 2]) -> [f64; 2] {
        let [x, z] = [point[0] - self.centre[0], point[1] - self.centre[1]];
        [x * self.cosine - z * self.sine, x * self.sine + z * self.cosine]
    }
}

/// The corners of a box, counter-clockwise from (−a, −b).
pub(super) fn corners([a, b]: [f64; 2]) -> [[f64; 2]; 4] {
    [[-a, -b], [a, -b], [a, b], [-a, b]]
}
