"""Linear analysis of the rotors that ROSS brings along: ROSS beside `auxbear import` and `auxbear run`.

    python benchmarks/peers/ross_linear.py path/to/auxbear

Needs `ross-rotordynamics` 2.3 and `plotly<6`. Prints, for each rotor and speed, the largest difference of the first twelve bending eigenvalues, |Δλ|/|λ|,
and the CPU time of both for a Campbell diagram of 100 speeds.
"""

import json
import resource
import subprocess
import sys
import tempfile
import time
import warnings
from pathlib import Path

import numpy as np
import ross

warnings.filterwarnings("ignore")
MODES = 12


def eigenvalues(rotor, speed):
    found = rotor.run_modal(speed, num_modes=8 * MODES).evalues
    return [value for value in found if value.imag > 1.0]


def of_auxbear(command, folder, file, settings, name):
    out = folder / name
    words = [command, "run", file, "--out", out, "--quiet"]
    for path, value in settings.items():
        words += ["--set", f"{path}={value}"]
    done = subprocess.run(words, capture_output=True, text=True)
    if done.returncode != 0:
        raise RuntimeError(done.stderr)
    return json.loads((out / "summary.json").read_text())["quantities"]


def number(quantities, name):
    return quantities[name]["value"]


def modes(quantities):
    found = []
    for k in range(1, MODES + 1):
        if f"mode_{k}.frequency" in quantities:
            frequency, ratio = (number(quantities, f"mode_{k}.{what}") for what in ("frequency", "damping_ratio"))
            # the frequency is Im λ, the ratio -Re λ/|λ|
            found.append(complex(-ratio * frequency / (1.0 - ratio**2) ** 0.5, frequency))
    return found


def difference(ours, theirs):
    """Largest distance of one of ours to the nearest of theirs, which has axial and torsional modes besides, of its size."""
    return max(min(abs(value - other) for other in theirs) / abs(value) for value in ours)


def main(command):
    rotors = {
        "rotor_example": (ross.rotor_example(), [10.0, 100.0, 400.0]),
        # speeds of rows of its tables: in between ROSS takes splines, auxbear straight lines
        "compressor_example": (ross.compressor_example(), [1047.1975511965977]),
    }
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for title, (rotor, speeds) in rotors.items():
            saved, file = folder / f"{title}.toml", folder / f"{title}-auxbear.toml"
            rotor.save(saved)
            subprocess.run([command, "import", saved, "--out", file], check=True, capture_output=True)
            for k, speed in enumerate(speeds):
                theirs = eigenvalues(rotor, speed)
                quantities = of_auxbear(command, folder, file, {"rotor.speed": f"{speed} rad/s", "analysis.modes": MODES}, f"{title}-{k}")
                whole = of_auxbear(command, folder, file, {"rotor.speed": f"{speed} rad/s", "analysis.modes": MODES, "analysis.cutoff": "1e9 rad/s"}, f"{title}-{k}-whole")
                parts = [f"{number(found, 'coordinates'):.0f} coordinates {difference(modes(found), theirs):.1e}" for found in (quantities, whole)]
                print(f"{title} at {speed:.1f} rad/s: {len(modes(whole))} eigenvalues differ by at most: {', '.join(parts)}")
            mass = number(quantities, "mass") / rotor.m - 1.0
            print(f"{title}: mass differs by {mass:.1e}")
            begin = time.process_time()
            rotor.run_campbell(np.linspace(0.0, 1000.0, 100))
            theirs = time.process_time() - begin
            begin = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
            of_auxbear(command, folder, file, {"analysis.speed_count": 100, "analysis.speed_to": "1000 rad/s"}, f"{title}-campbell")
            ours = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - begin
            print(f"{title}: 100 speeds, ROSS {theirs:.2f} CPU s, auxbear with critical speeds, map and report {ours:.2f}")


if __name__ == "__main__":
    main(sys.argv[1])
