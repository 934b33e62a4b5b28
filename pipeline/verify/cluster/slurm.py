"""A cluster of one node: munged, slurmctld and slurmd as plain processes of this user on loopback, with all that they write in one folder."""

import contextlib
import getpass
import os
import pathlib
import secrets
import shutil
import socket
import subprocess
import time

PROGRAMS = {"munged": "munge", "slurmctld": "slurm-wlm", "slurmd": "slurm-wlm", "srun": "slurm-wlm", "sbatch": "slurm-wlm", "salloc": "slurm-wlm"}
PATH = os.pathsep.join([os.environ.get("PATH", ""), "/usr/sbin", "/sbin"])

CONFIGURATION = """ClusterName=crumble
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={control}
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
CommunicationParameters=NoCtldInAddrAny,NoInAddrAny
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerParameters=batch_sched_delay=0
ReturnToService=0
KillWait=60
MaxJobCount=5000
NodeName=n1 NodeHostname={host} NodeAddr=127.0.0.1 Port={node} CPUs={cpus} State=UNKNOWN
PartitionName=all Nodes=n1 Default=YES MaxTime=INFINITE State=UP
"""


def missing():
    """Debian packages that are not there."""
    return sorted({package for program, package in PROGRAMS.items() if shutil.which(program, path=PATH) is None})


def free_ports(count):
    with contextlib.ExitStack() as stack:
        sockets = [stack.enter_context(socket.socket()) for _ in range(count)]
        for one in sockets:
            one.bind(("127.0.0.1", 0))
        return [one.getsockname()[1] for one in sockets]


def until(what, words, seconds=300):
    """Its value once there is one."""
    end = time.monotonic() + seconds
    while not (found := what()):
        if time.monotonic() > end:
            raise SystemExit(f"after {seconds} s there is still no {words}")
        time.sleep(0.02)
    return found


class Slurm(contextlib.AbstractContextManager):
    def __init__(self, folder, cpus):
        self.folder, self.daemons = pathlib.Path(folder), []
        self.started = []  # what has to end before the daemons
        for name in ("state", "spool"):
            (self.folder / name).mkdir(parents=True)
        self.folder.parent.chmod(0o711)  # munged wants to be reached by everyone
        key = self.folder / "munge.key"
        key.write_bytes(secrets.token_bytes(128))
        key.chmod(0o600)
        control, node = free_ports(2)
        configuration = self.folder / "slurm.conf"
        configuration.write_text(CONFIGURATION.format(folder=self.folder, host=socket.gethostname().partition(".")[0], user=getpass.getuser(), control=control,
                                                      node=node, cpus=cpus))
        self.environment = {name: value for name, value in os.environ.items() if not name.startswith(("SLURM", "MAKE", "MFLAGS"))}
        self.environment |= {"PATH": PATH, "SLURM_CONF": str(configuration)}

    def __enter__(self):
        place = lambda name: f"--{name.partition('.')[0]}-file={self.folder}/munge.{name}"
        try:
            self.start("munged", "--foreground", f"--socket={self.folder}/munge.socket", f"--key-file={self.folder}/munge.key", place("pid"), place("log"),
                       place("seed"))
            until(lambda: self.alive() and (self.folder / "munge.socket").exists(), "socket of munged")
            self.start("slurmctld", "-D", "-c")
            self.start("slurmd", "-D", "-N", "n1")
            until(lambda: self.alive() and "idle" in self.says("sinfo", "-h", "-o", "%T"), "idle node")
        except BaseException:
            self.__exit__()
            raise
        return self

    def __exit__(self, *_):
        self.call("scancel", "--user", getpass.getuser())
        for daemon in [*self.started, *reversed(self.daemons)]:
            daemon.terminate()
            try:
                daemon.wait(30)
            except subprocess.TimeoutExpired:
                daemon.kill()

    def start(self, *command):
        with open(self.folder / f"{command[0]}.said", "wb") as said:
            self.daemons.append(subprocess.Popen(command, env=self.environment, stdin=subprocess.DEVNULL, stdout=said, stderr=said))

    def alive(self):
        for daemon in self.daemons:
            if daemon.poll() is not None:
                raise SystemExit(f"{daemon.args[0]} ended: {(self.folder / f'{daemon.args[0]}.said').read_text().strip().splitlines()[-1:]}")
        return True

    def call(self, *command, **more):
        return subprocess.run([str(word) for word in command], env=self.environment, text=True, stdin=subprocess.DEVNULL, capture_output=True, **more)

    def says(self, *command):
        return self.call(*command).stdout

    def state(self, state):
        """Of the node: drain, down or resume."""
        done = self.call("scontrol", "update", "nodename=n1", f"state={state}", "reason=verification")
        if done.returncode:
            raise SystemExit(f"scontrol: {done.stderr}")

    def jobs(self, *state):
        return self.says("squeue", "-h", "-o", "%i", *state).split()
