# SPDX-License-Identifier: BSD-3-Clause
"""Loads of a sensor in the files of robots, one format per program."""
