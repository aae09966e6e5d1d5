#!/usr/bin/env python3
"""A PI controller in a process of its own: docs/your_controller.md says which lines go to and fro."""
import json
import sys

GAIN_mA, INTEGRAL_TIME_s = 30.0, 0.3

hello = json.loads(sys.stdin.readline())
assert hello["mckibben_controller"] == 1, "these lines are of a later version"
low_mA, high_mA = hello["lowest_mA"], hello["highest_mA"]
integral_mA = low_mA
print(low_mA, flush=True)  # while the rig settles

for line in sys.stdin:
    now = json.loads(line)
    ratio = (now["counts"] + hello["middle_of_count"]) * hello["contraction_per_count"]
    error = now["target"] - ratio
    wanted_mA = integral_mA + GAIN_mA * error
    current_mA = min(max(wanted_mA, low_mA), high_mA)
    if current_mA == wanted_mA:  # at a limit the integral waits
        integral_mA = integral_mA + GAIN_mA * hello["period_s"] / INTEGRAL_TIME_s * error
    print(current_mA, flush=True)
