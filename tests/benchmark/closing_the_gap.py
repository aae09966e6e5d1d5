#!/usr/bin/env python3
"""What a controller that plans with a model gains by a diagnosis, for each effect that a rig may hide.

    closing_the_gap.py PROGRAM FOLDER [EFFECT...]

For each effect: a rig that hides it is measured (`dataset`) and diagnosed; then it follows the target of
scenarios/model_inverse.yaml under three loads, by model_inverse on the nominal rig, on the corrected one, and on
one in which another effect was named and fitted (by golden section on what `replay` leaves), and by PID, tuned on
the rig itself. Prints a table, as Markdown, and writes closing_the_gap.svg into FOLDER.
"""
import json
import math
import pathlib
import re
import subprocess
import sys

# Effect, its parameters, the wrong name with its fixed parameters, the fitted one, its unit, and its largest value.
# Sizes are the large ones of the diagnosis benchmark (hidden_effects.cpp).
CASES = [
    ("viscous_damping", "damping: 120 N.s/m", "guide_friction", "", "coefficient", "", 0.1),
    ("guide_friction", "coefficient: 0.04", "bladder_hysteresis", "stroke: 8 mm, ", "force", "N", 40),
    ("speed_dependent_friction", "ratio: 0.6, speed: 20 mm/s", "viscous_damping", "", "damping", "N.s/m", 400),
    ("bladder_elasticity", "stiffness: 300 N/m", "end_cap_correction", "", "slope", "", 0.05),
    ("bladder_creep", "stiffness: 250 N/m, time: 1.5 s", "bladder_elasticity", "", "stiffness", "N/m", 800),
    ("bladder_hysteresis", "force: 12 N, stroke: 8 mm", "guide_friction", "", "coefficient", "", 0.2),
    ("end_cap_correction", "slope: 0.015", "bladder_elasticity", "", "stiffness", "N/m", 1500),
    ("pressure_threshold", "pressure: 0.4 bar", "bladder_elasticity", "", "stiffness", "N/m", 1500),
    ("muscle_leak", "conductance: 2e-10 m3/(s.Pa)", "exhaust_restriction", "", "share", "", 0.9),
    ("polytropic_gas", "exponent: 1.3", "viscous_damping", "", "damping", "N.s/m", 400),
    ("gas_temperature", "time: 0.3 s", "viscous_damping", "", "damping", "N.s/m", 400),
    ("valve_lag", "time: 40 ms", "viscous_damping", "", "damping", "N.s/m", 400),
    ("valve_dead_band", "half_width: 80 mbar", "guide_friction", "", "coefficient", "", 0.2),
    ("valve_hysteresis", "half_width: 80 mbar", "guide_friction", "", "coefficient", "", 0.2),
    ("supply_droop", "line_resistance: 1e8 s.Pa/kg, volume: 0.3 l", "valve_lag", "", "time", "ms", 200),
    ("exhaust_restriction", "share: 0.5", "muscle_leak", "", "conductance", "m3/(s.Pa)", 1e-9),
    ("command_delay", "time: 50 ms", "valve_lag", "", "time", "ms", 200),
    ("friction_warm_up", "change: -0.35, time: 5 s", "guide_friction", "", "coefficient", "", 0.1),
    ("encoder_backlash", "width: 1.2 mm", "bladder_hysteresis", "stroke: 8 mm, ", "force", "N", 40),
    ("encoder_scale", "error: 0.03", "end_cap_correction", "", "slope", "", 0.05),
    ("reading_delay", "time: 50 ms", "command_delay", "", "time", "ms", 200),
]
LOADS = "[11.138 kg, 16.138 kg, 23.406 kg]"
CONTROLLERS = ("nominal", "corrected", "wrong_name", "pid")
STYLE = {"nominal": "#d55e00", "wrong_name": "#cc79a7", "corrected": "#0072b2", "pid": "#666"}


def run(program, folder, *arguments):
    done = subprocess.run([program, *arguments], cwd=folder, capture_output=True, text=True)
    if done.returncode != 0:
        raise RuntimeError(f"{arguments}: {done.stderr[-2000:]}")
    return done.stdout


def rig(effect, parameters):
    return f"schema: mckibben-rig/1\nbase: thesis\neffects:\n  {effect}: {{{parameters}}}\n"


def left_by(program, folder, name):
    """What a rig leaves of the measurements: root mean square over the runs."""
    rows = json.loads(run(program, folder, "replay", "out/campaign", "--rig", name, "--out", "out/replay", "--json"))
    squares = [one["rmse"] ** 2 for one in rows["runs"]]
    return math.sqrt(sum(squares) / len(squares))


