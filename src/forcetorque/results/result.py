# SPDX-License-Identifier: BSD-3-Clause
"""The base of all results, its date and samples left out, and which results there are by the names of schemas."""

from __future__ import annotations

import csv
import json
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from datetime import UTC, datetime
from functools import cache
from importlib import import_module
from io import StringIO
from pathlib import Path
from pkgutil import walk_packages
from types import ModuleType
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Self

from pydantic import Field

from forcetorque.base.errors import ForceTorqueError, ShapeError, needs_extra
from forcetorque.base.lazy import named
from forcetorque.results.answer import Answer, answer_text
from forcetorque.results.table import Row, Shown, Table, optional_table
from forcetorque.results.table_rendering import html_lines, html_table, html_text, html_warnings, table_text, wrapped

if TYPE_CHECKING:
    from matplotlib.figure import Figure


class UnusableSamples(Row):
    """What is left out of one interval of one sensor."""

    sensor: Annotated[str, Shown("sensor")]
    """Sensor."""
    recording: Annotated[str, Shown("recording")]
    """Name of the experiment."""
    interval: Annotated[str, Shown("interval")]
    """Label of the interval."""
    use: Annotated[str, Shown("use")]
    """Use of the interval."""
    samples: Annotated[int, Shown("of samples")]
    """Number of its samples."""
    frozen: Annotated[int, Shown("frozen")]
    """Samples in which all channels repeat one reading although the log is noisy, or the expected wrench moves."""
    saturated: Annotated[int, Shown("saturated")]
    """Samples at the limit of the converter, or held by a board that says so."""
    repeated: Annotated[int, Shown("repeated")]
    """Messages whose stamp does not step forward, or that repeat the reading before under a new stamp."""


_UNUSABLE = "unusable_samples"
NOTEBOOK_WIDTH = 100
"""Characters of a line where nobody says how wide the page is."""


