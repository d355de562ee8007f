# SPDX-License-Identifier: BSD-3-Clause
"""Contact forces and joint torques together: one answer, from one motion, that shows itself."""

from __future__ import annotations

from pathlib import Path

import pytest

from forcetorque.calibration.calibrate import calibrate_sensor
from forcetorque.evaluation.commands import validate
from forcetorque.evaluation.validation.contact_force_errors import contact_forces
from forcetorque.evaluation.validation.validation import Validation, joint_torques
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.seen_and_outside_samples import sentences
from forcetorque.experiment.sensor_run import SensorRun
from tests.scenes.experiments import PARQUET, TWO, add

SHORT = '\n[[interval]]\nlabel = "blink"\nstart_s = 23.6\nend_s = 23.9\nuse = "validation"\nsupport = "base"\n'
"""An interval that ends within its first second."""


def _fitted(run: SensorRun) -> Calibration:
    return calibrate_sensor(run, code_version="test", created="test")


def test_it_joins_contact_forces_and_joint_torques(arm: Path) -> None:
    """The rows of both, who is best, and what either leaves out, each once, under the name of the sensor."""
    run = SensorRun(load_experiment(add(arm / PARQUET, SHORT)), "arm_ft")
    calibrations = {"new": _fitted(run)}
    validation = validate(run, calibrations)
    forces, (torques, not_estimated) = contact_forces(run, calibrations), joint_torques(run, calibrations)
    assert [row.flat() for row in validation.contact_forces] == [row.flat() for row in forces.verdicts]
    assert [row.flat() for row in validation.joint_torques] == [row.flat() for row in torques]
    assert validation.best == forces.best
    assert {best.best for best in validation.best} == {"new"}
    (words,) = forces.left_out
    assert validation.left_out == (f"arm_ft: {words}",)
    assert [row.calibration for row in validation.validity] == ["new"]
    assert validation.warnings == (*sentences(validation.validity), f"left out: arm_ft: {words}")
    assert not_estimated == (words,)


@pytest.mark.long
def test_nobody_is_best_among_equals(arm: Path) -> None:
    """Two of one kind are both better than the prior, and no different; alone there is nothing to be better than."""
    run = SensorRun(load_experiment(arm / PARQUET), "arm_ft")
    first = _fitted(run)
    for best in validate(run, {"a": first, "b": first}).best:
        judgements = {row.other: row.conclusion for row in best.comparisons}
        (prior,) = judgements.keys() - {"a", "b"}
        assert judgements == {prior: "better", "b": "no difference"}
        assert (best.by_magnitude, best.conclusion, best.best) == ("a", "no difference", None)
        assert f"offset {best.offset}: none is best; " in best.sentence
        assert "with b (no difference: the same in every sample)" in best.sentence
    for best in validate(run, {}).best:
        assert (best.best, best.conclusion, best.comparisons) == (None, None, ())


@pytest.mark.long
def test_the_motion_of_an_interval_is_computed_once(arm: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """However many candidates; negative control: another sensor has instants of its own, and its own motion."""
    experiment = load_experiment(arm / TWO)
    run = SensorRun(experiment, "arm_ft")
    first = _fitted(run)
    spans: list[int] = []

    motion_at = SensorRun.motion_at

    def counted(*args: object, **how: object) -> object:
        spans.append(1)
        return motion_at(*args, **how)  # type: ignore[arg-type]

    monkeypatch.setattr(SensorRun, "motion_at", counted)
    validate(run, {"a": first, "b": first, "c": first, "d": first})
    assert len(spans) == 1
    validate(SensorRun(experiment, "tool_ft"), {})
    assert len(spans) == 2


def test_several_sensors_are_put_together(arm: Path) -> None:
    """Rows one after the other; what is left out names its sensor."""
    experiment = load_experiment(add(arm / TWO, SHORT))
    one, other = (validate(SensorRun(experiment, name), {}) for name in ("arm_ft", "tool_ft"))
    both = Validation.together([one, other])
    assert both.contact_forces == one.contact_forces + other.contact_forces
    assert [row.sensor for row in both.best] == ["arm_ft"] * 2 + ["tool_ft"] * 2
    assert [words.split(":")[0] for words in both.left_out] == ["arm_ft", "tool_ft"]


@pytest.mark.long
def test_it_shows_itself(arm: Path) -> None:
    """On a narrow screen no number is folded; a page has the tables, and one line says what it is."""
    run = SensorRun(load_experiment(arm / PARQUET), "arm_ft")
    calibrations = {"new": _fitted(run)}
    validation = validate(run, calibrations)
    text, page = validation.text(60), validation._repr_html_()
    assert all(len(line) <= 60 for line in text.splitlines())
    assert len(repr(validation)) < 600
    assert (len(validation.contact_forces), len(validation.joint_torques)) == (4, 12)
    for row in validation.contact_forces:
        half_width = row.force_mean_half_width_95_N
        known = half_width is not None and round(half_width, 2) <= round(row.force_mean_N, 2)
        assert f"{row.force_mean_N:.2f} ±{f'{half_width:.2f}' if known else '?'}" in text
        assert f">{row.moment_mean_Nm:.3f}</td>" in page
    for torque in validation.joint_torques:
        assert f"{torque.rmse:.3f} ±{torque.rmse_half_width_95:.3f}" in text
        assert f">{torque.largest:.3f}</td>" in page
