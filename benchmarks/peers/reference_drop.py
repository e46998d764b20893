"""The reference drop as both peers know it: parameters, start, magnitudes of the channels, and the rotor's contact.

The machine is that of scenarios/reference_drop.toml; the equations are those of crates/model/src, written anew.
Vectors of the plane are complex numbers: v·n + i v·t = v conj(n). SI units throughout.
"""

import argparse
import cmath
import math

import numpy as np

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
INNER_TRACK = 14.825e-3
OUTER_TRACK = 21.173e-3
INNER_STIFFNESS = 25188251676.112152
OUTER_STIFFNESS = 22185150515.377434
DAMPING_TIME = 2.5e-6
TRACTION = 0.07
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

# State: rotor x y ẋ ẏ φ Ω, inner race x y ẋ ẏ ω, outer race x y ẋ ẏ, cage φ ω, friction energy; balls ρ ρ̇ θ θ̇ σ
HEAD = 18


def rotor_contact(y):
    """Penetration, normal force, friction on the rotor, slip, directions of the rotor/race contact."""
    spin, inner_spin = y[5], y[10]
    arm = -ECCENTRICITY * cmath.exp(1j * y[4])
    gap = complex(y[0] - y[6], y[1] - y[7]) + arm
    distance = abs(gap)
    n = gap / distance
    closing = (complex(y[2] - y[8], y[3] - y[9]) + 1j * spin * arm) * n.conjugate()
    depth = distance - CLEARANCE
    if depth <= 0.0:
        return depth, 0.0, 0.0, 0.0, arm, n
    normal = CONTACT_STIFFNESS * depth**CONTACT_EXPONENT * (1 + CONTACT_DAMPING * closing.real)
    normal = max(normal, 0.0)
    rotor_arm = BORE_RADIUS - CLEARANCE - depth / 2
    slip = inner_spin * (BORE_RADIUS + depth / 2) - spin * rotor_arm - closing.imag
    friction = CONTACT_FRICTION * math.tanh(slip / CONTACT_REFERENCE_SPEED) * normal
    return depth, normal, friction, slip, arm, n


def start():
    """Steady levitated orbit of the rotor above a bearing at rest."""
    k = LEVITATION_STIFFNESS + 1j * LEVITATION_DAMPING * RELEASE_SPEED
    centre = ECCENTRICITY * k / (k - ROTOR_MASS * RELEASE_SPEED**2)
    speed = 1j * RELEASE_SPEED * centre
    interference = INNER_TRACK + 2 * BALL_RADIUS - OUTER_TRACK
    inner_share = interference / (1 + (INNER_STIFFNESS / OUTER_STIFFNESS) ** (2 / 3))
    y = np.zeros(HEAD + 5 * BALLS)
    y[:6] = centre.real, centre.imag, speed.real, speed.imag, 0.0, RELEASE_SPEED
    balls = y[HEAD:].reshape(5, BALLS)
    balls[0] = INNER_TRACK + BALL_RADIUS - inner_share
    balls[2] = 2 * np.pi * np.arange(BALLS) / BALLS
    return y


def error_scale():
    """The magnitude that matters in each channel, as crates/model/src/system/drop/layout.rs has it."""
    fall = math.sqrt(2 * GRAVITY * CLEARANCE)
    plane = [CLEARANCE, CLEARANCE, fall, fall]
    energy = 0.5 * INNER_INERTIA * RELEASE_SPEED**2 + 0.5 * ROTOR_MASS * fall**2
    head = [*plane, 1.0, RELEASE_SPEED, *plane, RELEASE_SPEED, *plane, 1.0, 0.01 * RELEASE_SPEED, energy]
    spin = RELEASE_SPEED * INNER_TRACK / BALL_RADIUS
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


def arguments(description, rtol, methods):
    """What a peer is asked for."""
    parser = argparse.ArgumentParser(description=description.splitlines()[0])
    parser.add_argument("--duration", type=float, default=0.05, help="simulated time, s")
    parser.add_argument("--rtol", type=float, default=rtol, help="relative tolerance")
    parser.add_argument("--traction-speed", type=float, default=0.1, help="reference speed of ball traction, m/s")
    parser.add_argument("--method", choices=methods, default=methods[0])
    return parser.parse_args()


def quantities(words, seconds, touches, reached, contact_states, friction_energy):
    """What a peer reports: its cost and the reproducible quantities.

    `touches` are the instants at which rotor and race begin or end to touch, in turn; `reached` those at which the inner
    race passes 50 and 95 %; `contact_states` are the states on a fine grid over the first contact.
    """

    def first(times):
        return float(times[0]) if len(times) else None

    return {
        "cpu_seconds": seconds,
        "simulated_seconds": words.duration,
        "method": words.method,
        "rtol": words.rtol,
        "traction_reference_speed": words.traction_speed,
        "time_to_first_contact": first(touches),
        "first_impact_force": max((rotor_contact(y)[1] for y in contact_states), default=None),
        "inner_race_time_to_50_percent": first(reached[0]),
        "inner_race_time_to_95_percent": first(reached[1]),
        "rotor_race_friction_energy": float(friction_energy),
        "contact_start_times": touches[::2],
    }
