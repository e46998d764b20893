"""Response of the 52-element rotor to its unbalance in time, by ROSS: Newmark steps, linear supports.

    python3 ross_time.py [--duration 0.3] [--step 1e-4] [--modes 0]

The rotor is that of `scenarios/rotor_52_elements.toml`, which ROSS brings along. It starts at rest in the middle, at full speed. `--modes` reduces the model in the
way of ROSS, "pseudomodal"; 0 is the whole of it. Prints one JSON object; `cpu_seconds` covers the time response alone, after import and compilation, and
`middle_amplitude` is the largest distance from the middle in the last 50 ms beside that of ROSS's own response in frequency.
"""

import os

for pool in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS"):
    os.environ[pool] = "1"  # before NumPy reads them

import argparse
import contextlib
import io
import json
import time
import warnings
from importlib.metadata import version

warnings.filterwarnings("ignore")
with contextlib.redirect_stdout(io.StringIO()):
    import numpy as np
    import ross

SPEED = 1256.6370614359173
MIDDLE, END = 28, 5
UNBALANCE, PHASE = [20e-6, 3e-6], [0.0, 1.0]


def rotor():
    """As it stands, on supports in place of its magnets, with the damping of the scenario."""
    shipped = ross.rotor_amb_example()
    shaft = [
        ross.ShaftElement(L=part.L, idl=part.idl, odl=part.odl, material=part.material, alpha=2.5, beta=1e-6)
        for part in shipped.shaft_elements
    ]
    supports = [ross.BearingElement(n=node, kxx=160e3, cxx=880.0) for node in (12, 43)]
    return ross.Rotor(shaft, shipped.disk_elements, supports)


def response(model, duration, step, modes):
    """Place of the middle over time and the seconds it took."""
    times = np.arange(0.0, duration, step)
    options = {"model_reduction": {"num_modes": modes}} if modes else {}
    begun = time.thread_time()
    answer = model.run_time_response(SPEED, force(model, times), times, method="newmark", **options)
    seconds = time.thread_time() - begun
    return answer.yout[:, 6 * MIDDLE] + 1j * answer.yout[:, 6 * MIDDLE + 1], seconds


def force(model, times):
    """The unbalance at constant speed."""
    found = np.zeros((len(times), model.ndof))
    for node, amount, phase in zip((MIDDLE, END), UNBALANCE, PHASE):
        found[:, 6 * node] = amount * SPEED**2 * np.cos(SPEED * times + phase)
        found[:, 6 * node + 1] = amount * SPEED**2 * np.sin(SPEED * times + phase)
    return found


def main():
    """Integrates once and prints what came out and what it cost."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--duration", type=float, default=0.3)
    parser.add_argument("--step", type=float, default=1e-4)
    parser.add_argument("--modes", type=int, default=0)
    words = parser.parse_args()
    with contextlib.redirect_stdout(io.StringIO()):
        model = rotor()
        response(model, 20 * words.step, words.step, words.modes)  # compiles
        place, seconds = response(model, words.duration, words.step, words.modes)
        steady = model.run_unbalance_response([MIDDLE, END], UNBALANCE, PHASE, frequency=[SPEED]).forced_resp
    result = {
        "cpu_seconds": seconds,
        "middle_amplitude": float(np.abs(place[-round(0.05 / words.step) :]).max()),
        "middle_amplitude_in_frequency": float(np.abs(steady[6 * MIDDLE, 0])),
        "mass": float(model.m),
    }
    print(json.dumps(result | {name: version(name) for name in ("ross-rotordynamics", "numpy", "scipy")}))


if __name__ == "__main__":
    main()
