# SPDX-License-Identifier: BSD-3-Clause
"""One sensor of one experiment, or over many recordings: its samples, and how it is read."""
