"""Witnesses of minima, steps, impact times, Cantor's set and points beside sets: right ones, mistakes in all of a kind, and wrong ones."""

FALL = [["-10", "0", "0"]]
SPRING = [["-4", "1", "0"]]
UNIT = [["1", "0"], ["0", "1"]]
CONE = [["1/2", "1"], ["1/2", "-1"]]
PARABOLA = [["0", "1", "0", "1"], ["0", "-1", "2", "0"]]
OPPOSED = [["0", "1", "0", "1"], ["1", "-1", "0", "1"], ["1", "-1", "2", "0"]]

# max(0, −b) at b = 0, as b grows; a load between stick and slip that slips more
KINK = {"matrix": [["2"]], "vector": ["0"], "rows": [["1"]], "x": ["0"], "matrix_slope": [["0"]], "vector_slope": ["1"], "x_slope": ["0"]}
SLIP = {"matrix": UNIT, "vector": ["-2", "1"], "rows": CONE, "x": ["2", "-1"], "matrix_slope": [["0", "0"], ["0", "0"]], "vector_slope": ["0", "1"]}
# 15/(1 + R) at R = 0, as R grows
SOFT = {"matrix": [["1"]], "vector": ["-15"], "rows": [], "x": ["15"], "matrix_slope": [["1"]], "vector_slope": ["0"], "x_slope": ["-15"]}


def step(method: str, terms: list, h: str, before: list, after: list) -> dict:
    """A step."""
    return {"method": method, "terms": terms, "step": h, "before": before, "after": after}


RIGHT = {
    "cone-minimum": [
        {"matrix": [["2", "-1"], ["-1", "2"]], "vector": ["1", "-3"], "rows": UNIT, "x": ["1/3", "5/3"]},
        {"matrix": UNIT, "vector": ["1/10", "-1"], "rows": [["1", "1"], ["1", "-1"]], "x": ["9/20", "9/20"]},
        {"matrix": UNIT, "vector": ["3", "1"], "rows": CONE, "x": ["0", "0"]},
        {"matrix": [["2"]], "vector": ["-3"], "rows": [], "x": ["3/2"]},
        KINK,
        {**KINK, "vector_slope": ["-1"], "x_slope": ["1/2"]},
        {**SLIP, "x_slope": ["2/5", "-1/5"]},
        {**SLIP, "vector_slope": ["0", "-1"], "x_slope": ["0", "1"]},
        SOFT,
    ],
    "motion-step": [
        step("explicit-euler", SPRING, "1/2", UNIT, [["1", "-2"], ["1/2", "1"]]),
        step("semi-implicit-euler", [*SPRING, ["-1/2", "0", "1"]], "1/2", [["1", "2"]], [["3/4", "-1/2"]]),
        step("verlet", [["-1", "3", "0"]], "1", [["2", "5"]], [["3", "-25/2"]]),
        step("runge-kutta-4", SPRING, "1", [["1", "0"]], [["-1/3", "-4/3"]]),
        step("runge-kutta-4", FALL, "1/2", [["0", "3"]], [["1/4", "-2"]]),
        step("flight", FALL, "-1/2", [["0", "3"]], [["-11/4", "8"]]),
    ],
    "impact-time": [
        {"restitution": "1/2", "impact": [3], "value": "5/2"},
        {"restitution": "1", "impact": [60], "value": "119"},
        {"restitution": "4/5", "impact": [2], "value": "13/5"},
    ],
    "cantor-rises": [
        {"function": "cantor", "level": [3], "rises": ["7/8", "1/8"]},
        {"function": "uniform", "level": [2], "rises": ["1/3", "1/9"]},
        {"function": "jump", "level": [2], "rises": ["0", "1"]},
    ],
    "point-beside": [
        {"terms": PARABOLA, "centre": ["1/64", "0"], "reach": "1/512", "point": ["1/64", "1/512"]},
        {"terms": PARABOLA, "centre": ["0", "-1/64"], "reach": "1/512", "point": "none"},
        {"terms": OPPOSED, "centre": ["1/64", "0"], "reach": "1/512", "point": "none"},
        {"terms": [["0", "1", "3", "0"]], "centre": ["-1/64", "0"], "reach": "1/512", "point": "none"},
    ],
}

