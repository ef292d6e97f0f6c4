"""The policy of SROS 2 names every topic and service that the nodes open, and no other."""

from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest

from dualfoot_ros.core import FEET, PressureSeries
from dualfoot_ros.nodes.bringup import BringupNode, _make_recorder
from dualfoot_ros.nodes.fusion import FusionNode
from dualfoot_ros.nodes.imu_adapter import ImuAdapterNode
from dualfoot_ros.nodes.replay import ReplayNode
from dualfoot_ros.nodes.time_sync import TimeSyncNode
from dualfoot_ros.recording import read_bag, write_bag

POLICY = Path(__file__).resolve().parents[2] / "config" / "security" / "policy.xml"
KINDS = ("publish", "subscribe", "reply", "request")
WITH_TF = {("/fusion", "publish", "/tf")} | {
    ("/fusion", "subscribe", name) for name in ("/tf", "/tf_static")
}
AIDS = {"aids.barometer": True, "aids.magnetic_heading": True}


def allowed() -> set[tuple[str, str, str]]:
    """Return node, kind of access and full name of all that the policy allows."""
    found = set()
    for profile in ElementTree.parse(POLICY).iter("profile"):
        space = profile.get("ns").rstrip("/")
        node = f"{space}/{profile.get('node')}"
        for group in profile:
            for kind in (k for k in KINDS if group.get(k) == "ALLOW"):
                found |= {(node, kind, _full(item.text, space, node)) for item in group}
    return found


def _full(name: str, space: str, node: str) -> str:
    """Return a name as SROS 2 expands it."""
    if name.startswith("/"):
        return name
    return node + name[1:] if name.startswith("~") else f"{space}/{name}"


def opened(node) -> set[tuple[str, str, str]]:
    """Return node, kind of access and full name of all that a node has opened."""
    asked = (node.get_name(), node.get_namespace())
    found = zip(
        KINDS,
        (
            node.get_publisher_names_and_types_by_node(*asked),
            node.get_subscriber_names_and_types_by_node(*asked),
            node.get_service_names_and_types_by_node(*asked),
            node.get_client_names_and_types_by_node(*asked),
        ),
        strict=True,
    )
    own = node.get_fully_qualified_name()
    return {(own, kind, name) for kind, names in found for name, _ in names}


@pytest.fixture(scope="module")
def full_bag(walk_bag, tmp_path_factory) -> Path:
    """Return a bag with everything that a replay can publish."""
    whole = read_bag(walk_bag)
    feet = {}
    for foot in FEET:
        series = whole.imu(foot)[:100]
        feet[foot] = replace(series, magnetic_field=np.full((100, 3), 2e-5))
    stamps = feet["left"].stamp_ns
    pressure = {worn: PressureSeries(stamps, np.full(100, 1e5)) for worn in (*FEET, "both")}
    made = replace(whole, **feet, pressure=pressure, left_truth=None, right_truth=None)
    return write_bag(tmp_path_factory.mktemp("bags") / "full", made)


def nodes(bench, bag, tmp_path):
    """Make each node in the ways in which it opens most."""
    simulated = {"use_sim_time": True}
    yield bench.add(BringupNode, simulated)
    fusion = bench.add(FusionNode, {**simulated, **AIDS, "sync": "internal"})
    yield fusion
    recorded = tmp_path / "recorded"
    yield bench.add(lambda **options: _make_recorder(recorded, fusion, options), simulated)
    yield bench.add(FusionNode, {**simulated, "sync": "external"})
    yield bench.add(TimeSyncNode, simulated)
    for topic in ("data_raw", "data_sync"):
        yield bench.add(ReplayNode, {**simulated, "bag": str(bag), "topic": topic})
    for foot in FEET:
        for source in ("topic://imu", "udp://127.0.0.1:0?format=ximu3"):
            values = {**simulated, "source": source}
            yield bench.add(ImuAdapterNode, values, namespace=f"/{foot}")


def test_the_policy_has_what_the_nodes_open_and_nothing_else(bench, full_bag, tmp_path):
    found = set[tuple[str, str, str]]()
    for node in nodes(bench, full_bag, tmp_path):
        found |= opened(node)
    assert found - allowed() == set()
    assert allowed() - found - WITH_TF == set()
