# SPDX-License-Identifier: BSD-3-Clause
"""Joint torques by source in the report: the figure, the tables of the fusion, and why there are none."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.errors import ExperimentError
from forcetorque.estimation.estimate import estimate_experiment
from forcetorque.estimation.report_blocks import torque_section
from forcetorque.estimation.torque.experiment_fusion import fuse_experiment, torque_picture
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.offsets import corrections_of
from forcetorque.report.experiment_assessment import ExperimentAssessment, assess_experiment
from forcetorque.report.sensor_assessment import Demands
from forcetorque.results.document.content import Figure, List, Section
from forcetorque.results.table import Table
from tests.scenes.experiments import PARQUET
from tests.scenes.motors import DRIVEN, FUSION, with_motors
from tests.scenes.skinned_leg import FILE, write_leg
from tests.scenes.touched import write_table


def assessed(file: Path) -> ExperimentAssessment:
    """All that is said about an experiment."""
    return assess_experiment(load_experiment(file), {}, file=file.name, demands=Demands())


def figures(section: Section) -> list[Figure]:
    """Its figures."""
    return [block for block in section.blocks if isinstance(block, Figure)]


def fused(file: Path) -> Experiment:
    """The arm with motors."""
    return load_experiment(file)


def test_fused_torques_are_drawn_by_source(arm: Path) -> None:
    """A line and a band for sensor, motors and all together, over both intervals with a gap between."""
    experiment = fused(with_motors(arm))
    fusions, _ = fuse_experiment(experiment, corrections_of(experiment, {}))
    picture = torque_picture(experiment, fusions=fusions)
    assert picture.joints == DRIVEN
    assert list(picture.torques) == list(picture.deviations) == ["ft", "current", "fused"]
    lengths = [len(one.fusion.stamp_ns) for one in fusions]
    assert len(lengths) > 1
    assert len(picture.seconds) == sum(lengths) + len(lengths)
    gaps = np.cumsum(np.array(lengths) + 1) - 1
    assert np.isnan(picture.torques["fused"][gaps]).all()
    first = slice(0, lengths[0])
    np.testing.assert_array_equal(picture.torques["fused"][first], fusions[0].fusion.torque)
    np.testing.assert_allclose(1.959963984540054 * picture.deviations["fused"][first], fusions[0].fusion.half_width)


def test_the_report_shows_them(arm: Path) -> None:
    """With the tables of `estimate --fuse`; the JSON has those."""
    answer = assessed(with_motors(arm))
    section = torque_section(answer)
    captions = [block.caption for block in section.blocks if isinstance(block, Table)]
    assert captions[:2] == ["joint torques", "sources of joint torques"]
    (figure,) = figures(section)
    assert "by ft, current, fused; bands are intervals of 95 %" in figure.caption
    assert figure.picture.png.startswith(b"\x89PNG")
    assert answer.model_dump(mode="json")["fusion"]["torques"]


@pytest.mark.long
def test_skin_makes_a_figure_without_fusion(tmp_path: Path) -> None:
    """Sensors and skin are then one source, with a band."""
    write_leg(tmp_path)
    write_table(tmp_path)
    answer = assessed(tmp_path / FILE)
    assert answer.torque_picture is not None
    assert list(answer.torque_picture.torques) == list(answer.torque_picture.deviations) == ["sensors and skin"]
    assert len(figures(torque_section(answer))) == 1


@pytest.mark.long
def test_what_cannot_be_told_is_said(arm: Path) -> None:
    """It does not cost the document; a plain experiment has no section."""
    file = with_motors(arm)
    text = file.read_text(encoding="utf-8")
    file.write_text(text[: text.index("\n[[motor]]")] + FUSION, encoding="utf-8")
    section = torque_section(assessed(file))
    (points,) = (block.points for block in section.blocks if isinstance(block, List))
    assert "expected two sources of joint torques at least" in points[0]
    file.write_text(file.read_text(encoding="utf-8").replace(FUSION, ""), encoding="utf-8")
    assert torque_section(assessed(file)).blocks == ()


def test_without_torques_there_is_nothing_to_draw(arm: Path) -> None:
    """One line that says so; with estimates there is one source without a band."""
    experiment = load_experiment(arm / PARQUET)
    with pytest.raises(ExperimentError, match="expected the torque of a rotary joint to draw, got none"):
        torque_picture(experiment)
    picture = torque_picture(experiment, estimate_experiment(experiment, corrections_of(experiment, {})))
    assert list(picture.torques) == ["sensors"]
    assert picture.deviations == {}
