"""The dualfoot command itself: help, verbs, exit codes, what happens when things go wrong."""

import subprocess
import sys

import pytest

from dualfoot_ros import __version__
from dualfoot_ros.cli import main as command
from dualfoot_ros.cli.main import VERBS, main
from dualfoot_ros.core import ConfigError


def test_help_shows_every_verb_with_what_it_does_and_examples(capsys):
    with pytest.raises(SystemExit) as end:
        main(["--help"])
    assert end.value.code == 0
    out = capsys.readouterr().out
    for verb in VERBS:
        assert f"  {verb} " in out
        assert command.load(verb).HELP in out
    assert "examples:" in out


@pytest.mark.parametrize(
    ("arguments", "wanted"),
    [
        (["walk", "--jobs", "2"], True),
        (["walk", "--jobs=12", "-o", "report"], True),
        (["--jobs", "1", "walk"], False),
        (["walk", "--jobs=1"], False),
        (["walk", "--jobs", "two"], False),
        (["walk", "--jobs"], False),
        (["walk", "--jobs", "-3"], False),
        (["walk", "--scheduler", "tcp://host:8786"], False),
        (["walk", "--scheduler"], False),
        (["walk", "--jobs", "2", "-h"], False),
        ([], True),
    ],
)
def test_workers_are_got_ready_where_arguments_ask_for_some(arguments, wanted, monkeypatch):
    monkeypatch.setattr(command.os, "sched_getaffinity", lambda _: {0, 1, 2})
    assert command._wants_workers(arguments) == wanted


def test_one_core_without_jobs_has_no_workers(monkeypatch):
    monkeypatch.setattr(command.os, "sched_getaffinity", lambda _: {5})
    assert not command._wants_workers(["walk"])


def test_without_a_verb_the_help_is_shown(capsys):
    assert main([]) == 0
    assert "verbs:" in capsys.readouterr().out


@pytest.mark.parametrize("verb", VERBS)
def test_the_help_of_a_verb_has_examples_that_name_it(verb, capsys):
    with pytest.raises(SystemExit) as end:
        main([verb, "--help"])
    assert end.value.code == 0
    out = capsys.readouterr().out
    assert "examples:" in out
    assert f"dualfoot {verb} " in out


@pytest.mark.parametrize("verb", VERBS)
def test_the_examples_of_a_verb_are_accepted_by_its_parser(verb):
    lines = [line.strip() for line in command.load(verb).EXAMPLES.splitlines()]
    shown = [line.split("  ")[0].split(" | ")[0] for line in lines]
    examples = [line.split()[2:] for line in shown if line.startswith(f"dualfoot {verb} ")]
    assert examples
    for arguments in examples:
        command.parser_of(verb).parse_args(arguments)


def test_version_is_that_of_the_package(capsys):
    with pytest.raises(SystemExit) as end:
        main(["--version"])
    assert end.value.code == 0
    assert capsys.readouterr().out.strip() == f"dualfoot {__version__}"


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (
            ["evaluate", "walk", "--outpt", "r"],
            "dualfoot evaluate: error: unrecognized arguments: --outpt r; did you mean '--output'?"
            " 'dualfoot evaluate --help' lists the options\n",
        ),
        (
            ["calibrate", "gyro"],
            "dualfoot calibrate gyro: error: the following arguments are required: SOURCE; "
            "'dualfoot calibrate gyro --help' lists the options\n",
        ),
    ],
)
def test_wrong_arguments_are_refused_in_one_sentence(arguments, sentence, capsys):
    with pytest.raises(SystemExit) as end:
        main(arguments)
    assert end.value.code == 2
    assert capsys.readouterr().err == sentence


def test_an_unknown_verb_is_refused_with_the_nearest_one(capsys):
    assert main(["evalute", "walk"]) == 2
    error = capsys.readouterr().err
    assert "unknown verb 'evalute'" in error
    assert "did you mean 'evaluate'?" in error


