//! The page of the explorer in its two languages.

use super::grid::{SCENES, SCHEMES, STEPS, SchemeEntry};
use super::texts::TEXTS;
use crate::{Language, Words};
use maud::{DOCTYPE, Markup, PreEscaped, html};
use serde_json::{Map, Value, json};

/// The style of the explorer, for the head of its page; all of it is about what stands in `.explorer`.
pub const STYLE: &str = include_str!("style.css");

/// The title of the page.
pub const TITLE: Words = Words { en: "Explorer: scenes, schemes and parameters", zh: "探索器:场景、格式与参数" };

/// The files beside the runs.
pub const FILES: [(&str, &str); 3] = [
    ("stored.js", include_str!("stored.js")),
    ("draw.js", include_str!("draw.js")),
    ("explorer.js", include_str!("explorer.js")),
];

/// The style of a page that stands alone.
const ALONE: &str = "body{margin:0;font:16px/1.5 system-ui,sans-serif;background:#fff;color:#1b1b1b}main{max-width:1240px;margin:auto;\
                     padding:8px 12px}@media(prefers-color-scheme:dark){body{background:#14171a;color:#e8e8e8}}";

/// The four panels: the name in the page, and the scheme; the first one is chosen.
const PANELS: [(&str, &str); 4] = [("coulomb", "moreau-jean"), ("anitescu", "anitescu"), ("sap", "drake-sap"), ("mujoco", "mujoco")];

const SPEEDS: [&str; 5] = ["0.02", "0.1", "0.25", "0.5", "1"];

/// What stands in the `main` of the page; `folder` is where the files of the explorer are, seen from the page, `explorer/`.
pub fn content(language: Language, folder: &str) -> Markup {
    let text = |words: Words| words.of(language);
    html! {
        div.explorer #explorer data-folder=(folder) {
            h1 { (text(TITLE)) }
            p { (text(INTRODUCTION)) }
            noscript { p.fail { (text(NO_SCRIPT)) } }
            (choice(language))
            (time(language))
            p.numbers #explorer-numbers role="status" aria-live="polite" {}
            div.panels {
                @for (id, scheme) in PANELS {
                    @if let Some(scheme) = SCHEMES.iter().find(|one| one.id == scheme) { (panel(language, id, scheme)) }
                }
            }
            (notes(language))
        }
        script type="application/json" id="explorer-table" { (PreEscaped(table(language))) }
        @for (file, _) in FILES { script src={ (folder) (file) } {} }
    }
}

/// A whole page, which stands alone.
pub fn page(language: Language, folder: &str) -> String {
    let page = html! {
        (DOCTYPE)
        html lang=(language.tag()) {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                title { (TITLE.of(language)) }
                style { (PreEscaped(ALONE)) (PreEscaped(STYLE)) }
            }
            body { main { (content(language, folder)) } }
        }
    };
    page.into_string()
}

/// The scene, the scheme of the first panel, and the parameters.
fn choice(language: Language) -> Markup {
    let text = |words: Words| words.of(language);
    let select = |id: &str, label: &str, options: &Markup, note: bool| {
        html! {
            label for={ "explorer-" (id) } {
                span { (label) }
                select id={ "explorer-" (id) } aria-describedby=[note.then(|| format!("explorer-{id}-note"))] { (options) }
                @if note { small id={ "explorer-" (id) "-note" } {} }
            }
        }
    };
    let first = |scheme: &&SchemeEntry| scheme.id == "moreau-jean" || scheme.id == "stewart-trinkle";
    html! {
        form.choice #explorer-choice aria-label=(text(CHOICE)) {
            (select("scene", text(SCENE), &html! { @for one in &SCENES { option value=(one.id) { (text(one.name)) } } }, false))
            (select("scheme", text(SCHEME), &html! { @for one in SCHEMES.iter().filter(first) { option value=(one.id) { (text(one.name)) } } },
                false))
            (select("theta", text(THETA), &html! {}, true))
            (select("restitution", text(RESTITUTION), &html! {}, true))
            (select("friction", text(FRICTION), &html! {}, true))
            (select("step", text(STEP), &html! { @for (name, _) in STEPS { option value=(name) { (name) } } }, false))
        }
        p #explorer-about {}
    }
}

