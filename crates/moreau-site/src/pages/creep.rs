//! The table below the picture of creep: every engine that answered, at every step.

use super::data::{Creep, CreepStep};
use super::view::View;
use crate::words::Words;
use maud::{Markup, html};
use moreau_exact::number::{significant, two_digits};
use moreau_gate::trend::Origin;

const NUMBERS: Words = Words { en: "Creep of every engine", zh: "各引擎的蠕滑" };
const ENGINE: Words = Words { en: "engine", zh: "引擎" };
const AT: Words = Words { en: "h = {0} s", zh: "h = {0} s" };
const ORDER: Words = Words { en: "order p [1]", zh: "阶 p [1]" };
const BECOMES: Words = Words { en: "with the step", zh: "随步长" };
const WITHIN: Words = Words { en: "within what a step may make", zh: "在步长允许的范围内" };
const STAYS: Words = Words { en: "stays: the model", zh: "不变：源于模型" };
const VANISHES: Words = Words { en: "vanishes: the discretisation", zh: "消失：源于离散" };
const IRREGULAR: Words = Words { en: "irregular", zh: "不规则" };
const READ: Words = Words {
    en: "Speeds in m/s, uphill negative; p is fitted to speed ≈ C hᵖ where some step has more than a sound discretisation may make.",
    zh: "速度单位 m/s，向上为负；凡某一步长下超出可靠离散格式所允许者，按 速度 ≈ C hᵖ 拟合 p。",
};

/// The table.
pub fn table(view: &View) -> Markup {
    let engines = &view.report.given.creep;
    let mut steps: Vec<f64> = engines.iter().flat_map(|creep| &creep.steps).map(|step| step.time_step).collect();
    steps.sort_by(|one, other| other.total_cmp(one));
    steps.dedup();
    let table = html! {
        table {
            thead { tr {
                th scope="col" { (view.say(ENGINE)) }
                @for h in &steps { th.n scope="col" { (view.tell(AT, &[&significant(*h)])) } }
                th.n scope="col" { (view.say(ORDER)) }
                th scope="col" { (view.say(BECOMES)) }
            } }
            tbody { @for creep in engines { (row(view, creep, &steps)) } }
        }
    };
    html! {
        p { (view.say(READ)) }
        (view.scrolled(view.say(NUMBERS), &table))
    }
}

fn row(view: &View, creep: &Creep, steps: &[f64]) -> Markup {
    let at = |h: &f64| creep.steps.iter().find(|step| step.time_step == *h);
    let speed = |step: Option<&CreepStep>| step.map_or_else(|| "–".into(), |step| significant(step.speed));
    html! {
        tr {
            th scope="row" { code { (creep.engine) } }
            @for h in steps { td.n { (speed(at(h))) } }
            td.n { (creep.trend.map_or_else(|| "–".into(), |trend| two_digits(trend.order))) }
            td { (view.say(becomes(creep))) }
        }
    }
}

/// The gate's own word for the trend.
fn becomes(creep: &Creep) -> Words {
    match creep.trend.map(|trend| trend.origin) {
        None => WITHIN,
        Some(Origin::Model) => STAYS,
        Some(Origin::Discretisation) => VANISHES,
        Some(Origin::Irregular) => IRREGULAR,
    }
}
