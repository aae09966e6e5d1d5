"""McKibben: a pneumatic muscle that lifts a load, simulated, controlled, compared with measurements.

    >>> import mckibben
    >>> ride = mckibben.Ride("thesis", load_kg=11.138)
    >>> reading = ride.step(command=9.0)
    >>> reading.time_s
    0.012

Numbers are SI, gauge pressures, commands in what the valve takes (the thesis's: mA); names end in their units. docs/python.md is the tutorial.
"""
import os as _os
import pathlib as _pathlib

if (_tables := _pathlib.Path(__file__).parent / "libs/udunits2.xml").exists():  # a wheel carries them
    _os.environ.setdefault("UDUNITS2_XML_PATH", str(_tables))

from ._core import (Batch, Calibration, Dataset, Diagnosis, Linear, Reading, Result, Ride, Rig, Run, SavedRide,
                    Scenario)
from ._core import version as __version__
from .env import AutoresetMode, Env, VectorEnv
from .errors import Error, InputError, InputWarning, MissingInput, NumericalFailure, Problem, UnfitData
from .html import show as _show

_show(Result, Run)

Flock = Batch  #: its name until it was called after what it is

__all__ = ["AutoresetMode", "Batch", "Calibration", "Dataset", "Diagnosis", "Env", "Error", "Flock", "InputError", "InputWarning", "Linear",
           "MissingInput", "NumericalFailure", "Problem", "Reading", "Result", "Ride", "Rig", "Run", "SavedRide",
           "Scenario", "UnfitData", "VectorEnv"]
