"""What is compared: names of methods and presets, and sweeps."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from dualfoot_ros.core.constraints import METHODS
from dualfoot_ros.core.errors import ConfigError
from dualfoot_ros.evaluation import EvaluationError
from dualfoot_ros.evaluation.batch.cases import Sweep, case_names, make_cases


def test_all_is_every_method_for_a_sensor_on_each_foot():
    assert set(case_names("all")) == set(METHODS) - {"rigid_pair"}


def test_presets_stand_beside_methods_and_nothing_is_run_twice():
    assert case_names("idc, liu2023,idc") == ["idc", "liu2023"]


def test_an_unknown_name_is_refused_with_those_that_are_known():
    with pytest.raises(EvaluationError, match=r"'ukf' is no method.*mdmd_ukf.*liu2023"):
        case_names("ukf")


def test_a_method_takes_the_parameters_given_a_preset_its_own():
    idc, liu = make_cases(["idc", "liu2023"], None, {"zupt.std": 0.05, "idc.kappa": 0.5})
    assert (idc.config.zupt.std, liu.config.zupt.std) == (0.05, 0.05)
    assert idc.config.zupt.lever_arm > 0.0 == liu.config.zupt.lever_arm
    assert (idc.label, liu.label) == ("idc", "liu2023")


@given(st.floats(-2, 2), st.integers(0, 40), st.floats(0.01, 1.0))
def test_a_range_has_both_ends_and_equal_steps(start, steps, step):
    start, step = round(start, 3), round(step, 3)
    stop = round(start + steps * step, 6)
    values = Sweep.parse(f"kappa={start}:{stop}:{step}").values
    assert len(values) == steps + 1
    assert values[0] == pytest.approx(start) and values[-1] == pytest.approx(stop)


@pytest.mark.parametrize(
    "text",
    ["kappa", "kappa=", "=1,2", "kappa=1:2", "kappa=1:2:0", "kappa=2:1:0.1", "kappa=a,b",
     "kappa=nan", "kappa=0:1:0.0001"],
)  # fmt: skip
def test_a_sweep_that_is_none_is_refused_with_its_text(text):
    with pytest.raises(EvaluationError, match="--sweep"):
        Sweep.parse(text)


def test_a_sweep_runs_the_methods_that_have_the_parameter_only():
    sweeps = [Sweep.parse("kappa=0.4,0.6"), Sweep.parse("gamma=6000,8000")]
    cases = make_cases(["zupt", "idc", "spacing_vector"], sweeps=sweeps)
    kappa = [c for c in cases if c.swept and c.swept[0] == "kappa"]
    assert [(c.label, c.config.constraint.kappa) for c in kappa] == [
        ("idc kappa=0.4", 0.4),
        ("idc kappa=0.6", 0.6),
    ]
    gamma = [c for c in cases if c.swept and c.swept[0] == "gamma"]
    assert len(gamma) == 6
    assert {c.config.stance.threshold for c in gamma} == {6000.0, 8000.0}


def test_a_sweep_of_a_preset_keeps_the_rest_of_the_preset():
    cases = make_cases(["liu2023"], sweeps=[Sweep.parse("kappa=0.55")])
    assert cases[1].config.constraint.kappa == 0.55
    assert cases[1].config.constraint.solver == "iterative"


def test_whole_numbers_can_be_swept_by_their_dotted_name():
    cases = make_cases(["idc"], sweeps=[Sweep.parse("idc.iterations=1:3:1")])
    assert [c.config.constraint.iterations for c in cases[1:]] == [1, 2, 3]


def test_a_parameter_that_none_has_is_named():
    with pytest.raises(EvaluationError, match="no method among zupt has the parameter 'kappa'"):
        make_cases(["zupt"], sweeps=[Sweep.parse("kappa=0.5")])


def test_a_value_out_of_range_is_refused_as_anywhere():
    with pytest.raises(ConfigError, match=r"idc\.kappa.*allowed"):
        make_cases(["idc"], sweeps=[Sweep.parse("kappa=1.5")])