/// What moves the time.
fn time(language: Language) -> Markup {
    let text = |words: Words| words.of(language);
    html! {
        div.time role="group" aria-label=(text(TIME)) {
            button #explorer-play type="button" { (text(PLAY)) }
            button #explorer-back type="button" aria-label=(text(BACK)) { "‹" }
            button #explorer-on type="button" aria-label=(text(ON)) { "›" }
            label { span { (text(SPEED)) } select #explorer-speed {
                @for speed in SPEEDS { option value=(speed) selected[speed == "0.25"] { (speed) " ×" } }
            } }
            label.slider for="explorer-time" { span { (text(TIME)) } input #explorer-time type="range" min="0" max="1" step="1" value="0"; }
        }
    }
}

/// One scheme with its motion, its cone, its graphs and its numbers.
fn panel(language: Language, id: &str, scheme: &SchemeEntry) -> Markup {
    let part = |name: &str| format!("explorer-{id}-{name}");
    let picture = |name: &str, label: Words| {
        html! { figure class=(name) {
            svg id=(part(name)) role="img" aria-label=(label.of(language)) {}
        } }
    };
    html! {
        section.panel id={ "explorer-" (id) } aria-labelledby=(part("name")) data-scheme=(scheme.id) {
            h2 id=(part("name")) { (scheme.name.of(language)) }
            p.law id=(part("law")) { (scheme.law.of(language)) }
            p.certificate id=(part("certificate")) {}
            p.refusal id=(part("refusal")) hidden {}
            div.pictures id=(part("pictures")) {
                (picture("motion", MOTION)) (picture("cone", CONE))
                (picture("gap", GAP)) (picture("energy", ENERGY)) (picture("natural", NATURAL))
            }
            dl id=(part("numbers")) {}
            p.note id=(part("note")) {}
            p.command { code id=(part("command")) {} " " a id=(part("scene")) href="#" { (SCENE_FILE.of(language)) } }
        }
    }
}

fn notes(language: Language) -> Markup {
    html! {
        details {
            summary { (HOW.of(language)) }
            @for words in NOTES { p { (words.of(language)) } }
        }
    }
}

/// What the program knows of the grid, and its texts: JSON in which no letter ends a script.
fn table(language: Language) -> String {
    let scene = |one: &super::SceneEntry| {
        json!({"id": one.id, "about": one.about.of(language), "friction": one.friction, "restitution": one.restitution})
    };
    let scheme = |one: &SchemeEntry| {
        let name = one.name.of(language);
        json!({"id": one.id, "name": name, "law": one.law.of(language), "theta": one.theta, "restitution": one.id == "moreau-jean"})
    };
    let texts: Map<String, Value> = TEXTS.iter().chain(&ACTS).map(|(id, words)| (id.to_string(), words.of(language).into())).collect();
    let table = json!({"scenes": SCENES.iter().map(scene).collect::<Vec<_>>(), "schemes": SCHEMES.iter().map(scheme).collect::<Vec<_>>(),
        "steps": STEPS.map(|(name, _)| name), "texts": texts});
    table.to_string().replace('<', "\\u003c").replace('>', "\\u003e").replace('&', "\\u0026")
}

/// Where a parameter acts, beside its control.
const ACTS: [(&str, Words); 4] = [
    ("thetaActs", Words { en: "acts in Moreau–Jean only", zh: "只作用于 Moreau–Jean" }),
    ("thetaNot", Words { en: "Stewart–Trinkle has no θ", zh: "Stewart–Trinkle 没有 θ" }),
    ("restitutionActs", Words { en: "acts in Moreau–Jean only; see the notes of the others", zh: "只作用于 Moreau–Jean;见其他格式的注" }),
    ("actsNot", Words { en: "fixed in this scene", zh: "在此场景中固定" }),
];

