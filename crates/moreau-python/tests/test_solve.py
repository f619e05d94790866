"""Solving and certifying: closed forms, two ways in, errors."""
import copy
import errno
import json
import os
import pickle
import signal
import subprocess
import sys
import threading
import time
import warnings

import moreau_contact as mc
import numpy as np
import pytest
import scipy.sparse as sp

# u_free and impulse of a point of 1 kg, μ = ½: it opens, sticks, slides (r_n = −u_n, r_t = −r_n/2 · u_t/‖u_t‖)
POINTS = [([2, 3, -2], [0, 0, 0]), ([-1, 0.3, 0.2], [1, -0.3, -0.2]), ([-1, 1.8, -2.4], [1, -0.3, 0.4])]


@pytest.mark.parametrize(("free", "impulse"), POINTS)
def test_a_point_has_its_closed_form(free, impulse):
    answer = mc.solve(np.eye(3), free, 0.5)
    assert answer and answer.certificate
    np.testing.assert_allclose(answer.impulse, impulse, atol=1e-12)
    np.testing.assert_allclose(answer.velocity, np.add(free, impulse), atol=1e-12)


def stack(contacts=5):
    """Balls on each other on a line, 1 kg each, that fall at 1 m/s: M, H."""
    rows = [[1.0 if column == row else -1.0 if column == row - 1 else 0.0 for column in range(contacts)] for row in range(contacts)]
    return np.eye(contacts), np.array(rows)


def test_mass_and_jacobian_dense_and_sparse_pose_the_problem_of_w():
    mass, rows = stack()
    free = rows @ -np.ones(5)
    # the lowest contact carries all five: r = 5, 4, 3, 2, 1 N·s
    for given in [(mass, rows), (sp.csr_array(mass), sp.csc_array(rows)), (sp.coo_array(mass), rows), rows @ rows.T, sp.bsr_array(rows @ rows.T)]:
        answer = mc.solve(given, free, law="frictionless")
        np.testing.assert_allclose(answer.impulse, [5, 4, 3, 2, 1], rtol=1e-9)


def test_entries_that_stand_twice_are_added_as_scipy_does():
    twice = sp.coo_array(([0.5, 0.5, 1.0, 1.0], ([0, 0, 1, 2], [0, 0, 1, 2])), shape=(3, 3))
    np.testing.assert_array_equal(mc.Problem(twice, [-1, 0, 0], 0.5).W, np.eye(3))


def test_arrays_of_any_order_and_kind_are_read_by_their_entries():
    asymmetric = np.array([[1.0, 0.25], [0.125, 1.0]])
    for W in [asymmetric, np.asfortranarray(asymmetric), asymmetric.tolist(), asymmetric.astype(np.float32), np.hstack([asymmetric] * 2)[:, ::2].copy()[:, [0, 1]]]:
        problem = mc.Problem(W, [-1, 0], [0.5])
        np.testing.assert_array_equal(problem.W, np.array(W, dtype=float))
    strided = np.zeros((4, 4))[::2, ::2]
    strided[:] = asymmetric
    np.testing.assert_array_equal(mc.Problem(strided, np.array([-1, 9, 0, 9.0])[::2], [0.5]).W, asymmetric)
    np.testing.assert_array_equal(mc.Problem(asymmetric, [-1, 0], [0.5]).sparse().toarray(), asymmetric)


