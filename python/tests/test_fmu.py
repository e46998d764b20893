"""Machines as co-simulation units, driven by FMPy, another importer than ours."""

import ctypes
import functools
import hashlib
import json
import math
import os
import re
import subprocess
import traceback
import zipfile
from pathlib import Path

import numpy as np
import pytest

import auxbear

fmpy = pytest.importorskip("fmpy")
from fmpy.fmi2 import FMU2Slave  # noqa: E402
from fmpy.fmi3 import FMU3Slave  # noqa: E402
from fmpy.validation import validate_fmu  # noqa: E402

SCENARIOS = Path(__file__).parents[2] / "scenarios"
PERIOD, COMPUTING, LOSS, END = 50e-6, 20e-6, 4e-3, 12e-3
COMMAND = os.environ.get("AUXBEAR_COMMAND", "auxbear")

SETTINGS = {
    "levitation.controller.delay": "0 s",
    "levitation.controller.sampling_period": "50 us",
    "levitation.controller.computing_time": "20 us",
    "levitation.power_lost_at": "4 ms",
    "auxiliary_bearing.drive_end.contact.radial_air_clearance": "30 um",
    "run.duration": "12 ms",
}


def machine() -> auxbear.Scenario:
    """The rig with samples, which loses its magnets after 4 ms and lands soon after."""
    scenario = auxbear.Scenario.load(SCENARIOS / "amb_rig_drop.toml")
    for path, value in SETTINGS.items():
        scenario = scenario.set(path, value)
    return scenario


def export(folder: Path, *words: str) -> Path:
    file = folder / "machine.toml"
    file.write_text(machine().toml(), encoding="utf-8")
    out = folder / "machine.fmu"
    out.unlink(missing_ok=True)
    called = subprocess.run([COMMAND, "fmu", file, "--out", out, *words], capture_output=True, text=True)
    assert called.returncode == 0, called.stderr
    return out


@pytest.fixture(scope="module")
def exported(tmp_path_factory):
    folder = tmp_path_factory.mktemp("fmi3")
    by_package = machine().fmu(folder / "machine.fmu", version=3)
    return {"2": export(tmp_path_factory.mktemp("fmi2"), "--version", "2"), "3": by_package}


class Unit:
    """A unit of either version, by names."""

    def __init__(self, file: Path, folder: Path, *, instantiated=(), **start):
        self.description = fmpy.read_model_description(str(file))
        self.three = self.description.fmiVersion.startswith("3")
        self.references = {v.name: v.valueReference for v in self.description.modelVariables}
        self.messages = []
        unzipped = fmpy.extract(str(file), unzipdir=str(folder / file.stem))
        known = self.description.guid if not self.three else self.description.instantiationToken
        words = dict(
            guid=known,
            unzipDirectory=unzipped,
            modelIdentifier=self.description.coSimulation.modelIdentifier,
            instanceName="machine",
        )
        self.own = (FMU3Slave if self.three else FMU2Slave)(**words)
        self.own.instantiate(**dict(instantiated))
        for name, value in start.items():
            self.set(name, value)
        if self.three:
            self.own.enterInitializationMode(startTime=0.0)
        else:
            self.own.setupExperiment(startTime=0.0)
            self.own.enterInitializationMode()
        self.own.exitInitializationMode()

    def get(self, *names):
        references = [self.references[name] for name in names]
        return (self.own.getFloat64 if self.three else self.own.getReal)(references)

    def set(self, name, value):
        references = [self.references[name]]
        kind = {str: "String", bool: "Boolean"}.get(type(value), "Float64" if self.three else "Real")
        getattr(self.own, f"set{kind}")(references, [value])

    def step(self, start, end):
        length = end - start
        while start + length != end:  # an importer adds its steps up
            length = np.nextafter(length, np.inf if start + length < end else 0.0)
        self.own.doStep(currentCommunicationPoint=start, communicationStepSize=length)

    def end(self):
        self.own.terminate()
        self.own.freeInstance()


AXES = [(end, number) for end in ("drive_end", "other_end") for number in (1, 2)]


