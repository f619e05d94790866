//! A joint held at velocity level: the drift from its position constraint, and what stabilisation leaves of it.

use super::parts::{by_ratio, short};
use crate::picture::Picture;
use crate::words::Words;
use moreau_checks::plot::{Axis, Chart, Series, Sheet};
use moreau_dynamics::stabilisation::{
    Baumgarte, Constrained, CoordinateProjection, GearGuptaLeimkuhler, Pendulum, Stabilisation, VelocityLevel, run,
};
use moreau_exact::Result;
use moreau_forms::stabilised_circle::{biased_energy, biased_offset, projected_energy};

pub(super) const PICTURE: Picture = Picture {
    id: "constraint-drift",
    question: Words {
        en: "How far does a joint drift that is held at velocity level?", zh: "只在速度层面约束的关节会漂移多远？"
    },
    caption: Words {
        en: "A point runs at 1 m/s on a circle of 1 m without load. A velocity-level step leaves along the tangent, and the \
            radius grows without end. Baumgarte's bias, ERP = 0.2 as in Bullet, settles at a distance of h²v²/(2 ERP R): of second \
            order, and nothing more is lost of the energy. Projection (and Gear–Gupta–Leimkuhler) stays on the circle and pays with \
            energy, n (hv/R)² in n steps.",
        zh: "质点以 1 m/s 在半径 1 m 的圆上运动，无外载。速度层面的步沿切线离开，半径不断增大。Baumgarte 偏置（ERP = 0.2，同 Bullet）使偏差稳定在 h²v²/(2 ERP R)：为二阶小量，\
            此后能量不再损失。投影法（以及 Gear–Gupta–Leimkuhler）保持在圆上，代价是能量：n 步约损失 n (hv/R)²。",
    },
    obtained: Words {
        en: "Steps of `moreau-dynamics::stabilisation`; grey are the closed forms of `stabilised_circle` and of the kept \
            momentum.",
        zh: "由 `moreau-dynamics::stabilisation` 逐步计算；灰线为 `stabilised_circle` 及角动量守恒给出的闭式。",
    },
    command: "moreau verify --explain S9.velocity-drift",
    claims: &["S9.velocity-drift", "S2.vel-drift", "S9.projection-energy", "S9.bullet-erp", "S9.ggl"],
    draw: |_| sheet()?.svg(),
};

const ERP: f64 = 0.2;
/// h \[s\] of the motions.
const STEP: f64 = 0.05;
const STEPS: usize = 120;

fn circle() -> Result<Pendulum> {
    Pendulum::new(1.0, 1.0, 0.0)
}

/// (t, g, E/E₀) after every step.
fn path(method: &dyn Stabilisation, h: f64, steps: usize) -> Result<Vec<[f64; 3]>> {
    let system = circle()?;
    let mut state = system.at(0.0, 1.0);
    let mut found = vec![[0.0, 0.0, 1.0]];
    for k in 1..=steps {
        state = method.step(&system, &state, h)?;
        found.push([k as f64 * h, system.violation(&state.position)[0], state.velocity.norm_squared()]);
    }
    Ok(found)
}

/// r_n − 1 without stabilisation: L stays, r⁺² = r² + h²/r².
fn unheld(h: f64, steps: usize) -> Vec<[f64; 2]> {
    let mut radius = 1.0f64;
    let mut points = vec![[0.0, 0.0]];
    for k in 1..=steps {
        radius = (h / radius).hypot(radius);
        points.push([k as f64 * h, radius - 1.0]);
    }
    points
}

/// |g| after two seconds.
fn left(method: &dyn Stabilisation, h: f64) -> Result<f64> {
    let system = circle()?;
    let end = run(method, &system, &system.at(0.0, 1.0), h, (2.0 / h).round() as usize)?;
    Ok(system.violation(&end.position)[0].abs())
}

