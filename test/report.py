#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Whether benchmark/report.py sees what is wrong with a page, a sentence or raw data, and says what and where: every fault
below is put into a copy of the documentation, and the check has to fail with the words beside it."""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

root = pathlib.Path(__file__).resolve().parent.parent
RAW = "docs/results/"
CLAIMS = RAW + "paper-claims.md"

# file, what is replaced by a regular expression, by what, and what the check says
FAULTS = [
    ("docs/paper.md", r"(\| 3 simple .*?)\d\.\d\d", r"\g<1>9.99", r"paper\.md: line \d+ is\n.*9\.99"),
    ("docs/paper-h200.svg", r'cx="\d', 'cx="7', r"paper-h200\.svg: line \d+ is"),
    ("docs/paper-h200.svg", None, None, r"paper-h200\.svg: there is no such file"),
    ("README.md", r"(<!-- report: span .*?-->)\d", r"\g<1>7", r"README\.md: line \d+ is"),
    (CLAIMS, "report: scenes", "report: scene", r"claims\.md:\d+: .*there is no scene, but .*scenes"),
    (CLAIMS, "plot: speedups", "plot: speedup", r"claims\.md:\d+: .*there is no speedup, but"),
    (CLAIMS, "<!-- report: scenes", "<!-- reports: scenes", r"claims\.md:\d+: a marker that is none"),
    (CLAIMS, "<!-- report: scenes", "<!--report: scenes", r"claims\.md:\d+: a marker that is none"),
    (CLAIMS, "<!-- end of report", "<!-- end of raport", r"claims\.md:\d+: a marker that is none"),
    (CLAIMS, r"(<!-- plot: .*-->)", r"\g<1>\n", r"claims\.md:\d+: .*a plot without its picture"),
    (CLAIMS, " kind=record", " sort=record", r"claims\.md:\d+: .*unexpected keyword argument 'sort'"),
    ("README.md", r"\n[^\n]* (<!-- report: span)", r"\n\g<1>", r"README\.md:\d+: .* begins it"),
    # Sentences: a figure that was changed, one without a marker, in words too, one whose marker has gone, a marker that
    # has another cell, raw data that has changed, and an exception that nothing needs.
    ("README.md", r"(hit=4 -->)10 to 40", r"\g<1>10 to 14", r"README\.md: line \d+ is\n.*10 to 14 %"),
    ("README.md", "A hit is a", "It is 3.7 times as fast. A hit is a", r"README\.md:\d+: '3\.7 times' looks measured"),
    ("docs/paper.md", "- \\*\\*On a CPU, order", "- It takes 12 ms.\n- **On a CPU, order", r"paper\.md:\d+: '12 ms' looks"),
    ("docs/schedules.md", "Divergence is cheap", "Divergence costs two thirds and is cheap", r"md:\d+: 'two thirds' looks"),
    ("docs/results/cpu.md", r"\*\*Noise\.\*\*", "It is twice as fast.", r"cpu\.md:\d+: 'twice as' looks measured"),
    ("docs/accuracy.md", r"<!-- report: accuracy-of[^>]*-->([\d. to]+)<!-- end of report -->", r"\g<1>",
     r"accuracy\.md:\d+: '[\d. to]+' looks measured"),
    ("docs/concepts.md", "This is \\*\\*div", "It is 13x slower. This is **div", r"concepts\.md:\d+: '13x' looks measured"),
    ("docs/paper.md", "report: scene-share scenes-h200", "report: scene-share scenes-cpu", r"paper\.md: line \d+ is"),
    ("docs/accuracy.md", 'setting="max-depth 4"', 'setting="max-depth 5"', r"accuracy\.md:\d+: .*no cell is like that"),
    (RAW + "scenes-h200.json", '"seconds": 0.0', '"seconds": 0.1', r"md: line \d+ is"),
    ("docs/paper.md", "within 25 per cent of the law", "close to the law", r"prose\.py allows 'it is within 25 per cent"),

    (RAW + "h200-schedules.json", None, None, r"md:\d+: .*there is no raw data h200-schedules\.json"),
    (RAW + "h200-schedules.json", '"real_time"', '"time"', r"md:\d+: .*h200-schedules\.json.*has no 'real_time'"),
    (RAW + "h200-schedules.json", "local-bitonic", "bitonic", r"md:\d+: .*h200-schedules\.json.*no 'local-bitonic'"),
    (RAW + "h200-schedules.json", r"\A", "x", r"md:\d+: .*h200-schedules\.json.*JSONDecodeError"),
    (RAW + "h200-counters.json", '"bytes_read"', '"bytes"', r"md:\d+: .*h200-counters\.json.*no 'bytes_read'"),
    (RAW + "h200-counters.json", "/switch/", "/swatch/", r"md:\d+: .*h200-counters\.json.*no \('3 simple', 'switch', 1\)"),
    (RAW + "h200-bounces-1.json", '"efficiency"', '"share"', r"md:\d+: .*h200-bounces-1\.json.*no 'efficiency'"),
    (RAW + "matrix.json", '"capability"', '"arch"', r"matrix\.md:\d+: .*matrix\.json.*no 'capability'"),
    (RAW + "matrix.json", r'"outcome": "ok"', '"outcome": "good"', r"matrix\.md:\d+: .*a cell has another outcome"),
    (RAW + "compile-time-gcc.json", '"peak_kib"', '"kib"', r"md:\d+: .*compile-time-gcc\.json.*no 'peak_kib'"),
]


def check(folder):
    """Whether the check passes, and what it says."""
    done = subprocess.run([sys.executable, str(folder / "benchmark/report.py"), "--check"], capture_output=True,
                          text=True, check=False)
    return done.returncode == 0, done.stdout + done.stderr


def main():
    failed = []
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        shutil.copy(root / "README.md", folder)
        for part in ("benchmark", "docs"):
            shutil.copytree(root / part, folder / part, ignore=shutil.ignore_patterns("__pycache__"))
        passes, words = check(folder)
        if not passes:
            sys.exit(f"without any fault, the check says\n{words}")
        for file, old, new, expected in FAULTS:
            path = folder / file
            text = path.read_text(encoding="utf-8")
            if old is None:
                path.unlink()
            else:
                changed, count = re.subn(old, new, text)
                if count == 0 or changed == text:
                    failed.append(f"{file} has no {old} to replace")
                path.write_text(changed, encoding="utf-8")
            passes, words = check(folder)
            if passes or not re.search(expected, words, re.DOTALL) or "Traceback" in words:
                failed.append(f"{file}, {old} replaced by {new}: expected {expected}, and the check says\n{words}")
            path.write_text(text, encoding="utf-8")
    if failed:
        sys.exit("\n".join(failed))
    print(f"{len(FAULTS)} faults are found and named")


if __name__ == "__main__":
    main()
