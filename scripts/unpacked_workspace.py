#!/usr/bin/env python3
"""Makes one workspace of unpacked archives, so that their tests run together in one target folder.

    python3 scripts/unpacked_workspace.py FOLDER

FOLDER holds what `cargo package --workspace` packed, unpacked: `moreau-0.1.0/`, `moreau-contact-0.1.0/` … Each archive asks the registry for the others; here they are
patched onto each other. The profiles are those of the checkout's manifest, the versions those of its lock file.
"""

import pathlib
import re
import shutil
import sys
import tomllib

ROOT = pathlib.Path(__file__).resolve().parent.parent


def profiles() -> str:
    """The text of the checkout's profile tables."""
    text = (ROOT / "Cargo.toml").read_text(encoding="utf-8")
    tables = re.findall(r"^\[profile\.[^\n]*\]\n(?:[^\[\n][^\n]*\n)+", text, flags=re.MULTILINE)
    return "\n".join(tables)


def manifest(folder: pathlib.Path) -> str:
    """The workspace of the archives in a folder."""
    members = sorted(path.parent for path in folder.glob("*/Cargo.toml"))
    if not members:
        raise SystemExit(f"{folder}: no unpacked archive; run `cargo package --workspace` and unpack target/package/*.crate here")
    names = {member.name: tomllib.loads((member / "Cargo.toml").read_text(encoding="utf-8"))["package"]["name"] for member in members}
    patches = "".join(f'{name} = {{ path = "{folder_name}" }}\n' for folder_name, name in names.items())
    listed = ", ".join(f'"{name}"' for name in names)
    return f'[workspace]\nresolver = "3"\nmembers = [{listed}]\ndefault-members = [{listed}]\n\n[patch.crates-io]\n{patches}\n{profiles()}'


def main() -> int:
    """Writes the workspace's manifest and lock file."""
    if len(sys.argv) != 2:
        raise SystemExit(__doc__)
    folder = pathlib.Path(sys.argv[1])
    (folder / "Cargo.toml").write_text(manifest(folder), encoding="utf-8")
    shutil.copy(ROOT / "Cargo.lock", folder / "Cargo.lock")
    return 0


if __name__ == "__main__":
    sys.exit(main())
