#!/usr/bin/env python3
"""Make, or check, the files under references/ with the real engines.

For every engine this makes a virtual environment from scripts/requirements-<engine>.txt, starts
scripts/engines/<engine>.py in it (Rapier's adapter is built with cargo), and asks it through the protocol moreau-engine/1 for the
motions and single steps listed in scripts/reference/plan.py, and for the facts that
scripts/reference/facts.py describes.  Siconos, a Debian package, is run
by scripts/reference/siconos.py, some of it by a C++ program that needs g++ and libsiconos-kernel-dev.  The result does not depend on the date, the machine's name or
the order of the runs.
"""

import argparse
import json
import os
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

from reference import build, documents, environment, facts, packages, siconos  # noqa: E402
from reference.client import Engine, EngineError  # noqa: E402
from reference.compare import check, comparable, numbers_by_kind, tolerances_of  # noqa: E402
from reference.plan import all_jobs  # noqa: E402
from reference.scenes import all_scenes  # noqa: E402
from reference.tolerance import loose_kinds  # noqa: E402

SCRIPTS = Path(__file__).resolve().parent
DEFAULT = ("mujoco", "drake", "siconos")
OPTIONAL = ("bullet", "pinocchio", "dart", "rapier")  # run without being named only where they are installed already
ENGINES = DEFAULT + OPTIONAL
EPILOG = """
examples:
  scripts/generate_references.py                      write all files (some minutes)
  scripts/generate_references.py --only mujoco        write the files of one engine
  scripts/generate_references.py --check --require mujoco,drake
                                                      what continuous integration runs

--check makes every document again, in memory, and compares it number by number with the stored
file.  The tolerances come from scripts/reference/tolerance.py and from the amplification stored
in each file.  As a control, one stored number of every kind is moved by ten times its tolerance;
if that goes unnoticed, the check itself fails.  Missing and additional files are differences.

An engine that cannot be installed is reported as "not run"; with --require it is a failure.
mujoco and drake are installed on demand, the others only when --only or --require names them.

exit status: 0 everything agrees (or was written), 1 there are differences,
             2 wrong usage, or a required engine did not run
"""


def report(message, end="\n"):
    """One line on standard error."""
    print(message, end=end, file=sys.stderr, flush=True)


def progress(text):
    """Rewrite the progress line on a terminal; say nothing elsewhere."""
    if sys.stderr.isatty():
        report(f"\r\033[K{text}", end="")


def engine_list(text):
    """Parse `mujoco,drake`."""
    names = [name for name in text.split(",") if name]
    for name in names:
        if name not in ENGINES:
            raise argparse.ArgumentTypeError(f"unknown engine {name!r}; known: {', '.join(ENGINES)}")
    return names


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, epilog=EPILOG,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true",
                        help="compare with the stored files and write nothing")
    parser.add_argument("--only", type=engine_list, metavar="ENGINE[,ENGINE]", default=[],
                        help=f"engines to run (default: {','.join(DEFAULT)}, and those installed "
                             f"among {','.join(OPTIONAL)})")
    parser.add_argument("--require", type=engine_list, metavar="ENGINE[,ENGINE]", default=[],
                        help="engines that must run")
    parser.add_argument("--match", metavar="TEXT", default="",
                        help="only files whose path contains this text")
    parser.add_argument("--references", type=Path, default=SCRIPTS.parent / "references",
                        help="folder of the files (default: %(default)s)")
    parser.add_argument("--environments", type=Path, default=SCRIPTS.parent / ".venv",
                        help="folder of the virtual environments (default: %(default)s)")
    return parser.parse_args()