class Result(Row):
    """Result of an analysis. Its class for every analysis adds a field `schema`, rows and tables."""

    of_several: ClassVar[tuple[str, ...]] = ()
    """Fields that are not in the JSON where they are empty, such as those about each of several recordings."""

    interval_uses: ClassVar[tuple[str, ...] | None] = None
    """Uses of the intervals whose samples it is made from, all but ignored ones where it is empty; None for no samples,
    or where it does not count what it leaves out."""

    answered_by: ClassVar[str | None] = None
    """Function that gives the answer, or an iterable of them, as `module:name`; None where `answers` is written out."""

    warnings: tuple[str, ...] = Field(default=(), exclude=True)
    """Reasons to doubt the result, in sentences; messages, not part of the JSON."""

    unusable_samples: tuple[UnusableSamples, ...] = Field(default=(), exclude=True)
    """Samples that are left out because they say nothing of the load; in the JSON where there are any."""

    @property
    def passed(self) -> bool:
        """Whether it is as it should be."""
        return True

    @property
    def exit_code(self) -> int:
        """How a command ends that shows it: 0 where it is as it should be, else 1."""
        return 0 if self.passed else 1

    @property
    def details_options(self) -> str:
        """Options by which the same command shows the details."""
        return "--details"

    def answers(self) -> Iterator[Answer]:
        """Give the answer in a few lines.

        Yields:
            One per sensor or thing; nothing where the tables are the answer.
        """
        if self.answered_by is not None:
            given = named(self.answered_by)(self)
            yield from (given,) if isinstance(given, Answer) else given

    def blocks(self) -> Iterator[Table | str]:
        """Give the details that people read, in their order; every class has its own.

        Yields:
            Tables and sentences.
        """
        yield from ()

    def records(self) -> list[dict[str, object]]:
        """Give the result as flat records of numbers, for CSV.

        Returns:
            One line per row of the first list of rows; classes that hold several say what each line is.
        """
        for name in type(self).model_fields:
            value = getattr(self, name)
            if name == _UNUSABLE:
                continue
            if isinstance(value, tuple) and value and all(isinstance(entry, Row) for entry in value):
                return [entry.flat() for entry in value]
        return []

    def csv_text(self) -> str:
        """Give the records as CSV.

        Returns:
            Text with a header.
        """
        text = StringIO()
        writer = csv.DictWriter(text, fieldnames=self.columns(), lineterminator="\n")
        writer.writeheader()
        writer.writerows(self.records())
        return text.getvalue()

    def columns(self) -> list[str]:
        """Name the columns of the CSV.

        Returns:
            The keys of all records in the order in which they come; of the rows that there might be, where there are
            none.
        """
        return list(dict.fromkeys(name for record in self.records() for name in record))

    def to_pandas(self) -> Any:
        """Give the records as a table of pandas.

        Returns:
            `pandas.DataFrame` with a line per record.

        Raises:
            MissingExtraError: If pandas is not installed.
        """
        with needs_extra("to_pandas needs pandas", "frames"):
            import pandas
        return pandas.DataFrame(self.records(), columns=self.columns())

    def text(self, width: int = NOTEBOOK_WIDTH) -> str:
        """Write the result as text for people: the answer, and the details.

        Args:
            width: Characters of a line; narrow ones get tables on their side, never a folded number.

        Returns:
            Lines, each with its end.
        """
        return "\n".join(filter(None, (self._answer(width), self.details(width))))

    def details(self, width: int = NOTEBOOK_WIDTH) -> str:
        """Write tables and sentences without the answer.

        Args:
            width: As of `text`.

        Returns:
            Lines, each with its end.
        """
        return "".join(
            f"{wrapped(block, width)}\n" if isinstance(block, str) else table_text(block, width)
            for block in self._shown()
        )

    def json_text(self) -> str:
        """Write the result as JSON.

        Returns:
            One object with stable keys.
        """
        content = self.model_dump(mode="json", by_alias=True)
        first = {"schema": content.pop("schema")} if "schema" in content else {}
        stated = first | {name: value for name, value in content.items() if value or name not in self.of_several}
        if self.unusable_samples:
            stated[_UNUSABLE] = [row.model_dump(mode="json", by_alias=True) for row in self.unusable_samples]
        return json.dumps(stated, indent=2, allow_nan=False)

    def cautions(self) -> Iterator[str]:
        """Give the warnings.

        Yields:
            Every warning once, with how often it comes.
        """
        for sentence, count in Counter(self.warnings).items():
            yield sentence if count == 1 else f"{sentence} ({count} times)"

    def __str__(self) -> str:
        # the command line has standard error for warnings; a script that prints a result has no other place
        doubtful = "".join(f"{wrapped(f'warning: {sentence}', NOTEBOOK_WIDTH)}\n" for sentence in self.cautions())
        return "\n".join(filter(None, (self._answer(NOTEBOOK_WIDTH), doubtful, self.details())))

    def _answer(self, width: int) -> str:
        return answer_text(tuple(self.answers()), width)

    def _repr_html_(self) -> str:
        return (
            html_lines(self._answer(NOTEBOOK_WIDTH))
            + html_warnings(self.cautions())
            + "".join(
                f"<p>{html_text(block)}</p>" if isinstance(block, str) else html_table(block) for block in self._shown()
            )
        )

    def _shown(self) -> Iterator[Table | str]:
        """What people read, and what is left out."""
        yield from self.blocks()
        yield from self._unusable()

    def _unusable(self) -> Iterator[Table]:
        yield from optional_table(self.unusable_samples, "unusable samples, which are left out")

    @classmethod
    def described(cls) -> dict[str, Any]:
        """Describe the JSON.

        Returns:
            Its JSON schema.
        """
        schema = cls.model_json_schema(mode="serialization")
        schema["required"] = [name for name in schema.get("required", ()) if name not in cls.of_several]
        if cls.interval_uses is not None:
            rows = {"type": "array", "items": UnusableSamples.model_json_schema(mode="serialization")}
            schema["properties"][_UNUSABLE] = rows | {"description": cls.model_fields[_UNUSABLE].description or ""}
        return schema

    @classmethod
    def together(cls, results: Iterable[Self]) -> Self:
        """Put the results of several sensors of one experiment together.

        Args:
            results: Results of one class, at least one.

        Returns:
            One with the rows and warnings of all; what is no list is that of the first.

        Raises:
            ShapeError: If there is none.
        """
        parts: Sequence[Self] = tuple(results)
        if not parts:
            raise ShapeError(f"{cls.__name__}: expected at least one result to put together, got none")
        joined: dict[str, Any] = {}
        for name in cls.model_fields:
            values = [getattr(part, name) for part in parts]
            if isinstance(values[0], tuple):
                # a warning or a sentence that several sensors share is said once
                entries = [entry for value in values for entry in value]
                once = name == _UNUSABLE or _are_words(entries)
                joined[name] = tuple(dict.fromkeys(entries)) if once else tuple(entries)
        return parts[0].model_copy(update=joined)


