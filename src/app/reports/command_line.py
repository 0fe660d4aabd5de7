"""What each report begins and ends with: its command line, with the options that all share, and what is printed and written."""
import argparse
import dataclasses
import difflib
import math
import os
import re
import sys
import textwrap

from reports import document, page
from reports.files import BadInput, WriteError, require, write_file

UNITS = {"time": {"us": 1e-6, "ms": 1e-3, "s": 1.0, "min": 60.0, "h": 3600.0}, "length": {"mm": 1e-3, "cm": 1e-2, "m": 1.0}}
WRITTEN = ("html", "csv", "output", "write_config")  # options that name a file to write


@dataclasses.dataclass
class Command:
    """`usage`: what follows the command's name; `add_options(group)` adds the command's own options; `examples`: command lines."""
    name: str
    about: str
    usage: str
    page: str = ""  # what --html writes
    markdown: str = ""  # what --markdown prints
    csv: str = ""  # what --csv writes
    add_options: object = None
    prints_report: bool = True  # --json and --quiet make sense for it
    examples: tuple = ()


class Layout(argparse.HelpFormatter):
    """Names of options are not broken at their hyphens, and an option's placeholder is said once."""

    def _split_lines(self, text, width):
        return textwrap.wrap(" ".join(text.split()), width, break_on_hyphens=False)

    def _format_action_invocation(self, action):
        placeholder = "" if action.nargs in (0, "?") else f" {self._format_args(action, action.metavar)}"
        return ", ".join(action.option_strings) + placeholder


class Listed(argparse.Action):
    """A list, which may be given in parts; the first part replaces the usual one."""

    def __call__(self, parser, namespace, values, option_string=None):
        given = getattr(namespace, self.dest)
        setattr(namespace, self.dest, [*([] if given is self.default else given), *values])


class Parser(argparse.ArgumentParser):
    def error(self, message):
        raise BadInput(f"{message}; see --help")


def parser_of(command):
    parser = Parser(prog=f"pbreport {command.name}", usage=f"pbreport {command.name} {command.usage}", description=command.about,
                    allow_abbrev=False, add_help=False, formatter_class=Layout)
    parser.add_argument("files", nargs="*", metavar="FILE", help=argparse.SUPPRESS)
    group = parser.add_argument_group("Options")
    if command.add_options:
        command.add_options(group)
    if command.page:
        group.add_argument("--html", metavar="OUT", help=f"one self-contained page: {command.page}")
    if command.csv:
        group.add_argument("--csv", metavar="OUT", help=command.csv)
    if command.prints_report:
        group.add_argument("--json", action="store_true", help="print all as one JSON document")
    if command.markdown:
        group.add_argument("--markdown", action="store_true", help=command.markdown)
    group.add_argument("-h", "--help", nargs="?", const="all", metavar="all", help="print this help")
    printed = "--json or --markdown asks" if command.markdown else "--json asks"
    if command.prints_report:
        group.add_argument("-q", "--quiet", action="store_true", help=f"print nothing but errors and what {printed} for")
    return parser


def require_known(words, parser):
    """argparse names an unknown option late, and without the one that was meant."""
    known = [name for action in parser._actions for name in action.option_strings]  # pylint: disable=protected-access
    for word in words:
        name = word.split("=")[0]
        if re.match(r"--?[a-zA-Z]", word) and name not in known:
            near = difflib.get_close_matches(name, known, 1)
            raise BadInput(f"unknown option '{name}'; " + (f"did you mean {near[0]}?" if near else "see --help"))


def require_once(words, parser):
    """argparse takes the last of several values without a word."""
    for action in parser._actions:  # pylint: disable=protected-access
        given = [word.split("=")[0] for word in words if word.split("=")[0] in action.option_strings]
        require(len(given) < 2 or action.nargs == "+", f"option '{given[0] if given else ''}' cannot be given more than once")


