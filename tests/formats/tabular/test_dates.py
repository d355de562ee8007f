# SPDX-License-Identifier: BSD-3-Clause
"""Dates in place of times: every digit counts, a zone is what it says, and what is no date is refused by its line."""

from __future__ import annotations

import re
from datetime import UTC, datetime, timedelta, timezone
from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
from hypothesis import HealthCheck, given, settings, strategies as st

from forcetorque.base.errors import FormatError
from forcetorque.formats.tabular.log_format import is_table, sketch_table
from forcetorque.formats.tabular.table import read_table
from forcetorque.formats.tabular.table_layout import StampColumn, TableLayout, TableSignal

NS_0 = 1795428303_000_000_000
"""2026-11-23 10:05:03 UTC."""
ZONES = (None, UTC, timezone(timedelta(hours=1)), timezone(timedelta(hours=-9, minutes=-30)))
DATES = [f"2026-11-23T10:05:0{k}.25" for k in range(3, 7)]


def _layout(*, unit: str = "iso8601", delimiter: str = ",", decimal: str = ".") -> TableLayout:
    signal = TableSignal(quantity="scalar", columns=("u", "i"), units=("V", "A"))
    return TableLayout(
        delimiter=delimiter, decimal=decimal, stamp=StampColumn(column="t", unit=unit), signals=(signal,)
    )


def _text(dates: list[str], *, delimiter: str = ",", numbers: str = "4.9") -> str:
    lines = [f"t{delimiter}u{delimiter}i", *(f"{date}{delimiter}{numbers}{delimiter}{numbers}" for date in dates)]
    return "\n".join(lines) + "\n"


def _stamps(folder: Path, text: str, layout: TableLayout | None = None) -> list[int]:
    (folder / "log.csv").write_text(text, encoding="utf-8")
    (stream,) = read_table(folder / "log.csv", layout or _layout(), stream="supply", clock="pc").streams
    return [int(stamp) for stamp in stream.stamp_ns]


@pytest.mark.parametrize(
    ("date", "stamp_ns"),
    [
        ("2026-11-23T10:05:03", NS_0),
        ("2026-11-23 10:05", NS_0 - 3_000_000_000),
        ("2026-11-23 10:05:03.123456789", NS_0 + 123_456_789),
        ("2026-11-23T10:05:03.5Z", NS_0 + 500_000_000),
        ("2026-11-23T11:05:03+01:00", NS_0),
        ("2026-11-23T00:35:03-0930", NS_0),
        ('"2026-11-23 10:05:03"', NS_0),
        ("1969-12-31T23:59:59.999999999", -1),
    ],
)
def test_a_date_is_its_nanosecond(tmp_path: Path, date: str, stamp_ns: int) -> None:
    """With T or a blank, quoted or not, with a zone or, as if in UTC, without."""
    assert _stamps(tmp_path, _text([date] * 2)) == [stamp_ns] * 2


