"""Two muscles on one wheel, simulated by another engine: docs/equations.md and docs/two_muscles.md written down
once more in Python, integrated by LSODA (scipy), nothing of this program's in it. Makes data sets whose answer is
known.

    other_engine.py FOLDER NAME=SIZE[@SIDE] ...     NAME: muscle_leak, viscous_damping, valve_lag; SIDE: 1, 2

Each run: two currents, a row each 12 ms; the joint's angle [rad] as a potentiometer reads it, and with --gauges
both muscles' pressures [bar]. SI inside, pressures gauge, currents in mA.
"""
import math
import pathlib
import sys

import numpy
from scipy.integrate import odeint

TICK, SETTLING_TICKS = 0.012, 167
ROWS, RUNS = 190, 6  # of four, unseen runs do not decide between a small leak and other parameters

# The rig `thesis_pair`, value by value.
L0, R0, ALPHA, K, DEAD = 0.3, 0.0075, math.radians(20.0), 1.3, 5e-6
STOP, STOP_DAMPING = 3e5, 19.0
F0, F2, F3 = 4.6937, -13.9715, 0.5306
SIGMA0, SIGMA1, FLOOR = 4e5, 400.0, 1.0
ZERO, SPAN, SUPPLY, BAND, VALVE_VOLUME, VALVE_C = 5e4, 5e5, 6e5, 3e4, 5e-5, 4e-9
HOSE_C, CRITICAL, LINEAR = 1.5e-8, 0.3, 1e3
RT, RHO, ATMOSPHERE = 287.05 * 293.15, 1.185, 101325.0
WHEEL, INERTIA = 0.03, 1e-4 + 0.14
MASS, LENGTH, JOINT_DAMPING, MOUNTED, GRAVITY = 2.0, 0.25, 0.05, 0.10, 9.80665

A, B, AREA = 3 / math.tan(ALPHA)**2, 1 / math.sin(ALPHA)**2, math.pi * R0**2


def flow(conductance, p1, p2):
    """ISO 6358 with its linear zone [kg/s], absolute pressures."""
    if p1 < p2:
        return -flow(conductance, p2, p1)
    ellipse = lambda r: 1.0 if r <= CRITICAL else math.sqrt(max(0.0, 1 - ((r - CRITICAL) / (1 - CRITICAL))**2))
    whole = conductance * RHO * p1
    if p1 - p2 < LINEAR:
        return whole * ellipse((p1 - LINEAR) / p1) * (p1 - p2) / LINEAR
    return whole * ellipse(p2 / p1)


class Muscle:
    """A side: valve, hose, gas, braid and threads. Its state: valve and muscle pressure, bristles, and how far the
    valve is open if that lags."""

    def __init__(self, hidden):
        self.leak = hidden.get('muscle_leak', 0.0)
        self.damping = hidden.get('viscous_damping', 0.0)
        self.lag = hidden.get('valve_lag', 0.0)

    def rates(self, state, e, speed, wanted):
        """d(state)/dt and the cord's force [N]; `speed` of contraction [m/s]."""
        pv, pm, z, opening = state
        u = min(max((wanted - pv) / BAND, -1.0), 1.0)
        opened = opening if self.lag > 0.0 else u
        valve = (opened * flow(VALVE_C, SUPPLY + ATMOSPHERE, pv + ATMOSPHERE) if opened > 0.0 else
                 opened * flow(VALVE_C, pv + ATMOSPHERE, ATMOSPHERE))
        hose = flow(HOSE_C, pv + ATMOSPHERE, pm + ATMOSPHERE)
        leak = flow(self.leak, pm + ATMOSPHERE, ATMOSPHERE)
        bracket = A * (1 - K * e)**2 - B
        volume = DEAD + AREA * L0 + L0 * AREA * (A * (1 - (1 - K * e)**3) / (3 * K) - B * e)
        dpv = RT / VALVE_VOLUME * (valve - hose)
        dpm = (RT * (hose - leak) - (pm + ATMOSPHERE) * AREA * bracket * speed) / volume
        surface = (2 * math.pi * R0 * L0 * math.sin(ALPHA) /
                   ((1 - e) * math.sqrt(1 - (math.cos(ALPHA) * (1 - e))**2)))
        within = min(max(e, 0.005), 0.28)
        level = 0.01 * (F0 + F2 * within + F3 * math.log(within)) * surface * max(pm, 0.0)
        dz = speed - SIGMA0 * abs(speed) / (max(level, 0.0) + FLOOR) * z
        stop = -STOP * L0 * e * max(0.0, 1 - STOP_DAMPING * speed) if e < 0.0 else 0.0
        force = AREA * pm * bracket - SIGMA0 * z - SIGMA1 * dz + stop - self.damping * speed
        lag = (u - opening) / self.lag if self.lag > 0.0 else 0.0
        return [dpv, dpm, dz, lag], force


