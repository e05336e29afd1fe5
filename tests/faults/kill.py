"""After SIGKILL at any moment the complete old or new report is there. The next run works and removes leftovers."""

import json
import os
import shutil
import signal
import time
import unittest
from hashlib import sha256
from pathlib import Path

from common import EDITED, ONE_CPU, STRACE, WHOLE, Faults, needs_strace, of_each_kind, ours, some, sums_hold, tree, user_files_are_kept

CHANGES = ["openat", "write", "rename", "renameat", "renameat2", "link", "linkat", "unlink", "unlinkat", "mkdir", "mkdirat", "rmdir", "ftruncate",
           "fsync", "close", "sendfile", "copy_file_range"]
STEPS = CHANGES if WHOLE else ["write", "rename", "renameat2", "unlinkat"]   # fills a folder, puts it in its place, and removes the replaced folder


def runs_into(folder):
    """Returns the command lines of processes that name the folder."""
    found = []
    for process in Path("/proc").glob("[0-9]*/cmdline"):
        try:
            line = process.read_bytes()
        except OSError:
            continue
        if os.fsencode(folder) in line:
            found.append(line)
    return found


class Kill(Faults):
    def require_old_or_new(self, old, new, when):
        now = ours(tree(self.out))
        self.assertIn(now, (ours(self.edited(old)), new), f"{when}: neither the old report nor the new one")
        self.assertTrue(sums_hold(self.out), when)
        if self.user_files:
            self.assertTrue(user_files_are_kept(self.out), when)

    def edited(self, old):
        """Returns the tree of the old folder with the user's files."""
        name = EDITED[".meshfolio" if ".meshfolio" in old else ".meshfolio-marks"]
        return {**old, name: sha256(b"edited by hand").hexdigest()} if self.user_files else old

    def require_next_run(self, new, *words):
        """Requires the next run to succeed on the leftovers of the kill."""
        end = self.run_program(*words)
        self.assertEqual(end.code, 0, end.err)
        self.assertEqual(ours(tree(self.out)), new)
        self.assertEqual(self.beside(), [])
        if self.user_files:
            self.assertTrue(user_files_are_kept(self.out))

    @needs_strace
    def test_before_system_calls_of_a_report(self):
        old, new = self.with_old_and_new()
        self.user_files = True
        self.restore_old()
        words = self.report_words()
        for call in of_each_kind(self.calls(CHANGES, *words)):
            self.restore_old()
            end, _ = self.run_with(call, "signal=KILL", *words)
            self.assertNotEqual(end.code, 0, call.line)
            self.require_old_or_new(old, new, call.line)
        self.require_next_run(new, *words)

    @needs_strace
    def test_before_system_calls_of_a_first_report(self):
        new = self.report_tree(64)
        words = self.report_words()
        for call in some(self.calls(CHANGES, *words), 4):
            shutil.rmtree(self.out, ignore_errors=True)
            self.run_with(call, "signal=KILL", *words)
            self.assertIn(tree(self.out), (None, new), call.line)
        self.require_next_run(new, *words)

    @needs_strace
    def test_leftovers_in_the_cache_are_swept_by_the_next_report(self):
        words = self.report_words(cached=True)
        points = [c for c in self.calls(CHANGES, *words, within=self.folder / "cache") if ".meshfolio.part-" in c.line and c.name.startswith("rename")]
        new = tree(self.out)
        left = 0
        for call in some(points, 2):
            shutil.rmtree(self.folder / "cache")
            (self.folder / "cache").mkdir()
            self.run_with(call, "signal=KILL", *words)
            left += any(name.startswith(".meshfolio.part-") for name in self.beside())
            self.assertIn(tree(self.out), (None, new), call.line)
            self.require_next_run(new, *words)
        self.assertGreater(left, 0, "no kill left anything: the test tests nothing")

    @needs_strace
    def test_without_hard_links_the_next_run_finds_what_is_the_users(self):
        """Without hard links, files are moved after the exchange. After a kill in between, the next run finds them. This holds also if two
        renames replace the exchange of names."""
        _, new = self.with_old_and_new()
        self.user_files = True
        words = self.report_words()
        for refused in (["linkat:error=EPERM"], ["linkat:error=EPERM", "renameat2:error=EINVAL:when=2+"]):
            self.restore_old()
            wrap = [*ONE_CPU, STRACE, "-f", "-y", "-qq", "-e", "signal=none", "-o", self.folder / "trace", "-e", "trace=linkat,renameat2,unlinkat"]
            faults = [word for fault in refused for word in ("-e", "inject=" + fault)]
            end = self.end(self.start(*words, wrap=[*wrap, *faults]))
            self.assertEqual(end.code, 0, end.err)
            self.assertEqual((ours(tree(self.out)), self.beside(), user_files_are_kept(self.out)), (new, [], True), refused)
            renames = sum("renameat2(" in line for line in (self.folder / "trace").read_text(errors="replace").splitlines())
            if len(refused) > 1:   # strace can make the call fail or kill, not both
                continue
            for number in range(2, renames + 1):
                self.restore_old()
                self.end(self.start(*words, wrap=[*wrap, *faults, "-e", f"inject=renameat2:signal=KILL:when={number}"]))
                self.assertEqual(self.run_program(*words).code, 0)
                self.assertEqual((ours(tree(self.out)), self.beside(), user_files_are_kept(self.out)), (new, [], True), number)

    def test_at_random_moments(self):
        old, new = self.with_old_and_new()
        self.user_files = True
        self.restore_old()
        words = self.report_words(threads=2)
        began = time.monotonic()
        self.assertEqual(self.run_program(*words).code, 0)
        usual = time.monotonic() - began
        for _ in range(100 if WHOLE else 6):
            self.restore_old()
            process = self.start(*words)
            time.sleep(self.random.uniform(0, usual))
            os.killpg(process.pid, signal.SIGKILL)
            self.end(process)
            self.require_old_or_new(old, new, "at random")
        self.require_next_run(new, *words)

    @needs_strace
    def test_single_files_are_old_or_new(self):
        mesh, result = self.mesh(), self.place / "x.ply"
        words = ["smooth", mesh, "-o", result, "--lambda", "1e-4"]
        points = self.calls(CHANGES, *words)
        new = result.read_bytes()
        for call in some(points, 6):
            self.sweep()
            result.write_bytes(b"old")
            self.run_with(call, "signal=KILL", *words)
            self.assertIn(result.read_bytes(), (b"old", new), call.line)
        self.assertEqual(self.run_program(*words).code, 0)
        self.assertEqual(self.beside(), ["x.ply"])

    @needs_strace
    def test_before_system_calls_of_a_renewal_a_merge_and_marks(self):
        for made_of in (self.with_renewal, self.with_parts, self.with_marks):
            self.user_files = False
            old, new, words = made_of()
            self.user_files = True
            self.restore_old()
            for call in of_each_kind(self.calls(STEPS, *words)):
                self.restore_old()
                self.run_with(call, "signal=KILL", *words)
                self.require_old_or_new(old, new, call.line)
            self.require_next_run(new, *words)

    @needs_strace
    def test_before_system_calls_of_a_run_that_fails_and_of_the_next_good_one(self):
        good = self.report_tree(64)
        shutil.copytree(self.report_of(64), self.out)
        words, failed = self.report_words(), self.place / "out.failed"
        self.environment["MESHFOLIO_FAIL"] = "q2"
        for call in of_each_kind(self.calls(STEPS, *words, code=1)):
            self.run_with(call, "signal=KILL", *words)
            self.assertEqual(tree(self.out), good, call.line)
            self.assertTrue(not failed.exists() or sums_hold(failed), call.line)
        del self.environment["MESHFOLIO_FAIL"]
        points = [c for c in self.calls(CHANGES, *words) if "out.failed" in c.line or "unlink" in c.name]
        for call in of_each_kind(points):
            self.environment["MESHFOLIO_FAIL"] = "q2"
            self.assertEqual(self.run_program(*words).code, 1)
            del self.environment["MESHFOLIO_FAIL"]
            self.run_with(call, "signal=KILL", *words)
            self.assertEqual(tree(self.out), good, call.line)
        self.require_next_run(good, *words)

    def test_a_batch_at_random_moments(self):
        """Every report is complete, no process remains, and the final result equals that of one run."""
        words = ["batch", self.mesh(), self.mesh("cube8"), "--only", "certificates", "--size", 64, "--no-timings", "--jobs", 2]
        straight = self.run_program(*words, "--out", self.folder / "straight")
        for _ in range(40 if WHOLE else 3):
            process = self.start(*words, "--out", self.out)
            time.sleep(self.random.uniform(0, 1.2 * straight.seconds))
            process.kill()
            process.communicate()
            self.require_all_ended()
            for results in self.out.glob("*/results.json"):
                self.assertTrue(".tmp-" in results.parent.name or sums_hold(results.parent), results)
            for index in self.out.glob("batch.json"):
                self.assertEqual(len(json.loads(index.read_text())["meshes"]), 2)
        self.assertEqual(self.run_program(*words, "--out", self.out).code, straight.code)
        self.assertEqual(tree(self.out), tree(self.folder / "straight"))
        self.assertEqual(self.beside(), [])

    @needs_strace
    def test_before_system_calls_of_a_batch(self):
        """Kills the batch, or one of its reports, which affects only its row. The next run does not make finished reports again."""
        old, new, words, code = self.with_batch()
        points = self.calls(STEPS, *words, code=code)
        of_index = [c for c in points if any(Path(path).parent == self.out for path in c.paths)]
        for call in {*some(points, 3), *of_each_kind(of_index)}:
            self.restore_old()
            self.run_with(call, "signal=KILL", *words)
            self.require_all_ended()
            done = self.require_batch_of(old, new, call.line)
            made = {name: (self.out / name / "results.json").stat().st_ino for name in done}
            end = self.run_program(*words)
            self.assertEqual((end.code, tree(self.out)), (code, new), call.line + end.err)
            self.assertEqual({name: (self.out / name / "results.json").stat().st_ino for name in done}, made, call.line)
            self.assertEqual(self.beside(), [], call.line)

    def require_all_ended(self):
        limit = time.monotonic() + 20
        while runs_into(self.out) and time.monotonic() < limit:
            time.sleep(0.02)
        self.assertEqual(runs_into(self.out), [])

    def test_folders_of_a_dead_printer_are_swept(self):
        """The next run removes the folder of a browser if its run was killed while printing, but not the folder of a live run."""
        gone = self.start("--version")
        self.end(gone)
        dead = self.folder / "tmp" / f"meshfolio-print-{gone.pid}-abcdef"
        alive = self.folder / "tmp" / f"meshfolio-print-{os.getpid()}-abcdef"
        for folder in (dead, alive):
            (folder / "profile").mkdir(parents=True)
        browser = self.folder / "browser"
        browser.write_text('#!/bin/sh\n[ "$1" = --version ] && echo "Chromium 200.0.0.0"\n')
        browser.chmod(0o755)
        words = [w if w != "off" else "auto" for w in self.report_words()]
        end = self.run_program(*words, "--pdf-browser", browser)
        self.assertEqual(end.code, 0, end.err)
        self.assertEqual([p.name for p in (self.folder / "tmp").iterdir()], [alive.name])

    @unittest.skipUnless(WHOLE, "only with --whole")
    @needs_strace
    def test_before_system_calls_of_a_submission(self):
        full = self.run_program("report", "--quick", "--size", 64, "--pdf", "off", "--no-timings", "--out", self.out)
        self.assertEqual(full.code, 0, full.err)
        self.old_folder = self.folder / "submitted" / "out"
        shutil.copytree(self.out, self.old_folder)
        old = tree(self.out)
        words = ["submit", "--without-pdf", "--author", "A. Nobody", "--out", self.out]
        points = self.calls(CHANGES, *words)
        new = tree(self.out)
        for call in points[:: max(1, len(points) // 150)]:
            self.restore_old()
            self.run_with(call, "signal=KILL", *words)
            self.require_old_or_new(old, new, call.line)
        self.require_next_run(new, *words)


if __name__ == "__main__":
    unittest.main(verbosity=2)
