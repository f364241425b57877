// The module sightline_mpi: messages by MPI, whose C interface alone it uses.

#include "messages.h"

#include <mpi.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <stdexcept>
#include <thread>

namespace sightline::app {
namespace {

class Mpi_messages final : public Messages {
 public:
  Mpi_messages() { MPI_Init(nullptr, nullptr); }
  std::uint32_t rank() const override {
    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    return static_cast<std::uint32_t>(rank);
  }
  std::uint32_t size() const override {
    int size = 0;
    MPI_Comm_size(MPI_COMM_WORLD, &size);
    return static_cast<std::uint32_t>(size);
  }
  void send(std::uint32_t to, std::string_view bytes) override {
    if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
      throw std::length_error("an answer of 2^31 bytes and more, which no message holds; divide by --shard instead");
    MPI_Send(bytes.data(), static_cast<int>(bytes.size()), MPI_BYTE, static_cast<int>(to), 0, MPI_COMM_WORLD);
  }
  Message receive(const std::function<void()>& meanwhile) override {
    // MPI's own waiting takes a processor; units of work take much longer than these pauses.
    MPI_Status status;
    for (std::chrono::microseconds pause{20};; pause = std::min(2 * pause, std::chrono::microseconds{2000})) {
      int is_there = 0;
      MPI_Iprobe(MPI_ANY_SOURCE, 0, MPI_COMM_WORLD, &is_there, &status);
      if (is_there != 0) break;
      meanwhile();
      std::this_thread::sleep_for(pause);
    }
    int size = 0;
    MPI_Get_count(&status, MPI_BYTE, &size);
    Message message{static_cast<std::uint32_t>(status.MPI_SOURCE), std::string(static_cast<std::size_t>(size), '\0')};
    MPI_Recv(message.bytes.data(), size, MPI_BYTE, status.MPI_SOURCE, 0, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    return message;
  }
  void end() override { MPI_Finalize(); }
};

}  // namespace
}  // namespace sightline::app

extern "C" sightline::app::Messages* sightline_messages() {
  static sightline::app::Mpi_messages messages;
  return &messages;
}
