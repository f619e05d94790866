//! What a file of stripped source defines, brings into scope and names, and which file defines a name: enough of Rust's paths to follow
//! `crate::`, `self::`, `super::`, imported modules and re-exports.

use std::collections::{BTreeMap, BTreeSet};

/// A module's path from the root of its crate, the root itself being empty.
type Module = Vec<String>;

/// A source file: its module, and its code without comments, texts and tests.
pub struct Source {
    pub module: Module,
    pub code: String,
}

/// What a name stands for.
#[derive(Clone, Debug, PartialEq)]
enum Target {
    Module(Module),
    /// An item, by the number of the file that defines it.
    Item(usize),
    /// Of another crate, or local.
    Elsewhere,
}

/// One `use`: what path, under which name, and whether it hands the name on.
struct Import {
    path: Vec<String>,
    /// None: all that the path has.
    name: Option<String>,
    public: bool,
}

#[derive(Default)]
struct Scope {
    file: usize,
    items: BTreeSet<String>,
    children: BTreeSet<String>,
    imports: Vec<Import>,
    /// Paths and single names in the code outside `use`.
    named: BTreeSet<Vec<String>>,
}

/// The modules of one crate.
#[derive(Default)]
pub struct Modules {
    scopes: BTreeMap<Module, Scope>,
}

impl Modules {
    pub fn new(sources: &[Source]) -> Self {
        let mut modules = Self::default();
        for (file, source) in sources.iter().enumerate() {
            modules.read(file, source);
        }
        modules
    }

    /// From which file to which, with the paths that lead there; a file to itself is left out. Handing on what a child has is no import.
    pub fn edges(&self) -> BTreeMap<(usize, usize), BTreeSet<String>> {
        let mut edges: BTreeMap<_, BTreeSet<String>> = BTreeMap::new();
        for (module, scope) in &self.scopes {
            let below = |path: &[String]| scope.children.contains(&path[usize::from(path[0] == "self").min(path.len() - 1)]);
            let handed_on = |import: &Import| import.public && below(&import.path);
            let private: Vec<_> = scope.imports.iter().filter(|import| !handed_on(import) && import.name.is_some()).collect();
            // what an import brings is told by its own path
            let imported = |name: &String| private.iter().any(|import| import.name.as_ref() == Some(name));
            let named = scope.named.iter().filter(|path| path.len() > 1 || !imported(&path[0]));
            for path in private.iter().map(|import| &import.path).chain(named) {
                let Target::Item(file) = self.resolve(module, path) else { continue };
                edges.entry((scope.file, file)).or_default().insert(path.join("::"));
            }
        }
        edges.retain(|(from, to), _| from != to);
        edges
    }

    fn read(&mut self, file: usize, source: &Source) {
        let tokens = tokens(&source.code);
        let mut blocks: Vec<Option<String>> = Vec::new();
        let mut at = 0;
        while at < tokens.len() {
            let inline: Vec<_> = blocks.iter().flatten().cloned().collect();
            let top = blocks.iter().all(Option::is_some);
            let scope = self.scopes.entry([&source.module[..], &inline].concat()).or_insert_with(|| Scope { file, ..Scope::default() });
            let before = at.checked_sub(1).map_or("", |before| tokens[before]);
            let next = tokens.get(at + 1).copied().unwrap_or_default();
            match tokens[at] {
                "mod" if is_word(next) => {
                    scope.children.insert(next.into());
                    if tokens.get(at + 2) == Some(&"{") {
                        blocks.push(Some(next.into()));
                    }
                    at += 2;
                }
                "{" => blocks.push(None),
                "}" => {
                    blocks.pop();
                }
                "use" => {
                    let public = before == "pub" || before == ")";
                    at = group(&tokens, at + 1, &[], &mut |path, name| scope.imports.push(Import { path, name, public }));
                }
                word if is_item(word) && is_word(next) => {
                    let named = top && !matches!(before, "<" | "," | "'" | "*") && !matches!(next, "fn" | "unsafe");
                    if named {
                        scope.items.insert(next.into());
                        at += 1;
                    }
                }
                word if is_word(word) && !matches!(before, "::" | "." | "'") => {
                    let mut path = vec![word.to_string()];
                    while tokens.get(at + 1) == Some(&"::") && tokens.get(at + 2).is_some_and(|next| is_word(next)) {
                        path.push(tokens[at + 2].into());
                        at += 2;
                    }
                    scope.named.insert(path);
                }
                _ => {}
            }
            at += 1;
        }
    }

