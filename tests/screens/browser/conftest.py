import pytest


@pytest.fixture(scope="session")
def browser():
    """Start one browser for all tests of a pytest worker."""
    from tests.screens.browser.driving import start_chromium

    driver = start_chromium()
    yield driver
    driver.quit()


@pytest.fixture
def chromium(browser):
    """Return the browser; afterwards it leaves the page, which would go on drawing."""
    yield browser
    browser.get("about:blank")


@pytest.fixture
def stage():
    """Create an empty world with its page."""
    from tests.screens.browser.stage import Stage

    with Stage() as stage:
        yield stage
