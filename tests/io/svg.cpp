// Flat pictures: names of polygons, and colours of series.

#include <sightline/io/plot.h>
#include <sightline/io/svg.h>

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <sstream>

namespace sightline::test {
namespace {

TEST(Svg, names_polygons_that_have_a_name_and_no_others) {
  Svg svg(100, 100);
  svg.polygon({{10, 10}, {90, 10}, {10, 90}}, "#ff0000", "#000000", 1, "face-7-1", "face 7");
  svg.polygon({{10, 10}, {90, 10}, {10, 90}}, "#00ff00", "#000000", 1);
  const std::string text = svg.text();
  EXPECT_NE(text.find("<polygon id=\"face-7-1\" points=\"10,10 90,10 10,90\" fill=\"#ff0000\""), std::string::npos)
      << text;
  EXPECT_NE(text.find("<title>face 7</title></polygon>"), std::string::npos) << text;
  EXPECT_NE(text.find("<polygon points=\"10,10 90,10 10,90\" fill=\"#00ff00\" stroke=\"#000000\" stroke-width=\"1\"/>"),
            std::string::npos)
      << text;
}

TEST(Svg, clips_polygons_a_little_beyond_the_frame) {
  Svg svg(100, 100);
  svg.polygon({{-50, 50}, {50, 0}, {50, 100}}, "#ff0000", "#000000", 1);  // ten beyond is as far as it goes
  svg.polygon({{150, 50}, {50, 100}, {50, 0}}, "#ff0000", "#000000", 1);
  EXPECT_NE(svg.text().find("points=\"-10,30 50,0 50,100 -10,70\""), std::string::npos) << svg.text();
  EXPECT_NE(svg.text().find("points=\"110,70 50,100 50,0 110,30\""), std::string::npos) << svg.text();
}

TEST(Svg, writes_words_in_black_unless_told_otherwise) {
  Svg svg(100, 100, "none");
  svg.label(5, 5, 12, "plain");
  svg.label(5, 25, 12, "light", "end", "#eeeeee");
  EXPECT_NE(svg.text().find("<rect width=\"100%\" height=\"100%\" fill=\"none\"/>"), std::string::npos);
  EXPECT_NE(svg.text().find("font-size=\"12\">plain<"), std::string::npos) << svg.text();
  EXPECT_NE(svg.text().find("fill=\"#eeeeee\" text-anchor=\"end\">light<"), std::string::npos) << svg.text();
}

TEST(Svg, fills_polygons_as_one_shape_and_leaves_out_what_has_no_width) {
  Svg svg(100, 100);
  svg.shape({{{0, 0}, {5, 0}, {5, 5}}, {{5, 0}, {5.001, 0}, {5.002, 5}, {5, 5}}, {{5, 0}, {9, 0}, {9, 9}, {5, 5}}},
            "#ff0000");
  EXPECT_NE(svg.text().find("<path d=\"M0,0l5,0 0,5zM5,0l4,0 0,9-4-4z\" fill=\"#ff0000\"/>"), std::string::npos)
      << svg.text();
  svg.shape({{{-3, 7}, {1.25, 6.05}, {0.5, 8}}, {{1, 1}, {1, 1}, {2, 2}}}, "#0000ff", "#000000", 0.4, "face-7-1",
            "face 7");
  EXPECT_NE(svg.text().find("<path id=\"face-7-1\" d=\"M-3,7l4.25-.95-.75,1.95z\" fill=\"#0000ff\" "
                            "stroke=\"#000000\" stroke-width=\"0.4\"><title>face 7</title></path>"),
            std::string::npos)
      << svg.text();
  svg.chains({{{1, 1}, {2, 2}, {2, 2.001}, {3, 1}}, {{4, 4}, {4, 4}}}, "#00ff00", 2);
  EXPECT_NE(svg.text().find("<path d=\"M1,1 2,2 3,1\" fill=\"none\" stroke=\"#00ff00\""), std::string::npos)
      << svg.text();
}

/// The colour of each series of a plot, from the line before its name.
std::map<std::string, std::string> colours_of(const Log_plot& plot, const std::set<std::string>& series) {
  std::map<std::string, std::string> colours;
  std::istringstream text(plot.text());
  std::string line, colour;
  while (std::getline(text, line)) {
    if (const std::size_t at = line.find("stroke=\""); at != std::string::npos)
      colour = line.substr(at + 8, line.find('"', at + 8) - at - 8);
    for (const std::string& name : series)
      if (line.find(">" + name + "<") != std::string::npos) colours[name] = colour;
  }
  return colours;
}
Log_plot plot_of(const std::set<std::string>& series) {
  Log_plot plot("Title", "x axis", "y axis");
  for (const std::string& name : series) {
    plot.add(name, 1, 1);
    plot.add(name, 10, 100);
  }
  return plot;
}

TEST(Log_plot, gives_a_series_its_colour_whatever_others_are_there) {
  for (const std::string name : {"exact", "double", "brute force", "tracker"}) {
    const std::string alone = colours_of(plot_of({name}), {name})[name];
    EXPECT_FALSE(alone.empty()) << name;
    EXPECT_EQ(colours_of(plot_of({"zz", name}), {name})[name], alone) << name;
  }
}

TEST(Log_plot, gives_no_two_series_of_a_plot_one_colour) {
  std::set<std::string> names, colours;
  for (char c = 'a'; c < 'a' + 12; ++c) names.insert(std::string("series ") + c);
  for (const auto& [name, colour] : colours_of(plot_of(names), names)) colours.insert(colour);
  EXPECT_EQ(colours.size(), names.size());
}

TEST(Log_plot, takes_a_colour_a_size_and_a_background) {
  Log_plot plot = plot_of({"a", "b"});
  plot.set_colour("a", "#123456");
  plot.set_colour("not there", "#654321");
  plot.set_canvas(500, 300, "#000000", "#ffffff");
  EXPECT_EQ(colours_of(plot, {"a"})["a"], "#123456");
  const std::string text = plot.text();
  EXPECT_EQ(text.find("#654321"), std::string::npos);
  EXPECT_NE(text.find("width=\"500\" height=\"300\""), std::string::npos);
  EXPECT_NE(text.find("fill=\"#ffffff\">Title<"), std::string::npos) << text;
}

}  // namespace
}  // namespace sightline::test
