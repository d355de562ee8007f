# SPDX-License-Identifier: BSD-3-Clause
"""Known loads: workbench and payload as one estimation problem.

    reading = T(mount) sign [m a + alpha x h + w x (w x h); h x a + I alpha + w x I w] + bias_p + drift_p (t - t_p)

in power-up p, with the load's mass m, first moment h and inertia I about the sensor's origin. Which of these are known
is said by the `Load`; `solve` gives the others, with intervals, and names what the rows leave open.
"""

from __future__ import annotations

from dataclasses import dataclass

from forcetorque.arrays import FloatArray, read_only
from forcetorque.errors import FitError, known_names
from forcetorque.loads.load import Load
from forcetorque.loads.rows import LoadRows
from forcetorque.spatial import MeasureDirection


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class LoadProblem:
    """What was read under which loads, and what is to be estimated beside them."""

    rows: LoadRows
    """Readings and motion."""
    loads: tuple[Load, ...]
    """Loads, by their number in the rows."""
    sessions: tuple[str, ...]
    """Names of the power-ups, by their number in the rows; each has its own bias."""
    blocks: tuple[str, ...]
    """Names of the intervals or series, by their number in the rows."""
    direction: MeasureDirection
    """Who acts on whom in the reading; the load is the child."""
    drift: bool | None = None
    """Whether the bias of a session moves evenly in time; None to let held-out rows choose."""
    mount: bool = False
    """Whether the sensor is turned against the axes of the motion by an unknown rotation."""
    tilt: bool = False
    """Whether the world is tilted against gravity by an unknown angle; needs the orientation of the rows."""
    matrix_prior: FloatArray | None = None
    """Covariance of each row of the response `1 + E` to loads about 1, where the matrix is known in part; shape
    (6, 6, 6); N or N m per N, N m; None where it is exact."""
    slope: tuple[FloatArray, ...] = ()
    """By how much the logarithm of the density falls with mass, first moment and inertia of every load, beside what
    rows and priors say; shapes (10,); none if left out. `settled` finds it where the matrix is known in part."""
    variables: tuple[str, ...] = ()
    """Names and units of the variables of the rows, such as `temperature (degC)`."""

    def __post_init__(self) -> None:
        if self.matrix_prior is not None:
            object.__setattr__(self, "matrix_prior", read_only(self.matrix_prior, name="matrix_prior", shape=(6, 6, 6)))
        names = [load.name for load in self.loads]
        if len(set(names)) < len(names):
            raise FitError(f"loads: expected names that differ, got {', '.join(names)}")
        for field, known in (("load", self.loads), ("session", self.sessions), ("block", self.blocks)):
            number = getattr(self.rows, field)
            if len(number) and not 0 <= number.min() <= number.max() < len(known):
                raise FitError(f"rows: {field}: expected numbers from 0 to {len(known) - 1}, got {number.max()}")
        if len(self.variables) != (0 if self.rows.variables is None else self.rows.variables.shape[1]):
            raise FitError(f"variables: expected a name for each of the rows, got {len(self.variables)}")
        if self.tilt and self.rows.orientation is None:
            raise FitError("tilt: expected the orientation of the rows, got gravity alone; state an orientation stream")

    def load(self, name: str) -> Load:
        """Find a load.

        Args:
            name: Its name.

        Returns:
            The load.

        Raises:
            FitError: If there is none of that name.
        """
        for load in self.loads:
            if load.name == name:
                return load
        raise FitError(f"no load {name!r}; {known_names(name, [load.name for load in self.loads])}")
