//! Engines that no law knows, put to every check: bounds that such answers meet ask for nothing.
//!
//! ```text
//!     frozen     x(t) = x₀ ,  v = ω = 0 for t > 0 ;       r = 0 ;   every point is its own projection
//!     falling    x(t) = x₀ + v₀ t + ½ g t² ,  ω = ω₀ ;     r = 0 ;   every projection is 0
//!     doubled    the motion of a sound engine with 2 v and 2 ω ;   2 r and 2 u ;   twice the projection
//!     wandering  the motion of a sound engine, in the n-th answer with n t (1, 1, 0) m/s besides
//! ```

use crate::any_answer::is_of_any_answer;
use crate::runner::run;
use crate::{CheckOutcome, Description, Engine, Options, Plan, Reply, StepOutcome, Verdict, checks, own};
use moreau_contact::problem::{ContactProblem, Solution};
use moreau_dynamics::scenes::Scene;
use moreau_dynamics::trajectory::Trajectory;
use nalgebra::{Quaternion, UnitQuaternion, Vector3};

/// What is wrong with everything.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Absurd {
    Frozen,
    Falling,
    Doubled,
    Wandering,
}

use Absurd::{Doubled, Falling, Frozen, Wandering};

/// A step at which every check is asked.
const STEP: f64 = 1.0 / 240.0;

/// Checks that hold an engine against itself.
const COVARIANT: &[&str] = &[
    "determinism/repeat",
    "determinism/company",
    "metamorphic/rotation",
    "metamorphic/tilt",
    "metamorphic/mirror",
    "metamorphic/translation",
    "metamorphic/units",
    "metamorphic/body-order",
    "metamorphic/halving",
];

/// Absurd answers that checks take, because they are right where these look.
const RIGHT: &[(Absurd, &str, &[&str])] = &[
    (
        Frozen,
        "what is at rest has not moved",
        &[
            "rest/drift",
            "rest/jitter",
            "rest/depth",
            "stack/five",
            "stack/ten",
            "incline/stick",
            "limits/small",
            "incline/hop",
            "incline/gap",
            "pair/held",
            "fixed/rest",
            "round/standing",
        ],
    ),
    (Frozen, "every answer is the same, in every frame that is at rest", COVARIANT),
    (
        Frozen,
        "neither energy nor depth nor a turn appears; `isotropy/deceleration` sees that nothing slid, `tumbling/rest` that nothing fell",
        &["isotropy/straight", "energy/passive", "tumbling/passive", "tumbling/bouncing", "tumbling/rough", "tumbling/depth"],
    ),
    (Frozen, "there is no answer to be right", &["solver/infeasible"]),
    (
        Falling,
        "these bodies are free, or not touched",
        &[
            "flight/projectile",
            "flight/momentum",
            "spin/free-sphere",
            "spin/gyroscopic",
            "limits/fast",
            "bounce/separating",
            "metamorphic/galilean",
        ],
    ),
    (Falling, "free flight is the same in every frame and at every step", COVARIANT),
    (
        Falling,
        "free flight keeps energy, spin and place along the floor, and does not rebound; the checks of depth see it",
        &[
            "ball/effective-restitution",
            "rest/drift",
            "isotropy/straight",
            "energy/passive",
            "tumbling/passive",
            "tumbling/bouncing",
            "tumbling/rough",
            "spin/drilling",
        ],
    ),
    (
        Falling,
        "v_t + μ v_n is the same for all normal impulses, none included; `pair/ball-on-box` sees what falls",
        &["pair/plank-on-plank"],
    ),
    (Falling, "there is no answer to be right", &["solver/infeasible"]),
    (
        Doubled,
        "only ratios of velocities are read",
        &["ball/restitution", "ball/zeno", "ball/effective-restitution", "contact/dissipation"],
    ),
    (
        Doubled,
        "only places, orientations and impulses are read, or velocities of what rests",
        &[
            "ball/energy",
            "ball/penetration",
            "rest/drift",
            "rest/jitter",
            "rest/depth",
            "stack/five",
            "stack/ten",
            "stack/mass-ratio",
            "incline/stick",
            "limits/small",
            "incline/hop",
            "incline/gap",
            "isotropy/straight",
            "contact/cone",
            "rocking/impact",
            "rocking/fall-time",
            "tumbling/depth",
            "tumbling/rest",
            "spin/free-sphere",
            "pair/held",
            "fixed/rest",
            "round/standing",
        ],
    ),
    (Doubled, "the sign is that of the motion", &["contact/complementarity", "contact/increment"]),
    (Doubled, "twice a motion is as repeatable and as covariant as the motion", COVARIANT),
    (
        Wandering,
        "nothing is read along the floor",
        &[
            "ball/restitution",
            "ball/energy",
            "ball/zeno",
            "ball/penetration",
            "ball/effective-restitution",
            "rest/depth",
            "incline/hop",
            "tumbling/depth",
            "bounce/slow",
            "bounce/every-step",
            "bounce/separating",
        ],
    ),
    (
        Wandering,
        "only orientations and spins are read",
        &["flight/spinning-box", "rocking/fall-time", "spin/free-sphere", "spin/drilling", "spin/flat-box", "spin/gyroscopic"],
    ),
    (
        Wandering,
        "only impulses are read, or the work of friction that has become smaller",
        &["contact/cone", "contact/complementarity", "contact/increment"],
    ),
    (Wandering, "the acceleration is that of the motion", &["rolling/incline", "round/cylinder-incline", "round/capsule-incline"]),
    (Wandering, "what moves both bodies keeps their distance, and lifts them off the slope", &["pair/held"]),
    (Wandering, "there is no answer to be right", &["solver/infeasible"]),
];

