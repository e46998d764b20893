"""The reference drop as a user of SciPy would write it: NumPy over the balls, `solve_ivp` with LSODA.

    python3 scipy_lsoda.py [--duration 0.05] [--rtol 5e-4]

The machine is that of scenarios/reference_drop.toml; the equations are those of crates/model/src, written anew.
Vectors of the plane are complex numbers: v·n + i v·t = v conj(n). SI units throughout.
Prints one JSON object; `cpu_seconds` covers the integration alone, not the import of SciPy.
"""

import os

for pool in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[pool] = "1"  # before NumPy reads them

import argparse
import cmath
import json
import math
import time

import numpy as np
import scipy
from scipy.integrate import solve_ivp

GRAVITY = 9.81
# rotor
ROTOR_MASS = 8.0
ROTOR_INERTIA = 0.01
ECCENTRICITY = 5e-6
RELEASE_SPEED = 1256.6370614359173
LEVITATION_STIFFNESS = 1e6
LEVITATION_DAMPING = 1e3
# rotor against inner race
CLEARANCE = 0.25e-3
BORE_RADIUS = 12.5e-3
CONTACT_STIFFNESS = 5e8
CONTACT_EXPONENT = 10 / 9
CONTACT_DAMPING = 0.5
CONTACT_FRICTION = 0.15
CONTACT_REFERENCE_SPEED = 0.05
# races and mount
INNER_MASS = 20.4e-3
INNER_INERTIA = 3.9e-6
OUTER_MASS = 0.150 + 5e-3  # housing and cage
MOUNT_STIFFNESS = 2e7
MOUNT_DAMPING = 5000.0
# balls: 6.35 mm of steel between tracks with 4 um of diametral interference
BALLS = 10
BALL_RADIUS = 3.175e-3
BALL_MASS = 1.0524208776796881e-3
BALL_INERTIA = 0.4 * BALL_MASS * BALL_RADIUS**2
# rows: inner race, outer race; a column per ball, as broadcasting costs more than it saves here
TRACK = np.repeat([[14.825e-3], [21.173e-3]], BALLS, axis=1)
SIDE = np.repeat([[1.0], [-1.0]], BALLS, axis=1)
STIFFNESS = np.repeat([[25188251676.112152], [22185150515.377434]], BALLS, axis=1)
DAMPING = -1.5 * 2.5e-6 * SIDE
TRACTION = 0.07
TRACTION_REFERENCE_SPEED = 0.1
ORBIT_DRAG = 2e-4
SPIN_DRAG = 1e-9
# cage
CAGE_INERTIA = 1.62e-6
POCKET_RADIUS = 18e-3
POCKET_GAP = 0.1e-3
POCKET_STIFFNESS = 1e7
POCKET_DAMPING = 0.5
POCKET_FRICTION = 0.05
POCKET_REFERENCE_SPEED = 0.1

SEATS = 2 * np.pi * np.arange(BALLS) / BALLS
SEATS_BACK = np.exp(-1j * SEATS)
MOUNT_FREE = 1j * GRAVITY * (OUTER_MASS + INNER_MASS + BALLS * BALL_MASS) / MOUNT_STIFFNESS

# State: rotor x y ẋ ẏ φ Ω, inner race x y ẋ ẏ ω, outer race x y ẋ ẏ, cage φ ω, friction energy; balls ρ ρ̇ θ θ̇ σ
HEAD = 18


def rotor_contact(y):
    """Penetration, normal force, friction on the rotor, slip, directions of the rotor/race contact."""
    gx, gy, gvx, gvy, angle, spin, ix, iy, ivx, ivy, inner_spin = y[:11]
    arm = -ECCENTRICITY * cmath.exp(1j * angle)
    gap = complex(gx - ix, gy - iy) + arm
    distance = abs(gap)
    n = gap / distance
    closing = (complex(gvx - ivx, gvy - ivy) + 1j * spin * arm) * n.conjugate()
    depth = distance - CLEARANCE
    if depth <= 0.0:
        return depth, 0.0, 0.0, 0.0, arm, n
    normal = CONTACT_STIFFNESS * depth**CONTACT_EXPONENT * (1 + CONTACT_DAMPING * closing.real)
    normal = max(normal, 0.0)
    rotor_arm = BORE_RADIUS - CLEARANCE - depth / 2
    slip = inner_spin * (BORE_RADIUS + depth / 2) - spin * rotor_arm - closing.imag
    friction = CONTACT_FRICTION * math.tanh(slip / CONTACT_REFERENCE_SPEED) * normal
    return depth, normal, friction, slip, arm, n


