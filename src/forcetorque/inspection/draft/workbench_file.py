# SPDX-License-Identifier: BSD-3-Clause
"""Draft of a workbench file from a table of readings under known loads."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, Final

from forcetorque.base.errors import ExperimentError, FormatError, MissingFileError
from forcetorque.base.output_file import relative_path
from forcetorque.base.wrench import WRENCH_COMPONENTS, WRENCH_UNITS
from forcetorque.experiment.workbench_file import THESIS_TABLE
from forcetorque.formats.headings import Heading, is_time_name, read_heading, without_bracket
from forcetorque.formats.log_format import LogSketch
from forcetorque.inspection.draft.column_matches import column_matches, time_column
from forcetorque.inspection.draft.drafted_streams import DraftedLog
from forcetorque.inspection.draft.toml_lines import line, listed, question, remark, toml_value

BENCH_SCHEMA: Final = "forcetorque/bench/1"
"""Form of a workbench file."""
_KNOWN = re.compile(r"^(?:known|applied|load|loads|reference|ref|true)[ _./-]+(?P<rest>.+)$", re.IGNORECASE)
_KNOWN_BEHIND = re.compile(r"^(?P<rest>.+?)[ _./-]+(?:known|applied|reference|ref|true)$", re.IGNORECASE)
_COMPONENT = re.compile(
    r"^(?P<kind>force|f|torque|moment|tau|t|m)[ _./-]*(?P<axis>[xyz])(?:[ _./-]+(?P<unit>\S+))?$", re.IGNORECASE
)
"""Component of a load, and behind it what may be a unit that is not known."""
_FORCES = ("force", "f")
_NUMBERS = re.compile(r"^(?:position|pos|row|no|nr|number|index|#)\.?$", re.IGNORECASE)
"""Names of columns that number the rows."""


def is_bench(content: Mapping[str, Any]) -> bool:
    """Find out whether a file is a workbench file.

    Args:
        content: Tables of the file, not checked.

    Returns:
        Whether its `schema` is that of a workbench file.
    """
    return content.get("schema") == BENCH_SCHEMA


def bench_table(log: DraftedLog, loads: str | None) -> LogSketch | None:
    """Find the table of readings under known loads.

    Args:
        log: The log.
        loads: The weights as the user names them; None where none are named.

    Returns:
        The table: one whose weights are named, or one without times that has columns of loads, such as `known_fx`;
        None for any other log.

    Raises:
        ExperimentError: If weights are named beside what is not one table.
        FormatError: If the table has a form that workbench files cannot state.
    """
    tables = [stream.table for stream in log.streams]
    table = tables[0] if len(tables) == 1 and log.format == "tabular" else None
    if table is None:
        if loads is not None:
            raise ExperimentError(f"--loads {loads}: expected one table of readings (CSV, TSV), got another log")
        return None
    if loads is None and (_has_time(table) or not _known_columns(table)):
        return None
    if table.skipped or table.names_apart or table.decimal != "." or table.delimiter is None:
        raise FormatError(
            f"{table.path}: expected a text table with one line of headings, or none, and decimal points, for a "
            "workbench file; write it so"
        )
    return table


def bench_lines(table: LogSketch, loads: str | None, folder: Path) -> list[str]:
    """Write a workbench file.

    Args:
        table: Readings, one row of means per position.
        loads: Table of weights, `thesis-6.1`, or the table of readings itself where its columns have the loads; None
            where its headings name them.
        folder: Folder of the workbench file, from which paths count.

    Returns:
        Its lines.

    Raises:
        MissingFileError: If there is no such table of weights.
    """
    in_table = loads is None or (loads != THESIS_TABLE and Path(loads).resolve() == table.path.resolve())
    known = _known_columns(table) if in_table else {}
    channels = _channels(table, set(known.values()))
    others = [heading for k, heading in enumerate(_headings(table)) if k not in channels]
    if len(known) < len(WRENCH_COMPONENTS) and any(map(_is_unread_load, others)):
        known = {}  # else the sensor would be one of fewer components
    components = [name for name in WRENCH_COMPONENTS if name in known]
    lines = ['# What is "?" is a question: put the answer there. `forcetorque init --resume` asks one by one.']
    lines += [line("schema", BENCH_SCHEMA), "", "[sensor]", line("name", table.path.stem)]
    lines += [
        question("serial", "its serial number, or another mark that tells it from others"),
        question(
            "measure_direction",
            'who acts on whom in a reading: "child_to_parent" if a hanging weight reads down, "parent_to_child" if up',
        ),
        question("full_scale", f"largest magnitude of a reading, in its unit{_range(table, channels)}"),
    ]
    if components and len(components) < len(WRENCH_COMPONENTS):
        lines.append(line("components", components, "of which the table has the loads"))
        words = "largest fx, fy, fz, tx, ty, tz to come, as [100, 100, 200, 10, 10, 10]; N, N m"
        lines.append(question("load_full_scale", words))
    if in_table and not known:
        lines += [
            '# components = ["fx", "fy", "fz"]  # of a sensor that measures fewer than six, with the line below',
            "# load_full_scale = [100, 100, 200, 10, 10, 10]  # largest fx, fy, fz, tx, ty, tz to come; N, N m",
        ]
    lines.append(
        '# prior = "matrix.txt"  # matrix that the sensor came with; "identity" where the readings are wrenches'
    )
    if not in_table and loads is not None:
        if loads != THESIS_TABLE and not Path(loads).is_file():
            raise MissingFileError(f"--loads {loads}: expected a table of weights (CSV) or {THESIS_TABLE}, got no file")
        shown = loads if loads == THESIS_TABLE else relative_path(Path(loads), folder)
        words = "a row per row of the readings, in the same order"
        lines += ["", "[loads]", line("table", shown, words)]
    lines += ["", "[measurements]", line("format", "rows"), line("file", relative_path(table.path, folder))]
    if table.delimiter != ",":
        lines.append(line("delimiter", table.delimiter))
    names = [column.name for column in table.columns]
    if table.names_specified:
        lines.append(line("columns", names, "as specified by who began this file"))
    elif not table.has_headings:
        lines.append(question("columns", f"a name for each of the {len(names)} columns"))
    lines += _columns_lines(names, channels, known, in_table=in_table)
    return lines


def logs_of_bench(content: Mapping[str, Any]) -> tuple[str, ...]:
    """Name the files that a workbench file reads its measurements of.

    Args:
        content: Tables of the file, not checked.

    Returns:
        The files, as they are named.
    """
    readings = content.get("measurements", {})
    files = readings.get("files", ())
    return tuple(map(str, [readings["file"]] if "file" in readings else [files] if isinstance(files, str) else files))


def _columns_lines(
    names: Sequence[str], channels: Sequence[int], known: Mapping[str, str], *, in_table: bool
) -> Iterator[str]:
    rest = [name for name in names if name not in known.values()]
    if channels:
        yield line("channels", [names[k] for k in channels], "columns of the sensor")
    else:
        yield question("channels", f"columns of the sensor, among {listed(rest)}")
    if not in_table:
        return
    yield "# series_from_zero = true  # where every row without load begins a series, and is its bias"
    if not known:
        yield question("known", f"columns of the load fx fy fz tx ty tz, or of those measured, among {listed(rest)}")
        yield question("known_units", 'unit of each, as ["N", "N", "N", "N m", "N m", "N m"]')
        return
    yield line("known", list(known.values()), "columns of the load")
    taken = {names[k] for k in channels}
    if unused := [name for name in rest if name not in taken and _of_load(name)]:
        yield remark(f"named like a load, and not taken: {listed(unused)}")
    units = [read_heading(name).unit for name in known.values()]
    if all(units):
        yield line("known_units", units)
        return
    usual = [unit for name, unit in zip(WRENCH_COMPONENTS, WRENCH_UNITS, strict=True) if name in known]
    strange = [name for name in known.values() if read_heading(name).unit is None and _has_strange_unit(name)]
    likely = [
        unit or ("?" if name in strange else other)
        for name, unit, other in zip(known.values(), units, usual, strict=True)
    ]
    of = f"; not known: {listed(strange)}" if strange else ""
    yield question("known_units", f"unit of each, as {toml_value(likely)}{of}", None if strange else likely)


def _headings(table: LogSketch) -> list[Heading]:
    return [read_heading(column.name) for column in table.columns]


def _has_time(table: LogSketch) -> bool:
    """Whether a column is like a time, and is none of the numbers of rows."""
    headings = _headings(table)
    k = time_column(headings, [column.step for column in table.columns])
    if k is None or is_time_name(headings[k].name):
        return k is not None
    column = table.columns[k]
    first, last = column.smallest, column.largest
    numbered = column.step == 1.0 and first is not None and first in (0.0, 1.0) and last == first + column.rows - 1
    return not (numbered or _NUMBERS.match(headings[k].name))


def _of_load(name: str) -> str | None:
    """What a column of a known load is named beside that, without its unit; None for other columns."""
    bare, _ = without_bracket(name)  # also of a unit that is not known: it is asked
    named = _KNOWN.match(bare) or _KNOWN_BEHIND.match(bare)
    return None if named is None else named["rest"]


def _load_component(heading: Heading) -> re.Match[str] | None:
    return _COMPONENT.match(_of_load(heading.name) or "")


def _is_unread_load(heading: Heading) -> bool:
    return _of_load(heading.name) is not None and _load_component(heading) is None


def _has_strange_unit(name: str) -> bool:
    parts = _load_component(read_heading(name))
    return without_bracket(name)[1] is not None or (parts is not None and parts["unit"] is not None)


def _known_columns(table: LogSketch) -> dict[str, str]:
    """Columns of the load by component, in the order of a wrench; none without a force."""
    found: dict[str, str] = {}
    named = [(parts, one.text) for one in _headings(table) if (parts := _load_component(one)) is not None]
    for parts, text in sorted(named, key=lambda one: one[0]["unit"] is not None):
        kind = "f" if parts["kind"].lower() in _FORCES else "t"
        found.setdefault(f"{kind}{parts['axis'].lower()}", text)
    return {name: found[name] for name in WRENCH_COMPONENTS if name in found}


def _channels(table: LogSketch, known: set[str]) -> tuple[int, ...]:
    """Columns of the sensor: what is like a wrench or raw channels, or all that are left if they are six."""
    places = [k for k, column in enumerate(table.columns) if column.name not in known]
    if not (table.has_headings or table.names_specified):
        return ()
    headings = [read_heading(table.columns[k].name) for k in places]
    matches = [group for group in column_matches(headings, ()) if group.quantity in ("wrench", "raw")]
    if len(matches) == 1:
        return tuple(places[k] for k in matches[0].columns)
    return tuple(places) if len(places) == len(WRENCH_COMPONENTS) else ()


def _range(table: LogSketch, channels: Sequence[int]) -> str:
    columns = [table.columns[k] for k in channels]
    low = min((c.smallest for c in columns if c.smallest is not None), default=None)
    high = max((c.largest for c in columns if c.largest is not None), default=None)
    return "" if low is None or high is None else f", as 32768 of 16 bits; they run from {low:.4g} to {high:.4g}"
