#pragma once
// What a Model keeps, made when it is first asked for: the sources of the front door share it.

#include <sightline/algorithms/bsp/tree.h>
#include <sightline/algorithms/point_visibility/visible.h>
#include <sightline/algorithms/rays/tracer.h>
#include <sightline/algorithms/weak_visibility/occluders.h>
#include <sightline/kernel/threads.h>
#include <sightline/kernel/traits/exact_traits.h>
#include <sightline/sightline.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace sightline {

/// Errors: std::out_of_range where there is no such face.
void require_face(Face_id face, std::size_t count);

/// What is made once, when it is first asked for.
template <class T>
class Once {
 public:
  /// The thread that asks first makes it. Others wait, and call waiting(0, 1) now and then: what that throws ends their
  /// wait. Where making it throws, the next one that asks, or waits, makes it.
  template <class Make>
  const T& get(const Make& make, const Asking::Progress& waiting = {}) const {
    if (!is_made_.load(std::memory_order_acquire)) wait_or_make(make, waiting);
    return *value_;
  }

 private:
  template <class Make>
  void wait_or_make(const Make& make, const Asking::Progress& waiting) const {
    std::unique_lock lock(mutex_);
    while (!end_.wait_for(lock, std::chrono::milliseconds(10), [&] { return !is_being_made_; })) {
      if (!waiting) continue;
      lock.unlock();
      waiting(0, 1);
      lock.lock();
    }
    if (is_made_) return;
    is_being_made_ = true;
    lock.unlock();
    const auto end = [&](bool is_made) {
      lock.lock();
      is_being_made_ = false;
      is_made_.store(is_made, std::memory_order_release);
      lock.unlock();
      end_.notify_all();
    };
    try {
      in_isolation([&] { value_.reset(new T(make())); });  // where it is made it stays
    } catch (...) {
      end(false);
      throw;
    }
    end(true);
  }

  mutable std::mutex mutex_;
  mutable std::condition_variable end_;  // of making it, one way or the other
  mutable bool is_being_made_ = false;
  mutable std::atomic<bool> is_made_ = false;
  mutable std::unique_ptr<T> value_;
};

/// The soup as it was read, the scene of it, and what questions share. Any thread may ask for any of it.
struct Model::Inside {
  explicit Inside(Polygon_soup from) : soup(std::move(from)) {}

  // `waiting` is the progress of a question, within its budget, as Once has it.

  /// Errors: as Scene(), each time that it is asked for.
  const Scene& scene(const Asking::Progress& waiting = {}) const {
    return scene_.get([&] { return Scene(soup); }, waiting);
  }
  const Exact_traits& traits(const Asking::Progress& waiting = {}) const {
    return traits_.get([&] { return Exact_traits(scene(waiting)); }, waiting);
  }
  const std::vector<Left_out>& left_out() const;
  const std::vector<Part>& parts() const;
  Part part(const Piece& piece) const;
  const Bsp_tree<Exact_traits>& tree(int threads, const Asking::Progress& progress) const;
  const Piece_boxes& boxes(const Asking::Progress& waiting = {}) const {
    return boxes_.get([&] { return Piece_boxes(scene(waiting)); }, waiting);
  }
  const Occluders& occluders(const Asking::Progress& waiting = {}) const {
    return occluders_.get([&] { return Occluders(scene(waiting)); }, waiting);
  }
  const Ray_tracer& tracer(const Asking::Progress& waiting = {}) const {
    return tracer_.get([&] { return Ray_tracer(scene(waiting)); }, waiting);
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