@pytest.mark.parametrize(
    ("change", "field"),
    [
        ({"W": np.ones((3, 4))}, "W"),
        ({"W": np.ones(3)}, "W"),
        ({"W": np.eye(3) * 1j}, "W"),
        ({"W": (np.eye(3),)}, "W"),
        ({"W": (np.zeros((3, 3)), np.eye(3))}, "M"),
        ({"W": (np.eye(2), np.eye(3))}, ""),
        ({"solver": "magic"}, "solver"),
        ({"W": np.eye(6)}, "u_free"),
        ({"u_free": [-1, np.nan, 0]}, "u_free[1]"),
        ({"u_free": [[-1, 0, 0]]}, "u_free"),
        ({"u_free": "abc"}, "u_free"),
        ({"mu": -0.5}, "mu[0]"),
        ({"mu": [0.5, 0.5]}, "mu"),
        ({"mu": None}, "mu"),
        ({"law": "colomb"}, "law"),
        ({"law": "polyhedral-coulomb"}, "directions"),
        ({"directions": 4}, "directions"),
        ({"shift": [1, 2]}, "shift"),
        ({"tolerance": 0.0}, "tolerance"),
        ({"tolerance": float("nan")}, "tolerance"),
        ({"warm_start": [1, 2]}, "warm_start"),
        ({"warm_start": [1, 0, float("inf")]}, "warm_start[2]"),
        ({"solver": "lemke", "warm_start": [1, 0, 0], "law": "polyhedral-coulomb", "directions": 4}, "warm_start"),
    ],
)
def test_what_is_not_allowed_names_the_argument_and_the_cure(change, field):
    arguments = {"W": np.eye(3), "u_free": [-1, 0, 0], "mu": 0.5} | change
    with pytest.raises(mc.InvalidInput) as caught:
        mc.solve(arguments.pop("W"), arguments.pop("u_free"), arguments.pop("mu"), **arguments)
    assert caught.value.field.startswith(field) and caught.value.cure, caught.value
    assert isinstance(caught.value, ValueError) and "--" not in str(caught.value)


def test_an_impulse_that_is_no_number_is_refused_by_its_entry():
    problem = mc.Problem(np.eye(3), [-1, 0, 0], 0.5)
    for given, field in [({"impulse": [1, np.nan, 0]}, "impulse[1]"), ({"impulse": [1, 0, 0], "velocity": [0, 0, -np.inf]}, "velocity[2]")]:
        with pytest.raises(mc.InvalidInput) as caught:
            mc.certify(problem, **given)
        assert caught.value.field == field and len(str(caught.value)) < 200


def test_an_operator_that_is_none_of_contacts_between_masses_is_warned_of():
    for W, word in [([[1, 0.1], [0, 1]], "not symmetric"), ([[1, 0], [0, -1]], "W_ii < 0 in row 1")]:
        with pytest.warns(mc.UnusualOperator, match=word) as warned:
            problem = mc.Problem(W, [-1, 0], [0.5])
        assert warned[0].filename == __file__ and len(problem.remarks) == 1
    with pytest.warns(mc.UnusualOperator) as warned:
        mc.solve([[1, 0.1], [0, 1]], [-1, 0], [0.5])
    assert warned[0].filename == __file__
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert mc.Problem(np.eye(2), [-1, 0], [0.5]).remarks == []
        assert mc.Problem([[1, 0.1], [0, 1]], [-1, 0], law="frictionless").remarks  # a linear complementarity problem may have any matrix


def test_an_unknown_solver_is_told_with_the_names_there_are():
    with pytest.raises(mc.MoreauError, match="auto"):
        mc.solve(np.eye(3), [-1, 0, 0], 0.5, solver="magic")
    assert "auto" in mc.solvers()


def test_an_answer_that_the_certificate_rejects_is_raised_and_kept():
    # a box on four corners, pushed sideways: one sweep is not enough
    corners = [(x, y, -0.1) for x in (-0.2, 0.2) for y in (-0.2, 0.2)]
    rows = np.vstack([[[0, 0, 1, y, -x, 0], [1, 0, 0, 0, z, -y], [0, 1, 0, -z, 0, x]] for x, y, z in corners])
    arguments = ((np.diag([2, 2, 2, 0.05, 0.05, 0.05]), rows), rows @ [1, 0, -0.1, 0, 0, 0], [0.3] * 4)
    with pytest.raises(mc.Rejected) as caught:
        mc.solve(*arguments, solver="pgs", iterations=1)
    assert caught.value.status == "rejected" and not caught.value.solution and "contact" in str(caught.value)
    assert not mc.solve(*arguments, solver="pgs", iterations=1, accept_rejected=True).certificate
    assert mc.solve(*arguments)


