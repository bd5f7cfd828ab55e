#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the scenes beside this file; with --check, only compares them.

box.gltf, gallery.gltf; effects/: one small scene for each effect of the path tracer; paper/: five with as many
shaders as those of the paper.
"""
import argparse
import math
import pathlib
import sys

from effect_scenes import effect_scenes
from gltf_writer import Scene, about_y, as_float, bumps, checkers, cube, quad, sphere
from paper_scenes import paper_scenes
from random_numbers import random_numbers


def box():
    """A room open to the viewer, coloured side walls, a lamp in the ceiling, two blocks."""
    scene = Scene(((0.0, 1.0, 3.9), (0.0, 1.0, 0.0), 0.66))
    matte = {"specular": {"specularFactor": 0.0}}
    scene.material("white", (0.74, 0.73, 0.70), **matte)
    scene.material("orange", (0.70, 0.22, 0.05), **matte)
    scene.material("blue", (0.08, 0.20, 0.62), **matte)
    scene.material("lamp", (0.0, 0.0, 0.0), emission=(14.0, 12.0, 9.0))
    square, block = scene.geometry(*quad()), scene.geometry(*cube())
    quarter = as_float(math.sqrt(0.5))
    scene.place(square, "white", scale=[2.0, 1.0, 2.0])
    scene.place(square, "white", scale=[2.0, 1.0, 2.0], rotation=[1.0, 0.0, 0.0, 0.0], translation=[0.0, 2.0, 0.0])
    scene.place(square, "white", scale=[2.0, 1.0, 2.0], rotation=[quarter, 0.0, 0.0, quarter], translation=[0.0, 1.0, -1.0])
    scene.place(square, "orange", scale=[2.0, 1.0, 2.0], rotation=[0.0, 0.0, -quarter, quarter], translation=[-1.0, 1.0, 0.0])
    scene.place(square, "blue", scale=[2.0, 1.0, 2.0], rotation=[0.0, 0.0, quarter, quarter], translation=[1.0, 1.0, 0.0])
    scene.place(square, "lamp", scale=[0.6, 1.0, 0.5], rotation=[1.0, 0.0, 0.0, 0.0], translation=[0.0, 1.99, 0.0])
    scene.place(block, "white", scale=[0.56, 1.2, 0.56], rotation=about_y(19.0), translation=[-0.36, 0.6, -0.32])
    scene.place(block, "white", scale=[0.56, 0.56, 0.56], rotation=about_y(-17.0), translation=[0.38, 0.28, 0.34])
    return scene


def gallery():
    """Two hundred balls of sixteen materials, close together: after the first hit, neighbours part."""
    scene = Scene(((0.0, 3.1, 6.4), (0.0, 0.15, 0.55), 0.60), background=[0.16, 0.20, 0.28])
    matte = {"specular": {"specularFactor": 0.0}}
    tiles = scene.texture(checkers(32, 2, (92, 88, 84), (176, 170, 160)))
    stripes = scene.texture(checkers(32, 4, (24, 60, 110), (225, 215, 190)))
    waves = scene.texture(bumps(32, 4))
    # glTF keeps roughness in green and metallic in blue.
    worn = scene.texture(checkers(32, 8, (0, 64, 255), (0, 200, 40)))

    scene.material("floor", (1.0, 1.0, 1.0), roughness=0.55, textures={"baseColorTexture": tiles})
    scene.material("panel", (0.0, 0.0, 0.0), emission=(9.0, 8.2, 7.0), two_sided=True)
    scene.material("cool panel", (0.0, 0.0, 0.0), emission=(2.4, 3.6, 5.6), two_sided=True)
    balls = []

    def ball(name, *arguments, **members):
        scene.material(name, *arguments, **members)
        balls.append(name)

    ball("chalk", (0.72, 0.70, 0.64), **matte)
    ball("brick", (0.60, 0.16, 0.09), **matte)
    ball("gold", (1.00, 0.77, 0.34), 1.0, 0.22)
    ball("steel", (0.56, 0.57, 0.58), 1.0, 0.42)
    ball("red plastic", (0.72, 0.05, 0.06), 0.0, 0.18)
    ball("wavy plastic", (0.07, 0.42, 0.34), 0.0, 0.3, textures={"normalTexture": waves})
    ball("painted", (1.0, 1.0, 1.0), 0.0, 0.4, textures={"baseColorTexture": stripes})
    ball("worn metal", (0.80, 0.52, 0.36), 1.0, 1.0, textures={"metallicRoughnessTexture": worn})
    ball("glass", (1.0, 1.0, 1.0), 0.0, 0.0, transmission={"transmissionFactor": 1.0}, ior={"ior": 1.52})
    ball("frosted glass", (0.80, 0.94, 0.90), 0.0, 0.3, transmission={"transmissionFactor": 1.0}, ior={"ior": 1.45})
    ball("car paint", (0.45, 0.02, 0.10), 0.6, 0.45,
         clearcoat={"clearcoatFactor": 1.0, "clearcoatRoughnessFactor": 0.03})
    ball("varnish", (0.05, 0.12, 0.36), 0.0, 0.7,
         clearcoat={"clearcoatFactor": 0.8, "clearcoatRoughnessFactor": 0.1})
    ball("velvet", (0.20, 0.03, 0.24), 0.0, 0.9,
         sheen={"sheenColorFactor": [0.85, 0.65, 0.90], "sheenRoughnessFactor": 0.35})
    ball("marble", (0.86, 0.84, 0.80), roughness=0.5,
         extras={"shader": "marble", "second_color": [0.13, 0.15, 0.20], "pattern_scale": 1.6})
    ball("wood", (0.66, 0.40, 0.18), roughness=0.45,
         extras={"shader": "wood", "second_color": [0.26, 0.12, 0.05], "pattern_scale": 4.0})
    ball("ember", (0.2, 0.2, 0.2), emission=(3.0, 1.1, 0.3))

    square, round_shape = scene.geometry(*quad()), scene.geometry(*sphere(32, 16))
    scene.place(scene.geometry(*quad(20.0)), "floor", scale=[40.0, 1.0, 40.0])
    scene.place(square, "panel", scale=[3.0, 1.0, 2.0], translation=[-3.2, 5.2, 0.6])
    scene.place(square, "cool panel", scale=[2.0, 1.0, 4.0], translation=[4.0, 4.6, -1.2])
    scene.point_light([0.5, 3.2, 5.0], [1.0, 0.9, 0.75], 14.0)

    random = random_numbers(12345)
    columns, rows, pitch = 20, 10, 0.62
    for row in range(rows):
        for column in range(columns):
            radius = as_float(random(0.17, 0.30))
            x = (column - (columns - 1) / 2) * pitch + random(-0.04, 0.04)
            z = (row - (rows - 1) / 2) * pitch + random(-0.04, 0.04)
            name = balls[int(random(0, len(balls)))]
            if name == "ember" and random(0, 1) < 0.6:
                name = "glass"
            y = radius + row % 2 * random(0.0, 0.25)
            scene.place(round_shape, name, scale=[radius] * 3, rotation=about_y(random(0.0, 360.0)),
                        translation=[as_float(v) for v in (x, y, z)])
    return scene


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--check", action="store_true", help="compare the files instead of writing them")
    check = parser.parse_args().check
    folder = pathlib.Path(__file__).resolve().parent
    files = {"box.gltf": box().text().encode(), "gallery.gltf": gallery().text().encode()}
    files.update({f"effects/{name}": data for name, data in effect_scenes().items()})
    files.update({f"paper/{name}": data for name, data in paper_scenes().items()})
    different = []
    for name, data in files.items():
        path = folder / name
        if not check:
            path.parent.mkdir(exist_ok=True)
            path.write_bytes(data)
        elif not path.is_file() or path.read_bytes() != data:
            different.append(name)
    if different:
        sys.exit("differ from what this script makes: " + ", ".join(different))


if __name__ == "__main__":
    main()
