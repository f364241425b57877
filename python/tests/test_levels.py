"""Cells and what they see: volumes and areas that add up as fractions, eyes in cells, what the program says."""

import json
import subprocess
from fractions import Fraction

import numpy as np
import pytest

import sightline
from test_answers import corpus, program
from test_shadows import vector_area


def two_rooms():
    return sightline.read(corpus / "two_rooms.off")


def own_volume(cell):
    """By fans about the origin."""
    six = Fraction(0)
    for wall in cell.walls:
        a = wall.corners[0]
        for b, c in zip(wall.corners[1:], wall.corners[2:]):
            det = sum(a[k] * (b[k - 2] * c[k - 1] - b[k - 1] * c[k - 2]) for k in range(3))
            six += det if wall.front != cell.id else -det
    return six / 6


def size(corners):
    """Twice the area of a polygon that is perpendicular to an axis."""
    parts = [abs(x) for x in vector_area(corners)]
    assert sorted(parts)[:2] == [0, 0]
    return sum(parts)


def box_of(points):
    return [max(p[k] for p in points) - min(p[k] for p in points) for k in range(3)]


@pytest.mark.parametrize("family", ["city_rotated", "boxes", "crossing_faces"])
@pytest.mark.parametrize("grid", [None, (2, 1, 3)])
def test_volumes_and_walls_add_up(family, grid):
    scene = sightline.generate(family, size=4, seed=2).scene
    cells = scene.cells(grid=grid)
    corners = [p for wall in cells.walls for p in wall.corners]
    x, y, z = box_of(corners)
    assert [x, y, z] >= box_of([tuple(p) for p in scene.points(exact=True)])
    assert [cell.volume for cell in cells] == [own_volume(cell) for cell in cells]
    assert sum(cell.volume for cell in cells) == x * y * z and min(cell.volume for cell in cells) > 0
    if cells.is_closed:
        assert sum(cell.volume for cell in cells if cell.is_solid) == sightline.boolean("union", scene).volume
    for cell in cells:
        total = [Fraction(0)] * 3
        faces = set()
        for wall in cell.walls:
            assert cell.id in (wall.front, wall.behind)
            sense = 1 if wall.front == cell.id else -1
            total = [a + sense * b for a, b in zip(total, vector_area(wall.corners))]
            faces.update((wall.faces_front if sense > 0 else wall.faces_behind).tolist())
        assert total == [0, 0, 0] and sorted(faces) == cell.faces.tolist()
        assert cells.at(cell.inside).id == cell.id
        assert (cell.box is None) == (grid is None)
    if grid is not None:
        assert {cell.box for cell in cells} == {(i, 0, k) for i in range(2) for k in range(3)}
        low, high = scene.info()["box"]
        for cell in cells:
            for k in range(3):
                share = (cell.inside[k] - low[k]) / (high[k] - low[k]) * grid[k]
                assert cell.box[k] == min(max(share // 1, 0), grid[k] - 1)  # those at the rim go on without end


def boxes(*ends):
    """Boxes by two corners each, with points of their own."""
    V, F = [], []
    for low, high in ends:
        first = len(V)
        V += [[(low, high)[i][0], (low, high)[j][1], (low, high)[k][2]] for k in (0, 1) for j in (0, 1) for i in (0, 1)]
        for f in ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)):
            F.append([first + i for i in f])
    return sightline.Scene(V, F)


def test_rooms_hold_their_cells_and_regions_are_fewer():
    scene = two_rooms()
    low, high = scene.info()["box"]
    middle = (low[0] + high[0]) / 2
    rooms = boxes((low, (middle, high[1], high[2])), ((middle, low[1], low[2]), high))
    cells = scene.cells(volumes=rooms)
    for room in (0, 1):
        inside = [cell for cell in cells if cell.room == room]
        assert sum(cell.volume for cell in inside) == (middle - low[0]) * (high[1] - low[1]) * (high[2] - low[2])
        assert all((cell.inside[0] < middle) == (room == 0) for cell in inside)
    assert {cell.room for cell in cells} == {0, 1, None} and {cell.room for cell in scene.cells()} == {None}
    assert scene.pvs(volumes=rooms).visible.keys() == cells.pvs().visible.keys()
    regions = cells.coarse()
    assert ((regions < 0) == cells.solid).all() and regions.max() < len(cells) - 1
    assert regions.max() + 1 < cells.coarse(10**9).max() + 1 == (~cells.solid).sum()
    with pytest.raises(ValueError, match="faces? 0 and face 6 .* overlap"):
        scene.cells(volumes=boxes((low, high), (low, high)))
    with pytest.raises(ValueError, match="give one of them"):
        scene.cells(volumes=rooms, grid=(1, 1, 1))
    with pytest.raises(TypeError, match="volumes is a list"):
        scene.cells(volumes=[rooms])
    with pytest.raises(ValueError, match="most is 0"):
        cells.coarse(0)


