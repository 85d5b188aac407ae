"""The examples print what their last comment says, and their types are right."""

import pathlib
import subprocess
import sys

import outrider
import pytest

EXAMPLES = sorted(pathlib.Path(__file__).parent.parent.glob("examples/*.py"))


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda path: path.stem)
def test_an_example_prints_what_it_says(example):
    _, _, expected = example.read_text().partition("# Prints:\n")
    assert expected
    if "import plot" in example.read_text():
        pytest.importorskip("matplotlib")
    printed = subprocess.run([sys.executable, example], check=True, capture_output=True, text=True).stdout
    assert "".join(f"# {line}\n" for line in printed.splitlines()) == expected


def test_there_are_twelve():
    assert [path.stem[:3] for path in EXAMPLES] == [f"{number:02}_" for number in range(1, 13)]


def test_types_are_right():
    package = pathlib.Path(outrider.__file__).parent
    checked = subprocess.run([sys.executable, "-m", "mypy", "--strict", "--cache-dir=/dev/null", *EXAMPLES, package],
                             capture_output=True, text=True, check=False)
    assert checked.returncode == 0, checked.stdout