class Controllers:
    """The controllers of the rig, as a user would write them: K_p + K_i/s + K_d s/(1 + T_d s) by the bilinear rule."""

    def __init__(self):
        kp, ki, kd, rate = 8000.0, 8e4, 22.0, 1.0 / 45.47284088339867e-6
        # A is diagonal: 0 of the integral, -rate of the derivative
        half = [0.0, -rate * (0.5 * PERIOD)]
        factor = [1.0 / (1.0 - own) for own in half]
        entry = [factor[0] * (0.5 * PERIOD), factor[1] * rate * (0.5 * PERIOD)]
        self.a = [own * (1.0 + h) for own, h in zip(factor, half)]
        self.b = [own * e * 2.0 for own, e in zip(factor, entry)]
        self.c = [ki, -kd * rate]
        self.d = kp + kd * rate + (self.c[0] * entry[0] + self.c[1] * entry[1])
        # states and commands behind the sample of the start
        start = machine().simulation()
        find = lambda end: [start[name] for name in start if name.endswith(end)]  # noqa: E731
        self.states = list(zip(find("integral"), find("derivative")))
        self.commands = find("command computed")
        assert len(self.states) == 4 and len(self.commands) == 4

    def sample(self, signals):
        errors = [0.0 - signal for signal in signals]
        (c1, c2), (a1, a2), (b1, b2) = self.c, self.a, self.b
        pairs = list(zip(self.states, errors))
        self.commands = [c1 * x1 + c2 * x2 + self.d * e for (x1, x2), e in pairs]
        self.states = [(a1 * x1 + b1 * e, a2 * x2 + b2 * e) for (x1, x2), e in pairs]


def drive(unit: Unit, until: float = END, shift: float = 0.0) -> None:
    """Samples at k T_s and commands at k T_s + T_c until the power is lost, then one step to the end; steps end `shift` early besides."""
    own, now = Controllers(), 0.0
    signals = [f"sensor.{end}.signal_{number}" for end, number in AXES]

    def go(end):
        nonlocal now
        for stop in [end - shift, end] if shift else [end]:
            unit.step(now, stop)
            now = stop

    k = 0
    while True:
        go(k * PERIOD + COMPUTING)
        for (end, number), command in zip(AXES, own.commands):
            unit.set(f"magnet.{end}.current_command_{number}", command)
        k += 1
        if k * PERIOD >= LOSS:
            break
        go(k * PERIOD)
        own.sample(unit.get(*signals))
    go(until)


@pytest.mark.parametrize("version", "23")
def test_driven_by_its_own_controllers_it_is_its_run(exported, tmp_path, version) -> None:
    run = machine().run()
    unit = Unit(exported[version], tmp_path, run_directory=str(tmp_path / "run"))
    drive(unit)
    names = [name for name in run.history if name in unit.references and name != "time"]
    assert len(names) > 100
    last = dict(zip(names, unit.get(*names)))
    unit.end()
    theirs, ours = run.summary, json.loads((tmp_path / "run" / "summary.json").read_text(encoding="utf-8"))
    assert ours["work"]["steps"] == theirs["work"]["steps"]
    assert len(theirs["contacts"]) > 3
    for name, value in last.items():
        largest = np.nanmax(np.abs(run.history[name]))
        assert abs(value - run.history[name][-1]) <= 1e-12 * largest, name
    for name, quantity in theirs["quantities"].items():
        value, other = quantity["value"], ours["quantities"][name]["value"]
        if isinstance(value, float) and "residual" not in name:
            assert other == pytest.approx(value, rel=1e-12, abs=1e-15), name


@pytest.mark.parametrize("version", "23")
def test_importers_find_nothing_wrong(exported, version) -> None:
    assert validate_fmu(str(exported[version])) == []


def test_all_functions_of_the_headers_are_exported(exported, tmp_path) -> None:
    headers = Path(fmpy.__file__).parent / "c-code"
    names = []
    for header in ("fmi2Functions.h", "fmi3Functions.h"):
        text = (headers / header).read_text(encoding="utf-8")
        names += re.findall(r"_Export +fmi[23]\w+TYPE +(fmi[23]\w+);", text)
    exchange = [name for name in names if name.startswith("fmi2")]
    assert len(names) > 100 and "fmi3DoStep" in names and "fmi2DoStep" in exchange
    unzipped = fmpy.extract(str(exported["3"]), unzipdir=str(tmp_path / "unzipped"))
    library = ctypes.CDLL(str(next(Path(unzipped).glob("binaries/*/auxbear.*"))))
    missing = [name for name in names if not hasattr(library, name)]
    # those of model exchange in 2.0 are of another kind of unit
    assert [name for name in missing if name.startswith("fmi3")] == []
    assert len([name for name in missing if name.startswith("fmi2")]) <= 11, missing


