"""Recording with which most tests of edits begin."""

import pytest


@pytest.fixture
def mcap(tmp_path):
    from tests.recordings.edit.outcomes import SENT
    from tests.recordings.writers import write_mcap

    return write_mcap(tmp_path / "a.mcap", SENT)
