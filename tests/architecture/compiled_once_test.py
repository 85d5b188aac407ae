"""The tool is compiled once: `make test` after `make demo` finds more packages and builds more, but compiles no file of the
tool anew. Compares the commands of this build with those of a folder that is
configured as if only the packages for the tool were installed.

compiled_once_test.py SOURCES BUILD
"""
import json
import pathlib
import subprocess
import sys
import tempfile

REPLACED = "/rigid_world_absent.cpp.o"  # by the world in the physics engine
ABSENT = [f"-DOUTRIDER_WITH_{name}=OFF" for name in ("OMPL", "PHYSICS", "CBC", "CERES", "PYTHON")]


def commands(folder: pathlib.Path) -> dict[str, str]:
    entries = json.loads((folder / "compile_commands.json").read_text(encoding="utf-8"))
    return {entry["command"].split(" -o ")[1].split()[0]: entry["command"].replace(str(folder), "BUILD") for entry in entries}


def main() -> None:
    sources, build = (pathlib.Path(argument).resolve() for argument in sys.argv[1:])
    cache = (build / "CMakeCache.txt").read_text(encoding="utf-8").splitlines()
    kept = [f"-D{line}" for line in cache if line.startswith(("CMAKE_CXX_COMPILER:", "CMAKE_CXX_FLAGS:",
                                                              "CMAKE_CXX_COMPILER_LAUNCHER:", "CMAKE_COMPILE_WARNING_AS_ERROR:",
                                                              "OUTRIDER_QUICK_BUILD:", "OUTRIDER_WITH_PAGE:"))]
    with tempfile.TemporaryDirectory() as name:
        alone = pathlib.Path(name).resolve()
        subprocess.run(["cmake", "--preset", "release", "-B", alone, "-DOUTRIDER_BUILD_TESTS=OFF", *kept, *ABSENT], cwd=sources,
                       check=True, capture_output=True)
        before, after = commands(alone), commands(build)
    assert len(before) > 100, before
    alone_only = {output for output in before.keys() - after.keys() if not output.endswith(REPLACED)}
    assert not alone_only, f"compiled for the tool alone: {alone_only}"
    changed = sorted(output for output, command in before.items() if command != after.get(output, command))
    assert not changed, f"compiled again: {changed}"
    print(f"{len(before)} files of the tool, none compiled again")


main()
