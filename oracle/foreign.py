#!/usr/bin/env python3
"""Foreign tetrahedral meshes judged by `check`: foreign.py TARGET_FOLDER WORK_FOLDER [N]

TetGen, CGAL and Gmsh triangulate the same N points; each writes its own files, in every format that it has. Their meshes must be judged
right. The same meshes, spoilt by this script at a place known to it, must be judged wrong, with a witness at that place:
- flipped:  two cells replaced by the three about the edge between their outer vertices (2-3 flip): still a complex, no longer Delaunay;
- moved:    one corner of eight cospherical points moved by one unit in the last place into the sphere of a cell;
- missing:  a cell left out, from the inside and from the hull;
- doubled:  a cell given twice;
- inverted: two vertices of a cell exchanged.
All places are decided here by rationals. The points have nine decimals, which every program writes and reads without loss; eight of them are the corners
of a cube with nothing else near its sphere, eight the corners of a box around all (Gmsh's `tetrahedralize` leaves gaps along a hull of thin cells, as its own box
around the points is not far away).
"""

import json
import math
import random
import subprocess
import sys
from collections import defaultdict
from fractions import Fraction
from pathlib import Path

CLAIMS = "valid,orientation,delaunay,hull,topology"
CUBE = [(0.5 + 0.125 * (i & 1), 0.5 + 0.125 * (i >> 1 & 1), 0.5 + 0.125 * (i >> 2)) for i in range(8)]
BOX = [(-0.5 + 2.0 * (i & 1), -0.5 + 2.0 * (i >> 1 & 1), -0.5 + 2.0 * (i >> 2)) for i in range(8)]
# Which claim each way of spoiling violates, and which must still hold.
EXPECTED = {
    "flipped": ("delaunay", ["valid", "orientation", "hull"]),
    "moved": ("delaunay", ["valid", "orientation", "hull"]),
    "missing inside": ("hull", ["orientation"]),
    "missing at the hull": ("hull", ["orientation"]),
    "doubled": ("valid", []),
    "inverted": ("orientation", []),
    "as returned": ("orientation", ["valid", "delaunay", "hull"]),
}


def points_for(n, draw):
    """Uniform and clustered points of nine decimals, outside of the cube's sphere, then box and cube."""
    center, radius2 = (0.5625,) * 3, 3 * 0.0625**2 * 1.5
    points = set()
    while len(points) < n - 16:
        scale, offset = draw.choice([(1.0, 0.0), (0.01, 0.2), (0.001, 0.8)])
        p = tuple(round(offset + scale * draw.random(), 9) for _ in range(3))
        if math.dist(p, center) ** 2 > radius2:
            points.add(p)
    return sorted(points, key=lambda p: (p[2], p[0])) + BOX + CUBE


def det(rows):
    if len(rows) == 1:
        return rows[0][0]
    minor = lambda j: [row[:j] + row[j + 1 :] for row in rows[1:]]
    return sum((-1) ** j * rows[0][j] * det(minor(j)) for j in range(len(rows)) if rows[0][j])


def orientation(p, a, b, c, d):
    origin, *rest = [[Fraction(x) for x in p[v]] for v in (a, b, c, d)]
    return det([[x - o for x, o in zip(q, origin)] for q in rest])


def inside_sphere(p, cell, q):
    """Positive if q is strictly inside the sphere through the cell."""
    rows = []
    for v in cell:
        row = [Fraction(x) - Fraction(y) for x, y in zip(p[v], p[q])]
        rows.append(row + [sum(x * x for x in row)])
    return -det(rows) * (1 if orientation(p, *cell) > 0 else -1)


# Readers and writers of the three programs' formats.


def tetgen(points, folder):
    node = folder / "tetgen.node"
    write_node(node, points)
    subprocess.run(["tetgen", "-zQ", node], check=True, stdout=subprocess.DEVNULL)
    ele = folder / "tetgen.1.ele"
    lines = [line.split() for line in ele.read_text().splitlines() if not line.startswith("#")]
    return [ele], [tuple(map(int, line[1:5])) for line in lines[1 : int(lines[0][0]) + 1]]


def write_node(path, points):
    rows = [f"{i} {x!r} {y!r} {z!r}" for i, (x, y, z) in enumerate(points)]
    path.write_text("\n".join([f"{len(points)} 3 0 0", *rows]) + "\n")


