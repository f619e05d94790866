//! Bodies and contacts that are not those of the scene.

use delegate::delegate;
use moreau_contact::contact::Contact;
use moreau_dynamics::mechanics::{BodyState, Mechanism, State};
use moreau_dynamics::scenes::Scene;
use moreau_exact::Result;
use nalgebra::{DMatrix, DVector};

/// ⅔ m r².
pub(super) fn hollow_spheres(scene: &mut Scene) {
    for body in &mut scene.bodies {
        if let (Some(sphere), None) = (body.sphere, body.inertia) {
            body.inertia = Some([body.mass * sphere.radius * sphere.radius * 2.0 / 3.0; 3]);
        }
    }
}

/// m/3 (b² + c², …) with the edges instead of their halves.
pub(super) fn full_extents(scene: &mut Scene) {
    for body in &mut scene.bodies {
        if let (Some(cuboid), None) = (body.cuboid, body.inertia) {
            let [a, b, c] = cuboid.half_extents.map(|half| 4.0 * half * half);
            body.inertia = Some([b + c, a + c, a + b].map(|square| body.mass * square / 3.0));
        }
    }
}

/// A mechanism with other forces or contacts.
struct Changed {
    inner: Box<dyn Mechanism>,
    /// Changes F of a state.
    force: Forces,
    /// Changes the contacts.
    contacts: fn(&mut [Contact]),
}

impl Mechanism for Changed {
    delegate! {
        to self.inner {
            fn name(&self) -> &str;
            fn degrees_of_freedom(&self) -> usize;
            fn rows_per_contact(&self) -> usize;
            fn mass_matrix(&self, position: &DVector<f64>) -> DMatrix<f64>;
            fn potential_energy(&self, position: &DVector<f64>) -> f64;
            fn integrate(&self, position: &DVector<f64>, velocity: &DVector<f64>, h: f64) -> DVector<f64>;
            fn bodies(&self, position: &DVector<f64>, velocity: &DVector<f64>) -> Vec<BodyState>;
        }
    }

    fn force(&self, position: &DVector<f64>, velocity: &DVector<f64>) -> DVector<f64> {
        let mut force = self.inner.force(position, velocity);
        (self.force)(&mut force, &self.mass_matrix(position), velocity);
        force
    }

    fn mean_force(&self, position: &DVector<f64>, velocity: &DVector<f64>, h: f64) -> DVector<f64> {
        let mut force = self.inner.mean_force(position, velocity, h);
        (self.force)(&mut force, &self.mass_matrix(position), velocity);
        force
    }

    fn contacts(&self, position: &DVector<f64>) -> Vec<Contact> {
        let mut contacts = self.inner.contacts(position);
        (self.contacts)(&mut contacts);
        contacts
    }
}

type Start = (Box<dyn Mechanism>, State);

type Forces = fn(&mut DVector<f64>, &DMatrix<f64>, &DVector<f64>);

fn changed(scene: &Scene, force: Forces, contacts: fn(&mut [Contact])) -> Result<Start> {
    let (inner, start) = scene.spatial_mechanism()?;
    Ok((Box::new(Changed { inner, force, contacts }), start))
}

/// Rows 3 to 5 of each body's six velocities are its spin.
fn is_spin(column: usize) -> bool {
    column % 6 >= 3
}

/// −1/s · J ω.
pub(super) fn damped_spin(scene: &Scene) -> Result<Start> {
    let damp = |force: &mut DVector<f64>, mass: &DMatrix<f64>, velocity: &DVector<f64>| {
        for k in (0..force.len()).filter(|&k| is_spin(k)) {
            force[k] -= mass[(k, k)] * velocity[k];
        }
    };
    changed(scene, damp, |_| {})
}

/// Tangential rows without lever.
pub(super) fn friction_at_centre(scene: &Scene) -> Result<Start> {
    let unlever = |contacts: &mut [Contact]| {
        for contact in contacts {
            let mut rows = contact.jacobian.to_dense();
            for column in (0..rows.ncols()).filter(|&k| is_spin(k)) {
                rows.view_mut((1, column), (rows.nrows() - 1, 1)).fill(0.0);
            }
            contact.jacobian = rows.into();
        }
    };
    changed(scene, |_, _, _| {}, unlever)
}

/// Every gap is taken for 3 cm less.
pub(super) fn thick_floor(scene: &Scene) -> Result<Start> {
    changed(scene, |_, _, _| {}, |contacts| contacts.iter_mut().for_each(|contact| contact.gap -= 0.03))
}

/// Only the first candidate of all ever touches.
pub(in crate::planted) fn first_touches(scene: &Scene) -> Result<Start> {
    changed(scene, |_, _, _| {}, |contacts| contacts.iter_mut().skip(1).for_each(|contact| contact.gap = f64::INFINITY))
}

/// e is that of the deepest contact, the first of several, and 0 of the others.
pub(in crate::planted) fn first_bounces(scene: &Scene) -> Result<Start> {
    let others = |contacts: &mut [Contact]| {
        let deepest = contacts.iter().enumerate().min_by(|(_, one), (_, other)| one.gap.total_cmp(&other.gap)).map(|(index, _)| index);
        let others = contacts.iter_mut().enumerate().filter(|(index, _)| Some(*index) != deepest);
        others.for_each(|(_, contact)| contact.restitution = 0.0);
    };
    changed(scene, |_, _, _| {}, others)
}
