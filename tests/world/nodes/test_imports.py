import subprocess
import sys
from pathlib import Path

import tftool.world.nodes


def test_no_node_needs_numpy_or_a_screen_to_start():
    names = [path.stem for path in Path(tftool.world.nodes.__file__).parent.glob("*.py")]
    modules = ", ".join(f"tftool.world.nodes.{name}" for name in names if name != "__init__")
    code = (
        f"import sys, {modules}; print({{'numpy', 'textual', 'rich', 'zenoh'}} & set(sys.modules))"
    )
    done = subprocess.run(
        [sys.executable, "-c", code],
        capture_output=True,
        text=True,
        check=True,
        cwd=Path(tftool.__file__).parent.parent,
    )

    assert len(names) > 10
    assert done.stdout == "set()\n"
