"""The record of a problem, `answered-problem/1`: what fractions, theorems, `moreau problems measure` and `moreau certify --prove` say of it."""

import hashlib
import json
import subprocess
import tempfile
from fractions import Fraction
from pathlib import Path

from problems import exact

SAME = 1e-6  # of the largest velocity: an exact velocity and a certified answer nearer than this are one
BY_PATTERNS = "all patterns of states, in fractions"


class Contradiction(Exception):
    """Two ways to an answer that should agree do not."""


def text(document):
    """The text of a file: numbers in shortest exact form, whole ones without a point."""
    def plain(value):
        if isinstance(value, dict):
            return {key: plain(item) for key, item in value.items()}
        if isinstance(value, list):
            return [plain(item) for item in value]
        if isinstance(value, float) and value.is_integer() and abs(value) < 2 ** 53:
            return int(value)
        return value
    return json.dumps(plain(document), allow_nan=False, ensure_ascii=False, separators=(",", ":")) + "\n"


def _ask(command, *arguments, codes=(0,)):
    """What a command of moreau prints as JSON."""
    run = subprocess.run([*command, *map(str, arguments)], capture_output=True, text=True, check=False)
    if run.returncode not in codes:
        raise Contradiction(f"{' '.join(map(str, arguments))}: exit code {run.returncode}: {run.stderr.strip()}")
    return json.loads(run.stdout)


def _candidates(posed, answers):
    """Answers from outside as solution/1 objects."""
    found = []
    if posed.closed:
        found.append({**(posed.solution or {}), "schema": "solution/1", "impulse": posed.closed, "solver": posed.closed_by})
    for impulse in answers.impulses if answers else []:
        if impulse is not None:
            found.append({"schema": "solution/1", "impulse": [float(r) for r in impulse], "solver": BY_PATTERNS})
    for one in found:
        one.pop("problem", None)
        one.pop("residuals", None)
        one["velocity"] = [0.0] * len(one["impulse"])
    return found


def _single_contact_is_unique(document):
    """Whether it is one hard contact whose normal and tangents are not coupled and whose tangential block is a multiple of I, exactly."""
    if len(document["friction"]) != 1 or document["law"] != "coulomb" or "compliance" in document or "triplets" not in document.get("mass", {}):
        return False
    w, _ = exact.operator(document)
    size = range(1, len(w))
    return w[0][0] > 0 and not any(w[0][i] or w[i][0] for i in size) and \
        all(w[i][j] == (w[1][1] if i == j else 0) for i in size for j in size) and (len(w) < 2 or w[1][1] > 0)


def _uniqueness(posed, answers, found):
    """Whether u is the only velocity, with the proof or what stands in its way."""
    document = posed.document
    if answers and not answers.undecided:
        count = len(answers.velocities)
        if not count:
            return {"velocity": "none", "reason": f"none of the {answers.patterns} patterns of states has a solution, in fractions: {posed.no_solution}"}
        word = "unique" if count == 1 else "several"
        return {"velocity": word, "count": count, "reason": f"all {answers.patterns} patterns of states were solved in fractions"}
    if document["law"] in ("frictionless", "associated", "polyhedral-associated") or not any(document["friction"]):
        kind = "the law is that of a convex program" if any(document["friction"]) else "without friction the law is that of a convex program"
        return {"velocity": "unique", "count": 1, "reason": f"{kind}: two solutions have Δrᵀ(W + R)Δr ≤ 0, so that W Δr = 0"}
    if _single_contact_is_unique(document):
        return {"velocity": "unique", "count": 1,
                "reason": "one contact with W_nt = 0 and W_tt a multiple of I: r_n follows alone, and friction from r_n"}
    if len(found) > 1:
        return {"velocity": "unknown", "reason": f"{len(found)} certified answers with different velocities were found; their distance is not proved"}
    return {"velocity": "unknown", "reason": "no method at hand proves that there is one velocity, or shows another"}


