//! The work of iterations on the collection of contact problems, as a performance profile.

use crate::picture::{Given, Picture, Work};
use crate::words::Words;
use moreau_checks::plot::{Axis, Chart, Series, Sheet};
use moreau_exact::Result;

pub(super) const PICTURE: Picture = Picture {
    id: "work-profile",
    question: Words { en: "Which iteration needs the least work?", zh: "哪种迭代的工作量最小？" },
    caption: Words {
        en: "Performance profile (Dolan and Moré): the part of the problems of the collection that an iteration answers with at most τ \
            times the least work of any. Where a curve begins: how often it is the best; where it ends: how much it answers at all within \
            500 iterations. Work is the number of passes through W, products and sweeps, which is the same on every machine; looking \
            whether the answer is good enough counts as well, estimates of a step and of rounding do not. Newton’s, pivoting and \
            interior point methods are not compared: they factorise matrices, and passes say nothing of that.",
        zh: "性能曲线（Dolan–Moré）：题集中以不超过最小工作量 τ 倍的代价解出的问题所占比例。曲线起点是该迭代最省的频率，终点是 500 次迭代之内总共解出的比例。工作量是遍历 W 的次数（乘积与扫掠），在任何机器上都相同；\
            检查答案是否足够好也计入其中，步长与舍入的估计不计入。Newton 法、主元法与内点法要分解矩阵，遍历次数说明不了它们的代价，故不参与比较。",
    },
    obtained: Words {
        en: "Each iteration started from zero on every stored problem of the law that has a solution and that all of them take; an \
            answer counts where `moreau certify` accepts it.",
        zh: "各迭代从零开始求解该定律下有解且它们都能处理的每个已存问题；`moreau certify` 接受的答案才计入。",
    },
    command: "moreau report --out report",
    claims: &["S6.pgs-sublinear", "S5.rates", "R8"],
    draw: |given| sheet(given)?.svg(),
};

/// The largest factor that is drawn.
const FARTHEST: f64 = 1000.0;

/// The corners of the curve that holds each value until the next factor.
fn stairs(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let mut corners: Vec<[f64; 2]> = Vec::new();
    for [factor, part] in points.iter().copied().filter(|[factor, _]| *factor <= FARTHEST) {
        if let Some([_, before]) = corners.last().copied() {
            corners.push([factor, before]);
        }
        corners.push([factor, part]);
    }
    corners.extend(corners.last().copied().map(|[_, part]| [FARTHEST, part]));
    corners
}

fn chart(work: &Work) -> Chart {
    let series = work.profiles.iter().enumerate().map(|(k, (name, points))| Series::line(k, name.clone(), stairs(points)));
    let (factor, part) = (Axis::logarithmic("τ [1]").within(1.0, FARTHEST), Axis::linear("part [1]").within(0.0, 1.0));
    Chart::new(factor, part, series.collect()).titled(format!("{}, {} problems", work.laws, work.problems))
}

fn sheet(given: &Given) -> Result<Sheet> {
    Ok(Sheet::pairs(given.work.iter().map(chart).collect()))
}

#[cfg(test)]
mod tests {
    use super::stairs;

    #[test]
    fn a_part_holds_until_the_next_factor_and_to_the_end() {
        assert_eq!(stairs(&[[1.0, 0.25], [4.0, 0.75], [2000.0, 1.0]]), [[1.0, 0.25], [4.0, 0.25], [4.0, 0.75], [1000.0, 0.75]]);
        assert!(stairs(&[]).is_empty());
    }
}
