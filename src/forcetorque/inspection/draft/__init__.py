# SPDX-License-Identifier: BSD-3-Clause
"""A first experiment file of a log: what can be derived from log and robot model, and questions for the rest."""
