#pragma once
// Certificates as JSON text, written as a stream. certificate_json.h reads it.

#include <sightline/algorithms/verify/along.h>
#include <sightline/algorithms/verify/covering.h>
#include <sightline/algorithms/verify/graph.h>
#include <sightline/algorithms/verify/order.h>
#include <sightline/algorithms/verify/visible.h>
#include <sightline/algorithms/verify/weak.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <span>
#include <string>
#include <vector>

namespace sightline {

/// Writes the certificate as one line of JSON: numbers as strings "p" or "p/q", the vertices of fragments and pieces by
/// their places in a table, where each point is once. Post: read_certificate() gives the certificate back. Errors: none
/// of its own; the stream has its state. Exact: yes
void write_certificate(std::ostream& out, const Order_certificate& certificate);

/// The same for a graph.
void write_certificate(std::ostream& out, const Graph_certificate& certificate);

/// The same for what an eye sees.
void write_certificate(std::ostream& out, const Visible_certificate& certificate);

/// The same for weak visibility. Pre: each node is of a kind that there is.
void write_certificate(std::ostream& out, const Weak_certificate& certificate);

/// The same for what an eye sees on its way.
void write_certificate(std::ostream& out, const Along_certificate& certificate);

/// The text that write_certificate() writes.
template <class Any>
std::string certificate_text(const Any& certificate);
extern template std::string certificate_text(const Order_certificate&);
extern template std::string certificate_text(const Graph_certificate&);
extern template std::string certificate_text(const Visible_certificate&);
extern template std::string certificate_text(const Weak_certificate&);
extern template std::string certificate_text(const Along_certificate&);

/// Writes a certificate of what an eye sees piece by piece, for who does not want to hold it: everything that comes
/// before its rays; each ray, which gets the next number from 0; each part; each empty cone; finish(). Pre: in this
/// order; rays are not zero, and are numbered before they are named.
class Visible_certificate_writer {
 public:
  Visible_certificate_writer(std::ostream& out, const Covering& scene, const Exact_point& eye,
                             const Visible_certificate::Directions& field);
  void ray(const Exact_point& direction);
  void part(std::size_t fragment, std::span<const std::uint32_t> rays);
  void part(std::size_t fragment, const std::vector<Exact_point>& vertices, const Exact_point& ray);
  void empty(std::span<const std::uint32_t> rays);
  void empty(const Visible_certificate::Directions& rays);
  void finish();

 private:
  enum class Stage { rays, parts, empty };
  void go_to(Stage stage);
  void begin_entry(Stage stage);
  std::ostream& out_;
  Stage stage_ = Stage::rays;
  bool first_ = true;
};

}  // namespace sightline
