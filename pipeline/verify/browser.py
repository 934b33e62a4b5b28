"""A headless Chromium that a script drives: the DevTools protocol over two pipes, standard library only."""

import base64
import contextlib
import json
import os
import pathlib
import shutil
import subprocess
import tempfile
import time

# Software rendering, the same on every machine.
FLAGS = ["--headless=new", "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-dev-shm-usage",
         "--hide-scrollbars", "--no-first-run", "--disable-extensions", "--remote-debugging-pipe", "--remote-debugging-io-pipes=3,4"]


def there():
    return shutil.which("chromium") is not None


class Browser:
    """One page. `complaints` holds every error and warning of its console."""

    def __init__(self, width=1000, height=800, flags=()):
        self.folder = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        to_browser, self.write = os.pipe()
        self.read, from_browser = os.pipe()
        # The pipes are 3 and 4 there; taken from high numbers, so that neither is closed by the other's taking its place.
        ends = [os.dup2(to_browser, 103), os.dup2(from_browser, 104)]
        self.process = subprocess.Popen(["bash", "-c", 'exec 3<&103 4>&104 103<&- 104>&-; exec chromium "$@"', "chromium", *FLAGS, *flags,
                                         f"--user-data-dir={self.folder.name}", f"--window-size={width},{height}", "about:blank"],
                                        pass_fds=ends, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        for end in (to_browser, from_browser, *ends):
            os.close(end)
        self.number, self.rest, self.session, self.complaints = 0, b"", None, []
        target = next(t for t in self.ask("Target.getTargets")["targetInfos"] if t["type"] == "page")
        self.session = self.ask("Target.attachToTarget", targetId=target["targetId"], flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log"):
            self.ask(f"{domain}.enable")

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.terminate()
        self.process.wait(20)
        os.close(self.write)
        os.close(self.read)
        self.folder.cleanup()

    def cpu_seconds(self):
        """Of the browser and all processes that it started."""
        stat = {}
        for path in pathlib.Path("/proc").glob("[0-9]*/stat"):
            with contextlib.suppress(OSError):
                fields = path.read_text().rpartition(") ")[2].split()
                stat[int(path.parent.name)] = int(fields[1]), int(fields[11]) + int(fields[12])
        family, grown = {self.process.pid}, True
        while grown:
            more = {pid for pid, (parent, _) in stat.items() if parent in family} - family
            family, grown = family | more, bool(more)
        return sum(stat[pid][1] for pid in family if pid in stat) / os.sysconf("SC_CLK_TCK")

    def receive(self):
        while b"\0" not in self.rest:
            got = os.read(self.read, 1 << 20)
            if not got:
                raise RuntimeError("the browser has ended")
            self.rest += got
        text, self.rest = self.rest.split(b"\0", 1)
        message = json.loads(text)
        what, about = message.get("method"), message.get("params", {})
        if what == "Runtime.exceptionThrown":
            self.complaints.append(about["exceptionDetails"].get("exception", {}).get("description") or about["exceptionDetails"]["text"])
        elif what == "Runtime.consoleAPICalled" and about["type"] in ("error", "warning", "assert"):
            self.complaints.append(" ".join(str(a.get("value", a.get("description"))) for a in about["args"]))
        elif what == "Log.entryAdded" and about["entry"]["level"] in ("error", "warning"):
            self.complaints.append(about["entry"]["text"])
        return message

    def ask(self, method, **parameters):
        self.number += 1
        message = {"id": self.number, "method": method, "params": parameters} | ({"sessionId": self.session} if self.session else {})
        os.write(self.write, json.dumps(message).encode() + b"\0")
        while (answer := self.receive()).get("id") != self.number:
            pass
        if "error" in answer:
            raise RuntimeError(f"{method}: {answer['error']['message']}")
        return answer["result"]

    def js(self, expression):
        answer = self.ask("Runtime.evaluate", expression=expression, returnByValue=True, awaitPromise=True)
        if "exceptionDetails" in answer:
            raise RuntimeError(answer["exceptionDetails"].get("exception", {}).get("description", "exception"))
        return answer["result"].get("value")

    def until(self, expression, seconds=60):
        end = time.monotonic() + seconds
        while not self.js(expression):
            if time.monotonic() > end:
                return False
            time.sleep(0.05)
        return True

    def open(self, path, ready="document.documentElement.dataset.view === 'ready' || document.querySelector('.without') !== null"):
        self.ask("Page.navigate", url=pathlib.Path(path).resolve().as_uri())
        return self.until(f"location.protocol === 'file:' && document.readyState === 'complete' && ({ready})")

    def key(self, key, code=None):
        virtual = {"ArrowLeft": 37, "ArrowUp": 38, "ArrowRight": 39, "ArrowDown": 40, "Home": 36, " ": 32, "Tab": 9}.get(key, ord(key[0].upper()))
        text = {"text": key} if len(key) == 1 else {}
        for kind in ("keyDown", "keyUp"):
            self.ask("Input.dispatchKeyEvent", type=kind, key=key, code=code or key, windowsVirtualKeyCode=virtual, **(text if kind == "keyDown" else {}))

    def mouse(self, *kind_x_y):
        for kind, x, y in kind_x_y:
            self.ask("Input.dispatchMouseEvent", type=f"mouse{kind}", x=x, y=y, button="left", buttons=0 if kind == "Released" else 1, clickCount=1)

    def wheel(self, x, y, delta):
        self.ask("Input.dispatchMouseEvent", type="mouseWheel", x=x, y=y, deltaX=0, deltaY=delta)

    def resize(self, width, height, mobile=False):
        self.ask("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=mobile)

    def screenshot(self, path):
        pathlib.Path(path).write_bytes(base64.b64decode(self.ask("Page.captureScreenshot", format="png")["data"]))

    def pdf(self, path):
        pathlib.Path(path).write_bytes(base64.b64decode(self.ask("Page.printToPDF", printBackground=True)["data"]))
