// The subject `io` of sightline fuzz.

#include "fuzz.h"

#include <sightline/io/read.h>
#include <sightline/io/write.h>
#include <sightline/io/exact_text.h>

#include <sstream>

namespace sightline::app {

namespace {

/// What differs between two soups, or nothing: the points of each loop of each face, in order.
std::string difference(const Polygon_soup& a, const Polygon_soup& b) {
  if (a.face_count() != b.face_count())
    return std::to_string(b.face_count()) + " faces, not " + std::to_string(a.face_count());
  for (Face_id f = 0; f < a.face_count(); ++f) {
    if (a.loop_count(f) != b.loop_count(f)) return harness::face_name(f) + " has another number of loops";
    for (std::size_t k = 0; k < a.loop_count(f); ++k) {
      const auto own = a.loop(f, k), other = b.loop(f, k);
      if (own.size() != other.size()) return harness::face_name(f) + " has another number of corners";
      for (std::size_t c = 0; c < own.size(); ++c)
        if (a.point(own[c]) != b.point(other[c]))
          return harness::face_name(f) + ", corner " + std::to_string(c) + ": another point";
    }
  }
  return {};
}

harness::Outcome round_trip(const Polygon_soup& soup, Format format) {
  std::stringstream stream;
  try {
    write_scene(soup, stream, format);
  } catch (const Not_representable&) {
    return harness::Outcome::not_applicable();
  }
  const std::string what = difference(soup, read_scene(stream.str(), format, "round trip"));
  return what.empty() ? harness::Outcome{} : harness::Outcome::failed(what);
}

/// Nothing is asked of faces: formats are compared with the scene itself.
harness::Answer nothing(const generate::Posed_scene& posed) {
  harness::Answer answer;
  answer.labels.assign(posed.soup.face_count(), harness::Answer::none);
  return answer;
}

}  // namespace

harness::Subject io_subject() {
  harness::Subject subject;
  subject.name = "io";
  subject.what = "scenes written and read again in every format";
  subject.answer = nothing;
  const auto add = [&](const char* name, Format format) {
    subject.checks.push_back({name, std::string("the same scene from ") + name,
                              [format](const generate::Posed_scene& posed, const harness::Answer&, generate::Random&) {
                                return round_trip(posed.soup, format);
                              }});
  };
  add("qoff", Format::qoff);
  add("off", Format::off);
  add("obj", Format::obj);
  add("ply", Format::ply);
  add("binary ply", Format::ply_binary);
  add("stl", Format::stl);
  return subject;
}

}  // namespace sightline::app
