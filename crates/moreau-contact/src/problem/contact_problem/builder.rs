//! How a contact problem is made: its pieces are set one by one, and `build` checks them together.

use super::known::Known;
use super::number::Number;
use super::once::Once;
use super::{Compliance, ContactKey, ContactProblem, Dynamics, Law};
use crate::contact::delassus::delassus;
use crate::contact::{Inertia, Jacobian};
use crate::memory::spare::{self, Lent};
use crate::operator::{Operator, SparseDynamics, of_mechanism};
use moreau_exact::number::counted;
use moreau_exact::{Error, Result};
use nalgebra::{DMatrix, DVector};
use std::sync::Arc;

/// The pieces of a [`ContactProblem`]. The defaults are: no name, Coulomb's law, three rows per contact, no shift, hard contacts,
/// unknown mass, unknown bodies.
#[derive(Debug)]
#[must_use = "a problem is made by `build`"]
pub struct ContactProblemBuilder {
    name: String,
    rows_per_contact: usize,
    law: Law,
    friction: Option<Vec<f64>>,
    free_velocity: Result<DVector<f64>>,
    shift: Option<DVector<f64>>,
    delassus: Result<Operator>,
    compliance: Option<Compliance>,
    dynamics: Option<Known>,
    bodies: Option<Vec<[Option<usize>; 2]>>,
    keys: Option<Vec<ContactKey>>,
    /// What is known of whether an impulse that is small at its own contact may move another one far.
    overreaches: Option<bool>,
}

impl ContactProblem {
    /// Begins a problem from W \[1/kg\] and u_free \[m/s\].
    ///
    /// A block of 1 kg arrives at 1 m/s and slides at 2 m/s, μ = ½:
    /// ```
    /// use moreau_contact::nalgebra::{self, DMatrix, dvector};
    /// use moreau_contact::{ContactProblem, Law};
    ///
    /// let block = ContactProblem::new(DMatrix::identity(2, 2), dvector![-1.0, 2.0])
    ///     .name("block")
    ///     .law(Law::Coulomb)
    ///     .rows_per_contact(2)
    ///     .friction(vec![0.5])
    ///     .build()?;
    /// assert_eq!(block.velocity(&dvector![1.0, -0.5]), dvector![0.0, 1.5]);
    ///
    /// let infinite = ContactProblem::new(DMatrix::identity(1, 1), dvector![f64::INFINITY]).rows_per_contact(1).build();
    /// assert!(infinite.unwrap_err().to_string().contains("free_velocity[0]"));
    /// # Ok::<(), moreau_contact::Error>(())
    /// ```
    #[expect(clippy::new_ret_no_self, reason = "`new` begins a problem, and only `build` completes it")]
    pub fn new(delassus: impl Into<Operator>, free_velocity: DVector<f64>) -> ContactProblemBuilder {
        ContactProblemBuilder::of(Ok(delassus.into()), Ok(free_velocity), None)
    }

    /// Begins a problem from the mechanism: the (effective) mass M̂, the contact Jacobian H and v_free, the velocity that the mechanism
    /// would have without contact. W = H M̂⁻¹ Hᵀ and u_free = H v_free are formed here, and M̂ and H are kept with the problem.
    ///
    /// A ball of 2 kg on a line falls at 3 m/s:
    /// ```
    /// use moreau_contact::nalgebra::{self, dmatrix, dvector};
    /// use moreau_contact::ContactProblem;
    ///
    /// let ball = ContactProblem::from_dynamics(dmatrix![2.0], dmatrix![1.0], &dvector![-3.0]).rows_per_contact(1).build()?;
    /// assert_eq!((ball.entry(0, 0), ball.free_velocity()[0]), (0.5, -3.0));
    ///
    /// let weightless = ContactProblem::from_dynamics(dmatrix![0.0], dmatrix![1.0], &dvector![-3.0]).rows_per_contact(1).build();
    /// assert!(weightless.unwrap_err().to_string().contains("mass"));
    /// # Ok::<(), moreau_contact::Error>(())
    /// ```
    pub fn from_dynamics(mass: DMatrix<f64>, jacobian: DMatrix<f64>, free_motion: &DVector<f64>) -> ContactProblemBuilder {
        let free_velocity = fitting(jacobian.ncols(), free_motion).map(|motion| &jacobian * motion);
        let delassus = delassus(&mass, &jacobian).map(Operator::from);
        ContactProblemBuilder::of(delassus, free_velocity, Some(Known::Dense(Dynamics { mass, jacobian }))).overreaching(Some(false))
    }

