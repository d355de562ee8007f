# SPDX-License-Identifier: BSD-3-Clause
"""C3D files: wrenches of all types of plates against values by hand, units, signs and refusals."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ExperimentError, FormatError, MissingExtraError, OutputError
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.named_files import ExperimentContext, Inputs
from forcetorque.formats.c3d.c3d_file import is_c3d, read_c3d
from forcetorque.formats.c3d.force_platform import centre_of_pressure
from forcetorque.formats.c3d.log_format import C3dFormat
from forcetorque.formats.c3d.plate_conventions import C3dLog
from forcetorque.formats.c3d.writing import INTEL, Processor
from forcetorque.inspection.draft.draft import draft_experiment
from forcetorque.inspection.inspect import inspect_log
from tests.formats.c3d import plate_files as files

FLOAT32 = 1e-6
"""Share of a number by which a float of 32 bits may be off, a few times over."""


def _dec(values: FloatArray) -> bytes:
    """A PDP-11 has the halves exchanged, and an exponent that is larger by 2."""
    return np.asarray(4.0 * values, "<f4").reshape(-1).view("<u2").reshape(-1, 2)[:, ::-1].tobytes()


SGI = Processor(code=86, order=">", floats=lambda values: np.asarray(values, ">f4").tobytes())
DEC = Processor(code=85, order="<", floats=_dec)


def read(path: Path, **keys: Any) -> dict[str, Any]:
    """Streams of a file by name."""
    table = C3dLog.model_validate({"format": "c3d", "path": path.name, **keys})
    context = ExperimentContext(
        experiment=path.parent / "x.toml", inputs=Inputs(path.parent), sensors={}, joint_units={}
    )
    return {stream.name: stream for stream in C3dFormat().read(table, context).streams}


def _wrench(path: Path, **keys: Any) -> FloatArray:
    return read(path, **keys)["plate1"].signal("wrench").values


def _expected(sign: float = 1.0) -> FloatArray:
    return sign * files.surface_wrench_nmm() * np.repeat([1.0, 1e-3], 3)


@pytest.mark.parametrize("kind", [1, 2, 3, 4])
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_wrenches_are_about_the_centre_of_the_surface(tmp_path: Path, kind: int, sign: float) -> None:
    """Of every type and either sign; the centre of pressure does not depend on the sign."""
    path = files.write_plate(tmp_path / "a.c3d", kind, sign)
    wrench = _wrench(path)
    np.testing.assert_allclose(wrench, _expected(sign), atol=1e3 * FLOAT32)
    np.testing.assert_allclose(1e3 * centre_of_pressure(wrench), files.COP_MM, atol=1e-3)


@pytest.mark.parametrize("processor", [INTEL, SGI, DEC], ids=["intel", "sgi", "dec"])
def test_all_processors_are_read(tmp_path: Path, processor: Processor) -> None:
    """Bytes in other orders, and the floats of a PDP-11."""
    path = tmp_path / "a.c3d"
    path.write_bytes(files.plate_bytes(form={"processor": processor}))
    np.testing.assert_allclose(_wrench(path), _expected(), atol=1e3 * FLOAT32)
    tip = read(path)["tip"].signal("translation").values
    np.testing.assert_allclose(tip[0], [0.1, 0.2, 0.3], rtol=FLOAT32)
    assert np.isnan(tip[1]).all()


def test_integers_have_offset_and_scale(tmp_path: Path) -> None:
    """(raw - OFFSET) x SCALE x GEN_SCALE, unsigned where FORMAT says so; markers by POINT:SCALE."""
    analog, units = files.channels(2)
    scale, offset = np.full(6, -0.5), np.array([20000, 30000, 40000 - 65536, 20000, 20000, 20000])
    changes = {"ANALOG:SCALE": scale, "ANALOG:OFFSET": offset, "ANALOG:GEN_SCALE": np.array(2.0)}
    raw = np.round(analog / (1.0, 1.0, 1.0, 10.0, 10.0, 10.0) / (2.0 * scale)) + offset % 65536
    changes |= {"ANALOG:FORMAT": ("UNSIGNED",)}
    content = files.c3d_bytes(
        files.parameters(2, units) | changes,
        analog=raw,
        markers=np.full((2, 1, 3), 30.0),
        frame_rate_hz=50.0,
        scale=0.1,
    )
    path = tmp_path / "a.c3d"
    path.write_bytes(content)
    file = read_c3d(path)
    np.testing.assert_allclose(file.analog * (1, 1, 1, 10, 10, 10), analog, atol=10.0)
    np.testing.assert_allclose(file.markers, 30.0)


def test_samples_have_the_rate_of_the_channels(tmp_path: Path) -> None:
    """Several samples in a frame, of which markers have one."""
    analog, units = files.channels(2)
    content = files.c3d_bytes(
        files.parameters(2, units), analog=np.repeat(analog, 10, 0), markers=np.zeros((2, 1, 3)), frame_rate_hz=100.0
    )
    path = tmp_path / "a.c3d"
    path.write_bytes(content)
    streams = read(path)
    assert streams["plate1"].stamp_ns.tolist()[:3] == [0, 1_000_000, 2_000_000]
    assert streams["tip"].stamp_ns.tolist() == [0, 10_000_000]


def test_an_origin_of_the_other_sign_is_asked(tmp_path: Path) -> None:
    """Not guessed: meanwhile the wrench is about the sensor; either answer, and an answer that is not asked."""
    path = files.write_plate(tmp_path / "a.c3d", FORCE_PLATFORM__ORIGIN=-files.ORIGIN_MM[:, None])
    described = C3dFormat().describe(path)
    assert list(described.undetermined) == ["origin_from"]
    assert described.reading.streams[0].signal("wrench").frame == "plate1_sensor"
    np.testing.assert_allclose(_wrench(path, origin_from="surface"), _expected(), atol=1e3 * FLOAT32)
    other = _wrench(path, origin_from="sensor")[:, 3:]
    assert np.abs(other - _expected()[:, 3:]).max() > 0.1  # negative control
    with pytest.raises(FormatError, match=r"origin_from: expected where ORIGIN begins.*got none"):
        read(path)
    with pytest.raises(FormatError, match=r"origin_from: expected none, the file determines it"):
        read(files.write_plate(tmp_path / "b.c3d"), origin_from="surface")


@pytest.mark.parametrize(
    ("kind", "change", "key", "answer"),
    [
        (2, {"ANALOG__UNITS": ("V",) * 6}, ["force_unit", "moment_unit"], {"force_unit": "N", "moment_unit": "N mm"}),
        (4, {"FORCE_PLATFORM__UNITS": None}, ["force_unit", "moment_unit"], {"force_unit": "N", "moment_unit": "N mm"}),
        (3, {"POINT__UNITS": ("",)}, ["length_unit"], {"length_unit": "mm"}),
        (1, {"POINT__UNITS": ("furlong",)}, ["length_unit"], {"length_unit": "mm"}),
    ],
)
def test_units_that_are_not_stated_are_asked(
    tmp_path: Path, kind: int, change: dict[str, Any], key: list[str], answer: dict[str, str]
) -> None:
    """There is no wrench before, and the right one after the answer."""
    path = files.write_plate(tmp_path / "a.c3d", kind, **change)
    described = C3dFormat().describe(path)
    assert list(described.undetermined) == key
    assert not [stream for stream in described.reading.streams if "wrench" in stream.signals]
    assert described.unread_wrenches == ("plate1",)
    np.testing.assert_allclose(_wrench(path, **answer), _expected(), atol=1e3 * FLOAT32)


REFUSED: dict[str, tuple[dict[str, Any], str]] = {
    "type": ({"FORCE_PLATFORM__TYPE": np.array([5])}, r"plate 1: FORCE_PLATFORM:TYPE: expected 1 to 4, got 5"),
    "channel": (
        {"FORCE_PLATFORM__CHANNEL": np.arange(2, 8)[:, None]},
        r"plate 1: FORCE_PLATFORM:CHANNEL: expected 6 numbers from 1 to 6, got 2, 3, 4, 5, 6, 7",
    ),
    "zero": ({"FORCE_PLATFORM__ZERO": np.array([1, 9])}, r"ZERO: expected frames from 1 to 2, got 1 to 9"),
    "origin": ({"FORCE_PLATFORM__ORIGIN": None}, r"FORCE_PLATFORM:ORIGIN: expected 1 plates, got 0"),
    "corners": ({"FORCE_PLATFORM__CORNERS": np.zeros((4, 3))}, r"CORNERS: expected shape \(3, 4, n\), got \(4, 3, 1\)"),
    "frames": ({"POINT__FRAMES": np.array(9)}, r"header: expected one number of frames, got 2 and 9"),
}


@pytest.mark.parametrize("fault", REFUSED)
def test_contradictions_are_refused(tmp_path: Path, fault: str) -> None:
    """With file, parameter, expected and got."""
    change, message = REFUSED[fault]
    with pytest.raises(FormatError, match=message):
        read(files.write_plate(tmp_path / "a.c3d", **change))


def test_a_cut_file_is_refused(tmp_path: Path) -> None:
    """Frames are counted against the header."""
    path = tmp_path / "a.c3d"
    path.write_bytes(files.plate_bytes()[:-512])
    with pytest.raises(FormatError, match="expected 2 frames, as the header states, got 0: the file is cut"):
        read(path)


def test_zero_frames_are_subtracted(tmp_path: Path) -> None:
    """The mean of the frames of FORCE_PLATFORM:ZERO, and a finding that names them."""
    path = files.write_plate(tmp_path / "a.c3d", FORCE_PLATFORM__ZERO=np.array([1, 1]))
    expected = _expected() - _expected()[0]
    np.testing.assert_allclose(_wrench(path), expected, atol=1e3 * FLOAT32)
    assert [finding.kind for finding in C3dFormat().describe(path).reading.findings] == ["zeroed"]


def test_without_the_library_the_line_that_installs_it_is_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Recognised all the same."""
    monkeypatch.setitem(sys.modules, "c3d", None)
    path = files.write_plate(tmp_path / "a.c3d")
    assert is_c3d(path)
    with pytest.raises(MissingExtraError, match=r"pip install 'forcetorque\[c3d\]'"):
        read(path)


