//! Texts that come from claims, engines and files: escaped, with code between backticks.

use maud::{Markup, html};

/// A text as markup, in which nothing but what stands between two backticks is more than letters.
pub fn prose(text: &str) -> Markup {
    let parts: Vec<&str> = text.split('`').collect();
    if parts.len().is_multiple_of(2) {
        return html! { (text) };
    }
    html! {
        @for (k, part) in parts.iter().enumerate() {
            @if k % 2 == 1 { code { (part) } } @else { (part) }
        }
    }
}
