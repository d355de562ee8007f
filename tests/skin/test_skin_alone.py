# SPDX-License-Identifier: BSD-3-Clause
"""Files of skin alone: what is read of them without sensors, without a robot, and without patches."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.errors import ExperimentError
from forcetorque.experiment.loading import Purpose, load_experiment
from forcetorque.inspection.inspect import inspect_log
from forcetorque.recording.recording import Use
from forcetorque.robot.dynamics import link_pose
from forcetorque.robot.motion import JointMotion
from forcetorque.robot.tree import build_tree
from forcetorque.skin.patches_of_experiment import BESIDE_M, ROOT, is_skin_alone, links_side_by_side
from forcetorque.skin.section import force_patches
from tests.scenes.skin_alone import EVENTS, FRAMES, write_events
from tests.scenes.touched import write_table, write_touched


def test_contacts_of_a_skin_manager_need_nothing_else(tmp_path: Path) -> None:
    """Neither sensor nor patch nor robot: a link for each frame, and intervals that nothing is estimated in."""
    experiment = load_experiment(write_events(tmp_path), Purpose.DISPLAY)
    assert experiment.sensors == ()
    assert tuple(experiment.recording.streams) == EVENTS
    assert tuple(experiment.model.links) == (ROOT, *FRAMES)
    assert is_skin_alone(experiment.model)
    assert [interval.use for interval in experiment.recording.intervals] == [Use.IGNORE]
    found = {row.kind for row in inspect_log(experiment.file).findings}
    assert found == {"two_clocks", "heuristic"}


def test_links_stand_apart() -> None:
    """Side by side along x, so that skin of one is not drawn in another."""
    tree = build_tree(links_side_by_side(("left", "right")), ROOT)
    still = JointMotion.at_rest((), np.zeros((1, 0)))
    places = [link_pose(tree, still, link)[0][:3, 3] for link in ("left", "right")]
    np.testing.assert_allclose(places, [[0.0, 0.0, 0.0], [BESIDE_M, 0.0, 0.0]])


def test_a_patch_is_on_the_link_of_its_layout(tmp_path: Path) -> None:
    """Where the file states none."""
    write_touched(tmp_path, along=3)
    write_table(tmp_path)
    file = tmp_path / "touched.toml"
    file.write_text(file.read_text().replace("[[interval]]", 'table = "shank.json"\n\n[[interval]]'), encoding="utf-8")
    experiment = load_experiment(file, Purpose.DISPLAY)
    assert tuple(experiment.model.links) == (ROOT, "shank")
    assert [patch.link for patch in force_patches(experiment)] == ["shank"]


def test_what_is_about_neither_sensors_nor_skin_is_refused(tmp_path: Path) -> None:
    """By all that read it, with what to state."""
    file = write_events(tmp_path)
    with pytest.raises(ExperimentError, match=r"expected \[\[sensor\]\], .* got none; `forcetorque inspect`, `view`"):
        load_experiment(file)
    write_touched(tmp_path, along=3)
    counts = tmp_path / "touched.toml"
    text = counts.read_text(encoding="utf-8")
    counts.write_text(text[: text.index("[[patch]]")] + text[text.index("[[interval]]") :], encoding="utf-8")
    with pytest.raises(ExperimentError, match=r"expected \[robot\], or skin on links of some name: a \[\[patch\]\]"):
        load_experiment(counts, Purpose.DISPLAY)
