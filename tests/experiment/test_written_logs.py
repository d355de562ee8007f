# SPDX-License-Identifier: BSD-3-Clause
"""A simulated recording that is written as a folder of logs takes the whole path of a measured one."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from forcetorque.calibration.calibrate import calibrate_sensor
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.formats.icub_matrix import read_matrix_file
from forcetorque.formats.yarp.log_format import PortKind
from forcetorque.formats.yarp.writing import StreamPort, write_ports
from forcetorque.inspection.findings import inspect_experiment
from forcetorque.recording.recording import Recording
from forcetorque.recording.storage import read_recording
from forcetorque.simulation.network_faults import fail_groups, lose_messages
from forcetorque.simulation.simulated_sensor import calibrated_by_board
from tests.scenes.experiments import PARQUET, YARP, edit

PORTS = (
    StreamPort(path="arm_ft/analog:o", kind=PortKind.ANALOG, stream="arm_ft"),
    StreamPort(path="arm/stateExt:o", kind=PortKind.STATE_EXT, stream="joints"),
)


def _sent(arm: Path) -> Recording:
    """What the board of the arm's sensor and its joints send."""
    prior = read_matrix_file(arm / "matrix_SIM001.txt").matrix
    return calibrated_by_board(read_recording(arm / "recording"), "arm_ft", matrix=prior, frame="arm_ft")


def test_two_writers_of_one_recording_agree(arm: Path) -> None:
    """The logs of the tests' own small writer and those of the library load as the same streams."""
    by_tests = load_experiment(arm / YARP).recording
    write_ports(arm / "written", _sent(arm), PORTS)
    by_library = load_experiment(edit(arm / YARP, 'path = "log"', 'path = "written"')).recording
    assert list(by_library.streams) == list(by_tests.streams) == ["arm_ft", "joints"]
    for name, stream in by_tests.streams.items():
        other = by_library.stream(name)
        np.testing.assert_array_equal(other.stamp_ns, stream.stamp_ns)
        np.testing.assert_array_equal(other.sequence, stream.sequence)
        assert list(other.signals) == list(stream.signals)
        for quantity, signal in stream.signals.items():
            assert other.signal(quantity).frame == signal.frame
            # the tests' writer prints 12 digits, the library 15
            np.testing.assert_allclose(other.signal(quantity).values, signal.values, rtol=1e-11, atol=1e-12)
    assert [f.kind for f in by_library.findings] == [f.kind for f in by_tests.findings]


@pytest.mark.long
def test_a_written_log_calibrates_as_the_recording_itself(arm: Path) -> None:
    """The matrix through wrenches, degrees and text is that of the counts, far within its standard error."""
    write_ports(arm / "written", _sent(arm), PORTS)
    edit(arm / YARP, 'path = "log"', 'path = "written"')
    fits = []
    for form in (PARQUET, YARP):
        experiment = load_experiment(arm / form)
        fits.append(
            calibrate_sensor(SensorRun(experiment, experiment.sensors[0]), code_version="1", created="now").matrix
        )
    np.testing.assert_allclose(fits[1], fits[0], rtol=1e-6, atol=1e-9)


def test_injected_faults_are_found_by_inspect(arm: Path) -> None:
    """Lost messages of both ports and failed groups of the joints, as many as were injected; the clean log has none."""
    rng = np.random.default_rng(12)
    faulty = lose_messages(_sent(arm), bursts=6, length=4, rng=rng)
    faulty = fail_groups(faulty, quantity="position", bursts=3, length=5, rng=rng)
    write_ports(arm / "written", faulty, PORTS)
    clean = inspect_experiment(load_experiment(arm / YARP))
    assert not {finding.kind for finding in clean} & {"lost_messages", "missing", "failed_group"}
    found = inspect_experiment(load_experiment(edit(arm / YARP, 'path = "log"', 'path = "written"')))
    for stream in ("arm_ft", "joints"):
        assert [f.count for f in found if (f.kind, f.stream) == ("lost_messages", stream)] == [4] * 6
    assert [f.count for f in found if (f.kind, f.stream) == ("missing", "joints")] == [5] * 3
    assert [f.count for f in found if f.kind == "failed_group"] == [15]


def test_the_documented_lines_run(arm: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """What the page on YARP shows writes a folder that loads."""
    page = (Path(__file__).parents[2] / "docs" / "yarp.md").read_text(encoding="utf-8")
    (code,) = (block for block in re.findall(r"```python\n(.*?)```", page, re.DOTALL) if "write_ports" in block)
    monkeypatch.chdir(arm)
    names: dict[str, Any] = {
        "np": np,
        "recording": read_recording("recording"),
        "prior": read_matrix_file("matrix_SIM001.txt").matrix,
    }
    exec(compile(code, "docs/yarp.md", "exec"), names)
    experiment = load_experiment(edit(arm / YARP, 'path = "log"', 'path = "dumper"'))
    assert len(experiment.recording.stream("arm_ft")) == len(names["recording"].stream("arm_ft")) - 15