def _proved(command, problem, posed, answer, folder):
    """What `certify --prove` says of an answer: the radius in u, and how many velocities there are."""
    solution = folder / "answer.json"
    given = {"schema": "solution/1", "impulse": answer["impulse"], "velocity": answer["velocity"]}
    given.update({key: answer[key] for key in ("beta", "sigma") if answer.get(key) is not None})
    solution.write_text(json.dumps(given), encoding="utf-8")
    return _ask(command, "certify", problem, solution, "--prove", "--format", "json", codes=(0, 1))


def forward(certificate):
    """The radius of `certify --prove`, or its reason; under polyhedral friction the distance of a solution of the complementarity problem."""
    proof = certificate["forward"]
    radius = proof.get("radius")
    if proof["proved"] and radius:
        return {"velocity": radius["velocity"], "impulse": radius["impulse"]}
    lcp = certificate.get("lcp") or {}
    if lcp.get("near"):
        near = lcp["near"]
        return {"reason": f"{proof['reason']}: of that problem a solution ({lcp['unknowns']}) is within {near['distance']:.2e} N·s or m/s, in {near['in']}"}
    if lcp.get("not_proved"):
        return {"reason": f"{proof['reason']}: {lcp['not_proved']['reason']}"}
    place = "" if proof.get("contact") is None else f" (contact {proof['contact']})"
    return {"reason": proof["reason"] + place}


def _check(posed, answers, measured):
    """Holds what was found against what is known; a difference ends the script."""
    found = measured["answers"]
    solved = [one["solver"] for one in measured["solvers"] if one["ended"] == "solved"]
    if posed.no_solution:
        if solved or found:
            raise Contradiction(f"{posed.name}: has no solution, and {', '.join(solved) or found[0]['by']} has an answer that is accepted")
        if not answers or answers.velocities or answers.undecided:
            raise Contradiction(f"{posed.name}: that it has no solution is not what the patterns show")
    if answers and not answers.undecided:
        known = [[float(u) for u in velocity] for velocity in answers.velocities]
        shift = [Fraction(s) for s in posed.document.get("shift") or []]
        if shift:
            known = [[float(Fraction(u) - s) for u, s in zip(velocity, shift)] for velocity in answers.velocities]
        scale = max([abs(u) for velocity in known for u in velocity] + [abs(u) for u in posed.document["free_velocity"]], default=0.0)
        for one in found:
            nearest = min((max(abs(a - b) for a, b in zip(one["velocity"], velocity)) for velocity in known), default=float("inf"))
            if nearest > SAME * scale:
                raise Contradiction(f"{posed.name}: {one['by']} has an accepted answer {nearest} m/s from every exact one")
            if one["by"] != BY_PATTERNS and all(other["by"] != BY_PATTERNS for other in one["agreement"]):
                one["agreement"].insert(0, {"by": BY_PATTERNS, "difference": nearest})
        if len(found) > len(known):
            raise Contradiction(f"{posed.name}: {len(found)} answers, and the patterns have {len(known)}")
    if posed.closed and not posed.engine:
        names = [name for one in found for name in (one["by"], *(other["by"] for other in one["agreement"]))]
        if posed.closed_by not in names:
            raise Contradiction(f"{posed.name}: the closed form is not accepted, or something else is")


