#pragma once
// The numbers of CGAL's kernels that the program offers: what an eye sees by them is compiled once, in kernels.cpp.

#include <sightline/algorithms/point_visibility/number_view.h>
#include <sightline/algorithms/point_visibility/visible.h>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Gmpq.h>

namespace sightline {

extern template Visible_surface<Number_view<float>> visible_surface(const Number_view<float>&, const Piece_boxes&,
                                                                    Cones<Number_view<float>>, const Visible_options&);
extern template Visible_surface<Number_view<float>> visible_surface(const Number_view<float>&, const Piece_boxes&,
                                                                    const Visible_options&);
extern template Visible_surface<Number_view<double>> visible_surface(const Number_view<double>&, const Piece_boxes&,
                                                                     Cones<Number_view<double>>,
                                                                     const Visible_options&);
extern template Visible_surface<Number_view<double>> visible_surface(const Number_view<double>&, const Piece_boxes&,
                                                                     const Visible_options&);
extern template Visible_surface<Number_view<CGAL::Gmpq>> visible_surface(const Number_view<CGAL::Gmpq>&,
                                                                         const Piece_boxes&,
                                                                         Cones<Number_view<CGAL::Gmpq>>,
                                                                         const Visible_options&);
extern template Visible_surface<Number_view<CGAL::Gmpq>> visible_surface(const Number_view<CGAL::Gmpq>&,
                                                                         const Piece_boxes&, const Visible_options&);
extern template Visible_surface<Number_view<CGAL::Epeck::FT>> visible_surface(const Number_view<CGAL::Epeck::FT>&,
                                                                              const Piece_boxes&,
                                                                              Cones<Number_view<CGAL::Epeck::FT>>,
                                                                              const Visible_options&);
extern template Visible_surface<Number_view<CGAL::Epeck::FT>> visible_surface(const Number_view<CGAL::Epeck::FT>&,
                                                                              const Piece_boxes&,
                                                                              const Visible_options&);

}  // namespace sightline
