//! The bouncing ball: through infinitely many impacts, its heights, and what the floor does to it as a measure.

use super::parts::{GRAVITY, curve, drop, evenly, samples, short};
use crate::picture::Picture;
use crate::words::Words;
use moreau_checks::plot::{Axis, Chart, Series, Sheet};
use moreau_dynamics::schemes::{Activation, MoreauJean};
use moreau_exact::Result;
use moreau_forms::BouncingBall;

/// e of the first and the third picture.
const RESTITUTION: f64 = 0.5;
/// h \[s\] of the first picture.
const STEP: f64 = 0.01;
const STEPS: usize = 170;
/// h \[s\] of the other two.
const FINE_STEP: f64 = 0.002;

pub(super) const ZENO: Picture = Picture {
    id: "ball-through-zeno",
    question: Words {
        en: "What does a time-stepping scheme make of infinitely many impacts?",
        zh: "面对无穷多次碰撞（Zeno 现象），时步法会算出什么？",
    },
    caption: Words {
        en: "A ball of 1 kg falls 1 m and bounces with e = 0.5. Grey is the closed form, whose impacts accumulate at T∞. \
            Moreau–Jean (θ = ½, h = 10 ms) takes steps of one size: it meets a few of the impacts, swallows the rest within single \
            steps and comes to rest, whatever rule activates the contact. The rules A (φ ≤ 0), B (φ + ½h u ≤ 0) and D (φ + h u_free ≤ \
            0) differ in when they see the floor, so each lands on heights of its own, all within a step's fall.",
        zh: "质量 1 kg 的球从 1 m 高处落下，恢复系数 e = 0.5。灰线为闭式解，其碰撞时刻在 T∞ 处聚积。Moreau–Jean 格式（θ = ½，h = 10 ms）以固定步长推进：它只分辨出前几次碰撞，\
            其余的都被吸收在单个步内，最终静止，与采用哪条激活准则无关。准则 A（φ ≤ 0）、B（φ + ½h u ≤ 0）、D（φ + h u_free ≤ 0）的差别在于何时把接触视为激活，因此静止高度略有不同，但都不超过一步内的下落量。",
    },
    obtained: Words {
        en: "Simulated for this picture by the scheme `moreau-jean` with each activation rule; the grey curves are \
            `BouncingBall`.",
        zh: "由 `moreau-jean` 格式在三条激活准则下即时仿真得到；灰线由 `BouncingBall` 的闭式解给出。",
    },
    command: "moreau simulate --scene bouncing-ball --step 0.01 --activation A",
    claims: &["M.zeno", "S0.zeno-absorb", "S0.tinf"],
    draw: |_| zeno()?.svg(),
};

pub(super) const HEIGHTS: Picture = Picture {
    id: "heights-by-e-squared",
    question: Words { en: "How fast do the bounces become lower?", zh: "弹跳高度按什么规律递减？" },
    caption: Words {
        en: "The height after bounce k is e^{2k} of the first fall: a straight line over k in this picture, twice as steep as \
            that of the flight times, which shrink by e. Marks are the apexes of Moreau–Jean's motion at h = 2 ms; they leave the line \
            where a bounce is as low as a step's fall.",
        zh: "第 k 次反弹后的高度是首次下落高度的 e^{2k} 倍：在对数坐标下是关于 k 的直线，其斜率是飞行时间（按 e 递减）的两倍。标记点是 Moreau–Jean 格式（h = 2 ms）运动的顶点；\
            当反弹高度与一步内的下落量相当时，它们偏离直线。",
    },
    obtained: Words {
        en: "Apexes of simulated motions, and `BouncingBall::apex_height`.",
        zh: "标记点取自仿真轨迹的顶点，直线由 `BouncingBall::apex_height` 计算。",
    },
    command: "moreau simulate --scene bouncing-ball --step 0.002 --restitution 0.8 --duration 5",
    claims: &["S0.height-e2", "S12.energy"],
    draw: |_| heights()?.svg(),
};

