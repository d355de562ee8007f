# SPDX-License-Identifier: BSD-3-Clause
"""Messages of a patch that cannot be read are refused by row and column, with what to do."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import SkinError
from forcetorque.recording.recording import Recording
from forcetorque.recording.stream import Signal, Stream
from forcetorque.skin.patches_of_experiment import ExperimentPatch, PatchExperiment
from forcetorque.skin.wrench.pressures_over_recording import patch_messages

MESSAGES, COLUMNS = 20, 12
PADS = (6, 10)
"""Columns that are no taxels."""


def _content(counts: FloatArray) -> PatchExperiment:
    columns = tuple(map(str, range(COLUMNS)))
    signal = Signal(quantity="taxel_counts", values=counts, columns=columns, units=("counts",) * COLUMNS)
    stamps = np.arange(MESSAGES, dtype=np.int64) * 20_000_000
    stream = Stream(name="skin", clock="board", stamp_ns=stamps, signals={"taxel_counts": signal})
    patch = ExperimentPatch(
        name="palm",
        serial=None,
        counts="skin",
        pressure=None,
        layout=None,
        link=None,
        columns=COLUMNS,
        taxels=np.setdiff1d(np.arange(COLUMNS), PADS),
    )
    return PatchExperiment(
        name="palm",
        file=Path("palm.toml"),
        recording=Recording(streams={"skin": stream}),
        patches=(patch,),
        intervals=(),
        inputs_sha256={},
    )


@pytest.mark.parametrize(
    ("rows", "column", "value", "words"),
    [
        (slice(None), 4, np.nan, r"columns 4 of 'skin': expected counts, got no number in any message; write 0"),
        (slice(7, 9), 4, np.nan, r"row 7 of 'skin': .* zeros or with gaps \(2 such of 20\)"),
        (slice(5, 6), slice(None), 0.0, r"row 5 of 'skin': expected counts, got a message of zeros"),
        (slice(3, 5), 11, 256.0, r"row 3, column 11 of 'skin': expected counts from 0 to 255, got 256 \(2 such\)"),
        (
            slice(3, 4),
            0,
            -1.0,
            r"row 3, column 0 of 'skin': expected counts from 0 to 255, got -1 \(1 such\): .*8 bits",
        ),
    ],
)
def test_what_no_taxel_can_read_is_refused(rows: slice, column: int | slice, value: float, words: str) -> None:
    """The first row and column of it, and how many there are."""
    counts = np.full((MESSAGES, COLUMNS), 240.0)
    counts[rows, column] = value
    content = _content(counts)
    with pytest.raises(SkinError, match=words):
        patch_messages(content, content.patches[0])


def test_both_ends_of_the_range_are_read() -> None:
    """They are what a broken taxel reads, which is left out later; a pad may read anything."""
    counts = np.full((MESSAGES, COLUMNS), 240.0)
    counts[:, 1], counts[:, 2], counts[:, PADS[0]] = 0.0, 255.0, 300.0
    content = _content(counts)
    _, read = patch_messages(content, content.patches[0])
    np.testing.assert_array_equal(read, counts)
