//! Friction cones: projections, de Saxcé's correction, and polyhedral approximations.

use super::parts::{curve, evenly};
use crate::picture::Picture;
use crate::words::Words;
use moreau_checks::plot::{Axis, Chart, Ink, Series, Shape, Sheet};
use moreau_contact::cones::de_saxce::correct;
use moreau_contact::cones::polyhedral::{contains, direction, direction_error, force_error, most_dissipative, strength_error};
use moreau_contact::cones::second_order::project;
use moreau_exact::Result;
use std::f64::consts::{PI, TAU};

/// μ of the cones.
const FRICTION: f64 = 0.6;

pub(super) const PROJECTION: Picture = Picture {
    id: "cone-projection",
    question: Words {
        en: "Where does the projection on the friction cone send an impulse?", zh: "向摩擦锥投影时，冲量会被送到哪里？"
    },
    caption: Words {
        en: "The plane of tangential and normal impulse, μ = 0.6. Inside the cone nothing moves (stick); from the polar cone, \
            below r_n = −μ|r_t|, everything goes to the apex (open); from elsewhere an impulse goes perpendicularly to the border (slip)\
            . A negative normal impulse alone does not open the contact. What the projection removes lies in the polar cone and is \
            perpendicular to what remains.",
        zh: "横轴切向冲量，纵轴法向冲量，μ = 0.6。锥内的点不动（粘滞）；极锥（r_n ≤ −μ|r_t|）内的点投到锥顶（分离）；其余的点垂直投到锥面（滑动）。法向冲量为负并不足以判定分离。被投影去掉的部分位于极锥内，且与保留的部分正交。",
    },
    obtained: Words {
        en: "Points projected by `cones::second_order::project`, which all solvers use.",
        zh: "由所有求解器共用的 `cones::second_order::project` 计算投影。",
    },
    command: "moreau verify --explain S5.proj-states",
    claims: &["S5.proj", "S5.proj-states", "S3.projection"],
    draw: |_| projection()?.svg(),
};

pub(super) const DE_SAXCE: Picture = Picture {
    id: "de-saxce-correction",
    question: Words {
        en: "How does Coulomb's law become a complementarity of dual cones?",
        zh: "Coulomb 摩擦定律如何化为对偶锥之间的互补关系？",
    },
    caption: Words {
        en: "Velocities of a contact that slides have u_n = 0 and lie below the dual cone K*. Adding μ‖u_t‖ to the normal \
            component lifts each of them onto the border of K*, perpendicular to the border of K on which the friction impulse lies: K \
            ∋ r ⟂ û ∈ K*. Without the correction the convex law moves the velocity itself onto that border: the block lifts off as it \
            slides.",
        zh: "滑动接触的相对速度满足 u_n = 0，位于对偶锥 K* 之下。在法向分量上加 μ‖u_t‖ 后，速度恰好被抬到 K* 的边界上，并与摩擦冲量所在的 K 的边界正交：K ∋ r ⟂ û ∈ K*。若不作该修正，\
            凸化的定律会把速度本身推到这条边界上：物块边滑动边抬起。",
    },
    obtained: Words { en: "Velocities moved by `cones::de_saxce::correct`.", zh: "由 `cones::de_saxce::correct` 对速度作修正。" },
    command: "moreau verify --explain S2.desaxce-incl",
    claims: &["S2.bipotential", "S2.desaxce-incl", "S5.nonconvex"],
    draw: |_| de_saxce()?.svg(),
};

pub(super) const POLYHEDRAL: Picture = Picture {
    id: "polyhedral-error",
    question: Words { en: "How many friction directions are enough?", zh: "多面体摩擦锥需要多少个方向才够？" },
    caption: Words {
        en: "The errors of a cone with d directions. The strength in its weakest direction errs by 1 − cos(π/d), of second \
            order in 1/d; the direction of the friction force by π/d, and the force itself by 2 sin(π/2d), of first order. “Of order \
            1/d” is true of the force and not of the shape. Eight directions lose 8 % of strength and may point 22.5° aside.",
        zh: "具有 d 个方向的多面体锥的误差。最弱方向上的强度误差为 1 − cos(π/d)，关于 1/d 二阶；摩擦力方向误差为 π/d、力矢量误差为 2 sin(π/2d)，均为一阶。所谓“误差 O(1/d)”指力而非锥的形状。\
            八个方向损失 8 % 的强度，方向最多偏 22.5°。",
    },
    obtained: Words {
        en: "Marks are measured: by bisection of the membership, and over 720 sliding directions. Lines are the closed forms.",
        zh: "标记为实测：强度由成员判定的二分法得到，方向误差遍历 720 个滑动方向；线为闭式。",
    },
    command: "moreau verify --explain M.cone-error",
    claims: &["M.cone-error", "S4.poly-order", "S4.d8"],
    draw: |_| polyhedral()?.svg(),
};

