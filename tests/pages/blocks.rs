//! The blocks of code of a page, each with what stands directly before it.

/// A block of code.
#[derive(Debug, PartialEq)]
pub struct Block<'a> {
    /// The first line after the fence: the language.
    pub language: &'a str,
    /// The lines between the fences.
    pub text: &'a str,
    /// The comment on the line before the fence, without its marks.
    pub comment: Option<&'a str>,
    /// The file that the last line of prose before the block names: `…, `problem.json`:`.
    pub file: Option<&'a str>,
    /// How many headings stand before it.
    pub section: usize,
}

/// The blocks in the order of the page.
pub fn blocks(page: &str) -> Vec<Block<'_>> {
    let (mut found, mut section, mut before) = (Vec::new(), 0, [None; 2]);
    let mut rest = page;
    while let Some((line, after)) = next_line(rest) {
        rest = after;
        if let Some(language) = line.strip_prefix("```") {
            let end = after.find("\n```").map_or(if after.starts_with("```") { 0 } else { after.len() }, |place| place + 1);
            let [earlier, last] = before;
            let comment = last.and_then(|line: &str| line.strip_prefix("<!-- ")?.strip_suffix(" -->"));
            let prose = if comment.is_some() { earlier } else { last };
            found.push(Block { language, text: after[..end].trim_end_matches('\n'), comment, file: prose.and_then(file), section });
            rest = next_line(&after[end..]).map_or("", |(_, after)| after);
            before = [None; 2];
            continue;
        }
        section += usize::from(line.starts_with('#'));
        if !line.trim().is_empty() {
            before = [before[1], Some(line)];
        }
    }
    found
}

fn next_line(text: &str) -> Option<(&str, &str)> {
    (!text.is_empty()).then(|| text.split_once('\n').unwrap_or((text, "")))
}

/// The file that a line names last, before its colon.
fn file(line: &str) -> Option<&str> {
    let name = line.trim_end().strip_suffix("`:")?.rsplit('`').next()?;
    let ends = [".json", ".toml"].iter().any(|end| name.ends_with(end));
    (ends && !name.contains('/')).then_some(name)
}

#[test]
fn blocks_have_their_language_comment_file_and_section() {
    let page = "# a\nThis is `a.json`:\n\n```json\n{}\n```\n## b\n<!-- not run: no -->\n```sh\nx\ny\n```\ntext `b.json`.\n```text\n```\n";
    let found = blocks(page);
    let block = |language, text, comment, file, section| Block { language, text, comment, file, section };
    let expected =
        [block("json", "{}", None, Some("a.json"), 1), block("sh", "x\ny", Some("not run: no"), None, 2), block("text", "", None, None, 2)];
    assert_eq!(found, expected);
}
