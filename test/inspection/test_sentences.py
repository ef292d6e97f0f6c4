"""Sentences are for people: when all are reworded, nothing but the words changes."""

import json
from contextlib import redirect_stderr, redirect_stdout
from dataclasses import replace
from io import StringIO

import numpy as np
import pytest
from recording.samples import GRAVITY, moving

from dualfoot_ros.cli.main import main
from dualfoot_ros.core import ImuSeries, PressureSeries
from dualfoot_ros.inspection import Finding, FindingKind, Severity
from dualfoot_ros.recording import Recording, write_bag
from dualfoot_ros.simulation import WalkConfig, simulate
from inspection.kinds import kinds_made_in


def scaled(series, force=1.0, rate=1.0):
    return ImuSeries(series.stamp_ns, series.specific_force * force, series.angular_rate * rate)


def with_nan(series):
    series.angular_rate[700, 1] = np.nan
    return series


def held(series, first, last):
    series.angular_rate[first] = [1.0, 2.0, 3.0]
    series.specific_force[first:last] = series.specific_force[first]
    series.angular_rate[first:last] = series.angular_rate[first]
    return series


def again(series):
    stamps = np.concatenate([series.stamp_ns[:600], series.stamp_ns[:600]])
    return replace(series, stamp_ns=stamps)


def clipping(series):
    series.specific_force[:, 0] = 4.0 * np.clip(series.specific_force[:, 0], -16.0, 8.0)
    return series


def set_back(series):
    stamps = series.stamp_ns.copy()
    stamps[700:] -= 3_600_000_000_000
    return replace(series, stamp_ns=stamps)


def with_field(series, tesla):
    return replace(series, magnetic_field=np.full((len(series), 3), tesla))


def jittering(series):
    """Return stamps as of arrivals, with delays of some milliseconds."""
    late = np.random.default_rng(5).exponential(8e6, len(series)).astype(np.int64)
    return replace(series, stamp_ns=series.stamp_ns + late)


