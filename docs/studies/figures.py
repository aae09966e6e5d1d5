"""The figures that the thesis prints for its accuracy (T 4.3, 5) and the same ones of the simulated rig. Writes
figures.md and figures.svg; see index.md."""
import pathlib
import tempfile

import counting
import lag
from evidence import DIRECTIONS, Evidence, heading, per_cent, rms, spread_text, table, write

LOAD_KG, WEIGHED_KG, ERROR = 8.87, 9.45, 0.065  # T 4.3
LARGEST_ERROR, FRICTION_SPREAD, PRESSURE_SPREAD = 0.15, 0.10, 0.15  # T 5: "below"
STAGES = {"own": "each load and speed by itself (T 4.7)", "in_load": "the thesis's sequence of fits (T 4.14 to 4.28)",
          "joint": "the same equations, all samples at once"}


def weigh(evidence, calibration, loads_kg):
    """Each load weighed by the thesis's controller in five contractions: (load, weighed, spread) [kg]."""
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "calibration.yaml"
        file.write_text(calibration.to_yaml())
        result = evidence.rig.run(
            loads=[f"{load} kg" for load in loads_kg], duration="24 ms", target={"kind": "steps", "start": 0.05, "moves": []},
            controllers=[{"kind": "open_loop", "calibration": str(file), "extrapolate_load": True}])
    return [(run.load_kg, run.findings["weighed_load"][0], run.findings["weighed_load_spread"][0]) for run in result.runs]


class Ours:
    def __init__(self, evidence):
        loads = [LOAD_KG, *evidence.loads_kg]
        self.weighed, self.without_lag = (weigh(evidence, c, loads) for c in (evidence.from_current, evidence.from_gauge))
        self.friction = {}  # spread over mean, for each way to process the data; as the thesis first
        for pressure, known in (("current", "from the current"), ("gauge", "true")):
            for acceleration in ("counted", "neglected"):
                found = (evidence.found[pressure] if acceleration == "counted" else
                         evidence.data.calibrate(pressure=pressure, acceleration=acceleration).to_dict())["friction"]
                self.friction[f"pressure {known}, acceleration {acceleration}"] = {d: found[d]["spread"] for d in DIRECTIONS}


def error(weighing):
    load, weighed, _ = weighing
    return weighed / load - 1.0


def largest(weighings):
    return max(abs(error(one)) for one in weighings)


def verdict(ours, printed):
    return "below" if ours < printed else "above"


def pressure_spread(evidence, direction, stage):
    fit = evidence.found["current"]["pressure"][direction]
    return fit["standard_deviation_Pa"][stage] / fit["mean_Pa"]


def side_by_side(evidence, ours):
    unseen = ours.weighed[0]
    rows = [[f"{LOAD_KG:g} kg, unseen, weighed in five contractions (T 4.3)", f"{WEIGHED_KG:g} kg, {per_cent(ERROR)}",
             f"{unseen[1]:.2f} kg, {per_cent(error(unseen))}", verdict(abs(error(unseen)), ERROR)],
            ["largest error of a weighed load (T 5)", "below " + per_cent(LARGEST_ERROR), per_cent(largest(ours.weighed)),
             verdict(largest(ours.weighed), LARGEST_ERROR)]]
    as_thesis = next(iter(ours.friction.values()))
    compared = [(f"friction coefficient, spread over mean, {d}", FRICTION_SPREAD, as_thesis[d]) for d in DIRECTIONS]
    compared += [(f"pressure, spread over mean, {d}, {words}", PRESSURE_SPREAD, pressure_spread(evidence, d, stage))
                 for d in DIRECTIONS for stage, words in STAGES.items()]
    rows += [[name, "below " + per_cent(printed), spread_text(value), verdict(value, printed)] for name, printed, value in compared]
    return table(["", "thesis", "ours", "ours is"], rows)


