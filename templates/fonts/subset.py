"""Makes one face of the report's fonts: subset.py SOURCE FACE OUT, where FACE is "serif-italic" and so on.

Writes OUT.woff2 for pages and OUT.ttf for pictures: the characters below with TrueType outlines (Chromium prints others as fonts of type 3),
named "Report Serif" and so on, since the licences ask for another name once a font is changed; and OUT.h, the widths of its characters.
The same input gives the same bytes.
"""
import sys

from fontTools import subset
from fontTools.pens.cu2quPen import Cu2QuPen
from fontTools.pens.ttGlyphPen import TTGlyphPen
from fontTools.ttLib import TTFont, newTable

# The characters of each font, as far as its source has them, in hexadecimal. tests/report/page/fonts_test.cpp holds this against all words and formulas.
SYMBOLS = ("2009 200A 2010-2016 2018-201E 2020-2022 2026 202F 2030 2032 2033 2039 203A 2044 2060-2064 20AC 210E 2113 2122 2153-215E 2190-2195 "
           "21A6 21D2 21D4 2200 2202 2203 2205-2209 220B 220F 2211-2213 2215-221A 221D 221E 2225 2227-222B 223C 2243 2245 2248 2260 2261 "
           "2264 2265 226A 226B 227A 227B 2282-2287 2295 2297 22A4 22A5 22C5 25A0 25A1 25B2 25B4 25B6 25BC 25BE 25C0 25CB 25CF 25D0 2605 "
           "2713 2715 2717 27E8 27E9 2AB0")
GREEK = "391-3A9 3B1-3C9 3D1 3D5 3F5"
TEXT = f"20-7E A0-17F 2C6 2DC 300-304 306-308 30A 30C {GREEK} {SYMBOLS}"
# Letters of formulas: bold, italic, script capitals, bold and italic Greek, number sets.
MATH = (f"20-7E A0 A7 AC AF-B4 B7 D7 F7 2C6 2C7 2D8-2DA 2DC 300-304 306-308 30A 30C 20D7 {GREEK} {SYMBOLS} 2308-230B 1D400-1D467 "
        "1D49C-1D4B5 2102 210B 2110 2112 211B 212C 2130 2131 2133 2115 211A 211D 2124 1D53C 1D6A8-1D71B")
SETS = {"serif": TEXT, "sans": TEXT, "math": MATH, "mono": "20-7E A0-FF 2013 2014 2018 2019 201C 201D 2026 2190-2193 2212 2264 2265 25B4 25BE 25D0 2713 2715 2717"}
FEATURES = ["kern", "liga", "ccmp", "mark", "mkmk", "tnum", "lnum"]
RAISED, LOWERED = dict(zip("⁰¹²³⁴⁵⁶⁷⁸⁹⁺⁻⁽⁾ᵀᵈᵏᵖᵗ", "0123456789+−()Tdkpt")), dict(zip("₀₁₂₃₄₅₆₇₈₉₊₋ᵢⱼ", "0123456789+−ij"))


def reduce(font, kind):
    ranges = [part.split("-") for part in SETS[kind].split()]
    numbers = {c for ends in ranges for c in range(int(ends[0], 16), int(ends[-1], 16) + 1)} | set(map(ord, [*RAISED, *LOWERED, *"−ij"]))
    subsetter = subset.Subsetter(subset.Options(layout_features=FEATURES, hinting=False, notdef_outline=True, name_IDs=[0, 13, 14],
                                                drop_tables=[*subset.Options().drop_tables, "FFTM"]))
    subsetter.populate(unicodes=numbers)
    subsetter.subset(font)


def turn_into_truetype(font):
    """Quadratic curves within a thousandth of the em: a quarter of a printer's dot at 30 points."""
    order, outlines, glyphs = font.getGlyphOrder(), font.getGlyphSet(), {}
    for name in order:
        pen = TTGlyphPen(None)
        outlines[name].draw(Cu2QuPen(pen, font["head"].unitsPerEm / 1000, reverse_direction=True))
        glyphs[name] = pen.glyph()
    font["loca"], font["glyf"], font["maxp"] = newTable("loca"), newTable("glyf"), newTable("maxp")
    font["glyf"].glyphOrder, font["glyf"].glyphs = order, glyphs
    font["maxp"].tableVersion, font["maxp"].numGlyphs, font["maxp"].maxZones = 0x00010000, len(order), 1
    for name in ("maxTwilightPoints", "maxStorage", "maxFunctionDefs", "maxInstructionDefs", "maxStackElements", "maxSizeOfInstructions"):
        setattr(font["maxp"], name, 0)
    del font["CFF "]
    font.sfntVersion = "\0\1\0\0"


