# SPDX-License-Identifier: BSD-3-Clause
"""Matrix files of iCub as a form of priors."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from forcetorque.exchange.icub import read_matrix_file, serial_number_in_name
from forcetorque.exchange.prior.prior_file import PriorFile, RawUnit, StatedUnits

_CODES = 36
_MOST_CODES_LOOKED_AT, _FEWEST_CODES = 12, 10


class IcubMatrix:
    """Files `matrix_SN026.txt`: 36 codes of one to four hex digits a line, a gain, six full scales."""

    sign = "a matrix file of iCub (36 lines of hex)"

    def recognises(self, path: Path, text: str) -> bool:
        """Look for one number of hex digits a line; a short or damaged file is one too, by its name."""
        lines = text.split("\n")
        codes = [line.strip() for line in lines[:_MOST_CODES_LOOKED_AT]]
        # nearly all: what is wrong with one of them is said by its reader, line by line
        hex_only = sum(re.fullmatch("[0-9A-Fa-f]{1,4}", code) is not None for code in codes) >= _FEWEST_CODES
        return (hex_only and len(lines) > _CODES) or serial_number_in_name(path) is not None

    def read(self, path: Path, text: str, units: StatedUnits) -> PriorFile:
        """Read it."""
        file = read_matrix_file(path)
        return PriorFile(
            form="matrix file of iCub",
            matrix=file.matrix,
            raw_unit=RawUnit.COUNTS,
            full_scale=np.array(file.full_scale, dtype=np.float64),
            serial=serial_number_in_name(path),
        )
