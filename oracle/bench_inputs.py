#!/usr/bin/env python3
"""Writes the inputs of the benchmark: python3 bench_inputs.py FOLDER [N]

All numbers come from SplitMix64 (the generator of src/generators/draw.rs): word i of seed s is the i-th output, a unit is (word >> 11) / 2^53.
- uniform.f64:    N points, x and y units (seed 1).
- clustered.f64:  N points around 1,000 centers uniform in the unit square (seed 2): center word % 1000, then each coordinate the center's
                  plus (u1 + u2 + u3 - 1.5) / 64.
- matched.f64, matched.u32: the largest even k with k^2 <= N; one point in each cell of a k x k grid, uniform in the middle half of the cell
                  (seed 3); a segment joins the points of each two horizontal neighbours (2i, 2i + 1): k^2 / 2 disjoint segments.
                  Points and segments are shuffled by the order of seeds 4 and 5.
.f64: little-endian doubles x, y; .u32: little-endian pairs of point numbers.
"""

import sys

import numpy as np

GAMMA = np.uint64(0x9E3779B97F4A7C15)


def words(seed, count):
    with np.errstate(over="ignore"):
        z = np.uint64(seed) + GAMMA * np.arange(1, count + 1, dtype=np.uint64)
        z = (z ^ (z >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
        z = (z ^ (z >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
        return z ^ (z >> np.uint64(31))


def units(w):
    return (w >> np.uint64(11)).astype(np.float64) * 2.0**-53


def clustered(n):
    centers = units(words(102, 2000)).reshape(-1, 2)
    w = words(2, 7 * n).reshape(n, 7)
    u = units(w[:, 1:]).reshape(n, 2, 3)
    return centers[(w[:, 0] % np.uint64(1000)).astype(np.int64)] + (u.sum(axis=2) - 1.5) / 64


def matched(n):
    k = int(n**0.5)
    k -= k % 2
    cells = np.stack(np.meshgrid(np.arange(k), np.arange(k)), axis=-1).reshape(-1, 2)
    points = (cells + 0.25 + 0.5 * units(words(3, 2 * k * k)).reshape(-1, 2)) / k
    order = np.argsort(words(4, k * k), kind="stable")
    place = np.empty(k * k, dtype=np.uint32)
    place[order] = np.arange(k * k, dtype=np.uint32)
    segments = place.reshape(-1, 2)
    return points[order], segments[np.argsort(words(5, len(segments)), kind="stable")]


def main():
    folder, n = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 1_000_000
    units(words(1, 2 * n)).astype("<f8").tofile(f"{folder}/uniform.f64")
    clustered(n).astype("<f8").tofile(f"{folder}/clustered.f64")
    points, segments = matched(n)
    points.astype("<f8").tofile(f"{folder}/matched.f64")
    segments.astype("<u4").tofile(f"{folder}/matched.u32")


if __name__ == "__main__":
    main()
