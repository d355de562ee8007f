# SPDX-License-Identifier: BSD-3-Clause
"""Loads to come: predicted errors at the load cases of a sensor, and the verdict whether it may be used there."""
