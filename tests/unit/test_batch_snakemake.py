# runner: python
# SPDX-License-Identifier: GPL-2.0-or-later
"""Parameter tables with Snakemake, on the cores of this machine and on a real Slurm whose daemons the test starts and
stops.
"""
import csv
import os
import secrets
import shutil
import signal
import socket
import subprocess
import time
from pathlib import Path

import pytest

WORKFLOW = Path(__file__).resolve().parents[2] / "workflow"
TABLE = """house description set dt duration
A good * 2e-4 0.004
B wrong joint_types.corner_fitting.kn=1e12 2e-4 0.004
"""
"""The second run fails when its scene is built: its joints are too stiff for the time step."""
DAEMONS = ("munged", "slurmctld", "slurmd")

os.environ["PATH"] += ":/usr/sbin:/sbin"
missing = [program for program in DAEMONS if shutil.which(program) is None]
pytestmark = pytest.mark.skipif(
    shutil.which("snakemake") is None, reason="snakemake is not installed (scripts/setup --with-cluster)")


def command(profile):
    return ["snakemake", "--snakefile", str(WORKFLOW / "Snakefile"), "--profile", str(WORKFLOW / profile), "--config",
            "table=runs.txt"]


def snakemake(folder, profile, **environment):
    done = subprocess.run(command(profile), cwd=folder, capture_output=True, text=True, timeout=170,
                          env={**os.environ, **environment})
    assert done.returncode == 0, done.stderr[-3000:]
    return done.stderr


def states(folder):
    with open(folder / "results" / "runs" / "runs.csv", newline="") as file:
        return {row["description"]: row["status"] for row in csv.DictReader(file)}


def test_local_cores(tmp_path):
    """It continues after a kill; a failed run is a result; a new row runs alone, and moved rows do not run again."""
    (tmp_path / "runs.txt").write_text(TABLE)
    kill_after_first(tmp_path)
    early = ends(tmp_path)
    snakemake(tmp_path, "local")
    assert states(tmp_path) == {"good": "done", "wrong": "failed"}
    before = ends(tmp_path)
    assert early and early.items() <= before.items()
    head, *rows = TABLE.splitlines()
    (tmp_path / "runs.txt").write_text("\n".join([head, "A new * 2e-4 0.002", *rows]) + "\n")
    output = snakemake(tmp_path, "local")
    assert output.count("\nrule run:") == 1 and states(tmp_path) == {"new": "done", "good": "done", "wrong": "failed"}
    assert before.items() <= ends(tmp_path).items()


def ends(folder):
    """{run.json: time of its last change}."""
    return {path: path.stat().st_mtime_ns for path in folder.rglob("run.json")}


def kill_after_first(folder):
    victim = subprocess.Popen(command("local"), cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                              start_new_session=True)
    end = time.monotonic() + 120
    while not ends(folder) and victim.poll() is None and time.monotonic() < end:
        time.sleep(0.05)
    os.killpg(victim.pid, signal.SIGKILL)
    victim.wait()


# --- Slurm ------------------------------------------------------------------------------------------------------------


def free_ports(count):
    sockets = [socket.socket() for _ in range(count)]
    for one in sockets:
        one.bind(("127.0.0.1", 0))
    ports = [one.getsockname()[1] for one in sockets]
    for one in sockets:
        one.close()
    return ports


def slurm_conf(folder, user, host):
    controller, node = free_ports(2)
    return f"""ClusterName=test
SlurmctldHost={host}(127.0.0.1)
SlurmUser={user}
SlurmdUser={user}
SlurmctldPort={controller}
SlurmdPort={node}
AuthType=auth/munge
AuthInfo=socket={folder}/munge/socket
CredType=cred/munge
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core_Memory
NodeName={host} NodeAddr=127.0.0.1 CPUs=2 RealMemory=2000
PartitionName=test Nodes={host} Default=YES State=UP
"""


