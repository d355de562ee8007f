# SPDX-License-Identifier: BSD-3-Clause
"""The figure of sessions, of random data."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from forcetorque.base.wrench import WRENCH_COMPONENTS, WRENCH_UNITS
from forcetorque.sensor.figures import session_figure
from forcetorque.sensor.sessions.session_drift import SensorSessions, SessionChange, SessionRow


def draw_session(rng: np.random.Generator) -> Figure:
    """Sessions of two sensors: few with long names, and many, of a sensor with four components."""
    return session_figure([_sensor(rng, 3, 6), _sensor(rng, 12, 4)])


def _sensor(rng: np.random.Generator, count: int, components: int) -> SensorSessions:
    names = tuple(f"_session $k$ {k}" for k in range(count))
    rows = tuple(
        SessionRow(
            session=session,
            component=component,
            unit=unit,
            offset=float(rng.normal()),
            offset_half_width_95=0.3,
            gain=float(1.0 + 0.02 * rng.normal()),
            gain_half_width_95=0.02 if component != "fz" else np.inf,
            gain_session=session if component != "fz" else None,
            mean_load=1.0,
            load_of_session=1.0,
            load_deviation=0.5,
        )
        for component, unit in list(zip(WRENCH_COMPONENTS, WRENCH_UNITS, strict=True))[:components]
        for session in names
    )
    change = SessionChange(
        first=names[0],
        second=names[1],
        component="fx",
        quantity="offset",
        unit="N",
        change=1.0,
        half_width_95=0.3,
        p_value=1e-5,
        beyond_noise=True,
    )
    return SensorSessions(
        sensor="_left $wrist$",
        serial="FT1",
        wrench_source="the logged wrench",
        sessions=names,
        windows=100,
        window_s=1.0,
        rows=rows,
        changes=(change,),
    )
