"""Executes the example notebook and checks its outputs. Skipped (77) if nbclient is missing."""

import sys
import unittest
from pathlib import Path

try:
    import ipykernel  # noqa: F401  (the kernel that nbclient starts)
    import matplotlib  # noqa: F401
    import nbclient
    import nbformat
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

NOTEBOOK = Path(__file__).resolve().parents[2] / "data/notebooks/refinement.ipynb"


class Notebook(unittest.TestCase):
    def test_it_has_no_stored_outputs_runs_and_shows_pictures_and_a_plot(self):
        notebook = nbformat.read(NOTEBOOK, as_version=4)
        code = [cell for cell in notebook.cells if cell.cell_type == "code"]
        self.assertTrue(all(not cell.outputs and cell.execution_count is None for cell in code))
        nbclient.NotebookClient(notebook, timeout=600, kernel_name="python3").execute()
        shown = [set(output.get("data", {})) for cell in code for output in cell.outputs]
        self.assertTrue(any("text/html" in kinds and "image/png" in kinds for kinds in shown), "the mesh")
        self.assertEqual(sum("image/png" in kinds for kinds in shown), 3, shown)
        before, after = (float(x) for x in code[4].outputs[0]["data"]["text/plain"].strip("()").split(","))
        self.assertLess(after, before, "an implicit step takes noise away")


if __name__ == "__main__":
    unittest.main(verbosity=2)
