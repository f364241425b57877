#pragma once
// What the program asks of MPI: messages between the processes that mpirun started. It stands in a module of its own,
// which is loaded where there are several, so that a program that is started alone loads no MPI.

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace sightline::app {

struct Message {
  std::uint32_t from;  ///< a rank
  std::string bytes;
};

/// The processes that were started together, by rank. One thread calls.
class Messages {
 public:
  virtual ~Messages() = default;
  virtual std::uint32_t rank() const = 0;
  virtual std::uint32_t size() const = 0;
  /// Errors: std::length_error for 2^31 bytes and more. What MPI itself cannot do ends all processes, with its words.
  virtual void send(std::uint32_t to, std::string_view bytes) = 0;
  /// The next message of whoever it is; those of one sender come in their order. Waits without keeping a processor
  /// busy, and calls `meanwhile` some hundred times a second.
  virtual Message receive(const std::function<void()>& meanwhile) = 0;
  /// Says that there are no more. Waits until all have said so.
  virtual void end() = 0;
};

}  // namespace sightline::app

/// Begins MPI: the module's one symbol. Called once; what it returns lives to the end of the program.
extern "C" sightline::app::Messages* sightline_messages();
