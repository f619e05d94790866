//! Soft contact beside hard: filled-in graphs, MuJoCo's impedance, the bounce of a spring and damper, and how deep loads push.

use super::parts::{GRAVITY, by_ratio, curve, evenly, short};
use crate::picture::Picture;
use crate::words::Words;
use moreau_checks::plot::{Axis, Chart, Ink, Series, Shape, Sheet};
use moreau_exact::Result;
use moreau_forms::compliant_impact::CompliantImpact;
use moreau_forms::drake_sap::{SapContact, TANGENTIAL_RATIO};
use moreau_forms::huber::Huber;
use moreau_forms::mujoco_contact::ContactParameters;
use moreau_forms::rapier_contact::rest_depth;
use moreau_forms::regularised_friction::FrictionCurve;

pub(super) const GRAPHS: Picture = Picture {
    id: "filled-in-graphs",
    question: Words {
        en: "What does softening do to the laws of Signorini and Coulomb?",
        zh: "软化（正则化）把 Signorini 与 Coulomb 定律变成了什么？",
    },
    caption: Words {
        en: "Both laws are graphs with vertical pieces, drawn grey: at φ = 0 every force ≥ 0 is possible, at slip 0 every \
            friction up to μ f_n. Regularisation replaces them by functions. The price is seen where a load is to be carried: a \
            penetration f/k > 0, and a slip > 0 under every friction below μ f_n – creep. The Huber row of MuJoCo and Drake's curves \
            differ in shape, not in this.",
        zh: "两条定律都是带竖直段的图（灰线）：φ = 0 处任何非负法向力都可能，滑动速度为 0 时摩擦力可取 μ f_n 以内的任何值，即集值符号函数。正则化用单值函数取而代之。代价在承受载荷时显现：必有穿透 f/k > 0，且任何小于 \
            μ f_n 的摩擦力都伴随非零滑动——蠕滑。MuJoCo 的 Huber 行与 Drake 的曲线形状不同，但这一点相同。",
    },
    obtained: Words {
        en: "The curves of `huber` and `regularised_friction`, and penalties of two stiffnesses; μ f_n = 1 N, v_s = 10 mm/s.",
        zh: "由 `huber` 与 `regularised_friction` 的闭式及两种刚度的罚函数给出；μ f_n = 1 N，v_s = 10 mm/s。",
    },
    command: "moreau verify --explain S2.soft-limit",
    claims: &["S2.soft-limit", "S6.huber-box", "S3.moreau-env", "S2.branches"],
    draw: |_| graphs()?.svg(),
};

pub(super) const IMPEDANCE: Picture = Picture {
    id: "mujoco-impedance",
    question: Words { en: "How does MuJoCo's contact harden with depth?", zh: "MuJoCo 的接触怎样随穿透深度变硬？" },
    caption: Words {
        en: "The impedance d over the penetration, `solimp` = (0.9, 0.95, 1 mm, 0.5, p). It goes from 0.9 at the surface to \
            0.95 at 1 mm and stays there; the power p shapes the way. R = (1−d)/d · Â is what the contact gives way by: between \
            surface and width it falls by about half, so a deeper contact is harder, and never hard.",
        zh: "阻抗 d 随穿透深度的变化，`solimp` = (0.9, 0.95, 1 mm, 0.5, p)。d 从表面的 0.9 升到 1 mm 处的 0.95 后保持不变，幂次 p 决定过渡形状。R = (1−d)/d · Â \
            决定接触的柔度：从表面到该宽度约减半，因此压得越深越硬，但永远不是刚性。",
    },
    obtained: Words {
        en: "`ContactParameters::impedance_at` with three powers; R/Â beside it.",
        zh: "由 `ContactParameters::impedance_at` 按三种幂次计算；右图为 R/Â。",
    },
    command: "moreau verify --explain S6.impedance-curve",
    claims: &["S6.impedance-curve", "S6.impedance-range", "S6.R-formula", "S6.solimp-default"],
    draw: |_| impedance()?.svg(),
};

