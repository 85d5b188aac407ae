"""The notebooks run, print and draw; what is committed has no outputs."""

import importlib.util
import json
import pathlib

import pytest

FOLDER = pathlib.Path(__file__).parent.parent
NOTEBOOKS = sorted(FOLDER.glob("notebooks/*.ipynb"))


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_notebook_runs(path, tmp_path):
    for package in ("nbclient", "ipykernel", "matplotlib"):
        pytest.importorskip(package)
    spec = importlib.util.spec_from_file_location("execute_notebooks", FOLDER / "execute_notebooks.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    outputs = [one for cell in module.execute(path, tmp_path).cells for one in cell.get("outputs", [])]
    assert not [one for one in outputs if one.get("name") == "stderr"]
    assert any(one.get("name") == "stdout" for one in outputs)
    text = (tmp_path / f"{path.stem}.md").read_text()
    pictures = list((tmp_path / f"{path.stem}_files").glob("*.png"))
    assert pictures and all(f"{path.stem}_files/{one.name}" in text for one in pictures)


def test_what_is_committed_has_no_outputs():
    examples = {path.stem[:2] for path in FOLDER.glob("examples/*.py")}
    assert len(NOTEBOOKS) == 3 and all(path.stem[:2] in examples for path in NOTEBOOKS)
    for path in NOTEBOOKS:
        cells = json.loads(path.read_text())["cells"]
        assert cells[0]["cell_type"] == "markdown" and cells[0]["source"][0].startswith("# ")
        assert all(not cell["outputs"] and cell["execution_count"] is None for cell in cells if cell["cell_type"] == "code")
