#!/usr/bin/env python3
"""Packs every crate, looks into the archives, and compiles what they hold.

    python3 scripts/check_packages.py [--test]

`cargo package` packs what is committed. No archive is larger than 9 MB or without its two licences; together they hold every file of the repository, byte for byte, but for what is listed
in NOT_PACKED with its reason. Unpacked into one workspace, laid out as the checkout is, their own manifests compile: libraries, programs, tests, examples and benches,
and with them every file that is included at compile time. Tests read the same files from them as from the checkout; with --test they are run there, which compiles
everything once more (for a release). Needs Rust and Python 3.11.
"""

import argparse
import json
import pathlib
import shutil
import subprocess
import sys
import tarfile
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
LARGEST = 9 * 1024 * 1024
# What is in no archive, by the beginning of its path, and why.
NOT_PACKED = {
    ".ci/": "the project's own CI",
    "crates/moreau-python/": "a package of Python, whose archive is the sdist",
    "scripts/engines/rapier/": "a package of its own, which a script compiles",
}
# Folders of what is built and installed.
BUILT = {".git", ".venv", "__pycache__", "target"}
# What cargo writes into an archive.
WRITTEN_BY_CARGO = {".cargo_vcs_info.json", "Cargo.lock", "Cargo.toml"}


def packages() -> list[tuple[str, str, pathlib.PurePosixPath]]:
    """Name, version and folder in the repository of every crate that is packed, the top one first."""
    text = subprocess.run(["cargo", "metadata", "--no-deps", "--format-version", "1"], cwd=ROOT, check=True, capture_output=True, text=True).stdout
    found = []
    for package in json.loads(text)["packages"]:
        folder = pathlib.Path(package["manifest_path"]).parent.relative_to(ROOT)
        if package["publish"] != []:
            found.append((package["name"], package["version"], pathlib.PurePosixPath(folder)))
    return sorted(found, key=lambda package: package[2])


def check_archive(archive: pathlib.Path) -> None:
    """Its size and its licences."""
    size = archive.stat().st_size
    print(f"{archive.name}: {size} bytes", flush=True)
    if size > LARGEST:
        raise SystemExit(f"{archive.name} has {size} bytes; at most {LARGEST} are allowed")
    with tarfile.open(archive) as packed:
        licences = [name for name in packed.getnames() if "/LICENSE-" in name]
    if len(licences) != 2:
        raise SystemExit(f"{archive.name} has not both licences, but {licences}")


def unpack(archive: pathlib.Path, folder: pathlib.Path) -> None:
    """Puts what an archive holds into a folder, without the name and version that all paths in it begin with."""
    with tarfile.open(archive) as packed:
        for member in packed.getmembers():
            member.name = member.name.partition("/")[2]
            packed.extract(member, folder, filter="data")


def differences(files: list[str], checkout: pathlib.Path, unpacked: pathlib.Path) -> list[str]:
    """What the archives together lack of these files of the checkout, or hold otherwise; what need not be packed is, for the list would be wrong."""
    wrong = []
    for name in files:
        left_out = next((beginning for beginning in NOT_PACKED if name.startswith(beginning)), None)
        path = pathlib.PurePosixPath(name)
        # cargo keeps the manifest that was written under another name
        packed = unpacked / (path.with_name("Cargo.toml.orig") if path.name == "Cargo.toml" else path)
        if left_out is not None:
            if packed.exists():
                wrong.append(f"{name}: packed, though {NOT_PACKED[left_out]} is not")
        elif path.name in WRITTEN_BY_CARGO - {"Cargo.toml"}:
            continue
        elif not packed.is_file():
            wrong.append(f"{name}: in no archive")
        elif packed.read_bytes() != (checkout / name).read_bytes():
            wrong.append(f"{name}: differs from the checkout's")
    return wrong


def repository_files() -> list[str]:
    """What git keeps; where there is no git, as in an exported tree, every file but what is built or installed there."""
    # whoever owns the folder
    command = ["git", "-c", "safe.directory=*", "ls-files", "-z"]
    known = subprocess.run(command, cwd=ROOT, check=False, capture_output=True, text=True) if shutil.which("git") else None
    if known is not None and known.returncode == 0:
        return [name for name in known.stdout.split("\0") if name and (ROOT / name).is_file()]
    paths = (path.relative_to(ROOT) for path in ROOT.rglob("*") if path.is_file())
    return sorted(str(path) for path in paths if not BUILT.intersection(path.parts))


def workspace(top: str, members: list[str], folders: list[str]) -> str:
    """The manifest of the unpacked top crate as that of a workspace: the archives ask the registry for each other, and are patched onto each other here."""
    patches = "".join(f'{name} = {{ path = "{folder}" }}\n' for name, folder in zip(members, folders, strict=True))
    listed = ", ".join(f'"{folder}"' for folder in [".", *folders])
    return f'{top}\n[workspace]\nresolver = "3"\nmembers = [{listed}]\ndefault-members = [{listed}]\n\n[patch.crates-io]\n{patches}'


def lay_out(found: list[tuple[str, str, pathlib.PurePosixPath]], folder: pathlib.Path) -> None:
    """Unpacks the archives as the checkout has their crates, and makes one workspace of them."""
    for name, version, place in found:
        unpack(ROOT / "target" / "package" / f"{name}-{version}.crate", folder / place)
    inner = [(name, str(place)) for name, _, place in found if place != pathlib.PurePosixPath(".")]
    top = folder / "Cargo.toml"
    names, folders = [name for name, _ in inner], [place for _, place in inner]
    top.write_text(workspace(top.read_text(encoding="utf-8"), names, folders), encoding="utf-8")
    shutil.copy(ROOT / "Cargo.lock", folder / "Cargo.lock")


def lend(folder: pathlib.Path) -> None:
    """What is compiled of the registry's crates, copied: a target folder that is shared would take the checkout's programs for those of the archives."""
    for part in ("deps", ".fingerprint", "build"):
        compiled, place = ROOT / "target" / "debug" / part, folder / "target" / "debug" / part
        place.mkdir(parents=True)
        for entry in compiled.iterdir() if compiled.is_dir() else ():
            library = entry.is_dir() or ".r" in entry.name or entry.suffix in (".so", ".d")
            if library and "moreau" not in entry.name:
                subprocess.run(["cp", "-a", "--", entry, place], check=True)


def main() -> int:
    """Packs, looks and compiles."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--test", action="store_true", help="run the tests of the archives, too")
    arguments = parser.parse_args()
    subprocess.run(["cargo", "package", "--workspace", "--exclude", "moreau-python", "--no-verify"], cwd=ROOT, check=True)
    found = packages()
    for name, version, _ in found:
        check_archive(ROOT / "target" / "package" / f"{name}-{version}.crate")
    with tempfile.TemporaryDirectory(prefix="moreau-packages-") as name:
        folder = pathlib.Path(name)
        lay_out(found, folder)
        wrong = differences(repository_files(), ROOT, folder)
        if wrong:
            raise SystemExit("\n".join(["the archives are not what the repository is:", *wrong]))
        lend(folder)
        command = ["cargo", "test", "--workspace"] if arguments.test else ["cargo", "check", "--workspace", "--all-targets"]
        done = subprocess.run([*command, "--target-dir", str(folder / "target")], cwd=folder, check=False)
    return done.returncode


if __name__ == "__main__":
    sys.exit(main())
