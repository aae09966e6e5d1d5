"""What counting a quarter degree every 12 ms does to speed and acceleration (T 3.3), and so to the load that T 4.31
weighs. Writes counting.md and counting.svg; see index.md."""
import numpy as np
from evidence import Evidence, bias_and_spread, heading, rms, table, weighed, write


def kinds(rows, what):
    """True values, error of the counted ones, and of that rounding and lateness; `what`: v or a."""
    true, late, counted = rows[what], rows["late_" + what], rows["counted_" + what]
    return true, counted - true, counted - late, late - true


def differences(evidence, what):
    def line(name, rows):
        return [name, *(f"{rms(kind):.4f}" for kind in kinds(rows, what))]

    return table(["nu [mA/s]", "true", "error of the counted", "of that rounding", "of that lateness"],
                 [*(line(f"{nu:.1f}", evidence.rows[evidence.rows.nu == nu]) for nu in evidence.shown_speeds),
                  line("all speeds", evidence.rows)])


def load_errors(evidence, thesis):
    """Of each row of contraction with each acceleration. All but that true, or as the thesis: pressure from the
    current, friction as calibrated with counted accelerations."""
    rows = evidence.up
    pressure = rows.line if thesis else rows.muscle
    friction = evidence.calibrated_friction(rows, rows.line, evidence.from_current) if thesis else rows.friction
    return [weighed(rows, pressure, friction, a) for a in (rows.counted_a, 0.0, rows.a)]


def means_of_runs(evidence, errors):
    return [error.groupby(evidence.up.run).mean() for error in errors]


def weighings(evidence, errors):
    def line(name, chosen):
        return [name, *(bias_and_spread(error[chosen]) for error in errors)]

    rows = evidence.up
    return table(["", "acceleration counted", "acceleration neglected", "acceleration true"],
                 [*(line(f"{load:g} kg", rows.load == load) for load in evidence.loads_kg),
                  *(line(f"{nu:.1f} mA/s", rows.nu == nu) for nu in evidence.shown_speeds),
                  line("all rows", rows.nu > 0),
                  ["means of whole runs", *(bias_and_spread(mean) for mean in means_of_runs(evidence, errors))]])


def page(evidence):
    rig = evidence.rig
    speed_step = rig.contraction_per_count / rig.tick_s
    alone, thesis = load_errors(evidence, False), load_errors(evidence, True)

    def ratio(rows, what):
        true, error, *_ = kinds(rows, what)
        return rms(error) / rms(true)

    slow, fast = (ratio(evidence.rows[evidence.rows.nu == nu], "a") for nu in (evidence.shown_speeds[0], evidence.shown_speeds[-1]))
    return (
        heading(evidence, "counting", "Speed and acceleration from counts")
        + f"One count more or less in a tick of {1e3 * rig.tick_s:g} ms changes the contraction speed by {speed_step:.3f} 1/s "
        f"and its acceleration by {speed_step / rig.tick_s:.2f} 1/s2. For the load that is {rig.rest_length_m * speed_step / rig.tick_s:.2f} "
        "m/s2. So the picture's dots stand on lines that far apart.\n\n"
        "## Speed and acceleration\n\nRoot mean squares over the rows that the calibration uses. Rounding is what whole "
        "counts add to the difference of true positions; lateness is how far that difference, a mean over the last "
        "ticks, is from the value at the instant.\n\nContraction speed [1/s]:\n\n"
        + differences(evidence, "v") + "Acceleration of the load [m/s2]:\n\n" + differences(evidence, "a")
        + f"The counted speed is wrong by {100 * ratio(evidence.rows, 'v'):.0f} % of the speed itself, the counted acceleration "
        f"by {slow:.1f} times the acceleration itself with the slowest current and {fast:.1f} times with the fastest. "
        + ("So with slow currents it is better left out, with fast ones not." if fast < 1.0 < slow else "What is above 1 is better left out.")
        + "\n\n## The load weighed with it (T 4.31)\n\nError in kg over the rows of contraction, mean +- standard deviation; "
        "each row weighs by itself, as in T 4.31. The last line is over the means of whole runs.\n\nWith true pressure and "
        "true friction, so that only the acceleration (and what T 4.31 does not have: the guide's damping and the wheel's "
        "inertia) is left:\n\n" + weighings(evidence, alone)
        + "As the thesis: pressure from the current, friction calibrated with it and with counted accelerations:\n\n"
        + weighings(evidence, thesis)
        + "With all else true, a single row scatters by {:.2f} kg with counted accelerations, by {:.2f} kg without any and by "
        "{:.2f} kg with the true one. Over a whole run the rounding cancels: its mean is off by {:+.2f}, {:+.2f} and {:+.2f} "
        "kg.\n".format(*(error.std(ddof=0) for error in alone), *(mean.mean() for mean in means_of_runs(evidence, alone))))


def curves(evidence):
    """The first whole contraction under the lightest load and the fastest current."""
    rows = evidence.up[(evidence.up.load == evidence.loads_kg[0]) & (evidence.up.nu == evidence.speeds[-1])]
    run, k = rows.run.iloc[0], rows[rows.run == rows.run.iloc[0]].k.to_numpy()
    most_s = 0.5  # left out within a contraction; between two there is more
    end = np.flatnonzero(np.diff(k) * evidence.rig.tick_s > most_s)
    shown = evidence.look(run, np.arange(k[0], k[end[0] if len(end) else -1] + 1), "contraction")
    return [("true", shown.k * evidence.rig.tick_s, shown.a, "-"), ("counted", shown.k * evidence.rig.tick_s, shown.counted_a, "o")]


if __name__ == "__main__":
    seen = Evidence()
    write("counting", page(seen), f"acceleration in one contraction, {seen.loads_kg[0]:g} kg, {seen.speeds[-1]:.1f} mA/s",
          "time [s]", "acceleration [m/s2]", curves(seen))
