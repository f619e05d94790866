"""The verdict that follows from the findings of a claim, worked out once more."""

import math
from fractions import Fraction

from .judgement import Wrong, demand
from .matrices import fraction

GRADES = ("exact", "certified", "measured", "cited", "not-decidable")
ORIGINS = ("computed", "experiment", "look-up")
RELATIONS = ("equal", "at-most", "at-least")


def readable(claim: dict) -> None:
    """Raises ValueError or the like unless the claim and its findings have what is decided from, of the right kind."""
    if not isinstance(claim["id"], str) or not claim["id"] or not isinstance(claim["verdict"], str):
        raise ValueError("a claim has no id, or no verdict")
    if claim["evidence"] not in GRADES:
        raise ValueError(f"{claim['id']}: there is no grade {claim['evidence']!r}")
    if not (claim["failed"] is None or isinstance(claim["failed"], str)):
        raise ValueError(f"{claim['id']}: why it failed cannot be read")
    if not all(isinstance(witness, dict) for witness in claim["witnesses"]):
        raise ValueError(f"{claim['id']}: a witness is no object")
    for one in claim["findings"]:
        if not isinstance(one["name"], str) or not (one["stated"] is None or isinstance(one["stated"], dict) and one["stated"]):
            raise ValueError(f"{claim['id']}: a finding has no name, or what is stated cannot be read")
        told = one["stated"] or {"relation": "equal", "value": 0.0}
        numbers = [one["found"], one["expected"], told["value"]]
        right = all(value is None or is_float(value) or fraction(value) is not None for value in numbers)
        if not right or not {one["relation"], told["relation"]} <= set(RELATIONS) or not is_float(one["tolerance"]):
            raise ValueError(f"{claim['id']}: {one['name']}: a number or a relation cannot be read")
        if not isinstance(one["context"], bool) or not is_voice(one["voice"]) or not (one["violated"] is None or isinstance(one["violated"], str) and one["violated"]):
            raise ValueError(f"{claim['id']}: {one['name']}: its bearing cannot be read")
        if one["origin"] not in ORIGINS:
            raise ValueError(f"{claim['id']}: {one['name']}: there is no origin {one['origin']!r}")


def is_float(value: object) -> bool:
    """Whether it is a finite number of JSON."""
    return isinstance(value, float | int) and not isinstance(value, bool) and math.isfinite(value)


def is_voice(voice: object) -> bool:
    """Whether it names a passage, a reading or the point of an opinion, or is none."""
    named = isinstance(voice, dict) and len(voice) == 1 and set(voice) <= {"passage", "reading", "opinion"}
    return voice is None or named and all(isinstance(name, str) for name in voice.values())


def number(value: object) -> Fraction:
    """A fraction, or the exact value of a floating-point number."""
    if value is None:
        raise Wrong("a finding is not a number")
    return fraction(value) if isinstance(value, str) else Fraction(value)


def agrees(found: object, other: object, relation: str, tolerance: float) -> bool:
    """Whether two numbers are as the relation demands; a tolerance counts where one of them is rounded."""
    exact = isinstance(found, str) and isinstance(other, str)
    slack = Fraction(0) if exact else Fraction(tolerance)
    if exact:
        difference = number(found) - number(other)
    else:
        # floating point, as the finding was judged: the difference is rounded once
        difference = Fraction(float(number(found)) - float(number(other)))
    return {"equal": abs(difference) <= slack, "at-most": difference <= slack, "at-least": difference >= -slack}[relation]


def holds(finding: dict) -> bool:
    """Whether what was found is what was expected."""
    return agrees(finding["found"], finding["expected"], finding["relation"], finding["tolerance"])


def supports(finding: dict) -> bool:
    """Whether what was found is what the sentence says."""
    stated = finding["stated"]
    return holds(finding) if stated is None else agrees(finding["found"], stated["value"], stated["relation"], finding["tolerance"])


def said(finding: dict) -> tuple:
    """What the sentence says, to be compared."""
    stated = finding["stated"]
    return (finding["relation"], number(finding["expected"])) if stated is None else (stated["relation"], number(stated["value"]))


def verdict(findings: list) -> str:
    """The verdict in words of the file."""
    deciding = [one for one in findings if not one["context"]]
    demand(bool(deciding), "no finding decides")
    passages: dict[str, set] = {}
    readings: dict[str, bool] = {}
    for one in deciding:
        voice = one["voice"] or {}
        if "passage" in voice:
            passages.setdefault(one["name"], set()).add(said(one))
        if "reading" in voice:
            readings[voice["reading"]] = readings.get(voice["reading"], True) and supports(one)
    if any(len(different) > 1 for different in passages.values()):
        return "INTERNALLY INCONSISTENT"
    opinions = [one for one in deciding if "opinion" in (one["voice"] or {})]
    deciding = [one for one in deciding if "opinion" not in (one["voice"] or {})]
    refuted = {bool(one["violated"]) for one in deciding if not supports(one)}
    if len(set(readings.values())) > 1 or (opinions and False not in refuted):
        return "AMBIGUOUS"
    if False in refuted:
        return "FALSE AS STATED"
    if True in refuted:
        demand(any(supports(one) and not one["violated"] for one in deciding), "refuted where a condition is violated, and supported nowhere")
        return "TRUE WITH CONDITIONS"
    return "TRUE"


def grade(findings: list) -> str:
    """The grade: not decidable if a deciding finding is an opinion; else cited, measured or certified if one is looked up, tried or rounded; else exact."""
    deciding = [one for one in findings if not one["context"]]
    heard = [one for one in deciding if "opinion" not in (one["voice"] or {})]
    if not deciding or len(heard) < len(deciding):
        return "not-decidable"
    origins = {one["origin"] for one in heard}
    if "look-up" in origins:
        return "cited"
    if "experiment" in origins:
        return "measured"
    return "exact" if all(is_held_exactly(one) for one in heard) else "certified"


def is_held_exactly(finding: dict) -> bool:
    """Whether everything that is compared is a fraction, without an allowance."""
    numbers = [finding["found"], finding["expected"], *([finding["stated"]["value"]] if finding["stated"] else [])]
    return all(isinstance(number, str) for number in numbers) and finding["tolerance"] == 0


def decide(claim: dict) -> None:
    """Raises unless the findings hold and lead to the recorded verdict and the recorded grade."""
    demand(claim["failed"] is None, f"the check could not be carried out: {claim['failed']}")
    for one in claim["findings"]:
        demand(holds(one), f"{one['name']}: found {one['found']}, expected {one['expected']}")
    found = verdict(claim["findings"])
    demand(found == claim["verdict"], f"the findings say {found}, recorded is {claim['verdict']}")
    found = grade(claim["findings"])
    demand(found == claim["evidence"], f"the findings give the grade {found}, recorded is {claim['evidence']}")
