#include <sightline/harness/generate/weak_scenes.h>

#include <sightline/harness/generate/polygons.h>
#include <sightline/harness/generate/weak_neighbours.h>
#include <sightline/harness/generate/weak_shafts.h>
#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/scene/scene.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace sightline::generate::weak_drafts {

Weak_scene finished(Draft draft, Random& random) {
  // What changes nothing: source and target in each other's place, occluders turned, more of them before what is hidden
  // anyway.
  if (!draft.bodies && draft.targets.size() == 1 && random.chance(1, 3))
    std::swap(draft.source, draft.faces[draft.targets[0]]);
  std::vector<std::size_t> order;
  for (std::size_t k = 0; k < draft.faces.size(); ++k) {
    order.push_back(k);
    if (!draft.bodies && std::count(draft.targets.begin(), draft.targets.end(), k) == 0)
      draft.faces[k] = either_way(draft.faces[k], random);
  }
  Faces extra;
  add_any(extra, random.below(3), random);
  const bool add_extra = random.chance(1, 3), add_source = !draft.bodies && random.chance(1, 4);
  random.shuffle(order);
  Faces faces;
  Weak_scene scene;
  for (const std::size_t k : order) {
    if (std::count(draft.targets.begin(), draft.targets.end(), k) > 0)
      scene.targets.push_back(static_cast<Face_id>(faces.size()));
    faces.push_back(draft.faces[k]);
  }
  if (add_extra && draft.truth == false) add(faces, extra);
  if (add_source) faces.push_back(draft.source);
  scene.soup = soup_of(faces);
  scene.source = draft.source;
  scene.truth = draft.truth;
  const Scene read(scene.soup);
  for (const Set_aside& face : read.set_aside()) std::erase(scene.targets, face.face);
  switch (random.below(5)) {
    case 0: return scene;
    case 1: return project(scene, random_axes(random));
    case 2: return project(scene, random_rotation(random));
    case 3: return project(scene, random_shear(random));
    default: return project(scene, random_projection(scene, random));
  }
}

const std::array<Drafter, 18> drafters{
    {Drafter{"shared_edges", "triangles around a point that close a shaft and share all their edges", shared_edges},
     Drafter{"cracks", "two slopes that meet in a ridge, cut across at places of their own: edges shared in part",
             cracks},
     Drafter{"t_junctions", "a square cut again and again, each cut across one piece", t_junctions},
     Drafter{"coplanar_overlap", "strips in one plane that overlap, up to a seam in which they touch",
             coplanar_overlap},
     Drafter{"slats", "parallel edges in one plane with an edge of the source, plates on either side", slats},
     Drafter{"edges_in_one_plane", "edges in one plane, not parallel, plates on either side", edges_in_one_plane},
     Drafter{"concurrent_edges", "plates with edges through one point", concurrent_edges},
     Drafter{"regulus", "plates on four rulings of a regulus", regulus},
     Drafter{"tangent", "plates on three rulings and on a line that is tangent to their regulus: a double root",
             tangent},
     Drafter{"five_edges", "plates on five edges that one line meets", five_edges},
     Drafter{"apertures", "plates with slits and holes of width 2^-1 to 2^-60 around one line, one of them closed",
             apertures},
     Drafter{"hinged", "source and target share an edge or a corner, a plate between them", hinged},
     Drafter{"facing", "planes of source and target that cut the other polygon or touch it", facing},
     Drafter{"lids", "lids in the planes of source and target", lids},
     Drafter{"valley", "two slopes that start from a line across the source and cover it", valley},
     Drafter{"boxes", "boxes on boxes, in boxes, beside boxes; the source is one of their faces", boxes},
     Drafter{"lattice_faces", "anything on a small lattice, source and targets included; one face moved by K ulps",
             lattice_faces},
     Drafter{"triangles", "triangles between two squares, one of them moved by K ulps", triangles}}};

}  // namespace sightline::generate::weak_drafts
