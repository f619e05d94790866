//! A block on a slope: the gap that a convex scheme keeps while it slides, and the speed at which engines let it creep.

use super::parts::{GRAVITY, by_ratio, motion, samples, short};
use crate::picture::Picture;
use crate::words::Words;
use moreau_checks::plot::{Axis, Chart, Series, Sheet};
use moreau_dynamics::mechanics::PointMass;
use moreau_dynamics::schemes::{Anitescu, Scheme};
use moreau_exact::Result;
use moreau_forms::InclineBlock;
use moreau_forms::drake_sap::{SapContact, TANGENTIAL_RATIO};
use moreau_forms::mujoco_contact::ContactParameters;
use moreau_forms::regularised_friction::FrictionCurve;
use moreau_replicas::drake::Material;
use moreau_replicas::schemes::{SchemeParameters, by_name};
use nalgebra::dvector;

/// 20°.
const ANGLE: f64 = std::f64::consts::PI / 9.0;
/// μ < tan 20°, and μ > tan 20°.
const SLIDING: f64 = 0.3;
const STICKING: f64 = 0.5;

pub(super) const GLIDING: Picture = Picture {
    id: "gliding-gap",
    question: Words { en: "What is the price of a convex contact problem?", zh: "把接触问题凸化，要付出什么代价？" },
    caption: Words {
        en: "A block slides down a slope of 20° with μ = 0.3 under Anitescu's convex scheme. It does not touch the slope: it \
            floats at the height φ = μ h v_t, which grows with its speed and vanishes with the step. Grey is that height for the exact \
            speed. A block that sticks shows nothing of this: the hard relaxation has no creep.",
        zh: "物块沿 20° 斜面下滑，μ = 0.3，采用 Anitescu 凸格式。物块并不贴着斜面，而是悬浮在间隙 φ = μ h v_t 处：间隙随速度增大，随步长趋于零。灰线是由精确速度算出的该间隙。粘滞的物块则没有这种误差：\
            硬接触的凸松弛不产生蠕滑。",
    },
    obtained: Words {
        en: "Simulated by the scheme `anitescu` at three steps; the speed of the grey lines is `InclineBlock`.",
        zh: "由 `anitescu` 格式以三种步长仿真；灰线的速度取自 `InclineBlock` 闭式解。",
    },
    command: "moreau simulate --scene incline-slide --scheme anitescu --step 0.01",
    claims: &["S5.glide-h-not-mu", "S5.Oh-vanish", "S5.gliding-creep"],
    draw: |_| gliding()?.svg(),
};

pub(super) const CREEP: Picture = Picture {
    id: "creep-over-step",
    question: Words {
        en: "Whose block creeps down a slope where it should stick?", zh: "本应粘滞的物块，在哪些引擎里会缓慢下滑？"
    },
    caption: Words {
        en: "A block of 1 kg on a slope of 20° with μ = 0.5 > tan 20°. Grey lines are the engines' own models, marks are our \
            replicas of their steps. Drake's SAP creeps in proportion to the step; MuJoCo's elliptic cone and Drake's regularised \
            friction creep at a speed that no step makes smaller; more `impratio` makes MuJoCo's smaller, and beyond h = 10 ms its \
            time constant of two steps softens it. Moreau–Jean, Stewart–Trinkle and Anitescu stick exactly, and have no place on a \
            logarithmic axis.",
        zh: "质量 1 kg 的物块置于 20° 斜面，μ = 0.5 > tan 20°。灰线为各引擎自身模型的闭式解，标记为我们复现的引擎步进。Drake 的 SAP 蠕滑速度与步长成正比；MuJoCo 的椭圆锥与 Drake \
            的正则化摩擦以固定速度蠕滑，减小步长无济于事；增大 `impratio` 可减小 MuJoCo 的蠕滑，而 h 超过 10 ms 时其时间常数取两步之长，接触随之变软。Moreau–Jean、Stewart–Trinkle 与 Anitescu \
            精确粘滞，在对数坐标上无处可画。",
    },
    obtained: Words {
        en: "One second with each replica on one contact, its last speed; lines by `drake_sap`, `mujoco_contact` and \
            `regularised_friction`.",
        zh: "单接触点下各复现格式仿真 1 s 后的末速度；线由 `drake_sap`、`mujoco_contact` 与 `regularised_friction` 的闭式给出。",
    },
    command: "moreau compare incline-stick --schemes moreau-jean,anitescu,mujoco,drake-sap,drake-similar --step 0.005",
    claims: &["S5.gliding-creep", "S5.glide-h-not-mu", "Pr.sap-gliding", "S6.impratio", "R6"],
    draw: |_| creep()?.svg(),
};

