//! What θ does to the energy of a spring, and the step to a phase portrait.

use super::parts::{curve, evenly, short};
use crate::picture::Picture;
use crate::words::Words;
use moreau_checks::plot::{Axis, Chart, Ink, Series, Shape, Sheet};
use moreau_dynamics::integrators::{Damping, ExplicitEuler, Method, Phase, SemiImplicitEuler, SpringDamper, Theta};
use moreau_exact::Result;
use moreau_exact::scalar::{exact, ratio};
use moreau_forms::spring_damper::theta_energy_ratio;

/// s = hω of both pictures.
const ENERGY_STEP: f64 = 0.1;
const PORTRAIT_STEP: f64 = 0.3;

pub(super) const ENERGY: Picture = Picture {
    id: "energy-by-theta",
    question: Words {
        en: "How much energy does θ take, or give?", zh: "θ 取不同值时，能量被耗散多少，又被注入多少？"
    },
    caption: Words {
        en: "A mass on a spring without contact, h ω = 0.1. θ = ½ keeps the energy to rounding; every θ above ½ takes the same \
            share in each step, every θ below gives it. The share of a step is (1 + (1−θ)² s²)/(1 + θ² s²), s = hω: for θ = 1 it is \
            nearly s², so long motions run down, and finer steps only make that slower.",
        zh: "无接触的弹簧–质量系统，hω = 0.1。θ = ½ 时能量守恒（仅有舍入误差）；θ > ½ 每一步按同一比例耗散能量，θ < ½ 则按同一比例注入能量。单步能量比为 (1 + (1−θ)² s²)/(1 + θ² s²)，s \
            = hω：θ = 1 时每步约损失 s²，长时间运动必然衰减，减小步长只能使之变慢。",
    },
    obtained: Words {
        en: "Steps of the θ method of `moreau-dynamics`; grey is the power of the closed ratio.",
        zh: "由 `moreau-dynamics` 的 θ 方法逐步计算；灰线为闭式单步能量比的幂。",
    },
    command: "moreau verify --explain S3.theta-mid",
    claims: &["S3.theta-mid", "S3.energy-half", "S3.energy-runs-down", "S8.theta-spectrum"],
    draw: |_| energy()?.svg(),
};

pub(super) const PORTRAITS: Picture = Picture {
    id: "phase-portraits",
    question: Words { en: "Which Euler rule keeps an orbit closed?", zh: "哪一种 Euler 格式能使相轨道保持闭合？" },
    caption: Words {
        en: "The plane (q, v/ω) of a spring, h ω = 0.3, 60 steps from the same point, 22 of explicit Euler; the circle is \
            exact. Explicit Euler spirals outwards, implicit Euler inwards. Semi-implicit Euler changes one line of the explicit rule \
            and stays on an ellipse q² + v²/ω² − s q v/ω: it is symplectic. θ = ½ stays on the circle and errs in phase only.",
        zh: "弹簧振子的相平面 (q, v/ω)，hω = 0.3，从同一点出发走 60 步（显式 Euler 只走 22 步）；圆为精确轨道。显式 Euler 向外螺旋，隐式 Euler 向内螺旋。半隐式 Euler 只改动显式格式的一行，\
            却始终位于椭圆 q² + v²/ω² − s q v/ω 上：它是辛格式。θ = ½ 保持在圆上，只有相位误差。",
    },
    obtained: Words {
        en: "Steps of the integrators of `moreau-dynamics` with ω = 1/s.",
        zh: "由 `moreau-dynamics` 的积分器（ω = 1/s）逐步计算。",
    },
    command: "moreau verify --explain S8.semi-symplectic",
    claims: &["S8.semi-symplectic", "S8.explicit-injects", "S8.one-change", "S3.symplectic-like"],
    draw: |_| portraits()?.svg(),
};

fn undamped() -> SpringDamper {
    SpringDamper::of_ratio(ratio(0, 1))
}

