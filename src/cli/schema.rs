//! `moreau schema`: the JSON Schemas of messages and files.

use super::near::suggestion;
use super::output::{print, style};
use super::several::require_folder;
use super::{Answer, Format, section};
use crate::files::write_together;
use crate::report::formats::{BEGIN, END, markdown};
use crate::report::json::pretty;
use crate::report::schemas::FORMATS;
use crate::{Error, Result};
use std::path::{Path, PathBuf};

/// Print the JSON Schema of a message or file format, or list them.
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    /// The format; without it, the formats are listed.
    #[arg(value_name = "NAME")]
    name: Option<String>,
    /// Write all schemas into this folder, which must exist, as NAME.schema.json, all or none.
    #[arg(long, value_name = "FOLDER", conflicts_with = "name")]
    write: Option<PathBuf>,
    /// Replace the section between `<!-- formats -->` and `<!-- /formats -->` of this file by the tables of the fields of the files that
    /// people write; docs/formats.md is where they stand.
    #[arg(long, value_name = "FILE", conflicts_with_all = ["name", "write"])]
    readme: Option<PathBuf>,
    /// How to write the list.
    #[arg(long, value_enum, default_value_t, conflicts_with_all = ["name", "write", "readme"])]
    format: Format,
}

const EXAMPLES: &str = "\
Examples:
  moreau schema                     the formats
  moreau schema trajectory          the schema of trajectory/1
  moreau schema --write schemas     every schema, as a file
  moreau schema --readme docs/formats.md";

/// Runs the subcommand.
pub fn run(arguments: &Arguments) -> Result<Answer> {
    if let Some(folder) = &arguments.write {
        return write(folder);
    }
    if let Some(file) = &arguments.readme {
        let text = section::replaced(file, [BEGIN, END], &markdown())?;
        write_together(&[(file.as_path(), text.as_bytes())])?;
        return Ok(Answer::Yes);
    }
    let Some(name) = &arguments.name else { return list(arguments.format) };
    let format = FORMATS.iter().find(|format| format.name == name).ok_or_else(|| {
        let cure = suggestion(name, FORMATS.iter().map(|format| format.name), "`moreau schema` lists them");
        Error::Unsupported(format!("no format `{name}`; {cure}"))
    })?;
    print(&format.schema())?;
    Ok(Answer::Yes)
}

fn list(format: Format) -> Result<Answer> {
    print(&match format {
        Format::Text => {
            let style = style();
            let line = |format: &crate::report::schemas::Format| {
                style.wrapped("", &" ".repeat(17), &format!("{:16} {}", format.name, format.about)) + "\n"
            };
            FORMATS.iter().map(line).collect()
        }
        Format::Json => {
            let entry = |format: &crate::report::schemas::Format| serde_json::json!({"name": format.name, "about": format.about});
            pretty(&FORMATS.iter().map(entry).collect::<Vec<_>>())?
        }
    })?;
    Ok(Answer::Yes)
}

fn write(folder: &Path) -> Result<Answer> {
    require_folder("--write", folder)?;
    let texts: Vec<(PathBuf, String)> = FORMATS.iter().map(|format| (folder.join(format.file()), format.schema())).collect();
    let files: Vec<(&Path, &[u8])> = texts.iter().map(|(file, text)| (file.as_path(), text.as_bytes())).collect();
    write_together(&files)?;
    Ok(Answer::Yes)
}
