"""The reference drop as a careful user of Python would write it: a right-hand side compiled by Numba, CVODE of SUNDIALS.

    python3 cvode_numba.py [--duration 0.5] [--rtol 1e-5] [--traction-speed 0.1] [--method BDF|Adams|LSODA]

BDF is CVODE with a dense linear solver and a Jacobian that is compiled as well: differences ball by ball, as no ball
feels another directly. `--method difference` leaves the Jacobian to CVODE, which perturbs all 68 states one by one.
Adams is CVODE's other method, LSODA that of SciPy with this right-hand side.
Prints one JSON object; `cpu_seconds` covers the integration alone, neither imports nor compilation. Nothing compiled is
kept on disk: Numba would not notice that a parameter in another file has changed.
"""

import os

for pool in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[pool] = "1"  # before NumPy reads them

import cmath
import json
import math
import time

import numba
import numpy as np
import scipy
import scipy.integrate
import scipy.interpolate
import sksundae

from reference_drop import *  # the parameters, by their names
import reference_drop

compiled = numba.njit(error_model="numpy")
rotor_contact = compiled(reference_drop.rotor_contact)
SIZE = HEAD + 5 * BALLS
# What the balls do together to races and cage: force on the inner race x y, on the outer race x y, moments on inner
# race and cage
SUMS = 6
INNER_X, INNER_Y, OUTER_X, OUTER_Y, INNER_MOMENT, CAGE_MOMENT = range(SUMS)


@compiled
def race_contact(side, track, stiffness, x, y, vx, vy, race_spin, sigma, traction_speed):
    """Force of one race on a ball, tractions's moment arms, direction; `x y vx vy` is the ball seen from the race."""
    distance = math.sqrt(x * x + y * y)
    nx, ny = x / distance, y / distance
    leaving = vx * nx + vy * ny
    past = vy * nx - vx * ny
    approach = side * (track - distance) + BALL_RADIUS
    if approach <= 0.0:
        return 0.0, 0.0, 0.0, 0.0, nx, ny, distance, past, leaving
    load = stiffness * math.sqrt(approach) * (approach - 1.5 * DAMPING_TIME * side * leaving)
    load = max(load, 0.0)
    ball_arm = BALL_RADIUS - 0.5 * approach
    race_arm = track - side * 0.5 * approach
    slip = side * sigma * ball_arm - past + race_spin * race_arm
    traction = TRACTION * math.tanh(slip / traction_speed) * load
    return side * load, traction, ball_arm, race_arm, nx, ny, distance, past, leaving


@compiled
def ball(index, y, at, dy, sums, traction_speed):
    """Rates of the ball with states rho, rho', theta, theta', sigma from `at` on, `BALLS` apart; adds to `sums`."""
    rho, rho_rate, theta = y[at], y[at + BALLS], y[at + 2 * BALLS]
    theta_rate, sigma = y[at + 3 * BALLS], y[at + 4 * BALLS]
    c, s = math.cos(theta), math.sin(theta)
    orbital = rho * theta_rate
    x, z = rho * c, rho * s
    vx, vz = rho_rate * c - orbital * s, rho_rate * s + orbital * c

    load, traction, arm, race_arm, nx, ny, _, _, _ = race_contact(
        1.0, INNER_TRACK, INNER_STIFFNESS, x - y[6], z - y[7], vx - y[8], vz - y[9], y[10], sigma, traction_speed
    )
    fx, fy = load * nx - traction * ny, load * ny + traction * nx
    moment = -arm * traction - SPIN_DRAG * sigma
    sums[INNER_X] -= fx
    sums[INNER_Y] -= fy
    sums[INNER_MOMENT] -= race_arm * traction

    load, traction, arm, _, nx, ny, distance, past, leaving = race_contact(
        -1.0, OUTER_TRACK, OUTER_STIFFNESS, x - y[11], z - y[12], vx - y[13], vz - y[14], 0.0, sigma, traction_speed
    )
    moment += arm * traction

    # pocket, from the centre of the outer race
    turned = y[15] + 2.0 * math.pi * index / BALLS
    ct, st = math.cos(turned), math.sin(turned)
    offset = math.atan2(ny * ct - nx * st, nx * ct + ny * st)
    penetration = abs(offset) * POCKET_RADIUS - POCKET_GAP
    if penetration > 0.0:
        side = math.copysign(1.0, offset)
        speed = side * POCKET_RADIUS * (past / distance - y[16])
        press = max(POCKET_STIFFNESS * penetration * (1.0 + POCKET_DAMPING * speed), 0.0)
        slide = leaving - side * BALL_RADIUS * (sigma - y[16])
        friction = -POCKET_FRICTION * math.tanh(slide / POCKET_REFERENCE_SPEED) * press
        push = side * press * POCKET_RADIUS
        load += friction
        traction -= push / distance
        friction_moment = side * BALL_RADIUS * friction
        moment -= friction_moment
        sums[CAGE_MOMENT] += friction_moment + push

    ox, oy = load * nx - traction * ny, load * ny + traction * nx
    sums[OUTER_X] -= ox
    sums[OUTER_Y] -= oy
    ax, ay = (fx + ox) / BALL_MASS, (fy + oy) / BALL_MASS - GRAVITY
    dy[at] = rho_rate
    dy[at + BALLS] = ax * c + ay * s + orbital * theta_rate
    dy[at + 2 * BALLS] = theta_rate
    dy[at + 3 * BALLS] = (ay * c - ax * s - ORBIT_DRAG / BALL_MASS * orbital - 2.0 * rho_rate * theta_rate) / rho
    dy[at + 4 * BALLS] = moment / BALL_INERTIA


