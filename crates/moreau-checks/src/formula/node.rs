//! A formula as a tree, built from the events in their order.

use pulldown_latex::Event;
use pulldown_latex::event::{
    Content, DelimiterType, EnvironmentFlow, Font, Grouping, RelationContent, ScriptPosition, ScriptType, StateChange, Visual,
};
use std::vec::IntoIter;

/// What a sign is to its neighbours; TeX's classes, which set the spaces.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Class {
    /// A letter, a number, a root, a group.
    Ordinary,
    /// The name of a function.
    Function,
    /// An operator between two operands.
    Binary,
    /// A sign of a product or quotient, which stands without spaces.
    Tight,
    /// A relation.
    Relation,
    /// An opening bracket.
    Open,
    /// A closing bracket.
    Close,
    /// A comma or a semicolon.
    Punctuation,
    /// A space that is asked for, `\,`.
    Space,
}

/// One element of a formula.
#[derive(Debug)]
pub(super) enum Node {
    /// A sign or a word.
    Sign(String, Class),
    /// What stands in braces.
    Group(Vec<Node>),
    /// A base with its scripts.
    Script {
        /// What bears them.
        base: Box<Node>,
        /// The subscript.
        below: Option<Box<Node>>,
        /// The superscript.
        above: Option<Box<Node>>,
        /// Whether the superscript is an accent over the base.
        over: bool,
    },
    /// A root, with its degree where that is not 2.
    Root(Box<Node>, Option<Box<Node>>),
    /// A numerator over a denominator.
    Fraction(Box<Node>, Box<Node>),
    /// The rows of a matrix.
    Matrix(Vec<Vec<Vec<Node>>>),
}

/// The tree of a formula; the name of what this renderer does not know otherwise.
pub(super) fn tree(events: Vec<Event<'_>>) -> Result<Vec<Node>, String> {
    let mut builder = Builder { events: events.into_iter(), font: None };
    let mut nodes = Vec::new();
    while let Some(event) = builder.events.next() {
        nodes.extend(builder.node(event)?);
    }
    Ok(nodes)
}

struct Builder<'a> {
    events: IntoIter<Event<'a>>,
    font: Option<Font>,
}

impl<'a> Builder<'a> {
    /// The next element, past changes of style.
    fn element(&mut self) -> Result<Node, String> {
        loop {
            let event = self.events.next().ok_or("an element is missing")?;
            if let Some(node) = self.node(event)? {
                return Ok(node);
            }
        }
    }

    fn boxed(&mut self) -> Result<Box<Node>, String> {
        self.element().map(Box::new)
    }

    fn node(&mut self, event: Event<'a>) -> Result<Option<Node>, String> {
        Ok(Some(match event {
            Event::Content(content) => self.sign(content),
            Event::Begin(Grouping::Normal) => Node::Group(self.group()?),
            Event::Begin(Grouping::LeftRight(left, right)) => {
                let mut inside = self.group()?;
                inside.splice(0..0, left.map(|sign| Node::Sign(sign.into(), Class::Open)));
                inside.extend(right.map(|sign| Node::Sign(sign.into(), Class::Close)));
                Node::Group(inside)
            }
            Event::Begin(Grouping::Matrix { .. }) => Node::Matrix(self.rows()?),
            Event::Begin(other) => return Err(format!("the environment {other:?} has no form in Unicode")),
            Event::Visual(Visual::SquareRoot) => Node::Root(self.boxed()?, None),
            Event::Visual(Visual::Root) => {
                let radicand = self.boxed()?;
                Node::Root(radicand, Some(self.boxed()?))
            }
            Event::Visual(Visual::Fraction(_)) => {
                let numerator = self.boxed()?;
                Node::Fraction(numerator, self.boxed()?)
            }
            Event::Visual(Visual::Negation) => negated(self.element()?)?,
            Event::Script { ty, position } => self.script(ty, position)?,
            Event::Space { width: Some(_), .. } => Node::Sign(" ".into(), Class::Space),
            Event::StateChange(StateChange::Font(font)) => {
                self.font = font;
                return Ok(None);
            }
            Event::StateChange(_) | Event::Space { .. } => return Ok(None),
            Event::End | Event::EnvironmentFlow(_) => return Err("a group ends that did not begin".into()),
        }))
    }

