//! Motions with a closed form each: Newton's cradle, a sphere that begins to roll, an elastic bar, and a rough oscillator.

use super::parts::{GRAVITY, curve, evenly, samples, short};
use crate::picture::Picture;
use crate::words::Words;
use moreau_checks::plot::{Axis, Chart, Ink, Mark, Series, Shape, Sheet};
use moreau_contact::contact::delassus::delassus;
use moreau_contact::problem::PlanarProblem;
use moreau_contact::solvers::Auto;
use moreau_dynamics::elastic_bar::{FiniteElementBar, Method};
use moreau_dynamics::event_driven::EventDriven;
use moreau_dynamics::event_driven::filippov::{DryFriction, advance};
use moreau_dynamics::impact_laws::{moreau, sequential};
use moreau_dynamics::mechanics::{BallChain, Mechanism};
use moreau_dynamics::scenes::named;
use moreau_dynamics::schemes::{MoreauJean, simulate};
use moreau_dynamics::trajectory::Recording;
use moreau_exact::Result;
use moreau_forms::newtons_cradle::{after_two_impacts, at_once};
use moreau_forms::{DryFrictionOscillator, ElasticBar, SlidingToRolling};
use nalgebra::{DMatrix, DVector, dvector};

pub(super) const CRADLE: Picture = Picture {
    id: "newtons-cradle",
    question: Words { en: "Who moves after three balls have met?", zh: "三球相碰之后，谁在运动？" },
    caption: Words {
        en: "The first of three equal balls arrives at 1 m/s. If all contacts act at once (Moreau), the second and third leave \
            together and the first turns back for e > ½. If the impact passes from contact to contact, e = 1 gives all to the third, \
            as the toy does. Both keep momentum, both keep energy at e = 1: coefficients do not decide between them, and neither does \
            the mechanics of rigid bodies. For e < 1 the first ball catches up, and the sequence goes on beyond its first two impacts.",
        zh: "三个相同的球，第一个以 1 m/s 到达。若所有接触同时作用（Moreau 定律），第二、第三球一起离开，e > ½ 时第一球反弹。若碰撞逐个接触传递，e = 1 时全部速度传给第三球，如同牛顿摆玩具。二者都守恒动量，e = \
            1 时都守恒能量：恢复系数无法在两者之间取舍，刚体力学也不能。e < 1 时第一球还会追上第二球，碰撞序列不止前两次。",
    },
    obtained: Words {
        en: "Marks: `impact_laws::moreau`, and `impact_laws::sequential` until nothing approaches, on `BallChain`; lines: \
            `newtons_cradle`.",
        zh: "标记：对 `BallChain` 应用 `impact_laws::moreau` 与 `impact_laws::sequential`（完整序列）；线：`newtons_cradle` 闭式。",
    },
    command: "moreau verify --explain S7.multi-nonunique",
    claims: &["S7.multi-nonunique", "S7.newton-neq-poisson-multi", "S7.solver-pivot"],
    draw: |_| cradle()?.svg(),
};

pub(super) const ROLLING: Picture = Picture {
    id: "sliding-to-rolling",
    question: Words { en: "At which speed does a sliding sphere begin to roll?", zh: "滑动的球在什么速度下开始纯滚动？" },
    caption: Words {
        en: "A sphere of 1 kg is thrown at 1 m/s without spin on a floor with μ = 0.2. Friction of size μ m g brakes it and \
            spins it up until the slip is zero, at 5/7 m/s whatever μ; then it vanishes. The set-valued law does this within a step: \
            the tangential impulse that ends the slip lies inside the cone. Grey is the closed form, lines are Moreau–Jean at h = 10 ms.",
        zh: "1 kg 的球以 1 m/s 无自旋抛在 μ = 0.2 的地面上。大小为 μ m g 的摩擦力使其减速并加快自转，直到滑动速度为零——此时速度为 5/7 m/s，与 μ 无关，摩擦随即消失。集值摩擦定律在一步之内就完成切换：\
            使滑动终止的切向冲量落在锥内。灰线为闭式解，曲线为 Moreau–Jean 格式（h = 10 ms）。",
    },
    obtained: Words {
        en: "The scene `rolling-sphere` under `moreau-jean`; grey is `SlidingToRolling`.",
        zh: "场景 `rolling-sphere` 在 `moreau-jean` 格式下的仿真；灰线为 `SlidingToRolling`。",
    },
    command: "moreau simulate --scene rolling-sphere --step 0.01",
    claims: &["S4.maxdiss", "P.scenes", "S7.friction-bound"],
    draw: |_| rolling()?.svg(),
};

