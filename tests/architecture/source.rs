//! A scanner for Rust source: what is left of a file without test code, and what it imports.

/// Stripped code without its `#[cfg(test)]` items, and the names of the modules among them that live in files of their own.
pub fn without_tests(code: &str) -> (String, Vec<String>) {
    let mut kept = String::new();
    let mut modules = Vec::new();
    let mut rest = code;
    while let Some(start) = ["#[cfg(test)]", "#[cfg(all(test,"].iter().filter_map(|mark| rest.find(mark)).min() {
        kept.push_str(&rest[..start]);
        let attribute = rest[start..].find(']').expect("an attribute ends") + 1;
        let item = &rest[start + attribute..];
        let end = item_end(item);
        if let Some((_, name)) = item[..end].trim_end_matches(';').rsplit_once("mod ").filter(|_| item[..end].ends_with(';')) {
            modules.push(name.trim().to_string());
        }
        rest = &item[end..];
    }
    kept.push_str(rest);
    (kept, modules)
}

/// Where an item ends: at its first `;` outside braces, or at the brace that closes its first one.
fn item_end(item: &str) -> usize {
    let mut depth = 0;
    for (at, letter) in item.char_indices() {
        match letter {
            ';' if depth == 0 => return at + 1,
            '{' => depth += 1,
            '}' => {
                depth -= 1;
                if depth == 0 {
                    return at + 1;
                }
            }
            _ => {}
        }
    }
    item.len()
}

/// The top-level names that stripped code reaches through `crate::` or through `super::` up to the root, groups included.
///
/// `depth` is the number of modules between the root and this one: 1 in `src/cones/mod.rs`, 2 in `src/cones/orthant.rs`.
pub fn imports(code: &str, depth: usize) -> Vec<String> {
    let to_root = format!("{}::", vec!["super"; depth].join("::"));
    names_after(code, &["crate::", &to_root])
}

/// The names that stripped code reaches through one of these paths, groups included.
pub fn names_after(code: &str, roots: &[&str]) -> Vec<String> {
    let mut names = Vec::new();
    for root in roots {
        for (at, _) in code.match_indices(root) {
            let inside_word = code[..at].ends_with(|letter: char| letter.is_alphanumeric() || letter == '_' || letter == ':');
            if !inside_word {
                names.extend(first_names(&code[at + root.len()..]));
            }
        }
    }
    names.sort();
    names.dedup();
    names
}

/// The first names of a path or of the members of a group `{a, b::c, d::{e, f}}`.
fn first_names(path: &str) -> Vec<String> {
    let path = path.trim_start();
    let Some(group) = path.strip_prefix('{') else { return vec![word(path)] };
    let mut names = Vec::new();
    let mut depth = 0;
    let mut start = 0;
    for (at, letter) in group.char_indices() {
        match letter {
            '{' => depth += 1,
            '}' if depth > 0 => depth -= 1,
            ',' | '}' if depth == 0 => {
                names.push(word(group[start..at].trim_start()));
                start = at + 1;
                if letter == '}' {
                    break;
                }
            }
            _ => {}
        }
    }
    names.retain(|name| !name.is_empty());
    names
}

fn word(path: &str) -> String {
    path.chars().take_while(|letter| letter.is_alphanumeric() || matches!(letter, '_' | '*')).collect()
}

/// The numbers with a negative decimal exponent in stripped code, `1e-9` or `2.5E-3`.
pub fn small_literals(code: &str) -> Vec<String> {
    let letters: Vec<char> = code.chars().collect();
    let numeric = |letter: &char| letter.is_ascii_digit() || matches!(letter, '.' | '_');
    (1..letters.len().saturating_sub(2))
        .filter(|&at| {
            matches!(letters[at], 'e' | 'E') && letters[at + 1] == '-' && numeric(&letters[at - 1]) && letters[at + 2].is_ascii_digit()
        })
        .filter_map(|at| {
            let start = at - letters[..at].iter().rev().take_while(|letter| numeric(letter)).count();
            let named = start > 0 && (letters[start - 1].is_alphabetic() || letters[start - 1] == '_');
            let end = at + 2 + letters[at + 2..].iter().take_while(|letter| letter.is_ascii_digit()).count();
            (!named).then(|| letters[start..end].iter().collect())
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::super::strip::strip;
    use super::*;

    #[test]
    fn a_planted_import_is_found_however_it_is_written() {
        for planted in [
            "use crate::schemes::MoreauJean;",
            "use crate::{Error, schemes::MoreauJean};",
            "use crate::{\n  cones::{second_order, orthant},\n  schemes,\n};",
            "fn f() { crate::schemes::step() }",
            "use super::super::schemes::step;",
        ] {
            assert!(imports(&strip(planted), 2).contains(&"schemes".to_string()), "{planted}");
        }
        assert_eq!(imports("use crate::{Error, cones::{a, b}, law};", 2), ["Error", "cones", "law"]);
    }

    #[test]
    fn a_sibling_is_not_the_root_and_a_wildcard_is_visible() {
        assert!(imports("use super::schemes::x;", 2).is_empty());
        assert_eq!(imports("use super::schemes::x;", 1), ["schemes"]);
        assert_eq!(imports("use crate::*;", 1), ["*"]);
        assert!(imports("use my_crate::schemes;", 1).is_empty());
    }

    #[test]
    fn comments_texts_and_letters_are_not_code() {
        let source = r###"
            /// [`crate::schemes`] 1e-9
            /* outer /* crate::solvers */ 1e-8 */
            let text = "crate::schemes \" 1e-7"; let raw = r#"crate::x " 1e-6"#;
            let letter = '"'; let other = '\''; fn f<'a>(x: &'a str) -> f64 { 1e-5 }
        "###;
        let code = strip(source);
        assert!(imports(&code, 2).is_empty(), "{code}");
        assert_eq!(small_literals(&code), ["1e-5"]);
    }

    #[test]
    fn test_modules_are_cut_out_and_what_follows_stays() {
        let code = "fn a() {}\n#[cfg(test)]\nmod tests { fn b() { use crate::schemes; } }\n#[cfg(test)]\nmod testing;\n\
                    #[cfg(all(test, feature = \" \"))]\nmod more { use crate::schemes; }\nfn c() { 1e-3 }";
        let (kept, modules) = without_tests(code);
        assert!(kept.contains("fn a()") && kept.contains("fn c()") && !kept.contains("schemes"));
        assert_eq!(modules, ["testing"]);
        assert_eq!(names_after("use moreau_contact::{problem::Law, solvers};", &["moreau_contact::"]), ["problem", "solvers"]);
    }

    #[test]
    fn small_literals_are_numbers_with_a_negative_exponent_only() {
        assert_eq!(small_literals("x = 2.5e-3 + 1E-12_f64; "), ["2.5e-3", "1E-12"]);
        assert!(small_literals("1e3 + 1e+3 + value1e-3 + size-1 + 0.001 ").is_empty());
        assert_eq!(small_literals("f(1e-9)"), ["1e-9"]);
    }
}
