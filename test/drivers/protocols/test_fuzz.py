"""A short run of the fuzzer; ``benchmark/fuzz_decoders.py`` is for the long ones."""

import json
import subprocess
import sys
from pathlib import Path

FUZZER = Path(__file__).parents[3] / "benchmark" / "fuzz_decoders.py"


def test_a_short_fuzz_of_every_decoder_breaks_no_promise():
    command = [sys.executable, FUZZER, "--executions", "600", "--seed", "11", "--json"]
    run = subprocess.run(command, capture_output=True, text=True, check=False)
    assert run.returncode == 0, run.stdout + run.stderr
    results = json.loads(run.stdout)["results"]
    assert len(results) == 9
    for result in results:
        assert result["executions"] == 600
        assert result["failures"] == []
        assert result["second_frame_lost"] == 0, result
        if result["format"] != "dot":  # damaged notifications have the wrong length
            assert result["samples_of_damaged_bytes"] > 0


def test_the_fuzzer_refuses_no_executions():
    command = [sys.executable, FUZZER, "--executions", "0"]
    run = subprocess.run(command, capture_output=True, text=True, check=False)
    assert run.returncode == 2
    assert "--executions is 0" in run.stderr
