# SPDX-License-Identifier: BSD-3-Clause
"""Heat on skin: what thermal pads predict of it, estimated in a warm-up or by the firmware's rule."""
