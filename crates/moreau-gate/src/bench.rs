//! The bench a check works at: the engine with its description, and replies that have been looked at before they are used.

use crate::any_answer::AnyAnswer;
use crate::description::Friction;
use crate::model::Model;
use crate::model::addition::Addition;
use crate::tolerance::{PERTURBATION, SAME_TIME};
use crate::{Description, Engine, Measurement, Options, Refusal, Reply};
use moreau_contact::problem::{ContactProblem, Solution};
use moreau_dynamics::scenes::Scene;
use moreau_dynamics::trajectory::Trajectory;
use moreau_exact::number::{counted, significant};

/// An engine on the bench, under fixed options.
pub struct Bench<'a> {
    engine: &'a mut dyn Engine,
    description: &'a Description,
    options: &'a Options,
    /// Relative change of gravity and of linear velocities.
    perturbation: f64,
    /// What the check predicts where the engine declares it.
    predicted: &'static [Addition],
    /// What is wrong with any answer.
    any_answer: AnyAnswer,
}

impl<'a> Bench<'a> {
    /// The engine with the description it gave under these options.
    pub fn new(engine: &'a mut dyn Engine, description: &'a Description, options: &'a Options) -> Self {
        Bench { engine, description, options, perturbation: 0.0, predicted: &[], any_answer: AnyAnswer::default() }
    }

    /// The bench of the `repeat`-th measurement: gravity and linear velocities are changed by ±1, ±2, … times 2⁻³⁰ of themselves, which
    /// moves no exact value by more than that and shows how far the engine's numbers scatter. The 0-th is not perturbed.
    pub fn perturbed(mut self, repeat: usize) -> Self {
        let sign = if repeat % 2 == 1 { 1.0 } else { -1.0 };
        self.perturbation = sign * repeat.div_ceil(2) as f64 * PERTURBATION;
        self
    }

    /// What is wrong with the answers, whatever was asked.
    pub fn wrong_in_any_answer(self) -> impl Iterator<Item = Measurement> {
        self.any_answer.wrong()
    }

    /// What the engine said of itself.
    pub fn description(&self) -> &Description {
        self.description
    }

    /// ε of the engine's arithmetic.
    pub fn epsilon(&self) -> f64 {
        self.description.precision.epsilon()
    }

    /// Says which additions to Coulomb's law the check predicts; it is not asked of an engine that declares another one that matters.
    pub fn predicts(&mut self, additions: &'static [Addition]) {
        self.predicted = additions;
    }

    /// Refuses a check whose closed form has no damping to an engine that declares some.
    ///
    /// # Errors
    /// `unsupported`, with that reason.
    pub fn without_damping(&self) -> Reply<()> {
        match Model::of(self.description).damping() {
            Some(_) => Err(Refusal::unsupported("the engine declares damping, which this check does not predict")),
            None => Ok(()),
        }
    }

    /// The motion of a scene over `steps` steps of h \[s\], every `sample_every`-th state; the scene's duration is replaced by steps · h.
    ///
    /// # Errors
    /// `unsupported` if the scene has what the engine does not declare: restitution, friction, a shape, bodies that are not free; if the
    /// time step is so long that there is no step; or as the engine answers. `errored` also if the trajectory does not answer the question:
    /// other bodies, other times, numbers that are not finite. The first state is what the checks and the probe `simulate/initial-state`
    /// look at.
    pub fn simulate(&mut self, scene: &Scene, time_step: f64, steps: usize, sample_every: usize) -> Reply<Trajectory> {
        self.simulate_with(scene, time_step, steps, sample_every, &Options::new())
    }

    /// [`Bench::simulate`] where bodies may sleep, if the engine declares an option for that; `None` if it does not.
    ///
    /// # Errors
    /// Those of [`Bench::simulate`].
    pub fn simulate_sleeping(&mut self, scene: &Scene, time_step: f64, steps: usize, sample_every: usize) -> Reply<Option<Trajectory>> {
        let Some(sleeping) = &self.description.sleeping else { return Ok(None) };
        let on = Options::from_iter([(sleeping.clone(), true.into())]);
        self.simulate_with(scene, time_step, steps, sample_every, &on).map(Some)
    }

