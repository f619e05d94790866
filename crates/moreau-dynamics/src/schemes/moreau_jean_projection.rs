//! Moreau–Jean with combined projection, as in Siconos: a contact acts in the step that would penetrate, and the step ends on it.
//!
//! ```text
//!     I = ∅ ,  q⁺ = q + h (θ v_free + (1−θ) v) ;    repeat, while some contact outside I has φ(q⁺) ≤ 0, and joins I:
//!         M (v⁺ − v) = h F_θ + Hᵀ r ,  H at q⁺ ,   K_μ ∋ r ⟂ y + μ‖y_t‖ n ∈ K_μ* ,   y = H v⁺ + e u_n n ,  u = H(q) v ,   for I
//!         q⁺ = q + h (θ v⁺ + (1−θ) v) ,  then   q⁺ ← q⁺ − H_nᵀ (H_n H_nᵀ)⁻¹ φ   until φ = 0 for all of I
//! ```
//! The gap decides implicitly, at the end of the step, where `moreau-jean` forecasts it. The projection is an equality: a contact of I is
//! moved onto φ = 0 from outside as well as from inside. It is the nearest move in the coordinates, not in the norm of M.
//!
//! An elastic ball that is projected from the height q loses m g q: unlike clipping at φ ≤ 0, which adds m g δ, this takes energy.
//!
//! # Energy
//! ```text
//!     T̂(v⁺) ≤ T̂(v_free) − Σ e r_n u_n⁻ − ½ rᵀŴ r ,      u_n⁻ = H_n(q) v, all else with H(q⁺)
//! ```
//! The total energy has no theorem: the projection moves bodies along the force or against it (`moreau::checks::energy_balance`).

use super::assembly::{self, normal_only};
use super::projection::{Listed, project};
use super::{Certified, Inertia, Scheme, StepContext, StepProblem, Waist, passes_the_waist};
use moreau_contact::certificate::StepResidual;
use moreau_contact::contact::{Components, Contact, Identity, pairs};
use moreau_contact::problem::{ContactProblem, Law};
use moreau_contact::solvers::{Auto, ContactSolver, LemkePivoting};
use moreau_exact::Result;
use nalgebra::DVector;
use std::sync::Arc;

/// Moreau–Jean with combined projection.
///
/// # Source
/// Siconos 4.4.0, `MoreauJeanCombinedProjectionOSI` and `TimeSteppingCombinedProjection`; Acary, Comput. Methods Appl. Mech. Eng. 256
/// (2013) 224.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MoreauJeanProjection {
    /// θ ∈ \[0, 1\] of the position update and of linear forces.
    pub theta: f64,
}

/// The contacts of the next problem: those of `contacts` that are closed or held already, and those held before that are no candidates any
/// more, as they were.
fn joined(contacts: Vec<Contact>, held: Vec<(Identity, Contact)>) -> Vec<(Identity, Contact)> {
    let before = Listed::of(held.iter().map(|(key, _)| *key));
    let listed = contacts.into_iter().enumerate().map(|(k, contact)| (Identity::of(k, &contact), contact));
    let mut next: Vec<(Identity, Contact)> =
        listed.filter(|(key, contact)| contact.gap <= 0.0 || before.position(*key).is_some()).collect();
    let now = Listed::of(next.iter().map(|(key, _)| *key));
    let gone: Vec<_> = held.into_iter().filter(|(key, _)| now.position(*key).is_none()).collect();
    next.extend(gone);
    next
}

impl MoreauJeanProjection {
    /// Checks θ.
    ///
    /// # Errors
    /// If θ is not in \[0, 1\].
    pub fn validate(&self) -> Result<()> {
        super::MoreauJean { theta: self.theta, ..Default::default() }.validate()
    }

