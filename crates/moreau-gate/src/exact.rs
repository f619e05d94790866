//! An engine that answers with a motion in closed form, which a check must pass before anything else, and ours with changed reports.

use crate::description::{BodyKind, Friction, OneOrMany, Precision, ShapeKind};
use crate::{ContactModel, Description, Engine, Kind, Level, Options, Reply};
use moreau_dynamics::scenes::Scene;
use moreau_dynamics::trajectory::{BodyTrack, Trajectory};

/// Position, orientation \[w, x, y, z\], velocity and angular velocity of one body.
pub(crate) type RigidState = ([f64; 3], [f64; 4], [f64; 3], [f64; 3]);

/// The engine whose bodies move as `motion(scene, body, h, t)` says.
pub(crate) struct Exact<F> {
    /// The motion.
    pub motion: F,
}

impl<F: Fn(&Scene, usize, f64, f64) -> RigidState + Send> Engine for Exact<F> {
    fn describe(&mut self, _options: &Options) -> Reply<Description> {
        Ok(Description {
            name: "exact".into(),
            version: "0".into(),
            precision: Precision::Double,
            contact_model: ContactModel { kind: Kind::Rigid, law: Some("coulomb".into()), parameters: Default::default() },
            restitution: true,
            friction: Friction::Cone,
            reports_contacts: false,
            levels: vec![Level::Simulate],
            laws: Vec::new(),
            shapes: ShapeKind::ALL.to_vec(),
            bodies: BodyKind::ALL.to_vec(),
            sleeping: None,
            options: Options::new(),
        })
    }

    fn simulate(&mut self, scene: &Scene, h: f64, every: usize, _options: &Options) -> Reply<Trajectory> {
        let samples = (scene.duration / (h * every as f64)).round() as usize;
        let times: Vec<f64> = (0..=samples).map(|k| (k * every) as f64 * h).collect();
        let bodies = scene.bodies.iter().enumerate().map(|(index, body)| self.track(scene, index, &body.name, h, &times)).collect();
        Ok(Trajectory {
            schema: moreau_dynamics::trajectory::SCHEMA.into(),
            scene: scene.clone(),
            engine: moreau_dynamics::trajectory::Producer { name: "exact".into(), version: "0".into(), options: Options::new() },
            time_step: h,
            times,
            bodies,
            contacts: Vec::new(),
            steps: None,
            provenance: None,
        })
    }
}

impl<F: Fn(&Scene, usize, f64, f64) -> RigidState> Exact<F> {
    fn track(&self, scene: &Scene, index: usize, name: &str, h: f64, times: &[f64]) -> BodyTrack {
        let states: Vec<RigidState> = times.iter().map(|t| (self.motion)(scene, index, h, *t)).collect();
        BodyTrack {
            name: name.into(),
            position: states.iter().map(|state| state.0).collect(),
            orientation: states.iter().map(|state| state.1).collect(),
            linear_velocity: states.iter().map(|state| state.2).collect(),
            angular_velocity: states.iter().map(|state| state.3).collect(),
        }
    }
}

/// Our Moreau–Jean engine, whose motions are changed before they are reported.
pub(crate) struct Reporting<F>(pub F);

impl<F: FnMut(&mut Trajectory) + Send> Engine for Reporting<F> {
    fn describe(&mut self, options: &Options) -> Reply<Description> {
        crate::own::by_name("moreau-jean").expect("listed").describe(options)
    }

    fn simulate(&mut self, scene: &Scene, h: f64, every: usize, options: &Options) -> Reply<Trajectory> {
        let mut motion = crate::own::by_name("moreau-jean").expect("listed").simulate(scene, h, every, options)?;
        (self.0)(&mut motion);
        Ok(motion)
    }
}

/// The measurements of a check on an engine at h, as the engine describes itself.
pub(crate) fn measure(check: &str, h: f64, engine: &mut dyn Engine) -> Vec<crate::Measurement> {
    let options = Options::new();
    let description = engine.describe(&options).expect("describes itself");
    ask(check, h, &mut crate::Bench::new(engine, &description, &options)).expect("answers")
}

fn ask(check: &str, h: f64, bench: &mut crate::Bench) -> Reply<Vec<crate::Measurement>> {
    match crate::checks::find(check).expect("a registered check").run {
        crate::Run::EachStep(run) => run(bench, h),
        crate::Run::Once(run) => run(bench),
    }
}

/// The measurements of a check on a motion at h, with their verdicts.
pub(crate) fn judge<F: Fn(&Scene, usize, f64, f64) -> RigidState + Send>(check: &str, h: f64, motion: F) -> Vec<crate::Measurement> {
    judge_declaring(check, h, &[], motion)
}

/// The same of an engine that declares these numbers, with their units.
pub(crate) fn judge_declaring<F: Fn(&Scene, usize, f64, f64) -> RigidState + Send>(
    check: &str,
    h: f64,
    declared: &[(&str, f64, &str)],
    motion: F,
) -> Vec<crate::Measurement> {
    answer_declaring(check, h, declared, motion).expect("an exact engine answers")
}

/// Why a check is not asked of an engine that declares these numbers, if it is not; where it is, its bodies stay where they are.
pub(crate) fn refusal(check: &str, h: f64, declared: &[(&str, f64, &str)]) -> Option<String> {
    let still = |scene: &Scene, index: usize, _: f64, _: f64| {
        let body = &scene.bodies[index];
        (body.position, body.orientation, [0.0; 3], [0.0; 3])
    };
    match answer_declaring(check, h, declared, still) {
        Err(crate::Refusal::Unsupported(reason)) => Some(reason),
        answer => {
            answer.expect("an engine whose bodies stay answers");
            None
        }
    }
}

/// What is found at the bench of a rigid engine that declares a pyramid within or around the cone.
pub(crate) fn declaring_a_pyramid<T>(find: impl FnOnce(&crate::Bench) -> T) -> T {
    let mut engine = crate::own::by_name("moreau-jean").expect("listed");
    let options = Options::new();
    let described = engine.describe(&options).expect("our own engine describes itself");
    let description = Description { friction: Friction::Pyramid, ..described };
    find(&crate::Bench::new(&mut engine, &description, &options))
}

fn answer_declaring<F: Fn(&Scene, usize, f64, f64) -> RigidState + Send>(
    check: &str,
    h: f64,
    declared: &[(&str, f64, &str)],
    motion: F,
) -> Reply<Vec<crate::Measurement>> {
    let mut engine = Exact { motion };
    let options = Options::new();
    let mut description = engine.describe(&options).expect("an exact engine describes itself");
    for (name, value, unit) in declared {
        let parameter = crate::Parameter { value: OneOrMany::One(*value), unit: OneOrMany::One((*unit).into()) };
        description.contact_model.parameters.insert((*name).into(), parameter);
    }
    ask(check, h, &mut crate::Bench::new(&mut engine, &description, &options))
}
