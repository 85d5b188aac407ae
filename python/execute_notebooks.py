"""execute_notebooks.py OUT NOTEBOOK...: runs notebooks, and writes them as Markdown with their outputs and pictures.

It needs python3-nbclient and python3-ipykernel, and the package `outrider` on PYTHONPATH. A cell that fails ends it.
"""

import base64
import os
import pathlib
import sys
from typing import Any

import nbclient
import nbformat

# The kernel runs in the folder of the notebook, and has the packages that this process has.
_FOLDERS = [os.path.abspath(folder) for folder in os.environ.get("PYTHONPATH", "").split(os.pathsep) if folder]
os.environ |= {"PYTHONPATH": os.pathsep.join(_FOLDERS), "PYDEVD_DISABLE_FILE_VALIDATION": "1"}


def _fence(language: str, text: str) -> str:
    return f"````{language}\n{text.rstrip()}\n````"


def _output(output: Any, picture: pathlib.Path) -> str:
    data = output.get("data", {})
    if "image/png" in data:
        picture.parent.mkdir(exist_ok=True)
        picture.write_bytes(base64.b64decode(data["image/png"]))
        return f"![What the code above draws](./{picture.parent.name}/{picture.name})"
    return _fence("text", output.get("text") or data.get("text/plain", ""))


def execute(path: pathlib.Path, out: pathlib.Path) -> Any:
    """Runs a notebook in its folder, writes OUT/NAME.md with its pictures beside it, and returns it with its outputs."""
    notebook = nbformat.read(path, as_version=4)
    nbclient.NotebookClient(notebook, timeout=120, kernel_name="python3",
                            resources={"metadata": {"path": str(path.parent)}}).execute()
    out.mkdir(parents=True, exist_ok=True)
    parts = []
    for i, cell in enumerate(notebook.cells):
        parts.append(cell.source if cell.cell_type == "markdown" else _fence("python", cell.source))
        for k, output in enumerate(cell.get("outputs", [])):
            parts.append(_output(output, out / f"{path.stem}_files" / f"{i}_{k}.png"))
    (out / f"{path.stem}.md").write_text("\n\n".join(parts) + "\n")
    return notebook


if __name__ == "__main__":
    for argument in sys.argv[2:]:
        execute(pathlib.Path(argument).resolve(), pathlib.Path(sys.argv[1]))