def record(posed, command, stored=True):
    """The record of a problem."""
    document = posed.document
    body = text(document)
    answers = exact.all_solutions(document)
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        problem = folder / "problem.json"
        problem.write_text(body, encoding="utf-8")
        given = []
        for number, candidate in enumerate(_candidates(posed, answers)):
            file = folder / f"given-{number}.json"
            file.write_text(json.dumps(candidate), encoding="utf-8")
            given += ["--given", file]
        measured = _ask(command, "problems", "measure", problem, *given, "--format", "json", codes=(0, 1))
        _check(posed, answers, measured)
        uniqueness = _uniqueness(posed, answers, measured["answers"])
        stored_answers = []
        for answer in measured["answers"]:
            certificate = _proved(command, problem, posed, answer, folder)
            answer["forward"] = forward(certificate)
            uniqueness = _better(uniqueness, certificate.get("solutions"), posed)
            stored_answers.append({key: value for key, value in answer.items() if key != "velocity" and value is not None})
    uniqueness = _with_answers(_several(uniqueness, apart(measured["answers"]), posed), measured["answers"])
    return {"schema": "answered-problem/1", "name": posed.name, "group": posed.group, "about": posed.about,
            "contacts": posed.contacts, "dimension": document["dimension"], "law": document["law"],
            "friction": [min(document["friction"]), max(document["friction"])], "stored": stored,
            "sha256": hashlib.sha256(body.encode("utf-8")).hexdigest(),
            "script": f"python3 scripts/generate_problems.py --only {posed.name}" + ("" if stored else " --large FOLDER"),
            "answers": stored_answers, "uniqueness": uniqueness, "difficulty": measured["difficulty"], "solvers": measured["solvers"]}


def apart(answers):
    """How many of these answers, as one pass from the smallest radius on finds them, have enclosures in u that are disjoint from each other.

    ‖u* − u‖ ≤ ε at every contact: where an entry of u and u′ differs by more than ε + ε′, so do the solutions near.
    """
    def differ(one, other):
        # the difference is rounded once, far below the half of it
        return 0.5 * max(abs(a - b) for a, b in zip(one["velocity"], other["velocity"])) > one["forward"]["velocity"] + other["forward"]["velocity"]
    chosen = []
    proved = [one for one in answers if one["forward"].get("velocity") is not None]
    for one in sorted(proved, key=lambda one: one["forward"]["velocity"]):
        if all(differ(one, other) for other in chosen):
            chosen.append(one)
    return len(chosen)


def _several(known, count, posed):
    """Several velocities, where that many answers have disjoint enclosures and nothing else tells how many there are."""
    if count < 2:
        return known
    if known["velocity"] not in ("unknown", "several") or known.get("count", count) < count:
        raise Contradiction(f"{posed.name}: the velocity is {known['velocity']} ({known['reason']}), and {count} answers have disjoint enclosures")
    if known["velocity"] == "several":
        return known
    return {"velocity": "several", "reason": f"at least {count} velocities: {count} answers have proved enclosures in u that are disjoint"}


def _with_answers(known, answers):
    """What a proof that there is one velocity is without an accepted answer: that there is at most one."""
    if known["velocity"] != "unique" or answers:
        return known
    return {"velocity": "at-most-one", "reason": known["reason"]}


def _better(known, proved, posed):
    """The uniqueness that `certify --prove` proves, where nothing else did; two proofs must not contradict each other."""
    if not isinstance(proved, dict):
        return known
    every = proved.get("all") or {}
    continuum = bool(every.get("continuum") or proved.get("continuum"))
    count = None if continuum else every.get("velocities")
    least = (proved.get("several") or {}).get("at_least")
    told = proved.get("unique") in ("solution", "velocity")
    unique, several = told or count == 1, continuum or (count or 0) > 1 or least
    if not (unique or several):
        return known
    if told:
        reason = proved.get("reason")
    elif continuum:
        reason = "the velocities are a continuum"
    else:
        tried = f"all {every.get('patterns')} patterns were tried, and the solutions have exactly {count} velocit{'y' if count == 1 else 'ies'}"
        reason = f"at least {least} velocities have disjoint enclosures" if least else tried
    proved = {"velocity": "unique" if unique else "several", "reason": reason}
    if known["velocity"] not in ("unknown", proved["velocity"]):
        raise Contradiction(f"{posed.name}: the velocity is {known['velocity']} ({known['reason']}), and certify --prove says {proved['velocity']}")
    if known["velocity"] != "unknown":
        return known
    better = {"velocity": proved["velocity"], "reason": f"moreau certify --prove: {proved.get('reason') or 'proved'}"}
    if not continuum and not least:
        better["count"] = count or 1
    return better
