#!/usr/bin/env python3
"""Turns real inputs into a stream of cases of space (README.md, "Cases of space"): corpora_space.py FILES... >STREAM

Points of the plane appear twice: at height 0, and at height x (another plane). Weighted points of the plane keep their weights. `.xyz` with a
count in its first line, `.node` of dimension 2 and 3, `.json`, `.wkt`, weighted `.txt`, `.off` (vertices) are read; others are left out, and said so.
"""

import json
import re
import struct
import sys
from pathlib import Path

from space import Case, case_bytes

NUMBER = r"(-?[\d.]+(?:[eE][-+]?\d+)?)"


def words_of(text):
    lines = (line.split("#")[0].replace(",", " ").split() for line in text.splitlines())
    return [line for line in lines if line]


def read(path):
    """Points with two or three coordinates, and weights (None: without)."""
    text, ending = Path(path).read_text(), Path(path).suffix.lower()
    if ending == ".json":
        return [p[:2] for p in json.loads(text)], None
    if ending == ".wkt":
        return re.findall(NUMBER + r"\s+" + NUMBER, text), None
    lines = words_of(text)
    if ending == ".node":
        n, dimension = int(lines[0][0]), int(lines[0][1])
        return [line[1 : 1 + dimension] for line in lines[1 : n + 1]], None
    if ending == ".txt":
        n = int(lines[0][0]) - 1
        return [line[:2] for line in lines[1 : n + 1]], [line[2] for line in lines[1 : n + 1]]
    if ending == ".xyz":
        return [line[:3] for line in lines if len(line) >= 3], None
    if ending == ".off":
        flat = [w for line in lines for w in line]
        if flat[0] != "OFF":
            raise ValueError("no OFF")
        n = int(flat[1])
        return [flat[4 + 3 * i : 7 + 3 * i] for i in range(n)], None
    raise ValueError("unknown format")


def packed(points, weights, height):
    rows = []
    for i, p in enumerate(points):
        p = [float(x) for x in p]
        z = p[2] if len(p) == 3 else height * p[0]
        rows.append(struct.pack("<4d", p[0], p[1], z, float(weights[i]) if weights else 0.0))
    return b"".join(rows)


def main():
    for path in sys.argv[1:]:
        try:
            points, weights = read(path)
            if not points:
                raise ValueError("no points")
            name = "/".join(Path(path).parts[-2:])
            flat = len(points[0]) == 2
            for height in [0.0, 1.0] if flat else [0.0]:
                sys.stdout.buffer.write(case_bytes(Case(name + (" tilted" if height else ""), packed(points, weights, height), [])))
        except (ValueError, IndexError, UnicodeDecodeError) as error:
            print(f"{path}: left out: {error}", file=sys.stderr)


if __name__ == "__main__":
    main()
