# SPDX-License-Identifier: BSD-3-Clause
"""What was fitted is known by its readings, where stamps or names say something else."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.errors import ExperimentError
from forcetorque.calibration.calibrate import calibrate_sensor
from forcetorque.evaluation.commands import evaluate
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.recording.recording import Recording
from forcetorque.recording.storage import read_recording, write_recording
from forcetorque.recording.stream import Stream
from tests.cases import some_cases
from tests.scenes.experiments import PARQUET, edit

FITTED = "was fitted on the interval 'fit', which overlaps the validation interval 'judge'"
RNG = np.random.default_rng(5)


def _run(folder: Path) -> SensorRun:
    return SensorRun(load_experiment(folder / PARQUET), "arm_ft")


def _fitted(folder: Path) -> Calibration:
    return calibrate_sensor(_run(folder), code_version="0", created="2026-01-01T00:00:00+00:00")


def _written_again(folder: Path, change: Callable[[Stream], Stream]) -> None:
    """The recording with other streams, in place of the one that there is."""
    recording: Recording = read_recording(folder / "recording")
    streams = {name: change(stream) for name, stream in recording.streams.items()}
    write_recording(folder / "again", replace(recording, streams=streams))
    edit(folder / PARQUET, 'path = "recording"', 'path = "again"')


def _from_zero(stream: Stream, *, cut: int = 0) -> Stream:
    """A log that counts from its start."""
    first = 1_700_000_000 * 10**9
    signals = {name: replace(signal, values=signal.values[cut:]) for name, signal in stream.signals.items()}
    sequence = None if stream.sequence is None else stream.sequence[cut:]
    return replace(stream, stamp_ns=stream.stamp_ns[cut:] - first, signals=signals, sequence=sequence)


def _with_other_noise(stream: Stream) -> Stream:
    signals = {
        name: replace(signal, values=signal.values + 4.0 * RNG.normal(size=signal.values.shape))
        if name == "raw"
        else signal
        for name, signal in stream.signals.items()
    }
    return replace(stream, signals=signals)


@pytest.mark.long
def test_fitted_readings_are_known_under_other_stamps_and_names(arm: Path) -> None:
    """Of a log that was exported again, with stamps from another origin, cut, and under another name."""
    fitted = _fitted(arm)
    _written_again(arm, lambda stream: _from_zero(stream, cut=300))
    file = edit(arm / PARQUET, 'name = "small arm"', 'name = "another"')
    edit(file, "start_s = 14.5\nend_s = 23.5", "start_s = 5.0\nend_s = 7.0")
    edit(file, "start_s = 0.5\nend_s = 14.0", "start_s = 9.0\nend_s = 17.0")
    with pytest.raises(ExperimentError, match=FITTED):
        evaluate(_run(arm), {"new": fitted})
    edit(file, "start_s = 9.0\nend_s = 17.0", "start_s = 0.5\nend_s = 8.0")
    edit(file, "start_s = 5.0\nend_s = 7.0", "start_s = 8.6\nend_s = 17.0")
    assert evaluate(_run(arm), {"new": fitted}).verdicts


@some_cases("from_zero", [True, False])
def test_other_readings_with_the_same_stamps_were_not_fitted(arm: Path, from_zero: bool) -> None:
    """Where logs count from their start, as with a rate; a time of day that is the same is the same log."""
    if from_zero:
        _written_again(arm, _from_zero)
        edit(arm / PARQUET, 'path = "again"', 'path = "recording"')
        (arm / "recording").rename(arm / "first")
        (arm / "again").rename(arm / "recording")
    fitted = _fitted(arm)
    _written_again(arm, _with_other_noise)
    file = edit(arm / PARQUET, "start_s = 14.5\nend_s = 23.5", "start_s = 5.0\nend_s = 13.0")
    edit(file, "start_s = 0.5\nend_s = 14.0", "start_s = 14.0\nend_s = 17.0")
    if from_zero:
        assert evaluate(_run(arm), {"new": fitted}).verdicts
    else:
        with pytest.raises(ExperimentError, match=FITTED):
            evaluate(_run(arm), {"new": fitted})