fn is_right(check: &str, absurd: Absurd) -> bool {
    RIGHT.iter().any(|(one, _, checks)| *one == absurd && checks.contains(&check))
}

/// Answers absurdly; it describes itself as the sound engine does whose motion is doubled.
struct Engineless {
    absurd: Absurd,
    sound: own::OwnEngine,
    answers: usize,
}

impl Engineless {
    fn new(absurd: Absurd) -> Self {
        Engineless { absurd, sound: own::by_name("moreau-jean").expect("listed"), answers: 0 }
    }
}

impl Engine for Engineless {
    fn describe(&mut self, options: &Options) -> Reply<Description> {
        self.sound.describe(options)
    }

    fn simulate(&mut self, scene: &Scene, h: f64, every: usize, options: &Options) -> Reply<Trajectory> {
        let mut motion = self.sound.simulate(scene, h, every, options)?;
        self.answers += 1;
        let aside = Vector3::new(1.0, 1.0, 0.0) * self.answers as f64;
        let gravity = Vector3::from(scene.gravity);
        for track in &mut motion.bodies {
            for k in 1..motion.times.len() {
                let time = motion.times[k];
                match self.absurd {
                    Frozen => {
                        track.position[k] = track.position[0];
                        track.orientation[k] = track.orientation[0];
                        track.linear_velocity[k] = [0.0; 3];
                        track.angular_velocity[k] = [0.0; 3];
                    }
                    Falling => {
                        let [start, velocity, spin] =
                            [track.position[0], track.linear_velocity[0], track.angular_velocity[0]].map(Vector3::from);
                        let [w, x, y, z] = track.orientation[0];
                        let turned = UnitQuaternion::from_scaled_axis(spin * time).into_inner() * Quaternion::new(w, x, y, z);
                        track.position[k] = (start + velocity * time + gravity * (0.5 * time * time)).into();
                        track.orientation[k] = [turned.w, turned.i, turned.j, turned.k];
                        track.linear_velocity[k] = (velocity + gravity * time).into();
                        track.angular_velocity[k] = spin.into();
                    }
                    Doubled => {
                        track.linear_velocity[k] = track.linear_velocity[k].map(|v| 2.0 * v);
                        track.angular_velocity[k] = track.angular_velocity[k].map(|w| 2.0 * w);
                    }
                    Wandering => {
                        track.position[k] = (Vector3::from(track.position[k]) + aside * time).into();
                        track.linear_velocity[k] = (Vector3::from(track.linear_velocity[k]) + aside).into();
                    }
                }
            }
        }
        if matches!(self.absurd, Frozen | Falling) {
            motion.contacts.clear();
        }
        Ok(motion)
    }

