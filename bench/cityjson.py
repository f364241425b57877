#!/usr/bin/env python3
"""Cities of others as scenes: CityJSON or CityJSONSeq to .qoff, every coordinate exactly as the file says it.

cityjson.py FILE... --out FOLDER    writes FOLDER/NAME.qoff for each

A coordinate is integer * scale + translate, in rational numbers. Of each object the surfaces of its highest level of detail become faces, their fronts as they are; equal points
become one. A file that is none, names a vertex that is not there, or has a number with an exponent beyond 1100 either way is refused: exit code 3. What .qoff cannot say is left out and counted: surfaces with holes, so that what these closed is open. Objects without surfaces of their own are counted too: points, lines, instances of templates.
"""
import argparse, json, pathlib, sys
from fractions import Fraction

DEPTH = {"MultiSurface": 0, "CompositeSurface": 0, "Solid": 1, "MultiSolid": 2, "CompositeSolid": 2}  # of lists around lists of surfaces


def number(text):
    exponent = int(text.lower().partition("e")[2] or 0)
    if not -1100 <= exponent <= 1100:
        raise ValueError(f"the exponent of {text[:40]} is not between -1100 and 1100")
    return Fraction(text)


def no_number(text):
    raise ValueError(f"{text} is no finite number")


def index(value, count):
    """The place of a vertex. Python's own would count -1 from the end, and cut off fractions."""
    if not isinstance(value, Fraction) or value.denominator != 1 or not 0 <= value < count:
        raise ValueError(f"there is no vertex {str(value)[:40]} of {count}")
    return int(value)


def point(vertex, scale, translate):
    if not len(vertex) == len(scale) == len(translate) == 3:
        raise ValueError("a vertex, scale or translate has not three numbers")
    return tuple(x * s + t for x, s, t in zip(vertex, scale, translate))


def parts_of(path):
    """Objects with their vertices: a whole city, or the features of a sequence, whose first line has the transform of all."""
    numbers = {"parse_float": number, "parse_int": Fraction, "parse_constant": no_number}
    text = path.read_text(encoding="utf-8")
    lines = [text] if path.suffix != ".jsonl" else [line for line in text.splitlines() if line.strip()]
    transform = None
    for line in lines:
        part = json.loads(line, **numbers)
        transform = transform or part.get("transform")
        scale, translate = (transform["scale"], transform["translate"]) if transform else ([1, 1, 1], [0, 0, 0])
        points = [point(vertex, scale, translate) for vertex in part["vertices"]]
        yield part["CityObjects"].values(), points


def surfaces_of(city_object):
    """Those of the highest level of detail, each a list of loops of vertices, the first one its outline."""
    shapes = [shape for shape in city_object.get("geometry", []) if shape["type"] in DEPTH]
    level = lambda shape: Fraction(str(shape.get("lod", 0)))
    for shape in shapes:
        if level(shape) < max(map(level, shapes)):
            continue
        surfaces = shape["boundaries"]
        for _ in range(DEPTH[shape["type"]]):
            surfaces = [inner for outer in surfaces for inner in outer]
        yield from surfaces


def convert(path, folder):
    ids, faces, holes, without = {}, [], 0, 0
    for objects, points in parts_of(path):
        for city_object in objects:
            surfaces = list(surfaces_of(city_object))
            without += not surfaces
            holes += sum(len(loops) > 1 for loops in surfaces)
            faces += [[ids.setdefault(points[index(v, len(points))], len(ids)) for v in loops[0]] for loops in surfaces if len(loops) == 1]
    lines = ["OFF", f"{len(ids)} {len(faces)} 0"] + [" ".join(map(str, p)) for p in ids] + [" ".join(map(str, [len(f)] + f)) for f in faces]
    name = path.name.split(".")[0]
    (folder / f"{name}.qoff").write_text("\n".join(lines) + "\n")
    print(f"{name}: {len(faces)} faces, {len(ids)} points; left out: {holes} surfaces with holes, {without} objects without surfaces", file=sys.stderr)


arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
arguments.add_argument("files", nargs="+", type=pathlib.Path, metavar="FILE")
arguments.add_argument("--out", required=True, type=pathlib.Path, metavar="FOLDER")
arguments = arguments.parse_args()
arguments.out.mkdir(parents=True, exist_ok=True)
for path in arguments.files:
    try:
        convert(path, arguments.out)
    except (OSError, ValueError, LookupError, TypeError, AttributeError, RecursionError) as error:  # what is no city
        what = f"it has no {error}" if isinstance(error, KeyError) else str(error)
        print(f"cityjson.py: {path}: {what}; give CityJSON, or CityJSONSeq as .jsonl", file=sys.stderr)
        sys.exit(3)
