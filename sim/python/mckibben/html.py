"""What notebooks show of results: a small table, each run with its motion as a line."""
import html

import numpy


def sparkline(values, wide=160, high=28):
    """The values as an SVG line."""
    values = numpy.asarray(values, dtype=float)
    values = values[numpy.linspace(0, len(values) - 1, min(len(values), wide)).astype(int)] if len(values) else values
    if not len(values):
        return ""
    low, span = values.min(), max(float(numpy.ptp(values)), 1e-12)
    across = numpy.linspace(1, wide - 1, len(values))
    points = " ".join(f"{x:.1f},{high - 2 - (high - 4) * (y - low) / span:.1f}" for x, y in zip(across, values))
    return (f'<svg width="{wide}" height="{high}" role="img" aria-label="motion over time">'
            f'<polyline points="{points}" fill="none" stroke="#0072B2"/></svg>')


def _motion(run):
    """Of a joint its angle."""
    for name in ("angle_rad", "contraction_ratio"):
        if name in run.units:
            return name, run[name]
    return "", []


def _row(run):
    name, motion = _motion(run)
    rmse = [f"{value:.5f}{key[4:].replace('_', ' ')}" for key, value in run.metrics.items() if key.startswith("rmse")]
    said = html.escape(run.failure) if run.failure else "".join(rmse)
    ends = f"{name} {min(motion):.4g} to {max(motion):.4g}" if len(motion) else ""
    return (f"<tr><td>{html.escape(run.name)}</td><td>{run.load_kg:g}</td><td>{html.escape(run.controller)}</td>"
            f"<td>{said}</td><td>{sparkline(motion)}</td><td>{ends}</td></tr>")


def of_runs(runs, most=20):
    """The first of them."""
    rows = "".join(_row(run) for run in runs[:most])
    more = f"<p>and {len(runs) - most} more</p>" if len(runs) > most else ""
    return ("<table><tr><th>run</th><th>load [kg]</th><th>controller</th><th>rmse</th><th>motion</th><th></th></tr>"
            f"{rows}</table>{more}")


def show(result, run):
    """Lets notebooks show these classes."""
    result._repr_html_ = lambda self: of_runs(self.runs)
    run._repr_html_ = lambda self: of_runs([self])
