#!/usr/bin/env python3
"""Writes `sikku-VERSION.spdx.json`, which lists what the artefacts of a release contain and depend on (SPDX 2.3).

usage: packaging/sbom.py FOLDER BUILD_FOLDER

FOLDER has the artefacts; BUILD_FOLDER the program and the modules that the Debian packages contain.
"""

import datetime
import hashlib
import json
import os
import re
import subprocess
import sys
import tarfile
import zipfile
from pathlib import Path

from components import BOOST, LIBRARY_HEADERS, MODULE_HEADERS, PROGRAM_HEADERS, Component, of_libraries, of_packages, query

NAMESPACE = "https://sikku.example/spdx"


def direct_libraries(files: list[Path]) -> list[str]:
    """Paths of the libraries, except the C library, that files are linked with directly."""
    named = set()
    for file in files:
        headers = subprocess.run(["objdump", "-p", file], check=True, capture_output=True, text=True).stdout
        named.update(re.findall(r"NEEDED +(\S+)", headers))
    by_name = {}
    for file in files:
        for line in subprocess.run(["ldd", file], check=True, capture_output=True, text=True).stdout.splitlines():
            name, arrow, rest = line.strip().partition(" => ")
            if arrow and name in named and not re.match(r"(libc|libm|libdl|libpthread|librt)\.so", name):
                by_name[name] = os.path.realpath(rest.split(" ")[0])
    return sorted(by_name.values())


def listed(text: str) -> list[Component]:
    return [Component(*line.split("\t")) for line in text.splitlines()]


# Debian packages of the C++ libraries in WebAssembly, by their names in studio/notices.mjs.
WEB = {
    "Boost": BOOST, "GLM": "libglm-dev", "fmt": "libfmt-dev", "nlohmann/json": "nlohmann-json3-dev",
    "fast_float": "libfast-float-dev", "toml++": "libtomlplusplus-dev",
    "Emscripten": "emscripten", "musl": "emscripten", "libc++, libc++abi": "emscripten",
}  # fmt: skip


def of_notices(notices: list[dict[str, str]]) -> list[Component]:
    return [
        Component(each["name"], each["version"] or query(WEB[each["name"]], "source:Version"), each["licence"])
        for each in notices
    ]


def contained(artefact: Path) -> list[Component]:
    """Components inside an artefact that lists them itself."""
    if artefact.suffix == ".whl":
        with zipfile.ZipFile(artefact) as archive:
            name = next(each for each in archive.namelist() if each.endswith("components.tsv"))
            return listed(archive.read(name).decode())
    if artefact.suffix == ".vsix":
        with zipfile.ZipFile(artefact) as archive:
            text = archive.read("extension/dist/NOTICES.txt").decode()
        # As packaging/editors/vscode/build.mjs writes it: `semver 7.8.6 (ISC)`, and the licence.
        heads = [notice.partition("\n")[0] for notice in text.split("\n" + "-" * 80 + "\n\n")]
        return [Component(*head.rstrip(")").replace("(", "").split(" ", 2)) for head in heads]
    with tarfile.open(artefact) as archive:
        for member in archive:
            if member.name.endswith(("components.tsv", "NOTICES.json")):
                file = archive.extractfile(member)
                assert file
                text = file.read().decode()
                return listed(text) if member.name.endswith(".tsv") else of_notices(json.loads(text))
    return []


def identifier(text: str) -> str:
    return "SPDXRef-" + re.sub(r"[^A-Za-z0-9.-]", "-", text)


