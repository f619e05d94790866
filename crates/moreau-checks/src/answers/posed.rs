//! Contact problems with known answers: r and y are chosen in the law, and u_free := y − (W + R) r − shift.
//!
//! Every number is a binary fraction of few digits, so that nothing rounds: the stored answer is the exact one.

use moreau_contact::problem::{Compliance, ContactProblem, Coordinates, Dynamics, Law};
use moreau_exact::Result;
use nalgebra::{DMatrix, DVector, dmatrix};

/// A contact problem with the answer that it was made from.
pub struct Posed {
    /// What it shows.
    pub name: &'static str,
    /// The problem.
    pub problem: ContactProblem,
    /// r \[N·s\].
    pub impulse: DVector<f64>,
}

/// Law, W, μ, r and y of a problem before its data follow.
struct Chosen<'a> {
    name: &'static str,
    law: Law,
    delassus: DMatrix<f64>,
    friction: &'a [f64],
    impulse: &'a [f64],
    velocity: &'a [f64],
    shift: &'a [f64],
    softness: &'a [f64],
}

impl Chosen<'_> {
    fn pose(&self) -> Result<Posed> {
        let rows = self.impulse.len();
        let filled = |given: &[f64]| DVector::from_fn(rows, |i, _| given.get(i).copied().unwrap_or(0.0));
        let (impulse, shift, softness) = (filled(self.impulse), filled(self.shift), filled(self.softness));
        let free = filled(self.velocity) - &self.delassus * &impulse - softness.component_mul(&impulse) - &shift;
        let soft = softness.amax() > 0.0;
        let problem = ContactProblem::new(self.delassus.clone(), free)
            .name(self.name)
            .law(self.law)
            .rows_per_contact(rows / self.friction.len())
            .friction(self.friction.to_vec())
            .shift(shift)
            .compliance(soft.then_some(Compliance { coordinates: Coordinates::Contact, diagonal: softness }))
            .build()?;
        Ok(Posed { name: self.name, problem, impulse })
    }
}

/// W of one contact whose rows are coupled \[1/kg\].
fn coupled() -> DMatrix<f64> {
    dmatrix![1.0, 0.25, 0.0; 0.25, 2.0, 0.125; 0.0, 0.125, 1.5]
}

/// W of one contact without coupling \[1/kg\].
fn plain() -> DMatrix<f64> {
    DMatrix::from_diagonal(&DVector::from_vec(vec![1.0, 2.0, 2.0]))
}

/// Two contacts with these blocks, coupled by `between` times the identity.
fn two(first: &DMatrix<f64>, second: &DMatrix<f64>, between: f64) -> DMatrix<f64> {
    let mut w = DMatrix::zeros(6, 6);
    w.view_mut((0, 0), (3, 3)).copy_from(first);
    w.view_mut((3, 3), (3, 3)).copy_from(second);
    for k in 0..3 {
        (w[(k, k + 3)], w[(k + 3, k)]) = (between, between);
    }
    w
}

/// ‖r_t‖ = 5/2 = μ r_n.
const SLIDING: [f64; 3] = [5.0, -1.5, -2.0];
/// Opposite to it, with y_n = 0.
const SLIP: [f64; 3] = [0.0, 0.375, 0.5];
const STICKING: [f64; 3] = [4.0, 0.5, 0.25];
const REST: [f64; 3] = [0.0; 3];
const HALF: [f64; 1] = [0.5];

/// Every problem of this family.
///
/// # Errors
/// None: the data are valid.
pub fn all() -> Result<Vec<Posed>> {
    let mut posed = one_contact()?;
    posed.extend(polyhedral()?);
    posed.extend(two_contacts()?);
    posed.push(grazing()?);
    Ok(posed)
}

