# SPDX-License-Identifier: BSD-3-Clause
"""The `PatchCalibration`, what a calibration of taxels leaves on disk, and its tables from counts to pressure."""

from __future__ import annotations

import io
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated, Any, Final, Literal

import numpy as np
from pydantic import ConfigDict, Field, model_validator

from forcetorque.base.arrays import (
    ArrayField,
    ArrayRecord,
    BoolArray,
    FloatArray,
    IntArray,
    array,
    check_arrays,
    require_last_axis,
)
from forcetorque.base.errors import FormatError, ShapeError, SkinError
from forcetorque.base.output_file import write_bytes_atomically
from forcetorque.base.stored_table import StoredTable, read_json, validated_table, write_stored_table
from forcetorque.skin.taxels.taxel_curve import CurveKind, TaxelCurve
from forcetorque.skin.taxels.taxel_faults import require_counts
from forcetorque.skin.temperature.taxel_temperature_drift import WarmUp

ROWS = 256
"""Counts below rest that a table has, from 0 on."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PressureTable(ArrayRecord):
    """Pressure of every taxel of one patch by its counts below rest."""

    patch: str
    """Patch."""
    serial: str | None = None
    """Serial number of the patch, if it has one."""
    columns: int
    """Numbers in one message of counts."""
    taxels: IntArray = field(metadata=array("n", dtype="int"))
    """Column of each taxel, increasing; shape (n,)."""
    live: BoolArray = field(metadata=array("n", dtype="bool"))
    """Whether the taxel has a table; shape (n,)."""
    values: FloatArray = field(metadata=array(ROWS, "n"))
    """Pressure at 0 to 255 counts below rest; shape (256, n); Pa; 0 where the taxel is not live."""
    range_counts: FloatArray = field(metadata=array("n"))
    """Fall beyond which the table is extrapolated; shape (n,); counts."""
    error: FloatArray = field(metadata=array("n"))
    """Standard deviation of the table while loading; shape (n,); Pa."""
    hysteresis: FloatArray = field(metadata=array("n"))
    """How much more the same pressure reads while unloading; shape (n,); Pa."""

    def __post_init__(self) -> None:
        check_arrays(self)
        if len(self) and not 0 <= int(self.taxels.min()) <= int(self.taxels.max()) < self.columns:
            raise ShapeError(
                f"taxels: expected columns of 0 to {self.columns - 1}, got {self.taxels.min()} to {self.taxels.max()}"
            )

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
        for name, values in (("counts", message), ("rest", level)):
            require_last_axis(values, name=f"{where}: {name}", length=self.columns)
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
        """Find the taxels beyond the fitted range, whose pressure is extrapolated.

        Args:
            counts: As of `fall`.
            rest: As of `fall`.

        Returns:
            Whether each does; shape (..., n).
        """
        return self.live & (self.fall(counts, rest) > self.range_counts)

    def falls(self) -> BoolArray:
        """Find the tables that fall anywhere: there a higher pressure reads as a lower one.

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


SCHEMA: Final = "forcetorque/taxels/1"
"""Name and version of the file's form."""


class CalibratedTaxel(StoredTable):
    """One taxel: its curve and what that is worth, or why it has none."""

    taxel: int = Field(ge=0)
    """Column of the taxel."""
    left_out: tuple[str, ...] = ()
    """What was wrong with it in the recordings that were fitted; nothing for a valid one."""
    coefficients: Annotated[FloatArray, ArrayField((None,))] | None = None
    """Coefficients of its curve; None for one that was left out."""
    range_counts: float | None = Field(default=None, gt=0.0)
    """Fall at the highest fitted pressure; counts."""
    rmse_pa: float | None = None
    """Root mean square error on the fitted samples; Pa."""
    error_pa: float | None = None
    """Error of the curve while loading, without noise; Pa."""
    hysteresis_pa: float | None = None
    """How much more the same pressure reads while unloading; Pa."""
    hysteresis_share: float | None = None
    """The same as a share of the range."""

    @model_validator(mode="after")
    def _has_a_curve_or_a_reason(self) -> CalibratedTaxel:
        numbers = (self.coefficients, self.range_counts, self.rmse_pa, self.error_pa, self.hysteresis_pa)
        missing = [number is None for number in numbers]
        if any(missing) and (not all(missing) or not self.left_out):
            raise ValueError("expected a curve with its errors, or why there is none")
        return self


