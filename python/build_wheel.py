"""Builds a wheel of the Python package with CMake, for pip (PEP 517): needs nothing but what the build needs.

Builds in the folder `build` of the sources, which it configures if nobody has; so after `make build` little is left to
compile. Another folder: `pip install --no-build-isolation --config-settings=build=FOLDER .`
"""
import base64
import hashlib
import pathlib
import re
import subprocess
import sys
import sysconfig
import zipfile

SOURCE = pathlib.Path(__file__).resolve().parent.parent


def version():
    return re.search(r"project\(outrider VERSION (\S+)", (SOURCE / "CMakeLists.txt").read_text())[1]


def metadata():
    return (f"Metadata-Version: 2.1\nName: outrider\nVersion: {version()}\n"
            "Summary: A ground robot finds its way, and does a job, in a yard or a building\n"
            "License: Apache-2.0\nRequires-Python: >=3.11\nRequires-Dist: numpy\n")


def build_extension(settings):
    """Returns the built module and the files beside it."""
    build = pathlib.Path((settings or {}).get("build", SOURCE / "build")).resolve()
    options = ["-DOUTRIDER_WITH_PYTHON=ON"]
    if not (build / "CMakeCache.txt").exists():
        options += ["-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DOUTRIDER_BUILD_TESTS=OFF",
                    f"-DPython3_EXECUTABLE={sys.executable}"]
    subprocess.run(["cmake", "-S", SOURCE, "-B", build, *options], check=True)
    subprocess.run(["cmake", "--build", build, "--target", "outrider_python"], check=True)
    module = build / "python/outrider" / ("_outrider" + sysconfig.get_config_var("EXT_SUFFIX"))
    package = SOURCE / "python/outrider"
    return [module, *sorted(path for path in package.iterdir() if path.suffix in (".py", ".pyi", ".typed"))]


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    tag = f"{python}-{python}-{sysconfig.get_platform().replace('-', '_').replace('.', '_')}"
    files = {f"outrider/{path.name}": path.read_bytes() for path in build_extension(config_settings)}
    info = f"outrider-{version()}.dist-info"
    files[f"{info}/METADATA"] = metadata().encode()
    files[f"{info}/WHEEL"] = f"Wheel-Version: 1.0\nGenerator: outrider\nRoot-Is-Purelib: false\nTag: {tag}\n".encode()
    record = f"{info}/RECORD"
    lines = []
    for name, content in files.items():
        digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
        lines.append(f"{name},sha256={digest},{len(content)}\n")
    files[record] = "".join([*lines, f"{record},,\n"]).encode()
    name = f"outrider-{version()}-{tag}.whl"
    with zipfile.ZipFile(pathlib.Path(wheel_directory, name), "w", zipfile.ZIP_DEFLATED) as wheel:
        for path, content in files.items():
            wheel.writestr(path, content)
    return name
