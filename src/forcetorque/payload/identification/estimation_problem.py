# SPDX-License-Identifier: BSD-3-Clause
"""The estimation problem: loads known in part, samples and power cycles, of one or several recordings."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, Literal

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray, array, check_arrays, names, read_only
from forcetorque.base.errors import FitError, known_names
from forcetorque.base.wrench import MeasureDirection


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class LoadRows:
    """n readings of one sensor, means or still poses, in the order in which they were taken."""

    wrench: FloatArray = field(metadata=array("n", 6))
    """Readings as wrenches in the sensor's frame and direction; shape (n, 6); N, N m."""
    proper_acceleration: FloatArray = field(metadata=array("n", 3))
    """Of the sensor's origin along its axes, `-g` where it is still; shape (n, 3); m/s2."""
    angular_velocity_products: FloatArray | None = field(default=None, metadata=array("n", 3, 3))
    """Products `w w'` of the angular velocity w along the sensor's axes, as means over each row, because products of
    means lose what varies within a row; shape (n, 3, 3); rad2/s2; None where it stands still or turns slowly."""
    angular_acceleration: FloatArray | None = field(default=None, metadata=array("n", 3))
    """Along the sensor's axes; shape (n, 3); rad/s2; given if the products of the angular velocity are."""
    time_s: FloatArray | None = field(default=None, metadata=array("n"))
    """Instants, not falling within a session; shape (n,); s; None for poses without instants, whose noise is taken for
    independent: their order counts for drift only."""
    session: IntArray = field(metadata=array("n", dtype="int"))
    """Number of the power-up of each row; shape (n,)."""
    block: IntArray = field(metadata=array("n", dtype="int"))
    """Number of the interval or series of each row, within which the bias is surely one; shape (n,)."""
    load: IntArray = field(metadata=array("n", dtype="int"))
    """Number of the load on the sensor; shape (n,)."""
    share: FloatArray = field(metadata=array("n"))
    """Samples in each row over the usual number; shape (n,)."""
    columns: FloatArray | None = field(default=None, metadata=array("n", 6, 10))
    """What a unit of mass (kg), first moment (kg m) and inertia (xx, yy, zz, xy, xz, yz; kg m2) about the origin of the
    load's own frame adds to the wrench that moves it, in the sensor's frame, as means over each row; shape (n, 6, 10);
    None where the load's frame is the sensor's, so that the motion of each row tells it."""
    known: FloatArray | None = field(default=None, metadata=array("n", 6))
    """What the sensor reads of bodies beyond it that are no load, such as links of a robot; shape (n, 6); N, N m."""
    variables: FloatArray | None = field(default=None, metadata=array("n", None))
    """Temperatures, or whatever else moves the bias linearly; shape (n, v)."""
    orientation: FloatArray | None = field(default=None, metadata=array("n", 3, 3))
    """`world_R_sensor`, z of the world up; shape (n, 3, 3); None where only gravity was logged."""
    names: tuple[str, ...] = field(metadata=names("n"))
    """Where each row is from, such as `poses 17`; n words."""

    def __post_init__(self) -> None:
        check_arrays(self)
        if (self.angular_velocity_products is None) != (self.angular_acceleration is None):
            raise FitError("angular velocity and angular_acceleration: expected both or neither")
        self._require_finite()

    def __len__(self) -> int:
        return len(self.wrench)

    def moved(self, values: FloatArray) -> FloatArray:
        """Take values from their mean in each power-up, in which the bias is one.

        Args:
            values: Of the rows; shape (n, k).

        Returns:
            What changes within power-ups; shape (n, k).
        """
        moved = values.copy()
        for session in np.unique(self.session):
            mine = self.session == session
            moved[mine] -= moved[mine].mean(axis=0)
        return moved

    def _require_finite(self) -> None:
        for key in (
            "wrench",
            "proper_acceleration",
            "angular_velocity_products",
            "angular_acceleration",
            "variables",
        ):
            values = getattr(self, key)
            if values is None:
                continue
            lacking = ~np.isfinite(values).all(axis=tuple(range(1, values.ndim)))
            if lacking.any():
                first = int(np.flatnonzero(lacking)[0])
                raise FitError(
                    f"{key}: row {self.names[first]!r} has a value that is no finite number ({int(lacking.sum())} "
                    "such rows); leave these rows out, or mend the log"
                )

    @classmethod
    def of_poses(
        cls,
        wrench: Any,
        proper_acceleration: Any,
        *,
        angular_velocity: Any = None,
        session: Sequence[int] | None = None,
        **others: Any,
    ) -> LoadRows:
        """Take still poses, or any rows that are counted alike.

        Args:
            wrench: As of the class.
            proper_acceleration: As of the class.
            angular_velocity: Of rows that are single instants, along the sensor's axes; shape (n, 3); rad/s; None of
                poses that are still.
            session: As of the class; one for all if left out.
            others: As of the class; blocks are the sessions, the load is the first, rows are numbered from 1.

        Returns:
            The rows.
        """
        n = len(np.asarray(wrench))
        number = np.zeros(n, dtype=np.int64) if session is None else np.asarray(session)
        default: dict[str, Any] = {
            "block": number,
            "load": np.zeros(n, dtype=np.int64),
            "share": np.ones(n),
            "names": tuple(f"row {k}" for k in range(1, n + 1)),
        }
        if angular_velocity is not None:
            velocity = read_only(angular_velocity, name="angular_velocity", shape=(n, 3))
            default["angular_velocity_products"] = velocity[:, :, None] * velocity[:, None, :]
        return cls(wrench=wrench, proper_acceleration=proper_acceleration, session=number, **(default | others))


