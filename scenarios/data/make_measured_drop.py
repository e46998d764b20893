"""Writes measured_drop.csv, a made-up measurement for scenarios/measured_drop.toml. Nothing in it was measured.

    python3 scenarios/data/make_measured_drop.py target/debug/auxbear

Two runs of the scenario with FRICTION and DAMPING instead of its own values, the second with the unbalance turned by TURNED, are sampled
with noise of PROBE and RACE rms. Before the release the rotor whirls on its magnets as it does at the release.
"""

import csv
import math
import random
import subprocess
import sys
import tempfile
from pathlib import Path

FRICTION, DAMPING, TURNED = 0.21, "3200 N s/m", "60 deg"
PROBE, RACE = 1e-6, 2.0  # m, rad/s
BEFORE, STEP = 0.03, 1e-4  # s
SPEED = 12000 * math.pi / 30

here = Path(__file__).parent


def run(*sets):
    text = (here.parent / "measured_drop.toml").read_text().split("[[measured]]")[0]
    with tempfile.TemporaryDirectory() as folder:
        scenario = Path(folder) / "truth.toml"
        scenario.write_text(text)
        out = Path(folder) / "run"
        sets = [word for path in (f"contact.friction_coefficient={FRICTION}", f"mount.damping={DAMPING}", *sets) for word in ("--set", path)]
        subprocess.run([sys.argv[1], "run", scenario, "--out", out, "--quiet", *sets], check=True)
        subprocess.run([sys.argv[1], "export", out, "--csv"], check=True)
        (history,) = Path(folder).rglob("history.csv")
        with history.open() as file:
            return list(csv.DictReader(file))


def column(rows, name):
    (key,) = [key for key in rows[0] if key.split(" [")[0] == name]
    return [float(row[key]) for row in rows]


noise = random.Random(1)
drops = [run(), run(f"rotor.unbalance_angle={TURNED}")]
before = round(BEFORE / STEP)
lines = []
for row in range(-before, len(drops[0])):
    values = [f"{(row + before) * STEP:.4f}"]
    for number, rows in enumerate(drops):
        x, y, race = (column(rows[: max(row, 0) + 1][-1:], name)[0] for name in ("rotor.x", "rotor.y", "bearing.inner_race.speed"))
        turned = SPEED * STEP * min(row, 0)
        x, y = x * math.cos(turned) - y * math.sin(turned), x * math.sin(turned) + y * math.cos(turned)
        values += [f"{1e6 * (x + noise.gauss(0, PROBE)):.2f}", f"{-1e6 * (y + noise.gauss(0, PROBE)):.2f}"]
        if number == 0:
            values.append(f"{(race + noise.gauss(0, RACE)) * 30 / math.pi:.1f}")
    lines.append("; ".join(values))
head = "Synthetic: written by make_measured_drop.py, nothing was measured\n"
names = "time [s]; probe x [um]; probe y [um]; race [rpm]; probe x, drop 2 [um]; probe y, drop 2 [um]"
(here / "measured_drop.csv").write_text(head + names + "\n" + "\n".join(lines) + "\n")
