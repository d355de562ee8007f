# SPDX-License-Identifier: BSD-3-Clause
"""TOML files with a checked form: unknown keys are errors, numbers are numbers, every error names its key."""

from __future__ import annotations

import json
import re
import tomllib
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any, TypeVar, get_args, get_origin

from pydantic import BaseModel, ConfigDict, Field, ValidationError, model_validator
from pydantic_core import ErrorDetails, PydanticCustomError

from forcetorque.base.errors import FormatError, MissingFileError, known_names
from forcetorque.base.input_file import require_file

_TABLES = ("model_type", "model_attributes_type", "dict_type")
_COMPARED = {
    "greater than or equal to ": "at least ",
    "greater than ": "more than ",
    "less than or equal to ": "at most ",
}


def expected_text(entry: ErrorDetails) -> str:
    """Say what was expected at one place of a table.

    Args:
        entry: One error of a validation.

    Returns:
        What was expected, without what is there instead.
    """
    if entry["type"] == "missing":
        return "expected this key, there is none"
    if entry["type"] == "union_tag_invalid":
        return f"expected one of {entry['ctx']['expected_tags']}"
    if entry["type"] in _TABLES:
        return "expected a table"
    if entry["type"] == "tuple_type":
        return "expected a list"
    if entry["type"] == "union_tag_not_found":
        return "expected this key, there is none"
    if entry["type"] == "too_short" and "ctx" in entry:
        least = entry["ctx"]["min_length"]
        return f"expected at least {least} value{'s' * (least > 1)}"
    if entry["type"] == "value_error":
        return entry["msg"].removeprefix("Value error, ")
    if entry["type"] == "extra_forbidden":
        return "expected no such key"
    words = entry["msg"].removeprefix("Input should be ")
    if words == entry["msg"]:
        return words
    for comparison, shorter in _COMPARED.items():
        words = words.replace(comparison, shorter)
    return f"expected {words}"


def first_error(error: ValidationError, *, whole: str = "content") -> str:
    """Say where a table is wrong first, and what was expected there.

    Args:
        error: What validation found.
        whole: What the table is called where no key of it is at fault.

    Returns:
        Keys apart by dots, and what was expected.
    """
    first = error.errors()[0]
    return f"{'.'.join(map(str, first['loc'])) or whole}: {expected_text(first)}"


class Table(BaseModel):
    """A table of the file; a key that it does not know is an error that lists the known ones."""

    model_config = ConfigDict(
        defer_build=True, extra="forbid", frozen=True, arbitrary_types_allowed=True, populate_by_name=True
    )

    @model_validator(mode="before")
    @classmethod
    def _refuse_unknown_keys(cls, values: Any) -> Any:
        known = {field.alias or name for name, field in cls.model_fields.items()}
        for key in values if isinstance(values, dict) else ():
            if key not in known:
                raise PydanticCustomError(
                    "unknown_key", "{message}", {"message": f"unknown key {key!r}; {known_names(key, known)}"}
                )
        return values


Text = Annotated[str, Field(min_length=1)]
# strict: a text or a flag is no number
Positive = Annotated[float, Field(gt=0.0, allow_inf_nan=False, strict=True)]
NotNegative = Annotated[float, Field(ge=0.0, allow_inf_nan=False, strict=True)]
Finite = Annotated[float, Field(allow_inf_nan=False, strict=True)]

_Content = TypeVar("_Content", bound=Table)


def one_for_each(value: Any, count: int) -> Any:
    """Read a key that takes one number for all, or a list with a number for each.

    Args:
        value: The number, or the list.
        count: How many there are.

    Returns:
        The number as often as there are; a list as it is.
    """
    return (value,) * count if isinstance(value, int | float) and not isinstance(value, bool) else value


OPEN = "?"
"""Value of a key that is still to be filled in by the user; no command runs before."""

_OPEN_KEY = re.compile(r"""(?P<key>[\w.-]+|"[^"]*")\s*=\s*[\[\s]*["']\?["']""")
_TEXT = re.compile(r""""(?:[^"\\]|\\.)*"|'[^']*'""")
_MOST_LINES = 12
"""Lines of further unanswered keys in a message."""


@dataclass(frozen=True, slots=True, kw_only=True)
class UnansweredKey:
    """A key of a file that is still to be filled in."""

    line: int
    """Its line, from 1."""
    key: str
    """The key."""
    words: str
    """What to fill in: the comment behind it."""


def word_or_table(value: Any) -> str:
    """Name the form of a key that takes a text, such as a path, or a table: the tag of a union of both."""
    return "word" if isinstance(value, str | Path) else "table"


