"""Reads binary glTF 2.0 with the standard library alone, and checks the requirements of the format."""

import json
import struct

SIZES = {5120: ("b", 1), 5121: ("B", 1), 5123: ("H", 2), 5125: ("I", 4), 5126: ("f", 4)}
COLUMNS = {"SCALAR": 1, "VEC3": 3, "VEC4": 4}
LARGEST = {5120: 127, 5121: 255, 5123: 65535}


class Glb:
    def __init__(self, data):
        magic, version, length = struct.unpack("<4sII", data[:12])
        assert (magic, version, length) == (b"glTF", 2, len(data))
        chunks, at = {}, 12
        while at < len(data):
            size, kind = struct.unpack("<I4s", data[at : at + 8])
            assert size % 4 == 0, "chunks are aligned"
            chunks[kind] = data[at + 8 : at + 8 + size]
            at += 8 + size
        assert at == len(data) and list(chunks) == [b"JSON", b"BIN\0"]
        self.json, self.binary = json.loads(chunks[b"JSON"], parse_constant=self.refuse), chunks[b"BIN\0"]
        (buffer,) = self.json["buffers"]
        assert len(self.binary) - 3 <= buffer["byteLength"] <= len(self.binary)
        self.check_views()
        self.mesh = self.json["meshes"][0]
        (self.primitive,) = self.mesh["primitives"]
        self.extras = self.mesh.get("extras")
        self.indices = self.indices_of(self.mesh)
        self.attributes = {name: self.rows(number) for name, number in self.primitive["attributes"].items()}
        count = len(self.attributes["POSITION"])
        assert {len(rows) for rows in self.attributes.values()} == {count}
        assert len(self.indices) % 3 == 0 and 0 <= min(self.indices) and max(self.indices) < count

    @staticmethod
    def refuse(constant):
        raise AssertionError(f"{constant} is not JSON")

    def check_views(self):
        end = 0
        for view in self.json["bufferViews"]:
            assert view["byteOffset"] % 4 == 0 and view["byteOffset"] >= end
            assert ("byteStride" in view) == (view["target"] == 34962)
            assert view.get("byteStride", 4) % 4 == 0 and view.get("byteStride", 4) >= 4
            end = view["byteOffset"] + view["byteLength"]
        assert end <= self.json["buffers"][0]["byteLength"]

    def rows(self, number):
        """Returns the values of an accessor; normalised integers become numbers between −1 and 1."""
        accessor = self.json["accessors"][number]
        view = self.json["bufferViews"][accessor["bufferView"]]
        letter, size = SIZES[accessor["componentType"]]
        columns = COLUMNS[accessor["type"]]
        stride = view.get("byteStride", columns * size)
        assert (accessor["count"] - 1) * stride + columns * size <= view["byteLength"]
        starts = (view["byteOffset"] + i * stride for i in range(accessor["count"]))
        rows = [struct.unpack_from(f"<{columns}{letter}", self.binary, start) for start in starts]
        for name, choose in (("min", min), ("max", max)):
            if name in accessor:
                assert list(map(choose, zip(*rows))) == accessor[name], name
        if accessor.get("normalized"):
            rows = [tuple(c / LARGEST[accessor["componentType"]] for c in row) for row in rows]
        return rows

    def indices_of(self, mesh):
        (primitive,) = mesh["primitives"]
        return [i for (i,) in self.rows(primitive["indices"])]

    def positions(self, node=0):
        node = self.json["nodes"][node]
        move, scale = node.get("translation", [0, 0, 0]), node.get("scale", [1, 1, 1])
        return [[t + s * x for t, s, x in zip(move, scale, row)] for row in self.attributes["POSITION"]]

    def bodies(self):
        """Returns the corners of the triangles of each node of the scene."""
        assert self.json["scenes"][self.json["scene"]]["nodes"] == list(range(len(self.json["nodes"])))
        meshes = [self.json["meshes"][node["mesh"]] for node in self.json["nodes"]]
        return [[self.positions(number)[i] for i in self.indices_of(mesh)] for number, mesh in enumerate(meshes)]