    fn problem(&self, at: &StepContext, held: &[(Identity, Contact)], mass: &Arc<Inertia>, free: &DVector<f64>) -> Result<ContactProblem> {
        let (mechanism, state) = (at.mechanism(), at.state());
        let (rows, before) = (mechanism.rows_per_contact(), at.contacts());
        let jacobian = assembly::stack(held.iter().map(|(_, contact)| contact), rows, mechanism.degrees_of_freedom());
        let earlier = Listed::of(before.iter().enumerate().map(|(k, contact)| Identity::of(k, contact)));
        let shifts = held.iter().map(|(key, contact)| {
            let earlier = earlier.position(*key).map_or(contact, |k| &before[k]);
            let arriving = &earlier.jacobian * &state.velocity;
            normal_only(contact.restitution * arriving[0], rows)
        });
        let shifts: Vec<Components> = shifts.collect();
        ContactProblem::from_inertia(mass, &jacobian, free)
            .name(format!("{} moreau-jean-projection t={}", mechanism.name(), state.time))
            .law(if rows == 1 { Law::Frictionless } else { Law::Coulomb })
            .rows_per_contact(rows)
            .friction(held.iter().map(|(_, contact)| contact.friction).collect())
            .shift(DVector::from_iterator(rows * held.len(), shifts.iter().flat_map(|shift| shift.iter().copied())))
            .bodies(pairs(&held.iter().map(|(identity, _)| identity.place).collect::<Vec<_>>()))
            .build()
    }
}

impl Scheme for MoreauJeanProjection {
    fn name(&self) -> String {
        format!("moreau-jean-projection theta={}", self.theta)
    }

    passes_the_waist!();
}

impl Waist for MoreauJeanProjection {
    fn assemble(&self, at: &StepContext) -> Result<StepProblem> {
        let mechanism = at.mechanism();
        self.validate()?;
        let (effective_mass, free_velocity) = at.free_motion(self.theta)?;
        let mut reached = self.advance(at, &free_velocity);
        let (mut held, mut problem): (Vec<(Identity, Contact)>, Option<ContactProblem>) = (Vec::new(), None);
        let (mut residual, mut rejected) = (None, None);
        loop {
            let next = joined(mechanism.contacts(&reached), held.clone());
            if next.len() == held.len() {
                // the same ones, perhaps in another order: what was posed stays
                break;
            }
            held = next;
            let posed = self.problem(at, &held, &effective_mass, &free_velocity)?;
            let solver: &dyn ContactSolver = if posed.rows_per_contact() <= 2 { &LemkePivoting } else { &Auto };
            let certified = Certified::new(solver);
            let solution = certified.solve(&posed, None)?;
            let (worst, first) = certified.take();
            residual = StepResidual::worse_of(residual, worst);
            rejected = rejected.or(first.map(Box::new));
            let jacobian = assembly::stack(held.iter().map(|(_, contact)| contact), mechanism.rows_per_contact(), free_velocity.len());
            let velocity = &free_velocity + effective_mass.solve(&jacobian.tr_mul(&solution.impulse));
            let keys: Vec<Identity> = held.iter().map(|(key, _)| *key).collect();
            reached = project(mechanism, self.advance(at, &velocity), &keys)?;
            problem = Some(posed);
        }
        let jacobian = assembly::stack(held.iter().map(|(_, contact)| contact), mechanism.rows_per_contact(), free_velocity.len());
        let (active, places) = held.into_iter().map(|(key, _)| (key.index, key.place)).unzip();
        Ok(StepProblem { problem, active, places, effective_mass, free_velocity, jacobian, residual, rejected })
    }

    fn advance(&self, at: &StepContext, velocity_post: &DVector<f64>) -> DVector<f64> {
        let (state, h) = (at.state(), at.h());
        let mean = velocity_post * self.theta + &state.velocity * (1.0 - self.theta);
        at.mechanism().integrate(&at.state().position, &mean, h)
    }

