#!/usr/bin/env python3
"""Makes hostile inputs in a temporary folder, class by class, and judges the program on each. The program must end within time and memory, with
the right exit code and a few harmless lines.

    MESHFOLIO=build/release/meshfolio tests/hostile/hostile.py [--whole] [-v] [CLASS…]

--whole: larger inputs, and more inputs of each class."""

import hashlib
import json
import os
import pty
import socket
import struct
import subprocess
import sys
import threading
import unittest
import urllib.parse

from judge import PROGRAM, RAW, TETRAHEDRON, Hostile

WHOLE = "--whole" in sys.argv

NAMES = [
    b"plain", b"two words", b"it's", b'"quoted"', b"back`touch PWNED`tick", b"$(touch PWNED)", b";touch PWNED;", b"| touch PWNED", b"&",
    b"<script>alert(1)<", b"%s%n%d", b"%2e%2e", b"a\nb", b"a\rb", b"\x1b[31mred\x1b[0m", b"\x07\x08\x7f", b"\xff\xfe", b"\xc3(", b"\xed\xa0\x80",
    "a\u202eb".encode(), "\u2028".encode(), "\u0085".encode(), "é∞𝄞".encode(), b"-x", b"--help", b"{{title}}", b"a:b:3", b"a,b", b"=cmd()",
    b"..", b"con", b"\\", b"#", b"?q=1", b"x" * 251,
]


def good_meshes():
    """Returns a tetrahedron in every input format."""
    points = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
    faces = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
    text = "".join("%g %g %g\n" % p for p in points)
    lists = "".join("3 %d %d %d\n" % f for f in faces)
    header = ("ply\nformat %s 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 4\n"
              "property list uchar int vertex_indices\nend_header\n")

    def ply(order, name):
        body = b"".join(struct.pack(order + "3f", *p) for p in points) + b"".join(struct.pack(order + "B3i", 3, *f) for f in faces)
        return (header % name).encode() + body

    facet = "facet normal 0 0 0\nouter loop\n%sendloop\nendfacet\n"
    corners = [[points[v] for v in f] for f in faces]
    return {
        "m.obj": TETRAHEDRON.encode(),
        "m.off": f"OFF\n4 4 6\n{text}{lists}".encode(),
        "a.ply": (header % "ascii" + text + lists).encode(),
        "le.ply": ply("<", "binary_little_endian"),
        "be.ply": ply(">", "binary_big_endian"),
        "a.stl": ("solid s\n" + "".join(facet % "".join("vertex %g %g %g\n" % c for c in t) for t in corners) + "endsolid s\n").encode(),
        "b.stl": bytes(80) + struct.pack("<I", 4) + b"".join(struct.pack("<12fH", 0, 0, 0, *t[0], *t[1], *t[2], 0) for t in corners),
    }


