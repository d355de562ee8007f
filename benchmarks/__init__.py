# SPDX-License-Identifier: BSD-3-Clause
"""Benchmarks: ours against a named peer in the same run; `python -m benchmarks.NAME --json FILE`."""