SAMPLES = "c3d_plates"
"""Folder of measured data."""


@pytest.mark.real_data
@pytest.mark.parametrize(
    ("name", "keys"),
    [
        ("plate_type2", {}),
        ("plate_type2_action_sign", {}),
        ("plate_type2_baseline_zero", {}),
        ("plate_type2_origin_positive", {"origin_from": "surface"}),
        ("plate_type4", {"force_unit": "N", "moment_unit": "N mm"}),
    ],
)
def test_files_of_another_writer_have_their_known_wrench(data_dir: Path, name: str, keys: dict[str, str]) -> None:
    """Written by ezc3d with known force and centre of pressure; two of them 0.5 s later."""
    wrench = _wrench(data_dir / SAMPLES / f"{name}.c3d", **keys)[600:]
    time = np.arange(600, 600 + len(wrench)) / 1000.0
    force = np.column_stack([20 * np.sin(5 * time), -15 * np.cos(4 * time), 600 + 50 * np.sin(3 * time)])
    sign = 1.0 if name.endswith("action_sign") else -1.0
    noise = 1.5  # N: five times the noise of 0.2 N, and of type 4 what 32 bits leave of it
    assert np.abs(sign * wrench[:, :3] - force).max() < noise
    centre = np.column_stack([60 * np.sin(2 * time), 40 * np.cos(2 * time)])
    assert np.abs(1e3 * centre_of_pressure(wrench) - centre).max() < 0.5
    assert json.loads((data_dir / SAMPLES / "truth.json").read_text())["force_from_s"] == 0.5


