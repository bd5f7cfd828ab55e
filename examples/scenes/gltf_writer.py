# SPDX-License-Identifier: Apache-2.0
"""A writer of text glTF with geometry and textures as data URIs, some shapes and some pictures.

Only integer arithmetic and correctly rounded operations decide a byte, apart from sines, which are
rounded to float.
"""
import base64
import json
import math
import struct
import zlib


class Scene:
    """Collects a glTF file; each geometry goes into one buffer and may serve many materials."""

    def __init__(self, camera, background=None, lens=None, **extras):
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
            extras["background"] = background
        if extras:
            self.gltf["scenes"][0]["extras"] = extras
        position, target, yfov = camera
        self.append("cameras", {"type": "perspective", "perspective": {"yfov": yfov, "znear": 0.01}})
        if lens:
            self.gltf["cameras"][0]["extras"] = lens
        self.node(camera=0, matrix=look_at(position, target))
        self.materials, self.meshes, self.extensions = {}, {}, set()

    def append(self, collection, value):
        self.gltf.setdefault(collection, []).append(value)
        return len(self.gltf[collection]) - 1

    def node(self, **members):
        number = self.append("nodes", members)
        self.gltf["scenes"][0]["nodes"].append(number)
        return number

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
            extensions.setdefault("specular", {"specularFactor": 0.0})  # a lamp is matte
        if "transmission" in extensions:
            extensions.setdefault("volume", {"thicknessFactor": 1.0})  # a body, not a pane
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
        return self.node(mesh=self.meshes[key], **transform)

    def point_light(self, position, color, intensity):
        lights = self.gltf.setdefault("extensions", {}).setdefault("KHR_lights_punctual", {"lights": []})
        lights["lights"].append({"type": "point", "color": color, "intensity": intensity})
        self.node(translation=position,
                  extensions={"KHR_lights_punctual": {"light": len(lights["lights"]) - 1}})
        self.extensions.add("KHR_lights_punctual")

    def animate(self, node, path, times, values):
        """Keys of a node's translation, rotation or scale, linear in between."""
        sampler = {"input": self.accessor(times, "SCALAR", 5126, min=[times[0]], max=[times[-1]]),
                   "output": self.accessor(values, f"VEC{len(values[0])}", 5126)}
        self.append("animations", {"samplers": [sampler],
                                   "channels": [{"sampler": 0, "target": {"node": node, "path": path}}]})

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


def radiance_hdr(rows):
    """A picture in Radiance's format, RGBE without run lengths, from rows of linear RGB."""
    def encoded(pixel):
        largest = max(pixel)
        if largest < 1e-32:
            return b"\0\0\0\0"
        mantissa, exponent = math.frexp(largest)
        scale = mantissa * 256.0 / largest
        return bytes([int(c * scale) for c in pixel] + [exponent + 128])

    header = f"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {len(rows)} +X {len(rows[0])}\n"
    return header.encode() + b"".join(encoded(pixel) for row in rows for pixel in row)