@pytest.mark.parametrize("arguments", [(np.zeros((1, 1)), [-1.0], [0.0]), (np.zeros((3, 3)), [-1, 0, 0], 0.3), (-np.eye(3), [-1, 0, 0], 0.3)])
def test_that_there_is_no_solution_is_told(arguments):
    with pytest.raises(mc.SolverError) as caught:
        mc.solve(*arguments)
    assert caught.value.status == "infeasible", caught.value
    assert not isinstance(caught.value, mc.Rejected)


def test_free_motion_in_place_of_contact_velocities_and_files_in_place_of_arrays_are_told():
    mass, rows = stack()
    with pytest.raises(mc.InvalidInput, match="H has 6 rows") as caught:
        mc.solve((mass, np.vstack([rows, rows[:1]])), np.zeros(5), law="frictionless")
    assert caught.value.field == "u_free"
    for wrong in [lambda: mc.solve("problem.json"), lambda: mc.Problem("problem.json", [0.0]), lambda: mc.certify("problem.json", [0.0])]:
        with pytest.raises(mc.InvalidInput, match="Problem"):
            wrong()


def test_a_problem_is_copied_and_sent_to_other_processes():
    problem = mc.Problem(np.eye(2), [-1.0, 2.0], [0.5], name="block")
    for again in [pickle.loads(pickle.dumps(problem)), copy.deepcopy(problem)]:
        assert again.to_json() == problem.to_json()


def test_the_certificate_tells_each_contact():
    problem = mc.Problem(np.eye(9), np.concatenate([free for free, _ in POINTS]), [0.5] * 3)
    right = np.concatenate([impulse for _, impulse in POINTS]).astype(float)
    assert mc.certify(problem, right)
    wrong = right.copy()
    wrong[4] += 0.25
    certificate = mc.certify(problem, wrong)
    assert not certificate and certificate.contacts["accepted"].tolist() == [True, False, True]
    assert certificate.residuals["tangential"]["contact"] == 1 and certificate.residuals["tangential"]["unit"] == "N·s"
    assert "contact 1 is refused" in str(certificate) and str(certificate).endswith("NOT a solution to the relative tolerance 1e-8")
    assert not mc.certify(problem, right, velocity=np.zeros(9)), "a stored velocity is compared"
    with pytest.raises(mc.InvalidInput, match="impulse"):
        mc.certify(problem, right[:8])


def test_fields_of_records_and_other_strides_are_read_by_their_entries():
    records = np.zeros(2, dtype=[("mu", "f8"), ("id", "i4")])
    records["mu"] = 0.5
    assert mc.Problem(np.eye(6), [-1, 1, 0, -1, 1, 0], records["mu"]).mu.tolist() == [0.5, 0.5]
    table = np.zeros((3, 3), dtype=[("w", "f8"), ("id", "i4")])
    table["w"] = np.eye(3)
    assert mc.Problem(table["w"], [-1, 1, 0], 0.5).W.tolist() == np.eye(3).tolist()
    unaligned = np.frombuffer(b"x" + np.array([-1.0, 1.0, 0.0]).tobytes(), dtype=np.uint8)[1:].view("f8")
    assert mc.Problem(np.eye(3), unaligned, np.float32(0.5)).u_free.tolist() == [-1, 1, 0]
    for wrong in [np.ma.masked_array(np.eye(3), np.eye(3)), np.eye(3)]:
        with pytest.raises(mc.InvalidInput):
            mc.Problem(wrong, [-1, 1, 0], np.complex128(0.5 + 3j))


