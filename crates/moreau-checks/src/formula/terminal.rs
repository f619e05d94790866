//! A formula in one line of Unicode.

use super::events::read;
use super::node::{Class, Node, tree};
use super::pieces::refused;
use super::{accents, scripts, spacing};
use moreau_exact::Result;

/// Fractions that have a sign of their own.
const FRACTIONS: [(&str, &str, &str); 5] = [("1", "2", "½"), ("1", "3", "⅓"), ("2", "3", "⅔"), ("1", "4", "¼"), ("3", "4", "¾")];

/// The formula as a line.
pub(super) fn written(tex: &str) -> Result<String> {
    let line = read(tex, |events| {
        let nodes = tree(events).map_err(|problem| refused(tex, problem))?;
        row(&nodes).map_err(|problem| refused(tex, problem))
    })?;
    Ok(line)
}

type Line = std::result::Result<String, String>;

/// Elements side by side.
fn row(nodes: &[Node]) -> Line {
    Ok(spacing::spaced(&signs(nodes)?))
}

/// Elements in a script, where there is no room for spaces.
fn narrow(node: &Node) -> Line {
    let nodes = if let Node::Group(inside) = node { inside.as_slice() } else { std::slice::from_ref(node) };
    Ok(signs(nodes)?.into_iter().map(|(sign, class)| if class == Class::Function { sign + " " } else { sign }).collect())
}

fn signs(nodes: &[Node]) -> std::result::Result<Vec<(String, Class)>, String> {
    let mut found = Vec::new();
    for node in nodes {
        match node {
            Node::Sign(sign, class) => found.push((sign.clone(), *class)),
            Node::Group(inside) => found.push((row(inside)?, Class::Ordinary)),
            Node::Script { base, below, above, over } => found.push(script(base, below.as_deref(), above.as_deref(), *over)?),
            Node::Root(radicand, degree) => found.push((root(radicand, degree.as_deref())?, Class::Ordinary)),
            Node::Fraction(above, below) => found.push((fraction(above, below)?, Class::Ordinary)),
            Node::Matrix(rows) => found.push((matrix(rows)?, Class::Ordinary)),
        }
    }
    Ok(found)
}

fn script(base: &Node, below: Option<&Node>, above: Option<&Node>, over: bool) -> std::result::Result<(String, Class), String> {
    let bearer = signs(std::slice::from_ref(base))?;
    let (mut line, class) = bearer.into_iter().next().ok_or("scripts without a base")?;
    if let (true, Some(accent)) = (over, above) {
        let accent = narrow(accent)?;
        let mark = accent.chars().next().ok_or("an accent without a sign")?;
        return accents::accented(&line, mark).map(|line| (line, class)).ok_or(format!("`{accent}` over `{line}` has no form in Unicode"));
    }
    if let Some(below) = below {
        line += &scripts::below(&narrow(below)?);
    }
    if let Some(above) = above {
        line += &scripts::above(&narrow(above)?);
    }
    Ok((line, class))
}

fn root(radicand: &Node, degree: Option<&Node>) -> Line {
    let sign = match degree.map(narrow).transpose()?.as_deref() {
        None => "√",
        Some("3") => "∛",
        Some("4") => "∜",
        Some(degree) => return Err(format!("a root of degree {degree} has no sign in Unicode")),
    };
    Ok(format!("{sign}{}", enclosed(radicand)?))
}

fn fraction(above: &Node, below: &Node) -> Line {
    let (above_line, below_line) = (row(std::slice::from_ref(above))?, row(std::slice::from_ref(below))?);
    match FRACTIONS.iter().find(|(over, under, _)| (*over, *under) == (&above_line, &below_line)) {
        Some((.., sign)) => Ok((*sign).into()),
        None => Ok(format!("{}/{}", enclosed(above)?, enclosed(below)?)),
    }
}

/// The element, in brackets where it is more than one sign.
fn enclosed(node: &Node) -> Line {
    let line = row(std::slice::from_ref(node))?;
    let single = match node {
        Node::Group(inside) => inside.len() == 1,
        _ => true,
    };
    Ok(if single { line } else { format!("({line})") })
}

/// `[[a, b], [c, d]]`.
fn matrix(rows: &[Vec<Vec<Node>>]) -> Line {
    let filled = rows.iter().filter(|entries| entries.iter().any(|entry| !entry.is_empty()));
    let lines = filled.map(|entries| {
        Ok(format!("[{}]", entries.iter().map(|entry| row(entry)).collect::<std::result::Result<Vec<_>, String>>()?.join(", ")))
    });
    Ok(lines.collect::<std::result::Result<Vec<_>, String>>()?.join(", "))
}
