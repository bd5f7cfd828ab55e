# SPDX-License-Identifier: Apache-2.0
"""Checks the renderers of examples/05_renderer: integration.py SWITCH DEFERRED NUMBERED, the programs
of the two files, and the second with the schedule whose number SCHEDULE has.

The pictures are equal bit by bit, whatever the schedule and the number of threads. That they are not
equal because they are empty is known from what they must show: the lamp where the camera looks at it,
a picture of ones in the white furnace, other noise and the same mean with another seed."""
import array
import math
import os
import pathlib
import re
import resource
import subprocess
import sys
import tempfile

switch, deferred, numbered = sys.argv[1:4]
width, height, lamp_radiance = 320, 240, (16.0, 14.0, 10.0)
folder = tempfile.TemporaryDirectory()
file = pathlib.Path(folder.name) / "picture.pfm"


def expect(condition, what):
    if not condition:
        sys.exit(f"integration.py: not so: {what}")


def run(program, *arguments, environment=None, **options):
    variables = {**os.environ, "OMP_NUM_THREADS": "2", "OMP_WAIT_POLICY": "passive", **(environment or {})}
    return subprocess.run([program, str(file), *arguments], env=variables, capture_output=True,
                          text=True, timeout=300, **options)


def written(result):
    """What a program wrote: its picture, which is removed, what it printed, and what it reported."""
    expect(result.returncode == 0, f"{result.args} ends with 0: {result.stderr}")
    picture = file.read_bytes()
    file.unlink()
    return picture, result.stdout, result.stderr


def pixels(picture):
    header = f"PF\n{width} {height}\n-1.0\n".encode()
    expect(picture.startswith(header), "the picture is a PFM of 320 x 240 pixels")
    values = array.array("f", picture[len(header):])
    if sys.byteorder == "big":
        values.byteswap()
    expect(len(values) == 3 * width * height, "the picture has all its pixels")
    expect(all(math.isfinite(v) and v >= 0 for v in values), "radiance is finite and not negative")
    return values


def looks_at_lamp(x, y):
    """Whether all of a pixel shows the lamp: a disk is convex, so its four corners do."""
    towards = (-1.5, 4.2 - 2, 1 - 8)  # from the camera to the lamp's centre
    distance = math.hypot(*towards)
    least = math.sqrt(1 - (0.699 / distance) ** 2)  # the cosine of the angle that its radius takes
    for corner in [(x, y), (x + 1, y), (x, y + 1), (x + 1, y + 1)]:
        direction = (corner[0] - width / 2, corner[1] - height / 2, -1.2 * height)
        cosine = sum(a * b for a, b in zip(direction, towards)) / math.hypot(*direction) / distance
        if cosine < least:
            return False
    return True


wanted, printed, _ = written(run(switch))
first = pixels(wanted)
for threads in ["1", "2", "3"]:
    got = written(run(deferred, environment={"OMP_NUM_THREADS": threads}))
    expect(got[:2] == (wanted, printed), f"the deferred renderer's picture on {threads} threads is the same")

reports = []
for number in range(100):
    chosen = {"SCHEDULE": str(number), "OMP_NUM_THREADS": "3"}
    result = run(numbered, environment=chosen)
    if result.returncode == 2:
        expect("no schedule" in result.stderr, f"schedule {number} ends the program only if there is none")
        break
    picture, text, report = written(result)
    expect((picture, text) == (wanted, printed), f"the picture with schedule {number} is the same")
    reports.append(re.sub(r", \d+\.\d+ ms$", "", report, flags=re.MULTILINE))
expect(1 < len(reports) < 100, f"there are a few schedules, and not {len(reports)}")
expect(len(set(reports)) == 1, "the schedules report the same batches")
lines = reports[0].splitlines()
expect(len(lines) == int(re.search(r"(\d+) steps", printed)[1]), "each step is reported")
found = [re.fullmatch(rf"{width * height} requests, efficiency ([01]\.\d+)", line) for line in lines]
expect(all(match and 0 < float(match[1]) < 1 for match in found), f"{lines[0]} is a report")

shown = [3 * (y * width + x) for y in range(height) for x in range(width) if looks_at_lamp(x, y)]
expect(len(shown) > 300, "the camera looks at the lamp")
expect(all(tuple(first[i:i + 3]) == lamp_radiance for i in shown), "the lamp is as bright as it is")

second = pixels(written(run(deferred, "2"))[0])
expect(sum(a != b for a, b in zip(first, second)) > len(first) / 4, "another seed is other noise")
means = sum(first) / len(first), sum(second) / len(second)
expect(abs(means[0] - means[1]) < 0.02 * means[0], f"the seeds agree about the mean: {means}")
for program in [switch, deferred]:
    furnace = pixels(written(run(program, "1", "furnace"))[0])
    expect(all(v == 1 for v in furnace), f"{program} loses no light and makes none")

# Whole or not at all: a file may have a tenth of the picture's bytes here, and what stood there before stays. (LLVM's
# OpenMP has a file of a kilobyte itself.)
file.write_text("before", encoding="utf-8")
most = len(wanted) // 10
limit = {"preexec_fn": lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (most, most)), "restore_signals": False}
for program in [switch, deferred]:
    result = run(program, **limit)
    expect(result.returncode == 1 and "cannot write" in result.stderr, f"{program} says that it cannot write")
    expect(list(file.parent.iterdir()) == [file], f"{program} leaves nothing behind")
    expect(file.read_text(encoding="utf-8") == "before", f"{program} leaves what was there")
print(f"{len(reports)} schedules write the switch's picture of mean {means[0]:.4f}, in {printed.strip()}")
