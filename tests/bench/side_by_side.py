#!/usr/bin/python3
"""Makes sheets of our pictures beside f3d's and VTK's, of the same mesh from the same direction.

    side_by_side.py FOLDER [--meshes bunny.off …] [--views +z +x] [--out side_by_side] [--meshfolio PROGRAM] [--bench PROGRAM]

Each mesh and view has a sheet. Columns: ours, VTK (4 samples a pixel), f3d (with ambient occlusion, antialiasing and tone
mapping). The first row is plain, the second is coloured by height if the tool supports it.
"""
import argparse
import os
import sys
import tempfile
from pathlib import Path

from PIL import Image, ImageDraw

from six_views import PYTHON, SIDE, VIEWS, display, f3d_command, ply_bounds, timed

HERE = Path(__file__).resolve().parent
BUILD = HERE.parent.parent / "build" / "release"


def pictures_of(options, mesh, folder):
    """Returns {(row, column): pattern of the pictures' paths, with a place for the view's name}."""
    drawn = {}
    for row, ours, vtk in (("plain", [], ["--plain"]), ("by height", ["--field", "y", "--colormap", "viridis"], [])):
        for column, command in (("ours", [options.meshfolio, "render", mesh, *ours, "--out"]),
                                ("VTK", [PYTHON, str(HERE / "vtk_peer.py"), "--samples", "4", *vtk, mesh])):
            target = Path(folder, row, column)
            target.mkdir(parents=True)
            timed([*command, str(target)])
            drawn[row, column] = str(target / "{}.png")
    for view in VIEWS:
        if view[0] in options.views:
            timed(f3d_command(mesh, ply_bounds(mesh), view, f"{folder}/f3d{view[0]}.png", "--ssao", "--fxaa", "--tone-mapping",
                              "--bg-color", "1,1,1"))
    return drawn | {("plain", "f3d"): folder + "/f3d{}.png"}


def sheet_of(title, drawn, view):
    columns, rows, head = ["ours", "VTK", "f3d"], ["plain", "by height"], 24
    sheet = Image.new("RGB", (len(columns) * SIDE, len(rows) * (SIDE + head)), "white")
    draw = ImageDraw.Draw(sheet)
    for j, row in enumerate(rows):
        for i, column in enumerate(columns):
            if (row, column) not in drawn:
                continue
            x, y = i * SIDE, j * (SIDE + head)
            draw.text((x + 8, y + 6), f"{title} {view}  {column}, {row}", fill="black")
            sheet.paste(Image.open(drawn[row, column].format(view)).convert("RGB"), (x, y + head))
    return sheet


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder")
    parser.add_argument("--meshes", nargs="+", default=["bunny.off", "armadillo.obj", "fandisk.off", "lilium.obj"])
    parser.add_argument("--views", nargs="+", default=["+z", "+x"], choices=[view[0] for view in VIEWS])
    parser.add_argument("--out", default="side_by_side")
    parser.add_argument("--meshfolio", default=str(BUILD / "meshfolio"))
    parser.add_argument("--bench", default=str(BUILD / "tests" / "bench" / "render_bench"))
    options = parser.parse_args()
    os.makedirs(options.out, exist_ok=True)
    with display():
        for name in options.meshes:
            path = Path(options.folder, name)
            if not path.exists():
                print(f"{name} skipped: not in {options.folder}", file=sys.stderr)
                continue
            with tempfile.TemporaryDirectory() as folder:
                timed([str(Path(options.bench).with_name("make_meshes")), str(path), folder, "0"])
                drawn = pictures_of(options, folder + "/0.ply", folder)
                for view in options.views:
                    target = Path(options.out, f"{path.stem}{view}.png")
                    sheet_of(path.stem, drawn, view).save(target)
                    print(target)


if __name__ == "__main__":
    main()
