"""What `pip install .` calls (PEP 517): CMake builds the module, and a wheel is a zip of it. It stands on Python alone,
so that nothing is fetched.

Settings, by `--config-settings NAME=VALUE`: build-dir, where CMake builds, by default build/python; prebuilt, a build
folder that has the module already.
"""

import base64
import hashlib
import io
import os
import re
import shutil
import subprocess
import sys
import sysconfig
import tarfile
import tomllib
import zipfile
from pathlib import Path

root = Path(__file__).resolve().parents[1]
sources = ["CMakeLists.txt", "CMakePresets.json", "LICENSE", "README.md", "pyproject.toml", "algorithms", "apps", "bench",
           "harness", "io", "kernel", "python", "sightline", "tests"]  # fmt: skip


def _project():
    """[project], with the version of CMakeLists.txt."""
    project = tomllib.loads((root / "pyproject.toml").read_text())["project"]
    project["version"] = re.search(r"project\(sightline VERSION ([0-9.]+)", (root / "CMakeLists.txt").read_text())[1]
    return project


def _metadata():
    project = _project()
    lines = ["Metadata-Version: 2.1", f"Name: {project['name']}", f"Version: {project['version']}",
             f"Summary: {project['description']}", f"License: {project['license']['text']}",
             f"Requires-Python: {project['requires-python']}"]  # fmt: skip
    lines += [f"Requires-Dist: {needed}" for needed in project["dependencies"]]
    for extra, needs in project["optional-dependencies"].items():
        lines.append(f"Provides-Extra: {extra}")
        lines += [f"Requires-Dist: {needed}; extra == '{extra}'" for needed in needs]
    lines.append("Description-Content-Type: text/markdown")
    return "\n".join(lines) + "\n\n" + (root / project["readme"]).read_text()


def _jobs():
    """As many compilers at once as there are processors, but 3 GiB of memory for each."""
    try:
        memory = os.sysconf("SC_AVPHYS_PAGES") * os.sysconf("SC_PAGE_SIZE") // (3 << 30)
    except (ValueError, OSError):
        memory = 1
    return max(1, min(os.cpu_count() or 1, memory))


def _build(folder):
    """The folder of the package, the module in it."""
    options = ["-DCMAKE_BUILD_TYPE=Release", "-DSIGHTLINE_PYTHON=ON", f"-DSIGHTLINE_PYTHON_EXECUTABLE={sys.executable}",
               "-DSIGHTLINE_APPS=OFF", "-DSIGHTLINE_TESTS=OFF", "-DSIGHTLINE_BENCH=OFF", "-DSIGHTLINE_INSTALL=OFF",
               "-DCMAKE_UNITY_BUILD=ON", "-DCMAKE_UNITY_BUILD_BATCH_SIZE=10"]  # fmt: skip
    if shutil.which("ninja"):
        options += ["-G", "Ninja"]
    if not shutil.which("cmake"):
        raise SystemExit("sightline is compiled: it needs cmake and a C++20 compiler, and what .ci/environment.sh lists")
    subprocess.run(["cmake", "-S", root, "-B", folder, *options], check=True)
    subprocess.run(["cmake", "--build", folder, "--target", "sightline_python", "--parallel", str(_jobs())], check=True)


def _tag():
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    return f"{python}-{python}-{re.sub('[-.]', '_', sysconfig.get_platform())}"


def _of_info():
    """The files of the folder that says what is installed, but for the list of all."""
    wheel = f"Wheel-Version: 1.0\nGenerator: sightline\nRoot-Is-Purelib: false\nTag: {_tag()}\n"
    return {"METADATA": _metadata().encode(), "WHEEL": wheel.encode(), "LICENSE": (root / "LICENSE").read_bytes()}


def prepare_metadata_for_build_wheel(metadata_directory, config_settings=None):
    name = f"sightline-{_project()['version']}.dist-info"
    folder = Path(metadata_directory) / name
    folder.mkdir()
    for file, data in _of_info().items():
        (folder / file).write_bytes(data)
    return name


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    settings = config_settings or {}
    folder = Path(settings.get("prebuilt") or settings.get("build-dir") or root / "build" / "python")
    if not settings.get("prebuilt"):
        _build(folder)
    module = folder / "python" / "sightline" / ("_sightline" + sysconfig.get_config_var("EXT_SUFFIX"))
    if not module.is_file():
        raise SystemExit(f"{folder} has no module for this Python, {module.name}")
    project = _project()
    info = f"sightline-{project['version']}.dist-info"
    package = root / "python" / "sightline"
    files = {f"sightline/{file.name}": file.read_bytes()
             for file in sorted(package.iterdir()) if file.suffix in (".py", ".pyi", ".typed")}  # fmt: skip
    files[f"sightline/{module.name}"] = module.read_bytes()
    files["sightline/py.typed"] = b""
    files.update({f"{info}/{file}": data for file, data in _of_info().items()})
    record = ""
    for name, data in files.items():
        digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
        record += f"{name},sha256={digest},{len(data)}\n"
    files[f"{info}/RECORD"] = (record + f"{info}/RECORD,,\n").encode()
    wheel = f"sightline-{project['version']}-{_tag()}.whl"
    with zipfile.ZipFile(Path(wheel_directory) / wheel, "w", zipfile.ZIP_DEFLATED) as out:
        for name, data in files.items():
            out.writestr(name, data)
    return wheel


def build_sdist(sdist_directory, config_settings=None):
    name = f"sightline-{_project()['version']}"
    with tarfile.open(Path(sdist_directory) / f"{name}.tar.gz", "w:gz") as out:
        for source in sources:
            out.add(root / source, f"{name}/{source}", filter=lambda f: None if "__pycache__" in f.name else f)
        metadata = _metadata().encode()
        entry = tarfile.TarInfo(f"{name}/PKG-INFO")
        entry.size = len(metadata)
        out.addfile(entry, io.BytesIO(metadata))
    return f"{name}.tar.gz"
