# SPDX-License-Identifier: BSD-3-Clause
"""What scripts and notebooks hold: an experiment, from a file or from arrays, and its sensors with every analysis."""