INERTIAL = 10
"""Inertial parameters: mass, first moment (3), and xx, yy, zz, xy, xz, yz of the inertia about an origin."""
_ROUNDING = 1e-9
"""kg m2: a stated inertia may be as far from symmetric."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Load:
    """What hangs on a sensor in some of the rows."""

    name: str
    """Name, unique in the problem."""
    mass: float | None = None
    """Mass; kg; None where it is to be estimated; 0 for the bare sensor."""
    centre_of_mass: FloatArray | None = None
    """Position in the load's frame, the sensor's unless rows have `columns`; shape (3,); m; None where it is to be
    estimated."""
    inertia: FloatArray | Literal["unknown"] | None = None
    """About the centre of mass, along the same axes; shape (3, 3); kg m2; None for a point mass; `unknown` where it is
    to be estimated, for which the load must be turned with changing speed."""
    expected: FloatArray | None = None
    """What is to be estimated, as it is known before the rows: mass, first moment, and inertia (xx, yy, zz, xy, xz, yz)
    about the origin of the load's frame; shape (10,); kg, kg m, kg m2; None where nothing is known."""
    precision: FloatArray | None = None
    """How well: inverse of its covariance, zero along what is not known; shape (10, 10); given if `expected` is."""

    def __post_init__(self) -> None:
        if self.mass is not None and not (np.isfinite(self.mass) and self.mass >= 0.0):
            raise FitError(
                f"load {self.name!r}: mass: expected a finite number of at least 0 kg, got {self.mass!r}; "
                "leave it out to estimate it"
            )
        if self.centre_of_mass is not None:
            centre = read_only(self.centre_of_mass, name=f"load {self.name!r}: centre_of_mass", shape=(3,))
            object.__setattr__(self, "centre_of_mass", centre)
        if self.inertia is not None and not isinstance(self.inertia, str):
            inertia = read_only(self.inertia, name=f"load {self.name!r}: inertia", shape=(3, 3))
            if not np.allclose(inertia, inertia.T, atol=_ROUNDING):
                raise FitError(f"load {self.name!r}: inertia: expected a symmetric matrix, got {inertia.tolist()}")
            object.__setattr__(self, "inertia", inertia)
        if (self.expected is None) != (self.precision is None):
            raise FitError(f"load {self.name!r}: expected and precision: expected both or neither")
        if self.expected is None or self.precision is None:
            return
        if self.is_known:
            raise FitError(f"load {self.name!r}: expected: it is stated already; leave out what is known in part only")
        for key, shape in (("expected", (INERTIAL,)), ("precision", (INERTIAL, INERTIAL))):
            values = read_only(getattr(self, key), name=f"load {self.name!r}: {key}", shape=shape)
            object.__setattr__(self, key, values)

    @property
    def is_known(self) -> bool:
        """Whether nothing of it is left to be estimated."""
        stated = self.mass is not None and self.centre_of_mass is not None and not isinstance(self.inertia, str)
        return stated or self.mass == 0.0


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
    matrix_prior: FloatArray | None = field(default=None, metadata=array(6, 6, 6))
    """Covariance of each row of the response `1 + E` to loads about 1, where the matrix is known in part; shape
    (6, 6, 6); N or N m per N, N m; None where it is exact."""
    slope: tuple[FloatArray, ...] = ()
    """By how much the logarithm of the density falls with mass, first moment and inertia of every load, beside what
    rows and priors say; shapes (10,); none if left out. `settled` finds it where the matrix is known in part."""
    variables: tuple[str, ...] = ()
    """Names and units of the variables of the rows, such as `temperature (degC)`."""

    def __post_init__(self) -> None:
        check_arrays(self)
        load_names = [load.name for load in self.loads]
        if len(set(load_names)) < len(load_names):
            raise FitError(f"loads: expected names that differ, got {', '.join(load_names)}")
        for numbered, known in (("load", self.loads), ("session", self.sessions), ("block", self.blocks)):
            number = getattr(self.rows, numbered)
            if len(number) and not 0 <= number.min() <= number.max() < len(known):
                raise FitError(f"rows: {numbered}: expected numbers from 0 to {len(known) - 1}, got {number.max()}")
        if len(self.variables) != (0 if self.rows.variables is None else self.rows.variables.shape[1]):
            raise FitError(f"variables: expected a name for each of the rows, got {len(self.variables)}")
        if self.tilt and self.rows.orientation is None:
            raise FitError("tilt: expected the orientation of the rows, got gravity alone; state an orientation stream")

    def load(self, name: str) -> Load:
        """Find a load.

        Returns:
            The load.

        Raises:
            FitError: If there is none of that name.
        """
        for load in self.loads:
            if load.name == name:
                return load
        raise FitError(f"no load {name!r}; {known_names(name, [load.name for load in self.loads])}")


