//! Solvers on one contact problem: how the residual of the answer falls with the iterations.

use crate::picture::Picture;
use crate::words::Words;
use moreau_checks::plot::{Axis, Chart, Series, Sheet};
use moreau_contact::certificate::residuals;
use moreau_contact::problem::ContactProblem;
use moreau_contact::solvers::{Auto, Solvers};
use moreau_dynamics::scenes::named;
use moreau_dynamics::schemes::{Anitescu, step};
use moreau_exact::{Error, Result};

pub(super) const PICTURE: Picture = Picture {
    id: "residual-by-iteration",
    question: Words { en: "How many iterations does a contact solver need?", zh: "接触求解器需要迭代多少次？" },
    caption: Words {
        en: "The relative residual of the certificate for the first step of five boxes on each other under the convex law, \
            over the limit of iterations. Ten sweeps of projected Gauss–Seidel leave a residual that shows, and hundreds do not remove \
            it. Methods of first order with momentum (APGD) or spectral steps (BB) show little at first and then fall fast. An \
            interior point method needs a dozen iterations, each of which factorises a matrix.",
        zh: "五箱堆叠第一步（凸定律）的证书相对残差随迭代次数上限的变化。投影 Gauss–Seidel 扫掠十次后残差仍很明显，数百次也未消除；带动量（APGD）或谱步长（BB）的一阶方法起初几乎不动，随后迅速下降；内点法只需十余次迭代，\
            但每次都要分解一个矩阵。",
    },
    obtained: Words {
        en: "`box-stack`, scheme `anitescu`, h = 10 ms; each solver started from zero with another limit, its answer judged by \
            the certificate.",
        zh: "场景 `box-stack`、格式 `anitescu`、h = 10 ms；各求解器从零开始、逐次放宽迭代上限，答案由证书评判。",
    },
    command: "moreau simulate --scene box-stack --scheme anitescu --step 0.01 --solver pgs",
    claims: &["S6.pgs-10", "S6.pgs-sublinear", "S5.rates", "R8"],
    draw: |_| sheet()?.svg(),
};

/// Limits of iterations that are tried.
const LIMITS: [usize; 12] = [1, 2, 4, 7, 12, 20, 35, 60, 100, 180, 320, 560];
const NAMES: [&str; 4] = ["pgs", "apgd", "bb", "interior-point"];

/// The contact problem of the first step.
fn problem() -> Result<ContactProblem> {
    let (mechanism, start) = named("box-stack")?.mechanism()?;
    let made = step(&Anitescu, &Auto, mechanism.as_ref(), &start, 0.01)?;
    made.assembled.problem.ok_or_else(|| Error::Unsupported("the boxes do not touch".into()))
}

/// (iterations, residual) where the solver has an answer that is not exact to rounding.
fn residual_by_limit(problem: &ContactProblem, name: &str) -> Result<Vec<[f64; 2]>> {
    let solvers = Solvers::own();
    let mut points = Vec::new();
    for limit in LIMITS {
        let answer = solvers.with_iterations(name, Some(limit))?.solve(problem, None);
        if let Ok(answer) = answer {
            let residual = residuals(problem, &answer)?.judged.relative();
            if residual > 0.0 {
                points.push([limit as f64, residual]);
            }
        }
    }
    Ok(points)
}

fn sheet() -> Result<Sheet> {
    let problem = problem()?;
    let mut series = Vec::new();
    for (k, name) in NAMES.into_iter().enumerate() {
        let points = residual_by_limit(&problem, name)?;
        series.push(Series::line(k, "", points.clone()));
        series.push(Series::dots(k, name, points));
    }
    Ok(Sheet::column(vec![Chart::new(Axis::logarithmic("iterations [1]"), Axis::logarithmic("relative residual [1]"), series)]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use moreau_contact::solvers::ContactSolver;

    #[test]
    fn residuals_fall_and_the_velocities_of_the_answer_are_those_of_a_stack_at_rest() {
        let problem = problem().expect("a step");
        for name in NAMES {
            let points = residual_by_limit(&problem, name).expect("answers");
            let (first, last) = (points[0], points[points.len() - 1]);
            assert!(points.len() >= 2 && last[1] <= 0.1 * first[1], "{name}: {points:?}");
        }
        // what the ground gives to a stack that stays is the weight of all five boxes over the step
        let answer = Auto.solve(&problem, None).expect("an answer");
        let carried: f64 = answer.impulse.iter().step_by(problem.rows_per_contact()).sum();
        // the k-th of five layers carries 5, 4, 3, 2 and 1 weights
        assert!((carried / (15.0 * 9.81 * 0.01) - 1.0).abs() <= 0.01, "{carried}");
    }
}
