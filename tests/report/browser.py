# SPDX-License-Identifier: BSD-3-Clause
"""A headless Chromium controlled through a pipe: pages at a given width, their console output,
pixels, values."""
import base64
import json
import os
import shutil
import subprocess
import tempfile
import time

WRONG = ("error", "warning", "assert")  # kinds of console messages
NAMES = ("chromium", "chromium-browser", "google-chrome")
OPTIONS = ("--headless", "--no-sandbox", "--disable-dev-shm-usage", "--use-gl=angle",
           "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist",
           "--disable-background-networking", "--disable-extensions", "--hide-scrollbars",
           "--remote-debugging-pipe")


def program():
    """The installed Chromium, or None."""
    return next((path for path in map(shutil.which, NAMES) if path), None)


class Browser:
    """with Browser() as browser: page = browser.open(path, width)"""
    def __init__(self, seconds=120):
        self.seconds, self.number, self.events = seconds, 0, []

    def __enter__(self):
        self.profile = tempfile.mkdtemp(prefix="report_browser_")
        to_read, self.write = os.pipe()
        self.read, to_write = os.pipe()
        # Chromium reads commands from descriptor 3 and writes answers to 4. Our own descriptors may
        # have these numbers and are therefore moved first.
        moved = [os.dup(descriptor) for descriptor in (to_read, to_write)]
        while min(moved) <= 4:
            moved = [os.dup(descriptor) for descriptor in moved]

        def descriptors():
            os.dup2(moved[0], 3)
            os.dup2(moved[1], 4)

        self.process = subprocess.Popen(
            [program(), *OPTIONS, f"--user-data-dir={self.profile}", "about:blank"],
            stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
            preexec_fn=descriptors, close_fds=False)
        for descriptor in (to_read, to_write, *moved):
            os.close(descriptor)
        self.left = b""
        target = self.call("Target.createTarget", url="about:blank")["targetId"]
        self.session = self.call("Target.attachToTarget", targetId=target,
                                 flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.call(f"{domain}.enable")
        return self

    def __exit__(self, *_):
        self.process.terminate()
        self.process.wait(timeout=30)
        os.close(self.read), os.close(self.write)
        shutil.rmtree(self.profile, ignore_errors=True)

    def message(self, until):
        while b"\0" not in self.left:
            if time.monotonic() > until:
                raise TimeoutError("Chromium does not answer")
            more = os.read(self.read, 1 << 20)
            if not more:
                raise RuntimeError("Chromium has ended")
            self.left += more
        line, _, self.left = self.left.partition(b"\0")
        return json.loads(line)

    def call(self, method, **parameters):
        self.number += 1
        request = {"id": self.number, "method": method, "params": parameters}
        if hasattr(self, "session"):
            request["sessionId"] = self.session
        os.write(self.write, json.dumps(request).encode() + b"\0")
        until = time.monotonic() + self.seconds
        while True:
            answer = self.message(until)
            if answer.get("id") == self.number:
                if "error" in answer:
                    raise RuntimeError(f"{method}: {answer['error']['message']}")
                return answer["result"]
            self.events.append(answer)

    def open(self, path, width, height=900):
        """Loads a file; faults() contains the console output of the page from then on."""
        self.events = []
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height,
                  deviceScaleFactor=1, mobile=False)
        self.call("Page.navigate", url=path.resolve().as_uri())
        until = time.monotonic() + self.seconds
        while not any(event.get("method") == "Page.loadEventFired" for event in self.events):
            self.events.append(self.message(until))
        return self

    def value(self, expression):
        """Value of a JavaScript expression in the page; promises are awaited."""
        result = self.call("Runtime.evaluate", expression=expression, returnByValue=True,
                           awaitPromise=True)
        if "exceptionDetails" in result:
            raise RuntimeError(result["exceptionDetails"]["exception"].get(
                "description", expression))
        return result["result"].get("value")

    def faults(self):
        """Errors and warnings of the console, exceptions, and requests other than the file
        itself."""
        found = []
        for event in self.events:
            method, what = event.get("method"), event.get("params", {})
            if method == "Runtime.exceptionThrown":
                thrown = what["exceptionDetails"].get("exception", {})
                found.append(thrown.get("description", "exception"))
            elif method == "Runtime.consoleAPICalled" and what["type"] in WRONG:
                found.append(" ".join(
                    str(argument.get("value", argument.get("description", "")))
                    for argument in what["args"]))
            elif method == "Log.entryAdded" and what["entry"]["level"] == "error":
                found.append(what["entry"]["text"])
            elif method == "Network.requestWillBeSent" and not what["request"]["url"].startswith(
                ("file:", "data:", "blob:")):
                found.append("request of " + what["request"]["url"])
        return found

    def picture(self, path, whole=False, media=None, element=None):
        """A screenshot as PNG, of the window, the whole page, or all elements of a selector."""
        if media:
            self.call("Emulation.setEmulatedMedia", media=media)
        clip = {}
        if element:
            box = self.value(f"""(() => {{
                const found = [...document.querySelectorAll({json.dumps(element)})];
                const boxes = found.map((one) => one.getBoundingClientRect());
                const left = Math.min(...boxes.map((b) => b.left));
                const top = Math.min(...boxes.map((b) => b.top));
                return {{x: left + scrollX, y: top + scrollY,
                         width: Math.max(...boxes.map((b) => b.right)) - left,
                         height: Math.max(...boxes.map((b) => b.bottom)) - top}};
            }})()""")
            clip = {"clip": {**box, "scale": 1}}
        shot = self.call("Page.captureScreenshot", format="png", captureBeyondViewport=whole
                         or bool(element), **clip)
        path.write_bytes(base64.b64decode(shot["data"]))
