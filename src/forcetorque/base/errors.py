# SPDX-License-Identifier: BSD-3-Clause
"""One error tree; every message gives where, what was expected, what came and what to do."""

from __future__ import annotations

import math
import re
from collections.abc import Collection, Iterable, Iterator
from contextlib import contextmanager
from difflib import SequenceMatcher, get_close_matches

_LONGEST_QUOTE = 40
_COMPARED, _ALIKE = 5, 0.5
"""Names that are looked at as the one that was meant, and the share of letters that two spellings of a word share."""


class ForceTorqueError(Exception):
    """Base of everything this library raises on purpose."""


class ShapeError(ForceTorqueError, ValueError):
    """An array does not have the shape that the argument documents."""


class UnitError(ForceTorqueError, ValueError):
    """A unit is unknown or does not belong to the quantity."""


class FormatError(ForceTorqueError, ValueError):
    """A file or a text is not what its format requires."""


class MissingFileError(ForceTorqueError, FileNotFoundError):
    """A file or a folder that was named is not there."""


class OutputError(ForceTorqueError, FileExistsError):
    """A file that is to be written is an input, was made by another program, or cannot be written."""


class ChangingFileError(ForceTorqueError, ValueError):
    """A file was written to while it was read."""


class RobotError(ForceTorqueError, ValueError):
    """A robot model is not a tree of links, or lacks what was requested."""


class RecordingError(ForceTorqueError, ValueError):
    """A recording lacks a stream, a column or an instant that is needed."""


class ExperimentError(ForceTorqueError, ValueError):
    """An experiment file contradicts itself or what it points to."""


class EstimationError(ForceTorqueError, ValueError):
    """The requested quantity is not identifiable from the sensors and contacts."""


class FitError(ForceTorqueError, ValueError):
    """Data do not determine what a fit estimates."""


class SensorError(ForceTorqueError, ValueError):
    """A part of a sensor was described, or used, as no such part can be."""


class ControlError(ForceTorqueError, ValueError):
    """A controller, or a loop that it closes, was described or fed as none can be."""


class SkinError(ForceTorqueError, ValueError):
    """A patch of skin, or what it reads, is not what such a patch can be."""


class MissingExtraError(ForceTorqueError, ImportError):
    """A function needs an optional extra that is not installed."""


def install_line(extra: str) -> str:
    """Give the line that installs an extra of this library.

    Args:
        extra: Its name, as in `pyproject.toml`.

    Returns:
        The line, in quotes for shells that expand brackets.
    """
    return f"pip install 'forcetorque[{extra}]'"


@contextmanager
def needs_extra(what: str, extra: str) -> Iterator[None]:
    """Refuse what an extra does while it is not installed.

    Args:
        what: What is done by which library, such as `HDF5 is read by h5py`.
        extra: Name of the extra, which what is imported inside the context belongs to.

    Raises:
        MissingExtraError: If an import inside the context fails.
    """
    try:
        yield
    except ImportError as error:
        raise MissingExtraError(f"{what}: {install_line(extra)}") from error


class SerialNumberError(ForceTorqueError, ValueError):
    """A calibration was offered to a sensor with another serial number."""


def known_names(wanted: object, known: Iterable[str]) -> str:
    """List the names that would have been accepted, the likeliest one first.

    Args:
        wanted: Name that was not found; anything else is not close to any.
        known: Names that exist.

    Returns:
        Text to append to a message: the closest name if there is one, then all of them, sorted.
    """
    # names come from files: one with a line break in it must not break the message in two
    names = sorted(name if name.isprintable() else repr(name) for name in known)
    spelled = {name.lower(): name for name in names}
    text = str(wanted).lower()
    # r_hip_pitch shares half of its letters with torso_pitch, and is another joint
    likely = (close for close in get_close_matches(text, spelled, n=_COMPARED) if _are_same_words(text, close))
    hint = next((f'did you mean "{spelled[close]}"? ' for close in likely), "")
    return f"{hint}known: {', '.join(names) if names else 'none'}"


def require_known(wanted: object, known: Collection[str], error: type[ForceTorqueError], message: str) -> None:
    """Refuse a name that does not exist, and list those that do.

    Args:
        wanted: The name.
        known: Names that exist.
        error: Class of the error.
        message: Where the name stands and what it should name; the list of names is appended.

    Raises:
        ForceTorqueError: Of that class, if the name is not known.
    """
    if wanted not in known:
        raise error(f"{message}; {known_names(wanted, known)}")


def require_positive(value: float, *, name: str, unit: str) -> None:
    """Refuse what is not a finite number above zero.

    Args:
        value: Number to check.
        name: Part and argument, for the message.
        unit: Unit of the number, for the message; "1" for a ratio.

    Raises:
        SensorError: If the number is zero, negative, infinite or NaN.
    """
    if not 0.0 < value < math.inf:
        raise SensorError(f"{name}: expected a finite number above 0 {unit}, got {value:g}")


def require_finite(value: float, *, name: str, unit: str) -> None:
    """Refuse infinity and NaN.

    Args:
        value: Number to check.
        name: Part and argument, for the message.
        unit: Unit of the number, for the message; "1" for a ratio.

    Raises:
        SensorError: If the number is infinite or NaN.
    """
    if not math.isfinite(value):
        raise SensorError(f"{name}: expected a finite number of {unit}, got {value:g}")


def _are_same_words(text: str, other: str) -> bool:
    """Whether one name has all words of the other, up to typing errors, word by word or as one word."""
    words, others = (re.findall("[a-z0-9]+", one) for one in (text, other))
    missing, more = [one for one in words if one not in others], [one for one in others if one not in words]
    if not missing or not more:
        return True
    pairs = (missing, more) if len(missing) <= len(more) else (more, missing)
    return "".join(words) == "".join(others) or all(any(_is_misspelt(one, two) for two in pairs[1]) for one in pairs[0])


def _is_misspelt(word: str, other: str) -> bool:
    return sorted(word) == sorted(other) or SequenceMatcher(None, word, other).ratio() >= _ALIKE


def quoted(text: str) -> str:
    """Show a text of a file in a message: on one line, and not longer than the report of what is wrong with it.

    Args:
        text: Anything.

    Returns:
        The text in quotes, with what cannot be printed escaped, cut after 40 characters.
    """
    return repr(text if len(text) <= _LONGEST_QUOTE else f"{text[:_LONGEST_QUOTE]}...")
