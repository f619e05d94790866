"""What follows from the times: the virtual best peer, ratios, shifted geometric means, the performance profile."""

import math

CLASSES = ((0, 5, "≤ 5 contacts"), (6, 60, "6–60 contacts"), (61, 10**9, "> 60 contacts"))
FACTORS = (1.0, 1.2, 1.5, 2.0, 5.0, 10.0, 100.0)
SHIFT = 1e-6  # [s] of the shifted geometric mean: below it times are those of the clock


def best(problem, accuracy, own):
    """The fastest result that reaches the accuracy, of moreau or of its peers."""
    reached = [result for result in problem["results"] if result["accuracy"] == accuracy and result["reached"]
               and (result["peer"] == "moreau") == own]
    return min(reached, key=lambda result: result["seconds"], default=None)


def geometric(values):
    """exp(mean ln x); None of nothing."""
    return math.exp(sum(map(math.log, values)) / len(values)) if values else None


def shifted(seconds):
    """exp(mean ln(t + s)) − s; None of nothing."""
    mean = geometric([t + SHIFT for t in seconds])
    return None if mean is None else mean - SHIFT


def summary(report):
    """For each accuracy: solved, ratios by class, profile by peer and setting."""
    lines = []
    for accuracy in report["accuracies"]:
        problems = report["problems"]
        pairs = [(problem, best(problem, accuracy, True), best(problem, accuracy, False)) for problem in problems]
        line = {"accuracy": accuracy, "problems": len(problems), "moreau": sum(own is not None for _, own, _ in pairs),
                "peers": sum(peer is not None for _, _, peer in pairs), "classes": []}
        for least, most, name in CLASSES:
            of_class = [(own, peer) for problem, own, peer in pairs if least <= problem["contacts"] <= most]
            both = [(own["seconds"], peer["seconds"]) for own, peer in of_class if own and peer]
            line["classes"].append({
                "class": name, "problems": len(of_class), "both": len(both),
                "ratio": geometric([own / peer for own, peer in both]),
                "worst": max((own / peer for own, peer in both), default=None),
                "moreau_seconds": shifted([own for own, _ in both]),
                "peer_seconds": shifted([peer for _, peer in both])})
        line["profile"] = profile(problems, accuracy)
        lines.append(line)
    return lines


def profile(problems, accuracy):
    """{solver: parts of the problems that it solves within τ times the best time of all}, τ in FACTORS."""
    times = {}
    for number, problem in enumerate(problems):
        for result in problem["results"]:
            if result["accuracy"] == accuracy and result["reached"]:
                times.setdefault(f"{result['peer']} {result['setting']}", {})[number] = result["seconds"]
    least = {number: min(own[number] for own in times.values() if number in own)
             for number in range(len(problems)) if any(number in own for own in times.values())}
    count = max(len(problems), 1)
    return {solver: [sum(t <= factor * least[number] for number, t in own.items()) / count for factor in FACTORS]
            for solver, own in sorted(times.items())}
