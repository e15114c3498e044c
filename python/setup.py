"""Builds the package with CMake: `pip install ./python`, or, with the tools already installed in the environment,
`pip install --no-build-isolation --no-index ./python`, which needs no network.

There is no pyproject.toml, because pip would download setuptools for it.
"""

import os
import re
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

SOURCE = Path(__file__).resolve().parent.parent
# SIKKU_BUILD can name an existing CMake build folder to use instead.
BUILD = SOURCE / "build" / f"pip-{sys.implementation.cache_tag}"


class CMakeBuild(build_ext):
    """Installs the module, the image module and the patterns in the layout of an installation."""

    def build_extension(self, ext: Extension) -> None:
        build = Path(os.environ.get("SIKKU_BUILD", BUILD))
        package = Path(self.get_ext_fullpath(ext.name)).resolve().parent.parent
        jobs = os.environ.get("CMAKE_BUILD_PARALLEL_LEVEL", str(os.cpu_count() or 1))
        configure = [
            "cmake", "-S", str(SOURCE), "-B", str(build), "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
            "-DCMAKE_INSTALL_BINDIR=bin", "-DCMAKE_INSTALL_LIBDIR=lib", "-DCMAKE_INSTALL_DATADIR=share",
            "-DSIKKU_PYTHON=ON", "-DSIKKU_TESTS=OFF", f"-DPython_EXECUTABLE={sys.executable}",
        ]
        # Written last: absent if configuring failed before.
        if not (build / "build.ninja").exists():
            subprocess.run(configure, check=True)
        subprocess.run(
            ["cmake", "--build", str(build), "--target", "sikku_python", "--parallel", jobs], check=True
        )
        subprocess.run(
            ["cmake", "--install", str(build), "--component", "python", "--strip", "--prefix", str(package)],
            check=True,
        )


def version() -> str:
    found = re.search(r"project\(sikku VERSION ([0-9.]+)", (SOURCE / "CMakeLists.txt").read_text())
    assert found
    return found[1]


setup(
    name="sikku",
    version=version(),
    description="L-systems: kolams, tilings, plants and music",
    license="MIT",
    python_requires=">=3.9",
    install_requires=["numpy"],
    package_dir={"": "src"},
    packages=["sikku", "sikku.lib"],
    package_data={"sikku": ["py.typed"], "sikku.lib": ["_core.pyi"]},
    ext_modules=[Extension("sikku.lib._core", sources=[])],
    cmdclass={"build_ext": CMakeBuild},
    zip_safe=False,
    options={"build": {"build_base": str(BUILD / "setuptools")}},
)