@pytest.mark.parametrize("version", "23")
def test_a_state_gives_the_same_bits(exported, tmp_path, version) -> None:
    unit = Unit(exported[version], tmp_path)
    names = list(unit.references)
    names = [v.name for v in unit.description.modelVariables if v.causality == "output"]
    unit.step(0.0, 1e-3)
    three = unit.three
    state = unit.own.getFMUState() if three else unit.own.getFMUstate()
    data = unit.own.serializeFMUState(state) if three else unit.own.serializeFMUstate(state)

    def on(own):
        own.set("magnet.drive_end.current_command_1", 0.7)
        own.step(1e-3, 7e-3)
        return [float(value).hex() for value in own.get(*names)]

    first = on(unit)
    (unit.own.setFMUState if three else unit.own.setFMUstate)(state)
    assert on(unit) == first
    other = Unit(exported[version], tmp_path / "other")
    again = other.own.deserializeFMUState(data) if three else other.own.deSerializeFMUstate(data)
    (other.own.setFMUState if three else other.own.setFMUstate)(again)
    assert on(other) == first
    other.end()
    unit.end()


@pytest.mark.parametrize("allowed", [False, True])
def test_a_step_returns_early_at_a_contact_where_the_importer_allows_that(exported, tmp_path, allowed) -> None:
    more = {"earlyReturnAllowed": allowed}
    unit = Unit(exported["3"], tmp_path, instantiated=more, stop_at_contacts=True)
    now, stops = 0.0, []
    while now < END:
        _, _, early, now = unit.own.doStep(currentCommunicationPoint=now, communicationStepSize=END - now)
        stops.append(now)
        assert early == (now < END)
    assert (len(stops) > 3) == allowed and stops[-1] == END
    unit.end()


def test_driven_at_other_points_it_is_one_more_of_its_perturbed_runs(tmp_path) -> None:
    """Results that the first contacts decide agree to the tolerance; of those that scatter, 2 in 9 lie outside the range of 8 others."""
    longer, changes = 0.06, []
    for angle in (math.pi / 4 * k for k in range(8)):
        start = {"rotor.start_x": math.cos(angle), "rotor.start_y": math.sin(angle)}
        changes.append({path: f"{1e-10 * part} m" for path, part in start.items()})
    members = machine().set("run.duration", f"{longer} s").evaluate(changes).table
    duration = {"scenario.run.duration": longer, "run_directory": str(tmp_path / "run")}
    unit = Unit(export(tmp_path), tmp_path, **duration)
    drive(unit, longer, shift=7e-6)
    unit.end()
    found = json.loads((tmp_path / "run" / "summary.json").read_text(encoding="utf-8"))["quantities"]
    scattered, outside = 0, []
    for name in members.columns:
        values, value = members[name].tolist(), found.get(name, {}).get("value")
        if not all(isinstance(own, float) and math.isfinite(own) for own in [value, *values]):
            continue
        low, high = min(values), max(values)
        if high - low > 1e-3 * max(abs(low), abs(high)):
            scattered += 1
            outside += [name] * (not low <= value <= high)
    assert scattered > 40 and len(outside) < 0.4 * scattered, outside
    first = "drive_end.time_to_first_contact"
    assert found[first]["value"] == pytest.approx(members[first][0], rel=1e-5)


SOURCE = """
from {module} import {names}

C, A, B, D = {c!r}, {a!r}, {b!r}, {d!r}
STATES, FIRST = {states!r}, {first!r}


class Controllers({bases}):
    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.states, self.stepped = list(STATES), False
        {time}
        for axis in range({axes}):
            setattr(self, f"signal_{{axis}}", 0.0)
            setattr(self, f"command_{{axis}}", 0.0)
            self.register_variable({real}(f"signal_{{axis}}", causality={causality}.input, {start}))
            self.register_variable({real}(f"command_{{axis}}", causality={causality}.output))

    def do_step(self, current_time, step_size):
        for axis in range({axes}):
            (x1, x2), e = self.states[axis % 4], 0.0 - getattr(self, f"signal_{{axis}}")
            # the states are those behind the sample of the start
            command = FIRST[axis % 4]
            if self.stepped:
                command = C[0] * x1 + C[1] * x2 + D * e
                self.states[axis % 4] = (A[0] * x1 + B[0] * e, A[1] * x2 + B[1] * e)
            setattr(self, f"command_{{axis}}", command)
        self.stepped = True
        return {done}
"""

VERSIONS = {
    "2": dict(
        module="pythonfmu",
        names="Fmi2Causality, Fmi2Slave, Real",
        bases="Fmi2Slave",
        real="Real",
        causality="Fmi2Causality",
        time="",
        start="start=0.0",
        done="True",
    ),
    "3": dict(
        module="pythonfmu3",
        names="Fmi3Causality, Fmi3Slave, Fmi3Variability, Float64",
        bases="Fmi3Slave",
        real="Float64",
        causality="Fmi3Causality",
        time="self.time = 0.0\n        self.register_variable(Float64('time', causality=Fmi3Causality.independent, variability=Fmi3Variability.continuous))",
        start="start=0.0",
        done="True",
    ),
}


