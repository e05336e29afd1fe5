"""`diff` of reports, of files results.json, and of batches."""

import json
import os
import shutil
import subprocess
import unittest
import xml.etree.ElementTree as ET
from pathlib import Path

from in_folder import InFolder
from program import PROGRAM, SOURCE

QUICK = ('--quick', '--size', '64', '--pdf', 'off', '--no-timings')


class Diff(InFolder):

    def setUp(self):
        super().setUp()
        self.folder = Path(self.folder)
        self.mesh = self.sample('cube8')

    def report(self, out):
        self.succeed('report', self.mesh, '--only', 'q1', *QUICK, '--out', out)
        return self.folder / out

    def diff(self, expected, *words):
        code, out, err = self.run_here('diff', *words)
        self.assertEqual(code, expected, err)
        return out

    def test_a_report_equals_itself(self):
        self.report('a')
        text = self.diff(0, 'a', 'a')
        self.assertRegex(text, r'^no change in \d+ checks, \d+ numbers of \d+ tables, \d+ pictures')
        self.assertEqual(json.loads(self.diff(0, 'a/results.json', 'a', '--json'))['changes'], [])

    def test_every_planted_change_is_found(self):
        new = self.folder / 'new'
        shutil.copytree(self.report('old'), new)
        results = json.loads((new / 'results.json').read_text())
        question = results['questions'][0]
        table = next(t for t in question['tables'] if len(t['rows']) > 1 and isinstance(t['rows'][0][-1], float))
        table['rows'][0][-1] = table['rows'][0][-1] * 1.5 + 1
        check = next(c for c in question['checks'] if c['status'] == 'passed')
        check.update(status='failed', passed=False)
        results['provenance']['settings']['size'] = '17 × 17'
        (new / 'results.json').write_text(json.dumps(results))
        picture = next(new.glob('images/*_sheet.png'))
        self.succeed('render', self.mesh, '-o', 'other.png')
        shutil.copy(self.folder / 'other.png', picture)
        changes = json.loads(self.diff(1, 'old', 'new', '--json', '--junit', 'j.xml', '--html', 'p.html'))['changes']
        self.assertEqual([change['kind'] for change in changes], ['setting', 'check', 'number', 'picture'])
        self.assertEqual(changes[1]['id'], check['id'])
        self.assertEqual((changes[2]['id'], changes[2]['after']), (table['id'], repr(table['rows'][0][-1])))
        self.assertEqual(changes[3]['id'], f'images/{picture.name}')
        text = self.diff(1, 'old', 'new')
        for part in ('checks, worst first', check['id'], table['id'], picture.name, '4 changes in'):
            self.assertIn(part, text)
        failures = ET.parse(self.folder / 'j.xml').findall('.//failure')
        self.assertEqual(len(failures), 4)
        page = (self.folder / 'p.html').read_text()
        ET.fromstring(page.replace('<!DOCTYPE html>', ''))
        self.assertEqual(page.count('type="range"'), 1)
        self.assertEqual(self.diff(1, 'new', 'old').count('undecided'), 0)

    def test_a_tolerance_lets_small_changes_pass(self):
        old = self.report('old')
        results = json.loads((old / 'results.json').read_text())
        for table in results['questions'][0]['tables']:
            for row in table['rows']:
                if isinstance(row[-1], float):
                    row[-1] *= 1 + 1e-7
        self.write('new.json', json.dumps(results))
        self.assertEqual(json.loads(self.diff(0, 'old', 'new.json', '--tolerance', '1e-6', '--json'))['changes'], [])
        self.assertNotEqual(json.loads(self.diff(1, 'old', 'new.json', '--json'))['changes'], [])

    def test_meshes_by_their_distance(self):
        for out in ('old', 'new'):
            self.succeed('report', self.mesh, '--only', 'q4', *QUICK, '--out', out)
            self.succeed('noise', self.mesh, '-o', self.mesh, '--sigma', '0.001')
        changes = json.loads(self.diff(1, 'old', 'new', '--json'))['changes']
        meshes = [change for change in changes if change['kind'] == 'mesh']
        self.assertTrue(meshes and all(0 < change['size'] < 0.01 for change in meshes), meshes)
        self.assertTrue(meshes[0]['id'].startswith('meshes/q4_cube8_k') and 'of the box diagonal' in meshes[0]['after'])

    def test_batches_are_compared_mesh_by_mesh(self):
        other = self.sample('sphere')
        for out, meshes in (('old', [self.mesh, other]), ('new', [self.mesh])):
            self.succeed('batch', *meshes, '--only', 'q1', *QUICK, '--out', out)
        changes = json.loads(self.diff(1, 'old', 'new', '--json'))['changes']
        self.assertEqual([(c['kind'], c['id'], c['before'], c['after']) for c in changes], [('presence', 'sphere', 'there', None)])
        self.diff(3, 'old', 'old/cube8')

    def test_what_is_no_report_is_refused(self):
        self.write('x.json', '{}')
        self.diff(3, 'x.json', 'x.json')
        self.diff(3, 'missing', 'missing')
        self.diff(2, 'x.json', 'x.json', '--tolerance', '-1')
        self.diff(2, 'x.json', 'x.json', '--html', 'a.txt')


class Baseline(InFolder):
    """The step of .github/actions/compare that compares the report of a pull request with that of the target branch."""

    def summary(self, old, new, said='### Meshes that change'):
        self.write('summary.md', said + '\n')
        os.makedirs(self.path('out'), exist_ok=True)
        subprocess.run([SOURCE / '.github/actions/compare/baseline.sh'], cwd=self.folder, check=True,
                       env={**os.environ, 'PROGRAM': PROGRAM, 'OLD': old, 'NEW': new, 'SUMMARY': 'summary.md', 'OUT': 'out', 'CHANGED': '2',
                            'GITHUB_OUTPUT': self.path('outputs')})
        return Path(self.path('summary.md')).read_text(), Path(self.path('outputs')).read_text().splitlines()[-1]

    def test_the_summary_says_what_changed(self):
        mesh = self.sample('cube8')
        for out, size in (('old', '64'), ('new', '65')):
            self.succeed('report', mesh, '--only', 'q1', '--quick', '--pdf', 'off', '--no-timings', '--size', size, '--out', out)
        text, changed = self.summary('old', 'new')
        self.assertTrue(text.startswith('### Meshes that change\n'))
        self.assertIn('size: 64 × 64 -> 65 × 65', text)
        self.assertEqual(changed, 'changed=3')
        self.assertTrue(Path(self.path('out/changes.html')).stat().st_size > 1000)
        text, changed = self.summary('old', 'old')
        self.assertIn('no change in', text)
        self.assertEqual(changed, 'changed=2')
        text, changed = self.summary('old', 'gone')
        self.assertIn('cannot be compared: `meshfolio: ', text)


if __name__ == '__main__':
    unittest.main()