/// The points (q, v) of an orbit from (1, 0).
fn orbit(method: &impl Method, h: f64, steps: usize) -> Vec<[f64; 2]> {
    let mut now = Phase::of_one(1.0, 0.0);
    let mut points = vec![[1.0, 0.0]];
    for _ in 0..steps {
        now = method.step(&undamped(), &now, &h);
        points.push([now.position[0], now.velocity[0]]);
    }
    points
}

/// E/E₀ of every point.
fn energies(points: &[[f64; 2]]) -> Vec<f64> {
    points.iter().map(|[q, v]| q * q + v * v).collect()
}

fn of(theta: f64) -> Theta {
    Theta { theta: exact(theta) }
}

fn energy() -> Result<Sheet> {
    let steps = 400;
    let mut series = Vec::new();
    for (k, theta) in [0.25, 0.5, 0.6, 0.75, 1.0].into_iter().enumerate() {
        let ratio = theta_energy_ratio(theta, ENERGY_STEP);
        let label = if k == 0 { "closed form" } else { "" };
        series.push(Series::exact(label, curve(evenly(0.0, steps as f64, 40), |n| ratio.powf(n))));
        let found = energies(&orbit(&of(theta), ENERGY_STEP, steps));
        let points = found.into_iter().enumerate().map(|(n, energy)| [n as f64, energy]).collect();
        series.push(Series::line(k, format!("θ = {}", short(theta)), points));
    }
    Ok(Sheet::column(vec![Chart::new(Axis::linear("step n [1]"), Axis::logarithmic("E/E₀ [J/J]"), series)]))
}

fn portraits() -> Result<Sheet> {
    let symplectic = SemiImplicitEuler { damping: Damping::Explicit };
    let all = [
        ("explicit Euler", orbit(&ExplicitEuler, PORTRAIT_STEP, 22)),
        ("implicit Euler, θ = 1", orbit(&of(1.0), PORTRAIT_STEP, 60)),
        ("semi-implicit (symplectic) Euler", orbit(&symplectic, PORTRAIT_STEP, 60)),
        ("θ = ½", orbit(&of(0.5), PORTRAIT_STEP, 60)),
    ];
    let circle = || curve(evenly(0.0, std::f64::consts::TAU, 180), f64::sin).into_iter().map(|[t, sine]| [t.cos(), sine]).collect();
    let chart = |(k, (name, points)): (usize, (&str, Vec<[f64; 2]>))| {
        let path = Series::new("", Ink::thin(), Shape::Line(points.clone()));
        let series = vec![Series::exact("exact", circle()), path, Series::dots(k, "steps", points)];
        Chart::new(Axis::linear("q [m]"), Axis::linear("v/ω [m]"), series).titled(name).with_equal_scales()
    };
    Ok(Sheet::pairs(all.into_iter().enumerate().map(chart).collect()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_exact::tolerance::rounding;

    #[test]
    fn a_step_of_theta_has_the_closed_ratio_of_energies() {
        for theta in [0.25, 0.5, 0.75, 1.0] {
            let found = energies(&orbit(&of(theta), ENERGY_STEP, 3));
            let expected = theta_energy_ratio(theta, ENERGY_STEP).powi(3);
            assert!((found[3] - expected).abs() <= rounding(64, 1.0), "{theta}");
        }
    }

    #[test]
    fn orbits_spiral_close_or_stay_as_their_invariants_say() {
        let s = PORTRAIT_STEP;
        let explicit = energies(&orbit(&ExplicitEuler, s, 10));
        assert!((explicit[10] - (1.0 + s * s).powi(10)).abs() <= rounding(128, explicit[10]));
        let symplectic = orbit(&SemiImplicitEuler { damping: Damping::Explicit }, s, 60);
        assert!(symplectic.iter().all(|[q, v]| (q * q + v * v - s * q * v - 1.0).abs() <= rounding(512, 1.0)));
        let implicit = energies(&orbit(&of(1.0), s, 10));
        assert!((implicit[10] * (1.0 + s * s).powi(10) - 1.0).abs() <= rounding(256, 1.0));
    }
}
