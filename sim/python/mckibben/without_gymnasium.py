"""What Env and VectorEnv need of Gymnasium, where it is not installed."""
import enum

import numpy


class Base:
    """What Env has of Gymnasium's Env: chance, by a seed."""
    _np_random = None
    spec = None

    @property
    def np_random(self):
        """Where all chance comes from, a numpy.random.Generator."""
        if self._np_random is None:
            self._np_random = numpy.random.default_rng()
        return self._np_random

    @property
    def unwrapped(self):
        """Itself."""
        return self

    def reset(self, *, seed=None, options=None):
        if seed is not None:
            self._np_random = numpy.random.default_rng(seed)

    def __enter__(self):
        return self

    def __exit__(self, *error):
        self.close()


class Box:
    """Numbers between `low` and `high`: what there is of Gymnasium's Box here."""

    def __init__(self, low, high, dtype=numpy.float32):
        self.low = numpy.asarray(low, dtype)
        self.high = numpy.asarray(high, dtype)
        self.shape, self.dtype = self.low.shape, numpy.dtype(dtype)
        self._random = numpy.random.default_rng()

    def seed(self, seed=None):
        self._random = numpy.random.default_rng(seed)

    def sample(self):
        return self._random.uniform(self.low, self.high).astype(self.dtype)

    def contains(self, x):
        x = numpy.asarray(x)
        return x.shape == self.shape and bool(numpy.all((x >= self.low) & (x <= self.high)))

    def __contains__(self, x):
        return self.contains(x)

    def __eq__(self, other):
        return (isinstance(other, Box) and self.dtype == other.dtype and
                all(numpy.array_equal(*ends) for ends in ((self.low, other.low), (self.high, other.high))))

    def __repr__(self):
        low, high = (end.flat[0] if end.size and (end == end.flat[0]).all() else end
                     for end in (self.low, self.high))
        return f"Box({low}, {high}, {self.shape}, {self.dtype})"


class AutoresetMode(enum.Enum):
    """When a member whose episode has ended is reset, as Gymnasium 1.1 names it."""
    NEXT_STEP = "NextStep"
    SAME_STEP = "SameStep"
    DISABLED = "Disabled"
