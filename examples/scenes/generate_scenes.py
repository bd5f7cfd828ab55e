#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes box.gltf and gallery.gltf beside this file; with --check, only compares them.

Both are text glTF with their geometry and textures as data URIs. Only integer arithmetic and
correctly rounded operations decide a byte, apart from sines, which are rounded to float.
"""
import argparse
import base64
import json
import math
import pathlib
import struct
import sys
import zlib


class Scene:
    """Collects a glTF file; each geometry goes into one buffer and may serve many materials."""

    def __init__(self, camera, background=None):
        self.data = bytearray()
        self.gltf = {
            "asset": {"version": "2.0", "generator": "generate_scenes.py"},
            "scene": 0,
            "scenes": [{"nodes": []}],
            "cameras": [],
            "nodes": [],
            "materials": [],
            "meshes": [],
            "accessors": [],
            "bufferViews": [],
        }
        if background:
            self.gltf["scenes"][0]["extras"] = {"background": background}
        position, target, yfov = camera
        self.append("cameras", {"type": "perspective", "perspective": {"yfov": yfov, "znear": 0.01}})
        self.node(camera=0, matrix=look_at(position, target))
        self.materials, self.meshes, self.extensions = {}, {}, set()

    def append(self, collection, value):
        self.gltf.setdefault(collection, []).append(value)
        return len(self.gltf[collection]) - 1

    def node(self, **members):
        self.gltf["scenes"][0]["nodes"].append(self.append("nodes", members))

    def view(self, data):
        self.data += bytes(-len(self.data) % 4)
        start = len(self.data)
        self.data += data
        return self.append("bufferViews", {"buffer": 0, "byteOffset": start, "byteLength": len(data)})

    def accessor(self, values, kind, component, **bounds):
        flat = [x for v in values for x in v] if kind != "SCALAR" else values
        code = {5126: "f", 5123: "H"}[component]
        view = self.view(struct.pack(f"<{len(flat)}{code}", *flat))
        return self.append("accessors", {"bufferView": view, "componentType": component,
                                         "count": len(values), "type": kind, **bounds})

    def geometry(self, positions, normals, uvs, indices):
        """Accessors of a shape, for `place`. Positions are exact in float: they have to match min and max."""
        positions = [[as_float(x) for x in p] for p in positions]
        low = [min(p[i] for p in positions) for i in range(3)]
        high = [max(p[i] for p in positions) for i in range(3)]
        attributes = {"POSITION": self.accessor(positions, "VEC3", 5126, min=low, max=high),
                      "NORMAL": self.accessor(normals, "VEC3", 5126),
                      "TEXCOORD_0": self.accessor(uvs, "VEC2", 5126)}
        return {"attributes": attributes, "indices": self.accessor(indices, "SCALAR", 5123)}

    def material(self, name, color, metallic=0.0, roughness=1.0, extras=None, textures=None,
                 emission=None, two_sided=False, **extensions):
        pbr = {"baseColorFactor": [*color, 1.0], "metallicFactor": metallic, "roughnessFactor": roughness}
        material = {"name": name, "pbrMetallicRoughness": pbr}
        for key, value in (textures or {}).items():
            (material if key == "normalTexture" else pbr)[key] = value
        if extras:
            material["extras"] = extras
        if emission:
            strength = max(emission)
            material["emissiveFactor"] = [e / strength for e in emission]
            extensions["emissive_strength"] = {"emissiveStrength": strength}
        if two_sided:
            material["doubleSided"] = True
        if extensions:
            material["extensions"] = {f"KHR_materials_{k}": v for k, v in extensions.items()}
            self.extensions.update(material["extensions"])
        self.materials[name] = self.append("materials", material)

    def texture(self, pixels):
        view = self.view(png(pixels))
        image = self.append("images", {"bufferView": view, "mimeType": "image/png"})
        return {"index": self.append("textures", {"source": image})}

    def place(self, geometry, material, **transform):
        key = (geometry["indices"], material)
        if key not in self.meshes:
            primitive = {**geometry, "material": self.materials[material]}
            self.meshes[key] = self.append("meshes", {"primitives": [primitive]})
        self.node(mesh=self.meshes[key], **transform)

    def point_light(self, position, color, intensity):
        lights = self.gltf.setdefault("extensions", {}).setdefault("KHR_lights_punctual", {"lights": []})
        lights["lights"].append({"type": "point", "color": color, "intensity": intensity})
        self.node(translation=position,
                  extensions={"KHR_lights_punctual": {"light": len(lights["lights"]) - 1}})
        self.extensions.add("KHR_lights_punctual")

    def text(self):
        uri = "data:application/octet-stream;base64," + base64.b64encode(self.data).decode()
        result = dict(self.gltf, buffers=[{"byteLength": len(self.data), "uri": uri}])
        if self.extensions:
            result["extensionsUsed"] = sorted(self.extensions)
        lines = []  # one element to a line: short enough to read, and to compare
        for key, value in result.items():
            if isinstance(value, list) and value and isinstance(value[0], dict):
                rows = ",\n  ".join(json.dumps(v) for v in value)
                lines.append(f'{json.dumps(key)}: [\n  {rows}\n ]')
            else:
                lines.append(f"{json.dumps(key)}: {json.dumps(value)}")
        return "{\n " + ",\n ".join(lines) + "\n}\n"


def as_float(x):
    return struct.unpack("<f", struct.pack("<f", x))[0]


def normalized(v):
    length = math.sqrt(sum(x * x for x in v))
    return [x / length for x in v]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def look_at(position, target):
    back = normalized([p - t for p, t in zip(position, target)])
    right = normalized(cross([0.0, 1.0, 0.0], back))
    up = cross(back, right)
    columns = [[*right, 0.0], [*up, 0.0], [*back, 0.0], [*position, 1.0]]
    return [as_float(x) for column in columns for x in column]


def about_y(degrees):
    half = math.radians(degrees) / 2
    return [0.0, as_float(math.sin(half)), 0.0, as_float(math.cos(half))]


def quad(repeat=1.0):
    """Unit square in the xz plane, its front up; textures repeat on it."""
    corners = [[-0.5, 0.0, -0.5], [-0.5, 0.0, 0.5], [0.5, 0.0, 0.5], [0.5, 0.0, -0.5]]
    uvs = [[0.0, 0.0], [0.0, repeat], [repeat, repeat], [repeat, 0.0]]
    return corners, [[0.0, 1.0, 0.0]] * 4, uvs, [0, 1, 2, 0, 2, 3]


def cube():
    """Unit cube around the origin, without shared corners."""
    positions, normals, uvs, indices = [], [], [], []
    for axis in range(3):
        for sign in (-1.0, 1.0):
            first = len(positions)
            for u, v in ((-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)):
                corner = [0.0] * 3
                corner[axis] = 0.5 * sign
                corner[(axis + 1) % 3] = u * sign
                corner[(axis + 2) % 3] = v
                positions.append(corner)
                normals.append([sign if i == axis else 0.0 for i in range(3)])
                uvs.append([u + 0.5, 0.5 - v])
            indices += [first, first + 1, first + 2, first, first + 2, first + 3]
    return positions, normals, uvs, indices


def sphere(columns, rows):
    """Unit sphere in latitudes and longitudes; no triangle at the poles is degenerate."""
    normals, uvs, indices = [], [], []
    for row in range(rows + 1):
        theta = math.pi * row / rows
        for column in range(columns + 1):
            phi = 2 * math.pi * (column % columns) / columns
            normals.append([math.sin(theta) * math.sin(phi), math.cos(theta), math.sin(theta) * math.cos(phi)])
            uvs.append([column / columns, row / rows])
    for row in range(rows):
        for column in range(columns):
            upper = row * (columns + 1) + column
            lower = upper + columns + 1
            if row > 0:
                indices += [upper, lower, upper + 1]
            if row < rows - 1:
                indices += [upper + 1, lower, lower + 1]
    return [list(n) for n in normals], normals, uvs, indices


def png(pixels):
    """8-bit RGB PNG. Stored, not compressed: then no version of zlib changes a byte."""
    raw = b"".join(b"\0" + bytes(c for pixel in row for c in pixel) for row in pixels)
    stored = b"\x78\x01"
    for start in range(0, len(raw), 65535):
        block = raw[start:start + 65535]
        last = start + 65535 >= len(raw)
        stored += struct.pack("<BHH", last, len(block), len(block) ^ 0xFFFF) + block
    stored += struct.pack(">I", zlib.adler32(raw))

    def chunk(name, body):
        return struct.pack(">I", len(body)) + name + body + struct.pack(">I", zlib.crc32(name + body))

    header = struct.pack(">IIBBBBB", len(pixels[0]), len(pixels), 8, 2, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", stored) + chunk(b"IEND", b"")


def checkers(size, squares, dark, light):
    cell = size // squares
    return [[light if (x // cell + y // cell) % 2 else dark for x in range(size)] for y in range(size)]


def bumps(size, count):
    """Tangent-space normals of a wavy surface, as glTF encodes them."""
    def texel(x, y):
        angles = [2 * math.pi * count * (v + 0.5) / size for v in (x, y)]
        normal = normalized([-0.35 * math.cos(angles[0]), 0.35 * math.cos(angles[1]), 1.0])
        return [int((n * 0.5 + 0.5) * 255 + 0.5) for n in normal]
    return [[texel(x, y) for x in range(size)] for y in range(size)]


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

    state = 12345  # of a linear congruential generator, Numerical Recipes' constants

    def random(low, high):
        nonlocal state
        state = (state * 1664525 + 1013904223) % 2**32
        return low + (high - low) * (state >> 8) / 2**24

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
    different = []
    for name, make in (("box.gltf", box), ("gallery.gltf", gallery)):
        text = make().text().encode()
        path = folder / name
        if not check:
            path.write_bytes(text)
        elif not path.is_file() or path.read_bytes() != text:
            different.append(name)
    if different:
        sys.exit("differ from what this script makes: " + ", ".join(different))


if __name__ == "__main__":
    main()
