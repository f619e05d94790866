//! Planted defects of the family `energy-balance`: one step of a scheme, altered after it was made or in the problem it posed.

use crate::energy_balance::reach::Reach;
use crate::energy_balance::{Balance, Taken};
use crate::schemes::{SchemeParameters, by_name};
use moreau_checks::Finding;
use moreau_checks::planted::{Beside, Kind, Planted};
use moreau_contact::problem::ContactProblem;
use moreau_contact::solvers::Auto;
use moreau_dynamics::mechanics::spatial::{Shape, SpatialBody};
use moreau_dynamics::mechanics::{Mechanism, OscillatorWithStop, Plane, PointMass, SpatialBodies, State};
use moreau_dynamics::schemes::{Scheme, Step, StepContext, StepProblem, Waist, passes_the_waist, step};
use moreau_exact::{Error, Result};
use nalgebra::{DVector, dvector};

/// The defects of this family.
pub const DEFECTS: &[Planted<Beside>] = &[
    Planted {
        name: "energy-balance/restitution-twice",
        mistake: "y = u⁺ + 2 e u⁻: the ball leaves with 2 e of its speed",
        kind: Kind::Assembly,
        subject: Beside {
            check: "properties/energy-balance",
            defective: || posed("moreau-jean", ball, twice),
            reference: || posed("moreau-jean", ball, as_it_is),
        },
    },
    Planted {
        name: "energy-balance/gap-with-the-wrong-sign",
        mistake: "y = u⁺ − φ/h: a depth pulls and a distance throws",
        kind: Kind::Assembly,
        subject: Beside {
            check: "properties/energy-balance",
            defective: || posed("stewart-trinkle", ball, reversed),
            reference: || posed("stewart-trinkle", ball, as_it_is),
        },
    },
    Planted {
        name: "energy-balance/reference-acceleration-against-the-velocity",
        mistake: "MuJoCo's h a_ref is compared with u⁺ instead of the change of u over the step",
        kind: Kind::Scheme,
        subject: Beside {
            check: "properties/energy-balance",
            defective: || posed("mujoco", tumbling_box, free_velocity_twice),
            reference: || posed("mujoco", tumbling_box, as_it_is),
        },
    },
    Planted {
        name: "energy-balance/gravity-in-the-contact",
        mistake: "the impulse of gravity is added again after the contact: v⁺ = v_free + M⁻¹Hᵀr + h g",
        kind: Kind::Scheme,
        subject: Beside {
            check: "properties/energy-balance",
            defective: || made("moreau-jean", ball, |_, step, h| step.state.velocity[0] -= GRAVITY * h),
            reference: || made("moreau-jean", ball, |_, _, _| ()),
        },
    },
    Planted {
        name: "energy-balance/gravity-twice",
        mistake: "v_free = v + 2 h g, with the contact solved for it",
        kind: Kind::Scheme,
        subject: Beside {
            check: "properties/energy-balance",
            defective: || made("moreau-jean", flying_box, gravity_twice),
            reference: || made("moreau-jean", flying_box, |_, _, _| ()),
        },
    },
    Planted {
        name: "energy-balance/impulse-scaled",
        mistake: "the solver's impulses are 1 % too large, and so is their effect",
        kind: Kind::Solver,
        subject: Beside {
            check: "properties/energy-balance",
            defective: || made("moreau-jean", ball, |_, step, _| scaled(step, 1.01)),
            reference: || made("moreau-jean", ball, |_, _, _| ()),
        },
    },
    Planted {
        name: "energy-balance/impulse-misreported",
        mistake: "the reported impulses are 1 % larger than those that acted",
        kind: Kind::Report,
        subject: Beside {
            check: "properties/energy-balance",
            defective: || made("anitescu", tumbling_box, |_, step, _| step.impulses.iter_mut().for_each(|one| one.impulse[0] *= 1.01)),
            reference: || made("anitescu", tumbling_box, |_, _, _| ()),
        },
    },
    Planted {
        name: "energy-balance/positions-of-another-theta",
        mistake: "q⁺ = q + h v⁺ where the scheme declares θ = ½",
        kind: Kind::Scheme,
        subject: Beside {
            check: "properties/energy-balance",
            defective: || made("moreau-jean", ball, |before, step, h| step.state.position = &before.position + &step.state.velocity * h),
            reference: || made("moreau-jean", ball, |_, _, _| ()),
        },
    },
    Planted {
        name: "energy-balance/explicit-gyroscopic-torque",
        mistake: "−Ω × JΩ at the start of the step instead of its mean: ½ h²‖Ω̇‖²_J a step",
        kind: Kind::Scheme,
        subject: Beside {
            check: "properties/energy-balance",
            defective: || made("moreau-jean", flying_box, explicit_torque),
            reference: || made("moreau-jean", flying_box, |_, _, _| ()),
        },
    },
    Planted {
        name: "energy-balance/spring-explicit-in-an-implicit-step",
        mistake: "v_free without the term −h θ K v of the θ step",
        kind: Kind::Scheme,
        subject: Beside {
            check: "properties/energy-balance",
            defective: || {
                made("moreau-jean", spring, |before, step, h| shift_velocity(step, &(&before.velocity * (0.5 * h * h * STIFFNESS / MASS))))
            },
            reference: || made("moreau-jean", spring, |_, _, _| ()),
        },
    },
    Planted {
        name: "energy-balance/spring-contact-too-strong",
        mistake: "Hunt and Crossley's impulse acts twice",
        kind: Kind::Scheme,
        subject: Beside {
            check: "properties/energy-balance",
            defective: || made("drake-lagged", sunken, |_, step, _| scaled(step, 2.0)),
            reference: || made("drake-lagged", sunken, |_, _, _| ()),
        },
    },
    Planted {
        name: "energy-balance/elastic-impact-that-gains",
        mistake: "the impact of the variational integrator leaves with 1 % more speed",
        kind: Kind::Scheme,
        subject: Beside {
            check: "properties/energy-balance",
            defective: || made("variational", elastic, |_, step, _| step.state.velocity *= 1.01),
            reference: || made("variational", elastic, |_, _, _| ()),
        },
    },
    Planted {
        name: "energy-balance/event-that-gains",
        mistake: "a located impact leaves with more than the speed it had",
        kind: Kind::Scheme,
        subject: Beside {
            check: "properties/energy-balance",
            defective: || made("event-driven", ball, |before, step, h| step.state.velocity[0] = before.velocity[0].abs() + GRAVITY * h),
            reference: || made("event-driven", ball, |_, _, _| ()),
        },
    },
    Planted {
        name: "energy-balance/a-body-elsewhere",
        mistake: "a position is corrected sideways by a metre, which no energy notices",
        kind: Kind::Scheme,
        subject: Beside {
            check: "properties/energy-balance",
            defective: || made("moreau-jean", flying_box, |_, step, _| step.state.position[0] += 1.0),
            reference: || made("moreau-jean", flying_box, |_, _, _| ()),
        },
    },
];

