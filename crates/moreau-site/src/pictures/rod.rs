//! The rod that touches a rough floor with one end: Painlevé's regions, the gain of energy under Newton's law, one impact under three laws.

use super::parts::{curve, evenly, short};
use crate::picture::Picture;
use crate::words::Words;
use moreau_checks::plot::{Axis, Chart, Ink, Series, Shape, Sheet};
use moreau_contact::contact::delassus::delassus;
use moreau_contact::problem::{PlanarProblem, Response};
use moreau_dynamics::impact_laws::routh::Path;
use moreau_dynamics::impact_laws::{newton, poisson, stronge};
use moreau_dynamics::mechanics::{Mechanism, PainleveRod};
use moreau_exact::Result;
use nalgebra::{DMatrix, dmatrix, dvector};

pub(super) const PAINLEVE: Picture = Picture {
    id: "painleve-regions",
    question: Words {
        en: "For which angles and frictions has a sliding rod no force, or two?",
        zh: "滑动的杆在哪些倾角与摩擦系数下没有接触力解，或有两个解？",
    },
    caption: Words {
        en: "A uniform rod slides on a floor with its lower end ahead, away from the side it leans to. Below the curve one \
            sliding force exists. Above it W_nn + μ W_nt < 0: pushing harder makes the end approach faster, and there is none or \
            there are two – Painlevé's paradox. The curve is (1 + 3c²)/(3 s c) and never falls below μ = 4/3. Impulses resolve the \
            paradox: the slide ends at once, an impact without collision.",
        zh: "均质杆以下端在前的方式在地面上滑动，即背离其倾斜的一侧。曲线下方存在唯一的滑动接触力；曲线上方 W_nn + μ W_nt < 0：压得越紧，杆端接近得越快，接触力或者无解，或者有两个解——即 Painlevé 悖论。曲线为 (1 + 3c²)\
            /(3 s c)，最低点 μ = 4/3。用冲量描述即可化解：滑动瞬间终止，成为“无碰撞的冲击”。",
    },
    obtained: Words {
        en: "Marks: the friction at which the sign of W_nn + μ W_nt changes, by bisection on the Delassus operator of \
            `PainleveRod`.",
        zh: "标记：由 `PainleveRod` 的 Delassus 算子对 W_nn + μ W_nt 的符号作二分得到的临界摩擦；曲线为闭式。",
    },
    command: "moreau verify --explain S4.painleve",
    claims: &["S4.painleve", "S4.painleve-atom", "S11.painleve"],
    draw: |_| painleve()?.svg(),
};

pub(super) const GAIN: Picture = Picture {
    id: "energy-gain-of-the-rod",
    question: Words { en: "When does Newton's impact law create energy?", zh: "Newton 碰撞定律何时会凭空产生能量？" },
    caption: Words {
        en: "A rod of 1 kg hits a rough floor with one end, U⁻ = (−1, 0.6) m/s, e = 0.9. Shades tell by which share of the \
            energy of the contact, ½U⁻ᵀW⁻¹U⁻, the impact changes it under Newton's law along Routh's path; the two darkest gain. The \
            law prescribes a velocity, whatever energy friction leaves for it. Stronge's law, which prescribes the ratio of works, \
            gains nowhere.",
        zh: "1 kg 的杆以一端撞击粗糙地面，U⁻ = (−1, 0.6) m/s，e = 0.9。色阶表示沿 Routh 路径按 Newton 定律碰撞后，接触能量 ½U⁻ᵀW⁻¹U⁻ 的相对变化；最深的两级表示能量增加。\
            该定律只规定法向速度，而不问摩擦还剩多少能量可用。Stronge 定律规定功的比值，处处不增能量。",
    },
    obtained: Words {
        en: "Newton's law along Routh's path (`impact_laws`) on a grid of 60 × 40; the energy is ½Pᵀ(U⁺ + U⁻).",
        zh: "在 60 × 40 网格上用 `impact_laws` 的 Routh 路径与 Newton 定律计算；能量变化为 ½Pᵀ(U⁺ + U⁻)。",
    },
    command: "moreau verify --explain S7.kane-friction",
    claims: &["S7.kane-friction", "S7.stronge-no-gain", "S4.ex3-energy"],
    draw: |_| gain()?.svg(),
};