# changes that make every right witness of a kind a wrong one
MISTAKES = {
    "cone-minimum": [{"matrix": [["-1"]]}, {"vector": []}, {"rows": [["1", "1", "1"]]}, {"x": []}, {"more": "1"}, {"x_slope": ["7"]}],
    "motion-step": [
        {"step": "0"}, {"step": "7"}, {"after": []}, {"after": [["9", "9"]]}, {"terms": [["1", "-1", "0"]]}, {"terms": [["5", "5", "5"]]}, {"method": "leapfrog"},
        {"more": "1"},
    ],
    "impact-time": [{"impact": [0]}, {"impact": [True]}, {"impact": []}, {"restitution": "-1"}, {"restitution": "1/7"}, {"more": "1"}],
    "cantor-rises": [{"level": [-1]}, {"level": [13]}, {"rises": ["1", "0"]}, {"rises": []}, {"function": "sine"}, {"more": "1"}],
    "point-beside": [{"reach": "0"}, {"reach": "-1"}, {"centre": ["0"]}, {"centre": ["0", "0"], "point": "none"}, {"point": ["9", "9"]}, {"terms": []}, {"more": "1"}],
}

# what only looks right
WRONG = [
    # feasible and stationary along the cone, but not the nearest point; nearest of another metric
    ("cone-minimum", {"matrix": UNIT, "vector": ["-1", "0"], "rows": CONE, "x": ["0", "0"]}),
    ("cone-minimum", {"matrix": [["1", "0"], ["0", "2"]], "vector": ["1/10", "-1"], "rows": [["1", "1"], ["1", "-1"]], "x": ["9/20", "9/20"]}),
    # not definite, so that there are more minima; not symmetric; rows that depend on each other
    ("cone-minimum", {"matrix": [["1", "1"], ["1", "1"]], "vector": ["0", "0"], "rows": [], "x": ["1", "-1"]}),
    ("cone-minimum", {"matrix": [["1", "1"], ["0", "1"]], "vector": ["0", "0"], "rows": [], "x": ["0", "0"]}),
    ("cone-minimum", {"matrix": [["1"]], "vector": ["0"], "rows": [["1"], ["2"]], "x": ["0"]}),
    # the slope of the other side of a kink, and slopes that are not all told
    ("cone-minimum", {**KINK, "x_slope": ["-1/2"]}),
    ("cone-minimum", {**SLIP, "x_slope": ["0", "-1"]}),
    ("cone-minimum", {**SLIP, "vector_slope": ["0", "-1"], "x_slope": ["2/5", "1/5"]}),
    ("cone-minimum", {**SOFT, "matrix_slope": [["0"]]}),
    ("cone-minimum", {key: value for key, value in {**KINK, "vector_slope": ["0"]}.items() if key != "matrix_slope"}),
    # the step of another method
    ("motion-step", step("semi-implicit-euler", SPRING, "1/2", UNIT, [["1", "-2"], ["1/2", "1"]])),
    ("motion-step", step("explicit-euler", SPRING, "1/2", UNIT, [["0", "-2"], ["1/2", "1"]])),
    ("motion-step", step("runge-kutta-4", SPRING, "1", [["1", "0"]], [["-1", "-4"]])),
    ("motion-step", step("runge-kutta-4", [["-1", "3", "0"]], "1", [["0", "0"]], [["0", "0"]])),
    ("motion-step", step("verlet", [["-1", "0", "1"]], "1", [["0", "0"]], [["0", "0"]])),
    # a flight that takes another time, and one that is bent by nothing
    ("motion-step", step("flight", FALL, "1", [["0", "3"]], [["1/4", "-2"]])),
    ("motion-step", step("flight", FALL, "1/2", [["0", "3"]], [["0", "-2"]])),
    ("motion-step", step("flight", [["0", "0", "0"]], "1", [["0", "3"]], [["7", "3"]])),
    # the sum without its first term
    ("impact-time", {"restitution": "1/2", "impact": [3], "value": "3/2"}),
    # the largest rise twice, and a function that rises evenly
    ("cantor-rises", {"function": "cantor", "level": [3], "rises": ["1", "1/8"]}),
    ("cantor-rises", {"function": "cantor", "level": [2], "rises": ["1/3", "1/9"]}),
    # a point that is in one of two sets only; none where there is one; a constraint without a number
    ("point-beside", {"terms": OPPOSED, "centre": ["1/64", "0"], "reach": "1/512", "point": ["1/64", "0"]}),
    ("point-beside", {"terms": PARABOLA, "centre": ["1/64", "0"], "reach": "1/512", "point": "none"}),
    ("point-beside", {"terms": [["1", "1", "0", "1"]], "centre": ["0", "-1"], "reach": "1/2", "point": "none"}),
]
