# SPDX-License-Identifier: BSD-3-Clause
"""The viewer: robot pose and force space, linked in time, in the browser."""
