// Random choices that a seed fixes, and counts of what was met.
export class Random {
  constructor(seed) {
    this.state = (seed * 2654435761 + 12345) >>> 0;
    for (let i = 0; i < 4; ++i) this.unit();
  }
  unit() {
    this.state = (this.state + 0x6d2b79f5) >>> 0;
    let t = this.state;
    t = Math.imul(t ^ (t >>> 15), t | 1);
    t ^= t + Math.imul(t ^ (t >>> 7), t | 61);
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
  }
  below(count) {
    return Math.floor(this.unit() * count);
  }
  chance(share) {
    return this.unit() < share;
  }
  of(choices) {
    return choices[this.below(choices.length)];
  }
  /// Of a few digits.
  number(low, high) {
    return Number((low + (high - low) * this.unit()).toPrecision(4));
  }
}

export class Tally {
  constructor() {
    this.counts = new Map();
  }
  add(name, count = 1) {
    this.counts.set(name, (this.counts.get(name) ?? 0) + count);
  }
  get(name) {
    return this.counts.get(name) ?? 0;
  }
  toString() {
    return [...this.counts].map(([name, count]) => `  ${count} ${name}`).join("\n");
  }
}
