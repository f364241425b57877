#pragma once
// What a Model keeps, made when it is first asked for: the sources of the front door share it.

#include <sightline/algorithms/bsp/tree.h>
#include <sightline/algorithms/point_visibility/visible.h>
#include <sightline/algorithms/rays/tracer.h>
#include <sightline/algorithms/weak_visibility/occluders.h>
#include <sightline/kernel/threads.h>
#include <sightline/kernel/traits/exact_traits.h>
#include <sightline/sightline.h>

#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

namespace sightline {

/// What is made once, when it is first asked for.
template <class T>
class Once {
 public:
  template <class Make>
  const T& get(const Make& make) const {
    std::call_once(flag_, [&] { in_isolation([&] { value_.reset(new T(make())); }); });  // where it is made it stays
    return *value_;
  }

 private:
  mutable std::once_flag flag_;
  mutable std::unique_ptr<T> value_;
};

/// The soup as it was read, the scene of it, and what questions share. Any thread may ask for any of it.
struct Model::Inside {
  explicit Inside(Polygon_soup from) : soup(std::move(from)) {}

  /// Errors: as Scene(), each time that it is asked for.
  const Scene& scene() const {
    return scene_.get([&] { return Scene(soup); });
  }
  const Exact_traits& traits() const {
    return traits_.get([&] { return Exact_traits(scene()); });
  }
  const std::vector<Left_out>& left_out() const;
  const std::vector<Part>& parts() const;
  Part part(const Piece& piece) const;
  const Bsp_tree<Exact_traits>& tree(const Asking& asking) const;
  const Piece_boxes& boxes() const {
    return boxes_.get([&] { return Piece_boxes(scene()); });
  }
  const Occluders& occluders() const {
    return occluders_.get([&] { return Occluders(scene()); });
  }
  const Ray_tracer& tracer() const {
    return tracer_.get([&] { return Ray_tracer(scene()); });
  }
  const Facts& facts() const;

  const Polygon_soup soup;

 private:
  Once<Scene> scene_;
  Once<Exact_traits> traits_;
  Once<std::vector<Left_out>> left_out_;
  Once<std::vector<Part>> parts_;
  Once<Bsp_tree<Exact_traits>> tree_;
  Once<Piece_boxes> boxes_;
  Once<Occluders> occluders_;
  Once<Ray_tracer> tracer_;
  Once<Facts> facts_;
};

}  // namespace sightline
