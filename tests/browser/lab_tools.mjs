// Shared by the tests of the laboratory: the program, the modules of the page, and the data in a page.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import os from "node:os";
import path from "node:path";
import { after } from "node:test";
import { pathToFileURL } from "node:url";
import { inflateSync } from "node:zlib";
import { reports } from "./browser.mjs";

export const reportPage = readFileSync(path.join(reports.quick, "index.html"), "utf8");
export const options = { skip: reportPage.includes("viewer-program") ? false : "meshfolio was built without the viewer" };

const viewer = (name) => import(pathToFileURL(path.join(process.env.SOURCE, "templates/viewer", name)).href);
export const lab = await viewer("lab_math.js"), states = await viewer("lab_state.js"), { Experiment } = await viewer("lab_experiment.js"), { normalNumbers } = await viewer("lab_noise.js"), words = await viewer("lab_words.js");
export const { meanCurvature } = await viewer("lab_denoising.js"), play = await viewer("lab_play.js");

/// The working folder of the program.
export const folder = mkdtempSync(path.join(os.tmpdir(), "meshfolio-lab-"));
after(() => rmSync(folder, { recursive: true, force: true }));

export function run(...words) {
    const { status, stderr } = spawnSync(process.env.MESHFOLIO, words.map(String), { encoding: "utf8", cwd: folder });
    assert.ok(status === 0, `${words.join(" ")}: ${stderr}`);
    return stderr;
}
export const written = (file) => readFileSync(path.join(folder, file), "utf8");

/// Returns the data of a question in the text of a page.
export function dataOf(page, question) {
    const [, text] = page.match(new RegExp(`data-questions="(?:[^"]* )?${question}(?: [^"]*)?">([^<]*)<`));
    const bytes = inflateSync(Buffer.from(text, "base64"));
    return lab.decoded(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength));
}