def add_scripts(font):
    """Draws raised and lowered characters from those they stand for, all alike: text fonts have ¹²³ and few more."""
    cmap, em, size = font.getBestCmap(), font["head"].unitsPerEm, 0.64
    if all(ord(small) in cmap for small in "⁰⁴⁵⁶⁷⁸⁹"):
        return
    for small, large in {**RAISED, **LOWERED}.items():
        base, name = cmap[ord(large)], f"small{ord(small):X}"
        pen = TTGlyphPen(font["glyf"].glyphs)
        pen.addComponent(base, (size, 0, 0, size, 0, round((0.33 if small in RAISED else -0.15) * em)))
        font["glyf"][name] = pen.glyph()
        font["hmtx"][name] = (round(size * font["hmtx"][base][0] + 0.02 * em), 0)
        for table in font["cmap"].tables:
            table.cmap[ord(small)] = name


def suit_chromium(font):
    """MathML Core sets exponents without the italic correction, and the largest integral below DisplayOperatorMinHeight."""
    math = font["MATH"].table
    math.MathConstants.DisplayOperatorMinHeight = round(2.1 * font["head"].unitsPerEm)
    # It also moves scripts of single letters by their heights, as TeX moves only those of boxes: a² and b², x_i and p_i on one line.
    math.MathConstants.SubscriptBaselineDropMin.Value = 0
    math.MathConstants.SuperscriptBaselineDropMax.Value = round(0.42 * font["head"].unitsPerEm)
    corrections, letters = math.MathGlyphInfo.MathItalicsCorrectionInfo, {name for c, name in font.getBestCmap().items() if c >= 0x1D400}
    for name, correction in zip(corrections.Coverage.glyphs, corrections.ItalicsCorrection):
        if name in letters:
            font["hmtx"][name] = (font["hmtx"][name][0] + round(0.6 * correction.Value), 0)


def rename(font, kind, style):
    family, style = f"Report {kind.title()}", style.title()
    names = {1: family, 2: style, 3: f"{family} {style}", 4: f"{family} {style}", 5: "Version 1.0", 6: f"{family}-{style}".replace(" ", "")}
    font["name"].names = [entry for entry in font["name"].names if entry.platformID == 3]
    for number, text in names.items():
        font["name"].setName(text, number, 3, 1, 0x409)
    bold, italic = style == "Bold", style == "Italic"
    font["OS/2"].usWeightClass = 400 + 300 * bold
    font["OS/2"].fsSelection = font["OS/2"].fsSelection & 0x80 | (0x20 * bold + italic or 0x40)
    font["head"].macStyle = bold + 2 * italic


def main(source, face, out):
    kind, style = face.split("-")
    font = TTFont(source, recalcTimestamp=False)
    reduce(font, kind)
    if "CFF " in font:
        turn_into_truetype(font)
    add_scripts(font)
    if "MATH" in font:
        suit_chromium(font)
    if kind == "sans":   # Inter's ‖ is taller than its parentheses, and touches what follows
        bars = font.getBestCmap()[0x2016]
        font["glyf"][bars].coordinates.scale((1, 0.8))
        font["hmtx"][bars] = (round(1.17 * font["hmtx"][bars][0]), 0)
    rename(font, kind, style)
    for name in font.getGlyphOrder():
        font["glyf"][name].recalcBounds(font["glyf"])
        font["hmtx"][name] = (font["hmtx"][name][0], getattr(font["glyf"][name], "xMin", 0))
    widths = ", ".join(f"{{{c}, {1000 * font['hmtx'][name][0] / font['head'].unitsPerEm:.0f}}}" for c, name in sorted(font.getBestCmap().items()))
    with open(out + ".h", "w") as header:
        header.write(f"#pragma once\n// Characters and their widths in thousandths of the em.\nconstexpr struct {{ char32_t character; short width; }} "
                     f"{kind}_{style}_widths[] = {{{widths}}};\n")
    font["post"].formatType = 3
    font["gasp"] = newTable("gasp")
    font["gasp"].__dict__.update(version=1, gaspRange={0xFFFF: 15})   # smooth at every size
    for font.flavor, end in ((None, ".ttf"), ("woff2", ".woff2")):
        font.save(out + end)


if __name__ == "__main__":
    main(*sys.argv[1:])
