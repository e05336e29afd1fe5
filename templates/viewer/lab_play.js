// Runs a slider of the laboratory through its stops by itself. No page in here.
const stopsPerSecond = 15, openingStops = 45;

export class Play {
    /// @param set  set(name, value), for each stop; ended()
    constructor(set, ended) {
        Object.assign(this, { set, ended, name: null });
    }

    start(name, stops) {
        this.stop();
        const rest = stops[Symbol.iterator]();
        this.name = name;
        this.timer = setInterval(() => {
            const { value, done } = rest.next();
            if (done) this.ended();
            else this.set(name, value);
        }, 1000 / stopsPerSecond);
    }
    stop() {
        clearInterval(this.timer);
        this.name = null;
    }
}

/// From all modes down to k, the many fast and the few slowly.
export const openingOf = (modes, k) => Array.from({ length: openingStops + 1 }, (_, i) => Math.round(modes * (k / modes) ** (i / openingStops)));

/// What of a slider's stops is still to come; all of them at its end. @param stops  ascending
export function stopsAfter(stops, value) {
    const next = stops.findIndex((stop) => stop > value * (1 + 1e-9));
    return next < 0 ? stops : stops.slice(next);
}