    /// What a path means in a module. What a module of this crate does not show is taken for its file's.
    fn resolve(&self, module: &[String], path: &[String]) -> Target {
        let mut target = Target::Elsewhere;
        for (place, name) in path.iter().enumerate() {
            let last = place + 1 == path.len();
            target = match (&target, name.as_str()) {
                (_, "crate") => Target::Module(Vec::new()),
                (_, "self") if place == 0 => Target::Module(module.into()),
                (Target::Module(parent), "super") => Target::Module(parent[..parent.len().saturating_sub(1)].into()),
                (_, "super") => Target::Module(module[..module.len().saturating_sub(1)].into()),
                (_, name) if place == 0 => self.find(module, name, last, &mut Vec::new()).unwrap_or(Target::Elsewhere),
                (Target::Module(parent), name) => self.find(parent, name, last, &mut Vec::new()).unwrap_or_else(|| self.of_file(parent)),
                _ => unreachable!("the loop ends at what is no module"),
            };
            if !matches!(target, Target::Module(_)) {
                break;
            }
        }
        target
    }

    fn of_file(&self, module: &[String]) -> Target {
        self.scopes.get(module).map_or(Target::Elsewhere, |scope| Target::Item(scope.file))
    }

    /// What a name in a module's scope means: an item before a module of the same name at the end of a path, after it elsewhere.
    fn find(&self, module: &[String], name: &str, last: bool, passed: &mut Vec<(Module, String, bool)>) -> Option<Target> {
        let here = (module.to_vec(), name.to_string(), last);
        if passed.contains(&here) {
            return None;
        }
        passed.push(here);
        let scope = self.scopes.get(module)?;
        let mut found = Vec::new();
        if scope.items.contains(name) {
            found.push(Target::Item(scope.file));
        }
        if scope.children.contains(name) {
            found.push(Target::Module([module, &[name.to_string()]].concat()));
        }
        for import in scope.imports.iter().filter(|import| import.name.as_deref() == Some(name)) {
            found.push(self.follow(module, &import.path, last, passed));
        }
        if found.is_empty() {
            for import in scope.imports.iter().filter(|import| import.name.is_none()) {
                match self.follow(module, &import.path, false, passed) {
                    Target::Module(parent) => found.extend(self.find(&parent, name, last, passed)),
                    // whatever it has; of an item it is a variant
                    target => found.push(target),
                }
            }
        }
        let fits = |target: &&Target| **target != Target::Elsewhere && matches!(target, Target::Module(_)) != last;
        found.iter().find(fits).or(found.iter().find(|target| **target != Target::Elsewhere)).or(found.first()).cloned()
    }

    /// As `resolve`, within a search.
    fn follow(&self, module: &[String], path: &[String], last: bool, passed: &mut Vec<(Module, String, bool)>) -> Target {
        let (name, parents) = path.split_last().expect("a path has a name");
        if parents.is_empty() && !matches!(name.as_str(), "crate" | "self" | "super") {
            return self.find(module, name, last, passed).unwrap_or(Target::Elsewhere);
        }
        if parents.is_empty() || name == "super" {
            return self.resolve(module, path);
        }
        match self.follow(module, parents, false, passed) {
            Target::Module(parent) => self.find(&parent, name, last, passed).unwrap_or_else(|| self.of_file(&parent)),
            target => target,
        }
    }
}

/// Reads the tree of a `use` from `at` and tells every leaf; the answer is the place of the token that ends it.
fn group(tokens: &[&str], mut at: usize, before: &[String], tell: &mut impl FnMut(Vec<String>, Option<String>)) -> usize {
    let mut path = before.to_vec();
    loop {
        match tokens.get(at).copied() {
            Some("{") => {
                at += 1;
                while tokens.get(at).is_some_and(|token| *token != "}") {
                    at = group(tokens, at, &path, tell);
                    at += usize::from(tokens.get(at) == Some(&","));
                }
                return at + 1;
            }
            Some("*") => {
                tell(path, None);
                return at + 1;
            }
            Some("::") => {}
            Some("as") => {
                tell(path, Some(tokens[at + 1].into()));
                return at + 2;
            }
            Some("self") if !before.is_empty() && path == before => {}
            Some(word) if is_word(word) => path.push(word.into()),
            _ => {
                let name = path.last().cloned();
                tell(path, name);
                return at;
            }
        }
        at += 1;
    }
}

