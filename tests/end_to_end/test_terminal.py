"""Output to a terminal, and output to a program or a log."""

import fcntl
import json
import os
import pty
import re
import struct
import subprocess
import termios
import unittest

from in_folder import InFolder
from program import PROGRAM
from test_commands import COMMANDS

ESCAPE = re.compile(r'\x1b\[[0-9;]*[A-Za-z]')
COLOUR = re.compile(r'\x1b\[[0-9;]+m')


class Terminal(InFolder):

    def seen(self, *words, columns=80, **variables):
        """Runs the program on a terminal of this width. Returns exit code and output."""
        ours, theirs = pty.openpty()
        fcntl.ioctl(theirs, termios.TIOCSWINSZ, struct.pack('HHHH', 24, columns, 0, 0))
        environment = {name: value for name, value in os.environ.items() if name not in
                       ('NO_COLOR', 'CLICOLOR', 'CLICOLOR_FORCE', 'COLUMNS', 'COLORTERM', 'TERM_PROGRAM', 'LC_TERMINAL', 'TMUX', 'STY', 'KITTY_WINDOW_ID')}
        environment |= {'TERM': 'xterm-256color', 'MESHFOLIO_PDF': 'off', 'XDG_CACHE_HOME': self.path('cache'), **variables}
        process = subprocess.Popen([PROGRAM, *map(str, words)], cwd=self.folder, env=environment, stdin=theirs, stdout=theirs, stderr=theirs)
        os.close(theirs)
        sent = b''
        try:
            while part := os.read(ours, 65536):
                sent += part
        except OSError:   # on Linux, this error means that no writer is left
            pass
        os.close(ours)
        return process.wait(), sent.decode().replace('\r\n', '\n')

    def require_narrow(self, text, columns, words):
        """Requires that no line is wider, except for a single long word."""
        for line in re.split(r'[\n\r]', ESCAPE.sub('', text)):
            if len(line) > columns:
                self.assertLessEqual(len(line.split()), 1, (words, columns, line))

    def test_no_line_is_wider_than_the_terminal_and_no_word_is_cut(self):
        self.sample('cube')
        for words in ([], *(['help', command] for command in COMMANDS), ['doctor'], ['list'], ['inspect', 'cube.obj'], ['compare', 'cube.obj', 'cube.obj'],
                      ['inspect', 'none.obj'], ['render', 'cube.obj', '--fild', 'x'], ['report', '--plan', 'cube.obj']):
            code, plain, errors = self.run_here(*words)
            for columns in (50, 80, 132):
                told = self.seen(*words, columns=columns)
                self.assertEqual(told[0], code)
                self.require_narrow(told[1], columns, words)
                if words != ['doctor']:   # doctor shows the size of the cache
                    self.assertEqual(sorted(ESCAPE.sub('', told[1]).split()), sorted((plain + errors).split()), (words, columns))

    def test_colours_are_for_terminals_that_know_them_and_people_who_want_them(self):
        wrong = ['inspect', 'none.obj']
        has_colours = lambda *words, **variables: COLOUR.search(self.seen(*words, **variables)[1]) is not None
        for words in (wrong, ['--help'], ['doctor']):
            self.assertTrue(has_colours(*words), words)
            for variables in ({'NO_COLOR': '1'}, {'TERM': 'dumb'}, {'CLICOLOR': '0'}, {'NO_COLOR': '1', 'CLICOLOR_FORCE': '1'}):
                self.assertNotIn('\x1b', self.seen(*words, **variables)[1], (words, variables))
            self.assertTrue(has_colours(*words, NO_COLOR=''), 'it must not be empty')
            _, out, err = self.run_here(*words, TERM='xterm-256color', NO_COLOR='', CLICOLOR_FORCE='')
            self.assertNotIn('\x1b', out + err, words)
            _, out, err = self.run_here(*words, NO_COLOR='', CLICOLOR_FORCE='1')
            self.assertRegex(out + err, COLOUR)

    def test_help_names_every_command_once_on_one_line(self):
        told = ESCAPE.sub('', self.seen('--help')[1])
        groups = re.findall(r'^([A-Z][a-z ]+):\n((?:  \S.*\n)+)', told, re.MULTILINE)
        self.assertEqual([title for title, _ in groups if title != 'Options'], ['Make a report', 'Work on a mesh', 'Check and mark', 'Set up'])
        named = [line.split()[0] for title, lines in groups if title != 'Options' for line in lines.splitlines()]
        self.assertEqual(len(set(named)), len(named))
        self.assertLessEqual(set(COMMANDS), set(named))

    def test_two_meshes_are_shown_side_by_side(self):
        self.sample('sphere')
        os.rename(self.path('sphere.obj'), self.path('a\x1b]2;title\x07.obj'))
        words = ['compare', 'a\x1b]2;title\x07.obj', self.sample('cube')]
        numbers = self.succeed(*words)
        for variables, colours in (({}, '8;5;'), ({'COLORTERM': 'truecolor'}, '8;2;')):
            code, told = self.seen(*words, '--terminal', columns=60, **variables)
            self.assertEqual(code, 0, told)
            self.assertIn(colours, told)
            self.assertNotIn('\x1b]2', told)
            lines = ESCAPE.sub('', told).split('\n')
            rows = [line for line in lines if '▀' in line]
            self.assertGreater(len(rows), 10)
            self.assertLessEqual(max(map(len, lines[:len(rows)])), 60)
            for row in rows[len(rows) // 2 - 2:len(rows) // 2 + 2]:   # both surfaces, and the ground between them
                self.assertRegex(row.rstrip(), '^ *[▀▄]+ +[▀▄]+$')
            self.assertIn('B: cube.obj', told)
            self.assertEqual(sorted(ESCAPE.sub('', told).split('(pale)')[1].split()), sorted(numbers.split()))
        self.assertIn('\x1b_Ga=T,f=100,q=2,m=', self.seen(*words, '--terminal', TERM='xterm-kitty')[1])
        self.assertIn('\x1b]1337;File=inline=1;', self.seen(*words, '--terminal', TERM_PROGRAM='iTerm.app')[1])
        for variables, why in (({'TERM': 'dumb'}, "TERM is 'dumb'"), ({'TERM': ''}, "TERM is ''"), ({'NO_COLOR': '1'}, 'NO_COLOR is set')):
            code, told = self.seen(*words, '--terminal', **variables)
            self.assertEqual(code, 2)
            self.assertIn(why, ' '.join(told.split()))
        self.assertIn('the output is no terminal', self.refuse(2, *words, '--terminal', CLICOLOR_FORCE=''))
        for other in (['--json'], ['--csv', '-']):
            self.refuse(2, *words, '--terminal', *other)

    def test_doctor_ends_with_a_verdict(self):
        missing = json.loads(self.succeed('doctor', '--json'))['missing']
        last = self.succeed('doctor').splitlines()[-1]
        self.assertEqual(last == 'Ready: everything found', not missing, last)
        self.assertRegex(self.succeed('doctor', PATH=self.folder).splitlines()[-1], '^Works, without a PDF engine: apt install ')

    def test_a_report_ends_with_the_numbers_of_its_results(self):
        mesh = self.sample('sphere')
        for fails in ('', 'q1'):
            code, out, err = self.run_here('report', mesh, '--quick', '--only', 'q1,q2,certificates', '--size', 64, '--out', 'out', MESHFOLIO_FAIL=fails)
            self.assertEqual(code, 1 if fails else 0, err)
            folder = os.path.dirname(out.strip())
            self.assertEqual(out, os.path.join(folder, 'index.html') + '\n')
            with open(self.path(folder, 'results.json'), encoding='utf-8') as file:
                results = json.load(file)
            asked = [question['status'] for question in results['questions'] if question['status'] != 'skipped']
            checks = [check['status'] for section in results['questions'] + results['supporting'] for check in section['checks']]
            told = re.fullmatch(r'meshfolio: (\d+) of (\d+) questions? answered, (\d+) checks? passed(?:, (\d+) failed)?(?:, (\d+) undecided)?, [\d.]+ s',
                                err.splitlines()[-1])
            self.assertIsNotNone(told, err)
            self.assertEqual([int(number or 0) for number in told.groups()],
                             [asked.count('ok'), len(asked), *(checks.count(status) for status in ('passed', 'failed', 'undecided'))])
        self.assertRegex(self.run_here('report', '--from', 'out/results.json', '--out', 'again')[2].splitlines()[-1], r'(passed|failed|undecided)$')

    def test_batch_promises_nothing_before_something_is_done(self):
        for name in ('cube', 'sphere', 'saddle'):
            self.sample(name)
        words = ['batch', 'cube.obj', 'sphere.obj', 'saddle.obj', '--only', 'certificates', '--size', 64, '--jobs', 1]
        _, out, err = self.run_here(*words, '--out', 'piped')
        lines = err.splitlines()
        self.assertEqual(out, 'piped/index.html\n')
        self.assertNotIn('about', lines[0])
        for done in (1, 2):
            self.assertRegex(err, rf'{done} of 3: \S+ .* about \d+ s left')
        with open(self.path('piped', 'batch.json'), encoding='utf-8') as file:
            meshes = json.load(file)['meshes']
        good, passed = sum(mesh['status'] == 'ok' for mesh in meshes), sum(mesh['checks']['passed'] for mesh in meshes)
        self.assertRegex(lines[-1], rf'^meshfolio: {good} of 3 meshes without a failure, {passed} of \d+ checks passed.*, \d+ s$')
        _, told = self.seen(*words, '--out', 'shown', columns=60)
        self.require_narrow(told, 60, words)
        drawn = [ESCAPE.sub('', line) for line in told.split('\r') if line.startswith('[')]
        self.assertTrue(drawn)
        self.assertFalse([line for line in drawn if '   0 %' in line[:30] and 'about' in line])


if __name__ == '__main__':
    unittest.main(verbosity=2)
