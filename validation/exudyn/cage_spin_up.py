"""The cage of a 6010 brought to speed, in the multibody package EXUDYN.

    python3 -m pip install exudyn==1.13.6 numpy
    python3 validation/exudyn/cage_spin_up.py

Run by hand: nothing else needs the package. Bearing and contact numbers are those of the package's own test model
`ballBearingTest.py`: 14 balls, squeezed between rigid grooves, linear contact of 5e6 N/m and 50 N s/m, friction 0.2 that is proportional below 0.01 m/s.
Different here: a shaft that has 400 rad/s at once (12.6 rad/s there), a squeeze of 0.4 % of the ball radius (1 % there), no
gravity, a cage of polyamide (steel there) on springs and dampers ten times as stiff, so that it lags the balls by less than
a microsecond, and a second run with exponent 1.5 whose force at the initial squeeze is the same.
Prints one JSON object: instants at which the cage passes shares of its kinematic speed, ms, and its speed at the end over
the kinematic one.
"""

import json
import os
import tempfile
import time

import exudyn as exu
import numpy as np
from exudyn.machines import CreateBallBearing, GetBallBearingData
from exudyn.utilities import InertiaCylinder, MarkerBodyRigid, SensorBody

SPEED = 400.0
PITCH_RADIUS = 32.5e-3
BALL_RADIUS = 8.73e-3 / 2
SQUEEZED = 1.004  # ball radius over half the width between the grooves
SQUEEZE = (SQUEEZED - 1) * BALL_RADIUS
STIFFNESS = 5e6
BALL_DENSITY = 7800.0
CAGE_DENSITY = 1140.0
KINEMATIC = SPEED / 2 * (1 - BALL_RADIUS / PITCH_RADIUS)
# as the package derives the cage from the bearing's data: a hollow cylinder
CAGE_WIDTH = 2.5 * BALL_RADIUS
CAGE_HEIGHT = 0.7 * (35.125e-3 - 29.875e-3)
CAGE_MASS = CAGE_DENSITY * CAGE_WIDTH * 2 * np.pi * PITCH_RADIUS * CAGE_HEIGHT
CAGE_INERTIA = CAGE_MASS * (PITCH_RADIUS**2 + CAGE_HEIGHT**2 / 4)
BALL_MASS = BALL_DENSITY * 4 / 3 * np.pi * (SQUEEZED * BALL_RADIUS) ** 3
SHARES = (0.25, 0.5, 0.75, 0.95)


def spin_up(exponent, step, duration):
    """Times, cage speeds, and the CPU seconds of the solver."""
    system = exu.SystemContainer().AddSystem()
    axis = [0, 0, 1]
    data = GetBallBearingData(
        axis, 0.080, 0.050, 0.016, 14,
        radiusBalls=BALL_RADIUS, radiusCage=PITCH_RADIUS,
        innerGrooveRadius=1.25 * BALL_RADIUS, outerGrooveRadius=1.25 * BALL_RADIUS,
        innerRingShoulderRadius=29.875e-3, outerRingShoulderRadius=35.125e-3,
    )  # fmt: skip
    data["radiusBalls"] *= SQUEEZED
    ground = system.CreateGround()
    # so heavy that nothing here changes its speed
    shaft = system.CreateRigidBody(
        inertia=InertiaCylinder(1e9, 0.120, 0.025, axis=2), initialAngularVelocity=[0, 0, SPEED]
    )
    items = CreateBallBearing(
        system,
        data,
        system.AddMarker(MarkerBodyRigid(bodyNumber=shaft)),
        system.AddMarker(MarkerBodyRigid(bodyNumber=ground)),
        BALL_DENSITY,
        CAGE_DENSITY,
        springStiffnessCage=1e6,
        springDampingCage=1e3,
        contactParametersRingBalls={
            "contactStiffness": STIFFNESS * SQUEEZE ** (1 - exponent),
            "contactStiffnessExponent": exponent,
            "contactDamping": 50.0,
            "dynamicFriction": 0.2,
            "frictionProportionalZone": 0.01,
        },
    )
    cage = system.AddSensor(
        SensorBody(
            bodyNumber=items["objectCage"], storeInternal=True, outputVariableType=exu.OutputVariableType.AngularVelocity
        )
    )
    system.Assemble()
    settings = exu.SimulationSettings()
    settings.solution.file.write = False
    settings.solution.sensors.writePeriod = step
    settings.timeIntegration.numberOfSteps = round(duration / step)
    settings.timeIntegration.endTime = duration
    settings.timeIntegration.verboseMode = 0
    settings.timeIntegration.newton.useModifiedNewton = True
    settings.linearSolver.solverType = exu.LinearSolverType.EigenSparse
    begun = time.thread_time()
    system.SolveDynamic(settings)
    seconds = time.thread_time() - begun
    history = system.GetSensorStoredData(cage)
    return history[:, 0], history[:, 3], seconds


def passed(times, speeds, level):
    """First instant at which the speed reaches a level, by the straight line between two outputs."""
    after = int(np.argmax(speeds >= level))
    share = (level - speeds[after - 1]) / (speeds[after] - speeds[after - 1])
    return times[after - 1] + share * (times[after] - times[after - 1])


def main():
    """Both exponents at two step sizes."""
    result = {
        "exudyn": exu.__version__,
        "kinematic_cage_speed_rad_s": KINEMATIC,
        "ball_mass_kg": BALL_MASS,
        "cage_mass_kg": CAGE_MASS,
        "cage_inertia_kg_m2": CAGE_INERTIA,
    }
    for exponent in (1.0, 1.5):
        for step in (1e-6, 5e-7, 2.5e-7):
            times, speeds, _ = spin_up(exponent, step, 4e-3)
            result[f"exponent {exponent}, step {step * 1e6:g} us"] = {
                "passed_ms": {share: 1e3 * passed(times, speeds, share * KINEMATIC) for share in SHARES},
                "end_over_kinematic": float(speeds[-1] / KINEMATIC),
                "largest_over_kinematic": float(speeds.max() / KINEMATIC),
            }
    print(json.dumps(result, indent=1, default=lambda value: np.asarray(value).tolist()))


if __name__ == "__main__":
    os.chdir(tempfile.mkdtemp())  # the package writes files beside itself
    main()
