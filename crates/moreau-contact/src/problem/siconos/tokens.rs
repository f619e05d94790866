//! The numbers of a text, one after another, with the line each stands in.

use moreau_exact::number::counted;
use moreau_exact::{Error, Result};

/// Words of a text, in order.
#[derive(Clone)]
pub(super) struct Tokens<'a> {
    rest: &'a str,
    line: usize,
}

impl<'a> Tokens<'a> {
    pub(super) fn new(text: &'a str) -> Self {
        Tokens { rest: text, line: 1 }
    }

    /// The next word.
    pub(super) fn next(&mut self) -> Option<&'a str> {
        let word = self.rest.trim_start();
        self.line += self.rest[..self.rest.len() - word.len()].matches('\n').count();
        let end = word.find(char::is_whitespace).unwrap_or(word.len());
        self.rest = &word[end..];
        (end > 0).then_some(&word[..end])
    }

    /// Goes to the next line.
    pub(super) fn skip_line(&mut self) {
        self.rest = self.rest.find('\n').map_or("", |end| &self.rest[end..]);
    }

    /// How many words are left.
    pub(super) fn remaining(&self) -> usize {
        self.rest.split_whitespace().count()
    }

    /// The next whole numbers, at most so many and up to the first word that is none; they stay where they are.
    pub(super) fn peek_whole(&self, count: usize) -> Vec<usize> {
        self.rest.split_whitespace().take(count).map_while(|word| word.parse().ok()).collect()
    }

    /// The next word as a whole number.
    pub(super) fn whole(&mut self, what: &str) -> Result<usize> {
        self.parsed(what, "a whole number")
    }

    /// The next word as a finite number.
    pub(super) fn number(&mut self, what: &str) -> Result<f64> {
        let number: f64 = self.parsed(what, "a number")?;
        if number.is_finite() { Ok(number) } else { Err(self.error(what, format!("is {number}"), "use a finite number")) }
    }

    /// So many numbers.
    pub(super) fn vector(&mut self, what: &str, count: usize) -> Result<Vec<f64>> {
        if count > self.rest.len() {
            return Err(self.error(
                what,
                format!("has {} by the sizes before it", counted(count, "number")),
                "correct the size: the file is shorter",
            ));
        }
        (0..count).map(|_| self.number(what)).collect()
    }

    /// So many whole numbers.
    pub(super) fn indices(&mut self, what: &str, count: usize) -> Result<Vec<usize>> {
        if count > self.rest.len() {
            return Err(self.error(
                what,
                format!("has {} by the sizes before it", counted(count, "number")),
                "correct the size: the file is shorter",
            ));
        }
        (0..count).map(|_| self.whole(what)).collect()
    }

    fn parsed<T: std::str::FromStr>(&mut self, what: &str, kind: &str) -> Result<T> {
        let Some(word) = self.next() else {
            return Err(self.error(what, "is missing: the file ends".into(), "give the whole file; it may be truncated"));
        };
        word.parse().map_err(|_| self.error(what, format!("is `{}`", word.chars().take(40).collect::<String>()), &format!("use {kind}")))
    }

    /// An error at this place of the file.
    pub(super) fn error(&self, what: &str, problem: String, cure: &str) -> Error {
        Error::invalid(format!("{what}, line {}", self.line), problem, cure)
    }
}
