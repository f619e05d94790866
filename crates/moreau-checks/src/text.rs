//! How text for a terminal is marked.

/// Whether to mark headings and alarms with terminal colours.
#[derive(Clone, Copy)]
pub struct Style {
    /// False for pipes, files and `NO_COLOR`.
    pub colour: bool,
}

impl Style {
    fn paint(self, code: &str, text: &str) -> String {
        if self.colour { format!("\u{1b}[{code}m{text}\u{1b}[0m") } else { text.into() }
    }

    /// A heading.
    pub fn heading(self, text: &str) -> String {
        self.paint("1", text)
    }

    /// Something that is wrong.
    pub fn alarm(self, text: &str) -> String {
        self.paint("1;31", text)
    }
}