class Names(Hostile):
    def test_meshes(self):
        for name in NAMES:
            with self.subTest(name):
                path = self.write(name + b".obj")
                self.assertIn(b"V=4 F=4 ", self.judge(0, "inspect", path).out)
                self.judge(0, "inspect", b"./" + name + b".obj")
                self.write(name + b".obj", TETRAHEDRON + "f 1 2 9\n")
                self.judge(3, "inspect", path, says=":9: vertex index 9")
                self.judge(3, "inspect", path + b".none", says="unknown mesh format|No such file|too long")

    def test_outputs(self):
        mesh = self.write("m.obj")
        for name in NAMES if WHOLE else NAMES[::3]:
            with self.subTest(name):
                made = os.path.join(os.fsencode(self.folder), name)
                self.judge(0, "curvature", mesh, "--csv", made + b".csv")
                self.judge(0, "noise", mesh, "--sigma", "0", "-o", made + b".ply")
                for ending in (b".csv", b".ply"):
                    os.remove(made + ending)
        self.assertEqual(sorted(os.listdir(self.folder)), ["m.obj"])

    def test_too_long(self):
        for name in ("x" * 300 + ".obj", "d/" * 2500 + "m.obj"):
            self.judge(3, "inspect", name, says="too long")

    def test_options(self):
        mesh = self.write("m.obj")
        for i, text in enumerate(NAMES):
            commands = (["inspect", mesh, b"--no-" + text], ["render", mesh, "--field", text], ["render", mesh, "--views", text],
                        ["report", "--only", text], ["report", b"--size=" + text], ["sample", b"./" + text, "-o", "x.obj"])
            for words in commands if WHOLE else commands[i % 2 :: 2]:
                if text == b"-x" and "--views" in words:
                    continue  # one of them
                self.judge(2, *words)


    def test_paths_on_a_terminal(self):
        """Output for programs has the path unchanged; on a terminal the path is escaped."""
        cache = os.path.join(os.fsencode(self.folder), b"\x1b]0;title\x07\xff")
        out = subprocess.run([PROGRAM, "cache"], env={"XDG_CACHE_HOME": cache}, capture_output=True, check=True).stdout
        self.assertTrue(out.startswith(cache + b"/meshfolio\n"), out)
        master, slave = pty.openpty()
        subprocess.run([PROGRAM, "cache"], env={"XDG_CACHE_HOME": cache}, stdout=slave, check=True)
        os.close(slave)
        shown = os.read(master, 4096).decode().replace("\r\n", "\n")
        os.close(master)
        self.assertIn("\\x1b]0;title\\x07", shown)
        self.assertIsNone(RAW.search(shown), shown)


class Nodes(Hostile):
    """Files that are not regular, given to every option that names an input."""

    def nodes(self):
        folder = self.folder
        os.mkdir(folder / "folder")
        os.mkfifo(folder / "fifo")
        listening = socket.socket(socket.AF_UNIX)
        self.addCleanup(listening.close)
        here = os.getcwd()
        os.chdir(folder)  # a socket's path must be short
        listening.bind("socket")
        os.chdir(here)
        for name, target in (("zero", "/dev/zero"), ("null", "/dev/null"), ("tty", "/dev/tty"), ("loop", "loop"), ("dangling", "nowhere"),
                             ("full", "/dev/full"), ("stdin", "/dev/stdin")):
            os.symlink(target, folder / name)
        return ["folder", "fifo", "socket", "zero", "null", "tty", "loop", "dangling", "full", "stdin"]

    def test_each(self):
        mesh = self.write("m.obj")
        for node in self.nodes():
            with self.subTest(node):
                for ending in ("obj", "off", "ply", "stl"):
                    os.symlink(node, self.folder / f"link.{ending}")
                    self.judge(3, "inspect", f"link.{ending}", says=rf"link\.{ending}: ")
                    os.remove(self.folder / f"link.{ending}")
                self.judge(3, "render", mesh, "--values", f"{node}:x", "--out", "views", says=node)
                self.judge(3, "report", "--from", node, "--out", "out", says=node)
                self.judge(2, "report", "--config", node, "--out", "out", says=node)
                self.write("t.toml", f'[report]\ntemplate = "{node}"\n')
                self.judge(2, "report", "--config", "t.toml", "--out", "out", says=r"t\.toml:2: ")
                if node != "dangling" and node != "loop":
                    os.makedirs(self.folder / "mine", exist_ok=True)
                    os.symlink(f"../{node}", self.folder / "mine" / "report.html")
                    self.judge(2, "report", "--templates", "mine", "--only", "q2", "--out", "out", says=r"report\.html: ")
                    os.remove(self.folder / "mine" / "report.html")
        self.assertFalse((self.folder / "out").exists() or (self.folder / "views").exists())

    def test_what_may_not_be_read(self):
        if os.geteuid() != 0:
            mesh = self.write("m.obj")
            os.chmod(mesh, 0)
            self.judge(3, "inspect", mesh, says="Permission denied")
            return
        mesh, settings = self.write("m.obj"), self.write("s.toml", "")
        for path in (mesh, settings):
            os.chmod(path, 0)
        os.chmod(self.folder, 0o755)
        self.judge(3, "inspect", mesh, says="Permission denied", as_nobody=True)
        self.judge(2, "report", "--config", settings, says="Permission denied", as_nobody=True)

    def test_files_that_change_while_they_are_read(self):
        line = b"v 0 0 0\n"
        path = self.write("m.obj", TETRAHEDRON.encode() + line * (1 << 18))
        size, stop = os.path.getsize(path), threading.Event()

        def shake():
            while not stop.is_set():
                os.truncate(path, 100)
                os.truncate(path, size)  # extends the file with NUL bytes

        thread = threading.Thread(target=shake)
        thread.start()
        try:
            for _ in range(40 if WHOLE else 8):
                self.judge((0, 3), "inspect", path)
        finally:
            stop.set()
            thread.join()

    def test_files_that_say_they_are_large(self):
        mesh = self.write("m.obj")
        for name, size, code, words, says in (
                ("s.obj", 3 << 30, 3, ["inspect", "s.obj"], "out of memory for the 3221225472 bytes"),
                ("l.ply", 5 << 30, 3, ["inspect", "l.ply"], "more than the limit of 4294967296"),
                ("s.toml", 2 << 20, 2, ["report", "--config", "s.toml"], "more than the limit of 1048576"),
                ("r.json", 300 << 20, 3, ["report", "--from", "r.json"], "more than the limit of 268435456"),
                ("v.csv", 2 << 30, 3, ["render", mesh, "--values", "v.csv:x"], "more than the limit of 1073741824")):
            with open(self.folder / name, "wb") as file:
                file.truncate(size)
            self.judge(code, *words, says=says)
        (self.folder / "mine").mkdir()
        with open(self.folder / "mine" / "report.md", "wb") as file:
            file.truncate(5 << 20)
        self.judge(2, "report", "--templates", "mine", says="more than the limit of 4194304")