def write_ele(folder, name, points, cells):
    write_node(folder / f"{name}.node", points)
    rows = [f"{i} " + " ".join(map(str, c)) for i, c in enumerate(cells)]
    (folder / f"{name}.ele").write_text("\n".join([f"{len(cells)} 4 0", *rows]) + "\n")
    return [folder / f"{name}.ele"]


def cgal(points, folder, program):
    import struct

    rows, mesh = folder / "points.f64", folder / "cgal.mesh"
    rows.write_bytes(b"".join(struct.pack("<4d", *p, 0.0) for p in points))
    subprocess.run([program, rows, mesh], check=True)
    lines = mesh.read_text().splitlines()
    at = lines.index("Tetrahedra") + 2
    return [mesh], [tuple(int(w) - 1 for w in line.split()[:4]) for line in lines[at : at + int(lines[at - 1])]]


def write_mesh(folder, name, points, cells):
    path = folder / f"{name}.mesh"
    vertices = "".join(f"{x!r} {y!r} {z!r} 0\n" for x, y, z in points)
    tetrahedra = "".join(" ".join(str(v + 1) for v in c) + " 0\n" for c in cells)
    path.write_text(f"MeshVersionFormatted 2\nDimension\n3\nVertices\n{len(points)}\n{vertices}Tetrahedra\n{len(cells)}\n{tetrahedra}End\n")
    return [path]


def gmsh_cells(points):
    import gmsh

    gmsh.initialize(["", "-v", "1"])
    tags, _ = gmsh.algorithm.tetrahedralize([x for p in points for x in p])
    gmsh.finalize()
    ids = [int(t) - 1 for t in tags]
    return [tuple(ids[i : i + 4]) for i in range(0, len(ids), 4)]


def gmsh(points, folder):
    cells = gmsh_cells(points)
    return write_gmsh(folder, "gmsh", points, cells), cells


def write_gmsh(folder, name, points, cells):
    """As Gmsh itself writes: .msh 2.2 and 4.1 as text (binary ones are refused, with that advice), .vtk as text and binary."""
    import gmsh

    gmsh.initialize(["", "-v", "1"])
    gmsh.model.addDiscreteEntity(3, 1)
    gmsh.model.mesh.addNodes(3, 1, list(range(1, len(points) + 1)), [x for p in points for x in p])
    gmsh.model.mesh.addElementsByType(1, 4, [], [v + 1 for c in cells for v in c])
    gmsh.option.setNumber("Mesh.SaveAll", 1)
    files = []
    for version, binary, ending in [(2.2, 0, "22.msh"), (4.1, 0, "41.msh"), (0, 0, "vtk"), (0, 1, "binary.vtk")]:
        if version:
            gmsh.option.setNumber("Mesh.MshFileVersion", version)
        gmsh.option.setNumber("Mesh.Binary", binary)
        files.append(folder / f"{name}.{ending}")
        gmsh.write(str(files[-1]))
    gmsh.finalize()
    return files


# Ways of spoiling a mesh: each gives points, cells, and the vertices at the place.


def facets(cells):
    sides = defaultdict(list)
    for i, c in enumerate(cells):
        for v in c:
            sides[frozenset(c) - {v}].append((i, v))
    return sides


def flipped(points, cells, draw):
    inner = [(f, s) for f, s in facets(cells).items() if len(s) == 2]
    while True:
        facet, ((i, d), (j, e)) = draw.choice(inner)
        a, b, c = facet
        # The edge de must pass through the inside of abc, and the five points may not be cospherical.
        turns = [orientation(points, d, e, *pair) for pair in ((a, b), (b, c), (c, a))]
        if all(t > 0 for t in turns) or all(t < 0 for t in turns):
            if inside_sphere(points, cells[i], e) != 0:
                new = [positive(points, (d, e, *pair)) for pair in ((a, b), (b, c), (c, a))]
                return points, [x for k, x in enumerate(cells) if k not in (i, j)] + new, {a, b, c, d, e}


def positive(points, cell):
    a, b, c, d = cell
    return cell if orientation(points, *cell) > 0 else (a, b, d, c)


def moved(points, cells, draw):
    first, places = len(points) - 8, [(v, k, way) for v in range(8) for k in range(3) for way in (-math.inf, math.inf)]
    draw.shuffle(places)
    for v, k, way in places:
        q = first + v
        p = list(points[q])
        p[k] = math.nextafter(p[k], way)
        others = points[:q] + [tuple(p)] + points[q + 1 :]
        cube = [c for c in cells if min(c) >= first and q not in c]
        pierced = [c for c in cube if inside_sphere(others, c, q) > 0]
        # Only cells at q and spheres of the cube change; no cell turns over by an ulp, as all have some size.
        if pierced:
            return others, cells, set(pierced[0]) | {q}
    raise ValueError("no corner of the cube can be moved into a sphere")


