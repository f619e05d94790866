//! The page of pictures: each with its question, what is seen, how it was obtained, and the claims that it illustrates.

use super::creep;
use super::file::File;
use super::frame::document;
use super::prose::prose;
use super::view::View;
use crate::picture::{Given, Picture};
use crate::pictures::PICTURES;
use crate::pictures::engines::CREEP;
use crate::words::Words;
use maud::{Markup, html};
use moreau_exact::Result;

const TITLE: Words = Words { en: "Pictures", zh: "图示" };
const LEAD: Words = Words {
    en: "{0} pictures, one question each. The labels in the pictures are English.",
    zh: "{0} 幅图，各回答一个问题。图中标注为英文。",
};
const OBTAINED: Words = Words { en: "How its numbers were obtained: ", zh: "数据来源：" };
const AGAIN: Words = Words { en: "The command that makes them again: ", zh: "重新得到它们的命令：" };
const CLAIMS: Words = Words { en: "Claims: ", zh: "相关论断：" };

/// Every picture as a file that the pages of both languages show.
///
/// # Errors
/// If a picture cannot be drawn.
pub fn files(given: &Given, done: &(dyn Fn() + Sync)) -> Result<Vec<File>> {
    let draw = |picture: &&Picture| {
        let text = (picture.draw)(given)?;
        done();
        Ok(File { path: file(picture), text })
    };
    PICTURES.iter().map(draw).collect()
}

fn file(picture: &Picture) -> String {
    format!("pictures/{}.svg", picture.id)
}

/// The page.
pub fn page(view: &View) -> String {
    let body = html! {
        h1 { (view.say(TITLE)) }
        p { (view.tell(LEAD, &[&PICTURES.len()])) }
        ul.list { @for picture in PICTURES { li { a href={ "#" (picture.id) } { (view.say(picture.question)) } } } }
        @for picture in PICTURES { (figure(view, picture)) }
    };
    document(view, view.say(TITLE), &body)
}

fn figure(view: &View, picture: &Picture) -> Markup {
    let source = view.shared(&file(picture));
    html! {
        figure id=(picture.id) {
            h2 { (view.say(picture.question)) }
            a href=(source) { img src=(source) alt={ (view.say(picture.question)) " " (view.say(picture.caption)) } loading="lazy"; }
            figcaption {
                p { (prose(view.say(picture.caption))) }
                p { (view.say(OBTAINED)) (prose(view.say(picture.obtained))) }
                p { (view.say(AGAIN)) code { (picture.command) } }
                @if picture.id == CREEP.id { (creep::table(view)) }
                @if !picture.claims.is_empty() { p { (view.say(CLAIMS)) (view.claim_links(picture.claims.iter().copied())) } }
            }
        }
    }
}