def test_each_cell_shows_what_it_sees():
    scene = two_rooms()
    pvs = scene.pvs()
    for cell in list(pvs.visible)[::4]:
        certificate = pvs.certificate(cell)
        assert certificate.verify()
        data = certificate.data
        through = {data["fragments"][entry["fragment"]]["face"] for entry in data["visible"]}
        assert through | set(pvs.cells[cell].faces) == set(pvs.visible[cell])
    with pytest.raises(KeyError):
        pvs.certificate(len(pvs.cells))
    closed = sightline.read(corpus / "cube.off")
    turned = sightline.Scene(closed.points(exact=True), [face[::-1] for face in closed.faces()])
    room = turned.pvs()
    (cell,) = [cell for cell in room.visible if len(room.cells[cell].portals) == 0]
    assert len(room.visible[cell]) == 6
    with pytest.raises(ValueError, match="no portals"):
        room.certificate(cell)


def test_covered_parts_of_walls_are_the_faces():
    cube = sightline.read(corpus / "cube.off")
    cells = cube.cells()
    covered = np.zeros(cube.face_count, object)
    for wall in cells.walls:
        faces = np.union1d(wall.faces_front, wall.faces_behind)
        if wall.behind is None:
            assert wall.open == () and len(faces) == 0  # the end of the world
            continue
        left = size(wall.corners) - sum(size(part) for part in wall.open)
        assert (left > 0) == (len(faces) == 1)
        if left > 0:
            covered[faces[0]] += left
    assert covered.tolist() == [size(part.corners) for part in cube.parts]
    (solid,) = [cell for cell in cells if cell.is_solid]
    assert solid.faces.tolist() == [] and solid.winding == 1 and not solid.is_outside
    assert cells.is_closed and cells.way_out(cells[[i for i in range(len(cells)) if i != solid.id][0]].inside)
    assert cells.at((1000, 0, 0)) is None and cells.way_out(solid.inside) == []


def test_a_room_is_asked_about_and_the_outside_if_one_asks():
    cube = sightline.read(corpus / "cube.off")
    points, corners = cube.points(exact=True), np.array(cube.faces())
    middle = (points.min(axis=0) + points.max(axis=0)) / 2
    V = np.concatenate([points, middle + 3 * (points - middle)])
    shell = sightline.Scene(V, np.concatenate([corners[:, ::-1], corners + len(points)]))  # thick, about a room
    cells, eye, last = shell.cells(), list(middle), len(shell.faces()) // 2
    room = cells.at(eye)
    assert not room.is_solid and not room.is_outside and cells.way_out(eye) == []
    assert room.volume == 1 and sum(cell.volume for cell in cells if cell.is_solid) == 26
    pvs, all_of_them = cells.pvs(), shell.pvs(outside=True)
    assert {cell: seen.tolist() for cell, seen in pvs.visible.items()} == {room.id: list(range(last))}
    assert set(all_of_them.visible) == {cell.id for cell in cells if not cell.is_solid} > {room.id}
    for cell, seen in all_of_them.visible.items():
        assert len(seen) > 0 and (seen < last).all() == (cell == room.id)
    out = [cell for cell in cells if cell.is_outside][0]
    assert cells.way_out(out.inside)[-1].is_outside and pvs.at(out.inside) is None


def test_the_program_says_the_same_of_cells_and_pvs(tmp_path):
    if not program.is_file():
        pytest.skip("the program is not built here")
    file, out, table = corpus / "two_rooms.off", tmp_path / "cells.json", tmp_path / "pvs.json"
    subprocess.run([program, "cells", file, "--out", out], check=True, capture_output=True)
    said, cells = json.loads(out.read_text()), two_rooms().cells()
    points = [tuple(map(Fraction, p)) for p in said["points"]]
    assert len(cells) == len(said["cells"])
    for cell, of in zip(cells, said["cells"]):
        assert (cell.is_solid, cell.is_outside, cell.winding) == (of["solid"], of["outside"], of["winding"])
        assert cell.region == of["region"] and cell.faces.tolist() == of["faces"]
    assert len(cells.walls) == len(said["walls"])
    for wall, of in zip(cells.walls, said["walls"]):
        assert [wall.front, wall.behind] == of["cells"]
        assert list(wall.corners) == [points[i] for i in of["corners"]]
        assert [list(part) for part in wall.open] == [[points[i] for i in part] for part in of["open"]]
        assert [wall.faces_front.tolist(), wall.faces_behind.tolist()] == of["faces"]

    command = [program, "pvs", file, "--cells-too", "--out", table, "--json", out]
    subprocess.run(command, check=True, capture_output=True)
    said, result, pvs = json.loads(table.read_text()), json.loads(out.read_text())["result"], two_rooms().pvs()
    assert [(cell, seen.tolist()) for cell, seen in pvs.visible.items()] == [
        (row["cell"], row["visible"]) for row in said["cells"]
    ]
    assert len(pvs.visible) == result["cells"] and pvs.table().sum() == result["visible"]
    assert sum(map(len, pvs.undecided.values())) == result["undecided"] == 0
    pairs = cells.pairs()
    assert [seen.tolist() for seen in pairs.visible.values()] == [row["cells"] for row in said["cells"]]
    assert sum(map(len, pairs.visible.values())) == 2 * result["pairs_of_cells"]["visible"] > 0


