#!/usr/bin/env python3
"""data/workflow with Debian's Snakemake gives the bytes of `batch`, on this machine and through a Slurm of one node. The test starts and ends
this Slurm, kills jobs midway and loses the node.   MESHFOLIO=build/release/meshfolio tests/workflow/slow_workflow.py

Needs: apt-get install snakemake slurmctld slurmd slurm-client munge; skipped without them."""

import contextlib
import getpass
import json
import os
import re
import shutil
import signal
import socket
import subprocess
import sys
import time
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "end_to_end"))
from program import PROGRAM, SOURCE, run, sample, temporary_folder

WORKFLOW = SOURCE / "data" / "workflow"
SMALL = ["--size", "64"]
LIMIT = 900   # limit of one workflow, in seconds
os.environ["PATH"] += ":/usr/sbin:/sbin"


def tree(folder):
    return {str(file.relative_to(folder)): file.read_bytes() for file in folder.rglob("*") if file.is_file()}


def environment_of(process):
    try:
        return dict(word.split("=", 1) for word in (process / "environ").read_text(errors="replace").split("\0") if "=" in word)
    except OSError:   # the process has ended
        return {}


def words_of(process):
    try:
        return (process / "cmdline").read_text(errors="replace").split("\0")
    except OSError:
        return [""]


def free_ports(number):
    with contextlib.ExitStack() as stack:
        sockets = [stack.enter_context(socket.socket()) for _ in range(number)]
        for one in sockets:
            one.bind(("127.0.0.1", 0))
        return [one.getsockname()[1] for one in sockets]


class Slurm:
    """Starts munge, slurmctld and one slurmd for the test, in a folder, on the loopback interface."""

    def __init__(self, folder):
        self.folder = folder
        folder.mkdir(mode=0o755)
        for name in ("state", "spool"):
            (folder / name).mkdir()
        (folder / "munge.key").write_bytes(os.urandom(128))
        (folder / "munge.key").chmod(0o400)
        host, user, ports = socket.gethostname().split(".")[0], getpass.getuser(), free_ports(2)
        memory = os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE") // 2**20
        (folder / "slurm.conf").write_text(f"""ClusterName=meshfolio
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={ports[0]}
SlurmdPort={ports[1]}
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
CredType=cred/munge
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core_Memory
SchedulerParameters=batch_sched_delay=1,sched_interval=2
SlurmdTimeout=10
ReturnToService=2
KillWait=2
NodeName=one NodeHostname={host} NodeAddr=127.0.0.1 CPUs={os.cpu_count()} RealMemory={memory * 9 // 10} State=UNKNOWN
PartitionName=all Nodes=one Default=YES MaxTime=INFINITE State=UP
""")
        self.environment = {**os.environ, "SLURM_CONF": str(folder / "slurm.conf")}
        self.daemons = {}
        self.start("munged", "--foreground", "--force", *(f"--{name}={folder}/munge.{ending}" for name, ending in (
            ("socket", "socket"), ("key-file", "key"), ("pid-file", "pid"), ("log-file", "log"), ("seed-file", "seed"))))
        self.wait_until(lambda: (folder / "munge.socket").exists(), 20)
        self.start("slurmctld", "-D", "-c")
        self.start_node()

    def start(self, program, *words):
        with open(self.folder / f"{program}.out", "a") as log:
            self.daemons[program] = subprocess.Popen([program, *words], env=self.environment, stdin=subprocess.DEVNULL, stdout=log, stderr=log)

    def start_node(self):
        self.start("slurmd", "-D", "-N", "one")
        self.wait_until(lambda: self.ask("sinfo", "-h", "-o", "%T").strip() in ("idle", "mixed", "allocated"), 60)

    def node_processes(self):
        """Returns the processes of the node and of its jobs, which a variable in their environment identifies."""
        found = []
        for process in Path("/proc").glob("[0-9]*"):
            variables = environment_of(process)
            if variables.get("SLURM_CONF") != self.environment["SLURM_CONF"]:
                continue
            if "SLURMD_NODENAME" in variables or words_of(process)[0].startswith(("slurmd", "slurmstepd")):
                found.append(process)
        return found

    def lose_node(self):
        """Kills every process of the node at once."""
        for process in self.node_processes():
            with contextlib.suppress(ProcessLookupError):
                os.kill(int(process.name), signal.SIGKILL)
        self.daemons.pop("slurmd").wait()

    def ask(self, *words):
        return subprocess.run(words, env=self.environment, capture_output=True, text=True).stdout

    def jobs(self, state):
        """Returns the ids of the workflow's parts in that state."""
        lines = self.ask("squeue", "-h", "-t", "all", "-o", "%i %j %T").splitlines()
        return [job for job, name, now in map(str.split, lines) if name == "meshfolio-part" and now == state]

    def at_work(self):
        """Returns a job that makes a part, and the id of its process."""
        for process in self.node_processes():
            job = environment_of(process).get("SLURM_JOB_ID")
            if job and any(word.startswith("--part=") for word in words_of(process)):
                return job, int(process.name)
        return None

    @staticmethod
    def wait_until(is_so, seconds):
        limit = time.monotonic() + seconds
        while not (found := is_so()):
            if time.monotonic() > limit:
                raise TimeoutError
            time.sleep(0.05)
        return found

    def end(self):
        if "slurmd" in self.daemons:
            self.lose_node()
        for daemon in reversed(self.daemons.values()):
            daemon.terminate()
            try:
                daemon.wait(20)
            except subprocess.TimeoutExpired:
                daemon.kill()
                daemon.wait()