    /// Does what [`ContactProblem::from_dynamics`] does, from a mass matrix that is factored already and rows that are kept body by body: W
    /// is stored by blocks where most contacts do not meet, and no matrix is as large as the mechanism.
    pub fn from_inertia(inertia: &Arc<Inertia>, jacobian: &Arc<Jacobian>, free_motion: &DVector<f64>) -> ContactProblemBuilder {
        let free_velocity = fitting(jacobian.ncols(), free_motion).map(|motion| &**jacobian * motion);
        ContactProblem::from_inertia_at(inertia, jacobian, free_velocity)
    }

    /// [`ContactProblem::from_inertia`] where u_free = H v_free is known \[m/s\].
    pub fn from_free_velocity(inertia: &Arc<Inertia>, jacobian: &Arc<Jacobian>, free_velocity: DVector<f64>) -> ContactProblemBuilder {
        ContactProblem::from_inertia_at(inertia, jacobian, Ok(free_velocity))
    }

    fn from_inertia_at(inertia: &Arc<Inertia>, jacobian: &Arc<Jacobian>, free_velocity: Result<DVector<f64>>) -> ContactProblemBuilder {
        let known = Known::sparse(inertia.clone(), jacobian.clone());
        ContactProblemBuilder::of(of_mechanism(inertia, jacobian), free_velocity, Some(known)).overreaching(Some(false))
    }

    /// Begins a problem from the mechanism by bodies: W = H M̂⁻¹ Hᵀ acts through the bodies and is not formed, u_free = H v_free.
    ///
    /// Two balls of 2 kg on each other fall at 3 m/s:
    /// ```
    /// use moreau_contact::nalgebra::{self, dvector};
    /// use moreau_contact::ContactProblem;
    /// use moreau_contact::operator::{Sparse, SparseDynamics};
    ///
    /// let mass = Sparse { shape: [2, 2], entries: vec![(0, 0, 2.0), (1, 1, 2.0)] };
    /// let jacobian = Sparse { shape: [2, 2], entries: vec![(0, 0, 1.0), (1, 0, -1.0), (1, 1, 1.0)] };
    /// let mechanism = SparseDynamics::new(&mass, &jacobian, 1)?;
    /// let balls = ContactProblem::from_sparse_dynamics(&mechanism, &dvector![-3.0, -3.0]).rows_per_contact(1).build()?;
    /// assert_eq!((balls.entry(1, 1), balls.free_velocity()), (1.0, &dvector![-3.0, 0.0]));
    /// # Ok::<(), moreau_contact::Error>(())
    /// ```
    pub fn from_sparse_dynamics(dynamics: &SparseDynamics, free_motion: &DVector<f64>) -> ContactProblemBuilder {
        let free_velocity = if free_motion.len() == dynamics.velocity_count() {
            Ok(dynamics.contact_velocity(free_motion))
        } else {
            Err(free_motion_of(dynamics.velocity_count(), free_motion.len()))
        };
        ContactProblemBuilder::of(dynamics.matrix_free().map(Operator::from), free_velocity, None)
            .rows_per_contact(dynamics.rows_per_contact())
            .overreaching(Some(false))
    }

