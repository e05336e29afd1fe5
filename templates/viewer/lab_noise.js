// The noise of `meshfolio noise`, number by number (src/mesh/vertex_noise.cpp): the method of Box and Muller over mt19937_64.

const size = 312, middle = 156;
const mask = (1n << 64n) - 1n, upper = mask << 31n & mask, lower = (1n << 31n) - 1n;

/// 64-bit Mersenne twister (Matsumoto & Nishimura 2000).
class Bits {
    constructor(seed) {
        this.state = [BigInt(seed) & mask];
        for (let i = 1n; i < BigInt(size); ++i) {
            const last = this.state.at(-1);
            this.state.push((6364136223846793005n * (last ^ last >> 62n) + i) & mask);
        }
        this.at = size;
    }
    next() {
        if (this.at === size) this.twist();
        let x = this.state[this.at++];
        x ^= x >> 29n & 0x5555555555555555n;
        x ^= x << 17n & 0x71d67fffeda60000n;
        x ^= x << 37n & 0xfff7eee000000000n;
        return x ^ x >> 43n;
    }
    twist() {
        const { state } = this;
        for (let i = 0; i < size; ++i) {
            const x = state[i] & upper | state[(i + 1) % size] & lower;
            state[i] = state[(i + middle) % size] ^ x >> 1n ^ (x & 1n ? 0xb5026f5aa96619e9n : 0n);
        }
        this.at = 0;
    }
}

/// `count` standard normal numbers.
export function normalNumbers(seed, count) {
    const bits = new Bits(seed), uniform = () => Number(bits.next() >> 11n) * 2 ** -53;
    const numbers = new Float64Array(count + 1);
    for (let i = 0; i < count; i += 2) {
        const radius = Math.sqrt(-2 * Math.log(1 - uniform())), angle = 2 * Math.PI * uniform();
        numbers[i] = radius * Math.cos(angle);
        numbers[i + 1] = radius * Math.sin(angle);
    }
    return numbers.subarray(0, count);
}
