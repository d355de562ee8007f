# SPDX-License-Identifier: BSD-3-Clause
"""Known loads on a bench, as wrenches and as tables of weights."""

from __future__ import annotations

import csv
import re
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from importlib import resources
from pathlib import Path
from typing import Any, Final

import numpy as np

from forcetorque.base.arrays import ArrayRecord, BoolArray, FloatArray, array, check_arrays, names, read_only
from forcetorque.base.errors import FormatError, SensorError, ShapeError, UnitError, require_known
from forcetorque.base.input_file import read_text
from forcetorque.base.units import parsed_number
from forcetorque.base.wrench import MeasureDirection, reading_sign
from forcetorque.experiment.workbench_file import THESIS_TABLE

LONGEST_LEVER_M = 10.0
"""No weight of a bench is farther from the sensor: its position was typed in another unit."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Weights(ArrayRecord):
    """Weights at n positions, one at a time."""

    mass_kg: FloatArray = field(metadata=array("n"))
    """Mass of the weight without the structure; shape (n,); kg."""
    structure_kg: FloatArray = field(metadata=array("n"))
    """Mass of the mounting structure that hangs there too; shape (n,); kg."""
    position_m: FloatArray = field(metadata=array("n", 3))
    """Where the load acts, in the sensor's frame; shape (n, 3); m."""
    direction: FloatArray = field(metadata=array("n", 3))
    """Where gravity points in the sensor's frame, normalised to length 1; shape (n, 3)."""
    gravity: float
    """Magnitude of gravity; m/s2."""

    def __post_init__(self) -> None:
        check_arrays(self)
        for name in ("mass_kg", "structure_kg", "position_m", "direction"):
            values = getattr(self, name)
            if not np.isfinite(values).all():
                row = int(np.argwhere(~np.isfinite(values))[0, 0])
                raise SensorError(f"weight {row + 1}: {name}: expected finite numbers, got {values[row]}")
        _require_weights(self)
        unit = self.direction / np.linalg.norm(self.direction, axis=1, keepdims=True)
        object.__setattr__(self, "direction", read_only(unit, name="direction", shape=(None, 3)))

    @property
    def total_kg(self) -> FloatArray:
        """Mass of weight and structure; shape (n,); kg."""
        return self.mass_kg + self.structure_kg

    def wrench(self, *, measure_direction: MeasureDirection) -> FloatArray:
        """Compute what a sensor measures of each weight: force along gravity, moment `position x force`.

        Args:
            measure_direction: Who acts on whom in the measurement; the load is the child.

        Returns:
            Wrenches in the sensor's frame, about its origin; shape (n, 6); N, N m.
        """
        force = self.gravity * self.total_kg[:, None] * self.direction
        acting = np.hstack([force, np.cross(self.position_m, force)])
        return -reading_sign(measure_direction, child_is_outboard=True) * acting