const GRAVITY: f64 = 9.81;
const MASS: f64 = 2.0;
const STIFFNESS: f64 = 300.0;
const H: f64 = 0.01;

/// A mechanism, its state and the mass of its body.
type Case = (Box<dyn Mechanism>, State, f64);

/// A ball with e = ½ that reaches the floor within the step.
fn ball() -> Result<Case> {
    let state = State { time: 0.0, position: dvector![0.004], velocity: dvector![-1.0] };
    Ok((Box::new(PointMass::ball_on_floor(MASS, GRAVITY, 0.5)), state, MASS))
}

/// An elastic ball.
fn elastic() -> Result<Case> {
    let (_, state, mass) = ball()?;
    Ok((Box::new(PointMass::ball_on_floor(MASS, GRAVITY, 1.0)), state, mass))
}

/// A ball a millimetre deep in the floor.
fn sunken() -> Result<Case> {
    let (_, state, mass) = ball()?;
    Ok((Box::new(PointMass::ball_on_floor(MASS, GRAVITY, 0.0)), State { position: dvector![-0.001], ..state }, mass))
}

/// A box with three unequal axes, spinning, at this height of its centre.
fn thrown_box(height: f64) -> Result<Case> {
    let body = SpatialBody::solid("box", Shape::Box { half_extents: [0.3, 0.1, 0.2] }, MASS)?;
    let ground = Plane::new(dvector![0.0, 0.0, 1.0], 0.0, 0.6, 0.0)?;
    let mechanism = SpatialBodies::new("thrown box", vec![body], [0.0, 0.0, -GRAVITY], ground)?;
    let position = dvector![0.0, 0.0, height, 0.8, 0.6, 0.0, 0.0];
    Ok((Box::new(mechanism), State { time: 0.0, position, velocity: dvector![1.0, -0.5, -2.0, 4.0, -3.0, 5.0] }, MASS))
}

