"""The track for other programs: on the map, as tables, as a bag, on a floor plan."""

import json
import math
from dataclasses import replace
from xml.etree import ElementTree

import numpy as np
import pytest

from dualfoot_ros.evaluation import EvaluationError, evaluate, person_track
from dualfoot_ros.evaluation.exports import (
    FloorPlan,
    GeoOrigin,
    start_direction,
    write_estimate_bag,
    write_geo_files,
    write_person,
)
from dualfoot_ros.evaluation.reports.plots import tracks

from ..walks import perfect, rectangle

MUNICH = GeoOrigin(48.1486, 11.5680, 90.0)


@pytest.fixture(scope="module")
def person():
    """Return the person of a walk round a rectangle that starts along y."""
    return person_track(perfect(rectangle())[0])


def write_png(path, width, height):
    """Write a grey picture."""
    from matplotlib.image import imsave

    imsave(path, np.full((height, width, 3), 0.5))


def metres(origin, degrees):
    """Return east and north by the haversine's small angles, on a sphere of the mean radius."""
    lon, lat = np.radians(degrees - [[origin.longitude, origin.latitude]]).T
    radius = 6_371_000.0
    return np.column_stack([radius * lon * math.cos(math.radians(origin.latitude)), radius * lat])


def test_a_walk_starts_at_its_origin_along_its_bearing(person):
    for bearing in (0.0, 90.0, 200.0):
        places = metres(MUNICH, replace(MUNICH, heading=bearing).degrees(person))
        assert places[0] == pytest.approx([0.0, 0.0], abs=1e-6)
        ahead = places[np.searchsorted(person.walked_m, 3.0)]
        toward = math.degrees(math.atan2(ahead[0], ahead[1])) % 360
        assert toward == pytest.approx(bearing, abs=0.5)


def test_distances_on_the_map_are_those_of_the_walk(person):
    places = metres(MUNICH, MUNICH.degrees(person))
    on_map = np.linalg.norm(places - places[0], axis=1)
    walked = np.linalg.norm((person.position - person.position[0])[:, :2], axis=1)
    assert on_map == pytest.approx(walked, rel=0.005, abs=1e-3)


def test_without_a_bearing_x_points_to_the_east(person):
    east = GeoOrigin(0.0, 179.9999999).degrees(person)
    assert np.all(np.abs(east[:, 0]) <= 180.0)
    places = metres(MUNICH, GeoOrigin(MUNICH.latitude, MUNICH.longitude).degrees(person))
    wanted = (person.position - person.position[0])[:, :2]
    assert places == pytest.approx(wanted, rel=0.005, abs=0.05)


@pytest.mark.parametrize("text", ["", "48", "48,11,90,1", "north,11", "91,0", "48,181", "nan,0"])
def test_an_origin_that_is_none_is_refused(text):
    with pytest.raises(EvaluationError, match="allowed"):
        GeoOrigin.parse(text)


def test_the_files_of_a_map_are_what_their_formats_ask_for(person, tmp_path):
    geojson, kml, gpx = write_geo_files(tmp_path, person, MUNICH, "a <walk>")
    features = json.loads(geojson.read_text())["features"]
    assert [f["geometry"]["type"] for f in features] == ["LineString", "Point", "Point"]
    line = features[0]["geometry"]["coordinates"]
    assert len(line) == len(features[0]["properties"]["times"]) > 20
    assert line[0][:2] == pytest.approx([MUNICH.longitude, MUNICH.latitude])
    spaces = {"k": "http://www.opengis.net/kml/2.2", "g": "http://www.topografix.com/GPX/1/1"}
    root = ElementTree.parse(kml).getroot()
    assert root.findtext("k:Document/k:name", namespaces=spaces) == "a <walk>"
    text = root.findtext(".//k:LineString/k:coordinates", namespaces=spaces)
    assert len(text.split()) == len(line)
    points = ElementTree.parse(gpx).getroot().findall(".//g:trkpt", spaces)
    assert len(points) == len(line)
    times = [p.findtext("g:time", namespaces=spaces) for p in points]
    assert times == sorted(times) and times[0].endswith("Z")
    assert float(points[0].get("lat")) == pytest.approx(MUNICH.latitude)


def test_the_person_as_tum_and_csv_is_the_point_between_the_feet(person, tmp_path):
    tum, csv = write_person(tmp_path, person)
    rows = np.loadtxt(tum)
    assert rows[:, 1:4] == pytest.approx(person.position, abs=1e-9)
    assert np.linalg.norm(rows[:, 4:], axis=1) == pytest.approx(1.0)
    names = csv.read_text().splitlines()[0].split(",")
    table = np.loadtxt(csv, delimiter=",", skiprows=1)
    assert table.shape == (len(person.stamp_ns), len(names))
    assert table[:, names.index("walked_m")] == pytest.approx(person.walked_m, abs=1e-6)
    assert csv.read_text().splitlines()[1].startswith(str(person.stamp_ns[0]))