    /// The elements up to the end of the group.
    fn group(&mut self) -> Result<Vec<Node>, String> {
        let font = self.font;
        let mut inside = Vec::new();
        loop {
            match self.events.next().ok_or("a group does not end")? {
                Event::End => break,
                event => inside.extend(self.node(event)?),
            }
        }
        self.font = font;
        Ok(inside)
    }

    fn rows(&mut self) -> Result<Vec<Vec<Vec<Node>>>, String> {
        let mut rows = vec![vec![Vec::new()]];
        loop {
            let row = rows.last_mut().ok_or("a matrix without rows")?;
            match self.events.next().ok_or("a matrix does not end")? {
                Event::End => return Ok(rows),
                Event::EnvironmentFlow(EnvironmentFlow::Alignment) => row.push(Vec::new()),
                Event::EnvironmentFlow(EnvironmentFlow::NewLine { .. }) => rows.push(vec![Vec::new()]),
                event => {
                    let node = self.node(event)?;
                    row.last_mut().ok_or("a row without entries")?.extend(node);
                }
            }
        }
    }

    fn script(&mut self, ty: ScriptType, position: ScriptPosition) -> Result<Node, String> {
        let base = self.boxed()?;
        let below = if ty == ScriptType::Superscript { None } else { Some(self.boxed()?) };
        let above = if ty == ScriptType::Subscript { None } else { Some(self.boxed()?) };
        Ok(Node::Script { base, below, above, over: position == ScriptPosition::AboveBelow })
    }

    fn sign(&self, content: Content<'_>) -> Node {
        let (text, class) = match content {
            Content::Text(text) => (text.to_string(), Class::Ordinary),
            Content::Number(number) => (number.to_string(), Class::Ordinary),
            Content::Function(name) => (name.to_string(), Class::Function),
            Content::Ordinary { content: '/', .. } => ("/".into(), Class::Tight),
            Content::Ordinary { content, .. } => (self.letter(content), Class::Ordinary),
            Content::LargeOp { content: '∑', .. } => ("Σ".into(), Class::Ordinary),
            Content::LargeOp { content, .. } => (content.into(), Class::Ordinary),
            Content::BinaryOp { content, .. } => binary(content),
            Content::Relation { content, .. } => (relation(content), Class::Relation),
            Content::Delimiter { content, ty, .. } => (content.into(), bracket(ty)),
            Content::Punctuation('.') => (".".into(), Class::Ordinary),
            Content::Punctuation(sign) => (sign.into(), Class::Punctuation),
        };
        Node::Sign(text, class)
    }

    /// A letter in the font that is on: of the fonts Unicode has signs of its own for the sets of numbers only.
    fn letter(&self, letter: char) -> String {
        match (self.font, letter) {
            (Some(Font::DoubleStruck), 'R') => "ℝ".into(),
            (Some(Font::DoubleStruck), 'Q') => "ℚ".into(),
            (Some(Font::DoubleStruck), 'N') => "ℕ".into(),
            _ => letter.into(),
        }
    }
}

fn bracket(ty: DelimiterType) -> Class {
    match ty {
        DelimiterType::Open => Class::Open,
        DelimiterType::Close => Class::Close,
        DelimiterType::Fence => Class::Ordinary,
    }
}

/// The signs of a product stand without spaces.
fn binary(sign: char) -> (String, Class) {
    match sign {
        '⋅' => ("·".into(), Class::Tight),
        '×' => ("×".into(), Class::Tight),
        '∗' => ("*".into(), Class::Tight),
        other => (other.into(), Class::Binary),
    }
}

fn relation(content: RelationContent) -> String {
    let mut room = [0; 8];
    String::from_utf8_lossy(content.encode_utf8_to_buf(&mut room)).into_owned()
}

fn negated(node: Node) -> Result<Node, String> {
    let signs = [("=", "≠"), ("∈", "∉"), ("≥", "≱"), ("≤", "≰")];
    match node {
        Node::Sign(sign, class) => match signs.iter().find(|(plain, _)| *plain == sign) {
            Some((_, negated)) => Ok(Node::Sign((*negated).into(), class)),
            None => Err(format!("the negation of `{sign}` has no sign in Unicode")),
        },
        Node::Group(mut inside) if inside.len() == 1 => negated(inside.remove(0)),
        _ => Err("what is negated is no sign".into()),
    }
}
