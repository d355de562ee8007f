# SPDX-License-Identifier: BSD-3-Clause
"""Tables from counts to pressure, 256 numbers for each taxel, also as text for robots."""

from __future__ import annotations

import io
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, IntArray, read_only, read_only_integers, require_last_axis
from forcetorque.base.errors import ShapeError, SkinError
from forcetorque.base.files import write_bytes_atomically
from forcetorque.skin.messages import require_counts

ROWS = 256
"""Counts below rest that a table has, from 0 on."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PressureTable:
    """Pressure of every taxel of one patch by its counts below rest."""

    patch: str
    """Patch."""
    serial: str | None = None
    """Serial number of the patch, if it has one."""
    columns: int
    """Numbers in one message of counts."""
    taxels: IntArray
    """Column of each taxel, increasing; shape (n,)."""
    live: BoolArray
    """Whether the taxel has a table; shape (n,)."""
    values: FloatArray
    """Pressure at 0 to 255 counts below rest; shape (256, n); Pa; 0 where the taxel is not live."""
    range_counts: FloatArray
    """Fall beyond which the table is extrapolated; shape (n,); counts."""
    error: FloatArray
    """Standard deviation of the table while loading; shape (n,); Pa."""
    hysteresis: FloatArray
    """How much more the same pressure reads while unloading; shape (n,); Pa."""

    def __post_init__(self) -> None:
        taxels = read_only_integers(self.taxels, name="taxels", shape=(None,))
        n = len(taxels)
        live = np.array(self.live, dtype=bool)
        live.setflags(write=False)
        if live.shape != (n,):
            raise ShapeError(f"live: expected shape ({n},), got {live.shape}")
        if n and not 0 <= int(taxels.min()) <= int(taxels.max()) < self.columns:
            raise ShapeError(
                f"taxels: expected columns of 0 to {self.columns - 1}, got {taxels.min()} to {taxels.max()}"
            )
        object.__setattr__(self, "taxels", taxels)
        object.__setattr__(self, "live", live)
        object.__setattr__(self, "values", read_only(self.values, name="values", shape=(ROWS, n)))
        for name in ("range_counts", "error", "hysteresis"):
            object.__setattr__(self, name, read_only(getattr(self, name), name=name, shape=(n,)))

    def __len__(self) -> int:
        return len(self.taxels)

    def fall(self, counts: Any, rest: Any) -> FloatArray:
        """Give how far the taxels are below rest.

        Args:
            counts: Messages; shape (..., columns); counts.
            rest: Counts of one message at rest; shape (columns,); of this power-up, as rest moves.

        Returns:
            Counts below rest; shape (..., n).

        Raises:
            ShapeError: If a message has another number of counts.
            SkinError: If a message is all zero or has gaps.
        """
        message = np.asarray(counts, dtype=np.float64)
        level = np.asarray(rest, dtype=np.float64)
        where = f"patch {self.patch!r}"
        for name, array in (("counts", message), ("rest", level)):
            require_last_axis(array, name=f"{where}: {name}", length=self.columns)
        chosen = message[..., self.taxels]
        require_counts(chosen, where=where)
        return level[self.taxels] - chosen

    def pressures(self, counts: Any, rest: Any) -> FloatArray:
        """Turn counts into pressures; between whole counts, as means have them, the table is interpolated.

        Args:
            counts: As of `fall`.
            rest: As of `fall`.

        Returns:
            Pressures; shape (..., n); Pa; 0 above rest, and where a taxel is not live.
        """
        return self.look_up(self.fall(counts, rest))[0]

    def look_up(self, fall: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Give the pressures of taxels, and how steeply they rise there.

        Args:
            fall: Counts below rest; shape (..., n).

        Returns:
            Pressures, and pressures by count; shape (..., n) each; Pa.
        """
        place = np.minimum(np.maximum(fall, 0.0), ROWS - 1.0)
        row = np.minimum(place.astype(np.int64), ROWS - 2)
        # one index into all values is twice as fast as a row and a column
        number = len(self.taxels)
        index = row * number + np.arange(number)
        values = self.values.reshape(-1)
        below = values.take(index)
        slope: FloatArray = values.take(index + number) - below
        pressure: FloatArray = below + (place - row) * slope
        return pressure, slope

    def beyond_range(self, counts: Any, rest: Any) -> BoolArray:
        """Tell which taxels read more than was fitted, so that their pressure is extrapolated.

        Args:
            counts: As of `fall`.
            rest: As of `fall`.

        Returns:
            Whether each does; shape (..., n).
        """
        return self.live & (self.fall(counts, rest) > self.range_counts)

    def falls(self) -> BoolArray:
        """Tell which tables fall anywhere: there a higher pressure reads as a lower one.

        Returns:
            Whether each does; shape (n,).
        """
        return np.any(np.diff(self.values, axis=0) < 0.0, axis=0)

    def require_patch(self, patch: str, *, columns: int, serial: str | None = None) -> None:
        """Refuse counts of another patch.

        Args:
            patch: Name of the patch that the counts are of.
            columns: Numbers in one of its messages.
            serial: Its serial number, if it has one.

        Raises:
            SkinError: If it is another one.
        """
        own = (self.patch, self.columns, self.serial)
        if (patch, columns, serial) != own:
            names = ("name", "columns", "serial")
            differ = [
                f"{name} {other!r} for {mine!r}"
                for name, mine, other in zip(names, own, (patch, columns, serial), strict=True)
                if mine != other
            ]
            raise SkinError(
                f"table of patch {self.patch!r}: expected counts of that patch, got {', '.join(differ)}; every patch "
                "has its own table"
            )


HEADINGS = ("taxel", "counts_below_rest", "pressure_Pa", "beyond_range")
"""Columns of the text."""


def write_pressure_table(path: Path | str, table: PressureTable) -> None:
    """Write the tables of all live taxels as CSV; on any error the file keeps what it held before.

    Args:
        path: File to write or to replace, in an existing folder.
        table: The tables.
    """
    text = io.StringIO()
    text.write(",".join(HEADINGS) + "\n")
    for k in np.flatnonzero(table.live):
        for fall, pressure in enumerate(table.values[:, k].tolist()):
            text.write(f"{table.taxels[k]},{fall},{pressure:.6g},{int(fall > table.range_counts[k])}\n")
    write_bytes_atomically(Path(path), text.getvalue().encode())
