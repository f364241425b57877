#pragma once
// The images of `sightline graph --pixels`: how many faces the priorities leave to choose from at each pixel.

#include "picture.h"

#include <sightline/algorithms/priority/pixels.h>

namespace sightline::app {

struct Pixel_arguments {
  std::string size, eyes, pictures;  ///< WxH, a file, a folder
};

/// One image: by h, which holds for all viewpoints, and by the tree of separating planes.
struct Pixel_image {
  View view;
  Pixel_statistics by_number, by_tree;
  std::optional<double> changed;  ///< share of the pixels where |S^| by h is not that of the image before
};

/// The views of a file: a line X,Y,Z for the eye, or X,Y,Z,DX,DY,DZ with the direction it looks in. Errors: Usage_error
/// for the size; those of read_lines for the file.
std::vector<View> read_views(const Pixel_arguments& arguments);
/// Where the picture of an image goes, numbered from 1.
std::string picture_file(const Pixel_arguments& arguments, std::size_t number);
Pixel_view pixel_view(const View& view);
/// Both images beside each other, pixels with one face left green, with more from yellow to red.
std::string painted(const Pixel_image& image);
Json to_json(const std::vector<Pixel_image>& images);
void print(const std::vector<Pixel_image>& images);

}  // namespace sightline::app
