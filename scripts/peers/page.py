"""The page of a run in markdown."""

from .statistics import FACTORS, best


def markdown(report):
    """Tables for each accuracy, and how they were made."""
    versions = ", ".join(f"{name} {version}" for name, version in report["versions"].items())
    machine = report["machine"]
    lines = ["# Contact solvers side by side", "",
             f"{report['date']}, {machine['processor']}, one core of {machine['cores']}, {machine['system']}. {versions}.",
             "", "<!-- not run: it measures times against other packages -->", "```sh", report["command"], "```", "",
             f"Every solver on one core, in turn, {report['rounds']} {'round' if report['rounds'] == 1 else 'rounds'} in one run; the least time counts. *natural map* is "
             "‖r − P_K(r − ŷ)‖/‖q‖ with ρ = 1 kg, computed by numpy from the answer of each. "
             "† the peer was given (W + Wᵀ)/2 and is judged by it. No peer beside our time: no setting of theirs reached the accuracy "
             f"within {report['limit']:g} s, or where we did within {report['patience'][0]:g} times our time "
             f"and {report['patience'][1]:g} s. *certificate* is the time of our contact by contact certificate of the answer.", ""]
    for summary in report["summary"]:
        lines += _accuracy(report, summary)
    return "\n".join(lines)


def _accuracy(report, summary):
    accuracy = summary["accuracy"]
    lines = [f"## Natural map ≤ {accuracy:g}", "",
             f"moreau solves {summary['moreau']} of {summary['problems']}, the peers together {summary['peers']}.", "",
             "| contacts | problems | both solve | time / virtual best peer | worst | moreau | virtual best peer |",
             "|---|---|---|---|---|---|---|"]
    for row in summary["classes"]:
        lines.append(f"| {row['class'].replace(' contacts', '')} | {row['problems']} | {row['both']} | {_number(row['ratio'])} | "
                     f"{_number(row['worst'])} | {_time(row['moreau_seconds'])} | {_time(row['peer_seconds'])} |")
    lines += ["", "The two last columns are shifted geometric means over the problems that both solve.", "",
              "| problem | law | contacts | asymmetry of W | moreau | natural map | certificate | virtual best peer "
              "| natural map | ratio |",
              "|---|---|---|---|---|---|---|---|---|---|"]
    for problem in report["problems"]:
        own, peer = best(problem, accuracy, True), best(problem, accuracy, False)
        ours = ["–", "–", "–"]
        if own:
            ours = [_time(own["seconds"]), f"{own['residual']:.1e}", _time(own.get("certifying"))
                    + ("" if own.get("certified") else " (refused)")]
        theirs = ["–", "–"]
        if peer:
            theirs = [f"{_time(peer['seconds'])} {peer['peer']} {peer['setting']}{' †' if peer['symmetrised'] else ''}",
                      f"{peer['residual']:.1e}"]
        ratio = _number(own["seconds"] / peer["seconds"]) if own and peer else "–"
        asymmetry = f"{problem['asymmetry']:.0e}" if problem["asymmetry"] else "0"
        lines.append("| " + " | ".join([problem["name"], problem["law"], str(problem["contacts"]), asymmetry, *ours, *theirs, ratio])
                     + " |")
    heads = " | ".join(f"{factor:g}" for factor in FACTORS)
    lines += ["", "Performance profile: part of the problems solved within τ times the least time of all.", "",
              f"| solver, τ = | {heads} |", "|---|" + "---|" * len(FACTORS)]
    for solver, parts in summary["profile"].items():
        lines.append(f"| {solver} | " + " | ".join(f"{100 * part:.0f} %" for part in parts) + " |")
    return [*lines, ""]


def _number(value):
    return "–" if value is None else f"{value:.2f}"


def _time(seconds):
    if seconds is None:
        return "–"
    if seconds < 1e-3:
        return f"{1e6 * seconds:.1f} µs"
    return f"{1e3 * seconds:.2f} ms" if seconds < 1.0 else f"{seconds:.2f} s"