pub(super) const BAR: Picture = Picture {
    id: "elastic-bar-force",
    question: Words {
        en: "Is the contact force of an elastic body as smooth as its mesh says?",
        zh: "弹性体的接触力，网格算出来的可信吗？",
    },
    caption: Words {
        en: "A bar of 20 elements hits a wall. The exact force is constant, ρ c A V, until the wave returns: a finite force \
            over a finite time where a rigid body has an impulse. Average acceleration with the mass lumped at the striking end makes \
            it oscillate at the frequency of the mesh: the end has a mass of its own and bounces. Giving that mass to the next node \
            (redistributed mass) removes most of the oscillation.",
        zh: "20 个单元的杆撞墙。精确接触力为常数 ρ c A V，直到应力波返回：在刚体只有冲量的地方，弹性体是有限时间内的有限力。端部集中质量加平均加速度法会使接触力以网格频率振荡：端点自身有质量，会弹跳。\
            把该质量移到相邻节点（质量重分布）可消除大部分振荡。",
    },
    obtained: Words {
        en: "`FiniteElementBar` with and without redistributed mass, h a quarter of an element's time; grey is `ElasticBar`.",
        zh: "由 `FiniteElementBar`（有/无质量重分布）计算，h 取单元波行时间的四分之一；灰线为 `ElasticBar` 闭式解。",
    },
    command: "moreau verify --explain S11.rigid-to-fem",
    claims: &["S11.rigid-to-fem", "S11.fem-refs"],
    draw: |_| bar()?.svg(),
};

pub(super) const OSCILLATOR: Picture = Picture {
    id: "dry-friction-oscillator",
    question: Words { en: "When does dry friction stop an oscillation?", zh: "干摩擦会在何时让振动停下来？" },
    caption: Words {
        en: "A mass on a spring and a rough floor, released at 1 m; μ m g/k = 0.12 m. Each half-cycle is a half-circle about \
            ±δ, and the amplitude falls by 2δ: in a straight line, not exponentially. The first time it turns within the shaded zone \
            |q| ≤ δ it stays there for ever – Filippov's sliding mode on q̇ = 0, reached in finite time.",
        zh: "弹簧–质量系统置于粗糙地面，自 1 m 处释放；δ = F/k = 0.12 m。每个半周期在相平面上是以 ±δ 为圆心的半圆，振幅每次减少 2δ：线性衰减而非指数衰减。一旦在阴影区 |q| ≤ δ 内折返，\
            便永远停在那里——即 q̇ = 0 上的 Filippov 滑模，在有限时间内到达。",
    },
    obtained: Words {
        en: "Event-driven with Filippov's convention (`filippov::advance`), 240 samples; grey is `DryFrictionOscillator`.",
        zh: "事件驱动法与 Filippov 约定（`filippov::advance`），240 个采样；灰线为 `DryFrictionOscillator` 闭式解。",
    },
    command: "moreau verify --explain S1.stick-sliding",
    claims: &["S1.stick-sliding", "S1.filippov"],
    draw: |_| oscillator()?.svg(),
};

