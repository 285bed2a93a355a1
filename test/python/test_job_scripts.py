"""Job scripts for Slurm without Slurm: what they do when the job is told to stop."""

import os
import shutil
import signal
import subprocess
import time

import pytest

from conftest import ROOT, done
from sweeps import GRID, same, write_deck

ENVIRONMENT = os.environ | {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OMP_NUM_THREADS": "1"}


@pytest.fixture(name="job")
def fixture_job(camroller, tmp_path):
    """What a job finds, with a stand-in for the command that queues it again."""
    command = tmp_path / "bin/scontrol"
    command.parent.mkdir()
    command.write_text(f"#!/bin/sh\necho \"$@\" >> {tmp_path}/queued\n")
    command.chmod(0o755)
    return ENVIRONMENT | {"PATH": f"{command.parent}:{os.environ['PATH']}", "SLURM_JOB_ID": "17", "SLURM_SUBMIT_DIR": str(ROOT),
                          "CAMROLLER": camroller, "CAMROLLER_MPI": camroller}


@pytest.mark.parametrize("script, launcher", [("node.sh", ""), ("nodes.sh", "env"), ("nodes.sh", "mpirun --oversubscribe -n 1")])
@pytest.mark.once
def test_a_job_that_is_told_to_stop_is_queued_again(camroller, job, tmp_path, script, launcher):
    if launcher.startswith("mpirun") and not shutil.which("mpirun"):
        pytest.skip("no mpirun here")
    deck = write_deck(tmp_path / "deck.nml", GRID.replace("count_1 = 6", "count_1 = 150"))
    process = subprocess.Popen(["bash", ROOT / "slurm" / script, deck, tmp_path / "deck.h5", "--quiet"], cwd=tmp_path,
                               env=job | {"LAUNCHER": launcher}, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    while not list(tmp_path.glob("deck.h5.part-*")):
        assert process.poll() is None
        time.sleep(0.001)
    process.send_signal(signal.SIGTERM)
    out, words = process.communicate(timeout=60)
    assert process.returncode == 0, words
    assert "the sweep was stopped with " in words
    assert out.endswith("queueing the job again\n")
    assert (tmp_path / "queued").read_text() == "requeue 17\n"
    done(camroller, "sweep", deck, "--resume", "--quiet", folder=tmp_path)
    done(camroller, "sweep", deck, "--quiet", "-o", "undisturbed.h5", folder=tmp_path)
    assert same(tmp_path / "undisturbed.h5", tmp_path / "deck.h5")
