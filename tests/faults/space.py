"""With a full, read-only or broken disk, or a limit on file size, a run ends with code 4 and one line with path and reason. The old output
stays."""

import json
import os
import resource
import subprocess
import unittest

from common import ONE_CPU, PROGRAM, STRACE, WHOLE, Faults, needs_mount, needs_strace, of_each_kind, some, tree

WRITES = ["openat", "write", "fsync", "fdatasync", "ftruncate", "rename", "renameat2", "linkat", "mkdir", "mkdirat", "close"]
STEPS = WRITES if WHOLE else ["write", "fsync", "renameat2", "mkdir"]   # these kinds suffice for other commands; a report tries all
REASONS = {"ENOSPC": "No space left on device", "EIO": "Input/output error", "EDQUOT": "Disk quota exceeded"}


def writing(calls):
    """Returns the calls that write output, without calls on files that are only read."""
    created = {}
    for call in calls:
        if call.name == "openat":
            created[call.paths[-1]] = "O_CREAT" in call.line
        if call.name not in ("openat", "close") or created.get(call.paths[-1]):
            yield call


class Space(Faults):
    def require_refusal(self, end, reason, when):
        self.assertEqual(end.code, 4, f"{when}: {end.err}")
        errors = [line for line in end.err.splitlines() if "cannot" in line]
        self.assertEqual(len(errors), 1, f"{when}: {end.err}")
        self.assertTrue(errors[0].startswith("meshfolio: ") and reason in errors[0], f"{when}: {errors[0]}")
        self.assertIn(str(self.place), errors[0], when)

    @needs_strace
    def test_each_failing_call_of_a_report(self):
        self.with_old_and_new()
        self.user_files = True
        self.restore_old()
        old = tree(self.out)
        words = self.report_words()
        for number, call in enumerate(of_each_kind(list(writing(self.calls(WRITES, *words))))):
            error = list(REASONS)[number % len(REASONS)]
            self.restore_old()
            end, came = self.run_with(call, f"error={error}", *words)
            self.assertTrue(came, call.line)
            self.require_refusal(end, REASONS[error], call.line)
            self.assertEqual(tree(self.out), old, call.line)
            self.assertEqual(self.beside(), [], call.line)

    @needs_strace
    def test_each_failing_call_of_a_renewal_a_merge_and_marks(self):
        for made_of in (self.with_renewal, self.with_parts, self.with_marks):
            self.user_files = False
            _, _, words = made_of()
            self.user_files = True
            self.restore_old()
            old = tree(self.out)
            for call in of_each_kind(list(writing(self.calls(STEPS, *words)))):
                self.restore_old()
                end, came = self.run_with(call, "error=ENOSPC", *words)
                self.assertTrue(came, call.line)
                self.require_refusal(end, REASONS["ENOSPC"], call.line)
                self.assertEqual(tree(self.out), old, call.line)
                self.assertEqual(self.beside(), [], call.line)

    @needs_strace
    def test_each_failing_call_of_a_batch(self):
        """Tampers with the batch, which ends, or with its reports, which give a line each. The next run makes the missing reports."""
        old, new, words, code = self.with_batch()
        # Each process has a call with that number. Files that it opens and closes at its beginning are not output.
        points = self.calls([name for name in WRITES if name not in ("openat", "close")], *words, code=code)
        of_index = [c for c in points if any(path.rsplit("/", 1)[0] == str(self.out) for path in c.paths)]
        for call in [*some(points, 3), *of_each_kind(of_index)]:
            self.restore_old()
            end, came = self.run_with(call, "error=ENOSPC", *words)
            self.assertTrue(came, call.line)
            self.assertEqual(end.code, 4, f"{call.line}: {end.err}")
            errors = [line for line in end.err.splitlines() if "cannot" in line]
            self.assertLessEqual(len(errors), 2, f"{call.line}: {end.err}")
            # The call with that number may also write the message. Then the index has the message.
            told = errors + [row["error"] for row in json.loads((self.out / "batch.json").read_text())["meshes"] if "error" in row]
            self.assertTrue(told, f"{call.line}: {end.err}")
            for line in told:
                self.assertTrue(REASONS["ENOSPC"] in line and str(self.place) in line, line)
            self.require_batch_of(old, new, call.line)
            self.assertEqual(self.beside(), [], call.line)
        end = self.run_program(*words)
        self.assertEqual((end.code, tree(self.out)), (code, new), end.err)

    @needs_strace
    def test_each_failing_call_of_a_run_that_fails(self):
        good = self.report_tree(64)
        subprocess.run(["cp", "-r", self.report_of(64), self.out], check=True)
        self.environment["MESHFOLIO_FAIL"] = "q2"
        words = self.report_words()
        for call in of_each_kind(list(writing(self.calls(STEPS, *words, code=1)))):
            subprocess.run(["rm", "-rf", self.place / "out.failed"], check=True)
            end, came = self.run_with(call, "error=ENOSPC", *words)
            self.assertTrue(came, call.line)
            self.assertEqual(end.code, 4, call.line + end.err)
            self.assertEqual((tree(self.out), self.beside()), (good, []), call.line)

    @needs_strace
    @unittest.skipUnless(WHOLE, "with --whole only: tests/base/parallel_tasks_test.cpp asks for the same in little time")
    def test_a_failing_call_while_other_threads_work(self):
        """strace counts per thread, so each run hits another file. If no call has the number, the run succeeds."""
        old, _ = self.with_old_and_new()
        words, whole = (["q2,q4" if word == "q2" else word for word in self.report_words(out, threads=2)] for out in (self.out, self.folder / "whole"))
        self.assertEqual(self.run_program(*whole).code, 0)
        numbers = [c.number for c in writing(self.calls(["openat"], *words))]
        for number in some(range(min(numbers), max(numbers) + 1), 12):
            self.restore_old()
            log = self.folder / "trace"
            wrap = [STRACE, "-f", "-qq", "-e", "signal=none", "-o", log, "-e", "trace=openat", "-e", f"inject=openat:error=ENOSPC:when={number}"]
            end = self.run_program(*words, wrap=wrap)
            self.assertIn(end.code, (0, 4), f"{number}: {end.err}")
            self.assertEqual(tree(self.out), old if end.code == 4 else tree(self.folder / "whole"), number)
            self.assertEqual(self.beside(), [], number)

    @needs_strace
    def test_each_failing_call_of_a_folder_of_pictures(self):
        mesh = self.mesh("cube8")
        words = ["render", mesh, "--size", 64, "--views", "+x,-y", "--out", self.out]
        self.assertEqual(self.run_program(*words, "--edges").code, 0)
        old = tree(self.out)
        for number, call in enumerate(of_each_kind(list(writing(self.calls(WRITES, *words))))):
            error = list(REASONS)[number % len(REASONS)]
            self.assertEqual(self.run_program(*words, "--edges").code, 0)
            end, came = self.run_with(call, f"error={error}", *words)
            self.assertTrue(came, call.line)
            self.require_refusal(end, REASONS[error], call.line)
            self.assertEqual(tree(self.out), old, call.line)

    @needs_strace
    def test_each_failing_call_of_one_file(self):
        mesh, result = self.mesh(), self.place / "x.ply"
        words = ["smooth", mesh, "-o", result, "--lambda", "1e-4"]
        for call in list(writing(self.calls(WRITES, *words))):
            for error in REASONS if WHOLE else ["EIO"]:
                result.write_bytes(b"old")
                end, came = self.run_with(call, f"error={error}", *words)
                self.assertTrue(came, call.line)
                self.require_refusal(end, REASONS[error], call.line)
                self.assertEqual([p.name for p in self.place.iterdir()], ["x.ply"], call.line)
                self.assertEqual(result.read_bytes(), b"old", call.line)

    @needs_strace
    def test_a_broken_cache_is_no_reason_to_fail(self):
        new = self.report_tree(64)
        words = self.report_words(cached=True)
        points = list(writing(self.calls(WRITES, *words, within=self.folder / "cache")))
        for call in some(points, 4):
            subprocess.run(["rm", "-rf", self.folder / "cache" / "meshfolio", self.out], check=True)
            end, came = self.run_with(call, "error=ENOSPC", *words)
            self.assertTrue(came, call.line)
            self.assertEqual(end.code, 0, call.line + end.err)
            self.assertEqual(tree(self.out), new, call.line)
            self.assertIn("meshfolio: warning:", end.err, call.line)

    @needs_strace
    def test_standard_output_that_fails_when_it_is_closed(self):
        mesh, listing = self.mesh(), self.place / "listing"
        with open(listing, "wb") as file:
            calls = self.calls(["close"], "inspect", mesh, stdout=file)
        with open(listing, "wb") as file:
            log = self.folder / "trace"
            wrap = [*ONE_CPU, STRACE, "-f", "-qq", "-e", "signal=none", "-o", log, "-e", "trace=close", "-e", f"inject=close:error=EIO:when={calls[-1].number}"]
            end = self.run_program("inspect", mesh, wrap=wrap, stdout=file)
        self.assertEqual(end.code, 4, end.err)
        self.assertIn("standard output: may be incomplete, it cannot be closed (Input/output error); check the free space there and run again", end.err)

    def test_files_that_may_not_grow(self):
        old, new = self.with_old_and_new()
        largest = max((self.out / name).stat().st_size for name in old)
        for size in some([largest * i // 20 for i in range(1, 20)], 4):
            end = self.run_program(*self.report_words(), preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (size, size)))
            self.require_refusal(end, "File too large", size)
            self.assertEqual((tree(self.out), self.beside()), (old, []), size)

    def test_devices_as_outputs(self):
        mesh = self.mesh()
        for words in (["smooth", mesh, "-o", "/dev/full", "--lambda", "1e-4"], ["curvature", mesh, "--csv", "/dev/full"],
                      ["sample", "cube", "-o", "/dev/full"], ["spectrum", mesh, "-k", 3, "--vectors", "/dev/full"]):
            end = self.run_program(*words)
            self.assertIn(end.code, (2, 4), words)
            if end.code == 4:
                self.assertIn("/dev/full", end.err)
                self.assertIn("No space left on device", end.err)

    def test_missing_folders_and_folders_in_the_way(self):
        mesh = self.mesh()
        (self.place / "folder.ply").mkdir()
        for target, reason in ((self.place / "no" / "x.ply", "does not exist"), (self.place / "folder.ply", "Is a directory"),
                               (mesh / "x.ply", "does not exist"), (self.place / ("n" * 300 + ".ply"), "File name too long")):
            end = self.run_program("noise", mesh, "-o", target, "--sigma", 0.1)
            self.assertEqual(end.code, 4, end.err)
            self.assertEqual(len(end.err.splitlines()), 1)
            self.assertIn(reason, end.err)


    def test_a_working_directory_that_was_removed(self):
        def leave():
            os.mkdir("gone")
            os.chdir("gone")
            os.rmdir("../gone")
        for words in (["sample", "cube", "-o", "x.ply"], ["sample", "cube", "-o", "there/x.ply"], self.report_words("out"), ["templates", "mine"],
                      ["render", self.mesh("cube8"), "--size", 64]):
            end = self.run_program(*words, preexec_fn=leave)
            self.assertEqual((end.code, len(end.err.splitlines())), (4, 1), f"{words}: {end.err}")
            self.assertIn("No such file or directory", end.err)


@needs_mount
class Mounted(Faults):
    """Each test has its own mount namespace, which ends with its mounts."""

    def in_mount(self, options, script, **environment):
        """Runs the shell script with a new tmpfs at $M. Returns the finished process."""
        mount = self.folder / "mount"
        mount.mkdir(exist_ok=True)
        words = f"mount -t tmpfs -o {options} tmpfs \"$M\" && {{ {script}\n}}"
        process = subprocess.run(["unshare", "-m", "--propagation", "private", "sh", "-c", words], capture_output=True, text=True, timeout=200,
                                 env={**self.environment, "M": str(mount), "P": PROGRAM, "W": str(self.folder), **environment})
        return process

    REPORT = '"$P" report --quick --only q2 --pdf off --no-cache --no-timings --size 64 --out "$M/out"'
    SUMS = '( cd "$M/out" && find . -type f | sort | xargs sha256sum | sha256sum )'

    def test_a_small_disk(self):
        old, _ = self.with_old_and_new()
        kilobytes = sum((self.out / name).stat().st_size for name in old) // 1024
        for step in some(list(range(0, 20)), 4):
            size = kilobytes + 200 + kilobytes * step // 20
            script = f'cp -r "$W/place/out" "$M/out"; A=$( {self.SUMS} ); {self.REPORT}; C=$?; [ "$A" = "$( {self.SUMS} )" ] && [ "$(ls -A "$M")" = out ] && exit $C; exit 99'
            process = self.in_mount(f"size={size}k,mode=755", script)
            self.assertEqual(process.returncode, 4, process.stderr)
            self.assertIn("No space left on device", process.stderr)

    def test_a_small_disk_under_a_batch(self):
        """If the disk has no room for a report, the other reports stay. With more room, the next run makes it."""
        options = ["--only", "certificates", "--pdf", "off", "--no-timings", "--no-cache", "--size", 64, "--out"]
        torus, cube = self.mesh(), self.mesh("cube8")
        self.assertIn(self.run_program("batch", torus, *options, self.out).code, (0, 1))
        words = " ".join(["batch", str(torus), str(cube), *map(str, options), '"$M/out"'])
        kilobytes = sum(path.stat().st_size for path in self.out.rglob("*")) // 1024
        sums = self.SUMS.replace("out", "out/torus")
        script = (f'cp -r "$W/place/out" "$M/out"; A=$( {sums} ); "$P" {words}; [ $? = 4 ] || exit 98; [ "$A" = "$( {sums} )" ] || exit 97; '
                  f'[ ! -e "$M/out/cube8" ] || exit 96; mount -o remount,size=40m "$M"; "$P" {words}; [ $? -le 1 ] || exit 95; '
                  f'[ "$A" = "$( {sums} )" ] && [ -e "$M/out/cube8/results.json" ]')
        process = self.in_mount(f"size={kilobytes + 100}k,mode=755", script)
        self.assertEqual(process.returncode, 0, process.stderr)
        self.assertIn("No space left on device", process.stderr)

    def test_a_mount_point_keeps_its_good_report(self):
        report = self.REPORT.replace("$M/out", "$M")
        script = f'{report} && A=$( cd "$M" && cat SHA256SUMS ) || exit 99; MESHFOLIO_FAIL=q2 {report}; [ $? = 1 ] && [ "$A" = "$( cat "$M/SHA256SUMS" )" ] || exit 98; ( cd "$M.failed" && sha256sum -c --quiet SHA256SUMS ) || exit 97; {report} && [ ! -e "$M.failed" ]'
        process = self.in_mount("size=40m,mode=755", script)
        self.assertEqual(process.returncode, 0, process.stderr)

    def test_a_mount_point_leaves_the_users_files_alone(self):
        """This holds also after a kill between two files: the next run does not mistake our files for edited ones."""
        report = self.REPORT.replace("$M/out", "$M")
        kept = '[ "$(cat "$M/thesis.tex")" = months ] && [ "$(cat "$M/docs/a")" = a ] && [ "$(readlink "$M/link")" = /nowhere ] && [ -d "$M/docs/empty" ]'
        put = 'mkdir -p "$M/docs/empty"; echo months > "$M/thesis.tex"; echo a > "$M/docs/a"; ln -s /nowhere "$M/link"; mkdir -p "$M/images"; echo mine > "$M/images/mine.txt"'
        script = (f'{report} || exit 99; {put}; echo edited > "$M/report.md"; {report} || exit 98; {kept} || exit 97; '
                  f'[ "$(cat "$M/report.md.edited")" = edited ] && [ "$(cat "$M/images/mine.txt")" = mine ] || exit 96; '
                  f'( cd "$M" && sha256sum -c --quiet SHA256SUMS ) || exit 95; ')
        if STRACE:
            killed = self.REPORT.replace("$M/out", "$M").replace('"$P"', f'{STRACE} -f -qq -o /dev/null -e trace=renameat2 -e inject=renameat2:signal=KILL:when=8 "$P"').replace("--size 64", "--size 72")
            script += f'{killed}; {kept} || exit 94; {report} || exit 93; {kept} || exit 92; [ "$(ls -A "$M" | grep -c edited)" = 1 ] || exit 91; '
        process = self.in_mount("size=60m,mode=755", script + '( cd "$M" && sha256sum -c --quiet SHA256SUMS )')
        self.assertEqual(process.returncode, 0, process.stderr)

    def test_a_mount_point_inside_is_refused(self):
        script = (f'{self.REPORT} || exit 99; mkdir "$M/out/data"; mount -t tmpfs tmpfs "$M/out/data"; echo x > "$M/out/data/x"; A=$( {self.SUMS} ); '
                  f'{self.REPORT}; C=$?; [ "$A" = "$( {self.SUMS} )" ] && [ "$(ls -A "$M")" = out ] && exit $C; exit 98')
        process = self.in_mount("size=40m,mode=755", script)
        self.assertEqual(process.returncode, 4, process.stderr)
        self.assertIn("is a mount point", process.stderr)

    def test_a_disk_that_may_not_be_written(self):
        self.with_old_and_new()
        script = f'cp -r "$W/place/out" "$M/out"; mount -o remount,ro "$M"; A=$( {self.SUMS} ); {self.REPORT}; C=$?; [ "$A" = "$( {self.SUMS} )" ] && exit $C; exit 99'
        process = self.in_mount("size=40m,mode=755", script)
        self.assertEqual(process.returncode, 4, process.stderr)
        self.assertIn("Read-only file system", process.stderr)

    def test_an_output_folder_that_is_a_mount_point_serves_one_run_at_a_time(self):
        report = self.REPORT.replace("$M/out", "$M")
        script = f"{report} 2>$W/a & A=$!; {report} 2>$W/b; B=$?; wait $A; A=$?; cd $M && sha256sum -c --quiet SHA256SUMS >/dev/null 2>&1 || exit 99; [ $A = 4 ] || [ $B = 4 ] || exit 98; [ $A = 0 ] || [ $B = 0 ]"
        process = self.in_mount("size=40m,mode=755", script)
        told = (self.folder / "a").read_text() + (self.folder / "b").read_text()
        if process.returncode != 98:   # one run ended before the other began
            self.assertEqual(process.returncode, 0, told + process.stderr)
            self.assertIn("is busy: another run is writing there", told)


if __name__ == "__main__":
    unittest.main(verbosity=2)
