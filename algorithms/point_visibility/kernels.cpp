#include <sightline/algorithms/point_visibility/kernels.h>

namespace sightline {

template Visible_surface<Number_view<float>> visible_surface(const Number_view<float>&, const Piece_boxes&,
                                                             Cones<Number_view<float>>, const Visible_options&);
template Visible_surface<Number_view<float>> visible_surface(const Number_view<float>&, const Piece_boxes&,
                                                             const Visible_options&);
template Visible_surface<Number_view<double>> visible_surface(const Number_view<double>&, const Piece_boxes&,
                                                              Cones<Number_view<double>>, const Visible_options&);
template Visible_surface<Number_view<double>> visible_surface(const Number_view<double>&, const Piece_boxes&,
                                                              const Visible_options&);
template Visible_surface<Number_view<CGAL::Gmpq>> visible_surface(const Number_view<CGAL::Gmpq>&, const Piece_boxes&,
                                                                  Cones<Number_view<CGAL::Gmpq>>,
                                                                  const Visible_options&);
template Visible_surface<Number_view<CGAL::Gmpq>> visible_surface(const Number_view<CGAL::Gmpq>&, const Piece_boxes&,
                                                                  const Visible_options&);
template Visible_surface<Number_view<CGAL::Epeck::FT>> visible_surface(const Number_view<CGAL::Epeck::FT>&,
                                                                       const Piece_boxes&,
                                                                       Cones<Number_view<CGAL::Epeck::FT>>,
                                                                       const Visible_options&);
template Visible_surface<Number_view<CGAL::Epeck::FT>> visible_surface(const Number_view<CGAL::Epeck::FT>&,
                                                                       const Piece_boxes&, const Visible_options&);

}  // namespace sightline
