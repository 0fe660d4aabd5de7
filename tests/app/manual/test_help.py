"""--help fits on a screen, and --help all says everything."""
import unittest

from programs import PROGRAMS, all_commands, help_of, options_in, options_of, run


class Help(unittest.TestCase):
    def test_help_fits_on_a_screen_and_shows_options_that_are_there(self):
        for command in all_commands():
            text = run(*command, "--help").stdout
            self.assertLessEqual(len(text.splitlines()), 40, command)
            self.assertLessEqual(max(map(len, text.splitlines())), 110, command)
            self.assertLessEqual(len(options_in(text)), 15, command)
            self.assertLessEqual(options_in(text), options_of(*command), command)

    def test_help_says_how_to_see_the_options_that_it_leaves_out(self):
        for command in all_commands():
            text = run(*command, "--help").stdout
            if text != help_of(*command):
                self.assertIn(f"({' '.join(command)} --help all shows all {len(options_of(*command))})", text)
        self.assertNotEqual(run("pbmpi", "--help").stdout, help_of("pbmpi"))

    def test_the_word_all_follows_each_spelling(self):
        for command in (*((program,) for program in PROGRAMS), ("pbstudy", "accuracy"), ("pbreport", "csv")):
            self.assertEqual(run(*command, "-h").stdout, run(*command, "--help").stdout)
            for words in (("-h", "all"), ("--help=all",)):
                self.assertEqual(run(*command, *words).stdout, help_of(*command), (command, words))

    def test_another_word_is_refused(self):
        for command in all_commands():
            for words in (("--help", "stepper"), ("-h", "stepper"), ("--help=stepper",), ("--help=",)):
                result = run(*command, *words)
                self.assertEqual((result.returncode, result.stdout), (2, ""), (command, words))
                self.assertIn("--help all", result.stderr)


if __name__ == "__main__":
    unittest.main()