pub(super) const MEASURE: Picture = Picture {
    id: "impulse-as-a-measure",
    question: Words { en: "Why is the contact impulse a measure, and no force?", zh: "接触作用为什么是测度，而不是力？" },
    caption: Words {
        en: "What the floor has given to the ball up to a time: it jumps at every impact by (1 + e) m v⁻, an atom, and after \
            T∞ it grows with the slope m g, a density. Both are one measure. The scheme never separates them: it gives one impulse \
            (N·s) per step, and their sum follows the measure.",
        zh: "地面累计传给球的冲量：每次碰撞跳跃 (1 + e) m v⁻，即一个原子；T∞ 之后以斜率 m g 增长，即密度部分。二者同属一个测度。时步格式并不区分它们：每一步只给出一个冲量（N·s），其累计和逼近该测度。",
    },
    obtained: Words {
        en: "Impulses of Moreau–Jean at h = 2 ms, summed; the exact sum is that of the atoms and of the density.",
        zh: "Moreau–Jean 格式（h = 2 ms）各步冲量及其累计和；精确值为各原子与密度部分之和。",
    },
    command: "moreau verify --explain S0.measure-split",
    claims: &["S0.measure-split", "S11.atom", "S7.atom"],
    draw: |_| measure()?.svg(),
};

fn exact(restitution: f64) -> Result<BouncingBall> {
    BouncingBall::new(GRAVITY, 1.0, restitution)
}

fn zeno() -> Result<Sheet> {
    let ball = exact(RESTITUTION)?;
    let until = STEP * STEPS as f64;
    let mut heights = vec![Series::exact("closed form", curve(evenly(0.0, until, 600), |t| ball.state(t).0))];
    let mut speeds = vec![Series::exact("closed form", ball.velocity_corners(until))];
    for (k, rule) in Activation::ALL.into_iter().enumerate() {
        let motion = drop(&MoreauJean { activation: rule, ..MoreauJean::default() }, RESTITUTION, STEP, STEPS)?;
        heights.push(Series::line(k, rule.name(), samples(&motion, |state| state.position[0])));
        speeds.push(Series::line(k, rule.name(), samples(&motion, |state| state.velocity[0])));
    }
    let end = ball.accumulation_time();
    heights.push(Series::words(vec![([end, 0.3], format!("T∞ = {end:.3} s"))]));
    Ok(Sheet::column(vec![
        Chart::new(Axis::linear("t [s]"), Axis::linear("q [m]"), heights),
        Chart::new(Axis::linear("t [s]").within(1.0, until), Axis::linear("v [m/s]").within(-1.3, 1.3), speeds),
    ]))
}

/// (k, height) of the apexes of a motion, the drop first.
fn apexes(restitution: f64, bounces: usize) -> Result<Vec<[f64; 2]>> {
    let time = exact(restitution)?.impact_time(bounces + 1);
    let motion = drop(&MoreauJean::default(), restitution, FINE_STEP, (time / FINE_STEP) as usize)?;
    let tops = motion.samples.windows(2).filter(|pair| pair[0].velocity[0] >= 0.0 && pair[1].velocity[0] < 0.0);
    Ok(tops.enumerate().map(|(k, pair)| [k as f64, pair[0].position[0]]).collect())
}

/// How many bounces are higher than a hundred steps' falls.
fn bounces(restitution: f64) -> usize {
    let low = 100.0 * GRAVITY * FINE_STEP * FINE_STEP;
    (low.ln() / (2.0 * restitution.ln())) as usize
}

fn heights() -> Result<Sheet> {
    let (mut heights, mut flights) = (Vec::new(), Vec::new());
    for (k, restitution) in [0.5, 0.65, 0.8].into_iter().enumerate() {
        let (ball, count) = (exact(restitution)?, bounces(restitution));
        let label = format!("e = {}", short(restitution));
        let line = curve((0..=count).map(|k| k as f64), |k| ball.apex_height(k as usize));
        heights.push(Series::line(k, format!("{label}, e^2k q₀"), line));
        heights.push(Series::dots(k, format!("{label}, moreau-jean"), apexes(restitution, count)?));
        let flight = |k: f64| ball.impact_time(k as usize + 1) - ball.impact_time(k as usize);
        flights.push(Series::line(k, label, curve((1..=count).map(|k| k as f64), flight)));
    }
    let bounce = || Axis::linear("bounce k [1]").within(0.0, 10.0);
    Ok(Sheet::pairs(vec![
        Chart::new(bounce(), Axis::logarithmic("height [m]"), heights),
        Chart::new(bounce(), Axis::logarithmic("flight time [s]"), flights),
    ]))
}

