"""Tables of data sets that are at hand as arrays: written as CSV for the reader of files, which checks them."""
import math
import pathlib
import tempfile


def with_files(source):
    """A data set's dict in which runs have `file` in place of `data`, and the folder of these files, which is gone
    with `cleanup()`."""
    folder = tempfile.TemporaryDirectory(prefix="mckibben-")
    runs = source.get("runs")
    if not isinstance(runs, (list, tuple)):
        return source, folder
    try:
        return {**source, "runs": [with_file(run, pathlib.Path(folder.name)) for run in runs]}, folder
    except BaseException:
        folder.cleanup()
        raise


def with_file(run, folder):
    if not isinstance(run, dict) or "data" not in run:
        return run
    if "file" in run:
        raise ValueError(f"run {run.get('id')}: `data` or `file`, not both")
    name = "".join(letter if letter.isalnum() or letter in "-_" else "_" for letter in str(run.get("id", "run")))
    path = folder / f"{name}.csv"
    path.write_text(text_of(columns_of(run["data"])))
    return {**{key: value for key, value in run.items() if key != "data"}, "file": str(path)}


def columns_of(data):
    """Of a dict, a structured array or a DataFrame: lists of numbers by name."""
    names = getattr(getattr(data, "dtype", None), "names", None) or list(data)
    columns = {str(name): [float(value) for value in data[name]] for name in names}
    if len({len(column) for column in columns.values()}) != 1:
        raise ValueError("the columns of `data` have one length: "
                         + ", ".join(f"{name} has {len(column)}" for name, column in columns.items()))
    return columns


def text_of(columns):
    """As CSV; what is no number (NaN) is left empty, as a reading that is missing."""
    rows = (",".join("" if math.isnan(value) else repr(value) for value in row) for row in zip(*columns.values()))
    return "\n".join([",".join(columns), *rows]) + "\n"