class Run:
    """One invocation: what to do with a document, and what came of it."""

    def __init__(self, options):
        self.options, self.scenes = options, all_scenes()
        self.failures, self.done = [], 0

    def fail(self, path, messages):
        """Report the first differences of a file."""
        self.failures.append(path)
        progress("")
        report(f"DIFFERENT {path}: {len(messages)} differences")
        for message in messages[:5]:
            report(f"    {message}")

    def scene_files(self):
        """Write the scenes, or compare them exactly."""
        for name, scene in self.scenes.items():
            path = self.options.references / "scenes" / f"{name}.json"
            if not self.options.check:
                documents.write(path, scene)
            elif not path.exists():
                self.fail(f"scenes/{name}.json", ["missing"])
            elif documents.read(path) != scene:
                self.fail(f"scenes/{name}.json", ["differs from scripts/reference/scenes.py"])

    def job(self, engine, job, description):
        """Make one document; store it, or compare it."""
        scene = json.loads(json.dumps(self.scenes.get(getattr(job, "scene", None))))
        path = self.options.references / job.path
        if self.options.check and not path.exists():
            return self.fail(job.path, ["missing"])
        fresh = build.document(engine, job, scene, description)
        if self.options.check:
            messages, blind = check(documents.read(path), fresh)
            messages += [f"control: ten times the tolerance of {kind} goes unnoticed"
                         for kind in blind]
            if messages:
                self.fail(job.path, messages)
        else:
            fresh["provenance"]["sensitivity"] = build.sensitivity(engine, job, scene, fresh)
            table = comparable(fresh)
            loose = loose_kinds(numbers_by_kind(table), tolerances_of(fresh, table))
            if loose:
                return self.fail(job.path, loose)
            documents.write(path, fresh)
        self.done += 1

    def facts(self, place, make):
        """Store the facts that `make` finds out, or compare them; files that do not match are passed over."""
        path = self.options.references / place
        if self.options.match not in place:
            return
        if self.options.check and not path.exists():
            return self.fail(place, ["missing"])
        fresh = make()
        if not self.options.check:
            facts.write(path, fresh)
        elif messages := facts.differences_of(facts.read(path), fresh):
            self.fail(place, messages)
        self.done += 1

    def facts_of(self, name, engine, description):
        """The facts about an engine: what it says of itself, and what its package holds."""
        askers = {}
        if name in facts.ADAPTERS:
            askers[f"facts/{name}.json"] = lambda: facts.ask(engine, self.scenes, description)
        if name in packages.SUBJECTS:
            askers[packages.place(name)] = lambda: packages.package(name, engine.command)
        for place, make in askers.items():
            try:
                self.facts(place, make)
            except (EngineError, ValueError) as problem:
                self.fail(place, [str(problem)])

    def engine(self, name, jobs):
        """All jobs of one engine; raises NotInstalled when it cannot run at all."""
        named = name in DEFAULT or name in self.options.only or name in self.options.require
        if not (named or environment.is_installed(name, SCRIPTS, self.options.environments)):
            raise environment.NotInstalled(f"not installed; --only {name} installs it")
        command, before = environment.command_of(name, SCRIPTS, self.options.environments, report), self.done
        with open(os.devnull, "wb") as log:
            with Engine(command, log) as engine:
                description = engine.ask("describe")
                for number, job in enumerate(jobs, 1):
                    progress(f"{name} {number}/{len(jobs)} {job.path}")
                    try:
                        self.job(engine, job, description)
                    except (EngineError, ValueError) as problem:
                        self.fail(job.path, [str(problem)])
                self.facts_of(name, engine, description)
        progress("")
        report(f"{name} {description['version']}: {self.done - before} files")

    def stray_files(self, engine, jobs):
        """Files below references/<engine>/ that no job makes."""
        expected = {job.path for job in jobs}
        expected |= {packages.place(engine)} if engine in packages.SUBJECTS else set()
        folder = self.options.references / engine
        for path in sorted(folder.glob("*")) if folder.exists() else []:
            relative = f"{engine}/{path.name}"
            if relative not in expected:
                self.fail(relative, ["not in the plan; delete it or add it to the plan"])


def main():
    options = arguments()
    run, not_run = Run(options), []
    run.scene_files()
    for name in options.only or ENGINES:
        jobs = [job for job in all_jobs() if job.engine == name]
        try:
            if name == siconos.FOLDER:
                left_out, made = siconos.write_or_check(run, SCRIPTS)
                report(f"siconos: {made} files")
                for path, why in left_out.items():
                    report(f"{path}: not run: {why}")
                not_run += [name] * bool(left_out)
                continue
            run.stray_files(name, jobs)
            run.engine(name, [job for job in jobs if options.match in job.path])
        except (environment.NotInstalled, EngineError, OSError) as problem:
            report(f"{name}: not run: {problem}")
            not_run.append(name)
    ran = set(options.only or ENGINES) - set(not_run)
    missing = [name for name in options.require if name not in ran]
    verb = "checked" if options.check else "written"
    report(f"{run.done} files {verb}, {len(run.failures)} different, "
           f"not run: {', '.join(not_run) or 'none'}")
    if missing:
        report(f"required but not run: {', '.join(missing)}")
        return 2
    return 1 if run.failures else 0


if __name__ == "__main__":
    sys.exit(main())