def _require_weights(weights: Weights) -> None:
    if not 0.0 < weights.gravity < np.inf:
        raise SensorError(f"gravity: expected a number above 0 m/s2, got {weights.gravity:g}")
    levers = np.linalg.norm(weights.position_m, axis=1)
    lengths = np.linalg.norm(weights.direction, axis=1)
    for k, (mass, structure) in enumerate(zip(weights.mass_kg, weights.structure_kg, strict=True)):
        where = f"weight {k + 1}"
        if not mass > 0.0:
            raise SensorError(f"{where}: expected a mass above 0 kg, got {mass:g}; a block without a weight is bias")
        if structure < 0.0:
            raise SensorError(f"{where}: expected a structure of at least 0 kg, got {structure:g}")
        if levers[k] > LONGEST_LEVER_M:
            raise SensorError(
                f"{where}: expected a position within {LONGEST_LEVER_M:g} m of the sensor, got {levers[k]:g} m; "
                "is it in mm? State the unit in the heading"
            )
        if not lengths[k] > 0.0:
            raise SensorError(f"{where}: expected a direction of gravity, got {weights.direction[k].tolist()}")


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class BenchLoads(ArrayRecord):
    """Known wrenches on a sensor at n positions."""

    names: tuple[str, ...] = field(metadata=names("n"))
    """Name of every position, unique."""
    wrench: FloatArray = field(metadata=array("n", 6))
    """Wrenches in the sensor's frame and direction; shape (n, 6); N, N m; NaN where a component is not known."""
    series: tuple[str, ...]
    """Series of every position: positions of one series are set up together."""
    weights: Weights | None = None
    """Geometry that the wrenches come from; None where wrenches were specified."""
    named: str = "position"
    """What a name denotes: `position`, or `line` of a table."""

    def __post_init__(self) -> None:
        check_arrays(self)
        n = len(self.names)
        if len(set(self.names)) < n:
            twice = next(name for name in self.names if self.names.count(name) > 1)
            raise SensorError(f"loads: expected every name once, got {twice!r} again")
        if len(self.series) != n or (self.weights is not None and len(self.weights.mass_kg) != n):
            raise ShapeError(f"loads: expected {n} series and weights, as many as names")

    def __len__(self) -> int:
        return len(self.names)

    @classmethod
    def of_weights(
        cls, names: Sequence[str], weights: Weights, *, measure_direction: MeasureDirection, series: Sequence[str] = ()
    ) -> BenchLoads:
        """Compute the loads of weights.

        Args:
            names: Name of every position.
            weights: The weights.
            measure_direction: Who acts on whom in the measurement; the load is the child.
            series: Series of every position; one for all if left out.

        Returns:
            The loads.
        """
        return cls(
            names=tuple(names),
            wrench=weights.wrench(measure_direction=measure_direction),
            series=tuple(series) or ("all",) * len(names),
            weights=weights,
        )

    @property
    def known(self) -> BoolArray:
        """Whether all six components of a position are known; shape (n,)."""
        return np.asarray(np.isfinite(self.wrench).all(axis=1), dtype=np.bool_)

    def select(self, positions: Any) -> BenchLoads:
        """Select positions.

        Args:
            positions: Indices of the positions; shape (k,).

        Returns:
            Their loads.
        """
        indices = np.asarray(positions, dtype=np.int64)
        weights = self.weights
        if weights is not None:
            weights = replace(
                weights,
                mass_kg=weights.mass_kg[indices],
                structure_kg=weights.structure_kg[indices],
                position_m=weights.position_m[indices],
                direction=weights.direction[indices],
            )
        return BenchLoads(
            names=tuple(self.names[k] for k in indices),
            wrench=self.wrench[indices],
            series=tuple(self.series[k] for k in indices),
            weights=weights,
            named=self.named,
        )


_MASS_UNITS: Final = {"kg": 1.0, "g": 1e-3}
_LENGTH_UNITS: Final = {"m": 1.0, "mm": 1e-3, "cm": 1e-2}
_DIRECTION: Final = ("dx", "dy", "dz")
_GRAVITY: Final = re.compile(r"^# *gravity_m_per_s2 *: *(\S+) *$", re.MULTILINE)


def read_loads(source: Path | str, *, measure_direction: MeasureDirection) -> BenchLoads:
    """Read a table of weights: `# gravity_m_per_s2: 9.81`, a heading, and a row per position.

    The heading has `name`, `mass_kg`, `x_m y_m z_m`, `dx dy dz` (where gravity points in the sensor's frame), and may
    have `structure_kg` and `series`; masses may be in g, positions in mm or cm, one unit for all three.

    Args:
        source: File, or `thesis-6.1` for the bundled table.
        measure_direction: Who acts on whom in the measurement; the load is the child.

    Returns:
        The loads.

    Raises:
        MissingFileError: If there is no such file.
        FormatError: If a line is not of this form.
    """
    if str(source) == THESIS_TABLE:
        where, text = "Table 6.1", resources.files("forcetorque.workbench").joinpath("table_6_1.csv").read_text("utf-8")
    else:
        where, text = str(source), read_text(Path(source), f"a table of loads, or {THESIS_TABLE!r} for the bundled one")
    gravity = _GRAVITY.search(text)
    if gravity is None:
        raise FormatError(f"{where}: expected a line `# gravity_m_per_s2: 9.81` above the heading, got none")
    return LoadTable(where, text).loads(_number(f"{where}: gravity_m_per_s2", gravity[1]), measure_direction)


