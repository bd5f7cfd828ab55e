# SPDX-License-Identifier: Apache-2.0
"""Reads and writes PNG pictures of 8-bit RGB, as rows of (r, g, b), without a library for it."""
import struct
import zlib

SIGNATURE = b"\x89PNG\r\n\x1a\n"


def chunks(data):
    at = len(SIGNATURE)
    while at < len(data):
        length, = struct.unpack_from(">I", data, at)
        yield data[at + 4:at + 8], data[at + 8:at + 8 + length]
        at += length + 12


def unfiltered(kind, coded, above):
    """A line from what one of the format's filters made of it; both begin with a pixel that stands left of all."""
    line = bytearray(3)
    if kind == 0:
        return line + coded
    for k, value in enumerate(coded):
        left, up = line[k], above[k + 3]
        if kind == 4:
            corner = above[k]
            a, b, c = abs(up - corner), abs(left - corner), abs(left + up - 2 * corner)
            guess = left if a <= b and a <= c else up if b <= c else corner
        else:
            guess = left if kind == 1 else up if kind == 2 else (left + up) // 2
        line.append(value + guess & 255)
    return line


def read(path):
    data = path.read_bytes()
    parts = list(chunks(data))
    width, height, *kind = struct.unpack(">IIBBBBB", parts[0][1])
    if data[:8] != SIGNATURE or kind != [8, 2, 0, 0, 0]:
        raise ValueError(f"{path} is not an 8-bit RGB picture without interlacing")
    raw = zlib.decompress(b"".join(body for name, body in parts if name == b"IDAT"))
    stride, rows, line = 3 * width, [], bytes(3 * width + 3)
    for start in range(0, height * (stride + 1), stride + 1):
        line = unfiltered(raw[start], raw[start + 1:start + 1 + stride], line)
        rows.append([tuple(line[k:k + 3]) for k in range(3, stride + 3, 3)])
    return rows


def write(path, rows):
    """By a palette where 256 colours are enough, else as differences from the pixel to the left: both are smaller."""
    colors = sorted({pixel for row in rows for pixel in row})
    number = {color: k for k, color in enumerate(colors)}
    indexed = len(colors) <= 256
    raw = bytearray()
    for row in rows:
        flat = bytes(c for pixel in row for c in pixel)
        raw += b"\0" + bytes(number[pixel] for pixel in row) if indexed else \
            b"\1" + bytes(c - left & 255 for c, left in zip(flat, bytes(3) + flat))

    def chunk(name, body):
        return struct.pack(">I", len(body)) + name + body + struct.pack(">I", zlib.crc32(name + body))
    header = struct.pack(">IIBBBBB", len(rows[0]), len(rows), 8, 3 if indexed else 2, 0, 0, 0)
    palette = chunk(b"PLTE", bytes(c for color in colors for c in color)) if indexed else b""
    path.write_bytes(SIGNATURE + chunk(b"IHDR", header) + palette + chunk(b"IDAT", zlib.compress(raw, 9)) +
                     chunk(b"IEND", b""))


def beside(pictures, gap=4):
    """Pictures of one height in a row, with grey between."""
    between = [(128, 128, 128)] * gap
    return [[pixel for k, line in enumerate(lines) for pixel in between * (k > 0) + line] for lines in zip(*pictures)]
