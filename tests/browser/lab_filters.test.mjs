// The mathematics of the laboratory against the program's own commands.
import assert from "node:assert/strict";
import { writeFileSync } from "node:fs";
import path from "node:path";
import { before, describe, test } from "node:test";
import { dataOf, Experiment, meanCurvature, play, folder, lab, normalNumbers, options, reportPage, run, states, words, written } from "./lab_tools.mjs";

const positionsOf = (file) => Float64Array.from(written(file).match(/^v .*$/gm).flatMap((row) => row.split(/\s+/).slice(1, 4).map(Number)));
const start = (change) => ({ scheme: "projection", k: 15, lambda: 0.5, t: 10, sigma: 0, seed: 1, lines: false, ...change });
const result = (data, state) => lab.applied(data, lab.filter(data, state), data.coefficients, data.positions, new Float64Array(3 * data.vertices));
function measured(data, state) {
    const experiment = new Experiment(data);
    experiment.set({ ...states.startOf({ starts: {} }, ""), ...state });
    experiment.compute();
    return experiment.numbers();
}

describe("sums over modes in 16 bits are what the program computes", options, () => {
    let data, first;
    before(() => {
        run("sample", "cube", "-o", "cube.obj");
        run("lab", "cube.obj", "-o", "cube.html");
        data = dataOf(written("cube.html"), "lab");
        first = positionsOf("cube.obj");
    });

    /// √(mean |x − y|²) in box diagonals; the page's positions are about the box centre.
    function distance(x, y) {
        let sum = 0;
        for (let i = 0; i < x.length; ++i) sum += (x[i] - (y[i] - first[i] + data.positions[i])) ** 2;
        return Math.sqrt(sum / data.vertices) / data.diagonal;
    }
    /// Returns the result of `meshfolio smooth`; λ in units of λ_crit.
    function smoothed(scheme, lambda, t) {
        run("smooth", "cube.obj", "-o", "smooth.obj", "--scheme", scheme, "--lambda", lambda, "--unit", "tau", "--iterations", t);
        return positionsOf("smooth.obj");
    }
    const close = (x, y, what) => assert.ok(distance(x, y) <= 1e-4, `${what}: ${distance(x, y)}`);

    test("ten projections", () => {
        const counts = [1, 2, 5, 10, 15, 30, 60, 150, 400, 602];
        run("spectrum", "cube.obj", "-k", 602, "--reconstruct", counts.join(","), "--out", "modes", "--csv", "modes.csv");
        for (const k of counts) {
            run("noise", `modes/cube_k${k}.ply`, "-o", "k.obj", "--sigma", 0);   // as text
            close(result(data, start({ scheme: "projection", k })), positionsOf("k.obj"), `k = ${k}`);
        }
    });

    const settings = {
        explicit: [[0.1, 1], [0.1, 30], [0.25, 5], [0.5, 1], [0.5, 40], [0.9, 10], [0.99, 40], [1.01, 40], [1.05, 30], [2, 3]],
        implicit: [[0.1, 1], [0.5, 10], [1, 1], [1, 40], [3, 5], [5, 10], [20, 3], [100, 1], [100, 5], [1000, 1]],
        taubin: [[0.05, 1], [0.1, 5], [0.2, 20], [0.3, 1], [0.4, 10], [0.5, 20], [0.6, 40], [0.7, 3], [0.8, 5], [0.9, 2]],
    };
    for (const [scheme, pairs] of Object.entries(settings)) {
        test(`ten settings of ${scheme} steps`, () => {
            for (const [lambda, t] of pairs) close(result(data, start({ scheme, lambda, t })), smoothed(scheme, lambda, t), `λ = ${lambda} λ_crit, t = ${t}`);
        });
    }

    // (1 − h)ⁿ and (1 + h)⁻ⁿ lie on both sides of exp(−nh), equally far to first order.
    test("ten heat flows lie between many small explicit and implicit steps", () => {
        for (const [lambda, t] of [[0.1, 1], [0.5, 1], [1, 1], [1, 5], [2, 10], [5, 1], [10, 2], [20, 1], [50, 1], [100, 1]]) {
            const steps = Math.ceil(40 * lambda * t) + 400;
            const [below, above] = ["explicit", "implicit"].map((scheme) => smoothed(scheme, lambda * t / steps, steps));
            close(result(data, start({ scheme: "heat", lambda, t })), below.map((x, i) => (x + above[i]) / 2), `λ = ${lambda} λ_crit, t = ${t}`);
        }
    });

    test("the noise is that of `meshfolio noise`, number by number", () => {
        for (const seed of [0, 1, 7, 4000000000]) {
            run("noise", "cube.obj", "-o", "noisy.obj", "--sigma", 0.01, "--seed", seed);
            const noise = normalNumbers(seed, first.length), noisy = positionsOf("noisy.obj");
            noisy.forEach((x, i) => assert.ok(Math.abs(x - first[i] - 0.01 * noise[i]) < 1e-14, `seed ${seed}, number ${i}`));
        }
    });

    test("ten denoisings with the operator of the noisy mesh", () => {
        for (const [sigma, edges, t] of [[0.1, 0.001, 12], [0.3, 0.01, 5], [0.3, 0.1, 1], [1, 0.01, 19], [1, 0.1, 3], [1, 1, 2], [1, 10, 1], [3, 0.1, 9], [3, 1, 4], [3, 10, 48]]) {
            run("noise", "cube.obj", "-o", "noisy.obj", "--sigma", sigma / 100 * data.diagonal, "--seed", 3);
            run("smooth", "noisy.obj", "-o", "smooth.obj", "--scheme", "implicit", "--lambda", edges * data.meanEdge ** 2, "--iterations", t);
            const experiment = new Experiment(data);
            experiment.set(start({ scheme: "denoising", edges, t, sigma, seed: 3 }));
            experiment.compute();
            assert.ok(distance(experiment.x, positionsOf("smooth.obj")) < 1e-9, `σ = ${sigma} %, λ = ${edges} h̄², t = ${t}`);
        }
    });

    test("coefficients and the curve of the error belong to the positions", () => {
        for (const change of [{ scheme: "explicit", lambda: 0.3, t: 4 }, { scheme: "denoising", edges: 0.05, t: 4 }]) {
            const state = start({ ...change, sigma: 1, seed: 3 }), experiment = new Experiment(data);
            experiment.set(state);
            experiment.compute();
            const { x, after } = experiment, again = lab.sumOfModes(data, new Float64Array(data.modes).fill(1), after, new Float64Array(x.length));
            assert.ok(again.every((value, i) => Math.abs(value - x[i]) < 1e-4 * data.diagonal));
            const best = experiment.extendCurve(Infinity), { curve } = experiment;
            assert.ok(Math.abs(curve[4] / (100 * experiment.errors(x).surface / data.diagonal) - 1) < 1e-12);
            assert.ok(best > 0 && best < curve.length - 1 && curve.every((error) => error >= curve[best]));
        }
    });

    test("beyond 2,000 vertices the page has the lowest modes and says so", () => {
        run("sample", "sphere", "-o", "sphere.obj");
        assert.match(run("lab", "sphere.obj", "-o", "sphere.html"), /lowest 300 modes of 2562, a truncation/);
        const few = dataOf(written("sphere.html"), "lab");
        assert.equal(few.modes, 300);
        assert.ok(few.readings.length >= 5 && few.presets.every(({ state }) => state.scheme === "projection"));
        for (const { state: { k }, rms } of few.readings) {
            const x = result(few, start({ scheme: "projection", k }));
            const rounding = few.quantisationShift * few.diagonal;   // five modes are all of a sphere but for this
            assert.ok(Math.abs(lab.rms(few, x, true) - rms) < 1e-4 * rms + rounding, `k = ${k}`);
        }
    });
});