@pytest.mark.real_data
@pytest.mark.parametrize(
    ("name", "keys", "peaks"),
    [
        ("FP_Type3", {}, {"plate1": -887.0}),
        ("Qualisys", {"origin_from": "surface"}, {"plate1": -808.0, "plate2": -840.0}),
        ("BTS", {"origin_from": "surface"}, {"plate1": -662.0, "plate4": -637.0}),
        ("Kistler", {"length_unit": "mm"}, {"plate1": 816.0, "plate2": 826.0}),
    ],
)
def test_real_files_have_the_peaks_that_were_measured(
    data_dir: Path, name: str, keys: dict[str, str], peaks: dict[str, float]
) -> None:
    """Sign and size as another reader gave them; the force acts on the plate."""
    streams = read(data_dir / SAMPLES / f"ezc3d_{name}.c3d", **keys)
    for plate, peak in peaks.items():
        wrench = streams[plate].signal("wrench").values
        vertical = wrench[:, 2]
        assert vertical[np.argmax(np.abs(vertical))] == pytest.approx(peak, abs=1.0)
        loaded = wrench[np.abs(vertical) > 300.0]
        assert np.abs(centre_of_pressure(loaded)).max() < 0.35  # m, half of the longest edge


def test_init_asks_what_the_file_leaves_open(tmp_path: Path) -> None:
    """The sign of ORIGIN, and that of the wrench, which the format does not fix."""
    path = files.write_plate(tmp_path / "a.c3d", FORCE_PLATFORM__ORIGIN=-files.ORIGIN_MM[:, None])
    draft = draft_experiment(path, tmp_path / "x.toml")
    assert {"origin_from", "measure_direction"} <= {question.key for question in draft.questions}
    assert draft.format == "c3d"


