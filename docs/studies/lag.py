"""How much of the friction that the thesis finds is the lag of valve and hose: it took the pressure from the current
(T 3.3), and the muscle's own pressure comes later. Writes lag.md and lag.svg; see index.md."""
import numpy as np
from evidence import (DIRECTIONS, GRAVITY_M_PER_S2, Evidence, bias_and_spread, heading, spread_text, table, weighed, write)


def coefficient(rows, pressure):
    """T 4.2 with T 4.1, as the calibration has it."""
    weight = rows.load * (rows.counted_a + GRAVITY_M_PER_S2)
    return rows.up * (rows.generated * pressure - weight) / (rows.surface * pressure)


def estimate(evidence, source, direction, which, factor=1.0):
    calibration = evidence.from_current if source == "current" else evidence.from_gauge
    value, error = calibration.coefficients[f"{direction}_friction.{which}"]
    key = "f1_s2_per_mA2" if which == "f1" else which
    why = evidence.found[source]["friction"][direction][key].get("not_determined")
    return f"{factor * value:.3g} +- {factor * error:.1g}" + (f" ({why})" if why else "")


def coefficients(evidence, direction):
    fastest = evidence.speeds[-1]
    truth = {f"f{i}": 0.01 * evidence.number("friction", "scale") * evidence.number("friction", f"f{i}") for i in range(4)}
    rows = [[{"f1": "f1 [s2/mA2]"}.get(f, f), *(estimate(evidence, s, direction, f) for s in ("current", "gauge")),
             f"{truth[f]:.3g}"] for f in truth]
    rows.append([f"f1 nu2 at {fastest:.1f} mA/s", *(estimate(evidence, s, direction, "f1", fastest**2) for s in ("current", "gauge")),
                 f"{truth['f1'] * fastest**2:.3g}"])
    fits = [evidence.found[s]["friction"][direction] for s in ("current", "gauge")]
    rows.append(["mean coefficient", *(f"{fit['mean']:.4f}" for fit in fits), ""])
    rows.append(["spread over mean", *(spread_text(fit["spread"], 0) for fit in fits), ""])
    return f"In {direction}:\n\n" + table(["", "pressure from the current", "true pressure", "truth"], rows)


def in_disguise(evidence, direction):
    name = f"{direction}_friction.f1"
    (current, _), (gauge, error) = evidence.from_current.coefficients[name], evidence.from_gauge.coefficients[name]
    if current <= 0.0:
        return f"- {direction}: f1 is not positive with the pressure from the current; there is nothing to explain.\n"
    zero = "not_determined" in evidence.found["gauge"]["friction"][direction]["f1_s2_per_mA2"]
    return (f"- {direction}: {100 * (1 - gauge / current):.1f} +- {100 * error / current:.1f} % of f1 nu2 is the lag; the rest "
            f"is {'not significant' if zero else 'significant'}.\n")


def at_speeds(evidence, direction):
    """For each current speed: shift of the pressure [Pa], lag [s], friction coefficients."""
    up = 1.0 if direction == "contraction" else -1.0
    for nu, rows in evidence.rows[evidence.rows.up == up].groupby("nu"):
        shift, rate = rows.line - rows.muscle, evidence.slope_Pa_per_mA * rows.slope
        yield (nu, shift.mean(), (shift * rate).sum() / (rate**2).sum(), coefficient(rows, rows.line).mean(),
               coefficient(rows, rows.muscle).mean(), (rows.friction / (rows.surface * rows.muscle)).mean())


def shifts(evidence, direction):
    rows = [[f"{nu:.1f}", f"{1e-5 * shift:+.3f}", f"{1e3 * lag:.0f}", *(f"{f:.4f}" for f in found)]
            for nu, shift, lag, *found in at_speeds(evidence, direction) if nu in evidence.shown_speeds]
    return f"In {direction}:\n\n" + table(["nu [mA/s]", "shift of the pressure [bar]", "L [ms]", "f from the current",
                                         "f from the true pressure", "true f"], rows)


