# SPDX-License-Identifier: BSD-3-Clause
"""Every block of Python on a page runs: marked ones in `test_examples.py`, others in a test that is named here."""

from __future__ import annotations

from collections import Counter
from pathlib import Path

import pytest

from forcetorque.simulation.scenario.scenario import SimulatedRecording
from tests.page_scripts import marked, unmarked

ROOT = Path(__file__).resolve().parents[2]
PAGES = sorted([ROOT / "README.md", *(ROOT / "docs").rglob("*.md")])
RUN_ELSEWHERE = {
    "guides/notebook.md": "tests/examples/test_guides.py",
    "locomotion/balance.md": "tests/locomotion/standing/test_balance.py",
    "calibration/method.md": "tests/examples/test_calibration_page.py",
    "estimation/estimation.md": "tests/robot/mechanics/test_documentation.py",
    "live.md": "tests/live/test_corrector.py",
    "yarp.md": "tests/experiment/test_written_logs.py",
    "calibration/joint.md": "tests/calibration/joint/test_joint_calibration.py",
    "payload/robot_load.md": "tests/payload/test_tare.py",
    "locomotion/coherence.md": "tests/locomotion/net_force/test_coherence_command.py",
    "contests.md": "tests/contests/test_contest_command.py",
    "sensor/response.md": "tests/sensor/bandwidth/test_response.py",
    "locomotion/motion.md": "tests/locomotion/test_motion.py",
    "sensor/temperature.md": "tests/sensor/temperature/test_thermal.py",
    "locomotion/torque_loop.md": "tests/locomotion/torque_control/test_torque_loop_command.py",
    "tutorial.md": "tests/inspection/draft/test_tutorial.py",
    "simulation.md": "tests/examples/test_page_scripts.py",
    "skin/layout.md": "tests/skin/layout_formats/test_documentation.py",
    "simulation.md, both feet": "tests/examples/test_simulation_page.py",
    "simulation.md, contact switching": "tests/examples/test_simulation_page.py",
}
"""Pages with a block that is not marked, each by itself, and who runs it."""


@pytest.mark.long
def test_the_script_of_the_page_on_simulation_runs() -> None:
    """One seed of the twenty: all recordings, with other sensors under the same loads."""
    codes = unmarked((ROOT / "docs" / "simulation.md").read_text(encoding="utf-8"))
    (code,) = (code for code in codes if "range(1, 21)" in code)
    names: dict[str, object] = {}
    exec(compile(code.replace("range(1, 21)", "range(1, 2)"), "simulation.md", "exec"), names)
    made = names["made"]
    assert isinstance(made, SimulatedRecording)
    assert list(made.sensors) == ["l_leg_ft"]


def test_every_script_runs_somewhere() -> None:
    """What is not marked is told of here, script by script, and the test that runs it reads that page."""
    scripts = Counter({_name(page): len(unmarked(page.read_text(encoding="utf-8"))) for page in PAGES})
    assert +scripts == Counter(name.partition(",")[0] for name in RUN_ELSEWHERE)
    for name, test in RUN_ELSEWHERE.items():
        assert Path(name.partition(",")[0]).name in (ROOT / test).read_text(encoding="utf-8")


def _name(page: Path) -> str:
    """Path below the folder of pages."""
    return page.name if page.parent == ROOT else page.relative_to(ROOT / "docs").as_posix()


def test_scripts_are_told_apart() -> None:
    """Negative control: a block without marks is no marked one."""
    page = "<!-- example -->\n```python\na\n```\n<!-- /example -->\n\n```python\nb\n```\n"
    assert (marked(page), unmarked(page)) == (["a\n"], ["b\n"])
