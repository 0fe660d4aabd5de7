"""A real Slurm of two nodes on this machine, for as long as a test needs it.

Two slurmd (n1 and n2) share the host; munged, slurmctld and everything that they leave live in one temporary folder
with free ports and a key of its own, so that neither an installed Slurm nor a second test is touched.
"""
import os
import pwd
import secrets
import shutil
import signal
import socket
import subprocess
import tempfile
import time

PROGRAMS = ("munged", "slurmctld", "slurmd", "sbatch", "scontrol", "scancel", "sinfo", "squeue", "srun", "setpriv")
SBIN = "/usr/sbin"
START_LIMIT_S = 60  # a daemon that does not come up, not a slow one: all of them need about 3 s
# What Slurm 22.05 says now and then of a connection that it lost on a busy machine; asking again helps. A job is submitted
# once only: it may have arrived.
CONNECTION_BROKE = "Zero Bytes were transmitted or received"
BROKEN_CONNECTIONS = 3
FINAL_STATES = {"COMPLETED", "FAILED", "CANCELLED", "TIMEOUT", "NODE_FAIL", "OUT_OF_MEMORY", "BOOT_FAIL"}

CONFIGURATION = """\
ClusterName=pbmpi
SlurmctldHost={host}(127.0.0.1)
SlurmUser={user}
SlurmdUser={user}
SlurmctldPort={ports[0]}
AuthType=auth/munge
AuthInfo=socket={folder}/munge/socket
CredType=cred/munge
MpiDefault=none
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SlurmdParameters=config_overrides
ReturnToService=2
KillWait=10
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool-%n
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd-%n.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd-%n.log
NodeName=n1 NodeHostname={host} NodeAddr=127.0.0.1 Port={ports[1]} CPUs={cpus} State=UNKNOWN
NodeName=n2 NodeHostname={host} NodeAddr=127.0.0.1 Port={ports[2]} CPUs={cpus} State=UNKNOWN
PartitionName=main Nodes=n1,n2 Default=YES MaxTime=60 State=UP
"""


class SlurmError(RuntimeError):
    """The cluster could not be started, or refused a job."""


def search_path():
    return os.pathsep.join([os.environ.get("PATH", ""), SBIN])


def free_ports(count):
    sockets = [socket.socket() for _ in range(count)]
    try:
        for each in sockets:
            each.bind(("127.0.0.1", 0))
        return [each.getsockname()[1] for each in sockets]
    finally:
        for each in sockets:
            each.close()


def wait_until(condition, what, limit_s):
    """Polls until `condition()` is true and returns what it gave."""
    end = time.monotonic() + limit_s
    while True:
        result = condition()
        if result:
            return result
        if time.monotonic() > end:
            raise SlurmError(f"waited {limit_s} s for {what}")
        time.sleep(0.1)


