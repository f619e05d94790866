//! A formula as the events of the parser, and as MathML.

use super::pieces::refused;
use moreau_exact::Result;
use pulldown_latex::event::Content;
use pulldown_latex::{Event, Parser, RenderConfig, Storage, push_mathml};
use std::convert::Infallible;

/// Calls `with` on the events of a formula.
pub(super) fn read<T>(tex: &str, with: impl FnOnce(Vec<Event<'_>>) -> Result<T>) -> Result<T> {
    if let Some(other) = tex.chars().find(|letter| !letter.is_ascii()) {
        return Err(refused(tex, format!("`{other}` is written as a command in TeX")));
    }
    if tex.trim().is_empty() {
        return Err(refused(tex, "the formula is empty".into()));
    }
    let storage = Storage::new();
    let events = Parser::new(tex, &storage)
        .map(|event| event.map(usual).map_err(|error| refused(tex, reason(&error.to_string()))))
        .collect::<Result<Vec<_>>>()?;
    with(events)
}

/// The formula as a `<math>` element.
pub(super) fn mathml(tex: &str) -> Result<String> {
    read(tex, |events| {
        let mut page = String::new();
        push_mathml(&mut page, events.into_iter().map(Ok::<_, Infallible>), RenderConfig { xml: false, ..RenderConfig::default() })
            .map_err(|error| refused(tex, error.to_string()))?;
        Ok(with_one_base(&escaped(&page)))
    })
}

/// The library writes a relation as it is: the element that holds `<`, `>` or `&` alone.
fn escaped(page: &str) -> String {
    page.replace("><</", ">&lt;</").replace(">></", ">&gt;</").replace(">&</", ">&amp;</")
}

/// The library writes the space before a function into the script, whose base is then two elements: the space goes before the script.
fn with_one_base(page: &str) -> String {
    let mut written = String::new();
    let mut rest = page;
    while let Some(at) = rest.find("><mspace") {
        let (before, after) = rest.split_at(at + 1);
        let script = before.rfind('<').filter(|start| SCRIPTS.contains(&&before[*start..]));
        let end = after.find("/>").map_or(after.len(), |end| end + 2);
        let (space, following) = after.split_at(end);
        let (kept, opened) = before.split_at(script.unwrap_or(before.len()));
        written.extend([kept, space, opened]);
        rest = following;
    }
    written + rest
}

/// The elements that hold a base and what stands at it.
const SCRIPTS: [&str; 6] = ["<msup>", "<msub>", "<msubsup>", "<munder>", "<mover>", "<munderover>"];

/// The first line of the parser's message: what follows draws the place, which the formula names.
fn reason(message: &str) -> String {
    message.lines().next().unwrap_or_default().trim_start_matches("parsing error: ").into()
}

/// `\mu` is the Greek letter, not the sign of a millionth; `\phi` the letter that the chapter prints; `\|` the sign of a norm; and a stroke
/// stands without spaces, as in TeX.
fn usual(event: Event<'_>) -> Event<'_> {
    let (content, stretchy) = match event {
        Event::Content(Content::Ordinary { content, stretchy }) => (content, stretchy),
        Event::Content(Content::BinaryOp { content: '/', .. }) => ('/', false),
        other => return other,
    };
    let content = match content {
        'µ' => 'μ',
        'ϕ' => 'φ',
        '∥' => '‖',
        other => other,
    };
    Event::Content(Content::Ordinary { content, stretchy })
}
