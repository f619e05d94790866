//! Orders of convergence through an impact, in four distances.

use super::parts::{GRAVITY, drop, short};
use crate::picture::Picture;
use crate::words::Words;
use moreau_checks::plot::{Axis, Chart, Series, Sheet};
use moreau_dynamics::schemes::MoreauJean;
use moreau_dynamics::trajectory::metrics::{Normalisation, graph_distance, position_sup, velocity_l1, velocity_sup};
use moreau_dynamics::trajectory::{Graph, OrderEstimate, estimate_order};
use moreau_exact::Result;
use moreau_forms::BouncingBall;

pub(super) const PICTURE: Picture = Picture {
    id: "order-in-four-metrics",
    question: Words { en: "Of which order is a scheme through an impact?", zh: "跨越碰撞时，时步格式究竟是几阶的？" },
    caption: Words {
        en: "The distance between Moreau–Jean's motion of a ball through one impact and the closed form, over the step. \
            Positions, velocities in L¹ and filled-in velocity graphs converge with the first order. The largest difference of \
            velocities does not converge at all: the impact comes up to a step too early or late, and until then the velocities differ \
            by the whole jump. Which order a scheme has is a question of the distance. Each point is the worst of four steps that put \
            the impact at different phases.",
        zh: "Moreau–Jean 格式计算的球（经历一次碰撞）与闭式解之间的距离随步长的变化。位置误差、速度的 L¹ 误差以及填充速度图的 Hausdorff 距离均为一阶收敛；速度的最大误差则完全不收敛：碰撞时刻会提前或滞后至多一步，\
            在此期间速度相差整个跳跃。所谓“阶”取决于所用的距离。每个点取四个步长（碰撞落在步内的不同相位）中误差最大者。",
    },
    obtained: Words {
        en: "Four metrics of `moreau-dynamics` on simulated motions to t = 0.8 s; slopes by least squares on the worst phases.",
        zh: "对仿真运动（至 t = 0.8 s）用 `moreau-dynamics` 的四种度量计算误差；斜率由最不利相位的最小二乘拟合得到。",
    },
    command: "moreau verify --explain T.moreau-convergence",
    claims: &["T.moreau-convergence", "S0.all-Oh", "P.order-zero", "S0.order-meaningless"],
    draw: |_| sheet()?.svg(),
};

const RESTITUTION: f64 = 0.5;
/// When the motions end \[s\]: before the second impact.
const END: f64 = 0.8;
const LEVELS: [usize; 5] = [16, 32, 64, 128, 256];
const PHASES: usize = 4;
const NAMES: [&str; 4] = ["positions, sup [m]", "velocities, L¹ [m]", "velocity graphs, Hausdorff [1]", "velocities, sup [m/s]"];

fn ball() -> Result<BouncingBall> {
    BouncingBall::new(GRAVITY, 1.0, RESTITUTION)
}

/// The four errors at a step.
fn errors(h: f64) -> Result<[f64; 4]> {
    let ball = ball()?;
    let motion = drop(&MoreauJean::default(), RESTITUTION, h, (END / h) as usize)?;
    let times: Vec<f64> = motion.samples.iter().map(|state| state.time).collect();
    let positions: Vec<f64> = motion.samples.iter().map(|state| state.position[0]).collect();
    let velocities: Vec<f64> = motion.samples.iter().map(|state| state.velocity[0]).collect();
    let found = Graph::linear(&times, &velocities)?;
    let exact = Graph::new(ball.velocity_corners(times[times.len() - 1]))?;
    Ok([
        position_sup(&times, &positions, |t| ball.state(t).0),
        velocity_l1(&found, &exact),
        graph_distance(&found, &exact, Normalisation::of_fall(GRAVITY, 1.0))?.upper,
        velocity_sup(&found, &exact),
    ])
}

fn estimates() -> Result<Vec<OrderEstimate>> {
    let impact = ball()?.first_impact_time();
    (0..NAMES.len()).map(|k| estimate_order(impact, &LEVELS, PHASES, |h| Ok(errors(h)?[k]))).collect()
}

fn sheet() -> Result<Sheet> {
    let mut series = Vec::new();
    for (k, (name, estimate)) in NAMES.iter().zip(estimates()?).enumerate() {
        let points: Vec<[f64; 2]> = estimate.levels.iter().map(|level| [level.time_step, level.error]).collect();
        series.push(Series::line(k, format!("{name}: slope {}", short((estimate.slope * 100.0).round() / 100.0 + 0.0)), points.clone()));
        series.push(Series::dots(k, "", points));
    }
    Ok(Sheet::column(vec![Chart::new(Axis::logarithmic("h [s]"), Axis::logarithmic("error [m, m/s, 1]"), series)]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_slopes_are_those_that_are_proven() {
        let estimates = estimates().expect("motions");
        for (estimate, order) in estimates.iter().zip([1.0, 1.0, 1.0, 0.0]) {
            // constants of the worst phases differ by less than a factor of two
            assert!((estimate.slope - order).abs() <= estimate.slope_interval(2.0), "{} against {order}", estimate.slope);
        }
        // until the later of both impacts the velocities differ by the jump (1 + e) √(2 g q₀)
        let jump = (1.0 + RESTITUTION) * (2.0 * GRAVITY).sqrt();
        let finest = estimates[3].levels[LEVELS.len() - 1];
        assert!((finest.error - jump).abs() <= 4.0 * GRAVITY * finest.time_step + 0.5 * jump, "{}", finest.error);
    }
}
