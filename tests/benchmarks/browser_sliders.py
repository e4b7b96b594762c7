"""From key press to painted pictures, in a real browser: JupyterLab, chromium, MapLab on a plan of 600 x 800 pixels.

    python tests/benchmarks/browser_sliders.py [--labs 08_localization 09_fastslam] [--keys 60] [--shots FOLDER]

Run by hand (make bench-browser). Needs `pip install playwright` and a chromium of the system; neither is a dependency of the
project or of its tests. A key press counts from the keydown event to the end of the frame that paints the answer: all pictures
of the lab and its numbers. --labs also measures the first slider of every lab in these notebooks, --shots opens the course's
notebooks, runs them all and leaves pictures of them. Exit code 1 when a 90th percentile reaches 100 ms or a notebook shows an
error. The milliseconds are those of a machine that does nothing else.
"""

from __future__ import annotations

import argparse
import contextlib
import os
import secrets
import shutil
import socket
import subprocess
import sys
import tempfile
import time
import urllib.request
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import nbformat
import numpy as np

from priorlab.course.execute import METADATA

NOTEBOOKS = Path(__file__).parents[2] / "notebooks"
PROMPT = "priorlab.course.prompt_server.PromptConnection"
IDLE = ".jp-Notebook-ExecutionIndicator[data-status='idle']"
FLAGS = (
    "--no-sandbox --disable-gpu --disable-quic --no-first-run --disable-background-networking --disable-component-update "
    "--disable-sync"
).split()

LAB = """
import cv2, numpy as np, priorlab as pl
from priorlab.core.survey import look_around
from priorlab.widgets import MapLab

labels = np.zeros((600, 800), dtype=np.uint8)
for x in range(0, 800, 100):
    cv2.line(labels, (x, 0), (x, 599), 1, 5)
for y in range(0, 600, 120):
    cv2.line(labels, (0, y), (799, y), 1, 5)
for x in range(0, 800, 100):
    labels[40:80, max(0, x - 5) : x + 6] = labels[280:320, max(0, x - 5) : x + 6] = 0
walls = pl.Walls(labels)
truth = pl.Truth(walls.mask, np.zeros(labels.shape, bool))
rows = [((10, y), (790, y)) for y in (60, 180, 300, 420, 540)]
poses = look_around(rows, 10)
poses = poses[~walls.mask[600 - 1 - poses[:, 1].astype(int), poses[:, 0].astype(int)]]
grid = pl.Grid(labels.shape, 3)
lab = MapLab(walls, pl.gather_evidence(pl.explore(truth, poses, pl.RangeSensor(max_range=40)), grid), truth)
lab
"""

WATCH = """
cell => {
  const lab = document.querySelectorAll(".jp-Cell")[cell];
  const input = lab.querySelector(".priorlab-slider input");
  [window.took, window.asked] = [[], 0];
  let pressed = 0;
  input.addEventListener("keydown", () => { pressed = performance.now(); }, true);
  input.addEventListener("input", () => { window.asked += 1; });
  lab.querySelector(".priorlab-screen").addEventListener("priorlab-shown", () => {
    requestAnimationFrame(() => {  // this frame paints the pictures; a message posted here arrives when it has been painted
      const after = new MessageChannel();
      after.port1.onmessage = () => window.took.push(performance.now() - pressed);
      after.port2.postMessage(0);
    });
  });
  input.scrollIntoView({ block: "center" });
  input.focus();
  return Number(input.value) - Number(input.min) > Number(input.max) - Number(input.value);
}
"""
ANSWERED = """
() => new Promise(done => {  // or two seconds later: what a key changes may look as before
  const until = performance.now() + 2000;
  const look = () => window.took.length || performance.now() > until ? done() : setTimeout(look, 5);
  look();
})
"""
LABS_OF = """
() => [...document.querySelectorAll(".jp-Cell")].flatMap((cell, i) => {
  const label = cell.querySelector(".priorlab-screen") && cell.querySelector(".priorlab-slider label");
  return label ? [[i, label.textContent]] : [];
})
"""