@given(
    st.lists(st.datetimes(datetime(1700, 1, 1), datetime(2200, 1, 1)), min_size=1, max_size=20), st.sampled_from(ZONES)
)
@settings(suppress_health_check=[HealthCheck.function_scoped_fixture], deadline=None)
def test_dates_are_those_of_the_standard_library(tmp_path: Path, days: list[datetime], zone: timezone | None) -> None:
    """Whatever day and zone, the stamps are its microseconds since 1970."""
    dates = [day.replace(tzinfo=zone).isoformat() for day in days]
    epoch = datetime(1970, 1, 1, tzinfo=UTC)
    microseconds = [(day.replace(tzinfo=zone or UTC) - epoch) // timedelta(microseconds=1) for day in days]
    assert _stamps(tmp_path, _text(dates)) == [1000 * us for us in microseconds]


def test_seconds_of_a_date_have_the_comma_of_the_table_or_a_point(tmp_path: Path) -> None:
    """Programs that write decimal commas write either."""
    layout = _layout(delimiter=";", decimal=",")
    text = _text([DATES[0], DATES[0].replace(".", ",")], delimiter=";", numbers="4,9")
    assert _stamps(tmp_path, text, layout) == [NS_0 + 250_000_000] * 2


@pytest.mark.parametrize(
    ("bad", "message"),
    [
        ("", "expected a date as 2026-11-23T10:05:03.123, got ''"),
        ("23.11.2026 10:05", "expected a date as 2026-11-23T10:05:03.123, got '23.11.2026 10:05'"),
        ("2026-13-23T10:05:03", "expected a day and time of the years 1678 to 2261, got '2026-13-23T10:05:03'"),
        ("3026-11-23T10:05:03", "expected a day and time of the years 1678 to 2261, got '3026-11-23T10:05:03'"),
        ("2026-11-23T10:05:60", "expected a day and time of the years 1678 to 2261, got '2026-11-23T10:05:60'"),
        ("2026-11-23T10:05:03Z", "expected a date with no zone, as the first one, got '2026-11-23T10:05:03Z'"),
        ("1795428303.25", "expected a date as 2026-11-23T10:05:03.123, got '1795428303.25'"),
    ],
)
def test_what_is_no_date_is_refused_by_its_line(tmp_path: Path, bad: str, message: str) -> None:
    """And a zone that others lack, or the other way round: an hour is never guessed."""
    with pytest.raises(FormatError, match=re.escape(f"log.csv:4: column 't': {message}")):
        _stamps(tmp_path, _text([*DATES[:2], bad, DATES[3]]))
    if bad.endswith("Z"):
        with pytest.raises(
            FormatError, match=re.escape(f"expected a date with a zone, as the first one, got {DATES[0]!r}")
        ):
            _stamps(tmp_path, _text([bad, DATES[0]]))


def test_dates_and_seconds_are_not_taken_for_each_other(tmp_path: Path) -> None:
    """The error says what to state."""
    with pytest.raises(FormatError, match=r"log\.csv:2: column 't': expected a time in s .*; specify unit = .iso8601"):
        _stamps(tmp_path, _text(DATES), _layout(unit="s"))
    pq.write_table(pa.table({"t": [1.0, 2.0], "u": [1.0, 1.0], "i": [1.0, 1.0]}), tmp_path / "log.parquet")
    with pytest.raises(FormatError, match=r"row 1: column 't': expected dates, as specified, got double; specify s"):
        read_table(tmp_path / "log.parquet", _layout(), stream="supply", clock="pc")


@pytest.mark.parametrize(
    "kind", [pa.timestamp("ms"), pa.timestamp("us", "Europe/Rome"), pa.string(), pa.large_string()]
)
def test_parquet_has_instants_or_texts(tmp_path: Path, kind: pa.DataType) -> None:
    """Instants count from 1970 in UTC whatever zone they are shown in."""
    stamps = pa.array([NS_0, NS_0 + 250_000_000], pa.timestamp("ns")).cast(pa.timestamp("ms")).cast(kind)
    table = pa.table({"t": stamps, "u": [1.0, 2.0], "i": [1.0, 2.0]})
    pq.write_table(table, tmp_path / "log.parquet")
    (stream,) = read_table(tmp_path / "log.parquet", _layout(), stream="supply", clock="pc").streams
    np.testing.assert_array_equal(stream.stamp_ns, [NS_0, NS_0 + 250_000_000])
    time = sketch_table(tmp_path / "log.parquet").columns[0]
    assert (time.unit, time.step, time.is_number) == ("iso8601", 0.25, False)


def test_an_instant_beyond_64_bits_is_refused(tmp_path: Path) -> None:
    """Milliseconds of the year 3000 are no nanoseconds."""
    late = pa.array([32503680000000], pa.timestamp("ms"))
    pq.write_table(pa.table({"t": late, "u": [1.0], "i": [1.0]}), tmp_path / "log.parquet")
    with pytest.raises(FormatError, match=r"row 1: column 't': expected instants of the years 1678 to 2261"):
        read_table(tmp_path / "log.parquet", _layout(), stream="supply", clock="pc")


@pytest.mark.parametrize("unit", ["s", "iso8601"])
def test_a_missing_instant_is_refused_by_its_row(tmp_path: Path, unit: str) -> None:
    """As an empty cell, not as a number that is none."""
    table = pa.table({"t": pa.array([NS_0, None], pa.timestamp("ns")), "u": [1.0, 2.0], "i": [1.0, 2.0]})
    pq.write_table(table, tmp_path / "log.parquet")
    with pytest.raises(FormatError, match=r"row 2: column 't': expected an instant, got an empty cell"):
        read_table(tmp_path / "log.parquet", _layout(unit=unit), stream="supply", clock="pc")


@pytest.mark.parametrize(
    ("text", "unit", "step"),
    [
        (_text(DATES), "iso8601", 1.0),
        (_text([date.replace(".", ",") for date in DATES], delimiter=";", numbers="4,9"), "iso8601", 1.0),
        (_text(DATES).split("\n", 1)[1], "iso8601", 1.0),
        (_text([DATES[0]] * 4), "iso8601", None),
        (_text([*DATES[:3], "2026-13-01T00:00:00"]), None, None),
    ],
    ids=["headings", "commas", "no headings", "no steps", "a thirteenth month"],
)
def test_a_table_that_nobody_declared_shows_its_dates(
    tmp_path: Path, text: str, unit: str | None, step: float | None
) -> None:
    """It is a table, and its column of dates has the step of a time, where all of them are."""
    (tmp_path / "log.csv").write_text(text, encoding="utf-8")
    assert is_table(tmp_path / "log.csv")
    time = sketch_table(tmp_path / "log.csv").columns[0]
    assert (time.unit, time.step, time.is_number) == (unit, step, False)
