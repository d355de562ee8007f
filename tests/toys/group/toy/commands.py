# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque toy`: a group of one command."""

from __future__ import annotations

import typer
from forcetorque.toy.count_command import count

toy = typer.Typer(name="toy", help="Ask what nobody asks.", no_args_is_help=True, rich_markup_mode=None)

for _command in (count,):
    toy.command(_command.__name__)(_command)