def unanswered_keys(text: str) -> tuple[UnansweredKey, ...]:
    """Find the keys in the text of a TOML file that are still to be filled in.

    Args:
        text: Content of the file.

    Returns:
        The keys, one a line, in the order of the file.
    """
    keys = []
    for number, line in enumerate(text.splitlines(), start=1):
        match = _OPEN_KEY.search(line)
        if match and "#" not in _TEXT.sub("", line[: match.start()]):
            words = line[match.end() :].partition("#")[2].strip()
            keys.append(UnansweredKey(line=number, key=match["key"].strip('"'), words=words))
    return tuple(keys)


def with_answer(text: str, key: UnansweredKey, answer: str) -> str:
    """Fill in a key.

    Args:
        text: Content of the file.
        key: One of its keys that are still to be filled in.
        answer: The value, as TOML or, where it is none, as plain text.

    Returns:
        The content with the answer.
    """
    try:
        tomllib.loads(f"answer = {answer}")
        value = answer
    except tomllib.TOMLDecodeError:
        value = json.dumps(answer, ensure_ascii=False)
    lines = text.splitlines(keepends=True)
    lines[key.line - 1] = re.sub(r"""["']\?["']""", lambda _: value, lines[key.line - 1], count=1)
    return "".join(lines)


def answer_error(content: dict[str, Any], answered: dict[str, Any], form: type[BaseModel]) -> str | None:
    """Say what the form of a file has against an answer.

    Args:
        content: The tables before it.
        answered: The tables with it.
        form: Form of the file.

    Returns:
        What was expected; None where the form takes it, or a wrong key elsewhere keeps it from being checked.
    """
    place = _changed_place(content, answered)
    try:
        form.model_validate(answered)
    except ValidationError as error:
        wrong = [
            entry
            for entry in _short_lists_once(error.errors())
            if re.match(rf"{re.escape(place)}(?![\w-])", _key_path(answered, entry["loc"], missing=False))
        ]
        expected = dict.fromkeys(expected_text(entry) for entry in wrong)
        return " or ".join(expected).replace(" or expected ", " or ") or None
    return None


def _changed_place(before: Any, after: Any, place: str = "") -> str:
    """Name the key whose value differs, as `_key_path` does."""
    if isinstance(before, dict) and isinstance(after, dict):
        key = next(key for key, value in after.items() if before.get(key) != value)
        return _changed_place(before.get(key), after[key], f"{place}.{key}")
    if isinstance(before, list) and isinstance(after, list) and len(before) == len(after):
        k = next(k for k, value in enumerate(after) if before[k] != value)
        return _changed_place(before[k], after[k], f"{place}[{k}]")
    return place.removeprefix(".")


def toml_content(file: Path) -> tuple[str, dict[str, Any]]:
    """Parse a TOML file, with or without the byte-order mark that some editors put in front.

    Args:
        file: The file; it exists. What is no UTF-8 or no TOML raises the ValueError of the parser.

    Returns:
        Its text without the mark, and the tables in it.
    """
    require_file(file, "a TOML file")
    text = file.read_text(encoding="utf-8-sig")
    return text, tomllib.loads(text)


def read_toml(path: Path | str, form: type[_Content], *, what: str) -> _Content:
    """Read and check a TOML file, without opening what it points to.

    Args:
        path: TOML file.
        form: Its form.
        what: What the file is called in messages.

    Returns:
        Its content.

    Raises:
        MissingFileError: If there is no such file.
        FormatError: If it is not TOML, a key in it is still to be filled in, or is unknown, missing or has a wrong
            value.
    """
    file = Path(path)
    text, content = parsed_toml(file, what=what)
    _require_no_unanswered_key(file, text)
    return checked_tables(content, form, file)


def parsed_toml(file: Path, *, what: str) -> tuple[str, dict[str, Any]]:
    """Parse a TOML file whose keys may still be to be filled in.

    Args:
        file: The file.
        what: What the file is called in messages.

    Returns:
        Its text without a byte-order mark, and the tables in it.

    Raises:
        MissingFileError: If there is no such file.
        FormatError: If it is not TOML.
    """
    if not file.is_file():
        raise MissingFileError(f"{file}: expected {what}, {'got a folder' if file.is_dir() else 'there is none'}")
    try:
        return toml_content(file)
    except (ValueError, RecursionError) as error:  # not TOML, not UTF-8, or numbers and lists beyond all bounds
        expected = "TOML" if file.suffix.lower() == ".toml" else f"{what} (TOML)"
        raise FormatError(f"{file}: expected {expected}, got {error}") from error