test("a vertex without area has no mode, and the others are all there", options, () => {
    const points = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [2, 2, 2], [3, 3, 3], [4, 4, 4]];
    const triangles = [[1, 3, 2], [1, 2, 4], [2, 3, 4], [3, 1, 4], [5, 6, 7]];
    writeFileSync(path.join(folder, "line.obj"), [...points.map((p) => `v ${p.join(" ")}`), ...triangles.map((f) => `f ${f.join(" ")}`)].join("\n") + "\n");
    assert.doesNotMatch(run("lab", "line.obj", "-o", "line.html"), /truncation/);
    const data = dataOf(written("line.html"), "lab");
    assert.deepEqual([data.vertices, data.modes, data.hasAllModes], [7, 4, true]);
    assert.ok(data.presets.some(({ state }) => state.scheme === "explicit"));
    const heat = data.readings.find(({ state }) => state.scheme === "heat");
    assert.ok(Math.abs(measured(data, heat.state).rms / heat.rms - 1) < 1e-4, "what has no mode stays where it is");
});

test("every number that the report has is the page's to 1e-4", options, () => {
    let compared = 0;
    for (const question of ["q4", "q5", "q6", "q7"]) {
        const data = dataOf(reportPage, question);
        for (const { state, energy, volume, rms, factor, gains } of data.readings) {
            const here = measured(data, state), pairs = { energy: [here.energy, energy], rms: [here.rms, rms] };
            if (data.isClosed && Math.abs(volume) > data.rounding * Math.abs(lab.volume(data, data.positions))) pairs.volume = [here.volume, volume];
            if (factor !== null) pairs.factor = [here.factor, factor];
            gains?.forEach((gain, i) => { pairs[`gain ${i}`] = [here.gains[i], gain]; });
            for (const [name, [x, y]] of Object.entries(pairs)) {
                assert.ok(Math.abs(x - y) <= 1e-4 * Math.abs(y) + (name === "rms" ? data.rounding * data.diagonal : 0), `${question} ${JSON.stringify(state)}: ${name} ${x} ${y}`);
                ++compared;
            }
        }
    }
    assert.ok(compared > 150, `${compared}`);
});

