# SPDX-License-Identifier: BSD-3-Clause
"""Sentences that several say are said once, with the names of those whom they are about."""

from __future__ import annotations

from collections.abc import Iterable


def said_once(sentences: Iterable[tuple[str, str]]) -> list[str]:
    """Put together what is said of several in the same words.

    Args:
        sentences: Name of whom a sentence is about, and the sentence.

    Returns:
        Every sentence once, in the order in which they first come: by itself if it is about all of whom anything is
        said, else behind the names.
    """
    about: dict[str, dict[str, None]] = {}
    everyone: dict[str, None] = {}
    for name, sentence in sentences:
        about.setdefault(sentence, {})[name] = None
        everyone[name] = None
    return [
        sentence if len(names) == len(everyone) else f"{', '.join(names)}: {sentence}"
        for sentence, names in about.items()
    ]
