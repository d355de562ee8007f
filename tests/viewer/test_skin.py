# SPDX-License-Identifier: BSD-3-Clause
"""Skin in the scene: pressures and contacts of a patch are those of `skin wrench`, and a heuristic stays one."""

from __future__ import annotations

import shutil
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.experiment.loading import load_experiment
from forcetorque.formats.yarp.skin_ports import SkinPart, read_skin_events
from forcetorque.recording.alignment import usable_samples
from forcetorque.recording.recording import Recording
from forcetorque.results.figure_style import png_bytes
from forcetorque.skin.figures import skin_event_figure
from forcetorque.skin.section import load_patches
from forcetorque.skin.simulation.objects_on_skin import ContactTruth
from forcetorque.skin.simulation.recordings import Loading
from forcetorque.skin.wrench.result import skin_event_rows
from forcetorque.skin.wrench.skin_wrench import skin_wrench
from forcetorque.viewer import skin as viewer_events, skin as viewer_skin
from forcetorque.viewer.scene import SkinContactFrames
from forcetorque.viewer.scene_arrays import SceneDraft, read_array
from forcetorque.viewer.scene_builder import BuiltScene, scene_of
from forcetorque.viewer.skin import half_axes, scene_skin, scene_skin_events
from tests.cases import some_cases
from tests.scenes.experiments import edit
from tests.scenes.skin_arm import EVENT, EVENT_S, EVENTS, LINK, PATCH, SKIN, write_skin_arm

FLOAT32 = 2e-7
"""Rounding to 24 bits, relative."""
LOAD_SHARE = 0.2
"""What a contact may miss of an object's load: it is read by taxels of 8 bits, and skin feels no friction."""


@pytest.fixture(scope="module", name="skin_arm")
def skin_arm_folder(intact: Path, tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Sequence[ContactTruth]]:
    """Folder with skin on the arm, and what objects truly do; nobody changes it."""
    folder = tmp_path_factory.mktemp("skin")
    return folder, write_skin_arm(intact, folder)


@pytest.fixture(scope="module", name="shown")
def scene(skin_arm: tuple[Path, Sequence[ContactTruth]]) -> BuiltScene:
    """The scene of it."""
    return _scene(skin_arm[0])


def _scene(folder: Path) -> BuiltScene:
    return scene_of(folder / SKIN, load_experiment(folder / SKIN), {})


def _forces(built: BuiltScene, frames: SkinContactFrames) -> list[FloatArray]:
    """Forces of the contacts of each frame."""
    first = read_array(built.block, frames.first)
    force = read_array(built.block, frames.force)
    return [force[a:b] for a, b in zip(first, first[1:], strict=False)]


def test_contacts_are_those_of_the_command(skin_arm: tuple[Path, Sequence[ContactTruth]], shown: BuiltScene) -> None:
    """Number, place, force, standard deviation and time of every contact."""
    folder, _ = skin_arm
    rows = skin_wrench(folder / SKIN, folder / "shank.json").contacts
    (patch,) = shown.scene.skin
    assert (patch.name, patch.link) == (PATCH, LINK)
    frames = patch.contacts
    force = read_array(shown.block, frames.force)
    assert len(rows) == len(force) > 20
    np.testing.assert_allclose(force, [row.wrench[:3] for row in rows], rtol=FLOAT32, atol=1e-6)
    place = read_array(shown.block, frames.place)
    np.testing.assert_allclose(place, [row.centre_of_pressure_m for row in rows], rtol=FLOAT32, atol=1e-7)
    assert frames.spread is not None
    axes = read_array(shown.block, frames.spread).reshape(-1, 3, 3)
    along = np.einsum("mi,mij->mj", force / np.linalg.norm(force, axis=1, keepdims=True), axes)
    np.testing.assert_allclose(np.linalg.norm(along, axis=1), [row.force_sd_N for row in rows], rtol=1e-5)
    first = read_array(shown.block, frames.first)
    middles = np.repeat(read_array(shown.block, frames.time_s) + 0.5 * frames.hold_s, np.diff(first))
    np.testing.assert_allclose(middles, [row.time_s for row in rows], atol=1e-9)


def test_objects_are_seen_while_they_rest(skin_arm: tuple[Path, Sequence[ContactTruth]], shown: BuiltScene) -> None:
    """Linked to time: at the middle of each load the force is the object's, and between loads nothing is pressed."""
    (patch,) = shown.scene.skin
    starts, loading = read_array(shown.block, patch.contacts.time_s), Loading()
    forces, pressure = _forces(shown, patch.contacts), read_array(shown.block, patch.pressure)
    assert pressure.shape == (len(starts), patch.vertices.shape[0])
    assert pressure.max() == pytest.approx(patch.largest_Pa, rel=FLOAT32)
    _, truths = skin_arm
    for number, truth in enumerate(truths):
        begin = loading.rest_s + number * loading.turn_s
        held, free = (int(np.searchsorted(starts, seconds, side="right")) - 1 for seconds in (begin + 1.5, begin - 1.0))
        np.testing.assert_allclose(forces[held].sum(axis=0), truth.wrench[:3], atol=LOAD_SHARE * truth.load_N)
        assert pressure[held].any()
        assert not pressure[free].any()
        assert not len(forces[free])
    assert len(truths) == 3


