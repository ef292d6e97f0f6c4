"""Arguments that verbs share: one declaration each, the same words everywhere."""

import argparse
from collections import defaultdict

import pytest

from dualfoot_ros.cli.arguments import check_counts, load_bag, settings, tracker_config
from dualfoot_ros.cli.main import VERBS, parser_of
from dualfoot_ros.cli.table_options import INTAKE_DEFAULTS
from dualfoot_ros.core import ConfigError, EvaluationError, RecordingError

SHARED = ("--config", "--json", "--storage", "--jobs", "--align", "--allow-nan", "--left-topic")


def parsers():
    """Yield name and parser of every verb, and of the kinds of calibration."""
    for verb in VERBS:
        parser = parser_of(verb)
        yield verb, parser
        for action in parser._actions:
            if isinstance(action, argparse._SubParsersAction):
                yield from ((f"{verb} {name}", part) for name, part in action.choices.items())


def options():
    """Return what each option is declared as, by its name and the verb."""
    declared = defaultdict(dict)
    for verb, parser in parsers():
        for action in parser._actions:
            for name in action.option_strings:
                declared[name][verb] = action
    return declared


@pytest.mark.parametrize("name", [*SHARED, "--set"])
def test_a_shared_option_takes_the_same_in_every_verb(name):
    actions = options()[name]
    if name == "--left-topic":
        del actions["import"]  # a bag of another program has no usual topics
    assert len(actions) > 1
    taken = {(a.metavar, str(a.default), a.choices, a.type, a.nargs) for a in actions.values()}
    assert len(taken) == 1


def test_every_option_that_writes_a_bag_reads_alike():
    outputs = {verb: options()["--output"][verb] for verb in ("import", "simulate", "sync")}
    assert {(a.metavar, a.help) for a in outputs.values()} == {("BAG", "rosbag2 folder to write")}


def test_every_option_has_words_of_help():
    missing = [
        f"{verb} {action.option_strings}"
        for verb, parser in parsers()
        for action in parser._actions
        if action.option_strings and not action.help
    ]
    assert missing == []


VALUES = {
    "--axes": "+y-x+z",
    "--force-unit": "g",
    "--rate-unit": "deg/s",
    "--columns": "time=t",
    "--time-unit": "ms",
    "--delimiter": "tab",
    "--decimal": "comma",
    "--layout": "mine.yaml",
}


@pytest.mark.parametrize("verb", ["info", "sync", "evaluate", "calibrate spacing"])
def test_an_option_of_files_of_sensors_is_refused_with_a_bag(verb, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "mine.yaml").write_text("format: dualfoot_layout\nversion: 1\ntime_unit: ms\n")
    parser = dict(parsers())[verb]
    group = next(g for g in parser._action_groups if g.title == "files of sensors in place of BAG")
    flags = [a.option_strings[0] for a in group._group_actions]
    options = [flag for flag in flags if flag not in ("--left", "--right")]
    assert {o[2:].replace("-", "_") for o in options} == set(INTAKE_DEFAULTS)
    for flag in options:
        args = parser.parse_args(["walk", f"{flag}={VALUES.get(flag, '7')}"])
        with pytest.raises(RecordingError, match=f"^{flag} does not apply: 'walk' is a bag"):
            load_bag("walk", args)


def test_settings_are_read_as_yaml_and_the_method_wins():
    given = [
        "zupt.std=1e-3",
        "aids.barometer=true",
        "method=idc",
        "rigid_pair.lever_arm=[0, 0.1, 0]",
    ]
    read = settings(argparse.Namespace(set=given))
    assert read == {
        "zupt.std": 1e-3,
        "aids.barometer": True,
        "method": "idc",
        "rigid_pair.lever_arm": [0, 0.1, 0],
    }
    config = tracker_config(argparse.Namespace(set=given, config=None, method="zupt"))
    assert (config.method, config.zupt.std, config.aids.barometer) == ("zupt", 1e-3, True)
    assert tracker_config(argparse.Namespace(set=given, config=None)).method == "idc"


@pytest.mark.parametrize("text", ["zupt.std", "=1", "zupt.std="])
def test_a_setting_of_another_form_is_refused(text):
    with pytest.raises(ConfigError, match="allowed is KEY=VALUE"):
        settings(argparse.Namespace(set=[text]))


def test_counts_out_of_range_are_refused_by_name():
    check_counts(argparse.Namespace(jobs=None, repeat=20), repeat=20)
    for counts in ({"jobs": 0, "repeat": 1}, {"jobs": 257, "repeat": 1}):
        with pytest.raises(EvaluationError, match=r"--jobs is .*; allowed is 1 to 256"):
            check_counts(argparse.Namespace(**counts), repeat=20)
    with pytest.raises(EvaluationError, match="--repeat is 21; allowed is 1 to 20"):
        check_counts(argparse.Namespace(jobs=1, repeat=21), repeat=20)
