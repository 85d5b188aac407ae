"""Runs of scenarios, and their logs."""

import json
import os
import pathlib
import signal
import subprocess
import threading

import numpy as np
import outrider
import pytest

SCENARIO = "scenarios/pursuit/park.yaml"


def test_a_run_has_the_bytes_of_the_tool(tmp_path):
    run = outrider.run(pathlib.Path(SCENARIO))
    files = run.save(tmp_path / "python")
    subprocess.run([os.environ["OUTRIDER"], "run", SCENARIO, "--out", tmp_path / "tool"], check=False,
                   capture_output=True)
    names = sorted(path.name for path in (tmp_path / "tool").iterdir())
    assert names == sorted(path.name for path in (tmp_path / "python").iterdir())
    assert {"run.json", "run.mcap", "run.svg"} <= set(names)
    for name in names:
        assert (tmp_path / "tool" / name).read_bytes() == (tmp_path / "python" / name).read_bytes(), name
    assert set(files) >= {"result", "log", "picture"}
    assert run.result == (tmp_path / "tool" / "run.json").read_text()
    run.save(tmp_path / "again")
    assert (tmp_path / "again" / "run.mcap").read_bytes() == (tmp_path / "tool" / "run.mcap").read_bytes()


def test_results_are_values(tmp_path):
    run = outrider.run(SCENARIO)
    result = json.loads(run.result)
    assert run.status == result["status"] and run.job == "pursue"
    assert {name: run.metrics[name] for name in result["metrics"] if result["metrics"][name] is not None} == {
        name: value for name, value in result["metrics"].items() if value is not None}
    assert run.settings == result["settings"]
    for columns in run.tables.values():
        assert len({len(values) for values in columns.values()}) <= 1
    run.save(tmp_path)
    read = outrider.read_log(tmp_path / "run.mcap")
    assert read.keys() == run.log.keys() and read
    for name, array in read.items():
        np.testing.assert_array_equal(array, run.log[name])
    some = next(name for name in read if "/" not in name)
    assert some in outrider.read_log(tmp_path / "run.mcap", topics=["/" + some])


def test_options_are_set():
    run = outrider.run(SCENARIO, seed=7)
    assert run.settings["seed"].split()[0] == "7"
    same = outrider.run(SCENARIO, set={"seed": 7})
    assert same.result == run.result


@pytest.mark.parametrize("arguments, words", [
    ({"scenario": "scenarios/none.yaml"}, "none.yaml"),
    ({"set": {"no_such": 1}}, "no_such"),
    ({"set": {"seed": "many"}}, "many"),
    ({"set": {"seed": None}}, "None"),
])
def test_what_is_wrong_is_refused(arguments, words):
    with pytest.raises(outrider.BadInput, match=words):
        outrider.run(**{"scenario": SCENARIO, **arguments})


def test_a_folder_that_cannot_be_made_is_refused(tmp_path):
    run = outrider.run(SCENARIO)
    (tmp_path / "file").write_text("")
    with pytest.raises(outrider.BadInput, match="is no folder"):
        run.save(tmp_path / "file" / "folder")


def test_a_damaged_log_is_refused(tmp_path):
    outrider.run(SCENARIO).save(tmp_path)
    whole = (tmp_path / "run.mcap").read_bytes()
    for part in (whole[:len(whole) // 2], b"\x89MCAP0\r\n" + b"\xff" * 64):
        (tmp_path / "cut.mcap").write_bytes(part)
        with pytest.warns(RuntimeWarning, match="cut.mcap"):
            outrider.read_log(tmp_path / "cut.mcap")
    (tmp_path / "text.mcap").write_text("no log")
    with pytest.raises(outrider.BadInput, match="text.mcap"):
        outrider.read_log(tmp_path / "text.mcap")
    with pytest.raises(outrider.BadInput, match="none.mcap"):
        outrider.read_log(tmp_path / "none.mcap")


def test_ctrl_c_ends_a_run():
    """The office takes many seconds; the signal comes while it is explored."""
    threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT)).start()
    with pytest.raises(KeyboardInterrupt):
        outrider.run("scenarios/explore/office.yaml")


def test_the_jobs_are_listed():
    assert set(outrider.jobs()) == {"cover", "drive", "explore", "fleet", "guard", "plan", "pursue", "slam"}