    /// The pieces of this problem, to make another one that differs in some.
    /// ```
    /// use moreau_contact::nalgebra::{self, DMatrix, dvector};
    /// use moreau_contact::{ContactProblem, Law};
    ///
    /// let round = ContactProblem::new(DMatrix::identity(3, 3), dvector![-1.0, 2.0, 0.0]).friction(vec![0.5]).build()?;
    /// let octagon = round.clone().into_builder().law(Law::PolyhedralCoulomb { directions: 8 }).build()?;
    /// assert_eq!(octagon.free_velocity(), round.free_velocity());
    /// # Ok::<(), moreau_contact::Error>(())
    /// ```
    pub fn into_builder(self) -> ContactProblemBuilder {
        let overreaches = self.known_overreach();
        ContactProblemBuilder {
            overreaches,
            name: self.name.into_inner(),
            rows_per_contact: self.rows_per_contact,
            law: self.law,
            friction: Some(self.friction.into_inner()),
            free_velocity: Ok(self.free_velocity.into_inner()),
            shift: Some(self.shift.into_inner()),
            delassus: Ok(self.delassus),
            compliance: self.compliance,
            dynamics: self.dynamics,
            bodies: self.bodies.map(Lent::into_inner),
            keys: self.keys,
        }
    }
}

/// μ of every contact of so many rows: as given, or 0 where the law or the rows leave no friction.
fn friction(given: Option<Vec<f64>>, law: Law, size: usize, rows: usize) -> Result<Vec<f64>> {
    if !(1..=3).contains(&rows) {
        return Ok(given.unwrap_or_default()); // `validate` names the number of rows
    }
    if let Some(friction) = given {
        let contacts = friction.len();
        if size == rows * contacts {
            return Ok(friction);
        }
        let needed = format!(
            "give size {}, for {contacts} with {rows} each",
            rows * contacts,
            contacts = counted(contacts, "contact"),
            rows = counted(rows, "row")
        );
        let cure = format!("{needed}, or as many `friction` as contacts, or correct their rows (`rows_per_contact`, in files `dimension`)");
        return Err(Error::invalid("free_velocity", format!("has size {size}"), cure));
    }
    let contacts = size / rows;
    if !size.is_multiple_of(rows) {
        let cure = format!(
            "give a multiple of the rows per contact, which are {rows}, or correct their number (`rows_per_contact`, in files `dimension`)"
        );
        return Err(Error::invalid("free_velocity", format!("has size {size}"), cure));
    }
    if law == Law::Frictionless || rows < 2 || contacts == 0 {
        return Ok(vec![0.0; contacts]);
    }
    let problem = format!("is missing, but the law `{}` needs it", law.name());
    Err(Error::invalid("friction", problem, format!("give {} μ ≥ 0, with 0 for a contact without friction", counted(contacts, "number"))))
}

/// v_free, if it has one entry per column of H.
fn fitting(columns: usize, free_motion: &DVector<f64>) -> Result<&DVector<f64>> {
    if free_motion.len() == columns {
        return Ok(free_motion);
    }
    Err(free_motion_of(columns, free_motion.len()))
}

fn free_motion_of(wanted: usize, found: usize) -> Error {
    Error::invalid("free_motion", format!("has size {found}"), format!("give {wanted} entries, one per column of the Jacobian"))
}

impl ContactProblemBuilder {
    fn of(delassus: Result<Operator>, free_velocity: Result<DVector<f64>>, dynamics: Option<Known>) -> Self {
        ContactProblemBuilder {
            name: String::new(),
            rows_per_contact: 3,
            law: Law::Coulomb,
            friction: None,
            free_velocity,
            shift: None,
            delassus,
            compliance: None,
            dynamics,
            bodies: None,
            keys: None,
            overreaches: None,
        }
    }

    /// A name for messages.
    pub fn name(mut self, name: impl Into<String>) -> Self {
        self.name = name.into();
        self
    }

    /// The contact law.
    pub fn law(mut self, law: Law) -> Self {
        self.law = law;
        self
    }

    /// Rows per contact: 1 (normal only), 2 (planar) or 3.
    pub fn rows_per_contact(mut self, rows: usize) -> Self {
        self.rows_per_contact = rows;
        self
    }

    /// Friction coefficient μ ≥ 0 of each contact.
    pub fn friction(mut self, friction: Vec<f64>) -> Self {
        self.friction = Some(friction);
        self
    }

