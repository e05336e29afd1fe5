"""Reads the lines of a PDF and their positions with poppler."""

import re
import subprocess
from collections import Counter
from dataclasses import dataclass
from html import unescape

POINTS = 72 / 25.4   # a millimetre
WORD = re.compile(r'<word xMin="([^"]*)" yMin="([^"]*)" xMax="([^"]*)" yMax="([^"]*)">(.*?)</word>')


@dataclass
class Line:
    page: int                                   # from 1
    left: float                                 # [mm]
    top: float
    right: float
    bottom: float
    words: list                                 # [(left, right, text)]
    height: float                               # of most of its letters, [pt]

    @property
    def text(self):
        return " ".join(text for _, _, text in self.words)


def lines_of(path):
    said = subprocess.run(["pdftotext", "-bbox-layout", path, "-"], capture_output=True, text=True, check=True, timeout=120).stdout
    lines = []
    for number, page in enumerate(said.split("<page ")[1:], 1):
        for line in re.findall(r"<line [^>]*>(.*?)</line>", page, re.S):
            found = [(*(float(x) for x in word[:4]), unescape(word[4])) for word in WORD.findall(line)]
            heights = Counter()
            for _, top, _, bottom, text in found:
                heights[round(bottom - top, 1)] += len(text)
            box = [min(w[0] for w in found), min(w[1] for w in found), max(w[2] for w in found), max(w[3] for w in found)]
            words = [(left / POINTS, right / POINTS, text) for left, _, right, _, text in found]
            lines.append(Line(number, *(x / POINTS for x in box), words, heights.most_common(1)[0][0]))
    return lines


def running_text(lines):
    """Returns the lines of paragraphs: those in the size of most letters, without captions, tables, names in figures and formulas."""
    letters = Counter()
    for line in lines:
        letters[line.height] += len(line.text)
    body = letters.most_common(1)[0][0]
    return [line for line in lines if line.height == body]
