"""The site: `python -m sphinx -W docs SITE`, with the extra `docs`.

A directive prints from the program itself, so that a page cannot fall behind it: `{commands}` is
the help of every command.
"""

import contextlib
import io
import os
from pathlib import Path

from docutils import nodes
from docutils.parsers.rst import Directive
from sphinx.application import Sphinx

import tftool
from tftool.app.index import COMMANDS
from tftool.app.main import main

project = "tftool"
author = "the tftool maintainers"
release = tftool.__version__

extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.napoleon"]
myst_enable_extensions = ["attrs_inline", "colon_fence", "deflist"]
myst_heading_anchors = 3
exclude_patterns = ["requirements*"]

html_theme = "furo"
html_logo = html_favicon = "../tftool/screens/browser/page/icon.svg"
html_title = "tftool"
html_static_path = ["_static"]
html_css_files = ["site.css"]
html_show_sphinx = False
html_show_copyright = False
# Nothing is fetched from elsewhere: the theme's own fonts are the system's.
html_theme_options = {"top_of_page_buttons": []}
pygments_style = "friendly"
pygments_dark_style = "github-dark"

# Attributes of a class stand in its text; listed once more they would be there twice.
napoleon_use_ivar = True
autodoc_member_order = "bysource"
autodoc_typehints = "signature"
autodoc_typehints_format = "short"
python_use_unqualified_type_names = True
add_module_names = False
# Blocks of the pages carry marks of their own for the tests; they are shown as they stand.
highlight_language = "text"
suppress_warnings = ["misc.highlighting_failure"]


def _printed(*words: str) -> str:
    """What the command prints at 80 columns, without a terminal."""
    out = io.StringIO()
    os.environ["COLUMNS"] = "80"
    with contextlib.redirect_stdout(out):
        status = main(list(words))
    if status:
        raise RuntimeError(f"tftool {' '.join(words)} ended with {status}")
    return out.getvalue()


class EveryCommand(Directive):
    """A section for each command, in the order of `tftool --help`."""

    def run(self) -> list[nodes.Node]:
        """Give the sections."""
        sections: list[nodes.Node] = []
        for name in COMMANDS:
            section = nodes.section(ids=[f"tftool-{name}"], names=[f"tftool {name}"])
            self.state.document.note_explicit_target(section)
            section += nodes.title("", f"tftool {name}")
            text = _printed("help", name)
            section += nodes.literal_block(text, text, language="text")
            sections.append(section)
        return sections


def _write_scene(app: Sphinx) -> None:
    """Write the scene that the first page shows: the carrot scenario, as `view -o` writes it."""
    if app.builder.format == "html":
        scene = Path(app.outdir) / "carrot.html"
        scene.unlink(missing_ok=True)
        _printed("view", "carrot", "-o", str(scene))


def setup(app: Sphinx) -> None:
    """Add the directive, and the scene beside the pages."""
    app.add_directive("commands", EveryCommand)
    app.connect("builder-inited", _write_scene)
