//! Mechanisms: M(q) v̇ = F(q, v) + Hᵀ(q) λ with unilateral contacts φ(q) ≥ 0.

#[cfg(doc)]
use moreau_contact::contact::Place;
use moreau_contact::contact::{Contact, Rows};
use nalgebra::{DMatrix, DVector};

mod ball_chain;
mod bead_in_circle;
mod hinged_links;
mod neighbours;
mod oscillator;
mod painleve_rod;
mod pair_material;
pub mod planar;
mod point_mass;
mod rod_chain;
mod room;
mod slider_crank;
pub mod spatial;
mod sphere_bodies;
#[cfg(test)]
mod testing;
mod touching;

pub use ball_chain::BallChain;
pub use bead_in_circle::BeadInCircle;
pub use moreau_contact::contact::Mass;
pub use oscillator::OscillatorWithStop;
pub use painleve_rod::PainleveRod;
pub use pair_material::{Materials, PairMaterial};
pub use planar::PlanarBodies;
pub use point_mass::{Plane, PointMass};
pub use rod_chain::RodChain;
pub use room::afford;
pub use slider_crank::{SliderCrank, SliderCrankData};
pub use spatial::SpatialBodies;
pub use sphere_bodies::{SphereBodies, SphereBody};
pub use touching::contact_point;

/// Configuration and velocity of a mechanism.
#[derive(Clone, Debug, PartialEq)]
pub struct State {
    /// Time \[s\].
    pub time: f64,
    /// q.
    pub position: DVector<f64>,
    /// v.
    pub velocity: DVector<f64>,
}

/// Position, orientation and velocities of one body in the world frame, for files and pictures.
#[derive(Clone, Debug, PartialEq)]
pub struct BodyState {
    /// Name of the body.
    pub name: String,
    /// Centre of mass \[m\].
    pub position: [f64; 3],
    /// Unit quaternion \[w, x, y, z\].
    pub orientation: [f64; 4],
    /// Velocity of the centre of mass \[m/s\].
    pub linear_velocity: [f64; 3],
    /// \[rad/s\], world frame.
    pub angular_velocity: [f64; 3],
}

/// Delegates to an inner mechanism its name, sizes, mass matrix, force, potential energy and bodies. Write `answers_as!(self, mechanism)`
/// in the `impl Mechanism` of the outer mechanism. A crate that uses this macro depends on the crate `delegate`.
#[macro_export]
macro_rules! answers_as {
    ($me:ident, $inner:ident) => {
        ::delegate::delegate! {
            to $me.$inner {
                fn name(&$me) -> &str;
                fn degrees_of_freedom(&$me) -> usize;
                fn rows_per_contact(&$me) -> usize;
                fn mass_matrix(&$me, position: &::nalgebra::DVector<f64>) -> ::nalgebra::DMatrix<f64>;
                fn mass(&$me, position: &::nalgebra::DVector<f64>) -> $crate::mechanics::Mass;
                fn is_free(&$me) -> bool;
                fn force(&$me, position: &::nalgebra::DVector<f64>, velocity: &::nalgebra::DVector<f64>) -> ::nalgebra::DVector<f64>;
                fn potential_energy(&$me, position: &::nalgebra::DVector<f64>) -> f64;
                fn bodies(
                    &$me,
                    position: &::nalgebra::DVector<f64>,
                    velocity: &::nalgebra::DVector<f64>,
                ) -> Vec<$crate::mechanics::BodyState>;
            }
        }
    };
}

pub use answers_as;