@contextlib.contextmanager
def jupyter_lab(folder: Path, prompt: bool) -> Iterator[str]:
    """A JupyterLab of this environment on 127.0.0.1; yields its address, the notebook's name to be filled in."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    token = secrets.token_hex(16)
    settings = [f"--ServerApp.port={port}", "--ServerApp.ip=127.0.0.1", f"--ServerApp.root_dir={folder}", "--no-browser"]
    settings += ["--LabApp.news_url=None", "--LabApp.check_for_updates_class=jupyterlab.NeverCheckForUpdate"]
    settings += [f"--ServerApp.kernel_websocket_connection_class={PROMPT}"] if prompt else []
    environment = {**os.environ, "JUPYTER_TOKEN": token, "JUPYTER_CONFIG_DIR": str(folder / ".config")}
    environment.pop("MPLBACKEND", None)
    with (folder / "server.log").open("w") as log:
        command = [sys.executable, "-m", "jupyterlab", *settings, *(["--allow-root"] if os.geteuid() == 0 else [])]
        server = subprocess.Popen(command, stdout=log, stderr=log, env=environment)
        address = f"http://127.0.0.1:{port}"
        try:
            for _ in range(120):
                with contextlib.suppress(OSError):
                    urllib.request.urlopen(f"{address}/api?token={token}", timeout=2)
                    break
                time.sleep(0.5)
            yield f"{address}/lab/tree/{{}}?token={token}&reset"
        finally:
            server.terminate()
            server.wait(20)


def run_all(page: Any, address: str, wait_for: str) -> float:
    """Open a notebook, run all its cells, wait for something to appear; returns seconds to the first widget."""
    started = time.perf_counter()
    page.goto(address)
    page.wait_for_selector(".jp-Notebook .jp-Cell", timeout=30_000)
    page.wait_for_selector(IDLE, timeout=30_000)
    page.wait_for_timeout(1500)  # idle before its first command is not yet ready for it
    page.click("text=Run >> nth=0")
    page.wait_for_timeout(500)
    page.click("text=Run All Cells >> nth=0")
    page.wait_for_selector(wait_for, timeout=120_000)
    return time.perf_counter() - started


def main() -> int:
    """Measure, tell, and judge."""
    from playwright.sync_api import sync_playwright

    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--chromium", default=shutil.which("chromium") or "/usr/bin/chromium")
    parser.add_argument("--keys", type=int, default=60)
    parser.add_argument("--labs", nargs="*", default=[], metavar="NOTEBOOK")
    parser.add_argument("--shots", type=Path)
    options = parser.parse_args()
    bad = False
    with tempfile.TemporaryDirectory() as name, sync_playwright() as play:
        folder = Path(name)
        nbformat.write(nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(LAB)], metadata=METADATA), folder / "lab.ipynb")
        for notebook in NOTEBOOKS.glob("*.ipynb"):
            shutil.copy(notebook, folder)
        browser = play.chromium.launch(executable_path=options.chromium, headless=True, args=FLAGS)
        for prompt, words in ((False, "an ordinary JupyterLab"), (True, "as make lab starts it")):
            with jupyter_lab(folder, prompt) as address:
                page = browser.new_page(viewport={"width": 1280, "height": 900})
                seconds = run_all(page, address.format("lab.ipynb"), ".priorlab-picture")
                took = press(page, options.keys, cell=0)
                bad |= told(f"{words}, 600 x 800 px in cells of 3", took)
                print(f"    from address to first widget {seconds:.1f} s, of which 2 s waiting")
                for stem in options.labs if prompt else ():
                    run_all(page, address.format(f"{stem}.ipynb"), ".priorlab-slider")
                    page.wait_for_selector(IDLE, timeout=180_000)
                    for cell, label in page.evaluate(LABS_OF):
                        bad |= told(f"{stem}, {label}", press(page, options.keys, cell))
                if options.shots and prompt:
                    options.shots.mkdir(parents=True, exist_ok=True)
                    for notebook in sorted(NOTEBOOKS.glob("*.ipynb")):
                        bad |= shoot(page, address.format(notebook.name), options.shots / notebook.stem)
                page.close()
        browser.close()
    return int(bad)


def press(page: Any, keys: int, cell: int) -> np.ndarray:
    """Milliseconds from each key press on the first slider of a lab to its painted answer, if the key changes anything."""
    page.wait_for_timeout(1500)
    there, back = ("ArrowLeft", "ArrowRight") if page.evaluate(WATCH, cell) else ("ArrowRight", "ArrowLeft")
    took: list[float] = []
    for key in range(keys):
        page.evaluate("[window.took, window.asked] = [[], 0]")
        page.keyboard.press(there if key % 20 < 10 else back)
        if page.evaluate("window.asked"):
            page.evaluate(ANSWERED)
        page.wait_for_timeout(60)
        took += page.evaluate("window.took.slice(-1)")
    return np.array(took)


def told(what: str, took: np.ndarray) -> bool:
    """Print the times of some key presses; True when they are too long."""
    low, high = np.percentile(took, [50, 90])
    print(f"{what}: {len(took)} keys, median {low:.0f} ms, 90th percentile {high:.0f} ms, slowest {took.max():.0f} ms")
    return bool(high >= 100)


def shoot(page: Any, address: str, stem: Path) -> bool:
    """Run a course notebook and leave pictures of it from top to bottom; True when something went wrong."""
    seconds = run_all(page, address, ".priorlab-slider")
    page.wait_for_selector(IDLE, timeout=180_000)
    page.wait_for_timeout(2000)
    scroller = page.evaluate_handle("document.querySelector('.jp-WindowedPanel-outer')")
    height = scroller.evaluate("it => it.scrollHeight")
    errors = 0
    for number, top in enumerate(range(0, int(height), 780)):
        scroller.evaluate("(it, top) => { it.scrollTop = top; }", top)
        page.wait_for_timeout(500)
        page.screenshot(path=f"{stem}_{number:02d}.png")
        errors += page.locator(".jp-OutputArea-output[data-mime-type='application/vnd.jupyter.error']").count()
    print(f"{stem.name}: first widget after {seconds:.1f} s, {errors} errors on the screen")
    return errors > 0


if __name__ == "__main__":
    sys.exit(main())
