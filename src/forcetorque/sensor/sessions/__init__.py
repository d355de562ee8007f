# SPDX-License-Identifier: BSD-3-Clause
"""Offset and gain of a sensor in every session, and which of them changed."""
