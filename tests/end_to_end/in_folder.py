"""A test case that works in a folder of its own."""

import os
import unittest

from program import run, temporary_folder


class InFolder(unittest.TestCase):
    """Each test works in an empty folder of its own."""

    def setUp(self):
        self.folder = str(temporary_folder(self))

    def path(self, *names):
        return os.path.join(self.folder, *names)

    def write(self, name, content):
        path = self.path(name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, 'wb') as file:
            file.write(content if isinstance(content, bytes) else content.encode())
        return path

    def run_here(self, *arguments, **environment):
        """Runs the program in the folder. Returns exit code, stdout and stderr."""
        process = run(*arguments, cwd=self.folder, **environment)
        return process.returncode, process.stdout, process.stderr

    def succeed(self, *arguments, **environment):
        """Returns the stdout of a run that must end with code 0."""
        code, out, err = self.run_here(*arguments, **environment)
        self.assertEqual(code, 0, err)
        return out

    def refuse(self, expected, *arguments, **environment):
        """Requires a run to end with this code and exactly one line that is not a warning. Returns the line."""
        code, _, err = self.run_here(*arguments, **environment)
        self.assertEqual(code, expected, (arguments, err))
        lines = [line for line in err.splitlines() if not line.startswith('meshfolio: warning: ')]
        self.assertEqual(len(lines), 1, err)
        self.assertTrue(lines[0].startswith('meshfolio: '), err)
        return lines[0]

    def sample(self, name, ending='obj', *options):
        file = f'{name}.{ending}'
        self.succeed('sample', name, '-o', file, *options)
        return file
