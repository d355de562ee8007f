# SPDX-License-Identifier: BSD-3-Clause
"""What recorded sensors do to fast forces, and what cannot be told of a record."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from forcetorque.app.python.experiment import load_experiment
from forcetorque.base.errors import ExperimentError, FitError, RecordingError
from forcetorque.sensor.bandwidth.response import Response, response
from forcetorque.sensor.bandwidth.second_order import SecondOrder
from tests.page_scripts import unmarked
from tests.results.showing import require_shown
from tests.scenes.excited_sensors import MASS_KG, Spring, released, swung, write_excited, write_taps

SPRING = Spring(rate_hz=500.0)
ENOUGH = 3.0
"""Half-widths of 95 % intervals within which all of some numbers lie."""
SKREDE = """\
schema = "forcetorque/experiment/1"
name = "taps on a moving arm"

[load]
frame = "ft"
motion = ["imu"]
measure_direction = "child_to_parent"
mass_kg = 0.932
centre_of_mass_m = [0.0, 0.0, 0.0439]

[recording]
format = "tabular"
path = "{folder}"

[[recording.stream]]
name = "wrench"
file = "2-vibrations_wrench.csv"
stamp = {{ column = "t", unit = "us" }}

[[recording.stream.signal]]
quantity = "wrench"
columns = ["fx", "fy", "fz", "tx", "ty", "tz"]
units = ["N", "N", "N", "N m", "N m", "N m"]
frame = "ft"

[[recording.stream]]
name = "imu"
file = "2-vibrations_accel.csv"
clock = "{clock}"
stamp = {{ column = "t", unit = "us" }}

[[recording.stream.signal]]
quantity = "proper_acceleration"
columns = ["ay", "az", "ax"]
units = ["g", "g", "g"]
frame = "ft"

[[sensor]]
name = "wrist"
stream = "wrench"
serial = "ATI Gamma"
prior = "identity"

[[interval]]
label = "taps"
start_s = 0.01
end_s = 6.2
use = "calibration"
"""


@pytest.fixture(scope="module")
def taps(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Five taps with the force of the hammer."""
    return write_taps(tmp_path_factory.mktemp("taps"), spring=SPRING)


@pytest.fixture(scope="module")
def tapped(taps: Path) -> Response:
    """Their response."""
    return load_experiment(taps)["wrist"].response("impact", force="log", cut_off_hz=50.0)


def _held(answer: Response, source: str) -> list[str]:
    """Quantities of a source that lie near the truth."""
    truth = dict(zip(("natural frequency", "damping ratio", "gain"), SPRING.truth, strict=True))
    truth["bandwidth, -3 dB"] = SecondOrder(
        natural_frequency_hz=SPRING.natural_hz, damping=SPRING.damping, gain=1.0, covariance=np.zeros((3, 3))
    ).bandwidth()[0]
    rows = [row for row in answer.numbers if row.source == source]
    return [row.quantity for row in rows if abs(row.value - truth[row.quantity]) < ENOUGH * row.half_width_95]


def test_taps_tell_the_response(tapped: Response) -> None:
    """By decays and by the measured force, each with its interval."""
    require_shown(tapped)
    assert (len(tapped.events), tapped.signal, tapped.refused, tapped.warnings) == (5, "fz", (), ())
    assert _held(tapped, "free decays") == ["natural frequency", "damping ratio"]
    assert _held(tapped, "frequency response") == ["natural frequency", "damping ratio", "gain", "bandwidth, -3 dB"]
    assert tapped.curve is not None
    assert tapped.curve.explained_share > 0.95
    assert "vibrations above 250 Hz, half of the rate" in tapped.text()


def test_the_filter_is_used_and_kept(tapped: Response) -> None:
    """It lowers the error of pushes that were not fitted to less than half, also when read back from the JSON."""
    rng = np.random.default_rng(77)
    force = np.where(np.abs(SPRING.instants(4.0) - 2.0) < 0.3, 25.0, 0.0)
    _, measured, reading = SPRING.read(rng, force)
    level = reading[:500].mean()
    corrected = tapped.corrected(reading - level)
    assert (corrected - measured).std() < 0.5 * (reading - level - measured).std()
    kept = Response.model_validate_json(tapped.json_text())
    np.testing.assert_array_equal(kept.corrected(reading - level), corrected)
    assert tapped.inverse is not None
    assert tapped.inverse.noise_gain > 1.0


def test_taps_without_a_measured_force_tell_decays_alone(taps: Path) -> None:
    """No gain, no filter, and why."""
    answer = load_experiment(taps)["wrist"].response("impact")
    assert [row.source for row in answer.numbers] == ["free decays"] * 2
    assert (answer.curve, answer.inverse) == (None, None)
    assert "the force was not measured" in answer.refused[0]
    with pytest.raises(FitError, match="expected a filter that undoes its response, got none"):
        answer.corrected(np.zeros(5))


def test_released_weights_tell_the_gain(tmp_path: Path) -> None:
    """By the mass alone, or by the measured force."""
    rng = np.random.default_rng(4)
    path = write_excited(tmp_path, *SPRING.read(rng, released(rng, SPRING)))
    run = load_experiment(path)["wrist"]
    weighed = run.response("release", mass_kg=MASS_KG)
    assert _held(weighed, "the released weight") == ["gain"]
    assert weighed.inverse is not None
    measured = run.response("release", force="log")
    assert "gain" in _held(measured, "frequency response")


