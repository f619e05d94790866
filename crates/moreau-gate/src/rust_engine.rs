//! The gate for engines written in Rust: one `#[test]` per check.
//!
//! ```
//! use moreau_gate::{ContactModel, Description, Engine, Kind, Level, Options, Reply};
//! use moreau_gate::description::{BodyKind, Friction, Precision, ShapeKind};
//!
//! /// A library of cone projections; a simulator implements [`Engine::simulate`] in the same way.
//! #[derive(Default)]
//! struct MyEngine;
//!
//! impl Engine for MyEngine {
//!     fn describe(&mut self, _: &Options) -> Reply<Description> {
//!         Ok(Description {
//!             name: "mine".into(),
//!             version: "1".into(),
//!             precision: Precision::Double,
//!             contact_model: ContactModel { kind: Kind::Rigid, law: None, parameters: Default::default() },
//!             restitution: false,
//!             friction: Friction::Cone,
//!             reports_contacts: false,
//!             levels: vec![Level::Project],
//!             laws: vec![],
//!             shapes: ShapeKind::basic(),
//!             bodies: BodyKind::free(),
//!             sleeping: None,
//!             options: Options::new(),
//!         })
//!     }
//!
//!     fn project(&mut self, mu: f64, points: &[Vec<f64>], _: &Options) -> Reply<Vec<Vec<f64>>> {
//!         Ok(points.iter().map(|point| nearest(mu, point)).collect())
//!     }
//! }
//!
//! /// The nearest point to (n, t) of the cone ‖t‖ ≤ μ n.
//! fn nearest(mu: f64, point: &[f64]) -> Vec<f64> {
//!     let (n, t) = (point[0], point[1..].iter().map(|x| x * x).sum::<f64>().sqrt());
//!     if n >= 0.0 && t <= mu * n {
//!         return point.to_vec();
//!     }
//!     if mu * t <= -n {
//!         return vec![0.0; point.len()];
//!     }
//!     let normal = (n + mu * t) / (1.0 + mu * mu);
//!     std::iter::once(normal).chain(point[1..].iter().map(|x| mu * normal * x / t)).collect()
//! }
//!
//! moreau_gate::gate_tests!(MyEngine);
//! # moreau_gate::rust_engine::assert_check::<MyEngine>("projection/regions");
//! # moreau_gate::rust_engine::assert_check::<MyEngine>("projection/boundaries");
//! # moreau_gate::rust_engine::assert_check::<MyEngine>("flight/projectile"); // unsupported: not held against it
//! ```

use crate::report::text;
use crate::runner::{Plan, QUICK, SWEEP};
use crate::{Engine, Options, checks, runner};
use moreau_checks::text::Style;

/// Runs one check on an engine and panics with the table if it is bad; the quick sweep, or the whole one if `MOREAU_SWEEP=full`.
///
/// # Panics
/// If the verdict is fail or errored, or if there is no such check.
pub fn assert_check<E: Engine + Default + 'static>(name: &str) {
    let check = checks::find(name).unwrap_or_else(|| panic!("there is no check `{name}`"));
    let full = std::env::var("MOREAU_SWEEP").is_ok_and(|sweep| sweep == "full");
    let sweep = if full { SWEEP.to_vec() } else { QUICK.to_vec() };
    let plan = Plan { checks: vec![check], sweep, options: Options::new(), jobs: 1, repeats: 1, progress: &|| {} };
    match runner::run(&|| Box::new(E::default()), &plan) {
        Ok(report) => assert!(!report.is_bad(), "\n{}\n{}", text::table(&report, Style::PLAIN), check.derivation),
        Err(refusal) => panic!("the engine does not describe itself: {refusal}"),
    }
}

