# SPDX-License-Identifier: BSD-3-Clause
"""Help of a program or a group: commands with whole sentences, in panels."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar

from typer.core import TyperGroup

_WHOLE = 1000
"""Characters of a sentence that are shown: all."""


class WholeSentences(TyperGroup):
    """A group whose help cuts nothing off."""

    panels: ClassVar[Mapping[str, tuple[str, ...]] | None] = None
    """Titles, and commands in their order, the last with all others; None for one panel of all."""

    def format_commands(self, ctx: Any, formatter: Any) -> None:
        """Write a section for every panel.

        Args:
            ctx: The context.
            formatter: What the help is written to.
        """
        panels = {title: list(names) for title, names in (self.panels or {"Commands": ()}).items()}
        shown = {name for names in panels.values() for name in names}
        panels[list(panels)[-1]] += [name for name in self.list_commands(ctx) if name not in shown]
        for title, names in panels.items():
            known = {name: command for name in names if (command := self.get_command(ctx, name)) is not None}
            with formatter.section(title):
                formatter.write_dl(
                    [(name, command.get_short_help_str(limit=_WHOLE)) for name, command in known.items()]
                )