def test_a_swing_tells_what_it_drives(tmp_path: Path) -> None:
    """The gain well, the resonance beyond it by extrapolation, which is said."""
    rng = np.random.default_rng(5)
    spring = Spring(natural_hz=6.0, rate_hz=200.0)
    path = write_excited(tmp_path, *spring.read(rng, swung(rng, spring, seconds=60.0)))
    answer = load_experiment(path)["wrist"].response("pendulum", force="log", component="fz")
    (gain,) = [row for row in answer.numbers if row.quantity == "gain"]
    assert abs(gain.value - spring.gain) < ENOUGH * gain.half_width_95 < 0.02
    assert any("it is extrapolated by the form of the fit" in words for words in answer.warnings)


def test_two_recordings_are_one_answer(taps: Path, tmp_path: Path) -> None:
    """Events of both."""
    runs = [load_experiment(taps)["wrist"], load_experiment(write_taps(tmp_path, seed=8, spring=SPRING))["wrist"]]
    both = response(runs, "impact", force="log", component="fz")
    assert len(both.events) == 10
    assert "natural frequency" in _held(both, "frequency response")


def test_what_is_lacking_is_said(taps: Path) -> None:
    """An excitation, a component, an interval, a stream, a mass."""
    run = load_experiment(taps)["wrist"]
    for words, options in (
        ("no excitation 'shake'", {"excitation": "shake"}),
        ("no component 'f3'", {"excitation": "impact", "component": "f3"}),
        ("no interval is labelled 'oven'", {"excitation": "impact", "intervals": ["oven"]}),
        ("expected the stream of the measured force", {"excitation": "pendulum"}),
        ("expected more than 0 kg", {"excitation": "release", "mass_kg": -1.0}),
        ("a mass says nothing of a tap", {"excitation": "impact", "mass_kg": 1.0}),
        ("a weight of known mass is a force", {"excitation": "release", "mass_kg": 1.0, "component": "tx"}),
    ):
        with pytest.raises(ExperimentError, match=words):
            run.response(**options)


def test_a_record_that_cannot_tell_is_refused(tmp_path: Path) -> None:
    """Without an impact, with a clipped one, with a lost sample: each names where."""
    rng = np.random.default_rng(6)
    time, force, reading = SPRING.read(rng, np.zeros(len(SPRING.instants(5.0))))
    with pytest.raises(RecordingError, match="excited, taps: expected an impact or a release, got none"):
        load_experiment(write_excited(tmp_path, time, force, reading))["wrist"].response("impact")
    rows = np.loadtxt(write_taps(tmp_path).with_suffix(".csv"), delimiter=",", skiprows=1)
    cut = np.minimum(rows[:, 3], 0.7 * rows[:, 3].max())
    path = write_excited(tmp_path, rows[:, 0], rows[:, 9], cut)
    with pytest.raises(RecordingError, match=r"stream 'log': fz is clipped at \d\.\d+ s"):
        load_experiment(path)["wrist"].response("impact")
    kept = np.delete(rows, 700, axis=0)
    path = write_excited(tmp_path, kept[:, 0], kept[:, 9], kept[:, 3])
    with pytest.raises(RecordingError, match=r"uneven sampling: 1 of \d+ steps .* the first at 1.3980 s"):
        load_experiment(path)["wrist"].response("impact")


@pytest.mark.real_data
def test_four_real_taps_ring_and_tell_no_transfer_function(data_dir: Path, tmp_path: Path) -> None:
    """Each has a decay, which scatter; the accelerometer does not explain the wrench; other clocks are not mixed."""
    folder = data_dir / "ati_gamma_kuka_med14_skrede"
    path = tmp_path / "taps.toml"
    path.write_text(SKREDE.format(folder=folder.as_posix(), clock="log"))
    answer = load_experiment(path)["wrist"].response("impact", component="fy", force="imu")
    np.testing.assert_allclose([row.time_s for row in answer.events], [0.82, 2.27, 3.27, 4.23], atol=0.01)
    assert all(row.frequency_hz is not None and 5.0 < row.frequency_hz < 300.0 for row in answer.events)
    frequency = answer.numbers[0]
    assert frequency.scatter is not None
    assert frequency.scatter > 0.1 * frequency.value
    assert any("they are not one vibration" in words for words in answer.warnings)
    (refusal,) = answer.refused
    assert "no transfer function: the measured force explains" in refusal
    assert "coherence" in refusal
    assert answer.curve is None
    path.write_text(SKREDE.replace("2-vibrations", "1-baseline").format(folder=folder.as_posix(), clock="log"))
    with pytest.raises(RecordingError, match="expected an impact or a release, got none"):
        load_experiment(path)["wrist"].response("impact")
    path.write_text(SKREDE.format(folder=folder.as_posix(), clock="imu"))
    with pytest.raises(RecordingError, match="stamped by the clocks 'log' and 'imu'; bring them to one clock"):
        load_experiment(path)["wrist"].response("impact", component="fy", force="imu")


def test_the_script_of_its_page_runs(
    taps: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """It prints the table of the command."""
    (code,) = unmarked((Path(__file__).parents[3] / "docs" / "sensor" / "response.md").read_text(encoding="utf-8"))
    monkeypatch.chdir(taps.parent)
    exec(compile(code, "response.md", "exec"), {})
    assert "natural frequency" in capsys.readouterr().out