    /// [`Bench::simulate`] with further options.
    ///
    /// # Errors
    /// Those of [`Bench::simulate`].
    pub fn simulate_with(&mut self, scene: &Scene, time_step: f64, steps: usize, sample_every: usize, more: &Options) -> Reply<Trajectory> {
        self.can_express(scene)?;
        if steps == 0 {
            let h = significant(time_step);
            let reason = format!("a time step of {h} s is longer than the motion of this check; take shorter ones with `--steps`");
            return Err(Refusal::Unsupported(reason));
        }
        let mut scene = scene.clone();
        scene.duration = steps as f64 * time_step;
        self.perturb(&mut scene);
        scene.validate().map_err(Refusal::errored)?;
        let mut options = self.options.clone();
        if let Some(sleeping) = &self.description.sleeping {
            options.entry(sleeping).or_insert(false.into());
        }
        options.extend(more.clone());
        let trajectory = self.engine.simulate(&scene, time_step, sample_every, &options)?.with_ground_second();
        answers(&trajectory, &scene, time_step, steps, sample_every).map_err(Refusal::Errored)?;
        let may_sleep = self.description.sleeping.as_ref().is_some_and(|option| options.get(option) != Some(&false.into()));
        self.any_answer.look_at(&scene, &trajectory, self.description, may_sleep)?;
        Ok(trajectory)
    }

    /// The engine's answer to a contact problem; sizes are checked, the answer is not judged.
    ///
    /// # Errors
    /// As the engine answers; `errored` if sizes are wrong or numbers not finite.
    pub fn solve(&mut self, problem: &ContactProblem) -> Reply<Solution> {
        let solution = self.engine.solve(problem, self.options)?;
        for (field, vector) in [("impulse", &solution.impulse), ("velocity", &solution.velocity)] {
            if vector.len() != problem.rows() {
                return Err(Refusal::Errored(format!("`{field}` has {} instead of {}", counted(vector.len(), "entry"), problem.rows())));
            }
            if vector.iter().any(|x| !x.is_finite()) {
                return Err(Refusal::Errored(format!("`{field}` is not finite")));
            }
        }
        Ok(solution)
    }

    /// Whether the engine answered what it was asked last, if only with `error` or `unsupported`: see [`Engine::in_conversation`].
    pub fn in_conversation(&self) -> bool {
        self.engine.in_conversation()
    }

    /// The engine's projections of points on the cone ‖t‖ ≤ μ n; sizes are checked.
    ///
    /// # Errors
    /// As the engine answers; `errored` if sizes are wrong or numbers not finite.
    pub fn project(&mut self, friction: f64, points: &[Vec<f64>]) -> Reply<Vec<Vec<f64>>> {
        let projected = self.engine.project(friction, points, self.options)?;
        let same = projected.len() == points.len() && projected.iter().zip(points).all(|(one, other)| one.len() == other.len());
        if !same {
            return Err(Refusal::errored("`points` differs in size from the points of the request"));
        }
        if projected.iter().flatten().any(|x| !x.is_finite()) {
            return Err(Refusal::errored("`points` is not finite"));
        }
        Ok(projected)
    }

    fn perturb(&self, scene: &mut Scene) {
        let velocities = scene.bodies.iter_mut().flat_map(|body| body.linear_velocity.iter_mut());
        for number in velocities.chain(&mut scene.gravity) {
            *number *= 1.0 + self.perturbation;
        }
    }

