#!/usr/bin/env python3
"""Writes the inputs of the benchmark in space: python3 bench_inputs_space.py FOLDER [N]

Rows of four little-endian doubles x, y, z, weight; words and units as in bench_inputs.py.
- uniform.f64:   N points of the unit cube, three units each (seed 1). growth.f64: 3 N of them.
- sphere.f64:    N points of the unit sphere, rounded: (s cos t, s sin t, z) with z = 2 u - 1, s^2 = 1 - z^2, t = 2 pi u' (seed 2).
- clustered.f64: N points around 1,000 centers uniform in the unit cube (seed 103): center word % 1000, then each coordinate the center's plus
                 (u1 + u2 + u3 - 1.5) / 64 (seed 3).
- weighted.f64:  uniform, with weights 1.15 u N^(-2/3): some 10% of the points are hidden (seed 4).
- grid.f64:      the k x k x k grid of integers, k the cube root of N, z fastest.
- shuffled.f64:  the same in the order of seed 5.
- small_*.f64:   N / 10 points of each, for removal.
"""

import sys

import numpy as np

from bench_inputs import units, words


def uniform(n):
    return units(words(1, 3 * n)).reshape(n, 3)


def sphere(n):
    u = units(words(2, 2 * n)).reshape(n, 2)
    z = 2 * u[:, 0] - 1
    s, t = np.sqrt(1 - z * z), 2 * np.pi * u[:, 1]
    return np.stack([s * np.cos(t), s * np.sin(t), z], axis=1)


def clustered(n):
    centers = units(words(103, 3000)).reshape(-1, 3)
    w = words(3, 10 * n).reshape(n, 10)
    u = units(w[:, 1:]).reshape(n, 3, 3)
    return centers[(w[:, 0] % np.uint64(1000)).astype(np.int64)] + (u.sum(axis=2) - 1.5) / 64


def grid(n):
    k = round(n ** (1 / 3))
    i = np.arange(k**3)
    return np.stack([i // (k * k), i // k % k, i % k], axis=1).astype(np.float64)


def save(path, points, weights=None):
    weights = np.zeros(len(points)) if weights is None else weights
    np.column_stack([points, weights]).astype("<f8").tofile(path)


def main():
    folder, n = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 1_000_000
    save(f"{folder}/growth.f64", uniform(3 * n))
    for prefix, n in [("", n), ("small_", n // 10)]:
        save(f"{folder}/{prefix}uniform.f64", uniform(n))
        save(f"{folder}/{prefix}sphere.f64", sphere(n))
        save(f"{folder}/{prefix}clustered.f64", clustered(n))
        save(f"{folder}/{prefix}weighted.f64", uniform(n), 1.15 * units(words(4, n)) * n ** (-2 / 3))
        g = grid(n)
        save(f"{folder}/{prefix}grid.f64", g)
        save(f"{folder}/{prefix}shuffled.f64", g[np.argsort(words(5, len(g)), kind="stable")])


if __name__ == "__main__":
    main()
