# SPDX-License-Identifier: BSD-3-Clause
"""A correction is written where the text has exactly the effect that was tried, else by hand."""

from __future__ import annotations

import tomllib
from dataclasses import replace

import pytest

from forcetorque.inspection.draft.corrections import Correction

MOUNT = {"rotation_deg": [0.0, 0.0, 0.0], "shift_mm": [0.0, 0.0, 0.0]}
CORRECTION = Correction(table="sensor", index=0, key="mount", value="unknown", tried=MOUNT, owner="ft")
BY_HAND = "write mount = \"unknown\" in [[sensor]] 'ft'"
HEAD = '[[sensor]]\nname = "ft"\n'


@pytest.mark.parametrize("mount", ["", "mount = { rotation_deg = [0, 0, 9], shift_mm = [0, 0, 0] }  # drawn\n"])
def test_a_key_of_one_line_is_written(mount: str) -> None:
    """Also one that is not there yet."""
    text = f"{HEAD}{mount}"
    edit = CORRECTION.edit(text, tomllib.loads(text))
    assert edit is not None
    assert tomllib.loads(edit.applied(text)) == {"sensor": [{"name": "ft", "mount": "unknown"}]}


@pytest.mark.parametrize(
    "text",
    [
        f"{HEAD}\n[sensor.mount]\nrotation_deg = [0, 0, 9]\nshift_mm = [0, 0, 0]\n",
        f"{HEAD}mount.rotation_deg = [0, 0, 9]\nmount.shift_mm = [0, 0, 0]\n",
        'sensor = [{ name = "ft" }]\n',
    ],
)
def test_a_key_in_another_form_is_changed_by_hand(text: str) -> None:
    """A table of its own, keys with a point, a list in one line."""
    assert CORRECTION.edit(text, tomllib.loads(text)) is None
    assert CORRECTION.by_hand == BY_HAND
    assert CORRECTION.content(tomllib.loads(text), MOUNT)["sensor"] == [{"name": "ft", "mount": MOUNT}]


def test_a_clock_is_added_in_front_of_the_sensors() -> None:
    """Or named, where sensors have no header."""
    clock = {"stream": "ft", "to": "joints", "delay_s": 0.1}
    correction = Correction(table="clock", index=None, key="", value=clock, tried=clock)
    edit = correction.edit(HEAD, tomllib.loads(HEAD))
    assert edit is not None
    assert tomllib.loads(edit.applied(HEAD))["clock"] == [clock]
    inline = 'sensor = [{ name = "ft" }]\n'
    assert correction.edit(inline, tomllib.loads(inline)) is None
    assert correction.by_hand == 'write [[clock]] stream = "ft", to = "joints", delay_s = 0.1'
    others = edit.applied(HEAD)
    first = replace(correction, is_first=True)
    before = first.edit(others, tomllib.loads(others))
    assert before is not None
    assert before.line == edit.line, "in front of the clock that is there"
    assert first.by_hand == f"{correction.by_hand}, in front of the others"
