//! What an engine may declare beyond Coulomb's law of a point with Newton's e; a check predicts it, or is not asked.
//!
//! ```text
//!     static_friction           μ_s/μ        a contact that sticks holds up to μ_s p_n, one that slides has μ p_n
//!     torsional_friction        a \[m\]      a moment about the normal of at most a p_n
//!     rolling_friction          a \[m\]      a moment across the normal of at most a p_n
//!     tangential_restitution    κ            u_t⁺ = −κ e u_t of a contact that sticks in an impact; 1 is Moreau's law of the whole vector
//! ```

use crate::Description;
use moreau_dynamics::scenes::Scene;

/// One such declaration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Addition {
    /// More friction at rest than while sliding.
    StaticFriction,
    /// Friction against turning about the normal.
    TorsionalFriction,
    /// Friction against rolling.
    RollingFriction,
    /// Restitution of the tangential velocity.
    TangentialRestitution,
}

impl Addition {
    /// All of them, with the names of their parameters, their units, and the numbers that add nothing.
    pub const ALL: [(Addition, &'static str, &'static str, f64); 4] = [
        (Addition::StaticFriction, "static_friction", "1", 1.0),
        (Addition::TorsionalFriction, "torsional_friction", "m", 0.0),
        (Addition::RollingFriction, "rolling_friction", "m", 0.0),
        (Addition::TangentialRestitution, "tangential_restitution", "1", 0.0),
    ];

    fn row(self) -> (&'static str, f64) {
        Addition::ALL.into_iter().find(|row| row.0 == self).map_or(("", 0.0), |(_, name, _, nothing)| (name, nothing))
    }

