"""Chromium for the tests of pages: widths of a desk and of a phone, light and dark."""
import base64
import os
import time

CHROMIUM, DRIVER = "/usr/bin/chromium", "/usr/bin/chromedriver"
FLAGS = ["--headless", "--no-sandbox", "--disable-quic", "--no-first-run", "--disable-background-networking",
         "--disable-component-update", "--disable-sync", "--disable-gpu-rasterization", "--disable-accelerated-2d-canvas",
         "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
         "--disable-dev-shm-usage", "--window-size=1280,900"]
WIDTHS = {"desk": 1280, "phone": 390}
MODES = ("light", "dark")
WAIT_S = 60  # software rendering beside other work; nothing here measures time
HERE = os.path.dirname(os.path.abspath(__file__))


def is_there():
    """Selenium, Chromium and its driver are installed."""
    try:
        import selenium  # noqa: F401
    except ImportError:
        return False
    return os.path.exists(CHROMIUM) and os.path.exists(DRIVER)


def text_of(name):
    with open(os.path.join(HERE, name), encoding="utf-8") as file:
        return file.read()


class Browser:
    """Keeps its profile in `folder`."""

    def __init__(self, folder):
        from selenium import webdriver
        from selenium.webdriver.chrome.service import Service
        options = webdriver.ChromeOptions()
        options.binary_location = CHROMIUM
        for flag in FLAGS + ["--user-data-dir=" + os.path.join(folder, "profile")]:
            options.add_argument(flag)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
        self.driver = webdriver.Chrome(service=Service(DRIVER), options=options)
        self.driver.execute_cdp_cmd("Page.addScriptToEvaluateOnNewDocument", {"source": text_of("text_log.js")})

    def close(self):
        self.driver.quit()

    def open(self, path, width, mode, address=""):
        """Opens the page and waits until its last script has run."""
        self.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {
            "width": WIDTHS[width], "height": 844, "deviceScaleFactor": 1, "mobile": width == "phone"})
        self.driver.execute_cdp_cmd("Emulation.setEmulatedMedia",
                                    {"features": [{"name": "prefers-color-scheme", "value": mode}]})
        self.driver.get("about:blank")
        self.driver.get_log("browser")
        self.driver.get("file://" + path + address)
        until = time.monotonic() + WAIT_S
        while not self.js("return document.body.dataset.ready === 'yes'"):
            if time.monotonic() > until:
                raise AssertionError(f"{path}: the page's last script has not ended")
            time.sleep(0.05)
        # Two pictures later all that watches sizes has done its work.
        self.driver.execute_async_script("const done = arguments[0]; requestAnimationFrame(() => requestAnimationFrame(() => done()))")

    def js(self, script, *args):
        return self.driver.execute_script(script, *args)

    def problems(self):
        return self.js("return eval(arguments[0])", text_of("page_check.js"))

    def complaints(self):
        """What the console says, without warnings that are due to the software renderer and to text_log.js."""
        return [entry["message"] for entry in self.driver.get_log("browser")
                if entry["level"] in ("SEVERE", "WARNING") and not any(known in entry["message"] for known in ("GPU stall", "willReadFrequently"))]

    def save_screenshot(self, path):
        """Writes the whole page as PNG."""
        size = self.js("const e = document.documentElement; return [e.clientWidth, e.scrollHeight]")
        clip = {"x": 0, "y": 0, "width": size[0], "height": min(size[1], 8000), "scale": 1}
        picture = self.driver.execute_cdp_cmd("Page.captureScreenshot", {"captureBeyondViewport": True, "clip": clip})
        with open(path, "wb") as file:
            file.write(base64.b64decode(picture["data"]))
