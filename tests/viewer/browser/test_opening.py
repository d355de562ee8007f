# SPDX-License-Identifier: BSD-3-Clause
"""A page opens where there is something to judge."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from forcetorque.viewer.scene_arrays import read_array
from forcetorque.viewer.scene_builder import BuiltScene
from tests.browser import Visit
from tests.viewer.browser.arm_scene import WALL, Arm, arm_scene

pytestmark = [pytest.mark.browser, pytest.mark.long]

CALIBRATION, VALIDATION = slice(30, 290), slice(300, 560)
"""Samples of the intervals of the arm's scene."""


def _opened_at(visit: Visit, built: BuiltScene) -> int:
    return int(visit.open(built).evaluate("window.ft.sample()"))


def _expected_absent(built: BuiltScene, absent: slice) -> BuiltScene:
    """The scene without the expected wrenches of the first sensor at some samples."""
    expected = built.scene.sensors[0].wrenches[0]
    assert expected.role == "expected"
    values = read_array(built.block, expected.values).copy()
    values[absent] = np.nan
    block = bytearray(built.block)
    block[expected.values.offset : expected.values.offset + values.nbytes] = values.tobytes()
    return replace(built, block=bytes(block))


def _worst(built: BuiltScene, samples: slice) -> int:
    """Sample with the largest force error of the first calibration where nothing is ignored."""
    expected, _, calibrated, _ = (read_array(built.block, one.values) for one in built.scene.sensors[0].wrenches)
    error = np.linalg.norm((calibrated - expected)[:, :3], axis=1)
    error[WALL] = np.nan
    return samples.start + int(np.nanargmax(error[samples]))


def test_a_page_opens_at_the_worst_sample_of_the_validation_data(visit: Visit, arm: Arm) -> None:
    """Validation comes before calibration; samples at which nothing is expected are passed over."""
    scene = arm.built.scene
    worst = _worst(arm.built, VALIDATION)
    assert _opened_at(visit, arm.built) == worst
    absent = _expected_absent(arm.built, slice(worst, worst + 1))
    assert _opened_at(visit, absent) == _worst(absent, VALIDATION) != worst
    only = replace(scene, intervals=tuple(one for one in scene.intervals if one.use == "calibration"))
    assert _opened_at(visit, replace(arm.built, scene=only)) == _worst(arm.built, CALIBRATION)
    assert _opened_at(visit, _expected_absent(arm.built, slice(300, None))) == _worst(arm.built, CALIBRATION)


def test_a_page_without_anything_to_judge_opens_at_the_first_sample(visit: Visit, arm: Arm, tmp_path: Path) -> None:
    """Neither ignored intervals nor those without an expected wrench are looked for."""
    ignored = tuple(replace(one, use="ignore") for one in arm.built.scene.intervals)
    assert _opened_at(visit, replace(arm.built, scene=replace(arm.built.scene, intervals=ignored))) == 0
    assert _opened_at(visit, arm_scene(tmp_path, expected=False).built) == 0


def test_reset_shows_where_the_page_opened(visit: Visit, arm: Arm) -> None:
    """What was shown first is shown again."""
    page = visit.open(arm.built)
    page.evaluate("window.ft.show(7)")
    page.evaluate("window.ft.reset()")
    assert page.evaluate("window.ft.sample()") == _worst(arm.built, VALIDATION)
