# SPDX-License-Identifier: BSD-3-Clause
"""Spheres of the sensors of an experiment: which samples, which candidates, with or without the joints."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.errors import ExperimentError, SerialNumberError, UnitError
from forcetorque.calibration.calibrate import calibrate_sensor
from forcetorque.evaluation.sphere.sensor_sphere import SensorSphere, analyse_sphere, sphere_intervals
from forcetorque.evaluation.sphere.sphere import Spheres, spheres
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.recording.recording import Use
from tests.scenes.experiments import PARQUET, YARP, edit

ARM_MASS = 4.0
"""What the arm has beyond its sensor; kg."""
GRAVITY = 9.80665


@pytest.fixture(scope="module")
def experiment(intact: Path) -> Experiment:
    """The experiment with raw counts."""
    return load_experiment(intact / PARQUET)


@pytest.fixture(scope="module")
def fitted(experiment: Experiment) -> Calibration:
    """Its sensor, calibrated on the first interval."""
    return calibrate_sensor(SensorRun(experiment, experiment.sensors[0]), code_version="1", created="today")


def _answered(experiment: Experiment, names: list[str] | None, **calibrations: Calibration) -> Spheres:
    return spheres(SensorRun(experiment, experiment.sensors[0]), calibrations, names)


def _analysed(experiment: Experiment, names: list[str] | None, **calibrations: Calibration) -> tuple[SensorSphere, ...]:
    return _answered(experiment, names, **calibrations).analyses


def test_every_candidate_is_analysed_on_the_same_samples(experiment: Experiment, fitted: Calibration) -> None:
    """The prior comes first; its analysis is that of the samples read with the prior matrix."""
    prior, new = _analysed(experiment, ["judge"], new=fitted)
    assert [sphere.calibration for sphere in (prior, new)] == ["prior", "new"]
    assert prior.sensor == new.sensor == "arm_ft"
    (part,) = SensorRun(experiment, experiment.sensors[0]).samples(Use.VALIDATION)
    matrix = experiment.sensors[0].prior
    assert matrix is not None
    by_hand = analyse_sphere(part.raw @ matrix.T, part.samples.reference, gravity=GRAVITY, mass=ARM_MASS)
    assert prior.analysis.samples == new.analysis.samples == len(part.samples)
    assert prior.analysis.mapped is not None
    assert by_hand.mapped is not None
    np.testing.assert_allclose(prior.analysis.mapped.matrix, by_hand.mapped.matrix, atol=1e-12)
    np.testing.assert_allclose(prior.force, (part.raw @ matrix.T)[:, :3], atol=1e-12)
    np.testing.assert_allclose(prior.reference, part.samples.reference[:, :3])
    assert prior.no_model is None


def test_calibration_mends_the_index(experiment: Experiment, fitted: Calibration) -> None:
    """Before it axes differ by a kilogram, after it by ten grams; the mass is that of the model."""
    before, after = (sphere.analysis for sphere in _analysed(experiment, ["judge"], new=fitted))
    for analysis in (before, after):
        assert analysis.mass == pytest.approx(ARM_MASS, rel=1e-9)
        assert analysis.mapped is not None
        assert analysis.mapped.fit.identifiable
    assert before.mapped is not None
    assert after.mapped is not None
    assert before.mapped.fit.index / GRAVITY > 0.5
    assert after.mapped.fit.index / GRAVITY < 0.03
    masses = after.masses(after.mapped.fit)
    np.testing.assert_allclose(masses, ARM_MASS, atol=0.05)


@pytest.mark.long
def test_what_a_calibration_was_fitted_on_is_named(experiment: Experiment, fitted: Calibration) -> None:
    """It is not refused, since a grid is often all there is, but said."""
    assert [sphere.fitted_on for sphere in _analysed(experiment, None, new=fitted)] == [(), ("fit",)]
    assert [sphere.fitted_on for sphere in _analysed(experiment, ["judge"], new=fitted)] == [(), ()]


def test_what_flatters_is_a_warning_of_the_result(experiment: Experiment, fitted: Calibration) -> None:
    """A notebook gets it as the terminal does, once for all sensors that share it; nothing flatters, no warning."""
    result = _answered(experiment, None, new=fitted)
    assert result.warnings == ("new was fitted on 'fit', so the verdict on it flatters",)
    assert Spheres.together([result, result]).warnings == result.warnings
    assert _answered(experiment, ["judge"], new=fitted).warnings == ()


def test_the_result_shows_itself(experiment: Experiment, fitted: Calibration) -> None:
    """Every number whole in a narrow terminal, a table in a notebook, few words for `repr`; arrays in none."""
    result = _answered(experiment, ["judge"], new=fitted)
    text = result.text(60)
    for row in result.rows:
        for fit in (row.with_model, row.without_model):
            assert fit is not None
            assert fit.mass_kg is not None
            for mass, low, high in zip(fit.mass_kg, fit.mass_low_kg, fit.mass_high_kg, strict=True):
                assert f" {mass:.3f}" in text
                assert f"{low:.3f} to {'any' if high is None else f'{high:.3f}'}" in text
    assert max(map(len, text.splitlines())) <= 60
    assert result._repr_html_().count("<table ") == 3
    assert len(repr(result)) < 600
    assert result.analyses[0].analysis.samples == result.rows[0].samples
    assert "analyses" not in result.json_text()
    assert "analyses" not in Spheres.described()["properties"]


def test_masses_that_have_no_upper_end_are_empty_columns(experiment: Experiment) -> None:
    """Not words: three columns of a table of numbers, as where they have one."""
    (row,) = _answered(experiment, ["judge"]).rows
    assert row.without_model.mass_high_kg == (None, None, None)
    flat = row.flat()
    assert [flat[f"without_model_mass_high_{axis}_kg"] for axis in "xyz"] == [None] * 3
    assert "without_model_mass_high_kg" not in flat


def test_an_error_names_the_sensor_once(arm: Path, fitted: Calibration) -> None:
    """Whatever is wrong with it, wherever it was noticed: several sensors are analysed in one go."""
    experiment = load_experiment(edit(arm / PARQUET, 'serial = "SIM001"', 'serial = "SIM777"'))
    with pytest.raises(SerialNumberError, match=r"^sensor 'arm_ft': new: "):
        _analysed(experiment, None, new=fitted)


def test_intervals_are_chosen_by_label_or_kind_or_by_the_file(arm: Path) -> None:
    """A kind may stand for several; without words the file's sphere intervals are taken, else all."""
    path = edit(arm / PARQUET, 'label = "judge"', 'kind = "grid"\nlabel = "judge"')
    experiment = load_experiment(path)

    def labels(names: list[str] | None) -> list[str]:
        return [interval.label for interval in sphere_intervals(experiment, names)]

    assert labels(None) == ["fit", "judge"]
    assert labels(["grid"]) == labels(["judge"]) == labels(["judge", "grid"]) == ["judge"]
    assert labels(["grid", "fit"]) == ["fit", "judge"]
    with pytest.raises(ExperimentError, match="no interval to use has the label or kind 'gird'; did you mean"):
        labels(["gird"])
    with path.open("a") as stream:
        stream.write('\n[calibration]\noffset = "sphere"\nsphere_intervals = ["fit"]\n')
    experiment = load_experiment(path)
    assert labels(None) == ["fit"]


