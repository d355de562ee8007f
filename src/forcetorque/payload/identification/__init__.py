# SPDX-License-Identifier: BSD-3-Clause
"""One estimation problem of known and unknown loads: loads, biases and mounting of one sensor."""
