"""python3 reports COMMAND FILE [options]: pbreport's reports on studies and runs. pbreport calls it, once it has checked the
seals of the files."""
import importlib
import pathlib
import signal
import sys
import warnings

if __package__ in (None, ""):
    sys.path[0] = str(pathlib.Path(__file__).absolute().parents[1])

try:
    from reports.files import BadInput, WriteError, end_without_leftovers
except ImportError as error:
    print(f"pbreport: this report needs Python's {error.name}, which is not there; install it (Debian: python3-{error.name})", file=sys.stderr)
    sys.exit(1)

# By command; a module has run(words), which prints.
MODULES = {"study": "accuracy", "effects": "effects", "stability": "stability", "engines": "engines", "scaling": "scaling",
           "ensemble": "ensemble", "calibrate": "calibrate", "csv": "one_run.csv_report",
           "diff": "one_run.diff", "report": "one_run.run_page", "join": "join.joined"}


def fail(message, code):
    print(f"pbreport: {message}", file=sys.stderr)
    return code


def main(words):
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, end_without_leftovers)  # without a word, as other programs do
    for number in (signal.SIGPIPE, signal.SIGCHLD):
        signal.signal(number, signal.SIG_DFL)
    for stream in (sys.stdout, sys.stderr):
        if stream is not None:
            stream.reconfigure(encoding="utf-8", errors="replace")  # names of files may be no UTF-8
    warnings.simplefilter("ignore")  # numpy's, about numbers that are not finite
    try:
        report = importlib.import_module(f"reports.{MODULES[words[0]]}")
        report.run(words[1:])
    except BadInput as error:
        return fail(error, 2)
    except WriteError as error:
        return fail(error, 1)
    except MemoryError:
        return fail("there is not enough memory for what is to be read", 1)
    except (OSError, RuntimeError) as error:  # h5py's, of a file whose inside is damaged
        return fail(f"a file cannot be read ({error}); it is damaged or incomplete", 2)
    except (LookupError, ArithmeticError, ValueError, TypeError, AttributeError) as error:  # the files are sound, but not as they must be
        return fail(f"a file lacks something or has an impossible value ({type(error).__name__}: {error}); is it of another version of "
                    "pbmpi, or damaged?", 2)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]) if sys.argv[1:2] and sys.argv[1] in MODULES else fail(f"name a report: {', '.join(MODULES)}", 2))
