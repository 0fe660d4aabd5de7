"""What bash, fish and zsh complete is what --help all lists."""
import os
import pathlib
import pty
import subprocess
import tempfile
import unittest

from programs import ENVIRONMENT, all_commands, commands_of, options_of, run

FOLDER = pathlib.Path(__file__).resolve().parents[3] / "src/app/manual/completion"

# As on a terminal, where = parts words.
BASH = r"""
. /usr/share/bash-completion/bash_completion
. "$1"
shift
COMP_LINE="$*" COMP_POINT=${#COMP_LINE}
mapfile -t COMP_WORDS < <(printf '%s\n' "$@" | sed 's/=/\n=\n/; s/\n$//')
COMP_CWORD=$((${#COMP_WORDS[@]} - 1))
_pbmpi "${COMP_WORDS[0]}"
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
        """The words that the shell offers for the last word of a command line."""
        if shell == "bash":
            command = ["bash", "--norc", "-c", BASH, "bash", FOLDER / "pbmpi.bash", *line]
        else:
            script = 'source $argv[1]; complete -C "$argv[2]"'
            command = ["fish", "--no-config", "-c", script, FOLDER / "pbmpi.fish", " ".join(line)]
        result = subprocess.run(command, cwd=self.folder.name, capture_output=True, text=True, timeout=60, check=False,
                                env={**ENVIRONMENT, "HOME": self.folder.name})
        self.assertEqual(result.stderr, "", line)
        return {word.split("\t")[0] for word in result.stdout.split("\n") if word}

    def offered_by_zsh(self, line):
        """What zsh offers where TAB is pressed behind the line: its completions work on a terminal only."""
        out, setup = os.path.join(self.folder.name, ".offered"), os.path.join(self.folder.name, ".setup")
        with open(setup, "w", encoding="utf-8") as file:
            file.write(ZSH.format(folder=FOLDER, out=out))
        open(out, "w", encoding="utf-8").close()
        process, terminal = pty.fork()
        if process == 0:
            os.chdir(self.folder.name)
            os.execvpe("zsh", ["zsh", "-f", "-i"], ENVIRONMENT)
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

    def test_every_option_of_help_all_is_offered_and_no_other(self):
        for command in all_commands():
            for shell in ("bash", "fish"):
                self.assertEqual(self.offered(shell, *command, "--"), options_of(*command), (shell, command))

    def test_studies_and_commands_are_offered_first_and_files_too(self):
        for program in ("pbstudy", "pbreport"):
            for shell in ("bash", "fish"):
                self.assertLess({"run.h5", *commands_of(program)}, self.offered(shell, program, ""), (shell, program))
        for shell in ("bash", "fish"):
            self.assertEqual(self.offered(shell, "pbreport", "diff", "r"), {"run.h5"})
            self.assertEqual(self.offered(shell, "pbstudy", "acc"), {"accuracy"})

    def test_bash_offers_the_words_of_which_an_option_takes_one(self):
        steppers = {"sor", "quick", "direct", "bullet", "mujoco"}
        self.assertEqual(self.offered("bash", "pbmpi", "--stepper", ""), steppers)
        self.assertEqual(self.offered("bash", "pbmpi", "--stepper="), steppers)
        self.assertEqual(self.offered("bash", "pbmpi", "--stepper=qu"), {"quick"})
        self.assertEqual(self.offered("bash", "pbmpi", "--law", "o"), {"ode"})
        self.assertEqual(self.offered("bash", "pbreport", "ensemble", "--over", "w"), {"worlds"})

    def test_bash_offers_scenes_and_files(self):
        listed = run("pbmpi", "--list-scenes").stdout
        offered = self.offered("bash", "pbmpi", "--scene", "")
        self.assertLess({"CrashSk", "100CrSk", "Bowling", "hard/rest/column20", "own.toml"}, offered)
        for scene in offered - {"own.toml", "my own scene.toml", "run.h5"}:
            self.assertIn(scene, listed)
        self.assertEqual(self.offered("bash", "pbmpi", "--scene", "Cra"), {"CrashSk", "CrashWa"})
        self.assertEqual(self.offered("bash", "pbstudy", "accuracy", "--scene", "Cra"), {"CrashSk", "CrashWa"})
        self.assertEqual(self.offered("bash", "pbmpi", "--output", "ru"), {"run.h5"})
        self.assertEqual(self.offered("bash", "pbmpi", "-o", "ru"), {"run.h5"})
        self.assertEqual(self.offered("bash", "pbmpi", "--config", "my"), {"my own scene.toml"})

    def test_where_bash_is_to_offer_a_number_it_offers_nothing(self):
        self.assertEqual(self.offered("bash", "pbmpi", "--frames", ""), set())

    def test_zsh_offers_the_same_options(self):
        for command in (("pbmpi",), ("pbstudy", "accuracy"), ("pbreport", "csv"), ("pbreport",)):
            self.assertEqual(self.offered_by_zsh(" ".join(command) + " --"), options_of(*command), command)
        self.assertEqual(self.offered_by_zsh("pbreport diff r"), {"run.h5"})


if __name__ == "__main__":
    unittest.main()
