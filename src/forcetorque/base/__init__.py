# SPDX-License-Identifier: BSD-3-Clause
"""What everything stands on: spatial algebra with one sign rule, units, noise, arrays, files and errors."""
