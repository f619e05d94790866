//! An open chain of rigid links in the vertical x–z plane, the first hinged to the origin, each next one to the end of the one before.
//!
//! ```text
//!     q = (θ₁ … θ_n), absolute angles from the x axis towards z ;   e(θ) = (cos θ, sin θ) ,  e′(θ) = (−sin θ, cos θ)
//!     centre of link i:   Σ_k b_ik e(θ_k) ,   b_ik = l_k for k < i,  c_i for k = i,  0 beyond
//!     A_jk = Σ_i m_i b_ij b_ik ,   w_j = Σ_i m_i b_ij
//!     M_jk = A_jk cos(θ_j − θ_k) + I_j δ_jk
//!     F_j  = −Σ_k A_jk sin(θ_j − θ_k) θ̇_k² − g w_j cos θ_j
//!     V    = g Σ_j w_j sin θ_j
//! ```
//! *Derivation.* T = ½ Σ_i (m_i |Σ_k b_ik e′(θ_k) θ̇_k|² + I_i θ̇_i²) and e′(a)·e′(b) = cos(a − b); F follows from Lagrange's equations.

use super::point_mass::positive;
use super::{BodyState, Plane};
use moreau_contact::contact::Contact;
use moreau_exact::Result;
use nalgebra::{DMatrix, DVector, dvector};

/// One link of the chain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Link {
    /// l, from hinge to hinge \[m\].
    pub length: f64,
    /// c, from the first hinge to the centre of mass \[m\].
    pub centre: f64,
    /// m \[kg\].
    pub mass: f64,
    /// I about the centre of mass \[kg·m²\].
    pub inertia: f64,
}

impl Link {
    /// A uniform rod, c = l/2 and I = m l²/12.
    pub fn rod(mass: f64, length: f64) -> Self {
        Link { length, centre: 0.5 * length, mass, inertia: mass * length * length / 12.0 }
    }
}

/// The chain under gravity g along −z.
#[derive(Clone, Debug)]
pub(super) struct HingedLinks {
    links: Vec<Link>,
    gravity: f64,
    /// A.
    coupling: DMatrix<f64>,
    /// w.
    weights: DVector<f64>,
}

impl HingedLinks {
    /// The links from the origin on; g \[m/s²\].
    ///
    /// # Errors
    /// If a mass, an inertia or the length of a link before the last is not positive.
    pub fn new(links: Vec<Link>, gravity: f64) -> Result<Self> {
        for (k, link) in links.iter().enumerate() {
            positive("mass", link.mass)?;
            positive("inertia", link.inertia)?;
            if k + 1 < links.len() {
                positive("length", link.length)?;
            }
        }
        let n = links.len();
        let lever = |i: usize, k: usize| match k.cmp(&i) {
            std::cmp::Ordering::Less => links[k].length,
            std::cmp::Ordering::Equal => links[i].centre,
            std::cmp::Ordering::Greater => 0.0,
        };
        let coupling = DMatrix::from_fn(n, n, |j, k| (0..n).map(|i| links[i].mass * lever(i, j) * lever(i, k)).sum());
        let weights = DVector::from_fn(n, |j, _| (0..n).map(|i| links[i].mass * lever(i, j)).sum());
        Ok(HingedLinks { links, gravity, coupling, weights })
    }

    pub fn len(&self) -> usize {
        self.links.len()
    }

    pub fn mass_matrix(&self, angles: &DVector<f64>) -> DMatrix<f64> {
        DMatrix::from_fn(self.len(), self.len(), |j, k| {
            let own = if j == k { self.links[j].inertia } else { 0.0 };
            self.coupling[(j, k)] * (angles[j] - angles[k]).cos() + own
        })
    }

    pub fn force(&self, angles: &DVector<f64>, rates: &DVector<f64>) -> DVector<f64> {
        DVector::from_fn(self.len(), |j, _| {
            let turning = |k: usize| self.coupling[(j, k)] * (angles[j] - angles[k]).sin() * rates[k] * rates[k];
            -(0..self.len()).map(turning).sum::<f64>() - self.gravity * self.weights[j] * angles[j].cos()
        })
    }

    pub fn potential_energy(&self, angles: &DVector<f64>) -> f64 {
        self.gravity * angles.iter().zip(&self.weights).map(|(angle, weight)| weight * angle.sin()).sum::<f64>()
    }

    /// A point of a link, (along, across) its axis from its first hinge \[m\].
    pub fn point(&self, angles: &DVector<f64>, link: usize, [along, across]: [f64; 2]) -> DVector<f64> {
        let mut place = dvector![0.0, 0.0];
        for k in 0..link {
            let (s, c) = angles[k].sin_cos();
            place += dvector![c, s] * self.links[k].length;
        }
        let (s, c) = angles[link].sin_cos();
        place + dvector![along * c - across * s, along * s + across * c]
    }

    /// ∂point/∂q, 2 × n.
    pub fn jacobian(&self, angles: &DVector<f64>, link: usize, [along, across]: [f64; 2]) -> DMatrix<f64> {
        let mut jacobian = DMatrix::zeros(2, self.len());
        for k in 0..=link {
            let (s, c) = angles[k].sin_cos();
            let [a, b] = if k == link { [along, across] } else { [self.links[k].length, 0.0] };
            jacobian.set_column(k, &dvector![-a * s - b * c, a * c - b * s]);
        }
        jacobian
    }

    /// The contact of a point of a link with a plane.
    pub fn contact(&self, angles: &DVector<f64>, link: usize, offset: [f64; 2], plane: &Plane) -> Contact {
        Contact {
            gap: plane.gap(&self.point(angles, link, offset)),
            jacobian: (plane.frame() * self.jacobian(angles, link, offset)).into(),
            friction: plane.friction,
            restitution: plane.restitution,
            place: None,
        }
    }

    /// The links at their centres of mass; θ turns x towards z, which is a rotation about −ŷ.
    pub fn bodies(&self, angles: &DVector<f64>, rates: &DVector<f64>, names: impl Fn(usize) -> String) -> Vec<BodyState> {
        let body = |k: usize| {
            let centre = [self.links[k].centre, 0.0];
            let (place, velocity) = (self.point(angles, k, centre), self.jacobian(angles, k, centre) * rates);
            let (s, c) = (0.5 * angles[k]).sin_cos();
            BodyState {
                name: names(k),
                position: [place[0], 0.0, place[1]],
                orientation: [c, 0.0, -s, 0.0],
                linear_velocity: [velocity[0], 0.0, velocity[1]],
                angular_velocity: [0.0, -rates[k], 0.0],
            }
        };
        (0..self.len()).map(body).collect()
    }
}
