# SPDX-License-Identifier: BSD-3-Clause
"""A study on a real log: two sensors of the free leg, with blocks of time as data sets."""

from __future__ import annotations

from pathlib import Path

import pytest

from forcetorque.experiment.calibration.estimation_type import ESTIMATION_TYPES
from forcetorque.experiment.validation_offset import Offset
from forcetorque.study.candidate_selection import SWEEP_LAMBDAS
from forcetorque.study.study import study_sensor
from forcetorque.study.study_data import read_study_data

EXAMPLE = Path(__file__).resolve().parents[2] / "examples" / "10_icub_yoga_study.toml"

pytestmark = pytest.mark.real_data


@pytest.mark.long
def test_a_choice_on_one_block_halves_the_force_on_the_other(data_dir: Path, tmp_path: Path) -> None:
    """For both sensors; without temperature there are three types, and only sets with the grid have the S."""
    copy = tmp_path / EXAMPLE.name
    copy.write_text(EXAMPLE.read_text(encoding="utf-8").replace("../../shared/data", data_dir.as_posix()))
    found = read_study_data([copy], None)
    assert [data.sensor.serial for data in found] == ["SN026", "SN230"]
    for data in found:
        made = study_sensor(
            data,
            data_sets=None,
            kinds=list(ESTIMATION_TYPES.values()),
            lambdas=SWEEP_LAMBDAS,
            sphere=["early"],
            code_version="test",
            created="test",
        )
        study = made.study
        assert [combination.name for combination in study.fits.combinations][-1] == "early + moving + quiet"
        assert len(study.fits.candidates) == (7 * 2 + 4) * 13
        assert len(study.fits.left_out) == 3
        scores = study.choices[Offset.FIRST_SECOND].across_sessions
        assert [score.session for score in scores] == ["later", "last"]
        assert all(score.force_mean < 0.5 * (score.workbench_force_mean or 0.0) for score in scores)
        # a block alone leaves directions unexcited, so its fits without the prior may not be chosen
        assert not all(study.fits.combinations[0].excitation.excited)
        alone = [candidate for candidate in study.fits.candidates if candidate.data_set == "early"]
        assert len(alone) == 39
        assert all(candidate.determined is (candidate.table_lambda > 0.0) for candidate in alone)