def fitted(program, folder, effect, fixed, key, unit, highest):
    """The effect's size that leaves least, by golden section."""
    def tried(size):
        (folder / "wrong.yaml").write_text(rig(effect, f"{fixed}{key}: {size:.4g}{' ' + unit if unit else ''}"))
        return left_by(program, folder, "wrong.yaml")
    share = (math.sqrt(5) - 1) / 2
    low, high = 0.0, float(highest)
    a, b = high - share * (high - low), low + share * (high - low)
    at_a, at_b = tried(a), tried(b)
    for _ in range(9):
        if at_a < at_b:
            high, b, at_b = b, a, at_a
            a = high - share * (high - low)
            at_a = tried(a)
        else:
            low, a, at_a = a, b, at_b
            b = low + share * (high - low)
            at_b = tried(b)
    tried((low + high) / 2)


def one_case(program, root, folder, case):
    effect, parameters, wrong, fixed, key, unit, highest = case
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "hidden.yaml").write_text(rig(effect, parameters))
    (folder / "campaign.yaml").write_text(f"""schema: mckibben-campaign/1
rig: hidden.yaml
loads: {LOADS}
currents:
  - {{name: slow, duration: 8 s, current: {{kind: triangle_current, low: 5 mA, high: 15 mA, period: 8 s}}}}
  - {{name: wave, duration: 6 s, current: {{kind: sine_current, low: 6 mA, high: 14 mA, period: 3 s}}}}
noise: {{encoder_jitter: 5e-5}}
seed: 7
""")
    run(program, folder, "dataset", "campaign.yaml")
    run(program, folder, "diagnose", "out/campaign")
    diagnosis = json.loads((folder / "out/campaign-diagnose/diagnosis.json").read_text())
    fitted(program, folder, wrong, fixed, key, unit, highest)
    text = (root / "scenarios/model_inverse.yaml").read_text()
    head = text[:text.index("controllers:")]
    head = re.sub("rig: .*", "rig: hidden.yaml", re.sub(r"loads: \[.*", f"loads: {LOADS}", head))
    (folder / "control.yaml").write_text(head + """controllers:
  - {kind: model_inverse, name: nominal, rig: thesis}
  - {kind: model_inverse, name: corrected, rig: out/campaign-diagnose/rig.yaml}
  - {kind: model_inverse, name: wrong_name, rig: wrong.yaml}
  - {kind: pid, tuning_load: 16.138 kg}
""")
    result = json.loads(run(program, folder, "run", "control.yaml", "--json"))
    errors = {name: [] for name in CONTROLLERS}
    for one in result["runs"]:
        errors[one["controller"]].append(one["rmse"])
    named = " + ".join(one["name"] for one in diagnosis["effects"]) or diagnosis["verdict"]
    return {"effect": effect, "named": named, "wrong": wrong,
            **{name: sum(all_) / len(all_) for name, all_ in errors.items()}}


def picture(rows):
    """Each effect a line, each controller a dot, on a logarithmic axis."""
    left, width, row, low, high = 190, 430, 22, 1e-4, 1e-1
    def x(value):
        return left + width * math.log(value / low) / math.log(high / low)
    bottom = 40 + row * len(rows)
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {left + width + 30} {bottom + 40}" '
           'font-family="sans-serif" font-size="12">', '<rect width="100%" height="100%" fill="#fff"/>']
    for i, (name, colour) in enumerate(STYLE.items()):
        out.append(f'<circle cx="{left + 110 * i}" cy="14" r="5" fill="{colour}"/>'
                   f'<text x="{left + 110 * i + 10}" y="18">{name.replace("_", " ")}</text>')
    for value in (1e-4, 1e-3, 1e-2, 1e-1):
        out.append(f'<path d="M{x(value):.1f} 30V{bottom}" stroke="#ccc"/>'
                   f'<text x="{x(value):.1f}" y="{bottom + 16}" text-anchor="middle">{value:g}</text>')
    out.append(f'<text x="{left + width / 2}" y="{bottom + 34}" text-anchor="middle">'
               'rmse, contraction ratio, mean of three loads</text>')
    for i, one in enumerate(rows):
        y = 45 + row * i
        out.append(f'<text x="{left - 10}" y="{y + 4}" text-anchor="end">{one["effect"]}</text>'
                   f'<path d="M{left} {y}H{left + width}" stroke="#eee"/>')
        for name in ("pid", "nominal", "wrong_name", "corrected"):
            out.append(f'<circle cx="{x(one[name]):.1f}" cy="{y}" r="5" fill="{STYLE[name]}"/>')
    return "\n".join(out + ["</svg>"]) + "\n"


def main():
    program, folder = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
    root = pathlib.Path(__file__).resolve().parents[2]
    rows = []
    print("| hidden | diagnosed as | nominal | corrected | wrong name | fitted as | PID |\n|---|---|---|---|---|---|---|")
    for case in CASES:
        if sys.argv[3:] and case[0] not in sys.argv[3:]:
            continue
        one = one_case(str(program), root, folder / case[0], case)
        rows.append(one)
        print(f"| `{one['effect']}` | {one['named']} | {one['nominal']:.5f} | {one['corrected']:.5f} | "
              f"{one['wrong_name']:.5f} | `{one['wrong']}` | {one['pid']:.5f} |", flush=True)
    (folder / "closing_the_gap.svg").write_text(picture(rows))


main()