const INTRODUCTION: Words = Words {
    en: "The same scene through four schemes: Coulomb’s law, Anitescu’s convex step, SAP and MuJoCo’s law. The last two are our replicas of the \
         engines’ steps. Every run was computed when this report was built, by the library of the command; the command under each panel \
         makes its numbers again.",
    zh: "同一场景由四种格式计算:库仑定律、Anitescu 的凸步、SAP 与 MuJoCo 的定律;后两者是我们对引擎步的复刻。所有结果在生成本报告时由命令的程序库算出;\
         每个面板下方的命令可重新得到其数值。",
};
const NO_SCRIPT: Words = Words {
    en: "The runs are drawn by a script, which this browser does not run. The command `moreau simulate` makes the same numbers.",
    zh: "结果由脚本绘制,而此浏览器不运行脚本。命令 moreau simulate 给出相同的数值。",
};
const CHOICE: Words = Words { en: "Scene, scheme and parameters", zh: "场景、格式与参数" };
const SCENE: Words = Words { en: "scene", zh: "场景" };
const SCHEME: Words = Words { en: "scheme of Coulomb’s law", zh: "库仑定律的格式" };
const THETA: Words = Words { en: "θ [1]", zh: "θ [1]" };
const RESTITUTION: Words = Words { en: "restitution e [1]", zh: "恢复系数 e [1]" };
const FRICTION: Words = Words { en: "friction μ [1]", zh: "摩擦系数 μ [1]" };
const STEP: Words = Words { en: "time step h [s]", zh: "时间步长 h [s]" };
const TIME: Words = Words { en: "time", zh: "时间" };
const PLAY: Words = Words { en: "Play", zh: "播放" };
const BACK: Words = Words { en: "One step back", zh: "后退一步" };
const ON: Words = Words { en: "One step on", zh: "前进一步" };
const SPEED: Words = Words { en: "speed", zh: "速度" };
const MOTION: Words = Words { en: "The motion, seen from the side", zh: "运动的侧视图" };
const CONE: Words = Words { en: "The friction cone with the impulse, and its dual with the law velocity", zh: "摩擦锥与冲量,以及对偶锥与定律速度" };
const GAP: Words = Words { en: "Smallest gap over time", zh: "最小间隙随时间的变化" };
const ENERGY: Words = Words { en: "Energy over time", zh: "能量随时间的变化" };
const NATURAL: Words = Words { en: "Natural map of every step", zh: "每一步的自然映射" };
const SCENE_FILE: Words = Words { en: "the scene’s file", zh: "场景文件" };
const HOW: Words = Words { en: "How to read this page", zh: "如何阅读本页" };

const NOTES: [Words; 5] = [
    Words {
        en: "The cone: the filled wedge is K, |r_t| ≤ μ r_n, with the impulse r of every active contact as a solid arrow [N·s]; the wide wedge is \
             its dual K*, y_n ≥ μ|y_t|, with ŷ as a dashed arrow [m/s]. A step is solved where r lies in K, ŷ in K*, and both are at right angles \
             or one of them is zero. Lengths grow as the square root; directions are true.",
        zh: "锥:填充的楔形是 K,|r_t| ≤ μ r_n,每个起作用接触的冲量 r 画成实线箭头 [N·s];宽楔形是对偶锥 K*,y_n ≥ μ|y_t|,ŷ 画成虚线箭头 [m/s]。\
             r 在 K 中、ŷ 在 K* 中且两者垂直(或其一为零)时,该步得解。长度按平方根增长,方向真实。",
    },
    Words {
        en: "ŷ is u + μ‖u_t‖n for Coulomb’s law (with restitution in u), and for an associated law the velocity that the scheme relates to r, with \
             its shift and its compliance. Anitescu, SAP and MuJoCo lift a sliding contact for that reason.",
        zh: "库仑定律的 ŷ 是 u + μ‖u_t‖n(u 含恢复系数);关联定律的 ŷ 是格式与 r 相联系的速度,含其移位与柔度。Anitescu、SAP 与 MuJoCo 因此会把滑动的接触抬起。",
    },
    Words {
        en: "The natural map is ‖r − P_K(r − ρŷ)‖ over all contacts [N·s]; a zero stands on the lowest line. It is shown for comparison: the \
             certificate judges each residual against its scale. A triangle above the graph marks a rejected step, a diamond one that is \
             unconverged by declaration.",
        zh: "自然映射是所有接触上的 ‖r − P_K(r − ρŷ)‖ [N·s];零画在最低线上。它只供比较:证书按各残差的尺度判定。图上方的三角形标出被拒绝的步,菱形标出按声明未收敛的步。",
    },
    Words {
        en: "Positions, velocities, impulses and energies have six digits after the point, residuals two significant digits: these are the \
             command’s numbers. Every step is stored. MuJoCo’s replica moves bodies in space, the others in the plane; a box has four lower \
             corners there and two here.",
        zh: "位置、速度、冲量与能量保留小数点后六位,残差保留两位有效数字:与命令的数值相同。每一步都已存储。MuJoCo 的复刻在空间中运动,其余在平面内;\
             方块在前者有四个下角,在后者有两个。",
    },
    Words {
        en: "Keys: Tab goes from control to control; on the time slider the arrow keys go one step. The address of the page keeps the choice.",
        zh: "按键:Tab 在控件间移动;在时间滑块上方向键前进或后退一步。页面地址保存所做的选择。",
    },
];
