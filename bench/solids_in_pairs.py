"""Laws of volumes, exactly, on the closed scenes of a folder in pairs: PYTHONPATH=build/python bench/solids_in_pairs.py FOLDER

Each closed scene of at most so many faces is paired with each other one, in three poses: as they are; the second moved
so that its box has the first's middle; and so that it has the first's side of greatest x, where flat tops share a
plane. Of each pair, as rationals: |A or B| + |A and B| = |A| + |B|, |A less B| + |A and B| = |A|, the other way round,
and |A xor B| = |A less B| + |B less A|.
"""

import pathlib
import sys
import time

import sightline

MOST_FACES = int(sys.argv[2]) if len(sys.argv) > 2 else 3000


def volume(operation, *solids):
    return sightline.boolean(operation, *solids).volume


def moved(scene, step):
    return sightline.Scene(scene.points(exact=True) + step, scene.faces())


def poses(a, b):
    (low_a, high_a), (low_b, high_b) = a.info()["box"], b.info()["box"]
    middle = [(low_a[k] + high_a[k] - low_b[k] - high_b[k]) / 2 for k in range(3)]
    return b, moved(b, middle), moved(b, [high_a[0] - high_b[0], *middle[1:]])


solids = []
for path in sorted(pathlib.Path(sys.argv[1]).rglob("*")):
    if path.suffix not in (".obj", ".off", ".ply", ".stl", ".qoff", ".map") or path.stat().st_size > 2_000_000:
        continue
    try:
        scene = sightline.Scene.read(path)
    except ValueError:
        continue
    if scene.info()["closed"] and 0 < scene.face_count <= MOST_FACES:
        solids.append((path.name, scene, volume("union", scene, scene)))

begin, pairs, wrong, refused = time.process_time(), 0, 0, 0
for i, (name_a, a, volume_a) in enumerate(solids):
    for name_b, b, volume_b in solids[i + 1 :]:
        for pose, other in enumerate(poses(a, b)):
            try:
                either, both = volume("union", a, other), volume("intersection", a, other)
                less, rest = volume("difference", a, other), volume("difference", other, a)
                apart = volume("symmetric-difference", a, other)
            except ValueError as error:  # a face that crosses itself
                refused += 1
                print(f"{name_a}, {name_b}: {error}")
                continue
            pairs += 1
            if (either + both, less + both, rest + both, less + rest) != (volume_a + volume_b, volume_a, volume_b, apart):
                wrong += 1
                print(f"{name_a}, {name_b}, pose {pose}: volumes do not add up")
print(f"{len(solids)} closed scenes of at most {MOST_FACES} faces, {pairs} pairs and poses: {wrong} wrong, {refused} refused")
print(f"{time.process_time() - begin:.1f} seconds of processor time")
sys.exit(wrong > 0)
