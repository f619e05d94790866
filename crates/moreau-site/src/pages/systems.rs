//! The simulators on the four axes of the chapter, and how closely each agrees with what.

use super::frame::document;
use super::front;
use super::systems_words;
use super::view::View;
use crate::words::{Language, Words};
use maud::{Markup, html};
use moreau_checks::text::with_code;
use moreau_exact::number::{significant, two_digits, with_unit};
use moreau_replicas::systems::{AgreementReport, Cone, ConstraintLevel, ContactLaw, SystemReport};

const TITLE: Words = Words { en: "Systems on four axes", zh: "四条坐标轴上的系统" };
const LEAD: Words = Words {
    en: "Where each simulator of the chapter stands: the level at which the contact constraint is posed, the cone of impulses, the contact \
         law and the algorithm.",
    zh: "本章各仿真系统的位置：接触约束所在的层级、冲量锥、接触定律与算法。",
};
const SYSTEM: Words = Words { en: "system", zh: "系统" };
const LEVEL: Words = Words { en: "level", zh: "层级" };
const CONE: Words = Words { en: "cone", zh: "锥" };
const LAW: Words = Words { en: "law", zh: "定律" };
const ALGORITHM: Words = Words { en: "algorithm", zh: "算法" };
const RESTITUTION: Words = Words { en: "restitution", zh: "恢复系数" };
const UPDATE: Words = Words { en: "positions", zh: "位置更新" };
const AGREEMENTS: Words = Words { en: "How closely they agree", zh: "一致程度" };
const MEASURED: Words = Words {
    en: "Measured when this report was written. A difference beyond its bound is marked.",
    zh: "生成本报告时实测；超出误差界者有标记。",
};
const AGAINST: Words = Words { en: "against", zh: "对照" };
const QUANTITY: Words = Words { en: "quantity", zh: "物理量" };
const DIFFERENCE: Words = Words { en: "difference", zh: "差" };
const BOUND: Words = Words { en: "bound", zh: "误差界" };
const SHARE: Words = Words { en: "share", zh: "占比" };
const WITHIN: Words = Words { en: "within", zh: "界内" };
const OUTSIDE: Words = Words { en: "OUTSIDE", zh: "超出" };
const NO_NUMBER: Words = Words { en: "not a number", zh: "不是数" };
const NONE: Words = Words { en: "none", zh: "无" };
const OBTAINED: Words = Words { en: "How these numbers were obtained", zh: "这些数据的来源" };

/// The page.
pub fn page(view: &View) -> String {
    let systems = &view.report.systems.systems;
    let body = html! {
        h1 { (view.say(TITLE)) }
        p { (view.say(LEAD)) }
        p { (front::systems(view)) (view.stop()) a href="obtained.html#systems" { (view.say(OBTAINED)) } }
        (view.scrolled_wide(view.say(TITLE), &axes(view, systems)))
        h2 { (view.say(AGREEMENTS)) }
        p { (view.say(MEASURED)) }
        @for (k, system) in systems.iter().enumerate() {
            h3 id={ "system-" (k) } { (view.english(&system.name)) }
            p { @for scheme in &system.schemes { code { "--scheme " (scheme) } " " } }
            (view.scrolled(&system.name, &agreements(view, system)))
        }
    };
    document(view, view.say(TITLE), &body)
}

fn axes(view: &View, systems: &[SystemReport]) -> Markup {
    html! {
        table {
            thead { tr { @for head in [SYSTEM, LEVEL, CONE, LAW, ALGORITHM, RESTITUTION, UPDATE] { th scope="col" { (view.say(head)) } } } }
            tbody {
                @for (k, system) in systems.iter().enumerate() {
                    tr {
                        th scope="row" { a href={ "#system-" (k) } { (view.english(&system.name)) } }
                        td { (view.say(level(system.level))) }
                        td { (view.say(cone(system.cone))) }
                        td { (view.say(law(system.law))) }
                        td { (said(view, &system.algorithm)) }
                        td { (said(view, &system.restitution)) }
                        td { (said(view, &system.position_update)) }
                    }
                }
            }
        }
    }
}

fn level(level: ConstraintLevel) -> Words {
    match level {
        ConstraintLevel::Position => Words { en: "position", zh: "位置级" },
        ConstraintLevel::Velocity => Words { en: "velocity", zh: "速度级" },
        ConstraintLevel::Acceleration => Words { en: "acceleration", zh: "加速度级" },
    }
}

fn cone(cone: Cone) -> Words {
    match cone {
        Cone::SecondOrder => Words { en: "second-order", zh: "二阶锥" },
        Cone::Polyhedral => Words { en: "polyhedral", zh: "多面体锥" },
        Cone::None => NONE,
    }
}

fn law(law: ContactLaw) -> Words {
    match law {
        ContactLaw::Coulomb => Words { en: "Coulomb", zh: "Coulomb" },
        ContactLaw::Associated => Words { en: "associated (convex)", zh: "关联（凸）" },
        ContactLaw::Compliant => Words { en: "compliant", zh: "柔顺" },
        ContactLaw::None => NONE,
    }
}

fn agreements(view: &View, system: &SystemReport) -> Markup {
    html! {
        table {
            thead { tr { @for head in [AGAINST, QUANTITY, DIFFERENCE, BOUND, SHARE, WITHIN] { th scope="col" { (view.say(head)) } } } }
            tbody { @for agreement in &system.held_against { (row(view, agreement)) } }
        }
    }
}

fn row(view: &View, agreement: &AgreementReport) -> Markup {
    let difference = agreement.difference.map_or(view.say(NO_NUMBER).into(), |found| with_unit(&significant(found), &agreement.unit));
    html! {
        tr {
            td { (said(view, &agreement.against)) }
            td { (view.english(&agreement.quantity)) }
            td.n { (difference) }
            td.n { (with_unit(&significant(agreement.tolerance), &agreement.unit)) }
            td.n { (agreement.used.map(two_digits).unwrap_or_default()) }
            td { @if agreement.holds { "✓ " (view.say(WITHIN)) } @else { b.alarm { "✗ " (view.say(OUTSIDE)) } } }
        }
    }
}

/// A text of a system, on a Chinese page in Chinese where it has one.
fn said(view: &View, text: &str) -> Markup {
    match (systems_words::chinese(text), view.language) {
        (Some(chinese), Language::Chinese) => with_code(chinese),
        _ => view.english(text),
    }
}
