//! All rows MuJoCo gives a contact, those of rotation included, and the pieces of Gauss's program they belong to.
//!
//! ```text
//!     H = (n, t₁, t₂, ω_n, ω_t₁, ω_t₂) as far as there is friction ,      μ = (μ, μ, torsional, rolling, rolling)
//!     elliptic     one cone Σ (f_j/μ_j)² ≤ f_n²                    E = 1
//!     pyramidal    2(dim − 1) edges n ± μ_j row j , one R for all   E f = the rows' forces
//! ```
//! ω_n, … is the relative angular velocity \[rad/s\], so that its force is a torque \[N·m\] and its coefficient a length \[m\].

use crate::mujoco::integrator::Pushed;
use crate::mujoco::parameters::Soft;
use crate::mujoco::{Cone, Mujoco, Rotational};
use moreau_contact::certificate::StepResidual;
use moreau_contact::contact::{ContactImpulse, Inertia, Mass, Place, Rows};
use moreau_contact::solvers::GaussNewton;
use moreau_contact::solvers::gauss::{GaussProgram, SoftPiece};
use moreau_contact::tolerance::certificate::CERTIFY;
use moreau_dynamics::mechanics::{Mechanism, State};
use moreau_exact::{Error, Result};
use nalgebra::{DMatrix, DVector};

/// One active contact with its rows.
pub(super) struct SoftRows {
    pub index: usize,
    pub place: Option<Place>,
    /// H, all rows.
    pub jacobian: Rows,
    /// E: one row per row of the pieces.
    pub edges: DMatrix<f64>,
    pub pieces: Vec<SoftPiece>,
    /// a_ref of the pieces' rows.
    pub reference: DVector<f64>,
}

impl SoftRows {
    /// The rows of every piece, with it.
    fn by_piece(&self) -> impl Iterator<Item = (Rows, SoftPiece)> {
        self.pieces.iter().scan(0, |next, piece| {
            let first = *next;
            *next += piece.rows();
            Some((weighted(&self.edges.rows(first, piece.rows()).into_owned(), &self.jacobian), piece.clone()))
        })
    }
}

/// Gauss's program of a step h from M⁻¹F, the rows of every piece by bodies.
fn program(mass: Mass, free: &DVector<f64>, contacts: &[SoftRows], h: f64) -> Result<GaussProgram> {
    let (jacobian, pieces) = contacts.iter().flat_map(SoftRows::by_piece).unzip();
    let offset = contacts.iter().flat_map(|contact| {
        let violation = (&contact.edges * (&contact.jacobian * free) - &contact.reference) * h;
        violation.data.as_vec().clone()
    });
    GaussProgram::of_rows(mass, jacobian, DVector::from_vec(offset.collect()), pieces)
}

/// The rows A H.
fn weighted(weights: &DMatrix<f64>, rows: &Rows) -> Rows {
    let by_rows = weights.transpose();
    rows.combined(&by_rows.as_slice().chunks_exact(rows.nrows()).collect::<Vec<_>>())
}

impl Mujoco {
    /// The rows of every active contact at a state.
    pub(super) fn soft_rows(
        &self,
        mechanism: &dyn Mechanism,
        position: &DVector<f64>,
        velocity: &DVector<f64>,
        h: f64,
    ) -> Result<Vec<SoftRows>> {
        let inertia = Inertia::of(mechanism.mass(position))?;
        let contacts = self.active(mechanism, position, inertia.factor());
        contacts.iter().map(|soft| self.rows_of(mechanism, position, velocity, h, soft)).collect()
    }

    fn rows_of(
        &self,
        mechanism: &dyn Mechanism,
        position: &DVector<f64>,
        velocity: &DVector<f64>,
        h: f64,
        soft: &Soft,
    ) -> Result<SoftRows> {
        let Soft { index, contact, inverse_mass } = soft;
        let (gap, mu, sliding) = (contact.gap, contact.friction, contact.jacobian.nrows());
        let mut friction = if mu > 0.0 { vec![mu; sliding - 1] } else { Vec::new() };
        let mut jacobian = weighted(&DMatrix::identity(1 + friction.len(), sliding), &contact.jacobian);
        if friction.len() == 2 && self.rotational != Rotational::NONE {
            let more = self.rotational.coefficients();
            let turning = mechanism.contact_rotation(position, contact).ok_or_else(|| {
                Error::Unsupported(format!("{}: torsional and rolling friction need free bodies in space", mechanism.name()))
            })?;
            jacobian = jacobian.above(&weighted(&DMatrix::identity(more.len(), 3), &turning));
            friction.extend(more);
        }
        let rows = jacobian.nrows();
        let (edges, pieces) = if friction.is_empty() {
            (DMatrix::identity(1, 1), vec![SoftPiece::OneSided { softness: self.softness.elliptic(gap, *inverse_mass, &[])[0] }])
        } else if self.cone == Cone::Elliptic || sliding < 3 {
            let softness = self.softness.elliptic(gap, *inverse_mass, &friction);
            let cone = SoftPiece::Cone { normal: softness[0], tangential: softness[1] * mu * mu, friction };
            (DMatrix::identity(rows, rows), vec![cone])
        } else {
            let edge = SoftPiece::OneSided { softness: self.softness.pyramidal(gap, *inverse_mass, mu) };
            (pyramid(&friction), vec![edge; 2 * friction.len()])
        };
        let reference = self.softness.reference_acceleration(h, gap, (&jacobian * velocity).as_slice());
        let reference = &edges * DVector::from_vec(reference);
        Ok(SoftRows { index: *index, place: contact.place, jacobian, edges, pieces, reference })
    }

