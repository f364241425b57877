"""Pictures by matplotlib, where it is there: polygons in perspective, one painted over another in an exact order."""

import importlib
from typing import TYPE_CHECKING, Any, Dict, List, Tuple

import numpy as np
from numpy.typing import NDArray

from ._arrays import rounded_point

if TYPE_CHECKING:
    from ._answers import Parts, View
    from ._scene import Scene

Doubles = NDArray[np.float64]
Polygons = List[Doubles]


def _axes(ax: Any) -> Any:
    try:
        pyplot = importlib.import_module("matplotlib.pyplot")
    except ImportError as error:
        raise ImportError("plot() needs the package matplotlib (Debian: python3-matplotlib)") from error
    ax = pyplot.figure(figsize=(8, 6)).add_axes((0, 0, 1, 1)) if ax is None else ax
    ax.set_aspect("equal")
    ax.set_axis_off()
    return ax


def _polygons(parts: "Parts") -> Polygons:
    points, starts = parts.points()
    return np.split(points, starts[1:-1]) if len(parts) else []


def _unit(v: Doubles) -> Doubles:
    length: np.float64 = np.linalg.norm(v)
    unit: Doubles = v / length if length > 0 else v
    return unit


def _normal(polygon: Doubles) -> Doubles:
    return _unit(np.cross(polygon - polygon[0], np.roll(polygon, -1, axis=0) - polygon[0]).sum(axis=0))


def _in_front(polygon: Doubles, depth: Doubles, near: float) -> Doubles:
    """What of a polygon is deeper than `near`."""
    kept = []
    for i, j in zip(range(len(polygon)), [*range(1, len(polygon)), 0]):
        if depth[i] >= near:
            kept.append(polygon[i])
        if (depth[i] < near) != (depth[j] < near):
            kept.append(polygon[i] + (polygon[j] - polygon[i]) * (near - depth[i]) / (depth[j] - depth[i]))
    return np.array(kept).reshape(-1, 3)


def _paint(ax: Any, polygons: Polygons, colors: Doubles, eye: Doubles, style: Dict[str, Any]) -> Any:
    """Polygons one over the other, as the eye sees them that looks to their middle; the light is behind it."""
    corners = np.concatenate(polygons) if polygons else np.zeros((0, 3))
    middle = (corners.min(axis=0) + corners.max(axis=0)) / 2 if len(corners) else eye
    to = _unit(middle - eye) if np.any(middle != eye) else np.array([0.0, 1.0, 0.0])
    right = _unit(np.cross(to, [0.0, 0.0, 1.0] if abs(to[2]) < 0.99 else [0.0, 1.0, 0.0]))
    frame = np.stack([right, np.cross(right, to), to])
    near = 0.02 * float(np.linalg.norm(corners - eye, axis=1).max()) if len(corners) else 1.0
    flat, looks = [], []
    for polygon, color in zip(polygons, colors):
        seen = (_in_front(polygon, (polygon - eye) @ to, near) - eye) @ frame.T
        if len(seen) < 3:
            continue
        flat.append(seen[:, :2] / seen[:, 2:])
        looks.append(color[:3] * (0.65 + 0.35 * abs(_normal(polygon) @ _unit(to + 0.5 * right - 0.3 * frame[1]))))
    PolyCollection = importlib.import_module("matplotlib.collections").PolyCollection
    ax.add_collection(PolyCollection(flat, **{"facecolors": looks, "edgecolors": "black", "linewidths": 0.3, **style}))
    ax.autoscale_view()
    return ax


def draw_view(view: "View", ax: Any, style: Dict[str, Any]) -> Any:
    """What an eye sees, coloured by face."""
    ax = _axes(ax)
    colors = importlib.import_module("matplotlib").colormaps["tab20"](view.parts.faces % 20)
    return _paint(ax, _polygons(view.parts), colors, rounded_point(view.eye), style)


def _outside(scene: "Scene") -> Doubles:
    """An eye from which all of a scene is in view."""
    box = scene.info()["box"]
    low, high = np.array(box if box is not None else [(0, 0, 0), (1, 1, 1)], dtype=float)
    eye: Doubles = (low + high) / 2 + (high - low).max() * np.array([-0.6, -1.1, 1.1])
    return eye


def draw_faces(scene: "Scene", groups: Dict[str, NDArray[np.int64]], eye: Any, ax: Any, style: Dict[str, Any]) -> Any:
    """The fronts of faces, each group in its colour, in the exact order in which a painter paints them."""
    ax = _axes(ax)
    at = _outside(scene) if eye is None else rounded_point(eye)
    order = scene.order(at).parts
    to_rgb = importlib.import_module("matplotlib.colors").to_rgb
    of_face = np.ones((scene.face_count, 3))
    for color, faces in groups.items():
        of_face[faces] = to_rgb(color)
    chosen: List[Tuple[Doubles, Doubles]] = [
        (polygon, of_face[face])
        for polygon, face in zip(_polygons(order), order.faces)
        if _normal(polygon) @ (at - polygon[0]) > 0
    ]
    return _paint(ax, [polygon for polygon, _ in chosen], np.array([color for _, color in chosen]), at, style)