def test_the_heuristic_is_drawn_and_named_one(shown: BuiltScene) -> None:
    """Contacts of a skinManager are no contact wrenches; their times are those of their stream."""
    (events,) = shown.scene.skin_events
    assert (events.name, events.link) == (EVENTS, "hand")
    assert events.contacts.spread is None
    forces, starts = _forces(shown, events.contacts), read_array(shown.block, events.contacts.time_s)
    seen = np.array([len(force) == 1 for force in forces])
    np.testing.assert_array_equal(seen, (starts >= EVENT_S[0]) & (starts < EVENT_S[1]))
    np.testing.assert_allclose(forces[int(np.flatnonzero(seen)[0])][0], EVENT[4:7], rtol=FLOAT32)
    assert any(EVENTS in note and "heuristic, not newtons" in note for note in shown.scene.notes)
    assert EVENTS not in {contact.name for contact in shown.scene.contacts}


def test_half_axes_square_to_the_covariance() -> None:
    """A A^T is the covariance, also where a variance is zero; what is unknown stays so."""
    rng = np.random.default_rng(3)
    root = rng.normal(size=(5, 3, 3))
    covariances = root @ root.transpose(0, 2, 1)
    covariances[3] = np.diag([4.0, 0.0, 1.0])
    covariances[4] = np.nan
    axes = half_axes(covariances)
    np.testing.assert_allclose(axes[:4] @ axes[:4].transpose(0, 2, 1), covariances[:4], atol=1e-12)
    assert np.isnan(axes[4]).all()
    assert not np.allclose(axes[:3] @ axes[:3], covariances[:3])  # the control: rows are no half axes


@pytest.mark.long
def test_long_recordings_are_bounded(
    skin_arm: tuple[Path, Sequence[ContactTruth]], shown: BuiltScene, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Means of more messages, and one message in so many, fill no more than the page holds."""
    monkeypatch.setattr(viewer_skin, "MOST_PRESSURES", 2000)
    monkeypatch.setattr(viewer_events, "MOST_MESSAGES", 100)
    fewer = _scene(skin_arm[0])
    assert np.prod(shown.scene.skin[0].pressure.shape) > 2000
    assert np.prod(fewer.scene.skin[0].pressure.shape) <= 2000
    assert fewer.scene.skin_events[0].contacts.time_s.shape[0] <= 100
    assert any("in means of" in line and "means of 10 " not in line for line in fewer.scene.provenance)


@pytest.mark.parametrize(
    ("old", "new", "note"),
    [
        (f'link = "{LINK}"', 'link = "leg"', "no link 'leg'; state link"),
        ('table = "shank.json"\n', "", "states no table"),
        ('serial = "S1"', 'serial = "S2"', "every patch has its own table"),
    ],
)
def test_a_patch_that_cannot_be_shown_is_noted(
    skin_arm: tuple[Path, Sequence[ContactTruth]], tmp_path: Path, old: str, new: str, note: str
) -> None:
    """It is left out, and the note says what to change."""
    folder = Path(shutil.copytree(skin_arm[0], tmp_path / "copy"))
    edit(folder / SKIN, old, new)
    draft = SceneDraft()
    assert scene_skin(load_patches(folder / SKIN), (LINK,), draft) == ()
    assert any(note in line for line in draft.notes)


def test_contacts_on_another_clock_are_noted(skin_arm: tuple[Path, Sequence[ContactTruth]]) -> None:
    """Stamps of two clocks are never laid beside each other."""
    streams = load_experiment(skin_arm[0] / SKIN).recording.streams
    recording, draft = Recording(streams={EVENTS: streams[EVENTS]}), SceneDraft()
    assert scene_skin_events(recording, "other", ("hand",), draft) == ()
    assert "their clock is" in draft.notes[0]
    assert scene_skin_events(recording, streams[EVENTS].clock, ("forearm",), draft) == ()
    assert "no link 'hand'" in draft.notes[1]


@pytest.mark.real_data
@some_cases(("name", "parts"), [("left", {2: 597, 5: 9}), ("rightleftforearmshands", {2: 1045, 5: 924})])
def test_contacts_of_a_real_robot(data_dir: Path, tmp_path: Path, name: str, parts: dict[int, int]) -> None:
    """All that the log has are drawn and reported, on the one clock of their sender, in no newtons."""
    for kind in ("data", "info"):
        (tmp_path / f"{kind}.log").symlink_to(data_dir / "icub_skin_events_pps" / f"{name}_{kind}.log")
    wanted = [SkinPart(number=number, name=f"part {number}", frame=f"frame_{number}") for number in parts]
    streams = [reading.stream for reading in read_skin_events(tmp_path, parts=wanted)]
    recording, draft = Recording(streams={one.name: one for one in streams}), SceneDraft()
    frames = [part.frame for part in wanted]
    shown = scene_skin_events(recording, streams[0].clock, frames, draft)
    rows, pictures = skin_event_rows(recording)
    # a contact of a message whose stamp repeats the one before has no instant of its own
    repeated = len(streams[0]) - len(usable_samples(streams[0].stamp_ns))
    assert 0 < repeated < 40
    for number, one, row in zip(parts, shown, rows, strict=True):
        assert parts[number] - 3 * repeated <= row.contacts == one.contacts.force.shape[0] <= parts[number]
        assert one.contacts.spread is None
    assert all("not newtons" in note for note in draft.notes)
    assert len(png_bytes(skin_event_figure(pictures))) > 10_000
    assert scene_skin_events(recording, "another", frames, draft) == ()
