# SPDX-License-Identifier: BSD-3-Clause
"""Changes of single keys of a TOML file: the rest keeps its comments, its order and its spaces."""

from __future__ import annotations

import tomllib

import pytest

from forcetorque.inspection.draft.toml_edits import Edit, interval_edit, key_edit, table_edit

TEXT = """# an experiment
name = "a # b"

[[sensor]]
name = "one"   # the first
full_scale = [
  1,  # fx
  2,
]

# of the second
[[sensor]]
name = "two"

[[interval]]
label = "all"  # by eye
start_s = 0.0
use = "calibration"

[[interval]]
label = "rest"
start_s = 9.0
use = "ignore"  # nobody looked
"""


def _changed(edit: Edit | None, text: str = TEXT) -> str:
    assert edit is not None
    return edit.applied(text)


def test_a_value_keeps_its_comment_and_a_list_its_place() -> None:
    """One line is another; a list of several lines becomes one, and the tables behind it stay."""
    name = _changed(key_edit(TEXT, "sensor", 0, "name", "x"))
    assert name == TEXT.replace('name = "one"   # the first', 'name = "x"   # the first')
    scale = _changed(key_edit(TEXT, "sensor", 0, "full_scale", [3, 4]))
    assert "full_scale = [3, 4]\n\n# of the second\n[[sensor]]" in scale


def test_comments_around_a_list_of_several_lines_stay() -> None:
    """Those of the first and last line; a separator in a comment is no end of a line."""
    text = "[a]\nb = [  # of\n  1,\n]  # it\u2028all\nc = 2\n"
    assert _changed(key_edit(text, "a", 0, "b", [3]), text) == "[a]\nb = [3]  # of  # it\u2028all\nc = 2\n"


def test_a_new_key_is_the_last_of_its_table() -> None:
    """Before the comment on the next table; behind a key that is named."""
    assert 'name = "two"\nserial = "S"\n\n[[interval]]' in _changed(key_edit(TEXT, "sensor", 1, "serial", "S"))
    behind = _changed(key_edit(TEXT, "interval", 0, "end_s", 2.0, behind="start_s"))
    assert 'start_s = 0.0\nend_s = 2.0\nuse = "calibration"' in behind


def test_a_table_is_put_in_front_of_another_and_its_comments() -> None:
    """All other lines stay."""
    text = _changed(table_edit(TEXT, "clock", {"stream": "a", "delay_s": 0.1}, before="interval"))
    assert text.replace('[[clock]]\nstream = "a"\ndelay_s = 0.1\n\n', "") == TEXT


def test_an_interval_is_replaced_by_its_pieces() -> None:
    """Each has what else the interval has; one without changes stays as it is."""
    pieces = [{"label": "all 1", "end_s": 3.0}, {"label": "all 2", "start_s": 5.0, "use": "validation"}]
    text = _changed(interval_edit(TEXT, [pieces, [{}]]))
    intervals = tomllib.loads(text)["interval"]
    assert [one["label"] for one in intervals] == ["all 1", "all 2", "rest"]
    assert intervals[0] == {"label": "all 1", "start_s": 0.0, "end_s": 3.0, "use": "calibration"}
    assert text.count("# by eye") == 2
    assert text.startswith(TEXT[: TEXT.index("[[interval]]")])
    assert text.endswith(TEXT[TEXT.index('label = "rest"') :])


@pytest.mark.parametrize("text", ['interval = [{ label = "a" }]\n', 'note = """\n[[interval]]\n"""\n'])
def test_tables_without_a_header_are_not_changed(text: str) -> None:
    """A list of inline tables, and a header in a text."""
    assert interval_edit(text, [[{}]]) is None
    assert key_edit(text, "interval", 0, "label", "b") is None
