"""Tests of unpacked_workspace.py: the workspace of unpacked archives."""

import pathlib
import sys
import tempfile
import tomllib
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))

import unpacked_workspace  # noqa: E402


class UnpackedWorkspace(unittest.TestCase):
    """Members, patches and profiles."""

    def test_every_archive_is_a_member_and_patched_under_its_package_name(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            for package in ("moreau", "moreau-contact"):
                (folder / f"{package}-0.1.0").mkdir()
                (folder / f"{package}-0.1.0" / "Cargo.toml").write_text(f'[package]\nname = "{package}"\n', encoding="utf-8")
            manifest = tomllib.loads(unpacked_workspace.manifest(folder))
        self.assertEqual(manifest["workspace"]["members"], ["moreau-0.1.0", "moreau-contact-0.1.0"])
        self.assertEqual(manifest["workspace"]["default-members"], manifest["workspace"]["members"])
        self.assertEqual(manifest["patch"]["crates-io"]["moreau-contact"], {"path": "moreau-contact-0.1.0"})
        self.assertEqual(manifest["profile"]["dev"]["opt-level"], 1)
        self.assertEqual(manifest["profile"]["dev"]["package"]["*"]["opt-level"], 3)

    def test_a_folder_without_archives_is_refused(self):
        with tempfile.TemporaryDirectory() as name, self.assertRaises(SystemExit):
            unpacked_workspace.manifest(pathlib.Path(name))


if __name__ == "__main__":
    unittest.main()