def test_the_bag_holds_the_estimate_under_the_topics_of_the_nodes(person, tmp_path):
    from rosbags.highlevel import AnyReader

    track, _ = perfect(rectangle())
    path = write_estimate_bag(tmp_path, track, person)
    with AnyReader([path]) as reader:
        counts = {c.topic: c.msgcount for c in reader.connections}
        epochs = len(track.left)
        assert counts == {
            "/left/odometry": epochs,
            "/right/odometry": epochs,
            "/odometry": epochs,
            "/left/path": 1,
            "/right/path": 1,
            "/path": 1,
        }
        stamps = []
        for connection, stamp, raw in reader.messages():
            message = reader.deserialize(raw, connection.msgtype)
            stamps.append(stamp)
            if connection.topic == "/left/path":
                assert len(message.poses) > 15
                assert message.header.frame_id == "odom"
            if connection.topic == "/odometry":
                last = message
    assert stamps == sorted(stamps)
    p, q = last.pose.pose.position, last.pose.pose.orientation
    assert [p.x, p.y, p.z] == pytest.approx(person.position[-1])
    assert 2 * math.atan2(q.z, q.w) % math.tau == pytest.approx(person.heading[-1] % math.tau)
    assert np.reshape(last.pose.covariance, (6, 6))[:3, :3] == pytest.approx(person.covariance[-1])
    assert last.child_frame_id == "base_footprint"
    twist = np.reshape(last.twist.covariance, (6, 6))
    assert twist[:3, :3] == pytest.approx(np.eye(3) * 0.01)
    assert np.diag(twist)[3:] == pytest.approx([1000.0] * 3)


def test_a_floor_plan_lies_with_its_start_on_the_start(person, tmp_path):
    write_png(tmp_path / "hall.png", 200, 100)
    plan = FloorPlan.load(tmp_path / "hall.png", 0.05, "20,80,90")
    picture = plan.picture(person)
    assert (picture["width"], picture["height"]) == pytest.approx((10.0, 5.0))
    assert (picture["left"], picture["up"]) == pytest.approx((1.0, 4.0))
    assert picture["angle"] == pytest.approx(math.degrees(start_direction(person)) - 90.0)
    assert picture["href"].startswith("data:image/png;base64,")


def test_a_floor_plan_lies_under_the_tracks_of_the_picture_too(tmp_path, monkeypatch):
    drawn = []
    monkeypatch.setattr(tracks, "save", lambda figure, path: drawn.append(figure))
    write_png(tmp_path / "hall.png", 200, 100)
    run = evaluate(perfect(rectangle())[0])
    plan = FloorPlan.load(tmp_path / "hall.png", 0.05, "20,80,90")
    for given in (None, plan):
        tracks.draw_tracks({"zupt": run}, tmp_path / "tracks.png", "a walk", given)
    plain, laid = (figure.axes[0] for figure in drawn)
    (image,) = laid.images
    start = person_track(run.trajectory).position[0, :2]
    # the start's pixel in the coordinates of the picture, then where the axes draw it
    left, _, _, top = image.get_extent()
    pixel = np.array([left + 20 * 0.05, top - 80 * 0.05])
    shown = laid.transData.inverted().transform(image.get_transform().transform(pixel))
    assert shown == pytest.approx(start, abs=1e-6)
    assert image.get_zorder() < min(line.get_zorder() for line in laid.lines)
    assert np.ptp(laid.get_xlim()) == pytest.approx(np.ptp(plain.get_xlim()), rel=0.1)


@pytest.mark.parametrize(
    ("scale", "start"), [(None, "1,2"), (0.0, "1,2"), (0.1, None), (0.1, "1")]
)
def test_a_floor_plan_without_scale_or_start_is_refused(tmp_path, scale, start):
    write_png(tmp_path / "hall.png", 2, 2)
    with pytest.raises(EvaluationError, match="needed"):
        FloorPlan.load(tmp_path / "hall.png", scale, start)


def test_a_floor_plan_that_is_no_png_is_refused(tmp_path):
    (tmp_path / "hall.png").write_bytes(b"GIF89a")
    with pytest.raises(EvaluationError, match="PNG"):
        FloorPlan.load(tmp_path / "hall.png", 0.1, "1,2")
