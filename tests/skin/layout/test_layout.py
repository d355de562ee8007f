# SPDX-License-Identifier: BSD-3-Clause
"""A layout is sound or is refused, with the taxel that is not."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from forcetorque.base.errors import ShapeError, SkinError
from forcetorque.skin.layout.layout import SkinLayout
from forcetorque.skin.layout.triangular_modules import MODULE_PADS, MODULE_TAXELS, MODULE_THERMAL

SOUND: dict[str, Any] = {
    "name": "palm",
    "frame": "r_hand",
    "columns": 5,
    "taxels": [0, 1, 3],
    "modules": [0, 0, 0],
    "positions": [[0.0, 0.0, 0.0], [0.006, 0.0, 0.0], [0.0, 0.006, 0.0]],
    "normals": [[0.0, 0.0, 1.0]] * 3,
    "thermal_pads": [2],
    "thermal_modules": [0],
}


def test_what_is_sound_is_kept_and_cannot_be_changed() -> None:
    """Arrays are copies of the documented types that nobody can write to."""
    positions = np.array(SOUND["positions"])
    layout = SkinLayout(**SOUND | {"positions": positions})
    positions[0] = 1.0
    assert len(layout) == 3
    assert (layout.positions == SOUND["positions"]).all()
    assert {layout.taxels.dtype, layout.modules.dtype, layout.thermal_pads.dtype} == {np.dtype(np.int64)}
    for array in (layout.taxels, layout.modules, layout.positions, layout.normals, layout.thermal_pads):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 0


def test_a_patch_without_thermal_pads_is_one() -> None:
    """Empty lists are no pads."""
    assert len(SkinLayout(**SOUND | {"thermal_pads": [], "thermal_modules": []}).thermal_pads) == 0


UNSOUND: dict[str, tuple[dict[str, Any], str]] = {
    "same place": (
        {"positions": [[0.0, 0.0, 0.0], [0.0, 0.006, 0.0], [0.0, 0.006, 0.0]]},
        r"'palm', taxel 1: positions: expected a place for each, got \[0.*\] \(2 such\); `forcetorque skin check`",
    ),
    "zero normal": ({"normals": [[0, 0, 1], [0, 0, 1], [0, 0, 0]]}, r"taxel 3: normals: expected length 1, got 0.0"),
    "long normal": ({"normals": [[0, 0, 1], [0, 0, 2], [0, 0, 1]]}, r"taxel 1: normals: expected length 1, got 2.0"),
    "no number": ({"positions": [[0, 0, 0], [np.nan, 0, 0], [0, 1, 0]]}, "taxel 1: positions: expected finite"),
}


@pytest.mark.parametrize("defect", UNSOUND)
def test_what_is_not_sound_is_refused_with_its_taxel(defect: str) -> None:
    """The message names patch, taxel and how many, and the command that says more."""
    damage, message = UNSOUND[defect]
    with pytest.raises(SkinError, match=message):
        SkinLayout(**SOUND | damage)


MISSHAPEN: dict[str, tuple[dict[str, Any], str]] = {
    "order": ({"taxels": [0, 3, 1]}, "taxels: expected increasing columns"),
    "beyond": ({"taxels": [0, 1, 5]}, "expected columns of 0 to 4, as a message has 5 numbers, got 5"),
    "twice": ({"thermal_pads": [3]}, "column 3: expected a taxel or a thermal pad, got both"),
    "count": ({"modules": [0, 0]}, r"modules: expected an array of shape \(3\), got \(2,\)"),
    "fraction": ({"modules": [0, 0.5, 0]}, "modules: expected whole numbers, got 0.5"),
    "none": ({"taxels": [], "modules": [], "positions": np.empty((0, 3)), "normals": np.empty((0, 3))}, "at least one"),
}


@pytest.mark.parametrize("defect", MISSHAPEN)
def test_columns_that_no_message_has_are_refused(defect: str) -> None:
    """Each column is one taxel or one thermal pad of the message."""
    damage, message = MISSHAPEN[defect]
    with pytest.raises(ShapeError, match=message):
        SkinLayout(**SOUND | damage)


def test_pads_of_a_module_lie_alike_on_its_three_sides() -> None:
    """A third of a turn brings taxels onto taxels, a mirror along x too, to 0.01 mm of the drawing."""
    taxels = MODULE_PADS[MODULE_TAXELS]
    third = Rotation.from_euler("z", 120.0, degrees=True).apply(taxels)
    for moved in (third, taxels * [-1.0, 1.0, 1.0]):
        apart = np.linalg.norm(moved[:, None] - taxels, axis=2)
        assert apart.min(axis=1).max() < 1e-5
        assert sorted(apart.argmin(axis=1)) == list(range(len(taxels)))
    first, second = np.linalg.norm(MODULE_PADS[MODULE_THERMAL], axis=1)
    assert first == pytest.approx(second, abs=5e-5)