def missing(points, cells, draw, hull):
    at_hull = {i for s in facets(cells).values() if len(s) == 1 for i, _ in s}
    # Inside: no vertex on the hull, so that a hole appears and not a dent.
    hull_vertices = {v for f, s in facets(cells).items() if len(s) == 1 for v in f}
    fits = [i for i, c in enumerate(cells) if (i in at_hull if hull else not hull_vertices & set(c))]
    i = draw.choice(fits)
    return points, cells[:i] + cells[i + 1 :], set(cells[i])


def doubled(points, cells, draw):
    i = draw.randrange(len(cells))
    a, b, c, d = cells[i]
    return points, cells + [(b, c, a, d)], set(cells[i])


def inverted(points, cells, draw):
    i = draw.randrange(len(cells))
    a, b, c, d = cells[i]
    return points, cells[:i] + [(b, a, c, d)] + cells[i + 1 :], set(cells[i])


SPOILERS = {
    "flipped": flipped,
    "moved": moved,
    "missing inside": lambda p, c, r: missing(p, c, r, hull=False),
    "missing at the hull": lambda p, c, r: missing(p, c, r, hull=True),
    "doubled": doubled,
    "inverted": inverted,
}


class Judge:
    def __init__(self, program):
        self.program, self.wrong = program, []

    def report(self, path):
        run = subprocess.run([self.program, "check", path, "--claims", CLAIMS, "--json"], capture_output=True, text=True)
        if run.returncode not in (0, 1):
            return run.returncode, {}, run.stderr.strip()[-300:]
        claims = {c["claim"]: c for c in json.loads(run.stdout)["claims"]}
        return run.returncode, claims, ""

    def expect(self, title, path, how, place):
        code, claims, talk = self.report(path)
        bad = [name for name, c in claims.items() if c["verdict"] == "violated"]
        if how is None:
            right, text = code == 0 and not bad, "right" if code == 0 else f"wrong: {bad}"
        else:
            claim, hold = EXPECTED[how]
            witnesses = claims.get(claim, {}).get("witnesses", [])
            named = any(place & set(w.get("vertices", [])) for w in witnesses) or (how == "as returned" and witnesses)
            right = code == 1 and claim in bad and named and not set(hold) & set(bad)
            text = f"violates {', '.join(bad)}" + (f": {witnesses[0]['message']}" if witnesses else ", no witness")
            text += "" if named or not witnesses else " (not at the place)"
        print(f"{'ok ' if right else 'BAD'} {title:26} {how or 'whole':20} {path.name:20} {text} {talk}"[:230], flush=True)
        if not right:
            self.wrong.append((title, how, path.name))


def main():
    target, work = Path(sys.argv[1]), Path(sys.argv[2])
    draw = random.Random(3)
    points = points_for(int(sys.argv[3]) if len(sys.argv) > 3 else 1500, draw)
    judge = Judge(target / "release/orthoball")
    meshers = {
        "TetGen": (lambda: tetgen(points, work), write_ele),
        "CGAL": (lambda: cgal(points, work, target / "oracle/cgal-space_mesh"), write_mesh),
        "Gmsh": (lambda: gmsh(points, work), write_gmsh),
    }
    for title, (make, write) in meshers.items():
        files, cells = make()
        # Gmsh's function returns negative cells throughout, and no file of its own would hold such: that must be seen, and nothing else.
        if title == "Gmsh":
            for path in files:
                judge.expect(title, path, "as returned", set(cells[0]))
            cells = [positive(points, c) for c in cells]
            files = write_gmsh(work, "gmsh", points, cells)
        for path in files:
            judge.expect(f"{title}, {len(cells)} cells", path, None, set())
        for how, spoil in SPOILERS.items():
            spoilt_points, spoilt_cells, place = spoil(points, cells, draw)
            for path in write(work, "spoilt", spoilt_points, spoilt_cells):
                judge.expect(title, path, how, place)
    print(f"{len(judge.wrong)} wrong verdicts" if judge.wrong else "all verdicts right")
    sys.exit(bool(judge.wrong))


if __name__ == "__main__":
    main()
