"""The filter of Pandoc: what commands become, the cache, messages."""

import re
import shutil
import struct
import subprocess
import time
import unittest
import xml.dom.minidom
import zipfile

from document import FILTER, PROGRAM, SOURCE, InDocuments, Made, block, nodes, words


class Filter(InDocuments):

    def test_a_render_is_a_figure_with_id_caption_and_alt(self):
        tree = self.tree(block("render cube.obj", '#fig-c caption="A *cube*" alt="eight corners"'))
        [[attributes, caption, target]] = nodes(tree, "Image")
        self.assertEqual((attributes[0], target[1]), ("fig-c", "fig:"))
        self.assertRegex(target[0], r"^a_files/fig-c-\w{8}\.png$")
        self.assertEqual(words(caption), "Figure 1: A cube")
        self.assertIn(["alt", "eight corners"], attributes[2])
        self.assertEqual(len(nodes(caption, "Emph")), 1)

    def test_pages_have_pixels_and_latex_has_vectors(self):
        text = block("render cube.obj", 'caption="x" width="40%"')
        self.assertRegex(self.make(text, "-t", "html").text, r'src="a_files/render-\w{8}\.png" style="width:40.0%"')
        self.assertRegex(self.make(text, "-t", "latex").text, r"includegraphics\[width=0.4.*\{a_files/render-\w{8}\.pdf\}")
        self.assertRegex(self.make(text, "-t", "gfm").text, r"render-\w{8}\.png")
        self.assertEqual(self.make(block("render cube.obj", 'caption="All *corners*"'), "-t", "plain").text, "[All corners]\n")
        self.assertEqual(self.make(block("render cube.obj"), "-t", "plain").text, "[render cube.obj]\n")

    def test_several_renders_are_above_one_caption(self):
        text = block("render cube.obj\nrender cube.obj --field z", '#fig-c caption="Both"')
        [[attributes, blocks]] = nodes(self.tree(text), "Div")
        self.assertEqual((attributes[0], words(blocks[-1]), len(nodes(blocks, "Image"))), ("fig-c", "Figure 1: Both", 2))
        latex = self.make(text, "-t", "latex").text
        self.assertRegex(latex, r"(?s)fig-c-\w{8}\.pdf.*fig-c-\w{8}\.pdf.*\\refstepcounter\{figure\}\\label\{fig-c\}Figure~\\thefigure: Both")

    def test_figures_and_tables_are_numbered_and_referred_to(self):
        text = ("See @tbl-b, [@fig-b] and @fig-a, not @other." + block("render cube.obj", '#fig-a caption="A"') +
                block("render cube.obj --field z", '#fig-b caption="B"') + block("compare cube.obj cube.obj", '#tbl-b caption="T"'))
        plain = self.make(text, "-t", "plain").text
        self.assertTrue(plain.startswith("See Table 1, Figure 2 and Figure 1, not @other."), plain)
        self.assertIn(": Table 1: T", plain)
        latex = self.make(text, "-t", "latex").text
        self.assertIn(r"Table~\ref{tbl-b}", latex)
        self.assertIn(r"\caption{T\label{tbl-b}}", latex)

    def test_csv_is_a_table_with_rounded_numbers_on_the_right(self):
        tree = self.tree(block("curvature cube.obj", '#tbl-c caption="C" rows=2'))
        [[_, caption, columns, head, bodies, _]] = nodes(tree, "Table")
        self.assertEqual([column[0]["t"] for column in columns], ["AlignRight"] * 10)
        self.assertEqual([words(cell) for cell in head[1][0][1]], ["vertex", "x", "y", "z", "boundary", "area", "h uniform", "k gauss", "h cotan", "h uniform scaled"])
        self.assertEqual(words(caption), "Table 1: C")
        rows = [[words(row[1][i]) for i in (0, 1, 7)] for row in bodies[0][3]]
        self.assertEqual(rows, [["0", "-0.5", "1.571"], ["1", "-0.5", "2.356"]])

    def test_aligned_text_is_a_table_and_lines_are_paragraphs(self):
        tree = self.tree(block("compare cube.obj cube.obj"))
        cells = [words(row[1][0]) for row in nodes(tree, "Table")[0][4][0][3]]
        self.assertIn("volume ratio", cells)
        self.assertRegex(self.make(block("inspect cube.obj"), "-t", "plain").text, r"^V=8 F=12 chi=2[^\n]*\n\n  -----")

    def test_long_tables_are_not_cut_in_silence(self):
        shutil.copy(SOURCE / "data" / "plane.obj", self.folder)
        self.assertIn("more than 40 rows; say by rows=", self.refused(block("curvature plane.obj"), 3))
        self.assertEqual(len(nodes(self.tree(block("curvature plane.obj", "rows=50")), "Table")[0][4][0][3]), 50)

    def test_numbers_in_text_are_rounded_for_people(self):
        shutil.copy(SOURCE / "data" / "creature.obj", self.folder)
        text = ("`inspect cube.obj vertices`{.meshfolio} `inspect cube.obj smallest_angle_deg`{.meshfolio digits=2} "
                "`inspect cube.obj box_diagonal`{.meshfolio} `inspect creature.obj gauss_bonnet.residual`{.meshfolio digits=1}")
        self.assertRegex(self.make(text, "-t", "plain").text, r"^8 45 1\.732 \d×10[⁻¹²³⁴⁵⁶⁷]+\n$")
        self.assertRegex(self.make(text, "-t", "latex").text, r"\d×10\\textsuperscript\{-1\d\}")

    def test_a_mesh_of_a_block_is_an_input_of_later_blocks(self):
        tree = self.tree(block("noise cube.obj -o noisy.ply \\\n  --sigma 0.01") + block("# a comment\n\nrender noisy.ply", 'echo=true caption="x"'))
        self.assertEqual(nodes(tree, "CodeBlock")[0][1], "# a comment\n\nrender noisy.ply")
        self.assertTrue((self.folder / "a_files" / "noisy.ply").exists())

    def test_words_for_files_and_the_folder_of_data(self):
        (self.folder / "more").mkdir()
        shutil.copy(SOURCE / "data" / "plane.obj", self.folder / "more" / "own name.obj")
        meta = ', meshes: { bunny: [bunny.off, own name.obj, cube.obj], cube: "cube.obj" }'
        text = block("inspect bunny") + block("inspect cube")
        self.assertRegex(self.make(text, "-t", "plain", meta=meta, data="more").text, r"(?s)^V=100 .*\nV=8 ")
        self.assertRegex(self.make(text, "-t", "plain", meta=meta + ", data: more").text, r"(?s)^V=100 .*\nV=8 ")
        self.assertRegex(self.make(text, "-t", "plain", meta=meta).text, r"(?s)^V=8 .*\nV=8 ")

    def test_options_in_the_metadata_are_those_of_all_renders(self):
        def picture(meta, commands="render cube.obj --field z"):
            tree = self.tree(block(commands), meta=meta)
            return (self.folder / nodes(tree, "Image")[0][2][0]).read_bytes()

        plain = picture("")
        self.assertEqual(struct.unpack(">I", plain[16:20]), (201,))   # 200 pixels of 85 mm, in whole pixels an inch
        for meta in (", camera: '10,20'", ", colormap: gray", ", edges: true", ", zoom: 0.5"):
            self.assertNotEqual(picture(meta), plain, meta)
        self.assertEqual(picture(", zoom: 0.5", "render cube.obj --field z --zoom 1"), plain)

    def test_a_document_of_another_folder_is_made_from_here(self):
        shutil.copy(self.folder / "cube.obj", self.folder / "x.obj")
        (self.folder / "sub").mkdir()
        shutil.move(self.folder / "x.obj", self.folder / "sub" / "x.obj")
        document = self.write(block("render x.obj", '#fig-x caption="X"'), "sub/b.md")
        for written, source in (("sub/b.html", "b_files/"), ("b.html", "sub/b_files/")):
            self.assertEqual(Made(self.folder, document, "-o", written).code, 0)
            self.assertIn(f'src="{source}fig-x-', (self.folder / written).read_text())
        for written in ("sub/b.docx", "sub/b.odt"):
            self.assertEqual(Made(self.folder, document, "-o", written).message, "")
            self.assertTrue(any(name.endswith(".png") for name in zipfile.ZipFile(self.folder / written).namelist()))
        self.assertEqual(Made(self.folder, document, "--self-contained", "-s", "--metadata=title=x", "-o", "sub/c.html").message, "")
        self.assertIn("data:image/png;base64", (self.folder / "sub/c.html").read_text())

    def test_a_failure_names_file_line_and_reason(self):
        good = block("inspect cube.obj")
        self.assertIn("did you mean '--field'?", self.refused("Text." + good + block("\n# a\nrender cube.obj --feild z"), 9))
        self.assertIn("none.obj: cannot open the file", self.refused(good + block("inspect cube.obj\ninspect \\\n none.obj"), 8))
        self.assertIn("none.ply", self.refused("Text\nand `inspect none.ply`{.meshfolio} text", 2))
        self.assertIn("quote", self.refused(block("inspect 'cube.obj"), 3))
        self.assertIn("name it in MESHFOLIO", self.refused(block("inspect cube.obj"), 3, MESHFOLIO="/no/such/program"))
        (self.folder / "bad.obj").write_text("v 0 0 0\nv 1 x 0\n")
        self.assertIn("bad.obj:2", self.refused(block("inspect bad.obj"), 3))

    def test_failures_can_be_shown_instead(self):
        text = block("inspect none.obj") + "\n\nAfter `inspect no.obj`{.meshfolio}."
        for made in (self.make(text, "-t", "html", meta=", errors: show"), self.make(text.replace("}", " errors=show}"), "-t", "html")):
            self.assertEqual((made.code, made.message), (0, ""))
            self.assertEqual(len(re.findall('meshfolio-error"[^>]*border[^>]*><strong>a.md:', made.text)), 2)
        self.assertIn(r"\color{red}", self.make(text, "-t", "latex", meta=", errors: show").text)

    def test_a_second_run_does_nothing(self):
        calls = self.folder / "calls"
        program = self.folder / "counted"
        program.write_text(f'#!/bin/sh\n[ "$1" = version ] || echo "$1" >> "{calls}"\nexec "{PROGRAM}" "$@"\n')
        program.chmod(0o755)

        def made(text):
            calls.write_text("")
            tree = self.tree(text, MESHFOLIO=str(program))
            return calls.read_text().split(), tree

        text = block("noise cube.obj -o n.ply --sigma 0.01") + block("render n.ply") + block("compare cube.obj n.ply")
        first, tree = made(text)
        self.assertEqual(first, ["noise", "render", "compare"])
        self.assertEqual(made(text), ([], tree))
        self.assertEqual(made("More text." + text)[0], [])
        self.assertEqual(made(text.replace("0.01", "0.02"))[0], ["noise", "render", "compare"])
        (self.folder / "a_files" / "n.ply").write_bytes(b"spoilt")
        self.assertEqual(made(text.replace("0.01", "0.02"))[0], ["noise"])
        cube = (self.folder / "cube.obj").read_text()
        (self.folder / "cube.obj").write_text(cube.replace("-0.5", "-0.6"))
        self.assertEqual(made(text.replace("0.01", "0.02"))[0], ["noise", "render", "compare"])
        program.write_text(program.read_text().replace('[ "$1" = version ]', 'if [ "$1" = version ]; then echo other; exit; fi; false'))
        self.assertEqual(made(text.replace("0.01", "0.02"))[0], ["noise", "render", "compare"])

    def test_two_blocks_that_write_one_name_stay_in_order(self):
        text = (block("noise cube.obj -o n.ply --sigma 0.01") + block("inspect n.ply") + block("noise cube.obj -o n.ply --sigma 0.1") + block("inspect n.ply"))
        self.assertEqual(self.tree(text), self.tree(text))

    def test_forty_figures(self):
        text = "".join(block(f"render cube.obj --camera {9 * i},20", f'#fig-{i} caption="From {9 * i} degrees"') for i in range(40))
        first, second = (self.make(text, "-s", "--metadata=title=forty", "-o", "a.html") for _ in range(2))
        self.assertEqual((first.code, second.code), (0, 0), first.message + second.message)
        print(f"forty figures: {first.seconds:.2f} s, again {second.seconds:.2f} s")
        self.assertEqual((self.folder / "a.html").read_text().count("<img"), 40)
        self.assertLess(second.seconds, 0.7 * first.seconds)


if __name__ == "__main__":
    unittest.main()