def test_a_file_without_units_is_asked_for_them_and_its_plate_is_drafted(tmp_path: Path) -> None:
    """`inspect` names what lacks, and the draft is complete once that is answered."""
    path = files.write_plate(tmp_path / "a.c3d", 3, POINT__UNITS=("",))
    with pytest.raises(FormatError, match="length_unit: expected unit of corners, .*; got none, without which"):
        inspect_log(path)
    file = tmp_path / "x.toml"
    assert {"length_unit", "serial", "measure_direction"} <= {one.key for one in draft_experiment(path, file).questions}
    text = file.read_text(encoding="utf-8")
    answers = {"length_unit": "mm", "serial": "FP1", "motion": "none", "measure_direction": "child_to_parent"}
    for key, answer in answers.items():
        text = text.replace(f'{key} = "?"', f'{key} = "{answer}"')
    file.write_text(text.replace('full_scale = "?"', "full_scale = [5e3, 5e3, 1e4, 1e3, 1e3, 1e3]"), encoding="utf-8")
    assert "wrench" in load_experiment(file).recording.stream("plate1").signals


def test_init_drafts_every_plate(tmp_path: Path) -> None:
    """A file each, which differ in the plate alone; one that is named has a single file; files are not replaced."""
    corners, channels = files.CORNERS_MM.T.astype(np.float32), np.arange(1, 7)
    path = files.write_plate(
        tmp_path / "walk.c3d",
        FORCE_PLATFORM__USED=np.array(2),
        FORCE_PLATFORM__TYPE=np.array([2, 2]),
        FORCE_PLATFORM__CORNERS=np.stack([corners, corners], axis=2),
        FORCE_PLATFORM__ORIGIN=np.stack([files.ORIGIN_MM] * 2, axis=1),
        FORCE_PLATFORM__CHANNEL=np.stack([channels, channels], axis=1),
    )
    draft = draft_experiment(path, tmp_path / "walk.toml")
    second = tmp_path / "walk.plate2.toml"
    assert draft.sensor_files == (str(second),)
    first = (tmp_path / "walk.toml").read_text(encoding="utf-8")
    assert first.replace("plate1", "plate2") == second.read_text(encoding="utf-8") != first
    alone = draft_experiment(path, tmp_path / "two.toml", sensors=["plate2"])
    assert alone.sensor_files == ()
    assert (tmp_path / "two.toml").read_bytes() == second.read_bytes()
    (tmp_path / "walk.toml").unlink()
    with pytest.raises(OutputError, match=r"walk\.plate2\.toml"):
        draft_experiment(path, tmp_path / "walk.toml")
    assert not (tmp_path / "walk.toml").exists()
    with pytest.raises(ExperimentError, match="--output -: expected one sensor, .* got 2; name one by --sensor"):
        draft_experiment(path, "-")