fn flying_box() -> Result<Case> {
    thrown_box(5.0)
}

fn tumbling_box() -> Result<Case> {
    thrown_box(0.15)
}

/// A damped spring that passes its stop.
fn spring() -> Result<Case> {
    let mechanism = OscillatorWithStop::new(MASS, STIFFNESS, 1.5, 0.0, 0.5)?;
    Ok((Box::new(mechanism), State { time: 0.0, position: dvector![0.004], velocity: dvector![-1.0] }, MASS))
}

/// The balance of a step, and the reach of a motion that has only this one.
fn findings(balance: &Balance, taken: &Taken, mass: f64) -> Result<Vec<Finding>> {
    let judged = balance.judge(taken)?;
    let distance = Reach::new(taken)?.after(taken, &judged, &[mass])?;
    Ok(judged.findings.into_iter().chain(distance).collect())
}

/// The balance of a step that was altered after it was made.
fn made(name: &str, case: fn() -> Result<Case>, alter: fn(&State, &mut Step, f64)) -> Result<Vec<Finding>> {
    let (mechanism, before, mass) = case()?;
    let scheme = by_name(name, SchemeParameters::default())?;
    let mut step = step(scheme.as_ref(), &Auto, mechanism.as_ref(), &before, H)?;
    alter(&before, &mut step, H);
    let taken = Taken { mechanism: mechanism.as_ref(), before: &before, step: &step, h: H };
    findings(&Balance::of(name, &SchemeParameters::default())?, &taken, mass)
}

/// The balance of a step whose problem was altered before it was solved.
fn posed(name: &str, case: fn() -> Result<Case>, alter: fn(ContactProblem) -> Result<ContactProblem>) -> Result<Vec<Finding>> {
    let (mechanism, before, mass) = case()?;
    let scheme = by_name(name, SchemeParameters::default())?;
    let around = || Error::Unsupported(format!("`{name}` does not pass the waist"));
    let altered = Altered { scheme: scheme.waist().ok_or_else(around)?, alter };
    let step = step(&altered, &Auto, mechanism.as_ref(), &before, H)?;
    let taken = Taken { mechanism: mechanism.as_ref(), before: &before, step: &step, h: H };
    findings(&Balance::of(name, &SchemeParameters::default())?, &taken, mass)
}

fn as_it_is(problem: ContactProblem) -> Result<ContactProblem> {
    Ok(problem)
}

fn twice(problem: ContactProblem) -> Result<ContactProblem> {
    let shift = problem.shift() * 2.0;
    problem.into_builder().shift(shift).build()
}

fn free_velocity_twice(problem: ContactProblem) -> Result<ContactProblem> {
    let shift = problem.shift() + problem.free_velocity();
    problem.into_builder().shift(shift).build()
}

fn reversed(problem: ContactProblem) -> Result<ContactProblem> {
    let shift = -problem.shift();
    problem.into_builder().shift(shift).build()
}

/// Adds h g to the velocity of a free flight and to v_free; the positions follow as those of θ = ½ do.
fn gravity_twice(_: &State, step: &mut Step, h: f64) {
    shift_velocity(step, &dvector![0.0, 0.0, -GRAVITY * h, 0.0, 0.0, 0.0]);
    step.state.position[2] -= 0.5 * GRAVITY * h * h;
}

fn shift_velocity(step: &mut Step, by: &DVector<f64>) {
    step.assembled.free_velocity += by;
    step.state.velocity += by;
}

