"""Moves the colours of a map along its curve to equal steps of CAM02-UCS, as "pale" and "diverging" in render/color/colormap.cpp were.

    equal_steps.py HALVES SHARE RRGGBB RRGGBB ...

HALVES is 1 for a sequential map and 2 for a diverging one, whose halves get steps of their own: the ends and the middle stay where they are.
SHARE of the way is gone: 1 for "diverging", 0.9 for "pale", whose green would come too close to its cream for readers without L cones.
The curve is the renderer's: a Catmull-Rom spline in CIELAB through equally spaced colours. "diverging" was drawn up in CIELAB as
004c9e 0368c1 4b88d6 80a8e3 adc5ea d5dfef eeeeee efdad1 e9b9a8 de937f cc6a59 b4413d 93232b, "pale" as
f1eee4 d4d7b6 9bc6a5 5eb1ab 3397ac 117da8 09629c 1e4983 253261.
"""
import math
import sys


def times(m, v):
    return [sum(a * b for a, b in zip(row, v)) for row in m]


def inverse(m):
    (a, b, c), (d, e, f), (g, h, i) = m
    minors = [[e * i - f * h, c * h - b * i, b * f - c * e], [f * g - d * i, a * i - c * g, c * d - a * f],
              [d * h - e * g, b * g - a * h, a * e - b * d]]
    determinant = a * minors[0][0] + b * minors[1][0] + c * minors[2][0]
    return [[x / determinant for x in row] for row in minors]


XYZ_OF_RGB = [[0.4124564, 0.3575761, 0.1804375], [0.2126729, 0.7151522, 0.0721750], [0.0193339, 0.1191920, 0.9503041]]
WHITE = [0.95047, 1, 1.08883]


def linear(c):
    return c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055)**2.4


def encoded(v):
    v = min(1, max(0, v))
    return 12.92 * v if v <= 0.0031308 else 1.055 * v**(1 / 2.4) - 0.055


def lab(rgb):
    x, y, z = [t / w for t, w in zip(times(XYZ_OF_RGB, [linear(c) for c in rgb]), WHITE)]
    fx, fy, fz = [t**(1 / 3) if t > 216 / 24389 else (24389 / 27 * t + 16) / 116 for t in (x, y, z)]
    return [116 * fy - 16, 500 * (fx - fy), 200 * (fy - fz)]


def rgb_of_lab(p):
    fy = (p[0] + 16) / 116
    xyz = [w * (u**3 if u**3 > 216 / 24389 else (116 * u - 16) * 27 / 24389)
           for u, w in zip((fy + p[1] / 500, fy, fy - p[2] / 200), WHITE)]
    return [encoded(v) for v in times(inverse(XYZ_OF_RGB), xyz)]


# CIECAM02 (CIE 159:2004) of sRGB on a grey ground in an average surround, then Luo, Cui and Li's uniform space (2006).
CAT02 = [[0.7328, 0.4296, -0.1624], [-0.7036, 1.6975, 0.0061], [0.0030, 0.0136, 0.9834]]
CONES = [[0.38971, 0.68898, -0.07868], [-0.22981, 1.18340, 0.04641], [0, 0, 1]]
LA, C, NC, N = 64 / math.pi / 5, 0.69, 1.0, 0.2
K = 1 / (5 * LA + 1)
FL = 0.2 * K**4 * 5 * LA + 0.1 * (1 - K**4)**2 * (5 * LA)**(1 / 3)
NBB, Z = 0.725 * (1 / N)**0.2, 1.48 + math.sqrt(N)
D = 1 - 1 / 3.6 * math.exp((-LA - 42) / 92)


def response(x):
    t = (FL * abs(x) / 100)**0.42
    return math.copysign(400 * t / (t + 27.13), x) + 0.1


def responses(xyz):
    white = times(CAT02, [100 * w for w in WHITE])
    adapted = [c * (100 * D / w + 1 - D) for c, w in zip(times(CAT02, xyz), white)]
    return [response(x) for x in times(CONES, times(inverse(CAT02), adapted))]


def achromatic(p):
    return (2 * p[0] + p[1] + p[2] / 20 - 0.305) * NBB


def ucs(rgb):
    p = responses([100 * v for v in times(XYZ_OF_RGB, [linear(c) for c in rgb])])
    a, b = p[0] - 12 * p[1] / 11 + p[2] / 11, (p[0] + p[1] - 2 * p[2]) / 9
    hue = math.atan2(b, a)
    lightness = 100 * (achromatic(p) / achromatic(responses([100 * w for w in WHITE])))**(C * Z)
    t = 50000 / 13 * NC * NBB * 0.25 * (math.cos(hue + 2) + 3.8) * math.hypot(a, b) / (p[0] + p[1] + 21 * p[2] / 20)
    colourfulness = t**0.9 * math.sqrt(lightness / 100) * (1.64 - 0.29**N)**0.73 * FL**0.25
    chroma = math.log(1 + 0.0228 * colourfulness) / 0.0228
    return [1.7 * lightness / (1 + 0.007 * lightness), chroma * math.cos(hue), chroma * math.sin(hue)]


def curve_through(colors):
    """Returns the colour at t in [0, 1] as a function."""
    points = [lab([(c >> 16) / 255, (c >> 8 & 255) / 255, (c & 255) / 255]) for c in colors]
    points.insert(0, [2 * p - q for p, q in zip(points[0], points[1])])
    points.append([2 * p - q for p, q in zip(points[-1], points[-2])])

    def at(t):
        i = min(int(t * (len(colors) - 1)), len(colors) - 2)
        u = t * (len(colors) - 1) - i
        return rgb_of_lab([q + 0.5 * u * (r - p + u * (2 * p - 5 * q + 4 * r - s + u * (3 * (q - r) + s - p)))
                           for p, q, r, s in zip(*points[i:i + 4])])
    return at


def places_of_equal_steps(at, low, high, steps, parts=4000):
    places = [low + (high - low) * i / parts for i in range(parts + 1)]
    colors = [ucs(at(t)) for t in places]
    lengths = [0.0]
    for p, q in zip(colors, colors[1:]):
        lengths.append(lengths[-1] + math.dist(p, q))
    found = []
    for k in range(steps + 1):
        i = max(0, min(parts - 1, sum(length < lengths[-1] * k / steps for length in lengths) - 1))
        u = (lengths[-1] * k / steps - lengths[i]) / (lengths[i + 1] - lengths[i])
        found.append(places[i] + u * (places[i + 1] - places[i]))
    return found


def main():
    halves, share, colors = int(sys.argv[1]), float(sys.argv[2]), [int(c, 16) for c in sys.argv[3:]]
    at, steps = curve_through(colors), (len(colors) - 1) // halves
    moved = [0.0]
    for half in range(halves):
        moved += places_of_equal_steps(at, half / halves, (half + 1) / halves, steps)[1:]
    places = [share * t + (1 - share) * i / (len(colors) - 1) for i, t in enumerate(moved)]
    print(" ".join("%02x%02x%02x" % tuple(round(255 * c) for c in at(t)) for t in places))


main()
