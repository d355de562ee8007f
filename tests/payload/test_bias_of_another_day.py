# SPDX-License-Identifier: BSD-3-Clause
"""The interval of a bias does not hold on another day, and the answer of `payload` says so."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.payload.answers import payload_answers
from forcetorque.payload.identify import weigh_load
from forcetorque.payload.result import WeighedLoad

EXAMPLES = Path(__file__).parents[2] / "examples"
RUNS = {"1-baseline": (0.5, 5.2), "2-vibrations": (0.6, 5.0), "3-vibrations-contact": (0.5, 5.2)}
"""Runs, the last of another day, with the seconds between which they are shaken or touch something."""


def _weighed(example: str, data_dir: Path, folder: Path) -> WeighedLoad:
    path = folder / example
    text = (EXAMPLES / example).read_text(encoding="utf-8")
    path.write_text(text.replace("../../shared/data", data_dir.as_posix()))
    experiment = load_experiment(path)
    return weigh_load(SensorRun(experiment, experiment.sensors[0]))


def _why(weighed: WeighedLoad) -> str:
    (answer,) = payload_answers(weighed)
    return "\n".join(answer.why)


@pytest.mark.long
@pytest.mark.real_data
def test_one_recording_does_not_know_the_bias_of_another_day(data_dir: Path, tmp_path: Path) -> None:
    """Intervals from poses hold few of the biases that three runs have under the same load."""
    weighed = _weighed("07_wrist_payload.toml", data_dir, tmp_path)
    (load,), (session,) = weighed.loads, weighed.sessions
    bias, half_width = (np.array(values, dtype=float) for values in (session.bias, session.bias_half_width_95))
    folder = data_dir / "ati_gamma_kuka_med14_skrede"
    others = []
    for run, (first, last) in RUNS.items():
        wrench, turn = (
            np.loadtxt(folder / f"{run}_{kind}.csv", delimiter=",", skiprows=1) for kind in ("wrench", "orientations")
        )
        down = np.column_stack([np.interp(wrench[:, 0], turn[:, 0], -9.82085 * turn[:, k]) for k in (7, 8, 9)])
        weight = load.mass_kg * down
        free = wrench[:, 1:] - np.hstack([weight, np.cross(np.array(load.centre_of_mass_m, dtype=float), weight)])
        seconds = 1e-6 * (wrench[:, 0] - wrench[0, 0])
        others.append(free[(seconds < first) | (seconds > last)].mean(axis=0))
    held = np.abs(np.array(others) - bias) <= half_width
    assert (np.count_nonzero(held), held.size) == (4, 18)
    assert others[1][2] - others[2][2] == pytest.approx(0.4, abs=0.05)  # fz, from one day to the other
    assert "holds in this recording, not on another day" in _why(weighed)
    assert "tare before use" in _why(weighed)


@pytest.mark.real_data
def test_power_cycles_say_by_how_much_they_moved_the_bias(data_dir: Path, tmp_path: Path) -> None:
    """An Axia80 before and after its bias jumped."""
    why = _why(_weighed("26_wrist_base_frame.toml", data_dir, tmp_path))
    assert "power cycles moved the bias by up to 1.4 N" in why
    assert "tare before use" in why
