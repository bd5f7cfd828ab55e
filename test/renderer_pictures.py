# SPDX-License-Identifier: Apache-2.0
"""What the tests of examples/05_renderer share: they run a renderer, read its picture, and check what can be known of a
picture without another renderer."""
import array
import math
import os
import pathlib
import subprocess
import sys
import tempfile

width, height, lamp_radiance = 320, 240, (16.0, 14.0, 10.0)
folder = tempfile.TemporaryDirectory()
file = pathlib.Path(folder.name) / "picture.pfm"


def expect(condition, what):
    if not condition:
        sys.exit(f"{pathlib.Path(sys.argv[0]).name}: not so: {what}")


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
    """The radiance of all pixels, three values each."""
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


def check_lamp(picture):
    shown = [3 * (y * width + x) for y in range(height) for x in range(width) if looks_at_lamp(x, y)]
    expect(len(shown) > 300, "the camera looks at the lamp")
    expect(all(tuple(picture[i:i + 3]) == lamp_radiance for i in shown), "the lamp is as bright as it is")


def check_seeds(first, second):
    """Checks two pictures that differ in their seed. Returns the mean of the first."""
    expect(sum(a != b for a, b in zip(first, second)) > len(first) / 4, "another seed is other noise")
    means = sum(first) / len(first), sum(second) / len(second)
    expect(abs(means[0] - means[1]) < 0.02 * means[0], f"the seeds agree about the mean: {means}")
    return means[0]


def check_furnace(picture, program):
    expect(all(v == 1 for v in picture), f"{program} loses no light and makes none")