    /// F + Hᵀf at a state, and h f of every active contact, by Newton's method on Gauss's program with all rows.
    pub(super) fn pushed_with_rotation(&self, mechanism: &dyn Mechanism, state: &State, force: &DVector<f64>, h: f64) -> Result<Pushed> {
        let inertia = Inertia::of(mechanism.mass(&state.position))?;
        let free = inertia.solve(force);
        let contacts = self.soft_rows(mechanism, &state.position, &state.velocity, h)?;
        let program = program(inertia.mass().clone(), &free, &contacts, h)?;
        let answer = GaussNewton::default().minimise(&program, DVector::zeros(program.velocities()))?;
        let mut first = 0;
        let own = |contact: &SoftRows| {
            let impulse = contact.edges.tr_mul(&answer.impulse.rows(first, contact.edges.nrows()));
            first += contact.edges.nrows();
            ContactImpulse { contact: contact.index, impulse: impulse.as_slice().into(), place: contact.place }
        };
        let impulses = contacts.iter().map(own).collect();
        let relative = answer.relative_gradient;
        let residual =
            StepResidual { rule: "minimum of Gauss's program", residual: "gradient", relative, limit: CERTIFY, contact: None, pair: None };
        let force = force + program.push(&answer.impulse) / h;
        Ok(Pushed { force, impulses, residual: (!contacts.is_empty()).then_some(residual) })
    }
}

