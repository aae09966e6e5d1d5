"""Which operations of a program are worth a fault, by the letters that faults.cpp has logged of them."""


def telling(letters):
    """First and last of each kind of operation, and those before, at and after an exchange of folders; from 1 on."""
    told = {find(kind) for kind in set(letters) for find in (letters.index, letters.rindex)}
    told |= {n + beside for n, kind in enumerate(letters) if kind == "x" for beside in (-1, 0, 1)}
    return sorted(n + 1 for n in told if 0 <= n < len(letters))