/// The cradle as an impact: W and the velocities before, and what maps impulses to the balls.
fn three_balls() -> Result<(PlanarProblem<f64>, DMatrix<f64>)> {
    let chain = BallChain::new(vec![1.0; 3], vec![0.5; 3], 1.0)?;
    let places = dvector![0.0, 1.0, 2.0];
    let contacts = chain.contacts(&places);
    let jacobian = DMatrix::from_fn(2, 3, |i, j| contacts[i].jacobian.to_dense()[(0, j)]);
    let operator = delassus(&chain.mass_matrix(&places), &jacobian)?;
    let velocity = &jacobian * dvector![1.0, 0.0, 0.0];
    Ok((PlanarProblem::new(operator, velocity), jacobian))
}

/// The velocities of the balls \[m/s\] after the impulses, masses of 1 kg.
fn after(jacobian: &DMatrix<f64>, impulse: &DVector<f64>) -> DVector<f64> {
    dvector![1.0, 0.0, 0.0] + jacobian.tr_mul(impulse)
}

fn together(restitution: f64) -> Result<DVector<f64>> {
    let (impact, jacobian) = three_balls()?;
    Ok(after(&jacobian, &moreau::frictionless(&impact, &[restitution; 2])?.impulse))
}

fn in_turn(restitution: f64) -> Result<DVector<f64>> {
    let (impact, jacobian) = three_balls()?;
    Ok(after(&jacobian, &sequential::sequential(&impact, &restitution, &[0, 1])?.impulse))
}

fn cradle() -> Result<Sheet> {
    let values: Vec<f64> = evenly(0.0, 1.0, 10).collect();
    let chart = |title: &str, form: fn(&f64) -> [f64; 3], law: fn(f64) -> Result<DVector<f64>>, from: f64| -> Result<Chart> {
        let mut series = Vec::new();
        for ball in 0..3 {
            series.push(Series::line(ball, format!("ball {}", ball + 1), curve(evenly(0.0, 1.0, 40), |e| form(&e)[ball])));
            let marks = values.iter().filter(|e| **e >= from).map(|e| Ok([*e, law(*e)?[ball]])).collect::<Result<Vec<_>>>()?;
            series.push(Series::dots(ball, "", marks));
        }
        let y = Axis::linear("velocity after [m/s]").within(-0.4, 1.1);
        Ok(Chart::new(Axis::linear("restitution e [1]").within(-0.05, 1.05), y, series).titled(title))
    };
    Ok(Sheet::pairs(vec![
        chart("all at once: lines and marks agree", at_once, together, 0.0)?,
        chart("in turn: lines two impacts, marks all", after_two_impacts, in_turn, 0.05)?,
    ]))
}

const ROLL_STEP: f64 = 0.01;

fn thrown() -> Result<Recording> {
    let (mechanism, start) = named("rolling-sphere")?.mechanism()?;
    simulate(&MoreauJean::default(), &Auto, mechanism.as_ref(), start, ROLL_STEP, 100)
}

/// A solid sphere, μ = 0.2, at 1 m/s.
fn sphere() -> Result<SlidingToRolling> {
    SlidingToRolling::new(2.5, 0.2, GRAVITY, 0.0, 1.0, 0.0)
}

/// m; the radius of the scene's sphere.
const RADIUS: f64 = 0.1;

fn rolling() -> Result<Sheet> {
    let (run, form) = (thrown()?, sphere()?);
    let exact = |value: fn(moreau_forms::sliding_to_rolling::RollingState) -> f64| curve(evenly(0.0, 1.0, 200), |t| value(form.state(t)));
    let ends = form.rolling_time();
    let series = vec![
        Series::exact("closed form", exact(|state| state.speed)),
        Series::exact("", exact(|state| state.surface)),
        Series::line(0, "speed v", samples(&run, |state| state.velocity[0])),
        Series::line(1, "surface speed ω R", samples(&run, |state| RADIUS * state.velocity[2])),
        Series::words(vec![
            ([0.7, 0.75], "rolls at 5/7 m/s".into()),
            ([ends + 0.1, 0.4], format!("slides until {} s", short((ends * 1000.0).round() / 1000.0))),
        ]),
    ];
    Ok(Sheet::column(vec![Chart::new(Axis::linear("t [s]"), Axis::linear("speed [m/s]"), series)]))
}

