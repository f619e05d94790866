//! How large a step may be: for a spring and damper under each integrator, and for Baumgarte's correction.

use super::parts::{curve, evenly};
use crate::picture::Picture;
use crate::words::Words;
use moreau_checks::plot::{Axis, Chart, Ink, Mark, Series, Shape, Sheet};
use moreau_dynamics::integrators::stability::spectral_radius;
use moreau_dynamics::integrators::{Damping, ExplicitEuler, Method, Phase, RungeKutta, SemiImplicitEuler, SpringDamper, Theta};
use moreau_dynamics::stabilisation::ViolationStep;
use moreau_exact::Result;
use moreau_exact::scalar::exact;
use moreau_forms::spring_damper;

pub(super) const REGIONS: Picture = Picture {
    id: "stability-regions",
    question: Words { en: "How large a step does a contact spring bear?", zh: "接触弹簧能承受多大的步长？" },
    caption: Words {
        en: "Below each line a mass on a spring and damper comes to rest, above it explodes: the bound of h ω over the damping \
            ratio. Explicit Euler bears nothing without damping. Semi-implicit Euler bears h ω = 2 there – a step of 1/π of the period \
            – and less with damping, if the damping is explicit; more, if it is implicit. Runge–Kutta of order four bears 2√2. θ ≥ ½ \
            has no bound.",
        zh: "每条线以下，弹簧–阻尼系统趋于静止，以上则发散：hω 的稳定上界随阻尼比变化。显式 Euler 在无阻尼时完全不稳定。半隐式 Euler 在无阻尼时可达 hω = 2（即周期的 1/π）；显式处理阻尼时上界随阻尼减小，\
            隐式处理时增大。四阶 Runge–Kutta 可达 2√2。θ ≥ ½ 没有上界。",
    },
    obtained: Words {
        en: "Marks: bisection on the spectral radius of the Jacobian of a step of each method. Lines: the closed forms of \
            `spring_damper`.",
        zh: "标记：对各方法单步 Jacobian 的谱半径作二分；线：`spring_damper` 的闭式。",
    },
    command: "moreau verify --explain S8.damped-bound",
    claims: &["S8.damped-bound", "S8.semi-bound", "S8.explicit-bound", "S8.backward-uncond", "S8.one-over-pi"],
    draw: |_| regions()?.svg(),
};

pub(super) const BAUMGARTE: Picture = Picture {
    id: "baumgarte-region",
    question: Words {
        en: "For which parameters does Baumgarte's correction decay?",
        zh: "Baumgarte 稳定化的参数取何值时约束违反才会衰减？",
    },
    caption: Words {
        en: "The violation after a step depends on a = 2αh and b = βh alone. It decays inside the region a > 0, 2a + b² < 4. \
            On the dashed curve a = 2b − b² the step is critically damped, which is less damping than α = β of the differential \
            equation; below it the violation swings. a = b = 1 removes it in two steps. What is well tuned at one step is not at \
            another: a and b change with h.",
        zh: "一步之后的约束违反只取决于 a = 2αh 与 b = βh。在区域 a > 0、2a + b² < 4 内衰减。虚线 a = 2b − b² 上离散步为临界阻尼，所需阻尼小于微分方程的 α = β；虚线以下违反量来回振荡。a \
            = b = 1 时两步归零。步长改变时 a、b 随之改变，因此调好的参数换个步长就不再合适。",
    },
    obtained: Words {
        en: "Marks: Schur and Cohn's conditions on the matrix of the step, `ViolationStep::decays`. Lines: the closed borders.",
        zh: "标记：对单步矩阵应用 Schur–Cohn 判据（`ViolationStep::decays`）；线：闭式边界。",
    },
    command: "moreau verify --explain S9.baumgarte-tuning",
    claims: &["S9.baumgarte-tuning", "S9.baumgarte-eq", "S9.bullet-erp"],
    draw: |_| baumgarte()?.svg(),
};

/// The largest stable s = hω of a method at a damping ratio, by bisection from below.
fn bound(method: &impl Method, damping_ratio: f64) -> f64 {
    let spring = SpringDamper::of_ratio(exact(damping_ratio));
    let stable = |s: f64| spectral_radius(&method.jacobian(&spring, &Phase::of_one(1.0, 0.0), &s)) <= 1.0;
    let (mut low, mut high) = (0.0, 16.0);
    for _ in 0..50 {
        let middle = 0.5 * (low + high);
        if stable(middle) { low = middle } else { high = middle }
    }
    low
}

const EXPLICIT: SemiImplicitEuler = SemiImplicitEuler { damping: Damping::Explicit };
const IMPLICIT: SemiImplicitEuler = SemiImplicitEuler { damping: Damping::Implicit };

fn quarter() -> Theta {
    Theta { theta: exact(0.25) }
}

