# SPDX-License-Identifier: BSD-3-Clause
"""What a sensor with its mounting does to fast forces, and a filter that inverts it."""