def why_friction(evidence, ours):
    friction_N = evidence.rows.friction.mean()
    rounding_N = rms(evidence.rows.load * (evidence.rows.counted_a - evidence.rows.late_a))
    best = {d: min(ours.friction, key=lambda way: ours.friction[way][d]) for d in DIRECTIONS}
    reached = all(ours.friction[best[d]][d] < FRICTION_SPREAD for d in DIRECTIONS)
    means = [evidence.found[source]["friction"]["contraction"]["mean"] for source in ("gauge", "current")]
    return (f"- **Friction.** Rounding to counts adds a force of {rounding_N:.1f} N (rms over all rows; [counting](counting.md)) "
            f"to a friction of {friction_N:.1f} N in the mean: {100 * rounding_N / friction_N:.0f} % of it, before anything else."
            + "".join(f" In {d} the least spread is {spread_text(ours.friction[best[d]][d])} ({best[d]})." for d in DIRECTIONS)
            + f" The spread is divided by the mean, which the lag takes from {means[0]:.4f} to {means[1]:.4f} in contraction "
            "([lag](lag.md)). " + ("So the printed figure can be reached by processing alone." if reached else
                                   "No way of processing reaches the printed figure in both directions.")
            + " The thesis does not say whether its speeds and accelerations were smoothed, or whether its samples are means.\n")


def why_load(evidence, ours):
    errors = lag.load_errors(evidence)
    runs = counting.means_of_runs(evidence, counting.load_errors(evidence, False))
    return ("- **Load.** While the current rises, the pressure taken from it is too high. Over the rows of the calibration that "
            f"alone would make loads wrong by {errors['true_friction'].mean():+.2f} kg. The friction calibrated with it is wrong "
            f"as well, which leaves {errors['from_current'].mean():+.2f} kg ([lag](lag.md)). The same in the weighing, at 6 mA/s: with "
            f"the calibrated friction errors reach {per_cent(largest(ours.weighed))}, with the friction found with the true "
            f"pressure, which has no lag in it, {per_cent(largest(ours.without_lag))}. Counting shifts the mean of a whole run by "
            f"{runs[0].mean() - runs[2].mean():+.2f} kg ([counting](counting.md)).\n")


def why_pressure(evidence):
    own = [spread_text(pressure_spread(evidence, d, "own")) for d in DIRECTIONS]
    lost = any(pressure_spread(evidence, d, "in_load") > 2.0 * pressure_spread(evidence, d, "joint") for d in DIRECTIONS)
    return (f"- **Pressure.** Each load and speed by itself is described to {own[0]} and {own[1]} (contraction, relaxation). "
            + ("The sequence of fits loses that, because factor and exponent become polynomials in load that do not know of "
               "each other; all samples at once keep it." if lost else "The polynomials in load keep that.")
            + " Which of its stages the thesis's figure is for, it does not say. See "
            "[calibration](../calibration.md#pressure-against-contraction).\n")


def page(evidence, ours):
    loads = [[f"{one[0]:g}", f"{one[1]:.2f}", f"{one[2]:.3f}", per_cent(error(one)), per_cent(error(other))]
             for one, other in zip(ours.weighed, ours.without_lag)]
    friction = [[way, *(spread_text(spreads[d]) for d in DIRECTIONS)] for way, spreads in ours.friction.items()]
    return (
        heading(evidence, "figures", "The thesis's figures and ours")
        + "What the thesis prints about its accuracy (T 4.3, T 5) and the same numbers of the simulated rig, calibrated as "
        "the thesis did: pressure from the current, accelerations by counts.\n\n" + side_by_side(evidence, ours)
        + "## Weighed loads\n\nEach by the thesis's controller, five contractions, mean and standard deviation of their means.\n\n"
        + table(["load [kg]", "weighed [kg]", "spread [kg]", "error", "error with friction from the true pressure"], loads)
        + "## Spread of friction by how the data are processed\n\n"
        + table(["spread over mean of the friction coefficient", *DIRECTIONS], friction)
        + "## Why they differ\n\n" + why_friction(evidence, ours) + why_load(evidence, ours) + why_pressure(evidence))


def curves(ours):
    for label, weighings, style in (("ours", ours.weighed, "o"), ("ours, friction from the true pressure", ours.without_lag, "^")):
        yield label, [one[0] for one in weighings], [100 * error(one) for one in weighings], style
    yield "the thesis's", [LOAD_KG], [100 * ERROR], "s"
    for limit in (LARGEST_ERROR, -LARGEST_ERROR):
        yield f"the thesis's limit, {100 * limit:+g} %", [LOAD_KG, ours.weighed[-1][0]], [100 * limit] * 2, "--"


if __name__ == "__main__":
    seen = Evidence()
    compared = Ours(seen)
    write("figures", page(seen, compared), "error of the weighed load, five contractions", "load [kg]", "error [%]", curves(compared))
