#!/usr/bin/env python3
"""Opens a page in headless Chromium, asks it a question, and prints the answer as JSON.

    drive_page.py PAGE.html EXPRESSION [TIMEOUT_S]

EXPRESSION is JavaScript; a promise is waited for. Standard output holds
{"value": ..., "errors": [...], "requests": [...]}: errors are what the console was told and
exceptions, requests every address that the page asked for beyond itself. Exit code 77 without
Chromium. The browser draws in software, so that the answer does not depend on a graphics card.
Only the standard library is used: the browser is spoken to over a pair of pipes.
"""
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time

BROWSERS = ("chromium", "chromium-browser", "google-chrome")
FLAGS = ("--headless=new", "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
         "--disable-dev-shm-usage", "--no-first-run", "--disable-extensions",
         "--disable-background-networking", "--remote-debugging-pipe")


class Browser:
    def __init__(self, program, folder, seconds):
        to_read, self.write_end = os.pipe()
        self.read_end, to_write = os.pipe()
        self.deadline = time.monotonic() + seconds
        self.rest, self.number, self.session = b"", 0, None
        self.errors, self.requests = [], []

        def give_pipes():  # the browser reads file 3 and writes file 4
            high = [os.dup2(to_read, 60), os.dup2(to_write, 61)]
            for place, end in zip((3, 4), high):
                os.dup2(end, place)

        self.process = subprocess.Popen(
            [program, *FLAGS, "--user-data-dir=" + folder, "about:blank"], preexec_fn=give_pipes,
            close_fds=False, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(to_read)
        os.close(to_write)
        os.set_blocking(self.read_end, False)

    def messages(self):
        while b"\0" not in self.rest:
            if time.monotonic() > self.deadline or self.process.poll() is not None:
                raise TimeoutError("the browser does not answer")
            try:
                self.rest += os.read(self.read_end, 1 << 20)
            except BlockingIOError:
                time.sleep(0.01)
        text, self.rest = self.rest.split(b"\0", 1)
        return json.loads(text)

    def note(self, message):
        method, values = message.get("method"), message.get("params", {})
        if method == "Runtime.exceptionThrown":
            details = values["exceptionDetails"]
            self.errors.append(details.get("exception", {}).get("description", details["text"]))
        elif method == "Runtime.consoleAPICalled" and values["type"] in ("error", "warning"):
            self.errors.append(" ".join(str(a.get("value")) for a in values["args"]))
        elif method == "Log.entryAdded" and values["entry"]["level"] in ("error", "warning"):
            self.errors.append(values["entry"]["text"])
        elif method == "Network.requestWillBeSent":
            self.requests.append(values["request"]["url"][:200])

    def ask(self, method, **values):
        self.number += 1
        message = {"id": self.number, "method": method, "params": values}
        if self.session:
            message["sessionId"] = self.session
        os.write(self.write_end, json.dumps(message).encode() + b"\0")
        while True:
            answer = self.messages()
            if answer.get("id") == self.number:
                if "error" in answer:
                    raise RuntimeError(f"{method}: {answer['error']}")
                return answer["result"]
            self.note(answer)

    def close(self):
        self.process.kill()
        self.process.wait()


def answer_of(browser, page, expression):
    target = browser.ask("Target.createTarget", url="about:blank")["targetId"]
    browser.session = browser.ask("Target.attachToTarget", targetId=target,
                                  flatten=True)["sessionId"]
    for domain in ("Page", "Runtime", "Log", "Network"):
        browser.ask(domain + ".enable")
    url = pathlib.Path(page).resolve().as_uri()
    browser.ask("Page.navigate", url=url)
    while browser.ask("Runtime.evaluate", expression="location.href + document.readyState")[
            "result"]["value"] != url + "complete":
        time.sleep(0.05)
    result = browser.ask("Runtime.evaluate", expression=expression, awaitPromise=True,
                         returnByValue=True)
    if "exceptionDetails" in result:
        details = result["exceptionDetails"]
        browser.errors.append(details.get("exception", {}).get("description", details["text"]))
    return {"value": result["result"].get("value"), "errors": browser.errors,
            "requests": [r for r in browser.requests if r != url]}


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    program = next(filter(None, map(shutil.which, BROWSERS)), None)
    if program is None:
        print("skipped: no chromium", file=sys.stderr)
        sys.exit(77)
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder:
        seconds = float(sys.argv[3]) if len(sys.argv) > 3 else 60.0
        browser = Browser(program, folder, seconds)
        try:
            print(json.dumps(answer_of(browser, sys.argv[1], sys.argv[2])))
        finally:
            browser.close()


if __name__ == "__main__":
    main()
