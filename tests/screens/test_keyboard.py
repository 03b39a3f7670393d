"""Tests of keyboard bytes that are not valid text."""

import sys

from textual.driver import Driver

from tftool.screens.terminal.world_app import input_events, tolerant


class Broken:
    """Terminal driver that reads invalid UTF-8 once, and then nothing more."""

    def __init__(self):
        self.told = []
        self.rounds = 0

    def run_input_thread(self):
        self.rounds += 1
        if self.rounds == 1:
            b"a\xff\x1b[A".decode()

    def process_message(self, message):
        self.told.append(message.key)


def test_keys_beside_invalid_utf_8_bytes_are_kept():
    driver = tolerant(Broken)()

    driver.run_input_thread()

    assert (driver.told, driver.rounds) == (["a", "up"], 2)


def test_the_keys_are_read_on_where_textual_has_moved_its_parser(monkeypatch):
    monkeypatch.setitem(sys.modules, "textual._xterm_parser", None)
    driver = tolerant(Broken)()

    driver.run_input_thread()

    assert (driver.told, driver.rounds) == ([], 2)


def test_textual_has_its_parser_where_the_keyboard_looks_for_it():
    found = [event.key for event in input_events("q")]

    assert found == ["q"], "Textual moved XTermParser: mend screens/terminal/world_app.py"


def test_a_driver_that_decodes_nothing_stays_as_it_is():
    class Plain(Driver):
        pass

    assert tolerant(Plain) is Plain
