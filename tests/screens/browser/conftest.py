import pytest


@pytest.fixture(scope="session")
def chromium():
    """One browser for all tests of a worker."""
    from tests.screens.browser.driving import start_chromium

    driver = start_chromium()
    yield driver
    driver.quit()


@pytest.fixture
def stage():
    """An empty world and its page."""
    from tests.screens.browser.stage import Stage

    with Stage() as stage:
        yield stage
