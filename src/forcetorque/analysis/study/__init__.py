# SPDX-License-Identifier: BSD-3-Clause
"""Estimation types of the thesis beside each other, and the best of them."""
