"""Printed sizes of the words of a PDF, read from its content streams as qpdf writes them out."""

import base64
import json
import re
import subprocess
from dataclasses import dataclass

TOKEN = re.compile(
    rb"\s+|%[^\n]*|(?P<string>\((?:\\.|[^\\()])*\))|<(?P<hex>[0-9A-Fa-f\s]*)>|(?P<mark><<|>>|\[|\])|/(?P<name>[^\s/<>\[\](){}%]*)"
    rb"|(?P<number>[+-]?(?:\d+\.?\d*|\.\d+))(?![\w*'\"])|(?P<word>[A-Za-z'\"][\w*'\"]*)",
    re.S,
)


@dataclass
class Shown:
    """The text that one operator shows."""

    page: int       # from 1
    size: float     # [pt] on paper
    glyphs: int


def times(a, b):
    """Returns the PDF matrix (a, b, c, d, e, f) that applies a, then b."""
    return (
        a[0] * b[0] + a[1] * b[2], a[0] * b[1] + a[1] * b[3],
        a[2] * b[0] + a[3] * b[2], a[2] * b[1] + a[3] * b[3],
        a[4] * b[0] + a[5] * b[2] + b[4], a[4] * b[1] + a[5] * b[3] + b[5],
    )  # fmt: skip


class Reader:
    def __init__(self, path):
        command = ["qpdf", "--json=2", "--json-stream-data=inline", "--decode-level=generalized", "--json-key=qpdf", "--json-key=pages", str(path)]
        found = json.loads(subprocess.run(command, capture_output=True, check=True, timeout=120).stdout)
        self.objects = found["qpdf"][1]
        self.pages = [page["object"] for page in found["pages"]]
        self.shown = []
        for self.page, name in enumerate(self.pages, 1):
            page = self.value(name)
            contents = self.value(page["/Contents"])
            streams = contents if isinstance(contents, list) else [page["/Contents"]]
            self.read(b"\n".join(map(self.content, streams)), self.inherited(page, "/Resources"), (1, 0, 0, 1, 0, 0))

    def value(self, name):
        """Resolves a reference to its object."""
        if not (isinstance(name, str) and re.fullmatch(r"\d+ \d+ R", name)):
            return name
        found = self.objects["obj:" + name]
        return found["stream"]["dict"] if "stream" in found else found["value"]

    def inherited(self, page, key):
        return self.value(page[key] if key in page else self.inherited(self.value(page["/Parent"]), key))

    def content(self, name):
        return base64.b64decode(self.objects["obj:" + name]["stream"]["data"])

    def read(self, stream, resources, matrix):
        """Follows the matrices and the font size through a stream and the forms it draws."""
        forms = self.value(resources.get("/XObject", {}))
        stack, saved, size, text = [], [], 0.0, (1, 0, 0, 1, 0, 0)
        for token in TOKEN.finditer(stream):
            if token["number"] is not None:
                stack.append(float(token["number"]))
            elif token["name"] is not None:
                stack.append("/" + token["name"].decode())
            elif token["hex"] is not None or token["string"] is not None:
                stack.append(token)
            if token["word"] is None:
                continue
            word, numbers = token["word"].decode(), [x for x in stack if isinstance(x, float)]
            if word == "q":
                saved.append((matrix, size))
            elif word == "Q":
                matrix, size = saved.pop()
            elif word == "cm":
                matrix = times(numbers[-6:], matrix)
            elif word == "BT":
                text = (1, 0, 0, 1, 0, 0)
            elif word == "Tm":
                text = numbers[-6:]
            elif word == "Tf":
                size = numbers[-1]
            elif word in ("Tj", "TJ", "'", '"'):
                a, b, c, d, _, _ = times(text, matrix)
                glyphs = sum(len(x["hex"]) // 4 if x["hex"] is not None else len(x["string"]) - 2 for x in stack if isinstance(x, re.Match))
                self.shown.append(Shown(self.page, size * abs(a * d - b * c) ** 0.5, glyphs))
            elif word == "Do":
                form = forms.get(stack[-1])
                if form and self.value(form)["/Subtype"] == "/Form":
                    inner = self.value(form)
                    self.read(self.content(form), self.value(inner.get("/Resources", resources)), times(inner.get("/Matrix", (1, 0, 0, 1, 0, 0)), matrix))
            stack = []


def shown_in(path):
    """Returns all text of the PDF in the order of its streams."""
    return Reader(path).shown


def too_small(shown, least, script, longest_script):
    """Returns [(page, size, glyphs)] of text smaller than `least`. Indices and exponents do not count: at most `longest_script` glyphs in a row
    between words of full size on the same page, none smaller than `script`."""
    found, row = [], []

    def end_row():
        if sum(s.glyphs for s in row) > longest_script or any(s.size < script for s in row):
            found.extend((s.page, round(s.size, 2), s.glyphs) for s in row)
        row.clear()

    for one in shown:
        if one.size >= least - 0.01 or (row and row[-1].page != one.page):
            end_row()
        if one.size < least - 0.01:
            row.append(one)
    end_row()
    return found
