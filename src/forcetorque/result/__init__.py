# SPDX-License-Identifier: BSD-3-Clause
"""The one form of every answer."""