class DrawnResult(Result):
    """Result with a figure, which `--figure` of its command writes as PNG, SVG or PDF."""

    drawn_by: ClassVar[str]
    """Function that draws it, as `module:name`; classes with a `figure` of their own have none."""
    drawn_fields: ClassVar[tuple[str, ...]] = ()
    """Fields or properties that this function takes; the result itself if there are none."""
    outlives_figure: ClassVar[bool] = False
    """Whether a figure that cannot be drawn is a warning: of what took long, or cannot be computed again."""

    figure_file: str | None = Field(default=None, alias="figure")
    """File of the figure; null where none was written."""

    def figure(self) -> Figure:
        """Draw the result.

        Returns:
            Figure of matplotlib, which a notebook shows.

        Raises:
            ForceTorqueError: If the result holds nothing to draw; MissingExtraError if matplotlib is not installed.
        """
        figure: Figure = named(self.drawn_by)(*([getattr(self, field) for field in self.drawn_fields] or [self]))
        return figure

    def without_figure(self, file: Path, error: ForceTorqueError | OSError) -> Self:
        """Give the result where its figure cannot be drawn.

        Args:
            file: The figure.
            error: Why it is not there.

        Returns:
            The result with a warning, where it outlives its figure.

        Raises:
            ForceTorqueError: In all other results.
            OSError: As above.
        """
        if not self.outlives_figure:
            raise error
        return self.model_copy(update={"warnings": (*self.warnings, f"not drawn: {error}")})

    def _shown(self) -> Iterator[Table | str]:
        yield from self.blocks()
        if self.figure_file is not None:
            yield f"drawn to {self.figure_file}"
        yield from self._unusable()


def _are_words(entries: Sequence[Any]) -> bool:
    return all(isinstance(entry, str) for entry in entries)


def created_now() -> str:
    """Say when it is.

    Returns:
        Date and time in UTC as ISO 8601 writes them, to the second.
    """
    return datetime.now(UTC).isoformat(timespec="seconds")


_FAMILY = "forcetorque"
"""What names of schemas begin with: `forcetorque/NAME/VERSION`."""


def result_classes(*packages: ModuleType) -> dict[str, type[Result]]:
    """Find every result that packages give, so that a new one is known wherever results are.

    Args:
        packages: Packages; all modules below them are imported.

    Returns:
        Class by name of its schema, which is that of the command that shows it; sorted.
    """
    modules = {
        import_module(name).__name__
        for package in packages
        for name in _modules_below(package.__name__, tuple(package.__path__))
    }
    classes = {_name(kind): kind for kind in _below(Result) if kind.__module__ in modules}
    return {name: classes[name] for name in sorted(classes) if name}


@cache
def _modules_below(package: str, folders: tuple[str, ...]) -> frozenset[str]:
    """Names of the modules of a package; its folders are walked once, which takes longer than all else here."""
    return frozenset(module.name for module in walk_packages(folders, f"{package}."))


def _below(kind: type[Result]) -> Iterator[type[Result]]:
    for child in kind.__subclasses__():
        yield child
        yield from _below(child)


def _name(kind: type[Result]) -> str:
    """The name within the schema; empty for what is only a part of other results."""
    field = kind.model_fields.get("schema_name")
    words = [] if field is None else str(field.default).split("/")
    return words[1] if words[:1] == [_FAMILY] else ""
