# SPDX-License-Identifier: BSD-3-Clause
"""What a report shows of calibrations: the generative model by what it learnt, types of the thesis by lambda."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from forcetorque.calibration.calibrate import calibrate_sensor
from forcetorque.calibration.report_blocks import excitation_blocks, lambda_blocks, learnt_blocks, uncertainty_blocks
from forcetorque.calibration.summary import information_gains
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.report.sensor_assessment import Assessment
from forcetorque.results.document.content import Figure, Text
from forcetorque.results.table import Table
from tests.scenes.experiments import PARQUET, write_experiments


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> SensorRun:
    """A sensor of the small arm."""
    folder = tmp_path_factory.mktemp("arm")
    write_experiments(folder)
    return SensorRun(load_experiment(folder / PARQUET), "arm_ft")


@pytest.fixture(scope="module")
def generative(run: SensorRun) -> Calibration:
    """Fitted by default."""
    return calibrate_sensor(run, code_version="1", created="2020-01-01T00:00:00+00:00")


@pytest.fixture(scope="module")
def thesis(run: SensorRun) -> Calibration:
    """Fitted with a lambda."""
    return calibrate_sensor(run, code_version="1", created="2020-01-01T00:00:00+00:00", regularisation=5.0)


def _assessed(**calibrations: Calibration) -> Assessment:
    files = {str(Path("made", f"{name}.json")): one for name, one in calibrations.items()}
    learnt = {file: rows for file, one in files.items() if (rows := information_gains(one)) is not None}
    return Assessment.model_construct(sensor="arm_ft", serial="SIM001", calibrations=files, information_gain=learnt)


def test_a_generative_fit_is_shown_without_lambda(generative: Calibration) -> None:
    """Words, picture, assumptions, noise of every component and offsets; no lambda and no raw directions."""
    sensor = _assessed(new=generative)
    words, picture, assumed, noise, sessions = learnt_blocks(sensor)
    assert isinstance(words, Text)
    assert words.text.startswith("new.json: information gained: fx ")
    assert isinstance(picture, Figure)
    assert isinstance(assumed, Text)
    assert "the sensor as repeating itself to 0.3 % of its response." in assumed.text
    assert isinstance(noise, Table)
    assert isinstance(sessions, Table)
    posterior = generative.posterior
    assert posterior is not None
    assert [row[1] for row in noise.rows] == [f"{row.white:.3g}" for row in posterior.noise]
    assert [row[2] for row in noise.rows] == [
        f"{np.sqrt(row.ratio) * row.white:.3g}" if row.ratio else "none" for row in posterior.noise
    ]
    (row,) = sessions.rows
    assert row[0] == "small arm"
    assert "±" in row[1]
    assert list(lambda_blocks(sensor)) == list(excitation_blocks(sensor)) == []
    assert len(list(uncertainty_blocks(sensor))) == 1


def test_types_of_the_thesis_stay_as_they_are(thesis: Calibration, generative: Calibration) -> None:
    """Beside a generative fit: lambda and excitation of theirs alone."""
    sensor = _assessed(old=thesis, new=generative)
    (words,) = lambda_blocks(sensor)
    assert isinstance(words, Text)
    assert words.text == "old.json: lambda 5 counts²; given."
    assert len(list(excitation_blocks(sensor))) == 1
    assert list(learnt_blocks(_assessed(old=thesis))) == []


@pytest.mark.parametrize(
    ("value", "words"), [(np.inf, "lambda infinite, the prior matrix"), (None, "every row has its own lambda")]
)
def test_a_lambda_per_row_is_not_called_infinite(thesis: Calibration, value: float | None, words: str) -> None:
    """Both have no number to show."""
    (block,) = lambda_blocks(_assessed(old=thesis.model_copy(update={"lambda_counts2": value})))
    assert isinstance(block, Text)
    assert block.text == f"old.json: {words}; given."


def test_without_a_prior_there_is_nothing_to_be_narrower_than(generative: Calibration) -> None:
    """The picture stays away, and the reason is said; noise is that of channels."""
    assert generative.posterior is not None
    alone = generative.posterior.model_copy(update={"space": "channel", "prior_covariance": None})
    assumed, noise, _ = learnt_blocks(_assessed(new=generative.model_copy(update={"posterior": alone})))
    assert isinstance(assumed, Text)
    assert assumed.text.endswith("without a prior there is nothing to be narrower than.")
    assert isinstance(noise, Table)
    assert [row[0] for row in noise.rows] == [f"ch{k}, counts" for k in range(6)]


def test_drift_stands_below_the_offset_of_its_session(generative: Calibration) -> None:
    """Per hour, which people can judge."""
    (session,) = generative.sessions
    moving = session.model_copy(update={"drift_per_s": np.full(6, 0.001), "drift_from_ns": 0})
    *_, sessions = learnt_blocks(_assessed(new=generative.model_copy(update={"sessions": (moving,)})))
    assert isinstance(sessions, Table)
    assert sessions.rows[1] == ("small arm, added per hour", *["3.600"] * 6)
