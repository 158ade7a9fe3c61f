#!/usr/bin/env python3
"""Turns real inputs into a stream of cases: corpora.py poly|points FILES... (formats: README.md)

Equal points are merged and their references redirected; everything else is left as it is. Each case appears twice, the second time with
its vertices in reversed order under their old labels.
"""

import json
import re
import sys
from pathlib import Path


def rows(path):
    """The words of each line that holds any, comments cut."""
    lines = (line.split("#")[0].split() for line in Path(path).read_text().splitlines())
    return iter([line for line in lines if line])


def read_poly(path):
    lines = rows(path)
    n, _, attributes, markers = map(int, (next(lines) + ["0", "0"])[:4])
    if n == 0:
        raise ValueError("vertices in another file")
    ids, points = {}, []
    for i in range(n):
        words = next(lines)
        ids[words[0]] = i
        points.append((words[1], words[2]))
    segments = [tuple(ids[v] for v in next(lines)[1:3]) for _ in range(int(next(lines)[0]))]
    holes = [tuple(next(lines)[1:3]) for _ in range(int(next(lines, ["0"])[0]))]
    return points, segments, holes


def read_points(path):
    text = Path(path).read_text()
    if path.endswith(".node"):
        lines = rows(path)
        return [tuple(next(lines)[1:3]) for _ in range(int(next(lines)[0]))]
    if path.endswith(".json"):
        return [tuple(map(repr, p[:2])) for p in json.loads(text)]
    if path.endswith(".wkt"):
        return re.findall(r"(-?[\d.]+(?:[eE][-+]?\d+)?)\s+(-?[\d.]+(?:[eE][-+]?\d+)?)", text)
    return [tuple(line.split()[:2]) for line in text.splitlines() if len(line.split()) >= 2]


def merged(points, segments):
    """Without repetitions; -0 equals 0."""
    place, of, kept = {}, [], []
    for x, y in points:
        key = (float(x) + 0.0, float(y) + 0.0)
        if key not in place:
            place[key] = len(kept)
            kept.append((x, y))
        of.append(place[key])
    return kept, [(of[u], of[v]) for u, v in segments if of[u] != of[v]]


def write(name, points, segments, holes, order):
    place = {old: new for new, old in enumerate(order)}
    print("case", name, len(points), len(segments), len(holes))
    for old in order:
        print(old, *points[old])
    for u, v in segments:
        print(place[u], place[v])
    for x, y in holes:
        print(x, y)


def main():
    kind, files = sys.argv[1], sys.argv[2:]
    once = kind.endswith("-once")
    for path in files:
        try:
            points, segments, holes = read_poly(path) if kind.startswith("poly") else (read_points(path), [], [])
            points, segments = merged(points, segments)
        except (ValueError, StopIteration, KeyError) as error:
            print(f"{path}: left out: {error}", file=sys.stderr)
            continue
        order = list(range(len(points)))
        write(Path(path).stem, points, segments, holes, order)
        if not once:
            write(Path(path).stem, points, segments, holes, order[::-1])


if __name__ == "__main__":
    main()