test("what changes little is as exact as what changes much, and what changes nothing exact", options, () => {
    const data = dataOf(reportPage, "q6");
    for (const lambda of [1e-4, 1e-3, 1e-2]) {
        const step = result(data, start({ scheme: "explicit", lambda, t: 1 })), half = result(data, start({ scheme: "explicit", lambda: lambda / 2, t: 1 }));
        const moved = (x) => x.map((value, i) => value - data.positions[i]), [one, two] = [moved(step), moved(half)];   // of one step: as λ
        const size = Math.max(...one.map(Math.abs));
        assert.ok(size > 0 && one.every((value, i) => Math.abs(value - 2 * two[i]) < 1e-8 * size));
    }
    assert.equal(measured(data, { scheme: "implicit", lambda: 0, t: 5 }).rms, 0);
    assert.equal(measured(data, { scheme: "projection", k: data.modes }).rms, 0);
});

test("it says what is seen: one mode, nothing moved, and whose operator it is", options, () => {
    const data = dataOf(reportPage, "q7"), said = (change) => {
        const experiment = new Experiment(data), state = start({ edges: 0.1, ...change });
        experiment.set(state);
        experiment.compute();
        return words.told({ state, data, experiment, numbers: experiment.numbers(), clamped: 0, best: null });
    };
    assert.match(said({ k: 1 }), /^The smoothest of \d+ modes: rms .* It is constant: nothing is left but a point\.$/);
    assert.match(said({ scheme: "implicit", lambda: 0 }), /: nothing has moved\.$/);
    assert.match(said({ scheme: "explicit", lambda: 1.001 }), /multiplies the shortest wave by 1\.002\.$/);
    assert.match(said({ scheme: "implicit", sigma: 1 }), /know the clean mesh's operator/);
    assert.doesNotMatch(said({ scheme: "implicit", sigma: 0 }), /operator/);
    assert.match(said({ scheme: "denoising", edges: 0.01, t: 19, sigma: 1 }), /Of rms², \d+ % lies along the surface/);
    assert.doesNotMatch(said({ scheme: "denoising", edges: 0.01, t: 19, sigma: 0.1 }), /Of rms²/, "where smoothing does harm, it is not the noise that is left");
    assert.match(said({ scheme: "denoising", edges: 0.01, t: 19, sigma: 1, lines: true }), /along the surface is [\d.]+ times that of the noisy mesh, across it 0\.\d+ times\.$/);
});

test("the colours are those of the numbers: their mean square is that of the table", options, () => {
    const data = dataOf(reportPage, "q7");
    for (const change of [{ scheme: "explicit", lambda: 0.5, t: 5 }, { scheme: "denoising", edges: 0.1, t: 2, sigma: 0.5 }]) {
        const experiment = new Experiment(data), { colours } = experiment;
        experiment.set(start(change));
        experiment.compute();
        const { x } = experiment, values = colours.valuesOf(x, "distance"), rms = Math.sqrt(values.reduce((sum, far) => sum + far * far, 0) / values.length);
        const { surface, places } = experiment.errors(x), { places: shown, map } = colours.of(x, "distance"), range = colours.rangeOf("distance");
        assert.ok(Math.abs(rms / (100 * (change.sigma ? surface / change.sigma : places) / data.diagonal) - 1) < 1e-12);
        const place = (far) => (range.logarithmic ? Math.log(far / range.low) / Math.log(range.high / range.low) : far / range.high);
        assert.ok(values.every((far, v) => Math.abs(Math.min(1, Math.max(0, place(far))) - shown[v]) < 1e-6));
        assert.equal(map, "pale");
        assert.equal(colours.of(experiment.start, "distance") === null, !change.sigma, "the original is clay, the noisy mesh is not");
        const before = colours.rangeOf("distance");
        experiment.set(start({ ...change, t: 9 }));
        assert.deepEqual(colours.rangeOf("distance"), before, "colours of one mesh can be compared");
    }
    for (const x of [1e-3, 0.0149, 1, 1.01, 7.3, 96]) {
        const end = lab.roundedUp(x);
        assert.ok(end >= x && end <= 1.51 * x && String(end).length <= 6, `${x}: ${end}`);
    }
});

test("mean curvature is the program's, of one sign, and turns with the surface", options, () => {
    const data = dataOf(reportPage, "q5"), curvature = (x) => meanCurvature(data, x);
    run("sample", "cube", "-o", "cube.obj");
    run("curvature", "cube.obj", "--csv", "curvature.csv");
    const [head, ...rows] = written("curvature.csv").trim().split("\n").map((row) => row.split(",")), column = head.indexOf("h_cotan");
    assert.ok(column >= 0, head.join());
    const here = curvature(data.positions);
    rows.forEach((row, v) => assert.ok(Math.abs(here[v] - Number(row[column])) < 1e-9 * Math.max(1, Math.abs(here[v])), `vertex ${v}: ${here[v]}, ${row[column]}`));
    const inside = { ...data, corners: data.corners.slice().reverse() };
    meanCurvature(inside, data.positions).forEach((h, v) => assert.ok(Math.abs(h + here[v]) < 1e-9));
});

test("as many digits are claimed as page and program share", () => {
    const row = (here, program, rounding = 0) => ["", "", here, program, rounding];
    for (let digits = 0; digits <= 6; ++digits) assert.equal(words.sharedDigits([row(1, 1), row(5 * (1 + 0.4 * 10 ** -digits), 5)]), digits);
    assert.equal(words.sharedDigits([row(1, NaN)]), null);
    assert.equal(words.sharedDigits([row(1e-14, -1e-14, 1e-12), row(2, 2)]), 6, "rounding is no difference");
    assert.match(words.agreement([row(1, 1.1)]), /^✗/);
});

test("a play goes on from where a slider is, and the opening runs down to where it begins", () => {
    const stops = states.stopsOf(1, 300);
    assert.deepEqual(play.stopsAfter(stops, 40), stops.filter((stop) => stop > 40));
    assert.deepEqual(play.stopsAfter(stops, 300), stops);
    for (const [modes, k] of [[300, 15], [8, 5], [4, 4]]) {
        const opening = play.openingOf(modes, k);
        assert.deepEqual([opening[0], opening.at(-1)], [modes, k]);
        assert.ok(opening.every((count, i) => i === 0 || count <= opening[i - 1]));
    }
});

test("of the limits passed the last is said, and none where the filter is another", options, () => {
    const data = dataOf(reportPage, "q5"), side = (change) => {
        const experiment = new Experiment(data), state = start(change);
        experiment.set(state);
        experiment.compute();
        return words.limits({ state, data, experiment, numbers: experiment.numbers(), clamped: 0, best: null });
    };
    const explicit = (lambda) => side({ scheme: "explicit", lambda, t: 1 });
    assert.match(words.passed(explicit(0.3), explicit(1.001)), /grow/);
    assert.equal(words.passed(explicit(0.3), explicit(0.3)), "");
    assert.equal(words.passed(explicit(0.3), side({ scheme: "implicit", lambda: 2, t: 1 })), "");
    assert.equal(words.passed({}, explicit(2)), "");
    assert.match(words.passed(side({ scheme: "implicit", lambda: 0.5 }), side({ scheme: "implicit", lambda: 2 })), /explicit steps would blow up/);
    const carried = data.mu.filter((mu) => 2 * Math.PI / Math.sqrt(mu) >= 2 * data.meanEdge).length;   // the constant mode is infinitely long
    assert.match(words.passed(side({ k: carried }), side({ k: carried + 1 })), new RegExp(`^Past k = ${carried}: .*two mean edges`));
    assert.match(words.passed(side({ k: carried + 1 }), side({ k: carried })), /longer than two mean edges/);
});

test("a slider stops at every small number, at both ends, and nowhere far beyond 2 %", () => {
    for (const [low, high] of [[0, 200], [1, 361], [1, 2000], [1, 4], [1, 1]]) {
        const stops = states.stopsOf(low, high);
        assert.deepEqual([stops[0], stops.at(-1)], [low, high]);
        assert.ok(stops.every((stop, i) => i === 0 || (stop > stops[i - 1] && stop - stops[i - 1] <= Math.max(1, 0.03 * stop))), `${stops}`);
        for (let k = low; k <= Math.min(50, high); ++k) assert.ok(stops.includes(k));
    }
});

test("a link restores the state, whatever it holds", () => {
    const start = { starts: { q5: { scheme: "explicit", lambda: 0.25, t: 5, sigma: 1 } } };
    for (const state of [{ scheme: "projection", k: 7 }, { scheme: "explicit", lambda: 1.05, t: 40 }, { scheme: "heat", lambda: 100, t: 1, sigma: 0.5, seed: 3, lines: true }, { scheme: "denoising", edges: 0.01, t: 19, sigma: 1, colours: "none", wire: true }]) {
        const whole = { ...states.startOf({ starts: {} }, "q5"), ...state }, { question, change } = states.readLink(states.linkOf("q5", whole));
        assert.equal(question, "q5");
        const read = states.held({ ...states.startOf(start, "q5"), ...change }, 602);
        assert.ok(states.sameState(whole, read), JSON.stringify([whole, read]));
        assert.deepEqual([read.wire, read.colours], [whole.wire, whole.colours]);
    }
    assert.deepEqual(states.readLink("#lab=q5,lambda=1.01,t=40"), { question: "q5", change: { lambda: 1.01, t: 40 } });
    assert.equal(states.readLink("#q5"), null);
    assert.deepEqual(states.readLink("#lab%3Dq5%2Clambda%3D1.01%2ct%3D40"), states.readLink("#lab=q5,lambda=1.01,t=40"));
    assert.deepEqual(states.readLink("#lab=q5,scheme=magic,lambda=,t=%E0,k").change, {}, "what cannot be read changes nothing");
    assert.equal(states.held({ ...start, lambda: NaN }, 602, { ...start, lambda: 0.25 }).lambda, 0.25);
    const odd = states.held(states.readLink("#lab=q5,scheme=toString,lambda=-1e999,t=NaN,k=1e9,sigma=<b>,seed=").change, 602);
    assert.deepEqual([odd.scheme, odd.lambda, odd.t, odd.k, odd.sigma], ["projection", 0.5, 10, 602, 0]);
    for (const lambda of [0, 0.3, 1, 3, 10, 999]) assert.ok(Math.abs(states.lambdaAt(states.placeOf(lambda)) - lambda) < 1e-9 * (1 + lambda));
    for (const edges of [0, 0.001, 0.3, 1, 99]) assert.ok(Math.abs(states.edgesAt(states.placeOfEdges(edges)) - edges) < 1e-9 * (1 + edges));
});
