# SPDX-License-Identifier: BSD-3-Clause
"""Short recordings that are reduced in segments, as long ones are, and streams that do not last as long."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace

import numpy as np
import pytest

from forcetorque.experiment.experiment import Experiment

SEGMENT_S = 5.9
"""Length of the segments."""


@contextmanager
def short_segments(length_s: float = SEGMENT_S) -> Iterator[None]:
    """Make segments short, with 2.4 s around them, of no sample beside these, cut at whole seconds.

    Args:
        length_s: Length of a segment; s.
    """
    long_recording = "forcetorque.experiment.long_recording"
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("forcetorque.recording.segments.BLOCK_NS", 10**9)
        patch.setattr("forcetorque.recording.segments._SHORT", 0)
        patch.setattr(f"{long_recording}._LEAST_MARGIN_S", 0.0)
        patch.setattr(f"{long_recording}._WINDOWS", 0.6)
        patch.setattr(f"{long_recording}.SEGMENT_S", length_s)
        yield


def within(experiment: Experiment, name: str, start_s: float, end_s: float) -> Experiment:
    """Leave out what a stream holds before and after these seconds of the recording."""
    recording = experiment.recording
    stream = recording.stream(name)
    rows = slice(*np.searchsorted(stream.stamp_ns, recording.start_ns + np.array([start_s, end_s]) * 1e9))
    signals = {key: replace(signal, values=signal.values[rows]) for key, signal in stream.signals.items()}
    short = replace(stream, stamp_ns=stream.stamp_ns[rows], signals=signals, sequence=None)
    return replace(experiment, recording=replace(recording, streams={**recording.streams, name: short}))
