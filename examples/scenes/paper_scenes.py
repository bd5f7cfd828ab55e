# SPDX-License-Identifier: Apache-2.0
"""Five scenes with as many shaders, of about the weight, as those of the paper (docs/paper.md).

Rooms are closed, so that no ray leaves them; in the others the sky is one of the shaders. Objects of different
shaders stand close together, and enough of them reflect that paths part at the first hit.
"""
import math

from gltf_writer import Scene, about_y, as_float, cube, quad, sphere
from random_numbers import random_numbers

MATTE = {"specular": {"specularFactor": 0.0}}
QUARTER = as_float(math.sqrt(0.5))
SKY = [0.55, 0.65, 0.85]


def stage(camera, **arguments):
    scene = Scene(camera, **arguments)
    scene.square, scene.block, scene.ball = (scene.geometry(*shape) for shape in (quad(), cube(), sphere(32, 16)))
    return scene


def matte(scene, name, color):
    scene.material(name, color, **MATTE)


def metal(scene, name, color, roughness):
    scene.material(name, color, 1.0, roughness)


def marble(scene, name, color, veins, scale):
    scene.material(name, color, extras={"shader": "marble", "second_color": veins, "pattern_scale": scale})


def wood(scene, name, color, rings, scale):
    scene.material(name, color, roughness=0.4,
                   extras={"shader": "wood", "second_color": rings, "pattern_scale": scale})


def room(scene, floor, ceiling, back, sides, size):
    """Six walls about the camera and all else, each larger than need be: no ray slips through a corner."""
    width, height, depth = size
    wide, high = [width + 2.0, 1.0, depth + 2.0], height / 2
    wall = [width + 2.0, 1.0, height + 2.0]
    side = [height + 2.0, 1.0, depth + 2.0]
    scene.place(scene.square, floor, scale=wide)
    scene.place(scene.square, ceiling, scale=wide, rotation=[1.0, 0.0, 0.0, 0.0], translation=[0.0, height, 0.0])
    scene.place(scene.square, back, scale=wall, rotation=[QUARTER, 0.0, 0.0, QUARTER],
                translation=[0.0, high, -depth / 2])
    scene.place(scene.square, back, scale=wall, rotation=[-QUARTER, 0.0, 0.0, QUARTER],
                translation=[0.0, high, depth / 2])
    scene.place(scene.square, sides[0], scale=side, rotation=[0.0, 0.0, -QUARTER, QUARTER],
                translation=[-width / 2, high, 0.0])
    scene.place(scene.square, sides[1], scale=side, rotation=[0.0, 0.0, QUARTER, QUARTER],
                translation=[width / 2, high, 0.0])


def lamps(scene, name, places, size):
    """Panels that face down."""
    for place in places:
        scene.place(scene.square, name, scale=[size, 1.0, size], rotation=[1.0, 0.0, 0.0, 0.0], translation=place)


def crowd(scene, names, grid, pitch, seed, middle=(0.0, 0.0)):
    """Balls, every third of them a block, in rows; a material after the other by chance."""
    random = random_numbers(seed)
    columns, rows = grid
    for k in range(columns * rows):
        column, row = k % columns, k // columns
        size = pitch * random(0.30, 0.44)
        x = middle[0] + (column - (columns - 1) / 2) * pitch + random(-0.1, 0.1) * pitch
        z = middle[1] + (row - (rows - 1) / 2) * pitch + random(-0.1, 0.1) * pitch
        name, turn = names[int(random(0, len(names)))], about_y(random(0.0, 360.0))
        high = size * random(0.8, 1.8)
        is_block = k % 3 == 0
        scene.place(scene.block if is_block else scene.ball, name, rotation=turn,
                    scale=[as_float(v) for v in ((1.4 * size, 2 * high, 1.4 * size) if is_block else (size,) * 3)],
                    translation=[as_float(v) for v in (x, high if is_block else size, z)])


