//! What every page has: its head, the common style, text with code in it, and tables that scroll in a box of their own.

use maud::{DOCTYPE, Markup, PreEscaped, html};
pub use moreau_checks::text::with_code;

/// Light and dark, from 360 pixels of width on; nothing to tap is lower than 44 pixels.
const STYLE: &str = include_str!("style.css");

/// The version of this program, which a page names.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");

/// A whole page that needs no other file. `style` is added to the common one.
pub fn document(title: &str, style: &str, body: &Markup) -> String {
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                title { (title) }
                style { (PreEscaped(STYLE)) (PreEscaped(style)) }
            }
            body { (body) }
        }
    };
    page.into_string()
}

/// A table in a box that scrolls by itself, so that the page stays as wide as the screen; its head stays in sight.
pub fn scrolled(name: &str, table: &Markup) -> Markup {
    html! { div.scroll role="region" aria-label=(name) tabindex="0" { (table) } }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_page_has_what_a_telephone_asks_for_and_escapes_its_title() {
        let page = document("</title><b>", ".own{}", &html! { p { "text" } });
        assert!(page.starts_with("<!DOCTYPE html><html lang=\"en\"><head><meta charset=\"utf-8\">"), "{page}");
        assert!(page.contains("<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">"), "{page}");
        assert!(page.contains("<title>&lt;/title&gt;&lt;b&gt;</title>") && page.contains(".own{}</style>"), "{page}");
        assert!(STYLE.contains("prefers-color-scheme:dark") && STYLE.contains("min-height:44px") && !STYLE.contains("url("));
    }
}
