"""A study on the workers of a cluster gives what it gives at home."""

import os
import signal
from concurrent.futures import Future

import auxbear
import auxbear.distributed
import pytest

distributed = pytest.importorskip("distributed")


@pytest.fixture
def study(tmp_path):
    """Drops of 12 ms in five parts."""
    from conftest import SCENARIOS

    drop = auxbear.Scenario.load(SCENARIOS / "reference_drop.toml").set("run.duration", "12 ms").set("run.accuracy", "screening")
    file = tmp_path / "drop.toml"
    file.write_text(drop.toml(), encoding="utf-8")
    design = {"kind": "sobol", "members": 320}
    return auxbear.Study(scenario=str(file), seed=3, design=design, input=[{"path": "rotor.mass", "uniform": ["7 kg", "9 kg"]}])


def table(directory):
    return (directory / "members.csv").read_bytes()


def test_workers_that_are_killed_or_join_late_change_nothing(study, tmp_path):
    study.run(tmp_path / "home")
    killed = []

    def kill_one(share):
        if not killed:
            killed.append(next(iter(client.run(os.getpid).values())))
            os.kill(killed[0], signal.SIGKILL)
            cluster.scale(3)

    cluster = distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None)
    with cluster, distributed.Client(cluster) as client:
        result = auxbear.distributed.run(study, tmp_path / "away", client, progress=kill_one)
    assert killed
    assert result.complete
    assert table(tmp_path / "away") == table(tmp_path / "home")


class Here:
    """Stands for a client: tasks are done as they are submitted, with a limit on how many; counts those under way."""

    def __init__(self, most=10**9, version=None):
        self.left, self.under_way, self.largest = most, 0, 0
        self.version = version or auxbear.__version__

    def ncores(self):
        return {"one": 2, "other": 2}

    def submit(self, function, *given, pure, retries):
        if self.left == 0:
            raise ConnectionError("the scheduler is gone")
        self.left -= 1
        future = Future()
        future.set_result(function(*given)._replace(version=self.version))
        future.release = self._release
        self.under_way += 1
        self.largest = max(self.largest, self.under_way)
        return future

    def _release(self):
        self.under_way -= 1


def test_a_client_that_was_lost_comes_back(study, tmp_path):
    study.run(tmp_path / "home")
    with pytest.raises(ConnectionError):
        auxbear.distributed.run(study, tmp_path / "away", Here(most=2))
    assert not (tmp_path / "away" / "members.csv").exists()
    auxbear.distributed.run(study, tmp_path / "away", Here())
    assert table(tmp_path / "away") == table(tmp_path / "home")


def test_tasks_under_way_do_not_grow_with_the_study(tmp_path):
    file = tmp_path / "torque.toml"
    file.write_text(auxbear.template("torque"), encoding="utf-8")
    design = {"kind": "monte carlo", "members": 1_600}
    inputs = [{"path": "bearing.moment.viscosity", "uniform": ["20 mm^2/s", "50 mm^2/s"]}]
    study = auxbear.Study(scenario=str(file), seed=1, design=design, input=inputs)
    client = Here()
    result = auxbear.distributed.run(study, tmp_path / "away", client)
    assert result.complete and client.under_way == 0
    assert client.largest <= 8


def test_a_worker_of_another_version_is_refused(study, tmp_path):
    with pytest.raises(RuntimeError, match="one version"):
        auxbear.distributed.run(study, tmp_path / "away", Here(version="0.0.0"))
