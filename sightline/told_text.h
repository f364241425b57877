#pragma once
// Text of a certificate, which may be given up while it is written.

#include <sightline/sightline.h>

#include <atomic>
#include <cstddef>
#include <ios>
#include <ostream>
#include <sstream>
#include <string>
#include <utility>

namespace sightline {

/// Text that calls a progress each time that some thousands of pieces more have been written: with what the steps
/// before told last, at first 0 of 1, since how long it will be is not known.
class Told_text : public std::stringbuf {
 public:
  explicit Told_text(const Asking::Progress& progress) : progress_(progress) { tell_again(); }

  /// For the steps that have a count of their own; empty where the progress is.
  Asking::Progress of_steps() {
    if (!progress_) return {};
    return [this](std::size_t done, std::size_t all) {
      done_ = done;
      all_ = all;
      progress_(done, all);
    };
  }

 protected:
  std::streamsize xsputn(const char* text, std::streamsize size) override {
    constexpr std::size_t often = 4096;
    if (++pieces_ % often == 0) tell_again();
    return std::stringbuf::xsputn(text, size);
  }

 private:
  void tell_again() const {
    if (progress_) progress_(done_, all_);
  }

  const Asking::Progress progress_;
  std::size_t pieces_ = 0;
  std::atomic<std::size_t> done_ = 0, all_ = 1;
};

/// What write(stream, progress of its steps) writes. Errors: what that and `progress` throw.
template <class Write>
std::string told_text(const Asking::Progress& progress, const Write& write) {
  Told_text text(progress);
  std::ostream out(&text);
  out.exceptions(std::ios::badbit);  // by which what the progress throws comes out of the stream
  write(out, text.of_steps());
  return std::move(text).str();
}

}  // namespace sightline