/// Rows n ± μ_j row j in MuJoCo's order.
fn pyramid(friction: &[f64]) -> DMatrix<f64> {
    DMatrix::from_fn(2 * friction.len(), 1 + friction.len(), |edge, row| match row {
        0 => 1.0,
        _ if row - 1 == edge / 2 => friction[row - 1] * if edge % 2 == 0 { 1.0 } else { -1.0 },
        _ => 0.0,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_contact::contact::delassus::MassFactor;
    use moreau_dynamics::scenes::named;
    use moreau_dynamics::schemes::{Scheme, step};
    use moreau_exact::tolerance::rounding;

    #[test]
    fn without_rotation_the_program_and_the_waist_give_the_same_forces() {
        for cone in [Cone::Pyramidal, Cone::Elliptic] {
            for scene in ["incline-slide", "box-stack"] {
                let scheme = Mujoco::standard(cone);
                let (mechanism, mut state) = named(scene).and_then(|scene| scene.spatial_mechanism()).expect("built in");
                for _ in 0..10 {
                    let force = mechanism.force(&state.position, &state.velocity);
                    let pushed = scheme.pushed_with_rotation(mechanism.as_ref(), &state, &force, 0.005).expect("valid");
                    let made = step(&scheme, &GaussNewton::default(), mechanism.as_ref(), &state, 0.005).expect("valid");
                    let change = MassFactor::new(&mechanism.mass_matrix(&state.position)).expect("positive").solve(&pushed.force) * 0.005;
                    let far = (&state.velocity + change - &made.state.velocity).amax();
                    // both end at the same relative gradient, whose effect on one velocity the lever of a corner multiplies by ten
                    assert!(far <= 20.0 * moreau_contact::tolerance::solvers::STOP, "{scene} {cone:?}: {far}");
                    assert_eq!(pushed.impulses.len(), made.impulses.len());
                    state = made.state;
                }
            }
        }
    }

    /// A ball on a box and one on the ground, which roll and spin: rows of one and of two bodies.
    const ROLLING: &str = r#"{"schema": "scene/1", "name": "rolling", "duration": 1, "gravity": [0, 0, -9.81],
        "material": {"friction": 0.5, "restitution": 0}, "ground": {"normal": [0, 0, 1], "offset": 0}, "bodies": [
        {"name": "box", "mass": 3, "position": [1, 0, 0.0998], "box": {"half_extents": [0.2, 0.15, 0.1]}, "linear_velocity": [1, 0.5, 0]},
        {"name": "rider", "mass": 0.5, "position": [1.05, 0.02, 0.299], "sphere": {"radius": 0.1}, "angular_velocity": [1, 3, -2]},
        {"name": "air", "mass": 1, "position": [0, 0, 1], "sphere": {"radius": 0.1}, "linear_velocity": [0, 1, 0]},
        {"name": "lone", "mass": 1, "position": [2, 0, 0.099], "sphere": {"radius": 0.1}, "angular_velocity": [0, 1, 5]}]}"#;

    #[test]
    fn rows_by_bodies_move_as_rows_of_all_velocities() {
        let scene = moreau_dynamics::scenes::Scene::from_json(ROLLING).and_then(|scene| scene.spatial_mechanism());
        let ((mechanism, state), h) = (scene.expect("four bodies"), 0.005);
        let mass = mechanism.mass(&state.position);
        let free = Inertia::of(mass.clone()).expect("positive").solve(&mechanism.force(&state.position, &state.velocity));
        for (cone, rolling) in [(Cone::Pyramidal, 0.001), (Cone::Elliptic, 0.001), (Cone::Elliptic, 0.0)] {
            let scheme = Mujoco { rotational: Rotational { torsional: 0.02, rolling }, ..Mujoco::standard(cone) };
            let contacts = scheme.soft_rows(mechanism.as_ref(), &state.position, &state.velocity, h).expect("free bodies");
            let by_bodies = program(mass.clone(), &free, &contacts, h).expect("it fits");
            let rows: Vec<_> = contacts.iter().map(|contact| &contact.edges * contact.jacobian.to_dense()).collect();
            let jacobian = DMatrix::from_fn(by_bodies.rows(), 24, |row, column| {
                let (mut rest, mut of) = (row, 0);
                while rest >= rows[of].nrows() {
                    (rest, of) = (rest - rows[of].nrows(), of + 1);
                }
                rows[of][(rest, column)]
            });
            let reference = contacts.iter().flat_map(|contact| contact.reference.data.as_vec().clone()).collect();
            let offset = (&jacobian * &free - DVector::from_vec(reference)) * h;
            let pieces = contacts.iter().flat_map(|contact| contact.pieces.clone()).collect();
            let linked = GaussProgram::new(mass.to_dense(), jacobian, offset, pieces).expect("it fits");
            let found = |program: &GaussProgram| GaussNewton::default().minimise(program, DVector::zeros(24)).expect("definite").change;
            let (one, other) = (found(&by_bodies), found(&linked));
            // both end at the same relative gradient in the norm of M, whose least entry is that of a ball of ½ kg, 2·10⁻³ kg m²
            let allowed = 2.0 * moreau_contact::tolerance::solvers::STOP * other.dot(&mass.times(&other)).sqrt() / 2e-3f64.sqrt();
            assert!(other.norm() > 0.01 && (&one - &other).amax() <= 2.0 * allowed, "{cone:?}: {one} {other}");
        }
    }

    #[test]
    fn a_pyramid_holds_one_pair_of_edges_per_direction_and_their_forces_add_up() {
        let edges = pyramid(&[0.5, 0.5, 0.02]);
        assert_eq!(edges.shape(), (6, 4));
        assert_eq!(edges.row(1).iter().copied().collect::<Vec<f64>>(), [1.0, -0.5, 0.0, 0.0]);
        let force = edges.tr_mul(&DVector::from_vec(vec![1.0, 2.0, 0.0, 0.0, 3.0, 0.0]));
        let expected = [6.0, -0.5, 0.0, 0.06];
        assert!(force.iter().zip(expected).all(|(a, b)| (a - b).abs() <= rounding(4, 6.0)), "{force}");
    }

    #[test]
    fn lengths_that_cannot_be_meant_and_bodies_that_do_not_turn_are_refused() {
        let refused = |torsional, rolling| Rotational { torsional, rolling }.validate().expect_err("refused").to_string();
        assert!(refused(-0.1, 0.0).contains("torsional") && refused(f64::NAN, 0.0).contains("torsional"));
        assert!(refused(0.0, 0.1).contains("give both") && refused(0.1, f64::INFINITY).contains("rolling"));
        let scheme = Mujoco { rotational: Rotational { torsional: 0.01, rolling: 0.0 }, ..Mujoco::standard(Cone::Elliptic) };
        assert_eq!(scheme.name(), "mujoco elliptic torsional");
        let (planar, start) = named("incline-slide").and_then(|scene| scene.mechanism()).expect("built in");
        // a planar contact has one tangent and no such rows: it moves as without
        let plain = Mujoco { rotational: Rotational::NONE, ..scheme };
        let [one, other] =
            [scheme, plain].map(|scheme| step(&scheme, &GaussNewton::default(), planar.as_ref(), &start, 0.01).expect("valid").state);
        assert!((one.velocity - other.velocity).amax() <= 20.0 * moreau_contact::tolerance::solvers::STOP);
    }
}