class PatchProvenance(StoredTable):
    """What the curves were fitted to."""

    code_version: str
    """Version of this library."""
    created: str
    """Date and time of the fit, ISO 8601, UTC."""
    experiments: tuple[str, ...]
    """Names of the experiments."""
    intervals: tuple[str, ...]
    """Labels of the fitted intervals."""
    samples: int = Field(ge=0)
    """Number of fitted messages."""
    inputs_sha256: dict[str, str]
    """SHA-256 of every input file, by its experiment and its path as the experiment file names it."""


class PatchCalibration(StoredTable):
    """Curves of the taxels of one patch."""

    model_config = ConfigDict(
        defer_build=True, extra="forbid", frozen=True, arbitrary_types_allowed=True, populate_by_name=True
    )

    schema_name: Literal["forcetorque/taxels/1"] = Field(default=SCHEMA, alias="schema")
    """Form of the file."""
    patch: str
    """Name of the patch."""
    serial: str | None = None
    """Its serial number, if it has one."""
    columns: int = Field(ge=1)
    """Numbers in one message of its counts."""
    curve: CurveKind
    """Form of the curves."""
    highest_pa: float = Field(gt=0.0)
    """Highest pressure above rest that was fitted; Pa."""
    taxels: tuple[CalibratedTaxel, ...]
    """Taxels in the order of their columns."""
    provenance: PatchProvenance
    """What the curves were fitted to."""
    warm_up: WarmUp | None = None
    """How its taxels follow its thermal pads; None if that was not learned."""

    @model_validator(mode="after")
    def _warm_up_of_its_taxels(self) -> PatchCalibration:
        if self.warm_up is not None and len(self.warm_up.taxels) != len(self.taxels):
            raise ValueError("expected as many taxels in warm_up as in taxels")
        return self

    def __repr__(self) -> str:
        sound = sum(taxel.coefficients is not None for taxel in self.taxels)
        return f"<PatchCalibration of {self.patch}: {self.curve}, {sound} of {len(self.taxels)} taxels>"

    __str__ = __repr__

    def table(self) -> PressureTable:
        """Evaluate the curves at every count below rest.

        Returns:
            The tables; taxels that were left out are not live.
        """
        curves = [self.taxel_curve(k) for k in range(len(self.taxels))]
        fall = np.arange(float(ROWS))
        zero = np.zeros(ROWS)
        return PressureTable(
            patch=self.patch,
            serial=self.serial,
            columns=self.columns,
            taxels=np.array([taxel.taxel for taxel in self.taxels]),
            live=np.array([curve is not None for curve in curves]),
            values=np.stack([zero if curve is None else curve.pressure(fall) for curve in curves], axis=1),
            range_counts=np.array([taxel.range_counts or 0.0 for taxel in self.taxels]),
            error=np.array([taxel.error_pa or 0.0 for taxel in self.taxels]),
            hysteresis=np.array([taxel.hysteresis_pa or 0.0 for taxel in self.taxels]),
        )

    def taxel_curve(self, k: int) -> TaxelCurve | None:
        """Give the curve of a taxel.

        Args:
            k: Place of the taxel in `taxels`.

        Returns:
            Its curve; None if it was left out.
        """
        taxel = self.taxels[k]
        if taxel.coefficients is None or taxel.range_counts is None:
            return None
        return TaxelCurve(kind=self.curve, coefficients=taxel.coefficients, range_counts=taxel.range_counts)

    def save(self, path: Path | str, *, force: bool = False) -> None:
        """Write the calibration as JSON; on any error the file keeps what it held before.

        Args:
            path: File to write or to replace, in an existing folder.
            force: Whether a file that is neither a result nor a figure may be replaced; an input never is.

        Raises:
            OutputError: If the file is an input of it, or a file that `force` is needed for.
        """
        write_stored_table(path, self, inputs_sha256=self.provenance.inputs_sha256.values(), force=force, indent=2)


def read_patch_calibration(path: Path | str) -> PatchCalibration:
    """Read a calibration of taxels that `PatchCalibration.save` wrote.

    Args:
        path: JSON file.

    Returns:
        The calibration.

    Raises:
        FormatError: If it is not a calibration of taxels of this schema version.
    """
    file = Path(path)
    content = read_json(file, expected="a calibration of taxels, there is none; `forcetorque skin calibrate` makes one")
    schema = content.get("schema") if isinstance(content, dict) else None
    if schema != SCHEMA:
        raise FormatError(f"{file}: expected the schema {SCHEMA!r}, got {schema!r}; calibrate again with this version")
    return validated_table(file, PatchCalibration, content)
