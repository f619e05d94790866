"""scripts/bench_peers.py: what is computed from the times, and the natural map that decides."""

import importlib.util
import json
import sys
import tempfile
import unittest
from pathlib import Path

SCRIPTS = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(SCRIPTS))

import bench_peers  # noqa: E402
from peers import page, statistics  # noqa: E402
from peers.client import Late, Worker  # noqa: E402

HAS_NUMPY = importlib.util.find_spec("numpy") is not None


def result(peer, setting, seconds, reached=True, symmetrised=False, accuracy=1e-8):
    return {"peer": peer, "setting": setting, "accuracy": accuracy, "seconds": seconds, "reached": reached,
            "symmetrised": symmetrised, "residual": 1e-9, "certified": True, "certifying": 1e-6}


def report(*problems):
    made = {"date": "2026-01-01", "versions": {"moreau": "0"}, "command": "…", "accuracies": [1e-8], "rounds": 1,
            "limit": 1, "patience": [100, 0.3],
            "machine": {"processor": "p", "cores": 2, "system": "s"},
            "problems": [{"name": f"p{k}", "law": "coulomb", "contacts": contacts, "asymmetry": 0.0, "results": list(results)}
                         for k, (contacts, *results) in enumerate(problems)]}
    made["summary"] = statistics.summary(made)
    return made


class Command(unittest.TestCase):
    def test_where_a_folder_lies_is_not_told(self):
        with tempfile.TemporaryDirectory() as folder:
            told = bench_peers.options_of([folder, "--limit", "5"]).command
            self.assertEqual(told, f"scripts/bench_peers.py {Path(folder).name} --limit 5")
            self.assertEqual(bench_peers.options_of(["heaps/new"]).command, "scripts/bench_peers.py heaps/new")


@unittest.skipUnless(HAS_NUMPY, "numpy is not installed")
class Cones(unittest.TestCase):
    def test_a_pull_without_friction_is_projected_to_nothing(self):
        import numpy
        from peers.arrays import projected
        points = numpy.array([[-1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 3.0, 0.0]])
        self.assertEqual(projected(points, numpy.zeros(3)).tolist(), [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 0.0, 0.0]])


class Statistics(unittest.TestCase):
    def test_the_virtual_best_peer_is_the_fastest_that_reaches_the_accuracy(self):
        made = report((3, result("moreau", "auto", 2e-6), result("siconos", "NSGS", 1e-6, reached=False),
                       result("siconos", "NSN_AC", 8e-6), result("pinocchio", "ADMM", 4e-6, symmetrised=True)))
        line = made["summary"][0]
        self.assertEqual((line["moreau"], line["peers"]), (1, 1))
        self.assertAlmostEqual(line["classes"][0]["ratio"], 0.5)
        self.assertIn("pinocchio ADMM †", page.markdown(made))

    def test_a_class_has_the_geometric_mean_and_the_worst_ratio_of_what_both_solve(self):
        made = report((7, result("moreau", "auto", 1e-3), result("siconos", "NSGS", 4e-3)),
                      (60, result("moreau", "auto", 4e-3), result("siconos", "NSGS", 1e-3)),
                      (8, result("moreau", "auto", 1e-3)), (9, result("siconos", "NSGS", 1e-3)),
                      (61, result("moreau", "auto", 1.0), result("siconos", "NSGS", 2.0)))
        small, middle, large = made["summary"][0]["classes"]
        self.assertEqual((small["ratio"], middle["problems"], middle["both"]), (None, 4, 2))
        self.assertAlmostEqual(middle["ratio"], 1.0)
        self.assertAlmostEqual(middle["worst"], 4.0)
        self.assertAlmostEqual(large["ratio"], 0.5)
        self.assertEqual((made["summary"][0]["moreau"], made["summary"][0]["peers"]), (4, 4))

    def test_the_profile_counts_the_problems_within_a_factor_of_the_best(self):
        made = report((1, result("moreau", "auto", 1.0), result("siconos", "NSGS", 1.5)),
                      (1, result("moreau", "auto", 3.0, reached=False), result("siconos", "NSGS", 2.0)))
        profile = made["summary"][0]["profile"]
        self.assertEqual(profile["moreau auto"][0], 0.5)
        self.assertEqual(profile["siconos NSGS"][:3], [0.5, 0.5, 1.0])

    def test_shifted_means_of_one_value_are_that_value(self):
        self.assertAlmostEqual(statistics.shifted([3e-5]), 3e-5)
        self.assertIsNone(statistics.shifted([]))


