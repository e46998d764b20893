"""Two signs of ROSS in time: the negative stiffness of a magnet, and the friction of a rub.

    python benchmarks/peers/ross_signs.py

Needs `ross-rotordynamics` 2.3 and `plotly<6`. Prints for a rigid rotor on two magnets the eigenvalue of largest real part, by the matrices of ROSS's own linear
analysis, beside what its time response does after a blow; for its rub the force of friction at eight places of a circular whirl and the mean over the circle.
"""

import contextlib
import io
import warnings
from importlib.metadata import version

import numpy as np

warnings.filterwarnings("ignore")
import ross

STEEL = ross.Material("steel", rho=7850, E=2.1e11, Poisson=0.3)
GAP, BIAS, AREA, TURNS, HALF_ANGLE = 1e-3, 1.0, 1e-4, 200, 0.392
STEP, TIME, BLOW = 1e-5, 0.5, 2e-3
RADIUS = 25e-3
WHEEL = 2


def rotor_on(bearings):
    """A shaft of 0.2 m and 50 mm with a wheel of 5 kg in its middle."""
    shaft = [ross.ShaftElement(L=0.05, idl=0.0, odl=2 * RADIUS, material=STEEL, n=n) for n in range(4)]
    return ross.Rotor(shaft, [ross.DiskElement(n=WHEEL, m=5.0, Id=0.01, Ip=0.02)], bearings)


def magnet(node, share):
    """A magnet whose K_p k_i is a share of its negative stiffness, with little damping."""
    return ross.MagneticBearingElement(
        n=node, g0=GAP, i0=BIAS, ag=AREA, nw=TURNS, alpha=HALF_ANGLE, kp_pid=share * BIAS / GAP, kd_pid=0.2
    )


def after_a_blow(rotor):
    """Place of the wheel, m, over time after a half sine of 10 N."""
    times = np.arange(0.0, TIME, STEP)
    force = np.zeros((len(times), rotor.ndof))
    force[:, WHEEL * 6] = np.where(times < BLOW, 10.0 * np.sin(np.pi * times / BLOW), 0.0)
    with contextlib.redirect_stdout(io.StringIO()):
        return times, rotor.run_time_response(0.0, force, times, method="newmark").yout[:, WHEEL * 6]


def frequency(times, place):
    """Angular frequency by the crossings of zero after the blow, rad/s."""
    times, place = times[times > BLOW], place[times > BLOW]
    at = np.flatnonzero(np.diff(np.signbit(place)))
    crossings = times[at] - place[at] * np.diff(times)[at] / np.diff(place)[at]
    return np.pi / np.mean(np.diff(crossings))


def magnets():
    for share in (0.5, 1.5, 3.0):
        rotor = rotor_on([magnet(0, share), magnet(4, share)])
        negative = abs(float(np.ravel(rotor.bearing_elements[0].ks)[0]))
        mass = rotor.m
        # x and the rotation about y of all nodes: the rest is apart from them at standstill
        bent = [6 * node + of for of in (0, 4) for node in rotor.nodes]
        part = lambda matrix: matrix[np.ix_(bent, bent)]
        inverse = np.linalg.inv(part(rotor.M(0.0)))
        lower = np.hstack([-inverse @ part(rotor.K(0.0)), -inverse @ part(rotor.C(0.0))])
        upper = np.hstack([np.zeros((len(bent), len(bent))), np.eye(len(bent))])
        values = np.linalg.eigvals(np.vstack([upper, lower]))
        slow = values[values.real > values.real.max() - 1e-6]
        times, place = after_a_blow(rotor)
        print(
            f"K_p k_i = {share} |k_s|, |k_s| = {negative:.1f} N/m, {mass:.4f} kg: linear analysis {slow[0]:.2f} 1/s; "
            f"time response {frequency(times, place):.2f} rad/s, largest {1e6 * np.abs(place).max():.1f} um; "
            f"sqrt(2 (K_p k_i + |k_s|)/m) = {np.sqrt(2 * negative * (share + 1) / mass):.2f} rad/s, "
            f"with minus {np.emath.sqrt(2 * negative * (share - 1) / mass):.2f}"
        )


def rub():
    friction, stiffness, gap, depth = 0.3, 1e6, 1e-4, 1e-5
    rotor = rotor_on([ross.BearingElement(n=n, kxx=1e6, cxx=0.0) for n in (0, 4)])
    part, smooth = (ross.faults.rubbing.Rubbing(rotor, 1, gap, stiffness, 0.0, mu, torque=True) for mu in (friction, 0.0))
    load, radius = friction * stiffness * depth, gap + depth
    for spin, whirl in ((100.0, 100.0), (100.0, -100.0), (0.0, 100.0), (100.0, -40000.0)):
        found = []
        for angle in np.arange(360) * np.pi / 180 + 1e-6:
            n, t = np.array([np.cos(angle), np.sin(angle)]), np.array([-np.sin(angle), np.cos(angle)])
            place, velocity = np.zeros(12), np.zeros(12)
            place[:2], velocity[:2] = radius * n, whirl * radius * t
            force = part.compute_rubbing_force(place, velocity, spin) - smooth.compute_rubbing_force(place, velocity, spin)
            found.append([force[:2] @ t / load, force[:2] @ n / load, force[5] / (load * RADIUS)])
        slip = spin * RADIUS + whirl * radius
        print(f"spin {spin:g} rad/s, whirl {whirl:g} rad/s, slip {slip:.3f} m/s; Coulomb: {-np.sign(slip):+.0f}, 0, {-np.sign(slip):+.0f} at every place")
        for name, values in zip(("tangential force over mu N", "radial force over mu N", "moment over mu N R"), np.array(found).T):
            print(f"    {name}, at 0, 45 .. 315 deg:", " ".join(f"{value:+.2f}" for value in values[::45]), f"; mean {values.mean():+.3f}")


if __name__ == "__main__":
    print(", ".join(f"{name} {version(name)}" for name in ("ross-rotordynamics", "numpy", "scipy")))
    magnets()
    rub()
