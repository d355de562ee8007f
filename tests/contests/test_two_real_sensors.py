# SPDX-License-Identifier: BSD-3-Clause
"""Two sensors of one leg of a real robot meet in one contest, which names that they do not carry one load."""

from __future__ import annotations

from pathlib import Path

import pytest

from forcetorque.contests.commands import contest
from forcetorque.contests.contest_file import read_entries

YOGA = Path(__file__).parents[2] / "examples" / "04_icub_yoga_quiet.toml"
FOOT_STREAM = """\
[[recording.stream]]
kind = "analog"
name = "right_foot_ft"
port = "right_foot/analog:o"

[[recording.stream]]
kind = "state_ext"
name = "left_leg"
"""
FOOT = """\
[[sensor]]
name = "r_foot_ft_sensor"
stream = "right_foot_ft"
serial = "SN230"
prior = "{folder}/sensorCalibMatrices/matrix_SN230.txt"

[processing]
"""
INTERVAL = """\
[[interval]]
label = "free"
start_s = 31.5
end_s = 58.0
use = "validation"
support = "l_sole"
"""
CONTEST = """\
schema = "forcetorque/contestants/1"
name = "two sensors of one leg"
run = [{ experiment = "yoga.toml", load_kg = 0 }]

[[contestant]]
name = "leg"
sensor = "r_leg_ft_sensor"
method = "maker"

[[contestant]]
name = "foot"
sensor = "r_foot_ft_sensor"
method = "maker"
"""


@pytest.mark.real_data
def test_sensors_of_one_leg_do_not_carry_one_load(data_dir: Path, tmp_path: Path) -> None:
    """Both are read and judged over the same motion; the foot carries less, which the contest says."""
    folder = (data_dir / "icub_genova02_yoga").as_posix()
    text = YOGA.read_text().replace("../../shared/data/icub_genova02_yoga", folder)
    text = text.replace('[[recording.stream]]\nkind = "state_ext"\nname = "left_leg"\n', FOOT_STREAM)
    text = text.replace("[processing]\n", FOOT.format(folder=folder))
    (tmp_path / "yoga.toml").write_text(text[: text.index("[[interval]]")] + INTERVAL)
    (tmp_path / "contest.toml").write_text(CONTEST)
    answer = contest(read_entries(tmp_path / "contest.toml"))
    judged = {row.contestant: row.validated_N for row in answer.contestants}
    assert 3.0 * judged["foot"] < judged["leg"] < 5.0 * judged["foot"]
    assert sum("they do not carry one load" in words for words in answer.warnings) == 2  # in N, in N m
    assert (answer.comparable, answer.winner) == (False, None)
    assert next(iter(answer.answers())).verdict == "NOT COMPARABLE"