def test_leaves_of_a_compiled_level(tmp_path):
    if not program.is_file():
        pytest.skip("the program is not built here")
    file, out = corpus.parent / "robust" / "tiny_level.bsp", tmp_path / "cells.json"
    subprocess.run([program, "cells", file, "--leaves", "--out", out], check=True, capture_output=True)
    said, level = json.loads(out.read_text()), sightline.read(file)
    cells = level.cells(leaves=True)
    assert [cell.leaf for cell in cells] == [cell["leaf"] for cell in said["cells"]]
    assert len({cell.leaf for cell in cells}) > 1 and {cell.leaf for cell in level.cells()} == {None}
    table = tmp_path / "pvs.json"
    subprocess.run([program, "pvs", file, "--leaves", "--out", table], check=True, capture_output=True)
    pvs = level.pvs(leaves=True)
    assert [(cell, seen.tolist()) for cell, seen in pvs.visible.items()] == [
        (row["cell"], row["visible"]) for row in json.loads(table.read_text())["cells"]
    ]
    with pytest.raises(ValueError, match="give one of them"):
        level.cells(leaves=True, grid=(1, 1, 1))
    copy = tmp_path / "level.bsp"
    copy.write_bytes(file.read_bytes())
    other = sightline.read(copy)
    assert len(other.cells(leaves=True)) == len(cells)
    bytes_of = bytearray(copy.read_bytes())
    vertices = int.from_bytes(bytes_of[28:32], "little")  # the third lump
    bytes_of[vertices : vertices + 4] = np.float32(77).tobytes()
    copy.write_bytes(bytes_of)
    with pytest.raises(ValueError, match="no longer what was read"):
        other.cells(leaves=True)
    for scene in (two_rooms(), sightline.Scene([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])):
        with pytest.raises(ValueError, match="compiled"):
            scene.pvs(leaves=True)


@pytest.mark.parametrize("grid", [None, (2, 2, 1)])
def test_a_cell_sees_what_eyes_in_it_see(grid):
    scene = two_rooms()
    pvs = scene.pvs(grid=grid)
    table = pvs.table()
    assert len(pvs.visible) > 3 and not table.all()
    for cell in pvs.cells:
        if cell.id not in pvs.visible:
            continue
        assert set(cell.faces.tolist()) <= set(pvs.at(cell.inside).tolist())
        corner = cell.walls[0].corners[0]
        for share in (Fraction(0), Fraction(9, 10)):  # the middle, and near a corner
            eye = [(1 - share) * a + share * b for a, b in zip(cell.inside, corner)]
            assert table[cell.id, scene.see(eye).visible].all()
    assert pvs.at((1000, 1000, 1000)) is None
    pairs = pvs.cells.pairs()
    assert pairs.visible.keys() == pvs.visible.keys() and not any(map(len, pairs.undecided.values()))
    for wall in pvs.cells.walls:
        if wall.open and {wall.front, wall.behind} <= pairs.visible.keys():
            assert wall.behind in pairs.visible[wall.front] and wall.front in pairs.visible[wall.behind]
    for cell, seen in pairs.visible.items():
        assert all(cell in pairs.visible[other] for other in seen) and cell not in seen
    for cell in pvs.cells[:3]:
        assert pvs.cells[cell.id - len(pvs.cells)].id == cell.id


def test_what_is_no_level_is_refused():
    scene = two_rooms()
    for grid in ((0, 1, 1), (1, 1), "1,1,1", (1000, 1000, 1000)):
        with pytest.raises(ValueError, match="grid"):
            scene.cells(grid=grid)
    with pytest.raises(TypeError):
        scene.cells(grid=(1.5, 1, 1))
    with pytest.raises(ValueError, match="candidates"):
        scene.cells(candidates=0)
    with pytest.raises(ValueError, match="along z"):
        sightline.Scene([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]).cells(grid=(1, 1, 2))
    with pytest.raises(IndexError):
        scene.cells()[10000]
    with pytest.raises(sightline.OutOfBudget):
        scene.cells(budget=1e-9)
    assert sum(map(len, scene.pvs(threads=1).undecided.values())) == 0
    assert sum(map(len, scene.cells().pvs(budget=1e-9).undecided.values())) > 0
    empty = sightline.Scene(np.zeros((0, 3)), np.zeros((0, 3), int)).pvs()
    assert len(empty.cells) == 1 and [len(seen) for seen in empty.visible.values()] in ([], [0])