/// The gap of a block that slides from rest, and of one that starts at this speed in its own gap.
fn gaps(h: f64) -> Result<Vec<[f64; 2]>> {
    let block = PointMass::block_on_incline(1.0, GRAVITY, ANGLE, SLIDING, 0.0);
    let run = motion(&Anitescu, &block, [dvector![0.0, 0.0], dvector![0.0, 0.0]], h, (1.0 / h).round() as usize)?;
    Ok(samples(&run, |state| state.position[1]))
}

/// μ h v_t at the exact speed.
fn kept(h: f64, time: f64) -> Result<f64> {
    let slide = InclineBlock::new(GRAVITY, ANGLE, SLIDING, 0.0)?;
    Ok(SLIDING * h * slide.state(time).1)
}

fn gliding() -> Result<Sheet> {
    let mut series = Vec::new();
    for (k, h) in [0.02, 0.01, 0.005].into_iter().enumerate() {
        let label = if k == 0 { "μ h v_t" } else { "" };
        series.push(Series::exact(label, vec![[0.0, 0.0], [1.0, kept(h, 1.0)?]]));
        series.push(Series::line(k, format!("anitescu, h = {} s", short(h)), gaps(h)?));
    }
    Ok(Sheet::column(vec![Chart::new(Axis::linear("t [s]"), Axis::linear("gap φ [m]"), series)]))
}

/// A replica whose block creeps, and the speed that its model predicts [m/s].
struct Creeping {
    label: &'static str,
    scheme: &'static str,
    impedance_ratio: f64,
    predicted: fn(f64) -> Result<f64>,
}

/// (normal, along the slope) [N].
fn loads() -> [f64; 2] {
    [GRAVITY * ANGLE.cos(), GRAVITY * ANGLE.sin()]
}

fn sap(h: f64) -> Result<f64> {
    let [stiffness, relaxation_time] = [Material::default().stiffness, Material::default().relaxation_time];
    // two rows of a body of 1 kg
    let diagonal_mean = 2f64.sqrt() / 3.0;
    let contact =
        SapContact { time_step: h, stiffness, relaxation_time, diagonal_mean, tangential_ratio: TANGENTIAL_RATIO, friction: STICKING };
    Ok(contact.creep_speed(loads()[1]))
}

fn mujoco(h: f64, impedance_ratio: f64) -> Result<f64> {
    let [normal, along] = loads();
    ContactParameters { impedance_ratio, ..ContactParameters::default() }.creep_speed(h, 1.0, normal, along)
}

fn regularised(curve: FrictionCurve) -> Result<f64> {
    let slip = curve.slip(ANGLE.tan() / STICKING).unwrap_or(f64::NAN);
    Ok(slip * Material::default().stiction_tolerance)
}

const CREEPING: [Creeping; 5] = [
    Creeping { label: "Drake SAP", scheme: "drake-sap", impedance_ratio: 1.0, predicted: sap },
    Creeping { label: "MuJoCo, elliptic", scheme: "mujoco", impedance_ratio: 1.0, predicted: |h| mujoco(h, 1.0) },
    Creeping { label: "MuJoCo, impratio 10", scheme: "mujoco", impedance_ratio: 10.0, predicted: |h| mujoco(h, 10.0) },
    Creeping { label: "Drake Similar", scheme: "drake-similar", impedance_ratio: 1.0, predicted: |_| regularised(FrictionCurve::Sigmoid) },
    Creeping { label: "Drake TAMSI", scheme: "drake-tamsi", impedance_ratio: 1.0, predicted: |_| regularised(FrictionCurve::Parabola) },
];

