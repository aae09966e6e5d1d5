#!/usr/bin/env python3
"""How often names were right, by how far they were ahead: what is told of such names, and what was counted.

    reliability.py TOLD COUNTED FOLDER

TOLD and COUNTED: what `bench diagnosis --weak` printed on two sets of seeds, of the first with what `--nulls` printed
after it. Of the first is what a diagnosis tells (sim/diagnose/record.cpp), the second checks it. Prints a table, as
Markdown, and writes reliability.svg into FOLDER.
"""
import math
import pathlib
import re
import sys

BINS = (0.0, 15.0, 50.0, 500.0)  # those of record.cpp, divided further
EVIDENCE = re.compile(r"\[ahead by (-?[\d.]+|inf)(, wrong)?\]")
COLOUR = {"told": "#0072b2", "counted": "#d55e00"}


def names(text):
    """(ahead, right) of each name that no other does as well as."""
    found = []
    for line in text.splitlines():
        evidence = EVIDENCE.findall(line)
        said = re.split(r" \+ ", line[:line.find("[ahead")]) if evidence else []
        for (ahead, wrong), name in zip(evidence, said[-len(evidence):]):
            if " (or " not in name:
                found.append((float(ahead), not wrong))
    return found


def shares(found):
    """Right and all, in each bin."""
    counts = []
    for low, high in zip(BINS, BINS[1:] + (math.inf,)):
        right = [is_right for ahead, is_right in found if low <= ahead < high or ahead == high == math.inf]
        counts.append((sum(right), len(right)))
    return counts


def interval(right, of, z=1.96):
    """95 % (Wilson 1927)."""
    share, all_ = right / of, 1.0 + z * z / of
    middle = share + z * z / (2.0 * of)
    half = z * math.sqrt(share * (1.0 - share) / of + z * z / (4.0 * of * of))
    return max(0.0, middle - half) / all_, min(1.0, (middle + half) / all_)


def title(i):
    if i + 1 == len(BINS):
        return f"{BINS[i]:g} or more"
    return f"{BINS[i]:g} to {BINS[i + 1]:g}" if i else f"less than {BINS[1]:g}"


def picture(rows):
    """Each bin a column, in it both shares with their intervals."""
    left, column, top, height = 60, 130, 40, 240
    def y(share):
        return top + height * (1.0 - share)
    right = left + column * len(BINS)
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {right + 20} {top + height + 60}" '
           'font-family="sans-serif" font-size="12">', '<rect width="100%" height="100%" fill="#fff"/>']
    for i, (kind, colour) in enumerate(COLOUR.items()):
        out.append(f'<circle cx="{left + 90 * i + 5}" cy="16" r="5" fill="{colour}"/>'
                   f'<text x="{left + 90 * i + 15}" y="20">{kind}</text>')
    for share in (0.0, 0.25, 0.5, 0.75, 1.0):
        out.append(f'<path d="M{left} {y(share):.1f}H{right}" stroke="#ddd"/>'
                   f'<text x="{left - 8}" y="{y(share) + 4:.1f}" text-anchor="end">{100 * share:g} %</text>')
    for i in range(len(BINS)):
        middle = left + column * (i + 0.5)
        out.append(f'<text x="{middle}" y="{top + height + 20}" text-anchor="middle">{title(i)}</text>')
        for (kind, colour), shift in zip(COLOUR.items(), (-24, 24)):
            count, of = rows[kind][i]
            if of == 0:
                continue
            low, high = interval(count, of)
            x = middle + shift
            out.append(f'<path d="M{x} {y(low):.1f}V{y(high):.1f}" stroke="{colour}" stroke-width="2"/>'
                       f'<circle cx="{x}" cy="{y(count / of):.1f}" r="5" fill="{colour}"/>'
                       f'<text x="{x}" y="{top + height + 36}" text-anchor="middle" fill="{colour}">{count}/{of}</text>')
    out.append(f'<text x="{(left + right) / 2}" y="{top + height + 54}" text-anchor="middle">'
               'ahead of the next, in misfit</text>')
    return "\n".join(out + ["</svg>"]) + "\n"


def main():
    told, counted, folder = (pathlib.Path(word) for word in sys.argv[1:])
    rows = {"told": shares(names(told.read_text())), "counted": shares(names(counted.read_text()))}
    print("| ahead by | told | counted |\n|---|---|---|")
    for i in range(len(BINS)):
        print(f"| {title(i)} | " + " | ".join(f"{rows[kind][i][0]} of {rows[kind][i][1]}" for kind in COLOUR) + " |")
    (folder / "reliability.svg").write_text(picture(rows))


main()
