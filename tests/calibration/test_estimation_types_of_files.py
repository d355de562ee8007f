# SPDX-License-Identifier: BSD-3-Clause
"""Estimation types in the experiment file: by name or by plain options, and which intervals draw the sphere."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.errors import ExperimentError, FitError, FormatError
from forcetorque.calibration.calibrate import calibrate_sensor
from forcetorque.calibration.thesis.calibrate import sphere_centre
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.calibration.estimation_type import ESTIMATION_TYPES, EstimationType
from forcetorque.experiment.calibration.moments import Moments
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.recording.recording import Use
from tests.scenes.experiments import PARQUET, add, edit
from tests.scenes.warm_experiments import EXACT, TEMPERATURE, with_variables

LAMBDA = 6e4
"""counts2; enough to tell the types apart, which agree without a prior."""


def _fitted(experiment: Experiment, kind: EstimationType | None = None) -> Calibration:
    return calibrate_sensor(
        SensorRun(experiment, experiment.sensors[0]), code_version="1", created="now", regularisation=LAMBDA, kind=kind
    )


def _numbers(made: Calibration) -> list[object]:
    raw_offset = None if made.raw_offset_counts is None else made.raw_offset_counts.tolist()
    variables = [(v.coefficients.tolist(), v.reference_value) for v in made.variables]
    return [made.estimation_type, made.matrix.tolist(), made.offset.tolist(), variables, raw_offset]


def _with_calibration(file: Path, text: str) -> Experiment:
    """Load the experiment with a `[calibration]` table, which is taken out again."""
    before = file.read_text(encoding="utf-8")
    try:
        return load_experiment(add(file, f"\n[calibration]\n{text}\n"))
    finally:
        file.write_text(before, encoding="utf-8")


@pytest.mark.parametrize("name", ESTIMATION_TYPES)
def test_a_name_stands_for_its_plain_options(warm_log: Path, name: str) -> None:
    """By name, by options and asked for in the call a type is the same fit to the last bit, recorded by its name."""
    file, kind = with_variables(warm_log / PARQUET, TEMPERATURE), ESTIMATION_TYPES[name]
    words = [f'offset = "{kind.offset}"', f"with_variables = {str(kind.with_variables).lower()}"]
    words += [f"from_reference = {str(kind.from_reference).lower()}"]
    by_name = _fitted(_with_calibration(file, f'type = "{name}"'))
    by_options = _fitted(_with_calibration(file, "\n".join(words)))
    asked = _fitted(load_experiment(file), kind)
    assert by_name.estimation_type == name
    assert _numbers(by_name) == _numbers(by_options) == _numbers(asked)
    assert (by_name.raw_offset_counts is not None) is name.startswith("S")
    assert len(by_name.variables) == ("w" in name)


def test_the_types_are_different_fits(warm_log: Path) -> None:
    """Negative control: only centralised and one-shot agree, and only in what theorem 5.1 says."""
    experiment = load_experiment(with_variables(warm_log / PARQUET, TEMPERATURE))
    made = {name: _fitted(experiment, kind) for name, kind in ESTIMATION_TYPES.items()}
    names, scale = list(made), np.abs(made["OnTdTO"].matrix).max()
    same = {
        (a, b)
        for k, a in enumerate(names)
        for b in names[k + 1 :]
        if np.abs(made[a].matrix - made[b].matrix).max() < EXACT * scale
        and np.abs(made[a].offset - made[b].offset).max() < EXACT * np.abs(made[a].offset).max()
    }
    assert same == {("CnTdTO", "OnTdTO"), ("CwTdTO", "OwTdTO"), ("CwTrTO", "OwTrTO")}


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("", "OwTrTO"),
        ("with_variables = false", "OnTdTO"),
        ("from_reference = false", "OwTdTO"),
        ('offset = "sphere"', "SwTrTO"),
        ('offset = "centralised"\nfrom_reference = false', "CwTdTO"),
    ],
)
def test_what_the_options_leave_open_is_settled_by_the_sensor(warm_log: Path, text: str, expected: str) -> None:
    """One-shot is the default; variables are fitted from their reference value where the sensor has any."""
    file = with_variables(warm_log / PARQUET, TEMPERATURE)
    assert _fitted(_with_calibration(file, text)).estimation_type == expected
    plain = _with_calibration(edit(file, TEMPERATURE, ""), text)
    assert _fitted(plain).estimation_type == f"{expected[0]}nTdTO"


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ('type = "OwTrTO"\noffset = "one-shot"', "type stands for offset, with_variables and from_reference; give the"),
        ('type = "OwTrTO"\nwith_variables = true', "type stands for offset, with_variables and from_reference"),
        ('type = "OwTrTO"\nfrom_reference = false', "type stands for offset, with_variables and from_reference"),
        ('type = "OwTrT0"', r"calibration: no estimation type is called 'OwTrT0'; did you mean \"OwTrTO\"\?"),
        ('offset = "centralized"', r"calibration\.offset: .*'centralised'"),
        ("with_variables = false\nfrom_reference = true", "from_reference belongs to with_variables = true"),
        ("sphere_intervals = []", r"calibration\.sphere_intervals: "),
        ('tpye = "OwTrTO"', r"unknown key 'tpye'; did you mean \"type\""),
    ],
)
def test_contradicting_options_are_refused(warm_log: Path, text: str, message: str) -> None:
    """A type by name and by options at once, or one that does not exist, is an error of the file."""
    with pytest.raises(FormatError, match=message) as caught:
        _with_calibration(warm_log / PARQUET, text)
    assert str(caught.value).startswith(str(warm_log / PARQUET))


def _two_grids(file: Path) -> Path:
    """Divide the calibration interval in two."""
    second = 'end_s = 7.0\nuse = "calibration"\nsupport = "base"\n\n[[interval]]\nlabel = "fit_2"\nstart_s = 7.0\n'
    return edit(file, "end_s = 14.0\n", f"{second}end_s = 14.0\n")


def test_the_sphere_is_drawn_by_the_named_intervals(warm_log: Path) -> None:
    """The raw offset is that of the named grid alone, while all intervals are fitted."""
    file = _two_grids(with_variables(warm_log / PARQUET, TEMPERATURE))
    experiment = load_experiment(file)
    parts = {p.interval.label: p for p in SensorRun(experiment, experiment.sensors[0]).samples(Use.CALIBRATION)}
    assert list(parts) == ["fit", "fit_2"]
    centres = {label: sphere_centre(Moments.of(p.raw, p.samples.reference)) for label, p in parts.items()}
    for label in parts:
        made = _fitted(_with_calibration(file, f'type = "SwTrTO"\nsphere_intervals = ["{label}"]'))
        assert made.raw_offset_counts is not None
        np.testing.assert_allclose(made.raw_offset_counts, centres[label], rtol=1e-9)
        assert [i.label for i in made.provenance.intervals] == ["fit", "fit_2"]
        assert made.provenance.samples == sum(len(p.samples) for p in parts.values())
    assert not np.allclose(centres["fit"], centres["fit_2"], rtol=1e-3)
    both = _fitted(_with_calibration(file, 'type = "SwTrTO"\nsphere_intervals = ["fit", "fit_2"]'))
    (whole,) = SensorRun(load_experiment(_joined(file)), experiment.sensors[0]).samples(Use.CALIBRATION)
    assert both.raw_offset_counts is not None
    np.testing.assert_allclose(
        both.raw_offset_counts, sphere_centre(Moments.of(whole.raw, whole.samples.reference)), rtol=1e-9
    )


def _joined(file: Path) -> Path:
    text = file.read_text(encoding="utf-8")
    start, end = text.index("end_s = 7.0"), text.index("end_s = 14.0")
    file.write_text(text[:start] + text[end:], encoding="utf-8")
    return file


def test_nobody_guesses_which_of_several_grids_draws_the_sphere(warm_log: Path) -> None:
    """Without a name the intervals are listed with the key that names them; other types need none."""
    experiment = load_experiment(_two_grids(warm_log / PARQUET))
    with pytest.raises(FitError, match=r"out of fit, fit_2; in an experiment file they are sphere_intervals of \[cali"):
        _fitted(experiment, ESTIMATION_TYPES["SnTdTO"])
    assert _fitted(experiment, ESTIMATION_TYPES["CnTdTO"]).raw_offset_counts is None


@pytest.mark.parametrize("label", ["fti", "judge"])
def test_a_sphere_of_no_calibration_interval_is_refused(warm_log: Path, label: str) -> None:
    """A label that nothing has, or that of an interval for validation, is an error whatever the type."""
    with pytest.raises(
        ExperimentError, match=f"calibration: sphere_intervals: no calibration .* labelled '{label}'"
    ) as e:
        _with_calibration(warm_log / PARQUET, f'sphere_intervals = ["fit", "{label}"]')
    assert str(e.value).endswith("known: fit")
    assert _with_calibration(warm_log / PARQUET, 'sphere_intervals = ["fit"]').fit_options.sphere_intervals == ("fit",)
