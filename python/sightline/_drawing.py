"""Pictures by matplotlib, where it is there."""

import importlib
from typing import TYPE_CHECKING, Any, Dict, Sequence

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from ._answers import Parts
    from ._scene import Scene


def _axes(ax: Any) -> Any:
    try:
        pyplot = importlib.import_module("matplotlib.pyplot")
    except ImportError as error:
        raise ImportError("plot() needs the package matplotlib (Debian: python3-matplotlib)") from error
    return ax if ax is not None else pyplot.figure().add_subplot(projection="3d")


def _add(ax: Any, polygons: Sequence[NDArray[np.float64]], colors: Any, style: Dict[str, Any]) -> Any:
    art3d = importlib.import_module("mpl_toolkits.mplot3d.art3d")
    look = {"edgecolors": "black", "linewidths": 0.3, "facecolors": colors, **style}
    ax.add_collection3d(art3d.Poly3DCollection(polygons, **look))
    return ax


def _fit(ax: Any, points: NDArray[np.float64]) -> None:
    if len(points) == 0:
        return
    low, high = points.min(axis=0), points.max(axis=0)
    for k, set_limits in enumerate((ax.set_xlim, ax.set_ylim, ax.set_zlim)):
        set_limits(low[k], high[k] if high[k] > low[k] else low[k] + 1)
    ax.set_box_aspect(np.maximum(high - low, 0.05 * (high - low).max() or 1))


def draw_parts(parts: "Parts", ax: Any, style: Dict[str, Any]) -> Any:
    """Parts, coloured by face."""
    ax = _axes(ax)
    points, starts = parts.points()
    colors = importlib.import_module("matplotlib").colormaps["tab20"](parts.faces % 20)
    _add(ax, np.split(points, starts[1:-1]) if len(parts) else [], colors, style)
    _fit(ax, points)
    return ax


def draw_faces(scene: "Scene", groups: Dict[str, NDArray[np.int64]], ax: Any, style: Dict[str, Any]) -> Any:
    """The faces of a scene, each group in its colour."""
    ax = _axes(ax)
    points, starts = scene.parts.points()
    polygons = np.split(points, starts[1:-1]) if len(starts) > 1 else []
    faces = scene.parts.faces
    for color, ids in groups.items():
        chosen = np.flatnonzero(np.isin(faces, ids))
        if len(chosen):
            _add(ax, [polygons[i] for i in chosen], color, style)
    _fit(ax, points)
    return ax