class Encodings(Hostile):
    def test_meshes(self):
        for name, content in good_meshes().items():
            if name[0] not in "ma":
                continue
            text = content.decode()
            for label, code, changed in (
                    ("BOM", 0, b"\xef\xbb\xbf" + content), ("two BOMs", (0, 3), b"\xef\xbb\xbf" * 2 + content),
                    ("UTF-16", 3, text.encode("utf-16")), ("UTF-16 without BOM", 3, text.encode("utf-16-be")),
                    ("UTF-32", 3, text.encode("utf-32")), ("EBCDIC", 3, text.encode("cp037")), ("CR", 0, text.replace("\n", "\r").encode()),
                    ("CRLF", 0, text.replace("\n", "\r\n").encode()), ("NEL", 3, text.replace("\n", "\u0085").encode()),
                    ("LS", 3, text.replace("\n", "\u2028").encode()), ("NUL at the end", (0, 3), content + b"\0"),
                    ("NUL at the beginning", 3, b"\0" + content), ("^Z at the end", (0, 3), content + b"\x1a"),
                    ("no-break spaces", 3, text.replace(" ", "\u00a0").encode()), ("full-width digits", 3, text.replace("1", "\uff11").encode()),
                    ("gzip", 3, b"\x1f\x8b" + content), ("HTML", 3, b"<!DOCTYPE html><title>404</title>"), ("XML", 3, b"<?xml?><x/>")):
                with self.subTest(f"{name} {label}"):
                    self.judge(code, "inspect", self.write(name, changed))

    def test_settings(self):
        text = "[report]\ntitle = \"é\"\nsections = [\"q2\"]\nsize = 8\n"  # the last key is wrong, so no run begins
        for encoding in ("utf-16", "utf-16-be", "utf-32", "latin-1", "cp037"):
            self.judge(2, "report", "--config", self.write("s.toml", text.encode(encoding)), says=r"s\.toml:\d+: ")
        self.judge(2, "report", "--config", self.write("s.toml", b"\xef\xbb\xbf" + text.encode()), says=r"s\.toml:4: unknown key 'size'")
        self.judge(2, "report", "--config", self.write("s.toml", text.replace("\n", "\r\n")), says=r"s\.toml:4: unknown key 'size'")

    def test_values(self):
        mesh = self.write("m.obj")
        good = "vertex,x\n0,1\n1,2\n2,3\n3,4\n"
        for label, code, content in (
                ("good", 0, good), ("BOM", 0, b"\xef\xbb\xbf" + good.encode()), ("CRLF", 0, good.replace("\n", "\r\n")),
                ("CR", 0, good.replace("\n", "\r")), ("UTF-16", 3, good.encode("utf-16")), ("NUL", 3, good + "\0"), ("empty", 3, ""),
                ("semicolons", 0, good.replace(",", ";")), ("too few", 3, good[:-4]), ("too many", 3, good + "4,5\n"),
                ("cells", 3, good + "4,5,6\n"), ("ragged", 3, good.replace("2,3", "2,3,4")), ("nan", 0, good.replace("3", "nan")),
                ("inf", 3, good.replace("3", "inf")), ("1e999", 3, good.replace("3", "1e999")), ("1e308", 3, good.replace("3", "1e308")),
                ("hex", 3, good.replace("3", "0x3")), ("quoted", 0, good.replace("3", '"3"')), ("formula", 3, good.replace("3", "=1+1")),
                ("denormal", 0, good.replace("3", "5e-324")), ("minus zero", 0, good.replace("3", "-0")), ("all empty", 0, "x\n\n\n\n\n"),
                ("one line of commas", 3, "x" + "," * (1 << 24)), ("commas below", 3, "x\n" + "," * (1 << 24)), ("long word", 3, "x\n" + "9" * (1 << 24)),
                ("large", 0, good.replace("3", "1e100").replace("2", "-1e100"))):
            with self.subTest(label):
                self.judge(code, "render", mesh, "--size", "16", "--out", "views", "--values", self.write("v.csv", content) + b":x",
                           says=r"v\.csv(:\d+)?: " if code else None)


