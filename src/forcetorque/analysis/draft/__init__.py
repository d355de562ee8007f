# SPDX-License-Identifier: BSD-3-Clause
"""A first experiment file of a log: what can be told from it and from the robot's model, and questions for the rest."""
