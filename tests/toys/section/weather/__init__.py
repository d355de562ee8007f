# SPDX-License-Identifier: BSD-3-Clause
"""The weather of a recording: a capability with a section of the experiment file, for the test that adds one."""

from forcetorque.results.capability import Capability

CAPABILITY = Capability(page="recording.md", sections=("forcetorque.weather.section:WEATHER",))