def rate(_time, y):
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
    traction = TRACTION * np.tanh(slip / TRACTION_REFERENCE_SPEED) * load
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


def start():
    """Steady levitated orbit of the rotor above a bearing at rest."""
    k = LEVITATION_STIFFNESS + 1j * LEVITATION_DAMPING * RELEASE_SPEED
    centre = ECCENTRICITY * k / (k - ROTOR_MASS * RELEASE_SPEED**2)
    speed = 1j * RELEASE_SPEED * centre
    interference = TRACK[0, 0] + 2 * BALL_RADIUS - TRACK[1, 0]
    inner_share = interference / (1 + (STIFFNESS[0, 0] / STIFFNESS[1, 0]) ** (2 / 3))
    y = np.zeros(HEAD + 5 * BALLS)
    y[:6] = centre.real, centre.imag, speed.real, speed.imag, 0.0, RELEASE_SPEED
    balls = y[HEAD:].reshape(5, BALLS)
    balls[0] = TRACK[0, 0] + BALL_RADIUS - inner_share
    balls[2] = SEATS
    return y


def error_scale():
    """The magnitude that matters in each channel, as crates/model/src/system/drop/layout.rs has it."""
    fall = math.sqrt(2 * GRAVITY * CLEARANCE)
    plane = [CLEARANCE, CLEARANCE, fall, fall]
    energy = 0.5 * INNER_INERTIA * RELEASE_SPEED**2 + 0.5 * ROTOR_MASS * fall**2
    head = [*plane, 1.0, RELEASE_SPEED, *plane, RELEASE_SPEED, *plane, 1.0, 0.01 * RELEASE_SPEED, energy]
    spin = RELEASE_SPEED * TRACK[0, 0] / BALL_RADIUS
    balls = [1e-4 * BALL_RADIUS, fall, 1.0, 0.01 * RELEASE_SPEED, spin]
    return np.array(head + [value for value in balls for _ in range(BALLS)])


def tolerances(rtol):
    """Relative and absolute tolerances by channel.

    The rotor's channels are a hundred times tighter: that costs nothing and takes contact times from the
    microsecond to the nanosecond, as its slow fall would otherwise be integrated loosely.
    """
    share = np.full(HEAD + 5 * BALLS, rtol)
    share[:6] *= 1e-2
    return share, share * error_scale()


def gap(_time, y):
    """Penetration of rotor and inner race, for the events."""
    return rotor_contact(y[:11].tolist())[0]


def level(_time, y):
    """Speed of the inner race over 95 % of the rotor's at release."""
    return y[10] - 0.95 * RELEASE_SPEED


def first_impact(solution, begin, end):
    """Largest normal force of the first contact, on dense output."""
    times = np.linspace(begin, end, 4001)
    return max(rotor_contact(y)[1] for y in solution.sol(times)[:11].T.tolist())


def main():
    """Integrates once and prints what came out and what it cost."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--duration", type=float, default=0.05, help="simulated time, s")
    parser.add_argument("--rtol", type=float, default=5e-4, help="relative tolerance")
    words = parser.parse_args()

    rtol, atol = tolerances(words.rtol)
    begun = time.process_time()
    solution = solve_ivp(
        rate,
        (0.0, words.duration),
        start(),
        method="LSODA",
        rtol=rtol,
        atol=atol,
        max_step=1e-3,
        events=(gap, level),
        dense_output=True,
    )
    seconds = time.process_time() - begun
    if not solution.success:
        raise SystemExit(solution.message)

    touches = solution.t_events[0].tolist()
    edges = [*touches[:2], words.duration]
    reached = solution.t_events[1].tolist()
    result = {
        "cpu_seconds": seconds,
        "simulated_seconds": words.duration,
        "rtol": words.rtol,
        "time_to_first_contact": touches[0] if touches else None,
        "first_impact_force": first_impact(solution, *edges[:2]) if touches else None,
        "inner_race_time_to_95_percent": reached[0] if reached else None,
        "rotor_race_friction_energy": float(solution.y[17, -1]),
        "rate_calls": solution.nfev,
        "steps": len(solution.t) - 1,
        "contact_start_times": touches[::2],
        "numpy": np.__version__,
        "scipy": scipy.__version__,
    }
    print(json.dumps(result))


if __name__ == "__main__":
    main()
