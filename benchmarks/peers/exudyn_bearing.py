"""The cage of `scenarios/spin_up_6010.toml` brought to speed by EXUDYN's ball bearing.

    python3 exudyn_bearing.py [--duration 4e-3] [--step 1e-6]

The model is that of `validation/exudyn/cage_spin_up.py`, with exponent 1.5. Prints one JSON object; `cpu_seconds` covers the solver alone,
after import and assembly.
"""

import os

for pool in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[pool] = "1"  # before NumPy reads them

import argparse
import json
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "validation" / "exudyn"))
import exudyn
import numpy as np
from cage_spin_up import KINEMATIC, passed, spin_up


def main():
    """Integrates once and prints what came out and what it cost."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--duration", type=float, default=4e-3)
    parser.add_argument("--step", type=float, default=1e-6)
    words = parser.parse_args()
    os.chdir(tempfile.mkdtemp())  # the package writes files beside itself
    times, speeds, seconds = spin_up(1.5, words.step, words.duration)
    result = {"cpu_seconds": seconds}
    result["cage_at_50_percent"] = float(passed(times, speeds, 0.5 * KINEMATIC))
    result["cage_at_95_percent"] = float(passed(times, speeds, 0.95 * KINEMATIC))
    print(json.dumps(result | {"exudyn": exudyn.__version__, "numpy": np.__version__}))


if __name__ == "__main__":
    main()