def main(folder: Path, build: Path) -> None:
    modules = list(build.glob("lib*/sikku/*"))
    program = [build / "bin/sikku"]
    python = list(build.glob("python/sikku/lib/_core.*.so"))
    script = "import { notices } from './notices.mjs'; console.log(JSON.stringify(notices('node_modules')))"
    answer = subprocess.run(["node", "--input-type=module", "-e", script], check=True, capture_output=True, cwd="studio")
    page = of_notices(json.loads(answer.stdout))
    known = re.compile(r"(sikku|libsikku-dev|python3-sikku|sikku-studio)[-_].*\.(deb|tar\.gz|whl|html)|sikku-.*\.(tgz|vsix)")
    artefacts = sorted(folder.iterdir())
    for artefact in artefacts:
        if not known.fullmatch(artefact.name):
            raise SystemExit(f"packaging/sbom.py: {artefact} is not an artefact of a release")
    version = re.search(r"project\(sikku VERSION ([0-9.]+)", Path("CMakeLists.txt").read_text())
    assert version

    packages: dict[str, dict[str, object]] = {}
    relationships = []

    def add(component: Component) -> str:
        key = identifier(f"{component.name}-{component.version}")
        packages[key] = {
            "SPDXID": key, "name": component.name, "versionInfo": component.version or "NOASSERTION",
            "downloadLocation": "NOASSERTION", "filesAnalyzed": False,
            "licenseConcluded": component.licence, "licenseDeclared": component.licence,
            "copyrightText": "NOASSERTION",
        }  # fmt: skip
        return key

    for artefact in artefacts:
        key = identifier(artefact.name)
        packages[key] = {
            "SPDXID": key, "name": artefact.name, "versionInfo": version[1], "packageFileName": artefact.name,
            "downloadLocation": "NOASSERTION", "filesAnalyzed": False,
            "licenseDeclared": "MIT", "copyrightText": "NOASSERTION",
            "checksums": [{"algorithm": "SHA256", "checksumValue": hashlib.sha256(artefact.read_bytes()).hexdigest()}],
        }  # fmt: skip
        relationships.append(("SPDXRef-DOCUMENT", "DESCRIBES", key))
        inside: list[Component] = []
        needed: list[Component] = []
        if artefact.name.startswith(("sikku-studio_", "sikku-studio-")):
            inside = page
        elif artefact.name.startswith("sikku_"):
            inside = of_packages(PROGRAM_HEADERS)
            needed = of_libraries(direct_libraries(program + modules))
        elif artefact.name.startswith("python3-"):
            inside = of_packages(MODULE_HEADERS)
            needed = of_libraries(direct_libraries(python))
        elif artefact.name.startswith("libsikku-dev_"):
            inside = of_packages(LIBRARY_HEADERS)
            needed = of_packages(["libfmt-dev", "libtbb-dev", "zlib1g-dev", "libpugixml-dev", "libglm-dev"])
        else:
            inside = contained(artefact)
            if "-linux-" in artefact.name and artefact.suffix == ".gz":
                inside += page
            if artefact.suffix == ".whl":
                needed = of_libraries(direct_libraries(modules))
        licences = sorted({component.licence for component in inside} - {"MIT"})
        packages[key]["licenseConcluded"] = " AND ".join(
            ["MIT", *(f"({licence})" if " " in licence else licence for licence in licences)]
        )
        for component in inside:
            relationships.append((key, "CONTAINS", add(component)))
        for component in needed:
            if (component.name, component.version) not in {(each.name, each.version) for each in inside}:
                relationships.append((key, "DEPENDS_ON", add(component)))

    seconds = int(os.environ.get("SOURCE_DATE_EPOCH", "0"))
    created = datetime.datetime.fromtimestamp(seconds, datetime.timezone.utc).strftime("%Y-%m-%dT%H:%M:%SZ")
    document = {
        "spdxVersion": "SPDX-2.3", "dataLicense": "CC0-1.0", "SPDXID": "SPDXRef-DOCUMENT",
        "name": f"sikku-{version[1]}", "documentNamespace": f"{NAMESPACE}/{version[1]}-{seconds}",
        "creationInfo": {"created": created, "creators": ["Tool: packaging/sbom.py"]},
        "hasExtractedLicensingInfos": [
            {"licenseId": "LicenseRef-public-domain", "extractedText": "This code has been placed in the public domain."}
        ],
        "packages": [packages[key] for key in sorted(packages)],
        "relationships": [
            {"spdxElementId": one, "relationshipType": kind, "relatedSpdxElement": other}
            for one, kind, other in sorted(set(relationships))
        ],
    }  # fmt: skip
    (folder / f"sikku-{version[1]}.spdx.json").write_text(json.dumps(document, indent=1) + "\n")


if len(sys.argv) != 3:
    sys.exit(__doc__)
main(Path(sys.argv[1]), Path(sys.argv[2]))
