#include <sightline/io/write.h>

#include <sightline/io/exact_text.h>
#include <sightline/io/file.h>
#include <sightline/io/obj.h>
#include <sightline/io/off.h>
#include <sightline/io/ply.h>
#include <sightline/io/stl.h>

#include <optional>
#include <sstream>
#include <stdexcept>
#include <streambuf>
#include <string>
#include <string_view>

namespace sightline {

void write_scene(const Polygon_soup& soup, std::ostream& out, Format format) {
  soup.check_corners();
  switch (format) {
    case Format::obj: return write_obj(soup, out);
    case Format::off: return write_off(soup, out);
    case Format::qoff: return write_qoff(soup, out);
    case Format::ply: return write_ply(soup, out, false);
    case Format::ply_binary: return write_ply(soup, out, true);
    case Format::stl: return write_stl(soup, out);
    case Format::map:
    case Format::bsp: throw Not_representable("levels are read only; write .qoff, which holds any scene without holes");
    case Format::glb:
    case Format::gltf: throw Not_representable("glTF is read only; write .qoff, which holds any scene without holes");
  }
}

void write_scene(const Polygon_soup& soup, const std::filesystem::path& path, Format format) {
  std::ostringstream out;
  write_scene(soup, out, format);
  write_bytes(path, out.view());
}

static Format format_to_write(const std::filesystem::path& path) {
  if (const std::optional<Format> format = format_of_ending(path)) return *format;
  throw std::runtime_error(path.string() + ": no format has this ending; give one of " + supported_formats);
}

void write_scene(const Polygon_soup& soup, const std::filesystem::path& path) {
  write_scene(soup, path, format_to_write(path));
}

/// Gathers bytes, and tells how many there are.
class Told_buffer : public std::streambuf {
 public:
  explicit Told_buffer(const std::function<void(std::size_t done, std::size_t all)>& progress) : progress_(progress) {}
  const std::string& bytes() const { return bytes_; }
  static constexpr std::size_t step = 1 << 16;

 protected:
  std::streamsize xsputn(const char* more, std::streamsize count) override {
    bytes_.append(more, static_cast<std::size_t>(count));
    if (bytes_.size() >= told_ + step) progress_(told_ = bytes_.size(), 0);
    return count;
  }
  int overflow(int c) override {
    if (c != traits_type::eof()) bytes_ += traits_type::to_char_type(c);
    return traits_type::not_eof(c);
  }

 private:
  const std::function<void(std::size_t done, std::size_t all)>& progress_;
  std::string bytes_;
  std::size_t told_ = 0;
};

void write_scene(const Polygon_soup& soup, const std::filesystem::path& path,
                 const std::function<void(std::size_t done, std::size_t all)>& progress) {
  Told_buffer buffer(progress);
  std::ostream made(&buffer);
  made.exceptions(std::ios::badbit);  // what progress throws goes through
  write_scene(soup, made, format_to_write(path));
  write_stream(path, [&](std::ostream& out) {
    const std::string_view bytes = buffer.bytes();
    for (std::size_t at = 0; at < bytes.size() && out; at += Told_buffer::step) {
      const std::string_view part = bytes.substr(at, Told_buffer::step);
      out.write(part.data(), static_cast<std::streamsize>(part.size()));
      progress(at + part.size(), bytes.size());
    }
  });
}

}  // namespace sightline
