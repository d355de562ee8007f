# SPDX-License-Identifier: BSD-3-Clause
"""Help of a program or a group: commands with whole sentences, in panels."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, ClassVar

from typer.core import TyperGroup

if TYPE_CHECKING:
    from click import Context, HelpFormatter

_WHOLE = 1000
"""Characters of a sentence that are shown: all."""


class WholeSentences(TyperGroup):
    """A group whose help cuts nothing off."""

    panels: ClassVar[Mapping[str, tuple[str, ...]] | None] = None
    """Titles, and commands in their order; None for one panel of all."""

    def format_commands(self, ctx: Context, formatter: HelpFormatter) -> None:
        """Write a section for every panel.

        Args:
            ctx: The context.
            formatter: What the help is written to.
        """
        for title, names in (self.panels or {"Commands": tuple(self.list_commands(ctx))}).items():
            known = {name: command for name in names if (command := self.get_command(ctx, name)) is not None}
            with formatter.section(title):
                formatter.write_dl(
                    [(name, command.get_short_help_str(limit=_WHOLE)) for name, command in known.items()]
                )
