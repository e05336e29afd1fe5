// node make_reports.mjs MESHFOLIO FOLDER: the two reports that the tests of the page look at.
import { spawnSync } from "node:child_process";
import { mkdirSync, writeFileSync } from "node:fs";
import path from "node:path";

const [program, folder] = process.argv.slice(2);
const hostile = `<script>alert(1)</script>"'</style>{{title}} ]]> <img src=x onerror=alert(2)> -->`;

function run(...words) {
    const { status, stderr } = spawnSync(program, words, { encoding: "utf8" });
    if (status !== 0) throw new Error(`${program} ${words.join(" ")}: exit code ${status}\n${stderr}`);
}

mkdirSync(folder, { recursive: true });
const report = ["report", "--quick", "--size", "160", "--pdf", "off"];
run(...report, "--views-files", "--out", path.join(folder, "quick"));

const mesh = path.join(folder, `<img src=x onerror=alert(3)>&"'.obj`), settings = path.join(folder, "hostile.toml");
run("sample", "torus", "-o", mesh);
writeFileSync(settings, `[report]\ntitle = '''${hostile}'''\nauthor = '''${hostile}'''\n`);
run(...report, mesh, "--only", "q1,q5,methods", "--config", settings, "--out", path.join(folder, "hostile"));
