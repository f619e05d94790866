//! Stored measurements of engines: the creep of a block that should stick, against the time step.

use crate::picture::{Creep, Given, Picture};
use crate::words::Words;
use moreau_checks::plot::{Axis, Chart, Series, Sheet};
use moreau_exact::Result;
use moreau_gate::tolerance::incline::SLOWEST;

pub(crate) const CREEP: Picture = Picture {
    id: "creep-of-engines",
    question: Words { en: "Does creep vanish with the time step?", zh: "减小步长，蠕滑会随之消失吗？" },
    caption: Words {
        en: "The speed at which a block creeps down a slope of 20° on which it should stick, μ = 0.5, in every engine of the scoreboard \
            that answered, one chart per engine with all of its configurations. Grey is what a sound discretisation may make at that \
            step: marks above it that fall with the step belong to the discretisation, marks that stay to the model. The sign is left \
            out: some engines creep uphill. What is slower than a nanometre per second is not told from rounding and has no place \
            here; engines that are so slow at every step stand in the table alone.",
        zh: "物块置于 20° 斜面，μ = 0.5，本应粘滞；图中为引擎记分板上给出答案的每个引擎的蠕滑速度，每个引擎一幅，含其各种配置。灰线是可靠的离散格式在该步长下允许的大小：灰线以上的标记若随步长下降，则源于离散；若保持不变，则源于模型。\
            此处不计符号：有的引擎向上蠕滑。慢于每秒一纳米者与舍入误差无法区分，不在图中；在所有步长下都如此之慢的引擎只列在表中。",
    },
    obtained: Words {
        en: "Read from the stored results of the check `incline/stick`, with the engines’ versions; nothing of it is computed here.",
        zh: "读自检查 `incline/stick` 的已存结果，附引擎版本；此处不作任何计算。",
    },
    command: "moreau scoreboard --checks incline/stick",
    claims: &["S5.gliding-creep", "Pr.sap-gliding", "S6.impratio", "R6"],
    draw: |given| creep(given)?.svg(),
};

/// (h, |speed|) where it is more than rounding.
fn marks(creep: &Creep) -> Vec<[f64; 2]> {
    creep.steps.iter().map(|step| [step.time_step, step.speed.abs()]).filter(|[_, speed]| *speed >= SLOWEST).collect()
}

/// Engines that have a mark, by their program, in the order of the scoreboard.
fn programs(given: &Given) -> Vec<(&str, Vec<&Creep>)> {
    let mut found: Vec<(&str, Vec<&Creep>)> = Vec::new();
    for creep in given.creep.iter().filter(|creep| !marks(creep).is_empty()) {
        match found.iter_mut().find(|(program, _)| *program == creep.program) {
            Some((_, engines)) => engines.push(creep),
            None => found.push((&creep.program, vec![creep])),
        }
    }
    found
}

fn creep(given: &Given) -> Result<Sheet> {
    let chart = |(program, engines): (&str, Vec<&Creep>)| {
        let allowed = engines[0].steps.iter().map(|step| [step.time_step, step.allowed]).collect();
        let mut series = vec![Series::exact("allowed", allowed)];
        for (k, engine) in engines.into_iter().enumerate() {
            series.push(Series::line(k, "", marks(engine)));
            series.push(Series::dots(k, engine.engine.clone(), marks(engine)));
        }
        let steps = Axis::logarithmic("h [s]").within(0.0008, 0.02);
        Chart::new(steps, Axis::logarithmic("creep [m/s]").within(SLOWEST, 1.0), series).titled(program)
    };
    Ok(Sheet::pairs(programs(given).into_iter().map(chart).collect()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::picture::CreepStep;
    use moreau_checks::plot::Shape;

    fn engine(name: &str, program: &str, speeds: [f64; 2]) -> Creep {
        let step = |h: f64, speed| CreepStep { time_step: h, speed, allowed: 0.001 * h };
        Creep { engine: name.into(), program: program.into(), steps: vec![step(0.01, speeds[0]), step(0.001, speeds[1])], trend: None }
    }

    #[test]
    fn every_speed_that_is_more_than_rounding_has_a_mark_in_the_chart_of_its_program() {
        let creep = vec![
            engine("a", "A", [0.002, -0.004]),
            engine("b", "B", [0.5, 0.0]),
            engine("a-2", "A", [0.25, 0.125]),
            engine("exact", "C", [f64::EPSILON, 0.0]),
        ];
        let sheet = super::creep(&Given { creep, work: Vec::new() }).expect("charts");
        let titles: Vec<_> = sheet.charts.iter().map(|chart| chart.title.as_str()).collect();
        assert_eq!(titles, ["A", "B"]);
        let dots = |chart: usize| -> Vec<(&str, Vec<[f64; 2]>)> {
            let series = sheet.charts[chart].series.iter();
            series.filter(|one| matches!(one.shape, Shape::Dots(_))).map(|one| (one.label.as_str(), one.shape.points())).collect()
        };
        assert_eq!(dots(0), [("a", vec![[0.01, 0.002], [0.001, 0.004]]), ("a-2", vec![[0.01, 0.25], [0.001, 0.125]])]);
        assert_eq!(dots(1), [("b", vec![[0.01, 0.5]])]);
    }
}
