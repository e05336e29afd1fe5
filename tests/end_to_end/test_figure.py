"""`render -o`: one figure as PDF, SVG and PNG, read by independent programs."""

import os
import pathlib
import re
import struct
import subprocess
import unittest
import xml.dom.minidom

from in_folder import InFolder

POINTS_PER_MM = 72 / 25.4


def told_by(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


class Figure(InFolder):

    def setUp(self):
        super().setUp()
        for name in ('torus', 'creature', 'sphere'):
            self.sample(name)
        self.meshes = ['torus.obj', 'creature.obj', 'sphere.obj']

    def bytes_of(self, file):
        return pathlib.Path(self.path(file)).read_bytes()

    def figure(self, file, *options):
        self.assertEqual(self.succeed('render', *self.meshes, *options, '-o', file), file + '\n')
        return self.path(file)

    def test_a_pdf_has_its_width_its_words_and_its_fonts(self):
        pdf = self.figure('fig.pdf', '--field', 'h-cotan,gauss', '--camera', '35,22', '--width-mm', '85', '--dpi', '150', '--title', 'Café & <curvature>')
        width = float(re.search(r'Page size: +([\d.]+) x', told_by('pdfinfo', pdf)).group(1))
        self.assertAlmostEqual(width, 85 * POINTS_PER_MM, delta=0.3)
        self.assertIn('Pages:           1\n', told_by('pdfinfo', pdf))
        text = told_by('pdftotext', '-layout', pdf, '-')
        for words in ('Café & <curvature>', 'mean curvature H', 'Gaussian curvature K', *self.meshes):
            self.assertIn(words, text)
        fonts = told_by('pdffonts', pdf).splitlines()[2:]
        self.assertGreater(len(fonts), 0)
        for font in fonts:
            self.assertRegex(font, r' yes (yes|no ) yes ', 'embedded, and with a map to Unicode')
        self.assertIn('No syntax', told_by('qpdf', '--check', pdf))
        self.assertEqual(len(told_by('pdfimages', '-list', pdf).splitlines()) - 2, 6)

    def test_every_format_is_the_same_every_time_and_of_one_size(self):
        options = ('--field', 'z', '--isolines', '0.2', '--dpi', '120', '--width-mm', '100')
        for ending in ('pdf', 'svg', 'png'):
            contents = [self.bytes_of(self.figure(f'{number}.{ending}', *options)) for number in (1, 2)]
            self.assertEqual(*contents)
        width, height = struct.unpack('>II', contents[0][16:24])
        self.assertEqual(width, round(100 / 25.4 * 120))
        per_metre = struct.unpack('>I', contents[0].split(b'pHYs')[1][:4])[0]
        self.assertAlmostEqual(per_metre * 0.0254, 120, delta=0.02)
        svg = xml.dom.minidom.parse(self.path('1.svg')).documentElement
        self.assertAlmostEqual(float(svg.getAttribute('width').removesuffix('mm')), 100, delta=0.2)
        words = [node.firstChild.data for node in svg.getElementsByTagName('text')]
        for mesh in self.meshes:
            self.assertIn(mesh, words)

    def test_inputs_and_folders_stay(self):
        before = self.bytes_of('torus.obj')
        self.refuse(2, 'render', 'torus.obj', '-o', 'torus.obj')
        self.assertIn('-o', self.refuse(2, 'render', 'torus.obj', '--out', 'fig.pdf'))
        self.assertIn('-o', self.refuse(2, 'render', *self.meshes))
        self.assertIn('-o', self.refuse(2, 'render', *self.meshes, '--out', 'folder'))
        self.refuse(4, 'render', 'torus.obj', '-o', 'no/fig.pdf')
        self.refuse(3, 'render', 'torus.obj', 'none.obj', '-o', 'fig.pdf')
        self.assertEqual(self.bytes_of('torus.obj'), before)
        self.assertEqual(sorted(os.listdir(self.folder)), sorted(self.meshes))

    def test_options_that_do_not_fit_are_refused(self):
        for words in (['--size', '100'], ['--plain'], ['--glb', 'x.glb'], ['--field', 'id'], ['--out', 'x'], ['--terminal'],
                      ['--columns', '0'], ['--width-mm', '1'], ['--dpi', 'inf'], ['--camera', '1'], ['--camera', '0,91'], ['--zoom', '0'],
                      ['--up', 'w'], ['--views', '+q'], ['--background', 'pink'], ['--fit', 'both'], ['--field', 'h-cotan,gaus'],
                      ['--isolines', '1'], ['--values', 'v.csv:x']):
            self.refuse(2, 'render', *self.meshes, '-o', 'x.pdf', *words)
        for field in ('', ',', 'x,'):
            self.assertIn('--field', self.refuse(2, 'render', 'torus.obj', '-o', 'x.pdf', '--field', field))
        for words in (['--columns', '2'], ['--dpi', '100'], ['--width-mm', '85'], ['--fit', 'each'], ['--field', 'x,y']):
            self.assertIn('-o', self.refuse(2, 'render', 'torus.obj', *words))
        self.assertIn("'gauss'", self.refuse(2, 'render', 'torus.obj', '-o', 'x.pdf', '--field', 'gaus'))
        self.assertIn('distance', self.refuse(2, 'render', 'torus.obj', '--field', 'distance', '-o', 'x.pdf'))

    def test_a_camera_is_a_view_of_its_own(self):
        printed = self.succeed('render', 'torus.obj', '--camera', '35,22', '--size', '64', '--out', 'views')
        self.assertEqual(printed, 'views/camera.png\nviews/sheet.png\n')
        self.succeed('render', 'torus.obj', '--camera', '90,0', '--size', '64', '--plain', '--out', 'right')
        self.succeed('render', 'torus.obj', '--views', '+x', '--size', '64', '--plain', '--out', 'x')
        self.assertEqual(*(self.bytes_of(file) for file in ('right/camera.png', 'x/+x.png')))


if __name__ == '__main__':
    unittest.main()
