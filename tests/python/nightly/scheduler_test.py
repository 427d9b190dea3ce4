"""A scheduler that is killed and started again: takes long and rarely fails, for the nightly run."""

import contextlib
import os
import socket
import sqlite3
import subprocess
import sys

import pytest

from sweep_test import SPEC, assert_is_complete, command, folder, read, results, stand_in  # noqa: F401


def start(*words):
    return subprocess.Popen([sys.executable, "-m", *words], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def cluster(port):
    scheduler = start("distributed.cli.dask_scheduler", "--host", "127.0.0.1", "--port", str(port), "--no-dashboard",
                      "--no-show")
    worker = start("distributed.cli.dask_worker", f"tcp://127.0.0.1:{port}", "--nthreads", "1", "--no-dashboard",
                   "--no-nanny", "--death-timeout", "120")
    return scheduler, worker


def test_a_scheduler_that_is_started_again_is_found_again(folder, stand_in):  # noqa: F811
    spec = read(folder, SPEC.replace("points = 9", "points = 3000"))
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    processes = []
    try:
        processes += cluster(port)
        client = subprocess.Popen([*command(folder, "run"), "--scheduler", f"tcp://127.0.0.1:{port}"])
        processes.append(client)
        before = []
        while len(before) < 5:
            assert client.poll() is None, "it ended before the scheduler could be killed"
            with contextlib.suppress(sqlite3.Error):
                before = results(folder)
        for process in processes[:2]:
            process.kill()
            process.wait()
        before = results(folder)
        assert len(before) < spec.size
        processes += cluster(port)
        assert client.wait(timeout=300) == 0
    finally:
        for process in processes:
            process.kill()
            process.wait()
    assert_is_complete(folder, spec)
    assert set(before) <= set(results(folder))
