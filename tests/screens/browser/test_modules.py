"""Tests of the page's modules that need no browser, run with node's test runner."""

import shutil
import subprocess
from pathlib import Path

import pytest

NODE = shutil.which("node")
MODULES = sorted((Path(__file__).parent / "page").glob("*.test.mjs"))


@pytest.mark.skipif(NODE is None, reason="node is not installed")
def test_the_pages_pure_modules_hold_what_their_own_tests_say():
    command = [NODE, "--test", "--test-reporter=tap", *map(str, MODULES)]
    ended = subprocess.run(command, capture_output=True, text=True, check=False)

    assert ended.returncode == 0, ended.stdout + ended.stderr
    assert "# fail 0\n" in ended.stdout
    assert "# pass 0\n" not in ended.stdout
