# SPDX-License-Identifier: Apache-2.0
"""Checks the renderers of examples/05_renderer for a GPU: integration_cuda.py SORT GROUPED SWITCH. The last is the
renderer for a CPU.

The three pictures are equal bit by bit: arithmetic is IEEE's on both machines, and the compilers contract nothing. So what
the CPU's picture must show, the GPU's show, too; that is checked of one of them."""
import re
import sys

from renderer_pictures import check_furnace, check_lamp, check_seeds, expect, file, pixels, run, written

sort, grouped, switch = sys.argv[1:4]


def time_of(text):
    found = re.fullmatch(r"8 samples a pixel, (\d+\.\d+) ms a frame\n", text)
    expect(found and float(found[1]) > 0, f"'{text}' tells the time of a frame")
    return found[1]


pictures = []
for arguments in [("1", "balls"), ("2", "balls"), ("1", "furnace")]:
    wanted = written(run(switch, *arguments))[0]
    for program in [sort, grouped]:
        picture, text, _ = written(run(program, *arguments))
        time_of(text)
        expect(picture == wanted, f"the picture of {program} {' '.join(arguments)} is the CPU's")
    pictures.append(pixels(picture))
first, second, furnace = pictures
check_lamp(first)
mean = check_seeds(first, second)
check_furnace(furnace, grouped)

(large, sorted_text, _), (same, grouped_text, _) = (written(run(p, "1", "balls", "3")) for p in [sort, grouped])
expect(large.startswith(b"PF\n960 720\n"), "SCALE makes a larger picture")
expect(large == same, "the larger pictures are the same")

file.mkdir()  # where the picture would go
for program in [sort, grouped]:
    result = run(program)
    expect(result.returncode == 1 and "cannot write" in result.stderr, f"{program} says that it cannot write")
    expect(list(file.parent.iterdir()) == [file], f"{program} leaves nothing behind")
print(f"three renderers write the same picture of mean {mean:.4f}; of 960 x 720 pixels, the sort takes "
      f"{time_of(sorted_text)} ms a frame and the library {time_of(grouped_text)} ms")