class Cluster:
    """with Cluster() as cluster: cluster.submit(...), cluster.wait_for(job)."""

    def __init__(self, cpus_per_node=2):
        self.cpus_per_node = cpus_per_node
        self.folder = None
        self.daemons = []

    def __enter__(self):
        missing = [name for name in PROGRAMS if shutil.which(name, path=search_path()) is None]
        if missing:
            raise SlurmError(f"missing: {' '.join(missing)}; install them with jobs/install_packages.sh --tests")
        self.folder = tempfile.mkdtemp(prefix="pbmpi-slurm-")
        os.chmod(self.folder, 0o755)  # munge's user must reach its socket inside
        try:
            self._start()
        except BaseException:
            self.__exit__(None, None, None)
            raise
        return self

    def __exit__(self, *_):
        try:
            self._cancel_all()
        except (SlurmError, subprocess.SubprocessError):
            pass  # the daemons may be what failed; what they started is killed below
        for daemon in reversed(self.daemons):
            stop(daemon)
        self._kill_remains()
        shutil.rmtree(self.folder, ignore_errors=True)

    # -- what tests call --

    @property
    def environment(self):
        """Of every command that talks to this cluster, and so of its jobs."""
        inherited = {name: value for name, value in os.environ.items() if not name.startswith(("SLURM_", "SBATCH_"))}
        temporary = os.path.join(self.folder, "tmp")  # Open MPI's session folders, removed with the rest
        # The ranks of two nodes on one host would call their shared-memory segments by the same names: TCP between them.
        return {**inherited, "PATH": search_path(), "SLURM_CONF": self._configuration(), "TMPDIR": temporary,
                "OMPI_MCA_btl": "self,tcp"}

    def command(self, *args, **options):
        for attempt in range(BROKEN_CONNECTIONS + 1):
            result = subprocess.run(args, env=self.environment, capture_output=True, text=True, timeout=60, check=False,
                                    **options)
            if result.returncode == 0:
                return result.stdout
            if CONNECTION_BROKE not in result.stderr or args[0] == "sbatch":
                break
            time.sleep(attempt)
        raise SlurmError(f"{' '.join(args)}: {result.stderr.strip()}")

    def submit(self, *args, cwd):
        """`sbatch args...` in the folder `cwd`; returns the job id."""
        return self.command("sbatch", "--parsable", *args, cwd=cwd).strip()

    def job(self, job_id):
        """The fields of a job, or of each task of an array, as `scontrol show job` prints them."""
        text = self.command("scontrol", "--oneliner", "show", "job", job_id)
        return [dict(word.split("=", 1) for word in line.split() if "=" in word) for line in text.splitlines() if line]

    def ended(self, job_id):
        """The fields of the job (of each task of an array), or None while it has not ended."""
        jobs = self.job(job_id)
        return jobs if all(job["JobState"] in FINAL_STATES for job in jobs) else None

    def wait_for(self, job_id, limit_s):
        """The fields of the ended job (of each task of an array)."""
        return wait_until(lambda: self.ended(job_id), f"the end of job {job_id}", limit_s)

    def logs(self):
        """The ends of the daemons' logs, for the message of a failed test."""
        text = ""
        for name in sorted(os.listdir(self.folder)):
            if name.endswith(".log"):
                with open(os.path.join(self.folder, name), encoding="utf-8", errors="replace") as file:
                    text += f"--- {name}\n" + "".join(file.readlines()[-15:])
        return text

    # -- how it comes up and goes down --

    def _configuration(self):
        return os.path.join(self.folder, "slurm.conf")

    def _start(self):
        for name in ("state", "spool-n1", "spool-n2", "tmp"):
            os.mkdir(os.path.join(self.folder, name))
        with open(self._configuration(), "w", encoding="utf-8") as file:
            file.write(CONFIGURATION.format(folder=self.folder, host=socket.gethostname().split(".")[0],
                                            user=pwd.getpwuid(os.geteuid()).pw_name, ports=free_ports(3),
                                            cpus=self.cpus_per_node))
        self._start_munge()
        self._daemon("slurmctld", "-D", "-f", self._configuration())
        for node in ("n1", "n2"):
            self._daemon("slurmd", "-D", "-N", node, "-f", self._configuration())
        self._wait_for_nodes()

    def _start_munge(self):
        folder = os.path.join(self.folder, "munge")
        os.mkdir(folder, 0o711)
        key = os.path.join(folder, "key")
        with open(key, "wb") as file:
            file.write(secrets.token_bytes(128))
        os.chmod(key, 0o400)
        who = {}
        if os.geteuid() == 0:  # munged refuses to run as root
            munge = pwd.getpwnam("munge")
            who = {"user": munge.pw_uid, "group": munge.pw_gid, "extra_groups": []}
            for path in (folder, key):
                os.chown(path, munge.pw_uid, munge.pw_gid)
        self._daemon("munged", "--foreground", f"--key-file={key}", f"--socket={folder}/socket",
                     f"--pid-file={folder}/pid", f"--seed-file={folder}/seed", **who)
        wait_until(lambda: os.path.exists(f"{folder}/socket"), "munged's socket\n" + self.logs(), START_LIMIT_S)

    def _daemon(self, name, *args, **options):
        """Starts a daemon in the foreground; should this process be killed, it goes too."""
        log = os.path.join(self.folder, f"{name}-{len(self.daemons)}.log")
        with open(log, "wb") as file:
            self.daemons.append(subprocess.Popen(["setpriv", "--pdeathsig", "TERM", name, *args],
                                                 env=self.environment, cwd="/", stdin=subprocess.DEVNULL, stdout=file,
                                                 stderr=file, start_new_session=True, **options))

    def _wait_for_nodes(self):
        def idle():
            for daemon in self.daemons:
                if daemon.poll() is not None:
                    raise SlurmError(f"{daemon.args[3]} ended with {daemon.returncode}\n{self.logs()}")
            result = subprocess.run(["sinfo", "--noheader", "--Node", "--format=%N %t"], env=self.environment,
                                    capture_output=True, text=True, timeout=60, check=False)
            return sorted(result.stdout.split("\n")[:-1]) == ["n1 idle", "n2 idle"]
        try:
            wait_until(idle, "two idle nodes", START_LIMIT_S)
        except SlurmError as error:
            raise SlurmError(f"{error}\n{self.logs()}") from None

    def _cancel_all(self):
        if not os.path.exists(self._configuration()) or len(self.daemons) < 2:
            return
        self.command("scancel", f"--user={pwd.getpwuid(os.geteuid()).pw_name}")
        wait_until(lambda: not self.command("squeue", "--noheader").strip(), "the queue to empty", 20)

    def _kill_remains(self):
        """slurmstepd leaves its daemon's session: whatever still carries this cluster's configuration in its
        environment was started by it."""
        mark = f"SLURM_CONF={self._configuration()}".encode()
        for entry in os.listdir("/proc"):
            if not entry.isdigit() or int(entry) == os.getpid():
                continue
            try:
                with open(f"/proc/{entry}/environ", "rb") as file:
                    if mark in file.read().split(b"\0"):
                        os.kill(int(entry), signal.SIGKILL)
            except (FileNotFoundError, ProcessLookupError, PermissionError):
                continue  # ended while we looked


def stop(daemon):
    daemon.terminate()
    try:
        daemon.wait(timeout=10)
    except subprocess.TimeoutExpired:
        daemon.kill()
        daemon.wait()
