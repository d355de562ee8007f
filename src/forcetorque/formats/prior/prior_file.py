# SPDX-License-Identifier: BSD-3-Clause
"""Calibration of a sensor from a file of any form, in SI units, and the members that a form needs."""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import StrEnum
from pathlib import Path
from typing import Protocol

import numpy as np

from forcetorque.base.arrays import ArrayRecord, FloatArray, array, check_arrays
from forcetorque.base.errors import FormatError


class RawUnit(StrEnum):
    """What the channels are that a matrix takes."""

    COUNTS = "counts"
    VOLTS = "V"
    WRENCH = "N, N m"


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PriorFile(ArrayRecord):
    """A calibration that a sensor came with."""

    form: str
    """What the file is, as text."""
    matrix: FloatArray = field(metadata=array(6, None))
    """Matrix; rows fx to tz, columns the c channels; shape (6, c); N, N m per raw unit."""
    raw_unit: RawUnit
    """Unit of the channels."""
    offset: FloatArray | None = field(default=None, metadata=array(6))
    """What is added; shape (6,); N, N m; None where the form has none."""
    full_scale: FloatArray | None = field(default=None, metadata=array(6))
    """Full scale of fx to tz; shape (6,); N, N m; None where the form has none."""
    serial: str | None = None
    """Serial number of the sensor; None where the form has none."""
    date: str | None = None
    """When it was calibrated, as the file writes it; None where it does not."""
    notes: tuple[str, ...] = ()
    """What else is to be known of it."""

    def __post_init__(self) -> None:
        check_arrays(self)
        for name, values in (("offset", self.offset), ("full_scale", self.full_scale)):
            if values is not None and not np.isfinite(values).all():
                raise FormatError(f"{name}: expected finite numbers")
        if self.matrix.shape[1] < 1 or not np.isfinite(self.matrix).all():
            raise FormatError("matrix: expected finite numbers in at least one column")


class PriorFormat(Protocol):
    """A form of calibrations, recognised by the content of the file."""

    @property
    def sign(self) -> str:
        """What it is recognised by, for the message where nothing is."""

    def recognises(self, path: Path, text: str) -> bool:
        """Check whether a file is one.

        Args:
            path: File.
            text: Its content.

        Returns:
            Whether it is.
        """

    def read(self, path: Path, text: str) -> PriorFile:
        """Read a file.

        Args:
            path: File.
            text: Its content.

        Returns:
            Its content.

        Raises:
            FormatError: If it is damaged, or has content that is not known here.
        """
