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
    "--no-sandbox",  # a container's root has no other choice
    "--disable-dev-shm-usage",
    "--use-angle=swiftshader",  # three.js draws without a graphics card
    "--enable-unsafe-swiftshader",
    "--disable-gpu",
    "--window-size=1280,800",
    "--hide-scrollbars",
    # Every window draws, whether or not another one lies over it.
    "--disable-backgrounding-occluded-windows",
    "--disable-renderer-backgrounding",
    # Nothing is asked of anybody but the page's own server.
    "--disable-background-networking",
    "--disable-component-update",
    # Between two pages Chromium may not know that 127.0.0.1 asks 127.0.0.1.
    "--disable-features=LocalNetworkAccessChecks",
    "--disable-quic",
    "--disable-sync",
    "--no-first-run",
]


def start_chromium():
    """A browser without a window; the caller quits it."""
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
        # What an earlier page complained of is not this one's.
        driver.get_log("browser")
        if patient and "timeout=" not in state:
            # On a busy machine a test may last longer than frames without data are shown.
            state = f"{state}&timeout=1000".lstrip("&")
        driver.get(f"{stage.url}#{state}")

    def said(self, expression):
        """The value of an expression in the page."""
        return self.driver.execute_script(f"return {expression}")

    def until(self, condition):
        """Wait until `condition()` holds; return what it gave."""
        return WebDriverWait(self.driver, PATIENCE, poll_frequency=0.02).until(
            lambda _: condition()
        )

    def find(self, selector):
        return self.driver.find_element(By.CSS_SELECTOR, selector)

    def texts(self, selector):
        script = "return [...document.querySelectorAll(arguments[0])].map(e => e.textContent)"
        return self.driver.execute_script(script, selector)

    def text(self, selector):
        return self.texts(selector)[0]

    def drawn(self):
        """What is drawn in 3-D, by name: pose in the fixed frame, pixel, arrow, fading."""
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
    """A window of another size, for as long as the block lasts."""

    def __init__(self, driver, width, height):
        self.driver = driver
        self.size = {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": False}

    def __enter__(self):
        self.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", self.size)

    def __exit__(self, *error):
        self.driver.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})