def in_a_process_of_its_own(test):
    """The test in a child that ends without exit handlers: the libraries of pythonfmu release a static object there twice
    (PySlaveInstance.cpp: its own destructor, then that of the library), which leaves the heap of the process broken."""

    @functools.wraps(test)
    def forked(*arguments, **named):
        for words in VERSIONS.values():
            pytest.importorskip(words["module"])
        child = os.fork()
        if child == 0:
            status = 1
            try:
                test(*arguments, **named)
                status = 0
            except BaseException:
                os.write(2, traceback.format_exc().encode())
            finally:
                os._exit(status)
        assert os.waitpid(child, 0)[1] == 0

    return pytest.mark.skipif(not hasattr(os, "fork"), reason="no fork here")(forked)


def controller(folder: Path, version: str, axes: int = 4) -> Path:
    """The controllers of the rig as a unit made by another program."""
    words = VERSIONS[version]
    own = Controllers()
    source = folder / f"controllers{version}{axes}.py"
    text = SOURCE.format(
        **words, axes=axes, a=tuple(own.a), b=tuple(own.b), c=tuple(own.c), d=own.d, states=own.states, first=own.commands
    )
    source.write_text(text, encoding="utf-8")
    builder = pytest.importorskip(words["module"] + ".builder").FmuBuilder
    return Path(builder.build_FMU(source, dest=folder))


@pytest.mark.parametrize("version", "23")
@in_a_process_of_its_own
def test_a_unit_as_controller_gives_the_numbers_of_the_built_in_one(tmp_path, version) -> None:
    unit = controller(tmp_path, version)
    run = machine().run()
    controlled = machine().set("levitation.controller.fmu", str(unit)).run()
    assert controlled.complete, controlled.stop
    assert controlled.summary["work"]["steps"] == run.summary["work"]["steps"]
    for name in run.history:
        ours, theirs = np.asarray(controlled.history[name]), np.asarray(run.history[name])
        assert np.nanmax(np.abs(ours - theirs)) <= 1e-12 * np.nanmax(np.abs(theirs)), name
    controlled.write(tmp_path / "run")
    assert (tmp_path / "run" / unit.name).read_bytes() == unit.read_bytes()
    resolved = (tmp_path / "run" / "scenario.toml").read_text(encoding="utf-8")
    assert f"sha256:{hashlib.sha256(unit.read_bytes()).hexdigest()}" in resolved


@in_a_process_of_its_own
def test_units_that_cannot_control_are_refused(tmp_path) -> None:
    few = controller(tmp_path, "2", axes=2)
    text = tmp_path / "text.fmu"
    text.write_text("no unit", encoding="utf-8")
    for file, why in (
        (few, "it has 2 inputs, and 4 axes of sensors give a signal each"),
        (text, "is no unit that can be unpacked"),
        (tmp_path / "none.fmu", "No such file"),
    ):
        with pytest.raises(auxbear.Problem, match=why):
            machine().set("levitation.controller.fmu", str(file)).run()
    other = machine().set("levitation.controller.fmu", str(few)).set("levitation.controller.fmu_hash", "sha256:00")
    with pytest.raises(auxbear.Problem, match="another one than that of fmu_hash"):
        other.run()
    with pytest.raises(auxbear.Problem, match="sampling_period"):
        auxbear.Scenario.load(SCENARIOS / "amb_rig_drop.toml").set("levitation.controller.fmu", str(few)).check()
    # studies ask while they run: members end and say why
    few_inputs = machine().set("levitation.controller.fmu", str(few))
    _, failed = few_inputs.evaluate([{"rotor.speed": "11000 rpm"}])
    assert "2 inputs" in failed[0]


@in_a_process_of_its_own
def test_a_unit_that_may_be_there_once_is_refused_for_more_members(tmp_path) -> None:
    unit = controller(tmp_path, "2")
    alone = tmp_path / "alone.fmu"
    with zipfile.ZipFile(unit) as given, zipfile.ZipFile(alone, "w") as written:
        for name in given.namelist():
            content = given.read(name)
            if name == "modelDescription.xml":
                content = content.replace(b'canBeInstantiatedOnlyOncePerProcess="false"', b'canBeInstantiatedOnlyOncePerProcess="true"')
                assert b'OncePerProcess="true"' in content
            written.writestr(name, content)
    scenario = machine().set("run.duration", "1 ms").set("levitation.controller.fmu", str(alone))
    assert scenario.run().complete
    with pytest.raises(auxbear.Problem, match="may be instantiated once in a process"):
        scenario.run(repeat=2)
