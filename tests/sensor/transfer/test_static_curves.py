# SPDX-License-Identifier: BSD-3-Clause
"""Curves of all channels of a sensor by the loads of its recording: a bent channel is named, a straight one is not."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ExperimentError, FitError
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.recording.storage import read_recording, write_recording
from forcetorque.sensor.bandwidth.response import response
from forcetorque.sensor.figures import response_figure
from forcetorque.sensor.transfer.static_curves import FITTERS, channel_curve, static_curves
from tests.app.outcome import Run
from tests.cases import some_cases
from tests.scenes.experiments import PARQUET, write_experiments

QUICK = {name: FITTERS[name] for name in ("linear", "polynomial", "piecewise_linear", "spline")}
"""Without the network, which takes a second per channel."""
BENT = 2
"""Place of the channel that is bent."""


def _arm(folder: Path, bend: Callable[[FloatArray], FloatArray] | None = None) -> Path:
    write_experiments(folder)
    if bend is None:
        return folder / PARQUET
    recording = read_recording(folder / "recording")
    stream = recording.stream("arm_ft")
    values = np.array(stream.signal("raw").values)
    values[:, BENT] = bend(values[:, BENT])
    changed = replace(stream, signals={**stream.signals, "raw": replace(stream.signal("raw"), values=values)})
    shutil.rmtree(folder / "recording")
    write_recording(folder / "recording", replace(recording, streams={**recording.streams, "arm_ft": changed}))
    return folder / PARQUET


def _bow(counts: FloatArray) -> FloatArray:
    """Bend by a twentieth of the span at its middle."""
    middle, half = 0.5 * (counts.max() + counts.min()), 0.5 * np.ptp(counts)
    return counts + 0.1 * half * (1.0 - ((counts - middle) / half) ** 2)


def test_the_bent_channel_is_named(tmp_path: Path, run: Run) -> None:
    """Of six channels one is curved, by what it was bent, less what a line through it takes; without the bend none."""
    (tmp_path / "bent").mkdir()
    bent = SensorRun(load_experiment(_arm(tmp_path / "bent", _bow)), "arm_ft")
    curves = static_curves([bent], fitters=QUICK)
    assert len(curves) == 6
    assert [curve.curved for curve in curves] == [place == BENT for place in range(6)]
    assert 1.0 < curves[BENT].nonlinearity_percent < 6.0
    straight = static_curves([SensorRun(load_experiment(_arm(tmp_path)), "arm_ft")], fitters=QUICK)
    assert not any(curve.curved for curve in straight)
    assert straight[BENT].linear_rmse < 0.2 * curves[BENT].linear_rmse
    shown = run("bench", "response", tmp_path / "bent" / PARQUET, "-e", "static")
    assert f"CURVED: {curves[BENT].channel}" in shown.out


def test_sessions_keep_their_own_offsets(tmp_path: Path) -> None:
    """Of two power-ups with other offsets the bent channel is named, and no straight one."""
    runs = []
    for name, shift in (("first", 0.0), ("second", 3000.0)):
        (tmp_path / name).mkdir()
        file = _arm(tmp_path / name, lambda counts, shift=shift: _bow(counts) + shift)
        runs.append(SensorRun(load_experiment(file), "arm_ft"))
    curves = static_curves(runs, fitters=QUICK)
    assert [curve.curved for curve in curves] == [place == BENT for place in range(6)]
    assert curves[BENT].linear_rmse < 0.2 * 3000.0


@some_cases("noise", [3.0, 0.0])
def test_a_channel_that_the_load_does_not_move_gets_no_verdict(tmp_path: Path, run: Run, noise: float) -> None:
    """Whether it stands still or is noisy, and the answer says so."""
    rng = np.random.default_rng(3)
    file = _arm(tmp_path, lambda counts: np.rint(100.0 + noise * rng.normal(size=len(counts))))
    curves = static_curves([SensorRun(load_experiment(file), "arm_ft")], fitters=QUICK)
    assert [curve.curved for curve in curves] == [None if place == BENT else False for place in range(6)]
    assert curves[BENT].nonlinearity_percent is None
    if noise:
        assert f"NOT DETERMINED: {curves[BENT].channel}" in run("bench", "response", file, "-e", "static").out


def test_recordings_of_other_channels_are_refused(tmp_path: Path) -> None:
    """The same number of channels by other names."""
    first = SensorRun(load_experiment(_arm(tmp_path)), "arm_ft")
    signal = first.stream.signal("raw")
    stream = replace(first.stream, signals={"raw": replace(signal, columns=tuple("abcdef"))})
    recording = first.experiment.recording
    recording = replace(recording, streams={**recording.streams, "arm_ft": stream})
    other = SensorRun(replace(first.experiment, recording=recording), "arm_ft")
    with pytest.raises(ExperimentError, match=r"expected ch0 \(counts\), .*got a \(counts\)"):
        static_curves([first, other])


def test_what_static_curves_cannot_take_is_refused(tmp_path: Path) -> None:
    """A force, a picture, and a second of data."""
    arm = SensorRun(load_experiment(_arm(tmp_path)), "arm_ft")
    with pytest.raises(ExperimentError, match="static: the load is that which the experiment states"):
        response(arm, "static", force="hammer")
    interval = arm.experiment.recording.intervals[0]
    shown = response(arm, "static")
    with pytest.raises(ExperimentError, match="static curves have a table and no picture"):
        response_figure(shown)
    short = replace(interval, end_ns=interval.start_ns + 10**9)
    experiment = replace(arm.experiment, recording=arm.experiment.recording.with_intervals([short]))
    with pytest.raises(FitError, match="expected 40 points of 0.2 s at least, got"):
        static_curves([SensorRun(experiment, "arm_ft")])


def test_rates_of_both_errors() -> None:
    """Of 60 straight channels, half with slow noise, at most 3 count as curved; of 60 bent by 1 % at least 57 do.

    By the quick kinds; the rates of all kinds are in docs/measured.md.
    """
    rng = np.random.default_rng(21)
    load = np.sin(np.linspace(0.0, 12.0, 200))
    straight = bent = 0
    for draw in range(60):
        noise = 0.003 * rng.normal(size=200)
        if draw % 2:  # slow: a random walk that returns
            noise = np.convolve(noise, np.exp(-np.arange(40) / 8.0), mode="same")
        straight += _is_curved(load, load + noise)
        bent += _is_curved(load, load + 0.02 * load**2 + 0.003 * rng.normal(size=200))
    assert straight <= 3
    assert bent >= 57


def _is_curved(load: FloatArray, reading: FloatArray) -> bool:
    return channel_curve("ch0", "counts", load, reading, fitters=QUICK).curved is True