def load_errors(evidence):
    """Of the rows of contraction [kg]: all from the current, all with the true pressure, true friction alone."""
    rows = evidence.up
    return {"from_current": weighed(rows, rows.line, evidence.calibrated_friction(rows, rows.line, evidence.from_current), rows.counted_a),
            "from_gauge": weighed(rows, rows.muscle, evidence.calibrated_friction(rows, rows.muscle, evidence.from_gauge), rows.counted_a),
            "true_friction": weighed(rows, rows.line, rows.friction, rows.counted_a)}


def page(evidence):
    errors = load_errors(evidence)
    loads = [[f"{load:g}", *(bias_and_spread(error[evidence.up.load == load]) for error in errors.values())]
             for load in evidence.loads_kg] + [["all", *(bias_and_spread(error) for error in errors.values())]]
    mean = {name: error.mean() for name, error in errors.items()}
    lightest, heaviest = (errors["from_current"][evidence.up.load == evidence.loads_kg[i]].mean() for i in (0, -1))
    cancels = abs(mean["from_current"]) < 0.5 * abs(mean["true_friction"])
    return (
        heading(evidence, "lag", "Friction or lag?")
        + "The thesis has no gauge: it takes the pressure from the current, as if it followed at once (T 3.3). Here the "
        "same rows are processed twice, with that pressure and with the muscle's own, and both are compared with the "
        "friction that the simulated threads really had.\n\n"
        "## The friction law (T 4.6)\n\nStandard errors behind +-. They take residuals as independent, which they are "
        "not: read them as lower bounds.\n\n"
        + "".join(coefficients(evidence, direction) for direction in DIRECTIONS)
        + "How much of f1 nu2 is the lag of valve and hose in disguise:\n\n"
        + "".join(in_disguise(evidence, direction) for direction in DIRECTIONS)
        + "\n## The lag itself\n\nIn a ramp the muscle's pressure stays s nu L behind the one taken from the current, with "
        "s the slope of the valve's line. L is fitted to the used rows (through zero), each with its own di/dt in the "
        "place of nu; the shift is their mean, line less muscle. f are means over the same rows. The printed shift is "
        "not s nu L of the printed nu and L: nu is a mean over whole half periods, and on a sine di/dt in the used rows "
        "is not that mean.\n\n"
        + "".join(shifts(evidence, direction) for direction in DIRECTIONS)
        + "## The load weighed with it (T 4.31)\n\nError in kg over the rows of contraction, mean +- standard deviation of "
        "single rows (much of that is the [counter](counting.md)).\n\n"
        + table(["load [kg]", "pressure and friction from the current", "both with the true pressure",
                 "pressure from the current, true friction"], loads)
        + f"Whoever knew the true friction but took the pressure from the current would be wrong by {mean['true_friction']:+.2f} "
        f"kg. With friction that was calibrated in the same way that error {'mostly cancels' if cancels else 'does not cancel'} "
        f"in the mean of all loads: {mean['from_current']:+.2f} kg. It is {lightest:+.2f} kg for the lightest load and "
        f"{heaviest:+.2f} kg for the heaviest"
        + (": one coefficient for all loads (T 4.6) cannot take the lag out of each" if lightest * heaviest < 0 else "") + ".\n")


def curves(evidence, step=0.01):
    """Means over steps of e, at the slowest and the fastest current."""
    for nu in (evidence.speeds[0], evidence.speeds[-1]):
        rows = evidence.up[evidence.up.nu == nu]
        rows = rows.assign(place=np.floor(rows.e / step), from_current=coefficient(rows, rows.line),
                           true_pressure=coefficient(rows, rows.muscle), truth=rows.friction / (rows.surface * rows.muscle))
        bins = rows.groupby("place").filter(lambda some: len(some) >= 20).groupby("place")  # fewer: the counter's noise
        means = bins[["from_current", "true_pressure", "truth"]].mean()
        for column, style in (("from_current", "o"), ("true_pressure", "^"), ("truth", "-")):
            yield f"{column.replace('_', ' ')}, {nu:.1f} mA/s", (means.index + 0.5) * step, means[column], style


if __name__ == "__main__":
    seen = Evidence()
    write("lag", page(seen), "friction coefficient in contraction, by where the pressure is from",
          "contraction ratio (means over 0.01)", "friction coefficient", curves(seen))