/// A mechanical system with contacts: everything a scheme may know of it.
pub trait Mechanism: Send + Sync {
    /// A short name.
    fn name(&self) -> &str;
    /// nv, the number of velocities.
    fn degrees_of_freedom(&self) -> usize;
    /// Rows of each contact: 1 (normal), 2 (planar) or 3.
    fn rows_per_contact(&self) -> usize;
    /// M(q), symmetric positive definite, nv × nv.
    fn mass_matrix(&self, position: &DVector<f64>) -> DMatrix<f64>;
    /// M(q) by what couples its velocities, so that no step of free bodies needs a matrix of all of them; dense unless told otherwise.
    fn mass(&self, position: &DVector<f64>) -> Mass {
        Mass::Dense(self.mass_matrix(position))
    }
    /// Whether M couples no velocities of two bodies, and a contact touches two bodies at most: then no step needs a matrix of all of them.
    fn is_free(&self) -> bool {
        false
    }
    /// F(q, v) \[N, N·m\]: applied forces and velocity-dependent terms, without contact.
    fn force(&self, position: &DVector<f64>, velocity: &DVector<f64>) -> DVector<f64>;
    /// The average of F over a step of size h from (q, v) without contact, so that v + h M⁻¹F̄ is the velocity after it:
    /// F(q, v), unless a velocity-dependent term deserves more than an explicit step.
    fn mean_force(&self, position: &DVector<f64>, velocity: &DVector<f64>, h: f64) -> DVector<f64> {
        let _ = h;
        self.force(position, velocity)
    }
    /// Whether a step of size h can be taken at the velocity v with a work that does not grow with v.
    ///
    /// # Errors
    /// [`moreau_exact::Error::Invalid`] names the body that is too fast.
    fn check_speed(&self, velocity: &DVector<f64>, h: f64) -> moreau_exact::Result<()> {
        let _ = (velocity, h);
        Ok(())
    }
    /// Every contact candidate at q, always in the same order.
    fn contacts(&self, position: &DVector<f64>) -> Vec<Contact>;
    /// The candidates with a gap of at most `reach` \[m\], in the order of [`Mechanism::contacts`]; more may be listed, and by default
    /// all are.
    fn contacts_within(&self, position: &DVector<f64>, reach: f64) -> Vec<Contact> {
        let _ = reach;
        self.contacts(position)
    }
    /// An upper bound of the number of contact candidates at any q; `None` if there are too few to matter.
    fn most_candidates(&self) -> Option<usize> {
        None
    }
    /// How many candidates [`Mechanism::contacts_within`] lists, without their rows.
    fn count_within(&self, position: &DVector<f64>, reach: f64) -> usize {
        self.contacts_within(position, reach).len()
    }
    /// Shows the gaps \[m\] of the candidates that [`Mechanism::contacts_within`] lists, and the bodies of [`Place::bodies`], without
    /// their rows.
    fn gaps_within(&self, position: &DVector<f64>, reach: f64, show: &mut dyn FnMut(f64, Option<(usize, Option<usize>)>)) {
        self.contacts_within(position, reach).iter().for_each(|contact| show(contact.gap, contact.place.map(|place| place.bodies)));
    }
    /// The candidates between two bodies of [`Place::bodies`], as [`Mechanism::contacts`] lists them.
    fn contacts_between(&self, position: &DVector<f64>, bodies: (usize, Option<usize>)) -> Vec<Contact> {
        self.contacts(position).into_iter().filter(|contact| contact.place.is_some_and(|place| place.bodies == bodies)).collect()
    }
    /// The candidates of [`Mechanism::contacts_within`], their rows taken at the point halfway between the two points that touch: both
    /// bodies are looked at there. Where the gap is zero nothing changes; by default nothing ever does.
    fn contacts_halfway(&self, position: &DVector<f64>, reach: f64) -> Vec<Contact> {
        self.contacts_within(position, reach)
    }
    /// Σ 1/m over the two bodies of a contact \[1/kg\]: how easily a push at their centres moves them apart. `None` if the mechanism does
    /// not consist of free bodies.
    fn inverse_mass(&self, contact: &Contact) -> Option<f64> {
        let _ = contact;
        None
    }
    /// The relative angular velocity of the two bodies of a contact about its n, t₁ and t₂, as rows times v \[rad/s\]. `None` if the
    /// mechanism does not consist of bodies that turn by themselves in space.
    fn contact_rotation(&self, position: &DVector<f64>, contact: &Contact) -> Option<Rows> {
        let _ = (position, contact);
        None
    }
    /// ∂F/∂v of the gyroscopic torques of free bodies, one block for the velocities of each body \[N·m·s\]. `None` if the mechanism does
    /// not consist of free bodies.
    fn gyroscopic_slope(&self, position: &DVector<f64>, velocity: &DVector<f64>) -> Option<Vec<DMatrix<f64>>> {
        let _ = (position, velocity);
        None
    }
    /// An upper bound of h (‖u_n‖ + μ‖u_t‖) over every contact candidate there could be, at the velocity v \[m\]: a contact with a
    /// larger gap does not close in a step h with this velocity. Infinite by default: no bound is known.
    fn reach(&self, velocity: &DVector<f64>, h: f64) -> f64 {
        let _ = (velocity, h);
        f64::INFINITY
    }
    /// Potential energy V(q) \[J\].
    fn potential_energy(&self, position: &DVector<f64>) -> f64;
    /// Linear stiffness K and damping C of F = −K q − C v + …, treated θ-implicitly if present.
    fn linear_force(&self) -> Option<LinearForce> {
        None
    }
    /// q advanced by the velocity v over a time h; q + h v unless the configuration space is curved.
    fn integrate(&self, position: &DVector<f64>, velocity: &DVector<f64>, h: f64) -> DVector<f64> {
        position + velocity * h
    }
    /// The bodies of the mechanism in the world frame.
    fn bodies(&self, position: &DVector<f64>, velocity: &DVector<f64>) -> Vec<BodyState>;
    /// Kinetic energy ½ vᵀM(q)v \[J\].
    fn kinetic_energy(&self, state: &State) -> f64 {
        0.5 * state.velocity.dot(&self.mass(&state.position).times(&state.velocity))
    }
    /// T + V \[J\].
    fn energy(&self, state: &State) -> f64 {
        self.kinetic_energy(state) + self.potential_energy(&state.position)
    }
}

/// The linear part −K q − C v of a generalised force.
#[derive(Clone, Debug, PartialEq)]
pub struct LinearForce {
    /// K \[N/m\], nv × nv.
    pub stiffness: DMatrix<f64>,
    /// C \[N·s/m\], nv × nv.
    pub damping: DMatrix<f64>,
}