pub(super) const LAWS: Picture = Picture {
    id: "three-laws-on-one-path",
    question: Words {
        en: "Where do the laws of Newton, Poisson and Stronge end one impact?",
        zh: "同一次碰撞，Newton、Poisson 与 Stronge 定律各在何处结束？",
    },
    caption: Words {
        en: "The velocities of a rod's end while its normal impulse grows (Routh), at 45°, μ = 0.2, U⁻ = (−1, 0.6) m/s, e = \
            0.5. Compression ends where u_n = 0. The sliding stops on the way, and the path has a corner. Newton's law ends where u_n \
            = −e u_n⁻, Poisson's where the impulse is (1 + e) times that of compression, Stronge's where the normal force has given \
            back e² of its work. Without friction, or without the coupling W_nt, the three ends are one.",
        zh: "法向冲量增长过程中杆端的速度（Routh 方法），倾角 45°，μ = 0.2，U⁻ = (−1, 0.6) m/s，e = 0.5。u_n = 0 处压缩阶段结束。途中滑动停止，路径出现折角。Newton 定律终止于 u_n \
            = −e u_n⁻，Poisson 定律终止于冲量达到压缩冲量的 (1 + e) 倍处，Stronge 定律终止于法向力归还 e² 的功处。若无摩擦或无耦合 W_nt，三者重合。",
    },
    obtained: Words {
        en: "The path of `impact_laws::routh` and the three laws along it.",
        zh: "由 `impact_laws::routh` 的路径及沿该路径的三条定律计算。",
    },
    command: "moreau verify --explain S7.definitions-differ",
    claims: &["S7.definitions-differ", "S7.routh", "S7.compression-end"],
    draw: |_| laws()?.svg(),
};

/// W of the rod at an angle \[rad\], 1 kg and half-length 1 m.
fn operator(angle: f64) -> Result<DMatrix<f64>> {
    let rod = PainleveRod::new(1.0, 1.0, 9.81, 0.0, 0.0)?;
    let position = dvector![0.0, angle.sin(), angle];
    delassus(&rod.mass_matrix(&position), &rod.contacts(&position)[0].jacobian.to_dense())
}

/// The friction at which pushing no longer opens the contact, by bisection.
fn critical(angle: f64) -> Result<f64> {
    let w = operator(angle)?;
    let opens = |friction: f64| w[(0, 0)] + friction * w[(0, 1)] > 0.0;
    let (mut low, mut high) = (0.0, 1e3);
    for _ in 0..80 {
        let middle = 0.5 * (low + high);
        if opens(middle) { low = middle } else { high = middle }
    }
    Ok(0.5 * (low + high))
}

fn painleve() -> Result<Sheet> {
    let form = |degrees: f64| {
        let (s, c) = degrees.to_radians().sin_cos();
        (1.0 + 3.0 * c * c) / (3.0 * s * c)
    };
    let border = curve(evenly(10.0, 88.0, 400), form);
    let found = evenly(27.0, 81.0, 18).map(|degrees| Ok([degrees, critical(degrees.to_radians())?])).collect::<Result<Vec<_>>>()?;
    let mut paradox = border.clone();
    paradox.extend([[88.0, 30.0], [10.0, 30.0]]);
    let series = vec![
        Series::new("none, or two", Ink::of(1).solid(), Shape::Region(paradox)),
        Series::exact("(1 + 3c²)/(3 s c)", border),
        Series::dots(0, "W_nn + μ W_nt = 0", found),
        Series::words(vec![([60.0, 2.3], "no sliding force, or two".into()), ([30.0, 0.7], "one sliding force".into())]),
    ];
    let chart = Chart::new(Axis::linear("angle [°]").within(0.0, 90.0), Axis::linear("friction μ [1]").within(0.0, 3.0), series);
    Ok(Sheet::column(vec![chart]))
}

const RESTITUTION: f64 = 0.9;

fn path(angle: f64, friction: f64) -> Result<Path<f64>> {
    let w = operator(angle)?;
    let impact = PlanarProblem::new(dmatrix![w[(0, 0)], w[(0, 1)]; w[(1, 0)], w[(1, 1)]], dvector![-1.0, 0.6]);
    Path::new(impact, &friction)
}

/// ½Pᵀ(U⁺ + U⁻)/(½U⁻ᵀW⁻¹U⁻).
fn share(path: &Path<f64>, response: &Response<f64>) -> f64 {
    let impact = path.impact();
    let change = 0.5 * response.impulse.dot(&(&response.after + &impact.velocity));
    let energy = 0.5 * impact.velocity.dot(&impact.delassus.clone().lu().solve(&impact.velocity).unwrap_or_default());
    change / energy
}

/// Upper ends of the shades, of the change of energy.
const SHADES: [(f64, &str); 5] = [
    (-0.4, "below −40 %"),
    (-0.2, "−40 to −20 %"),
    (0.0, "−20 to 0 %"),
    (0.2, "0 to +20 %, a gain"),
    (f64::INFINITY, "above +20 %, a gain"),
];

