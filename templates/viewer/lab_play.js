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

/// Returns stops from all modes down to k, with larger steps among many modes.
export const openingOf = (modes, k) => Array.from({ length: openingStops + 1 }, (_, i) => Math.round(modes * (k / modes) ** (i / openingStops)));

/// Returns the stops behind `value`; all of them if there are none. @param stops  ascending
export function stopsAfter(stops, value) {
    const next = stops.findIndex((stop) => stop > value * (1 + 1e-9));
    return next < 0 ? stops : stops.slice(next);
}
