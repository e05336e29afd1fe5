"""Documents that try to run other programs, or to read and write elsewhere, and names that look like commands."""

import os
import re
import shutil
import unittest
import urllib.parse

from document import InDocuments, Made, block, nodes, words

OUTSIDE = "leads out of the folders"


class Hostile(InDocuments):

    def setUp(self):
        super().setUp()
        self.home = self.folder
        self.folder = self.home / "work"   # the document's folder; nothing may change beside it
        self.folder.mkdir()
        for name in ("work/cube.obj", "secret.obj"):
            shutil.copy(self.home / "cube.obj", self.home / name)
        self.before = self.around()

    def around(self):
        return {str(path.relative_to(self.home)): path.read_bytes() for path in self.home.rglob("*") if path.is_file() and self.folder not in path.parents}

    def refuse(self, commands, reason, meta=""):
        """Requires that each command fails for this reason, in a block and in running text, and that nothing changes elsewhere."""
        text = "".join(block(command) + f"\n`` {command} ``{{.meshfolio}}\n" for command in commands)
        tree = self.tree(text, meta=meta + ", errors: show")
        boxes = [words(content) for attributes, content in nodes(tree, "Span") if "meshfolio-error" in attributes[1]]
        self.assertEqual(len(boxes), 2 * len(commands), (commands, boxes))
        for i, message in enumerate(boxes):
            self.assertRegex(message, reason, commands[i // 2])
        self.assertEqual(self.around(), self.before, commands)

    def test_only_commands_of_the_list_are_run(self):
        self.refuse(["report", "batch cube.obj --out x", "templates .", "lab cube.obj -o x.html", "cache --clear", "submit", "/bin/sh -c id", "sh", "-h",
                     "version", "''"], "cannot be run here")

    def test_there_is_no_shell(self):
        self.refuse(["inspect cube.obj; touch x", "inspect cube.obj && touch x", "inspect cube.obj | sh", "inspect cube.obj > x", "inspect < cube.obj",
                     "inspect `touch x`"], "without a shell")
        self.refuse(["inspect $(touch)", "inspect $HOME", "inspect ~/secret.obj", "inspect *.obj", "inspect {cube,x}.obj"], "cannot open the file")
        self.assertFalse((self.folder / "x").exists())

    def test_inputs_outside_are_refused(self):
        names = ("../secret.obj", str(self.home / "secret.obj"), "x/../../secret.obj", "./../secret.obj", "/dev/zero")
        self.refuse([command.format(name) for name in names for command in (
            "inspect '{}'", "render cube.obj '{}'", "render cube.obj --values '{}:k'", "render cube.obj --colormap='{}'", "smooth cube.obj -o a.ply --trace {}")], OUTSIDE)
        for name in names:
            self.refuse(["inspect bunny"], OUTSIDE, meta=f", meshes: {{ bunny: '{name}' }}")
        (self.folder / "link.obj").symlink_to(self.home / "secret.obj")
        (self.folder / "away").symlink_to(self.home)
        self.refuse(["inspect link.obj", "inspect away/secret.obj"], OUTSIDE)

    def test_outputs_outside_are_refused(self):
        self.refuse([command.format(name) for name in ("../x.ply", str(self.home / "x.ply"), "y/../../x.ply", "../cube.obj") for command in (
            "noise cube.obj --sigma 1 -o '{}'", "noise cube.obj --sigma 1 --output='{}'", "sample cube -o '{}'",
            "curvature cube.obj --csv '{}'", "render cube.obj -o '{}'", "render cube.obj --out '{}'", "render cube.obj --out x --glb '{}'",
            "spectrum cube.obj -k 2 --vectors '{}'", "compare cube.obj cube.obj --html '{}'", "spectrum cube.obj -k 2 --reconstruct 2 --out '{}'",
            "inspect cube.obj --junit {}", "smooth cube.obj -o a.ply --plot {}", "smooth cube.obj -o a.ply --unknown '{}'")], OUTSIDE)
        self.refuse(["noise cube.obj --sigma 1 -o../x.ply"], "write a blank")
        self.make(block("render cube.obj --views +x --size 16") + block("spectrum cube.obj -k 2 --reconstruct 2"), "-t", "plain")
        self.assertEqual(self.around(), self.before, "folders that are not named")

    def test_links_in_the_folder_of_outputs_are_refused(self):
        (self.folder / "a_files").symlink_to(self.home)
        made = self.make(block("noise cube.obj --sigma 1 -o secret.obj") + block("render cube.obj", "#fig-a"), "-t", "html")
        self.assertNotEqual(made.code, 0)
        self.assertEqual(self.around(), self.before)
        os.unlink(self.folder / "a_files")
        (self.folder / "a_files").mkdir()
        (self.folder / "a_files" / "n.ply").symlink_to(self.home / "secret.obj")
        (self.folder / "a_files" / "cache").symlink_to(self.home)
        self.refuse(["noise cube.obj --sigma 1 -o n.ply", "inspect cube.obj"], OUTSIDE)

    def test_the_metadata_may_allow_it(self):
        made = self.make(block("noise ../secret.obj --sigma 0.01 -o ../n.ply") + block("inspect ../n.ply"), "-t", "plain", meta=", allow-outside: true")
        self.assertEqual(made.code, 0, made.message)
        self.assertTrue((self.folder / "n.ply").exists() or (self.home / "n.ply").exists())

    def test_the_program_is_not_the_documents_choice(self):
        evil = self.folder / "evil"
        evil.write_text("#!/bin/sh\ntouch x\n")
        evil.chmod(0o755)
        self.make(block("inspect cube.obj"), "-t", "plain", meta=", program: ./evil")
        self.assertFalse((self.folder / "x").exists())

    def test_a_cache_from_elsewhere_cannot_run_anything(self):
        self.make(block("inspect cube.obj"), "-t", "plain")
        for record in (self.folder / "a_files" / "cache").iterdir():
            record.write_text("\n`touch x` os.execute('touch x')\n")
        made = self.make(block("inspect cube.obj"), "-t", "plain")
        self.assertEqual((made.code, (self.folder / "x").exists()), (0, False), made.message)

    def test_strange_names_are_names(self):
        text, names = "", ("a b", "it's", 'say "no"', "line\nbreak", "back\\slash", "semi;colon", "$HOME", "-o", "#x", "ä€", "100%", "<b>", "`id`", "{x}")
        for name in names:
            shutil.copy(self.folder / "cube.obj", self.folder / f"{name}.obj")
            start = "./" if name.startswith("-") else ""
            escaped = re.sub(r'([\\"`$])', r"\\\1", name)
            for word in [f'"{start}{escaped}'] + [f"'{start}{name}"] * ("'" not in name):
                text += f"\n~~~{{.meshfolio caption='x'}}\nrender {word}.obj{word[0]} -o {word}.png{word[0]}\n~~~\n"
        tree = self.tree(text)
        found = [urllib.parse.unquote(target[0]) for _, _, target in nodes(tree, "Image")]
        self.assertEqual({os.path.basename(path) for path in found}, {f"{name}.png" for name in names})
        self.assertTrue(all((self.folder / path).exists() for path in found))
        made = self.make(text, "-o", "a.docx")
        self.assertEqual((made.code, made.message), (0, ""))

    def test_a_strange_name_of_the_document(self):
        for name in ("my 'own' doc.md", "-x.md", "a;b$(c)#.md"):
            self.write(block("render cube.obj", "#fig-a"), name)
            made = Made(self.folder, "./" + name, "-o", "out.docx")
            self.assertEqual((made.code, made.message), (0, ""), name)


if __name__ == "__main__":
    unittest.main()
