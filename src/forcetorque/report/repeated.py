# SPDX-License-Identifier: BSD-3-Clause
"""What is said of several in the same words is said once, with the names of those whom it is about."""

from __future__ import annotations

from collections.abc import Collection, Hashable, Iterable
from typing import TypeVar

_Said = TypeVar("_Said", bound=Hashable)


def gathered(said: Iterable[tuple[str, _Said]]) -> list[tuple[tuple[str, ...], _Said]]:
    """Put together what is said of several in the same words.

    Args:
        said: Name of whom something is about, and what is said.

    Returns:
        Names, each once, and what is said of them; in the order in which it first comes.
    """
    about: dict[_Said, dict[str, None]] = {}
    for name, what in said:
        about.setdefault(what, {})[name] = None
    return [(tuple(names), what) for what, names in about.items()]


def said_once(sentences: Iterable[tuple[str, str]], everyone: Collection[str]) -> list[str]:
    """Say every sentence once.

    Args:
        sentences: Name of whom a sentence is about, and the sentence.
        everyone: Names of all of whom something might be said.

    Returns:
        A sentence by itself if it is about everyone, else behind the names.
    """
    return [
        sentence if set(names) == set(everyone) else f"{', '.join(names)}: {sentence}"
        for names, sentence in gathered(sentences)
    ]
