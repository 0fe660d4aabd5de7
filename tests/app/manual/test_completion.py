"""What bash, fish and zsh complete is what the programs take."""
import os
import pty
import re
import subprocess
import tempfile
import unittest

from programs import BIN, MANUAL, PROGRAMS, all_commands, commands_of, options_of

BASH = r"""
source "$1"
program=$2
shift 2
COMP_WORDS=("$program" "$@")
COMP_CWORD=$#
_$program
printf '%s\n' "${COMPREPLY[@]}"
"""

ZSH = r"""
fpath=({folder} $fpath)
autoload -Uz compinit && compinit -D -u
compadd() {{
  # Where the completion system itself asks what would match, nothing is offered yet.
  if (( ${{@[(i)-[AOD]*]}} <= $# )); then builtin compadd "$@"; return; fi
  local -a words_offered
  builtin compadd -O words_offered "$@"
  print -rl -- $words_offered >>{out}
  builtin compadd "$@"
}}
"""


class Completion(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory(prefix="pbmpi-test-")
        self.addCleanup(self.folder.cleanup)
        for name in ("run.h5", "own.toml", "my own scene.toml"):
            open(os.path.join(self.folder.name, name), "w", encoding="utf-8").close()

    def offered(self, shell, *line):
        """The words that the shell offers for the last word of a command line, whose = it parts as bash does."""
        if shell == "bash":
            words = [part for word in line for part in re.findall(r"=|[^=]+|^$", word)]
            command = ["bash", "--norc", "-c", BASH, "bash", os.path.join(MANUAL, "bash", line[0]), *words]
        else:
            script = 'source $argv[1]; complete -C "$argv[2]"'
            command = ["fish", "--no-config", "-c", script, os.path.join(MANUAL, "fish", line[0] + ".fish"), " ".join(line)]
        result = subprocess.run(command, cwd=self.folder.name, capture_output=True, text=True, timeout=60, check=False,
                                env={**os.environ, "HOME": self.folder.name})
        self.assertEqual(result.stderr, "", line)
        return {word.split("\t")[0] for word in result.stdout.split("\n") if word}

    def offered_by_zsh(self, line):
        """What zsh offers where TAB is pressed behind the line: its completions work on a terminal only."""
        out, setup = os.path.join(self.folder.name, ".offered"), os.path.join(self.folder.name, ".setup")
        with open(setup, "w", encoding="utf-8") as file:
            file.write(ZSH.format(folder=os.path.join(MANUAL, "zsh"), out=out))
        open(out, "w", encoding="utf-8").close()
        process, terminal = pty.fork()
        if process == 0:
            os.chdir(self.folder.name)
            os.execvp("zsh", ["zsh", "-f", "-i"])
        os.write(terminal, f"source {setup}; PS1=REA'DY'\n".encode())
        seen = b""
        while b"READY" not in seen:  # from then on zsh reads key by key
            seen += os.read(terminal, 4096)
        os.write(terminal, line.encode() + b"\t\x15exit\n")
        try:
            while os.read(terminal, 4096):
                pass
        except OSError:  # Linux's end of a terminal
            pass
        os.waitpid(process, 0)
        os.close(terminal)
        with open(out, encoding="utf-8") as file:
            return set(file.read().split())

    def test_every_option_of_help_is_offered_and_no_other(self):
        for command in all_commands():
            for shell in ("bash", "fish"):
                offered = {word for word in self.offered(shell, *command, "--")}
                self.assertEqual({word for word in offered if word.startswith("--")}, options_of(*command), (shell, command))

    def test_studies_and_commands_are_offered_first(self):
        for program in ("pbstudy", "pbreport"):
            for shell in ("bash", "fish"):
                words = self.offered(shell, program, "")
                self.assertLessEqual(set(commands_of(program)), words, (shell, program))
        self.assertEqual(self.offered("bash", "pbstudy", "accuracy", ""), self.offered("bash", "pbstudy", "accuracy", "-"))

    def test_closed_lists_are_offered_as_values(self):
        for shell in ("bash", "fish"):
            self.assertEqual(self.offered(shell, "pbmpi", "--stepper", ""), {"sor", "quick", "direct", "bullet", "mujoco"})
            self.assertEqual(self.offered(shell, "pbmpi", "--law", "so"), {"soft"})
            self.assertEqual(self.offered(shell, "pbstudy", "accuracy", "--precision", ""), {"double", "single"})
            self.assertEqual(self.offered(shell, "pbreport", "ensemble", "--over", "w"), {"worlds"})
        self.assertEqual(self.offered("bash", "pbmpi", "--stepper=qu"), {"quick"})
        self.assertEqual(self.offered("bash", "pbmpi", "--stepper="), {"sor", "quick", "direct", "bullet", "mujoco"})

    def test_the_scenes_that_pbmpi_brings_and_files_are_offered(self):
        listed = subprocess.run([os.path.join(BIN, "pbmpi"), "--list-scenes"], check=True, capture_output=True, text=True,
                                timeout=60).stdout
        for shell in ("bash", "fish"):
            offered = self.offered(shell, "pbmpi", "--scene", "")
            self.assertLess({"CrashSk", "100CrSk", "Bowling", "hard/rest/column20", "own.toml"}, offered)
            for scene in offered - {"own.toml", "my own scene.toml", "run.h5"}:
                self.assertIn(scene.split("/")[-1], listed)
            self.assertEqual(self.offered(shell, "pbmpi", "--scene", "Cra"), {"CrashSk", "CrashWa"})
            self.assertEqual(self.offered(shell, "pbmpi", "--output", "ru"), {"run.h5"})
            self.assertEqual({word.replace("\\ ", " ") for word in self.offered(shell, "pbmpi", "--config", "my")}, {"my own scene.toml"})

    def test_an_option_that_takes_many_values_is_offered_more(self):
        self.assertEqual(self.offered("bash", "pbstudy", "effects", "--scene", "CrashSk", "CrashW"), {"CrashWa"})
        self.assertEqual(self.offered("bash", "pbstudy", "effects", "--effect", "drag", "slee"), {"sleeping"})
        self.assertEqual(self.offered("bash", "pbmpi", "--effects", "-dr"), {"-drag"})

    def test_where_a_number_is_wanted_nothing_is_offered_and_behind_it_options_are(self):
        self.assertEqual(self.offered("bash", "pbmpi", "--frames", ""), set())
        self.assertLess({"--scene", "--frames"}, self.offered("bash", "pbmpi", "--frames", "3", ""))

    def test_pbreport_is_offered_files_once_the_command_is_named(self):
        self.assertEqual(self.offered("bash", "pbreport", "diff", "r"), {"run.h5"})
        self.assertLess({"run.h5", "diff"}, self.offered("bash", "pbreport", ""))

    def test_zsh_offers_the_same(self):
        for program in PROGRAMS:
            path = os.path.join(MANUAL, "zsh", "_" + program)
            result = subprocess.run(["zsh", "-n", path], capture_output=True, text=True, timeout=60, check=False)
            self.assertEqual((result.returncode, result.stderr), (0, ""))
        for command in (("pbmpi",), ("pbstudy", "accuracy"), ("pbreport", "csv"), ("pbreport",)):
            self.assertEqual(self.offered_by_zsh(" ".join(command) + " --"), options_of(*command), command)
        self.assertEqual(self.offered_by_zsh("pbmpi --stepper "), {"sor", "quick", "direct", "bullet", "mujoco"})
        self.assertEqual(self.offered_by_zsh("pbmpi --scene=Cra"), {"CrashSk", "CrashWa"})
        self.assertEqual(self.offered_by_zsh("pbstudy "), set(commands_of("pbstudy")))
        self.assertEqual(self.offered_by_zsh("pbreport diff r"), {"run.h5"})


if __name__ == "__main__":
    unittest.main()
