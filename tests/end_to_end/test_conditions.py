"""`inspect MESH MEASURE` and `inspect --require`: they agree with `inspect --json`, on good and bad meshes."""

import json
import operator
import unittest
import xml.etree.ElementTree as ElementTree

from in_folder import InFolder

SIGNS = {"=": operator.eq, "!=": operator.ne, "<": operator.lt, "<=": operator.le, ">": operator.gt, ">=": operator.ge}
TETRAHEDRON = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"
BOW = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv -1 0 0\nv -1 1 0\nf 1 2 3\nf 1 5 4\n"


def flat(value, key=""):
    """Returns the measures of --json by their keys with dots: numbers, truths, and lengths of other lists."""
    if isinstance(value, dict) or (isinstance(value, list) and value and isinstance(value[0], (int, float))):
        parts = value.items() if isinstance(value, dict) else enumerate(value)
        return {k: v for name, part in parts for k, v in flat(part, f"{key}.{name}" if key else str(name)).items()}
    return {key: len(value) if isinstance(value, list) else value}


class Conditions(InFolder):
    def meshes(self):
        self.write("tetrahedron.obj", TETRAHEDRON)
        self.write("bow.obj", BOW)
        self.write("open.obj", TETRAHEDRON.rsplit("f", 1)[0])
        return [self.sample(name) for name in ("cube8", "torus", "saddle")] + ["tetrahedron.obj", "bow.obj", "open.obj"]

    def measures(self, mesh):
        return flat(json.loads(self.succeed("inspect", mesh, "--json")))

    def lines(self, mesh, *conditions):
        """Returns the exit code and [condition, measured, verdict] of each line."""
        words = [word for text in conditions for word in ("--require", text)]
        code, out, err = self.run_here("inspect", mesh, *words)
        self.assertLess(code, 2, err)
        return code, [line.split(None, 1)[:1] + line.split(None, 1)[1].rsplit(None, 1) for line in out.splitlines()]

    def test_a_measure_is_that_of_json(self):
        for mesh in self.meshes():
            measures = self.measures(mesh)
            for key in list(measures)[::7] + ["boundary_loops", "definiteness.verdict", "gauss_bonnet.residual", "box_low.0"]:
                told, value = self.succeed("inspect", mesh, key.replace("_", "-")).rstrip("\n"), measures[key]
                wanted = "" if value is None else {True: "yes", False: "no"}[value] if isinstance(value, bool) else value
                self.assertEqual(float(told) if isinstance(wanted, (int, float)) else told, wanted, (mesh, key))

    def test_conditions_agree_with_json(self):
        for mesh in self.meshes():
            measures = {key: value for key, value in self.measures(mesh).items() if not isinstance(value, str) and key != "why_no_volume"}
            conditions, expected = [], []
            for number, (key, value) in enumerate(measures.items()):
                if isinstance(value, bool):
                    conditions += [key, f"{key}=no", f"{key}!=no"]
                    expected += [value, not value, value]
                    continue
                limit = 0 if value is None else value
                for sign, compare in list(SIGNS.items())[number % 2::2]:
                    for near in (limit, limit - 1, limit + 1):
                        conditions.append(f"{key}{sign}{near!r}")
                        expected.append(value is not None and compare(value, near))
            code, lines = self.lines(mesh, ",".join(conditions[:9]), ",".join(conditions[9:]))
            self.assertEqual([line[0] for line in lines], conditions)
            self.assertEqual([line[2] for line in lines], ["holds" if holds else "FAILS" for holds in expected], mesh)
            self.assertEqual(code, 1)
            good = [condition for condition, holds in zip(conditions, expected) if holds]
            self.assertEqual(self.lines(mesh, *good)[0], 0)

    def test_words_and_reasons(self):
        mesh = self.sample("torus")
        self.assertEqual(self.succeed("inspect", mesh, "--require", "closed,genus=1,smallest-angle>=5,components<2").split()[0], "closed")
        _, lines = self.lines(mesh, "closed,manifold,orientable,watertight,genus=0")
        self.assertEqual(lines, [["closed", "yes", "holds"], ["manifold", "yes", "holds"], ["orientable", "yes", "holds"],
                                 ["watertight", "yes", "holds"], ["genus=0", "1", "FAILS"]])
        self.write("bow.obj", BOW)
        code, lines = self.lines("bow.obj", "volume>0,genus=0,watertight")
        self.assertEqual((code, [line[2] for line in lines]), (1, ["FAILS"] * 3))
        self.assertRegex(lines[0][1], "^undefined: the surface is open")
        self.assertIn("bow.obj: 3 of 3 conditions failed: volume>0 (undefined)", self.refuse(1, "inspect", "bow.obj", "--require", "volume>0,genus=0,closed"))

    def test_columns_are_aligned(self):
        out = self.succeed("inspect", self.sample("cube8"), "--require", "closed,euler-characteristic=2,area>0")
        self.assertEqual(len({line.index("holds") for line in out.splitlines()}), 1)
        self.assertTrue(all(len([part for part in line.split("  ") if part.strip()]) == 3 for line in out.splitlines()), out)

    def test_json_and_junit(self):
        mesh = self.sample("cube8")
        code, out, _ = self.run_here("inspect", mesh, "--json", "--require", "closed,genus=1,area>0", "--junit", "mesh.xml")
        self.assertEqual(code, 1)
        told = json.loads(out)
        self.assertEqual([(c["condition"], c["measured"], c["holds"]) for c in told["conditions"]],
                         [("closed", True, True), ("genus=1", 0, False), ("area>0", told["area"], True)])
        suite = ElementTree.parse(self.path("mesh.xml")).getroot().find("testsuite")
        self.assertEqual((suite.get("tests"), suite.get("failures"), suite.get("name")), ("3", "1", "inspect: cube8.obj"))
        failures = [case.find("failure") for case in suite.iter("testcase")]
        self.assertEqual([failure is None for failure in failures], [True, False, True])
        self.assertIn("genus=1: measured 0, expected 1", failures[1].get("message"))
        self.assertIn("area>0: measured 6", suite.findtext("system-out"))

    def test_wrong_conditions(self):
        mesh = self.sample("cube8")
        for condition, words in (("clsoed", "did you mean 'closed'?"), ("genus", "no condition on a number"), ("genus=", "not a finite number"),
                                 ("genus=x", "not a finite number"), ("genus=>1", "no condition on a number"), ("closed>0", "true or false"),
                                 ("closed=maybe", "yes, no"), ("why-no-volume=1", "is a text"), ("closed,,manifold", "unknown measure ''")):
            self.assertIn(words, self.refuse(2, "inspect", "none.obj", "--require", condition), condition)
        self.assertIn("did you mean 'genus'?", self.refuse(2, "inspect", mesh, "gneus"))
        self.refuse(2, "inspect", mesh, "genus", "--json")
        self.refuse(2, "inspect", mesh, "genus", "--require", "closed")
        self.refuse(2, "inspect", mesh, "--junit", "x.xml")
        self.refuse(2, "inspect", mesh, "--require", "closed", "--junit", "x.txt")
        self.refuse(4, "inspect", mesh, "--require", "closed", "--junit", "none/x.xml")


if __name__ == "__main__":
    unittest.main()
