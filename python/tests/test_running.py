"""Threads, Ctrl-C, progress, studies, and what a call costs."""

import _thread
import os
import signal
import subprocess
import sys
import threading
import time

import auxbear
import pytest
from conftest import SCENARIOS


def long_drop():
    return auxbear.Scenario.load(SCENARIOS / "reference_drop.toml").set("run.duration", "20 s")


def test_ctrl_c_ends_a_run():
    # a job in the background is started with the signal ignored
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    begin = time.monotonic()
    threading.Timer(0.5, _thread.interrupt_main).start()
    with pytest.raises(KeyboardInterrupt):
        long_drop().run(repeat=64)
    signal.signal(signal.SIGINT, before)
    assert time.monotonic() - begin < 10.0


ROTOR = """
format = "auxbear.scenario/1"
system = "rotor"
rotor.speed = "1000 rad/s"
analysis = { speed_to = "2000 rad/s", cutoff = "1e9 rad/s", speed_count = 200 }
rotor.section = [{ length = "1 m", outer_diameter = "50 mm", material = "steel", elements = 30 }]
rotor.support = [{ at = "0 m", stiffness = "1 MN/m" }, { at = "1 m", stiffness = "1 MN/m" }]
limit = [{ quantity = "mode_1.frequency", least = "1 rad/s" }]
"""


def test_a_check_of_limits_analyses_nothing():
    # the analysis of this rotor takes a minute; the names of its results are known without it
    begin = time.monotonic()
    assert isinstance(auxbear.Scenario.parse(ROTOR).check(), list)
    assert time.monotonic() - begin < 5.0
    with pytest.raises(auxbear.Problem, match="mode_"):
        auxbear.Scenario.parse(ROTOR.replace("mode_1.frequency", "mode_1.frequenzy")).check()


def test_progress_is_told_and_may_end_a_run():
    told = []

    def enough(share):
        told.append(share)
        if len(told) == 2:
            raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        long_drop().run(progress=enough)
    assert 0.0 < told[0] < told[1] < 1.0


def test_other_threads_of_python_go_on_during_a_run():
    count = 0
    over = threading.Event()

    def counting():
        nonlocal count
        while not over.wait(0.005):
            count += 1

    other = threading.Thread(target=counting)
    other.start()
    begin = time.monotonic()
    with pytest.raises(ZeroDivisionError):
        # some progress, then an end
        long_drop().run(progress=lambda share: 1 / 0 if time.monotonic() - begin > 0.5 else None)
    over.set()
    other.join()
    assert count > 20


def test_a_number_of_threads_that_is_none_is_refused(drop):
    with pytest.raises(ValueError):
        drop.run(threads=0)


def test_numbers_do_not_depend_on_threads(drop):
    one, two = (drop.run(repeat=6, threads=threads) for threads in (1, 2))
    assert one.summary["quantities"] == two.summary["quantities"]


def test_a_study_is_run_read_and_goes_on(short_study, tmp_path):
    directory = tmp_path / "study"
    done = short_study.run(directory)
    assert done.complete and not done.failed
    assert done.members.columns[:2] == ["member", "input.rotor.mass"]
    assert len(done.members) == short_study.members == 32
    forces = done.members["first_impact_force"]
    alone = short_study.member(5).run()["first_impact_force"]
    assert float(alone) == forces[5]
    assert done["first_impact_force"]["members"] == 32
    more = short_study.run(directory, add=32)
    assert len(more.members) == 64
    assert (more.members["first_impact_force"][:32] == forces).all()
    again = auxbear.StudyResult.load(directory)
    assert again.summary == more.summary
    with pytest.raises(IndexError):
        short_study.member(32)


def test_a_wrong_study_is_a_problem(tmp_path):
    with pytest.raises(auxbear.Problem):
        auxbear.Study(scenario=str(tmp_path / "nothing.toml"), design={"kind": "sobol"})
    with pytest.raises(auxbear.Problem):
        auxbear.StudyResult.load(tmp_path)


def test_the_import_is_quick():
    code = "import time; t = time.perf_counter(); import auxbear; print(time.perf_counter() - t)"
    times = [
        float(subprocess.run([sys.executable, "-c", code], check=True, capture_output=True).stdout)
        for _ in range(3)
    ]
    assert min(times) < 0.3


def test_a_call_costs_little_beside_the_computation():
    scenario = auxbear.Scenario(system="torque", bearing={"name": "6005"})
    result = scenario.run()

    def of_each(work, count=2000):
        begin = time.perf_counter()
        for _ in range(count):
            work()
        return (time.perf_counter() - begin) / count

    best = min(of_each(lambda: float(result["friction_moment"])) for _ in range(5))
    assert best < 50e-6


@pytest.mark.skipif(not hasattr(os, "fork"), reason="no fork here")
def test_a_forked_child_runs_too(drop):
    script = f"""
import multiprocessing, warnings, auxbear
warnings.simplefilter("ignore")
scenario = auxbear.Scenario.load({str(SCENARIOS / "reference_drop.toml")!r}).set("run.duration", "8 ms")
def force(seed):
    return scenario.run(repeat=8)["peak_contact_force"].spread.mean
here = force(0)
with multiprocessing.get_context("fork").Pool(2) as pool:
    assert pool.map(force, range(2)) == [here, here]
"""
    subprocess.run([sys.executable, "-c", script], check=True, timeout=60)


def test_what_is_no_progress_is_refused(drop):
    with pytest.raises(TypeError, match="progress"):
        drop.run(progress=3)


def test_a_qualification_gives_its_requirements(tmp_path):
    machine = (SCENARIOS / "machine_casing.toml").read_text(encoding="utf-8").replace('"50 ms"', '"2 ms"')
    (tmp_path / "machine.toml").write_text(machine, encoding="utf-8")
    study = auxbear.Study(
        scenario=str(tmp_path / "machine.toml"),
        set=["run.duration=15 ms", "run.accuracy=screening"],
        design={"kind": "qualification", "draws": 1},
        limit=[{"quantity": "node.seal.least_distance", "least": "1 mm", "source": "none can"}],
    )
    found = study.qualify(tmp_path / "out", date="2026-11-28")
    assert [one["verdict"] for one in found] == ["not met"]
    assert found[0]["source"] == "none can" and found[0]["worst_value"] < 1e-3
    assert "2026-11-28" in (tmp_path / "out" / "document.html").read_text(encoding="utf-8")
    with pytest.raises(auxbear.Problem, match="qualification"):
        auxbear.Study(scenario=str(tmp_path / "machine.toml"), design={"kind": "monte carlo", "members": 2}, input=[{"path": "rotor.speed", "normal": "1 rpm"}]).qualify(tmp_path / "no")
    assert not (tmp_path / "no").exists()
