//! The page of the explorer in its two languages.

use super::grid::{SCENES, SCHEMES, STEPS, SceneEntry, SchemeEntry};
use super::texts::{
    ACTS, BACK, CHOICE, CONE, ENERGY, FRICTION, GAP, HOW, INTRODUCTION, MOTION, NATURAL, NO_SCRIPT, NOTES, ON, PLAY, RESTITUTION, SCENE,
    SCENE_FILE, SCHEME, SPEED, STEP, TEXTS, THETA, TIME,
};
use crate::words::{Language, Words};
use maud::{DOCTYPE, Markup, PreEscaped, html};
use serde_json::{Map, Value, json};

/// The title of the page.
pub const TITLE: Words = Words { en: "Explorer: scenes, schemes and parameters", zh: "探索页：场景、格式与参数" };

/// The files beside the runs; all of the style is about what stands in `.explorer`.
pub const FILES: [(&str, &str); 4] = [
    ("explorer.css", include_str!("explorer.css")),
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
        link rel="stylesheet" href={ (folder) "explorer.css" };
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
        @for (file, _) in FILES.iter().filter(|(file, _)| file.ends_with(".js")) { script src={ (folder) (file) } {} }
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
                style { (PreEscaped(ALONE)) }
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
            (select("scheme", text(SCHEME), &html! {
                @for one in SCHEMES.iter().filter(first) { option value=(one.id) { (text(one.name)) } }
            }, false))
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
    let scene =
        |one: &SceneEntry| json!({"id": one.id, "about": one.about.of(language), "friction": one.friction, "restitution": one.restitution});
    let scheme = |one: &SchemeEntry| {
        let name = one.name.of(language);
        json!({"id": one.id, "name": name, "law": one.law.of(language), "theta": one.theta, "options": one.options.join(" ")})
    };
    let texts: Map<String, Value> = TEXTS.iter().chain(&ACTS).map(|(id, words)| (id.to_string(), words.of(language).into())).collect();
    let table = json!({"scenes": SCENES.iter().map(scene).collect::<Vec<_>>(), "schemes": SCHEMES.iter().map(scheme).collect::<Vec<_>>(),
        "steps": STEPS.map(|(name, _)| name), "texts": texts});
    table.to_string().replace('<', "\\u003c").replace('>', "\\u003e").replace('&', "\\u0026")
}
