"""A unit that FMPy steps at 50 us, beside a run with the same sampled instants.

    AUXBEAR_COMMAND=target/release/auxbear python3 fmu_stepped.py

The run has its own sampled controllers, the unit the same ones in this script: four signals are read and four commands set in each step.
Prints one JSON object of CPU times, s:
of a run without its start and its report (a long one less a short one), of the unit for the same time, and what reading and setting take
of that.
"""

import json
import os
import subprocess
import tempfile
import time
from pathlib import Path

import fmpy
from fmpy.fmi2 import FMU2Slave

COMMAND = os.environ.get("AUXBEAR_COMMAND", "auxbear")
SCENARIO = Path(__file__).parents[2] / "scenarios" / "amb_rig_drop.toml"
STEP, SHORT, LONG = 50e-6, 0.02, 0.1
SETS = [
    "levitation.controller.sampling_period=50 us",
    "levitation.controller.computing_time=0 s",
    "levitation.controller.delay=0 s",
    "levitation.power_lost_at=10 s",
]


def words(end: float) -> list:
    return [word for own in [*SETS, f"run.duration={end} s"] for word in ("--set", own)]


def run(end: float, folder: str) -> float:
    before = os.times()
    subprocess.run(
        [COMMAND, "run", SCENARIO, "--quiet", "--threads", "1", "--out", f"{folder}/run{end}{time.monotonic_ns()}", *words(end)], check=True
    )
    after = os.times()
    return after.children_user - before.children_user + after.children_system - before.children_system


def stepped(file: Path, folder: str) -> float:
    description = fmpy.read_model_description(str(file))
    references = {v.name: v.valueReference for v in description.modelVariables}
    signals = [reference for name, reference in references.items() if ".signal_" in name]
    commands = [reference for name, reference in references.items() if "current_command" in name]
    unit = FMU2Slave(
        guid=description.guid,
        unzipDirectory=fmpy.extract(str(file), unzipdir=f"{folder}/unit"),
        modelIdentifier=description.coSimulation.modelIdentifier,
        instanceName="machine",
    )
    unit.instantiate()
    unit.setupExperiment(startTime=0.0)
    unit.enterInitializationMode()
    unit.exitInitializationMode()
    # the controllers of the file, as the test of the package has them
    kp, ki, kd, td = 8000.0, 8e4, 22.0, 45.47284088339867e-6
    decay = (1 - STEP / 2 / td) / (1 + STEP / 2 / td)
    held, errors, rates = unit.getReal(commands), [-signal for signal in unit.getReal(signals)], [0.0] * 4
    sums = [command / ki - kp / ki * error for command, error in zip(held, errors)]
    times, before = [], time.process_time()
    for k in range(round(LONG / STEP)):
        if k == round(SHORT / STEP):
            before = time.process_time()
        now = k * STEP
        last, errors = errors, [-signal for signal in unit.getReal(signals)]
        for axis in range(4):
            sums[axis] += 0.5 * STEP * (errors[axis] + last[axis])
            rates[axis] = decay * rates[axis] + kd / td * (errors[axis] - last[axis]) / (1 + STEP / 2 / td)
        unit.setReal(commands, [kp * errors[axis] + ki * sums[axis] + rates[axis] for axis in range(4)])
        unit.doStep(currentCommunicationPoint=now, communicationStepSize=STEP)
    took = time.process_time() - before
    x = unit.getReal([references["drive_end.rotor.x"]])
    assert abs(x[0]) < 1e-4, x
    # the same calls without steps: what the importer takes
    before = time.process_time()
    for _ in range(round((LONG - SHORT) / STEP)):
        unit.getReal(signals)
        unit.setReal(commands, held)
    calls = time.process_time() - before
    unit.freeInstance()
    return took, calls


with tempfile.TemporaryDirectory() as folder:
    file = Path(folder) / "machine.fmu"
    subprocess.run([COMMAND, "fmu", SCENARIO, "--out", file, *words(LONG)], check=True, stdout=subprocess.DEVNULL)
    whole = [run(LONG, folder) - run(SHORT, folder) for _ in range(3)]
    units = [stepped(file, folder) for _ in range(3)]
    print(json.dumps({"run": sorted(whole)[1], "unit": sorted(units)[1][0], "reading_and_setting": sorted(units)[1][1]}))