/// Whether a name follows this word where an item begins.
fn is_item(word: &str) -> bool {
    matches!(word, "fn" | "struct" | "enum" | "trait" | "type" | "const" | "static")
}

fn is_word(token: &str) -> bool {
    token.starts_with(|letter: char| letter.is_alphabetic() || letter == '_')
}

/// Words, `::` and single signs.
fn tokens(code: &str) -> Vec<&str> {
    let mut tokens = Vec::new();
    let mut rest = code.trim_start();
    while let Some(first) = rest.chars().next() {
        let word = rest.find(|letter: char| !letter.is_alphanumeric() && letter != '_').unwrap_or(rest.len());
        let length = if rest.starts_with("::") { 2 } else { word.max(first.len_utf8()) };
        tokens.push(&rest[..length]);
        rest = rest[length..].trim_start();
    }
    tokens
}

#[cfg(test)]
mod tests {
    use super::*;

    fn source(module: &str, code: &str) -> Source {
        Source { module: module.split("::").filter(|part| !part.is_empty()).map(String::from).collect(), code: code.into() }
    }

    /// The edges of files whose modules are named, as `from to`.
    fn edges(sources: &[(&str, &str)]) -> Vec<String> {
        let read: Vec<_> = sources.iter().map(|(module, code)| source(module, code)).collect();
        Modules::new(&read).edges().into_keys().map(|(from, to)| format!("{} {}", sources[from].0, sources[to].0)).collect()
    }

    #[test]
    fn an_import_leads_to_the_file_that_defines_the_name_however_it_is_written() {
        for code in [
            "use crate::a::b::X;",
            "use super::b::X;",
            "use super::{b::{X as Y}};",
            "use crate::a::b; fn f() { b::X::new() }",
            "use super::super::a::b::{self}; fn f() -> b::X {}",
            "fn f(x: super::b::X) {}",
            "fn f() { use crate::a::b::X; }",
            "use crate::Handed;",
            "use crate::*; fn f(x: Handed) {}",
            "mod inner { use super::super::b::X; }",
        ] {
            let files = [("", "mod a; pub use a::b::X as Handed;"), ("a", "mod b; mod c;"), ("a::b", "pub struct X;"), ("a::c", code)];
            assert_eq!(edges(&files), ["a::c a::b"], "{code}");
        }
    }

    #[test]
    fn declaring_handing_on_and_other_crates_are_no_imports() {
        let files = [
            ("", "mod a; pub use a::{X, y}; use other::a::Z; fn f() { self.y.a(); Z::X }"),
            ("a", "pub struct X; pub fn y() -> &'static Error {} pub use other::Error;"),
            ("b", "use crate::a::Error; use c::X; use crate::a;"),
        ];
        assert_eq!(edges(&files), Vec::<String>::new());
    }

    #[test]
    fn a_name_that_is_handed_on_and_used_is_an_import() {
        assert_eq!(edges(&[("", "mod a; pub use a::X; fn f(x: X) {}"), ("a", "pub struct X;")]), [" a"]);
        assert_eq!(edges(&[("", "mod a; mod b;"), ("a", "pub struct X;"), ("b", "pub use crate::a::X;")]), ["b a"]);
        assert_eq!(edges(&[("", "mod a; mod b; pub use a::f;"), ("a", "pub fn f() {}"), ("b", "use crate::f; ")]), ["b a"]);
        // a function and its module of one name
        assert_eq!(edges(&[("", "mod f; pub use f::f;"), ("f", "pub fn f() {}"), ("b", "use crate::f;")]), ["b f"]);
        assert_eq!(edges(&[("", "mod f; pub use f::f;"), ("f", "pub fn f() {} pub fn g() {}"), ("b", "use crate::f::g;")]), ["b f"]);
    }
}