@unittest.skipUnless(shutil.which("snakemake"), "no snakemake is here")
class Workflow(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.case = cls()
        cls.folder = temporary_folder(cls.case)
        (cls.folder / "meshes").mkdir()
        for name, ending in (("cube8", "obj"), ("sphere", "obj"), ("cube8", "ply")):
            sample(cls.folder / "meshes", name, ending)
        (cls.folder / "meshes" / "sphere.obj").rename(cls.folder / "meshes" / "ball {1}.obj")   # elsewhere, braces are wildcards
        subprocess.run(["gzip", cls.folder / "meshes" / "cube8.ply"], check=True)
        (cls.folder / "meshes" / "broken.off").write_text("OFF\n1 2 3\n")
        (cls.folder / "meshes.txt").write_text("meshes/cube8.obj\n# the others\n\nmeshes/*.gz\nmeshes/broken.off\nmeshes/ball {1}.obj\n")
        process = run("batch", "--list", "meshes.txt", "--out", "whole", "--no-timings", *SMALL, cwd=cls.folder)
        assert process.returncode == 1, process.stderr   # one mesh is unreadable
        cls.whole = tree(cls.folder / "whole")

    @classmethod
    def tearDownClass(cls):
        cls.case.doCleanups()

    def begin(self, out, *words, environment=os.environ, apart):
        """Starts a workflow on the four meshes. A section that takes longer than `apart` seconds becomes a separate part."""
        cache = temporary_folder(self)
        config = [f"program={PROGRAM}", "list=meshes.txt", f"out={out}", f"apart={apart}", "options=" + " ".join(SMALL)]
        log = open(self.folder / f"{out}.log", "w")
        self.addCleanup(log.close)
        process = subprocess.Popen(["snakemake", "--snakefile", WORKFLOW / "Snakefile", "--nolock", *words, "--config", *config], cwd=self.folder,
                                   env={**environment, "XDG_CACHE_HOME": str(cache)}, stdin=subprocess.DEVNULL, stdout=log, stderr=log)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)   # empty if the process has ended
        return process

    def require_the_whole(self, process, out):
        process.wait(LIMIT)
        log = (self.folder / f"{out}.log").read_text()
        self.assertEqual(process.returncode, 0, log)
        made = tree(self.folder / out)
        self.assertEqual(sorted(made), sorted(self.whole))
        self.assertEqual([name for name in made if made[name] != self.whole[name]], [])
        return log

    def test_on_this_machine(self):
        log = self.require_the_whole(self.begin("local", "--cores", "2", apart=1), "local")
        parts = json.loads((self.folder / "local.parts" / "plans.json").read_text())
        self.assertEqual(list(parts), ["cube8", "cube8-2", "broken", "ball__1_"])
        self.assertEqual(parts.pop("broken"), {})
        for mesh, some in parts.items():
            self.assertGreater(len(some), 1, mesh)
            self.assertEqual(len({section for part in some.values() for section in part["sections"]}),
                             sum(len(part["sections"]) for part in some.values()))
        self.assertEqual(log.count("\nrule part:"), sum(map(len, parts.values())))
        self.assertIn("4 meshes, 3 done before\n", log)   # the index made no report again
        log = self.require_the_whole(self.begin("local", "--cores", "2", apart=1), "local")
        self.assertIn("Nothing to be done", log)

    @unittest.skipUnless(all(map(shutil.which, ("munged", "slurmctld", "slurmd", "sbatch"))), "no Slurm is here")
    def test_through_slurm_with_jobs_killed_and_the_node_lost(self):
        slurm = Slurm(self.folder / "slurm")
        self.addCleanup(slurm.end)
        process = self.begin("cluster", "--profile", WORKFLOW / "slurm", environment=slurm.environment, apart=0.1)
        began = time.monotonic()
        cancelled, _ = slurm.wait_until(slurm.at_work, 120)
        slurm.ask("scancel", cancelled)
        slurm.wait_until(lambda: cancelled in slurm.jobs("CANCELLED"), 60)
        killed, report = slurm.wait_until(slurm.at_work, 120)
        os.kill(report, signal.SIGKILL)
        slurm.wait_until(lambda: killed in slurm.jobs("FAILED"), 60)
        slurm.wait_until(slurm.at_work, 120)
        lost = slurm.jobs("RUNNING")
        slurm.lose_node()
        slurm.wait_until(lambda: slurm.ask("sinfo", "-h", "-o", "%T").startswith("down"), 120)
        self.assertIsNone(process.poll())
        slurm.start_node()
        log = self.require_the_whole(process, "cluster")
        restarts = len(re.findall("^Trying to restart job", log, re.MULTILINE))
        jobs = len(re.findall("^Submitted job", log, re.MULTILINE))
        self.assertGreaterEqual(restarts, 2)
        requeued = [job for job in lost if "Restarts=0" not in slurm.ask("scontrol", "show", "job", job)]
        self.assertTrue(lost)
        self.assertEqual(requeued, lost)
        self.assertIn("4 meshes, 3 done before\n", "".join(file.read_text() for file in (self.folder / ".snakemake/slurm").glob("*.log")))
        print(f"{jobs} jobs of Slurm; {cancelled} cancelled, {killed} killed, {', '.join(lost)} lost with the node and begun again; "
              f"{restarts} made again; {time.monotonic() - began:.0f} s", file=sys.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=2)