def test_ignored_intervals_are_not_used(arm: Path) -> None:
    """Where nothing is left, that is said."""
    path = edit(arm / PARQUET, 'use = "validation"', 'use = "ignore"')
    experiment = load_experiment(path)
    assert [interval.label for interval in sphere_intervals(experiment, None)] == ["fit"]
    with pytest.raises(ExperimentError, match="has the label or kind 'judge'; known: fit"):
        sphere_intervals(experiment, ["judge"])
    experiment = load_experiment(edit(path, 'use = "calibration"', 'use = "ignore"'))
    with pytest.raises(ExperimentError, match="expected an interval that is not to be ignored"):
        sphere_intervals(experiment, None)


def test_supports_on_both_sides_of_the_sensor_are_refused(arm: Path) -> None:
    """Held by its hand the arm hangs its base on the sensor, another mass; each side by itself is analysed."""
    path = arm / PARQUET
    head, _, judge = path.read_text(encoding="utf-8").rpartition("[[interval]]")
    swapped = judge.replace('support = "base"', 'support = "hand"')
    assert swapped != judge
    held = '[[support]]\nframe = "hand"\ngravity_direction = [0.0, 0.0, -1.0]\n\n[[interval]]'
    path.write_text(f"{head}{held}{swapped}", encoding="utf-8")
    experiment = load_experiment(path)
    (base,), (hand,) = (_analysed(experiment, [name]) for name in ("fit", "judge"))
    assert base.analysis.mass == pytest.approx(ARM_MASS)
    assert hand.analysis.mass is not None
    assert hand.analysis.mass != pytest.approx(ARM_MASS, rel=0.01)
    with pytest.raises(ExperimentError, match="expected the same mass on it in all intervals, got 4 kg in 'fit' and"):
        _analysed(experiment, None)


