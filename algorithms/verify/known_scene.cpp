#include <sightline/algorithms/verify/known_scene.h>

#include <algorithm>

namespace sightline::weak_check {

static std::vector<Outward_box> boxes_of(const std::vector<Order_fragment>& fragments) {
  std::vector<Outward_box> boxes;
  for (const Order_fragment& fragment : fragments) boxes.emplace_back(fragment.vertices);
  return boxes;
}

Known_scene::Known_scene(const Polygon_soup& soup, const Covering& covering, const Workers& workers)
    : covering_(covering), covered_(check_covering(soup, covering, workers)), boxes_(boxes_of(covering.fragments)) {
  for (const Order_fragment& fragment : covering.fragments) {
    workers.ask();
    outlines_.emplace_back(fragment.vertices);
  }
}

bool Known_scene::is_of(const Covering& other) const {
  const auto same_part = [](const auto& a, const auto& b) {
    return a.face == b.face && a.piece == b.piece && a.vertices == b.vertices;
  };
  const auto same_reason = [](const Covering::Set_aside& a, const Covering::Set_aside& b) {
    return a.face == b.face && a.why == b.why;
  };
  return std::equal(covering_.fragments.begin(), covering_.fragments.end(), other.fragments.begin(),
                    other.fragments.end(), same_part) &&
         std::equal(covering_.pieces.begin(), covering_.pieces.end(), other.pieces.begin(), other.pieces.end(),
                    same_part) &&
         std::equal(covering_.set_aside.begin(), covering_.set_aside.end(), other.set_aside.begin(),
                    other.set_aside.end(), same_reason);
}

}  // namespace sightline::weak_check