class LoadTable:
    """Rows of a table below its heading."""

    def __init__(self, where: str, text: str) -> None:
        """Divide a text into fields without the spaces around them.

        Args:
            where: File, for messages.
            text: Its text; lines that begin with # are comments.

        Raises:
            FormatError: If there is no row, or one has another number of fields than the heading.
        """
        self._where = where
        rows = [
            (line, [cell.strip() for cell in next(csv.reader([content]))])
            for line, content in enumerate(text.splitlines(), start=1)
            if content.strip() and not content.startswith("#")
        ]
        if len(rows) < 2:
            raise FormatError(f"{where}: expected a heading and a row per position, got {len(rows)} lines")
        (self._heading_line, self._heading), self._rows = rows[0], rows[1:]
        for line, cells in self._rows:
            if len(cells) != len(self._heading):
                raise FormatError(f"{where}:{line}: expected {len(self._heading)} fields, got {len(cells)}")

    def loads(self, gravity: float, measure_direction: MeasureDirection) -> BenchLoads:
        """Compute the loads.

        Args:
            gravity: Magnitude of gravity; m/s2.
            measure_direction: Who acts on whom in the measurement; the load is the child.

        Returns:
            The loads.

        Raises:
            UnitError: If x, y and z have several units.
        """
        mass, kilograms = self._with_unit("mass", _MASS_UNITS)
        structure = self._with_unit("structure", _MASS_UNITS, optional=True)
        axes = [self._with_unit(axis, _LENGTH_UNITS) for axis in "xyz"]
        if len({factor for _, factor in axes}) > 1:
            raise UnitError(
                f"{self._where}:{self._heading_line}: expected x, y and z in one unit, got "
                f"{', '.join(name for name, _ in axes)}"
            )
        weights = Weights(
            mass_kg=kilograms * self.column(mass),
            structure_kg=structure[1] * self.column(structure[0]) if structure[0] else np.zeros(len(self._rows)),
            position_m=axes[0][1] * np.column_stack([self.column(name) for name, _ in axes]),
            direction=np.column_stack([self.column(name) for name in _DIRECTION]),
            gravity=gravity,
        )
        series = self._cells("series") if "series" in self._heading else ()
        return BenchLoads.of_weights(self._cells("name"), weights, measure_direction=measure_direction, series=series)

    def _with_unit(self, name: str, units: dict[str, float], *, optional: bool = False) -> tuple[str, float]:
        headings = [heading for heading in self._heading if heading.startswith(f"{name}_")]
        if optional and not headings:
            return "", 1.0
        unit = headings[0].removeprefix(f"{name}_") if len(headings) == 1 else ""
        if unit not in units:
            raise UnitError(
                f"{self._where}:{self._heading_line}: expected one column {' or '.join(f'{name}_{u}' for u in units)}, "
                f"got {', '.join(headings) or 'none'}"
            )
        return headings[0], units[unit]

    def _cells(self, name: str) -> list[str]:
        require_known(
            name, self._heading, FormatError, f"{self._where}:{self._heading_line}: expected a column {name!r}"
        )
        index = self._heading.index(name)
        return [cells[index] for _, cells in self._rows]

    def column(self, name: str) -> np.ndarray[tuple[int], np.dtype[np.float64]]:
        """Read a column of numbers.

        Args:
            name: Its heading.

        Returns:
            Finite numbers in the unit of the column; shape (n,).
        """
        cells = zip(self._rows, self._cells(name), strict=True)
        return np.array([_number(f"{self._where}:{line}: {name}", cell) for (line, _), cell in cells])


def _number(where: str, cell: str) -> float:
    number = parsed_number(cell)
    if not np.isfinite(number):
        raise FormatError(f"{where}: expected a finite number, got {cell!r}")
    return number