fn one_contact() -> Result<Vec<Posed>> {
    let none: &[f64] = &[];
    let of = |name, law, delassus: DMatrix<f64>, impulse: [f64; 3], velocity: [f64; 3]| {
        Chosen { name, law, delassus, friction: &HALF, impulse: &impulse, velocity: &velocity, shift: none, softness: none }.pose()
    };
    let edge = Chosen {
        name: "sticks at the edge of a narrow cone",
        law: Law::Coulomb,
        delassus: dmatrix![1.0, 0.0, 0.0; 0.0, 2.0, 0.0; 0.0, 0.0, 1.0],
        friction: &[1.0 / 1024.0],
        impulse: &[1024.0, -1.0, 0.0],
        velocity: &REST,
        shift: none,
        softness: none,
    };
    let soft = Chosen {
        name: "slides, soft and with restitution",
        delassus: coupled(),
        friction: &HALF,
        impulse: &SLIDING,
        velocity: &SLIP,
        shift: &[0.25, 0.0, 0.0],
        softness: &[0.25, 0.125, 0.125],
        ..edge
    };
    let small = SLIDING.map(|r| r / (1u32 << 24) as f64);
    let slow = SLIP.map(|y| y / (1u32 << 24) as f64);
    Ok(vec![
        of("slides", Law::Coulomb, coupled(), SLIDING, SLIP)?,
        of("slides, rows apart", Law::Coulomb, plain(), SLIDING, SLIP)?,
        of("slides slowly under little load", Law::Coulomb, plain(), small, slow)?,
        of("sticks", Law::Coulomb, coupled(), STICKING, REST)?,
        of("leaves", Law::Coulomb, coupled(), REST, [0.5, 1.0, -0.25])?,
        of("slides, associated", Law::Associated, coupled(), SLIDING, [0.3125, 0.375, 0.5])?,
        of("is smooth", Law::Frictionless, coupled(), [2.0, 0.0, 0.0], [0.0, 0.25, -1.0])?,
        edge.pose()?,
        soft.pose()?,
    ])
}

fn polyhedral() -> Result<Vec<Posed>> {
    let planar = dmatrix![1.0, 0.25; 0.25, 2.0];
    let of = |name, law, delassus, impulse: &[f64], velocity: &[f64]| {
        Chosen { name, law, delassus, friction: &HALF, impulse, velocity, shift: &[], softness: &[] }.pose()
    };
    let [coulomb, associated] = [Law::PolyhedralCoulomb { directions: 2 }, Law::PolyhedralAssociated { directions: 2 }];
    Ok(vec![
        of("slides in the plane", coulomb, planar.clone(), &[4.0, -2.0], &[0.0, 0.75])?,
        of("slides in the plane, associated", associated, planar, &[4.0, -2.0], &[0.375, 0.75])?,
        // of four directions −tangent₁ is nearest to opposing the slip, and carries all
        of("slides under a pyramid", Law::PolyhedralCoulomb { directions: 4 }, plain(), &[4.0, -2.0, 0.0], &[0.0, 0.75, 0.25])?,
    ])
}

fn two_contacts() -> Result<Vec<Posed>> {
    let join = |one: [f64; 3], other: [f64; 3]| [one, other].concat();
    let of = |name, delassus, friction: &[f64], impulse: &[f64], velocity: &[f64]| {
        Chosen { name, law: Law::Coulomb, delassus, friction, impulse, velocity, shift: &[], softness: &[] }.pose()
    };
    let heavy = two(&(coupled() / 1024.0), &plain(), 0.0);
    let loads = join(SLIDING.map(|r| 1024.0 * r), SLIDING.map(|r| r / 1024.0));
    Ok(vec![
        of("one a million times as loaded", heavy, &[0.5, 0.5], &loads, &join(SLIP, SLIP))?,
        of("one slides, one sticks", two(&coupled(), &plain(), 0.125), &[0.5, 0.25], &join(SLIDING, STICKING), &join(SLIP, REST))?,
        of("one slides, one leaves", two(&plain(), &coupled(), 0.125), &[0.5, 0.5], &join(SLIDING, REST), &join(SLIP, [0.5, 0.25, 0.0]))?,
    ])
}

/// Three contacts of one body without friction. The second is unloaded and opens at 2⁻¹⁷ m/s; the third joins it to the first, which does
/// not feel it.
fn grazing() -> Result<Posed> {
    let jacobian = dmatrix![1.0, 1.0; 1.0, -1.0; 1.0, 0.5];
    let mass = DMatrix::identity(2, 2);
    let delassus = &jacobian * jacobian.transpose();
    let impulse = DVector::from_vec(vec![4.0, 0.0, 0.0]);
    let velocity = DVector::from_vec(vec![0.0, 1.0 / (1u32 << 17) as f64, 8.0]);
    let free = velocity - &delassus * &impulse;
    let problem = ContactProblem::new(delassus, free)
        .name("grazes beside a load")
        .law(Law::Frictionless)
        .rows_per_contact(1)
        .friction(vec![0.0; 3])
        .dynamics(Dynamics { mass, jacobian })
        .build()?;
    Ok(Posed { name: "grazes beside a load", problem, impulse })
}