pub(super) const BOUNCE: Picture = Picture {
    id: "bounce-of-a-spring-and-damper",
    question: Words {
        en: "How high bounces what lands on a spring and a damper?", zh: "落在弹簧–阻尼接触上的物体会弹多高？"
    },
    caption: Words {
        en: "The coefficient of restitution of a linear spring and damper over its damping ratio ζ. If the contact may pull \
            until the gap opens, it is exp(−πζ/√(1−ζ²)) and nothing bounces from ζ = 1 on. Engines whose contact may not pull let go \
            as soon as the force would: e is larger, and critical damping still bounces with e = e⁻² = 0.135. Marks are integrated.",
        zh: "线性弹簧–阻尼接触的恢复系数随阻尼比 ζ 的变化。若允许接触力为拉力直到间隙张开，e = exp(−πζ/√(1−ζ²))，ζ ≥ 1 时不再反弹。不允许拉力的引擎在力变号时即脱开：e 更大，临界阻尼下仍以 e = e⁻² = \
            0.135 反弹。标记为数值积分结果。",
    },
    obtained: Words {
        en: "Lines: `CompliantImpact`. Marks: the flight out of the contact, integrated with θ = ½ in 4000 steps per radian.",
        zh: "线：`CompliantImpact` 闭式；标记：用 θ = ½（每弧度 4000 步）积分接触过程直至脱离。",
    },
    command: "moreau verify --explain S6.zeta-bounce",
    claims: &["S6.zeta-bounce", "S8.spring-damper-model", "S7.e-not-material"],
    draw: |_| bounce()?.svg(),
};

pub(super) const LOAD: Picture = Picture {
    id: "penetration-over-load",
    question: Words { en: "How deep does a light box sink under a heavy stack?", zh: "轻箱被重物压住时会陷入多深？" },
    caption: Words {
        en: "The rest depth of one contact of a body of 1 kg that carries a load, in units of its own weight. MuJoCo's depth \
            depends on the inertia of the body that is pressed: beyond a millimetre it grows in proportion to the mass ratio. Drake's \
            SAP has a stiffness of its own, limited by what the step resolves. Rapier's grows in proportion from the start. A hard \
            contact has depth 0 at every load, and no place on this axis.",
        zh: "质量 1 kg 的物体承受载荷（以自重为单位）时单个接触的静止穿透深度。MuJoCo 的深度取决于被压物体的惯量：超过约 1 mm 后与质量比成正比。Drake 的 SAP 有自己的刚度，并受步长可分辨刚度的限制。Rapier \
            从一开始就成正比。硬接触在任何载荷下深度为 0，在此坐标上无处可画。",
    },
    obtained: Words {
        en: "The engines' own models: `mujoco_contact`, `drake_sap` with h = 10 ms and k = 10⁵ N/m, `rapier_contact` with 30 Hz.",
        zh: "由各引擎自身模型的闭式计算：`mujoco_contact`、`drake_sap`（h = 10 ms，k = 10⁵ N/m）、`rapier_contact`（30 Hz）。",
    },
    command: "moreau simulate --scene box-stack --scheme mujoco --step 0.005",
    claims: &["S6.rest-penetration", "S2.penetration-zero", "S9.penetration-rigid-vs-soft", "S6.less-rigid-than-sap"],
    draw: |_| load()?.svg(),
};

/// v_s \[m/s\] of the regularised curves.
const STICTION: f64 = 0.01;

fn huber(slip: f64) -> f64 {
    // the row's R turns a slip in units of v_s into a force up to 1 N
    Huber { bound: 1.0, regularisation: STICTION }.force(&slip)
}

