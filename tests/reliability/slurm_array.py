#!/usr/bin/env python3
# SPDX-FileCopyrightText: The Far-LoD authors
# SPDX-License-Identifier: Apache-2.0
"""Runs the job scripts of docs/clusters under a Slurm of one node on the loopback device, which lives as long as this does.

Packs and evaluates in arrays of eight tasks, kills one of them and requeues it, and compares what is merged with single runs.
Ends with 77 where Slurm is not installed: scripts/install-dependencies slurm.
"""

import argparse
import getpass
import os
import shutil
import socket
import subprocess
import sys
import tempfile
import time
from pathlib import Path

TOOLS = ["munged", "slurmctld", "slurmd", "sbatch", "scontrol", "scancel", "squeue", "sinfo"]
SHARDS = 8


class Failure(Exception):
    """What was promised was not kept."""


def tool(name: str) -> str | None:
    return shutil.which(name, path=os.environ.get("PATH", "") + ":/usr/sbin:/sbin")


def call(command: list[str], environment=None, code: int = 0) -> subprocess.CompletedProcess:
    result = subprocess.run(command, capture_output=True, text=True, env=environment)
    if result.returncode != code:
        raise Failure(f"{' '.join(command)} ended with {result.returncode}, not {code}: {result.stdout}{result.stderr}")
    return result


def free_port() -> int:
    with socket.socket() as s:
        s.bind(("127.0.0.1", 0))
        return s.getsockname()[1]


def wait_until(condition, what: str, seconds: float = 600.0) -> None:
    end = time.monotonic() + seconds
    while not condition():
        if time.monotonic() > end:
            raise Failure(f"waited {seconds:.0f} s in vain: {what}")
        time.sleep(0.05)


class Slurm:
    """munged, slurmctld and slurmd with all of their files in one folder."""

    def __init__(self, folder: Path) -> None:
        self.folder, self.daemons = folder, []
        for name in ("state", "spool", "munge"):
            (folder / name).mkdir(mode=0o700)
        self.environment = {**os.environ, "SLURM_CONF": str(folder / "slurm.conf")}
        self.write_configuration()

    def write_configuration(self) -> None:
        # MinJobAge: on a slow machine the first tasks are forgotten before the last one has ended
        f, user = self.folder, getpass.getuser()
        cpus = os.cpu_count() or 1
        (f / "slurm.conf").write_text(f"""ClusterName=loopback
SlurmctldHost=localhost(127.0.0.1)
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
AuthInfo=socket={f}/munge/socket
CommunicationParameters=NoCtldInAddrAny,NoInAddrAny
SlurmctldPort={free_port()}
SlurmdPort={free_port()}
StateSaveLocation={f}/state
SlurmdSpoolDir={f}/spool
SlurmctldPidFile={f}/slurmctld.pid
SlurmdPidFile={f}/slurmd.pid
SlurmctldLogFile={f}/slurmctld.log
SlurmdLogFile={f}/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
MpiDefault=none
SwitchType=switch/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
ReturnToService=2
MinJobAge=86400
NodeName=localhost NodeAddr=127.0.0.1 CPUs={cpus} RealMemory=1000
PartitionName=main Nodes=localhost Default=YES State=UP
""")

    def __enter__(self) -> "Slurm":
        f = self.folder
        key = f / "munge/key"
        key.write_bytes(os.urandom(1024))
        key.chmod(0o400)
        munge = [f"--key-file={key}", f"--socket={f}/munge/socket", f"--pid-file={f}/munge/pid", f"--log-file={f}/munge/log",
                 f"--seed-file={f}/munge/seed"]
        self.start([tool("munged"), "--foreground", "--force", *munge])
        wait_until(lambda: (f / "munge/socket").exists(), "munged has no socket")
        self.start([tool("slurmctld"), "-D", "-f", f"{f}/slurm.conf", "-c"])
        self.start([tool("slurmd"), "-D", "-f", f"{f}/slurm.conf", "-N", "localhost", "-c"])
        idle = [tool("sinfo"), "--noheader", "--format=%T"]
        try:
            wait_until(lambda: "idle" in subprocess.run(idle, capture_output=True, text=True, env=self.environment).stdout,
                       "the node is not idle")
        except Failure:
            self.__exit__()
            raise Failure("Slurm does not start: " + "".join(p.read_text()[-2000:] for p in f.glob("*.log")))
        return self

    def start(self, command: list[str]) -> None:
        output = open(self.folder / "daemons.log", "ab")
        self.daemons.append(subprocess.Popen(command, env=self.environment, stdout=output, stderr=output))

    def __exit__(self, *_) -> None:
        for daemon in reversed(self.daemons):
            daemon.terminate()
        for daemon in self.daemons:
            daemon.wait(timeout=600)

    def submit(self, script: Path, arguments: list[str]) -> str:
        command = [tool("sbatch"), "--parsable", f"--array=0-{SHARDS - 1}", f"--chdir={self.folder}", str(script), *arguments]
        return call(command, self.environment).stdout.strip()

    def states(self, job: str) -> dict[int, str]:
        """The state of each task that Slurm remembers."""
        shown = call([tool("scontrol"), "show", "job", "--oneliner", job], self.environment).stdout
        fields = [dict(word.split("=", 1) for word in line.split() if "=" in word) for line in shown.splitlines()]
        return {int(t["ArrayTaskId"]): t["JobState"] for t in fields if t.get("ArrayTaskId", "").isdigit()}

    def kill_one(self, job: str) -> int:
        """Kills a task that runs. One that comes to its end first is not counted."""
        killed: list[int] = []

        def kill_another() -> bool:
            for task, state in self.states(job).items():
                if state == "RUNNING":
                    subprocess.run([tool("scancel"), "--signal=KILL", "--full", f"{job}_{task}"], env=self.environment)
                    wait_until(lambda: self.states(job)[task] not in ("RUNNING", "COMPLETING"), f"task {task} does not end")
                    if self.states(job)[task] != "COMPLETED":
                        killed.append(task)
                        return True
            return False

        wait_until(kill_another, "no task could be killed")
        return killed[0]

    def wait_for(self, job: str) -> dict[int, str]:
        ended = ("COMPLETED", "FAILED", "CANCELLED", "TIMEOUT", "NODE_FAIL")
        wait_until(lambda: len(self.states(job)) == SHARDS and all(s in ended for s in self.states(job).values()),
                   f"job {job} does not end", 900)
        return self.states(job)