class Bombs(Hostile):
    def test_settings(self):
        for label, text in (
                ("dotted keys", "a" + ".a" * 400000 + " = 1"), ("table headers", "[a" + ".a" * 400000 + "]"),
                ("quoted keys", '"a"' + '."a"' * 200000 + " = 1"), ("lists", "a = " + "[" * 500000),
                ("inline tables", "a = " + "{a=" * 200000), ("dotted inline tables", "a = " + "{a.a.a.a.a.a.a.a.a.a=" * 40000),
                ("dotted keys of dotted tables", "".join("[" + ".".join(["a"] * 16) + "]\n" for _ in range(10000))),
                ("unknown keys", "".join(f"k{i} = 1\n" for i in range(50000))), ("one long key", "k" * 1000000 + " = 1"),
                ("one long text", "[report]\ntitle = \"" + "x" * 1000000 + '"'), ("list of a million", "[render]\nsize = [" + "1," * 500000 + "]"),
                ("questions", '[[question]]\nid = "q9"\n' * 30000), ("brackets", "[" * 1000000), ("escapes", 'a = "' + "\\" * 1000000)):
            with self.subTest(label):
                self.judge(2, "report", "--config", self.write("s.toml", text), "--out", "out", says=r"s\.toml:\d+: ")
        self.assertFalse((self.folder / "out").exists())

    def test_results(self):
        for label, text in (
                ("lists", "[" * 2000000), ("closed lists", "[" * 2000000 + "]" * 2000000), ("objects", '{"a":' * 1000000),
                ("in a known key", '{"schema_version": ' + "[" * 1000000 + "]" * 1000000 + "}"), ("a number", "1"), ("long number", "1" * 10000000),
                ("1e999", '{"schema_version": 1e999}'), ("long key", '{"' + "k" * 10000000 + '": 1}'), ("NaN", '{"schema_version": NaN}'),
                ("surrogate", '{"schema_version": "\\ud800"}'), ("version", '{"schema_version": "\\u001b[31m' + "x" * 100000 + '"}'),
                ("comment", "/* */ {}"), ("two", "{} {}"), ("empty", "")):
            with self.subTest(label):
                self.judge(3, "report", "--from", self.write("r.json", text), "--out", "out", says=r"r\.json(:\d+)?: ")
        self.assertFalse((self.folder / "out").exists())

    def test_templates(self):
        (self.folder / "mine").mkdir()
        deep = "{{#sections}}{{#blocks}}" * 10 + "x" + "{{/blocks}}{{/sections}}" * 10
        for label, text in (
                ("sections", "{{#title}}" * 50000 + "{{/title}}" * 50000), ("open sections", "{{#title}}" * 100000), ("lists in lists", deep),
                ("an include of itself", "{{>report.html}}"), ("two of them", "{{>report.html}}{{>report.html}}"),
                ("unknown include", "{{>none.html}}"), ("unknown tag", "{{none}}"), ("unclosed", "{{title"), ("unopened", "{{/title}}"),
                ("delimiters", "{{=<% %>=}}" + "<%#title%>" * 50000), ("no name", "{{}}"), ("only braces", "{" * 1000000),
                ("NUL", "\0{{none}}"), ("long tag", "{{" + "x" * 1000000 + "}}"), ("tags", "{{none}}" * 400000)):
            with self.subTest(label):
                self.write("mine/report.html", text)
                self.judge(2, "report", "--quick", "--size", "16", "--only", "q2", "--templates", "mine", "--out", "out", "--no-cache",
                           says=r"(report|none)\.html(:\d+)?: |none\.html")
        self.assertFalse((self.folder / "out").exists())

    def test_meshes(self):
        size = 8 if WHOLE else 1
        header = "ply\nformat %s 1.0\nelement vertex %s\nproperty float x\nproperty float y\nproperty float z\nelement face %s\nproperty list %s vertex_indices\nend_header\n"
        for name, code, content in (
                ("line.obj", 3, "v " + "1 " * (size << 22) + "\nf 1 2"), ("word.obj", 3, "v " + "1" * (size << 22)),
                ("corners.obj", 3, "v 0 0 0\nf " + "1 " * (size << 21)), ("gon.obj", 3, TETRAHEDRON + "f " + "1 2 3 " * 11000),
                ("slashes.obj", 3, TETRAHEDRON + "f " + "/" * (size << 22)), ("continued.obj", (0, 3), TETRAHEDRON + "\\\n" * (size << 20)),
                ("comments.obj", 3, "#" * (size << 22)), ("newlines.obj", 3, "\n" * (size << 22)),
                ("warnings.obj", 0, TETRAHEDRON + "".join(f"w{i} \x1b\n" for i in range(size << 18))),
                ("kinds.obj", 0, TETRAHEDRON + "f 1 1 2\nf 1 2\np 1\ncurv 0\ncsh ls\ncall x\nzz\nv 0 0 0 2\nv 0 0 0 0 0\n" * (size << 14)),
                ("duplicates.obj", 0, TETRAHEDRON + "f 1 3 2\n" * (size << 17)), ("fan.obj", 0, TETRAHEDRON + "".join(f"v 1 {i} 0\nf 1 2 -1\n" for i in range(size << 14))),
                ("star.obj", 0, TETRAHEDRON + "".join(f"v 2 {i} 0\nv 3 {i} {i}\nf 1 -1 -2\n" for i in range(size << 14))),
                ("zigzag.obj", (0, 3), "".join(f"v {i} {i % 2} 0\n" for i in range(20000)) + "f " + " ".join(map(str, range(1, 20001)))),
                ("spiral.obj", (0, 3), "".join("v %r %r 0\n" % (i * (-1) ** i, i * (-1) ** (i // 2)) for i in range(5000)) + "f " + " ".join(map(str, range(1, 5001)))),
                ("counts.off", 3, "OFF\n999999999 999999999 0\n"), ("zeros.off", 3, "OFF\n0 0 0\n"), ("numbers.off", 3, "OFF\n" + "9" * (1 << 20)),
                ("face.off", 3, "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n2000000000 0 1 2\n"), ("keyword.off", 3, "STCN4nOFF" * 100000),
                ("list.ply", 3, (header % ("binary_little_endian", 0, 1, "uint int")).encode() + b"\xff" * 100),
                ("lists.ply", 3, (header % ("binary_little_endian", 1, 1000000, "uchar int")).encode() + bytes(12 + 1000000)),
                ("elements.ply", 3, "ply\nformat ascii 1.0\n" + "element vertex 0\n" * (size << 16) + "end_header\n"),
                ("properties.ply", 3, "ply\nformat ascii 1.0\nelement vertex 1\n" + "property float x\n" * (size << 16) + "end_header\n"),
                ("header.ply", 3, "ply\nformat ascii 1.0\ncomment " + "x" * (size << 22)),
                ("count.stl", 3, bytes(80) + b"\xff\xff\xff\xff" + bytes(50)), ("solids.stl", 3, "solid\nendsolid\n" * (size << 16)),
                ("facets.stl", 3, "solid " + "facet " * (size << 16)), ("normals.stl", 3, "solid\n" + "facet normal " * (size << 16)),
                ("names.obj", 0, TETRAHEDRON + "g a\\\n" * (size << 16)),
                ("hub.obj", 0, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf " + "1 2 1 3 " * 8000),
                ("spikes.obj", 0, TETRAHEDRON + "".join(f"v {i % 89} {i * i % 97} 0\n" for i in range(90)) + "f " +
                 " ".join(str(5 + i * i * i % 90) for i in range(32000)))):
            with self.subTest(name):
                self.judge(code, "inspect", self.write(name, content))

    def test_columns(self):
        """Files below 100 kB with as many arrays, components and names as they can hold, read and written."""
        array = '<DataArray type="UInt8" Name="%s" NumberOfComponents="%d" format="%s"/>'
        points = '<Points><DataArray type="Float32" NumberOfComponents="3" format="ascii">%s</DataArray></Points>'
        polys = ('<Polys><DataArray type="Int32" Name="connectivity" format="ascii">0 2 1 0 1 3 0 3 2 1 2 3</DataArray>'
                 '<DataArray type="Int32" Name="offsets" format="ascii">3 6 9 12</DataArray></Polys>')
        cells = points % "0 0 0 1 0 0 0 1 0 0 0 1" + polys
        vtp = '<VTKFile type="PolyData" byte_order="LittleEndian"><PolyData>%s</PolyData>%s</VTKFile>'
        piece = '<Piece NumberOfPoints="%d"><PointData>%s</PointData>%s</Piece>'
        data = '<AppendedData encoding="raw">_' + "\xa0\x0f\0\0" + "\0" * 4000 + "</AppendedData>"
        empty = piece % (0, "".join(array % (i, 1000, "ascii") for i in range(1000)), points % "")
        shared = "".join(array % (i, 1000, 'appended" offset="0') for i in range(1000))
        ply = ("ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n%selement face 1\n"
               "property list uchar int vertex_indices\n%send_header\n%s3 0 1 2%s\n")
        rows = "".join(f"{i % 2} {i // 2} 0{{}}\n" for i in range(3))
        for name, code, content in (
                ("empty.vtp", 0, vtp % (empty + piece % (4, "", cells), "")), ("shared.vtp", 3, vtp % (piece % (4, shared, cells), data)),
                ("names.vtp", 0, vtp % (piece % (4, "", "<CellData>" + "".join(array % ("x" * 50 + str(i), 1, "ascii") for i in range(600))
                                                 + "</CellData>" + cells), "")),
                ("columns.ply", 0, ply % ("".join(f"property char p{i}\n" for i in range(3000)), "", rows.replace("{}", " 1" * 3000), "")),
                ("faces.ply", 0, ply % ("", "".join(f"property char p{i}\n" for i in range(5000)), rows.replace("{}", ""), " 1" * 5000))):
            with self.subTest(name):
                path = self.write(name, content.encode("latin-1"))
                for ending in ("vtp", "ply", "glb"):
                    self.judge(code, "noise", path, "--sigma", "0", "-o", f"out.{ending}")

    def test_links_of_templates(self):
        (self.folder / "mine").mkdir()
        os.symlink(self.write("secret"), self.folder / "mine" / "report.html")
        for command in (["report", "--only", "q2", "--out", "out"], ["lab", self.write("m.obj"), "-o", "lab.html"]):
            self.judge(2, *command, "--templates", "mine", says=r"report\.html: is a link that leads out")

    def test_folders_named_like_what_is_bundled(self):
        for name in ("laboratory", "bunny", "cow.obj"):
            (self.folder / name).mkdir()
        self.judge(0, "report", "--config", "laboratory", "--plan")


class Numbers(Hostile):
    def test_coordinates(self):
        for word, code in (("1e308", 3), ("1.7976931348623157e308", 3), ("1e100", 0), ("1.0000001e100", 3), ("-1e100", 0), ("5e-324", 0), ("-0", 0),
                           ("1e-400", 0), ("0x10", 3), ("1,5", 3), ("1.5.5", 3), ("1e", 3), ("e5", 3), (".", 3), ("+", 3), ("+-1", 3), ("1_000", 3),
                           ("١", 3), ("1e99999999999999999999", 3), ("0e99999999999999999999", 0), ("0." + "0" * 5000 + "1", 0),
                           ("1" + "0" * 400, 3), ("1f", 3), ("NaN(1)", 3), ("infinity", 3), ("1#INF", 3), ("½", 3), ("1'000", 3), ("(1)", 3)):
            for name, text in (("m.obj", TETRAHEDRON.replace("v 1 0 0", f"v {word} 0 0")),
                               ("m.off", f"OFF\n3 1 0\n0 0 0\n1 0 {word}\n0 1 0\n3 0 1 2\n"),
                               ("m.stl", f"solid\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 {word}\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n")):
                with self.subTest(f"{name} {word:.40}"):
                    self.judge(code, "inspect", self.write(name, text), says=name if code else None)

    def test_scales(self):
        """At the limits of accepted numbers, all output is finite or empty."""
        for scale in ("1e100", "1e-100", "1e-300", "5e-324", "1e-160", "1e75"):
            mesh = self.write("m.obj", TETRAHEDRON.replace("1 0 0", f"{scale} 0 0").replace("0 1 0", f"0 {scale} 0").replace("0 0 1", f"0 0 {scale}"))
            for words in (["curvature", mesh, "--jets"], ["inspect", mesh, "--json"], ["inspect", mesh], ["spectrum", mesh, "-k", "3"]):
                with self.subTest(f"{scale} {words[0]}"):
                    outcome = self.judge((0, 1, 3), *words)
                    text = outcome.out.decode()
                    self.assertNotRegex(text, r"(?i)(?<![a-z])(nan|inf|infinity)(?![a-z])")
                    if "--json" in words and outcome.code == 0:
                        json.loads(text, parse_constant=self.fail)

    def test_indices(self):
        for word in ("0", "5", "-5", "4294967297", "9" * 30, "-" + "9" * 30, "1.0", "1e0", "0x1", "+", "-", "1/", "1//", "/1", "1/1/1/1", "²", "1;"):
            with self.subTest(word):
                self.judge(3, "inspect", self.write("m.obj", TETRAHEDRON + f"f 1 2 {word}\n"), says=r"m\.obj:9: ")

    def test_options(self):
        mesh = self.write("m.obj")
        for word in ("nan", "inf", "1e999", "0x1", "1;5", "", " 1", "1 ", "--1", "١", "9" * 40):
            for words in (["smooth", mesh, "-o", "x.ply", f"--lambda={word}"], ["spectrum", mesh, f"-k={word}"], ["render", mesh, f"--size={word}"],
                          ["render", mesh, "--field", "x", f"--range=0,{word}"], ["noise", mesh, "-o", "x.ply", f"--sigma={word}"],
                          ["report", f"--threads={word}"], ["report", f"--size={word}"], ["sample", "cube", "-o", "x.ply", f"--subdivide={word}"]):
                with self.subTest(" ".join(map(str, words))):
                    if word == "9" * 40 and words[0] in ("smooth", "noise") or word == "9" * 40 and "--field" in words:
                        continue  # a finite number
                    if word == "" and words[0] == "report":
                        continue  # as if it were not given
                    self.judge(2, *words)
        self.assertEqual(os.listdir(self.folder), ["m.obj"])


class Corpus(Hostile):
    """Meshes of MESHFOLIO_BAD_MESHES, a folder with a manifest.tsv. Output for accepted meshes has no undefined numbers."""

    def test_numbers(self):
        folder = os.environ.get("MESHFOLIO_BAD_MESHES")
        if not folder:
            self.skipTest("MESHFOLIO_BAD_MESHES is not set")
        with open(os.path.join(folder, "manifest.tsv"), encoding="utf-8") as file:
            rows = [line.split("\t") for line in file.read().split("\n")[1:-1]]
        for row in rows:
            if row[2] == "reject" or not (WHOLE or row[0].startswith("topo/")):
                continue
            mesh = os.path.join(folder, urllib.parse.unquote(row[0]))
            for words in (["curvature", mesh], ["inspect", mesh, "--json"], ["inspect", mesh], ["smooth", mesh, "-o", "s.obj", "--lambda", "1e-6"]):
                with self.subTest(row[0] + " " + words[0]):
                    outcome = self.judge((0, 1, 3), *words)
                    if words[0] == "smooth" and outcome.code == 0:
                        text = (self.folder / "s.obj").read_text()
                    else:
                        text = outcome.out.decode()
                    self.assertNotRegex(text, r"(?i)(?<![a-z])(nan|inf|infinity)(?![a-z])")
                    if "--json" in words and outcome.code == 0:
                        json.loads(text, parse_constant=self.fail)


class Cache(Hostile):
    def entries(self):
        return [path for path in (self.folder / "cache" / "meshfolio" / "entries").rglob("*") if path.is_file()]

    def test_an_entry_cannot_leave_the_report(self):
        report = ["report", "--quick", "--size", "16", "--only", "q2", "--no-timings", "--out"]
        self.judge(0, *report, "out/a")
        objects = {hashlib.sha256(path.read_bytes()).hexdigest(): path for path in (self.folder / "cache/meshfolio/objects").rglob("*") if path.is_file()}
        changed = 0
        for path in self.entries():
            sums = dict(reversed(line.split("  ", 1)) for line in path.read_bytes()[64:].decode(errors="replace").split("\n") if "  " in line)
            if "results.json" not in sums:
                continue
            old = objects[sums["results.json"]]
            results = json.loads(old.read_bytes())
            results["questions"][0]["output_meshes"] = ["../../../escaped"]
            content = json.dumps(results).encode()
            digest = hashlib.sha256(content).hexdigest()
            new = self.folder / "cache/meshfolio/objects" / digest[:2] / digest[2:]
            new.parent.mkdir(exist_ok=True)
            new.write_bytes(content)
            sums |= {"results.json": digest, "../../../escaped": sums["results.json"]}
            entry = "".join(f"{sum}  {name}\n" for name, sum in sums.items()).encode()
            path.write_bytes(hashlib.sha256(entry).hexdigest().encode() + entry)
            changed += 1
        self.assertGreater(changed, 0)
        self.judge(0, *report, "out/b")
        self.assertEqual(sorted(os.listdir(self.folder)), ["cache", "out"])
        self.assertEqual((self.folder / "out/a/results.json").read_bytes(), (self.folder / "out/b/results.json").read_bytes())

    def test_damaged_entries_are_made_again(self):
        report = ["report", "--quick", "--size", "16", "--only", "q2", "--no-timings", "--out"]
        self.judge(0, *report, "a")
        expected = (self.folder / "a/results.json").read_bytes()
        for content in (b"", b"\0" * 64, b"x" * 100, lambda old: old[:-1], lambda old: old[:64] + b"[" * 100000,
                        lambda old: hashlib.sha256(b"[" * 100000).hexdigest().encode() + b"[" * 100000,
                        lambda old: hashlib.sha256(b"[[]]").hexdigest().encode() + b"[[]]"):
            for path in self.entries():
                path.write_bytes(content if isinstance(content, bytes) else content(path.read_bytes()))
            self.judge(0, *report, "b")
            self.assertEqual((self.folder / "b/results.json").read_bytes(), expected)


if __name__ == "__main__":
    sys.argv = [word for word in sys.argv if word != "--whole"]
    unittest.main()
