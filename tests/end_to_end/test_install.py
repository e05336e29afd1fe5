"""The files that `cmake --install` puts into a prefix, among them man pages and completions made by the program."""

import gzip
import json
import os
import re
import shutil
import subprocess
import sys
import unittest

from program import PROGRAM, SOURCE, run, temporary_folder

BUILD = os.path.dirname(PROGRAM)


class Install(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        cls.folder = temporary_folder(cls)
        cls.prefix = cls.folder / 'usr'
        done = subprocess.run(['cmake', '--install', BUILD, '--prefix', cls.prefix], capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
        cls.share = cls.prefix / 'share'
        cls.commands = re.findall(r'^  ([a-z]+) ', run('--help').stdout.split('Make a report:')[1], re.MULTILINE)

    def test_the_program_runs_from_there(self):
        done = subprocess.run([self.prefix / 'bin' / 'meshfolio', 'version'], capture_output=True, text=True, cwd=self.folder)
        self.assertRegex(done.stdout, r'^meshfolio \d+\.\d+\.\d+\n$')

    def test_every_command_has_a_page_that_names_its_options(self):
        pages = self.share / 'man' / 'man1'
        for command in set(self.commands) - {'version'}:
            page = gzip.decompress((pages / f'meshfolio-{command}.1.gz').read_bytes()).decode().replace('\\-', '-')
            for option in re.findall(r'^  (?:-\w,)?(--[\w-]+)', run('help', command).stdout, re.MULTILINE):
                self.assertIn(option, page, command)
        self.assertTrue((pages / 'meshfolio.1.gz').exists())
        if shutil.which('man'):
            for page in pages.iterdir():
                for width in ('80', '300'):
                    done = subprocess.run(['man', '--warnings', '-E', 'UTF-8', '-l', page], capture_output=True, text=True, env={**os.environ, 'MANWIDTH': width})
                    self.assertEqual((done.returncode, done.stderr), (0, ''), (page, width))
                self.assertIn('SYNOPSIS', done.stdout)

    def test_shells_read_their_completions(self):
        files = {'bash': 'bash-completion/completions/meshfolio', 'zsh': 'zsh/vendor-completions/_meshfolio',
                 'fish': 'fish/vendor_completions.d/meshfolio.fish'}
        for shell, file in files.items():
            self.assertIn('render', (self.share / file).read_text())
            if shutil.which(shell):
                done = subprocess.run([shell, '--no-execute' if shell == 'fish' else '-n', self.share / file], capture_output=True, text=True)
                self.assertEqual((done.returncode, done.stderr), (0, ''), shell)

    def test_bash_completes_commands_options_and_their_values(self):
        script = f'''source "{self.share}/bash-completion/completions/meshfolio"
            COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _meshfolio; echo "${{COMPREPLY[*]}}"'''

        def completed(*words):
            path = f'{self.prefix}/bin:{os.environ["PATH"]}'
            return subprocess.run(['bash', '-c', script, 'bash', 'meshfolio', *words], capture_output=True, text=True, env={**os.environ, 'PATH': path}).stdout.split()

        self.assertEqual(completed('rep'), ['report'])
        self.assertEqual(set(completed('')) - {'--help', '--version'}, set(self.commands))
        self.assertEqual(completed('render', '--iso'), ['--isolines'])
        self.assertEqual(completed('smooth', 'a.obj', '--scheme', ''), ['explicit', 'implicit', 'taubin'])
        self.assertEqual(completed('sample', 'creat'), ['creature'])
        self.assertEqual(completed('render', '--views', 'he'), ['hero'])
        self.assertEqual(completed('report', '--only', 'q'), [f'q{i}' for i in range(1, 8)])
        self.assertEqual(completed('report', '--config', 'lab'), ['laboratory'])
        self.assertEqual(completed('help', 'rend'), ['render'])
        self.assertEqual(completed('render', '--out', ''), [], 'names of files are left to bash')

    def test_the_bill_of_materials_names_what_is_built_in(self):
        bill = json.loads((self.share / 'doc/meshfolio/meshfolio.spdx.json').read_text())
        self.assertEqual(bill['spdxVersion'], 'SPDX-2.3')
        names = {package['name'] for package in bill['packages']}
        self.assertTrue({'meshfolio', 'Eigen', 'oneTBB', 'CLI11'} <= names, names)
        ids = {package['SPDXID'] for package in bill['packages']}
        self.assertEqual(len(ids), len(bill['packages']))
        linked = {relation['relatedSpdxElement'] for relation in bill['relationships']}
        self.assertEqual(linked, ids, 'each is said to be in it')

    def test_licence_and_documents(self):
        about = self.share / 'doc' / 'meshfolio'
        self.assertEqual((about / 'LICENSE').read_bytes(), (SOURCE / 'LICENSE').read_bytes())
        self.assertIn('{{', (about / 'templates.md').read_text())
        for name in ('README.md', 'NOTICES.md', 'copyright', 'changelog.gz', 'examples/report.toml'):
            self.assertGreater((about / name).stat().st_size, 100, name)

    def test_the_workflow_is_whole(self):
        for file in (SOURCE / 'data' / 'workflow').rglob('*'):
            installed = self.share / 'meshfolio' / 'workflow' / file.relative_to(SOURCE / 'data' / 'workflow')
            self.assertTrue(installed.exists(), file)
            self.assertEqual(os.access(installed, os.X_OK), os.access(file, os.X_OK), file)


if __name__ == '__main__':
    if not os.path.exists(os.path.join(BUILD, 'documents', 'made')):
        print('skipped: this build has no documents, so it is not for installation')
        sys.exit(77)   # CTest shows this code as skipped
    unittest.main()