class Stub:
    """A verb that does whatever it is told."""

    HELP, EXAMPLES = "a verb", "examples:\n  dualfoot info x\n"

    def __init__(self, action):
        self.action = action

    def add_arguments(self, parser):
        pass

    def run(self, args):
        return self.action()


def fail(error):
    def action():
        raise error

    return action


@pytest.mark.parametrize(
    ("error", "sentence"),
    [
        (ConfigError("parameter 'x' is 3"), "dualfoot info: error: parameter 'x' is 3\n"),
        (
            PermissionError(13, "Permission denied", "walk/metadata.yaml"),
            "dualfoot info: error: 'walk/metadata.yaml': Permission denied\n",
        ),
        (OSError(28, "No space left on device"), "error: No space left on device\n"),
    ],
)
def test_what_goes_wrong_is_one_sentence_and_exit_code_2(monkeypatch, capsys, error, sentence):
    monkeypatch.setattr(command, "load", lambda name: Stub(fail(error)))
    assert main(["info"]) == 2
    captured = capsys.readouterr()
    assert captured.err.endswith(sentence)
    assert captured.out == ""


def test_a_defect_of_the_program_is_not_hidden_as_bad_input(monkeypatch):
    monkeypatch.setattr(command, "load", lambda name: Stub(fail(ZeroDivisionError())))
    with pytest.raises(ZeroDivisionError):
        main(["info"])


def test_an_interrupt_ends_with_130_and_without_a_traceback(monkeypatch, capsys):
    monkeypatch.setattr(command, "load", lambda name: Stub(fail(KeyboardInterrupt())))
    assert main(["info"]) == 130
    assert capsys.readouterr().err == "dualfoot info: interrupted\n"


def test_the_exit_code_of_the_process_is_that_of_the_verb(tmp_path, dualfoot_process):
    done = dualfoot_process("info", "no_such_bag", cwd=tmp_path)
    assert done.returncode == 2
    assert done.stdout == ""
    assert done.stderr.startswith("dualfoot info: error: there is no bag 'no_such_bag'")
    assert len(done.stderr.splitlines()) == 1


def test_a_reader_that_goes_away_is_no_error():
    script = "import sys; from dualfoot_ros.cli import main as m\n"
    script += "class V: HELP = EXAMPLES = ''; add_arguments = staticmethod(lambda p: None)\n"
    script += "V.run = staticmethod(lambda a: [print('x' * 99) for _ in range(9999)] and 0)\n"
    script += "m.load = lambda name: V\nsys.exit(m.main(['info']))"
    process = subprocess.Popen(
        [sys.executable, "-c", script], stdout=subprocess.PIPE, stderr=subprocess.PIPE
    )
    process.stdout.readline()
    process.stdout.close()
    assert process.wait(timeout=60) == 141
    assert process.stderr.read() == b""
    process.stderr.close()


def test_an_interrupt_while_the_library_is_imported_ends_with_130_too(monkeypatch, capsys):
    monkeypatch.setattr(command, "load", lambda name: fail(KeyboardInterrupt())())
    assert main(["info"]) == 130
    assert capsys.readouterr().err == "dualfoot info: interrupted\n"
    script = "import sys, dualfoot_ros.cli.main; sys.exit('numpy' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", script], check=False).returncode == 0


def test_garbage_is_collected_while_a_verb_runs_but_not_in_what_was_imported_for_it():
    script = (
        "import gc, sys; from dualfoot_ros.cli import info, main\n"
        "sys.argv = ['dualfoot', 'info', 'walk']\n"
        "info.run = lambda args: print(gc.isenabled(), gc.get_freeze_count() > 10_000) or 0\n"
        "main.main()"
    )
    told = subprocess.run([sys.executable, "-c", script], check=True, stdout=subprocess.PIPE)
    assert told.stdout == b"True True\n"