pub(super) const DIRECTION: Picture = Picture {
    id: "pyramid-direction",
    question: Words { en: "Does friction on a pyramid oppose the sliding?", zh: "多面体锥上的摩擦力与滑动方向相反吗？" },
    caption: Words {
        en: "The angle between the friction force of maximal dissipation and the direction opposite to sliding. With d \
            directions it picks the vertex nearest to that direction: right at d angles, wrong by up to π/d between them. The polygons \
            show why: friction along d directions is anisotropic, and a body that slides diagonally is turned aside.",
        zh: "最大耗散的摩擦力与滑动反方向之间的夹角。d 个方向的锥总是取最近的顶点：只在 d 个角度上准确，其间误差最多 π/d。右图的多边形说明原因：d 个方向的摩擦是各向异性的，斜向滑动的物体会被偏转。",
    },
    obtained: Words {
        en: "`cones::polyhedral::most_dissipative` over 720 sliding directions.",
        zh: "对 720 个滑动方向调用 `cones::polyhedral::most_dissipative`。",
    },
    command: "moreau verify --explain S4.aniso",
    claims: &["S4.aniso", "S4.maxdiss", "S5.apitfall-poly"],
    draw: |_| directions()?.svg(),
};

/// The projected point (t, n) of (t, n).
fn projected([tangential, normal]: [f64; 2]) -> [f64; 2] {
    let mut impulse = [normal, tangential];
    project(&mut impulse, FRICTION);
    [impulse[1], impulse[0]]
}

/// The points whose projections are drawn: a ring around the apex.
fn ring() -> Vec<[f64; 2]> {
    evenly(0.0, TAU, 20).take(20).map(|angle| [1.6 * (angle + 0.1).cos(), 1.6 * (angle + 0.1).sin()]).collect()
}

fn projection() -> Result<Sheet> {
    let (mut moved, mut kept) = (Vec::new(), Vec::new());
    for point in ring() {
        let image = projected(point);
        if image == point { kept.push(point) } else { moved.push([point, image]) }
    }
    let cone = vec![[0.0, 0.0], [9.0 * FRICTION, 9.0], [-9.0 * FRICTION, 9.0]];
    let polar = vec![[0.0, 0.0], [9.0, -9.0 * FRICTION], [9.0, -9.0], [-9.0, -9.0], [-9.0, -9.0 * FRICTION]];
    let series = vec![
        Series::new("K, ‖r_t‖ ≤ μ r_n", Ink::of(0).solid(), Shape::Region(cone)),
        Series::new("polar cone K°", Ink::of(1).solid(), Shape::Region(polar)),
        Series::new("projection", Ink::thin(), Shape::Arrows(moved)),
        Series::dots(2, "fixed points", kept),
        Series::words(vec![
            ([0.0, 1.8], "stick".into()),
            ([0.0, -1.8], "open".into()),
            ([1.8, 0.3], "slip".into()),
            ([-1.8, 0.3], "slip".into()),
        ]),
    ];
    let chart = Chart::new(Axis::linear("r_t [N·s]").within(-2.1, 2.1), Axis::linear("r_n [N·s]").within(-2.1, 2.1), series);
    Ok(Sheet::column(vec![chart.with_equal_scales()]))
}

/// û of a contact that slides at u_t, as (t, n).
fn corrected(slip: f64) -> [f64; 2] {
    let mut velocity = [0.0, slip];
    correct(&mut velocity, FRICTION);
    [velocity[1], velocity[0]]
}

fn de_saxce() -> Result<Sheet> {
    let dual = vec![[0.0, 0.0], [9.0, 9.0 * FRICTION], [9.0, 9.0], [-9.0, 9.0], [-9.0, 9.0 * FRICTION]];
    let slips = [-1.6, -1.2, -0.8, -0.4, 0.4, 0.8, 1.2, 1.6];
    let lifts = slips.map(|slip| [[slip, 0.0], corrected(slip)]).to_vec();
    // the impulses against them, on the border of K
    let impulses = [-1.0, 1.0].map(|side| [[0.0, 0.0], [FRICTION * side, 1.0]]).to_vec();
    let series = vec![
        Series::new("K*, u_n ≥ μ‖u_t‖", Ink::of(0).solid(), Shape::Region(dual)),
        Series::new("u ↦ u + μ‖u_t‖ n", Ink::of(1).solid(), Shape::Arrows(lifts)),
        Series::new("impulses of slip, r [N·s]", Ink::of(2).solid(), Shape::Arrows(impulses)),
        Series::words(vec![([0.0, 1.7], "K*".into())]),
    ];
    let chart = Chart::new(Axis::linear("u_t [m/s]").within(-2.1, 2.1), Axis::linear("u_n [m/s]").within(-0.4, 2.1), series);
    Ok(Sheet::column(vec![chart.with_equal_scales()]))
}

/// The sliding directions that are tried.
fn slidings() -> impl Iterator<Item = f64> {
    evenly(0.0, TAU, 720)
}

