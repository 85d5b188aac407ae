"""Sweeps on a cluster of Dask that loses a worker."""

import hashlib
import os
import pathlib
import signal
import subprocess
import sys
import time

import pytest

distributed = pytest.importorskip("distributed")
TOOL = os.environ["OUTRIDER"]
# A run takes some tenths of a second.
WORDS = ["scenarios/waypoints/open_loop.yaml", "--runs", "24", "--seed", "7", "--chunk-runs", "2"]


@pytest.fixture(name="scheduler")
def start_scheduler():
    """The address of a scheduler of its own, without a worker yet."""
    process = subprocess.Popen([sys.executable, "-m", "distributed.cli.dask_scheduler", "--host", "127.0.0.1", "--port",
                                "0", "--dashboard-address", "127.0.0.1:0"], stderr=subprocess.PIPE, text=True)
    address = ""
    for line in process.stderr:
        if "Scheduler at:" in line:
            address = line.split()[-1]
            break
    yield address
    process.kill()
    process.communicate()


@pytest.fixture(name="workers")
def start_workers(scheduler, tmp_path):
    """Two workers, each with one thread and no nanny that would start it again."""
    workers = [subprocess.Popen([sys.executable, "-m", "distributed.cli.dask_worker", scheduler, "--nthreads", "1",
                                 "--no-nanny", "--no-dashboard", "--local-directory", str(tmp_path / f"worker{i}")],
                                stderr=subprocess.DEVNULL) for i in range(2)]
    with distributed.Client(scheduler) as client:
        client.wait_for_workers(2)
    yield workers
    for worker in workers:
        worker.kill()
        worker.wait()


def test_a_cluster_that_loses_a_worker_makes_the_same_table(scheduler, workers, tmp_path):
    subprocess.run([TOOL, "sweep", *WORDS, "--out", tmp_path / "once"], check=True, capture_output=True)
    workers[0].send_signal(signal.SIGSTOP)  # what it is given waits until it is killed
    sweep = subprocess.Popen([sys.executable, "-m", "outrider.sweep", "--scheduler", scheduler, *WORDS, "--out",
                              str(tmp_path / "out")], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    chunks = tmp_path / "out" / "chunks"
    while not list(chunks.glob("*.csv")) and sweep.poll() is None:
        time.sleep(0.01)
    workers[0].send_signal(signal.SIGKILL)
    assert len(list(chunks.glob("*.csv"))) < 12, "the one that was stopped has not done its part"
    out, error = sweep.communicate()
    assert sweep.returncode == 0, error
    table = (tmp_path / "out" / "table.csv").read_bytes()
    assert hashlib.sha256(table).hexdigest() in out
    assert table == (tmp_path / "once" / "table.csv").read_bytes()
    again = subprocess.run([sys.executable, "-m", "outrider.sweep", "--scheduler", scheduler, str(tmp_path / "out")],
                           capture_output=True, text=True, check=False)
    assert again.returncode == 0, again.stderr
    refused = subprocess.run([sys.executable, "-m", "outrider.sweep", "--scheduler", scheduler, *WORDS, "--seed", "8",
                              "--out", str(tmp_path / "out")], capture_output=True, text=True, check=False)
    assert refused.returncode == 2
    assert "--seed" in refused.stderr and pathlib.Path(tmp_path / "out" / "table.csv").read_bytes() == table
