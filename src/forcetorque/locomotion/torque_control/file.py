# SPDX-License-Identifier: BSD-3-Clause
"""The file of a torque loop: the robot, its controllers and rates, and the errors of its sensors that are tried."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Final, Literal

from pydantic import Field, model_validator

from forcetorque.base.toml_file import NotNegative, Positive, Table, Text, read_toml
from forcetorque.locomotion.torque_control.balancing import Balance, Timing
from forcetorque.locomotion.torque_control.closed_loop import PRINTED, LoopSetting
from forcetorque.locomotion.torque_control.controller import JointDrive, TorqueGains
from forcetorque.locomotion.torque_control.walking_loop import WalkingController
from forcetorque.locomotion.torque_control.world import JOINTS, MOST_TILT_DEG, Biped

PERIOD_S: Final = 0.001
"""Period of controllers and simulation; s."""

_Tilt = Annotated[float, Field(ge=-MOST_TILT_DEG, le=MOST_TILT_DEG)]


class DriveTable(Table):
    """Motor and gear of every joint, seen from the joint."""

    torque_per_duty_Nm: Positive = 60.0
    """Torque of the standing joint at whole duty, 1 / K_tau; N m."""
    lag_s: Positive = 0.005
    """Time constant of current and gear; s."""
    rotor_inertia_kgm2: Positive = 0.02
    """Inertia of the rotor; kg m2."""
    coulomb_Nm: NotNegative = 0.5
    """Coulomb friction; 0 switches it off; N m."""
    viscous_Nms: NotNegative = 0.2
    """Viscous friction; 0 switches it off; N m s/rad."""


class ControllerTable(Table):
    """Torque controller of every joint (thesis figure 5.10); a duty cycle is a fraction of 1."""

    proportional: NotNegative = 1.0 / 60.0
    """K_p, duty cycle per N m; 1/(N m)."""
    integral: NotNegative = 20.0 / 60.0
    """K_i; 1/(N m s)."""
    derivative: NotNegative = 0.0
    """K_d; s/(N m)."""
    compensated: Annotated[float, Field(ge=0.0, le=1.0)] = 0.8
    """Share of Coulomb friction that is made up for."""
    limit: Annotated[float, Field(gt=0.0, le=1.0)] = 1.0
    """Largest duty cycle."""


class EstimatorTable(Table):
    """How torques come to the controllers, which run at 1 kHz."""

    rate_hz: Annotated[float, Field(ge=1.0, le=1000.0)] = 1000.0
    """Rate of estimates; a whole number of milliseconds apart; Hz."""
    delay_s: Annotated[float, Field(ge=0.0, le=1.0, strict=True)] = 0.001
    """How late an estimate is, beside the step in which it is computed; 0 switches it off; s."""


class SensorTable(Table):
    """Errors of the four sensors of the legs, `reading = (1 + E) wrench + bias + noise`."""

    lever_m: Positive = 0.07
    """Moment that counts as much as a newton: elements of E that make moments of forces have the size times it; m."""
    noise_N: NotNegative = 0.1
    """White noise of a force; 0 switches it off; N."""
    noise_Nm: NotNegative = 0.002
    """White noise of a moment; N m."""
    resolution_N: NotNegative = 0.05
    """Step of a force; 0 switches it off; N."""
    resolution_Nm: NotNegative = 0.001
    """Step of a moment; N m."""
    bias_N: NotNegative = 0.0
    """Standard deviation of constant offsets of forces; N."""
    bias_Nm: NotNegative = 0.0
    """The same of moments; N m."""


class BalanceTable(Table):
    """The controller above: what torques are wanted."""

    centre_stiffness: NotNegative = 800.0
    """Pull of the centre of mass; N/m."""
    centre_damping: NotNegative = 200.0
    """Its damping; N s/m."""
    posture_stiffness: NotNegative = 60.0
    """Pull of every joint to its posture; N m/rad."""
    posture_damping: NotNegative = 2.0
    """Its damping; N m s/rad."""


class TorqueLoopFile(Table):
    """Everything that is settled before errors of sensors are drawn."""

    schema_name: Literal["forcetorque/torque_loop_file/1"] = Field(
        default="forcetorque/torque_loop_file/1", alias="schema"
    )
    """Form of the file."""
    name: Text = "biped, torque control with estimated torques"
    """What it is called."""
    seeds: Annotated[int, Field(ge=2, le=1000)] = 30
    """How many draws of E."""
    seed: Annotated[int, Field(ge=0)] = 1
    """Of all that is random."""
    errors: Annotated[dict[Text, Positive], Field(min_length=1)] = Field(default_factory=lambda: dict(PRINTED))
    """Sizes of E that count as 1, by name: standard deviation of the elements that make forces of forces. Those of the
    workbench and in situ are root mean square force errors of thesis Table 5.9, as shares of the weight."""
    scales: Annotated[tuple[Positive, ...], Field(min_length=1)] = (1.0, 2.0, 4.0)
    """Multiples of these sizes; the loop without E always runs beside."""
    tilt_deg: Annotated[tuple[_Tilt, ...], Field(min_length=1)] = (0.0, 10.0)
    """How far the soles are turned; degree."""
    gain_factors: Annotated[tuple[Positive, ...], Field(min_length=1)] = (1.0,)
    """Multiples of K_p, K_i and K_d that are tried."""
    drive: DriveTable = DriveTable()
    """Motors."""
    controller: ControllerTable = ControllerTable()
    """Torque controllers."""
    estimator: EstimatorTable = EstimatorTable()
    """Estimates of torques."""
    sensor: SensorTable = SensorTable()
    """Sensors."""
    motion: Timing = Timing()
    """What the robot does."""
    balance: BalanceTable = BalanceTable()
    """What torques are wanted."""
    walking: WalkingController = WalkingController()
    """The walking controller of `oscillation-causes`."""

    @model_validator(mode="after")
    def _steps_are_whole(self) -> TorqueLoopFile:
        steps_of = {
            "[estimator] delay_s": self.estimator.delay_s / PERIOD_S,
            "[estimator] rate_hz": self._hold(),
            "[walking] delay_s": self.walking.delay_s / PERIOD_S,
            "[walking] period_s": self.walking.period_s / PERIOD_S,
        }
        for what, steps in steps_of.items():
            if abs(steps - round(steps)) > 1e-6:
                raise ValueError(f"{what}: expected a whole number of periods of the controller, 1 ms, got {steps:g}")
        return self

    def _hold(self) -> float:
        return 1.0 / (self.estimator.rate_hz * PERIOD_S)

    def setting(self, biped: Biped, gain_factor: float) -> LoopSetting:
        """Freeze drives, controllers and rates.

        Args:
            biped: The robot.
            gain_factor: Multiple of K_p, K_i and K_d.

        Returns:
            The setting.
        """
        drive, controller = self.drive, self.controller
        return LoopSetting(
            drive=JointDrive(
                torque_per_duty=drive.torque_per_duty_Nm,
                lag_s=drive.lag_s,
                rotor_inertia=drive.rotor_inertia_kgm2,
                coulomb=drive.coulomb_Nm,
                viscous=drive.viscous_Nms,
            ),
            gains=TorqueGains.of(
                JOINTS,
                duty_torque=drive.torque_per_duty_Nm,
                proportional=gain_factor * controller.proportional,
                integral=gain_factor * controller.integral,
                derivative=gain_factor * controller.derivative,
                bemf=drive.viscous_Nms / drive.torque_per_duty_Nm,
                coulomb=controller.compensated * drive.coulomb_Nm,
                standstill=0.05,
                limit=controller.limit,
            ),
            balance=Balance(
                mass=biped.mass,
                centre_stiffness=self.balance.centre_stiffness,
                centre_damping=self.balance.centre_damping,
                posture_stiffness=self.balance.posture_stiffness,
                posture_damping=self.balance.posture_damping,
            ),
            period_s=PERIOD_S,
            hold_steps=round(self._hold()),
            delay_steps=round(self.estimator.delay_s / PERIOD_S),
        )


def read_torque_loop(path: Path | str) -> TorqueLoopFile:
    """Read the file of a torque loop.

    Args:
        path: TOML file.

    Returns:
        Its content.

    Raises:
        MissingFileError: If it is not there.
        FormatError: If it does not have its form.
    """
    return read_toml(Path(path), TorqueLoopFile, what="a torque loop")
