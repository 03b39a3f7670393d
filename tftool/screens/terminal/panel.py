"""The pieces the terminal app is made of: panels of lines, and their colours."""

from rich.segment import Segment
from rich.text import Text
from textual.geometry import Region
from textual.strip import Strip
from textual.theme import Theme
from textual.widget import Widget

from tftool.drawing import theme


class Panel(Widget):
    """Lines of text that repaints only those that changed."""

    def __init__(self, name: str, title: str = "", *, can_focus: bool = True) -> None:
        super().__init__(id=name)
        self.can_focus = can_focus
        self._title = title
        self._strips: list[Strip] = []

    def on_mount(self) -> None:
        """Stand under its title."""
        if self._title:
            self.border_title = self._title

    def show(self, lines: list[Text] | list[list[Segment]]) -> None:
        """Show these lines from now on."""
        width, height = self.size
        strips = [
            Strip(line.render(self.app.console, end="") if isinstance(line, Text) else line)
            for line in lines[:height]
        ]
        ground = self.rich_style
        strips = [strip.adjust_cell_length(width).apply_style(ground) for strip in strips]
        before, self._strips = self._strips, strips
        for y in range(max(len(before), len(strips))):
            if y >= len(before) or y >= len(strips) or before[y] != strips[y]:
                self.refresh(Region(0, y, width, 1))

    def render_line(self, y: int) -> Strip:
        """Give one line to textual."""
        if y < len(self._strips):
            return self._strips[y]
        return Strip.blank(self.size.width, self.rich_style)


def themes() -> list[Theme]:
    """Give `theme`'s two palettes to textual, as tftool-dark and tftool-light."""
    return [
        Theme(
            name=name,
            primary=theme.hexadecimal(palette.accent),
            accent=theme.hexadecimal(palette.accent),
            foreground=theme.hexadecimal(palette.text),
            background=theme.hexadecimal(palette.ground),
            surface=theme.hexadecimal(palette.panel),
            panel=theme.hexadecimal(palette.panel),
            secondary=theme.hexadecimal(theme.blend(palette.ground, palette.dim, 0.6)),
            dark=palette is theme.DARK,
        )
        for name, palette in (("tftool-dark", theme.DARK), ("tftool-light", theme.LIGHT))
    ]
