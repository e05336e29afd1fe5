"""An interrupted run ends soon with exit code 128 + signal and leaves no files, also while a browser prints, and by Ctrl-C on a terminal."""

import fcntl
import os
import pty
import select
import shutil
import signal
import struct
import subprocess
import termios
import time
import unittest

from common import ONE_CPU, STRACE, WHOLE, Faults, needs_strace, some, tree

SOON = 1 if WHOLE else 5   # [s]; on a busy machine a test can only show that the program does not hang
CODES = {signal.SIGINT: 130, signal.SIGTERM: 143, signal.SIGHUP: 129}
CREATIONS = ["openat", "mkdir", "mkdirat", "rename", "renameat2"]
BROWSER = """#!/bin/sh
if [ "$1" = --version ]; then echo "Chromium 200.0.0.0"; exit; fi
sleep 600 &
echo $$ $! > "$PIDS.part"
mv "$PIDS.part" "$PIDS"
wait
"""

THREAD_BEFORE_MAIN = """#include <pthread.h>
#include <unistd.h>
static void* wait_for_ever(void* nothing) { for (;;) pause(); return nothing; }
__attribute__((constructor)) static void begin(void) { pthread_t thread; pthread_create(&thread, 0, wait_for_ever, 0); }
"""


def is_alive(pid):
    try:
        with open(f"/proc/{pid}/stat") as file:
            return file.read().rsplit(") ", 1)[1][0] not in "ZX"
    except OSError:
        return False


def stopped_child(strace):
    """Returns the process id of the traced program once its first thread waits; None if the process has ended."""
    still, limit = 0, time.monotonic() + 60
    while strace.poll() is None and time.monotonic() < limit:
        try:
            with open(f"/proc/{strace.pid}/task/{strace.pid}/children") as file:
                program = int(file.read().split()[0])
            with open(f"/proc/{program}/stat") as file:
                still = still + 1 if file.read().rsplit(") ", 1)[1][0] == "t" else 0
        except (OSError, IndexError):
            still = 0
        if still == 4:
            return program
        time.sleep(0.01)
    return None


