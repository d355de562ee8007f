# SPDX-License-Identifier: BSD-3-Clause
"""What commands print on the examples at 80 characters: 12 lines for one sensor, one more for each further one."""

from __future__ import annotations

from pathlib import Path

import pytest

from forcetorque.results.answer import MOST_LINES, STANDARD_WIDTH
from tests.app.outcome import Outcome, typed

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
LEG, CONTACTS, SPHERE = "02_icub_yoga_forward.toml", "08_icub_yoga_contacts.toml", "12_icub_yoga_sphere.toml"
COMMANDS: dict[str, int] = {
    f"accept {LEG} --spec 11_acceptance.toml -c leg.json --population {{data}}/icub_workbench_matrices": 1,
    f"bench gains {LEG}": 1,
    f"calibrate {LEG} -o other.json": 1,
    f"calibrate {CONTACTS} -o both": 2,
    f"estimate {CONTACTS} -o contacts.parquet": 2,
    f"evaluate {LEG} -c leg.json": 1,
    "export leg.json --to csv -o leg.csv": 1,
    f"inspect {LEG}": 1,
    f"inspect {CONTACTS}": 2,
    "inspect 07_wrist_payload.toml": 1,
    "inspect 16_insole_fit.toml": 1,
    "inspect 25_wrist_clocks.toml": 1,
    "payload 07_wrist_payload.toml": 1,
    "payload 26_wrist_base_frame.toml": 1,
    f"plan {LEG} -c leg.json --recordings 1 --clearance-deg 10 --seconds 20": 1,
    "robot balance 21_icub_walking_forces.toml": 1,
    "robot balance 24_icub_com_sinusoid.toml": 1,
    "robot coherence 23_icub_yoga_switching.toml": 1,
    "robot motion 24_icub_com_sinusoid.toml --column net_force": 1,
    "skin calibrate 16_insole_fit.toml -o sole.json": 1,
    f"study sphere {SPHERE}": 3,
    f"study validate {LEG} -c leg.json": 1,
}
"""What is typed, and the number of sensors that it is about."""

pytestmark = [pytest.mark.long, pytest.mark.real_data]


@pytest.fixture(scope="module")
def examples(data_dir: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The examples, and a calibration of one of them."""
    folder = tmp_path_factory.mktemp("examples")
    for example in EXAMPLES.glob("*.toml"):
        text = example.read_text(encoding="utf-8").replace("../../shared/data", data_dir.as_posix())
        (folder / example.name).write_text(text, encoding="utf-8")
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(folder)
        assert typed("calibrate", LEG, "-o", "leg.json").code == 0
    return folder


def _lines(ended: Outcome) -> int:
    """Lines on the screen of a result and its warnings; not of what tells how far the work is."""
    shown = [*ended.out.splitlines(), *(line for line in ended.err.splitlines() if not line.startswith("INFO: "))]
    return sum(-(-max(len(line), 1) // STANDARD_WIDTH) for line in shown)


@pytest.mark.parametrize("command", COMMANDS)
def test_an_answer_fits_twelve_lines(
    examples: Path, data_dir: Path, monkeypatch: pytest.MonkeyPatch, command: str
) -> None:
    """Whatever the data are, what was found in them, and the files are called."""
    monkeypatch.chdir(examples)
    words = command.format(data=data_dir).split()
    ended = typed(*words, columns=STANDARD_WIDTH)
    codes = (0, 1, 3) if words[0] == "accept" else (0, 1)  # 3: `accept` leaves a sensor undecided
    assert ended.code in codes, ended.err
    assert ended.out.endswith("details: --details\n")
    assert 1 < _lines(ended) <= MOST_LINES + COMMANDS[command] - 1, ended.out + ended.err


def test_details_have_more_lines(examples: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Negative control: what is counted is all that is shown."""
    monkeypatch.chdir(examples)
    ended = typed("inspect", LEG, "--details", columns=STANDARD_WIDTH)
    assert _lines(ended) > MOST_LINES
    assert _lines(Outcome(code=0, out="", err=f"WARNING: {STANDARD_WIDTH * 'x'}\n")) == 2