def test_without_joints_there_is_no_reference_and_still_a_mass(arm: Path) -> None:
    """The log of the arm's joints is missing one: the readings are the same, and the model's mass is known."""
    whole = load_experiment(arm / YARP)
    (with_joints,) = _analysed(whole, ["judge"])
    path = edit(
        arm / YARP,
        '\n[[recording.stream]]\nkind = "state_ext"\nname = "joints"\nport = "arm/stateExt:o"\n'
        'joints = ["shoulder_yaw", "shoulder_pitch", "shoulder_roll", "elbow", "wrist"]\n',
        "",
    )
    (without,) = _analysed(load_experiment(path), ["judge"])
    assert without.no_model == (
        "no stream holds the position of shoulder_yaw, shoulder_pitch, shoulder_roll, elbow, wrist"
    )
    assert (without.reference, without.analysis.mapped, without.analysis.moment) == (None, None, None)
    assert without.analysis.mass == pytest.approx(ARM_MASS, rel=1e-9)
    assert abs(without.analysis.samples - with_joints.analysis.samples) < 10
    assert without.analysis.free.ellipsoid is not None
    assert without.analysis.errors(without.analysis.free) is not None


def test_counts_of_a_stream_that_is_called_a_wrench_are_refused(arm: Path) -> None:
    """With `identity` for a matrix, readings of thousands are taken for what they are."""
    path = edit(arm / YARP, 'prior = "matrix_SIM001.txt"', 'prior = "identity"')
    log = arm / "log" / "arm_ft" / "analog:o" / "data.log"
    lines = []
    for line in log.read_text().splitlines():
        number, stamp, *values = line.split()
        lines.append(" ".join([number, stamp, *(f"{1000.0 * float(value):.6f}" for value in values)]))
    log.write_text("\n".join(lines) + "\n")
    with pytest.raises(UnitError, match="sensor 'arm_ft', prior: force: expected N, got values .* only be counts"):
        _analysed(load_experiment(path), ["judge"])


def test_raw_counts_need_a_matrix(arm: Path, fitted: Calibration) -> None:
    """Without a prior a calibration is enough, and nothing is not."""
    experiment = load_experiment(edit(arm / PARQUET, 'prior = "matrix_SIM001.txt"\n', ""))
    with pytest.raises(ExperimentError, match="raw counts become forces by a calibration or a prior matrix"):
        _analysed(experiment, None)
    (sphere,) = _analysed(experiment, ["judge"], new=fitted)
    assert sphere.calibration == "new"


def test_a_calibration_of_another_sensor_is_refused(arm: Path, fitted: Calibration) -> None:
    """By its serial number."""
    experiment = load_experiment(edit(arm / PARQUET, 'serial = "SIM001"', 'serial = "SIM777"'))
    with pytest.raises(SerialNumberError):
        _analysed(experiment, None, new=fitted)
