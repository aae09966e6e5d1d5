"""What the studies look at: the thesis's campaign simulated, what was measured of it, what truly happened, and its
calibrations with the pressure from the current (T 3.3) and with the true one. Calibrations see the measurements only."""
import pathlib
import sys

import mckibben
import numpy as np
import pandas as pd

GRAVITY_M_PER_S2 = 9.80665
LOADS_KG = (11.138, 13.87, 16.138, 18.87, 23.406)
TICKS_PER_PERIOD = (*range(200, 561, 20), 600)  # as in scenarios/thesis_campaign.yaml
DIRECTIONS = ("contraction", "relaxation")


class Evidence:
    def __init__(self, loads_kg=LOADS_KG, ticks_per_period=TICKS_PER_PERIOD):
        self.rig = mckibben.Rig("thesis")
        self.values = self.rig.to_dict()
        self.loads_kg = loads_kg
        simulated = [self._sine(ticks) for ticks in ticks_per_period]
        self.runs = {f"m{m}_n{ticks}": result[m] for m in range(len(loads_kg))
                     for ticks, result in zip(ticks_per_period, simulated)}
        self.data = mckibben.Dataset({"runs": [
            {"id": name, "load": f"{run.load_kg} kg",
             "data": {"time_s": run["time_s"].round(9), "current_mA": run["current_mA"],
                      "contraction_ratio": run["encoder_contraction_ratio"],
                      "muscle_pressure_bar": run["muscle_pressure_bar"]}} for name, run in self.runs.items()]})
        self.from_current, self.from_gauge = (self.data.calibrate(pressure=p) for p in ("current", "gauge"))
        self.found = {"current": self.from_current.to_dict(), "gauge": self.from_gauge.to_dict()}
        self.speeds = self.found["current"]["current_speeds_mA_per_s"]
        self.shown_speeds = list(dict.fromkeys(self._nearest(nu) for nu in (5.6, 6.7, 8.3, 11.1, 16.7)))
        used = self.from_current.used_rows()
        self.rows = pd.concat([self.look(name, rows[direction], direction) for name, rows in used.items()
                               for direction in DIRECTIONS], ignore_index=True)
        self.up = self.rows[self.rows.up > 0]

    def number(self, section, key):
        """A field of the rig without its unit, which rig files show."""
        return float(str(self.values[section][key]).split()[0])

    def _sine(self, ticks):
        period_ms = 12 * ticks
        return self.rig.run(loads=[f"{load} kg" for load in self.loads_kg], duration=f"{5 * period_ms} ms",
                            target={"kind": "steps", "start": 0.05, "moves": []},
                            controllers=[{"kind": "sine_current", "low": "0 mA", "high": "20 mA", "period": f"{period_ms} ms"}])

    def _nearest(self, speed):
        return min(self.speeds, key=lambda known: abs(known - speed))

    @property
    def slope_Pa_per_mA(self):
        return ((self.number("valve", "span_pressure") - self.number("valve", "zero_pressure"))
                / (self.number("valve", "span_command") - self.number("valve", "zero_command")))

    def look(self, name, k, direction):
        """Rows k of a run as measured and as they were; none of the first two."""
        run, rig, up = self.runs[name], self.rig, 1.0 if direction == "contraction" else -1.0
        length, tick, per_count = rig.rest_length_m, rig.tick_s, rig.contraction_per_count
        current, counts = run["current_mA"], run["counts"]
        e = (counts[k] + 0.5) * per_count
        radius, angle = self.number("muscle", "rest_radius"), np.radians(self.number("muscle", "braid_angle"))
        u = 1.0 - self.number("muscle", "end_correction") * e
        sine2, cosine2 = np.sin(angle) ** 2, np.cos(angle) ** 2
        v = run["contraction_speed_per_s"][k]
        hung = run.load_kg + self.number("joint", "load_offset")
        moved = hung + self.number("joint", "wheel_inertia") / self.number("joint", "wheel_radius") ** 2
        pull = (run["braid_force_N"][k] + run["friction_force_N"][k] + run["effects_pull_N"][k]
                - self.number("joint", "guide_damping") * length * v - hung * GRAVITY_M_PER_S2)

        def differences(ratio):
            last, before = ratio[k] - ratio[k - 1], ratio[k - 1] - ratio[k - 2]
            return last / tick, length * (last - before) / tick**2

        late_v, late_a = differences(run["contraction_ratio"])
        counted_v, counted_a = differences(counts * per_count)
        half_periods = np.ptp(current) / (self.period_s(name) / 2)
        return pd.DataFrame({
            "run": name, "k": k, "up": up, "load": run.load_kg, "nu": self._nearest(half_periods),
            "slope": (current[k] - current[k - 1]) / tick, "e": e,
            "line": self.number("valve", "zero_pressure") + self.slope_Pa_per_mA * (current[k] - self.number("valve", "zero_command")),
            "muscle": 1e5 * run["muscle_pressure_bar"][k], "friction": -up * run["friction_force_N"][k],
            "generated": np.pi * radius**2 * (3.0 * cosine2 / sine2 * u * u - 1.0 / sine2),  # T 2.8, of 1 Pa
            "surface": (2.0 * np.pi * radius * length * np.sqrt(sine2)
                        / ((1.0 - e) * np.sqrt(1.0 - cosine2 * (1.0 - e) ** 2))),  # T 4.3
            "v": v, "a": pull / moved, "late_v": late_v, "late_a": late_a, "counted_v": counted_v, "counted_a": counted_a})

    def period_s(self, name):
        return int(name.split("_n")[1]) * self.rig.tick_s

    def calibrated_friction(self, rows, pressure, calibration):
        """[N], T 4.6 with T 4.2, in contraction."""
        f = [calibration.coefficients[f"contraction_friction.f{i}"][0] for i in range(4)]
        return (f[0] + f[1] * rows.nu**2 + f[2] * rows.e + f[3] * np.log(rows.e)) * rows.surface * pressure


