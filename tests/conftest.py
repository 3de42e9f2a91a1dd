"""The session's store of runs, shared by pytest-xdist's workers."""

import os

import freefem
import pytest


@pytest.fixture(scope="session", autouse=True)
def run_store(tmp_path_factory):
    base = tmp_path_factory.getbasetemp()
    if "PYTEST_XDIST_WORKER" in os.environ:  # a worker's folder lies in the session's
        base = base.parent
    freefem.STORE = base / "runs"