    /// The name of its parameter.
    pub fn name(self) -> &'static str {
        self.row().0
    }

    /// The declared number, or the one that adds nothing.
    pub fn declared(self, description: &Description) -> f64 {
        let (name, nothing) = self.row();
        description.contact_model.number(name).unwrap_or(nothing)
    }

    /// Whether it may change what happens in a scene: bodies that can touch, with friction or restitution where it needs one.
    pub fn matters(self, scene: &Scene) -> bool {
        let pairs = &scene.material.pairs;
        let friction = scene.material.friction > 0.0 || pairs.iter().any(|pair| pair.friction.is_some_and(|mu| mu > 0.0));
        let restitution = scene.material.restitution > 0.0 || pairs.iter().any(|pair| pair.restitution.is_some_and(|e| e > 0.0));
        let touching = scene.ground.is_some() || scene.bodies.len() > 1;
        touching
            && match self {
                Addition::StaticFriction => friction,
                Addition::TorsionalFriction | Addition::RollingFriction => true,
                Addition::TangentialRestitution => friction && restitution,
            }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::description::OneOrMany;
    use crate::own::{OwnEngine, OwnParameters, by_name};
    use crate::runner::{self, QUICK};
    use crate::{CheckOutcome, Engine, Options, Parameter, Plan, Reply, Verdict, checks};
    use moreau_dynamics::schemes::{MoreauJean, RestitutionRule, Scheme};
    use moreau_dynamics::trajectory::Trajectory;

    /// An engine that declares an addition, honestly or not.
    struct Declares {
        engine: Box<dyn Engine>,
        addition: Option<(&'static str, f64, &'static str)>,
    }

    impl Engine for Declares {
        fn describe(&mut self, options: &Options) -> Reply<Description> {
            let mut description = self.engine.describe(options)?;
            if let Some((name, value, unit)) = self.addition {
                let parameter = Parameter { value: OneOrMany::One(value), unit: OneOrMany::One(unit.into()) };
                description.contact_model.parameters.insert(name.into(), parameter);
            }
            Ok(description)
        }

        fn simulate(&mut self, scene: &Scene, h: f64, every: usize, options: &Options) -> Reply<Trajectory> {
            self.engine.simulate(scene, h, every, options)
        }
    }

    fn judged(check: &str, make: &(dyn Fn() -> Declares + Sync)) -> CheckOutcome {
        let checks = vec![checks::find(check).expect("a registered check")];
        let plan = Plan { checks, sweep: QUICK.to_vec(), options: Options::new(), jobs: 1, repeats: 1, progress: &|| {} };
        runner::run(&|| Box::new(make()), &plan).expect("it describes itself").checks.remove(0)
    }

    /// Moreau's law of the whole vector.
    fn full_vector(addition: Option<(&'static str, f64, &'static str)>) -> Declares {
        let scheme = |_: &OwnParameters| -> moreau_exact::Result<Box<dyn Scheme>> {
            Ok(Box::new(MoreauJean { restitution: RestitutionRule::FullVector, ..MoreauJean::default() }))
        };
        Declares { engine: Box::new(OwnEngine { scheme, ..by_name("moreau-jean").expect("listed") }), addition }
    }

    #[test]
    fn an_addition_matters_where_bodies_can_touch_with_what_it_adds_to() {
        use moreau_dynamics::scenes::{PairOverride, named};
        let scene = |ground: bool, bodies: usize, [friction, restitution]: [f64; 2]| {
            let mut scene = named("two-ball-impact").expect("built in");
            scene.ground = named("ball-drop").expect("built in").ground.filter(|_| ground);
            scene.bodies.truncate(bodies);
            (scene.material.friction, scene.material.restitution) = (friction, restitution);
            scene
        };
        let matter = |scene: &Scene| Addition::ALL.map(|(addition, ..)| addition.matters(scene));
        assert_eq!(matter(&scene(false, 1, [0.5, 0.5])), [false; 4], "nothing touches");
        for touching in [scene(true, 1, [0.5, 0.5]), scene(false, 2, [0.5, 0.5]), scene(true, 2, [0.5, 0.5])] {
            assert_eq!(matter(&touching), [true; 4]);
        }
        assert_eq!(matter(&scene(true, 1, [0.0, 0.5])), [false, true, true, false]);
        assert_eq!(matter(&scene(true, 1, [0.5, 0.0])), [true, true, true, false]);
        // what a pair alone has
        let mut paired = scene(false, 2, [0.0, 0.0]);
        let bodies = [0, 1].map(|k| paired.bodies[k].name.clone());
        paired.material.pairs = vec![PairOverride { bodies, friction: Some(0.5), restitution: Some(0.5) }];
        assert_eq!(matter(&paired), [true; 4]);
    }

    #[test]
    fn moreaus_law_of_the_whole_vector_is_a_difference_where_it_is_declared_and_a_failure_where_not() {
        for check in ["bounce/spinning-ball", "fixed/bounce"] {
            let declared = judged(check, &|| full_vector(Some(("tangential_restitution", 1.0, "1"))));
            assert_eq!(declared.verdict, Verdict::Difference, "{declared:?}");
            assert_eq!(judged(check, &|| full_vector(None)).verdict, Verdict::Fail, "{check}");
        }
    }

    #[test]
    fn what_sticks_longer_is_a_difference_where_it_is_declared_and_a_failure_where_not() {
        let planted = crate::planted::find("limits/static-friction").expect("listed");
        let sticking = |addition| Declares { engine: (planted.subject.engine)(), addition };
        let declared = judged("limits/stick", &|| sticking(Some(("static_friction", 1.05, "1"))));
        assert_eq!(declared.verdict, Verdict::Difference, "{declared:?}");
        assert_eq!(judged("limits/stick", &|| sticking(None)).verdict, Verdict::Fail);
    }

    #[test]
    fn what_is_declared_and_not_done_fails_where_it_is_predicted_and_is_not_asked_elsewhere() {
        let own = |addition| Declares { engine: Box::new(by_name("moreau-jean").expect("listed")), addition: Some(addition) };
        let cases = [
            ("spin/drilling", ("torsional_friction", 0.01, "m"), "pair/oblique-spheres"),
            ("rolling/incline", ("rolling_friction", 0.01, "m"), "conveyor/sphere"),
            ("rolling/five-sevenths", ("rolling_friction", 0.01, "m"), "impact/two-spheres"),
            ("spin/flat-box", ("torsional_friction", 0.01, "m"), "pair/woken"),
            ("incline/stick-threshold", ("static_friction", 1.25, "1"), "isotropy/deceleration"),
        ];
        for (predicted, addition, other) in cases {
            // our engine has no such friction, and does not do what it declares
            assert_eq!(judged(predicted, &|| own(addition)).verdict, Verdict::Fail, "{predicted}");
            let outcome = judged(other, &|| own(addition));
            assert_eq!(outcome.verdict, Verdict::Unsupported, "{other}");
            assert!(outcome.reason.is_some_and(|reason| reason.contains(addition.0)), "{other}");
        }
    }
}