def test_sparse_matrices_whose_indices_were_changed_are_refused():
    for place in (100, -1):
        changed = sp.coo_array(np.eye(3))
        changed.coords[0][0] = place
        for operator in [changed, (sp.eye_array(3), changed), (changed, sp.eye_array(3))]:
            with pytest.raises(mc.InvalidInput, match="outside"):
                mc.Problem(operator, [-1, 1, 0], 0.5)


def test_what_takes_too_much_memory_is_refused_before_it_is_begun():
    wide = np.broadcast_to(0.0, (10**6, 10**6))
    for call in [lambda: mc.Problem(wide, [-1, 0, 0], 0.5), lambda: mc.Problem(np.eye(3), np.broadcast_to(0.0, 10**12), 0.5),
                 lambda: mc.Problem((sp.coo_array((10**12, 10**12)), sp.coo_array((3, 10**12))), [-1, 0, 0], 0.5),
                 lambda: mc.Problem((np.eye(3), np.zeros((60000, 3))), np.zeros(60000), 0.5),
                 lambda: mc.Problem((sp.eye_array(90000), sp.eye_array(90000)), np.zeros(90000), 0.5).W]:
        with pytest.raises(mc.InvalidInput, match="set_memory_limit"):
            call()


def test_answers_and_errors_are_sent_to_other_processes():
    answer = mc.solve(np.eye(2), [-1.0, 2.0], [0.5])
    again = pickle.loads(pickle.dumps(answer))
    assert again and again.impulse.tolist() == answer.impulse.tolist() and again.certificate.tolerance == answer.certificate.tolerance
    for error in [mc.Rejected("no", "pgs", answer), mc.InvalidInput("no", "a", "b", "c"), mc.SolverError("no", "pgs", "ray")]:
        sent = pickle.loads(pickle.dumps(error))
        assert type(sent) is type(error) and str(sent) == "no" and sent.__dict__.keys() == error.__dict__.keys()
    with pytest.raises(mc.InvalidInput, match="velocity"):
        mc.certify(answer.problem, answer, velocity=[9, 9])


@pytest.mark.parametrize("call", ["mc.solve(np.eye(30) + 0.1, -np.ones(30), 0.5)", "mc.simulate('box-stack', step=0.001)"])
def test_python_ends_in_order_while_a_thread_is_in_a_call(call):
    script = (
        "import threading, time, numpy as np, moreau_contact as mc\n"
        f"def loop():\n    while True: {call}\n"
        "threading.Thread(target=loop, daemon=True).start(); time.sleep(0.5); print('ended')"
    )
    for _ in range(3):
        done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=60)
        assert (done.returncode, done.stdout, done.stderr) == (0, "ended\n", ""), done.stderr


@pytest.mark.usefixtures("interruptible")
def test_ctrl_c_ends_a_long_solve_at_once():
    threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT)).start()
    begin = time.perf_counter()
    with pytest.raises(KeyboardInterrupt):
        mc.solve(mc.Problem(*heap(1500)))
    assert time.perf_counter() - begin < 30


def test_a_warm_start_and_a_solution_are_taken():
    problem = mc.Problem(np.eye(3), [-1, 1.8, -2.4], 0.5)
    answer = mc.solve(problem)
    assert mc.solve(problem, warm_start=answer) and mc.solve(problem, warm_start=answer.impulse) and mc.certify(problem, answer)
    with pytest.raises(mc.InvalidInput, match="has its own data"):
        mc.solve(problem, [1, 2, 3])
    assert mc.solve(problem.with_law("frictionless")).impulse.tolist() == [1, 0, 0]