/// The angle from the direction opposite to sliding to the friction force \[rad\].
fn aside(angle: f64, d: usize) -> f64 {
    let [x, y] = direction(most_dissipative([angle.cos(), angle.sin()], d), d);
    let turned = y.atan2(x) - (angle + PI);
    turned.sin().atan2(turned.cos())
}

/// Loss of strength in the weakest direction, by bisection of the membership.
fn lost(d: usize) -> f64 {
    let weakest = PI / d as f64;
    let inside = |size: f64| contains(&[1.0, size * weakest.cos(), size * weakest.sin()], 1.0, d);
    let (mut low, mut high) = (0.0, 2.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if inside(middle) { low = middle } else { high = middle }
    }
    1.0 - low
}

/// (strength, direction, force) as measured.
fn measured(d: usize) -> [f64; 3] {
    let worst = slidings().map(|angle| aside(angle, d).abs()).fold(0.0, f64::max);
    [lost(d), worst, 2.0 * (0.5 * worst).sin()]
}

const COUNTS: [usize; 6] = [4, 6, 8, 12, 24, 48];

/// An error over the number of directions, with its name.
type Form = (&'static str, fn(usize) -> f64);

fn polyhedral() -> Result<Sheet> {
    let forms: [Form; 3] = [
        ("strength, 1 − cos(π/d): slope −2", strength_error),
        ("direction [rad], π/d: slope −1", direction_error),
        ("force, 2 sin(π/2d): slope −1", force_error),
    ];
    let mut series = Vec::new();
    for (k, (label, form)) in forms.into_iter().enumerate() {
        series.push(Series::line(k, label, COUNTS.map(|d| [d as f64, form(d)]).to_vec()));
        series.push(Series::dots(k, "", COUNTS.map(|d| [d as f64, measured(d)[k]]).to_vec()));
    }
    let x = Axis::logarithmic("directions d [1]").within(3.5, 55.0);
    Ok(Sheet::column(vec![Chart::new(x, Axis::logarithmic("error [1, rad]"), series)]))
}

fn directions() -> Result<Sheet> {
    let degrees = |angle: f64| angle.to_degrees();
    let (mut errors, mut shapes) = (
        Vec::new(),
        vec![Series::exact("Coulomb", curve(evenly(0.0, TAU, 180), f64::sin).into_iter().map(|[t, y]| [t.cos(), y]).collect())],
    );
    for (k, d) in [4, 8, 16].into_iter().enumerate() {
        let label = format!("d = {d}");
        // half a step off the ties between two vertices
        let angles = evenly(0.1, 180.1, 720);
        errors.push(Series::line(k, label.clone(), curve(angles, |angle| degrees(aside(angle.to_radians(), d)))));
        shapes.push(Series::line(k, label, (0..=d).map(|j| direction(j % d, d)).collect()));
    }
    Ok(Sheet::pairs(vec![
        Chart::new(Axis::linear("sliding direction [°]").within(0.0, 180.0), Axis::linear("friction aside by [°]"), errors),
        Chart::new(Axis::linear("r_t1/(μ r_n) [1]"), Axis::linear("r_t2/(μ r_n) [1]"), shapes).with_equal_scales(),
    ]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_exact::tolerance::rounding;

    #[test]
    fn what_is_removed_is_perpendicular_to_what_remains_and_in_the_polar_cone() {
        let mut cases = [0; 3];
        for point in ring() {
            let image = projected(point);
            let removed = [point[0] - image[0], point[1] - image[1]];
            assert!((removed[0] * image[0] + removed[1] * image[1]).abs() <= rounding(16, 4.0), "{point:?}");
            assert!(FRICTION * removed[0].abs() <= -removed[1] + rounding(16, 4.0), "{point:?}");
            assert!(image[0].abs() <= FRICTION * image[1] + rounding(16, 4.0));
            cases[if image == point { 0 } else { 1 + usize::from(image == [0.0, 0.0]) }] += 1;
        }
        assert!(cases.iter().all(|count| *count > 1), "{cases:?}");
    }

    #[test]
    fn a_corrected_velocity_is_perpendicular_to_the_impulse_of_its_slip() {
        for slip in [-1.6, 0.4] {
            let [t, n] = corrected(slip);
            let impulse = [-FRICTION * slip.signum(), 1.0];
            assert!((impulse[0] * t + impulse[1] * n).abs() <= rounding(8, 2.0), "{slip}");
        }
    }

    #[test]
    fn measured_errors_are_the_closed_ones() {
        for d in COUNTS {
            let [strength, angle, force] = measured(d);
            let turn = PI / d as f64;
            assert!((strength - (1.0 - turn.cos())).abs() <= rounding(64, 1.0), "{d}");
            assert!((angle - turn).abs() <= TAU / 720.0 && angle <= turn + rounding(64, 1.0), "{d}: {angle}");
            assert!((force - 2.0 * (0.5 * turn).sin()).abs() <= TAU / 720.0, "{d}: {force}");
        }
    }
}