/// Ω + h J⁻¹(−Ω × JΩ) in place of the midpoint rule's.
fn explicit_torque(before: &State, step: &mut Step, h: f64) {
    let mass = step.assembled.effective_mass.matrix();
    let [j1, j2, j3] = [3, 4, 5].map(|i| mass[(i, i)]);
    let [a, b, c] = [3, 4, 5].map(|i| before.velocity[i]);
    let torque = [(j2 - j3) * b * c / j1, (j3 - j1) * c * a / j2, (j1 - j2) * a * b / j3];
    for (k, rate) in torque.into_iter().enumerate() {
        let spin = before.velocity[3 + k] + h * rate;
        step.assembled.free_velocity[3 + k] = spin;
        step.state.velocity[3 + k] = spin;
    }
}

/// Scales impulses, answer and the change of velocity.
fn scaled(step: &mut Step, factor: f64) {
    let change = &step.state.velocity - &step.assembled.free_velocity;
    step.state.velocity += change * (factor - 1.0);
    step.impulses.iter_mut().flat_map(|one| one.impulse.iter_mut()).for_each(|r| *r *= factor);
    if let Some(solution) = &mut step.solution {
        solution.impulse *= factor;
        solution.velocity = &*step.assembled.jacobian * &step.state.velocity;
    }
}

/// A scheme whose contact problem is altered before it is solved.
struct Altered<'a> {
    scheme: &'a dyn Waist,
    alter: fn(ContactProblem) -> Result<ContactProblem>,
}

impl Scheme for Altered<'_> {
    fn name(&self) -> String {
        format!("{}, altered", self.scheme.name())
    }

    fn has_restitution(&self) -> bool {
        self.scheme.has_restitution()
    }

    fn is_truncated(&self) -> bool {
        self.scheme.is_truncated()
    }

    passes_the_waist!();
}

impl Waist for Altered<'_> {
    fn assemble(&self, at: &StepContext) -> Result<StepProblem> {
        let mut assembled = self.scheme.assemble(at)?;
        assembled.problem = assembled.problem.map(self.alter).transpose()?;
        Ok(assembled)
    }

    fn advance(&self, at: &StepContext, velocity_post: &DVector<f64>) -> DVector<f64> {
        self.scheme.advance(at, velocity_post)
    }

    fn settle(&self, at: &StepContext, assembled: &StepProblem, position: DVector<f64>) -> Result<DVector<f64>> {
        self.scheme.settle(at, assembled, position)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::energy_balance::{IDENTITY, KINETIC, RESIDUAL, TOTAL, TOTAL_IDENTITY, reach};

    /// Which findings fail on a planted step.
    fn caught(name: &str) -> Vec<String> {
        let defect = DEFECTS.iter().find(|defect| defect.name == format!("energy-balance/{name}")).expect("a planted step");
        let findings = (defect.subject.defective)().expect("judged");
        findings.into_iter().filter(|finding| !finding.holds()).map(|finding| finding.name).collect()
    }

    #[test]
    fn every_finding_is_the_one_to_catch_some_mistake() {
        let expected: [(&str, &str); 14] = [
            ("restitution-twice", KINETIC),
            ("gap-with-the-wrong-sign", KINETIC),
            ("reference-acceleration-against-the-velocity", KINETIC),
            ("gravity-in-the-contact", IDENTITY),
            ("gravity-twice", TOTAL_IDENTITY),
            ("impulse-scaled", RESIDUAL),
            ("impulse-misreported", IDENTITY),
            ("positions-of-another-theta", TOTAL_IDENTITY),
            ("explicit-gyroscopic-torque", TOTAL_IDENTITY),
            ("spring-explicit-in-an-implicit-step", TOTAL_IDENTITY),
            ("spring-contact-too-strong", KINETIC),
            ("elastic-impact-that-gains", TOTAL),
            ("event-that-gains", TOTAL),
            ("a-body-elsewhere", reach::REACH),
        ];
        assert_eq!(expected.len(), DEFECTS.len());
        for (defect, finding) in expected {
            assert!(caught(defect).iter().any(|name| name == finding), "{defect} is caught by {:?}, not by `{finding}`", caught(defect));
        }
        // a correction sideways is seen by nothing but the distance
        assert_eq!(caught("a-body-elsewhere"), [reach::REACH]);
    }
}