/// (t, ∫ dI) of the exact motion: the atoms up to t, and after T∞ the weight.
fn total(ball: &BouncingBall, time: f64) -> f64 {
    let end = ball.accumulation_time();
    let atom = |k: usize| (1.0 + RESTITUTION) * ball.impact_speed(k);
    // beyond the fiftieth impact nothing is left of the sum in floats
    let atoms: f64 = (1..=50).take_while(|k| ball.impact_time(*k) <= time).map(atom).sum();
    atoms + GRAVITY * (time - end).max(0.0)
}

/// The impulses of the motion and their sum, at the ends of the steps.
fn impulses() -> Result<[Vec<[f64; 2]>; 2]> {
    let motion = drop(&MoreauJean::default(), RESTITUTION, FINE_STEP, 900)?;
    let each: Vec<[f64; 2]> = motion
        .impulses
        .iter()
        .zip(&motion.samples[1..])
        .map(|(impulses, state)| [state.time, impulses.iter().map(|contact| contact.impulse[0]).sum()])
        .collect();
    let mut sum = 0.0;
    let summed = each.iter().map(|[time, impulse]| {
        sum += impulse;
        [*time, sum]
    });
    Ok([each.clone(), summed.collect()])
}

fn measure() -> Result<Sheet> {
    let ball = exact(RESTITUTION)?;
    let [each, summed] = impulses()?;
    let felt = each.into_iter().filter(|[_, impulse]| *impulse > 0.0).collect();
    let atoms = (1..=8).map(|k| [ball.impact_time(k), (1.0 + RESTITUTION) * ball.impact_speed(k)]).collect();
    let line = curve(evenly(0.0, 1.8, 1800), |t| total(&ball, t));
    Ok(Sheet::column(vec![
        Chart::new(
            Axis::linear("t [s]"),
            Axis::logarithmic("impulse of a step [N·s]"),
            vec![Series::dots(0, "moreau-jean, h = 0.002 s", felt), Series::dots(4, "atoms (1 + e) m v⁻", atoms)],
        ),
        Chart::new(
            Axis::linear("t [s]"),
            Axis::linear("∫ dI [N·s]"),
            vec![Series::exact("atoms and density", line), Series::line(0, "moreau-jean", summed)],
        ),
    ]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_rule_rests_after_the_sum_of_all_flights() {
        // T∞ as a sum of flights, not as the quotient that the form has
        let first = (2.0 / GRAVITY).sqrt();
        let sum: f64 = first + (1..60).map(|k| 2.0 * first * RESTITUTION.powi(k)).sum::<f64>();
        assert!((exact(RESTITUTION).expect("valid").accumulation_time() - sum).abs() <= f64::EPSILON * 100.0);
        for rule in Activation::ALL {
            let motion = drop(&MoreauJean { activation: rule, ..MoreauJean::default() }, RESTITUTION, STEP, STEPS).expect("a motion");
            let resting = motion.samples.iter().filter(|state| state.time > sum + 10.0 * STEP);
            let fall = GRAVITY * STEP;
            assert!(resting.clone().count() >= 10, "the motion goes on after T∞");
            assert!(resting.map(|state| state.velocity[0].abs()).fold(0.0, f64::max) <= 2.0 * fall, "{rule:?}");
        }
    }

    #[test]
    fn apexes_fall_by_e_squared() {
        for restitution in [0.5, 0.65, 0.8] {
            let tops = apexes(restitution, bounces(restitution)).expect("a motion");
            assert_eq!((tops[0], tops.len()), ([0.0, 1.0], bounces(restitution) + 1));
            for pair in tops.windows(2) {
                // an apex is off by no more than the impact's speed over a step
                let room = 4.0 * FINE_STEP * (2.0 * GRAVITY * pair[0][1]).sqrt();
                assert!((pair[1][1] - restitution * restitution * pair[0][1]).abs() <= room, "{restitution} {pair:?}");
            }
        }
    }

    #[test]
    fn the_measure_is_the_change_of_momentum() {
        let ball = exact(RESTITUTION).expect("valid");
        for time in [0.1, 0.5, 1.0, 1.3, 1.7] {
            // m v(t) = −m g t + I(t)
            assert!((total(&ball, time) - ball.state(time).1 - GRAVITY * time).abs() <= f64::EPSILON * 1000.0, "{time}");
        }
        let [_, summed] = impulses().expect("a motion");
        let [time, last] = summed[summed.len() - 1];
        assert!((last - total(&ball, time)).abs() <= 4.0 * GRAVITY * FINE_STEP, "{last}");
    }
}
