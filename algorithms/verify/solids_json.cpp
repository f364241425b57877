#include <sightline/algorithms/verify/solids_json.h>

#include <sightline/algorithms/verify/json_text.h>
#include <sightline/algorithms/verify/keys_once.h>
#include <sightline/algorithms/verify/written_out.h>
#include <sightline/kernel/quoted.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <ostream>
#include <stdexcept>
#include <unordered_map>
#include <vector>

namespace sightline {

namespace {

constexpr std::size_t most_said = 200;  // bytes, of what is wrong with its JSON
constexpr const char* solids_format = "sightline boolean 1";
constexpr std::array<const char*, 3> fate_names{"dropped", "kept", "turned"};

/// Whole numbers that fit.
std::uint32_t whole_number_of(const nlohmann::json& value) {
  if (!value.is_number_unsigned() || value.get<std::uint64_t>() > 0xffffffffu)
    throw std::invalid_argument("a number that should be a whole one below 2^32 is not");
  return value.get<std::uint32_t>();
}

int winding_number_of(const nlohmann::json& value) {
  const bool fits = value.is_number_integer() &&
                    (value.is_number_unsigned() ? value.get<std::uint64_t>() <= 0x7fffffffu
                                                : value.get<std::int64_t>() >= -std::int64_t{0x7fffffff});
  if (!fits) throw std::invalid_argument("a winding number is not a whole one between -2^31 and 2^31");
  return static_cast<int>(value.get<std::int64_t>());
}

/// Of equal points the same: canonical rationals have equal limbs.
struct Point_hash {
  std::size_t operator()(const Exact_point& p) const {
    std::uint64_t hash = 0;
    for (const Rational& x : p)
      for (const mpz_srcptr part : {x.get_num_mpz_t(), x.get_den_mpz_t()}) {
        hash ^= mpz_getlimbn(part, 0) + static_cast<std::uint64_t>(mpz_sgn(part));
        hash *= 0x9e3779b97f4a7c15;
        hash ^= hash >> 32;
      }
    return hash;
  }
};

}  // namespace

void write_solid_certificate(std::ostream& out, const Solid_certificate& certificate) {
  std::unordered_map<Exact_point, std::size_t, Point_hash> numbers;
  std::vector<std::size_t> of_corners;  // of all fragments, then of all pieces
  out << "{\"format\": \"" << solids_format << "\",\n\"operation\": ";
  certificate_check::write_json_text(out, certificate.operation);
  out << ", \"inside\": ";
  certificate_check::write_json_text(out, certificate.inside);
  out << ", \"operands\": " << certificate.operands << ",\n\"points\": [";
  const auto number = [&](const Exact_point& p) {
    const auto [at, fresh] = numbers.try_emplace(p, numbers.size());
    if (fresh) out << (at->second == 0 ? "\n[\"" : ",\n[\"") << p[0] << "\",\"" << p[1] << "\",\"" << p[2] << "\"]";
    of_corners.push_back(at->second);
  };
  for (const auto& fragment : certificate.fragments)
    for (const Exact_point& p : fragment.vertices) number(p);
  for (const auto& piece : certificate.pieces)
    for (const Exact_point& p : piece.vertices) number(p);
  std::size_t corner = 0;
  const auto loop = [&](const std::vector<Exact_point>& vertices) {
    out << "\"vertices\": [";
    for (std::size_t k = 0; k < vertices.size(); ++k) out << (k == 0 ? "" : ",") << of_corners[corner++];
    out << "]";
  };
  out << "],\n\"fragments\": [";
  bool first = true;
  for (const auto& fragment : certificate.fragments) {
    out << (first ? "\n{\"parts\": [" : ",\n{\"parts\": [");
    first = false;
    for (std::size_t k = 0; k < fragment.parts.size(); ++k) {
      const auto& part = fragment.parts[k];
      out << (k == 0 ? "[" : ",[") << part.operand << ',' << part.face << ',' << part.piece << ','
          << (part.turned ? 1 : 0) << ']';
    }
    out << "], ";
    loop(fragment.vertices);
    out << ", \"front\": [";
    for (std::size_t k = 0; k < fragment.front.size(); ++k)
      out << (k == 0 ? "[" : ",[") << fragment.front[k].first << ',' << fragment.front[k].second << ']';
    out << "], \"fate\": \"" << fate_names[static_cast<std::size_t>(fragment.fate)] << "\"}";
  }
  out << "],\n\"pieces\": [";
  first = true;
  for (const auto& piece : certificate.pieces) {
    out << (first ? "\n" : ",\n") << "{\"operand\": " << piece.operand << ", \"face\": " << piece.face
        << ", \"piece\": " << piece.piece << ", ";
    loop(piece.vertices);
    out << '}';
    first = false;
  }
  out << "],\n\"set_aside\": [";
  first = true;
  for (const auto& entry : certificate.set_aside) {
    out << (first ? "\n" : ",\n") << "{\"operand\": " << entry.operand << ", \"face\": " << entry.face << ", \"why\": ";
    certificate_check::write_json_text(out, entry.why);
    out << '}';
    first = false;
  }
  out << "]}\n";
}

Solid_certificate read_solid_certificate(const std::string& text) {
  using nlohmann::json;
  Solid_certificate certificate;
  try {
    const json all = json_with_keys_once(text);
    if (!all.is_object() || all.value("format", "") != solids_format)
      throw std::invalid_argument(std::string("its \"format\" is not \"") + solids_format + "\"");
    certificate.operation = all.at("operation").get<std::string>();
    certificate.inside = all.at("inside").get<std::string>();
    certificate.operands = whole_number_of(all.at("operands"));
    std::vector<Exact_point> points;
    for (const json& point : all.at("points")) {
      if (!point.is_array() || point.size() != 3) throw std::invalid_argument("a point has not three coordinates");
      Exact_point p;
      for (std::size_t k = 0; k < 3; ++k) p[k] = rational_from_string(point[k].get_ref<const std::string&>());
      points.push_back(std::move(p));
    }
    Written_out written_out;
    const auto loop = [&](const json& vertices) {
      std::vector<Exact_point> polygon;
      for (const json& number : vertices) {
        const std::uint32_t at = whole_number_of(number);
        if (at >= points.size()) throw std::invalid_argument("a vertex is none of the points");
        if (!written_out.add(points[at], text.size()))
          throw std::invalid_argument(std::string("points are ") + Written_out::what_is_too_much);
        polygon.push_back(points[at]);
      }
      if (polygon.size() < 3) throw std::invalid_argument("a polygon of fewer than three vertices");
      return polygon;
    };
    for (const json& entry : all.at("fragments")) {
      Solid_certificate::Fragment& fragment = certificate.fragments.emplace_back();
      for (const json& part : entry.at("parts")) {
        if (!part.is_array() || part.size() != 4) throw std::invalid_argument("a part is not of four numbers");
        const std::uint32_t turned = whole_number_of(part[3]);
        if (turned > 1) throw std::invalid_argument("a part is turned by neither 0 nor 1");
        fragment.parts.push_back(
            {whole_number_of(part[0]), whole_number_of(part[1]), whole_number_of(part[2]), turned == 1});
      }
      fragment.vertices = loop(entry.at("vertices"));
      for (const json& number : entry.at("front")) {
        if (!number.is_array() || number.size() != 2)
          throw std::invalid_argument("a winding number is not with its operand");
        fragment.front.emplace_back(whole_number_of(number[0]), winding_number_of(number[1]));
      }
      const std::string fate = entry.at("fate").get<std::string>();
      const auto at = std::find(fate_names.begin(), fate_names.end(), fate);
      if (at == fate_names.end()) throw std::invalid_argument("a fate is none of dropped, kept and turned");
      fragment.fate = static_cast<Solid_certificate::Fate>(at - fate_names.begin());
    }
    for (const json& entry : all.at("pieces"))
      certificate.pieces.push_back({whole_number_of(entry.at("operand")), whole_number_of(entry.at("face")),
                                    whole_number_of(entry.at("piece")), loop(entry.at("vertices"))});
    for (const json& entry : all.at("set_aside"))
      certificate.set_aside.push_back({whole_number_of(entry.at("operand")), whole_number_of(entry.at("face")),
                                       entry.at("why").get<std::string>()});
  } catch (const json::exception& error) {
    const std::string what = error.what();
    throw std::invalid_argument("no certificate of a set operation: " +
                                printable(what.substr(what.find("] ") + 2), most_said, true));
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(std::string("no certificate of a set operation: ") + error.what());
  }
  return certificate;
}

}  // namespace sightline