fn graphs() -> Result<Sheet> {
    let penalty = |stiffness: f64| curve(evenly(-0.002, 0.001, 300), move |gap| stiffness * (-gap).max(0.0));
    let kept = |points: Vec<[f64; 2]>| points.into_iter().filter(|[_, force]| *force <= 4.0).collect::<Vec<_>>();
    let signorini = vec![
        Series::exact("0 ≤ φ ⟂ f ≥ 0", vec![[0.0, 4.0], [0.0, 0.0], [0.001, 0.0]]),
        Series::line(0, "k = 2000 N/m", penalty(2000.0)),
        Series::line(1, "k = 10000 N/m", kept(penalty(10_000.0))),
    ];
    let range = 0.05;
    let signed = |c: FrictionCurve| move |slip: f64| -slip.signum() * c.strength(slip.abs() / STICTION);
    let places = || evenly(-range, range, 400);
    let coulomb = vec![
        Series::exact("−Sgn(u_t)", vec![[-range, 1.0], [0.0, 1.0], [0.0, -1.0], [range, -1.0]]),
        Series::line(0, "Drake Similar", curve(places(), signed(FrictionCurve::Sigmoid))),
        Series::line(1, "Drake TAMSI", curve(places(), signed(FrictionCurve::Parabola))),
        Series::line(2, "Huber", curve(places(), huber)),
    ];
    Ok(Sheet::pairs(vec![
        Chart::new(Axis::linear("gap φ [m]"), Axis::linear("f_n [N]").within(-0.3, 4.3), signorini).titled("Signorini"),
        Chart::new(Axis::linear("slip u_t [m/s]"), Axis::linear("f_t [N]").within(-1.2, 1.2), coulomb).titled("Coulomb"),
    ]))
}

/// MuJoCo's default with another power.
fn powered(power: f64) -> ContactParameters {
    let mut parameters = ContactParameters::default();
    parameters.impedance[4] = power;
    parameters
}

fn impedance() -> Result<Sheet> {
    let millimetres = || evenly(0.0, 1.5, 150);
    let (mut impedances, mut softness) = (Vec::new(), Vec::new());
    for (k, power) in [1.0, 2.0, 5.0].into_iter().enumerate() {
        let at = |depth: f64| powered(power).impedance_at(depth / 1000.0);
        let label = format!("p = {}", short(power));
        impedances.push(Series::line(k, label.clone(), curve(millimetres(), at)));
        softness.push(Series::line(k, label, curve(millimetres(), |depth| (1.0 - at(depth)) / at(depth))));
    }
    let depth = || Axis::linear("depth [mm]");
    Ok(Sheet::pairs(vec![Chart::new(depth(), Axis::linear("d [1]"), impedances), Chart::new(depth(), Axis::linear("R/Â [1]"), softness)]))
}

/// −v⁺/v⁻ of ẍ = −x − 2ζẋ from (0, −1), until the force or the gap ends the contact.
fn rebound(damping_ratio: f64, may_pull: bool) -> f64 {
    let h = 1.0 / 4000.0;
    let (mut x, mut v) = (0.0f64, -1.0f64);
    for _ in 0..80_000 {
        let force = -x - 2.0 * damping_ratio * v;
        if (may_pull && x > 0.0) || (!may_pull && v > 0.0 && force <= 0.0) {
            return v;
        }
        // v⁺ = v − h (x + ½h (v + v⁺)/1 · …), the midpoint rule of a linear force solved for v⁺
        let held = 1.0 + h * damping_ratio + 0.25 * h * h;
        let next = (v * (1.0 - h * damping_ratio - 0.25 * h * h) - h * x) / held;
        x += 0.5 * h * (v + next);
        v = next;
    }
    0.0
}

fn of_ratio(damping_ratio: f64) -> Result<CompliantImpact> {
    CompliantImpact::new(1.0, 1.0, 2.0 * damping_ratio)
}

fn bounce() -> Result<Sheet> {
    let ratios: Vec<f64> = evenly(0.0, 1.5, 150).collect();
    let line =
        |form: fn(&CompliantImpact) -> f64| ratios.iter().map(|ratio| Ok([*ratio, form(&of_ratio(*ratio)?)])).collect::<Result<Vec<_>>>();
    let marks = |may_pull: bool| curve(evenly(0.1, 1.4, 13), move |ratio| rebound(ratio, may_pull));
    let series = vec![
        Series::line(0, "may pull: exp(−πζ/√(1−ζ²))", line(CompliantImpact::restitution_with_adhesion)?),
        Series::line(1, "may not pull", line(CompliantImpact::restitution_cut)?),
        Series::dots(0, "integrated, may pull", marks(true)),
        Series::dots(1, "integrated, may not pull", marks(false)),
    ];
    Ok(Sheet::column(vec![Chart::new(Axis::linear("damping ratio ζ [1]"), Axis::linear("restitution e [1]"), series)]))
}

fn mujoco_depth(ratio: f64) -> Result<f64> {
    ContactParameters::default().rest_depth(0.01, 1.0, ratio * GRAVITY)
}

