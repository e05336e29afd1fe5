"""What the script of the page adds to a table: sorting and filtering. Driven in a headless browser; skipped without one."""

import re
import shutil
import subprocess
import unittest

from program import run, temporary_folder

BROWSER = next(filter(None, map(shutil.which, ["chromium-headless-shell", "chromium", "chrome-headless-shell"])), None)

# What is told of the ledger after each act; one line each.
ACTS = """
addEventListener("load", () => {
    const figure = document.getElementById("claims_ledger"), table = figure.querySelector("table");
    const heads = [...table.tHead.rows[0].cells], told = [];
    const column = (name) => heads.findIndex((head) => head.textContent.includes(name));
    const values = (name) => [...table.tBodies[0].rows].filter((row) => !row.hidden).map((row) => {
        const cell = row.cells[column(name)];
        return cell.dataset.value ?? cell.textContent.trim();
    });
    const click = (name) => heads[column(name)].querySelector("button").click();
    const choose = (name, pick) => {
        const select = [...figure.querySelectorAll("select")].find((s) => s.closest("label").textContent.startsWith(name));
        select.selectedIndex = [...select.options].findIndex((option) => option.textContent.includes(pick));
        select.dispatchEvent(new Event("change"));
    };
    const tell = (what, list) => told.push([what, ...list].join("\\t"));
    const number = "deciding number";
    tell("start", values(number));
    click(number); tell("ascending", values(number)); tell("aria", [heads[column(number)].getAttribute("aria-sort")]);
    click(number); tell("descending", values(number));
    click("source"); tell("sources", values("source")); tell("numbers within", values(number));
    tell("aria again", heads.map((head) => head.getAttribute("aria-sort") ?? "none"));
    click("no."); tell("no.", values("no."));
    choose("verdict", "refuted"); tell("refuted", values("verdict"));
    choose("source", "S0"); tell("refuted of S0", values("source")); tell("count", [figure.querySelector("output").textContent]);
    choose("verdict", "all"); choose("source", "all"); tell("all", values("no."));
    const out = document.createElement("pre");
    out.id = "told"; out.textContent = told.join("\\n"); document.body.append(out);
});
"""


@unittest.skipUnless(BROWSER, "no headless browser is installed")
class Ledger(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = temporary_folder(cls.case())
        process = run("report", "--only", "claims", "--quick", "--size", 64, "--out", folder / "out")
        assert process.returncode == 0, process.stderr
        cls.page = (folder / "out" / "index.html").read_text()
        # The acts are a second script, which the policy of the page would refuse.
        acting = re.sub(r'<meta http-equiv="Content-Security-Policy"[^>]*/>', "", cls.page)
        (folder / "acting.html").write_text(acting.replace("</body>", f"<script>{ACTS}</script></body>"))
        arguments = ["--no-sandbox", "--disable-gpu", "--virtual-time-budget=5000", f"--user-data-dir={folder}/browser", "--dump-dom"]
        dom = subprocess.run([BROWSER, *arguments, f"file://{folder}/acting.html"], capture_output=True, text=True, timeout=120)
        told = re.search(r'<pre id="told">(.*?)</pre>', dom.stdout, re.S)
        assert told, dom.stderr
        cls.told = {line.split("\t")[0]: line.split("\t")[1:] for line in told[1].splitlines()}

    @classmethod
    def case(cls):
        """What temporary folders are tied to: this class."""
        return type("Cleanup", (), {"addCleanup": staticmethod(cls.addClassCleanup)})

    def numbers(self, what):
        return [float(value) for value in self.told[what] if value != "–"]

    def test_without_a_script_it_is_a_plain_table(self):
        body = self.page[self.page.index("<body>"):self.page.index("<script>")]
        self.assertNotIn("<select", body)
        self.assertNotIn("<button", body)
        self.assertNotIn("hidden", body)

    def test_numbers_are_sorted_as_numbers_and_empty_cells_come_last(self):
        for what, reverse in (("ascending", False), ("descending", True)):
            self.assertEqual(self.numbers(what), sorted(self.numbers("start"), reverse=reverse), what)
            empty = self.told[what].index("–")
            self.assertEqual(set(self.told[what][empty:]), {"–"}, what)
        self.assertEqual(self.told["aria"], ["ascending"])

    def test_sorting_by_a_second_column_keeps_the_first(self):
        self.assertEqual(self.told["sources"], sorted(self.told["sources"], key=str.casefold))
        for source in set(self.told["sources"]):
            within = [n for n, s in zip(self.told["numbers within"], self.told["sources"]) if s == source]
            numbers = [float(n) for n in within if n != "–"]
            self.assertEqual(numbers, sorted(numbers, reverse=True), source)
        self.assertEqual(sum(state != "none" for state in self.told["aria again"]), 1)

    def test_claims_are_counted_not_spelt(self):
        counts = [int(label.rsplit(".", 1)[1]) for label in self.told["no."]]
        self.assertEqual(counts, list(range(1, len(counts) + 1)))

    def test_filters_combine_and_let_go(self):
        self.assertTrue(self.told["refuted"])
        self.assertTrue(all("refuted" in verdict for verdict in self.told["refuted"]))
        self.assertEqual(set(self.told["refuted of S0"]), {"S0"})
        self.assertLess(len(self.told["refuted of S0"]), len(self.told["refuted"]))
        self.assertEqual(self.told["count"], [f"{len(self.told['refuted of S0'])} of {len(self.told['no.'])} rows"])
        self.assertEqual(len(self.told["all"]), len(self.told["no."]))


if __name__ == "__main__":
    unittest.main(verbosity=2)
