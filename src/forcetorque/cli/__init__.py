# SPDX-License-Identifier: BSD-3-Clause
"""The command line: one file per command, its words in `parser`, what it does here."""

from forcetorque.cli.main import main

__all__ = ["main"]
