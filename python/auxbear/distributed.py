"""The members of a study on the machines of a Dask cluster, with the numbers and the directory of a run at home.

>>> from dask.distributed import Client
>>> result = auxbear.distributed.run(auxbear.Study.load("study.toml"), "runs/study", Client("tcp://scheduler:8786"))

Only this process writes the directory. It keeps so many tasks under way as the cluster has threads, and some in reserve, and lets
go of each result once it is stored: the scheduler never holds more. A worker that is killed loses its tasks, which run elsewhere;
one that joins gets its share; a client that is ended goes on with the same call. The version of the package must be the same everywhere.
"""

from __future__ import annotations

import tempfile
import time
from os import PathLike
from pathlib import Path
from typing import Any, NamedTuple

from auxbear import _auxbear, _progress
from auxbear._progress import Progress
from auxbear.study import Study, StudyResult

#: Least time that a task should take, s: below it a cluster is busy with itself.
_TASK = 1.0
#: Tasks under way for each thread of the cluster.
_AHEAD = 2
#: Times that a task whose worker was lost, or that failed, is tried again.
_RETRIES = 5


class _Computed(NamedTuple):
    version: str
    parts: list[tuple[int, bytes]]
    seconds: float


def run(
    study: Study,
    directory: str | PathLike[str],
    client: Any,
    *,
    add: int = 0,
    progress: bool | Progress | None = None,
) -> StudyResult:
    """Begins the study in a directory, or goes on where it stopped, on the workers of a client of ``dask.distributed``.

    Ctrl-C ends it with ``KeyboardInterrupt``; what was stored stands in the directory, and the same call goes on. Raises
    ``RuntimeError`` where a worker has another version of the package, or a task fails on every worker that tries it.
    """
    parts = _auxbear.Parts.open(study._native, directory, add)
    texts = parts.texts()
    missing = parts.missing()
    tell, end = _progress.shown("study", progress)
    under_way: dict[Any, int] = {}
    at_once, done, all_parts = 1, 0, len(missing)
    waiting = missing[::-1]
    try:
        while waiting or under_way:
            threads = max(1, sum(client.ncores().values()))
            while waiting and len(under_way) < _AHEAD * threads:
                # no more than a fair share of the rest, so that all threads end together
                share = max(1, min(at_once, len(waiting) // (_AHEAD * threads)))
                task = [waiting.pop() for _ in range(share)]
                future = client.submit(_compute, texts, task, pure=False, retries=_RETRIES)
                under_way[future] = len(task)
            for future in _ended(under_way):
                computed = future.result()
                count = under_way.pop(future)
                future.release()
                if computed.version != _auxbear.version():
                    text = f"a worker has auxbear {computed.version}, this process {_auxbear.version()}: one version is needed everywhere"
                    raise RuntimeError(text)
                for part, content in computed.parts:
                    parts.put(part, content)
                done += count
                if computed.seconds > 0.0:
                    at_once = max(1, round(_TASK * count / computed.seconds))
                if tell is not None:
                    tell(done / all_parts)
    finally:
        for future in under_way:
            future.cancel()
        end()
    parts.finish()
    del parts
    return StudyResult.load(directory)


def _ended(under_way: dict[Any, int]) -> list[Any]:
    """Tasks that ended; waits for one."""
    while True:
        ended = [future for future in under_way if future.done()]
        if ended:
            return ended
        time.sleep(0.02)


def _compute(texts: tuple[str, str], parts: list[int]) -> _Computed:
    """On a worker: these parts, with one thread, because the cluster gives each of its threads a task."""
    begin = time.perf_counter()
    with tempfile.TemporaryDirectory(prefix="auxbear-") as folder:
        study, scenario = (Path(folder) / name for name in ("study.toml", "scenario.toml"))
        study.write_text(texts[0], encoding="utf-8")
        scenario.write_text(texts[1], encoding="utf-8")
        native = _auxbear.Study.read(study)
    computed = [(part, native.part(part, 1)) for part in parts]
    return _Computed(_auxbear.version(), computed, time.perf_counter() - begin)