class Workers(unittest.TestCase):
    def worker(self, text):
        file = tempfile.NamedTemporaryFile("w", suffix=".py", delete=False)
        self.addCleanup(Path(file.name).unlink)
        with file:
            file.write(f"import sys; sys.path.insert(0, {str(SCRIPTS / 'peers')!r})\n{text}")
        worker = Worker([sys.executable, file.name], max(bench_peers.os.sched_getaffinity(0)))
        self.addCleanup(worker.end)
        return worker

    def test_a_late_worker_is_ended_and_starts_again(self):
        worker = self.worker("import time\nfrom worker import serve\n"
                             "def load(path): return {'fast': lambda t: lambda: ([t], 1, ''), 'slow': lambda t: lambda: time.sleep(60)}\n"
                             "serve(load)\n")
        self.assertEqual(worker.load("x.npz", 20), ["fast", "slow"])
        self.assertEqual(worker.solve("fast", 0.5, 0.0, 20)["impulse"], [0.5])
        with self.assertRaises(Late):
            worker.solve("slow", 0.5, 0.0, 0.5)
        self.assertEqual(worker.solve("fast", 0.25, 0.0, 20)["impulse"], [0.25])

    def test_what_a_peer_raises_or_prints_is_no_answer(self):
        worker = self.worker("from worker import serve\n"
                             "def load(path):\n print('noise')\n def prepare(t): raise ValueError('no')\n return {'one': prepare}\n"
                             "serve(load)\n")
        self.assertEqual(worker.load("x.npz", 20), ["one"])
        self.assertIn("no", worker.solve("one", 0.5, 0.0, 20)["error"])


@unittest.skipUnless(HAS_NUMPY, "numpy is not there: it comes with the environment of a peer")
class NaturalMap(unittest.TestCase):
    def block(self, law):
        # 1 kg that arrives at 1 m/s and slides at 2 m/s, μ = ½: Coulomb r = (1, −½)
        import numpy as np
        return {"operator": np.eye(2), "free": np.array([-1.0, 2.0]), "friction": np.array([0.5]), "dimension": 2, "law": law}

    def test_it_vanishes_at_the_solution_of_its_law_alone(self):
        from peers import arrays
        # associated: r = (1.6, −0.8), where y = (0.6, 1.2) has y_n = μ y_t
        for law, impulse in (("coulomb", [1.0, -0.5]), ("associated", [1.6, -0.8])):
            self.assertLess(arrays.natural_map(**self.block(law), impulse=impulse), 1e-15)
            other = "associated" if law == "coulomb" else "coulomb"
            self.assertGreater(arrays.natural_map(**self.block(other), impulse=impulse), 0.1)
        # r = 0: ŷ = (−1 + ½·2, 2) = (0, 2), −ŷ projects to the edge point (0.8, −0.4), ‖q‖ = √5
        self.assertAlmostEqual(arrays.natural_map(**self.block("coulomb"), impulse=[0.0, 0.0]), 0.4)
        self.assertEqual(arrays.natural_map(**self.block("coulomb"), impulse=[float("nan"), 0.0]), float("inf"))

    def test_projections_on_the_three_parts_of_the_cone(self):
        import numpy as np
        from peers import arrays
        points = np.array([[2.0, 0.5, 0.5], [-3.0, 1.0, 0.0], [0.0, 5.0, 0.0]])
        # the last one onto the edge (1, μ)/√(1 + μ²): 5 μ/(1 + μ²) (1, μ) = (2, 1)
        expected = np.array([[2.0, 0.5, 0.5], [0.0, 0.0, 0.0], [2.0, 1.0, 0.0]])
        self.assertLess(np.abs(arrays.projected(points, np.full(3, 0.5)) - expected).max(), 1e-15)

    def test_matrices_are_read_in_all_three_forms(self):
        from peers import arrays
        rows = {"shape": [2, 2], "rows": [[1, 2], [3, 4]]}
        triplets = {"shape": [2, 2], "triplets": {"row": [0, 0, 1, 1], "column": [0, 1, 0, 1], "value": [1, 2, 3, 4]}}
        blocks = {"shape": [2, 2], "blocks": {"row": [0], "column": [0], "value": [1, 2, 3, 4]}}
        for given in (rows, triplets, blocks):
            self.assertEqual(arrays.matrix(given).tolist(), [[1, 2], [3, 4]])

    def test_a_compliance_on_rows_is_added_and_other_laws_are_left_out(self):
        from peers import arrays
        document = {"schema": "contact-problem/1", "name": "", "dimension": 1, "law": "frictionless", "friction": [0], "shift": [0.5],
                    "free_velocity": [-1], "delassus": {"shape": [1, 1], "rows": [[2]]},
                    "compliance": {"coordinates": "contact", "diagonal": [0.25]}}
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "p.json"
            file.write_text(json.dumps(document))
            read = arrays.read(file)
            self.assertEqual((read["operator"].tolist(), read["free"].tolist()), ([[2.25]], [-0.5]))
            file.write_text(json.dumps({**document, "law": "polyhedral-coulomb"}))
            with self.assertRaises(ValueError):
                arrays.read(file)


if __name__ == "__main__":
    unittest.main()
