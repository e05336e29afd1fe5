"""Output has the same bytes for any time zone, date, locale, number of threads, working directory, output path, umask, environment and state
of memory. With --whole also for programs built in differently named folders, with -O2 and with -O3."""

import os
import shutil
import subprocess
import unittest

from common import SOURCE, WHOLE, Faults, tree

CPUS = sorted(os.sched_getaffinity(0))


class Determinism(Faults):
    def setUp(self):
        super().setUp()
        self.base = {"TZ": "UTC", "LC_ALL": "C"}

    def words(self, out, threads=1):
        questions = "q1,q4,q5" if WHOLE else "q2,q4"
        return ["report", "--quick", "--only", questions, "--pdf", "off", "--no-cache", "--no-timings", "--size", 64, "--threads", threads, "--out", out]

    def made(self, name, *, threads=1, wrap=(), environment=None, words=None, **options):
        out = self.place / name
        end = self.run_program(*(words or self.words)(out, threads), wrap=wrap, env={**self.environment, **self.base, **(environment or {})}, **options)
        self.assertEqual(end.code, 0, end.err)
        files = tree(out)
        shutil.rmtree(out)
        self.assertGreater(len(files), 5)
        return files

    def require_same(self, expected, files, what):
        differing = [name for name in {*expected, *files} if expected.get(name) != files.get(name)]
        self.assertEqual(differing, [], what)

    def german(self):
        """Makes a locale with a decimal comma. Returns its variables; None if that is impossible."""
        locales = self.folder / "locales"
        locales.mkdir(exist_ok=True)
        if not shutil.which("localedef"):
            return None
        subprocess.run(["localedef", "--no-archive", "-i", "de_DE", "-f", "UTF-8", str(locales / "de_DE.UTF-8")], capture_output=True)
        variables = {"LOCPATH": str(locales), "LC_ALL": "de_DE.UTF-8", "LANG": "de_DE.UTF-8"}
        shown = subprocess.run(["bash", "-c", "printf %.1f 1,5"], env={**os.environ, **variables}, capture_output=True, text=True).stdout
        return variables if shown == "1,5" else None

    def test_reports(self):
        deep = self.folder / "deeper" / "and deeper"
        deep.mkdir(parents=True)
        expected = self.made("a", wrap=["taskset", "-c", str(CPUS[0])])
        changes = {
            "again, on all processors": {},
            "two threads": {"threads": 2},
            "time zone": {"environment": {"TZ": "Asia/Kolkata"}},
            "working directory and output path": {"cwd": deep, "name": "a longer name with ö/out"},
            "umask": {"preexec_fn": lambda: os.umask(0o077)},
            "other variables": {"environment": {"HOME": str(deep), "USER": "someone", "COLUMNS": "40", "HOSTNAME": "else.example", "TMPDIR": str(deep)}},
            "dirty memory, no random addresses": {"environment": {"MALLOC_PERTURB_": "165"}, "wrap": ["setarch", "-R"]},
        }
        german = self.german()
        if german:
            changes["decimal comma"] = {"environment": german}
        else:
            print("no locale with a decimal comma can be made here", flush=True)
        if shutil.which("faketime"):
            changes["400 days later"] = {"wrap": ["faketime", "-f", "+400d"]}
        else:
            print("faketime is not installed", flush=True)
        environment, wrap = {}, []
        for change in changes.values():
            environment |= change.get("environment", {})
            wrap += change.get("wrap", [])
        together = {"threads": 2, "cwd": deep, "preexec_fn": lambda: os.umask(0o077), "environment": environment, "wrap": wrap}
        changes = {**(changes if WHOLE else {}), "all at once; --whole tries each alone": together}
        for what, change in changes.items():
            with self.subTest(what):
                self.require_same(expected, self.made(change.pop("name", "b"), **change), what)

    def test_single_files(self):
        mesh = self.mesh("torus", "--subdivide", 1)
        commands = {
            "views": lambda out, threads: ["render", mesh, "--field", "h-cotan", "--size", 200, "--out", out],
            "spectrum": lambda out, threads: ["spectrum", mesh, "-k", 30, "--reconstruct", "1,2,5,10,20,30", "--out", out],
        }
        for name, words in commands.items():
            expected = self.made(name, words=words, wrap=["taskset", "-c", str(CPUS[0])])
            for change in ({}, {"environment": {"MALLOC_PERTURB_": "165", "TZ": "Asia/Kolkata"}}, {"environment": self.german() or {}}):
                self.require_same(expected, self.made(name, words=words, **change), name)

    def large_mesh(self):
        """Writes a mesh of 30,324 vertices, 103,092 with --whole: two creatures, irregular enough for threads to share one factor."""
        path, points, faces = self.folder / "large.obj", [], []
        for shift, subdivide in ((0, 2 if WHOLE else 1), (10, 0)):
            end = self.run_program("sample", "creature", "--subdivide", subdivide, "-o", path)
            self.assertEqual(end.code, 0, end.err)
            first = len(points)
            for kind, *words in filter(None, map(str.split, path.read_text().splitlines())):
                if kind == "v":
                    points.append(f"v {float(words[0]) + shift!r} {words[1]} {words[2]}")
                elif kind == "f":
                    faces.append("f " + " ".join(str(int(w.split("/")[0]) + first) for w in words))
        path.write_text("\n".join(points + faces) + "\n")
        self.assertGreater(len(points), 100000 if WHOLE else 30000)
        return path

    def test_factors_of_a_large_mesh(self):
        mesh, settings = self.large_mesh(), self.folder / "large.toml"
        steps, questions = ([1e-5, 1e-4, 1e-3, 1e-2], "q6,q7") if WHOLE else ([1e-2], "q7")   # at least two factors at once, one for each noise
        settings.write_text("".join(f'[[question]]\nid = "{id}"\nmesh = "{mesh.name}"\nlambda = {steps}\niterations = [1]\n{more}\n'
                                    for id, more in (("q6", ""), ("q7", "noise = [0.001, 0.004]"))))

        def words(out, threads):
            return ["report", "--config", settings, "--quick", "--only", questions, "--pdf", "off", "--no-cache", "--no-timings", "--size", 64,
                    "--threads", threads, "--out", out]

        expected = self.made("a", words=words)
        for threads in (2, 4) if WHOLE else (2,):
            self.require_same(expected, self.made("a", words=words, threads=threads), f"{threads} threads")

    def test_the_order_of_folders(self):
        """The order in which files were made must not matter."""
        outs = []
        for order in (1, -1):
            data = self.folder / f"data{order}" / "meshes"
            data.mkdir(parents=True)
            for name in sorted(p.name for p in (SOURCE / "data").glob("*.obj"))[::order]:
                shutil.copy(SOURCE / "data" / name, data / name)
            templates = self.folder / f"templates{order}"
            templates.mkdir()
            for path in sorted((SOURCE / "templates").iterdir())[::order]:
                if path.is_file():
                    shutil.copy(path, templates / path.name)
            outs.append(self.made("a", words=lambda out, threads: [*self.words(out, threads), "--data", data, "--templates", templates]))
        self.require_same(*outs, "order of the files in folders")

    @unittest.skipUnless(WHOLE, "only with --whole: builds the program four times")
    def test_the_path_of_the_checkout(self):
        files = subprocess.run(["git", "ls-files", "-z"], cwd=SOURCE, capture_output=True, check=True).stdout.decode().split("\0")
        for optimisation in ("-O2", "-O3"):
            made = []
            for checkout in ("a", "elsewhere/a longer name"):
                source, build = self.folder / checkout / optimisation, self.folder / checkout / f"build{optimisation}"
                for file in filter(None, files):
                    (source / file).parent.mkdir(parents=True, exist_ok=True)
                    shutil.copy(SOURCE / file, source / file)
                launcher = ["-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"] if shutil.which("ccache") else []
                configure = ["cmake", "-S", source, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DMESHFOLIO_TESTS=OFF",
                             "-DMESHFOLIO_JOIN_SOURCES=ON", f"-DCMAKE_CXX_FLAGS_RELEASE={optimisation} -DNDEBUG", *launcher]
                for words in (configure, ["cmake", "--build", build, "--target", "meshfolio"]):
                    process = subprocess.run(list(map(str, words)), capture_output=True, text=True, env={**os.environ, "CCACHE_NOHASHDIR": "1"})
                    self.assertEqual(process.returncode, 0, process.stdout[-2000:] + process.stderr[-2000:])
                for threads in (1, 2):
                    made.append(self.made("a", threads=threads, program=build / "meshfolio"))
            for other in made[1:]:
                self.require_same(made[0], other, optimisation)


if __name__ == "__main__":
    unittest.main(verbosity=2)