/// One `#[test]` per check of the gate for an engine type that implements [`Engine`](crate::Engine) and `Default`.
///
/// A check that the engine does not support passes, as does a difference that its declared law predicts.
#[macro_export]
macro_rules! gate_tests {
    ($engine:ty) => {
        $crate::gate_tests! {
            $engine;
            flight_projectile "flight/projectile"
            flight_momentum "flight/momentum"
            flight_spinning_box "flight/spinning-box"
            ball_restitution "ball/restitution"
            ball_energy "ball/energy"
            ball_zeno "ball/zeno"
            ball_penetration "ball/penetration"
            ball_effective_restitution "ball/effective-restitution"
            impact_two_spheres "impact/two-spheres"
            impact_cradle "impact/cradle"
            impact_plastic "impact/plastic"
            rest_drift "rest/drift"
            rest_jitter "rest/jitter"
            rest_depth "rest/depth"
            stack_five "stack/five"
            stack_ten "stack/ten"
            stack_mass_ratio "stack/mass-ratio"
            determinism_repeat "determinism/repeat"
            determinism_company "determinism/company"
            metamorphic_rotation "metamorphic/rotation"
            metamorphic_tilt "metamorphic/tilt"
            metamorphic_mirror "metamorphic/mirror"
            metamorphic_translation "metamorphic/translation"
            metamorphic_units "metamorphic/units"
            metamorphic_body_order "metamorphic/body-order"
            metamorphic_galilean "metamorphic/galilean"
            metamorphic_halving "metamorphic/halving"
            solver_certificate "solver/certificate"
            solver_redundant "solver/redundant"
            solver_jamming "solver/jamming"
            solver_friction_range "solver/friction-range"
            solver_conditioning "solver/conditioning"
            solver_infeasible "solver/infeasible"
            projection_regions "projection/regions"
            projection_boundaries "projection/boundaries"
            projection_optimality "projection/optimality"
            incline_stick "incline/stick"
            incline_stick_threshold "incline/stick-threshold"
            incline_slide "incline/slide"
            incline_hop "incline/hop"
            incline_gap "incline/gap"
            rolling_five_sevenths "rolling/five-sevenths"
            rolling_incline "rolling/incline"
            isotropy_deceleration "isotropy/deceleration"
            isotropy_straight "isotropy/straight"
            contact_cone "contact/cone"
            contact_complementarity "contact/complementarity"
            contact_dissipation "contact/dissipation"
            contact_increment "contact/increment"
            contact_momentum "contact/momentum"
            contact_pairs "contact/pairs"
            energy_passive "energy/passive"
            rocking_impact "rocking/impact"
            rocking_fall_time "rocking/fall-time"
            painleve_rod "painleve/rod"
            tumbling_passive "tumbling/passive"
            tumbling_bouncing "tumbling/bouncing"
            tumbling_rough "tumbling/rough"
            tumbling_depth "tumbling/depth"
            tumbling_momentum "tumbling/momentum"
            tumbling_rest "tumbling/rest"
            spin_free_sphere "spin/free-sphere"
            spin_drilling "spin/drilling"
            spin_flat_box "spin/flat-box"
            spin_gyroscopic "spin/gyroscopic"
            limits_fast "limits/fast"
            limits_stick "limits/stick"
            limits_small "limits/small"
            bounce_flat_box "bounce/flat-box"
            bounce_corner "bounce/corner"
            bounce_slow "bounce/slow"
            bounce_every_step "bounce/every-step"
            bounce_spinning_ball "bounce/spinning-ball"
            bounce_separating "bounce/separating"
            bounce_turning_bar "bounce/turning-bar"
            pair_oblique_spheres "pair/oblique-spheres"
            pair_crossed_bars "pair/crossed-bars"
            pair_ball_on_box "pair/ball-on-box"
            pair_material_pairs "pair/material-pairs"
            pair_any_direction "pair/any-direction"
            pair_woken "pair/woken"
            pair_held "pair/held"
            pair_plank_on_plank "pair/plank-on-plank"
            pair_central "pair/central"
            pair_off_centre "pair/off-centre"
            pair_faces "pair/faces"
            pair_rough_corner "pair/rough-corner"
            pair_support_leaves "pair/support-leaves"
            fixed_bounce "fixed/bounce"
            fixed_rest "fixed/rest"
            conveyor_box "conveyor/box"
            conveyor_sphere "conveyor/sphere"
            round_cylinder_incline "round/cylinder-incline"
            round_capsule_incline "round/capsule-incline"
            round_standing "round/standing"
            round_struck "round/struck"
            round_crossed "round/crossed"
        }
    };
    ($engine:ty; $($function:ident $name:literal)*) => {
        $(
            #[test]
            fn $function() {
                $crate::rust_engine::assert_check::<$engine>($name);
            }
        )*
    };
}

#[cfg(test)]
mod tests {
    use crate::{Description, Engine, Options, Reply, checks, own};

    #[derive(Default)]
    struct Projections;

    impl Engine for Projections {
        fn describe(&mut self, options: &Options) -> Reply<Description> {
            let described = own::by_name("moreau-jean").expect("built in").describe(options)?;
            Ok(Description { levels: vec![crate::Level::Project], ..described })
        }

        fn project(&mut self, friction: f64, points: &[Vec<f64>], options: &Options) -> Reply<Vec<Vec<f64>>> {
            own::by_name("moreau-jean").expect("built in").project(friction, points, options)
        }
    }

    crate::gate_tests!(Projections);

    /// Answers every point with itself.
    #[derive(Default)]
    struct Identity;

    impl Engine for Identity {
        fn describe(&mut self, options: &Options) -> Reply<Description> {
            Projections.describe(options)
        }

        fn project(&mut self, _friction: f64, points: &[Vec<f64>], _options: &Options) -> Reply<Vec<Vec<f64>>> {
            Ok(points.to_vec())
        }
    }

    #[test]
    #[should_panic(expected = "fail")]
    fn a_wrong_projection_fails_by_name() {
        super::assert_check::<Identity>("projection/regions");
    }

    #[test]
    fn the_macro_has_every_check_once_in_the_order_of_the_registry() {
        let source = include_str!("rust_engine.rs");
        let (_, arms) = source.split_once("macro_rules!").expect("the macro");
        let (list, _) = arms.split_once("($engine:ty; ").expect("the second arm of the macro");
        let quoted: Vec<&str> = list.split('"').skip(1).step_by(2).filter(|name| name.contains('/')).collect();
        let names: Vec<&str> = checks::all().map(|check| check.name).collect();
        assert_eq!(quoted, names);
    }
}