def three_simple():
    """A room of mirrors and painted things: emitters, metal, matte."""
    scene = stage(((0.0, 2.3, 4.7), (0.0, 0.9, -0.5), 0.75))
    matte(scene, "white", (0.76, 0.74, 0.70))
    matte(scene, "red", (0.65, 0.14, 0.08))
    matte(scene, "green", (0.16, 0.42, 0.14))
    matte(scene, "yellow", (0.75, 0.55, 0.10))
    metal(scene, "silver", (0.95, 0.95, 0.96), 0.05)
    metal(scene, "copper", (0.95, 0.64, 0.54), 0.15)
    scene.material("lamp", (0.0, 0.0, 0.0), emission=(11.0, 10.0, 8.5))
    room(scene, "white", "white", "silver", ("red", "green"), (7.0, 3.6, 10.0))
    lamps(scene, "lamp", [[x, 3.59, z] for x in (-1.8, 1.8) for z in (-2.5, 0.5)], 1.1)
    crowd(scene, ["silver", "white", "copper", "yellow", "silver", "red"], (7, 5), 0.85, 3, (0.0, -0.6))
    return scene


def six_simple():
    """A court under the sky: emitters, smooth glass, metal, matte, plastic, and the sky."""
    scene = stage(((0.0, 2.3, 5.4), (0.0, 0.45, 0.3), 0.62), background=SKY)
    matte(scene, "ground", (0.52, 0.48, 0.42))
    matte(scene, "chalk", (0.80, 0.78, 0.72))
    metal(scene, "steel", (0.75, 0.76, 0.78), 0.08)
    metal(scene, "gold", (1.00, 0.77, 0.34), 0.20)
    scene.material("red plastic", (0.70, 0.06, 0.05), 0.0, 0.15)
    scene.material("blue plastic", (0.06, 0.20, 0.62), 0.0, 0.35)
    scene.material("glass", (1.0, 1.0, 1.0), 0.0, 0.0, transmission={"transmissionFactor": 1.0}, ior={"ior": 1.5})
    scene.material("lantern", (0.0, 0.0, 0.0), emission=(2.2, 1.4, 0.7))
    scene.place(scene.square, "ground", scale=[40.0, 1.0, 40.0])
    crowd(scene, ["steel", "red plastic", "glass", "chalk", "gold", "blue plastic", "glass", "lantern"],
          (11, 7), 0.78, 6)
    return scene


def two_simple_two_procedural():
    """A hall of marble and wood: emitters, metal, and both procedural shaders."""
    scene = stage(((0.0, 2.2, 4.6), (0.0, 1.0, -0.6), 0.75))
    marble(scene, "white marble", (0.86, 0.84, 0.80), [0.16, 0.18, 0.24], 1.6)
    marble(scene, "dark marble", (0.24, 0.27, 0.25), [0.80, 0.78, 0.70], 2.2)
    wood(scene, "oak", (0.66, 0.43, 0.22), [0.34, 0.18, 0.08], 3.0)
    wood(scene, "walnut", (0.38, 0.22, 0.12), [0.16, 0.08, 0.04], 4.0)
    metal(scene, "silver", (0.95, 0.95, 0.96), 0.06)
    scene.material("lamp", (0.0, 0.0, 0.0), emission=(13.0, 11.5, 9.0))
    room(scene, "white marble", "oak", "oak", ("walnut", "dark marble"), (7.0, 3.8, 10.0))
    lamps(scene, "lamp", [[x, 3.79, z] for x in (-2.0, 0.0, 2.0) for z in (-2.5, 0.5)], 1.0)
    crowd(scene, ["white marble", "silver", "oak", "dark marble", "silver", "walnut"], (7, 5), 0.85, 22, (0.0, -0.6))
    return scene


