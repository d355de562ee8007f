# SPDX-License-Identifier: BSD-3-Clause
"""The check that results show themselves can fail."""

from __future__ import annotations

from collections.abc import Iterator

from forcetorque.results.result import Result
from forcetorque.results.table import Table
from tests.results.showing import folded, require_shown


class _Whole(Result):
    def blocks(self) -> Iterator[Table | str]:
        yield Table(caption="", headings=("channel", "counts"), rows=(("ch0", "-12345.678"),))


class _Folded(_Whole):
    def text(self, width: int = 100) -> str:
        return super().text(width).replace("-12345.678", "-12345.\n678")


def test_a_folded_number_is_noticed() -> None:
    """Negative control: a number on two lines stands in none of them."""
    require_shown(_Whole())
    assert folded(_Folded(), 60) == {"-12345.678"}


def test_print_and_page_say_what_is_doubtful() -> None:
    """Once each and before the answer, as the command line does on standard error; the text alone does without."""
    doubtful = _Whole(warnings=("fx < fy in 3 % of it", "no offset", "no offset"))
    require_shown(doubtful)
    assert str(doubtful).startswith("warning: fx < fy in 3 % of it\nwarning: no offset (2 times)\n\n")
    assert doubtful._repr_html_().startswith("<p><b>warning:</b> fx &lt; fy in 3\N{NO-BREAK SPACE}% of it</p>")
    assert "warning" not in doubtful.text()
    assert str(_Whole()) == _Whole().text()
