"""Tests that the shipped page is built from the sources beside it."""

import hashlib
import json
import re
import shutil
import subprocess
from pathlib import Path

import pytest

import tftool

# A wheel contains the bundle, but not the scripts from which it was built.
PAGE = Path(__file__).parents[3] / "tftool" / "screens" / "browser" / "page"
BUNDLE = Path(tftool.__file__).parent / "screens" / "browser" / "bundle"
REBUILD = "run `npm install --no-package-lock && npm run build` in tftool/screens/browser/page"
NPM = shutil.which("npm")


def test_the_bundle_was_built_from_these_scripts():
    # page/build.mjs writes the same digest to the bundle's first line.
    digest = hashlib.sha256()
    found = [*PAGE.iterdir(), *(PAGE / "displays").iterdir()]
    for name in sorted(source.relative_to(PAGE).as_posix() for source in found):
        if re.search(r"\.(m?js|json)$", name):
            digest.update(name.encode() + b"\0" + (PAGE / name).read_bytes() + b"\0")

    with (BUNDLE / "page.js").open(encoding="utf-8") as script:
        assert digest.hexdigest() in script.readline(), REBUILD


def npm(*words, cwd):
    return subprocess.run([NPM, *words], cwd=cwd, capture_output=True, text=True, check=False)


@pytest.mark.skipif(NPM is None, reason="npm is not installed")
def test_the_bundle_built_anew_is_the_one_shipped_and_its_types_hold(tmp_path):
    page = shutil.copytree(PAGE, tmp_path / "page", ignore=shutil.ignore_patterns("node_modules"))
    # An earlier download is good enough, because the versions are exact.
    fetched = npm("install", "--no-package-lock", "--no-audit", "--prefer-offline", cwd=page)
    if fetched.returncode:
        pytest.skip(
            "npm cannot fetch what the page is built with: " + fetched.stderr.strip()[-200:]
        )
    checked = npm("run", "check", cwd=page)
    built = npm("run", "build", cwd=page)

    assert checked.returncode == 0, checked.stdout
    assert built.returncode == 0, built.stderr
    for name in ("page.js", "three-LICENSE.txt"):
        same = (tmp_path / "bundle" / name).read_bytes() == (BUNDLE / name).read_bytes()
        assert same, f"{name}: {REBUILD}"


def test_versions_are_exact_and_the_licence_of_three_is_shipped():
    wanted = json.loads((PAGE / "package.json").read_text())["devDependencies"]

    assert all(re.fullmatch(r"\d+\.\d+\.\d+", version) for version in wanted.values())
    assert "three.js authors" in (BUNDLE / "three-LICENSE.txt").read_text(encoding="utf-8")
    script = (BUNDLE / "page.js").read_text(encoding="utf-8")
    assert "three-LICENSE.txt" in script.splitlines()[0]


def test_the_page_asks_nobody_else_for_anything():
    for name in ("index.html", "page.css"):
        assert not re.search(r"(?:src|href|url\(|@import)[^>]*?//", (PAGE / name).read_text())


def test_names_never_become_markup():
    for source in [*PAGE.glob("*.js"), *PAGE.glob("displays/*.js")]:
        text = source.read_text()
        assert not re.search(r"innerHTML|outerHTML|insertAdjacent|document\.write|eval\(", text)
