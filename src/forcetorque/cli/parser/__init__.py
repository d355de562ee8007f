# SPDX-License-Identifier: BSD-3-Clause
"""The words of every command: arguments, options, help; what a command does is imported when it runs."""