@compiled
def rotor_and_races(y, dy, sums):
    """Rates of the first states, given what the balls do."""
    depth, normal, friction, slip, arm, n = rotor_contact(y)
    force = complex(-normal, friction) * n
    lever = arm + n * (BORE_RADIUS - CLEARANCE - 0.5 * depth)
    own_weight = GRAVITY * (OUTER_MASS + INNER_MASS + BALLS * BALL_MASS)
    dy[0], dy[1] = y[2], y[3]
    dy[2], dy[3] = force.real / ROTOR_MASS, force.imag / ROTOR_MASS - GRAVITY
    dy[4], dy[5] = y[5], (lever.real * force.imag - lever.imag * force.real) / ROTOR_INERTIA
    dy[6], dy[7] = y[8], y[9]
    dy[8] = (sums[INNER_X] - force.real) / INNER_MASS
    dy[9] = (sums[INNER_Y] - force.imag) / INNER_MASS - GRAVITY
    dy[10] = (sums[INNER_MOMENT] - (BORE_RADIUS + 0.5 * depth) * friction) / INNER_INERTIA
    dy[11], dy[12] = y[13], y[14]
    dy[13] = (sums[OUTER_X] - MOUNT_STIFFNESS * y[11] - MOUNT_DAMPING * y[13]) / OUTER_MASS
    dy[14] = (sums[OUTER_Y] - MOUNT_STIFFNESS * y[12] + own_weight - MOUNT_DAMPING * y[14]) / OUTER_MASS - GRAVITY
    dy[15], dy[16] = y[16], sums[CAGE_MOMENT] / CAGE_INERTIA
    dy[17] = friction * slip


@compiled
def rate(_time, y, dy, traction_speed):
    """Time derivative of the state."""
    sums = np.zeros(SUMS)
    for index in range(BALLS):
        ball(index, y, HEAD + index, dy, sums, traction_speed)
    rotor_and_races(y, dy, sums)


@compiled
def jacobian(_time, y, dy, matrix, traction_speed):
    """Differences: each ball's own states move that ball alone, the first states everything."""
    scale = error_scale_of_all
    moved = y.copy()
    rates = np.empty(SIZE)
    own, sums = np.zeros(SUMS), np.zeros(SUMS)
    matrix[:] = 0.0
    for column in range(HEAD):
        step = 1.5e-8 * max(abs(y[column]), scale[column])
        moved[column] = y[column] + step
        step = moved[column] - y[column]
        rate(0.0, moved, rates, traction_speed)
        for row in range(SIZE):
            matrix[row, column] = (rates[row] - dy[row]) / step
        moved[column] = y[column]
    for index in range(BALLS):
        own[:] = 0.0
        ball(index, y, HEAD + index, rates, own, traction_speed)
        for state in range(5):
            column = HEAD + index + state * BALLS
            step = 1.5e-8 * max(abs(y[column]), scale[column])
            moved[column] = y[column] + step
            step = moved[column] - y[column]
            sums[:] = 0.0
            ball(index, moved, HEAD + index, rates, sums, traction_speed)
            for other in range(5):
                row = HEAD + index + other * BALLS
                matrix[row, column] = (rates[row] - dy[row]) / step
            matrix[8, column] = (sums[INNER_X] - own[INNER_X]) / step / INNER_MASS
            matrix[9, column] = (sums[INNER_Y] - own[INNER_Y]) / step / INNER_MASS
            matrix[10, column] = (sums[INNER_MOMENT] - own[INNER_MOMENT]) / step / INNER_INERTIA
            matrix[13, column] = (sums[OUTER_X] - own[OUTER_X]) / step / OUTER_MASS
            matrix[14, column] = (sums[OUTER_Y] - own[OUTER_Y]) / step / OUTER_MASS
            matrix[16, column] = (sums[CAGE_MOMENT] - own[CAGE_MOMENT]) / step / CAGE_INERTIA
            moved[column] = y[column]