def joint(state, _, muscles, wanted):
    theta, turning = state[:2]
    e1, e2 = MOUNTED + WHEEL * theta / L0, MOUNTED - WHEEL * theta / L0
    one, pull_1 = muscles[0].rates(state[2:6], e1, WHEEL * turning, wanted[0])
    two, pull_2 = muscles[1].rates(state[6:10], e2, -WHEEL * turning, wanted[1])
    torque = WHEEL * (pull_1 - pull_2) - MASS * GRAVITY * LENGTH * math.sin(theta) - JOINT_DAMPING * turning
    return [turning, torque / INERTIA] + one + two


def asked_for(current_mA):
    return min(max(ZERO + (SPAN - ZERO) * (current_mA - 4.0) / 16.0, ZERO), SPAN)


def currents(run):
    """Against each other and together, each run otherwise [mA]."""
    t = TICK * numpy.arange(ROWS)
    turn = numpy.sin(2 * math.pi * t / (1.0 + 0.35 * run))
    if run % 2:
        turn = numpy.clip(1.7 * turn, -1.0, 1.0)
    together = 11.2 + 1.4 * (run - 1.5) / 2.0 + 1.6 * numpy.sin(2 * math.pi * t / 3.3 + run)
    return numpy.stack([together + 4.2 * turn, together - 4.2 * turn], axis=1)


def simulate(muscles, given_mA):
    """Angles [rad] and both muscle pressures [Pa] at the ticks, from rest."""
    wanted = [asked_for(i) for i in given_mA[0]]
    state = numpy.array([0.0, 0.0] + [wanted[0], wanted[0], 0.0, 0.0] + [wanted[1], wanted[1], 0.0, 0.0])

    def on(state, seconds):
        return odeint(joint, state, [0.0, seconds], args=(muscles, wanted), rtol=1e-8, atol=1e-9, mxstep=100000)[-1]

    state = on(state, SETTLING_TICKS * TICK)
    rows = []
    for both in given_mA:
        rows.append([state[0], state[3], state[7]])
        wanted = [asked_for(i) for i in both]
        state = on(state, TICK)
    return numpy.array(rows)


def write_dataset(folder, muscles, gauges, mirrored=False, seed=3):
    """`mirrored`: the same joint seen from behind, muscle 1 is muscle 2 and the angle turns the other way."""
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    random = numpy.random.default_rng(seed)
    for run in range(RUNS):
        given = currents(run)
        rows = simulate(muscles, given)
        angle = rows[:, 0] + 1e-3 * random.standard_normal(ROWS)
        bar = (rows[:, 1:] + 200.0 * random.standard_normal((ROWS, 2))) / 1e5
        if mirrored:
            given, angle, bar = given[:, ::-1], -angle, bar[:, ::-1]
        columns = [TICK * numpy.arange(ROWS), given[:, 0], given[:, 1], angle] + ([bar[:, 0], bar[:, 1]] if gauges else [])
        names = ['time_s', 'current_1_mA', 'current_2_mA', 'angle_rad'] + (
            ['muscle_pressure_1_bar', 'muscle_pressure_2_bar'] if gauges else [])
        numpy.savetxt(folder / f'r{run + 1}.csv', numpy.stack(columns, axis=1), fmt='%.9g', delimiter=',',
                      header=','.join(names), comments='')
    runs = ''.join(f'  - {{id: r{run + 1}, file: r{run + 1}.csv}}\n' for run in range(RUNS))
    (folder / 'dataset.yaml').write_text('schema: mckibben-dataset/1\nrig: thesis_pair\nruns:\n' + runs)


def muscles_of(hidden):
    """From ['muscle_leak=3e-10@2', ...]; without a side: of both."""
    sides = [{}, {}]
    for text in hidden:
        name, size = text.split('=')
        size, _, side = size.partition('@')
        for which in (1, 2) if side == '' else (int(side),):
            sides[which - 1][name] = float(size)
    return [Muscle(side) for side in sides]


if __name__ == '__main__':
    options = [a for a in sys.argv[2:] if a.startswith('--')]
    write_dataset(sys.argv[1], muscles_of([a for a in sys.argv[2:] if not a.startswith('--')]), '--gauges' in options,
                  '--mirrored' in options)