class Signals(Faults):
    def require_ended(self, end, which, old, new, when):
        self.assertIn(end.code, (CODES[which], 0), f"{when}: {end.err}")
        self.assertIn(tree(self.out), (old, new), when)
        self.assertEqual(self.beside(), [], when)
        if end.code == 0:
            self.assertEqual(tree(self.out), new, when)
        elif "earlier output is as it was" in end.err:
            self.assertEqual(tree(self.out), old, when)
        self.assertNotIn("internal error", end.err, when)

    def test_at_random_moments(self):
        old, new = self.with_old_and_new()
        words = self.report_words(threads=2)
        began = time.monotonic()
        self.assertEqual(self.run_program(*words).code, 0)
        usual, slowest, early = time.monotonic() - began, 0, 0
        runs = 120 if WHOLE else 12
        for number in range(runs):
            which = list(CODES)[number % len(CODES)]
            self.restore_old()
            process = self.start(*words)
            moment = self.random.uniform(0.05, usual)
            time.sleep(moment)
            process.send_signal(which)
            end = self.end(process)
            if end.code == -which:   # before main(), the signal kills the process directly
                early += 1
                self.assertEqual((tree(self.out), self.beside(), end.err), (old, [], ""))
                continue
            slowest = max(slowest, end.seconds)
            self.require_ended(end, which, old, new, f"{which!r} after {moment:.3f} s")
        self.assertLess(slowest, SOON)
        self.assertLess(early, runs / 2)
        print(f"slowest end {slowest:.3f} s", flush=True)

    def interrupt_at(self, restore, call, which, *words):
        """The thread waits before that call until the signal is handled, and the process ends late. A file that the thread then creates would stay
        for ever. On a busy machine a program may wait as long while it starts, and the signal kills it directly; then the test tries again."""
        for delay in (300000, 1000000, 3000000):   # [µs]; a busy machine may miss the shorter ones
            restore()
            wrap = [*ONE_CPU, STRACE, "-f", "-qq", "-e", "signal=none", "-o", self.folder / "trace", "-e", f"trace={call.name},exit_group",
                    "-e", f"inject={call.name}:delay_enter={delay}:when={call.number}", "-e", "inject=exit_group:delay_enter=300000"]
            process = self.start(*words, wrap=wrap)
            program = stopped_child(process)
            if program:
                os.kill(program, which)
            end = self.end(process)
            if program and end.code != -which:
                return end
        self.fail(f"the call did not come, or the signal ended the program the plain way: {call.line}")

    @needs_strace
    def test_where_a_name_is_about_to_appear(self):
        old, new = self.with_old_and_new()
        words = self.report_words()
        points = [c for c in self.calls(CREATIONS, *words) if c.name != "openat" or "O_CREAT" in c.line]
        folders = [c for c in points if c.name in ("mkdir", "mkdirat", "renameat2")]
        for number, call in enumerate([*some(points, 4), *some(folders, 4)]):
            which = list(CODES)[number % len(CODES)]
            end = self.interrupt_at(self.restore_old, call, which, *words)
            self.require_ended(end, which, old, new, call.line)

    @needs_strace
    def test_where_a_single_file_is_about_to_appear(self):
        mesh, result = self.mesh(), self.place / "x.ply"
        words = ["smooth", mesh, "-o", result, "--lambda", "1e-4"]
        for call in [c for c in self.calls(CREATIONS, *words) if c.name != "openat" or "O_CREAT" in c.line]:
            end = self.interrupt_at(lambda: result.unlink(missing_ok=True), call, signal.SIGTERM, *words)
            self.assertIn(end.code, (143, 0), call.line)
            left = [p.name for p in self.place.iterdir()]
            self.assertEqual(left, ["x.ply"] if end.code == 0 or "finished before" in end.err else [], call.line)

    def test_single_files(self):
        mesh, result = self.mesh("torus", "--subdivide", 1), self.place / "x.ply"
        words = ["smooth", mesh, "-o", result, "--lambda", "1e-4", "--iterations", 200]
        for number in range(30 if WHOLE else 6):
            which = list(CODES)[number % len(CODES)]
            result.write_bytes(b"old")
            process = self.start(*words)
            time.sleep(self.random.uniform(0.05, 0.3))
            process.send_signal(which)
            end = self.end(process)
            self.assertIn(end.code, (CODES[which], 0, -which))
            self.assertEqual([p.name for p in self.place.iterdir()], ["x.ply"])
            self.assertTrue(end.code == 0 or result.read_bytes() == b"old" or "finished before" in end.err)

    @unittest.skipUnless(shutil.which("c++"), "no compiler for a library that begins a thread")
    def test_a_thread_that_a_library_began(self):
        """A thread that begins before main() blocks no signal."""
        source, library = self.folder / "thread.c", self.folder / "thread.so"
        source.write_text(THREAD_BEFORE_MAIN)
        subprocess.run(["c++", "-x", "c", "-shared", "-fPIC", "-pthread", "-o", library, source], check=True)
        mesh, result = self.mesh("torus", "--subdivide", 1), self.place / "x.ply"
        words = ["smooth", mesh, "-o", result, "--lambda", "1e-4", "--iterations", 1000000]
        for which, code in CODES.items():
            process = self.start(*words, env={**self.environment, "LD_PRELOAD": str(library)})
            time.sleep(1)
            process.send_signal(which)
            end = self.end(process)
            self.assertEqual((end.code, list(self.place.iterdir())), (code, []), end.err)
            self.assertIn("meshfolio: interrupted", end.err)

    def test_a_hangup_that_nohup_ignores(self):
        new = self.report_tree(64)
        process = self.start(*self.report_words(), preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN))
        for _ in range(20):
            time.sleep(0.02)
            process.send_signal(signal.SIGHUP)
        self.assertEqual(self.end(process).code, 0)
        self.assertEqual(tree(self.out), new)

    def test_a_reader_that_does_not_read(self):
        """The writer waits for ever. A signal ends it although it cannot write its message."""
        mesh = self.mesh("torus", "--subdivide", 1)
        reading, writing = os.pipe()
        process = self.start("curvature", mesh, "--csv", "-", stdout=writing, stderr=writing)
        limit = time.monotonic() + 60
        waiting = 0   # until the pipe is full except for the last bytes
        while waiting < 60000 and time.monotonic() < limit:
            time.sleep(0.1)
            waiting = struct.unpack("i", fcntl.ioctl(reading, termios.FIONREAD, b"    "))[0]
        self.assertGreaterEqual(waiting, 60000)
        process.send_signal(signal.SIGTERM)
        self.assertEqual(process.wait(SOON), 143)
        os.close(reading)
        os.close(writing)

    def test_a_reader_that_has_gone(self):
        reading, writing = os.pipe()
        os.close(reading)
        end = self.run_program("curvature", self.mesh(), "--csv", "-", stdout=writing)
        os.close(writing)
        self.assertEqual((end.code, end.err), (-signal.SIGPIPE, ""), "as quiet as cat")