fn gain() -> Result<Sheet> {
    let (columns, rows) = (60, 40);
    let [degrees, frictions]: [Vec<f64>; 2] = [evenly(5.0, 85.0, columns).collect(), evenly(0.0, 2.0, rows).collect()];
    let mut cells: Vec<Vec<[[f64; 2]; 2]>> = vec![Vec::new(); SHADES.len()];
    for friction in frictions.windows(2) {
        let mut run: Option<(usize, [[f64; 2]; 2])> = None;
        for angle in degrees.windows(2) {
            let path = path((0.5 * (angle[0] + angle[1])).to_radians(), 0.5 * (friction[0] + friction[1]))?;
            let value = share(&path, &newton::along(&path, &RESTITUTION)?);
            let level = SHADES.iter().position(|(end, _)| value <= *end).unwrap_or(SHADES.len() - 1);
            match &mut run {
                Some((same, cell)) if *same == level => cell[1][0] = angle[1],
                _ => {
                    cells_of(&mut cells, run.take());
                    run = Some((level, [[angle[0], friction[0]], [angle[1], friction[1]]]));
                }
            }
        }
        cells_of(&mut cells, run);
    }
    let shaded = cells.into_iter().enumerate().filter(|(_, cells)| !cells.is_empty());
    let series = shaded.map(|(k, cells)| Series::new(SHADES[k].1, Ink::shade(k, SHADES.len()), Shape::Cells(cells))).collect();
    let chart = Chart::new(Axis::linear("angle [°]").within(5.0, 85.0), Axis::linear("friction μ [1]").within(0.0, 2.0), series);
    Ok(Sheet::column(vec![chart]))
}

fn cells_of(cells: &mut [Vec<[[f64; 2]; 2]>], run: Option<(usize, [[f64; 2]; 2])>) {
    if let Some((level, cell)) = run {
        cells[level].push(cell);
    }
}

const LAW: f64 = 0.5;
const LAW_FRICTION: f64 = 0.2;

/// The ends (p, u_n) of the three laws on the path.
fn ends() -> Result<[(&'static str, Response<f64>); 3]> {
    let path = path(std::f64::consts::FRAC_PI_4, LAW_FRICTION)?;
    Ok([("Newton", newton::along(&path, &LAW)?), ("Poisson", poisson::along(&path, &LAW)?), ("Stronge", stronge::along(&path, LAW)?)])
}

fn laws() -> Result<Sheet> {
    let path = path(std::f64::consts::FRAC_PI_4, LAW_FRICTION)?;
    let ends = ends()?;
    let last = ends.iter().map(|(_, end)| end.impulse[0]).fold(0.0, f64::max) * 1.1;
    let mut series = vec![
        Series::line(0, "u_n", curve(evenly(0.0, last, 200), |p| path.state(&p).normal)),
        Series::line(1, "u_t", curve(evenly(0.0, last, 200), |p| path.state(&p).tangential)),
        Series::dots(2, "end of compression", vec![[path.compression_end(), 0.0]]),
    ];
    for (k, (name, end)) in ends.into_iter().enumerate() {
        let label = format!("{name}, p = {} N·s", short((end.impulse[0] * 1e3).round() / 1e3));
        series.push(Series::dots([3, 0, 1][k], label, vec![[end.impulse[0], end.after[0]]]));
    }
    Ok(Sheet::column(vec![Chart::new(Axis::linear("normal impulse p [N·s]"), Axis::linear("velocity of the end [m/s]"), series)]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_exact::tolerance::rounding;
    use moreau_forms::SlidingEdge;
    use moreau_forms::rough_impact::RoughImpact;

    #[test]
    fn the_border_is_that_of_a_sliding_edge_and_its_lowest_friction_is_four_thirds() {
        for degrees in [35.0f64, 45.0, 63.0, 80.0] {
            let (s, c) = degrees.to_radians().sin_cos();
            let edge = SlidingEdge { mass: 1.0, inertia: 1.0 / 3.0, arm: [c, s] };
            let found = critical(degrees.to_radians()).expect("a rod");
            assert!((found - edge.critical_friction()).abs() <= rounding(64, 8.0), "{degrees}: {found}");
        }
        // tan θ = 2 makes (1 + 3c²)/(3 s c) smallest
        assert!((critical(2f64.atan()).expect("a rod") - 4.0 / 3.0).abs() <= rounding(64, 8.0));
    }

    #[test]
    fn energies_and_ends_are_those_of_the_closed_forms() {
        for (degrees, friction) in [(30.0f64, 0.3), (45.0, 0.8), (70.0, 1.5)] {
            let path = path(degrees.to_radians(), friction).expect("an impact");
            let (s, c) = degrees.to_radians().sin_cos();
            let form = RoughImpact::rod(&1.0, [c, s], [-1.0, 0.6], friction);
            let [nn, nt, tt] = form.delassus;
            let energy = 0.5 * (tt + 1.2 * nt + 0.36 * nn) / (nn * tt - nt * nt);
            let expected = form.energy_change(&form.newton(&RESTITUTION)) / energy;
            let found = share(&path, &newton::along(&path, &RESTITUTION).expect("an end"));
            assert!((found - expected).abs() <= rounding(512, 4.0), "{degrees}: {found} against {expected}");
            assert!(share(&path, &stronge::along(&path, RESTITUTION).expect("an end")) <= rounding(512, 4.0));
        }
        let form = RoughImpact::rod(&1.0, [0.5f64.sqrt(), 0.5f64.sqrt()], [-1.0, 0.6], LAW_FRICTION);
        let ends = ends().expect("an impact");
        assert!((ends[0].1.impulse[0] - form.newton(&LAW)[0]).abs() <= rounding(128, 2.0));
        assert!((ends[1].1.impulse[0] - form.poisson(&LAW)[0]).abs() <= rounding(128, 2.0));
    }
}
