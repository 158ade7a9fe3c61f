"""Cases of space and their answers (README.md, "Cases of space"): reading, writing, calling a program."""

import struct
import subprocess
from collections import namedtuple

Case = namedtuple("Case", "name points edits")  # points: bytes of N rows of four doubles; edits: (kind, id, weight)
Answer = namedtuple("Answer", "name dimension simplices hidden duplicates")  # bytes each but name and dimension

KINDS = ["insert", "remove", "set weight of"]


def case_bytes(case):
    name = case.name.encode()
    edits = b"".join(struct.pack("<IId", *e) for e in case.edits)
    head = struct.pack("<I", len(name)) + name + struct.pack("<I", len(case.points) // 32)
    return head + case.points + struct.pack("<I", len(case.edits)) + edits


def cases_of(stream):
    at = 0

    def take(n):
        nonlocal at
        at += n
        return stream[at - n : at]

    def number():
        return struct.unpack("<I", take(4))[0]

    while at < len(stream):
        name = take(number()).decode()
        points = take(32 * number())
        edits = list(struct.iter_unpack("<IId", take(16 * number())))
        yield Case(name, points, edits)


def answers_of(stream):
    at, all_ = 0, []

    def take(n):
        nonlocal at
        at += n
        if at > len(stream):
            raise EOFError
        return stream[at - n : at]

    def number():
        return struct.unpack("<I", take(4))[0]

    try:
        while at < len(stream):
            name = take(number()).decode()
            dimension = struct.unpack("<i", take(4))[0]
            all_.append(Answer(name, dimension, *(take(4 * number()) for _ in range(3))))
    except EOFError:
        print("an answer is cut off")
    return all_


def answers(program, stream, timeout=None):
    """The answers of a program, those before its failure if it fails; and whether it ended well and silently."""
    try:
        run = subprocess.run(program, input=stream, capture_output=True, timeout=timeout)
    except subprocess.TimeoutExpired as late:
        print(" ".join(program), "did not end in", timeout, "s")
        return answers_of(late.stdout or b""), False
    if run.returncode != 0 or run.stderr:
        print(" ".join(program), "exit code", run.returncode, run.stderr.decode(errors="replace")[-1500:])
    return answers_of(run.stdout), run.returncode == 0 and not run.stderr


def rows(case):
    return list(struct.iter_unpack("<4d", case.points))


def tuples(answer):
    size = answer.dimension + 1
    ids = struct.unpack(f"<{len(answer.simplices) // 4}I", answer.simplices)
    return [ids[i : i + size] for i in range(0, len(ids), size)] if size else []


def ids(data):
    return struct.unpack(f"<{len(data) // 4}I", data)


def describe(case):
    """A case as text, floats shortest round-trip."""
    lines = [f"  {i}: {x!r} {y!r} {z!r}  weight {w!r}" for i, (x, y, z, w) in enumerate(rows(case))]
    lines += [f"  {KINDS[kind]} {id_}" + (f": {weight!r}" if kind == 2 else "") for kind, id_, weight in case.edits]
    return "\n".join(lines)
