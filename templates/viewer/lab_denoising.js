// Question 7 in the page: implicit steps (M − λC) X' = M X with the masses and cotangents of the noisy mesh itself, and what the result is
// judged by. No page in here.

const noArea = 1e-12;   // twice the area over the squared longest edge, as in src/mesh/triangle_kind.h: below, a triangle has no operator
const dot = (u, v) => u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
const cross = (u, v) => [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
const between = (x, a, b) => [x[3 * b] - x[3 * a], x[3 * b + 1] - x[3 * a + 1], x[3 * b + 2] - x[3 * a + 2]];

/// Calls visit(corner, ends of the edge opposite, its cotangent, a third of the area) for the corners of all triangles with an area.
function forEachCorner(corners, x, visit) {
    for (let i = 0; i < corners.length; i += 3) {
        const triangle = corners.subarray(i, i + 3), sides = [0, 1, 2].map((k) => between(x, triangle[(k + 1) % 3], triangle[(k + 2) % 3]));
        const twice = Math.hypot(...cross(sides[0], sides[1]));
        if (!(twice > noArea * Math.max(...sides.map((side) => dot(side, side))))) continue;
        for (let k = 0; k < 3; ++k) visit(triangle[k], triangle[(k + 1) % 3], triangle[(k + 2) % 3], -dot(sides[(k + 1) % 3], sides[(k + 2) % 3]) / twice, twice / 6);
    }
}

/// Pointwise mean curvature by the cotangent operator, positive where it bulges [1/length]; 0 at the border, where it is not defined.
export function meanCurvature({ corners, vertices: n, isBorder }, x) {
    const flow = new Float64Array(3 * n), normals = new Float64Array(3 * n), mass = new Float64Array(n);
    forEachCorner(corners, x, (v, a, b, cotangent, area) => {
        mass[v] += area;
        const normal = cross(between(x, v, a), between(x, v, b));
        for (let k = 0; k < 3; ++k) {
            const pull = cotangent / 2 * (x[3 * b + k] - x[3 * a + k]);
            flow[3 * a + k] += pull, flow[3 * b + k] -= pull, normals[3 * v + k] += normal[k];
        }
    });
    return Float64Array.from(mass, (m, v) => {
        const at = [3 * v, 3 * v + 1, 3 * v + 2], size = Math.hypot(...at.map((i) => flow[i])) / (2 * m);
        return isBorder[v] || !(m > 0) ? 0 : at.reduce((sum, i) => sum + flow[i] * normals[i], 0) > 0 ? -size : size;
    });
}

/// Each vertex its place in an order in which neighbours are near: that of Cuthill and McKee.
function placesOf(around) {
    const place = new Int32Array(around.length).fill(-1);
    let count = 0;
    const walk = (start, visit) => {   // by distance, those of few neighbours first
        const seen = new Set([start]);
        for (const v of seen) {   // which grows
            visit(v);
            [...around[v]].sort((a, b) => around[a].size - around[b].size || a - b).forEach((w) => seen.add(w));
        }
    };
    for (let v = 0; v < around.length; ++v) {
        if (place[v] >= 0) continue;
        let end = v;
        walk(v, (w) => { end = w; });
        walk(end, (w) => { place[w] = count++; });
    }
    return place;
}

/// M − λC of a surface, factored within its envelope: in each row the entries from the first one to the diagonal.
export class ImplicitSteps {
    constructor({ corners, vertices: n }) {
        const around = Array.from({ length: n }, () => new Set());
        for (let i = 0; i < corners.length; ++i) {
            const a = corners[i], b = corners[i % 3 === 2 ? i - 2 : i + 1];
            around[a].add(b), around[b].add(a);
        }
        Object.assign(this, { corners, n, place: placesOf(around), first: Int32Array.from({ length: n }, (_, i) => i), row: new Int32Array(n) });
        around.forEach((others, v) => others.forEach((w) => { this.first[this.place[v]] = Math.min(this.first[this.place[v]], this.place[w]); }));
        let size = 0;
        for (let i = 0; i < n; ++i) this.row[i] = size - this.first[i], size += i - this.first[i] + 1;   // entry (i, j) is at row[i] + j
        this.factor = new Float64Array(size);
    }

    /// @param lambda  [length²]
    factorise(x, lambda) {
        const { n, place, row, first, factor } = this, mass = this.mass = new Float64Array(n);
        factor.fill(0);
        const add = (v, w, value) => { const i = place[v], j = place[w]; if (j <= i) factor[row[i] + j] += value; };
        forEachCorner(this.corners, x, (v, a, b, cotangent, area) => {
            const weight = lambda * cotangent / 2;
            mass[v] += area;
            add(a, a, weight), add(b, b, weight), add(a, b, -weight), add(b, a, -weight);
        });
        mass.forEach((m, v) => add(v, v, m > 0 ? m : 1));   // without mass it stays
        for (let i = 0; i < n; ++i) {
            for (let j = first[i], at = row[i]; j <= i; ++j) {
                const other = row[j];
                let sum = factor[at + j];
                for (let k = Math.max(first[i], first[j]); k < j; ++k) sum -= factor[at + k] * factor[other + k];
                factor[at + j] = j < i ? sum / factor[other + j] : Math.sqrt(sum);
            }
        }
    }

    /// One step from x.
    step(x) {
        const { n, place, row, first, factor, mass } = this, next = new Float64Array(3 * n), y = new Float64Array(n);
        for (let axis = 0; axis < 3; ++axis) {
            for (let v = 0; v < n; ++v) y[place[v]] = (mass[v] > 0 ? mass[v] : 1) * x[3 * v + axis];
            for (let i = 0; i < n; ++i) {
                for (let k = first[i]; k < i; ++k) y[i] -= factor[row[i] + k] * y[k];
                y[i] /= factor[row[i] + i];
            }
            for (let i = n - 1; i >= 0; --i) {
                y[i] /= factor[row[i] + i];
                for (let k = first[i]; k < i; ++k) y[k] -= factor[row[i] + k] * y[i];
            }
            for (let v = 0; v < n; ++v) next[3 * v + axis] = y[place[v]];
        }
        return next;
    }
}

/// A run from noisy positions, each step made once and kept, so that going back and forth costs nothing.
export class DenoisingRun {
    constructor(data) {
        this.steps = new ImplicitSteps(data);
        this.unit = data.meanEdge ** 2;
    }
    /// @param edges  λ in squared mean edges of the clean mesh
    from(x, edges) {
        if (this.states?.[0] === x && this.edges === edges) return;
        Object.assign(this, { states: [x], edges });
        if (edges > 0) this.steps.factorise(x, edges * this.unit);
    }
    at(t) {
        if (this.edges === 0) return this.states[0];
        while (this.states.length <= t) this.states.push(this.steps.step(this.states.at(-1)));
        return this.states[t];
    }
}

/// Squared distance from p to the segment from 0 to u.
function toSegment(p, u) {
    const squared = dot(u, u), t = squared > 0 ? Math.min(1, Math.max(0, dot(p, u) / squared)) : 0;
    return toPoint(p, u[0] * t, u[1] * t, u[2] * t);
}
const toPoint = (p, x, y, z) => (p[0] - x) ** 2 + (p[1] - y) ** 2 + (p[2] - z) ** 2;

/// Returns the squared distance from p to the triangle with a corner at 0, sides u, v and unit normal n. @param bound  upper bound of it
function toTriangle(p, { u, v, n, opposite }, bound) {
    if (n) {
        const height = dot(n, p);
        if (height * height >= bound) return bound;
        if (dot(cross(u, p), n) >= 0 && dot(cross(p, v), n) >= 0 && dot(cross(opposite, [p[0] - u[0], p[1] - u[1], p[2] - u[2]]), n) >= 0) return height * height;
    }
    return Math.min(toSegment(p, u), toSegment(p, v), toSegment([p[0] - u[0], p[1] - u[1], p[2] - u[2]], opposite));
}

/// Measures the errors of positions against the clean mesh, as src/geometry/measures/mesh_error.cpp does.
export class CleanSurface {
    constructor({ corners, positions, vertices }) {
        Object.assign(this, { corners, positions, around: Array.from({ length: vertices }, () => []), normals: [] });
        for (let i = 0; i < corners.length; i += 3) {
            const [a, b, c] = corners.subarray(i, i + 3), u = between(positions, a, b), v = between(positions, a, c), opposite = between(positions, b, c);
            const normal = cross(u, v), twice = Math.hypot(...normal), isFlat = !(twice > noArea * Math.max(dot(u, u), dot(v, v), dot(opposite, opposite)));
            this.normals.push(normal);
            const triangle = { at: 3 * a, u, v, opposite, n: isFlat ? null : normal.map((x) => x / twice) };
            for (const corner of [a, b, c]) this.around[corner].push(triangle);
        }
    }

    /// Returns the distance of each vertex from the triangles around its clean place [length].
    distances(x) {
        return Float64Array.from(this.around, (triangles, v) => {
            const at = 3 * v;
            let nearest = (x[at] - this.positions[at]) ** 2 + (x[at + 1] - this.positions[at + 1]) ** 2 + (x[at + 2] - this.positions[at + 2]) ** 2;
            for (const triangle of triangles) {
                const p = [0, 1, 2].map((k) => x[at + k] - this.positions[triangle.at + k]);
                nearest = Math.min(nearest, toTriangle(p, triangle, nearest));
            }
            return Math.sqrt(nearest);
        });
    }

    /// Root mean square of them [length].
    distance(x) {
        return Math.sqrt(this.distances(x).reduce((sum, d) => sum + d * d, 0) / this.around.length);
    }

    /// Mean angle of the normals of the triangles that have one [rad].
    angle(x) {
        let sum = 0, count = 0;
        this.normals.forEach((n, t) => {
            const [a, b, c] = this.corners.subarray(3 * t, 3 * t + 3), m = cross(between(x, a, b), between(x, a, c));
            if (dot(n, n) === 0 || dot(m, m) === 0) return;
            sum += Math.atan2(Math.hypot(...cross(n, m)), dot(n, m)), ++count;
        });
        return count > 0 ? sum / count : 0;
    }
}