impl Creeping {
    fn scheme(&self) -> Result<Box<dyn Scheme>> {
        let mut parameters = SchemeParameters::default();
        parameters.mujoco.cone = moreau_replicas::mujoco::Cone::Elliptic;
        parameters.mujoco.softness.impedance_ratio = self.impedance_ratio;
        by_name(self.scheme, parameters)
    }

    /// The speed after a second [m/s].
    fn speed(&self, h: f64) -> Result<f64> {
        let block = PointMass::block_on_incline(1.0, GRAVITY, ANGLE, STICKING, 0.0);
        let start = [dvector![0.0, 0.0], dvector![0.0, 0.0]];
        let run = motion(self.scheme()?.as_ref(), &block, start, h, (1.0 / h).round() as usize)?;
        Ok(run.last().velocity[0])
    }
}

const STEPS: [f64; 3] = [0.01, 0.005, 0.002];

fn creep() -> Result<Sheet> {
    let mut series = Vec::new();
    for (k, creeping) in CREEPING.iter().enumerate() {
        let line = by_ratio(0.001, 0.02, 12).map(|h| Ok([h, (creeping.predicted)(h)?])).collect::<Result<Vec<_>>>()?;
        series.push(Series::exact(if k == 0 { "models" } else { "" }, line));
        let found = STEPS.into_iter().map(|h| Ok([h, creeping.speed(h)?])).collect::<Result<Vec<_>>>()?;
        series.push(Series::line(k, "", found.clone()));
        series.push(Series::dots(k, creeping.label, found));
    }
    Ok(Sheet::column(vec![Chart::new(Axis::logarithmic("h [s]"), Axis::logarithmic("creep [m/s]"), series)]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_exact::tolerance::rounding;

    #[test]
    fn the_gap_is_mu_h_v() {
        for h in [0.02, 0.005] {
            for [time, gap] in gaps(h).expect("a motion").into_iter().filter(|[time, _]| *time > 0.1) {
                let expected = kept(h, time).expect("valid");
                // from φ = 0 the height arrives a few steps late, and the speed with it
                assert!((gap - expected).abs() <= 4.0 * SLIDING * h * GRAVITY * h, "h = {h}, t = {time}: {gap} against {expected}");
            }
        }
    }

    #[test]
    fn replicas_creep_as_their_models_predict() {
        for creeping in &CREEPING {
            for h in STEPS {
                let (found, expected) = (creeping.speed(h).expect("a motion"), (creeping.predicted)(h).expect("valid"));
                assert!((found / expected - 1.0).abs() <= 0.01, "{} at {h}: {found} against {expected}", creeping.label);
            }
        }
    }

    #[test]
    fn hard_schemes_stick() {
        for scheme in ["moreau-jean", "stewart-trinkle", "anitescu"] {
            let hard = Creeping { label: scheme, scheme, impedance_ratio: 1.0, predicted: sap };
            // the solver stops within its tolerance at every one of the hundred steps
            assert!(hard.speed(0.01).expect("a motion").abs() <= 100.0 * rounding(64, 1.0), "{scheme}");
        }
    }

    #[test]
    fn creep_goes_with_the_step_under_sap_alone() {
        assert!((sap(0.01).expect("valid") / sap(0.001).expect("valid") - 10.0).abs() <= 64.0 * f64::EPSILON * 10.0);
        for creeping in &CREEPING[1..] {
            let [coarse, fine] = [0.01, 0.001].map(|h| (creeping.predicted)(h).expect("valid"));
            assert!((coarse / fine - 1.0).abs() <= 64.0 * f64::EPSILON, "{}", creeping.label);
        }
        // R_n = (1 − d)/d and R_t = R_n/impratio: ten times the ratio, a tenth of the creep
        let ratio = mujoco(0.01, 1.0).expect("valid") / mujoco(0.01, 10.0).expect("valid");
        assert!((ratio - 10.0).abs() <= 64.0 * f64::EPSILON * 10.0);
    }
}
