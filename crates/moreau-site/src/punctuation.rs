//! Chinese texts have full-width punctuation: every text of the crate's source is looked at, and what the written pages say.

use std::path::{Path, PathBuf};

/// Whether a character is Chinese, or a mark of Chinese punctuation.
fn is_chinese(letter: char) -> bool {
    ('\u{3001}'..='\u{3017}').contains(&letter)
        || ('\u{3400}'..='\u{9fff}').contains(&letter)
        || ('\u{ff01}'..='\u{ff1f}').contains(&letter)
}

/// Half-width marks beside a Chinese character, each with what stands around it; code between backticks is none of it.
pub fn half_width(text: &str) -> Vec<String> {
    let letters: Vec<char> = text.split('`').step_by(2).collect::<Vec<_>>().join("`").chars().collect();
    let chinese = |at: Option<usize>| at.and_then(|at| letters.get(at)).is_some_and(|&letter| is_chinese(letter));
    let is_half = |at: usize| match letters[at] {
        ',' | ':' | ';' | '?' | '!' => chinese(at.checked_sub(1)) || chinese(Some(at + 1)),
        '(' => chinese(at.checked_sub(1)),
        _ => false,
    };
    let around = |at: usize| letters[at.saturating_sub(4)..(at + 5).min(letters.len())].iter().collect();
    (0..letters.len()).filter(|&at| is_half(at)).map(around).collect()
}

/// The texts between quotes in Rust source, with their broken lines joined.
fn texts(source: &str) -> Vec<String> {
    let (mut texts, mut open, mut letters) = (Vec::new(), None::<String>, source.chars().peekable());
    while let Some(letter) = letters.next() {
        match (letter, &mut open) {
            ('"', Some(_)) => texts.extend(open.take()),
            ('"', None) => open = Some(String::new()),
            ('\\', Some(text)) => match letters.next() {
                Some('\n') => while letters.next_if(|letter| letter.is_whitespace()).is_some() {},
                Some(other) => text.push(other),
                None => {}
            },
            (letter, Some(text)) => text.push(letter),
            (_, None) => {}
        }
    }
    texts
}

fn sources(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).expect("a folder of sources").map(|entry| entry.expect("an entry").path());
    entries.flat_map(|path| if path.is_dir() { sources(&path) } else { vec![path] }).collect()
}

#[test]
fn chinese_texts_have_full_width_punctuation() {
    let mut looked_at = 0;
    for path in sources(&Path::new(env!("CARGO_MANIFEST_DIR")).join("src")) {
        // tests have texts with the mistake on purpose
        let is_meant = path.extension().is_some_and(|end| end == "rs")
            && !path.components().any(|part| ["tests", "tests.rs", "punctuation.rs"].iter().any(|name| part.as_os_str() == *name));
        let source = if is_meant { std::fs::read_to_string(&path).expect("source") } else { continue };
        for text in texts(&source).into_iter().filter(|text| text.chars().any(is_chinese)) {
            looked_at += 1;
            assert_eq!(half_width(&text), Vec::<String>::new(), "{}: {text}", path.display());
        }
    }
    assert!(looked_at > 300, "{looked_at} texts");
}

#[test]
fn a_half_width_mark_is_seen() {
    assert_eq!(half_width("库仑,定律"), ["库仑,定律"]);
    for text in ["结果: 1", "h = 1;其余", "步(显式)", "对吗?"] {
        assert_eq!(half_width(text).len(), 1, "{text}");
    }
    for text in ["结果：1", "`a,b`，库仑", "点 (q, v) 与 1 − cos(π/d)，都是", "图 f(x) 是"] {
        assert_eq!(half_width(text), Vec::<String>::new(), "{text}");
    }
    let source = "zh: \"前半句\\\n        后\\\"半句\", en: \"b\"";
    assert_eq!(texts(source), ["前半句后\"半句", "b"]);
}