    fn settle(&self, at: &StepContext, assembled: &StepProblem, position: DVector<f64>) -> Result<DVector<f64>> {
        let mechanism = at.mechanism();
        let held = assembled.active.iter().zip(&assembled.places).map(|(&index, &place)| Identity { index, place });
        let held: Vec<Identity> = held.collect();
        if held.is_empty() { Ok(position) } else { project(mechanism, position, &held) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mechanics::{BallChain, BeadInCircle, Mechanism, PointMass, State};
    use crate::scenes::Scene;
    use crate::schemes::{simulate, step};
    use moreau_contact::contact::Place;
    use moreau_contact::solvers::LemkePivoting;
    use moreau_exact::tolerance::rounding;
    use nalgebra::dvector;

    fn after(mechanism: &dyn Mechanism, position: DVector<f64>, velocity: DVector<f64>, h: f64) -> State {
        let state = State { time: 0.0, position, velocity };
        step(&MoreauJeanProjection { theta: 0.5 }, &LemkePivoting, mechanism, &state, h).expect("a step").state
    }

    #[test]
    fn the_step_that_would_penetrate_ends_on_the_floor_with_the_law_s_velocity() {
        let ball = PointMass::ball_on_floor(2.0, 10.0, 0.5);
        let reached = after(&ball, dvector![0.005], dvector![-1.0], 0.01);
        assert_eq!((reached.position[0], reached.velocity[0]), (0.0, 0.5));
        // one step earlier the contact has not acted, although φ + ½hφ̇ ≤ 0 would have let it act
        let earlier = after(&ball, dvector![0.0106], dvector![-1.0], 0.01);
        assert!(earlier.position[0] > 0.0 && (earlier.velocity[0] + 1.1).abs() <= rounding(8, 1.0));
    }

    #[test]
    fn an_elastic_ball_loses_the_height_it_is_projected_from() {
        let ball = PointMass::ball_on_floor(2.0, 10.0, 1.0);
        let start = State { time: 0.0, position: dvector![0.005], velocity: dvector![-1.0] };
        let reached = after(&ball, start.position.clone(), start.velocity.clone(), 0.01);
        let lost = ball.energy(&start) - ball.energy(&reached);
        assert!((lost - 2.0 * 10.0 * 0.005).abs() <= rounding(16, 2.0), "{lost}");
    }

    #[test]
    fn a_contact_that_closes_only_because_another_acts_joins_the_step() {
        // the first ball hits the second, which then runs into the third
        let chain = BallChain::new(vec![1.0; 3], vec![0.1; 3], 0.0).expect("valid");
        let reached = after(&chain, dvector![0.0, 0.204, 0.405], dvector![1.0, 0.0, 0.0], 0.01);
        let third = 1.0 / 3.0;
        assert!((&reached.velocity - dvector![third, third, third]).amax() <= rounding(32, 1.0), "{}", reached.velocity);
        let gaps = [reached.position[1] - reached.position[0] - 0.2, reached.position[2] - reached.position[1] - 0.2];
        assert!(gaps.iter().all(|gap| gap.abs() <= rounding(16, 1.0)), "{gaps:?}");
    }

    #[test]
    fn a_bead_that_slides_along_the_circle_stays_on_it_and_loses_no_more_than_the_turn_takes() {
        let bead = BeadInCircle::new(1.0, 1.0, 0.0, 0.0, 0.0).expect("valid");
        let mut state = State { time: 0.0, position: dvector![0.0, -1.0], velocity: dvector![1.0, 0.0] };
        for _ in 0..100 {
            state = after(&bead, state.position, state.velocity, 0.01);
            assert!((state.position.norm() - 1.0).abs() <= rounding(32, 1.0));
        }
        // for every θ: the free step turns by Δ = atan(hv/R), and the tangent there keeps cos Δ of the speed
        let kept = state.velocity.norm_squared();
        assert!((kept - 1.0 / (1.0 + 100.0 * 1e-4)).abs() <= rounding(6400, 1.0), "{kept}");
    }

    #[test]
    fn a_contact_that_is_no_candidate_any_more_is_held_as_it_was_and_closes_nothing() {
        let ball = PointMass::ball_on_floor(2.0, 10.0, 0.5);
        let own = |gap: f64| ball.contacts(&dvector![gap]).remove(0);
        let touching = joined(vec![own(-0.1)], Vec::new());
        assert_eq!(touching.len(), 1);
        // the list is empty now: the contact stays with its rows, and no other contact has joined
        let kept = joined(Vec::new(), touching.clone());
        assert_eq!(kept, touching);
        // one that has vanished and another that has come are two, not one for the other
        let place = |feature| Place { bodies: (0, None), features: [feature, 0], frame: [[0.0; 3]; 3] };
        let at = |feature, gap| Contact { place: Some(place(feature)), ..own(gap) };
        let first = joined(vec![at(1, -0.1)], Vec::new());
        let both = joined(vec![at(2, -0.1), at(3, 0.1)], first);
        assert_eq!(both.iter().map(|(key, _)| key.place.expect("given").features[0]).collect::<Vec<_>>(), [2, 1]);
        // a projection that holds only what is gone moves nothing
        let gone = [Identity { index: 0, place: None }, Identity { index: 7, place: None }];
        assert_eq!(project(&ball, dvector![0.3], &gone[1..]).expect("nothing to close"), dvector![0.3]);
        assert_eq!(project(&ball, dvector![0.3], &gone).expect("one to close"), dvector![0.0]);
    }

    /// Three bricks over each other, turned and spinning, which collide with e = 0.8: `rand7`.
    const TUMBLING: &str = r#"{"schema": "scene/1", "name": "tumbling", "duration": 1, "gravity": [0, 0, -9.81],
        "material": {"friction": 0, "restitution": 0.8}, "ground": {"normal": [0, 0, 1], "offset": 0}, "bodies": [
        {"name": "b0", "mass": 0.1, "position": [-0.0828360450913399, -0.07680674962909693, 0.25],
         "box": {"half_extents": [0.11093420820191323, 0.05153764280082153, 0.07312759127730525]},
         "linear_velocity": [1.098238706508501, 0.05949171889937006, -1.019611336474975],
         "angular_velocity": [-1.6752509444331827, -6.199354556606316, 1.9153365734811032],
         "orientation": [-0.3456154154859365, 0.2978013448086546, 0.8760815251903188, 0.15603046122102243]},
        {"name": "b1", "mass": 10, "position": [0.017445400637320224, -0.07856750715537436, 0.55],
         "box": {"half_extents": [0.11192469366124261, 0.14117372509597728, 0.08051481465284538]},
         "linear_velocity": [-0.643799878184059, -0.8501903080902952, -0.1113705688727112],
         "angular_velocity": [-0.6481871968492023, -2.076621138837905, -2.2663339111499536],
         "orientation": [0.5860919445440047, -0.6275911063081451, -0.1664326262641539, -0.48469146551013487]},
        {"name": "b2", "mass": 1, "position": [0.06146372680987633, -0.08333808944877757, 0.85],
         "box": {"half_extents": [0.07360348991542721, 0.08160353294258153, 0.06035586495573661]},
         "linear_velocity": [0.1379862240060608, -0.02134311095098513, -0.24965049201050402],
         "angular_velocity": [4.086631474426205, 8.821585914351957, -2.551552850315907],
         "orientation": [0.35734194587852325, -0.4433812402783924, -0.2900423310033444, 0.769152296824947]}]}"#;

    #[test]
    fn tumbling_bricks_lose_their_candidates_within_a_step_and_go_on() {
        let (mechanism, start) = Scene::from_json(TUMBLING).and_then(|scene| scene.spatial_mechanism()).expect("three bricks");
        let scheme = MoreauJeanProjection { theta: 0.5 };
        let mut last = start.clone();
        for h in [0.01, 0.005] {
            let steps = (0.5 / h) as usize;
            last = simulate(&scheme, &Auto, mechanism.as_ref(), start.clone(), h, steps).expect("no panic").last().clone();
        }
        assert!(
            mechanism.contacts(&last.position).iter().all(|contact| contact.gap > -1e-2),
            "no brick has fallen through another or the floor"
        );
    }

    #[test]
    fn contacts_that_say_the_same_twice_are_projected_once() {
        let plane = || crate::mechanics::Plane::new(dvector![0.0, 1.0], 0.0, 0.0, 0.0).expect("a unit normal");
        let point = PointMass::new("point", 1.0, dvector![0.0, 0.0], vec![plane(), plane()]).expect("valid");
        let reached = after(&point, dvector![0.0, 0.005], dvector![0.5, -1.0], 0.01);
        assert!(reached.position[1].abs() <= rounding(16, 1.0) && reached.velocity[1].abs() <= rounding(64, 1.0));
    }
}