fn steel() -> Result<ElasticBar> {
    ElasticBar::new(1.0, 7800.0, 2.1e11, 0.0001, 1.0)
}

const ELEMENTS: usize = 20;

/// (t, λ) of every step.
fn force(redistributed: bool) -> Result<Vec<[f64; 2]>> {
    let bar = steel()?;
    let h = bar.length / bar.wave_speed() / (4 * ELEMENTS) as f64;
    let elements = FiniteElementBar::new(&bar, ELEMENTS, redistributed)?;
    let mut points = vec![[0.0, 0.0]];
    elements.run(Method::AverageAcceleration, h, 10 * ELEMENTS, |state| points.push([points.len() as f64 * h, state.force]))?;
    Ok(points)
}

fn bar() -> Result<Sheet> {
    let exact = steel()?;
    let (end, size) = (exact.contact_time(), exact.contact_force());
    let milli = |points: Vec<[f64; 2]>| points.into_iter().map(|[t, force]| [1000.0 * t, force / 1000.0]).collect::<Vec<_>>();
    let series = vec![
        Series::exact("ρ c A V", milli(vec![[0.0, 0.0], [0.0, size], [end, size], [end, 0.0], [1.25 * end, 0.0]])),
        Series::line(1, "lumped mass", milli(force(false)?)),
        Series::new("redistributed mass", Ink::of(0).solid(), Shape::Line(milli(force(true)?))),
    ];
    Ok(Sheet::column(vec![Chart::new(Axis::linear("t [ms]"), Axis::linear("contact force [kN]"), series)]))
}

/// 1 kg, ω = 2 rad/s, F/k = 0.12 m, from 1 m.
const ZONE: f64 = 0.12;
const FREQUENCY: f64 = 2.0;

fn rough() -> Result<DryFrictionOscillator> {
    DryFrictionOscillator::new(1.0, FREQUENCY * FREQUENCY, ZONE * FREQUENCY * FREQUENCY, 1.0)
}

/// (t, q, v/ω) of the event-driven motion.
fn sliding() -> Result<Vec<[f64; 3]>> {
    let system = DryFriction { frequency: FREQUENCY, belt: 0.0, sticking: ZONE, slipping: ZONE };
    let (h, mut x) = (8.0 / 240.0, dvector![1.0, 0.0]);
    let mut points = vec![[0.0, 1.0, 0.0]];
    for k in 1..=240 {
        x = advance(&EventDriven::default(), &system, &x, h)?.0;
        points.push([f64::from(k) * h, x[0], x[1] / FREQUENCY]);
    }
    Ok(points)
}

