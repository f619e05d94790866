//! The spaces between the signs of a formula, by TeX's classes.

use super::node::Class;

/// Signs in a row: spaces around relations and binary operators, after commas, between a function and its argument. A binary operator
/// without a left operand is a sign, `−x`.
pub(super) fn spaced(signs: &[(String, Class)]) -> String {
    let mut line = String::new();
    let mut before: Option<Class> = None;
    for (sign, class) in signs {
        let class = if *class == Class::Binary && !ends_an_operand(before) { Class::Tight } else { *class };
        if before.is_some_and(|before| apart(before, class)) && !(before == Some(Class::Function) && sign.starts_with(['|', '‖'])) {
            line.push(' ');
        }
        if class != Class::Space {
            line.push_str(sign);
        }
        before = Some(class);
    }
    line
}

fn ends_an_operand(before: Option<Class>) -> bool {
    matches!(before, Some(Class::Ordinary | Class::Close | Class::Space))
}

fn apart(before: Class, after: Class) -> bool {
    use Class::{Binary, Close, Function, Open, Ordinary, Punctuation, Relation, Space};
    match (before, after) {
        (_, Punctuation | Close) | (Open, _) => false,
        (Space, Space) => false,
        (Space, _) | (Punctuation, _) => true,
        (_, Space) => false,
        (Relation, Relation) => false,
        (Relation | Binary, _) | (_, Relation | Binary) => true,
        (Function, Ordinary) => true,
        (Ordinary | Close, Function) => true,
        _ => false,
    }
}