    fn can_express(&self, scene: &Scene) -> Reply<()> {
        if let Some(reason) = self.description.lacks(scene) {
            return Err(Refusal::unsupported(reason));
        }
        for (addition, name, _, nothing) in Addition::ALL {
            let declared = addition.declared(self.description) != nothing && addition.matters(scene);
            if declared && !self.predicted.contains(&addition) {
                return Err(Refusal::unsupported(format!("the engine declares `{name}`, which this check does not predict")));
            }
        }
        let pairs = &scene.material.pairs;
        let restitution = scene.material.restitution > 0.0 || pairs.iter().any(|pair| pair.restitution.is_some_and(|e| e > 0.0));
        if restitution && !self.description.restitution {
            return Err(Refusal::unsupported("the engine has no coefficient of restitution"));
        }
        let friction = scene.material.friction > 0.0 || pairs.iter().any(|pair| pair.friction.is_some_and(|mu| mu > 0.0));
        if friction && self.description.friction == Friction::None {
            return Err(Refusal::unsupported("the engine has no friction"));
        }
        Ok(())
    }
}

/// Whether a trajectory answers the request, and if not, why.
fn answers(trajectory: &Trajectory, scene: &Scene, time_step: f64, steps: usize, sample_every: usize) -> Result<(), String> {
    trajectory.validate().map_err(|error| error.to_string())?;
    let names = |scene: &Scene| scene.bodies.iter().map(|body| body.name.clone()).collect::<Vec<_>>();
    if names(&trajectory.scene) != names(scene) {
        return Err("the trajectory is of another scene: its bodies differ".into());
    }
    if (trajectory.scene.duration - scene.duration).abs() > SAME_TIME * scene.duration {
        return Err(format!("`scene.duration` is {} instead of the {} of the request", trajectory.scene.duration, scene.duration));
    }
    let samples = steps / sample_every + 1;
    if trajectory.times.len() != samples {
        return Err(format!("the trajectory has {} instead of {samples}", counted(trajectory.times.len(), "sample")));
    }
    for (k, time) in trajectory.times.iter().enumerate() {
        let expected = (k * sample_every) as f64 * time_step;
        if (time - expected).abs() > SAME_TIME * scene.duration {
            return Err(format!("times[{k}] is {time} instead of {expected}"));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::Exact;
    use moreau_dynamics::scenes::{PairOverride, named};
    use moreau_exact::tolerance::rounding;
    use std::sync::{Arc, Mutex};

    /// Answers with bodies that stay where they are, its times stretched by this part, and keeps the scenes it was asked.
    #[derive(Clone, Default)]
    struct Recording {
        late: f64,
        asked: Arc<Mutex<Vec<Scene>>>,
    }

    type Motion = fn(&Scene, usize, f64, f64) -> crate::exact::RigidState;

    fn still() -> Exact<Motion> {
        Exact { motion: |scene, body, _, _| (scene.bodies[body].position, [1.0, 0.0, 0.0, 0.0], [0.0; 3], [0.0; 3]) }
    }

    impl Engine for Recording {
        fn describe(&mut self, options: &Options) -> Reply<Description> {
            still().describe(options)
        }

        fn simulate(&mut self, scene: &Scene, h: f64, every: usize, options: &Options) -> Reply<Trajectory> {
            self.asked.lock().expect("no panic").push(scene.clone());
            let mut answer = still().simulate(scene, h, every, options)?;
            answer.times.iter_mut().skip(1).for_each(|time| *time += self.late);
            Ok(answer)
        }
    }

    fn asked(late: f64, repeat: usize) -> (Reply<Trajectory>, Scene) {
        let mut engine = Recording { late, ..Recording::default() };
        let (options, asked) = (Options::new(), engine.asked.clone());
        let description = engine.describe(&options).expect("describes itself");
        let scene = named("two-ball-impact").expect("built in");
        let answer = Bench::new(&mut engine, &description, &options).perturbed(repeat).simulate(&scene, 0.25, 8, 2);
        let asked = asked.lock().expect("no panic").remove(0);
        (answer, asked)
    }

    #[test]
    fn a_time_is_late_beyond_a_billionth_of_the_duration() {
        // The duration is 2 s. The limit is the protocol's, written out: a looser one would not be seen.
        assert!(asked(1.9e-9, 0).0.is_ok());
        let Err(Refusal::Errored(cause)) = asked(2.1e-9, 0).0 else { panic!("a time was wrong and nobody saw it") };
        assert!(cause.starts_with("times[1] is"), "{cause}");
    }

    #[test]
    fn a_step_that_is_longer_than_the_motion_is_told_as_that_and_the_engine_is_not_asked() {
        let mut engine = Recording::default();
        let (options, asked) = (Options::new(), engine.asked.clone());
        let description = engine.describe(&options).expect("describes itself");
        let scene = named("two-ball-impact").expect("built in");
        let answer = Bench::new(&mut engine, &description, &options).simulate(&scene, 10.0, 0, 1);
        let Err(Refusal::Unsupported(reason)) = answer else { panic!("{answer:?}") };
        assert!(reason.contains("time step of 10 s") && reason.contains("`--steps`") && asked.lock().expect("no panic").is_empty());
    }

    #[test]
    fn a_trajectory_that_goes_on_after_the_end_is_refused() {
        struct GoesOn;
        impl Engine for GoesOn {
            fn describe(&mut self, options: &Options) -> Reply<Description> {
                still().describe(options)
            }
            fn simulate(&mut self, scene: &Scene, h: f64, every: usize, options: &Options) -> Reply<Trajectory> {
                let longer = Scene { duration: scene.duration + h * every as f64, ..scene.clone() };
                Ok(Trajectory { scene: scene.clone(), ..still().simulate(&longer, h, every, options)? })
            }
        }
        let options = Options::new();
        let description = GoesOn.describe(&options).expect("describes itself");
        let scene = named("two-ball-impact").expect("built in");
        let Err(Refusal::Errored(cause)) = Bench::new(&mut GoesOn, &description, &options).simulate(&scene, 0.25, 8, 2) else {
            panic!("a sample too many was not seen")
        };
        assert!(cause.contains("6 samples instead of 5"), "{cause}");
    }

    #[test]
    fn what_a_pair_alone_has_is_not_asked_of_an_engine_without_it() {
        let plain = named("two-ball-impact").expect("built in");
        let names = [0, 1].map(|k| plain.bodies[k].name.clone());
        let ask = |friction: Option<f64>, restitution: Option<f64>| {
            let mut scene = plain.clone();
            (scene.material.friction, scene.material.restitution) = (0.0, 0.0);
            scene.material.pairs = vec![PairOverride { bodies: names.clone(), friction, restitution }];
            let mut engine = Recording::default();
            let options = Options::new();
            let described = engine.describe(&options).expect("describes itself");
            let without = Description { restitution: false, friction: Friction::None, ..described };
            Bench::new(&mut engine, &without, &options).simulate(&scene, 0.25, 8, 2)
        };
        assert!(ask(Some(0.0), Some(0.0)).is_ok());
        for (friction, restitution, word) in [(Some(0.5), None, "friction"), (None, Some(0.5), "restitution")] {
            let Err(Refusal::Unsupported(reason)) = ask(friction, restitution) else { panic!("{word} was asked for") };
            assert!(reason.contains(word), "{reason}");
        }
    }

    #[test]
    fn repeats_move_gravity_and_velocities_by_billionths_up_and_down_and_the_first_moves_nothing() {
        let plain = Scene { duration: 2.0, ..named("two-ball-impact").expect("built in") };
        assert_eq!(asked(0.0, 0).1, plain);
        let numbers = |scene: &Scene| -> Vec<f64> {
            scene.bodies.iter().flat_map(|body| body.linear_velocity).chain(scene.gravity).filter(|x| *x != 0.0).collect()
        };
        let before = numbers(&plain);
        assert!(!before.is_empty());
        let billionth = 1.0 / f64::from(1u32 << 30);
        for (repeat, part) in [(1, billionth), (2, -billionth), (3, 2.0 * billionth), (4, -2.0 * billionth)] {
            for (x, y) in before.iter().zip(numbers(&asked(0.0, repeat).1)) {
                assert!((y / x - 1.0 - part).abs() <= rounding(4, 1.0), "repeat {repeat}: {x} became {y}");
            }
        }
    }

    #[test]
    fn bodies_sleep_only_where_a_check_asks_for_it() {
        struct Asked(Arc<Mutex<Vec<Options>>>);
        impl Engine for Asked {
            fn describe(&mut self, options: &Options) -> Reply<Description> {
                Ok(Description { sleeping: Some("sleep".into()), ..still().describe(options)? })
            }
            fn simulate(&mut self, scene: &Scene, h: f64, every: usize, options: &Options) -> Reply<Trajectory> {
                self.0.lock().expect("no panic").push(options.clone());
                still().simulate(scene, h, every, options)
            }
        }
        let asked = Arc::new(Mutex::new(Vec::new()));
        let (mut engine, options) = (Asked(asked.clone()), Options::new());
        let description = engine.describe(&options).expect("describes itself");
        let scene = named("two-ball-impact").expect("built in");
        let mut bench = Bench::new(&mut engine, &description, &options);
        bench.simulate(&scene, 0.25, 4, 1).expect("answers");
        assert!(bench.simulate_sleeping(&scene, 0.25, 4, 1).expect("answers").is_some());
        let asked: Vec<_> = asked.lock().expect("no panic").iter().map(|options| options["sleep"].clone()).collect();
        assert_eq!(asked, [false, true]);
    }

    #[test]
    fn an_addition_to_coulombs_law_is_predicted_or_the_check_is_not_asked() {
        let mut engine = Recording::default();
        let options = Options::new();
        let mut description = engine.describe(&options).expect("describes itself");
        let length =
            crate::Parameter { value: crate::description::OneOrMany::One(0.001), unit: crate::description::OneOrMany::One("m".into()) };
        description.contact_model.parameters.insert("rolling_friction".into(), length);
        let scene = named("two-ball-impact").expect("built in");
        let mut bench = Bench::new(&mut engine, &description, &options);
        let refused = bench.simulate(&scene, 0.25, 8, 2);
        assert!(matches!(refused, Err(Refusal::Unsupported(reason)) if reason.contains("`rolling_friction`")));
        bench.predicts(&[Addition::RollingFriction]);
        assert!(bench.simulate(&scene, 0.25, 8, 2).is_ok());
        let alone = Scene { bodies: scene.bodies[..1].to_vec(), ..scene };
        assert!(Bench::new(&mut engine, &description, &options).simulate(&alone, 0.25, 8, 2).is_ok(), "nothing touches");
    }

    #[test]
    fn a_scene_with_what_the_engine_does_not_declare_is_never_sent() {
        use crate::description::{BodyKind, ShapeKind};
        let mut engine = Recording::default();
        let options = Options::new();
        let all = engine.describe(&options).expect("describes itself");
        let mut scene = named("two-ball-impact").expect("built in");
        scene.bodies[1] = scene.bodies[1].clone().driven([0.5, 0.0, 0.0]);
        let asked = engine.asked.clone();
        let mut refused = |description: &Description| match Bench::new(&mut engine, description, &options).simulate(&scene, 0.25, 8, 2) {
            Err(Refusal::Unsupported(reason)) => reason,
            other => panic!("{other:?}"),
        };
        assert!(refused(&Description { bodies: BodyKind::free(), ..all.clone() }).contains("`prescribed`"));
        assert!(refused(&Description { shapes: vec![ShapeKind::Box], ..all.clone() }).contains("`sphere`"));
        assert!(asked.lock().expect("no panic").is_empty());
        assert!(Bench::new(&mut engine, &all, &options).simulate(&scene, 0.25, 8, 2).is_ok());
    }

    #[test]
    fn an_engine_that_declares_damping_is_asked_nothing_that_has_none() {
        let mut engine = Recording::default();
        let options = Options::new();
        let mut description = engine.describe(&options).expect("describes itself");
        assert_eq!(Bench::new(&mut engine, &description, &options).without_damping(), Ok(()));
        let rate =
            crate::Parameter { value: crate::description::OneOrMany::One(0.1), unit: crate::description::OneOrMany::One("1/s".into()) };
        description.contact_model.parameters.insert("angular_damping".into(), rate);
        let refused = Bench::new(&mut engine, &description, &options).without_damping();
        assert!(matches!(refused, Err(Refusal::Unsupported(reason)) if reason.contains("damping")));
    }
}
