"""Tables of data sets that are at hand as arrays: written as CSV for the reader of files, which checks them."""
import math
import pathlib
import tempfile

from ._core import Rig


def with_files(source):
    """A data set's dict in which runs have `file` in place of `data`, and the data set their `rig`; the folder of these
    files, which is gone with `cleanup()`; and of each file the run's place in the list, and the names of its columns."""
    folder, written = tempfile.TemporaryDirectory(prefix="mckibben-"), {}
    runs = source.get("runs")
    if not isinstance(runs, (list, tuple)):
        return source, folder, written
    try:
        source, runs = with_rig(source, runs)
        with_file = [in_file(run, i, pathlib.Path(folder.name), written) for i, run in enumerate(runs)]
    except BaseException:
        folder.cleanup()
        raise
    return {**source, "runs": with_file}, folder, written


def with_rig(source, runs):
    """The rig that runs carry is that of a data set without one; with one they are compared with this."""
    rigs = {i: run["rig"] for i, run in enumerate(runs) if isinstance(run, dict) and "rig" in run}
    if not rigs:
        return source, runs
    if "rig" not in source:
        if len(rigs) < len(runs):
            raise ValueError("rig: some runs have one, others none; give the data set `rig`, with which all are compared")
        for i, rig in rigs.items():
            if rig != rigs[0] and Rig(rig) != Rig(rigs[0]):
                raise ValueError(f"runs[{i}].rig: is another one than that of runs[0]; make a Dataset of each, or give the "
                                 "data set `rig`, with which all are compared")
        source = {**source, "rig": rigs[0]}
    return source, [{key: value for key, value in run.items() if key != "rig"} if i in rigs else run
                    for i, run in enumerate(runs)]


def in_file(run, place, folder, written):
    if not isinstance(run, dict) or "data" not in run:
        return run
    if "file" in run:
        raise ValueError(f"runs[{place}]: `data` or `file`, not both")
    columns = columns_of(run["data"], f"runs[{place}].data")
    path = folder / f"{place}.csv"
    path.write_text(text_of(columns), encoding="utf-8")
    written[str(path)] = place, list(columns)
    return {**{key: value for key, value in run.items() if key != "data"}, "file": str(path)}


def columns_of(data, called):
    """Of a dict, a structured array or a DataFrame: lists of numbers by name."""
    try:
        names = getattr(getattr(data, "dtype", None), "names", None) or list(data)
        columns = {str(name): data[name] for name in names}
    except (TypeError, IndexError, KeyError):
        raise TypeError(f"{called}: columns by name, in a dict, a structured array or a DataFrame, "
                        f"not {type(data).__name__}") from None
    columns = {name: numbers_of(column, f"{called}[{name!r}]") for name, column in columns.items()}
    if len({len(column) for column in columns.values()}) != 1:
        raise ValueError(f"{called}: columns have one length: "
                         + ", ".join(f"{name} has {len(column)}" for name, column in columns.items()))
    return columns


def numbers_of(column, called):
    try:
        return [float(value) for value in column]
    except (TypeError, ValueError) as error:
        raise type(error)(f"{called}: {error}") from None


def text_of(columns):
    """As CSV; what is no number (NaN) is left empty, as a reading that is missing."""
    rows = (",".join("" if math.isnan(value) else repr(value) for value in row) for row in zip(*columns.values()))
    return "\n".join([",".join(columns), *rows]) + "\n"