fn sheet() -> Result<Sheet> {
    let baumgarte = Baumgarte::error_reduction(ERP, STEP)?;
    let named: [(&str, &dyn Stabilisation); 4] = [
        ("velocity level", &VelocityLevel),
        ("Baumgarte, ERP 0.2", &baumgarte),
        ("projection of q and v", &CoordinateProjection),
        ("Gear–Gupta–Leimkuhler", &GearGuptaLeimkuhler),
    ];
    let mut drifts = vec![Series::exact("closed forms", unheld(STEP, STEPS))];
    let settled = biased_offset(STEP, ERP);
    let until = STEP * STEPS as f64;
    drifts.push(Series::exact("", vec![[1.0, settled], [until, settled]]));
    let mut energies = vec![Series::exact("1/(1 + n w²)", (0..=STEPS).map(|n| [n as f64 * STEP, projected_energy(STEP, n)]).collect())];
    energies.push(Series::exact("", vec![[1.0, biased_energy(STEP, ERP)], [until, biased_energy(STEP, ERP)]]));
    for (k, (name, method)) in named.into_iter().enumerate() {
        let found = path(method, STEP, STEPS)?;
        drifts.push(Series::line(k, name, found.iter().map(|[t, g, _]| [*t, *g]).collect()));
        energies.push(Series::line(k, name, found.iter().map(|[t, _, energy]| [*t, *energy]).collect()));
    }
    let steps: Vec<f64> = by_ratio(0.005, 0.1, 5).map(|h| 2.0 / (2.0 / h).round()).collect();
    let bare = steps.iter().map(|h| Ok([*h, left(&VelocityLevel, *h)?])).collect::<Result<Vec<_>>>()?;
    let biased = steps.iter().map(|h| Ok([*h, left(&Baumgarte::error_reduction(ERP, *h)?, *h)?])).collect::<Result<Vec<_>>>()?;
    let mut orders = Vec::new();
    for (k, (name, points)) in [("velocity level", bare), ("Baumgarte, ERP 0.2", biased)].into_iter().enumerate() {
        orders.push(Series::line(k, format!("{name}: slope {}", short((slope(&points) * 100.0).round() / 100.0)), points.clone()));
        orders.push(Series::dots(k, "", points));
    }
    Ok(Sheet::column(vec![
        Chart::new(Axis::linear("t [s]"), Axis::linear("r − R [m]"), drifts),
        Chart::new(Axis::linear("t [s]"), Axis::linear("E/E₀ [J/J]"), energies),
        Chart::new(Axis::logarithmic("h [s]"), Axis::logarithmic("|r − R| after 2 s [m]"), orders),
    ]))
}

/// The slope between the first and the last point of a log–log line.
fn slope(points: &[[f64; 2]]) -> f64 {
    let (first, last) = (points[0], points[points.len() - 1]);
    (last[1] / first[1]).ln() / (last[0] / first[0]).ln()
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_exact::tolerance::rounding;

    #[test]
    fn the_motions_are_the_closed_ones() {
        let found = path(&VelocityLevel, STEP, STEPS).expect("a motion");
        for ([_, g, _], [_, expected]) in found.iter().zip(unheld(STEP, STEPS)) {
            assert!((g - expected).abs() <= rounding(16 * STEPS, 2.0), "{g} against {expected}");
        }
        let projected = path(&CoordinateProjection, STEP, STEPS).expect("a motion");
        let expected = 1.0 / (1.0 + STEPS as f64 * STEP * STEP);
        assert!((projected[STEPS][2] - expected).abs() <= rounding(64 * STEPS, 1.0), "{}", projected[STEPS][2]);
        let biased = path(&Baumgarte::error_reduction(ERP, STEP).expect("a share"), STEP, 300).expect("a motion");
        // what is left of the transient after 300 steps is below rounding
        assert!((biased[300][1] - biased_offset(STEP, ERP)).abs() <= rounding(4096, 1.0));
        assert!((biased_offset(STEP, ERP) - STEP * STEP / (2.0 * ERP)).abs() <= 4.0 * (STEP * STEP / (2.0 * ERP)).powi(2));
    }

    #[test]
    fn drift_is_of_first_order_and_of_second_with_the_bias() {
        let bare = [0.01, 0.02].map(|h| [h, left(&VelocityLevel, h).expect("a motion")]);
        let biased = [0.01, 0.02].map(|h| [h, left(&Baumgarte::error_reduction(ERP, h).expect("a share"), h).expect("a motion")]);
        assert!((slope(&bare) - 1.0).abs() <= 0.05 && (slope(&biased) - 2.0).abs() <= 0.05, "{} {}", slope(&bare), slope(&biased));
    }
}
