"""The manual pages: roff without a warning, and all that --help all says."""
import os
import re
import subprocess
import unittest

from programs import BIN, all_commands, help_of, options_of

PAGES = os.path.join(os.path.dirname(BIN), "manual", "man1")


def rendered(command):
    """The page as text, and what groff says of it."""
    result = subprocess.run(["groff", "-man", "-ww", "-Tascii", "-P-cbou", "-rLL=1000n", os.path.join(PAGES, "-".join(command) + ".1")],
                            check=True, capture_output=True, text=True, timeout=60)
    return result.stdout, result.stderr


def words(text):
    return " ".join(text.split())


class Pages(unittest.TestCase):
    def test_each_program_and_command_has_a_page_and_nothing_else_has(self):
        pages = {name for name in os.listdir(PAGES) if name.endswith(".1")}
        self.assertEqual(pages, {"-".join(command) + ".1" for command in all_commands()})
        self.assertGreater(len(all_commands()), 15)

    def test_groff_has_nothing_to_complain_about(self):
        for command in all_commands():
            self.assertEqual(rendered(command)[1], "", command)

    def test_a_page_has_its_name_in_its_head_and_what_it_is_for(self):
        for command in all_commands():
            page, name = rendered(command)[0], "-".join(command)
            self.assertIn(f"{name.upper()}(1)", page.splitlines()[0])
            self.assertRegex(page, rf"\nNAME\n +{name} - \w.*\S\n")

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
                self.assertIn(words(example), page)

    def test_exit_codes_stand_in_each_page(self):
        for command in all_commands():
            codes = re.search(r"\nEXIT STATUS\n(.*?)\n\S", rendered(command)[0], re.DOTALL)[1]
            self.assertEqual(re.findall(r"^ +(\d+)\b", codes, re.MULTILINE), ["0", "1", "2", "75"], command)


if __name__ == "__main__":
    unittest.main()