def in_bursts(series):
    return replace(series, stamp_ns=series.stamp_ns[np.arange(len(series)) // 4 * 4])


def overlaid(series):
    """Return samples in the order of a clock that was set back, and that made the stamps."""
    stamps = series.stamp_ns - np.where(np.arange(len(series)) < 800, 0, 743_000_000)
    order = np.argsort(stamps)
    return replace(series[order], stamp_ns=stamps[order])


def air(series, pascal):
    return {"both": PressureSeries(series.stamp_ns[::-1], np.full(len(series), pascal))}


def with_rate_of(series, other):
    """Return ``series`` with the rate of another foot, a quarter of a second too late."""
    return replace(series, angular_rate=np.roll(other.angular_rate, 25, axis=0))


def exchanged():
    made = simulate(WalkConfig(route="rectangle", rate=60.0), seed=1)
    return Recording(made.right, made.left)


RECORDINGS = {
    "good": lambda: Recording(moving(1), moving(2)),
    "one foot": lambda: Recording(moving(1)),
    "ends early": lambda: Recording(moving(1), moving(2)[:700]),
    "empty": lambda: Recording(moving(1)[:1], moving(2)),
    "nan": lambda: Recording(with_nan(moving(1)), moving(2)),
    "two in one": lambda: Recording(again(moving(1)), moving(2)),
    "set back": lambda: Recording(set_back(moving(1)), set_back(moving(2))),
    "g": lambda: Recording(scaled(moving(1), 1 / GRAVITY), moving(2)),
    "no gravity": lambda: Recording(scaled(moving(1), 0.01), moving(2)),
    "deg/s": lambda: Recording(moving(1), scaled(moving(2), rate=180 / np.pi)),
    "apart": lambda: Recording(moving(1), moving(2, start_ns=10**18 + 10**11)),
    "gaps": lambda: Recording(moving(1)[np.r_[0:600, 605, 605, 650:1200]], moving(2)[::2]),
    "no standstill": lambda: Recording(moving(1, stand=0), moving(2)),
    "stuck": lambda: Recording(held(moving(1), 700, 730), moving(2)),
    "stuck for long": lambda: Recording(held(moving(1), 700, 900), moving(2)),
    "clipping": lambda: Recording(clipping(moving(1)), moving(2)),
    "hPa": lambda: Recording(moving(1), moving(2), pressure=air(moving(1), 1013.0)),
    "uT": lambda: Recording(with_field(moving(1), 30.0), moving(2)),
    "heavy": lambda: Recording(scaled(moving(1), 1.08), moving(2)),
    "negated": lambda: Recording(scaled(moving(1), rate=-1.0), moving(2)),
    "slow gyro": lambda: Recording(scaled(moving(1), rate=0.7), moving(2)),
    "another gyro": lambda: Recording(with_rate_of(moving(1), moving(2)), moving(2)),
    "lossy": lambda: Recording(moving(1)[np.arange(1200) % 20 != 7], moving(2)),
    "jitter": lambda: Recording(jittering(moving(1)), moving(2)),
    "overlaid": lambda: Recording(overlaid(moving(1)), moving(2)),
    "33 Hz": lambda: Recording(moving(1)[::3], moving(2)[::3]),
    "same": lambda: Recording(moving(1), moving(1)),
    "bursts": lambda: Recording(in_bursts(moving(1)), moving(2)),
    "exchanged": exchanged,
}


OF_WALKS = {
    "missed_stances", "long_stride", "no_stance", "stance_share", "unequal_ways", "mirrored_foot",
    "feet_apart", "spacing",
}  # fmt: skip
"""What only a walk of both feet shows; `test_injected_faults` has these."""


@pytest.fixture(scope="module")
def bags(tmp_path_factory):
    folder = tmp_path_factory.mktemp("bags")
    return {name: write_bag(folder / name, make()) for name, make in RECORDINGS.items()}


def said(*arguments):
    """Run the command in this process; return its exit code and what it printed."""
    out = StringIO()
    with redirect_stdout(out), redirect_stderr(StringIO()):
        code = main([*map(str, arguments)])
    return code, out.getvalue()


def outcomes(bags):
    """Return kinds, severities, usability and exit codes of both verbs, and all sentences."""
    decided, sentences = {}, []
    for name, bag in bags.items():
        code, printed = said("info", bag, "--json")
        facts = json.loads(printed)
        kinds = [(found["name"], found["severity"]) for found in facts["findings"]]
        decided[name] = code, facts["usable"], kinds, sorted(facts["feet"])
        if name == "good" or not facts["usable"]:  # where findings decide whether it is tracked
            evaluated, _ = said("evaluate", bag, "--method", "zupt", "--json")
            decided[name] += (evaluated,)
        sentences += [found["sentence"] for found in facts["findings"]]
    return decided, sentences


@pytest.fixture(scope="module")
def plain(bags):
    return outcomes(bags)


def test_rewording_every_sentence_changes_nothing_that_is_decided(bags, plain, monkeypatch):
    decided, sentences = plain
    make = Finding.__new__
    reworded = "etwas ganz anderes"

    def in_other_words(cls, kind, severity, text, remedy="", about=""):
        return make(cls, kind, severity, reworded, "und was zu tun ist", about)

    monkeypatch.setattr(Finding, "__new__", in_other_words)
    again, others = outcomes(bags)
    assert again == decided
    assert len(set(sentences)) > 15
    assert set(others) == {f"{reworded}; und was zu tun ist"}


def test_these_recordings_show_all_but_a_few_kinds(plain):
    decided = {name: found[2] for name, found in plain[0].items() if name != "exchanged"}
    seen = {kind for kinds in decided.values() for kind, _ in kinds}
    rare = {
        "clocks_apart",
        "cut_off",
        "late_standstill",
        "pressure_clock",
        "field_stamps",
        "swapped",
        "restless_start",
        "rate_used",
        "carried",
        "lost_heading",
        "lost_foot",
        *OF_WALKS,
    }
    assert seen | rare == kinds_made_in("inspection")
    severities = {severity for kinds in decided.values() for _, severity in kinds}
    assert severities == set(Severity)


def test_every_kind_of_finding_is_made_on_recordings_or_live():
    assert kinds_made_in("inspection") | kinds_made_in("nodes") | kinds_made_in("cli") == set(
        FindingKind
    )


def test_an_error_outranks_a_warning_and_a_warning_outranks_nothing():
    assert Severity.ERROR.rank > Severity.WARNING.rank > 0


def test_a_finding_without_a_remedy_is_its_text():
    finding = Finding(FindingKind.STAMPS, Severity.WARNING, "two stamps are left out")
    assert finding.sentence == "two stamps are left out"
    assert not finding.is_error
    assert finding.to_dict() == {
        "severity": "warning",
        "name": "stamps",
        "sentence": "two stamps are left out",
    }