    fn solve(&mut self, problem: &ContactProblem, options: &Options) -> Reply<Solution> {
        let mut answer = self.sound.solve(problem, options)?;
        match self.absurd {
            Doubled => {
                answer.impulse *= 2.0;
                answer.velocity *= 2.0;
            }
            Frozen | Falling | Wandering => {
                answer.impulse.fill(0.0);
                answer.velocity.copy_from(problem.free_velocity());
            }
        }
        Ok(answer)
    }

    fn project(&mut self, friction: f64, points: &[Vec<f64>], options: &Options) -> Reply<Vec<Vec<f64>>> {
        let factor = match self.absurd {
            Frozen => return Ok(points.to_vec()),
            Falling | Wandering => 0.0,
            Doubled => 2.0,
        };
        let projected = self.sound.project(friction, points, options)?;
        Ok(projected.into_iter().map(|point| point.into_iter().map(|x| factor * x).collect()).collect())
    }
}

/// What the check itself found, without what every answer is asked.
fn own_outcome(outcome: CheckOutcome) -> CheckOutcome {
    let own = |step: StepOutcome| match step.reason {
        None => {
            let asked = step.measurements.into_iter().filter(|one| !is_of_any_answer(one)).collect();
            StepOutcome::new(step.time_step, Ok(asked))
        }
        Some(_) => step,
    };
    CheckOutcome::new(&outcome.check, outcome.steps.into_iter().map(own).collect())
}

#[test]
fn what_rests_without_impulses_fails_checks_that_ask_for_none() {
    let make = || -> Box<dyn Engine> { Box::new(Engineless::new(Frozen)) };
    let checks = ["rest/drift", "stack/five"].map(|name| checks::all().find(|check| check.name == name).expect("a check")).to_vec();
    let plan = Plan { checks, sweep: vec![STEP], options: Options::new(), jobs: 1, repeats: 1, progress: &|| {} };
    for outcome in run(&make, &plan).expect("it describes itself").checks {
        assert!(outcome.steps[0].measurements.iter().any(is_of_any_answer), "{}", outcome.check);
        assert_eq!((outcome.verdict, own_outcome(outcome).verdict), (Verdict::Fail, Verdict::Pass));
    }
}

/// In one step of 0.1 s our own ball does not touch the floor yet, from which no friction can be told.
#[test]
fn a_push_of_one_step_without_contact_is_no_question_and_one_of_ten_is() {
    let check = checks::all().find(|check| check.name == "isotropy/deceleration").expect("a check");
    let make = || -> Box<dyn Engine> { Box::new(own::by_name("moreau-jean").expect("built in")) };
    for (h, expected) in [(0.1, Verdict::Unsupported), (0.01, Verdict::Pass)] {
        let plan = Plan { checks: vec![check], sweep: vec![h], options: Options::new(), jobs: 1, repeats: 1, progress: &|| {} };
        assert_eq!(run(&make, &plan).expect("it describes itself").checks[0].verdict, expected, "{h}");
    }
}

#[test]
fn every_check_fails_what_no_law_knows_or_says_why_not() {
    let mut wrong = String::new();
    for absurd in [Frozen, Falling, Doubled, Wandering] {
        let make = || -> Box<dyn Engine> { Box::new(Engineless::new(absurd)) };
        let plan =
            Plan { checks: checks::all().collect(), sweep: vec![STEP], options: Options::new(), jobs: 1, repeats: 1, progress: &|| {} };
        for outcome in run(&make, &plan).expect("it describes itself").checks.into_iter().map(own_outcome) {
            let right = is_right(&outcome.check, absurd);
            let taken = matches!(outcome.verdict, Verdict::Pass | Verdict::Difference);
            if taken != right {
                wrong += &format!("{absurd:?}: {} is {}\n", outcome.check, outcome.verdict.word());
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
}

#[test]
fn every_check_fails_one_absurd_engine_at_least() {
    for check in checks::all() {
        let taken = [Frozen, Falling, Doubled, Wandering].into_iter().all(|absurd| is_right(check.name, absurd));
        assert!(!taken, "{} fails nothing", check.name);
    }
}
