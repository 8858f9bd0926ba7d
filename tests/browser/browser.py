"""A headless Chromium, spoken to through its pipe in the DevTools protocol."""
import base64
import json
import os
import shutil
import subprocess
import tempfile
import time


def find():
    """The program, or None where none is installed."""
    return shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")


class Browser:
    """One page; `errors` are what its console complained of since it was opened."""

    def __init__(self):
        self.profile = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        to_browser, from_page = os.pipe()
        from_browser, to_page = os.pipe()

        def pipes():  # the browser reads commands from 3 and answers on 4
            os.dup2(to_browser, 60)
            os.dup2(to_page, 61)
            os.dup2(60, 3)
            os.dup2(61, 4)

        self.process = subprocess.Popen(
            [find(), "--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--hide-scrollbars",
             "--no-first-run", f"--user-data-dir={self.profile.name}", "--remote-debugging-pipe", "about:blank"],
            preexec_fn=pipes, close_fds=False, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(to_browser)
        os.close(to_page)
        self.write, self.read = from_page, from_browser
        self.left, self.number, self.session, self.errors, self.events = b"", 0, None, [], []
        target = next(t for t in self.call("Target.getTargets")["targetInfos"] if t["type"] == "page")
        self.session = self.call("Target.attachToTarget", targetId=target["targetId"], flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log"):
            self.call(domain + ".enable")

    def close(self):
        os.close(self.write)
        os.close(self.read)
        try:
            self.process.wait(10)
        except subprocess.TimeoutExpired:
            self.process.kill()
        self.profile.cleanup()

    def message(self):
        while b"\0" not in self.left:
            more = os.read(self.read, 1 << 16)
            if not more:
                raise RuntimeError("the browser is gone")
            self.left += more
        one, _, self.left = self.left.partition(b"\0")
        said = json.loads(one)
        if said.get("method") == "Runtime.exceptionThrown":
            detail = said["params"]["exceptionDetails"]
            self.errors.append(detail.get("exception", {}).get("description", detail["text"]))
        if said.get("method") == "Runtime.consoleAPICalled" and said["params"]["type"] in ("error", "warning"):
            self.errors.append(" ".join(str(a.get("value", a.get("description"))) for a in said["params"]["args"]))
        if said.get("method") == "Log.entryAdded" and said["params"]["entry"]["level"] == "error":
            self.errors.append(said["params"]["entry"]["text"])
        if "method" in said:
            self.events.append(said["method"])
        return said

    def call(self, method, **parameters):
        self.number += 1
        command = {"id": self.number, "method": method, "params": parameters}
        if self.session:
            command["sessionId"] = self.session
        os.write(self.write, json.dumps(command).encode() + b"\0")
        while True:
            said = self.message()
            if said.get("id") == self.number:
                if "error" in said:
                    raise RuntimeError(f"{method}: {said['error']['message']}")
                return said["result"]

    def size(self, width, height=900, dark=False, paper=False):
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False)
        self.call("Emulation.setEmulatedMedia", media="print" if paper else "",
                  features=[{"name": "prefers-color-scheme", "value": "dark" if dark else "light"}])

    def open(self, file):
        """Seconds until the page is loaded and its first screen drawn; the rest is, too, when this returns."""
        self.errors, self.events = [], []
        start = time.monotonic()
        self.call("Page.navigate", url="file://" + os.path.abspath(file))
        while "Page.loadEventFired" not in self.events:
            self.message()
        self.ask("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(() => done())))")
        seconds = time.monotonic() - start
        self.ask("typeof dovetail === 'undefined' || dovetail.ready")
        return seconds

    def ask(self, expression):
        """What a script in the page comes to."""
        answer = self.call("Runtime.evaluate", expression=expression, awaitPromise=True, returnByValue=True)
        if "exceptionDetails" in answer:
            raise RuntimeError(answer["exceptionDetails"].get("exception", {}).get("description", "a script failed"))
        return answer["result"].get("value")

    def settle(self):
        self.ask("new Promise(done => setTimeout(() => done(), 150))")

    def press(self, x, y):
        for kind in ("mouseMoved", "mousePressed", "mouseReleased"):
            self.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, button="none" if kind == "mouseMoved" else "left",
                      clickCount=0 if kind == "mouseMoved" else 1)
        self.settle()

    def drag(self, x, y, to_x, to_y):
        self.point(x, y)
        self.call("Input.dispatchMouseEvent", type="mousePressed", x=x, y=y, button="left", clickCount=1)
        for step in range(1, 6):
            self.call("Input.dispatchMouseEvent", type="mouseMoved", x=x + (to_x - x) * step / 5, y=y + (to_y - y) * step / 5,
                      button="left", buttons=1)
        self.call("Input.dispatchMouseEvent", type="mouseReleased", x=to_x, y=to_y, button="left", clickCount=1)
        self.settle()

    def point(self, x, y):
        self.call("Input.dispatchMouseEvent", type="mouseMoved", x=x, y=y)
        self.settle()

    def picture(self, file, whole=True):
        shot = self.call("Page.captureScreenshot", captureBeyondViewport=whole, format="png")
        with open(file, "wb") as out:
            out.write(base64.b64decode(shot["data"]))

    def paper(self, file=None):
        """The pages of the print, as a PDF; how many there are."""
        data = base64.b64decode(self.call("Page.printToPDF", preferCSSPageSize=True, printBackground=True)["data"])
        if file:
            with open(file, "wb") as out:
                out.write(data)
        return data.count(b"/Type /Page\n") or data.count(b"/Type /Page ")