fn regions() -> Result<Sheet> {
    let lines = || evenly(0.02, 1.5, 120);
    let marks = || evenly(0.1, 1.5, 14);
    let lower = || evenly(0.1, 1.0, 9);
    let series = vec![
        Series::line(0, "explicit Euler", curve(lines(), |ratio| spring_damper::theta(0.0, ratio))),
        Series::dots(0, "", curve(marks(), |ratio| bound(&ExplicitEuler, ratio))),
        Series::line(1, "θ = ¼", curve(lines(), |ratio| spring_damper::theta(0.25, ratio))),
        Series::dots(1, "", curve(marks(), |ratio| bound(&quarter(), ratio))),
        Series::line(2, "semi-implicit Euler, damping explicit", curve(lines(), spring_damper::semi_implicit)),
        Series::dots(2, "", curve(marks(), |ratio| bound(&EXPLICIT, ratio))),
        Series::line(3, "semi-implicit Euler, damping implicit", curve(lines(), spring_damper::semi_implicit_with_implicit_damping)),
        Series::dots(3, "", curve(marks(), |ratio| bound(&IMPLICIT, ratio))),
        Series::dots(4, "Runge–Kutta, order 4", curve(lower(), |ratio| bound(&RungeKutta, ratio))),
    ];
    let y = Axis::linear("largest h ω [rad]").within(0.0, 7.0);
    Ok(Sheet::column(vec![Chart::new(Axis::linear("damping ratio ζ [1]").within(0.0, 1.53), y, series)]))
}

fn step(a: f64, b: f64) -> ViolationStep<f64> {
    ViolationStep { damping: a, stiffness: b * b }
}

fn baumgarte() -> Result<Sheet> {
    let mut region = vec![[0.0, 0.0]];
    region.extend(curve(evenly(0.0, 2.0, 60), |b| 2.0 - 0.5 * b * b));
    let grid: Vec<[f64; 2]> = evenly(0.1, 2.3, 11).flat_map(|b| evenly(-0.1, 2.3, 12).map(move |a| [b, a])).collect();
    let (decaying, other): (Vec<[f64; 2]>, Vec<[f64; 2]>) = grid.into_iter().partition(|[b, a]| step(*a, *b).decays());
    let (swinging, plain): (Vec<[f64; 2]>, Vec<[f64; 2]>) = decaying.into_iter().partition(|[b, a]| step(*a, *b).oscillates());
    let erp = 0.2f64;
    let series = vec![
        Series::new("2a + b² < 4", Ink::of(0).solid(), Shape::Region(region)),
        Series::line(1, "critical: a = 2b − b²", curve(evenly(0.0, 2.0, 60), |b| 2.0 * b - b * b)),
        Series::new("decays, swinging", Ink::of(2).marked(Mark::Circle), Shape::Dots(swinging)),
        Series::dots(0, "decays", plain),
        Series::new("does not decay", Ink::of(3).marked(Mark::Cross), Shape::Dots(other)),
        Series::new("two steps", Ink::of(1).marked(Mark::Square), Shape::Dots(vec![[1.0, 1.0]])),
        Series::new("Bullet, ERP 0.2", Ink::of(6).marked(Mark::Triangle), Shape::Dots(vec![[erp.sqrt(), 1.0]])),
    ];
    let chart = Chart::new(Axis::linear("b = βh [1]").within(0.0, 2.4), Axis::linear("a = 2αh [1]").within(-0.2, 2.4), series);
    Ok(Sheet::column(vec![chart]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_exact::tolerance::rounding;

    #[test]
    fn measured_bounds_are_the_closed_ones() {
        for ratio in [0.1, 0.7, 1.3] {
            // where the radius leaves 1 it does so with a slope of order one
            let near = |found: f64, form: f64| assert!((found - form).abs() <= rounding(4096, form), "{ratio}: {found} against {form}");
            near(bound(&ExplicitEuler, ratio), spring_damper::theta(0.0, ratio));
            near(bound(&quarter(), ratio), spring_damper::theta(0.25, ratio));
            near(bound(&EXPLICIT, ratio), spring_damper::semi_implicit(ratio));
            near(bound(&IMPLICIT, ratio), spring_damper::semi_implicit_with_implicit_damping(ratio));
        }
        let (found, form) = (bound(&RungeKutta, 1.0), spring_damper::runge_kutta_critical());
        assert!((found - form).abs() <= rounding(1 << 30, form), "a double eigenvalue is known to half the digits: {found} against {form}");
    }

    #[test]
    fn a_violation_decays_where_the_powers_of_its_step_do() {
        for (a, b, expected) in [(1.0, 1.0, true), (1.0, 0.2f64.sqrt(), true), (1.9, 1.0, false), (-0.1, 0.5, false), (0.5, 1.7, true)] {
            let step = step(a, b);
            let mut state = [1.0, 0.0];
            (0..400).for_each(|_| state = step.advance(&state));
            assert_eq!(state[0].abs() < 0.5, expected, "{a} {b}: {state:?}");
            assert_eq!(step.decays(), expected);
            assert_eq!(step.decays(), a > 0.0 && 2.0 * a + b * b < 4.0);
        }
        assert!(step(0.74, 0.5).oscillates() && !step(0.76, 0.5).oscillates(), "either side of a = 2b − b²");
    }
}