error_scale_of_all = error_scale()


@compiled
def watched(_time, y, events, _traction_speed):
    """Penetration of rotor and inner race; its speed over 50 and 95 % of the rotor's at release."""
    events[0] = rotor_contact(y)[0]
    events[1] = y[10] - 0.5 * RELEASE_SPEED
    events[2] = y[10] - 0.95 * RELEASE_SPEED


def watched_by_cvode(time, y, events, traction_speed):
    """The same, as a function that can carry the attribute CVODE reads."""
    watched(time, y, events, traction_speed)


watched_by_cvode.terminal = [False] * 3


def cvode(words):
    """One integration; the seconds it took, its steps, the instants watched, the number of right-hand sides."""
    share, atol = tolerances(words.rtol)
    calls = {"jacfn": jacobian} if words.method == "BDF" else {}
    solver = sksundae.cvode.CVODE(
        rate,
        userdata=words.traction_speed,
        method="Adams" if words.method == "Adams" else "BDF",
        rtol=share.min(),
        atol=atol,
        max_step=1e-3,
        max_num_steps=10**8,
        eventsfn=watched_by_cvode,
        num_events=3,
        **calls,
    )
    begun = time.thread_time()
    solution = solver.solve(np.array([0.0, words.duration]), start())
    seconds = time.thread_time() - begun
    if not solution.success:
        raise SystemExit(solution.message)
    passed = [[], [], []]
    if solution.t_events is not None:
        passed = [solution.t_events[which != 0] for which in solution.i_events.T]
    return seconds, solution.t, solution.y, passed, solution.nfev


def lsoda(words):
    """The same by SciPy."""
    share, atol = tolerances(words.rtol)
    dy, values = np.empty(SIZE), np.empty(3)

    def right_hand_side(t, y):
        rate(t, y, dy, words.traction_speed)
        return dy.copy()

    def event(index):
        def value(t, y):
            watched(t, y, values, words.traction_speed)
            return values[index]

        return value

    begun = time.thread_time()
    solution = scipy.integrate.solve_ivp(
        right_hand_side,
        (0.0, words.duration),
        start(),
        method="LSODA",
        rtol=share,
        atol=atol,
        max_step=1e-3,
        events=[event(index) for index in range(3)],
    )
    seconds = time.thread_time() - begun
    return seconds, solution.t, solution.y.T, solution.t_events, solution.nfev


def over_first_contact(times, states, touches, traction_speed):
    """States on a fine grid between the first two touches, by cubics through the steps and their rates."""
    if len(touches) == 0:
        return []
    begin, end = [*touches, times[-1]][:2]
    near = (times > begin - 1e-4) & (times < end + 1e-4)
    at, first = np.unique(times[near], return_index=True)
    steps = states[near][first]
    rates = np.empty_like(steps)
    for y, dy in zip(steps, rates):
        rate(0.0, y, dy, traction_speed)
    return scipy.interpolate.CubicHermiteSpline(at, steps, rates)(np.linspace(begin, end, 4001))


def main():
    """Integrates once and prints what came out and what it cost."""
    words = arguments(__doc__, 1e-5, ["BDF", "difference", "Adams", "LSODA"])
    integrate = lsoda if words.method == "LSODA" else cvode
    duration, words.duration = words.duration, 1e-4
    integrate(words)  # compiles
    words.duration = duration
    seconds, times, states, (touches, *reached), calls = integrate(words)
    contact = over_first_contact(times, states, touches, words.traction_speed)
    result = quantities(words, seconds, list(touches), reached, contact, states[-1, 17])
    result |= {"rate_calls": int(calls), "steps": len(times) - 1}
    versions = {"numba": numba, "numpy": np, "scipy": scipy, "scikit_sundae": sksundae}
    print(json.dumps(result | {name: module.__version__ for name, module in versions.items()}))


if __name__ == "__main__":
    main()
