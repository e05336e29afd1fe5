"""Tools of the peers: the six views of the program, a virtual display, running and timing programs."""
import array
import contextlib
import os
import subprocess
import tempfile
import time

PYTHON = "/usr/bin/python3"  # the Python of python3-vtk9
SIDE = 1024  # pixels
FILL = 0.92  # share of the picture that the largest extent takes
# name, from, up: as in render/scene/camera.h
VIEWS = [("+x", (1, 0, 0), (0, 1, 0)), ("-x", (-1, 0, 0), (0, 1, 0)), ("+y", (0, 1, 0), (0, 0, -1)),
         ("-y", (0, -1, 0), (0, 0, 1)), ("+z", (0, 0, 1), (0, 1, 0)), ("-z", (0, 0, -1), (0, 1, 0))]


def camera_position(low, high, towards, distance):
    """Returns a point `distance` times the largest extent away from the middle of the box."""
    extent = max(b - a for a, b in zip(low, high))
    return [(a + b) / 2 + distance * extent * d for a, b, d in zip(low, high, towards)]


def ply_bounds(path):
    """Returns (low, high) of a mesh from make_meshes: binary, three floats a vertex."""
    with open(path, "rb") as file:
        while (line := file.readline()) != b"end_header\n":
            if line.startswith(b"element vertex"):
                count = int(line.split()[2])
        numbers = array.array("f", file.read(12 * count))
    return [min(numbers[k::3]) for k in range(3)], [max(numbers[k::3]) for k in range(3)]


def f3d_command(mesh, bounds, view, picture, *more):
    """Returns the words that run f3d from one of the six sides. f3d has no parallel projection; at this distance its 30° cover the extent."""
    towards, up = view[1:]
    text = [",".join(map(str, numbers)) for numbers in (
        camera_position(*bounds, towards, distance=1 / FILL / 2 / 0.268 + 0.3), camera_position(*bounds, towards, distance=0), up)]
    return ["f3d", mesh, "--output", picture, "--resolution", f"{SIDE},{SIDE}", "--camera-position", text[0],
            "--camera-focal-point", text[1], "--camera-view-up", text[2], *more]


@contextlib.contextmanager
def display():
    """Runs a virtual X server and sets DISPLAY while it runs."""
    reading, writing = os.pipe()
    server = subprocess.Popen(["Xvfb", "-displayfd", str(writing), "-screen", "0", "1280x1280x24"], pass_fds=[writing],
                              stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    os.close(writing)
    try:
        with os.fdopen(reading) as pipe:
            os.environ["DISPLAY"] = ":" + pipe.readline().strip()
        yield
    finally:
        server.terminate()
        server.wait()


def timed(command, **environment):
    """Runs a program. Returns (seconds, peak memory in MiB, output)."""
    with tempfile.TemporaryFile("w+") as printed:
        begun = time.perf_counter()
        process = subprocess.Popen(command, stdout=printed, stderr=subprocess.DEVNULL, env={**os.environ, **environment})
        _, status, usage = os.wait4(process.pid, 0)
        seconds = time.perf_counter() - begun
        process.returncode = os.waitstatus_to_exitcode(status)
        if process.returncode != 0:
            raise RuntimeError(f"{' '.join(command)} ended with {process.returncode}")
        printed.seek(0)
        return seconds, usage.ru_maxrss / 1024, printed.read()
