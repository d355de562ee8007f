# SPDX-License-Identifier: BSD-3-Clause
"""Quadratic corrections on the command line: asked for, refused where they lose, and never exported as a matrix."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from forcetorque.calibration.export.formats import ExportFormat
from forcetorque.experiment.calibration.calibration_file import read_calibration, write_calibration
from forcetorque.experiment.calibration.quadratic_correction import QuadraticCorrection
from tests.app.json_schema import faults
from tests.app.outcome import Run
from tests.experiment.calibration.quadratic_sensor import correction_of_steepness
from tests.scenes.calibrations import make_calibration, make_variable
from tests.scenes.experiments import PARQUET, add, edit
from tests.scenes.studies import CALIBRATION

REFUSED = "WARNING: arm_ft: the quadratic correction of the {half} is refused: on recordings that were not "


def test_one_recording_is_refused_and_nothing_written(arm: Path, run: Run) -> None:
    """There is no other to judge on."""
    error = run("calibrate", PARQUET, "-o", "new.json", "--nonlinear").error()
    assert "nonlinear: expected at least two recordings, got 'small arm' alone" in error
    assert not Path("new.json").exists()


@pytest.mark.long
def test_a_linear_sensor_is_calibrated_linearly_with_a_warning(days: Path, run: Run) -> None:
    """The file has no terms, but the errors with and without; the sentences say by how much they lost."""
    done = run("calibrate", *CALIBRATION, "-o", "new.json", "--nonlinear", "--format", "json")
    result = done.result()
    assert faults(result, run("schema", "calibrate").result()) == []
    for half in ("force", "moment"):
        assert any(sentence.startswith(REFUSED.format(half=half)) for sentence in done.log)
    fitted = read_calibration("new.json")
    assert fitted.quadratic is None
    assert fitted.nonlinear is not None
    assert fitted.nonlinear.recordings == tuple(f"arm {file.removesuffix('.toml')}" for file in CALIBRATION)
    assert run("calibrate", *CALIBRATION, "-o", "linear.json").code == 0
    linear = read_calibration("linear.json")
    assert linear.nonlinear is None
    assert np.array_equal(linear.matrix, fitted.matrix)


@pytest.mark.long
def test_the_file_asks_for_it_and_the_command_line_rules_over_it(days: Path, run: Run) -> None:
    """All files alike; one that does not ask is fitted with others only where the command line says which."""
    two = CALIBRATION[2:]
    for file in two:
        edit(days / file, "[[support]]", "[calibration]\nnonlinear = true\n\n[[support]]")
    assert run("calibrate", *two, "-o", "new.json").code == 0
    assert read_calibration("new.json").nonlinear is not None
    assert run("calibrate", *two, "-o", "new.json", "--linear").code == 0
    assert read_calibration("new.json").nonlinear is None
    assert "expected the nonlinear of" in run("calibrate", *CALIBRATION[1:], "-o", "mixed.json").error()
    assert run("calibrate", *CALIBRATION[1:], "-o", "mixed.json", "--nonlinear").code == 0


@pytest.mark.long
def test_kept_moments_can_be_corrected_too(days: Path, run: Run) -> None:
    """Stored without the option, and fitted with it."""
    run("calibrate", *CALIBRATION[2:], "-o", "plain.json", "--moments", "kept")
    files = sorted(Path("kept").iterdir())
    assert run("calibrate", *files, "-o", "new.json", "--nonlinear").code == 0
    assert read_calibration("new.json").nonlinear is not None


def test_types_of_the_thesis_are_linear(arm: Path, run: Run) -> None:
    """The two together are refused, on the command line and in the file."""
    error = run("calibrate", PARQUET, "-o", "new.json", "--nonlinear", "--type", "OnTdTO").error()
    assert "nonlinear: the types of the thesis are linear; leave out the estimation type and lambda" in error
    for key in ('type = "OnTdTO"', "lambda_counts2 = 5.0"):
        file = add(arm / PARQUET, f"\n[calibration]\nnonlinear = true\n{key}\n")
        assert "nonlinear belongs to the generative model" in run("calibrate", file, "-o", "new.json").error()
        edit(arm / PARQUET, f"\n[calibration]\nnonlinear = true\n{key}\n", "")
    assert not Path("new.json").exists()


@pytest.mark.parametrize("form", ExportFormat)
def test_no_export_drops_the_terms(tmp_path: Path, run: Run, form: ExportFormat) -> None:
    """Exit code 2, the reason and the way out, and no file; the linear calibration is written."""
    linear = make_calibration(variables=(make_variable(),))
    curved = linear.model_copy(update={"quadratic": correction_of_steepness(0.1)})
    for name, calibration in (("linear", linear), ("curved", curved)):
        write_calibration(tmp_path / f"{name}.json", calibration)
    output = tmp_path / "matrix_SN001.txt"
    error = run("export", tmp_path / "curved.json", "--to", form, "-o", output).error()
    assert f"curved.json: expected a linear calibration for --to {form}, which has no place for quadr" in error
    assert error.endswith("fit again with `calibrate --linear`, from Python with nonlinear=False")
    assert not output.exists()
    frame = ("--frame-id", "ft") if form is ExportFormat.ROS2 else ()
    assert run("export", tmp_path / "linear.json", "--to", form, "-o", output, *frame).code == 0


def test_a_stream_made_with_terms_cannot_be_corrected_by_a_matrix(tmp_path: Path, run: Run) -> None:
    """The calibration that the stream is made with counts too."""
    write_calibration(tmp_path / "new.json", make_calibration())
    curved = make_calibration().model_copy(update={"quadratic": correction_of_steepness(0.1)})
    write_calibration(tmp_path / "old.json", curved)
    words = ("--to", "wholebodydynamics", "-o", tmp_path / "new.xml", "--stream", tmp_path / "old.json")
    assert "no place for quadratic terms" in run("export", tmp_path / "new.json", *words).error()


def test_judging_says_where_loads_are_beyond_the_fitted_ones(arm: Path, run: Run) -> None:
    """A correction whose limits hold no load is said to be used beyond them; one that holds all is not."""
    fitted = read_calibration("fitted.json")
    response = np.linalg.inv(fitted.matrix) / 32767.0
    for name, reach in (("narrow", 1e-9), ("wide", 10.0)):
        quadratic = QuadraticCorrection(
            coefficients=np.zeros((6, 21)),
            to_full_scale=response,
            centre=np.zeros(6),
            directions=np.eye(6),
            minimum=np.full(6, -reach),
            maximum=np.full(6, reach),
        )
        write_calibration(f"{name}.json", fitted.model_copy(update={"quadratic": quadratic}))
    words = "narrow.json: 100 % of the readings are of loads beyond those that its quadratic terms were fitted to"
    assert words in run("evaluate", PARQUET, "-c", "narrow.json", "--details").err
    assert "beyond" not in run("evaluate", PARQUET, "-c", "wide.json", "--details").err
