"""A real browser, and the page in it as a person uses it."""

import shutil

from selenium import webdriver
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.ui import WebDriverWait

from tests.patience import PATIENCE

CHROMIUM = shutil.which("chromium")
CHROMEDRIVER = shutil.which("chromedriver")

FLAGS = [
    "--headless=new",
    "--no-sandbox",  # Chromium needs this as root in a container
    "--disable-dev-shm-usage",
    "--use-angle=swiftshader",  # draws three.js without a graphics card
    "--enable-unsafe-swiftshader",
    "--disable-gpu",
    "--window-size=1280,800",
    "--hide-scrollbars",
    # Windows draw even if another window covers them.
    "--disable-backgrounding-occluded-windows",
    "--disable-renderer-backgrounding",
    # The browser contacts only the page's own server.
    "--disable-background-networking",
    "--disable-component-update",
    # Between two pages, Chromium may not recognise 127.0.0.1 as the same machine; and it would
    # keep the pages of earlier tests.
    "--disable-features=LocalNetworkAccessChecks,BackForwardCache",
    # A page starts sooner in the process of the page before.
    "--renderer-process-limit=1",
    "--disable-quic",
    "--disable-sync",
    "--no-first-run",
]


def start_chromium():
    """Start a browser without a window; the caller ends it."""
    options = webdriver.ChromeOptions()
    options.binary_location = CHROMIUM
    for flag in FLAGS:
        options.add_argument(flag)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    driver = webdriver.Chrome(options=options, service=Service(CHROMEDRIVER))
    driver.set_script_timeout(PATIENCE)
    return driver


class Page:
    """The page as a person uses it."""

    def __init__(self, driver, stage, state="", *, patient=True):
        self.driver = driver
        driver.get("about:blank")
        # Complaints of an earlier page do not count for this one.
        driver.get_log("browser")
        if patient and "timeout=" not in state:
            # On a busy machine, a test may last longer than frames without data are shown.
            state = f"{state}&timeout=1000".lstrip("&")
        driver.get(f"{stage.url}#{state}")

    def said(self, expression):
        """Return the value of an expression in the page."""
        return self.driver.execute_script(f"return {expression}")

    def until(self, condition):
        """Wait until `condition()` is true; return its value."""
        return WebDriverWait(self.driver, PATIENCE, poll_frequency=0.1).until(lambda _: condition())

    def find(self, selector):
        return self.driver.find_element(By.CSS_SELECTOR, selector)

    def texts(self, selector):
        script = "return [...document.querySelectorAll(arguments[0])].map(e => e.textContent)"
        return self.driver.execute_script(script, selector)

    def text(self, selector):
        return self.texts(selector)[0]

    def drawn(self):
        """Return the objects drawn in 3-D, by name: pose in the fixed frame, pixel and so on."""
        return {
            frame["name"]: frame for frame in self.driver.execute_script("return tftool.drawn()")
        }

    def x_of(self, name):
        return self.drawn().get(name, {}).get("pose", [None])[0]

    def row(self, name):
        rows = self.driver.find_elements(By.CSS_SELECTOR, "#tree .row")
        names = self.texts("#tree .name")
        return rows[names.index(name)]

    def pick(self, field, name):
        """Choose a frame as a person does: click the field, type, press Enter."""
        self.find(f"#{field}").click()
        self.find(f"#{field}").send_keys(name, Keys.ENTER)

    def scrub(self, moment):
        """Move the timeline's handle, as a pointer or the arrow keys do."""
        script = (
            "const line = document.getElementById('scrub'); line.value = arguments[0];"
            "line.dispatchEvent(new Event('input'))"
        )
        self.driver.execute_script(script, moment)

    def complaints(self):
        return [entry for entry in self.driver.get_log("browser") if entry["level"] == "SEVERE"]


class Resized:
    """Context manager that gives the window another size."""

    def __init__(self, driver, width, height):
        self.driver = driver
        self.size = {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": False}

    def __enter__(self):
        self.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", self.size)

    def __exit__(self, *error):
        self.driver.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})
