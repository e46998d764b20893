"""The reference drop as a user of SciPy would write it: NumPy over the balls, `solve_ivp` with LSODA.

    python3 scipy_lsoda.py [--duration 0.05] [--rtol 5e-4] [--traction-speed 0.1]

Prints one JSON object; `cpu_seconds` covers the integration alone, not the import of SciPy.
"""

import os

for pool in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[pool] = "1"  # before NumPy reads them

import cmath
import json
import time

import numpy as np
import scipy
from scipy.integrate import solve_ivp

from reference_drop import *  # the parameters, by their names

# rows: inner race, outer race; a column per ball, as broadcasting costs more than it saves here
TRACK = np.repeat([[INNER_TRACK], [OUTER_TRACK]], BALLS, axis=1)
SIDE = np.repeat([[1.0], [-1.0]], BALLS, axis=1)
STIFFNESS = np.repeat([[INNER_STIFFNESS], [OUTER_STIFFNESS]], BALLS, axis=1)
DAMPING = -1.5 * DAMPING_TIME * SIDE
MOUNT_FREE = 1j * GRAVITY * (OUTER_MASS + INNER_MASS + BALLS * BALL_MASS) / MOUNT_STIFFNESS
SEATS_BACK = np.exp(-2j * np.pi * np.arange(BALLS) / BALLS)


def rate(_time, y, traction_speed):
    """Time derivative of the state."""
    head = y[:HEAD].tolist()
    _, _, gvx, gvy, _, spin, ix, iy, ivx, ivy, inner_spin, ox, oy, ovx, ovy, cage, cage_spin, _ = head
    rho, rho_rate, theta, theta_rate, sigma = y[HEAD:].reshape(5, BALLS)

    # balls against both races at once
    radial = np.exp(1j * theta)
    orbital = rho * theta_rate
    from_race = rho * radial - np.array([[complex(ix, iy)], [complex(ox, oy)]])
    distance = np.abs(from_race)
    n = from_race / distance
    past = (rho_rate + 1j * orbital) * radial - np.array([[complex(ivx, ivy)], [complex(ovx, ovy)]])
    past = past * n.conj()
    approach = SIDE * (TRACK - distance) + BALL_RADIUS
    overlap = np.maximum(approach, 0.0)
    load = STIFFNESS * np.sqrt(overlap) * (overlap + DAMPING * past.real)
    load = np.maximum(load, 0.0)
    ball_arm = BALL_RADIUS - 0.5 * approach
    slip = SIDE * sigma * ball_arm - past.imag
    inner_arm = TRACK[0] - 0.5 * approach[0]
    slip[0] += inner_spin * inner_arm
    traction = TRACTION * np.tanh(slip / traction_speed) * load
    along = SIDE * load + 1j * traction
    moment = ball_arm[1] * traction[1] - ball_arm[0] * traction[0] - SPIN_DRAG * sigma

    # pockets, from the centre of the outer race
    seen = n[1] * (SEATS_BACK * cmath.exp(-1j * cage))
    offset = np.arctan2(seen.imag, seen.real)
    penetration = np.abs(offset) * POCKET_RADIUS - POCKET_GAP
    cage_moment = 0.0
    if penetration.max() > 0.0:
        side = np.copysign(1.0, offset)
        speed = side * POCKET_RADIUS * (past[1].imag / distance[1] - cage_spin)
        press = POCKET_STIFFNESS * np.maximum(penetration, 0.0) * (1 + POCKET_DAMPING * speed)
        press = np.maximum(press, 0.0)
        slide = past[1].real - side * BALL_RADIUS * (sigma - cage_spin)
        friction = -POCKET_FRICTION * np.tanh(slide / POCKET_REFERENCE_SPEED) * press
        push = side * press * POCKET_RADIUS
        friction_moment = side * BALL_RADIUS * friction
        along[1] += friction - 1j * push / distance[1]
        moment -= friction_moment
        cage_moment = float((friction_moment + push).sum())

    on_ball = along * n
    on_inner, on_outer = (-on_ball.sum(axis=1)).tolist()
    acceleration = (on_ball[0] + on_ball[1]) / BALL_MASS - 1j * GRAVITY
    acceleration = acceleration * radial.conj() - 1j * (ORBIT_DRAG / BALL_MASS) * orbital

    # rotor, races
    depth, normal, friction, contact_slip, arm, contact_n = rotor_contact(head)
    force = complex(-normal, friction) * contact_n
    lever = arm + contact_n * (BORE_RADIUS - CLEARANCE - depth / 2)
    rotor = force / ROTOR_MASS - 1j * GRAVITY
    rotor_spin_rate = (lever.conjugate() * force).imag / ROTOR_INERTIA
    inner = (on_inner - force) / INNER_MASS - 1j * GRAVITY
    inner_moment = -(BORE_RADIUS + depth / 2) * friction - float(inner_arm @ traction[0])
    mount = MOUNT_STIFFNESS * (complex(ox, oy) - MOUNT_FREE) + MOUNT_DAMPING * complex(ovx, ovy)
    outer = (on_outer - mount) / OUTER_MASS - 1j * GRAVITY

    dy = np.empty_like(y)
    dy[:HEAD] = (
        gvx, gvy, rotor.real, rotor.imag, spin, rotor_spin_rate,
        ivx, ivy, inner.real, inner.imag, inner_moment / INNER_INERTIA,
        ovx, ovy, outer.real, outer.imag,
        cage_spin, cage_moment / CAGE_INERTIA, friction * contact_slip,
    )  # fmt: skip
    balls = dy[HEAD:].reshape(5, BALLS)
    balls[0] = rho_rate
    balls[1] = acceleration.real + orbital * theta_rate
    balls[2] = theta_rate
    balls[3] = (acceleration.imag - 2 * rho_rate * theta_rate) / rho
    balls[4] = moment / BALL_INERTIA
    return dy


def gap(_time, y, _traction_speed):
    """Penetration of rotor and inner race, for the events."""
    return rotor_contact(y[:11].tolist())[0]


def half(_time, y, _traction_speed):
    """Speed of the inner race over half of the rotor's at release."""
    return y[10] - 0.5 * RELEASE_SPEED


def almost(_time, y, _traction_speed):
    """Speed of the inner race over 95 % of the rotor's at release."""
    return y[10] - 0.95 * RELEASE_SPEED


def main():
    """Integrates once and prints what came out and what it cost."""
    words = arguments(__doc__, 5e-4, ["LSODA", "Radau", "BDF", "RK23", "RK45", "DOP853"])
    rtol, atol = tolerances(words.rtol)
    begun = time.thread_time()
    solution = solve_ivp(
        rate,
        (0.0, words.duration),
        start(),
        method=words.method,
        args=(words.traction_speed,),
        rtol=rtol,
        atol=atol,
        max_step=1e-3,
        events=(gap, half, almost),
        dense_output=True,
    )
    seconds = time.thread_time() - begun
    if not solution.success:
        raise SystemExit(solution.message)

    touches, *reached = [events.tolist() for events in solution.t_events]
    grid = np.linspace(*[*touches, words.duration][:2], 4001)
    result = quantities(words, seconds, touches, reached, solution.sol(grid)[:11].T.tolist(), solution.y[17, -1])
    result |= {"rate_calls": solution.nfev, "steps": len(solution.t) - 1}
    print(json.dumps(result | {"numpy": np.__version__, "scipy": scipy.__version__}))


if __name__ == "__main__":
    main()
