//! The version with the commit that it is built from, for `moreau --version`: of a packed crate the one in its archive, of a checkout the
//! one that git tells; elsewhere there is none.

use std::env::var;
use std::path::Path;
use std::process::Command;

fn main() {
    let root = var("CARGO_MANIFEST_DIR").unwrap_or_default();
    let version = var("CARGO_PKG_VERSION").unwrap_or_default();
    println!("cargo::rerun-if-changed=build.rs");
    let commit = packed(Path::new(&root)).or_else(|| checked_out(Path::new(&root)));
    let commit = commit.map(|commit| format!(" (commit {})", &commit[..commit.len().min(12)])).unwrap_or_default();
    println!("cargo::rustc-env=MOREAU_VERSION={version}{commit}");
}

/// The commit of a packed crate: `"sha1": "…"` in what cargo puts beside the manifest.
fn packed(root: &Path) -> Option<String> {
    let text = std::fs::read_to_string(root.join(".cargo_vcs_info.json")).ok()?;
    let (_, after) = text.split_once("\"sha1\"")?;
    after.split('"').nth(1).map(Into::into)
}

/// The commit of the checkout whose root this is; no other repository around it is asked.
fn checked_out(root: &Path) -> Option<String> {
    let top = git(root, &["rev-parse", "--show-toplevel"])?;
    if Path::new(&top).canonicalize().ok()? != root.canonicalize().ok()? {
        return None;
    }
    // written by every commit and every checkout
    for name in ["HEAD", "logs/HEAD"] {
        let file = git(root, &["rev-parse", "--git-path", name])?;
        if root.join(&file).exists() {
            println!("cargo::rerun-if-changed={}", root.join(&file).display());
        }
    }
    git(root, &["rev-parse", "HEAD"])
}

/// What git prints, if there is a git and it succeeds.
fn git(root: &Path, arguments: &[&str]) -> Option<String> {
    let run = Command::new("git").args(arguments).current_dir(root).output().ok().filter(|run| run.status.success())?;
    Some(String::from_utf8(run.stdout).ok()?.trim().into())
}
