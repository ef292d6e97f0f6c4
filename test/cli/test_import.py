"""`dualfoot import` as a user runs it: as a process, on files made up here and on real ones."""

import pytest

from dualfoot_ros.core import Increments
from dualfoot_ros.recording import Reference, read_bag
from dualfoot_ros.recording.importers import FORMATS

COLUMNS = "PacketCounter,SampleTimeFine,Acc_X,Acc_Y,Acc_Z,Gyr_X,Gyr_Y,Gyr_Z"


def export(path, start_us=0, count=300):
    rows = [  # with some noise, or the sensor would be called stuck
        f"{k},{start_us + k * 16667},0.1,0.2,9.8{k % 7},0.5,-0.5,1.0{k % 5}" for k in range(count)
    ]
    path.write_text("DeviceTag:,A\n\n" + "\n".join([COLUMNS, *rows]) + "\n")
    return path


@pytest.fixture
def pair(tmp_path):
    left, right = export(tmp_path / "L.csv"), export(tmp_path / "R.csv", 8000)
    return ["--left", left, "--right", right]


def test_a_pair_of_exports_becomes_a_bag(tmp_path, pair, dualfoot_process):
    done = dualfoot_process("import", *pair, "-o", "walk", cwd=tmp_path)
    assert (done.returncode, done.stderr) == (0, "")
    assert "left: 300 samples, 5.0 s, 60.0 Hz" in done.stdout
    assert "wrote walk" in done.stdout
    assert len(read_bag(tmp_path / "walk").right) == 300


@pytest.mark.parametrize(("storage", "suffix"), [("mcap", ".mcap"), ("sqlite3", ".db3")])
def test_the_storage_is_the_one_asked_for(tmp_path, pair, storage, suffix, dualfoot):
    dualfoot("import", *pair, "-o", "walk", "--storage", storage, cwd=tmp_path)
    assert (tmp_path / "walk" / f"walk{suffix}").exists()


def test_an_export_of_the_dot_app_has_compensated_increments_unless_told_otherwise(
    tmp_path, pair, dualfoot
):
    dualfoot("import", *pair, "-o", "walk", cwd=tmp_path)
    assert read_bag(tmp_path / "walk").left.increments is Increments.COMPENSATED
    dualfoot("import", *pair, "-o", "other", "--increments", "averaged", cwd=tmp_path)
    assert read_bag(tmp_path / "other").right.increments is Increments.AVERAGED


def test_list_names_every_format(tmp_path, dualfoot):
    done = dualfoot("import", "--list", cwd=tmp_path)
    assert done.returncode == 0
    for known in FORMATS:
        assert known.name in done.stdout
        assert known.description in done.stdout


def test_devices_with_different_clocks_are_told_and_an_offset_brings_them_together(
    tmp_path, dualfoot
):
    left = export(tmp_path / "L.csv", 170_000_000)
    right = export(tmp_path / "R.csv", 7_500_000)
    pair = ["--left", left, "--right", right]
    done = dualfoot("import", *pair, "-o", "apart", cwd=tmp_path)
    assert done.returncode == 0
    assert "do not overlap" in done.stderr
    assert "'dualfoot sync BAG -o ALIGNED'" in done.stderr
    assert "--right-offset SECONDS" in done.stderr
    done = dualfoot("import", *pair, "-o", "together", "--right-offset", "162.5", cwd=tmp_path)
    assert (done.returncode, done.stderr) == (0, "")
    bag = read_bag(tmp_path / "together")
    assert bag.left.stamp_ns[0] == bag.right.stamp_ns[0]
    assert bag.notes["right_offset_s"] == "162.500000000"


def test_a_bag_that_exists_is_kept_unless_overwriting_is_asked_for(tmp_path, pair, dualfoot):
    dualfoot("import", *pair, "-o", "walk", cwd=tmp_path)
    before = (tmp_path / "walk" / "walk.mcap").read_bytes()
    done = dualfoot("import", *pair, "-o", "walk", "--right-offset", "1", cwd=tmp_path)
    assert done.returncode == 2
    assert "'walk' exists already" in done.stderr
    assert (tmp_path / "walk" / "walk.mcap").read_bytes() == before
    done = dualfoot(
        "import", *pair, "-o", "walk", "--right-offset", "1", "--overwrite", cwd=tmp_path
    )
    assert done.returncode == 0
    assert read_bag(tmp_path / "walk").right.stamp_ns[0] == 1_008_000_000


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        ([], "no source given"),
        (["missing.mat"], "there is no file 'missing.mat'"),
        (["L.csv", "R.csv"], "give --left FILE and --right FILE"),
        (["--left", "L.csv", "--right", "R.csv", "--axes=+x+y-z"], "they mirror the sensor"),
        (["broken.mat"], "no readable .mat file"),
    ],
)
def test_what_cannot_be_imported_is_one_sentence_and_leaves_nothing(
    tmp_path, pair, arguments, sentence, dualfoot
):
    (tmp_path / "broken.mat").write_bytes(bytes(300))
    files = sorted(tmp_path.iterdir())
    done = dualfoot("import", *arguments, "-o", "walk", cwd=tmp_path)
    assert done.returncode == 2
    assert sentence in done.stderr
    assert len(done.stderr.splitlines()) == 1
    assert sorted(tmp_path.iterdir()) == files


def test_without_an_output_nothing_is_guessed(tmp_path, pair, dualfoot):
    done = dualfoot("import", *pair, cwd=tmp_path)
    assert done.returncode == 2
    assert "no output given" in done.stderr


def test_a_real_walk_comes_with_its_markers(tmp_path, dual_feet, dualfoot):
    walk = dual_feet / "rectangle_cw" / "XF_2Laces_cw_1.mat"
    done = dualfoot("import", walk, "-o", "walk", cwd=tmp_path)
    assert (done.returncode, done.stderr) == (0, "")
    assert "21 markers of the right foot" in done.stdout
    markers = Reference.load(tmp_path / "walk" / "reference.yaml").markers["right"]
    assert markers[9].tolist() == pytest.approx([1.2, 9.6, 0.0])
