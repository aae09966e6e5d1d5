"""Runs as pandas DataFrames, where pandas is installed."""


def frame_of(run):
    """A DataFrame of a Run: a row at each tick, its time as the index, units and words in attrs."""
    try:
        import pandas
    except ImportError as error:
        raise ImportError("frames need pandas (Debian: python3-pandas); "
                          "without it, Run.samples is a NumPy array with the same columns") from error
    units, meanings = run.units, run.meanings
    frame = pandas.DataFrame({name: run[name] for name in units if name != "time_s"},
                             index=pandas.Index(run["time_s"], name="time_s"))
    frame.attrs.update(units=units, meanings=meanings)
    return frame