    /// u_free \[m/s\], in place of the one before.
    pub fn free_velocity(mut self, free_velocity: DVector<f64>) -> Self {
        self.free_velocity = Ok(free_velocity);
        self
    }

    /// What the scheme adds for the law: restitution, φ/h, reference acceleration \[m/s\].
    pub fn shift(mut self, shift: DVector<f64>) -> Self {
        self.shift = Some(shift);
        self
    }

    /// W \[1/kg\], in place of the one before; mass and Jacobian stay what they are.
    pub fn delassus(mut self, delassus: impl Into<Operator>) -> Self {
        self.delassus = Ok(delassus.into());
        self.overreaches = None;
        self
    }

    /// W is any matrix, as of a linear complementarity problem, and no Delassus operator: an impulse that is small by its own size may
    /// carry another row, and the certificate asks for that. Where it is not said, entries that are too large for bodies tell, or that
    /// W is not positive semidefinite.
    pub fn of_any_matrix(self) -> Self {
        self.overreaching(Some(true))
    }

    /// What is known of that.
    pub(crate) fn overreaching(mut self, known: Option<bool>) -> Self {
        self.overreaches = known;
        self
    }

    /// R of soft contacts, or `None`.
    pub fn compliance(mut self, compliance: impl Into<Option<Compliance>>) -> Self {
        self.compliance = compliance.into();
        self
    }

    /// The mass and Jacobian that W came from, or `None`. They are believed, not compared with W: [`ContactProblem::from_dynamics`]
    /// makes W of them.
    pub fn dynamics(mut self, dynamics: impl Into<Option<Dynamics>>) -> Self {
        self.dynamics = dynamics.into().map(Known::Dense);
        self
    }

    /// The mass and Jacobian that W came from, by the velocities that the mass couples. They are believed, not compared with W.
    pub fn sparse_dynamics(mut self, dynamics: SparseDynamics) -> Self {
        self.dynamics = Some(Known::listed(dynamics));
        self
    }

    /// The mass and Jacobian that W came from, however a file has them, or `None`.
    #[cfg(feature = "files")]
    pub(in crate::problem) fn known(mut self, known: Option<Known>) -> Self {
        self.dynamics = known;
        self
    }

    /// The two bodies of each contact by number, the ground as `None`; or `None` for all of them.
    pub fn bodies(mut self, bodies: impl Into<Option<Vec<[Option<usize>; 2]>>>) -> Self {
        self.bodies = bodies.into();
        self
    }

    /// What tells each contact from the others in any list; or `None`.
    pub fn keys(mut self, keys: impl Into<Option<Vec<ContactKey>>>) -> Self {
        self.keys = keys.into();
        self
    }

    /// The problem, if its pieces are valid together.
    ///
    /// # Errors
    /// [`Error::Invalid`] names the first field whose size, number or sign does not fit, with the cure.
    pub fn build(self) -> Result<ContactProblem> {
        let (delassus, free_velocity) = (self.delassus?, self.free_velocity?);
        let friction = friction(self.friction, self.law, free_velocity.len(), self.rows_per_contact)?;
        let shift = self.shift.unwrap_or_else(|| spare::zeros(free_velocity.len()));
        let problem = ContactProblem {
            name: self.name.into(),
            rows_per_contact: self.rows_per_contact,
            law: self.law,
            friction: friction.into(),
            free_velocity: free_velocity.into(),
            shift: shift.into(),
            delassus,
            compliance: self.compliance,
            dynamics: self.dynamics,
            bodies: self.bodies.map(Lent::from),
            keys: self.keys,
            groups: Once::default(),
            weights: Once::default(),
            islands: Once::default(),
            rounding: Once::default(),
            loses_digits: Once::default(),
            unformed: Once::default(),
            overreaches: self.overreaches.map_or_else(Once::default, Once::known),
            indefiniteness: if self.overreaches == Some(false) { Once::known(0.0) } else { Once::default() },
            velocity_factor: Once::default(),
            written_out: Once::default(),
            number: Number::default(),
        };
        problem.validate()?;
        Ok(problem)
    }
}
