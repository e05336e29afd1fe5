"""Compares `--backend slepc` in one process and in two with the built-in backend. Skipped (77) if the program was built without it."""

import csv
import os
import re
import shutil
import subprocess
import sys
import unittest

from file_readers import ply
from in_folder import InFolder
from program import PROGRAM, run

MPIRUN = ['mpirun', '-q', '--allow-run-as-root', '--oversubscribe', '--bind-to', 'none', '--mca', 'mpi_yield_when_idle', '1']


class Ranks(InFolder):

    def setUp(self):
        super().setUp()
        self.sample('sphere')  # eigenvalues of 3, 5, 7 …
        self.sample('saddle', 'obj', '--subdivide', '1')  # open
        self.sample('creature')
        creature, count = self.read('creature.obj'), self.read('creature.obj').count('\nv ') + self.read('creature.obj').startswith('v ')
        moved = re.sub(r'(?<=^f )(\d+)\D+(\d+)\D+(\d+)', lambda m: ' '.join(str(int(i) + count) for i in m.groups()), self.read('sphere.obj'), flags=re.M)
        self.write('two.obj', creature + moved)

    def read(self, name):
        with open(self.path(name), encoding='utf-8') as file:
            return file.read()

    def by_ranks(self, number, *arguments):
        """Runs the program in several processes. Returns exit code, stdout and stderr."""
        words = [*MPIRUN, '-n', str(number), PROGRAM, *arguments, '--backend', 'slepc']
        process = subprocess.run(words, cwd=self.folder, capture_output=True, text=True, timeout=280)
        return process.returncode, process.stdout, process.stderr

    def test_eigenpairs_and_certificates_agree(self):
        counted = re.compile(r'none missing below ([^:]+): (\w+)( but for measured rounding)? \((\d+) counted by inertia, (\d+) found')
        for mesh in ('sphere.obj', 'saddle.obj', 'two.obj'):
            code, own, text = self.run_here('spectrum', mesh, '-k', '30')
            self.assertEqual(code, 0, text)
            expected = [float(row['eigenvalue']) for row in csv.DictReader(own.splitlines())]
            proof = counted.search(text)
            for number in (1, 2):
                code, table, text = self.by_ranks(number, 'spectrum', mesh, '-k', '30')
                self.assertEqual(code, 0, text)
                self.assertEqual(text.count('certificate'), 1, 'one process writes')
                theirs = counted.search(text)
                self.assertEqual(theirs.group(2, 4, 5), proof.group(2, 4, 5), (mesh, number))
                self.assertEqual((theirs[2], theirs[3], proof[3]), ('proved', ' but for measured rounding', None))
                values = [float(row['eigenvalue']) for row in csv.DictReader(table.splitlines())]
                self.assertEqual(len(values), 30)
                for a, b in zip(expected, values):
                    self.assertLessEqual(abs(a - b), 1e-9 * a, (mesh, number))

    def test_implicit_steps_agree(self):
        options = ['--scheme', 'implicit', '--lambda', '20', '--unit', 'tau', '--iterations', '3']
        for mesh in ('sphere.obj', 'saddle.obj', 'two.obj'):
            for more in ([], ['--rebuild']):
                self.succeed('smooth', mesh, '-o', 'own.ply', *options, *more)
                own = ply(self.path('own.ply'))[0]
                box = max(max(column) - min(column) for column in zip(*own))
                for number in (1, 2):
                    code, _, text = self.by_ranks(number, 'smooth', mesh, '-o', 'theirs.ply', *options, *more)
                    self.assertEqual(code, 0, text)
                    for a, b in zip(own, ply(self.path('theirs.ply'))[0]):
                        self.assertLessEqual(max(abs(x - y) for x, y in zip(a, b)), 1e-9 * box, (mesh, number, more))

    def test_an_error_of_one_rank_ends_all_with_one_line(self):
        self.write('bad.obj', 'v 0 0 zero\n')
        for expected, arguments in ((3, ['spectrum', 'none.obj', '-k', '3']), (3, ['spectrum', 'bad.obj', '-k', '3']),
                                    (2, ['spectrum', 'sphere.obj', '-k', '0']), (4, ['spectrum', 'sphere.obj', '-k', '3', '--csv', 'no/x.csv']),
                                    (2, ['smooth', 'sphere.obj', '-o', 'x.ply', '--lambda', '1'])):
            code, out, text = self.by_ranks(2, *arguments)
            self.assertEqual(code, expected, text)
            lines = [line for line in text.splitlines() if line.startswith('meshfolio: ') and 'certificate' not in line]
            self.assertEqual((len(lines), out), (1, ''), text)


def missing():
    """Returns the reason to skip the test; empty if there is none."""
    process = run('spectrum', 'none.obj', '-k', '1', '--backend', 'slepc', OMPI_ALLOW_RUN_AS_ROOT=1, OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1)
    if process.returncode == 5:
        assert re.fullmatch(r'meshfolio: .*-DMESHFOLIO_SLEPC=ON.*\n', process.stderr), process.stderr
        return 'the program was built without -DMESHFOLIO_SLEPC=ON'
    assert process.returncode == 3, process.stderr
    return '' if shutil.which('mpirun') else 'mpirun is not installed'


if __name__ == '__main__':
    reason = missing()
    if reason:
        print('skipped:', reason)
        sys.exit(77)
    os.environ['OMP_NUM_THREADS'] = '1'
    unittest.main(verbosity=2)
