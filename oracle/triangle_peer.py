#!/usr/bin/env python3
"""Triangle as a peer, through its Python wheel (`pip install triangle`: non-commercial licence, never shipped with this project).

  triangle_peer.py delaunay POINTS
  triangle_peer.py constrained POINTS SEGMENTS
  triangle_peer.py refine SHAPE AREA DEGREES
  triangle_peer.py mesh DEGREES AREA MAX_VERTICES < CASES
Files and output as in README.md. Times are CPU seconds of the call, the wrapper's copies included.
"""

import math
import sys
import time

import numpy as np
import triangle


def timed(data, options):
    start = time.process_time()
    result = triangle.triangulate(data, options)
    return result, time.process_time() - start


def quality(result):
    """Smallest angle in degrees and largest area."""
    corners = result["vertices"][result["triangles"]]
    smallest, largest = 180.0, 0.0
    for i in range(3):
        a, u, v = corners[:, i], corners[:, (i + 1) % 3] - corners[:, i], corners[:, (i + 2) % 3] - corners[:, i]
        cross, dot = u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0], (u * v).sum(axis=1)
        smallest = min(smallest, math.degrees(np.arctan2(cross, dot).min()))
        largest = max(largest, cross.max() / 2)
    return smallest, largest


def cases(stream):
    words = iter(stream.read().split())
    for _ in words:
        name, n, m, h = next(words), int(next(words)), int(next(words)), int(next(words))
        points = [(next(words), float(next(words)), float(next(words)))[1:] for _ in range(n)]
        segments = [(int(next(words)), int(next(words))) for _ in range(m)]
        holes = [(float(next(words)), float(next(words))) for _ in range(h)]
        yield name, points, segments, holes


def mesh(degrees, area, limit):
    for name, points, segments, holes in cases(sys.stdin):
        data = {"vertices": np.array(points), "segments": np.array(segments, dtype=np.int32)}
        if holes:
            data["holes"] = np.array(holes)
        options = f"pq{degrees}S{int(limit)}" + (f"a{float(area):.17f}" if float(area) > 0 else "")
        result, seconds = timed(data, options)
        if "triangles" not in result:
            print(name, "nothing to mesh", flush=True)
            continue
        smallest, largest = quality(result)
        ended = int(len(result["vertices"]) - len(points) < int(limit))
        print(name, ended, len(result["vertices"]), len(result["triangles"]), f"{smallest:.4f} {largest:.6e} {seconds:.3f}", flush=True)


def main():
    mode, *rest = sys.argv[1:]
    if mode == "mesh":
        mesh(*rest)
        return
    extra = ""
    if mode == "delaunay":
        result, seconds = timed({"vertices": np.fromfile(rest[0]).reshape(-1, 2)}, "z")
    elif mode == "constrained":
        data = {"vertices": np.fromfile(rest[0]).reshape(-1, 2), "segments": np.fromfile(rest[1], dtype="<u4").reshape(-1, 2).astype(np.int32)}
        result, seconds = timed(data, "pczB")
    else:
        square, quad = [(0, 0), (1, 0), (1, 1), (0, 1)], [(0, 0), (1, 0.125), (0.875, 1.0625), (-0.0625, 0.9375)]
        data = {"vertices": np.array(square if rest[0] == "square" else quad, dtype=float), "segments": np.array([(0, 1), (1, 2), (2, 3), (3, 0)], dtype=np.int32)}
        result, seconds = timed(data, f"pq{rest[2]}a{float(rest[1]):.17f}")
        extra = f" {quality(result)[0]:.4f}"
    print(f"{seconds:.4f} {len(result['vertices'])} {len(result['triangles'])}{extra}")


if __name__ == "__main__":
    main()