def checked_tables(content: dict[str, Any], form: type[_Content], file: Path) -> _Content:
    """Check the tables of a file.

    Args:
        content: The tables, as a parser of TOML gives them.
        form: Form of the file.
        file: The file, for messages.

    Returns:
        The content.

    Raises:
        FormatError: If a key is unknown, missing or has a wrong value.
    """
    try:
        return form.model_validate(content)
    except ValidationError as error:
        _require_schema(content, form, file)
        raise FormatError(_validation_message(file, content, form, error)) from error


def _require_schema(content: dict[str, Any], form: type[BaseModel], file: Path) -> None:
    """Name the form of a file of another kind, in place of its first key that this form does not have."""
    field = form.model_fields.get("schema_name")
    expected = "" if field is None else str(get_args(field.annotation)[0])
    got = str(content.get("schema", ""))
    kinds = [name.split("/")[1] for name in (expected, got) if name.count("/") == 2]
    if len(set(kinds)) == 2:
        raise FormatError(
            f'{file}: schema: expected "{expected}", got "{got}": a file of another kind; `forcetorque schema '
            f"{kinds[1]}` has its keys"
        )


def _require_no_unanswered_key(file: Path, text: str) -> None:
    keys = unanswered_keys(text)
    if not keys:
        return
    first, *more = keys
    others = ", ".join(str(key.line) for key in more[:_MOST_LINES])
    beyond = ", ..." if len(more) > _MOST_LINES else ""
    rest = f" ({len(more)} more: line {others}{beyond})" if more else ""
    words = f": {first.words}" if first.words else ""
    raise FormatError(f"{file}:{first.line}: {first.key} is still to be filled in{rest}{words}")


def _validation_message(file: Path, content: dict[str, Any], form: type[BaseModel], error: ValidationError) -> str:
    errors = _short_lists_once(error.errors())
    # a list that is too short because its only element is wrong is no second error
    places = [e["loc"] for e in errors]
    first, *more = [
        e for e in errors if e["type"] != "too_short" or not any(p[: len(e["loc"])] == e["loc"] != p for p in places)
    ]
    where = _key_path(content, first["loc"], missing=first["type"] == "missing") or "top level"
    message, got = expected_text(first), first["input"]
    if first["type"] in ("union_tag_invalid", "union_tag_not_found"):
        where, got = f"{where}.{first['ctx']['discriminator'].strip(chr(39))}", first["ctx"].get("tag")
    if first["type"] == "tuple_type" and isinstance(got, dict):
        message += f", written [[{where}]]"
    if len(first["loc"]) == 1 and first["type"] != "union_tag_not_found":
        message = re.sub(r"this key|a table$|at least 1 value$", _written(form, str(first["loc"][0])), message)
    shown = first["type"] in ("missing", "unknown_key", "union_tag_not_found") or isinstance(got, dict)
    got_text = "" if shown else f", got {got!r}"
    rest = f" (and {len(more)} more)" if more else ""
    return f"{file}: {where}: {message[:400]}{got_text[:200]}{rest}"


def _written(form: type[BaseModel], key: str) -> str:
    """How a key of the whole file is written: as a table, as one of several tables, or as a key."""
    annotation = {field.alias or name: field.annotation for name, field in form.model_fields.items()}[key]
    several = get_origin(annotation) is tuple
    for one in (annotation, *get_args(annotation)):
        if isinstance(one, type) and issubclass(one, BaseModel):
            return f"at least one table [[{key}]]" if several else f"a table [{key}]"
    return "this key"


def _short_lists_once(errors: list[ErrorDetails]) -> list[ErrorDetails]:
    """Name a list of fixed length that is too short, in place of each element that it lacks: those have no place."""
    kept: list[ErrorDetails] = []
    for entry in errors:
        *place, last = entry["loc"] or ("",)
        if entry["type"] == "missing" and isinstance(last, int):
            if kept and kept[-1]["type"] == "too_short" and kept[-1]["loc"] == tuple(place):
                kept.pop()
            entry |= {"type": "too_short", "loc": tuple(place), "msg": f"expected {last + 1} values"}
        kept.append(entry)
    return kept


def _key_path(content: Any, location: tuple[int | str, ...], *, missing: bool) -> str:
    """Name a key as the file has it, such as `sensor[0].serial`; the names of alternatives are no keys."""
    place = ""
    for depth, part in enumerate(location, start=1):
        if isinstance(part, int) and not isinstance(content, list | tuple):
            continue  # one table may stand for a list of one, one number for several
        if isinstance(part, int):
            place, content = f"{place}[{part}]", content[part]
        elif isinstance(content, dict) and part in content:
            place, content = f"{place}.{part}", content[part]
        elif missing and depth == len(location):
            place = f"{place}.{part}"
    return place.removeprefix(".")
