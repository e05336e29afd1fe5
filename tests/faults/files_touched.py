"""A run with misleading names touches only its inputs, the system's libraries, its outputs and its cache, and starts no other program and no
shell."""

import os
import re
import unittest

from common import STRACE, Faults, needs_strace

SYSTEM = ("/lib/", "/lib64/", "/usr/lib/", "/usr/lib64/", "/usr/local/lib/", "/etc/ld.so", "/proc/self/", "/proc/cpuinfo", "/proc/meminfo", "/proc/sys/vm/",
          "/sys/devices/system/", "/sys/fs/cgroup/", "/sys/kernel/mm/", "/dev/null", "/proc/filesystems", "/etc/localtime", "/usr/share/zoneinfo",
          "/etc/nsswitch.conf", "/etc/passwd")  # the account's home folder
MISLEADING = ["$(touch PWNED).obj", "a;touch PWNED;.obj", "`touch PWNED`.obj", "..obj", "a .. b.obj", "|touch PWNED.obj", "-rf.obj", "a\nb.obj"]
READING = ["open", "openat", "openat2"]
CHANGING = ["rename", "renameat", "renameat2", "link", "linkat", "symlink", "symlinkat", "unlink", "unlinkat", "rmdir", "mkdir", "mkdirat", "truncate",
            "chmod", "fchmodat", "mknod", "mknodat", "creat"]
RUNNING = ["execve", "execveat", "fork", "vfork"]


def unescaped(text):
    return text.encode("latin-1", "replace").decode("unicode_escape").encode("latin-1").decode("utf-8", "replace")


@needs_strace
class FilesTouched(Faults):
    def touched(self, *words, **options):
        """Runs the program. Returns the finished process and [(call, paths, is for writing, has succeeded)]."""
        log = self.folder / "trace"
        wrap = [STRACE, "-f", "-y", "-qq", "-s", "4096", "-e", "signal=none", "-o", log, "-e", "trace=" + ",".join("?" + n for n in READING + CHANGING + RUNNING)]
        end = self.run_program(*words, wrap=wrap, **options)
        calls = []
        for line in log.read_text(errors="replace").splitlines():
            match = re.match(r"\d+ +(\w+)\((.*)", line)
            if match:
                named = re.findall(r'(?:(?:AT_FDCWD|\d+)<([^>]*)>, )?"((?:[^"\\]|\\.)*)"', match[2])
                paths = [unescaped(text if text.startswith("/") or not folder else f"{folder}/{text}") for folder, text in named]
                for_writing = match[1] in CHANGING or re.search(r"O_(WRONLY|RDWR|CREAT)", match[2]) is not None
                calls.append((match[1], paths, for_writing, " = -1 " not in match[2]))
        return end, calls

    def require_allowed(self, calls, inputs, outputs):
        runs = [paths for name, paths, _, _ in calls if name in RUNNING]
        self.assertEqual(len(runs), 1, runs)   # the program itself
        for name, paths, for_writing, worked in calls:
            for path in paths if name not in RUNNING else []:
                full = os.path.normpath(path)
                if for_writing:
                    self.assertTrue(full.startswith(tuple(map(str, outputs))), f"{name} changes {full}")
                elif worked:
                    allowed = full.startswith(SYSTEM) or full.startswith(tuple(map(str, [*inputs, *outputs])))
                    folder = any(str(one).startswith(full.rstrip("/") + "/") for one in outputs)   # to flush or to remove it
                    self.assertTrue(allowed or folder, f"{name} reads {full}")

    def test_names_that_mislead_and_libraries_of_materials(self):
        (self.folder / "secret").write_text("newmtl x\nmap_Kd map\n")
        inputs = self.folder / "inputs"
        inputs.mkdir()
        for name in MISLEADING:
            (inputs / name).write_text("mtllib ../secret\nmtllib /etc/passwd\nmtllib ../../../../../../etc/passwd\nusemtl x\n"
                                       "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n")
            end, calls = self.touched("inspect", f"./{name}", cwd=inputs)
            self.assertEqual(end.code, 0, end.err)
            self.require_allowed(calls, [inputs], ["/nowhere"])
            self.assertFalse([p for _, paths, *_ in calls for p in paths if "secret" in p or "passwd" in p])
        self.assertEqual(sorted(p.name for p in inputs.iterdir()), sorted(MISLEADING))

    def test_a_report_of_a_mesh_with_a_misleading_name(self):
        mesh = self.mesh("cube8")
        misleading = self.folder / "inputs" / "..$(touch PWNED) <b>.ply"
        misleading.parent.mkdir()
        mesh.rename(misleading)
        cache = self.folder / "cache" / "meshfolio"
        words = [*self.report_words(cached=True), misleading]
        words[words.index("q2")] = "certificates"
        for _ in range(2):   # the second takes its answer from the cache
            end, calls = self.touched(*words)
            self.assertIn(end.code, (0, 1), end.err)
            self.require_allowed(calls, [misleading], [self.out, cache])
        self.assertEqual(sorted(p.name for p in self.folder.iterdir()), ["cache", "inputs", "place", "tmp", "trace"])

    def test_outputs_below_a_question_that_would_leave_the_folder(self):
        settings = self.folder / "report.toml"
        settings.write_text('[[question]]\nid = "q4"\noutput = "../../escaped"\n')
        end, calls = self.touched(*self.report_words(), "--config", settings)
        self.assertEqual(end.code, 2, end.err)
        self.assertFalse([paths for _, paths, for_writing, _ in calls if for_writing])

    def test_what_replaces_a_private_file_is_private_from_its_first_byte(self):
        private = self.place / "private.ply"
        private.write_text("")
        private.chmod(0o600)
        end, _ = self.touched("sample", "cube8", "-o", private, umask=0)
        self.assertEqual(end.code, 0, end.err)
        created = re.findall(r'openat\([^\n]*"[^"]*/place/[^\n]*O_CREAT[^\n]*, 0(\d+)\)', (self.folder / "trace").read_text())
        self.assertEqual(created, ["600"])


if __name__ == "__main__":
    unittest.main(verbosity=2)
