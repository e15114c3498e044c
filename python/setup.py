"""Builds the package with CMake: `pip install ./python`, or, with setuptools and wheel already installed in the
environment, `pip install --no-build-isolation --no-index ./python`, which needs no network.

The libraries are compiled in SIKKU_BUILD if it is set, otherwise in build/release if ./demo has left it there, so that
only the module itself has to be compiled, otherwise in a folder of their own. The source distribution contains the
libraries as `source`.
"""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext
from setuptools.command.sdist import sdist

HERE = Path(__file__).resolve().parent
SOURCE = HERE / "source" if (HERE / "source").is_dir() else HERE.parent
DEMO_BUILD = SOURCE / "build" / "release"
OWN_BUILD = SOURCE / "build" / f"pip-{sys.implementation.cache_tag}"


def version() -> str:
    found = re.search(r"project\(sikku VERSION ([0-9.]+)", (SOURCE / "CMakeLists.txt").read_text())
    assert found
    return found[1]


# What a build of the module needs.
SOURCES = ["CMakeLists.txt", "LICENSE", "art", "engine", "music", "packaging", "patterns", "python"]
SKIPPED = {"__pycache__", "sikku.egg-info", "build", "dist", "tests", ".pytest_cache", f"sikku-{version()}"}


def build_folder() -> Path:
    if "SIKKU_BUILD" in os.environ:
        return Path(os.environ["SIKKU_BUILD"])
    return DEMO_BUILD if (DEMO_BUILD / "CMakeCache.txt").exists() else OWN_BUILD


class CMakeBuild(build_ext):
    """Installs the module, the image module and the patterns in the layout of an installation."""

    def build_extension(self, ext: Extension) -> None:
        build = build_folder()
        package = Path(self.get_ext_fullpath(ext.name)).resolve().parent.parent
        jobs = os.environ.get("CMAKE_BUILD_PARALLEL_LEVEL", str(os.cpu_count() or 1))
        configure = ["cmake", "-S", str(SOURCE), "-B", str(build), "-DSIKKU_PYTHON=ON",
                     f"-DPython_EXECUTABLE={sys.executable}"]  # fmt: skip
        if build == OWN_BUILD:
            print("Compiling Sikku: about 10 minutes on two cores. After ./demo only the module is compiled.", flush=True)
            configure += ["-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_INSTALL_BINDIR=bin",
                          "-DCMAKE_INSTALL_LIBDIR=lib", "-DCMAKE_INSTALL_DATADIR=share", "-DSIKKU_TESTS=OFF",
                          "-DSIKKU_PROGRAM=OFF"]  # fmt: skip
        subprocess.run(configure, check=True)
        subprocess.run(
            ["cmake", "--build", str(build), "--target", "sikku_python", "--parallel", jobs], check=True
        )
        subprocess.run(
            ["cmake", "--install", str(build), "--component", "python", "--strip", "--prefix", str(package)],
            check=True,
        )
        if build == DEMO_BUILD:  # later builds of ./demo compile no module, and need no interpreter
            subprocess.run(["cmake", "-DSIKKU_PYTHON=OFF", "-UPython_EXECUTABLE", str(build)], check=True)


class SourceDistribution(sdist):
    """Adds the sources of the libraries, so that the archive builds without the checkout."""

    def make_release_tree(self, base_dir: str, files: list) -> None:
        super().make_release_tree(base_dir, ["setup.py", "pyproject.toml", "README.md"])
        for name in SOURCES:
            found = [SOURCE / name] if (SOURCE / name).is_file() else sorted((SOURCE / name).rglob("*"))
            for file in found:
                part = file.relative_to(SOURCE)
                if file.is_file() and not SKIPPED.intersection(part.parts):
                    target = Path(base_dir) / "source" / part
                    target.parent.mkdir(parents=True, exist_ok=True)
                    shutil.copy2(file, target)


setup(
    name="sikku",
    version=version(),
    description="L-systems: kolams, tilings, plants and music",
    long_description=(SOURCE / "python" / "README.md").read_text(),
    long_description_content_type="text/markdown",
    license="MIT",
    python_requires=">=3.9",
    install_requires=["numpy"],
    package_dir={"": os.path.relpath(SOURCE / "python" / "src", HERE)},
    packages=["sikku", "sikku.lib"],
    package_data={"sikku": ["outputs.pyi", "py.typed"], "sikku.lib": ["_core.pyi"]},
    ext_modules=[Extension("sikku.lib._core", sources=[])],
    cmdclass={"build_ext": CMakeBuild, "sdist": SourceDistribution},
    zip_safe=False,
    options={"build": {"build_base": str(build_folder() / "setuptools")}},
)
