"""Readers of the files that meshfolio writes, independent of its code."""

import struct
import zlib


def read(path):
    with open(path, 'rb') as file:
        return file.read()


def obj(path):
    """Returns vertices and triangles of an OBJ file of plain triangles."""
    vertices, triangles = [], []
    for line in read(path).decode().splitlines():
        words = line.split()
        if words[:1] == ['v']:
            vertices.append(tuple(map(float, words[1:4])))
        elif words[:1] == ['f']:
            triangles.append(tuple(int(w.split('/')[0]) - 1 for w in words[1:4]))
    return vertices, triangles


def ply(path):
    """Returns vertices and triangles of a binary little-endian PLY file with double coordinates."""
    data = read(path)
    end = data.index(b'end_header\n') + len(b'end_header\n')
    header = data[:end].decode().split('\n')
    assert header[0] == 'ply' and header[1] == 'format binary_little_endian 1.0', header
    counts = {words[1]: int(words[2]) for words in map(str.split, header) if words[:1] == ['element']}
    at = end
    vertices = [struct.unpack_from('<3d', data, at + 24 * i) for i in range(counts['vertex'])]
    at += 24 * counts['vertex']
    triangles = []
    for i in range(counts['face']):
        assert data[at + 13 * i] == 3
        triangles.append(struct.unpack_from('<3i', data, at + 13 * i + 1))
    assert at + 13 * counts['face'] == len(data)
    return vertices, triangles


def png_size(path):
    """Checks the chunks and the pixels of an 8-bit PNG. Returns its width and height."""
    data = read(path)
    assert data[:8] == b'\x89PNG\r\n\x1a\n', path
    at, pixels, header = 8, b'', None
    while at < len(data):
        length, kind = struct.unpack_from('>I4s', data, at)
        body = data[at + 8:at + 8 + length]
        assert zlib.crc32(kind + body) == struct.unpack_from('>I', data, at + 8 + length)[0], path
        if kind == b'IHDR':
            header = struct.unpack('>IIBB', body[:10])
        if kind == b'IDAT':
            pixels += body
        at += 12 + length
    width, height, depth, kind = header
    channels = {2: 3, 6: 4}[kind]
    assert depth == 8 and len(zlib.decompress(pixels)) == height * (1 + width * channels), path
    return width, height


def png(path):
    """Returns width, height and rows of (r, g, b) of an 8-bit PNG, without alpha."""
    data = read(path)
    assert data[:8] == b'\x89PNG\r\n\x1a\n'
    at, packed = 8, b''
    while at < len(data):
        length, kind = struct.unpack_from('>I4s', data, at)
        body = data[at + 8:at + 8 + length]
        assert zlib.crc32(kind + body) == struct.unpack_from('>I', data, at + 8 + length)[0]
        if kind == b'IHDR':
            width, height, depth, color = struct.unpack('>IIBB', body[:10])
        elif kind == b'IDAT':
            packed += body
        at += 12 + length
    assert depth == 8 and color in (2, 6)
    step = 3 if color == 2 else 4
    return width, height, _unfiltered(zlib.decompress(packed), width, height, step)


def _unfiltered(raw, width, height, step):
    rows, previous, stride = [], bytes(width * step), width * step
    for y in range(height):
        kind = raw[y * (stride + 1)]
        line = bytearray(raw[y * (stride + 1) + 1:(y + 1) * (stride + 1)])
        for x in range(stride):
            left = line[x - step] if x >= step else 0
            up, corner = previous[x], previous[x - step] if x >= step else 0
            if kind == 1:
                add = left
            elif kind == 2:
                add = up
            elif kind == 3:
                add = (left + up) // 2
            elif kind == 4:
                p = left + up - corner
                distances = (abs(p - left), abs(p - up), abs(p - corner))
                add = (left, up, corner)[distances.index(min(distances))]
            else:
                add = 0
            line[x] = (line[x] + add) & 255
        previous = bytes(line)
        rows.append([tuple(previous[i:i + 3]) for i in range(0, stride, step)])
    return rows