_OPTIONAL = (
    "angular_velocity_products",
    "angular_acceleration",
    "columns",
    "known",
    "time_s",
    "variables",
    "orientation",
)


def together(problems: Mapping[str, LoadProblem]) -> LoadProblem:
    """Join problems with the same loads.

    Args:
        problems: Problems by the name of their recording, at least one.

    Returns:
        The problem of all rows; names of sessions, intervals and rows begin with those of their recordings.

    Raises:
        FitError: If loads, direction or variables differ.
    """
    names, parts = list(problems), list(problems.values())
    if len(parts) == 1:
        return parts[0]
    first = parts[0]
    for name, problem in problems.items():
        if not _alike(first, problem):
            raise FitError(
                f"{name}: expected the loads, measure_direction, drift, mount, tilt and variables of {names[0]}, got "
                "others; state them alike to weigh recordings together"
            )
    sessions, blocks = ([len(getattr(problem, field)) for problem in parts] for field in ("sessions", "blocks"))
    lengths = [len(problem.rows) for problem in parts]
    rows = LoadRows(
        wrench=np.concatenate([problem.rows.wrench for problem in parts]),
        proper_acceleration=np.concatenate([problem.rows.proper_acceleration for problem in parts]),
        session=_shifted([problem.rows.session for problem in parts], sessions),
        block=_shifted([problem.rows.block for problem in parts], blocks),
        load=np.concatenate([problem.rows.load for problem in parts]),
        share=np.concatenate([problem.rows.share for problem in parts]),
        names=tuple(f"{name}: {row}" for name, problem in problems.items() for row in problem.rows.names),
        **{field: _optional([problem.rows for problem in parts], field, lengths) for field in _OPTIONAL},
    )
    return replace(
        first,
        rows=rows,
        sessions=tuple(_named(name, own) for name, problem in problems.items() for own in problem.sessions),
        blocks=tuple(f"{name}: {own}" for name, problem in problems.items() for own in problem.blocks),
        tilt=first.tilt and rows.orientation is not None,
    )


def _named(recording: str, session: str) -> str:
    return session if session == recording else f"{recording}: {session}"


def _alike(first: LoadProblem, other: LoadProblem) -> bool:
    def stated(problem: LoadProblem) -> tuple[object, ...]:
        loads = tuple(
            (
                load.name,
                load.mass,
                None if load.centre_of_mass is None else tuple(load.centre_of_mass),
                str(load.inertia),
            )
            for load in problem.loads
        )
        return loads, problem.direction, problem.drift, problem.mount, problem.tilt, problem.variables

    return stated(first) == stated(other)


def _shifted(numbers: list[np.ndarray], counts: list[int]) -> np.ndarray:
    starts = np.cumsum([0, *counts[:-1]])
    return np.concatenate([own + start for own, start in zip(numbers, starts, strict=True)])


def _optional(rows: list[LoadRows], field: str, lengths: list[int]) -> np.ndarray | None:
    """Values of a field; zeros for a motion that was slow in some of the recordings, none where they are needed."""
    values = [getattr(own, field) for own in rows]
    if all(value is None for value in values):
        return None
    if field.startswith("angular"):
        values = [np.zeros((n, 3)) if value is None else value for value, n in zip(values, lengths, strict=True)]
    return None if any(value is None for value in values) else np.concatenate(values)
