"""Stubs of PBS and LSF: programs by their names that note what is submitted, and a queue that runs it on this machine.

They do what the manuals of OpenPBS 22 and LSF 10 say of the calls that the job scripts make, and no more: the scripts have
not run on the real ones.
"""
import json
import os
import re
import shutil
import signal
import stat
import subprocess
import sys
import time

STUB = """#!{python}
import json, os, sys
folder = {folder!r}
name = os.path.basename(sys.argv[0])
if name == "qstat":
    for line in open(os.path.join(folder, "walltime-" + sys.argv[-1])):
        print("    Resource_List.walltime = " + line.strip())
    sys.exit(0)
count = len(os.listdir(os.path.join(folder, "queue")))
job = {{"program": name, "args": sys.argv[1:], "cwd": os.getcwd(), "env": dict(os.environ),
       "script": sys.stdin.read() if name == "bsub" else ""}}
with open(os.path.join(folder, "queue", str(100 + count)), "w") as file:
    json.dump(job, file)
print(100 + count)
"""


def option(args, name, default=None):
    return args[args.index(name) + 1] if name in args else default


class Queue:
    """The programs lie in `bin`, to be put on PATH; what they are asked for runs by run_all()."""

    def __init__(self, folder):
        self.folder = folder
        self.bin = os.path.join(folder, "bin")
        self.done = 0
        for name in ("bin", "queue", "spool"):
            os.mkdir(os.path.join(folder, name))
        for program in ("qsub", "qstat", "bsub", "brequeue"):
            path = os.path.join(self.bin, program)
            with open(path, "w", encoding="utf-8") as file:
                file.write(STUB.format(python=sys.executable, folder=folder))
            os.chmod(path, os.stat(path).st_mode | stat.S_IXUSR)
        self.hosts = os.path.join(folder, "hosts")
        with open(self.hosts, "w", encoding="utf-8") as file:
            file.write("localhost\nlocalhost\n")
        self.jobs = {}

    def run_all(self, warn_when=None):
        """Runs what waits, and what that puts into the queue: [(exit code, output)]. `warn_when`: for LSF, when the job is
        told that its time is up."""
        results = []
        while self.done < len(os.listdir(os.path.join(self.folder, "queue"))):
            number = 100 + self.done
            self.done += 1
            with open(os.path.join(self.folder, "queue", str(number)), encoding="utf-8") as file:
                job = json.load(file)
            task = None
            if job["program"] == "brequeue":
                name, task = re.fullmatch(r"(\d+)(?:\[(\d+)\])?", job["args"][-1]).groups()
                number, job = self.jobs[name]
                warn_when = None
            self.jobs[str(number)] = (number, job)
            for index in [int(task)] if task else self.tasks(job):
                results.append(self.run(number, job, index, warn_when))
        return results

    @staticmethod
    def tasks(job):
        bounds = re.fullmatch(r".*?\[?(\d+)-(\d+)\]?", option(job["args"], "-J", ""))
        return range(int(bounds[1]), int(bounds[2]) + 1) if bounds else [None]

    def run(self, number, job, index, warn_when):
        script = os.path.join(self.folder, "spool", f"{number}-{index}")
        environment = {key: value for key, value in job["env"].items() if not key.startswith(("PBS_", "LSB_", "OMPI_COMM"))}
        cwd = self.folder
        if job["program"] == "qsub":
            shutil.copy(os.path.join(job["cwd"], job["args"][-1]), script)
            job_id = f"{number}.stub" if index is None else f"{number}[{index}].stub"
            environment |= {"PBS_JOBID": job_id, "PBS_JOBNAME": "stub", "PBS_O_WORKDIR": job["cwd"], "PBS_NODEFILE": self.hosts}
            if index is not None:
                environment["PBS_ARRAY_INDEX"] = str(index)
            limits = [value[len("walltime="):] for value in job["args"] if value.startswith("walltime=")]
            with open(os.path.join(self.folder, "walltime-" + job_id), "w", encoding="utf-8") as file:
                file.writelines(limits)
        else:
            with open(script, "w", encoding="utf-8") as file:
                file.write(job["script"])
            cwd = job["cwd"]
            environment |= {"LSB_JOBID": str(number), "LSB_JOBINDEX": str(index or 0), "LSB_JOBNAME": "stub",
                            "LS_SUBCWD": job["cwd"], "LSB_DJOB_NUMPROC": "2", "LSB_DJOB_HOSTFILE": self.hosts}
        with subprocess.Popen(["bash", script], cwd=cwd, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              text=True, start_new_session=True) as process:
            if warn_when is not None:
                end = time.monotonic() + 120
                while not warn_when() and process.poll() is None and time.monotonic() < end:
                    time.sleep(0.05)
                os.killpg(process.pid, signal.SIGUSR2)
            output = process.communicate(timeout=240)[0]
        return process.returncode, output
