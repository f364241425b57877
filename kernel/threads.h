#pragma once
// Threads, in one place: how many work on something, and how work is shared out. oneTBB does it, and stays in the
// source.

#include <cstddef>
#include <functional>
#include <memory>

namespace sightline {

/// Runs work whose tasks get that many threads, also where there are fewer processors. 0: as many as there are
/// processors. Errors: what the work throws.
void run_with_threads(int threads, const std::function<void()>& work);

/// Calls body(i) for each i from 0 to before `count`, in any order, on the threads of run_with_threads(). Cost: for
/// bodies that take a microsecond or more. Errors: what a body throws; bodies that have not begun are left out then. Of
/// work within work that is given up no part counts as done: it ends in an exception of its own, of which only that of
/// the outer work comes out.
void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body);

/// Does both, one of them perhaps in another thread. Errors: as parallel_for().
void parallel_invoke(const std::function<void()>& one, const std::function<void()>& other);

/// Does work that waits for tasks of its own: the thread takes up no others meanwhile, which might ask for what it is
/// making.
void in_isolation(const std::function<void()>& work);

/// Tasks that may start more tasks, and an end to wait for.
class Task_group {
 public:
  Task_group();
  ~Task_group();
  Task_group(const Task_group&) = delete;
  Task_group& operator=(const Task_group&) = delete;

  void run(std::function<void()> task);
  /// Runs a task here, then waits for all. Errors: as parallel_for().
  void run_and_wait(const std::function<void()>& task);

 private:
  struct Tasks;
  std::unique_ptr<Tasks> tasks_;
};

/// A place for each thread, empty until the thread asks for it.
class Thread_slots {
 public:
  Thread_slots();
  ~Thread_slots();
  Thread_slots(Thread_slots&&) noexcept;
  Thread_slots& operator=(Thread_slots&&) noexcept;

  std::shared_ptr<void>& local();
  /// Pre: no thread asks for its place meanwhile.
  void for_each(const std::function<void(std::shared_ptr<void>&)>& f);

 private:
  struct Slots;
  std::unique_ptr<Slots> slots_;
};

/// An object of its own for each thread, made when the thread first asks for it.
template <class T>
class Per_thread {
 public:
  T& local() {
    std::shared_ptr<void>& slot = slots_.local();
    if (!slot) slot = std::make_shared<T>();
    return *static_cast<T*>(slot.get());
  }
  /// Pre: no thread asks for its object meanwhile.
  template <class Function>
  void for_each(Function f) {
    slots_.for_each([&](std::shared_ptr<void>& slot) { f(*static_cast<T*>(slot.get())); });
  }

 private:
  Thread_slots slots_;
};

}  // namespace sightline
