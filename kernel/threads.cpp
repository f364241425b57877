#include <sightline/kernel/threads.h>

#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_invoke.h>
#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/task_group.h>

#include <array>
#include <atomic>
#include <exception>
#include <memory>
#include <optional>
#include <utility>

namespace sightline {

namespace tbb = oneapi::tbb;

namespace {

/// Work within work that is given up. oneTBB leaves out what has not begun of the inner work and goes on behind it, as
/// if it were done; the exception that ends the outer work is on its way already, and this one is lost in it.
struct Given_up : std::exception {
  const char* what() const noexcept override { return "the work around this one is given up"; }
};

void require_whole(tbb::task_group_context& context) {
  if (context.is_group_execution_cancelled()) throw Given_up();
}

/// What tasks of so many threads run in.
struct Arena {
  int threads;
  tbb::task_arena tasks;
};

/// Arenas in which nothing runs, to be used again: oneTBB 2021.8 never gives back the memory of one that a second
/// thread was in, some 7 kB. Without locks, so that a process that is forked meanwhile has them too.
class Idle_arenas {
 public:
  std::unique_ptr<Arena> take(int threads) {
    for (std::atomic<Arena*>& place : places_) {
      std::unique_ptr<Arena> arena(place.exchange(nullptr));
      if (arena && arena->threads == threads) return arena;
      give(std::move(arena));
    }
    return std::unique_ptr<Arena>(
        new Arena{threads, tbb::task_arena(threads > 0 ? threads : tbb::task_arena::automatic)});
  }
  /// Where all places are taken, it ends.
  void give(std::unique_ptr<Arena> arena) {
    for (std::atomic<Arena*>& place : places_) {
      Arena* nothing = nullptr;
      if (arena && place.compare_exchange_strong(nothing, arena.get())) static_cast<void>(arena.release());
    }
  }

 private:
  std::array<std::atomic<Arena*>, 64> places_{};
};

constinit Idle_arenas idle_arenas;  // never destroyed: threads may work until the process ends

}  // namespace

void run_with_threads(int threads, const std::function<void()>& work) {
  std::optional<tbb::global_control> more;
  if (threads > tbb::info::default_concurrency())
    more.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  struct Borrowed {
    std::unique_ptr<Arena> arena;
    ~Borrowed() { idle_arenas.give(std::move(arena)); }
  } borrowed{idle_arenas.take(threads)};
  borrowed.arena->tasks.execute([&] { work(); });
}

void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body) {
  tbb::task_group_context context;
  tbb::parallel_for(
      std::size_t{0}, count, [&](std::size_t i) { body(i); }, context);
  require_whole(context);
}

void parallel_invoke(const std::function<void()>& one, const std::function<void()>& other) {
  tbb::task_group_context context;
  tbb::parallel_invoke([&] { one(); }, [&] { other(); }, context);
  require_whole(context);
}

void in_isolation(const std::function<void()>& work) {
  tbb::this_task_arena::isolate([&] { work(); });
}

struct Task_group::Tasks {
  tbb::task_group group;
};
Task_group::Task_group() : tasks_(std::make_unique<Tasks>()) {}
Task_group::~Task_group() = default;
void Task_group::run(std::function<void()> task) { tasks_->group.run(std::move(task)); }
void Task_group::run_and_wait(const std::function<void()>& task) {
  if (tasks_->group.run_and_wait([&] { task(); }) == tbb::task_group_status::canceled) throw Given_up();
}

struct Thread_slots::Slots {
  tbb::enumerable_thread_specific<std::shared_ptr<void>> all;
};
Thread_slots::Thread_slots() : slots_(std::make_unique<Slots>()) {}
Thread_slots::~Thread_slots() = default;
Thread_slots::Thread_slots(Thread_slots&&) noexcept = default;
Thread_slots& Thread_slots::operator=(Thread_slots&&) noexcept = default;
std::shared_ptr<void>& Thread_slots::local() { return slots_->all.local(); }
void Thread_slots::for_each(const std::function<void(std::shared_ptr<void>&)>& f) {
  for (std::shared_ptr<void>& slot : slots_->all) f(slot);
}

}  // namespace sightline