def three_simple_two_procedural():
    """A room on a floor of marble and wooden tiles: emitters, metal, matte, and both procedural shaders."""
    scene = stage(((0.0, 2.7, 4.7), (0.0, 0.6, -0.6), 0.75))
    marble(scene, "marble", (0.86, 0.84, 0.80), [0.13, 0.15, 0.20], 1.8)
    wood(scene, "wood", (0.60, 0.38, 0.18), [0.28, 0.14, 0.06], 4.0)
    matte(scene, "plaster", (0.74, 0.72, 0.68))
    matte(scene, "blue", (0.12, 0.24, 0.58))
    metal(scene, "brass", (0.91, 0.78, 0.42), 0.08)
    scene.material("lamp", (0.0, 0.0, 0.0), emission=(13.0, 12.0, 10.0))
    room(scene, "wood", "plaster", "plaster", ("blue", "plaster"), (7.0, 3.6, 10.0))
    lamps(scene, "lamp", [[x, 3.59, z] for x in (-1.8, 1.8) for z in (-2.5, 0.5)], 1.1)
    for k in range(10 * 14):
        if (k % 10 + k // 10) % 2 == 0:
            scene.place(scene.block, "marble", scale=[0.7, 0.01, 0.7],
                        translation=[as_float(v) for v in (0.7 * (k % 10 - 4.5), 0.005, 0.7 * (k // 10 - 6.5))])
    crowd(scene, ["marble", "brass", "plaster", "wood", "brass", "blue"], (7, 5), 0.9, 7, (0.0, -0.6))
    return scene


def eleven_moderate():
    """A field under the sky of all shaders but the procedural two: the sky, emitters, matte, and eight whose BSDFs
    have several lobes, glass, layers, films or brush strokes."""
    scene = stage(((0.0, 2.3, 5.4), (0.0, 0.45, 0.3), 0.62), background=SKY)
    clear = {"transmission": {"transmissionFactor": 1.0}, "ior": {"ior": 1.5}}
    film = {"iridescenceFactor": 1.0, "iridescenceIor": 1.4, "iridescenceThicknessMaximum": 350.0}
    scene.material("ground", (0.50, 0.48, 0.46), **MATTE)
    scene.material("lantern", (0.0, 0.0, 0.0), emission=(2.2, 1.4, 0.7))
    scene.place(scene.square, "ground", scale=[40.0, 1.0, 40.0])
    scene.material("steel", (0.75, 0.76, 0.78), 1.0, 0.2)
    scene.material("plastic", (0.10, 0.35, 0.20), 0.0, 0.2)
    scene.material("glass", (1.0, 1.0, 1.0), 0.0, 0.0, **clear)
    scene.material("frosted glass", (0.80, 0.94, 0.90), 0.0, 0.3, **clear)
    scene.material("car paint", (0.50, 0.02, 0.08), 0.6, 0.45, clearcoat={"clearcoatFactor": 1.0})
    scene.material("velvet", (0.20, 0.03, 0.24), 0.0, 0.9,
                   sheen={"sheenColorFactor": [0.85, 0.65, 0.90], "sheenRoughnessFactor": 0.35})
    scene.material("soap", (0.04, 0.04, 0.04), 0.0, 0.15, iridescence=film)
    scene.material("brushed steel", (0.80, 0.80, 0.82), 1.0, 0.3, anisotropy={"anisotropyStrength": 0.9})
    crowd(scene, ["steel", "plastic", "glass", "frosted glass", "car paint", "velvet", "soap", "brushed steel",
                  "lantern", "ground"], (11, 7), 0.78, 11)
    return scene


def paper_scenes():
    """The files of all of them, as bytes, in the order of the paper's."""
    scenes = {"3-simple": three_simple(), "6-simple": six_simple(),
              "2-simple-2-procedural": two_simple_two_procedural(),
              "3-simple-2-procedural": three_simple_two_procedural(), "11-moderate": eleven_moderate()}
    return {f"{name}.gltf": scene.text().encode() for name, scene in scenes.items()}
