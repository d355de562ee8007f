# SPDX-License-Identifier: BSD-3-Clause
"""Contacts over a recording: what every method says of the same objects, and what makes them doubtful."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.errors import SkinError
from forcetorque.skin.commands import skin_wrench
from forcetorque.skin.simulation.objects_on_skin import ContactTruth
from forcetorque.skin.simulation.recordings import Loading
from forcetorque.skin.wrench.skin_wrench import SkinWrench
from tests.cases import some_cases
from tests.scenes.touched import write_table, write_touched

HYSTERESIS = 0.1
"""Curves lie between loading and unloading: while an object rests they read that much too little at most."""


@pytest.fixture(scope="module", name="made")
def made_folder(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Sequence[ContactTruth]]:
    """Folder with a recording, its calibration, and what the objects truly do."""
    folder = tmp_path_factory.mktemp("shank")
    truths = write_touched(folder)
    write_table(folder)
    return folder, truths


def asked(folder: Path, **choice: object) -> SkinWrench:
    """The answer of one choice."""
    return skin_wrench(folder / "touched.toml", folder / "shank.json", **choice)


def held_wrench(answer: SkinWrench, number: int) -> np.ndarray:
    """Mean wrench while an object rests."""
    loading = Loading()
    start = loading.rest_s + number * loading.turn_s + loading.ramp_s
    rows = [row for row in answer.contacts if start + 0.2 < row.time_s < start + loading.hold_s - 0.2]
    assert rows
    return np.sum([row.wrench for row in rows], axis=0) / len({row.time_s for row in rows})


@some_cases("method", ["kriging", "linear"])
def test_wrenches_are_those_of_the_objects(made: tuple[Path, Sequence[ContactTruth]], method: str) -> None:
    """Force and moment about the link's origin."""
    folder, truths = made
    answer = asked(folder, method=method)
    assert answer.method == method
    for number, truth in enumerate(truths):
        wrench = held_wrench(answer, number)
        np.testing.assert_allclose(wrench[:3], truth.wrench[:3], atol=(HYSTERESIS + 0.1) * truth.load_N)
        np.testing.assert_allclose(wrench[3:], truth.wrench[3:], atol=(HYSTERESIS + 0.1) * truth.load_N * 0.1)


def test_centres_lie_where_objects_rest(made: tuple[Path, Sequence[ContactTruth]]) -> None:
    """Of contacts that are one, within half a pitch."""
    folder, truths = made
    answer, loading = asked(folder, averaged=50), Loading()
    start = loading.rest_s + loading.turn_s + loading.ramp_s
    (row,) = [row for row in answer.contacts if start + 0.4 < row.time_s < start + loading.hold_s - 0.4][:1]
    np.testing.assert_allclose(row.centre_of_pressure_m, truths[1].centre, atol=3.3e-3)
    assert row.active == len(row.taxels)


@pytest.mark.long
def test_a_simple_sum_beside_another_is_drawn_only(made: tuple[Path, Sequence[ContactTruth]]) -> None:
    """It changes no number of the answer."""
    folder, _ = made
    plain, beside = asked(folder), asked(folder, taxel_area_mm2=15.2)
    assert plain.json_text() == beside.json_text()
    assert len(beside.picture.forces) == len(plain.picture.forces) + 1
    assert beside.picture.forces["simple, 15.2 mm2: norm of the force"].max() < beside.largest_force_N


@pytest.mark.long
def test_the_summary_is_that_of_the_rows(made: tuple[Path, Sequence[ContactTruth]]) -> None:
    """Touched frames, largest and mean force; all recordings end untouched."""
    folder, truths = made
    answer = asked(folder)
    assert answer.frames_with_contact == len({row.time_s for row in answer.contacts})
    assert 0 < answer.frames_with_contact < answer.frames
    assert answer.largest_force_N == pytest.approx(max(truth.load_N for truth in truths), rel=0.15)
    assert 0.0 < answer.mean_force_N < answer.largest_force_N
    assert "touched in" in answer.text()


@pytest.mark.long
def test_the_written_normals_are_those_of_the_file(made: tuple[Path, Sequence[ContactTruth]]) -> None:
    """Those of this layout are true: the simple sum with rebuilt ones differs by little."""
    folder, _ = made
    rebuilt = asked(folder, method="simple", taxel_area_mm2=39.0)
    written = asked(folder, method="simple", taxel_area_mm2=39.0, written_normals=True)
    assert rebuilt.largest_force_N == pytest.approx(written.largest_force_N, rel=0.01)
    assert rebuilt.json_text() != written.json_text()


def test_a_drawing_of_another_patch_is_refused(made: tuple[Path, Sequence[ContactTruth]], tmp_path: Path) -> None:
    """A plan with a single module does not say where the other taxels are."""
    folder, _ = made
    plan = tmp_path / "plan.ini"
    plan.write_text("robotPart shank\n[SENSORS]\ntriangle_10pad 0 0 0 0 5 0\n", encoding="utf-8")
    with pytest.raises(SkinError, match="expected a drawing of all"):
        asked(folder, method="thesis", plan=plan)
