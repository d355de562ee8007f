# SPDX-License-Identifier: BSD-3-Clause
"""Errors of many candidates in compiled code, over blocks of samples."""