fn sap_depth(ratio: f64) -> f64 {
    let contact = SapContact {
        time_step: 0.01,
        stiffness: 1e5,
        relaxation_time: 0.0,
        diagonal_mean: 3f64.sqrt() / 3.0,
        tangential_ratio: TANGENTIAL_RATIO,
        friction: 0.5,
    };
    -contact.rest_gap(ratio * GRAVITY)
}

fn load() -> Result<Sheet> {
    let ratios: Vec<f64> = by_ratio(1.0, 1000.0, 60).collect();
    let millimetres = |depth: f64| 1000.0 * depth;
    let mujoco = ratios.iter().map(|ratio| Ok([*ratio, millimetres(mujoco_depth(*ratio)?)])).collect::<Result<Vec<_>>>()?;
    let series = vec![
        Series::line(0, "MuJoCo, default", mujoco),
        Series::line(1, "Drake SAP, k = 1e5 N/m", curve(ratios.iter().copied(), |ratio| millimetres(sap_depth(ratio)))),
        Series::line(2, "Rapier, 30 Hz", curve(ratios.into_iter(), |ratio| millimetres(rest_depth(30.0, 1.0, ratio * GRAVITY)))),
        Series::new("width of solimp, 1 mm", Ink::thin(), Shape::Line(vec![[1.0, 1.0], [1000.0, 1.0]])),
    ];
    Ok(Sheet::column(vec![Chart::new(Axis::logarithmic("load over own weight [N/N]"), Axis::logarithmic("rest depth [mm]"), series)]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_exact::tolerance::rounding;
    use moreau_forms::soft_impedance::SoftImpedance;

    #[test]
    fn the_huber_row_is_the_projection_on_its_bounds() {
        for slip in [-0.03, -0.004, 0.0, 0.009, 0.02] {
            assert!((huber(slip) - (-slip / STICTION).clamp(-1.0, 1.0)).abs() <= rounding(8, 4.0), "{slip}");
        }
    }

    #[test]
    fn the_impedance_is_that_of_the_exact_form() {
        for (power, depth) in [(1, 0.0004), (2, 0.0004), (2, 0.0008), (5, 0.0003), (5, 0.002)] {
            let exact = SoftImpedance { power, ..SoftImpedance::<f64>::standard() }.at(&depth);
            assert!((powered(f64::from(power)).impedance_at(depth) - exact).abs() <= rounding(64, 1.0), "{power} {depth}");
        }
    }

    #[test]
    fn integrated_bounces_are_the_closed_ones() {
        for ratio in [0.1, 0.5, 0.9, 1.3] {
            let form = of_ratio(ratio).expect("valid");
            // the contact ends within a step of 1/4000
            let room = 4.0 / 4000.0;
            assert!((rebound(ratio, true) - form.restitution_with_adhesion()).abs() <= room, "{ratio}");
            assert!((rebound(ratio, false) - form.restitution_cut()).abs() <= room, "{ratio}");
        }
        assert!((of_ratio(1.0).expect("valid").restitution_cut() - (-2f64).exp()).abs() <= rounding(64, 1.0));
    }

    #[test]
    fn depths_carry_their_loads() {
        for ratio in [1.0, 30.0, 1000.0] {
            let depth = mujoco_depth(ratio).expect("valid");
            let d = ContactParameters::default().impedance_at(depth);
            // k = 1/(d_w t_c)², k d² δ = (1 − d) f
            let stiffness = 1.0 / (0.95f64 * 0.02).powi(2);
            let force = ratio * GRAVITY;
            assert!((stiffness * d * d * depth - (1.0 - d) * force).abs() <= rounding(256, force), "{ratio}");
        }
        assert!((mujoco_depth(1000.0).expect("valid") / mujoco_depth(100.0).expect("valid") - 10.0).abs() <= rounding(512, 10.0));
        // SAP: the nearer of f/k and what a contact of the period 2πh carries, f h² w/(4π²)
        let softest = (1.0f64 / 1e5).max(0.01 * 0.01 * 3f64.sqrt() / 3.0 / (4.0 * std::f64::consts::PI.powi(2)));
        assert!((sap_depth(7.0) - 7.0 * GRAVITY * softest).abs() <= rounding(64, 1.0) * softest * 70.0);
    }
}
