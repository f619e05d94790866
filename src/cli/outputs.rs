//! Files that results are written into: refused before anything is computed where the name says another kind of file, or where nothing can
//! be written.

use crate::{Error, Result};
use std::path::Path;

/// What is written into a file.
#[derive(Clone, Copy, Debug)]
pub struct Content {
    /// In words.
    words: &'static str,
    /// How the name of the file ends.
    ends: &'static [&'static str],
}

/// Every format in JSON.
pub const JSON: Content = Content { words: "JSON", ends: &["json"] };
/// A page of its own.
pub const HTML: Content = Content { words: "an HTML page", ends: &["html", "htm", "xhtml"] };
/// A picture.
pub const SVG: Content = Content { words: "an SVG picture", ends: &["svg"] };
/// A report for CI.
pub const JUNIT: Content = Content { words: "JUnit XML", ends: &["xml"] };
/// A baseline of the gate.
pub const TOML: Content = Content { words: "TOML", ends: &["toml"] };
/// Programs.
pub const PYTHON: Content = Content { words: "a program in Python", ends: &["py"] };
/// A program for Node.
pub const JAVASCRIPT: Content = Content { words: "a program in JavaScript", ends: &["js", "cjs"] };
/// A program to compile.
pub const RUST: Content = Content { words: "a program in Rust", ends: &["rs"] };

/// Ends of names that say what a file holds; any other end may hold anything.
const TELLING: [&str; 43] = [
    "json", "jsonl", "html", "htm", "xhtml", "svg", "xml", "toml", "py", "js", "mjs", "cjs", "rs", "md", "csv", "tsv", "yaml", "yml",
    "png", "jpg", "jpeg", "gif", "webp", "bmp", "tif", "tiff", "pdf", "ps", "eps", "hdf5", "h5", "dat", "npy", "npz", "zip", "gz", "tar",
    "tex", "css", "mp4", "xlsx", "doc", "docx",
];

/// Refuses a file that is named as another kind, that is a folder, or whose folder is not there; `option` names it.
///
/// # Errors
/// [`Error::Invalid`] with the option, the file and the cure.
pub fn require(option: &str, file: Option<&Path>, content: Content) -> Result<()> {
    let Some(file) = file else { return Ok(()) };
    if file == Path::new("-") {
        return Err(Error::invalid(option, "is -, which is no file", "name a file: /dev/stdout, or ./- for one of that name"));
    }
    let end = file.extension().map(|end| end.to_string_lossy().to_lowercase()).unwrap_or_default();
    if TELLING.contains(&end.as_str()) && !content.ends.contains(&end.as_str()) {
        let problem = format!("is {}, and what is written there is {}", file.display(), content.words);
        return Err(Error::invalid(option, problem, format!("end the name in .{}", content.ends[0])));
    }
    if file.is_dir() {
        return Err(Error::invalid(option, format!("is {}, a folder", file.display()), "name a file in it"));
    }
    match file.parent().filter(|folder| !folder.as_os_str().is_empty()) {
        Some(folder) if !folder.exists() => {
            let problem = format!("is {}, and there is no folder {}", file.display(), folder.display());
            Err(Error::invalid(option, problem, "make the folder, or name another one"))
        }
        Some(folder) if !folder.is_dir() => {
            let problem = format!("is {}, and {} is a file", file.display(), folder.display());
            Err(Error::invalid(option, problem, "name a file in a folder"))
        }
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refused(file: &str, content: Content) -> Option<String> {
        require("--option", Some(Path::new(file)), content).err().map(|error| error.to_string())
    }

    #[test]
    fn a_name_of_another_kind_is_refused_and_any_other_is_taken() {
        let all = [JSON, HTML, SVG, JUNIT, TOML, PYTHON, JAVASCRIPT, RUST];
        for content in all {
            for end in content.ends {
                assert!(TELLING.contains(end), "{end}");
                assert_eq!(refused(&format!("file.{}", end.to_uppercase()), content), None);
                for other in all.iter().filter(|other| !other.ends.contains(end)) {
                    let message = refused(&format!("file.{end}"), *other).expect("another kind");
                    for word in ["--option", &format!("file.{end}"), other.words, &format!("end the name in .{}", other.ends[0])] {
                        assert!(message.contains(word), "{word}: {message}");
                    }
                }
            }
            assert_eq!(["file", "file.out", "file.txt", "a.json.part"].map(|file| refused(file, content)), [None, None, None, None]);
            assert!(refused("file.png", content).is_some() && require("--option", None, content).is_ok());
        }
    }

    #[test]
    fn a_place_where_nothing_can_be_written_is_refused() {
        let folder = std::env::temp_dir().join(format!("moreau-outputs-{}", std::process::id()));
        std::fs::create_dir_all(&folder).expect("a folder for temporary files");
        std::fs::write(folder.join("file"), "").expect("a writable folder");
        let said = |name: &str| refused(&folder.join(name).to_string_lossy(), JSON).unwrap_or_default();
        assert!(said(".").contains("a folder; name a file in it"));
        assert!(said("none/x.json").contains("there is no folder") && said("none/x.json").contains("make the folder"));
        assert!(said("file/x.json").contains("is a file; name a file in a folder"));
        assert_eq!(said("x.json"), "");
        assert!(refused("-", JSON).is_some_and(|said| said.contains("/dev/stdout")) && refused("./-", JSON).is_none());
        std::fs::remove_dir_all(&folder).expect("it was made");
    }
}