fn oscillator() -> Result<Sheet> {
    let (form, found) = (rough()?, sliding()?);
    let exact = |value: fn((f64, f64)) -> f64| curve(evenly(0.0, 8.0, 400), |t| value(form.state(t)));
    let zone = |from: f64, to: f64, low: f64, high: f64| vec![[from, low], [to, low], [to, high], [from, high]];
    let [positions, velocities] = [exact(|(q, _)| q), exact(|(_, v)| v / FREQUENCY)];
    let plane = positions.iter().zip(&velocities).map(|(q, v)| [q[1], v[1]]).collect();
    let envelope = curve(evenly(0.0, form.sticking_time(), 20), |t| 1.0 - 2.0 * ZONE * t * FREQUENCY / std::f64::consts::PI);
    let time = vec![
        Series::new("|q| ≤ F/k", Ink::of(4).solid(), Shape::Region(zone(0.0, 8.0, -ZONE, ZONE))),
        Series::exact("closed form", positions),
        Series::line(0, "event-driven", found.iter().map(|[t, q, _]| [*t, *q]).collect()),
        Series::line(1, "1 − 2δ ω t/π", envelope),
    ];
    let dots = found.iter().step_by(3).map(|[_, q, v]| [*q, *v]).collect();
    let phase = vec![
        Series::exact("closed form", plane),
        Series::dots(0, "event-driven", dots),
        Series::new("stick", Ink::of(1).marked(Mark::Square), Shape::Dots(vec![[found[240][1], 0.0]])),
    ];
    Ok(Sheet::pairs(vec![
        Chart::new(Axis::linear("t [s]"), Axis::linear("q [m]").within(-1.0, 1.1), time),
        Chart::new(Axis::linear("q [m]"), Axis::linear("v/ω [m]"), phase).with_equal_scales(),
    ]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_exact::tolerance::rounding;

    #[test]
    fn the_cradle_keeps_momentum_and_answers_as_the_closed_forms_do() {
        for e in [0.0, 0.3, 1.0] {
            let found = together(e).expect("an impact");
            for (ball, expected) in at_once(&e).into_iter().enumerate() {
                assert!((found[ball] - expected).abs() <= rounding(64, 2.0), "{e} {ball}");
            }
        }
        let toy = in_turn(1.0).expect("an impact");
        assert!((toy - dvector![0.0, 0.0, 1.0]).amax() <= rounding(64, 2.0));
        for e in [0.2, 0.7] {
            let [all, turn] = [together(e), in_turn(e)].map(|found| found.expect("an impact"));
            assert!((all.sum() - 1.0).abs() <= rounding(64, 2.0) && (turn.sum() - 1.0).abs() <= rounding(512, 2.0), "{e}");
            assert!(turn[0] <= turn[1] + rounding(64, 1.0) && turn[1] <= turn[2] + rounding(64, 1.0));
        }
    }

    #[test]
    fn the_sphere_rolls_at_five_sevenths_from_the_same_time_on() {
        let run = thrown().expect("a motion");
        let end = run.last();
        assert!((end.velocity[0] - 5.0 / 7.0).abs() <= rounding(4096, 1.0), "{}", end.velocity[0]);
        assert!((end.velocity[2] * RADIUS - 5.0 / 7.0).abs() <= rounding(4096, 1.0), "{}", end.velocity[2]);
        // slip 1 m/s falls by (1 + 5/2) μ g
        let time = 1.0 / (3.5 * 0.2 * GRAVITY);
        let slips = run.samples.iter().filter(|state| (state.velocity[0] - RADIUS * state.velocity[2]).abs() > rounding(4096, 1.0));
        let last = slips.map(|state| state.time).fold(0.0, f64::max);
        assert!((last - time).abs() <= ROLL_STEP, "{last} against {time}");
    }

    #[test]
    fn the_wall_gives_the_bar_twice_its_momentum() {
        let bar = steel().expect("a bar");
        for redistributed in [false, true] {
            let points = force(redistributed).expect("a motion");
            let impulse: f64 = points.windows(2).map(|pair| 0.5 * (pair[0][1] + pair[1][1]) * (pair[1][0] - pair[0][0])).sum();
            let expected = 2.0 * bar.mass() * bar.speed;
            // the wave that returns is smeared over a few of the elements
            assert!((impulse / expected - 1.0).abs() <= 2.0 / ELEMENTS as f64, "{redistributed}: {impulse} against {expected}");
        }
    }

    #[test]
    fn turning_points_fall_by_twice_the_zone() {
        let found = sliding().expect("a motion");
        let form = rough().expect("valid");
        for [time, q, _] in &found {
            assert!((q - form.state(*time).0).abs() <= 1.0 / f64::from(1 << 16), "{time}");
        }
        // 1 − 2 k 0.12 until it is within 0.12: four turns
        assert_eq!(form.half_cycles(), 4);
        assert!((found[240][1] - (1.0 - 8.0 * ZONE)).abs() <= 1.0 / f64::from(1 << 16), "{}", found[240][1]);
    }
}
