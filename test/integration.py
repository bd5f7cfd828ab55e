# SPDX-License-Identifier: Apache-2.0
"""Checks the renderers of examples/05_renderer: integration.py SWITCH DEFERRED NUMBERED, the programs
of the two files, and the second with the schedule whose number SCHEDULE has.

The pictures are equal bit by bit, whatever the schedule and the number of threads. That they are not
equal because they are empty is known from what they must show: the lamp where the camera looks at it,
a picture of ones in the white furnace, other noise and the same mean with another seed."""
import re
import resource
import sys

from renderer_pictures import (check_furnace, check_lamp, check_seeds, expect, file, height, pixels, run, width,
                               written)

switch, deferred, numbered = sys.argv[1:4]

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

check_lamp(first)
mean = check_seeds(first, pixels(written(run(deferred, "2"))[0]))
for program in [switch, deferred]:
    check_furnace(pixels(written(run(program, "1", "furnace"))[0]), program)

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
print(f"{len(reports)} schedules write the switch's picture of mean {mean:.4f}, in {printed.strip()}")
