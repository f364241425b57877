"""From a mesh to a picture of what a window sees."""

from types import SimpleNamespace

import sightline

V, F, _ = sightline.generate("city_rotated", size=25, seed=4).scene.parts.triangles()
mesh = SimpleNamespace(vertices=V, faces=F)  # or trimesh.load("town.obj")
town = sightline.Scene(mesh)
window = [[-1, 2, 0.2], [-1, 3, 0.2], [-1, 3, 0.6], [-1, 2, 0.6]]  # counterclockwise from where it looks to
seen = town.weakly_visible(window)
print(seen, "proved" if seen.certificate().verify() else "wrong")
seen.plot(eye=(7, -6, 7)).figure.savefig("window.png")