def test_a_warm_start_goes_by_the_keys_of_the_contacts_where_both_have_them():
    def balls(bodies, keyed=True):
        n = len(bodies)
        keys = [{"bodies": [body, None], "features": [0, 0]} for body in bodies]
        return mc.Problem.from_json(json.dumps({
            "schema": "contact-problem/1", "name": f"of {n}", "dimension": 1, "law": "frictionless", "friction": [0] * n,
            "free_velocity": [-float(body) for body in bodies], **({"keys": keys} if keyed else {}),
            "delassus": {"shape": [n, n], "rows": np.eye(n).tolist()}}))

    before = mc.solve(balls([5, 7, 8]))
    assert before.impulse.tolist() == [5, 7, 8]
    # a start that is a solution needs no sweep
    after = mc.solve(balls([8, 5, 7]), solver="pgs", warm_start=before)
    assert after.impulse.tolist() == [8, 5, 7] and after.iterations == 0
    for other in (balls([8, 9, 5, 7], keyed=False), balls([5, 7, 8, 9], keyed=False)):
        with pytest.raises(mc.InvalidInput, match="warm_start.*has size 3; give size 4"):
            mc.solve(other, warm_start=before)
    by_position = mc.solve(balls([8, 5, 7], keyed=False), solver="pgs", warm_start=before)
    assert by_position.impulse.tolist() == [8, 5, 7] and by_position.iterations > 0


def test_files_are_those_of_the_command(command, tmp_path):
    problem = mc.Problem(np.eye(2), [-1.0, 2.0], [0.5], name="block")
    problem.write(tmp_path / "problem.json")
    assert mc.Problem.read(tmp_path / "problem.json").to_json() == problem.to_json() == mc.Problem.from_json(problem.to_json()).to_json()
    command("solve", "problem.json", "--out", "theirs.json")
    theirs = mc.Solution.read(tmp_path / "theirs.json", problem)
    assert theirs and theirs.impulse.tolist() == mc.solve(problem).impulse.tolist() == [1.0, -0.5]
    theirs.write(tmp_path / "ours.json")
    printed = json.loads(command("certify", "problem.json", "ours.json", "--format", "json"))
    own = json.loads(theirs.certificate.to_json())
    assert printed["residuals"] == own["residuals"] and printed["solution"] is own["solution"] is True
    with pytest.raises(mc.FileError) as absent:
        mc.Problem.read(tmp_path / "absent.json")
    again = pickle.loads(pickle.dumps(absent.value))
    assert (again.errno, again.filename) == (errno.ENOENT, str(tmp_path / "absent.json")) and "absent.json" in str(again)
    assert "Errno" not in str(absent.value)
    (tmp_path / "half.json").write_text(problem.to_json()[:40])
    with pytest.raises(mc.InvalidInput):
        mc.Problem.read(tmp_path / "half.json")


def test_an_lcp_is_read(tmp_path):
    (tmp_path / "lcp.json").write_text('{"schema": "lcp/1", "name": "two", "matrix": {"shape": [2, 2], "rows": [[2, 1], [1, 2]]}, "vector": [-5, -6]}')
    answer = mc.solve(mc.Problem.read(tmp_path / "lcp.json"))
    np.testing.assert_allclose(answer.impulse, [4 / 3, 7 / 3], rtol=1e-12)


def heap(contacts=700):
    """A chain of spheres that press on each other with friction: a problem that takes a while."""
    rng = np.random.default_rng(1)
    rows = sp.random_array((3 * contacts, 6 * contacts // 4), density=0.01, rng=rng, format="csr")
    rows = rows + sp.eye_array(*rows.shape)
    return (sp.eye_array(rows.shape[1], format="csr"), rows.tocsr()), rng.normal(size=3 * contacts) - 1.0, np.full(contacts, 0.5)


def test_other_threads_run_while_a_problem_is_solved():
    seen, done = [], threading.Event()

    def look():
        while not done.is_set():
            seen.append(time.perf_counter())
            time.sleep(0.001)

    watcher = threading.Thread(target=look)
    watcher.start()
    begin = time.perf_counter()
    mc.solve(*heap(), solver="pgs", iterations=2000, accept_rejected=True)
    lasted = time.perf_counter() - begin
    done.set()
    watcher.join()
    gaps = np.diff(seen)
    assert gaps.max() < 0.5 * max(lasted, 0.2), f"the lock was held for {gaps.max()} of {lasted} s"
