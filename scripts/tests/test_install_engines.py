"""The list of engine configurations and the installer's report; installs nothing."""

import contextlib
import io
import json
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

SCRIPTS = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(SCRIPTS))

import install_engines  # noqa: E402
from reference.environment import NotInstalled, is_current, stamp_of  # noqa: E402

CONFIGURATIONS = json.loads((SCRIPTS / "engines" / "engines.json").read_text())["engines"]


class Configurations(unittest.TestCase):
    def test_names_are_unique_words(self):
        names = [configuration["name"] for configuration in CONFIGURATIONS]
        self.assertEqual(len(set(names)), len(names))
        for name in names:
            self.assertRegex(name, r"^[a-z0-9.-]+$")

    def test_every_configuration_has_a_command_options_and_a_way_to_install_it(self):
        for configuration in CONFIGURATIONS:
            self.assertEqual(list(configuration), ["name", "command", "options", "install"])
            self.assertIsInstance(configuration["options"], dict)
            if install_engines.OWN in configuration["command"]:
                continue
            engine = install_engines.engine_of(configuration["command"])
            if configuration["command"][0].startswith(".venv/"):
                self.assertEqual(configuration["install"],
                                 f"python3 scripts/install_engines.py {engine}")

    def test_every_adapter_is_in_the_list(self):
        listed = set(install_engines.commands_by_engine())
        adapters = {path.stem for path in (SCRIPTS / "engines").glob("[a-z]*.py")}
        self.assertLessEqual(adapters, listed)

    def test_a_command_without_adapter_is_refused(self):
        with self.assertRaises(ValueError):
            install_engines.engine_of(["python3", "engine.py"])


def version_of_script(text):
    with tempfile.TemporaryDirectory() as folder:
        script = Path(folder) / "adapter.py"
        script.write_text(text)
        return install_engines.version_of([sys.executable, str(script)])


class Versions(unittest.TestCase):
    def test_an_adapter_that_describes_itself_is_installed(self):
        self.assertEqual(version_of_script(
            'input(); print(\'{"id":1,"result":{"name":"toy","version":"1.2"}}\')'), "1.2")

    def test_the_reason_is_the_last_line_of_standard_error(self):
        with self.assertRaisesRegex(NotInstalled, "No module named 'no_such_engine'"):
            version_of_script("import no_such_engine")

    def test_garbage_and_refusals_are_not_installed(self):
        for line in ("hello", "[]", '{"id":1,"error":"broken"}', '{"id":1,"result":[]}'):
            with self.assertRaises(NotInstalled, msg=line):
                version_of_script(f"print({line!r})")

    def test_a_missing_program_is_named(self):
        with self.assertRaisesRegex(NotInstalled, "no/such/python does not exist"):
            install_engines.version_of(["no/such/python", "scripts/engines/x.py"])


class Report(unittest.TestCase):
    def run_main(self, *words, version="1"):
        text = io.StringIO()
        with contextlib.redirect_stdout(text), contextlib.redirect_stderr(io.StringIO()), \
                mock.patch.object(install_engines, "state_of", side_effect=version), \
                mock.patch.object(install_engines, "install") as install:
            return install_engines.main(list(words)), text.getvalue(), install.call_count

    def test_list_installs_nothing_and_names_every_engine(self):
        status, text, installs = self.run_main("--list", version=lambda *_: "1")
        self.assertEqual((status, installs), (0, 0))
        self.assertEqual(len(text.splitlines()), len(install_engines.commands_by_engine()))

    def test_one_missing_engine_is_reported_and_fails_the_run(self):
        status, text, installs = self.run_main("mujoco", version=NotInstalled("no such package"))
        self.assertEqual((status, installs), (1, 1))
        self.assertIn("not installed: no such package", text)

    def test_an_unknown_engine_is_wrong_usage(self):
        with self.assertRaises(SystemExit) as end:
            self.run_main("mujoko")
        self.assertEqual(end.exception.code, 2)


class Environments(unittest.TestCase):
    def test_an_environment_is_current_until_its_requirements_change(self):
        with tempfile.TemporaryDirectory() as folder:
            root = Path(folder)
            requirements = root / "requirements-toy.txt"
            requirements.write_text("toy==1\n")
            (root / "toy" / "bin").mkdir(parents=True)
            (root / "toy" / "bin" / "python").touch()
            (root / "toy" / "installed").write_text(stamp_of(requirements))
            self.assertTrue(is_current("toy", root, root))
            requirements.write_text("toy==2\n")
            self.assertFalse(is_current("toy", root, root))
            (root / "toy" / "installed").unlink()
            self.assertFalse(is_current("toy", root, root))


if __name__ == "__main__":
    unittest.main()
