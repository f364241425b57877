"""Laws of volumes, exactly, on the closed scenes of a folder in pairs: PYTHONPATH=build/python bench/solids_in_pairs.py FOLDER

Each closed scene of at most so many faces (a second argument) is paired with each other one, in three poses: as they
are; the second moved so that its box has the first's middle; and so that it has the first's side of greatest x, where
flat tops share a plane. Of each pair, as rationals: |A or B| + |A and B| = |A| + |B|, |A less B| + |A and B| = |A|, the
other way round, and |A xor B| = |A less B| + |B less A|. Pairs and poses come in an order that is drawn by a seed, 1;
a third argument, seconds of processor time, or Ctrl-C ends them; the last line says how many were asked about. A fourth
one, 3/8, takes every eighth of them from the fourth on: the shards together are all.
"""

import collections
import itertools
import pathlib
import random
import sys
import time

import sightline

MOST_FACES = int(sys.argv[2]) if len(sys.argv) > 2 else 3000
MOST_SECONDS = float(sys.argv[3]) if len(sys.argv) > 3 else float("inf")
SHARD, SHARDS = map(int, sys.argv[4].split("/")) if len(sys.argv) > 4 else (0, 1)
SECONDS_EACH = 60  # of one operation
POSES = "as they are", "middle on middle", "side on side"


def volume(operation, *solids):
    return sightline.boolean(operation, *solids, threads=1, budget=SECONDS_EACH).volume


def moved(scene, step):
    return sightline.Scene(scene.points(exact=True) + step, scene.faces())


def in_pose(pose, a, b):
    if pose == 0:
        return b
    (low_a, high_a), (low_b, high_b) = a.info()["box"], b.info()["box"]
    step = [(low_a[k] + high_a[k] - low_b[k] - high_b[k]) / 2 for k in range(3)]
    if pose == 2:
        step[0] = high_a[0] - high_b[0]
    return moved(b, step)


def judged(a, b):
    """What becomes of two solids and their volumes, each (scene, volume)."""
    either, both = volume("union", a[0], b[0]), volume("intersection", a[0], b[0])
    less, rest = volume("difference", a[0], b[0]), volume("difference", b[0], a[0])
    apart = volume("symmetric-difference", a[0], b[0])
    right = (either + both, less + both, rest + both, less + rest) == (a[1] + b[1], a[1], b[1], apart)
    return ("right, their insides apart" if both == 0 else "right") if right else "wrong"


begin, solids, too_large = time.process_time(), [], 0
for path in sorted(pathlib.Path(sys.argv[1]).rglob("*")):
    if path.suffix not in (".obj", ".off", ".ply", ".stl", ".qoff", ".map"):
        continue
    try:
        scene = sightline.Scene.read(path)
        if not scene.info()["closed"] or scene.face_count == 0:
            continue
        if scene.face_count > MOST_FACES:
            too_large += 1
            continue
        solids.append((path.name, scene, volume("union", scene)))
    except ValueError as error:  # no scene, or a face that crosses itself
        if "bounds no solid" in str(error):
            print(f"{path.name}: {error}")
print(f"{len(solids)} closed scenes of at most {MOST_FACES} faces, {too_large} larger ones left out", flush=True)

asked = [(*pair, pose) for pair in itertools.combinations(solids, 2) for pose in range(3)]
random.Random(1).shuffle(asked)
asked = asked[SHARD::SHARDS]
found = collections.Counter()
for (name_a, *a), (name_b, *b), pose in asked:
    if time.process_time() - begin > MOST_SECONDS:
        break
    try:
        what = judged(a, (in_pose(pose, a[0], b[0]), b[1]))
    except ValueError as error:
        what = f"refused: {error}"
    except sightline.OutOfBudget:
        what = "undecided"
    except KeyboardInterrupt:
        break
    if not what.startswith("right"):
        print(f"{name_a}, {name_b}, {POSES[pose]}: {what}", flush=True)
    found[what.split(":")[0]] += 1
print(f"{sum(found.values())} of {len(asked)} pairs and poses: " + ", ".join(f"{n} {what}" for what, n in found.items()))
print(f"{time.process_time() - begin:.1f} seconds of processor time")
sys.exit(found["wrong"] > 0)
