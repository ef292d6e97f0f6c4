"""Entry of the ``dualfoot`` command: find the verb, run it, turn errors into sentences.

Nothing of the library is imported before an interrupt can be turned into one, too.
"""

from __future__ import annotations

import argparse
import gc
import importlib
import os
import sys
from collections.abc import Iterable, Sequence
from typing import NoReturn, Protocol, cast

from .. import __version__
from .process.freed_memory import keep_freed_memory
from .process.interrupt import EXIT_INTERRUPTED, Interruptible

VERBS = {
    "probe": "probe",
    "import": "import_",
    "simulate": "simulate",
    "info": "info",
    "sync": "sync",
    "calibrate": "calibrate",
    "evaluate": "evaluate",
    "compare": "compare",
    "consistency": "consistency",
    "live": "live",
}
WITH_WORKERS = ("compare", "consistency")
EXIT_BAD_INPUT = 2
EXIT_BROKEN_PIPE = 141

EXAMPLES = """\
examples:
  dualfoot simulate -o walk                 a simulated walk with exact truth, as a bag
  dualfoot info walk                        what is in the bag, in words
  dualfoot evaluate walk -o report          both tracks, their errors, plots
  dualfoot compare walk                     every method on it, one table
  dualfoot import walk.mat -o walk          a sensor's export, as a bag
  dualfoot live --open                      a page that shows what the nodes publish now
  dualfoot VERB --help                      the options of one verb, with examples
"""


class VerbParser(argparse.ArgumentParser):
    """Parser that refuses arguments in one sentence, without the twenty lines of the usage."""

    def error(self, message: str) -> NoReturn:
        """End the process with the sentence and what helps."""
        _, _, rest = message.partition("unrecognized arguments: ")
        hint = _near(rest.split("=")[0].split(" ")[0], self._option_string_actions)
        self.exit(
            EXIT_BAD_INPUT,
            f"{self.prog}: error: {message}{hint or ';'} '{self.prog} --help' lists the options\n",
        )


class Verb(Protocol):
    """What each module ``cli/<verb>.py`` provides."""

    HELP: str
    EXAMPLES: str

    def add_arguments(self, parser: argparse.ArgumentParser) -> None:
        """Declare the arguments of the verb."""

    def run(self, args: argparse.Namespace) -> int:
        """Do it and return the exit code."""


def main(argv: Sequence[str] | None = None) -> int:
    """Run ``dualfoot`` with ``argv`` (default: those of the process); return the exit code.

    0 is success, 2 an input or an argument that cannot be used, 130 an interrupt.
    """
    arguments = list(sys.argv[1:] if argv is None else argv)
    if not arguments or arguments[0].startswith("-"):
        return _without_verb(arguments)
    name, *rest = arguments
    if name not in VERBS:
        return _unknown(name)
    sentence = f"dualfoot {name}: interrupted"
    try:
        if argv is not None:
            return _run(name, rest)
        with Interruptible(sentence):  # the process is ours to end
            return _run_alone(name, rest)
    except KeyboardInterrupt:
        print(sentence, file=sys.stderr)
        return EXIT_INTERRUPTED


def load(name: str) -> Verb:
    """Import the module of the verb ``name``."""
    return cast(Verb, importlib.import_module(f"{__package__}.{VERBS[name]}"))


def parser_of(name: str) -> argparse.ArgumentParser:
    """Return the argument parser of the verb ``name``."""
    verb = load(name)
    parser = VerbParser(
        prog=f"dualfoot {name}",
        description=verb.HELP,
        epilog=verb.EXAMPLES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    verb.add_arguments(parser)
    return parser


def _run_alone(name: str, arguments: list[str]) -> int:
    """Run a verb in a process that ends after it.

    Modules stay to the end, so the garbage collector does not search them; nor does it search
    anything when the process ends.  Both took a twentieth of the time of a short command.
    """
    if name in WITH_WORKERS and _wants_workers(arguments):
        from ..fork_server import fork_server

        fork_server()  # imports what workers need while we import the verb
    gc.disable()
    keep_freed_memory()
    load(name)
    gc.freeze()
    gc.enable()
    try:
        return _run(name, arguments)
    finally:
        gc.freeze()


def _wants_workers(arguments: list[str]) -> bool:
    """Tell it from arguments that have not been checked; one without its value is None."""
    parser = argparse.ArgumentParser(add_help=False)
    parser.add_argument("--jobs", nargs="?", default=str(len(os.sched_getaffinity(0))))
    parser.add_argument("--scheduler", nargs="?", const="")
    parser.add_argument("--help", "-h", action="store_true")
    known, _ = parser.parse_known_args(arguments)
    many = str(known.jobs).isdecimal() and int(known.jobs) > 1
    return many and known.scheduler is None and not known.help


def _run(name: str, arguments: list[str]) -> int:
    try:
        args = parser_of(name).parse_args(arguments)
        code = load(name).run(args)
        sys.stdout.flush()
    except BrokenPipeError:
        # The reader of our output is gone; keep the interpreter from flushing into it again.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return EXIT_BROKEN_PIPE
    except Exception as error:
        sentence = _sentence(error)
        if sentence is None:
            raise
        return _refuse(name, sentence)
    return code


def _sentence(error: Exception) -> str | None:
    """Return what to tell the user of an error; None when it is a fault of the program."""
    from ..core import DualFootError, os_error_text

    if isinstance(error, DualFootError):
        return str(error)
    if isinstance(error, OSError) and error.strerror is not None:
        return os_error_text(error)
    return None


def _refuse(name: str, sentence: str) -> int:
    print(f"dualfoot {name}: error: {sentence}", file=sys.stderr)
    return EXIT_BAD_INPUT


def _without_verb(arguments: list[str]) -> int:
    parser = argparse.ArgumentParser(
        prog="dualfoot",
        usage="dualfoot [--help] [--version] VERB ...",
        description=_overview(),
        epilog=EXAMPLES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--version", action="version", version=f"dualfoot {__version__}")
    parser.parse_args(arguments)
    parser.print_help()
    return 0


def _overview() -> str:
    width = max(map(len, VERBS))
    lines = [f"  {name:<{width}}  {load(name).HELP}" for name in VERBS]
    return "\n".join(["Two IMUs, one on each foot, to two trajectories.", "", "verbs:", *lines])


def _unknown(name: str) -> int:
    verbs, near = ", ".join(VERBS), _near(name, VERBS)
    print(f"dualfoot: error: unknown verb '{name}'; allowed: {verbs}{near}", file=sys.stderr)
    return EXIT_BAD_INPUT


def _near(word: str, known: Iterable[str]) -> str:
    """Return a question about the known word that ``word`` may mean; none if there is no such."""
    import difflib

    near = difflib.get_close_matches(word, known, n=1)
    return f"; did you mean '{near[0]}'?" if near else ""