def help_text(command, parser):
    """In the layout of the other programs' help."""
    options = parser.format_help()
    about = f"pbreport {command.name} {command.about[0].lower()}{command.about[1:]}"
    examples = "".join(f"  $ {example}\n" for example in command.examples)
    return (f"{textwrap.fill(about, 80, break_on_hyphens=False)}\n\nUsage: pbreport {command.name} {command.usage}\n\n"
            f"{options[options.index('Options:'):]}" + (f"\nExamples:\n{examples}" if examples else ""))


def parse(command, words):
    """The options of a command line, or None where it asks for help, which is printed. Raises BadInput with one clear message."""
    parser = parser_of(command)
    require_known(words, parser)
    require_once(words, parser)
    options = parser.parse_args(words)
    if options.help is not None:
        require(options.help == "all", f"--help {options.help}: write --help for the basic options, or --help all for all")
        put(help_text(command, parser))
        return None
    require(not (command.markdown and options.json and options.markdown), "--json and --markdown: print one of the two")
    require_separate(options)
    return options


def require_separate(options):
    """A file that is written is neither read nor written a second time."""
    given = [("the file", name) for name in options.files]
    given += [(f"--{name.replace('_', '-')}", getattr(options, name)) for name in ("hard_cases", *WRITTEN)
              if getattr(options, name, None) is not None]
    for place, (option, path) in enumerate(given):
        require(path != "", f"{option}: the file name is empty; name a file")
        for other, before in given[:place]:
            replaced = os.path.isfile(path) or not os.path.exists(path)  # several may go to a device or a pipe
            if option[2:].replace("-", "_") in WRITTEN and replaced and os.path.realpath(path) == os.path.realpath(before):
                raise BadInput(f"{option} {path}: it is {other} as well; name another file")


def one_file(options, what, example):
    require(options.files, f"no file given; name the file of {what}, e.g. pbreport {example}")
    require(len(options.files) == 1, f"'{options.files[-1]}' follows '{options.files[0]}': give one study")
    return options.files[0]


def quantity(text, kind, option):
    """A time [s] or a length [m] with its unit."""
    units = UNITS[kind]
    found = re.fullmatch(r"([0-9.]+(?:[eE][-+]?[0-9]+)?)(" + "|".join(units) + ")", text)
    try:
        value = float(found[1]) * units[found[2]] if found else 0.0
    except ValueError:
        value = 0.0
    example = "3.33ms" if kind == "time" else "1cm"
    require(0 < value < math.inf, f"{option} {text}: it must be a number above 0 and a unit ({', '.join(units)}), e.g. {example}")
    return value


def add_scene_option(group):
    group.add_argument("--scene", nargs="+", action=Listed, default=[], metavar="NAME", help="these scenes of the study only")


def add_table_option(group, names, usual):
    group.add_argument("--table", metavar="NAME", default=usual, help=f"which table --csv writes: {', '.join(names)} (usual: {usual})")


def require_table(options, names):
    """Raises BadInput unless --table names one of these."""
    require(options.table in names, f"--table {options.table}: there is no such table; {suggestion(options.table, names)}")


def suggestion(word, names):
    """What may have been meant by a name that is not among these."""
    near = difflib.get_close_matches(word, names, 1)
    if near:
        return f"did you mean '{near[0]}'?"
    return f"known: {', '.join(map(repr, names))}" if names else "there are none"


def put(text):
    """Prints all of it, or raises WriteError."""
    if sys.stdout is None:
        raise WriteError("the report cannot be written: standard output is closed")
    try:
        sys.stdout.write(text)
        sys.stdout.flush()
    except OSError as error:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())  # or the interpreter complains as it ends
        raise WriteError(f"the report cannot be written to standard output ({error.strerror}); is the disk full?") from None


def deliver(report, options, csv_columns=None):
    """As the options ask: the page, the CSV, and on standard output JSON, Markdown or text."""
    if csv_columns is not None and options.csv:
        write_file(options.csv, document.csv(csv_columns))
    if getattr(options, "html", None):
        page.write(options.html, report)
    if options.json:
        put(document.json(report))
    elif getattr(options, "markdown", False):
        put(document.markdown(report))
    elif not options.quiet:
        put(document.text(report))
