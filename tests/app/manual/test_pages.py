"""The manual pages: roff without a warning, and all that --help says."""
import os
import re
import subprocess
import unittest

from programs import MANUAL, all_commands, help_of, options_of


def path_of(command):
    return os.path.join(MANUAL, "man1", "-".join(command) + ".1")


def rendered(command):
    """The page as text, and what groff says of it."""
    result = subprocess.run(["groff", "-man", "-ww", "-Tascii", "-P-cbou", "-rLL=1000n", path_of(command)], check=True,
                            capture_output=True, text=True, timeout=60)
    return result.stdout, result.stderr


def words(text):
    return " ".join(text.split())


class Pages(unittest.TestCase):
    def test_each_program_and_command_has_a_page_and_nothing_else_has(self):
        pages = set(os.listdir(os.path.join(MANUAL, "man1")))
        self.assertEqual({name for name in pages if name.endswith(".1")}, {"-".join(command) + ".1" for command in all_commands()})
        self.assertGreater(len(all_commands()), 15)

    def test_groff_has_nothing_to_complain_about(self):
        for command in all_commands():
            self.assertEqual(rendered(command)[1], "", command)

    def test_the_page_has_the_options_of_help_and_no_others(self):
        for command in all_commands():
            page = rendered(command)[0].split("\nOPTIONS\n")[1].split("\nEXIT STATUS\n")[0]
            self.assertEqual(set(re.findall(r"^ +(?:-\w, )?(--[\w-]+)", page, re.MULTILINE)), options_of(*command), command)

    def test_the_page_says_what_help_says(self):
        for command in all_commands():
            page, text = words(rendered(command)[0]), help_of(*command)
            usage = re.search(r"^Usage: (.*)$", text, re.MULTILINE)[1]
            about = words(text.split("\nUsage:")[0])
            self.assertIn(about, page)
            self.assertIn(usage, page)
            for example in text.split("\nExamples:\n")[1].splitlines() if "\nExamples:\n" in text else []:
                self.assertIn(example.strip(), page)

    def test_exit_codes_of_the_program_stand_in_the_pages_of_its_commands_too(self):
        for command in all_commands():
            codes = re.search(r"\nEXIT STATUS\n(.*?)\n\S", rendered(command)[0], re.DOTALL)[1]
            stops = command[0] in ("pbmpi", "pbstudy")  # early on request
            self.assertEqual(re.findall(r"^ +(\d+)\b", codes, re.MULTILINE), ["0", "1", "2", *(["75"] if stops else [])], command)


if __name__ == "__main__":
    unittest.main()
