"""`compare` and `render A B` on surfaces with equal or different triangles, and the action that runs them for a pull request."""

import json
import os
import re
import shutil
import struct
import subprocess
import unittest

from file_readers import png
from in_folder import InFolder
from program import PROGRAM, SOURCE
from test_commands import BOX, table

ONE_SIDED = ['rms_a_to_b', 'rms_b_to_a', 'mean_a_to_b', 'mean_b_to_a', 'max_a_to_b', 'max_b_to_a', 'normal_angle_a_to_b_deg',
             'normal_angle_b_to_a_deg']
ERRORS = ['mean_error_a_to_b', 'mean_error_b_to_a', 'rms_error_a_to_b', 'rms_error_b_to_a']
SAME = ['rms', 'max', 'hausdorff', 'hausdorff_bound', 'mean_normal_angle_deg', 'volume_ratio', 'area_ratio']
GROUND = 'v -5 -5 0\nv 5 -5 0\nv 5 5 0\nv -5 5 0\nf 1 2 3\nf 1 3 4\n'
TILE = 'v -1 -1 2\nv 1 -1 2\nv 1 1 2\nv -1 1 2\nv 0 0 2\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n'


class Compare(InFolder):

    def setUp(self):
        super().setUp()
        self.write('ground.obj', GROUND)
        self.write('tile.obj', TILE)

    def numbers(self, a, b, *options):
        return json.loads(self.succeed('compare', a, b, '--json', *options))

    def test_keys_of_both_kinds(self):
        self.succeed('noise', self.sample('cube8'), '-o', 'noisy.obj', '--sigma', '0.01')
        same, other = self.numbers('cube8.obj', 'noisy.obj'), self.numbers('tile.obj', 'ground.obj')
        surfaces = self.numbers('cube8.obj', 'noisy.obj', '--surfaces')
        for facts in (other, surfaces):
            self.assertEqual(list(facts), [*SAME, 'box_diagonal', *ONE_SIDED, 'rms_error', *ERRORS, 'same_triangles', 'histogram'])
        self.assertEqual(list(same), [*SAME, 'area_weighted_rms', 'mean_squared_normal_angle_deg2', 'box_diagonal', 'inverted_faces',
                                      'same_triangles'])
        self.assertIsInstance(same['inverted_faces'], int)
        self.assertEqual([facts['same_triangles'] for facts in (same, other, surfaces)], [True, False, True])

    def test_a_tile_above_the_ground(self):
        facts = self.numbers('tile.obj', 'ground.obj')
        for key in ('rms_a_to_b', 'mean_a_to_b', 'max_a_to_b'):
            self.assertAlmostEqual(facts[key], 2, delta=1e-12)
        self.assertAlmostEqual(facts['max_b_to_a'], (4**2 + 4**2 + 2**2)**0.5)   # from its corners
        self.assertEqual(facts['hausdorff'], facts['max_b_to_a'])
        self.assertAlmostEqual(facts['area_ratio'], 25)
        self.assertIsNone(facts['volume_ratio'])
        self.assertAlmostEqual(facts['mean_normal_angle_deg'], 0, delta=1e-5)
        self.assertAlmostEqual(sum(facts['histogram']['a_to_b']), 1)
        back = self.numbers('ground.obj', 'tile.obj')
        for key in ONE_SIDED:
            other = key.replace('a_to_b', 'b_to_a') if 'a_to_b' in key else key.replace('b_to_a', 'a_to_b')
            self.assertAlmostEqual(back[other], facts[key], delta=1e-9)

    def test_a_gap_between_vertices_is_found(self):
        """A needle with a gap, over a plate: the middle of the gap is as far from the halves of the needle as from the plate, or nearer."""
        plate = ''.join(f'v {x} {y} DEPTH\n' for x, y in ((0, 0), (1000, 0), (1000, 1000), (0, 1000)))
        whole = plate + 'v 0 0 0\nv 1000 0 0\nv 1000 .001 0\nf 1 2 3\nf 1 3 4\nf 5 6 7\n'
        parts = (plate + 'v 0 0 0\nv 400 0 0\nv 400 .0004 0\nv 600 0 0\nv 600 .0006 0\nv 1000 0 0\nv 1000 .001 0\n'
                 'f 1 2 3\nf 1 3 4\nf 5 6 7\nf 8 10 11\nf 8 11 9\n')
        for depth, far in ((-50, 50), (-200, 100)):
            self.write('whole.obj', whole.replace('DEPTH', str(depth)))
            self.write('parts.obj', parts.replace('DEPTH', str(depth)))
            for accuracy in (1e-1, 1e-3, 1e-6):
                for pair in (('whole.obj', 'parts.obj'), ('parts.obj', 'whole.obj')):
                    facts = self.numbers(*pair, '--accuracy', str(accuracy))
                    self.assertLessEqual(facts['hausdorff'], far * (1 + 1e-9))
                    self.assertGreaterEqual(facts['hausdorff_bound'], far)
                    self.assertLessEqual(facts['hausdorff_bound'], facts['hausdorff'] * (1 + accuracy))

    def test_accuracy_has_limits(self):
        for value in ('0', '-1', '1e-10', '2', 'nan', 'inf', 'x', ''):
            self.assertIn('--accuracy', self.refuse(2, 'compare', 'tile.obj', 'ground.obj', '--accuracy', value))
        self.assertIn('no more than this', self.succeed('compare', 'tile.obj', 'ground.obj', '--accuracy', '1e-9'))

    def test_distances_of_vertices(self):
        rows = table(self.succeed('compare', 'tile.obj', 'ground.obj', '--csv', '-'))
        self.assertEqual([(row['vertex'], float(row['distance'])) for row in rows], [(str(v), 2.0) for v in range(5)])
        self.assertIn('hausdorff', self.succeed('compare', 'tile.obj', 'ground.obj', '--csv', 'd.csv'))
        self.succeed('render', 'tile.obj', '--values', 'd.csv:distance', '--size', '32', '--views', '+z', '--out', 'views')
        self.refuse(2, 'compare', 'tile.obj', 'ground.obj', '--csv', '-', '--json')

    def test_the_mesh_with_its_distances(self):
        self.succeed('compare', 'tile.obj', 'ground.obj', '--ply', 'tile.ply')
        with open(self.path('tile.ply'), 'rb') as file:
            header, body = file.read().split(b'end_header\n', 1)
        self.assertIn(b'property float distance\n', header)
        rows = [struct.unpack_from('<dddf', body, 28 * v) for v in range(5)]
        self.assertEqual([row[3] for row in rows], 5 * [2])
        self.assertEqual(rows[2][:3], (1, 1, 2))
        self.assertEqual(self.numbers('tile.obj', 'tile.ply')['max'], 0)   # and it is the same mesh
        self.refuse(2, 'compare', 'tile.obj', 'ground.obj', '--ply', 'tile.off')

    def test_the_page_is_self_contained(self):
        os.rename(self.path('tile.obj'), self.path('<b>&.obj'))
        for b in ('ground.obj', '<b>&.obj'):   # also of two equal meshes
            self.succeed('compare', '<b>&.obj', b, '--html', 'page.html')
            with open(self.path('page.html'), encoding='utf-8') as file:
                page = file.read()
            self.assertIn('&lt;b&gt;&amp;.obj', page)
            self.assertNotIn('<b>&', page)
            self.assertIn('content="default-src &#39;none&#39;;', page)
            self.assertEqual(re.findall(r'(?:src|href)="(?!data:|#)([^"]*)', page), [])
            self.assertIn('Hausdorff distance', page)
            self.assertIsNone(re.search(r'\b(?:[a-z]+_)+[a-z]+\b', re.sub(r'<style.*?</style>|<script.*?</script>|<[^>]*>', ' ', page, flags=re.S)))
            for part in ('<figure class="plot">', 'largest, A to B', 'rms distance, '):
                self.assertEqual(part in page, b == 'ground.obj', part)
            self.assertEqual('<b>Identical</b>' in page, b != 'ground.obj')
            self.assertLess(page.index('class="tiles"'), page.index('<img'), 'numbers come first')

    def test_one_moved_vertex_is_not_identical(self):
        self.write('moved.obj', TILE.replace('v 0 0 2', 'v 0 0 2.0000001'))
        self.succeed('compare', 'tile.obj', 'moved.obj', '--html', 'page.html')
        with open(self.path('page.html'), encoding='utf-8') as file:
            self.assertNotIn('Identical', file.read())

    def test_an_open_surface_has_no_volume(self):
        for options in ([], ['--surfaces']):
            self.assertRegex(self.succeed('compare', 'tile.obj', 'tile.obj', *options), r'volume_ratio +undefined')
            self.assertIsNone(json.loads(self.succeed('compare', 'tile.obj', 'tile.obj', '--json', *options))['volume_ratio'])

    def test_bad_inputs_and_outputs_are_refused(self):
        self.assertIn('none.obj', self.refuse(3, 'compare', 'tile.obj', 'none.obj'))
        self.refuse(2, 'compare', 'tile.obj', 'ground.obj', '--csv', 'ground.obj')
        self.refuse(4, 'compare', 'tile.obj', 'ground.obj', '--html', 'no/page.html')
        self.assertEqual(sorted(os.listdir(self.folder)), ['ground.obj', 'tile.obj'])


