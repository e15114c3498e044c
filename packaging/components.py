"""What Sikku's artefacts contain of others: Debian packages by the libraries that come from them, with their licences."""

import subprocess
from dataclasses import dataclass
from pathlib import Path

# Licences of the libraries themselves as SPDX expressions, by source package. Debian's copyright files also list those
# of tests, tools and packaging, which no artefact contains.
LICENCES = {
    "alsa-lib": "LGPL-2.1-or-later",
    "boost1.74": "BSL-1.0",
    "brotli": "MIT",
    "cli11": "BSD-3-Clause",
    "expat": "MIT",
    "fmtlib": "MIT",
    "fontconfig": "HPND-sell-variant",
    "freetype": "FTL OR GPL-2.0-or-later",
    "fribidi": "LGPL-2.1-or-later",
    "gcc-12": "GPL-3.0-or-later WITH GCC-exception-3.1",
    "glib2.0": "LGPL-2.1-or-later",
    "glm": "MIT",
    "graphite2": "LGPL-2.1-or-later OR MPL-1.1 OR GPL-2.0-or-later",
    "harfbuzz": "MIT-Modern-Variant",
    "imath": "BSD-3-Clause",
    "jbigkit": "GPL-2.0-or-later",
    "lcms2": "MIT",
    "lerc": "Apache-2.0",
    "libdeflate": "MIT",
    "libheif": "LGPL-3.0-or-later",
    "libjpeg-turbo": "IJG AND BSD-3-Clause AND Zlib",
    "liblo": "LGPL-2.1-or-later",
    "libpng1.6": "libpng-2.0",
    "libwebp": "BSD-3-Clause",
    "libzstd": "BSD-3-Clause OR GPL-2.0-only",
    "nlohmann-json3": "MIT",
    "onetbb": "Apache-2.0",
    "openexr": "BSD-3-Clause",
    "openimageio": "Apache-2.0",
    "pcre2": "BSD-3-Clause",
    "pugixml": "MIT",
    "pybind11": "BSD-3-Clause",
    "robin-map": "MIT",
    "tiff": "libtiff",
    "tomlplusplus": "MIT",
    "xz-utils": "LicenseRef-public-domain",
    "zlib": "Zlib",
}

def query(package: str, field: str) -> str:
    return subprocess.run(
        ["dpkg-query", "-W", "-f", f"${{{field}}}", package], check=True, capture_output=True, text=True
    ).stdout


# Header-only libraries, which are compiled in. libboost-dev is empty and depends on the package with the headers.
BOOST = query("libboost-dev", "Depends").split(" ")[0]
LIBRARY_HEADERS = [BOOST, "libglm-dev", "libtomlplusplus-dev", "nlohmann-json3-dev"]
PROGRAM_HEADERS = [*LIBRARY_HEADERS, "libcli11-dev"]
MODULE_HEADERS = [*LIBRARY_HEADERS, "pybind11-dev"]  # of the Python module


@dataclass(frozen=True, order=True)
class Component:
    name: str  # of the source package
    version: str
    licence: str  # SPDX expression
    text: str = ""  # copyright notices and licences in full


def of_package(package: str) -> Component:
    """The component that an installed Debian package is part of. Raises SystemExit if its licence is unknown."""
    source = query(package, "source:Package")
    if source not in LICENCES:
        raise SystemExit(f"packaging/components.py: the licence of {source} is missing")
    text = Path(f"/usr/share/doc/{package.split(':')[0]}/copyright").read_text(errors="replace")
    return Component(source, query(package, "source:Version"), LICENCES[source], text)


def of_library(path: str) -> Component:
    """The component that an installed file is part of."""
    # Packages of before /lib became a link to /usr/lib list their files there.
    for name in [path, path.removeprefix("/usr")]:
        found = subprocess.run(["dpkg", "-S", name], capture_output=True, text=True)
        if found.returncode == 0:
            return of_package(found.stdout.split(": ")[0].split(", ")[0])
    raise SystemExit(f"no Debian package contains {path}")


def of_packages(packages: list[str]) -> list[Component]:
    return sorted({of_package(package) for package in packages})


def of_libraries(paths: list[str], slim: Path | None = None) -> list[Component]:
    """Components that shared libraries come from.

    slim: a folder with an OpenImageIO of our own, from which some of the paths are
    """
    found = set()
    for path in paths:
        if slim and slim.resolve() in Path(path).parents:
            texts = [(slim / name).read_text() for name in ("LICENSE.md", "THIRD-PARTY.md")]
            version = (slim / "version").read_text().strip()
            found.add(Component("openimageio", version, LICENCES["openimageio"], "\n\n".join(texts)))
            found.add(of_package("robin-map-dev"))  # compiled into it
        else:
            found.add(of_library(path))
    return sorted(found)