def shown_on(terminal):
    """Reads everything that is available."""
    shown = b""
    while select.select([terminal], [], [], 1)[0]:
        try:
            shown += os.read(terminal, 65536)
        except OSError:   # the other end is closed
            break
    return shown.decode()


class Printing(Faults):
    """Interrupted runs with a browser that never ends."""

    def start_printing(self, **options):
        browser, pids = self.folder / "browser", self.folder / "pids"
        browser.write_text(BROWSER)
        browser.chmod(0o755)
        self.environment["PIDS"] = str(pids)
        words = [w if w != "off" else "require" for w in self.report_words()]
        process = self.start(*words, "--pdf-browser", browser, **options)
        limit = time.monotonic() + 60
        while not pids.exists() and time.monotonic() < limit:
            time.sleep(0.02)
        return process, [int(pid) for pid in pids.read_text().split()]

    def require_all_gone(self, pids):
        limit = time.monotonic() + SOON
        while any(map(is_alive, pids)) and time.monotonic() < limit:
            time.sleep(0.01)
        self.assertEqual([pid for pid in pids if is_alive(pid)], [])
        self.assertEqual((self.beside(), tree(self.out)), ([], None))

    def test_its_whole_group_dies(self):
        for which, code in CODES.items():
            process, pids = self.start_printing()
            process.send_signal(which)
            end = self.end(process)
            self.assertEqual(end.code, code, end.err)
            self.assertLess(end.seconds, SOON)
            self.require_all_gone(pids)
            (self.folder / "pids").unlink()

    def test_by_the_key_of_a_terminal(self):
        """Ctrl-C goes to the foreground group, to which the browser does not belong."""
        master, slave = pty.openpty()
        self.addCleanup(os.close, master)
        self.environment["TERM"] = "xterm"
        process, pids = self.start_printing(stdin=slave, stdout=slave, stderr=slave,
                                            preexec_fn=lambda: fcntl.ioctl(0, termios.TIOCSCTTY, 0))
        os.close(slave)
        os.write(master, b"\x03")
        self.assertEqual(self.end(process).code, 130)
        self.assertIn("meshfolio: interrupted", shown_on(master))
        self.require_all_gone(pids)

    @unittest.skipUnless(WHOLE and shutil.which("chromium-headless-shell"), "only with --whole and a browser")
    def test_with_a_real_browser(self):
        words = [w if w != "off" else "require" for w in self.report_words()]
        for _ in range(15):
            process = self.start(*words)
            time.sleep(self.random.uniform(0.3, 2))
            process.send_signal(signal.SIGTERM)
            end = self.end(process)
            self.assertIn(end.code, (143, 0), end.err)
            time.sleep(0.5)
            running = subprocess.run(["pgrep", "-f", str(self.folder)], capture_output=True, text=True).stdout
            self.assertEqual((running, self.beside()), ("", []))
            shutil.rmtree(self.out, ignore_errors=True)


if __name__ == "__main__":
    unittest.main(verbosity=2)
