"""Tests of check_packages.py: what archives lack or hold otherwise, and the workspace of what is unpacked."""

import io
import pathlib
import sys
import tarfile
import tempfile
import tomllib
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))

import check_packages  # noqa: E402


def write(folder: pathlib.Path, files: dict[str, str]) -> None:
    for name, text in files.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text, encoding="utf-8")


def archive(path: pathlib.Path, names: list[str], size: int = 0) -> pathlib.Path:
    with tarfile.open(path, "w") as packed:
        for name in names:
            entry = tarfile.TarInfo(name)
            entry.size = size
            packed.addfile(entry, io.BytesIO(bytes(size)))
    return path


class CheckPackages(unittest.TestCase):
    """Every mistake that the script exists to catch."""

    def setUp(self):
        kept = tempfile.TemporaryDirectory()
        self.addCleanup(kept.cleanup)
        self.folder = pathlib.Path(kept.name)
        self.checkout, self.unpacked = self.folder / "checkout", self.folder / "unpacked"

    def differences(self) -> list[str]:
        files = [str(path.relative_to(self.checkout)) for path in sorted(self.checkout.rglob("*")) if path.is_file()]
        return check_packages.differences(files, self.checkout, self.unpacked)

    def test_the_repository_in_the_archives_is_as_it_is_there(self):
        write(self.checkout, {"Cargo.toml": "[package]", "Cargo.lock": "1", ".ci/run": "x", "crates/a/src/lib.rs": "//! a"})
        write(self.unpacked, {"Cargo.toml": "written by cargo", "Cargo.toml.orig": "[package]", "Cargo.lock": "2", "crates/a/src/lib.rs": "//! a"})
        self.assertEqual(self.differences(), [])

    def test_a_file_that_is_missing_changed_or_packed_against_the_list_is_named(self):
        write(self.checkout, {"Cargo.toml": "[package]", "docs/a.md": "a", "docs/b.md": "b", ".ci/run": "x"})
        write(self.unpacked, {"Cargo.toml.orig": "[package]\n", "docs/b.md": "c", ".ci/run": "x"})
        named = [line.partition(":")[0] for line in self.differences()]
        self.assertEqual(named, [".ci/run", "Cargo.toml", "docs/a.md", "docs/b.md"])

    def test_an_archive_that_is_too_large_or_has_one_licence_is_refused(self):
        both = ["a-1/LICENSE-MIT", "a-1/LICENSE-APACHE"]
        check_packages.check_archive(archive(self.folder / "right.crate", both))
        with self.assertRaisesRegex(SystemExit, "not both licences"):
            check_packages.check_archive(archive(self.folder / "one.crate", both[:1]))
        with self.assertRaisesRegex(SystemExit, "at most"):
            check_packages.check_archive(archive(self.folder / "large.crate", both, check_packages.LARGEST // 2))

    def test_paths_lose_name_and_version(self):
        check_packages.unpack(archive(self.folder / "a.crate", ["a-1/src/lib.rs"], 3), self.unpacked)
        self.assertEqual([path.name for path in self.unpacked.iterdir()], ["src"])

    def test_every_crate_is_a_member_and_patched_under_its_name(self):
        top = '[package]\nname = "moreau"\nversion = "0.1.0"\n'
        manifest = tomllib.loads(check_packages.workspace(top, ["moreau-contact"], ["crates/moreau-contact"]))
        self.assertEqual(manifest["workspace"]["members"], [".", "crates/moreau-contact"])
        self.assertEqual(manifest["workspace"]["default-members"], manifest["workspace"]["members"])
        self.assertEqual(manifest["patch"]["crates-io"]["moreau-contact"], {"path": "crates/moreau-contact"})

    def test_every_crate_but_pythons_is_packed_the_top_one_first(self):
        names = [name for name, _, _ in check_packages.packages()]
        self.assertEqual(names[0], "moreau")
        self.assertEqual(len(names), 9)
        self.assertNotIn("moreau-python", names)


if __name__ == "__main__":
    unittest.main()