def differences(a: Path, b: Path) -> list[str]:
    """What two folders, or two files, do not have in common."""
    compared = subprocess.run(["diff", "--recursive", "--brief", a, b], capture_output=True, text=True)
    return (compared.stdout + compared.stderr).splitlines()


def kill_in_array(slurm: Slurm, script: Path, arguments: list[str], merge: list[str], output: Path) -> tuple[str, int]:
    """The job, and the task of it that was killed before it had done its work."""
    for _ in range(5):
        subprocess.run(["rm", "-rf", str(output), f"{output}.unfinished"], check=True)
        job = slurm.submit(script, arguments)
        task = slurm.kill_one(job)
        states = slurm.wait_for(job)
        if [t for t, s in states.items() if s != "COMPLETED"] != [task]:
            raise Failure(f"only task {task} was killed: {states}")
        # One that is killed when all is kept, and before it has ended, leaves nothing missing
        if subprocess.run(merge, capture_output=True).returncode != 0:
            return job, task
    raise Failure("each task had done its work before it was killed")


def run_array(slurm: Slurm, script: Path, arguments: list[str], merge: list[str], expected: Path, output: Path) -> None:
    """An array, one of whose tasks is killed and requeued; then what it has made is merged, and compared."""
    job, task = kill_in_array(slurm, script, arguments, merge, output)
    missing = call(merge, code=3).stderr
    if f"{task}/{SHARDS}" not in missing:
        raise Failure(f"the missing shard {task} is not named: {missing}")
    call([tool("scontrol"), "requeue", f"{job}_{task}"], slurm.environment)
    wait_until(lambda: slurm.states(job)[task] in ("PENDING", "RUNNING", "COMPLETING"), "the task is not requeued", 20)
    states = slurm.wait_for(job)
    if set(states.values()) != {"COMPLETED"}:
        raise Failure(f"not all tasks have come to their end: {states}")
    call(merge)
    wrong = differences(expected, output)
    if wrong:
        raise Failure(f"{output.name}: {len(wrong)} files differ from those of a single run: {', '.join(wrong[:5])}")
    print(f"{script.name}: {SHARDS} tasks, task {task} killed and requeued, {output.name} has the bytes of a single run", flush=True)


def refuse_second_claim(binaries: Path, folder: Path, pack: list[str]) -> None:
    """Two processes with one index: the second one is refused."""
    output = folder / "claimed.farlod"
    command = [str(binaries / "farlod-pack"), *pack, "-o", str(output), "--shard", "0/2"]
    first = subprocess.Popen(command, stdout=subprocess.DEVNULL)
    try:
        wait_until(lambda: (Path(f"{output}.unfinished") / "shards/0.lock").exists(), "the first process has no lock", 60)
        message = call(command, code=6).stderr
        if "shard 0/2" not in message:
            raise Failure(f"the shard is not named: {message}")
    finally:
        first.kill()
        first.wait()
    print("a second process with the index of the first one is refused", flush=True)


def test_under(slurm: Slurm, binaries: Path, scripts: Path) -> None:
    folder = slurm.folder
    city, single, shards = folder / "city.obj", folder / "single.farlod", folder / "shards.farlod"
    call([str(binaries / "farlod-city"), "-o", str(city), "--size", "2500", "--crs", "EPSG:32632"])
    pack = [str(city), "--crs", "EPSG:32632", "--cell", "25"]
    call([str(binaries / "farlod-pack"), *pack, "-o", str(single)])
    merge = [str(binaries / "farlod-pack"), "--merge", "-o", str(shards)]
    run_array(slurm, scripts / "pack_array.sbatch", [str(city), str(shards), *pack[1:]], merge, single, shards)
    svf, one, many = str(binaries / "farlod-svf"), folder / "one.tif", folder / "many.tif"
    grid = ["--grid", "0.7"]
    call([svf, str(single), "-o", str(one), *grid])
    merge = [svf, str(single), "-o", str(many), *grid, "--merge"]
    run_array(slurm, scripts / "svf_array.sbatch", [str(single), str(many), *grid], merge, one, many)
    refuse_second_claim(binaries, folder, pack)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    root = Path(__file__).resolve().parents[2]
    parser.add_argument("--bin", type=Path, default=root / "build/bin", help="folder of the programs")
    arguments = parser.parse_args()
    missing = [name for name in TOOLS if tool(name) is None]
    if missing:
        print(f"skipped: {', '.join(missing)} not found; scripts/install-dependencies slurm installs it")
        return 77
    binaries = arguments.bin.resolve()
    os.environ["PATH"] = f"{binaries}:{os.environ['PATH']}"
    # Sockets have short names
    with tempfile.TemporaryDirectory(prefix="slurm-", dir="/tmp") as folder:
        try:
            with Slurm(Path(folder)) as slurm:
                test_under(slurm, binaries, root / "docs/clusters")
        except Failure as failure:
            print(f"slurm: {failure}", file=sys.stderr)
            for log in Path(folder).glob("farlod-*.log"):
                print(f"{log.name}: {log.read_text()[-500:]}", file=sys.stderr)
            return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