@pytest.fixture
def slurm(tmp_path_factory):
    """Path of the slurm.conf of a cluster whose one node is this machine. Its three daemons run in the foreground and
    end with the test.
    """
    if missing:
        pytest.skip(f"{', '.join(missing)} not installed (scripts/setup --with-cluster)")
    folder = tmp_path_factory.mktemp("slurm")
    for name in ("munge", "state", "spool"):
        (folder / name).mkdir(mode=0o700)
    key = folder / "munge" / "key"
    key.write_bytes(secrets.token_bytes(1024))
    key.chmod(0o400)
    conf = folder / "slurm.conf"
    user = subprocess.run(["id", "-un"], capture_output=True, text=True).stdout.strip()
    conf.write_text(slurm_conf(folder, user, socket.gethostname().split(".")[0]))
    munge = [f"--{option}={folder}/munge/{option}" for option in ("socket", "pid-file", "log-file", "seed-file")]
    starts = [["munged", "--foreground", "--force", f"--key-file={key}", *munge],
              ["slurmctld", "-D", "-c", "-f", str(conf)], ["slurmd", "-D", "-f", str(conf)]]
    daemons = []
    try:
        for start in starts:
            log = open(folder / f"{start[0]}.log", "w")
            daemons.append(subprocess.Popen(["setpriv", "--pdeathsig", "TERM", *start], stdin=subprocess.DEVNULL,
                                            stdout=log, stderr=log))
        wait_for_node(conf, folder)
        yield conf
    finally:
        for daemon in reversed(daemons):
            daemon.terminate()
        for daemon in daemons:
            daemon.wait(timeout=30)


def wait_for_node(conf, folder):
    end = time.monotonic() + 60
    while "idle" not in sinfo(conf):
        assert time.monotonic() < end, "\n".join(path.read_text()[-800:] for path in folder.glob("*.log"))
        time.sleep(0.2)


def sinfo(conf):
    return subprocess.run(["sinfo", "--noheader"], capture_output=True, text=True,
                          env={**os.environ, "SLURM_CONF": str(conf)}).stdout


def test_tables_are_checked_before_the_first_run(tmp_path):
    (tmp_path / "runs.txt").write_text("house dt\nA 2e-4\nA 1\n")
    done = subprocess.run(command("local"), cwd=tmp_path, capture_output=True, text=True, timeout=170)
    assert done.returncode != 0 and "runs.txt:3, column dt: " in done.stderr + done.stdout and not ends(tmp_path)


def test_slurm(tmp_path, slurm):
    (tmp_path / "runs.txt").write_text(TABLE)
    output = snakemake(tmp_path, "slurm", SLURM_CONF=str(slurm))
    assert output.count("Submitted job") == 2 and states(tmp_path) == {"good": "done", "wrong": "failed"}


def test_job_states(slurm):
    """Output of status.sh for a job that succeeds, one that fails, a running one, and an unknown one."""
    environment = {**os.environ, "SLURM_CONF": str(slurm)}

    def run(*command):
        return subprocess.run(command, capture_output=True, text=True, env=environment).stdout.strip()

    states = {}
    for task in ("true", "false", "sleep 60"):
        job = run("sbatch", "--parsable", "--mem=10", "--output=/dev/null", f"--wrap={task}")
        states[task] = wait_while(lambda: run(str(WORKFLOW / "slurm" / "status.sh"), job), "running",
                                  30 if task != "sleep 60" else 0)
    run("scancel", job)
    assert states == {"true": "success", "false": "failed", "sleep 60": "running"}
    assert wait_while(lambda: run(str(WORKFLOW / "slurm" / "status.sh"), job), "running", 30) == "failed"
    assert run(str(WORKFLOW / "slurm" / "status.sh"), "999999") == "failed"


def wait_while(probe, state, seconds):
    """The value of probe() once it differs from `state`, or after that many seconds."""
    end = time.monotonic() + seconds
    while (value := probe()) == state and time.monotonic() < end:
        time.sleep(0.2)
    return value
