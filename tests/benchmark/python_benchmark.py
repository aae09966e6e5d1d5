#!/usr/bin/env python3
"""What Python costs: a ride stepped from Python against the loop in C++, runs from Python against runs of mckibben.

    python_benchmark.py PROGRAM [RUNS]

Prints times of one session on one thread, and their ratios: those can be compared between machines.
"""
import json
import pathlib
import subprocess
import sys
import tempfile
import time

import numpy

import mckibben

PROGRAM, RUNS = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 1000
CURRENTS = 9.0 - 4.0 * numpy.cos(0.02 * numpy.arange(1000))


def best(work, times=5):
    """Seconds of the quickest of some trials."""
    spent = []
    for _ in range(times):
        begin = time.perf_counter()
        work()
        spent.append(time.perf_counter() - begin)
    return min(spent)


def steps():
    ride = mckibben.Ride(load_kg=11.138)
    start = ride.save()
    currents = CURRENTS.tolist()

    def one_by_one():
        ride.restore(start)
        for current in currents:
            ride.step(current)

    def in_cpp():
        ride.restore(start)
        ride.follow(CURRENTS)

    python_s, cpp_s = best(one_by_one), best(in_cpp)
    loads_kg = numpy.linspace(8.0, 24.0, 64)
    batch = mckibben.Batch("thesis", loads_kg)
    table = numpy.tile(CURRENTS[:, None], 64)
    batch_s = best(lambda: (batch.start(), batch.follow(table)), 3)
    ticks = len(currents)
    print(f"step, from Python          {ticks / python_s:10.0f} calls a second")
    print(f"the same loop in C++       {ticks / cpp_s:10.0f} ticks a second, {python_s / cpp_s:5.2f} times as many")
    print(f"64 rigs in a batch         {64 * ticks / batch_s:10.0f} ticks a second, {64 * cpp_s / batch_s:5.2f} times the loop in C++")


def scenario(loads):
    return {"schema": "mckibben-scenario/1", "loads": loads, "duration": "2.4 s",
            "target": {"kind": "sine", "mean": 0.05, "amplitude": 0.02, "period": "2.4 s"},
            "controllers": [{"kind": "sine_current", "low": "5 mA", "high": "9 mA", "period": "2.4 s"}]}


def runs():
    loads = [f"{8.0 + 16.0 * i / RUNS!r} kg" for i in range(RUNS)]
    few = max(1, RUNS // 20)
    with tempfile.TemporaryDirectory() as folder:
        def command(keys):
            path = pathlib.Path(folder) / "scenario.yaml"
            path.write_text(json.dumps(keys))
            subprocess.run([PROGRAM, "run", path, "--threads", "1", "--out", f"{folder}/out"], check=True,
                           stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

        def one_by_one(run):
            for load in loads[:few]:
                run(scenario([load]))
        python_s = best(lambda: mckibben.Scenario(scenario(loads)).run(threads=1), 3)
        command_s = best(lambda: command(scenario(loads)), 1)
        python_each_s = best(lambda: one_by_one(lambda keys: mckibben.Scenario(keys).run(threads=1)), 3)
        command_each_s = best(lambda: one_by_one(command), 1)
    print(f"{RUNS} runs in one call       {python_s:10.2f} s; one command, which writes its files, {command_s:.2f} s: "
          f"{command_s / python_s:.2f} times as long")
    print(f"{RUNS} calls of one run each  {python_each_s * RUNS / few:10.2f} s; as many commands {command_each_s * RUNS / few:.2f} s: "
          f"{command_each_s / python_each_s:.2f} times as long")


steps()
runs()