def weighed(rows, pressure, friction, acceleration):
    """Error of the load by T 4.31, row by row [kg]."""
    return (rows.generated * pressure - friction) / (acceleration + GRAVITY_M_PER_S2) - rows.load


def rms(values):
    return np.sqrt(np.mean(values**2))


def bias_and_spread(values):
    return f"{values.mean():+.2f} +- {values.std(ddof=0):.2f}"


def per_cent(ratio):
    return f"{100.0 * ratio:.1f} %"


def spread_text(ratio, decimals=1):
    return f"{100.0 * ratio:.{decimals}f} %" if ratio <= 1.0 else "not usable (above 100 %)"


def table(head, rows):
    lines = [head, ["---", *["---:"] * (len(head) - 1)], *rows]
    return "".join("| " + " | ".join(row) + " |\n" if row is not lines[1] else "|" + "|".join(row) + "|\n" for row in lines) + "\n"


def heading(evidence, name, title):
    loads, speeds = evidence.loads_kg, evidence.speeds
    return (f"# {title}\n\nMade by `./mckibben python docs/studies/{name}.py` from the campaign `thesis_campaign`, "
            f"{len(evidence.runs)} runs: loads from {loads[0]:g} to {loads[-1]:g} kg, current speeds nu from "
            f"{speeds[0]:.1f} to {speeds[-1]:.1f} mA/s. A test makes this page again."
            f"\n\n![{title}]({name}.svg)\n\n")


def write(name, page, title, x_label, y_label, curves):
    """The page and its picture, into the folder that the command line names. Curves: (label, x, y, style)."""
    folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "out/studies")
    folder.mkdir(parents=True, exist_ok=True)
    (folder / f"{name}.md").write_text(page)
    try:
        import matplotlib
    except ImportError:
        sys.exit(f"{folder}/{name}.md is written; its picture needs python3-matplotlib")
    matplotlib.use("svg")
    matplotlib.rcParams.update({"svg.hashsalt": name, "svg.fonttype": "none"})
    from matplotlib import pyplot
    figure, axes = pyplot.subplots(figsize=(8, 5), layout="tight")
    for label, x, y, style in curves:
        axes.plot(x, y, style, label=label, markersize=4)
    axes.set(title=title, xlabel=x_label, ylabel=y_label)
    axes.grid(alpha=0.3)
    axes.legend(fontsize="small")
    figure.savefig(folder / f"{name}.svg", metadata={"Date": None})