class Pair(InFolder):

    def test_two_meshes_in_one_figure(self):
        self.write('box.obj', BOX)
        self.sample('creature')
        for field in ('none', 'distance', 'h-cotan'):
            self.assertEqual(self.succeed('render', 'box.obj', 'creature.obj', '--field', field, '--dpi', '72', '-o', field + '.png'),
                             field + '.png\n')
            self.assertEqual(png(self.path(field + '.png'))[0], round(170 / 25.4 * 72))


class Action(InFolder):
    """.github/actions/compare on a repository of two commits, with a stand-in for the tool that comments."""

    HOSTILE = 'a `$(touch x)`|<b>.OBJ'

    def git(self, *words):
        done = subprocess.run(['git', '-c', 'user.name=n', '-c', 'user.email=e', *words], cwd=self.path('tree'), capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout.strip()

    def commit(self):
        self.git('add', '--all')
        self.git('commit', '--quiet', '-m', 'meshes')
        return self.git('rev-parse', 'HEAD')

    def setUp(self):
        super().setUp()
        if not shutil.which('git') or not shutil.which('bash'):
            self.skipTest('no git or no bash')
        os.mkdir(self.path('tree'))
        subprocess.run(['git', 'init', '--quiet', '--bare', self.path('origin')], check=True)
        self.git('init', '--quiet')
        self.git('remote', 'add', 'origin', self.path('origin'))
        for name, text in (('changed.obj', TILE), (self.HOSTILE, GROUND), ('gone.obj', 'v 7 8 9\nv 9 8 7\nv 7 7 7\nf 1 2 3\n'), ('moved.obj', BOX), ('same.obj', GROUND),
                           ('link.obj', TILE), ('turned.obj', BOX + '# a' * 40)):
            self.write('tree/' + name, text)
        base = self.commit()
        os.remove(self.path('tree/gone.obj'))
        os.rename(self.path('tree/moved.obj'), self.path('tree/place.obj'))
        os.remove(self.path('tree/link.obj'))
        os.symlink('same.obj', self.path('tree/link.obj'))
        os.remove(self.path('tree/turned.obj'))
        os.chmod(self.path('tree/same.obj'), 0o755)
        for name, text in (('turned2.obj', BOX + '# a' * 40 + '\n'), ('packed.vtp.gz', 'no'), ('changed.obj', TILE.replace(' 2\n', ' 3\n', 1)), (self.HOSTILE, GROUND + 'f 1 2 4\n'), ('broken.obj', 'f 1 2 3\n'),
                           ('new.obj', TILE), ('notes.txt', 'no mesh')):
            self.write('tree/' + name, text)
        self.variables = {'PROGRAM': PROGRAM, 'BASE': base, 'HEAD': self.commit(), 'OUT': self.path('out'), 'BRANCH': '', 'REPOSITORY_URL': 'https://h/r',
                          'GITHUB_OUTPUT': self.path('outputs')}

    def compared(self, **variables):
        """Returns the summary, and the outputs of the step by name."""
        done = subprocess.run([SOURCE / '.github/actions/compare/compare.sh'], cwd=self.path('tree'), capture_output=True, text=True,
                              env={**os.environ, **self.variables, **variables})
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(self.path('outputs'), encoding='utf-8') as file:
            outputs = dict(line.split('=', 1) for line in file.read().splitlines())
        with open(outputs['summary'], encoding='utf-8') as file:
            return file.read(), outputs

    def test_every_mesh_that_changed_has_a_row(self):
        summary, outputs = self.compared()
        rows = dict(re.findall(r'^\| `(.*?)` \| (.*?) \|', summary, re.M))
        self.assertTrue(rows.pop('broken.obj').startswith('`meshfolio: broken.obj:1: '))
        self.assertIn('packed.vtp.gz', rows.pop('packed.vtp.gz'))
        self.assertEqual(rows, {'changed.obj': 'changed', 'gone.obj': 'removed', 'new.obj': 'new', 'place.obj': 'moved, was `moved.obj`',
                                'turned2.obj': 'changed, was `turned.obj`', 'same.obj': 'other permissions',
                                'link.obj': 'a file or a link, which it was not',
                                self.HOSTILE.translate({ord(c): '?' for c in '`$()|<>'}): 'changed'})
        self.assertEqual(outputs['changed'], '10')
        self.assertRegex(summary, r'`turned.obj` \| 0 \| 0 \| 0 \|')
        self.assertFalse(os.path.exists(self.path('tree/x')))
        folders = os.listdir(self.path('out/meshes'))
        self.assertEqual(sum(os.path.exists(self.path('out/meshes', folder, 'sheet.png')) for folder in folders), 4)
        self.assertNotIn('![', summary)

    def test_nothing_changed(self):
        summary, outputs = self.compared(BASE=self.variables['HEAD'])
        self.assertIn('None.', summary)
        self.assertEqual(outputs['changed'], '0')

    def test_sheets_are_kept_on_a_branch(self):
        for run in (1, 2):
            summary, _ = self.compared(BRANCH='pictures')
            found = re.findall(r'\(https://h/r/blob/(\w+)/(\S+?)\?raw=true\)', summary)
            self.assertEqual(len(found), 4)
            for commit, path in found:
                size = subprocess.check_output(['git', 'cat-file', '-s', f'{commit}:{path}'], cwd=self.path('origin'))
                self.assertGreater(int(size), 1000)
            self.assertEqual(subprocess.check_output(['git', 'rev-list', '--count', 'pictures'], cwd=self.path('origin'), text=True).strip(), str(run))

    def test_its_steps_comment_once(self):
        try:
            import yaml
        except ImportError:
            self.skipTest('no python3-yaml')
        with open(SOURCE / '.github/actions/compare/action.yml', encoding='utf-8') as file:
            steps = yaml.safe_load(file)['runs']['steps']
        for step in steps:
            self.assertRegex(step.get('uses', 'x@' + 40 * '0'), r'@[0-9a-f]{40}$')
            self.assertNotIn('${{', step.get('run', ''))   # names of a pull request arrive in variables, never as code
        _, outputs = self.compared()
        self.write('bin/gh', '#!/bin/sh\ncase " $*" in *--method*) echo "$@" >> "$CALLS" ;; *) printf "%s" "$EARLIER" ;; esac\n')
        os.chmod(self.path('bin/gh'), 0o755)
        variables = {**os.environ, 'PATH': self.path('bin') + ':' + os.environ['PATH'], 'CALLS': self.path('calls'), 'SUMMARY': outputs['summary'],
                     'GITHUB_STEP_SUMMARY': self.path('job.md'), 'GITHUB_REPOSITORY': 'o/r', 'NUMBER': '7', 'CHANGED': '6', 'ARTIFACT': 'https://h/a'}
        for earlier, comment, changed in (('', 'true', '6'), ('12\n13\n', 'true', '0'), ('', 'true', '0'), ('12\n', 'false', '6')):
            subprocess.run(['bash', '-e', '-o', 'pipefail', '-c', steps[-1]['run']], check=True,
                           env={**variables, 'EARLIER': earlier, 'COMMENT': comment, 'CHANGED': changed})
        with open(self.path('calls'), encoding='utf-8') as file:
            calls = file.read().splitlines()
        self.assertEqual([call.split(' --field')[0] for call in calls], ['api --silent --method POST repos/o/r/issues/7/comments',
                                                                         'api --silent --method PATCH repos/o/r/issues/comments/12'])
        with open(self.path('job.md'), encoding='utf-8') as file:
            self.assertIn('https://h/a', file.read())


if __name__ == '__main__':
    unittest.main()
